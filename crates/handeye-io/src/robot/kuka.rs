//! KUKA: `X Y Z A B C` in mm and degrees, `R = Rz(A) Ry(B) Rx(C)`.

use super::{Column, Notation, Rotation, Sense, X, Y, Z, angle};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] = &[X, Y, Z, angle(&["A"]), angle(&["B"]), angle(&["C"])];

/// The maker's notation.
pub(super) fn notation() -> Notation {
    Notation {
        name: "kuka".into(),
        columns: COLUMNS,
        length_unit: Some(LengthUnit::Millimetre),
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::Euler([2, 1, 0], Sense::Intrinsic),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    #[test]
    fn a_turns_about_z_first() {
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
                    &[0.0, 0.0, 1.0, 0.0, 0.0, 180.0],
                    [0.0, 0.0, 0.001],
                    [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0],
                ),
            ],
        );
    }
}
