//! Truncated least squares by graduated non-convexity.
//!
//! ```text
//! minimise Σ_i min(d_i², c²)        d² = (angle/σ_r)² + (distance/σ_t)²
//!
//! w_i = 1                        for d_i² ≤ c² μ/(μ + 1)
//!       0                        for d_i² ≥ c² (μ + 1)/μ
//!       c/d_i √(μ (μ + 1)) - μ   between
//! ```
//!
//! For a small `μ` the cost is convex; `μ` grows until every weight is 0 or 1, and each weighted fit
//! starts from the one before. Weights are small altogether in the beginning: they are scaled to a
//! maximum of 1, or the fit would take them for converged.
//!
//! H. Yang, P. Antonante, V. Tzoumas, L. Carlone, *Graduated non-convexity for robust spatial
//! perception: from non-minimal solvers to global outlier rejection*, IEEE RA-L 5(2), 2020.

use nalgebra::{Matrix6, Vector6};

use crate::{
    HandEye,
    model::residual::Residual,
    solve::{View, least_squares::fit_weighted},
};

/// Steps at most: `1.4^100` is beyond any ratio of residuals.
const MOST_STEPS: usize = 100;
/// Factor on `μ` in each step, of the paper.
const GROWTH: f64 = 1.4;

/// The answer from a start; `sigma` per axis, `gate` is `c`.
pub(super) fn graduated(views: &[View], start: &HandEye, sigma: Residual, gate: f64) -> HandEye {
    let (r, t) = (sigma.angle.powi(-2), sigma.distance.powi(-2));
    let unit = Matrix6::from_diagonal(&Vector6::new(r, r, r, t, t, t));
    let squares = |at: &HandEye| -> Vec<f64> {
        let one = |v: &View| {
            let residual = at.loop_residual(&v.pair);
            (residual.angle / sigma.angle).powi(2) + (residual.distance / sigma.distance).powi(2)
        };
        views.iter().map(one).collect()
    };
    let mut at = *start;
    let c2 = gate * gate;
    let worst = squares(&at).into_iter().fold(0.0, f64::max);
    // nothing is near the gate: plain least squares
    let mut mu = if 2.0 * worst > c2 { c2 / (2.0 * worst - c2) } else { f64::INFINITY };
    for _ in 0..MOST_STEPS {
        let weights: Vec<f64> = squares(&at).into_iter().map(|d2| weight(d2, c2, mu)).collect();
        let largest = weights.iter().copied().fold(0.0, f64::max);
        if !(largest > 0.0) {
            break;
        }
        let scaled: Vec<_> = weights.iter().map(|w| unit * (w / largest)).collect();
        at = fit_weighted(views, &scaled, &at);
        if weights.iter().all(|&w| w == 0.0 || w == 1.0) {
            break;
        }
        mu *= GROWTH;
    }
    at
}

fn weight(d2: f64, c2: f64, mu: f64) -> f64 {
    match mu {
        _ if !mu.is_finite() || d2 <= c2 * mu / (mu + 1.0) => 1.0,
        _ if d2 >= c2 * (mu + 1.0) / mu => 0.0,
        _ => (c2 / d2 * mu * (mu + 1.0)).sqrt() - mu,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::{
        least_squares::fit_fixed_weights,
        tests::{assert_same, exact_pairs, truths},
    };

    #[test]
    fn a_start_that_wrong_captures_have_pulled_away_is_left_behind() {
        let truth = truths()[0];
        let mut pairs = exact_pairs(&truth, 15);
        let first = pairs[2].camera_from_target;
        (pairs[2].camera_from_target, pairs[7].camera_from_target) =
            (pairs[7].camera_from_target, first);
        pairs[11].anchor_from_mount = pairs[10].anchor_from_mount;
        let views: Vec<View> = pairs.into_iter().map(View::bare).collect();
        let pulled = fit_fixed_weights(&views, &truth, 0.3);
        assert!(pulled.mount_from_camera.local(&truth.mount_from_camera).norm() > 1e-3);
        let found = graduated(&views, &pulled, Residual { angle: 1e-3, distance: 1e-3 }, 7.0);
        assert_same(found.mount_from_camera, truth.mount_from_camera, "X");
    }

    #[test]
    fn weights_fall_steadily_between_one_and_zero() {
        let all: Vec<f64> = (0..100).map(|k| weight(f64::from(k), 49.0, 2.0)).collect();
        assert_eq!((all[0], all[99]), (1.0, 0.0));
        assert!(all.windows(2).all(|w| w[1] <= w[0] + 1e-12));
    }
}
