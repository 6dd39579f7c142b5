//! Rows of numbers as robots write them, as poses and back.

use handeye::{Base, Flange, Pose};
use handeye_io::{
    robot::{Notation, Units},
    units::{AngleUnit, LengthUnit},
};
use nalgebra::Isometry3;
use numpy::PyArray2;
use pyo3::prelude::*;
use serde::de::DeserializeOwned;

use crate::{arrays, errors};

/// A notation, and the units of its numbers.
fn notation(
    name: &str,
    length_unit: Option<&str>,
    angle_unit: Option<&str>,
) -> PyResult<(Notation, Units)> {
    let notation = Notation::named(name)
        .map_err(|known| errors::input(format!("the notation {name:?} is not known: {known}")))?;
    let length: Option<LengthUnit> = unit("length_unit", length_unit)?;
    let length = length.or(notation.length_unit).ok_or_else(|| {
        let what = "is written in metres and in millimetres: give length_unit=\"m\" or \"mm\"";
        errors::input(format!("{name} {what}"))
    })?;
    let angle: Option<AngleUnit> = unit("angle_unit", angle_unit)?;
    Ok((notation.clone(), Units { length, angle: angle.unwrap_or(notation.angle_unit) }))
}

/// A unit by its sign.
fn unit<T: DeserializeOwned>(key: &str, sign: Option<&str>) -> PyResult<Option<T>> {
    let read = |sign: &str| {
        serde_json::from_value(sign.into())
            .map_err(|error| errors::input(format!("{key}: {error}")))
    };
    sign.map(read).transpose()
}

/// Rows of a notation's numbers as matrices, 4 x 4, row by row.
#[pyfunction]
#[pyo3(signature = (rows, name, *, length_unit=None, angle_unit=None, inverse=false))]
pub fn poses_from(
    rows: Vec<Vec<f64>>,
    name: &str,
    length_unit: Option<&str>,
    angle_unit: Option<&str>,
    inverse: bool,
) -> PyResult<Vec<Vec<f64>>> {
    let (notation, units) = notation(name, length_unit, angle_unit)?;
    let names: Vec<&str> = notation.columns.iter().map(|column| column.names[0]).collect();
    let one = |(k, row): (usize, &Vec<f64>)| {
        if row.len() != names.len() {
            let (count, needed) = (row.len(), names.len());
            let what =
                format!("row {k} has {count} numbers: {name} has {needed} ({})", names.join(", "));
            return Err(errors::input(what));
        }
        if row.iter().any(|x| !x.is_finite()) {
            return Err(errors::input(format!("row {k} holds a number that is NaN or infinite")));
        }
        let iso =
            notation.pose(row, units).map_err(|what| errors::input(format!("row {k}: {what}")))?;
        let pose = Pose::<Base, Flange>::claim(if inverse { iso.inverse() } else { iso });
        if pose.is_too_far() {
            let what = format!("row {k} lies beyond any robot: check length_unit");
            return Err(errors::input(what));
        }
        Ok(pose.matrix().transpose().as_slice().to_vec())
    };
    rows.iter().enumerate().map(one).collect()
}

/// Matrices as rows of a notation's numbers.
#[pyfunction]
#[pyo3(signature = (matrices, name, *, length_unit=None, angle_unit=None))]
pub fn poses_to<'py>(
    py: Python<'py>,
    matrices: &Bound<'py, PyAny>,
    name: &str,
    length_unit: Option<&str>,
    angle_unit: Option<&str>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (notation, units) = notation(name, length_unit, angle_unit)?;
    let one = |(r, t): &(_, _)| {
        let iso: Isometry3<f64> = *Pose::<Base, Flange>::from_parts(r, *t).iso();
        notation.values(&iso, units)
    };
    let rows: Vec<Vec<f64>> = arrays::poses(matrices, "poses")?.iter().map(one).collect();
    if rows.is_empty() {
        return Ok(PyArray2::zeros(py, [0, notation.columns.len()], false));
    }
    arrays::rows(py, &rows)
}
