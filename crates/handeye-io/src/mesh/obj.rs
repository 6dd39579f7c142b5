//! Wavefront OBJ: lines `v x y z` and `f 1 2 3`, where a corner may also be `1/2`, `1/2/3` or `1//3`, and
//! numbers below zero count from the last vertex. All else is skipped. Wavefront Technologies, "Object
//! Files", 1995.

use std::path::Path;

use super::{Fans, Parts, in_metres};
use crate::{
    error::{Error, Place, malformed},
    files,
    records::{MOST_POINTS, check_count},
    units::LengthUnit,
};

pub(super) fn read(path: &Path, unit: LengthUnit) -> Result<Parts, Error> {
    let bytes = files::bytes(path)?;
    let (mut vertices, mut fans) = (Vec::new(), Fans::default());
    for (i, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let wrong =
            |what: String| malformed(Place::line(path, i + 1), what, "export it as OBJ again");
        let line = line.split(|b| *b == b'#').next().unwrap_or_default();
        let mut words = line.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty());
        match words.next() {
            Some(b"v") => {
                let mut number = || std::str::from_utf8(words.next()?).ok()?.parse().ok();
                let (Some(x), Some(y), Some(z)) = (number(), number(), number()) else {
                    return Err(wrong("a vertex without three numbers".into()));
                };
                vertices.push(in_metres([x, y, z], unit));
            }
            Some(b"f") => {
                fans.begin();
                for word in words {
                    let corner = corner(word, vertices.len()).ok_or_else(|| {
                        let word = String::from_utf8_lossy(&word[..word.len().min(32)]);
                        wrong(format!("a face with a corner \"{word}\""))
                    })?;
                    if fans.corner(corner).is_none() {
                        check_count(MOST_POINTS + 1, "triangles", 0, 0, path)?;
                    }
                }
            }
            _ => {}
        }
    }
    check_count(vertices.len(), "vertices", 0, 0, path)?;
    Ok(Parts { vertices, triangles: fans.triangles })
}

/// The vertex of a face's corner, from 0; so many vertices stand before it.
fn corner(word: &[u8], before: usize) -> Option<u32> {
    let vertex = word.split(|b| *b == b'/').next()?;
    let number: i64 = std::str::from_utf8(vertex).ok()?.parse().ok()?;
    let at = if number < 0 { number.checked_add(before as i64)? } else { number - 1 };
    u32::try_from(at).ok()
}
