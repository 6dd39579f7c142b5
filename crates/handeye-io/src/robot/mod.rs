//! How robots write a pose. A notation is data: its columns, its units, and how its last numbers
//! make a rotation; `makers` and the files beside it say them. Reading and writing use the same data.

mod abb;
pub(crate) mod corrected;
mod dh;
mod euler;
mod generic;
mod makers;
mod rotation;
mod suspicion;
mod typed;
mod universal_robots;
mod urdf;
mod urdf_shapes;

use nalgebra::{Isometry3, Translation3};

use crate::{
    error::nearest,
    table::Record,
    units::{AngleUnit, LengthUnit},
};
pub use dh::arm_file;
pub(crate) use dh::{ArmModel, DhSpec};
pub use euler::{Axes, Sense};
pub use rotation::{Rotation, rotation_near};
pub(crate) use suspicion::suspicious_values;
pub use urdf::Urdf;
pub(crate) use urdf::{UrdfSpec, rigid};
pub(crate) use urdf_shapes::meshes;
pub use urdf_shapes::parts;

/// What a number of a notation measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// A number without unit.
    Plain,
}

/// One number of a notation: its usual names and what it measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// Usual names; the first is the maker's.
    pub names: &'static [&'static str],
    /// What it measures.
    pub quantity: Quantity,
}

/// How a robot writes a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Notation {
    /// Its name in a manifest.
    pub name: String,
    /// Its numbers in order.
    pub columns: &'static [Column],
    /// The maker's unit; `None` where the data must say it.
    pub length_unit: Option<LengthUnit>,
    /// The maker's unit.
    pub angle_unit: AngleUnit,
    /// How the rotation is written.
    pub rotation: Rotation,
}

const fn length(names: &'static [&'static str]) -> Column {
    Column { names, quantity: Quantity::Length }
}
const fn angle(names: &'static [&'static str]) -> Column {
    Column { names, quantity: Quantity::Angle }
}
const fn plain(names: &'static [&'static str]) -> Column {
    Column { names, quantity: Quantity::Plain }
}

const X: Column = length(&["x", "tx", "t_x", "px", "pos_x", "position.x", "translation.x", "p_x"]);
const Y: Column = length(&["y", "ty", "t_y", "py", "pos_y", "position.y", "translation.y", "p_y"]);
const Z: Column = length(&["z", "tz", "t_z", "pz", "pos_z", "position.z", "translation.z", "p_z"]);

/// Not a notation of poses: values of joints, of an arm that is known.
const JOINTS: &str = "joints";

/// Names of all notations that poses are written in, without the 24 Euler ones.
pub fn names() -> impl Iterator<Item = &'static str> {
    generic::names().chain(makers::names())
}

/// The same, the makers' first, and what else a manifest may say, to be shown to people.
#[cfg(test)]
pub(crate) fn names_in_words() -> String {
    let own = ["euler-<axes>-intrinsic", "euler-<axes>-extrinsic", JOINTS];
    let all: Vec<_> = makers::names().chain(generic::names()).chain(own).collect();
    all.join(", ")
}

/// Those in which controllers report poses, and the generic ones.
pub(crate) fn usual_names() -> String {
    makers::reported().chain(generic::names()).collect::<Vec<_>>().join(", ")
}

/// Makers' notations of three angles in degrees.
pub(crate) fn names_in_degrees() -> String {
    makers::in_degrees().collect::<Vec<_>>().join(", ")
}

/// Makers' notations all of whose numbers are called as in a record.
pub(crate) fn notations_called(record: &Record) -> Vec<&'static str> {
    let is_called = |name: &&str| {
        makers::named(name).is_some_and(|notation| notation.names_in(record).is_some())
    };
    makers::reported().filter(is_called).collect()
}

impl Notation {
    /// The notation of a name, such as `kuka` or `euler-zyx-intrinsic`, in capitals or not; `Err` says which there are.
    pub fn named(name: &str) -> Result<Notation, String> {
        let name = &name.to_ascii_lowercase();
        let found = generic::named(name).or_else(|| makers::named(name));
        found.or_else(|| generic::euler(name)).ok_or_else(|| unknown(name))
    }

    /// The makers whose robots write a rotation as this notation does.
    pub(crate) fn makers(&self) -> Vec<&'static str> {
        makers::of(self.rotation)
    }

    /// Values in the notation's order, in the given units, as a pose in metres and radians.
    pub fn pose(&self, values: &[f64], units: Units) -> Result<Isometry3<f64>, String> {
        let si: Vec<f64> =
            self.columns.iter().zip(values).map(|(c, v)| units.to_si(c, *v)).collect();
        if si.len() != values.len() || si.len() < self.columns.len() {
            return Err(format!("{} values are not a {} pose", values.len(), self.name));
        }
        if si.iter().any(|x| !x.is_finite()) {
            return Err(format!("a number of {values:?} is not finite"));
        }
        let (position, rotation) = self.rotation.split(&si);
        Ok(Isometry3::from_parts(Translation3::from(position), self.rotation.read(&rotation)?))
    }

    /// A pose in the notation's numbers, in order and in the given units.
    pub fn values(&self, pose: &Isometry3<f64>, units: Units) -> Vec<f64> {
        let si = self.rotation.join(&pose.translation.vector, &self.rotation.write(&pose.rotation));
        self.columns.iter().zip(si).map(|(c, v)| units.to_file(c, v)).collect()
    }

    /// The maker's units, metres where there are none.
    pub fn own_units(&self) -> Units {
        Units { length: self.length_unit.unwrap_or(LengthUnit::Metre), angle: self.angle_unit }
    }

    /// The numbers of a record, in the notation's order.
    pub(crate) fn numbers(&self, record: &Record) -> Result<Vec<f64>, crate::Error> {
        // a matrix without its last row
        if matches!(self.rotation, Rotation::Matrix) && record.cells.len() == 12 {
            let names: Vec<_> = self.columns[..12].iter().map(|c| c.names).collect();
            let mut numbers = record.numbers_in_any_language(&names, &self.name)?;
            numbers.extend([0.0, 0.0, 0.0, 1.0]);
            return Ok(numbers);
        }
        let names: Vec<_> = self.columns.iter().map(|c| c.names).collect();
        let found = record.numbers_in_any_language(&names, &self.name);
        let others = notations_called(record);
        match found {
            Err(_) if self.names_in(record).is_none() && !others.is_empty() => {
                let what = format!(
                    "the names {} are not those of {}, but those of {}",
                    record.names.join(", "),
                    self.name,
                    others.join(" and of ")
                );
                Err(record.refuse(
                    what,
                    "is the notation another one? Or say which columns = [..] are meant",
                ))
            }
            found => found,
        }
    }

    /// What a file calls these numbers, in the notation's order; `None` where it does not name them.
    pub(crate) fn names_in(&self, record: &Record) -> Option<Vec<String>> {
        let names: Vec<_> = self.columns.iter().map(|c| c.names).collect();
        record.names_of(&names)
    }
}

fn unknown(name: &str) -> String {
    let all: Vec<_> = names().chain([JOINTS]).collect();
    let near = nearest(name, all.iter().copied()).map(|n| format!("did you mean {n}? "));
    format!(
        "{}there are {}, and euler-<axes>-intrinsic or euler-<axes>-extrinsic",
        near.unwrap_or_default(),
        all.join(", ")
    )
}

/// The units of a pose's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units {
    /// Of its lengths.
    pub length: LengthUnit,
    /// Of its angles.
    pub angle: AngleUnit,
}

impl Units {
    /// A number in metres, radians or without unit.
    fn to_si(self, column: &Column, value: f64) -> f64 {
        match column.quantity {
            Quantity::Length => self.length.to_metres(value),
            Quantity::Angle => self.angle.to_radians(value),
            Quantity::Plain => value,
        }
    }

    fn to_file(self, column: &Column, value: f64) -> f64 {
        match column.quantity {
            Quantity::Length => value / self.length.metres(),
            Quantity::Angle => self.angle.from_radians(value),
            Quantity::Plain => value,
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use nalgebra::{Matrix3, UnitQuaternion, Vector3};
    use std::f64::consts::PI;

    /// A notation reads hand-computed lines as these positions (m) and rotation matrices.
    pub(crate) fn reads(notation: &Notation, cases: &[(&[f64], [f64; 3], [f64; 9])]) {
        for (values, position, matrix) in cases {
            let pose = notation.pose(values, notation.own_units()).unwrap();
            let rotation = pose.rotation.to_rotation_matrix().into_inner();
            let apart = (rotation - Matrix3::from_row_slice(matrix)).norm();
            assert!(apart < 1e-12, "{}: {values:?} gives {rotation}", notation.name);
            assert!((pose.translation.vector - Vector3::from(*position)).norm() < 1e-12);
        }
        round_trip(notation);
    }

    /// Poses, gimbal lock and half turns among them, survive writing and reading.
    pub(crate) fn round_trip(notation: &Notation) {
        let half = PI / 2.0;
        let axes = [
            [0.0, 0.0, 0.0],
            [0.3, -0.2, 0.9],
            [half, 0.0, 0.0],
            [0.0, half, 0.0],
            [0.0, -half, 0.0],
            [0.0, 0.0, half],
            [PI, 0.0, 0.0],
            [0.0, PI, 0.0],
            [0.0, 0.0, -PI],
            [-2.0, 1.0, 0.5],
            [1e-9, 0.0, -1e-9],
        ];
        for turn in axes {
            for also in axes {
                let (turn, also) = (
                    UnitQuaternion::new(Vector3::from(turn)),
                    UnitQuaternion::new(Vector3::from(also)),
                );
                let pose = Isometry3::from_parts(Translation3::new(0.1, -2.0, 0.3), turn * also);
                let units = notation.own_units();
                let again = notation.pose(&notation.values(&pose, units), units).unwrap();
                let apart = pose.rotation.angle_to(&again.rotation);
                assert!(apart < 5e-8, "{} {pose} {again} {apart}", notation.name);
                assert!((pose.translation.vector - again.translation.vector).norm() < 1e-14);
            }
        }
    }

    #[test]
    fn every_name_has_its_notation_and_survives_a_round_trip() {
        for name in names() {
            let notation = Notation::named(name).unwrap();
            assert_eq!(notation.name, name);
            round_trip(&notation);
        }
    }

    #[test]
    fn all_24_euler_notations_survive_a_round_trip() {
        for axes in
            ["xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"]
        {
            for sense in ["intrinsic", "extrinsic"] {
                round_trip(&Notation::named(&format!("euler-{axes}-{sense}")).unwrap());
            }
        }
    }

    #[test]
    fn a_misspelt_notation_is_corrected() {
        let message = Notation::named("kukka").unwrap_err();
        assert!(message.starts_with("did you mean kuka? there are matrix4x4,"), "{message}");
        assert!(Notation::named("euler-xxy-intrinsic").is_err());
    }
}
