//! How far corners lie from where the board has them, by the smoothest view of it that fits.
//!
//! The view is a homography and the lens of the camera; without a camera, one coefficient of radial
//! distortion. It is fitted with Huber's weights, so that a corner that is wrong stands out and does
//! not bend the view.
//!
//! P. Huber, *Robust estimation of a location parameter*, 1964.

use nalgebra::{Matrix2, Vector2};

use super::view::{Sighting, View};
use crate::{
    ImageCorner, Intrinsics, TargetModel,
    math::linalg::{median, root_mean},
};

/// Fewer corners leave nothing beside the homography's eight numbers.
const FEWEST_CORNERS: usize = 6;
/// Fits, each with weights from the one before.
const ROUNDS: usize = 4;
/// Corners farther off than this multiple of the median count less.
const HUBER: f64 = 2.0;
/// What the view does not know of: paper that is not flat, lenses (px²).
const VIEW_VARIANCE: f64 = 1e-4;

/// Detected minus predicted pixel of each corner, px, in the order of `corners`, in an image of
/// `size` (width, height). `None` where the corners are too few or do not tell.
pub fn residuals(
    corners: &[ImageCorner],
    target: &TargetModel,
    size: (usize, usize),
    camera: Option<&Intrinsics>,
) -> Option<Vec<Vector2<f64>>> {
    if corners.len() < FEWEST_CORNERS {
        return None;
    }
    let plain: Vec<Sighting> =
        corners.iter().map(|c| sighting(c, target)).collect::<Option<_>>()?;
    let mut weighted = plain.clone();
    let mut residuals = vec![];
    for _ in 0..ROUNDS {
        let view = View::fit(&weighted, size, camera)?;
        let residual = |s: &Sighting| Some(s.pixel - view.pixel(&s.on_board)?);
        residuals = plain.iter().map(residual).collect::<Option<_>>()?;
        let usual = median(residuals.iter().map(|r: &Vector2<f64>| r.norm()));
        for ((weighted, plain), r) in weighted.iter_mut().zip(&plain).zip(&residuals) {
            let far = r.norm() / (HUBER * usual).max(f64::MIN_POSITIVE);
            weighted.covariance = plain.covariance * far.max(1.0);
        }
    }
    Some(residuals)
}

/// Root of the mean squared length of residuals, px.
pub fn rms(residuals: &[Vector2<f64>]) -> f64 {
    root_mean(residuals.iter().map(|r| r.norm_squared())).unwrap_or(0.0)
}

fn sighting(corner: &ImageCorner, target: &TargetModel) -> Option<Sighting> {
    Some(Sighting {
        on_board: target.corner(corner.id)?.vector().xy() / target.pitch_m(),
        pixel: corner.pixel,
        covariance: corner.covariance + Matrix2::identity() * VIEW_VARIANCE,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Distortion, Pose, Target, math::random::Random};
    use nalgebra::Isometry3;

    const SIZE: (usize, usize) = (800, 600);

    fn camera() -> Intrinsics {
        let mut k = [0.0; 12];
        (k[0], k[1]) = (-0.2, 0.1);
        let plain = Intrinsics::pinhole(800, 600, 900.0, 900.0, 410.0, 290.0);
        Intrinsics { distortion: Distortion::BrownConrady(k), ..plain }
    }

    fn board() -> TargetModel {
        TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 }
    }

    fn corners(noise_px: f64) -> Vec<ImageCorner> {
        let mut random = Random::new(3);
        let pose: Pose<Camera, Target> =
            Pose::claim(Isometry3::new([-0.08, -0.05, 0.25].into(), [0.3, -0.2, 0.1].into()));
        let corner = |(id, p): (usize, crate::Point<Target>)| {
            let noise = Vector2::new(random.normal(), random.normal()) * noise_px;
            let pixel = camera().project(&(pose * p).vector()).unwrap() + noise;
            ImageCorner { id: id as u32, pixel, covariance: Matrix2::identity() * 1e-3 }
        };
        board().corners().into_iter().enumerate().map(corner).collect()
    }

    #[test]
    fn exact_corners_lie_where_the_board_has_them() {
        let exact = residuals(&corners(0.0), &board(), SIZE, Some(&camera())).unwrap();
        assert!(rms(&exact) < 1e-6, "{}", rms(&exact));
        let unknown_lens = residuals(&corners(0.0), &board(), SIZE, None).unwrap();
        assert!(rms(&unknown_lens) < 0.1, "{}", rms(&unknown_lens));
    }

    #[test]
    fn residuals_are_as_large_as_the_noise() {
        let found = residuals(&corners(0.05), &board(), SIZE, Some(&camera())).unwrap();
        // two axes, 108 numbers, eight of them fitted
        let expected = 0.05 * (2.0_f64 * 100.0 / 108.0).sqrt();
        assert!((rms(&found) / expected - 1.0).abs() < 0.2, "{} {expected}", rms(&found));
    }

    #[test]
    fn a_wrong_corner_stands_out() {
        let mut wrong = corners(0.02);
        wrong[20].pixel.x += 3.0;
        let found = residuals(&wrong, &board(), SIZE, Some(&camera())).unwrap();
        assert!((found[20] - Vector2::new(3.0, 0.0)).norm() < 0.1, "{}", found[20]);
        let others = found.iter().enumerate().filter(|(k, _)| *k != 20);
        assert!(others.map(|(_, r)| r.norm()).fold(0.0, f64::max) < 0.2);
    }

    #[test]
    fn few_corners_and_corners_on_a_line_have_none() {
        let all = corners(0.0);
        assert!(residuals(&all[..4], &board(), SIZE, None).is_none());
        assert!(residuals(&all[..9], &board(), SIZE, None).is_none());
        let strange = ImageCorner { id: 999, ..all[0] };
        let with_strange: Vec<_> = all.iter().copied().chain([strange]).collect();
        assert!(residuals(&with_strange, &board(), SIZE, None).is_none());
    }
}
