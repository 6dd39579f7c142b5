//! Records of `.npy` and `.npz` arrays: the first axis counts the records. An array no longer than
//! one pose (a vector, or a 3x4 or 4x4 matrix) is one record.

use std::path::Path;

use super::{Cell, Layout, Record};
use crate::{
    error::{Error, Place, malformed},
    files,
    npy::{Archive, Array},
};

/// Most numbers in an array of records.
const MOST_NUMBERS: usize = 10_000_000;

pub(super) fn records(path: &Path, layout: &Layout) -> Result<Vec<Record>, Error> {
    let (place, array) = if files::extension(path) == "npy" {
        (Place::file(path), Array::read(path)?)
    } else {
        named(path, layout)?
    };
    if array.len() == 0 || array.len() > MOST_NUMBERS {
        let what = format!("an array of shape {:?} is no list of records", array.shape);
        return Err(malformed(place, what, "name the array of poses"));
    }
    let whole =
        array.shape.len() < 2 || (array.shape.len() == 2 && matches!(array.shape[..], [3 | 4, 4]));
    let count = if whole { 1 } else { array.shape[0] };
    let values = array.values();
    let record = |(i, row): (usize, &[f64])| Record {
        cells: row.iter().copied().map(Cell::Number).collect(),
        names: vec![],
        by_header: false,
        id: None,
        place: if whole { place.clone() } else { row_place(&place, i) },
    };
    Ok(values.chunks(values.len() / count).enumerate().map(record).collect())
}

fn row_place(place: &Place, row: usize) -> Place {
    let key = place.field.as_deref().map(|k| format!("{k}.")).unwrap_or_default();
    Place { field: Some(format!("{key}{row}")), ..place.clone() }
}

fn named(path: &Path, layout: &Layout) -> Result<(Place, Array), Error> {
    let archive = Archive::read(path)?;
    let names: Vec<&str> = archive.names().collect();
    let name = match (layout.fields.first(), &names[..]) {
        (Some(field), _) => field.as_str(),
        (None, [only]) => only,
        _ => return Err(which(path, &names)),
    };
    let array = archive.array(name).unwrap_or_else(|| Err(which(path, &names)))?;
    Ok((Place::field(path, name), array))
}

fn which(path: &Path, names: &[&str]) -> Error {
    malformed(
        Place::file(path),
        "field must name one of its arrays",
        format!("it holds {}", names.join(", ")),
    )
}
