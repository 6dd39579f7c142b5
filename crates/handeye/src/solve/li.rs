//! Robot-world / hand-eye by one linear system.
//!
//! With `x = vec(R_X)`, `y = vec(R_Y)`, `A X = Y B` is linear in all 24 unknowns:
//!
//! ```text
//! (R_B ⊗ R_A) x - y = 0          (t_Bᵀ ⊗ I) y - R_A t_X + t_Y = t_A
//! ```
//!
//! solved by least squares; then `R_X` and `R_Y` are replaced by the rotations nearest to them.
//! `x` and `t_Y` have multiples of the identity as their blocks and are eliminated first.
//!
//! Degenerate: rotations about one axis and none at all; a mount that stays in its place, for then
//! zero solves the equations. The positions are those of the matrices before they became rotations.
//!
//! A. Li, L. Wang and D. Wu, *Simultaneous robot-world and hand-eye calibration using
//! dual-quaternions and Kronecker product*, Int. J. Physical Sciences 5(10), 2010.

use nalgebra::{Isometry3, Matrix3, SMatrix};

use super::{kronecker, kronecker::Centred, moments, shared::open};
use crate::{Error, HandEye, Pose, PosePair, math::jacobi};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let n = pairs.len() as f64;
    let (p, m) = (kronecker::sum(pairs), Centred::new(pairs));
    let rotations = SMatrix::<f64, 9, 9>::identity() * n - p * p.transpose() / n;
    let mut normal = SMatrix::<f64, 12, 12>::zeros();
    let bb = m.bb.kronecker(&Matrix3::identity());
    normal.fixed_view_mut::<9, 9>(0, 0).copy_from(&(rotations + bb));
    normal.fixed_view_mut::<9, 3>(0, 9).copy_from(&-m.br);
    normal.fixed_view_mut::<3, 9>(9, 0).copy_from(&-m.br.transpose());
    normal.fixed_view_mut::<3, 3>(9, 9).copy_from(&m.rr);
    let mut rhs = SMatrix::<f64, 12, 1>::zeros();
    rhs.fixed_view_mut::<9, 1>(0, 0).copy_from_slice(m.ab.as_slice());
    rhs.fixed_view_mut::<3, 1>(9, 0).copy_from(&-m.ra);
    let free = || open("the poses do not fix the answer by this method's equations");
    let found = moments::solve_spd(&normal, &rhs).ok_or_else(free)?;
    let y = SMatrix::<f64, 9, 1>::from_column_slice(&found.as_slice()[..9]);
    let x = p.transpose() * y / n;
    let t_x = found.fixed_rows::<3>(9).into_owned();
    let linear = |v: &SMatrix<f64, 9, 1>| Matrix3::from_column_slice(v.as_slice());
    let t_y = m.other(&linear(&y), &t_x);
    let r_x = jacobi::nearest_rotation(&linear(&x)).ok_or_else(free)?;
    let r_y = jacobi::nearest_rotation(&linear(&y)).ok_or_else(free)?;
    Ok(HandEye {
        mount_from_camera: Pose::claim(Isometry3::from_parts(t_x.into(), r_x)),
        anchor_from_target: Pose::claim(Isometry3::from_parts(t_y.into(), r_y)),
    })
}
