//! Poses of robots, in many notations.

use crate::{file, told};
use handeye_io::{RobotFile, read_robot_poses};

const NOTATIONS: [&str; 8] =
    ["ur", "kuka", "fanuc", "abb", "matrix", "quaternion-xyzw", "kawasaki", "nonsense"];

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let Some((notation, rest)) = data.split_first() else { return };
    let extensions = ["csv", "txt", "json", "yaml", "xml", "npy", "toml", "calib"];
    let Some(poses) = file(rest, &extensions) else { return };
    told(read_robot_poses(&RobotFile { poses: poses.clone(), keys: vec![] }));
    let notation = NOTATIONS[usize::from(*notation) % NOTATIONS.len()];
    let keys = vec![
        ("notation", notation.into()),
        ("direction", "base_from_flange".into()),
        ("length_unit", "mm".into()),
        ("angle_unit", "deg".into()),
    ];
    told(read_robot_poses(&RobotFile { poses, keys }));
}
