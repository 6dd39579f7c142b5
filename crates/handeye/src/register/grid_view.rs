//! Where in an organised scan a point would be seen.
//!
//! The grid itself tells: over all windows, column and row are affine in `x/z` and `y/z`, but for the
//! lens' distortion. A second look from the window that was found takes that out.

use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

use super::patch::Patch;

/// From directions to columns and rows of windows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GridView {
    linear: Matrix2<f64>,
    offset: Vector2<f64>,
    /// Columns and rows.
    size: (usize, usize),
}

/// A grid of which the directions are off by more than this many windows (RMS) is no camera's.
const FARTHEST: f64 = 2.0;

impl GridView {
    /// `None` where the grid is not that of a camera at the origin.
    pub fn of(patches: &[Option<Patch>], size: (usize, usize)) -> Option<Self> {
        let columns = size.0;
        let all = || {
            patches.iter().enumerate().filter_map(move |(k, patch)| {
                let patch = patch.as_ref().filter(|p| p.mean.z > 0.0)?;
                let at = Vector2::new((k % columns) as f64, (k / columns) as f64);
                Some((direction(&patch.mean).push(1.0), at))
            })
        };
        let (mut normal, mut right) = (Matrix3::zeros(), Matrix3x2::zeros());
        for (d, at) in all() {
            normal += d * d.transpose();
            right += d * at.transpose();
        }
        let solution = normal.try_inverse()? * right;
        let linear = solution.fixed_rows::<2>(0).transpose();
        let view = Self { linear, offset: solution.row(2).transpose(), size };
        let (mut sum, mut count) = (0.0, 0.0);
        for (d, at) in all() {
            sum += (view.linear * d.xy() + view.offset - at).norm_squared();
            count += 1.0;
        }
        (sum < FARTHEST * FARTHEST * count).then_some(view)
    }

    /// The window that has the point's direction.
    #[inline]
    pub fn find(&self, patches: &[Option<Patch>], p: &Vector3<f64>) -> Option<usize> {
        if p.z <= 0.0 {
            return None;
        }
        let d = direction(p);
        let at = self.linear * d + self.offset;
        let k = self.index(&at)?;
        let Some(patch) = &patches[k] else { return None };
        let columns = self.size.0;
        let here = Vector2::new((k % columns) as f64, (k / columns) as f64);
        let beside = here + self.linear * (d - direction(&patch.mean));
        self.index(&beside).filter(|k| patches[*k].is_some())
    }

    #[inline(always)]
    fn index(&self, at: &Vector2<f64>) -> Option<usize> {
        let (x, y) = (at.x + 0.5, at.y + 0.5);
        let (columns, rows) = self.size;
        let inside = x >= 0.0 && y >= 0.0 && x < columns as f64 && y < rows as f64;
        inside.then(|| y as usize * columns + x as usize)
    }
}

#[inline(always)]
fn direction(p: &Vector3<f64>) -> Vector2<f64> {
    p.xy() / p.z
}
