//! The makers who write a position in mm and three angles in degrees: one line each says which
//! angles, about which axes, and whether later turns are about the moved axes.

use super::{
    Axes, Column, Notation, Rotation, Sense,
    Sense::{Extrinsic, Intrinsic},
    X, Y, Z, angle,
};
use crate::units::{AngleUnit, LengthUnit};

const X_Y_Z_TURNS: [Column; 6] =
    [X, Y, Z, angle(&["rx", "r_x"]), angle(&["ry", "r_y"]), angle(&["rz", "r_z"])];

/// Name, columns, axes in the order of the numbers.
type Maker = (&'static str, &'static [Column], Axes, Sense);

const MAKERS: [Maker; 7] = [
    // R = Rz(A) Ry(B) Rx(C)
    ("kuka", &[X, Y, Z, angle(&["A"]), angle(&["B"]), angle(&["C"])], [2, 1, 0], Intrinsic),
    // R = Rz(R) Ry(P) Rx(W)
    ("fanuc", &[X, Y, Z, angle(&["W"]), angle(&["P"]), angle(&["R"])], [0, 1, 2], Extrinsic),
    // R = Rz(Rz) Ry(Ry) Rx(Rx)
    ("yaskawa", &X_Y_Z_TURNS, [0, 1, 2], Extrinsic),
    // R = Rz(O) Ry(A) Rz(T)
    ("kawasaki", &[X, Y, Z, angle(&["O"]), angle(&["A"]), angle(&["T"])], [2, 1, 2], Intrinsic),
    // R = Rx(rx) Ry(ry) Rz(rz)
    ("staubli", &X_Y_Z_TURNS, [0, 1, 2], Intrinsic),
    // R = Rz(A) Ry(B) Rz(C)
    (
        "doosan",
        &[X, Y, Z, angle(&["A", "rx"]), angle(&["B", "ry"]), angle(&["C", "rz"])],
        [2, 1, 2],
        Intrinsic,
    ),
    // R = Rz(RZ) Ry(RY) Rx(RX)
    ("denso", &X_Y_Z_TURNS, [0, 1, 2], Extrinsic),
];

/// The makers who write a rotation so.
pub(super) fn of(rotation: Rotation) -> Vec<&'static str> {
    let same = |m: &&Maker| rotation == Rotation::Euler(m.2, m.3);
    MAKERS.iter().filter(same).map(|m| m.0).collect()
}

/// The notation of one of these makers.
pub(super) fn notation(name: &str) -> Option<Notation> {
    let (name, columns, axes, sense) = *MAKERS.iter().find(|m| m.0 == name)?;
    Some(Notation {
        name: name.into(),
        columns,
        length_unit: Some(LengthUnit::Millimetre),
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::Euler(axes, sense),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    /// Reads each triple of angles, behind a position, as the matrix beside it.
    fn turns(name: &str, cases: [([f64; 3], [f64; 9]); 3]) {
        for (angles, matrix) in cases {
            let values = [&[100.0, -200.0, 300.0][..], &angles].concat();
            reads(&notation(name).unwrap(), &[(&values, [0.1, -0.2, 0.3], matrix)]);
        }
    }

    /// A quarter turn about y, whatever the maker calls it.
    const ABOUT_Y: [f64; 9] = [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0];
    /// Half a turn about x.
    const HALF_X: [f64; 9] = [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0];
    /// Half a turn about y.
    const HALF_Y: [f64; 9] = [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0];
    /// A quarter turn about x, then one about the fixed z.
    const FIXED_X_THEN_Z: [f64; 9] = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    /// A quarter turn about x, then one about the moved z.
    const MOVED_X_THEN_Z: [f64; 9] = [0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0];
    /// A quarter turn about z, then one about the moved y.
    const MOVED_Z_THEN_Y: [f64; 9] = [0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0];
    /// A quarter turn about y, then one about the moved z.
    const MOVED_Y_THEN_Z: [f64; 9] = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

    #[test]
    fn a_of_kuka_turns_about_z_first() {
        turns(
            "kuka",
            [
                ([90.0, 0.0, 90.0], FIXED_X_THEN_Z),
                ([0.0, 90.0, 0.0], ABOUT_Y),
                ([0.0, 0.0, 180.0], HALF_X),
            ],
        );
    }

    #[test]
    fn fanuc_yaskawa_and_denso_turn_first_about_the_fixed_x() {
        for name in ["fanuc", "yaskawa", "denso"] {
            turns(
                name,
                [
                    ([90.0, 0.0, 90.0], FIXED_X_THEN_Z),
                    ([0.0, 90.0, 0.0], ABOUT_Y),
                    ([180.0, 0.0, 0.0], HALF_X),
                ],
            );
        }
    }

    #[test]
    fn later_turns_of_staubli_are_about_the_moved_axes() {
        turns(
            "staubli",
            [
                ([90.0, 0.0, 90.0], MOVED_X_THEN_Z),
                ([0.0, 90.0, 0.0], ABOUT_Y),
                ([180.0, 0.0, 0.0], HALF_X),
            ],
        );
    }

    #[test]
    fn kawasaki_and_doosan_turn_about_z_the_moved_y_and_z_again() {
        for name in ["kawasaki", "doosan"] {
            turns(
                name,
                [
                    ([90.0, 90.0, 0.0], MOVED_Z_THEN_Y),
                    ([0.0, 90.0, 90.0], MOVED_Y_THEN_Z),
                    ([0.0, 180.0, 0.0], HALF_Y),
                ],
            );
        }
    }
}
