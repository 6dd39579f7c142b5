//! Plain text: matrices, and the notations of robots as their programs write them.

use nalgebra::Isometry3;

use super::{CameraPose, DEGREES, METRES, MILLIMETRES, TURNS, matrix_row, number, row_major};
use crate::{
    robot::{Column, Notation, Quantity},
    units::{AngleUnit, LengthUnit},
};

/// Four lines of four numbers.
pub(super) fn matrix(pose: &CameraPose) -> String {
    let rows = row_major(&pose.parent_from_child);
    rows.chunks(4).map(|row| matrix_row(row, METRES, " ") + "\n").collect()
}

/// A name for a comment.
fn on_one_line(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// A pose as a robot's programs write it, in the maker's units.
pub(crate) fn pose(pose: &Isometry3<f64>, notation: &Notation) -> String {
    let units = notation.own_units();
    let values = notation.values(pose, units);
    let lengths = if units.length == LengthUnit::Metre { METRES } else { MILLIMETRES };
    let turns = if units.angle == AngleUnit::Degree { DEGREES } else { TURNS };
    let written = |(column, value): (&Column, f64)| match column.quantity {
        Quantity::Length => number(value, lengths),
        Quantity::Angle => number(value, turns),
        Quantity::Plain => number(value, TURNS),
    };
    let values: Vec<String> = notation.columns.iter().zip(values).map(written).collect();
    line(notation, &names(notation), &values)
}

fn names(notation: &Notation) -> Vec<&'static str> {
    notation.columns.iter().map(|c| c.names[0]).collect()
}

/// One line in a robot's notation, below a comment that says what it is.
pub(super) fn robot(camera: &CameraPose, notation: &Notation) -> String {
    let length = notation.own_units().length;
    format!(
        "# {} ({} from {}), {}: {} in {}{}\n{}\n",
        camera.name,
        on_one_line(camera.parent),
        on_one_line(camera.child),
        notation.name,
        names(notation).join(" "),
        length.name(),
        angles(notation),
        pose(&camera.parent_from_child, notation),
    )
}

fn angles(notation: &Notation) -> &'static str {
    match notation.columns.iter().any(|c| c.quantity == Quantity::Angle) {
        false => "",
        true if notation.angle_unit == AngleUnit::Degree => " and deg",
        true => " and rad",
    }
}

/// As the maker's programs write it.
fn line(notation: &Notation, names: &[&str], values: &[String]) -> String {
    match notation.name.as_str() {
        "ur" => format!("p[{}]", values.join(", ")),
        "abb" => format!("[[{}], [{}]]", values[..3].join(", "), values[3..].join(", ")),
        "kuka" => {
            let named: Vec<String> =
                names.iter().zip(values).map(|(n, v)| format!("{n} {v}")).collect();
            format!("{{{}}}", named.join(", "))
        }
        _ => values.join(" "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        export::{Format, render, tests::example},
        robot,
        table::{self, Layout},
    };

    #[test]
    fn what_is_written_for_a_robot_is_read_back_as_the_same_pose() {
        let folder = std::env::temp_dir().join(format!("handeye-export-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for name in robot::names() {
            let notation = Notation::named(name).unwrap();
            let path = folder.join(format!("{name}.txt"));
            std::fs::write(&path, render(&example(), &Format::named(name).unwrap())).unwrap();
            let layout = Layout { matrices: name == "matrix4x4", ..Layout::default() };
            let records = table::records(&path, &layout).unwrap();
            let values = notation.numbers(&records[0]).unwrap();
            let again = notation.pose(&values, notation.own_units()).unwrap();
            let apart = again.inverse() * example().parent_from_child;
            assert!(
                apart.translation.vector.norm() < 1e-12 && apart.rotation.angle() < 1e-7,
                "{name}"
            );
        }
        std::fs::remove_dir_all(folder).unwrap();
    }
}
