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
    calibrate::settle::Stand,
};

/// Calibrates from captures of a moving robot. `robot` is where its flange was over time, `times` says when each capture
/// was taken, by the camera's clock (s); the robot poses in `session` are not looked at. The result tells the offset of
/// the clocks, camera time minus robot time, and its standard deviation.
///
/// # Errors
/// [`Error::NotFinite`] on times and poses that are no numbers, [`Error::TooFewSamples`] without robot poses or without
/// captures that show the target. Fewer than needed end in a verdict.
pub fn calibrate_moving(
    session: &Session,
    robot: &[Stamped<Pose<Base, Flange>>],
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
            let (result, without) = finish(session, &both, times, settled.stand, steady, config)?;
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

/// The calibration with every capture at the robot's pose of its moment, and those of which there is none.
fn finish(
    session: &Session,
    both: &Both,
    times: &BTreeMap<String, f64>,
    stand: Stand,
    steady: bool,
    config: &Config,
) -> Result<(Calibration, Option<Warning>), Error> {
    let (mut session, mut velocities) = (session.clone(), BTreeMap::new());
    let offset = stand.offset + both.epochs();
    let mut without = vec![];
    session.observations.retain_mut(|o| {
        let Some(moment) = times.get(&o.capture).and_then(|t| both.robot_at(t - offset)) else {
            without.push(o.capture.clone());
            return false;
        };
        o.base_from_flange = Pose::claim(moment.robot);
        o.joints.clear(); // those of another moment
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
    let warning = (!without.is_empty()).then(|| {
        let text = format!(
            "{} captures were taken where the robot's poses have a gap, or before or after them, and are left out: {}",
            without.len(),
            without.join(", ")
        );
        Warning::new("capture-without-robot-pose", text)
    });
    Ok((result, warning))
}
