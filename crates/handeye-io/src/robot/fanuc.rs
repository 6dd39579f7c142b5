//! FANUC: `X Y Z W P R` in mm and degrees, `R = Rz(R) Ry(P) Rx(W)`.

use super::{Column, Notation, Rotation, Sense, X, Y, Z, angle};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] = &[X, Y, Z, angle(&["W"]), angle(&["P"]), angle(&["R"])];

/// The maker's notation.
pub(super) fn notation() -> Notation {
    Notation {
        name: "fanuc".into(),
        columns: COLUMNS,
        length_unit: Some(LengthUnit::Millimetre),
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::Euler([0, 1, 2], Sense::Extrinsic),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    #[test]
    fn w_turns_about_x_first() {
        reads(
            &notation(),
            &[
                (
                    &[100.0, -200.0, 300.0, 90.0, 0.0, 90.0],
                    [0.1, -0.2, 0.3],
                    [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.0, 0.0, 90.0, 0.0],
                    [0.0; 3],
                    [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 1.0, 180.0, 0.0, 0.0],
                    [0.0, 0.0, 0.001],
                    [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0],
                ),
            ],
        );
    }
}
