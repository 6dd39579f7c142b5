//! Notations of no maker: their length unit must be said.

use super::{Column, Notation, Rotation, Sense, X, Y, Z, angle, length, plain};
use crate::units::AngleUnit;

const MATRIX: &[Column] = &[
    plain(&["r11"]),
    plain(&["r12"]),
    plain(&["r13"]),
    length(&["t1"]),
    plain(&["r21"]),
    plain(&["r22"]),
    plain(&["r23"]),
    length(&["t2"]),
    plain(&["r31"]),
    plain(&["r32"]),
    plain(&["r33"]),
    length(&["t3"]),
    plain(&["r41"]),
    plain(&["r42"]),
    plain(&["r43"]),
    plain(&["r44"]),
];

const QX: Column =
    plain(&["qx", "q_x", "orientation.x", "rotation.x", "quat_x", "quaternion.x", "i"]);
const QY: Column =
    plain(&["qy", "q_y", "orientation.y", "rotation.y", "quat_y", "quaternion.y", "j"]);
const QZ: Column =
    plain(&["qz", "q_z", "orientation.z", "rotation.z", "quat_z", "quaternion.z", "k"]);
const QW: Column =
    plain(&["qw", "q_w", "orientation.w", "rotation.w", "quat_w", "quaternion.w", "w"]);

const ROTATION_VECTOR: &[Column] = &[
    X,
    Y,
    Z,
    angle(&["rx", "r_x", "tux", "rvec_x", "rot_x"]),
    angle(&["ry", "r_y", "tuy", "rvec_y", "rot_y"]),
    angle(&["rz", "r_z", "tuz", "rvec_z", "rot_z"]),
];

const EULER: &[Column] = &[X, Y, Z, angle(&["a"]), angle(&["b"]), angle(&["c"])];

/// Name, columns and rotation, in the order in which they are listed.
const GENERIC: [(&str, &[Column], Rotation); 4] = [
    // row by row
    ("matrix4x4", MATRIX, Rotation::Matrix),
    ("quaternion-xyzw", &[X, Y, Z, QX, QY, QZ, QW], Rotation::QuaternionXyzw),
    ("quaternion-wxyz", &[X, Y, Z, QW, QX, QY, QZ], Rotation::QuaternionWxyz),
    // axis times angle (rad)
    ("rotation-vector", ROTATION_VECTOR, Rotation::Vector),
];

/// Their names.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    GENERIC.into_iter().map(|(name, ..)| name)
}

/// The notation of that name.
pub(super) fn named(name: &str) -> Option<Notation> {
    let (name, columns, rotation) = GENERIC.into_iter().find(|row| row.0 == name)?;
    Some(notation(name, columns, rotation))
}

fn notation(name: &str, columns: &'static [Column], rotation: Rotation) -> Notation {
    let angle_unit = AngleUnit::Radian;
    Notation { name: name.into(), columns, length_unit: None, angle_unit, rotation }
}

/// `x y z` and three angles, of a name like `euler-zyx-intrinsic`; degrees unless said otherwise.
pub(super) fn euler(name: &str) -> Option<Notation> {
    let (axes, sense) = name.strip_prefix("euler-")?.split_once('-')?;
    let sense = match sense {
        "intrinsic" => Sense::Intrinsic,
        "extrinsic" => Sense::Extrinsic,
        _ => return None,
    };
    let axes: Vec<usize> = axes.chars().map(|c| "xyz".find(c)).collect::<Option<_>>()?;
    let axes: [usize; 3] = axes.try_into().ok()?;
    if axes[0] == axes[1] || axes[1] == axes[2] {
        return None;
    }
    let angle_unit = AngleUnit::Degree;
    Some(Notation { angle_unit, ..notation(name, EULER, Rotation::Euler(axes, sense)) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;
    use std::f64::consts::{FRAC_PI_2, PI};

    const R_Z: [f64; 9] = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    const R_X: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0];
    const TURN_Y: [f64; 9] = [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0];
    const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

    #[test]
    fn matrices_are_read_row_by_row() {
        let z = [0.0, -1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0];
        let x = [1.0, 0.0, 0.0, 0.1, 0.0, 0.0, -1.0, 0.2, 0.0, 1.0, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0];
        let y = [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        reads(
            &named("matrix4x4").unwrap(),
            &[(&z, [1.0, 2.0, 3.0], R_Z), (&x, [0.1, 0.2, 0.3], R_X), (&y, [0.0; 3], TURN_Y)],
        );
    }

    #[test]
    fn quaternions_are_read_in_both_orders() {
        reads(
            &named("quaternion-xyzw").unwrap(),
            &[
                (&[1.0, 2.0, 3.0, 0.0, 0.0, HALF, HALF], [1.0, 2.0, 3.0], R_Z),
                (&[0.0, 0.0, 0.0, HALF, 0.0, 0.0, HALF], [0.0; 3], R_X),
                (&[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [0.0; 3], TURN_Y),
            ],
        );
        reads(
            &named("quaternion-wxyz").unwrap(),
            &[
                (&[1.0, 2.0, 3.0, HALF, 0.0, 0.0, HALF], [1.0, 2.0, 3.0], R_Z),
                (&[0.0, 0.0, 0.0, HALF, HALF, 0.0, 0.0], [0.0; 3], R_X),
                (&[0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0], [0.0; 3], TURN_Y),
            ],
        );
    }

    #[test]
    fn rotation_vectors_are_axis_times_angle() {
        reads(
            &named("rotation-vector").unwrap(),
            &[
                (&[1.0, 2.0, 3.0, 0.0, 0.0, FRAC_PI_2], [1.0, 2.0, 3.0], R_Z),
                (&[0.0, 0.0, 0.0, FRAC_PI_2, 0.0, 0.0], [0.0; 3], R_X),
                (&[0.0, 0.0, 0.0, 0.0, -PI, 0.0], [0.0; 3], TURN_Y),
            ],
        );
    }
}
