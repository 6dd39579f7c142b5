//! Hand-eye calibration by logarithms.
//!
//! `A X = X B` for relative motions; with `α = log R_A`, `β = log R_B` the rotations obey
//! `α = R_X β`, so `R_X` is the rotation that best turns the `β` into the `α`:
//! `R_X = (MᵀM)^{-1/2} Mᵀ`, `M = Σ β αᵀ`, taken here by its singular vectors, which also serves
//! when `M` has rank two. Then `(R_A - I) t_X = R_X t_B - t_A` is linear in `t_X`.
//!
//! F. Park and B. Martin, *Robot sensor calibration: solving AX = XB on the Euclidean group*,
//! IEEE T-RA 10(5), 1994.

use nalgebra::{Matrix3, Vector3};

use super::{isometry, motions, place_target};
use crate::{Error, HandEye, Pose, PosePair, lie, linalg};

/// Relative rotations above this angle are left out: near a half turn the logarithm's sign is
/// decided by noise. 175 degrees.
const MOST_ANGLE: f64 = 3.054;

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = motions::motions(pairs);
    let used: Vec<_> = all
        .iter()
        .filter(|m| m.a.rotation.angle() < MOST_ANGLE && m.b.rotation.angle() < MOST_ANGLE)
        .collect();
    let missing = || Error::NotDetermined {
        what: "the rotations between captures do not fix the camera's rotation".into(),
    };
    let m: Matrix3<f64> = used
        .iter()
        .map(|m| lie::so3_log(&m.a.rotation) * lie::so3_log(&m.b.rotation).transpose())
        .sum();
    let r_x = linalg::nearest_rotation(&m).ok_or_else(missing)?;
    let t_x = translation(&all, &r_x).ok_or_else(missing)?;
    Ok(place_target(pairs, &Pose::claim(isometry(&r_x, t_x))))
}

/// Least squares over `(R_A - I) t_X = R_X t_B - t_A`.
pub(super) fn translation(all: &[motions::Motion], r_x: &Matrix3<f64>) -> Option<Vector3<f64>> {
    let (mut normal, mut rhs) = (Matrix3::zeros(), Vector3::zeros());
    for m in all {
        let c = m.a.rotation.to_rotation_matrix().into_inner() - Matrix3::identity();
        normal += c.transpose() * c;
        rhs += c.transpose() * (r_x * m.b.translation.vector - m.a.translation.vector);
    }
    let inverse = linalg::invert_spd(&normal)?;
    let t = inverse * rhs;
    Some(t + inverse * (rhs - normal * t))
}
