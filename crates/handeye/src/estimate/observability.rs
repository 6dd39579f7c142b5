//! Which directions of the answer the data do not constrain (observability), and the volume that captures show.
//!
//! A direction is unconstrained where its standard deviation, an eigenvalue of the covariance's block, is beyond what an
//! answer is used with.

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::{JointFit, predict};
use crate::{PosePair, Setup, Target, model::residual::Residual, solve::motions};

/// Largest standard deviations of an answer that still counts as determined: 3 degrees, 20 mm.
const FREE: Residual = Residual { angle: 0.052, distance: 0.02 };

/// A direction of `mount_from_camera` that the data do not constrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// A rotation, or else a translation.
    pub is_rotation: bool,
    /// About or along which direction, in the mount.
    pub axis: Vector3<f64>,
}

/// Directions of `mount_from_camera` that the data do not constrain.
pub fn free_directions(fit: &JointFit) -> Vec<Free> {
    let Some(covariance) = fit.pose_covariance() else {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        return [true, false]
            .into_iter()
            .flat_map(|is_rotation| axes.map(|axis| Free { is_rotation, axis }))
            .collect();
    };
    let of_mount = covariance.fixed_view::<6, 6>(0, 0).into_owned();
    free_of(&of_mount, &fit.hand_eye.mount_from_camera.rotation())
}

/// The same for a covariance of `mount_from_camera`, whose rotation is `r`.
pub(crate) fn free_of(covariance: &Matrix6<f64>, r: &Matrix3<f64>) -> Vec<Free> {
    let mut free = Vec::new();
    for (block, limit) in [(0, FREE.angle), (3, FREE.distance)] {
        let s: Matrix3<f64> = covariance.fixed_view::<3, 3>(block, block).into_owned();
        let eigen = s.symmetric_eigen();
        for k in 0..3 {
            if eigen.eigenvalues[k].max(0.0).sqrt() > limit {
                let axis = r * eigen.eigenvectors.column(k);
                // the same direction has the same sign in every run
                let sign = if axis[axis.iamax()] < 0.0 { -1.0 } else { 1.0 };
                free.push(Free { is_rotation: block == 0, axis: axis * sign });
            }
        }
    }
    free
}

/// Cosine of the angle between a direction and the robot's one axis up to which they are the same.
const ALONG: f64 = 0.999;

/// Unconstrained directions in the user's words.
pub fn in_words(free: &[Free], pairs: &[PosePair], setup: Setup) -> Vec<String> {
    let mount = setup.mount();
    let count = |is_rotation| free.iter().filter(|f| f.is_rotation == is_rotation).count();
    let mut named = Vec::new();
    let single = motions::single_axis(pairs);
    for (is_rotation, all, what) in [
        (true, "the rotation of the camera on", "rotation about"),
        (false, "the position of the camera on", "translation along"),
    ] {
        if count(is_rotation) == 3 {
            named.push(format!("{all} {mount}"));
            continue;
        }
        for f in free.iter().filter(|f| f.is_rotation == is_rotation) {
            let turning = single.is_some_and(|a| a.dot(&f.axis).abs() > ALONG);
            let which = if turning { "the rotation axis " } else { "" };
            named.push(format!("{what} {which}{} of {mount}", axis_name(&f.axis)));
        }
    }
    named
}

/// `x`, `y`, `z`, or the direction in numbers.
pub fn axis_name(axis: &Vector3<f64>) -> String {
    let axis = axis.normalize();
    let k = axis.iamax();
    if axis[k].abs() > 0.9998 {
        return ["x", "y", "z"][k].into();
    }
    format!("({:.2}, {:.2}, {:.2})", axis.x, axis.y, axis.z)
}

/// Points of the target as seen in all captures, in the camera frame, under a name.
pub fn seen_volume(
    pairs: &[PosePair],
    corners: &[crate::Point<Target>],
    name: &str,
) -> Option<predict::Volume> {
    let points = pairs
        .iter()
        .flat_map(|p| corners.iter().map(move |c| (p.camera_from_target * *c).vector()));
    predict::Volume::around(points, name)
}
