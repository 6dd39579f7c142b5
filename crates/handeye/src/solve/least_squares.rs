//! One capture as the fits see it, and least squares over captures with one weight for all.
//!
//! ```text
//! r_i = log(C_i⁻¹ X⁻¹ A_i⁻¹ Y)
//! ∂r/∂X = -J_l⁻¹(r) Ad(C_i⁻¹)          ∂r/∂Y = J_r⁻¹(r)          ∂r/∂C = -J_l⁻¹(r)
//! ```
//!
//! with `X = mount_from_camera`, `Y = anchor_from_target`, all perturbed on the right.

use std::sync::Arc;

use nalgebra::{DMatrix, Matrix6, SMatrix, SVector, Vector6};

use crate::{
    HandEye, PosePair,
    detect::Sight,
    math::{
        lie, linalg,
        optimize::{self, Damping, Problem, Rules, Singular, Tried},
    },
};

/// One capture as the fit sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Robot pose and target pose.
    pub pair: PosePair,
    /// Covariance of the target pose, in the Target frame; `None` when unknown.
    pub covariance: Option<Matrix6<f64>>,
    /// How the target pose depends on camera and target, and what the corners say about these.
    pub sight: Option<Arc<Sight>>,
    /// How the robot pose moves with the arm's deviations: 6 rows, rotation first, for
    /// `anchor_from_mount` perturbed on the right.
    pub by_robot: Option<Arc<DMatrix<f64>>>,
}

impl View {
    /// A pose that came from elsewhere, of unknown covariance.
    pub fn bare(pair: PosePair) -> Self {
        Self { pair, covariance: None, sight: None, by_robot: None }
    }

    /// How the target pose moves with one parameter.
    pub(crate) fn by_camera(&self, which: usize) -> Vector6<f64> {
        self.sight.as_ref().map_or_else(Vector6::zeros, |s| s.by_camera.column(which).into())
    }

    /// How the robot pose moves with one deviation of the arm.
    pub(crate) fn by_robot(&self, which: usize) -> Vector6<f64> {
        self.by_robot
            .as_ref()
            .filter(|m| which < m.ncols())
            .map_or_else(Vector6::zeros, |m| m.fixed_view::<6, 1>(0, which).into())
    }
}

/// Information and covariance of both unknowns: X first, then Y.
pub(crate) type Matrix12 = SMatrix<f64, 12, 12>;
pub(crate) type Vector12 = SVector<f64, 12>;
type Matrix6x12 = SMatrix<f64, 6, 12>;

/// Of one fit: steps of Gauss and Newton as long as these lower the cost; from a closed form it takes five.
const RULES: Rules = Rules {
    most_steps: 100,
    damping: Damping {
        start: 0.0,
        negligible: 1e-9,
        raised: 1e-6,
        least: 0.0,
        most: 1e8_f64.next_down(),
    },
    slack: 0.0,
    singular: Singular::IsDamped,
};
/// The fit has converged when a step changes the cost by less than this part of it.
const COST_CHANGE: f64 = 1e-14;
/// The residual of one view, `r_i`.
pub fn residual(hand_eye: &HandEye, pair: &PosePair) -> Vector6<f64> {
    lie::log(hand_eye.loop_error(pair).inverse().iso())
}

/// The residual and its Jacobian by `(X, Y)`.
pub(crate) fn residual_with_jacobian(
    hand_eye: &HandEye,
    pair: &PosePair,
) -> (Vector6<f64>, SMatrix<f64, 6, 12>) {
    let r = residual(hand_eye, pair);
    let inverse = lie::left_jacobian_inverse(&r);
    let by_x = -lie::left_jacobian_inverse_after(&r, pair.camera_from_target.inverse().iso());
    let mut j = Matrix6x12::zeros();
    j.fixed_view_mut::<6, 6>(0, 0).copy_from(&by_x);
    j.fixed_view_mut::<6, 6>(0, 6).copy_from(&(inverse + lie::ad(&r)));
    (r, j)
}

/// Normal equations at one point, for weights held still.
struct Normal {
    h: Matrix12,
    g: Vector12,
    cost: f64,
}

fn normal(views: &[View], weights: &[Matrix6<f64>], at: &HandEye) -> Normal {
    let mut sum = Normal { h: Matrix12::zeros(), g: Vector12::zeros(), cost: 0.0 };
    for (view, w) in views.iter().zip(weights) {
        let (r, j) = residual_with_jacobian(at, &view.pair);
        let jw = j.transpose() * w;
        sum.h += jw * j;
        sum.g += jw * r;
        sum.cost += r.dot(&(w * r));
    }
    sum
}

pub(crate) fn moved(at: &HandEye, step: &Vector12) -> HandEye {
    let half = |k: usize| Vector6::from_fn(|i, _| step[k + i]);
    HandEye {
        mount_from_camera: at.mount_from_camera.retract(&half(0)),
        anchor_from_target: at.anchor_from_target.retract(&half(6)),
    }
}

/// Views with weights held still.
struct Weighted<'a> {
    views: &'a [View],
    weights: &'a [Matrix6<f64>],
}

impl Problem for Weighted<'_> {
    type Point = HandEye;
    type Equations = Normal;
    type Step = Vector12;

    fn equations(&self, at: &HandEye) -> Option<Normal> {
        Some(normal(self.views, self.weights, at))
    }

    fn cost(&self, here: &Normal) -> f64 {
        here.cost
    }

    fn step(&self, _: &HandEye, here: &Normal, damping: f64) -> Option<Vector12> {
        damped_step(here, damping)
    }

    fn moved(&self, at: &HandEye, step: &Vector12) -> HandEye {
        moved(at, step)
    }

    fn is_last(&self, tried: &Tried<Vector12>) -> bool {
        let gain = tried.before - tried.after;
        gain.is_nan() || gain.abs() <= COST_CHANGE * tried.before
    }
}

fn minimise(views: &[View], weights: &[Matrix6<f64>], start: &HandEye) -> HandEye {
    let problem = Weighted { views, weights };
    let mut at = *start;
    optimize::descend(&problem, &mut at, normal(views, weights, start), &RULES);
    at
}

fn damped_step(at: &Normal, damping: f64) -> Option<Vector12> {
    let mut h = at.h;
    for k in 0..12 {
        h[(k, k)] *= 1.0 + damping;
    }
    let inverse = linalg::invert_spd(&h)?;
    let step = -(inverse * at.g);
    // one round of refinement of the linear solution
    Some(step - inverse * (at.g + h * step))
}

/// Fits both unknowns with one weight for all: 1 rad of residual costs as much as `metres_per_rad`.
pub(crate) fn fit_fixed_weights(views: &[View], start: &HandEye, metres_per_rad: f64) -> HandEye {
    let rotation = metres_per_rad * metres_per_rad;
    let weight = Matrix6::from_diagonal(&Vector6::new(rotation, rotation, rotation, 1.0, 1.0, 1.0));
    minimise(views, &vec![weight; views.len()], start)
}

/// Fits both unknowns with a weight for each view, 6 x 6 on its residual (rotation first).
pub(crate) fn fit_weighted(views: &[View], weights: &[Matrix6<f64>], start: &HandEye) -> HandEye {
    minimise(views, weights, start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{exact_pairs, truths};

    fn views(count: usize) -> Vec<View> {
        exact_pairs(&truths()[0], count).into_iter().map(View::bare).collect()
    }

    #[test]
    fn jacobian_matches_central_differences() {
        let truth = truths()[0];
        let off = moved(&truth, &Vector12::from_fn(|i, _| 0.3 * (i as f64 + 1.0).sin()));
        for view in views(5) {
            let (_, j) = residual_with_jacobian(&off, &view.pair);
            for k in 0..12 {
                let mut step = Vector12::zeros();
                step[k] = 1e-6;
                let ahead = residual(&moved(&off, &step), &view.pair);
                let behind = residual(&moved(&off, &-step), &view.pair);
                let numeric = (ahead - behind) / 2e-6;
                assert!((j.column(k) - numeric).norm() < 1e-6, "column {k}");
            }
        }
    }
}
