//! Tables in text: one record per line, values apart by semicolons, commas, tabs or spaces, with or
//! without a header, `#` before comments; and matrices that stretch over four lines.
//!
//! Spreadsheets of much of Europe write `1,5;2,25`: where semicolons or tabs separate the values of a file and a comma
//! stands within one of its numbers, commas are decimal points in all of it.

use std::path::Path;

use super::{Cell, Layout, Record, is_padded};
use crate::{
    error::{Error, Place, malformed},
    files,
};

struct Line {
    number: usize,
    cells: Vec<(Option<String>, Cell)>,
}

pub(super) fn records(path: &Path, layout: &Layout) -> Result<Vec<Record>, Error> {
    let text = files::table_text(path)?;
    let below = || text.lines().enumerate().skip(layout.skip_lines);
    let commas = Commas::of(below().map(|(_, line)| line));
    let mut lines = Vec::new();
    for (i, line) in below() {
        if commas == Commas::InNumbers && is_apart_by_commas(line) {
            let what =
                "has commas between its values, but numbers of other lines have decimal commas";
            return Err(malformed(Place::line(path, i + 1), what, "write all lines alike"));
        }
        if commas == Commas::InNumbers && has_point_in_number(line) {
            let what = "has a point in a number, but the file has decimal commas";
            let advice = "leave out what separates thousands, and write all numbers alike";
            return Err(malformed(Place::line(path, i + 1), what, advice));
        }
        let cells = cells(line, commas);
        if !cells.is_empty() {
            lines.push(Line { number: i + 1, cells });
        }
    }
    let header = take_header(&mut lines);
    let records: Vec<Record> =
        lines.into_iter().map(|l| record(l, &header, path)).collect::<Result<_, _>>()?;
    if records.is_empty() {
        return Err(malformed(Place::file(path), "holds no numbers", "record it again"));
    }
    if layout.matrices { matrices(records, path) } else { Ok(records) }
}

/// What a comma means in a file.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Commas {
    BetweenValues,
    InNumbers,
}

impl Commas {
    fn of<'a>(mut lines: impl Iterator<Item = &'a str>) -> Self {
        let in_numbers = |line: &str| {
            let line = without_comment(line);
            let separator = [';', '\t'].into_iter().find(|s| line.contains(*s));
            separator.is_some_and(|s| line.split(s).any(is_decimal_comma))
        };
        if lines.any(in_numbers) { Self::InNumbers } else { Self::BetweenValues }
    }
}

fn is_apart_by_commas(line: &str) -> bool {
    let line = without_comment(line);
    line.contains(',') && !line.contains([';', '\t'])
}

fn has_point_in_number(line: &str) -> bool {
    let is_digit = |c: Option<&u8>| c.is_some_and(u8::is_ascii_digit);
    let is_one = |cell: &str| {
        let bytes = cell.trim().trim_matches('"').as_bytes();
        let is_number = bytes.iter().all(|b| b.is_ascii_digit() || b"+-.,eE".contains(b));
        is_number
            && (1..bytes.len()).any(|k| {
                bytes[k] == b'.' && is_digit(bytes.get(k - 1)) && is_digit(bytes.get(k + 1))
            })
    };
    without_comment(line).split([';', '\t']).any(is_one)
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// The values of one line, each with the name before it if there is one (`X: 1.5`, `X 1.5`).
fn cells(line: &str, commas: Commas) -> Vec<(Option<String>, Cell)> {
    let line = without_comment(line);
    let line = line.strip_prefix("p[").unwrap_or(line);
    let mut bare = without_brackets(line);
    if commas == Commas::InNumbers {
        bare = with_points(&bare);
    }
    // tabs that only align the columns leave some empty
    let apart_by_tabs = bare.contains('\t') && !bare.contains("\t\t");
    let separator = match commas {
        _ if bare.contains(';') => ';',
        Commas::BetweenValues if bare.contains(',') => ',',
        _ if apart_by_tabs => '\t',
        _ => return words(&bare),
    };
    let parts = bare.trim().trim_end_matches(separator).split(separator);
    parts.flat_map(part).collect()
}

/// The text without brackets around values; those around a unit behind a name stay: `X [mm]`.
fn without_brackets(line: &str) -> String {
    let ends = |at: usize, open: char| {
        let close = match open {
            '[' => ']',
            '(' => ')',
            _ => return None,
        };
        let length = line[at + 1..].find(close)?;
        let is_unit = |c: char| c.is_alphabetic() || "°/%".contains(c);
        let content = line[at + 1..at + 1 + length].trim();
        let is_behind_name = line[..at].trim_end().ends_with(|c: char| c.is_alphanumeric());
        let is_one = !content.is_empty() && content.chars().all(is_unit) && is_behind_name;
        is_one.then_some(at + 1 + length)
    };
    let mut end = None;
    let keep = |(at, c): (usize, char)| {
        if end.is_some_and(|end| at <= end) {
            return c;
        }
        end = ends(at, c);
        if end.is_none() && "[]{}()".contains(c) { ' ' } else { c }
    };
    line.char_indices().map(keep).collect()
}

fn is_decimal_comma(cell: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|c| c.is_ascii_digit());
    let bare = cell.trim().trim_matches('"').trim_start_matches(['-', '+']);
    bare.split_once(',').is_some_and(|(whole, rest)| {
        digits(whole) && digits(rest.split(['e', 'E']).next().unwrap_or_default())
    })
}

/// Every comma between two digits as a decimal point.
fn with_points(text: &str) -> String {
    let bytes = text.as_bytes();
    let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let point =
        |(at, c)| if c == ',' && at > 0 && is_digit(at - 1) && is_digit(at + 1) { '.' } else { c };
    text.char_indices().map(point).collect()
}

/// What stands between two separators: numbers, a named number, or one text.
fn part(part: &str) -> Vec<(Option<String>, Cell)> {
    let part = part.trim().trim_matches('"');
    let words = words(part);
    if words.is_empty() || words.iter().any(|(_, cell)| cell.number().is_none()) {
        if let [name, value] = part.split_whitespace().collect::<Vec<_>>()[..]
            && let Ok(x) = value.parse()
        {
            return vec![(Some(name.into()), Cell::Number(x))];
        }
        return vec![(None, Cell::Text(part.into()))];
    }
    words
}

/// Values apart by spaces; `X:` and `X=` name the value that follows.
fn words(text: &str) -> Vec<(Option<String>, Cell)> {
    let spaced = text.replace('=', "= ").replace(':', ": ");
    let (mut cells, mut name) = (Vec::new(), None);
    for word in spaced.split_whitespace() {
        match (word.strip_suffix([':', '=']), word.parse()) {
            (Some(before), _) => name = Some(before.to_string()),
            (None, Ok(x)) if !is_padded(word) => cells.push((name.take(), Cell::Number(x))),
            (None, _) => cells.push((name.take(), Cell::Text(word.into()))),
        }
    }
    cells
}

/// A first line without any number names the columns.
fn take_header(lines: &mut Vec<Line>) -> Vec<String> {
    let is_header = lines.first().is_some_and(|line| {
        line.cells.len() > 1 && line.cells.iter().all(|(_, c)| c.number().is_none())
    });
    if !is_header {
        return vec![];
    }
    let text = |(_, cell): (Option<String>, Cell)| match cell {
        Cell::Text(text) => text,
        Cell::Number(x) => x.to_string(),
    };
    lines.remove(0).cells.into_iter().map(text).collect()
}

/// Usual names of the column that names a record.
pub(super) const ID_NAMES: [&str; 17] = [
    "id",
    "name",
    "capture",
    "capture_id",
    "image",
    "file",
    "pose_id",
    "record_id",
    "pose",
    "nr",
    "no",
    "number",
    "nummer",
    "bild",
    "aufnahme",
    "numero",
    "punkt",
];

fn record(line: Line, header: &[String], path: &Path) -> Result<Record, Error> {
    let place = Place::line(path, line.number);
    if !header.is_empty() && header.len() != line.cells.len() {
        return Err(malformed(
            place,
            format!("{} values, but the header names {}", line.cells.len(), header.len()),
            "complete the line",
        ));
    }
    let (own, cells): (Vec<_>, Vec<_>) = line.cells.into_iter().unzip();
    let own: Option<Vec<String>> = own.into_iter().collect();
    let names = if header.is_empty() { own.unwrap_or_default() } else { header.to_vec() };
    let mut record = Record { cells, names, by_header: !header.is_empty(), id: None, place };
    record.id = record.text_named(&ID_NAMES).or_else(|| match record.cells.first() {
        Some(Cell::Text(text)) => Some(text.clone()),
        _ => None,
    });
    Ok(record)
}

/// Lines of four numbers put together to matrices; a count in front is checked.
fn matrices(lines: Vec<Record>, path: &Path) -> Result<Vec<Record>, Error> {
    let count = match lines[0].cells[..] {
        [Cell::Number(n)] if lines.len() > 1 => Some(n),
        _ => None,
    };
    let rows: Vec<Record> = lines.into_iter().skip(usize::from(count.is_some())).collect();
    if rows.iter().any(|r| r.cells.len() != 4) {
        return Ok(rows);
    }
    let last = [0.0, 0.0, 0.0, 1.0].map(Cell::Number);
    let height = if rows.len() >= 4 && rows[3].cells == last { 4 } else { 3 };
    let blocks = rows.len() / height;
    if !rows.len().is_multiple_of(height) || count.is_some_and(|n| n != blocks as f64) {
        let counted = count.map(|n| format!(" after a count of {n}")).unwrap_or_default();
        return Err(malformed(
            Place::file(path),
            format!(
                "{} lines of a {height}x4 matrix{counted} are no whole number of poses",
                rows.len()
            ),
            "complete the file",
        ));
    }
    Ok(rows.chunks(height).map(|block| super::joined(block.to_vec())).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(line: &str) -> Vec<f64> {
        let cells = cells(line, Commas::of([line].into_iter()));
        cells.iter().map(|(_, c)| c.number().unwrap()).collect()
    }

    #[test]
    fn every_usual_separator_is_understood() {
        for line in [
            "1,2,-3e1",
            "1; 2; -3e1",
            "1\t2\t-3e1",
            "1,\t2,\t-3e1",
            " 1  2 -3e1 # note",
            "p[1, 2, -30]",
            "[1, 2], [-30]",
            "1;2,0;-3,0e1",
            "1\t2,0\t-30,000",
            "\"1,0\";\"2\";-30",
        ] {
            assert_eq!(numbers(line), [1.0, 2.0, -30.0], "{line}");
        }
    }

    #[test]
    fn a_comma_is_a_decimal_point_in_a_whole_file_or_nowhere() {
        let of = |lines: &[&str]| Commas::of(lines.iter().copied());
        assert_eq!(of(&["x;y", "1;2", "1,5;2"]), Commas::InNumbers);
        assert_eq!(of(&["x\ty", "1\t2,5"]), Commas::InNumbers);
        assert_eq!(of(&["1,5,2", "1,2"]), Commas::BetweenValues);
        assert_eq!(of(&["[1, 2]; [3, 4]", "1;2 # 3,5;4"]), Commas::BetweenValues);
    }

    #[test]
    fn names_apart_by_tabs_may_have_blanks() {
        let names: Vec<Cell> =
            cells("Pose Nr\tX", Commas::BetweenValues).into_iter().map(|c| c.1).collect();
        assert_eq!(names, ["Pose Nr", "X"].map(|n| Cell::Text(n.into())));
    }

    #[test]
    fn units_in_brackets_stay_with_their_names() {
        let names = |line: &str| {
            let cells = cells(line, Commas::InNumbers).into_iter();
            cells.map(|(_, cell)| cell.text()).collect::<Vec<_>>()
        };
        assert_eq!(names("Punkt;X [mm];A [°];t(s)"), ["Punkt", "X [mm]", "A [°]", "t(s)"]);
        assert_eq!(names("[x; y; z]"), ["x", "y", "z"]);
    }

    #[test]
    fn names_beside_values_are_kept() {
        for line in ["{X 1.5,Y 2,Z 3}", "X: 1.5 Y: 2 Z: 3", "X=1.5, Y=2, Z=3"] {
            let cells = cells(line, Commas::BetweenValues);
            let names: Vec<_> = cells.iter().map(|(n, _)| n.as_deref().unwrap_or("")).collect();
            assert_eq!(names, ["X", "Y", "Z"], "{line}");
        }
    }
}
