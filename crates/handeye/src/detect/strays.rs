//! Corners that lie where the board cannot have them.
//!
//! Close to the edge of what hides a board, the edge may pass for one of a square. What remains of
//! such a corner stands out against the smoothest view of the board, and against the corners around
//! it: where the view is wrong, because the lens bends or the paper does, those around it are off by nearly as much.

use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

use super::residuals::residuals;
use crate::{ImageCorner, Intrinsics, TargetModel, detect::outcome::Outcome, math::linalg::median};

/// Fewer corners do not tell which of them is wrong.
const FEWEST: usize = 13;
/// Corners around one, and fits of a plane to how far they are off, each with weights from the one
/// before.
const AROUND: usize = 12;
const ROUNDS: usize = 4;
/// Those farther off the plane than this multiple of the median count less.
const HUBER: f64 = 2.0;
/// A stray is off by more than this, px,
const NOT_STRAY_PX: f64 = 0.7;
/// by more than this multiple of the board's median,
const FAR: f64 = 10.0;
/// and by more than this multiple of what is usual around it.
const STRAY: f64 = 8.0;

/// The corners without strays; of a board that is seen as a whole nothing is hidden.
pub(super) fn without_strays(
    found: Outcome,
    target: &TargetModel,
    size: (usize, usize),
    camera: Option<&Intrinsics>,
) -> Outcome {
    let corners = found?;
    let hidden_in_part = corners.len() < target.len();
    if corners.len() < FEWEST || !hidden_in_part {
        return Ok(corners);
    }
    let Some(off) = residuals(&corners, target, size, camera) else { return Ok(corners) };
    let floor = NOT_STRAY_PX.max(FAR * median(off.iter().map(|r| r.norm())));
    let kept = (0..corners.len()).filter(|&k| !is_stray(k, &corners, &off, target, floor));
    Ok(kept.map(|k| corners[k]).collect())
}

fn is_stray(
    k: usize,
    corners: &[ImageCorner],
    off: &[Vector2<f64>],
    target: &TargetModel,
    floor: f64,
) -> bool {
    if off[k].norm() < floor {
        return false;
    }
    let place = |k: usize| target.corner(corners[k].id).map(|p| p.vector().xy());
    let from_here = |other: usize| Some((place(other)? - place(k)?) / target.pitch_m());
    let others = (0..corners.len()).filter(|other| *other != k);
    let mut near: Vec<Near> =
        others.filter_map(|o| Some(Near { at: from_here(o)?, off: off[o], weight: 1.0 })).collect();
    // equally far ones stay in the order of their ids
    near.sort_by(|a, b| a.at.norm_squared().total_cmp(&b.at.norm_squared()));
    near.truncate(AROUND);
    let mut usual = 0.0;
    for _ in 0..ROUNDS {
        let Some(trend) = Trend::of(&near) else { return false };
        usual = median(near.iter().map(|n| trend.residual(n)));
        if (off[k] - trend.here).norm() <= floor.max(STRAY * usual) {
            return false;
        }
        for n in &mut near {
            n.weight = (HUBER * usual / trend.residual(n)).min(1.0);
        }
    }
    usual.is_finite()
}

/// A corner beside the one that is judged.
struct Near {
    /// Place from there, in steps of the board.
    at: Vector2<f64>,
    off: Vector2<f64>,
    weight: f64,
}

/// A plane through the residuals around a corner.
struct Trend {
    /// Where the corner is.
    here: Vector2<f64>,
    slope: Matrix2<f64>,
}

impl Trend {
    fn of(near: &[Near]) -> Option<Self> {
        let (mut normal, mut right) = (Matrix3::zeros(), Matrix3x2::zeros());
        for n in near {
            let row = Vector3::new(1.0, n.at.x, n.at.y);
            normal += row * row.transpose() * n.weight;
            right += row * n.off.transpose() * n.weight;
        }
        let plane = normal.cholesky()?.solve(&right);
        let slope = plane.fixed_rows::<2>(1).transpose();
        Some(Self { here: plane.row(0).transpose(), slope })
    }

    fn residual(&self, near: &Near) -> f64 {
        (near.off - self.here - self.slope * near.at).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Distortion, Pose};
    use nalgebra::Isometry3;

    fn corners(k1: f64) -> (TargetModel, Vec<ImageCorner>) {
        let target = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 };
        let mut k = [0.0; 12];
        (k[0], k[1]) = (k1, -0.5 * k1);
        let plain = Intrinsics::pinhole(800, 600, 500.0, 500.0, 410.0, 290.0);
        let camera = Intrinsics { distortion: Distortion::BrownConrady(k), ..plain };
        let pose: Pose<crate::Camera, crate::Target> =
            Pose::claim(Isometry3::new([-0.08, -0.05, 0.15].into(), [0.3, -0.2, 0.1].into()));
        let corner = |(id, p): (usize, crate::Point<crate::Target>)| {
            let pixel = camera.project(&(pose * p).vector()).unwrap();
            ImageCorner { id: id as u32, pixel, covariance: Matrix2::identity() * 1e-4 }
        };
        let all = target.corners().into_iter().enumerate().map(corner).collect();
        (target, all)
    }

    fn kept(corners: &[ImageCorner], target: &TargetModel) -> Vec<u32> {
        let seen = corners.iter().filter(|c| c.id != 53).copied().collect();
        let kept = without_strays(Ok(seen), target, (800, 600), None).unwrap();
        kept.iter().map(|c| c.id).collect()
    }

    #[test]
    fn corners_off_their_place_are_left_out_at_the_rim_and_inside() {
        let (target, mut wrong) = corners(-0.2);
        for id in [0, 26, 40] {
            wrong[id].pixel += Vector2::new(1.5, -1.0);
        }
        let left_out: Vec<u32> = (0..53).filter(|id| !kept(&wrong, &target).contains(id)).collect();
        assert_eq!(left_out, [0, 26, 40]);
    }

    #[test]
    fn a_lens_that_bends_more_than_the_view_knows_keeps_its_corners() {
        let (target, bent) = corners(-0.6);
        let off = residuals(&bent, &target, (800, 600), None).unwrap();
        let largest = off.iter().map(|r| r.norm()).fold(0.0, f64::max);
        let usual = median(off.iter().map(|r| r.norm()));
        assert!(largest > NOT_STRAY_PX, "{largest} {usual}: the test is too easy");
        assert_eq!(kept(&bent, &target).len(), 53);
    }
}
