//! Denso: `X Y Z RX RY RZ` in mm and degrees, `R = Rz(RZ) Ry(RY) Rx(RX)`.

use super::{Column, Notation, Rotation, Sense, X, Y, Z, angle};
use crate::units::{AngleUnit, LengthUnit};

const COLUMNS: &[Column] =
    &[X, Y, Z, angle(&["rx", "r_x"]), angle(&["ry", "r_y"]), angle(&["rz", "r_z"])];

/// The maker's notation.
pub(super) fn notation() -> Notation {
    Notation {
        name: "denso".into(),
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
    fn rx_turns_first_about_the_fixed_x() {
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
