//! Scans of 3D cameras: points in PLY, PCD, E57, ZDF and text, depth in PNG and TIFF, either in NPY and NPZ.

mod depth;
#[cfg(feature = "e57")]
mod e57;
mod numpy;
mod pcd;
mod ply;
mod text;
#[cfg(feature = "netcdf")]
mod zdf;

use std::path::Path;

use handeye::{Intrinsics, Scan};

use crate::{
    error::{Error, Place, malformed, undeclared},
    files,
    image::image_size,
    units::LengthUnit,
};

/// What a scan's file does not say.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ScanOptions {
    /// Unit of the coordinates of points, where the file or its format does not say it.
    pub length_unit: Option<LengthUnit>,
    /// Metres per unit of depth.
    pub depth_scale: Option<f64>,
    /// Width and height of the camera's grid of points.
    pub organised: Option<(usize, usize)>,
    /// Intrinsics of the depth image.
    pub intrinsics: Option<Intrinsics>,
}

/// What a file holds, in metres.
struct Points {
    xyz: Vec<[f32; 3]>,
    grid: Option<(usize, usize)>,
}

/// Reads a scan into metres; points at the origin, and depths of 0, are missing. An E57 file of one scan
/// has its points in the frame of its camera, one of several in that of the file, where their poses put
/// them.
///
/// # Errors
/// What is no scan, is cut short or empty, or needs a unit, scale or intrinsics that are not given.
pub fn read_scan(path: &Path, options: &ScanOptions) -> Result<Scan, Error> {
    match files::extension(path).as_str() {
        "ply" => of_points(ply::read(path, unit(options, path)?)?, options, path),
        "pcd" => of_points(pcd::read(path, unit(options, path)?)?, options, path),
        "xyz" | "txt" | "csv" | "asc" | "pts" => {
            of_points(text::read(path, options)?, options, path)
        }
        #[cfg(feature = "e57")]
        "e57" => of_points(e57::read(path)?, options, path),
        #[cfg(not(feature = "e57"))]
        "e57" => Err(crate::error::not_built_in(path, "E57", "e57")),
        #[cfg(feature = "netcdf")]
        "zdf" => of_points(zdf::read(path)?, options, path),
        #[cfg(not(feature = "netcdf"))]
        "zdf" => Err(crate::error::not_built_in(path, "ZDF", "netcdf")),
        "npy" | "npz" => numpy::read(path, options),
        "png" | "tif" | "tiff" => depth::read(path, options),
        other => Err(malformed(
            Place::file(path),
            format!("scans of kind \".{other}\" cannot be read"),
            "PLY, PCD, E57, ZDF, XYZ, TXT, CSV, ASC, PTS, NPY, NPZ, and depth in PNG and TIFF can; export one of \
             them",
        )),
    }
}

/// The unit of the points, where the file or its format says it. It needs no declaration then.
pub fn scan_unit(path: &Path) -> Option<LengthUnit> {
    match files::extension(path).as_str() {
        "e57" => Some(LengthUnit::Metre),
        "zdf" => Some(LengthUnit::Millimetre),
        "xyz" | "txt" | "csv" | "asc" | "pts" => text::unit_said(path),
        _ => None,
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
