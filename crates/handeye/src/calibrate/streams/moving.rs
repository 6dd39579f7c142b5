//! Captures of a robot that did not stop for them.
//!
//! Their target poses are a stream, and so are the robot's poses: the two give the offset of the clocks, as they do
//! where poses are all there is. Then every capture gets the robot's pose of its own moment, and the calibration runs on
//! the captures whole, corners and all, with the offset free about what was found.

use std::collections::BTreeMap;

use super::{
    Both, Stamped, Streams, both, choose, cleaning, enough, nothing, open, settle_streams, told,
    without_offset,
};
use crate::{
    Base, Calibration, Config, Error, Flange, Pose, Session, Warning, calibrate,
    calibrate::settle::Stand, findings::StreamFinding,
};

/// Calibrates from captures of a moving robot. `robot` is where its flange was over time, `joints` what its joint values
/// were (rad, m; empty where they are not known), `times` says when each capture was taken, by the camera's clock (s); the
/// robot's poses and joint values in `session` are not looked at. The result tells the offset of
/// the clocks, camera time minus robot time, and its standard deviation.
///
/// # Errors
/// [`Error::NotFinite`] on times and poses that are no numbers, [`Error::TooFewSamples`] without robot poses or without
/// captures that show the target. Fewer than needed end in a verdict.
pub fn calibrate_moving(
    session: &Session,
    robot: &[Stamped<Pose<Base, Flange>>],
    joints: &[Stamped<Vec<f64>>],
    times: &BTreeMap<String, f64>,
    config: &Config,
) -> Result<Calibration, Error> {
    let streams = streams(session, robot, times);
    let both = both(&streams)?;
    let mut warnings = cleaning(&both.robot, "robot");
    let found = enough(&both).and_then(|()| settle_streams(&both, false, config));
    let still = open::still(&both, found.as_ref().ok().map(|f| &f.0));
    let mut result = match found {
        Err(error @ Error::TooFewSamples { .. }) => nothing(&both, &streams, &error),
        _ if let Some(still) = still => nothing(&both, &streams, &still),
        Ok((settled, chosen, _)) => {
            let likeness = choose::likeness(&settled, both.setup);
            let steady = open::clock_is_free(&both, &chosen, &settled);
            let moving = Moving { both: &both, joints: in_order(joints), times };
            let (result, without) = finish(session, &moving, settled.stand, steady, config)?;
            warnings.extend(without);
            warnings.extend(told(
                &result,
                result.captures.len(),
                both.camera.times.len(),
                likeness,
            ));
            result
        }
        Err(error) => without_offset(&both, &streams, config, &error)?,
    };
    result.warnings.splice(0..0, warnings);
    Ok(result)
}

/// The captures that show the target, as a stream of its poses.
fn streams(
    session: &Session,
    robot: &[Stamped<Pose<Base, Flange>>],
    times: &BTreeMap<String, f64>,
) -> Streams {
    let seen = session.observations.iter().filter_map(|o| {
        let pose = o.candidates.first()?.camera_from_target;
        Some(Stamped { time_s: *times.get(&o.capture)?, pose })
    });
    Streams {
        setup: session.setup,
        robot: robot.to_vec(),
        camera: seen.collect(),
        unknown_scale: false,
    }
}

/// A robot in motion, and when the captures were taken.
struct Moving<'a> {
    both: &'a Both,
    /// In the order of their times.
    joints: Vec<&'a Stamped<Vec<f64>>>,
    times: &'a BTreeMap<String, f64>,
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

/// The calibration with every capture at the robot's pose of its moment, and those of which there is none.
fn finish(
    session: &Session,
    moving: &Moving,
    stand: Stand,
    steady: bool,
    config: &Config,
) -> Result<(Calibration, Option<Warning>), Error> {
    let (mut session, mut velocities) = (session.clone(), BTreeMap::new());
    let Moving { both, joints, times } = moving;
    let offset = stand.offset + both.epochs();
    let mut without = vec![];
    session.observations.retain_mut(|o| {
        let time_s = times.get(&o.capture).map(|t| t - offset);
        let moment = time_s.and_then(|t| Some((t, both.robot_at(t)?)));
        let Some((time_s, moment)) = moment else {
            without.push(o.capture.clone());
            return false;
        };
        o.base_from_flange = Pose::claim(moment.robot);
        o.joints = joints_at(joints, time_s).unwrap_or_default();
        velocities.insert(o.capture.clone(), both.mount_velocity(&moment));
        true
    });
    let mut config = config.clone();
    config.unknown.velocities = if steady { open::steadied(&velocities) } else { velocities };
    let mut result = calibrate::calibrate(&session, &config)?;
    result.time_offset_s = match result.time_offset_sigma_s {
        Some(_) => result.time_offset_s.map(|later| offset + later),
        None => None,
    };
    let warning =
        (!without.is_empty()).then(|| StreamFinding::WithoutRobotPose { captures: without }.into());
    Ok((result, warning))
}
