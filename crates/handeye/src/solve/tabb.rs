//! Robot-world / hand-eye by minimising a distance between poses.
//!
//! ```text
//! c₁ = Σ ‖A X - Y B‖²          c₂ = Σ ‖A - Y B X⁻¹‖²
//! ```
//!
//! in the Frobenius norm of 4 x 4 matrices, with lengths in metres. Both are quadratic in the entries of
//! the matrices, so that the sums over captures are taken once and every step works on moments.
//! `c₂` is `c₁` of the inverse loop `B X⁻¹ = Y⁻¹ A`. The start is Shah's answer; the steps are
//! Gauss-Newton steps on the rotation groups (the paper parametrises rotations by Euler angles,
//! axis and angle, or quaternions; the minimum is the same).
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone. The costs compare
//! entries of rotations with metres.
//!
//! A. Tabb and K. Ahmad Yousef, *Solving the robot-world hand-eye(s) calibration problem with
//! iterative methods*, Machine Vision and Applications 28, 2017.

use nalgebra::{Isometry3, Matrix3, SMatrix, UnitQuaternion, Vector3};

use super::{
    horaud_dornaika::{turning, weighted},
    kronecker::{self, Centred},
    moments, shah,
    shared::open,
};
use crate::{Error, HandEye, Pose, PosePair, math::lie};

/// Distances in the anchor, of the camera's origin.
pub(super) fn solve_c1(pairs: &[PosePair]) -> Result<HandEye, Error> {
    minimise(pairs)
}

/// Distances in the anchor, of the mount's origin.
pub(super) fn solve_c2(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let inverse: Vec<PosePair> = pairs.iter().map(exchanged).collect();
    let found = minimise(&inverse)?;
    Ok(HandEye {
        mount_from_camera: found.mount_from_camera.inverse().rename(),
        anchor_from_target: found.anchor_from_target.inverse().rename(),
    })
}

/// Robot and camera exchange their roles: `A ↔ B`.
fn exchanged(pair: &PosePair) -> PosePair {
    PosePair {
        anchor_from_mount: pair.camera_from_target.inverse().rename(),
        camera_from_target: pair.anchor_from_mount.inverse().rename(),
    }
}

/// Steps at most; from Shah's answer few are needed.
const MOST_STEPS: usize = 50;
/// Steps shorter than this (rad, m) end the iteration.
const SHORT: f64 = 1e-12;

/// Unknowns without `t_Y`, which follows from the means.
struct State {
    r_x: UnitQuaternion<f64>,
    r_y: UnitQuaternion<f64>,
    t_x: Vector3<f64>,
}

fn minimise(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let (p, m) = (kronecker::sum(pairs), Centred::new(pairs));
    let (r_x, r_y) = shah::rotations(&p)?;
    let (t_x, _) = m.positions(&r_y.to_rotation_matrix().into_inner())?;
    let mut state = State { r_x, r_y, t_x };
    for _ in 0..MOST_STEPS {
        let step = step(&state, &p, &m, pairs.len() as f64)
            .ok_or_else(|| open("the poses do not fix the answer"))?;
        let part = |k: usize| step.fixed_rows::<3>(k).into_owned();
        let turned = |r: UnitQuaternion<f64>, by: Vector3<f64>| {
            UnitQuaternion::new_normalize((r * lie::so3_exp(&by)).into_inner())
        };
        state.r_x = turned(state.r_x, part(0));
        state.r_y = turned(state.r_y, part(3));
        state.t_x += part(6);
        if step.norm() < SHORT {
            break;
        }
    }
    let t_y = m.other(&state.r_y.to_rotation_matrix().into_inner(), &state.t_x);
    Ok(HandEye {
        mount_from_camera: Pose::claim(Isometry3::from_parts(state.t_x.into(), state.r_x)),
        anchor_from_target: Pose::claim(Isometry3::from_parts(t_y.into(), state.r_y)),
    })
}

/// One Gauss-Newton step of the residuals `(R_B ⊗ R_A) x - y` and `R_Y t_B - R_A t_X - t_A`.
fn step(state: &State, p: &SMatrix<f64, 9, 9>, m: &Centred, n: f64) -> Option<SMatrix<f64, 9, 1>> {
    let matrix = |q: &UnitQuaternion<f64>| q.to_rotation_matrix().into_inner();
    let (r_x, r_y) = (matrix(&state.r_x), matrix(&state.r_y));
    let vec = |r: &Matrix3<f64>| SMatrix::<f64, 9, 1>::from_column_slice(r.as_slice());
    let (x, y, j_x, j_y) = (vec(&r_x), vec(&r_y), turning(&r_x), turning(&r_y));
    let residual = vec(&(r_y * m.bb - m.ab)) - m.br * state.t_x;
    let mut gradient = SMatrix::<f64, 9, 1>::zeros();
    gradient.fixed_rows_mut::<3>(0).copy_from(&-(j_x.transpose() * (p.transpose() * y)));
    gradient.fixed_rows_mut::<3>(3).copy_from(&(j_y.transpose() * (residual - p * x)));
    gradient.fixed_rows_mut::<3>(6).copy_from(&(m.rr * state.t_x + m.ra - m.br.transpose() * y));
    let (h_xy, h_yt) = (-(j_x.transpose() * (p.transpose() * j_y)), -(j_y.transpose() * m.br));
    let twice = Matrix3::identity() * (2.0 * n); // J_xᵀ J_x = 2 I
    let mut h = SMatrix::<f64, 9, 9>::zeros();
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(&twice);
    h.fixed_view_mut::<3, 3>(0, 3).copy_from(&h_xy);
    h.fixed_view_mut::<3, 3>(3, 0).copy_from(&h_xy.transpose());
    h.fixed_view_mut::<3, 3>(3, 3).copy_from(&(twice + j_y.transpose() * weighted(&j_y, &m.bb)));
    h.fixed_view_mut::<3, 3>(3, 6).copy_from(&h_yt);
    h.fixed_view_mut::<3, 3>(6, 3).copy_from(&h_yt.transpose());
    h.fixed_view_mut::<3, 3>(6, 6).copy_from(&m.rr);
    moments::solve_spd(&h, &-gradient)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{assert_least, assert_same, exact_pairs, noisy_pairs, truths};
    use nalgebra::Matrix4;

    #[test]
    fn both_costs_give_the_truth_of_exact_pairs() {
        for truth in truths() {
            for solve in [solve_c1, solve_c2] {
                let found = solve(&exact_pairs(&truth, 5)).unwrap();
                assert_same(found.mount_from_camera, truth.mount_from_camera, "X");
                assert_same(found.anchor_from_target, truth.anchor_from_target, "Y");
            }
        }
    }

    /// `A`, `X`, `Y`, `B` of every pair.
    fn loops(pairs: &[PosePair], answer: &HandEye) -> Vec<[Matrix4<f64>; 4]> {
        let (x, y) = (answer.mount_from_camera.matrix(), answer.anchor_from_target.matrix());
        let b = |p: &PosePair| p.camera_from_target.inverse().matrix();
        pairs.iter().map(|p| [p.anchor_from_mount.matrix(), x, y, b(p)]).collect()
    }

    #[test]
    fn no_small_step_makes_the_costs_smaller() {
        let pairs = noisy_pairs(&truths()[0], 12);
        assert_least(&solve_c1(&pairs).unwrap(), 12, |answer| {
            loops(&pairs, answer).iter().map(|[a, x, y, b]| (a * x - y * b).norm_squared()).sum()
        });
        assert_least(&solve_c2(&pairs).unwrap(), 12, |answer| {
            let inverse = answer.mount_from_camera.inverse().matrix();
            let all = loops(&pairs, answer);
            all.iter().map(|[a, _, y, b]| (a - y * b * inverse).norm_squared()).sum()
        });
    }
}
