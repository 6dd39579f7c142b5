//! Values that look like another unit than the declared one.

use std::f64::consts::TAU;

use handeye::Warning;

use super::{Notation, Quantity, Rotation, Units};
use crate::{
    error::Place,
    units::{AngleUnit, LengthUnit},
};

/// No robot reaches further, m.
const FAR: f64 = 10.0;
/// A cell in which no flange comes farther from the base than this is no cell, m.
const NEAR: f64 = 0.01;
/// Angles in degrees that all stay below this are probably radians.
const FEW_DEGREES: f64 = 3.2;

/// Warnings about a list of poses, written as the file has them.
pub(crate) fn suspicious_values(
    values: &[Vec<f64>],
    notation: &Notation,
    units: Units,
    place: &Place,
) -> Vec<Warning> {
    let largest = |quantity: Quantity| {
        let of_quantity = move |row: &Vec<f64>| {
            let columns = notation.columns.iter().zip(row.clone());
            columns
                .filter(move |(c, _)| c.quantity == quantity)
                .map(|(_, v)| v.abs())
                .collect::<Vec<_>>()
        };
        values.iter().flat_map(of_quantity).fold(0.0, f64::max)
    };
    let lengths = length_warning(units.length, largest(Quantity::Length), values.len(), place);
    let angles =
        angle_warning(notation, units.angle, largest(Quantity::Angle), values.len(), place);
    lengths.into_iter().chain(angles).collect()
}

fn length_warning(unit: LengthUnit, largest: f64, count: usize, place: &Place) -> Option<Warning> {
    let metres = unit.to_metres(largest);
    let said = unit.name();
    if metres > FAR {
        let question = match unit {
            LengthUnit::Millimetre => "is that number right?".to_owned(),
            _ => format!("is length_unit really \"{said}\", or is it \"mm\"?"),
        };
        return Some(Warning::new(
            "length-unit-suspicious",
            format!(
                "{place}: a position of {largest:.1} {said} is {metres:.0} m from the origin; {question}"
            ),
        ));
    }
    (count > 2 && metres < NEAR && unit != LengthUnit::Metre).then(|| {
        Warning::new(
            "length-unit-suspicious",
            format!(
                "{place}: all positions lie within {largest:.3} {said} of the origin; \
                 is length_unit really \"{said}\", or is it \"m\"?"
            ),
        )
    })
}

fn angle_warning(
    notation: &Notation,
    unit: AngleUnit,
    largest: f64,
    count: usize,
    place: &Place,
) -> Option<Warning> {
    let angles = matches!(notation.rotation, Rotation::Vector | Rotation::Euler(..));
    let (said, other) = match unit {
        AngleUnit::Radian if angles && largest > TAU + 0.01 => ("rad", "deg"),
        AngleUnit::Degree if angles && count > 2 && largest > 0.0 && largest < FEW_DEGREES => {
            ("deg", "rad")
        }
        _ => return None,
    };
    Some(Warning::new(
        "angle-unit-suspicious",
        format!(
            "{place}: the largest angle is {largest:.3} {said}; \
             is angle_unit really \"{said}\", or is it \"{other}\"?"
        ),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(name: &str, rows: &[Vec<f64>], length: LengthUnit) -> Vec<String> {
        let notation = Notation::named(name).unwrap();
        let units = Units { length, ..notation.own_units() };
        let found = suspicious_values(rows, &notation, units, &Place::default());
        found.into_iter().map(|w| w.code).collect()
    }

    #[test]
    fn millimetres_declared_as_metres_are_noticed() {
        let row = vec![350.0, 20.0, 400.0, 0.1, 0.2, 0.3];
        assert_eq!(codes("ur", &[row], LengthUnit::Metre), ["length-unit-suspicious"]);
    }

    #[test]
    fn degrees_in_a_rotation_vector_are_noticed() {
        let row = vec![0.35, 0.2, 0.4, 178.0, 2.0, 3.0];
        assert_eq!(codes("ur", &[row], LengthUnit::Metre), ["angle-unit-suspicious"]);
    }

    #[test]
    fn radians_declared_as_degrees_are_noticed() {
        let rows = vec![vec![350.0, 20.0, 400.0, 3.1, 0.2, -1.5]; 3];
        assert_eq!(codes("kuka", &rows, LengthUnit::Millimetre), ["angle-unit-suspicious"]);
    }

    #[test]
    fn usual_values_raise_no_suspicion() {
        let row = vec![350.0, 20.0, 400.0, 178.0, 2.0, 3.0];
        assert!(codes("kuka", &[row], LengthUnit::Millimetre).is_empty());
    }
}
