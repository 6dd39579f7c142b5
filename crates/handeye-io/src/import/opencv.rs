//! Transforms in files of OpenCV's FileStorage: 4 x 4 and 3 x 4 matrices, and rotations with a translation beside them, under
//! the names that scripts of OpenCV have. `cam2gripper` takes points of the camera into the gripper.

use nalgebra::{Matrix3, Matrix4, Rotation3, Vector3};

use super::Direction;
use crate::tree::Tree;

/// One transform of a file.
pub(super) struct Transform {
    /// As in the file; of two entries, what they have in common.
    pub(super) name: String,
    /// Row by row, 4 x 4.
    pub(super) numbers: Vec<f64>,
    /// What the name says, where it is of the camera on a robot.
    pub(super) direction: Option<Direction>,
}

const ROTATIONS: [&str; 4] = ["rotation", "rvec", "rot", "r"];
const TRANSLATIONS: [&str; 4] = ["translation", "trans", "tvec", "t"];

/// All that the entries hold.
pub(super) fn transforms(entries: &[(String, Tree)]) -> Vec<Transform> {
    let numbers: Vec<(&str, Vec<f64>)> =
        entries.iter().filter_map(|(key, value)| Some((key.as_str(), value.numbers()?))).collect();
    let whole = numbers.iter().filter_map(|(key, n)| {
        let numbers = if n.len() == 12 { completed(n)? } else { n.clone() };
        let name = key.to_string();
        (numbers.len() == 16).then(|| Transform { name, numbers, direction: direction(key) })
    });
    let parted = numbers.iter().filter_map(|(key, turn)| {
        let of = behind(key, &ROTATIONS)?;
        let place = numbers
            .iter()
            .find(|(k, n)| n.len() == 3 && behind(k, &TRANSLATIONS) == Some(of.clone()))?;
        Some(Transform {
            name: if of.is_empty() { format!("{key} and {}", place.0) } else { of.clone() },
            numbers: joined(turn, &place.1)?,
            direction: direction(&of),
        })
    });
    whole.chain(parted).collect()
}

/// The last row below three; `None` of twelve numbers that are something else, as coefficients of a lens.
fn completed(rows: &[f64]) -> Option<Vec<f64>> {
    let turn = Matrix3::from_fn(|i, j| rows[4 * i + j]);
    let is_rotation = (turn * turn.transpose() - Matrix3::identity()).amax() < NEAR;
    is_rotation.then(|| [rows, &[0.0, 0.0, 0.0, 1.0]].concat())
}

/// Rounded rotations are as near to one.
const NEAR: f64 = 1e-2;

/// `cam2gripper` of `R_cam2gripper`, in small letters.
fn behind(key: &str, prefixes: &[&str]) -> Option<String> {
    let key = key.to_lowercase();
    let mut rests = prefixes.iter().filter_map(|prefix| key.strip_prefix(prefix));
    rests.find_map(|rest| match rest.strip_prefix('_') {
        Some(name) => Some(name.to_string()),
        None => rest.is_empty().then(String::new),
    })
}

/// A matrix of 3 x 3 or a rotation vector, and a translation.
fn joined(turn: &[f64], place: &[f64]) -> Option<Vec<f64>> {
    let turn = match turn.len() {
        9 => Matrix3::from_row_slice(turn),
        3 => Rotation3::from_scaled_axis(Vector3::from_column_slice(turn)).into_inner(),
        _ => return None,
    };
    let mut whole = Matrix4::identity();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    whole.fixed_view_mut::<3, 1>(0, 3).copy_from_slice(place);
    Some(whole.transpose().as_slice().to_vec())
}

/// `flange_from_camera` of `T_cam2gripper`, `cam_to_gripper` or its own name.
fn direction(name: &str) -> Option<Direction> {
    let lower = name.to_lowercase();
    if let Ok(own) = Direction::named(&lower) {
        return own.setup().map(|_| own);
    }
    let bare = match lower.split_once('_') {
        Some((letter, rest)) if letter.len() == 1 => rest,
        _ => &lower,
    };
    let parted = |by: &str| {
        let (one, other) = bare.split_once(by)?;
        Some((frame(one)?, frame(other)?))
    };
    let inverse = |(to, from)| (from, to);
    let (from, to) =
        parted("2").or_else(|| parted("_to_")).or_else(|| parted("_from_").map(inverse))?;
    let found = Direction::of(to, from);
    found.setup().map(|_| found)
}

/// Whose frame a word of such a name means.
fn frame(word: &str) -> Option<&'static str> {
    match word.trim_matches('_') {
        "cam" | "camera" | "eye" | "sensor" => Some("camera"),
        "gripper" | "hand" | "flange" | "ee" | "eef" | "end" | "wrist" | "tool" | "tool0"
        | "tcp" => Some("flange"),
        "base" | "robot" => Some("base"),
        _ => None,
    }
}
