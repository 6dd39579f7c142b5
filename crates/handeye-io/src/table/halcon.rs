//! HALCON's pose files (`write_pose`): a type `f`, a rotation `r`, a translation `t` in metres.
//!
//! ```text
//! f 0   gba          R = Rx(r1) Ry(r2) Rz(r3), degrees
//! f 2   abg          R = Rz(r3) Ry(r2) Rx(r1), degrees
//! f 4   rodriguez    turn about r by the angle whose half has |r| as its tangent
//! ```
//!
//! Each becomes a record of a position and a quaternion. All other types have the translation before the rotation, or
//! the inverse of the pose.

use std::path::Path;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{Cell, Record};
use crate::error::{Error, Place, malformed};

/// Columns of such a record: those of `quaternion-xyzw`.
pub(crate) const COLUMNS: [&[&str]; 7] =
    [&["x"], &["y"], &["z"], &["qx"], &["qy"], &["qz"], &["qw"]];

/// Whether a text is such a file: it has a line of each kind, and no others.
pub(crate) fn is_pose(text: &str) -> bool {
    let mut kinds: Vec<&str> = lines(text).map(|(_, kind, _)| kind).collect();
    kinds.sort_unstable();
    kinds == ["f", "r", "t"]
}

/// Number, first word and rest of each line that is no comment.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str, &str)> {
    let bare = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    bare.enumerate().filter(|(_, line)| !line.is_empty()).map(|(k, line)| {
        let (first, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        (k + 1, first, rest)
    })
}

/// The pose of the file.
pub(super) fn record(text: &str, path: &Path) -> Result<Record, Error> {
    let values = |wanted: &str, count: usize| {
        let (line, _, rest) = lines(text).find(|(_, kind, _)| *kind == wanted).unwrap_or_default();
        let numbers: Option<Vec<f64>> = rest.split_whitespace().map(|w| w.parse().ok()).collect();
        numbers.filter(|n| n.len() == count && n.iter().all(|x| x.is_finite())).ok_or_else(|| {
            let what = format!("the line {wanted} has not {count} numbers");
            malformed(Place::line(path, line), what, "write it again with write_pose")
        })
    };
    let (kind, r, t) = (values("f", 1)?, values("r", 3)?, values("t", 3)?);
    let rotation = rotation(kind[0], Vector3::from_row_slice(&r)).ok_or_else(|| {
        let what = format!("is a pose of type {}", kind[0]);
        let advice = "HALCON's convert_pose_type makes type 0 of it ('Rp+T', 'gba', 'point')";
        malformed(Place::file(path), what, advice)
    })?;
    let q = rotation.coords;
    let cells = t.into_iter().chain(q.iter().copied()).map(Cell::Number).collect();
    let names = COLUMNS.iter().map(|names| names[0].to_string()).collect();
    Ok(Record { cells, names, by_header: false, id: None, place: Place::file(path) })
}

fn rotation(kind: f64, r: Vector3<f64>) -> Option<UnitQuaternion<f64>> {
    let about = |axis: Vector3<f64>, angle: f64| UnitQuaternion::new(axis * angle.to_radians());
    let [x, y, z] = [about(Vector3::x(), r.x), about(Vector3::y(), r.y), about(Vector3::z(), r.z)];
    match kind {
        0.0 => Some(x * y * z),
        2.0 => Some(z * y * x),
        4.0 => Some(UnitQuaternion::from_quaternion(Quaternion::from_parts(1.0, r))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quaternion(text: &str) -> UnitQuaternion<f64> {
        let record = record(text, Path::new("a.dat")).unwrap();
        let n = record.numbers(&COLUMNS, "a pose").unwrap();
        assert_eq!(n[..3], [0.1, 0.2, 0.3]);
        UnitQuaternion::from_quaternion(Quaternion::new(n[6], n[3], n[4], n[5]))
    }

    fn file(kind: &str, turn: &str) -> String {
        format!("# 3D POSE\nf {kind}\n\n# angles\nr {turn}\n# m\nt 0.1 0.2 0.3\n")
    }

    #[test]
    fn the_three_kinds_of_rotation_are_read() {
        let turned = |axis: Vector3<f64>| UnitQuaternion::new(axis * 90f64.to_radians());
        let (x, z) = (turned(Vector3::x()), turned(Vector3::z()));
        assert!(quaternion(&file("0", "90 0 90")).angle_to(&(x * z)) < 1e-12);
        assert!(quaternion(&file("2", "90 0 90")).angle_to(&(z * x)) < 1e-12);
        assert!(quaternion(&file("4", "0 0 1")).angle_to(&z) < 1e-12);
    }

    #[test]
    fn other_kinds_are_refused_and_other_files_are_not_taken() {
        let error = record(&file("1", "0 0 0"), Path::new("a.dat")).unwrap_err().to_string();
        assert!(error.contains("type 1") && error.contains("convert_pose_type"), "{error}");
        let error = record(&file("0", "0 0"), Path::new("a.dat")).unwrap_err().to_string();
        assert!(error.starts_with("a.dat:5: "), "{error}");
        assert!(!is_pose("1 2 3\n4 5 6\n") && !is_pose("f 0\nr 0 0 0\n"));
    }
}
