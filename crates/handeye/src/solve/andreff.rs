//! Hand-eye calibration by one linear system, also with camera positions in an unknown unit.
//!
//! With `x = vec(R_X)` the motions give
//!
//! ```text
//! [ I - R_B ⊗ R_A   0       ] [ x   ]   [ 0   ]
//! [ t_Bᵀ ⊗ I        I - R_A ] [ t_X ] = [ t_A ]
//! ```
//!
//! solved by least squares over all motions, through their moments; then `R_X` is replaced by the
//! rotation nearest to it. A camera that reconstructs the scene knows `t_B` only up to a factor:
//! then `x` is the null vector of the first rows, and `s R_X t_B + (I - R_A) t_X = t_A` is linear
//! in `t_X` and the factor `s`.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone; a mount that stays in
//! its place, for then nothing but zero is on the right-hand side; with an unknown unit also a
//! camera that stays in its place. The position is that of the matrix before it became a rotation.
//!
//! N. Andreff, R. Horaud and B. Espiau, *Robot hand-eye calibration using structure-from-motion*,
//! IJRR 20(3), 2001; *On-line hand-eye calibration*, 3DIM 1999.

use nalgebra::{Isometry3, Matrix3, Matrix4, SMatrix, Vector4};

use super::{
    kronecker, moments,
    moments::Translations,
    motions::check,
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let m = Translations::of_all(&all);
    let mut normal = SMatrix::<f64, 12, 12>::zeros();
    let bb = m.bb.kronecker(&Matrix3::identity());
    normal.fixed_view_mut::<9, 9>(0, 0).copy_from(&(rotation_form(&all) + bb));
    normal.fixed_view_mut::<9, 3>(0, 9).copy_from(&m.bt);
    normal.fixed_view_mut::<3, 9>(9, 0).copy_from(&m.bt.transpose());
    normal.fixed_view_mut::<3, 3>(9, 9).copy_from(&m.tt);
    let mut rhs = SMatrix::<f64, 12, 1>::zeros();
    rhs.fixed_view_mut::<9, 1>(0, 0).copy_from_slice(m.ab.as_slice());
    rhs.fixed_view_mut::<3, 1>(9, 0).copy_from(&m.at);
    let free = || open("the motions do not fix the camera's place by this method's equations");
    let x = moments::solve_spd(&normal, &rhs).ok_or_else(free)?;
    let r = Matrix3::from_column_slice(&x.as_slice()[..9]);
    let rotation = jacobi::nearest_rotation(&r).ok_or_else(free)?;
    Ok(place(pairs, Isometry3::from_parts(x.fixed_rows::<3>(9).into_owned().into(), rotation)))
}

/// `Σ (I - R_B ⊗ R_A)ᵀ (I - R_B ⊗ R_A)` over all motions: `n² I - Pᵀ P`.
fn rotation_form(all: &[moments::Seen]) -> SMatrix<f64, 9, 9> {
    let n = all.len() as f64;
    let p = all.iter().fold(SMatrix::<f64, 9, 9>::zeros(), |mut sum, s| {
        kronecker::add(&mut sum, &moments::matrix(&s.b), &moments::matrix(&s.a));
        sum
    });
    SMatrix::<f64, 9, 9>::identity() * (n * n) - p.transpose() * p
}

/// The answer when the camera's positions are in an unknown unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scaled {
    /// The answer, in metres.
    pub hand_eye: HandEye,
    /// Metres per unit of the positions in `camera_from_target`.
    pub scale: f64,
}

/// Solves `A X = X B` where the positions in `camera_from_target` are known up to one factor, as
/// from a reconstruction without a target of known size.
///
/// # Errors
/// As [`super::solve`]; also when the factor is not determined or not positive.
pub fn solve_with_scale(pairs: &[PosePair]) -> Result<Scaled, Error> {
    check(pairs)?;
    scaled(pairs)
}

pub(super) fn scaled(pairs: &[PosePair]) -> Result<Scaled, Error> {
    let all = moments::seen(pairs)?;
    let (values, vectors) = jacobi::eigen(&rotation_form(&all));
    let free = || open("the motions do not fix the camera's rotation");
    if !(values[7] > jacobi::NO_GAP * values[0]) {
        return Err(free());
    }
    let null = Matrix3::from_column_slice(vectors.column(8).into_owned().as_slice());
    let rotation =
        jacobi::nearest_rotation(&(null * null.determinant().signum())).ok_or_else(free)?;
    let r_x = rotation.to_rotation_matrix().into_inner();
    let (t, scale) = position_and_scale(&Translations::of_all(&all), &r_x)?;
    let metric: Vec<PosePair> = pairs.iter().map(|p| p.farther(scale)).collect();
    Ok(Scaled { hand_eye: place(&metric, Isometry3::from_parts(t.into(), rotation)), scale })
}

/// Least squares of `(I - R_A) t_X + s R_X t_B = t_A`.
fn position_and_scale(
    m: &Translations,
    r_x: &Matrix3<f64>,
) -> Result<(nalgebra::Vector3<f64>, f64), Error> {
    let x = SMatrix::<f64, 9, 1>::from_column_slice(r_x.as_slice());
    let mixed = m.bt.transpose() * x;
    let mut normal = Matrix4::zeros();
    normal.fixed_view_mut::<3, 3>(0, 0).copy_from(&m.tt);
    normal.fixed_view_mut::<3, 1>(0, 3).copy_from(&mixed);
    normal.fixed_view_mut::<1, 3>(3, 0).copy_from(&mixed.transpose());
    normal[(3, 3)] = m.bb.trace();
    let rhs = Vector4::new(m.at.x, m.at.y, m.at.z, r_x.dot(&m.ab));
    match moments::solve_spd(&normal, &rhs) {
        Some(t) if t[3] > 0.0 => Ok((t.xyz(), t[3])),
        _ => Err(open("the motions do not fix the unit of the camera's positions")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{assert_same, exact_pairs, truths};

    #[test]
    fn an_unknown_unit_of_the_camera_is_found() {
        for truth in truths() {
            for scale in [0.001, 0.4, 25.4] {
                let pairs: Vec<PosePair> =
                    exact_pairs(&truth, 6).iter().map(|p| p.farther(1.0 / scale)).collect();
                let found = solve_with_scale(&pairs).unwrap();
                assert!((found.scale / scale - 1.0).abs() < 1e-9);
                let (x, y) = (found.hand_eye.mount_from_camera, found.hand_eye.anchor_from_target);
                assert_same(x, truth.mount_from_camera, "X");
                assert_same(y, truth.anchor_from_target, "Y");
            }
        }
    }
}
