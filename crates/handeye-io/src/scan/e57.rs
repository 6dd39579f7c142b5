//! E57, the exchange format of 3D imaging systems: ASTM E2807. Metres; one scan or several.
//!
//! A file is cut into pages, each with a checksum. Its XML part lists the scans; the points of each lie in
//! packets that hold a stream of bits per coordinate. Header, XML and checksums are read by the crate
//! `e57`. Points are unpacked here, stream by stream: so they take no more memory than the file and
//! themselves, whatever the packets say.

use std::{
    io::Cursor,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use e57::{E57Reader, PointCloud, Record, RecordDataType, RecordName};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::{Points, in_metres};
use crate::{
    error::{Error, Place, malformed},
    files,
    records::{check_count, cut_short},
    units::LengthUnit,
};

/// Bytes of a page, and those of them that are no checksum.
const PAGE: usize = 1024;
const PAGE_CONTENT: usize = 1020;
/// Bytes of the header before a scan's packets, and where in it the place of the first packet stands.
const SECTION_HEADER: usize = 32;
const FIRST_PACKET: usize = 16;
/// Where in a data packet its length less one, the number of its streams, and their lengths stand.
const PACKET_LENGTH: usize = 2;
const STREAM_COUNT: usize = 4;
const STREAM_LENGTHS: usize = 6;
/// Kinds of packets.
const INDEX_PACKET: u8 = 0;
const DATA_PACKET: u8 = 1;
const IGNORED_PACKET: u8 = 2;
/// A grid of more than so many places a point is no camera's.
const MOST_PLACES: usize = 16;
/// Bytes behind a stream, so that its last number can be read as the others are.
const PADDING: usize = 16;

pub(super) fn read(path: &Path) -> Result<Points, Error> {
    let bytes = files::bytes(path)?;
    let scans = scans(&bytes, path)?;
    let pages = content(&bytes);
    drop(bytes);
    let counts = scans.iter().map(|s| usize::try_from(s.records).unwrap_or(usize::MAX));
    let total = counts.fold(0, usize::saturating_add);
    check_count(total, "points", 0, 0, path)?;
    let mut all = Points { xyz: vec![], grid: None };
    for scan in &scans {
        let found = points(scan, &pages, path)?;
        // alone, a scan stays in the frame of its camera; several meet where their poses put them
        if scans.len() == 1 {
            return Ok(in_grid(found));
        }
        let pose = pose(scan, path)?;
        all.xyz.extend(found.xyz.into_iter().map(|p| moved(p, &pose)));
    }
    Ok(all)
}

/// The scans that the XML part lists. All checksums are right.
fn scans(bytes: &[u8], path: &Path) -> Result<Vec<PointCloud>, Error> {
    let broken = |e: e57::Error| {
        let what = format!("cannot be read as E57 ({e})");
        malformed(Place::file(path), what, "copy or record it again")
    };
    let read = || {
        E57Reader::validate_crc(Cursor::new(bytes))?;
        Ok(E57Reader::new(Cursor::new(bytes))?.pointclouds())
    };
    // A header that the crate did not foresee must not end the program: its panics end here.
    catch_unwind(AssertUnwindSafe(read))
        .unwrap_or_else(|_| e57::Error::invalid("its header is damaged"))
        .map_err(broken)
}

/// The file without the checksums of its pages.
fn content(bytes: &[u8]) -> Vec<u8> {
    bytes.chunks_exact(PAGE).flat_map(|page| &page[..PAGE_CONTENT]).copied().collect()
}

/// Where a place of the file lies in its content.
fn in_content(place: u64) -> Option<usize> {
    let place = usize::try_from(place).ok()?;
    Some(place - place / PAGE * (PAGE - PAGE_CONTENT))
}

// ---------------------------------------------------------------- points of one scan

/// The points of a scan, and the row and column of each where the file tells them.
struct Found {
    xyz: Vec<[f32; 3]>,
    pixels: Option<Vec<[i64; 2]>>,
}

/// What a scan's packets hold of its points.
struct Streams<'a> {
    records: &'a [Record],
    /// The bits of each record, where they are wanted.
    bits: Vec<Vec<u8>>,
    count: usize,
}

fn points(scan: &PointCloud, pages: &[u8], path: &Path) -> Result<Found, Error> {
    let wrong = |what: &str| malformed(Place::file(path), what, "export it as E57 again");
    let at = |name: RecordName| scan.prototype.iter().position(|r| r.name == name);
    let all = |names: [RecordName; 3]| {
        let [a, b, c] = names.map(at);
        Some([a?, b?, c?])
    };
    let cartesian = all([RecordName::CartesianX, RecordName::CartesianY, RecordName::CartesianZ]);
    let spherical = all([
        RecordName::SphericalRange,
        RecordName::SphericalAzimuth,
        RecordName::SphericalElevation,
    ]);
    let (place, is_spherical) = match (cartesian, spherical) {
        (Some(place), _) => (place, false),
        (None, Some(place)) => (place, true),
        (None, None) => return Err(wrong("its points have neither x, y, z nor range and angles")),
    };
    let state = if is_spherical {
        at(RecordName::SphericalInvalidState)
    } else {
        at(RecordName::CartesianInvalidState)
    };
    let pixel = at(RecordName::RowIndex).zip(at(RecordName::ColumnIndex));
    let mut wanted = place.to_vec();
    wanted.extend(state);
    wanted.extend(pixel.map(|(row, column)| [row, column]).into_iter().flatten());
    let streams = streams(scan, &wanted, pages, path)?;
    let xyz = (0..streams.count).map(|i| {
        let [a, b, c] = place.map(|k| streams.number(k, i));
        let is_seen = state.is_none_or(|k| streams.number(k, i) == 0.0);
        let point = if is_spherical { from_angles(a, b, c) } else { [a, b, c] };
        in_metres(if is_seen { point } else { [f64::NAN; 3] }, LengthUnit::Metre)
    });
    let pixels = pixel.map(|(row, column)| {
        let at = |i| [row, column].map(|k| streams.number(k, i) as i64);
        (0..streams.count).map(at).collect()
    });
    Ok(Found { xyz: xyz.collect(), pixels })
}

/// From a range and the angles in the plane of x and y and above it.
fn from_angles(range: f64, azimuth: f64, elevation: f64) -> [f64; 3] {
    let flat = range * elevation.cos();
    [flat * azimuth.cos(), flat * azimuth.sin(), range * elevation.sin()]
}

/// Gathers the wanted streams of all packets.
fn streams<'a>(
    scan: &'a PointCloud,
    wanted: &[usize],
    pages: &[u8],
    path: &Path,
) -> Result<Streams<'a>, Error> {
    let count = usize::try_from(scan.records).unwrap_or(usize::MAX);
    let cut = || cut_short(count, "points", path);
    let all_bits: usize = scan.prototype.iter().map(|r| width(&r.data_type)).sum();
    // points of constants alone would take no bytes, and could be any number
    if count > 0 && (all_bits == 0 || count.saturating_mul(all_bits) / 8 > pages.len()) {
        return Err(cut());
    }
    let mut streams =
        Streams { records: &scan.prototype, bits: vec![vec![]; scan.prototype.len()], count };
    let needed: Vec<usize> =
        wanted.iter().map(|k| (count * width(&scan.prototype[*k].data_type)).div_ceil(8)).collect();
    let mut at = first_packet(scan, pages).ok_or_else(cut)?;
    while wanted.iter().zip(&needed).any(|(k, bytes)| streams.bits[*k].len() < *bytes) {
        at = packet(&mut streams, wanted, pages, at).ok_or_else(cut)?;
    }
    for stream in &mut streams.bits {
        stream.extend([0; PADDING]);
    }
    Ok(streams)
}

fn first_packet(scan: &PointCloud, pages: &[u8]) -> Option<usize> {
    let start = in_content(scan.file_offset)?;
    let header = pages.get(start..start.checked_add(SECTION_HEADER)?)?;
    let place = header[FIRST_PACKET..FIRST_PACKET + 8].try_into().ok()?;
    in_content(u64::from_le_bytes(place))
}

/// Takes the wanted streams of the packet at a place; where the next one begins.
fn packet(streams: &mut Streams, wanted: &[usize], pages: &[u8], at: usize) -> Option<usize> {
    let rest = pages.get(at..)?;
    let number =
        |at: usize| Some(usize::from(u16::from_le_bytes(rest.get(at..at + 2)?.try_into().ok()?)));
    let length = number(PACKET_LENGTH)? + 1;
    let records = streams.records.len();
    match *rest.first()? {
        INDEX_PACKET | IGNORED_PACKET => {}
        DATA_PACKET if number(STREAM_COUNT)? == records => {
            let mut start = STREAM_LENGTHS + 2 * records;
            for k in 0..records {
                let stop = start + number(STREAM_LENGTHS + 2 * k)?;
                let bits = rest.get(start..stop).filter(|_| stop <= length)?;
                if wanted.contains(&k) {
                    streams.bits[k].extend_from_slice(bits);
                }
                start = stop;
            }
        }
        _ => return None,
    }
    Some((at + length).next_multiple_of(4))
}

/// Bits of a number.
fn width(kind: &RecordDataType) -> usize {
    match kind {
        RecordDataType::Single { .. } => 32,
        RecordDataType::Double { .. } => 64,
        RecordDataType::ScaledInteger { min, max, .. } | RecordDataType::Integer { min, max } => {
            let range = (i128::from(*max) - i128::from(*min)).max(0) as u128;
            (u128::BITS - range.leading_zeros()) as usize
        }
    }
}

impl Streams<'_> {
    /// Number `i` of a record.
    #[inline(always)]
    fn number(&self, record: usize, i: usize) -> f64 {
        let kind = &self.records[record].data_type;
        match kind {
            RecordDataType::Single { .. } => f32::from_bits(self.raw(record, i, 32) as u32).into(),
            RecordDataType::Double { .. } => f64::from_bits(self.raw(record, i, 64)),
            RecordDataType::Integer { min, .. } => {
                min.wrapping_add(self.raw(record, i, width(kind)) as i64) as f64
            }
            RecordDataType::ScaledInteger { min, scale, offset, .. } => {
                let whole = min.wrapping_add(self.raw(record, i, width(kind)) as i64);
                whole as f64 * scale + offset
            }
        }
    }

    /// The bits of number `i`, the lowest first.
    #[inline(always)]
    fn raw(&self, record: usize, i: usize, width: usize) -> u64 {
        let first = i * width;
        let mut bytes = [0; PADDING];
        bytes.copy_from_slice(&self.bits[record][first / 8..first / 8 + PADDING]);
        let bits = (u128::from_le_bytes(bytes) >> (first % 8)) as u64;
        if width == 64 { bits } else { bits & ((1 << width) - 1) }
    }
}

// ---------------------------------------------------------------- grids and poses

/// Puts the points of one scan into the rows and columns of its camera. Where two points share a place,
/// or hardly any place has one, they are no camera's, and stay a list.
fn in_grid(found: Found) -> Points {
    let (count, list) = (found.xyz.len(), Points { xyz: vec![], grid: None });
    let grid = found.pixels.as_deref().and_then(|pixels| size(pixels, count).zip(Some(pixels)));
    let Some((([top, left], [height, width]), pixels)) = grid else {
        return Points { xyz: found.xyz, ..list };
    };
    let mut xyz = vec![[f32::NAN; 3]; width * height];
    let mut is_taken = vec![false; width * height];
    for (point, [row, column]) in found.xyz.iter().zip(pixels) {
        let at = (row - top) as usize * width + (column - left) as usize;
        if is_taken[at] {
            return Points { xyz: found.xyz, ..list };
        }
        (xyz[at], is_taken[at]) = (*point, true);
    }
    Points { xyz, grid: Some((width, height)) }
}

/// First row and column, and how many there are of either; `None` of too many for so many points.
fn size(pixels: &[[i64; 2]], count: usize) -> Option<([i64; 2], [usize; 2])> {
    let ends = [0, 1].map(|k| {
        let all = || pixels.iter().map(|p| p[k]);
        Some((all().min()?, all().max()?))
    });
    let [(top, bottom), (left, right)] = [ends[0]?, ends[1]?];
    let lengths = [(top, bottom), (left, right)]
        .map(|(low, high)| usize::try_from(high.checked_sub(low)?.checked_add(1)?).ok());
    let [height, width] = [lengths[0]?, lengths[1]?];
    let places = width.checked_mul(height)?;
    let fits = places <= count.saturating_mul(MOST_PLACES) && height > 1 && width > 1;
    fits.then_some(([top, left], [height, width]))
}

/// Where a scan's frame lies in that of the file.
fn pose(scan: &PointCloud, path: &Path) -> Result<Isometry3<f64>, Error> {
    let Some(pose) = &scan.transform else { return Ok(Isometry3::identity()) };
    let (t, q) = (&pose.translation, &pose.rotation);
    let rotation = UnitQuaternion::try_new(Quaternion::new(q.w, q.x, q.y, q.z), f64::EPSILON);
    let translation = Translation3::new(t.x, t.y, t.z);
    rotation
        .map(|rotation| Isometry3::from_parts(translation, rotation))
        .filter(|pose| pose.to_homogeneous().iter().all(|x| x.is_finite()))
        .ok_or_else(|| {
            malformed(
                Place::file(path),
                "the pose of one of its scans is no pose",
                "export it as E57 again",
            )
        })
}

fn moved(point: [f32; 3], pose: &Isometry3<f64>) -> [f32; 3] {
    let moved = pose.transform_point(&point.map(f64::from).into());
    [moved.x as f32, moved.y as f32, moved.z as f32]
}
