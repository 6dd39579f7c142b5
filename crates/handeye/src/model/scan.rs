//! What a 3D camera measures in one shot: points in the camera frame.

use nalgebra::{Vector2, Vector3};

use crate::Intrinsics;

/// Points in the camera frame, in metres; NaN where the camera saw nothing. An organised scan has
/// one point per pixel, row by row; an unorganised one has height 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    width: usize,
    height: usize,
    points: Vec<[f32; 3]>,
}

impl Scan {
    /// From rows of points; `None` unless there are exactly `width * height` of them.
    pub fn new(width: usize, height: usize, points: Vec<[f32; 3]>) -> Option<Self> {
        (width.checked_mul(height) == Some(points.len())).then_some(Self { width, height, points })
    }

    /// From a depth image (m along the optical axis, row by row, 0 or NaN where nothing was seen).
    pub fn from_depth(depth: &[f32], intrinsics: &Intrinsics) -> Option<Self> {
        let (width, height) = (intrinsics.width as usize, intrinsics.height as usize);
        if depth.len() != width.checked_mul(height)? {
            return None;
        }
        let point = |(i, &z): (usize, &f32)| {
            let pixel = Vector2::new((i % width) as f64, (i / width) as f64);
            match intrinsics.undistort(&pixel) {
                Some(n) if z > 0.0 => [n.x as f32 * z, n.y as f32 * z, z],
                _ => [f32::NAN; 3],
            }
        };
        Self::new(width, height, depth.iter().enumerate().map(point).collect())
    }

    /// Points per row.
    pub fn width(&self) -> usize {
        self.width
    }
    /// Rows; 1 for an unorganised scan.
    pub fn height(&self) -> usize {
        self.height
    }
    /// One point per pixel of an image.
    pub(crate) fn is_organised(&self) -> bool {
        self.height > 1
    }
    /// All points, row by row.
    pub fn points(&self) -> &[[f32; 3]] {
        &self.points
    }
    /// The point of pixel `(x, y)`, m; `None` where nothing was seen.
    pub fn at(&self, x: usize, y: usize) -> Option<Vector3<f64>> {
        let [px, py, pz] = self.points[y * self.width + x];
        (px.is_finite() && py.is_finite() && pz.is_finite())
            .then(|| Vector3::new(px.into(), py.into(), pz.into()))
    }
}
