//! Lengths in another unit: millimetres read as metres put the flange beyond any robot's reach, and the target beyond any
//! camera's sight. Captures that do not agree have no say.

use super::thresholds::FARTHEST;
use crate::{Observation, findings::RobotFinding, math::linalg::median};

/// Whether robot poses or target poses are too far away to be in metres.
pub(crate) fn wrong_units(used: &[&Observation]) -> Vec<RobotFinding> {
    let reach = used.iter().map(|o| o.base_from_flange.translation().norm());
    let farthest_m = reach.fold(0.0, f64::max);
    let seen = used.iter().filter_map(|o| o.candidates.first());
    let distance_m = median(seen.map(|pose| pose.camera_from_target.translation().norm()));
    let target = (distance_m > FARTHEST).then_some(RobotFinding::TargetLengthUnit { distance_m });
    let robot = (farthest_m > FARTHEST).then_some(RobotFinding::LengthUnit { farthest_m });
    target.into_iter().chain(robot).collect()
}
