//! How makers write a pose: a row for each notation. Most write a position in mm and three angles in degrees, and differ
//! in which angles, about which axes, and whether later turns are about the moved axes.

use super::{
    Axes, Column, Notation, Rotation, Sense,
    Sense::{Extrinsic, Intrinsic},
    X, Y, Z, abb, angle, universal_robots,
};
use crate::units::{AngleUnit, LengthUnit};

/// A maker's notation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Maker {
    pub(super) name: &'static str,
    pub(super) columns: &'static [Column],
    pub(super) length_unit: LengthUnit,
    pub(super) angle_unit: AngleUnit,
    pub(super) rotation: Rotation,
    /// Whether controllers report poses so, not pendants alone.
    pub(super) reported: bool,
}

const X_Y_Z_TURNS: [Column; 6] =
    [X, Y, Z, angle(&["rx", "r_x"]), angle(&["ry", "r_y"]), angle(&["rz", "r_z"])];

/// In the order in which they are listed.
const MAKERS: [Maker; 10] = [
    universal_robots::POSE,
    universal_robots::RPY,
    // R = Rz(A) Ry(B) Rx(C)
    angles("kuka", &[X, Y, Z, angle(&["A"]), angle(&["B"]), angle(&["C"])], [2, 1, 0], Intrinsic),
    // R = Rz(R) Ry(P) Rx(W)
    angles("fanuc", &[X, Y, Z, angle(&["W"]), angle(&["P"]), angle(&["R"])], [0, 1, 2], Extrinsic),
    abb::POSE,
    // R = Rz(Rz) Ry(Ry) Rx(Rx)
    angles("yaskawa", &X_Y_Z_TURNS, [0, 1, 2], Extrinsic),
    // R = Rz(O) Ry(A) Rz(T)
    angles(
        "kawasaki",
        &[X, Y, Z, angle(&["O"]), angle(&["A"]), angle(&["T"])],
        [2, 1, 2],
        Intrinsic,
    ),
    // R = Rx(rx) Ry(ry) Rz(rz)
    angles("staubli", &X_Y_Z_TURNS, [0, 1, 2], Intrinsic),
    // R = Rz(A) Ry(B) Rz(C)
    angles(
        "doosan",
        &[X, Y, Z, angle(&["A", "rx"]), angle(&["B", "ry"]), angle(&["C", "rz"])],
        [2, 1, 2],
        Intrinsic,
    ),
    // R = Rz(RZ) Ry(RY) Rx(RX)
    angles("denso", &X_Y_Z_TURNS, [0, 1, 2], Extrinsic),
];

/// A position in mm and three angles in degrees, about the axes in the order of the numbers.
const fn angles(name: &'static str, columns: &'static [Column], axes: Axes, sense: Sense) -> Maker {
    Maker {
        name,
        columns,
        length_unit: LengthUnit::Millimetre,
        angle_unit: AngleUnit::Degree,
        rotation: Rotation::Euler(axes, sense),
        reported: true,
    }
}

/// Names of all makers' notations.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    MAKERS.into_iter().map(|m| m.name)
}

/// Those in which controllers report poses.
pub(super) fn reported() -> impl Iterator<Item = &'static str> {
    MAKERS.into_iter().filter(|m| m.reported).map(|m| m.name)
}

/// Those of three angles in degrees.
pub(super) fn in_degrees() -> impl Iterator<Item = &'static str> {
    let turns = |m: &Maker| matches!(m.rotation, Rotation::Euler(..));
    MAKERS
        .into_iter()
        .filter(move |m| turns(m) && m.angle_unit == AngleUnit::Degree)
        .map(|m| m.name)
}

/// The makers whose controllers write a rotation so; quaternions are not called by a maker.
pub(super) fn of(rotation: Rotation) -> Vec<&'static str> {
    if matches!(rotation, Rotation::QuaternionXyzw | Rotation::QuaternionWxyz) {
        return vec![];
    }
    MAKERS.iter().filter(|m| m.reported && m.rotation == rotation).map(|m| m.name).collect()
}

/// The notation of that name.
pub(super) fn named(name: &str) -> Option<Notation> {
    MAKERS.into_iter().find(|m| m.name == name).map(Notation::from)
}

impl From<Maker> for Notation {
    fn from(maker: Maker) -> Self {
        Self {
            name: maker.name.into(),
            columns: maker.columns,
            length_unit: Some(maker.length_unit),
            angle_unit: maker.angle_unit,
            rotation: maker.rotation,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::tests::reads;

    /// Reads each triple of angles, behind a position, as the matrix beside it.
    fn turns(name: &str, cases: [([f64; 3], [f64; 9]); 3]) {
        for (angles, matrix) in cases {
            let values = [&[100.0, -200.0, 300.0][..], &angles].concat();
            reads(&named(name).unwrap(), &[(&values, [0.1, -0.2, 0.3], matrix)]);
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
