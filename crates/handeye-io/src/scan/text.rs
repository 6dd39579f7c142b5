//! Points in text (XYZ, TXT, CSV, ASC, PTS): one a line, its values apart by blanks, tabs, commas or
//! semicolons.
//!
//! A first line, or a comment before the points, may name the columns (`x,y,z`, `//X Y Z`) and their
//! unit (`x_mm`); without names the first three are x, y and z. PTS begins with the number of its
//! points, and may go on with further lists of this kind. What is empty or NaN was not seen. Between
//! semicolons or tabs numbers may have a decimal comma.

use std::{borrow::Cow, fs::File, io::Read, path::Path};

use super::{Points, ScanOptions, in_metres, unit};
use crate::{
    error::{Error, Place, malformed},
    files,
    records::{check_count, cut_short},
    units::LengthUnit,
};

/// A point takes so many bytes at least: three digits and what stands between and behind them.
const FEWEST_BYTES: usize = 6;
/// Names of the columns stand within so many bytes of the beginning.
const LONGEST_HEAD: u64 = 1 << 16;

pub(super) fn read(path: &Path, options: &ScanOptions) -> Result<Points, Error> {
    let bytes = files::bytes(path)?;
    let mut lines = Lines::of(&bytes);
    let head = head(&mut lines, path)?;
    let unit = agreed(head.unit, options, path)?;
    let mut promised = head.promised;
    let mut xyz = Vec::new();
    for line in lines {
        if line.text.is_empty() {
            continue;
        }
        match point(line.text, &head) {
            Ok(point) => xyz.push(in_metres(point, unit)),
            Err(fault) => match (promised, count_in(line.text)) {
                (Some(before), Some(more)) if before == xyz.len() => {
                    promised = Some(before.saturating_add(more));
                }
                _ => return Err(refused(&fault, &line, &head, path)),
            },
        }
    }
    check_count(xyz.len(), "points", 0, 0, path)?;
    match promised {
        Some(count) if count > xyz.len() => Err(cut_short(count, "points", path)),
        Some(count) if count < xyz.len() => Err(malformed(
            Place::file(path),
            format!("promises {count} points, but holds {}", xyz.len()),
            "correct the number in its first line, or remove that line",
        )),
        _ => Ok(Points { xyz, grid: None }),
    }
}

/// The unit that the names of the columns say.
pub(super) fn unit_said(path: &Path) -> Option<LengthUnit> {
    let mut start = Vec::new();
    File::open(path).and_then(|f| f.take(LONGEST_HEAD).read_to_end(&mut start)).ok()?;
    head(&mut Lines::of(&start), path).ok()?.unit
}

/// The unit that was said in the file or declared; where they differ, one is wrong.
fn agreed(
    said: Option<LengthUnit>,
    options: &ScanOptions,
    path: &Path,
) -> Result<LengthUnit, Error> {
    match (said, options.length_unit) {
        (Some(said), Some(declared)) if said != declared => Err(malformed(
            Place::file(path),
            format!("its columns are in {}, but {} is declared", said.name(), declared.name()),
            "correct the names of the columns, or the length unit",
        )),
        (Some(said), _) => Ok(said),
        (None, _) => unit(options, path),
    }
}

// ---------------------------------------------------------------- lines

/// A line without its comment and the blanks around it; tabs stay, for they separate.
struct Line<'a> {
    /// Counted from 1.
    number: usize,
    text: &'a [u8],
    comment: &'a [u8],
}

#[derive(Clone)]
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    fn of(bytes: &'a [u8]) -> Self {
        Self { rest: bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes), number: 0 }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    #[inline(always)]
    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| *b == b'\n').unwrap_or(self.rest.len());
        let whole = &self.rest[..end];
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        self.number += 1;
        let (text, comment) = whole.split_at(comment_in(whole).unwrap_or(whole.len()));
        Some(Line { number: self.number, text: without_blanks(text), comment })
    }
}

/// Where a comment begins: `#`, or `//`.
#[inline(always)]
fn comment_in(line: &[u8]) -> Option<usize> {
    let begins = |at: &usize| line[*at] == b'#' || line.get(at + 1) == Some(&b'/');
    let mark = |b: &u8| matches!(b, b'#' | b'/');
    let first = line.iter().position(mark)?;
    (first..line.len()).find(|at| mark(&line[*at]) && begins(at))
}

#[inline(always)]
fn without_blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\r', rest @ ..] = text {
        text = rest;
    }
    while let [rest @ .., b' ' | b'\r'] = text {
        text = rest;
    }
    // a line of tabs alone has no values
    if text.iter().all(|b| *b == b'\t') { &[] } else { text }
}

// ---------------------------------------------------------------- values

/// What stands between two values.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Separator {
    Mark(u8),
    Blanks,
}

/// What separates the values of a line.
fn separator_of(line: &[u8]) -> Separator {
    let count = |mark: u8| line.iter().filter(|b| **b == mark).count();
    match () {
        () if count(b';') > 0 => Separator::Mark(b';'),
        () if count(b'\t') > 1 => Separator::Mark(b'\t'),
        () if count(b',') > 0 => Separator::Mark(b','),
        () => Separator::Blanks,
    }
}

/// Calls `each` with every value of a line and its column, and tells how many there are.
#[inline(always)]
fn values<'a>(
    line: &'a [u8],
    separator: Separator,
    mut each: impl FnMut(usize, &'a [u8]),
) -> usize {
    let mut count = 0;
    let mut take = |value: &'a [u8]| {
        each(count, value);
        count += 1;
    };
    match separator {
        Separator::Mark(mark) => line.split(|b| *b == mark).for_each(|v| take(v.trim_ascii())),
        Separator::Blanks => line
            .split(|b| matches!(b, b' ' | b'\t'))
            .filter(|value| !value.is_empty())
            .for_each(take),
    }
    count
}

fn all_values(line: &[u8]) -> Vec<&[u8]> {
    let mut all = vec![];
    values(line, separator_of(line), |_, value| all.push(value));
    all
}

/// A number; NaN where nothing stands.
#[inline(always)]
fn number(value: &[u8], separator: Separator) -> Option<f64> {
    let text = std::str::from_utf8(value).ok()?;
    text.parse().ok().or_else(|| otherwise_written(text, separator))
}

/// A number in quotation marks or with a decimal comma, or none at all.
#[cold]
fn otherwise_written(text: &str, separator: Separator) -> Option<f64> {
    let bare = text.trim_matches('"').trim();
    if bare.is_empty() {
        return Some(f64::NAN);
    }
    let comma_is_free = separator != Separator::Mark(b',');
    let bare = if comma_is_free { Cow::from(bare.replacen(',', ".", 1)) } else { bare.into() };
    bare.parse().ok()
}

fn is_decimal_comma(word: &[u8]) -> bool {
    let digits = |s: &[u8]| !s.is_empty() && s.iter().all(u8::is_ascii_digit);
    let word = word.strip_prefix(b"-").unwrap_or(word);
    word.iter()
        .position(|b| *b == b',')
        .is_some_and(|at| digits(&word[..at]) && digits(&word[at + 1..]))
}

/// The number of points that begins a list.
fn count_in(line: &[u8]) -> Option<usize> {
    std::str::from_utf8(line).ok()?.parse().ok()
}

// ---------------------------------------------------------------- head

/// What stands before the points, and how they are written.
#[derive(Debug)]
struct Head {
    separator: Separator,
    /// Columns of x, y and z.
    columns: [usize; 3],
    /// Values on every line.
    count: usize,
    unit: Option<LengthUnit>,
    promised: Option<usize>,
}

/// Names of the columns.
struct Names {
    columns: [usize; 3],
    count: usize,
    unit: Option<LengthUnit>,
    in_comment: bool,
}

/// Reads up to the first point, which is the next line.
fn head(lines: &mut Lines, path: &Path) -> Result<Head, Error> {
    let (mut names, mut promised): (Option<Names>, _) = (None, None);
    let mut at_point = lines.clone();
    while let Some(line) = at_point.next() {
        if line.text.is_empty() {
            names = names.or(names_in(line.comment, true));
        } else if let (Some(count), None) = (count_in(line.text), promised) {
            check_count(count, "points", FEWEST_BYTES, at_point.rest.len() + 1, path)?;
            promised = Some(count);
        } else if has_no_number(line.text) && names.as_ref().is_none_or(|n| n.in_comment) {
            let found = names_in(line.text, false);
            names = Some(found.ok_or_else(|| {
                malformed(
                    Place::line(path, line.number),
                    "is neither a point nor a line that names the columns x, y and z",
                    "remove it, or begin it with #",
                )
            })?);
        } else {
            return of_first_point(&line, names, promised, path);
        }
        *lines = at_point.clone();
    }
    let nothing = [0, 1, 2];
    Ok(Head { separator: Separator::Blanks, columns: nothing, count: 3, unit: None, promised })
}

fn of_first_point(
    line: &Line,
    names: Option<Names>,
    promised: Option<usize>,
    path: &Path,
) -> Result<Head, Error> {
    let place = || Place::line(path, line.number);
    let separator = separator_of(line.text);
    let mut words = line.text.split(|b| *b == b' ').filter(|w| !w.is_empty());
    if separator == Separator::Mark(b',') && words.all(is_decimal_comma) {
        return Err(malformed(
            place(),
            "has numbers with a decimal comma, apart by blanks or commas",
            "write a decimal point, or put semicolons between the columns",
        ));
    }
    let count = values(line.text, separator, |_, _| ());
    if count < 3 {
        return Err(malformed(
            place(),
            format!("has {count} values, but a point takes x, y and z"),
            "is it a list of points?",
        ));
    }
    let head = |columns, unit| Head { separator, columns, count, unit, promised };
    match names {
        Some(names) if names.count == count => Ok(head(names.columns, names.unit)),
        // words of a remark
        Some(names) if names.in_comment => Ok(head([0, 1, 2], None)),
        Some(names) => Err(malformed(
            place(),
            format!("has {count} values, but {} columns are named", names.count),
            "name every column, or none",
        )),
        None => Ok(head([0, 1, 2], None)),
    }
}

fn has_no_number(line: &[u8]) -> bool {
    let values = all_values(line);
    let is_number = |v: &&[u8]| number(v, separator_of(line)).is_some_and(|x| !x.is_nan());
    let is_nothing = |v: &&[u8]| number(v, separator_of(line)).is_some_and(f64::is_nan);
    !values.iter().any(is_number) && !values.iter().all(is_nothing)
}

/// The columns that a line names; `None` unless x, y and z are among them, each once and all in one unit.
fn names_in(line: &[u8], in_comment: bool) -> Option<Names> {
    let start = line.iter().position(|b| !matches!(b, b'#' | b'/' | b' ' | b'\t' | b'\r'))?;
    let names = all_values(without_blanks(&line[start..]));
    let mut found: [Option<(usize, Option<LengthUnit>)>; 3] = [None; 3];
    for (k, name) in names.iter().enumerate() {
        let Some((axis, unit)) = axis(name) else { continue };
        if found[axis].replace((k, unit)).is_some() {
            return None;
        }
    }
    let [x, y, z] = found;
    let (x, y, z) = (x?, y?, z?);
    let alike = x.1 == y.1 && y.1 == z.1;
    alike.then_some(Names { columns: [x.0, y.0, z.0], count: names.len(), unit: x.1, in_comment })
}

/// `X`, `x_mm`, `"Y [mm]"` and the like: which coordinate, and in which unit.
fn axis(name: &[u8]) -> Option<(usize, Option<LengthUnit>)> {
    let name = std::str::from_utf8(name).ok()?.trim_matches('"').trim().to_lowercase();
    let axis = ["x", "y", "z"].iter().position(|a| name.starts_with(a))?;
    let rest = &name[1..];
    let bare = rest.trim_matches(|c: char| !c.is_alphanumeric());
    let unit = match bare {
        "" => None,
        _ if bare.len() == rest.len() => return None, // xn, yaw: other words
        "m" => Some(LengthUnit::Metre),
        "cm" => Some(LengthUnit::Centimetre),
        "mm" => Some(LengthUnit::Millimetre),
        "in" | "inch" => Some(LengthUnit::Inch),
        _ => return None,
    };
    Some((axis, unit))
}

// ---------------------------------------------------------------- points

/// Why a line is no point.
enum Fault {
    /// Another number of values than in the first line.
    Count(usize),
    /// The value in this column is no number.
    NoNumber(usize),
}

#[inline(always)]
fn point(line: &[u8], head: &Head) -> Result<[f64; 3], Fault> {
    let mut point = [f64::NAN; 3];
    let mut wrong = None;
    let count = values(line, head.separator, |k, value| {
        for axis in 0..3 {
            if head.columns[axis] == k {
                match number(value, head.separator) {
                    Some(x) => point[axis] = x,
                    None => wrong = Some(k),
                }
            }
        }
    });
    match wrong {
        _ if count != head.count => Err(Fault::Count(count)),
        Some(column) => Err(Fault::NoNumber(column)),
        None => Ok(point),
    }
}

#[cold]
fn refused(fault: &Fault, line: &Line, head: &Head, path: &Path) -> Error {
    let place = Place::line(path, line.number);
    match fault {
        Fault::Count(count) => malformed(
            place,
            format!("has {count} values, but the lines before have {}", head.count),
            "complete the line or remove it (comments begin with #)",
        ),
        Fault::NoNumber(column) => {
            let mut found = String::new();
            values(line.text, head.separator, |k, value| {
                if k == *column {
                    found = String::from_utf8_lossy(value).chars().take(32).collect();
                }
            });
            malformed(
                place,
                format!("\"{found}\" is not a number"),
                "correct the line or remove it",
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_known_by_their_names_and_these_by_their_first_letter() {
        for (name, expected) in [
            ("X", Some((0, None))),
            ("\"y\"", Some((1, None))),
            ("z_mm", Some((2, Some(LengthUnit::Millimetre)))),
            ("Y [m]", Some((1, Some(LengthUnit::Metre)))),
            ("x(inch)", Some((0, Some(LengthUnit::Inch)))),
            ("xn", None),
            ("yaw", None),
            ("x_normal", None),
            ("", None),
        ] {
            assert_eq!(axis(name.as_bytes()), expected, "{name}");
        }
    }

    #[test]
    fn a_comment_begins_with_a_hash_or_two_slashes() {
        assert_eq!(comment_in(b"1 2 3 # seen"), Some(6));
        assert_eq!(comment_in(b"1/2 3 // seen"), Some(6));
        assert_eq!(comment_in(b"1/2 3"), None);
    }
}
