//! STL: triangles with corners of their own, in binary or text. 3D Systems, "StereoLithography Interface
//! Specification", 1988. Corners that are equal to the bit become one vertex.

use std::{collections::HashMap, path::Path};

use foldhash::fast::RandomState;

use super::{Parts, in_metres};
use crate::{
    error::{Error, Place, malformed},
    files,
    records::{check_count, cut_short},
    units::LengthUnit,
};

/// A title, then the number of triangles.
const HEADER: usize = 84;
/// Where that number stands.
const COUNT: usize = 80;
/// A normal, three corners, and two bytes of attributes.
const TRIANGLE: usize = 50;
/// Where the first corner stands.
const CORNERS: usize = 12;

pub(super) fn read(path: &Path, unit: LengthUnit) -> Result<Parts, Error> {
    let bytes = files::bytes(path)?;
    match promised(&bytes) {
        // programs begin binary files with "solid", too: their length tells them from text
        Some(count) if bytes.len() == size(count) || !is_text(&bytes) => {
            binary(&bytes, count, unit, path)
        }
        None if !is_text(&bytes) => {
            Err(malformed(Place::file(path), "is no STL file", "export it as STL again"))
        }
        _ => text(&bytes, unit, path),
    }
}

/// The number of triangles of a binary file.
fn promised(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(COUNT..HEADER)?.try_into().ok()?;
    Some(u32::from_le_bytes(count) as usize)
}

fn size(count: usize) -> usize {
    HEADER.saturating_add(count.saturating_mul(TRIANGLE))
}

fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid")
}

/// Corners that become vertices, each place once. They are numbered as they come: how they are found
/// again decides nothing.
#[derive(Default)]
struct Corners {
    numbers: HashMap<u128, u32, RandomState>,
    places: Vec<[f32; 3]>,
}

impl Corners {
    /// Room for the vertices of so many triangles: of a closed surface they are half as many.
    fn with_room(triangles: usize) -> Self {
        let (numbers, places) = (HashMap::default(), vec![]);
        let mut corners = Self { numbers, places };
        corners.numbers.reserve(triangles / 2);
        corners
    }

    #[inline(always)]
    fn number(&mut self, place: [f32; 3]) -> u32 {
        let [x, y, z] = place.map(|x| u128::from(x.to_bits()));
        *self.numbers.entry(x | y << 32 | z << 64).or_insert_with(|| {
            self.places.push(place);
            (self.places.len() - 1) as u32
        })
    }

    fn in_metres(self, unit: LengthUnit) -> Vec<[f32; 3]> {
        self.places.into_iter().map(|p| in_metres(p.map(f64::from), unit)).collect()
    }
}

fn binary(bytes: &[u8], count: usize, unit: LengthUnit, path: &Path) -> Result<Parts, Error> {
    check_count(count, "triangles", TRIANGLE, bytes.len() - HEADER, path)?;
    let mut corners = Corners::with_room(count);
    let mut triangles = Vec::with_capacity(count);
    for record in bytes[HEADER..].chunks_exact(TRIANGLE).take(count) {
        let number = |at: usize| {
            let raw = &record[CORNERS + 4 * at..];
            f32::from_le_bytes([raw[0], raw[1], raw[2], raw[3]])
        };
        let corner = |k: usize| [number(3 * k), number(3 * k + 1), number(3 * k + 2)];
        triangles.push([0, 1, 2].map(|k| corners.number(corner(k))));
    }
    Ok(Parts { vertices: corners.in_metres(unit), triangles })
}

/// Three lines `vertex x y z` between `outer loop` and `endloop`, up to `endsolid`.
fn text(bytes: &[u8], unit: LengthUnit, path: &Path) -> Result<Parts, Error> {
    let mut corners = Corners::default();
    let (mut triangles, mut facet, mut is_whole) = (vec![], vec![], false);
    for (i, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let wrong =
            |what: String| malformed(Place::line(path, i + 1), what, "export it as STL again");
        let mut words = line.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty());
        let Some(first) = words.next() else { continue };
        if first.eq_ignore_ascii_case(b"vertex") {
            let mut number = || std::str::from_utf8(words.next()?).ok()?.parse().ok();
            let (Some(x), Some(y), Some(z)) = (number(), number(), number()) else {
                return Err(wrong("a vertex without three numbers".into()));
            };
            facet.push(corners.number([x, y, z]));
        } else if first.eq_ignore_ascii_case(b"endloop") {
            let corners = facet.as_slice().try_into();
            triangles
                .push(corners.map_err(|_| wrong(format!("a facet of {} corners", facet.len())))?);
            facet.clear();
        }
        is_whole = first.eq_ignore_ascii_case(b"endsolid");
    }
    if !is_whole {
        return Err(malformed(
            Place::file(path),
            "is cut short: its last line is not endsolid",
            "copy or export it again",
        ));
    }
    if !facet.is_empty() {
        return Err(cut_short(triangles.len() + 1, "facets", path));
    }
    Ok(Parts { vertices: corners.in_metres(unit), triangles })
}
