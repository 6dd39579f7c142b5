//! ABB: `x y z` in mm and the quaternion `q1 q2 q3 q4`, its scalar `q1` first.

use super::{Column, Rotation, X, Y, Z, makers::Maker, plain};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] = &[
    X,
    Y,
    Z,
    plain(&["q1", "qw"]),
    plain(&["q2", "qx"]),
    plain(&["q3", "qy"]),
    plain(&["q4", "qz"]),
];

/// As its controllers write it.
pub(super) const POSE: Maker = Maker {
    name: "abb",
    columns: COLUMNS,
    length_unit: LengthUnit::Millimetre,
    angle_unit: AngleUnit::Degree,
    rotation: Rotation::QuaternionWxyz,
    reported: true,
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    #[test]
    fn q1_is_the_scalar() {
        reads(
            &POSE.into(),
            &[
                (
                    &[100.0, -200.0, 300.0, 0.5, 0.5, 0.5, 0.5],
                    [0.1, -0.2, 0.3],
                    [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.0, 0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt(), 0.0],
                    [0.0; 3],
                    [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0],
                    [0.0, 0.0, 0.001],
                    [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0],
                ),
            ],
        );
    }
}
