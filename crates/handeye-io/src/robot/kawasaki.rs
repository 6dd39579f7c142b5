//! Kawasaki: `X Y Z O A T` in mm and degrees, `R = Rz(O) Ry(A) Rz(T)`.

use super::{Column, Notation, Rotation, Sense, X, Y, Z, angle};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] = &[X, Y, Z, angle(&["O"]), angle(&["A"]), angle(&["T"])];

/// The maker's notation.
pub(super) fn notation() -> Notation {
    Notation {
        name: "kawasaki".into(),
        columns: COLUMNS,
        length_unit: Some(LengthUnit::Millimetre),
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::Euler([2, 1, 2], Sense::Intrinsic),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    #[test]
    fn o_turns_about_z_and_a_about_the_moved_y() {
        reads(
            &notation(),
            &[
                (
                    &[100.0, -200.0, 300.0, 90.0, 90.0, 0.0],
                    [0.1, -0.2, 0.3],
                    [0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 0.0, 0.0, 90.0, 90.0],
                    [0.0; 3],
                    [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
                ),
                (
                    &[0.0, 0.0, 1.0, 0.0, 180.0, 0.0],
                    [0.0, 0.0, 0.001],
                    [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0],
                ),
            ],
        );
    }
}
