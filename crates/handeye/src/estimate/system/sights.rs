//! What all corners say about the camera beyond the poses.

use nalgebra::{DMatrix, DVector};

use super::super::{Problem, extra::ExtraKind, noise::Source};
use crate::estimate::noise::Variances;

/// `Σ (cᵀ S c + 2 sᵀ c)/θ_picture`.
pub(super) struct Sights {
    pub information: DMatrix<f64>,
    pub gradient: DVector<f64>,
}

/// An image's noise is not less than this part of what its corners state (variance): exact data
/// would leave nothing to divide by.
const LEAST_PICTURE: f64 = 1e-6;

/// By how much corners err more than they state (variance).
pub(super) fn variance(variances: &Variances) -> f64 {
    variances[Source::Picture.index()].max(LEAST_PICTURE)
}

impl Sights {
    pub fn of(problem: &Problem, variances: &Variances) -> Self {
        let p = problem.extras.len();
        let mut sum = Self { information: DMatrix::zeros(p, p), gradient: DVector::zeros(p) };
        let parameter = |k: usize| match problem.extras[k].kind {
            ExtraKind::Camera(which) => Some((k, which)),
            _ => None,
        };
        let free: Vec<(usize, usize)> = (0..p).filter_map(parameter).collect();
        if free.is_empty() {
            return sum;
        }
        let scale = 1.0 / variance(variances);
        let placed = problem.boards.iter().filter_map(|b| b.seen.as_ref());
        for sight in problem.views.iter().chain(placed).filter_map(|v| v.sight.as_ref()) {
            for &(k, a) in &free {
                sum.gradient[k] += sight.gradient[a] * scale;
                for &(l, b) in &free {
                    sum.information[(k, l)] += sight.information[(a, b)] * scale;
                }
            }
        }
        sum
    }

    pub fn cost(&self, values: &DVector<f64>) -> f64 {
        values.dot(&(&self.information * values)) + 2.0 * self.gradient.dot(values)
    }
}
