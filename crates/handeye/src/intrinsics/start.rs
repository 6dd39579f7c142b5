//! Cameras to start from: Zhang's closed form, and common lenses.

use nalgebra::{Matrix3, SMatrix, SVector, Vector2};

use super::LensModel;
use crate::{ImageCorner, Intrinsics, TargetModel, detect::homography};

/// Focal length of a common lens, in image widths: the start when there is no closed one.
const COMMON_FOCAL: f64 = 1.2;
/// Focal lengths of lenses that see more and more, in image widths.
const FISHEYE_FOCALS: [f64; 3] = [0.5, 0.33, 0.8];
/// Focal lengths outside of this range, in image widths, are no start.
const FOCAL_RANGE: (f64, f64) = (0.3, 10.0);

/// Zhang's closed form, if it gives a camera, and a common lens.
pub(super) fn starts(
    views: &[Vec<ImageCorner>],
    target: &TargetModel,
    width: u32,
    height: u32,
    lens: LensModel,
) -> Vec<Intrinsics> {
    let (w, h) = (f64::from(width), f64::from(height));
    let centre = Vector2::new(0.5 * (w - 1.0), 0.5 * (h - 1.0));
    let homographies: Vec<_> =
        views.iter().filter_map(|view| view_homography(view, target, &centre, w)).collect();
    let common = COMMON_FOCAL * w.max(h);
    let plain =
        |fx: f64, fy: f64, c: Vector2<f64>| Intrinsics::pinhole(width, height, fx, fy, c.x, c.y);
    let closed = zhang(&homographies).map(|(fx, fy, c)| plain(fx * w, fy * w, c * w + centre));
    let plausible = |c: &Intrinsics| {
        let range = FOCAL_RANGE.0 * w..FOCAL_RANGE.1 * w;
        range.contains(&c.fx)
            && range.contains(&c.fy)
            && (0.0..w).contains(&c.cx)
            && (0.0..h).contains(&c.cy)
    };
    let wide = FISHEYE_FOCALS.map(|share| plain(share * w, share * w, centre));
    let fisheye = wide.into_iter().filter(|_| lens == LensModel::KannalaBrandt);
    let of_lens = |camera: Intrinsics| Intrinsics { distortion: lens.plain(), ..camera };
    let all = closed.filter(plausible).into_iter().chain([plain(common, common, centre)]);
    fisheye.chain(all).map(of_lens).collect()
}

/// Homography from the target to pixels from the centre, in image widths.
fn view_homography(
    view: &[ImageCorner],
    target: &TargetModel,
    centre: &Vector2<f64>,
    width: f64,
) -> Option<Matrix3<f64>> {
    let pairs: Vec<(Vector2<f64>, Vector2<f64>)> = view
        .iter()
        .filter_map(|c| Some((target.corner(c.id)?.vector().xy(), (c.pixel - centre) / width)))
        .collect();
    let (from, to): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
    homography::fit(&from, &to)
}

/// Zhang's closed form without skew: focal lengths and principal point.
fn zhang(homographies: &[Matrix3<f64>]) -> Option<(f64, f64, Vector2<f64>)> {
    // B11 B22 B13 B23 B33; B12 = 0
    let row = |h: &Matrix3<f64>, i: usize, j: usize| {
        SVector::<f64, 5>::new(
            h[(0, i)] * h[(0, j)],
            h[(1, i)] * h[(1, j)],
            h[(2, i)] * h[(0, j)] + h[(0, i)] * h[(2, j)],
            h[(2, i)] * h[(1, j)] + h[(1, i)] * h[(2, j)],
            h[(2, i)] * h[(2, j)],
        )
    };
    let mut normal = SMatrix::<f64, 5, 5>::zeros();
    for h in homographies {
        let h = h / h.column(0).norm();
        for v in [row(&h, 0, 1), row(&h, 0, 0) - row(&h, 1, 1)] {
            normal += v * v.transpose();
        }
    }
    let eigen = normal.symmetric_eigen();
    let b = eigen.eigenvectors.column(eigen.eigenvalues.imin());
    let b = b * b[0].signum();
    let [b11, b22, b13, b23, b33] = [b[0], b[1], b[2], b[3], b[4]];
    let (cx, cy) = (-b13 / b11, -b23 / b22);
    let lambda = b33 - b13 * b13 / b11 - b23 * b23 / b22;
    let (fx, fy) = ((lambda / b11).sqrt(), (lambda / b22).sqrt());
    (fx.is_finite() && fy.is_finite()).then(|| (fx, fy, Vector2::new(cx, cy)))
}
