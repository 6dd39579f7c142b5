//! Captures of a robot that did not stop for them.
//!
//! Their target poses are a stream, and so are the robot's poses: the two give the offset of the clocks, as they do
//! where poses are all there is. Then every capture gets the robot's pose of its own moment, and the calibration runs on
//! the captures whole, corners and all, with the offset free about what was found.

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

/// Joint values between two samples, by a straight line. Whether they are too far apart the poses tell.
fn joints_at(joints: &[&Stamped<Vec<f64>>], time_s: f64) -> Option<Vec<f64>> {
    let after = joints.partition_point(|j| j.time_s <= time_s);
    let before = joints[after.checked_sub(1)?];
    if before.time_s == time_s {
        return Some(before.pose.clone());
    }
    let next = joints.get(after)?;
    let part = (time_s - before.time_s) / (next.time_s - before.time_s);
    Some(before.pose.iter().zip(&next.pose).map(|(a, b)| a + part * (b - a)).collect())
}
