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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pose, findings::Finding, mistakes::tests::session};
    use nalgebra::Vector3;

    #[test]
    fn no_robot_reaches_beyond_twenty_metres_and_no_camera_sees_that_far() {
        let mut session = session(5, 1);
        let codes = |session: &crate::Session| {
            let found = wrong_units(&session.observations.iter().collect::<Vec<_>>());
            found.into_iter().map(|f| Finding::from(f).code()).collect::<Vec<_>>()
        };
        assert!(codes(&session).is_empty());
        let at =
            |x: f64| Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::new(x, 0.0, 0.0));
        session.observations[2].base_from_flange = at(19.0);
        assert!(codes(&session).is_empty());
        session.observations[2].base_from_flange = at(21.0);
        assert_eq!(codes(&session), ["robot-length-unit"]);
        for o in &mut session.observations {
            o.candidates.iter_mut().for_each(|c| c.camera_from_target = at(21.0).rename());
        }
        assert_eq!(codes(&session), ["target-length-unit", "robot-length-unit"]);
    }
}
