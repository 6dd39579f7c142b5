//! ZDF, the files of Zivid's cameras: netCDF-4, which is HDF5, with `data/pointcloud` of height x width x 3
//! numbers in millimetres, NaN where nothing was seen.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use hdf5_reader::{Hdf5File, OpenOptions};

use super::{Points, in_metres};
use crate::{
    error::{Error, Place, malformed},
    files,
    records::{check_count, cut_short},
    units::LengthUnit,
};

/// The array of points.
const POINTS: &str = "data/pointcloud";
/// One byte of deflated data makes at most so many (zlib, "Technical Details").
const MOST_EXPANSION: usize = 1032;
/// Bytes of a point.
const BYTES: usize = 12;
/// Largest part that is packed on its own, bytes: cameras write less than a tenth.
const LARGEST_CHUNK: usize = 256 << 20;

pub(super) fn read(path: &Path) -> Result<Points, Error> {
    let bytes = files::bytes(path)?;
    // HDF5 is large, and read by a library: a panic of it on some broken file must not end the program.
    catch_unwind(AssertUnwindSafe(|| unpacked(bytes, path))).unwrap_or_else(|_| {
        Err(malformed(Place::file(path), "is damaged beyond reading", "copy or record it again"))
    })
}

fn unpacked(bytes: Vec<u8>, path: &Path) -> Result<Points, Error> {
    let broken = |e: hdf5_reader::error::Error| {
        let what = format!("cannot be read as ZDF ({e})");
        malformed(Place::file(path), what, "copy or record it again")
    };
    let most = bytes.len().saturating_mul(MOST_EXPANSION);
    let limits = OpenOptions::default()
        .with_max_chunk_bytes(most.min(LARGEST_CHUNK))
        .with_max_read_bytes(most);
    let file = Hdf5File::from_vec_with_options(bytes, limits).map_err(broken)?;
    let array = file.dataset(POINTS).map_err(broken)?;
    let [height, width, 3] = *array.shape() else {
        return Err(malformed(
            Place::file(path),
            format!("{POINTS} of shape {:?} is no scan", array.shape()),
            "it should be height x width x 3",
        ));
    };
    let count = width.saturating_mul(height).try_into().unwrap_or(usize::MAX);
    check_count(count, "points", 0, 0, path)?;
    if count.saturating_mul(BYTES) > most {
        return Err(cut_short(count, "points", path));
    }
    let mut xyz = vec![[0f32; 3]; count];
    array.read_into(xyz.as_flattened_mut()).map_err(broken)?;
    for point in &mut xyz {
        *point = in_metres(point.map(f64::from), LengthUnit::Millimetre);
    }
    Ok(Points { xyz, grid: Some((width as usize, height as usize)) })
}
