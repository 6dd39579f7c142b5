//! Images and scans as cameras write them.

use std::io::Cursor;

use handeye::{GrayImage, Scan};
use image::{ExtendedColorType, ImageEncoder, codecs::png};

use super::ScanFormat;

/// Metres per unit of the depth images: 0.1 mm, up to 6.5 m.
pub(super) const DEPTH_SCALE: f64 = 1e-4;

/// A grey image as the bytes of a PNG file.
pub fn picture(image: &GrayImage) -> Vec<u8> {
    png_of(
        &image.to_u8(),
        (image.width(), image.height()),
        ExtendedColorType::L8,
        png::FilterType::NoFilter,
    )
}

fn depth(scan: &Scan) -> Vec<u8> {
    let unit = |p: &[f32; 3]| (f64::from(p[2]) / DEPTH_SCALE).round().clamp(0.0, 65535.0) as u16;
    // NaN becomes 0: nothing seen
    let bytes: Vec<u8> = scan.points().iter().flat_map(|p| unit(p).to_ne_bytes()).collect();
    png_of(&bytes, (scan.width(), scan.height()), ExtendedColorType::L16, png::FilterType::Adaptive)
}

/// Noise on flat fields is packed best unfiltered, slopes of depth as differences.
fn png_of(
    bytes: &[u8],
    (width, height): (usize, usize),
    colour: ExtendedColorType,
    filter: png::FilterType,
) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(&mut out, png::CompressionType::Best, filter);
    let written = encoder.write_image(bytes, width as u32, height as u32, colour);
    written.expect("an image of the size of its bytes, into memory");
    out.into_inner()
}

/// A scan as the bytes of an organised PLY file, metres.
pub fn cloud(of: &Scan) -> Vec<u8> {
    scan(of, ScanFormat::Ply)
}

/// A scan in the given format.
pub(super) fn scan(scan: &Scan, format: ScanFormat) -> Vec<u8> {
    match format {
        ScanFormat::DepthPng => depth(scan),
        ScanFormat::Ply => [ply_header(scan).into_bytes(), floats(scan)].concat(),
        ScanFormat::Pcd => [pcd_header(scan).into_bytes(), floats(scan)].concat(),
    }
}

/// x, y, z in metres, row by row; NaN where nothing was seen.
fn floats(scan: &Scan) -> Vec<u8> {
    scan.points().iter().flatten().flat_map(|x| x.to_le_bytes()).collect()
}

fn ply_header(scan: &Scan) -> String {
    format!(
        "ply\nformat binary_little_endian 1.0\nobj_info num_cols {}\nobj_info num_rows {}\n\
         element vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
        scan.width(),
        scan.height(),
        scan.points().len()
    )
}

fn pcd_header(scan: &Scan) -> String {
    format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n\
         TYPE F F F\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\n\
         DATA binary\n",
        scan.width(),
        scan.height(),
        scan.points().len()
    )
}
