//! Relative motions between captures: the A and B of `A X = X B`, and what they can determine.
//!
//! `A_ij = A_j⁻¹ A_i` in the mount, `B_ij = B_j⁻¹ B_i` in the camera: then `A_ij X = X B_ij`.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::{
    moments,
    shared::{FEWEST_POSES, too_few},
};
use crate::{
    Error, PosePair,
    math::{jacobi, lie},
};

/// One relative motion, seen by the robot and by the camera.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// In the mount.
    pub a: Isometry3<f64>,
    /// In the camera.
    pub b: Isometry3<f64>,
}

/// Up to this many captures all pairs are used; above, each capture is paired with as many others.
const ALL_PAIRS_UP_TO: usize = 64;

/// Motions between captures: all pairs of few captures; of many, each with `ALL_PAIRS_UP_TO`
/// others at evenly spaced distances in the order, so that the count stays linear.
pub fn motions(pairs: &[PosePair]) -> Vec<Motion> {
    let n = pairs.len();
    if n <= ALL_PAIRS_UP_TO {
        let all = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        return all.map(|(i, j)| motion(&pairs[i], &pairs[j])).collect();
    }
    let step = |k: usize| 1 + k * (n - 1) / ALL_PAIRS_UP_TO;
    (0..n)
        .flat_map(|i| (0..ALL_PAIRS_UP_TO).map(move |k| (i, (i + step(k)) % n)))
        .map(|(i, j)| motion(&pairs[i], &pairs[j]))
        .collect()
}

/// The motion from capture `i` to capture `j`.
pub fn motion(i: &PosePair, j: &PosePair) -> Motion {
    Motion {
        a: j.anchor_from_mount.iso().inv_mul(i.anchor_from_mount.iso()),
        // B_j⁻¹ B_i with B = target_from_camera
        b: j.camera_from_target.iso() * i.camera_from_target.iso().inverse(),
    }
}

/// Middle over largest eigenvalue of the scatter of rotation axes below which all rotations count
/// as being about one axis. With noise of 0.05 degrees on rotations of 5 degrees the ratio of a
/// single axis is 1e-4.
pub(crate) const ONE_AXIS: f64 = 1e-6;

/// Scatter of the robot's rotation vectors (rad²) between captures, in the mount.
pub(crate) fn axis_scatter(pairs: &[PosePair]) -> Matrix3<f64> {
    let scatter = |w: Vector3<f64>| w * w.transpose();
    motions(pairs).iter().map(|m| scatter(lie::so3_log(&m.a.rotation))).sum()
}

/// Mean square rotation (rad²) between captures below which the robot counts as not turning.
const NO_ROTATION: f64 = 1e-8;

/// Eigenvalues (rad², over all motions, rotations by their chords) of the scatter of axes, largest
/// first, and the axis of the largest.
fn principal(pairs: &[PosePair]) -> ([f64; 3], Vector3<f64>) {
    let (values, axes) = jacobi::eigen(&(moments::axis_moment(pairs) * 4.0));
    (values.into(), axes.column(0).into_owned())
}

/// Whether the robot turns at all between the captures.
pub(crate) fn rotates(pairs: &[PosePair]) -> bool {
    let count = (pairs.len() * pairs.len().saturating_sub(1) / 2).max(1) as f64;
    principal(pairs).0[0] / count > NO_ROTATION
}

/// The axis (in the mount) about which all rotations are, if there is only one.
pub(crate) fn single_axis(pairs: &[PosePair]) -> Option<Vector3<f64>> {
    let (values, axis) = principal(pairs);
    (rotates(pairs) && values[1] < ONE_AXIS * values[0]).then_some(axis)
}

/// Refuses captures whose rotations are all about one axis, or that do not rotate at all.
pub(super) fn check_axes(pairs: &[PosePair]) -> Result<(), Error> {
    if !rotates(pairs) {
        let what = "the robot does not rotate between the captures; tilt it by 30 degrees and more \
                    about two axes";
        return Err(Error::NotDetermined { what: what.into() });
    }
    match single_axis(pairs) {
        None => Ok(()),
        Some(axis) => Err(Error::NotDetermined {
            what: format!(
                "all rotations are about one axis, ({:.3}, {:.3}, {:.3}) of the body that carries \
                 the camera (flange or base): the position along it is free; tilt the robot about \
                 a second axis, or touch a corner",
                axis.x, axis.y, axis.z
            ),
        }),
    }
}

/// Refuses what no method can solve.
pub(crate) fn check(pairs: &[PosePair]) -> Result<(), Error> {
    if pairs.len() < FEWEST_POSES {
        return Err(too_few(pairs.len()));
    }
    let finite = |p: &PosePair| p.anchor_from_mount.is_finite() && p.camera_from_target.is_finite();
    match pairs.iter().position(|p| !finite(p)) {
        Some(i) => Err(Error::NotFinite { what: format!("pose pair {}", i + 1) }),
        None => check_axes(pairs),
    }
}
