//! Scans that come with images: a file counts once it can be read as the settings say, and its points are where a camera can
//! see them.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{Scan, math::linalg::median};
use handeye_io::{ScanOptions, ScanSettings, read_scan};

use super::outlet::{StoredFile, Wanted};

/// Endings of scans.
const ENDINGS: [&str; 13] =
    ["ply", "pcd", "e57", "zdf", "xyz", "txt", "csv", "asc", "pts", "npy", "npz", "tif", "tiff"];
/// Endings of depth images, which need intrinsics to be read.
const DEPTH: [&str; 3] = ["png", "tif", "tiff"];
/// No 3D camera measures nearer or farther, m.
const NEAREST_M: f64 = 0.05;
const FARTHEST_M: f64 = 30.0;
/// Larger files are no scans of a camera, bytes.
const LARGEST: u64 = 1 << 30;

/// The scan in a file.
///
/// # Errors
/// What cannot be read as the settings say, and points that are nearer or farther than any camera sees.
pub fn read(path: &Path, wanted: &Wanted, settings: &ScanSettings) -> Result<StoredFile, String> {
    let ending = ending(path).unwrap_or_default();
    let length = fs::metadata(path).map_err(|e| format!("{}: {e}", path.display()))?.len();
    if length > LARGEST {
        return Err(format!("{} is no scan: it has {length} bytes", path.display()));
    }
    let options = ScanOptions {
        length_unit: settings.length_unit,
        depth_scale: settings.depth_scale,
        intrinsics: wanted.intrinsics,
        organised: None,
    };
    // what depth means without intrinsics is seen once they are known
    if wanted.intrinsics.is_some() || !DEPTH.contains(&&ending[..]) {
        let scan = read_scan(path, &options).map_err(|e| e.to_string())?;
        can_be(&scan).map_err(|why| format!("{}: {why}", path.display()))?;
    }
    let bytes = fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    match bytes.len() as u64 == length {
        true => Ok((ending, bytes.into())),
        false => Err(format!("{} is still being written", path.display())),
    }
}

/// Refuses points that no camera can see there: their unit is another one.
fn can_be(scan: &Scan) -> Result<(), String> {
    let middle = median(scan.points().iter().filter_map(distance));
    match (NEAREST_M..FARTHEST_M).contains(&middle) {
        true => Ok(()),
        false => Err(format!(
            "its points are {middle:.3} m away from the camera (median): is the unit of scans another one?"
        )),
    }
}

fn distance(point: &[f32; 3]) -> Option<f64> {
    let square: f32 = point.iter().map(|x| x * x).sum();
    square.is_finite().then(|| f64::from(square).sqrt())
}

/// The scan that lies beside an image: a file of the same name with the ending of a scan.
pub fn beside(image: &Path) -> Option<PathBuf> {
    let all = fs::read_dir(image.parent()?).ok()?.flatten().map(|entry| entry.path());
    let is_it = |path: &PathBuf| {
        let is_scan = ending(path).is_some_and(|ending| ENDINGS.contains(&&ending[..]));
        path != image && path.file_stem() == image.file_stem() && is_scan
    };
    all.filter(is_it).min()
}

/// The ending of a scan's name, in small letters.
fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    (ENDINGS.contains(&&ending[..]) || DEPTH.contains(&&ending[..])).then_some(ending)
}
