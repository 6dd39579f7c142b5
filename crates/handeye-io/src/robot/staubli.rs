//! Stäubli: `x y z rx ry rz` in mm and degrees, `R = Rx(rx) Ry(ry) Rz(rz)`.

use super::{Column, Notation, Rotation, Sense, X, Y, Z, angle};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] =
    &[X, Y, Z, angle(&["rx", "r_x"]), angle(&["ry", "r_y"]), angle(&["rz", "r_z"])];

/// The maker's notation.
pub(super) fn notation() -> Notation {
    Notation {
        name: "staubli".into(),
        columns: COLUMNS,
        length_unit: Some(LengthUnit::Millimetre),
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::Euler([0, 1, 2], Sense::Intrinsic),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    #[test]
    fn later_turns_are_about_the_moved_axes() {
        reads(
            &notation(),
            &[
                (
                    &[100.0, -200.0, 300.0, 90.0, 0.0, 90.0],
                    [0.1, -0.2, 0.3],
                    [0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0],
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
