//! Scans in NumPy files: height x width x 3 (or N x 3) points, or height x width depth.

use std::path::Path;

use handeye::Scan;

use super::{Points, ScanOptions, depth, in_metres, of_points, unit};
use crate::{
    error::{Error, Place, malformed},
    files,
    image::check_size,
    npy::{Archive, Array},
};

/// Usual names of the array in an `.npz`.
const NAMES: [&str; 7] = ["points", "xyz", "point_cloud", "pointcloud", "cloud", "depth", "arr_0"];

pub(super) fn read(path: &Path, options: &ScanOptions) -> Result<Scan, Error> {
    let array = array(path)?;
    match array.shape[..] {
        [height, width, 3] => points(&array, Some((width, height)), options, path),
        [_, 3] => points(&array, None, options, path),
        [height, width] => {
            check_size(width as u64, height as u64, path)?;
            let integer = array.is_integer();
            depth::scan(
                &depth::Depth { width, height, values: array.values(), integer },
                options,
                path,
            )
        }
        _ => Err(malformed(
            Place::file(path),
            format!("an array of shape {:?} is no scan", array.shape),
            "points are height x width x 3, depth is height x width",
        )),
    }
}

fn array(path: &Path) -> Result<Array, Error> {
    if files::extension(path) == "npy" { Array::read(path) } else { named(path) }
}

/// Width and height, of an array with rows and columns.
pub(super) fn size(path: &Path) -> Result<Option<(u32, u32)>, Error> {
    Ok(match array(path)?.shape[..] {
        [_, 3] => None,
        [height, width] | [height, width, 3] => {
            u32::try_from(width).ok().zip(u32::try_from(height).ok())
        }
        _ => None,
    })
}

fn points(
    array: &Array,
    grid: Option<(usize, usize)>,
    options: &ScanOptions,
    path: &Path,
) -> Result<Scan, Error> {
    let unit = unit(options, path)?;
    let values = array.values();
    let xyz = values.chunks_exact(3).map(|p| in_metres([p[0], p[1], p[2]], unit)).collect();
    of_points(Points { xyz, grid }, options, path)
}

fn named(path: &Path) -> Result<Array, Error> {
    let archive = Archive::read(path)?;
    let names: Vec<&str> = archive.names().collect();
    let name = NAMES.into_iter().find(|n| names.contains(n)).or(match names[..] {
        [only] => Some(only),
        _ => None,
    });
    name.and_then(|n| archive.array(n)).unwrap_or_else(|| {
        Err(malformed(
            Place::file(path),
            format!("none of its arrays ({}) is known as a scan", names.join(", ")),
            format!("name it {}", NAMES.join(", ")),
        ))
    })
}
