//! Corners on arbitrary scans.

use handeye::{ImageCorner, Intrinsics, Scan, detect};
use nalgebra::{Matrix2, Vector2};

/// Bytes are metres, in steps of which some are missing and some are far.
fn metres(byte: u8) -> f32 {
    match byte {
        255 => f32::NAN,
        254 => f32::INFINITY,
        253 => 1e30,
        other => 0.5 + f32::from(other) * 1e-3,
    }
}

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let [width, organised, depths @ ..] = data else { return };
    let width = usize::from(*width).max(1);
    let height = depths.len() / width;
    let point = |(k, d): (usize, &u8)| {
        let z = metres(*d);
        [0.02 * (k % width) as f32 * z, 0.02 * (k / width) as f32 * z, z]
    };
    let points: Vec<[f32; 3]> = depths[..width * height].iter().enumerate().map(point).collect();
    let (columns, rows) = if organised % 2 == 0 { (width, height) } else { (width * height, 1) };
    let Some(scan) = Scan::new(columns, rows, points) else { return };
    let corner = |id: u32| ImageCorner {
        id,
        pixel: Vector2::new(f64::from(id % 5) * 4.0, f64::from(id / 5) * 4.0),
        covariance: Matrix2::identity() * 1e-4,
    };
    let corners: Vec<ImageCorner> = (0..20).map(corner).collect();
    let camera = Intrinsics::pinhole(width as u32, height as u32, 50.0, 50.0, 0.0, 0.0);
    for intrinsics in [None, Some(&camera)] {
        let (found, missing) = detect::lift(&corners, (width, height), &scan, intrinsics);
        assert_eq!(found.len() + missing.len(), corners.len());
        for corner in found {
            assert!(corner.covariance.iter().all(|x| x.is_finite()));
        }
    }
}
