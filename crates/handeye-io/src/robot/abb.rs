//! ABB: `x y z` in mm and the quaternion `q1 q2 q3 q4`, its scalar `q1` first.

use super::{Column, Notation, Rotation, X, Y, Z, plain};
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

/// The maker's notation.
pub(super) fn notation() -> Notation {
    Notation {
        name: "abb".into(),
        columns: COLUMNS,
        length_unit: Some(LengthUnit::Millimetre),
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::QuaternionWxyz,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    #[test]
    fn q1_is_the_scalar() {
        reads(
            &notation(),
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
