//! Points in records of numbers, in binary and in text.

use std::path::Path;

use crate::error::{Error, Place, malformed};

/// Most points a scan or mesh may have.
pub(crate) const MOST_POINTS: usize = 100_000_000;

/// Refuses more points (or faces) than are read, and more than the file's bytes can hold.
pub(crate) fn check_count(
    count: usize,
    what: &str,
    fewest_bytes: usize,
    present: usize,
    path: &Path,
) -> Result<(), Error> {
    if count > MOST_POINTS {
        return Err(Error::TooLarge {
            place: Place::file(path),
            what: format!("the number of {what}"),
            found: count as u64,
            limit: MOST_POINTS as u64,
            advice: "is the file damaged?".into(),
        });
    }
    if count.saturating_mul(fewest_bytes) > present {
        return Err(cut_short(count, what, path));
    }
    Ok(())
}

pub(crate) fn cut_short(count: usize, what: &str, path: &Path) -> Error {
    malformed(
        Place::file(path),
        format!("is cut short: the header promises {count} {what}"),
        "copy or record it again",
    )
}

/// A number type of a binary point file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    /// Its bytes.
    pub(crate) fn size(self) -> usize {
        match self {
            Number::I8 | Number::U8 => 1,
            Number::I16 | Number::U16 => 2,
            Number::I32 | Number::U32 | Number::F32 => 4,
            Number::F64 => 8,
        }
    }

    /// The number at the start of `bytes`; `None` if they are too few.
    pub(crate) fn read(self, bytes: &[u8], big_endian: bool) -> Option<f64> {
        let mut raw = [0u8; 8];
        raw[..self.size()].copy_from_slice(bytes.get(..self.size())?);
        if big_endian {
            raw[..self.size()].reverse();
        }
        let [b0, b1, b2, b3, ..] = raw;
        Some(match self {
            Number::I8 => i8::from_le_bytes([b0]).into(),
            Number::U8 => b0.into(),
            Number::I16 => i16::from_le_bytes([b0, b1]).into(),
            Number::U16 => u16::from_le_bytes([b0, b1]).into(),
            Number::I32 => i32::from_le_bytes([b0, b1, b2, b3]).into(),
            Number::U32 => u32::from_le_bytes([b0, b1, b2, b3]).into(),
            Number::F32 => f32::from_le_bytes([b0, b1, b2, b3]).into(),
            Number::F64 => f64::from_le_bytes(raw),
        })
    }
}

/// Where a coordinate stands in a record.
#[derive(Clone, Copy)]
pub(crate) struct Column {
    pub(crate) offset: usize,
    pub(crate) number: Number,
}

/// Points of binary records of equal size, each as `point` makes it of the three numbers; `None` where
/// bytes are missing.
pub(crate) fn of_records(
    body: &[u8],
    size: usize,
    count: usize,
    columns: [Column; 3],
    big_endian: bool,
    point: impl Fn([f64; 3]) -> [f32; 3],
) -> Option<Vec<[f32; 3]>> {
    let is_inside = |c: &Column| c.offset + c.number.size() <= size;
    let records = body.get(..count.checked_mul(size)?)?;
    if size == 0 || !columns.iter().all(is_inside) {
        return None;
    }
    let records = records.chunks_exact(size);
    if !big_endian && columns.iter().all(|c| c.number == Number::F32) {
        let at = columns.map(|c| c.offset);
        let single = |record: &[u8], k: usize| {
            let bytes = [record[at[k]], record[at[k] + 1], record[at[k] + 2], record[at[k] + 3]];
            f64::from(f32::from_le_bytes(bytes))
        };
        return Some(records.map(|r| point([0, 1, 2].map(|k| single(r, k)))).collect());
    }
    let read = |record: &[u8]| {
        let at = |c: Column| c.number.read(&record[c.offset..], big_endian);
        let [x, y, z] = columns.map(at);
        Some(point([x?, y?, z?]))
    };
    records.map(read).collect()
}

/// Points of lines of words, of which three are coordinates; `None` where they are missing.
pub(crate) fn of_lines<'a>(
    lines: impl Iterator<Item = &'a str>,
    count: usize,
    words: [usize; 3],
    point: impl Fn([f64; 3]) -> [f32; 3],
) -> Option<Vec<[f32; 3]>> {
    let last = words.into_iter().max()?;
    let mut points = Vec::new();
    for line in lines.filter(|line| !line.trim_ascii().is_empty()).take(count) {
        let mut found = [None; 3];
        for (k, word) in line.split_ascii_whitespace().enumerate().take(last + 1) {
            for axis in 0..3 {
                if words[axis] == k {
                    found[axis] = word.parse().ok();
                }
            }
        }
        let [x, y, z] = found;
        points.push(point([x?, y?, z?]));
    }
    (points.len() == count).then_some(points)
}
