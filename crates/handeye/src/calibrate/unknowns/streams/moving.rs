//! Captures of a robot that did not stop for them.
//!
//! Their target poses are a stream, and so are the robot's poses: the two give the offset of the clocks, as they do
//! where poses are all there is. Then every capture gets the robot's pose of its own moment, and the calibration runs on
//! the captures whole, corners and all, with the offset free about what was found.

use std::f64::consts::{PI, TAU};

use super::choose::Both;
use crate::{Observation, Pose, Session, Stamped, model::session::Motion};

/// The captures with the robot's pose and joint values of their moments, the camera's clock being `offset` (s) ahead, and
/// the names of those at which the robot's record has none.
pub(super) fn captures(
    session: &Session,
    motion: &Motion,
    both: &Both,
    offset: f64,
) -> (Session, Vec<String>) {
    let joints = in_order(&motion.joints);
    let mut without = vec![];
    let at_its_moment = |o: &Observation| {
        let time_s = o.time_s? - offset;
        let moment = both.robot_at(time_s)?;
        Some(Observation {
            base_from_flange: Pose::claim(moment.robot),
            joints: joints_at(&joints, time_s).unwrap_or_default(),
            velocity: Some(both.mount_velocity(&moment)),
            ..o.clone()
        })
    };
    let mut observations = vec![];
    for o in &session.observations {
        match at_its_moment(o) {
            Some(moved) => observations.push(moved),
            None => without.push(o.capture.clone()),
        }
    }
    (Session { observations, motion: None, ..session.clone() }, without)
}

fn in_order(joints: &[Stamped<Vec<f64>>]) -> Vec<&Stamped<Vec<f64>>> {
    let mut all: Vec<_> = joints.iter().filter(|j| j.time_s.is_finite()).collect();
    all.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    all
}

/// Joint values (rad, m) so far between those of two samples. An angle goes the shorter way: a controller that writes
/// angles from -pi to pi jumps by a whole turn.
pub fn joints_between(before: &[f64], after: &[f64], part: f64) -> Vec<f64> {
    let step =
        |a: f64, b: f64| if (b - a).abs() > PI { b - a - TAU.copysign(b - a) } else { b - a };
    before.iter().zip(after).map(|(a, b)| a + part * step(*a, *b)).collect()
}

/// Joint values between two samples. Whether they are too far apart the poses tell.
fn joints_at(joints: &[&Stamped<Vec<f64>>], time_s: f64) -> Option<Vec<f64>> {
    let after = joints.partition_point(|j| j.time_s <= time_s);
    let before = joints[after.checked_sub(1)?];
    if before.time_s == time_s {
        return Some(before.pose.clone());
    }
    let next = joints.get(after)?;
    let part = (time_s - before.time_s) / (next.time_s - before.time_s);
    Some(joints_between(&before.pose, &next.pose, part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_between_two_samples_go_the_shorter_way() {
        let half = joints_between(&[3.13, 0.2, 0.4], &[-3.13, 0.4, 0.4], 0.5);
        assert!((half[0] - PI).abs() < 1e-12, "{half:?}");
        assert!((half[1] - 0.3).abs() < 1e-12 && half[2] == 0.4, "{half:?}");
    }
}
