//! What a bag calls the frames of the result, and which frames are fixed to the camera.

use std::collections::BTreeSet;

use handeye::{
    Pose, Setup,
    calibrate::result::{BodyFrame, FrameNames},
};
use nalgebra::Isometry3;

use super::{
    RobotSource,
    survey::{Edge, Survey},
};

/// Frames between a camera's optical frame and its body are no more than this.
const MOST_BODIES: usize = 8;

/// The names for a result, of a robot whose poses are read from `source` and of images in the frame `optical`.
pub(super) fn names(
    survey: &Survey,
    source: &RobotSource,
    setup: Option<Setup>,
    optical: Option<&str>,
) -> FrameNames {
    let (base, flange) = match source {
        RobotSource::Frames { base, flange } | RobotSource::Joints { base, flange, .. } => {
            (Some(base.clone()), Some(flange.clone()))
        }
        RobotSource::Poses { topic } => {
            (survey.topics.get(topic).and_then(|t| t.frame.clone()), None)
        }
    };
    let of_robot: BTreeSet<&str> =
        [&base, &flange].into_iter().flatten().flat_map(|f| up(survey, f)).collect();
    let bodies = optical.map_or(vec![], |optical| bodies(survey, optical, &of_robot));
    let mount = match setup {
        Some(Setup::EyeInHand) => flange,
        Some(Setup::EyeToHand) => base,
        None => None,
    };
    FrameNames { mount, camera: optical.map(String::from), bodies }
}

/// A frame and all above it.
fn up<'a>(survey: &'a Survey, frame: &'a str) -> Vec<&'a str> {
    let mut all = vec![frame];
    while let Some((parent, _)) = parent(survey, all[all.len() - 1]) {
        if all.contains(&parent) {
            break;
        }
        all.push(parent);
    }
    all
}

/// The only parent of a frame.
fn parent<'a>(survey: &'a Survey, frame: &str) -> Option<(&'a str, &'a Edge)> {
    let mut parents = survey.edges.get(frame)?.iter();
    parents.next().filter(|_| parents.next().is_none()).map(|(name, edge)| (name.as_str(), edge))
}

/// The frames above the camera's that never move against it, up to those of the robot.
fn bodies(survey: &Survey, optical: &str, of_robot: &BTreeSet<&str>) -> Vec<BodyFrame> {
    let (mut all, mut at, mut at_from_camera) = (vec![], optical, Isometry3::identity());
    while let Some((above, edge)) =
        parent(survey, at).filter(|(above, _)| !of_robot.contains(above))
    {
        let Some((_, above_from_at)) = edge.samples.last().filter(|_| edge.fixed) else { break };
        at_from_camera = above_from_at * at_from_camera;
        all.push(BodyFrame { name: above.into(), body_from_camera: Pose::claim(at_from_camera) });
        at = above;
        if all.len() == MOST_BODIES {
            break;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn survey() -> Survey {
        let mut survey = Survey::default();
        let mut edge = |parent: &str, child: &str, fixed: bool, x: f64| {
            let samples = vec![(0.0, Isometry3::translation(x, 0.0, 0.0))];
            let edge = Edge { fixed, samples, ..Edge::default() };
            survey.edges.entry(child.into()).or_default().insert(parent.into(), edge);
        };
        edge("base_link", "wrist", false, 9.0);
        edge("wrist", "tool0", true, 5.0);
        edge("wrist", "camera_link", true, 3.0);
        edge("camera_link", "camera_color_frame", true, 0.1);
        edge("camera_color_frame", "camera_color_optical_frame", true, 0.02);
        survey
    }

    #[test]
    fn frames_fixed_to_the_camera_end_before_those_of_the_robot() {
        let source = RobotSource::Frames { base: "base_link".into(), flange: "tool0".into() };
        let optical = Some("camera_color_optical_frame");
        let found = names(&survey(), &source, Some(Setup::EyeInHand), optical);
        assert_eq!(found.mount.as_deref(), Some("tool0"));
        assert_eq!(found.camera.as_deref(), optical);
        let x = |b: &BodyFrame| b.body_from_camera.translation().x;
        let bodies: Vec<(&str, f64)> =
            found.bodies.iter().map(|b| (b.name.as_str(), x(b))).collect();
        assert_eq!(bodies, [("camera_color_frame", 0.02), ("camera_link", 0.02 + 0.1)]);
        let beside = names(&survey(), &source, Some(Setup::EyeToHand), optical);
        assert_eq!(beside.mount.as_deref(), Some("base_link"));
        assert_eq!(names(&survey(), &source, None, optical).mount, None);
    }
}
