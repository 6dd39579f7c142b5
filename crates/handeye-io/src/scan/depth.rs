//! Depth images: 16-bit PNG, and TIFF of whole or 32-bit floating-point numbers.

use std::{io::Cursor, path::Path};

use handeye::Scan;
use image::DynamicImage;
use tiff::decoder::{Decoder, DecodingResult, Limits};

use super::{ScanOptions, with_points};
use crate::{
    error::{Error, Place, malformed, undeclared},
    files,
    image::{check_size, decode},
};

/// A depth image as a file has it.
pub(super) struct Depth {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f64>,
    /// Whole numbers mean nothing without a scale.
    pub(super) integer: bool,
}

pub(super) fn read(path: &Path, options: &ScanOptions) -> Result<Scan, Error> {
    let depth = if files::extension(path) == "png" { png(path)? } else { tiff(path)? };
    scan(&depth, options, path)
}

/// Depth along the optical axis as points of the camera.
pub(super) fn scan(depth: &Depth, options: &ScanOptions, path: &Path) -> Result<Scan, Error> {
    let camera = options.intrinsics.ok_or_else(|| {
        undeclared(path, "[scans.camera]", "which intrinsics has the depth image? (or [camera])")
    })?;
    let scale = match options.depth_scale.or(options.length_unit.map(|u| u.metres())) {
        Some(scale) if scale.is_finite() && scale > 0.0 => scale,
        Some(scale) => {
            let what = format!("depth_scale = {scale}");
            return Err(malformed(Place::file(path), what, "give the metres per unit of depth"));
        }
        None => {
            let kind = if depth.integer { "whole numbers" } else { "numbers" };
            let question =
                format!("how many metres is one unit of its {kind}? (0.001 for millimetres)");
            return Err(undeclared(path, "depth_scale", &question));
        }
    };
    let metres: Vec<f32> = depth.values.iter().map(|v| (v * scale) as f32).collect();
    let sized = (camera.width as usize, camera.height as usize) == (depth.width, depth.height);
    let scan = Scan::from_depth(&metres, &camera).filter(|_| sized).ok_or_else(|| {
        malformed(
            Place::file(path),
            format!(
                "the depth image has {} x {} pixels, its intrinsics {} x {}",
                depth.width, depth.height, camera.width, camera.height
            ),
            "give the depth image's own intrinsics in [scans.camera]",
        )
    })?;
    with_points(scan, path)
}

fn png(path: &Path) -> Result<Depth, Error> {
    let DynamicImage::ImageLuma16(picture) = decode(path)? else {
        return Err(malformed(
            Place::file(path),
            "is no depth image: it is not grey with 16 bits",
            "save depth as a 16-bit grey PNG",
        ));
    };
    Ok(Depth {
        width: picture.width() as usize,
        height: picture.height() as usize,
        values: picture.as_raw().iter().map(|v| f64::from(*v)).collect(),
        integer: true,
    })
}

fn tiff(path: &Path) -> Result<Depth, Error> {
    let bytes = files::bytes(path)?;
    let broken = |e: tiff::TiffError| {
        let what = format!("the TIFF cannot be decoded ({e})");
        malformed(Place::file(path), what, "copy or record it again")
    };
    let mut limits = Limits::default();
    limits.decoding_buffer_size = 8 * crate::image::MOST_PIXELS as usize;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(broken)?.with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(broken)?;
    check_size(width.into(), height.into(), path)?;
    let (values, integer): (Vec<f64>, bool) = match decoder.read_image().map_err(broken)? {
        DecodingResult::F32(v) => (v.into_iter().map(f64::from).collect(), false),
        DecodingResult::F64(v) => (v, false),
        DecodingResult::U16(v) => (v.into_iter().map(f64::from).collect(), true),
        DecodingResult::U32(v) => (v.into_iter().map(f64::from).collect(), true),
        _ => (vec![], true),
    };
    if values.len() != width as usize * height as usize {
        return Err(malformed(
            Place::file(path),
            "is no depth image: it has not one number of 16 or 32 bits per pixel",
            "save depth as 32-bit floating-point or 16-bit grey TIFF",
        ));
    }
    Ok(Depth { width: width as usize, height: height as usize, values, integer })
}
