//! The least-squares cost of `A X = Y B` as one quadratic form, and its least on rotations.
//!
//! ```text
//! Σ w_R ‖R_A R_X - R_Y R_B‖² + ‖R_A t_X + t_A - R_Y t_B - t_Y‖²  =  zᵀ Q z
//! z = (vec R_X, vec R_Y, 1),   t = (t_X, t_Y) = -P⁺ S z
//! ```
//!
//! The translations are linear in the rest and leave the problem in closed form; `P`, `S` are their
//! normal equations. `w_R` makes a small angle cost as much as its arc at [`ARM`].

use nalgebra::{DMatrix, Isometry3, Matrix3, Matrix6, SMatrix, SVector, Vector3, Vector6};

use crate::{
    HandEye, Pose, PosePair,
    math::{lie, linalg},
};

/// Entries of `z`.
pub(super) const N: usize = 19;
pub(super) type Form = SMatrix<f64, N, N>;
pub(super) type Z = SVector<f64, N>;
type ByTranslation = SMatrix<f64, 6, N>;

/// Lever arm (m) at which rotation counts: 1 rad costs as much as 0.1 m, as in the least-squares
/// candidate.
pub const ARM: f64 = 0.1;
/// Singular values below this part of the largest count as zero: the direction is free.
const RANK: f64 = 1e-12;

/// The cost of some pairs.
#[derive(Debug, Clone)]
pub(super) struct Cost {
    pub q: Form,
    /// `-P⁺ S`.
    translation_by: ByTranslation,
}

impl Cost {
    pub fn of(pairs: &[PosePair]) -> Self {
        let mut q = Form::zeros();
        let mut normal = Matrix6::zeros();
        let mut mixed = ByTranslation::zeros();
        // ‖R_A R_X - R_Y R_B‖² = 2 arm² angle² for small angles
        let weight = 0.5 * ARM * ARM;
        for pair in pairs {
            let rotation = rotation_rows(pair);
            q += rotation.transpose() * rotation * weight;
            let g = translation_rows(pair);
            let mut d = SMatrix::<f64, 3, 6>::zeros();
            d.fixed_view_mut::<3, 3>(0, 0).copy_from(&pair.r_a());
            d.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Matrix3::identity());
            q += g.transpose() * g;
            normal += d.transpose() * d;
            mixed += d.transpose() * g;
        }
        let translation_by = -pseudo_inverse(&normal) * mixed;
        q += mixed.transpose() * translation_by;
        Self { q: 0.5 * (q + q.transpose()), translation_by }
    }

    /// The cost at a pair of rotations, translations at their best.
    pub fn at(&self, r: &Rotations) -> f64 {
        let z = r.z();
        z.dot(&(self.q * z))
    }

    /// Both poses of a pair of rotations.
    pub fn hand_eye(&self, r: &Rotations) -> HandEye {
        let t = self.translation_by * r.z();
        HandEye {
            mount_from_camera: Pose::from_parts(&r.x, t.fixed_rows::<3>(0).into()),
            anchor_from_target: Pose::from_parts(&r.y, t.fixed_rows::<3>(3).into()),
        }
    }
}

/// `vec(R_A R_X - R_Y R_B)` by `z`.
fn rotation_rows(pair: &PosePair) -> SMatrix<f64, 9, N> {
    let mut rows = SMatrix::<f64, 9, N>::zeros();
    let i = Matrix3::identity();
    rows.fixed_view_mut::<9, 9>(0, 0).copy_from(&i.kronecker(&pair.r_a()));
    rows.fixed_view_mut::<9, 9>(0, 9).copy_from(&-pair.r_b().transpose().kronecker(&i));
    rows
}

/// `t_A - R_Y t_B` by `z`.
fn translation_rows(pair: &PosePair) -> SMatrix<f64, 3, N> {
    let mut rows = SMatrix::<f64, 3, N>::zeros();
    let by_y = -pair.t_b().transpose().kronecker(&Matrix3::identity());
    rows.fixed_view_mut::<3, 9>(0, 9).copy_from(&by_y);
    rows.fixed_view_mut::<3, 1>(0, 18).copy_from(&pair.t_a());
    rows
}

fn pseudo_inverse(m: &Matrix6<f64>) -> Matrix6<f64> {
    let svd = linalg::svd(&DMatrix::from_column_slice(6, 6, m.as_slice()));
    let mut inverse = Matrix6::zeros();
    for k in (0..6).filter(|&k| svd.s[k] > RANK * svd.s[0]) {
        let column = |m: &DMatrix<f64>| Vector6::from_fn(|i, _| m[(i, k)]);
        inverse += column(&svd.v) * column(&svd.u).transpose() / svd.s[k];
    }
    inverse
}

/// `R_X` and `R_Y`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rotations {
    x: Matrix3<f64>,
    y: Matrix3<f64>,
}

/// Steps of the descent; ten do from a closed form.
const MOST_STEPS: usize = 200;
/// Damping beyond which no step descends any more.
const MOST_DAMPING: f64 = 1e12;

impl Rotations {
    pub fn of(hand_eye: &HandEye) -> Self {
        Self { x: hand_eye.mount_from_camera.rotation(), y: hand_eye.anchor_from_target.rotation() }
    }

    pub fn z(&self) -> Z {
        let entries = self.x.iter().chain(self.y.iter()).copied().chain([1.0]);
        Z::from_iterator(entries)
    }

    fn moved(&self, by: &Vector6<f64>) -> Self {
        let turn = |r: &Matrix3<f64>, w: Vector3<f64>| {
            let turned = Pose::<(), ()>::from_parts(r, Vector3::zeros()).iso()
                * Isometry3::from_parts(Vector3::zeros().into(), lie::so3_exp(&w));
            turned.rotation.to_rotation_matrix().into_inner()
        };
        Self { x: turn(&self.x, lie::omega(by)), y: turn(&self.y, lie::nu(by)) }
    }

    /// The nearest minimum of the cost: damped Newton steps on both rotations.
    pub(crate) fn polished(mut self, cost: &Cost) -> Self {
        let (mut here, mut damping) = (cost.at(&self), 0.0);
        for _ in 0..MOST_STEPS {
            let (g, h) = self.derivatives(&cost.q);
            let unit = h.norm().max(f64::MIN_POSITIVE);
            let damped = h + Matrix6::identity() * (damping * unit);
            let step = damped.cholesky().map(|c| -c.solve(&g));
            let next = step.map(|s| self.moved(&s));
            let there = next.map_or(f64::INFINITY, |n| cost.at(&n));
            if let Some(next) = next
                && there < here
            {
                (self, here) = (next, there);
                damping *= 0.1;
            } else if step.is_some_and(|s| s.norm() < 1e-12) || damping > MOST_DAMPING {
                break;
            } else {
                damping = if damping < 1e-9 { 1e-6 } else { damping * 10.0 };
            }
        }
        self
    }

    /// Gradient and Hessian of `zᵀ Q z` by rotations `R exp(δ)`.
    fn derivatives(&self, q: &Form) -> (Vector6<f64>, Matrix6<f64>) {
        let qz = q * self.z();
        let mut j = SMatrix::<f64, N, 6>::zeros();
        let mut h = Matrix6::zeros();
        for (block, r) in [(0, &self.x), (1, &self.y)] {
            for k in 0..3 {
                let by = r * lie::hat(&Vector3::ith(k, 1.0));
                j.fixed_view_mut::<9, 1>(9 * block, 3 * block + k).copy_from_slice(by.as_slice());
            }
            // R exp(δ) = R (I + [δ] + [δ]²/2), [δ]² = δ δᵀ - |δ|² I
            let g = r.transpose() * Matrix3::from_column_slice(&qz.as_slice()[9 * block..][..9]);
            let bend = g + g.transpose() - Matrix3::identity() * (2.0 * g.trace());
            h.fixed_view_mut::<3, 3>(3 * block, 3 * block).copy_from(&bend);
        }
        (2.0 * j.transpose() * qz, h + 2.0 * j.transpose() * q * j)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{noisy_pairs, truths};

    #[test]
    fn the_form_is_the_cost() {
        let pairs = noisy_pairs(&truths()[0], 8);
        let cost = Cost::of(&pairs);
        let r = Rotations::of(&truths()[0]).moved(&Vector6::new(0.1, 0.2, -0.1, 0.05, 0.0, 0.3));
        let found = cost.hand_eye(&r);
        let sum: f64 = pairs
            .iter()
            .map(|p| {
                let left = p.anchor_from_mount * found.mount_from_camera;
                let right = found.anchor_from_target * p.camera_from_target.inverse();
                let turn = (left.rotation() - right.rotation()).norm_squared();
                0.5 * ARM * ARM * turn + (left.translation() - right.translation()).norm_squared()
            })
            .sum();
        assert!((sum - cost.at(&r)).abs() < 1e-12 * sum.max(1.0), "{sum} {}", cost.at(&r));
    }

    #[test]
    fn derivatives_match_central_differences() {
        let cost = Cost::of(&noisy_pairs(&truths()[0], 8));
        let r = Rotations::of(&truths()[0]).moved(&Vector6::new(0.1, 0.2, -0.1, 0.05, 0.0, 0.3));
        let (g, h) = r.derivatives(&cost.q);
        for k in 0..6 {
            let at = |s: f64| r.moved(&Vector6::ith(k, s));
            let slope = (cost.at(&at(1e-6)) - cost.at(&at(-1e-6))) / 2e-6;
            assert!((slope - g[k]).abs() < 1e-7, "{k}: {slope} {}", g[k]);
            let bend = (cost.at(&at(1e-4)) - 2.0 * cost.at(&r) + cost.at(&at(-1e-4))) / 1e-8;
            assert!((bend - h[(k, k)]).abs() < 1e-5 * h.norm(), "{k}: {bend} {}", h[(k, k)]);
        }
    }
}
