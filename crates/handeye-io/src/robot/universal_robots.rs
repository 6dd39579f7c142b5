//! Universal Robots: `p[x, y, z, rx, ry, rz]` in metres and axis times angle (rad); and the
//! teach pendant's RPY, `R = Rz(rz) Ry(ry) Rx(rx)`, in metres and radians here.

use super::{Column, Rotation, Sense, X, Y, Z, angle, makers::Maker};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] = &[
    X,
    Y,
    Z,
    angle(&["rx", "r_x", "roll"]),
    angle(&["ry", "r_y", "pitch"]),
    angle(&["rz", "r_z", "yaw"]),
];

/// Position and rotation vector, as the controller reports them.
pub(super) const POSE: Maker = Maker {
    name: "ur",
    columns: COLUMNS,
    length_unit: LengthUnit::Metre,
    angle_unit: AngleUnit::Radian,
    rotation: Rotation::Vector,
    reported: true,
};

/// Position and roll, pitch, yaw about the fixed axes.
pub(super) const RPY: Maker = Maker {
    name: "ur-rpy",
    rotation: Rotation::Euler([0, 1, 2], Sense::Extrinsic),
    reported: false,
    ..POSE
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn the_last_three_numbers_are_a_rotation_vector() {
        let third = 2.0 * PI / 3.0 / 3.0_f64.sqrt(); // a third of a turn about (1, 1, 1)
        reads(
            &POSE.into(),
            &[
                (
                    &[0.1, -0.2, 0.3, third, third, third],
                    [0.1, -0.2, 0.3],
                    [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.0, 0.0, FRAC_PI_2, 0.0],
                    [0.0; 3],
                    [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.001, PI, 0.0, 0.0],
                    [0.0, 0.0, 0.001],
                    [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0],
                ),
            ],
        );
    }

    #[test]
    fn roll_turns_first_about_the_fixed_x() {
        reads(
            &RPY.into(),
            &[
                (
                    &[0.1, -0.2, 0.3, FRAC_PI_2, 0.0, FRAC_PI_2],
                    [0.1, -0.2, 0.3],
                    [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.0, 0.0, FRAC_PI_2, 0.0],
                    [0.0; 3],
                    [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.001, PI, 0.0, 0.0],
                    [0.0, 0.0, 0.001],
                    [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0],
                ),
            ],
        );
    }
}
