//! Scans of 3D cameras: point clouds in PLY and PCD, depth in PNG and TIFF, either in NPY and NPZ.

mod depth;
mod numpy;
mod pcd;
mod ply;

use std::path::Path;

use handeye::{Intrinsics, Scan};

use crate::{
    error::{Error, Place, malformed},
    files,
    image::image_size,
    units::LengthUnit,
};

/// What a scan's file does not say.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ScanOptions {
    /// Unit of the coordinates of points.
    pub length_unit: Option<LengthUnit>,
    /// Metres per unit of depth.
    pub depth_scale: Option<f64>,
    /// Width and height of the camera's grid of points.
    pub organised: Option<(usize, usize)>,
    /// Intrinsics of the depth image.
    pub intrinsics: Option<Intrinsics>,
}

/// Most points a scan may have.
const MOST_POINTS: usize = 100_000_000;

/// What a file holds, in metres.
struct Points {
    xyz: Vec<[f32; 3]>,
    grid: Option<(usize, usize)>,
}

/// Reads a scan into metres; points at the origin, and depths of 0, are missing.
///
/// # Errors
/// What is no scan, is cut short or empty, or needs a unit, scale or intrinsics that are not given.
pub fn read_scan(path: &Path, options: &ScanOptions) -> Result<Scan, Error> {
    match files::extension(path).as_str() {
        "ply" => of_points(ply::read(path, unit(options, path)?)?, options, path),
        "pcd" => of_points(pcd::read(path, unit(options, path)?)?, options, path),
        "npy" | "npz" => numpy::read(path, options),
        "png" | "tif" | "tiff" => depth::read(path, options),
        other => Err(malformed(
            Place::file(path),
            format!("scans of kind \".{other}\" cannot be read"),
            "PLY, PCD, NPY, NPZ, and depth in PNG and TIFF can; export one of them",
        )),
    }
}

/// Width and height of a depth image, or of a grid of points in a NumPy file; `None` of other files.
///
/// # Errors
/// What cannot be read.
pub fn scan_size(path: &Path) -> Result<Option<(u32, u32)>, Error> {
    match files::extension(path).as_str() {
        "npy" | "npz" => numpy::size(path),
        "png" | "tif" | "tiff" => image_size(path).map(Some),
        _ => Ok(None),
    }
}

fn undeclared(path: &Path, key: &str, question: &str) -> Error {
    Error::Undeclared { place: Place::file(path), key: key.into(), question: question.into() }
}

fn unit(options: &ScanOptions, path: &Path) -> Result<LengthUnit, Error> {
    options.length_unit.ok_or_else(|| {
        undeclared(path, "length_unit", "are the coordinates of the points in \"m\" or in \"mm\"?")
    })
}

/// In metres; a point at the origin is missing.
#[inline(always)]
fn in_metres(point: [f64; 3], unit: LengthUnit) -> [f32; 3] {
    let seen = point.iter().all(|x| x.is_finite()) && point != [0.0; 3];
    if seen { point.map(|x| unit.to_metres(x) as f32) } else { [f32::NAN; 3] }
}

fn of_points(points: Points, options: &ScanOptions, path: &Path) -> Result<Scan, Error> {
    let count = points.xyz.len();
    let (width, height) = options.organised.or(points.grid).unwrap_or((count, 1));
    let scan = Scan::new(width, height, points.xyz).ok_or_else(|| {
        malformed(
            Place::file(path),
            format!("holds {count} points, not {width} x {height}"),
            "correct organised = [width, height], or leave it out",
        )
    })?;
    with_points(scan, path)
}

/// Refuses a scan in which nothing was seen.
fn with_points(scan: Scan, path: &Path) -> Result<Scan, Error> {
    if scan.points().iter().all(|p| p[0].is_nan()) {
        return Err(malformed(
            Place::file(path),
            "the scan holds no point",
            "record it again, or exclude its capture",
        ));
    }
    Ok(scan)
}

/// Refuses more points than are read, and more than the file's bytes can hold.
fn check_count(
    count: usize,
    fewest_bytes: usize,
    present: usize,
    path: &Path,
) -> Result<(), Error> {
    if count > MOST_POINTS {
        return Err(Error::TooLarge {
            place: Place::file(path),
            what: "the number of points".into(),
            found: count as u64,
            limit: MOST_POINTS as u64,
            advice: "is the file damaged?".into(),
        });
    }
    if count.saturating_mul(fewest_bytes) > present {
        return Err(cut_short(count, path));
    }
    Ok(())
}

fn cut_short(count: usize, path: &Path) -> Error {
    malformed(
        Place::file(path),
        format!("is cut short: the header promises {count} points"),
        "copy or record it again",
    )
}

/// A number type of a binary point file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Number {
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
    fn size(self) -> usize {
        match self {
            Number::I8 | Number::U8 => 1,
            Number::I16 | Number::U16 => 2,
            Number::I32 | Number::U32 | Number::F32 => 4,
            Number::F64 => 8,
        }
    }

    /// The number at the start of `bytes`; `None` if they are too few.
    fn read(self, bytes: &[u8], big_endian: bool) -> Option<f64> {
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
struct Column {
    offset: usize,
    number: Number,
}

/// Points of binary records of equal size; `None` where bytes are missing.
fn of_records(
    body: &[u8],
    size: usize,
    count: usize,
    columns: [Column; 3],
    big_endian: bool,
    unit: LengthUnit,
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
        return Some(records.map(|r| in_metres([0, 1, 2].map(|k| single(r, k)), unit)).collect());
    }
    let point = |record: &[u8]| {
        let at = |c: Column| c.number.read(&record[c.offset..], big_endian);
        let [x, y, z] = columns.map(at);
        Some(in_metres([x?, y?, z?], unit))
    };
    records.map(point).collect()
}

/// Points of lines of words, of which three are coordinates; `None` where they are missing.
fn of_lines<'a>(
    lines: impl Iterator<Item = &'a str>,
    count: usize,
    words: [usize; 3],
    unit: LengthUnit,
) -> Option<Vec<[f32; 3]>> {
    let last = words.into_iter().max()?;
    let mut points = Vec::new();
    for line in lines.filter(|line| !line.trim_ascii().is_empty()).take(count) {
        let mut point = [None; 3];
        for (k, word) in line.split_ascii_whitespace().enumerate().take(last + 1) {
            for axis in 0..3 {
                if words[axis] == k {
                    point[axis] = word.parse().ok();
                }
            }
        }
        let [x, y, z] = point;
        points.push(in_metres([x?, y?, z?], unit));
    }
    (points.len() == count).then_some(points)
}
