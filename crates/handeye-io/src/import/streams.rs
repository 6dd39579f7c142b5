//! Two streams of poses, each by its own clock, as `solve` reads them.

use std::fmt::Write;

use handeye::{Base, Camera, Flange, Pose, Setup, Stamped, Streams, Target};
use nalgebra::Isometry3;
use serde_json::json;

use super::Direction;

/// What `solve` reads.
pub(super) const NAME: &str = "pairs.json";

/// Robot and camera poses as their files have them, time in seconds.
pub(super) struct Recorded {
    pub(super) robot: Vec<Stamped<Isometry3<f64>>>,
    pub(super) camera: Vec<Stamped<Isometry3<f64>>>,
}

/// Directions of the poses of robot and camera.
pub(super) type Directions = (Direction, Direction);

pub(super) const ROBOT: Direction = Direction::of("base", "flange");
pub(super) const CAMERA: Direction = Direction::of("camera", "target");

impl Recorded {
    /// The streams, read in these directions.
    pub(super) fn streams(&self, setup: Setup, (robot, camera): Directions) -> Streams {
        let of_robot = |s: &Stamped<Isometry3<f64>>| Stamped {
            time_s: s.time_s,
            pose: Pose::<Base, Flange>::claim(robot.turned(&s.pose, ROBOT)),
        };
        let of_camera = |s: &Stamped<Isometry3<f64>>| Stamped {
            time_s: s.time_s,
            pose: Pose::<Camera, Target>::claim(camera.turned(&s.pose, CAMERA)),
        };
        Streams {
            setup,
            robot: self.robot.iter().map(of_robot).collect(),
            camera: self.camera.iter().map(of_camera).collect(),
            unknown_scale: false,
        }
    }
}

/// The streams as JSON, a line for each sample.
pub(super) fn text(streams: &Streams) -> String {
    let robot = |s: &Stamped<Pose<Base, Flange>>| {
        json!({ "time_s": s.time_s, "base_from_flange": s.pose }).to_string()
    };
    let camera = |s: &Stamped<Pose<Camera, Target>>| {
        json!({ "time_s": s.time_s, "camera_from_target": s.pose }).to_string()
    };
    let lists = [
        ("robot", streams.robot.iter().map(robot).collect()),
        ("camera", streams.camera.iter().map(camera).collect()),
    ];
    document(streams.setup, streams.unknown_scale, &lists)
}

/// A file for `solve` with these lists of lines.
pub(super) fn document(setup: Setup, unknown_scale: bool, lists: &[(&str, Vec<String>)]) -> String {
    let mut text = format!("{{\"setup\": \"{}\"", setup.name());
    if unknown_scale {
        text += ",\n \"unknown_scale\": true";
    }
    for (name, lines) in lists {
        write!(text, ",\n \"{name}\": [\n  {}\n ]", lines.join(",\n  ")).ok();
    }
    text + "}\n"
}
