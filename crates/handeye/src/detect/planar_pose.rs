//! The pose of a flat target from its corners.
//!
//! A homography `H` takes the plane to normalised image coordinates. Its derivative at the plane's
//! origin leaves two rotations, mirror images of each other to first order ([`two_rotations`]);
//! both are polished by Levenberg-Marquardt on
//!
//! ```text
//! Σ |π(T p) - u|²_(Σᵤ + τ² I)  +  Σ |T p - x|²_Σₓ        T = camera_from_target
//! ```
//!
//! with the lens distortion in `π`, Huber's weights, and, if the camera measures surfaces, the 3D
//! corners `x`. `τ` is what lens model and print leave in the residuals beyond the corners' own
//! covariances; it is estimated so that the residuals are as large as they should be.
//!
//! T. Collins and A. Bartoli, *Infinitesimal plane-based pose estimation*, IJCV 109, 2014;
//! P. Huber, *Robust estimation of a location parameter*, 1964.

mod fit;
mod start;
mod symmetry;
#[cfg(test)]
mod tests;

pub(super) use fit::Fit;
pub(crate) use fit::moved;
pub use symmetry::with_symmetries;
pub(crate) use symmetry::{relabelled, symmetry_turn};

use crate::{
    Camera, Error, ImageCorner, Intrinsics, Pose, SurfaceCorner, Target, TargetModel, TargetPose,
    math::{linalg::median, parallel},
};

/// A pose of the target and how well it explains the image.
#[derive(Debug, Clone, PartialEq)]
pub struct PosedTarget {
    /// Pose and covariance.
    pub pose: TargetPose,
    /// Sum of the squared residuals over their variances.
    pub cost: f64,
    /// Root of the mean squared distance of corners and model, px.
    pub rms_px: f64,
    /// What lens model and print add to a corner's error per axis, px.
    pub excess_px: f64,
    /// Corners that do not fit and were left out.
    pub left_out: Vec<u32>,
}

/// Poses nearer to each other than this angle (rad) are one solution.
const SAME_RAD: f64 = 1e-3;
/// A solution whose cost exceeds the best by more than this is no candidate: ten standard
/// deviations.
const COST_GAP: f64 = 100.0;

/// All poses of the target that explain its corners, best first: one, or two where the board is so
/// far or so flat that its mirror image looks the same.
///
/// `surface` may be empty. Errors: fewer than four known corners; corners on a line.
pub fn target_poses(
    corners: &[ImageCorner],
    surface: &[SurfaceCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
) -> Result<Vec<PosedTarget>, Error> {
    target_poses_with(corners, surface, target, intrinsics, None)
}

/// As [`target_poses`], with what other images of the same camera and target say about lens model
/// and print: the typical `excess_px` of [`PosedTarget`]. A few corners tell little about it
/// themselves.
///
/// # Errors
/// As [`target_poses`].
pub fn target_poses_with(
    corners: &[ImageCorner],
    surface: &[SurfaceCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
    typical_excess_px: Option<f64>,
) -> Result<Vec<PosedTarget>, Error> {
    let mut fit = Fit::new(corners, surface, target, intrinsics)?;
    fit.typical_excess = typical_excess_px.map(|px| px * px);
    let mut found: Vec<PosedTarget> = vec![];
    for start in fit.starts()? {
        let posed = fit.polish(start);
        let possible = |p: &PosedTarget| fit.is_possible(p.pose.camera_from_target.iso());
        found.extend(posed.filter(|p| p.cost.is_finite()).filter(possible));
    }
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let best = found.first().map(|p| p.cost).ok_or_else(|| Error::NotDetermined {
        what: "no pose of the target puts its corners in front of the camera".into(),
    })?;
    let mut kept: Vec<PosedTarget> = vec![];
    for posed in found {
        let pose = posed.pose.camera_from_target;
        let known = kept.iter().any(|k| k.pose.camera_from_target.angle_to(&pose) < SAME_RAD);
        if !known && posed.cost < best + COST_GAP {
            kept.push(posed);
        }
    }
    Ok(kept)
}

/// The pose of the target near one that is nearly right: of two readings, the one that this is.
pub(crate) fn target_pose_near(
    corners: &[ImageCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
    near: &Pose<Camera, Target>,
) -> Option<PosedTarget> {
    Fit::new(corners, &[], target, intrinsics).ok()?.polish(*near.iso())
}

/// Fewest images that tell what is typical.
const FEWEST_TYPICAL: usize = 4;

/// The pose of the target that explains the corners of each image best; `None` where they have none.
///
/// `threads` share the work, 0 and 1 the caller's own alone; the poses do not depend on how many they are.
pub fn best_poses(
    pictures: &[&[ImageCorner]],
    target: &TargetModel,
    intrinsics: &Intrinsics,
    threads: usize,
) -> Vec<Option<PosedTarget>> {
    parallel::in_order(pictures.len(), threads, |k| best_pose(pictures[k], target, intrinsics))
}

fn best_pose(
    corners: &[ImageCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
) -> Option<PosedTarget> {
    target_poses(corners, &[], target, intrinsics).ok()?.into_iter().next()
}

/// What lens model and print leave in the corners of all images of one camera, px: the median over the poses that
/// [`best_poses`] finds. `None` where the images are too few to tell.
pub fn typical_excess<'a>(posed: impl IntoIterator<Item = &'a PosedTarget>) -> Option<f64> {
    typical(posed.into_iter().map(|p| p.excess_px).collect())
}

fn typical(all: Vec<f64>) -> Option<f64> {
    (all.len() >= FEWEST_TYPICAL).then(|| median(all))
}

/// As [`typical_excess`], of images with poses of the target that are nearly right.
pub(crate) fn typical_excess_near<'a>(
    pictures: impl IntoIterator<Item = (&'a [ImageCorner], &'a [TargetPose])>,
    target: &TargetModel,
    intrinsics: &Intrinsics,
) -> Option<f64> {
    let excess = |(corners, poses): (&[ImageCorner], &[TargetPose])| {
        let mut fit = Fit::new(corners, &[], target, intrinsics).ok()?;
        let near = fit.nearest(poses).and_then(|start| fit.polish(start));
        near.or_else(|| best_pose(corners, target, intrinsics)).map(|p| p.excess_px)
    };
    typical(pictures.into_iter().filter_map(excess).collect())
}
