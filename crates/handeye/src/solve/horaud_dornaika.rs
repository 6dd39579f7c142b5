//! Hand-eye calibration by unit quaternions: rotation first, or rotation and position together.
//!
//! `a x = x b` for the quaternions of every motion, so `x` minimises a quadratic form; position
//! follows from linear least squares. The second method then minimises both sums together,
//!
//! ```text
//! λ₁ Σ |Q(a) x - W(b) x|²  +  λ₂ Σ |R_X t_B + (I - R_A) t_X - t_A|²        λ₁ = λ₂ = 1
//! ```
//!
//! with the positions in metres, by Gauss-Newton steps on the rotation group instead of the
//! paper's penalty on the length of `x`. Both are over all motions, by moments. The axes in the
//! paper are unit vectors; here, as in common use, a motion weighs by the sine of half its angle.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone. The weights of the
//! second method compare radians with metres.
//!
//! R. Horaud and F. Dornaika, *Hand-eye calibration*, IJRR 14(3), 1995.

use nalgebra::{Isometry3, Matrix3, Matrix4, SMatrix, UnitQuaternion, Vector3, Vector6};

use super::{
    moments,
    moments::{Seen, Translations},
    shared::{open, place},
};
use crate::{
    Error, HandEye, PosePair,
    math::{jacobi, lie},
};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let x = moments::with_position(rotation(&moments::loops(&all))?, &Translations::of_all(&all))?;
    Ok(place(pairs, x))
}

pub(super) fn solve_nonlinear(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let (loops, motions) = (moments::loops(&all), Translations::of_all(&all));
    let start = moments::with_position(rotation(&loops)?, &motions)?;
    Ok(place(pairs, refine(&all, start, &loops, &motions)?))
}

/// `Σ |Q(a) x - W(b) x|² = n² - |Sᵀ x|²` is least for the leading left singular vector of `S`.
fn rotation(loops: &Matrix4<f64>) -> Result<UnitQuaternion<f64>, Error> {
    let x = jacobi::leading(&(loops * loops.transpose()))
        .ok_or_else(|| open("the rotations between captures do not fix the camera's rotation"))?;
    Ok(jacobi::rotation_of(&x))
}

/// Steps after which the fit counts as not converging; from the linear answer few are needed.
const MOST_STEPS: usize = 50;
/// Steps shorter than this (rad, m) end the iteration.
const SHORT: f64 = 1e-13;

fn refine(
    all: &[Seen],
    start: Isometry3<f64>,
    loops: &Matrix4<f64>,
    motions: &Translations,
) -> Result<Isometry3<f64>, Error> {
    let n = all.len() as f64;
    let form = Matrix4::identity() * (n * n) - loops * loops.transpose();
    let mut x = start;
    for _ in 0..MOST_STEPS {
        let step = step(&x, &form, motions)
            .ok_or_else(|| open("the motions do not fix the camera's place"))?;
        let (turn, shift) = (lie::omega(&step), lie::nu(&step));
        x.rotation = UnitQuaternion::new_normalize((x.rotation * lie::so3_exp(&turn)).into_inner());
        x.translation.vector += shift;
        if step.norm() < SHORT {
            break;
        }
    }
    Ok(x)
}

/// One Gauss-Newton step `(δ, Δt)`, `R_X ← R_X exp(δ)`.
fn step(x: &Isometry3<f64>, form: &Matrix4<f64>, m: &Translations) -> Option<Vector6<f64>> {
    let r = x.rotation.to_rotation_matrix().into_inner();
    let (q, t) = (moments::scalar_first(&x.rotation), x.translation.vector);
    // x exp(δ) ≈ x + x (0, δ)/2
    let j_q = moments::left(&q).fixed_view::<4, 3>(0, 1) * 0.5;
    let j_r = turning(&r);
    let vec_r = SMatrix::<f64, 9, 1>::from_column_slice(r.as_slice());
    let bb_r = SMatrix::<f64, 9, 1>::from_column_slice((r * m.bb - m.ab).as_slice());
    let g_r = j_r.transpose() * (bb_r + m.bt * t) + j_q.transpose() * form * q;
    let g_t = m.bt.transpose() * vec_r + m.tt * t - m.at;
    let h_rt = j_r.transpose() * m.bt;
    let mut h = SMatrix::<f64, 6, 6>::zeros();
    let h_r = j_r.transpose() * weighted(&j_r, &m.bb) + j_q.transpose() * form * j_q;
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(&h_r);
    h.fixed_view_mut::<3, 3>(0, 3).copy_from(&h_rt);
    h.fixed_view_mut::<3, 3>(3, 0).copy_from(&h_rt.transpose());
    h.fixed_view_mut::<3, 3>(3, 3).copy_from(&m.tt);
    moments::solve_spd(&h, &-lie::tangent(&g_r, &g_t))
}

/// `d vec(R exp(δ)) / dδ`: its column `k` is `vec(R [e_k]ₓ)`.
pub(super) fn turning(r: &Matrix3<f64>) -> SMatrix<f64, 9, 3> {
    let mut j = SMatrix::<f64, 9, 3>::zeros();
    for k in 0..3 {
        let turned = r * Vector3::ith(k, 1.0).cross_matrix();
        j.column_mut(k).copy_from_slice(turned.as_slice());
    }
    j
}

/// `(M ⊗ I) J` for a symmetric `M`.
pub(super) fn weighted(j: &SMatrix<f64, 9, 3>, m: &Matrix3<f64>) -> SMatrix<f64, 9, 3> {
    let mut product = SMatrix::<f64, 9, 3>::zeros();
    for k in 0..3 {
        let column = Matrix3::from_column_slice(j.column(k).as_slice()) * m;
        product.column_mut(k).copy_from_slice(column.as_slice());
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{assert_least, noisy_pairs, truths};

    #[test]
    fn no_small_step_makes_the_joint_cost_smaller() {
        let pairs = noisy_pairs(&truths()[0], 9);
        let all = moments::seen(&pairs).unwrap();
        assert_least(&solve_nonlinear(&pairs).unwrap(), 6, |answer| {
            let (q, r) = (
                moments::scalar_first(&answer.mount_from_camera.iso().rotation),
                answer.mount_from_camera.rotation(),
            );
            let t = answer.mount_from_camera.translation();
            let cost = |i: &Seen, j: &Seen| {
                let (a, t_a) = moments::motion(&i.a, &i.t_a, &j.a, &j.t_a);
                let (b, t_b) = moments::motion(&i.b, &i.t_b, &j.b, &j.t_b);
                let rotation = moments::product(&a, &q) - moments::product(&q, &b);
                let position = r * t_b + t - moments::matrix(&a) * t - t_a;
                rotation.norm_squared() + position.norm_squared()
            };
            let motions = (1..all.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
            motions.map(|(i, j)| cost(&all[i], &all[j])).sum()
        });
    }
}
