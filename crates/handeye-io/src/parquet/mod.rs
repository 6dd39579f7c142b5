//! Tables in Apache Parquet: columns of numbers and of texts, by their names. Lists and other nested columns are passed
//! over. Compressed with zstd, snappy or gzip, or not; plain or by a dictionary.
//!
//! <https://parquet.apache.org/docs/file-format/>

mod pages;
mod thrift;

use std::path::{Path, PathBuf};

use crate::{
    error::{Error, Place, malformed},
    files,
};
use pages::{Chunk, Column};
use thrift::Value;

/// An open table.
pub(crate) struct Parquet {
    path: PathBuf,
    bytes: Vec<u8>,
    groups: Vec<Group>,
}

/// Rows that are stored together.
struct Group {
    rows: usize,
    columns: Vec<(String, Chunk)>,
}

/// Why a table cannot be read.
type Broken = String;

const MAGIC: &[u8] = b"PAR1";
/// Most rows of a file: columns of them are held in memory.
const MOST_ROWS: usize = 2_000_000;
/// Largest description of a file's columns.
const LONGEST_FOOTER: usize = 64 << 20;

impl Parquet {
    /// Reads a file.
    pub(crate) fn read(path: &Path) -> Result<Self, Error> {
        let bytes = files::bytes(path)?;
        let groups = groups(&bytes).map_err(|what| refused(path, what))?;
        Ok(Self { path: path.into(), bytes, groups })
    }

    /// In how many groups its rows are stored.
    pub(crate) fn groups(&self) -> usize {
        self.groups.len()
    }

    /// A column of numbers in a group; what is missing is NaN.
    pub(crate) fn numbers(&self, group: usize, name: &str) -> Result<Vec<f64>, Error> {
        match self.column(group, name)? {
            Column::Numbers(numbers) => Ok(numbers),
            Column::Texts(_) => Err(self.refused(format!("the column {name} holds no numbers"))),
        }
    }

    /// A column of texts in a group; what is missing is empty.
    pub(crate) fn texts(&self, group: usize, name: &str) -> Result<Vec<String>, Error> {
        match self.column(group, name)? {
            Column::Texts(texts) => Ok(texts),
            Column::Numbers(_) => Err(self.refused(format!("the column {name} holds no text"))),
        }
    }

    fn column(&self, group: usize, name: &str) -> Result<Column, Error> {
        let group =
            self.groups.get(group).ok_or_else(|| self.refused(format!("has no group {group}")))?;
        let found = group.columns.iter().find(|(own, _)| own == name);
        let (_, chunk) = found.ok_or_else(|| self.refused(format!("has no column {name}")))?;
        let column = chunk.read(&self.bytes, group.rows);
        column.map_err(|what| self.refused(format!("the column {name}: {what}")))
    }

    fn refused(&self, what: String) -> Error {
        refused(&self.path, what)
    }
}

fn refused(path: &Path, what: String) -> Error {
    malformed(Place::file(path), what, "is it a Parquet file, and whole? write it again")
}

/// The groups that the end of a file describes.
fn groups(bytes: &[u8]) -> Result<Vec<Group>, Broken> {
    let whole = "does not begin and end as a Parquet file";
    let (body, magic) = bytes.split_last_chunk::<4>().ok_or(whole)?;
    let (body, length) = body.split_last_chunk::<4>().ok_or(whole)?;
    let length = u32::from_le_bytes(*length) as usize;
    if magic != MAGIC || !bytes.starts_with(MAGIC) || length > body.len() || length > LONGEST_FOOTER
    {
        return Err(whole.into());
    }
    let footer = Value::parse(&body[body.len() - length..])?;
    let flat = flat_columns(footer.list(2)?);
    let groups: Vec<Group> =
        footer.list(4)?.iter().map(|group| Group::of(group, &flat)).collect::<Result<_, _>>()?;
    match groups.iter().try_fold(0usize, |sum, group| sum.checked_add(group.rows)) {
        Some(rows) if rows <= MOST_ROWS => Ok(groups),
        _ => Err(format!("has more than {MOST_ROWS} rows")),
    }
}

/// Columns right below the root of the schema, and whether their values may be missing.
fn flat_columns(schema: &[Value]) -> Vec<(String, bool)> {
    let (mut flat, mut inside) = (vec![], 0);
    for element in schema.iter().skip(1) {
        let children = element.number(5).unwrap_or(0).max(0);
        if inside == 0 && children == 0 {
            let is_optional = element.number(3) == Ok(1);
            flat.extend(element.text(4).ok().map(|name| (name, is_optional)));
        }
        inside = (inside - i64::from(inside > 0)).saturating_add(children);
    }
    flat
}

impl Group {
    fn of(group: &Value, flat: &[(String, bool)]) -> Result<Self, Broken> {
        let rows = group.size(3)?;
        let mut columns = vec![];
        for chunk in group.list(1)? {
            let about = chunk.field(3)?;
            let [name] = about.list(3)? else { continue };
            let name = name.as_text()?;
            if let Some((_, is_optional)) = flat.iter().find(|(own, _)| *own == name) {
                columns.push((name, Chunk::of(about, *is_optional)?));
            }
        }
        Ok(Self { rows, columns })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_parquet_file_is_refused() {
        for bytes in [
            &b"PAR1"[..],
            b"",
            b"PAR1PAR1PAR1",
            b"PAR1\xff\xff\xff\xffPAR1",
            b"PAR1\x19\x01\0\0\0PAR1",
        ] {
            assert!(groups(bytes).is_err(), "{bytes:?}");
        }
    }
}
