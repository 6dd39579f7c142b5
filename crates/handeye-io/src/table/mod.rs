//! Records of numbers, whatever file they stand in: a line of a table, an element of a document,
//! a row of an array, a block of a matrix file. Each record knows where it came from.

mod array;
mod field;
pub(crate) mod halcon;
mod lines;
pub(crate) mod programs;

use std::path::{Path, PathBuf};

use crate::{
    error::{Error, Place, malformed},
    files,
};
use programs::Language;

/// One value of a record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    Text(String),
}

impl Cell {
    fn text(&self) -> String {
        match self {
            Cell::Number(x) => x.to_string(),
            Cell::Text(text) => text.clone(),
        }
    }

    fn number(&self) -> Option<f64> {
        match self {
            Cell::Number(x) => Some(*x),
            Cell::Text(text) if is_padded(text) => text.parse().ok(),
            Cell::Text(_) => None,
        }
    }
}

/// Whether text is a whole number with zeros before it: a name more often than a number, and kept as it is written.
pub(crate) fn is_padded(text: &str) -> bool {
    text.len() > 1 && text.starts_with('0') && text.bytes().all(|b| b.is_ascii_digit())
}

/// One record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Record {
    pub(crate) cells: Vec<Cell>,
    /// Name of every cell, where a header or keys say them; otherwise empty.
    pub(crate) names: Vec<String>,
    /// Whether the names are those of a header above the columns of a text: then their order is that of the columns.
    pub(crate) by_header: bool,
    /// What the file calls the record.
    pub(crate) id: Option<String>,
    pub(crate) place: Place,
}

/// Which of a file's records and values are meant.
#[derive(Debug, Clone, Default)]
pub(crate) struct Layout {
    /// Paths of the values in a structured document; their numbers are joined.
    pub(crate) fields: Vec<String>,
    /// First and last record, counted from 1.
    pub(crate) rows: Option<(usize, usize)>,
    /// The columns in the notation's order, by number from 1 or by name.
    pub(crate) columns: Vec<Column>,
    /// Lines before the table.
    pub(crate) skip_lines: usize,
    /// Records are 4x4 or 3x4 matrices, which may stretch over lines.
    pub(crate) matrices: bool,
}

/// A column, by number from 1 or by name.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(crate) enum Column {
    Number(#[cfg_attr(test, schemars(range(min = 1)))] usize),
    Name(String),
}

/// All records of one file.
pub(crate) fn records(path: &Path, layout: &Layout) -> Result<Vec<Record>, Error> {
    let records = match files::extension(path).as_str() {
        "json" | "yaml" | "yml" | "calib" | "samples" | "xml" => field::records(path, layout)?,
        "npy" | "npz" => array::records(path, layout)?,
        "dat" if let Some(text) = pose_of_halcon(path)? => vec![halcon::record(&text, path)?],
        _ => match program(path)? {
            Some((language, text)) => language.records(&text, path)?,
            None => lines::records(path, layout)?,
        },
    };
    let records = select_rows(records, layout, path)?;
    records.into_iter().map(|r| r.select_columns(&layout.columns)).collect()
}

/// The text of a file, where it is a pose that HALCON wrote.
fn pose_of_halcon(path: &Path) -> Result<Option<String>, Error> {
    files::table_text(path).map(|text| Some(text).filter(|text| halcon::is_pose(text)))
}

/// Names of files that hold programs of robots, or perhaps tables.
const PROGRAMS: [&str; 7] = ["dat", "src", "mod", "prg", "ls", "jbi", "txt"];

/// The language and the text of a robot's program.
pub(crate) fn program(path: &Path) -> Result<Option<(Language, String)>, Error> {
    if !PROGRAMS.contains(&files::extension(path).as_str()) {
        return Ok(None);
    }
    let text = files::table_text(path)?;
    Ok(Language::of(&text).map(|language| (language, text)))
}

/// The single record of each of several files, named after its file.
pub(crate) fn record_per_file(paths: &[PathBuf], layout: &Layout) -> Result<Vec<Record>, Error> {
    let names = distinct_names(paths);
    let named =
        |(path, id): (&PathBuf, String)| Ok(Record { id: Some(id), ..only_record(path, layout)? });
    let all: Vec<Record> = paths.iter().zip(names).map(named).collect::<Result<_, Error>>()?;
    let folder = paths.first().and_then(|p| p.parent()).unwrap_or(Path::new(""));
    select_rows(all, &Layout { rows: layout.rows, ..Layout::default() }, folder)
}

fn only_record(path: &Path, layout: &Layout) -> Result<Record, Error> {
    let whole = Layout { rows: None, columns: vec![], ..layout.clone() };
    let mut found = records(path, &whole)?;
    if found.len() > 1 && found.iter().all(|r| r.cells.len() < 6) {
        found = vec![joined(found)];
    }
    match (found.len(), found.pop()) {
        (1, Some(record)) => record.select_columns(&layout.columns),
        (count, _) => Err(malformed(
            Place::file(path),
            format!("holds {count} records, but a pattern of files means one in each"),
            "name this file alone, or give the field of the one record",
        )),
    }
}

/// One record out of lines that each hold a part of it.
fn joined(parts: Vec<Record>) -> Record {
    let place = parts.first().map(|r| r.place.clone()).unwrap_or_default();
    let named = parts.iter().all(|r| r.names.len() == r.cells.len());
    let names = if named { parts.iter().flat_map(|r| r.names.clone()).collect() } else { vec![] };
    let cells = parts.into_iter().flat_map(|r| r.cells).collect();
    Record { cells, names, by_header: false, id: None, place }
}

/// File names without extension, or their folders' names where all files are called the same.
pub(crate) fn distinct_names(paths: &[PathBuf]) -> Vec<String> {
    let stems: Vec<String> = paths.iter().map(|p| files::stem(p)).collect();
    let same = stems.len() > 1 && stems.iter().all(|s| *s == stems[0]);
    let folder = |p: &PathBuf| p.parent().map(files::stem).unwrap_or_default();
    if same { paths.iter().map(folder).collect() } else { stems }
}

fn select_rows(all: Vec<Record>, layout: &Layout, path: &Path) -> Result<Vec<Record>, Error> {
    let Some((first, last)) = layout.rows else { return Ok(all) };
    let count = all.len();
    if first == 0 || last < first || last > count {
        return Err(malformed(
            Place::file(path),
            format!("has {count} records, but rows = \"{first}..{last}\" are asked for"),
            "rows count from 1 and include both ends",
        ));
    }
    Ok(all.into_iter().skip(first - 1).take(last - first + 1).collect())
}

impl Record {
    fn select_columns(mut self, columns: &[Column]) -> Result<Record, Error> {
        if columns.is_empty() {
            return Ok(self);
        }
        let picked: Result<Vec<Cell>, Error> = columns.iter().map(|c| self.column(c)).collect();
        self.cells = picked?;
        self.names.clear();
        Ok(self)
    }

    fn column(&self, column: &Column) -> Result<Cell, Error> {
        let at = match column {
            Column::Number(n) => n.checked_sub(1),
            Column::Name(name) => self.names.iter().position(|n| n == name),
        };
        at.and_then(|i| self.cells.get(i)).cloned().ok_or_else(|| {
            let (what, count) = (format!("{column:?}"), self.cells.len());
            self.refuse(
                format!("has no column {what} (it has {count})"),
                "columns are counted from 1 or named as in the header",
            )
        })
    }

    /// An error at this record.
    pub(crate) fn refuse(&self, what: impl Into<String>, advice: impl Into<String>) -> Error {
        malformed(self.place.clone(), what, advice)
    }

    /// The cell that the header calls by one of these names.
    pub(crate) fn named(&self, names: &[&str]) -> Option<&Cell> {
        let wanted = |have: &String| names.iter().any(|n| plain(n) == plain(have));
        self.cells.get(self.names.iter().position(wanted)?)
    }

    /// The first cell, as a name.
    pub(crate) fn first_as_text(&self) -> Option<String> {
        self.cells.first().map(Cell::text)
    }

    /// The number under one of these names.
    pub(crate) fn number_named(&self, names: &[&str]) -> Option<f64> {
        self.named(names).and_then(Cell::number)
    }

    /// The text or whole number under one of these names.
    pub(crate) fn text_named(&self, names: &[&str]) -> Option<String> {
        self.named(names).map(Cell::text)
    }

    /// The values of `columns` (each with its usual names), by name where the file names them, otherwise in order. All are
    /// finite.
    pub(crate) fn numbers(&self, columns: &[&[&str]], what: &str) -> Result<Vec<f64>, Error> {
        let cells = if self.names.is_empty() {
            self.in_order(columns, what)?
        } else {
            self.by_name(columns, what)?
        };
        cells.into_iter().map(|cell| self.finite(cell)).collect()
    }

    /// The same of a table whose header calls all columns something else, in another language: in order, unless a name says
    /// another one.
    pub(crate) fn numbers_in_any_language(
        &self,
        columns: &[&[&str]],
        what: &str,
    ) -> Result<Vec<f64>, Error> {
        let is_known = |names: &&[&str]| self.named(names).is_some();
        let unnamed = Record { names: vec![], ..self.clone() };
        let foreign = self.by_header && !columns.iter().any(is_known);
        if foreign && let Some(cells) = self.foreign_values(columns) {
            return Record { cells, id: None, ..unnamed }.numbers(columns, what);
        }
        self.numbers(columns, what)
    }

    /// The numbers under names that nobody here knows, as many as `columns`, where none of the names ends as that of
    /// another column does: `rot_w` is no `x`, `A1` no `z`.
    fn foreign_values(&self, columns: &[&[&str]]) -> Option<Vec<Cell>> {
        let named: Vec<(&Cell, &String)> = self
            .cells
            .iter()
            .zip(&self.names)
            .filter(|(cell, name)| cell.number().is_some() && !is_id_name(name))
            .collect();
        let is_elsewhere = |name: &str, wanted: &[&str]| {
            let end = plain(name).chars().last();
            end.is_some_and(|c| "xyzw".contains(c) || c.is_ascii_digit())
                && !wanted.iter().any(|w| plain(w).chars().last() == end)
        };
        let contradicts =
            named.iter().zip(columns).any(|((_, name), wanted)| is_elsewhere(name, wanted));
        let all = || named.iter().map(|(cell, _)| (*cell).clone()).collect();
        (named.len() == columns.len() && !contradicts).then(all)
    }

    /// The finite number that a cell must be.
    fn finite(&self, cell: &Cell) -> Result<f64, Error> {
        match (cell, cell.number()) {
            (_, Some(x)) if x.is_finite() => Ok(x),
            (Cell::Number(x), _) => Err(self.refuse(
                format!("{x} is not a finite number"),
                "remove the record or exclude its capture",
            )),
            (Cell::Text(text), _) => Err(self.refuse(
                format!("\"{text}\" is not a number"),
                "correct the file, or say which columns = [..] hold the numbers",
            )),
        }
    }

    /// What the file calls the values of `columns`; `None` where it names none of them, or not all.
    pub(crate) fn names_of(&self, columns: &[&[&str]]) -> Option<Vec<String>> {
        let name = |wanted: &&[&str]| {
            let called = |have: &&String| wanted.iter().any(|n| plain(n) == plain(have));
            self.names.iter().find(called).cloned()
        };
        columns.iter().map(name).collect()
    }

    fn in_order(&self, columns: &[&[&str]], what: &str) -> Result<Vec<&Cell>, Error> {
        let leading_name = matches!(self.cells.first(), Some(Cell::Text(_)));
        let cells: Vec<&Cell> = self.cells.iter().skip(usize::from(leading_name)).collect();
        if cells.len() != columns.len() {
            return Err(self.refuse(
                format!("has {} values, but {what} takes {}", cells.len(), columns.len()),
                format!(
                    "in the order {}; say which with columns = [..]",
                    columns.iter().map(|c| c[0]).collect::<Vec<_>>().join(" ")
                ),
            ));
        }
        Ok(cells)
    }

    fn by_name(&self, columns: &[&[&str]], what: &str) -> Result<Vec<&Cell>, Error> {
        let cell = |names: &&[&str]| {
            self.named(names).ok_or_else(|| {
                self.refuse(
                    format!(
                        "{what} needs a value named {}, but the names are {}",
                        names[0],
                        self.names.join(", ")
                    ),
                    "say which columns = [..] are meant, in the notation's order",
                )
            })
        };
        columns.iter().map(cell).collect()
    }
}

/// Whether a column of this name names the record.
pub(crate) fn is_id_name(name: &str) -> bool {
    lines::ID_NAMES.iter().any(|n| plain(n) == plain(name))
}

/// A column's name without its unit, marks and capitals: `q_x`, `Q.X` and `qx [-]` are one.
pub(crate) fn plain(name: &str) -> String {
    let name = name.split(['[', '(']).next().unwrap_or_default().trim().to_lowercase();
    let bare = ["_mm", "_deg", "_rad", "_m"].iter().find_map(|unit| name.strip_suffix(unit));
    bare.unwrap_or(&name).chars().filter(|c| c.is_alphanumeric()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_columns_are_compared_without_marks() {
        for name in ["q_x", "Qx", "qx [-]", "q.x"] {
            assert_eq!(plain(name), "qx");
        }
        assert_eq!(plain("x_mm"), "x");
    }

    #[test]
    fn columns_in_another_language_are_taken_in_order() {
        const COLUMNS: [&[&str]; 3] = [&["x"], &["y"], &["z"]];
        let record = |names: &[&str], cells: &[f64]| Record {
            cells: cells.iter().map(|x| Cell::Number(*x)).collect(),
            names: names.iter().map(|n| (*n).into()).collect(),
            by_header: true,
            id: None,
            place: Place::default(),
        };
        let read = |names: &[&str], cells: &[f64]| {
            record(names, cells).numbers_in_any_language(&COLUMNS, "it").ok()
        };
        let in_order = Some(vec![1.0, 2.0, 3.0]);
        assert_eq!(read(&["rechts", "vorn", "oben"], &[1.0, 2.0, 3.0]), in_order);
        assert_eq!(read(&["Nr", "rechts", "vorn", "oben"], &[9.0, 1.0, 2.0, 3.0]), in_order);
        assert_eq!(read(&["z", "y", "x"], &[3.0, 2.0, 1.0]), in_order);
        // one that is known, and others that are not: which is which?
        assert_eq!(read(&["x", "vorn", "oben"], &[1.0, 2.0, 3.0]), None);
        assert_eq!(read(&["was", "rechts", "vorn", "oben"], &[9.0, 1.0, 2.0, 3.0]), None);
        // names that say another order
        assert_eq!(read(&["unten_z", "unten_y", "unten_x"], &[3.0, 2.0, 1.0]), None);
        assert_eq!(read(&["A1", "A2", "A3"], &[1.0, 2.0, 3.0]), None);
        let keys = Record { by_header: false, ..record(&["r", "s", "t"], &[1.0, 2.0, 3.0]) };
        assert!(keys.numbers_in_any_language(&COLUMNS, "it").is_err());
    }

    #[test]
    fn files_of_one_name_are_called_after_their_folders() {
        let paths = ["a/pose_00/data.json".into(), "a/pose_01/data.json".into()];
        assert_eq!(distinct_names(&paths), ["pose_00", "pose_01"]);
    }
}
