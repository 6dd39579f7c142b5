//! The likeliest noise and drift.

use nalgebra::{DMatrix, DVector};

use super::{
    super::noise::{self, KnownNoise},
    kalman::{Line, filter},
};
use crate::{
    HandEye,
    estimate::drift::sequence::{LOG_PRIOR_SIGMA, Levels, MEMORY, Sequence},
};

/// Steps of the search for the likeliest noise.
const MOST_STEPS: usize = 40;
/// Difference for derivatives by logarithms of standard deviations.
const DIFFERENCE: f64 = 1e-5;
/// The search has ended when a step gains less.
const GAIN: f64 = 1e-3;
/// Longest step of one logarithm.
const LONGEST: f64 = 1.5;
/// Inverse of the curvature to begin with.
pub(super) const FIRST_STEP: f64 = 0.1;

/// The search for the likeliest noise and drift, by the method of Broyden, Fletcher, Goldfarb and
/// Shanno.
pub(super) struct Search {
    pub known: KnownNoise,
    /// Prior means of the logarithms.
    pub first: Vec<f64>,
    /// Whether the unit of distances drifts.
    pub scale: bool,
    /// Inverse of the curvature.
    pub inverse: DMatrix<f64>,
}

impl Search {
    /// The place of the memory among the logarithms, where drift is free.
    fn memory(&self, levels: &Levels) -> Option<usize> {
        levels.free.then(|| self.first.len() - 3 - usize::from(self.scale))
    }

    pub fn likeliest(&mut self, sequence: &Sequence, lines: &[Line], at: &mut Climb) {
        let mut levels = at.levels.clone();
        let memory = self.memory(&levels);
        let (known, first, values) = (self.known, self.first.clone(), &at.values);
        let mut cost = |x: &DVector<f64>| {
            levels.set(x.as_slice(), &known);
            // any memory is as likely as any other
            let with_prior = (0..x.len()).filter(|k| memory != Some(*k));
            let prior: f64 =
                with_prior.map(|k| ((x[k] - first[k]) / LOG_PRIOR_SIGMA).powi(2)).sum();
            0.5 * prior - filter(lines, &levels).log_likelihood(sequence, values)
        };
        let mut x = DVector::from_vec(at.levels.get(&known));
        let mut here = cost(&x);
        let mut g = slope(&mut cost, &x, here);
        for _ in 0..MOST_STEPS {
            let mut step = -(&self.inverse * &g);
            if step.dot(&g) >= 0.0 {
                self.inverse = DMatrix::identity(x.len(), x.len()) * FIRST_STEP;
                step = -(&self.inverse * &g);
            }
            step *= (LONGEST / step.amax().max(f64::MIN_POSITIVE)).min(1.0);
            let Some((next, there)) = shortened(&mut cost, &x, step, here, memory) else { break };
            let g_next = slope(&mut cost, &next, there);
            self.learn(&(&next - &x), &(&g_next - &g));
            let gain = here - there;
            (x, here, g) = (next, there, g_next);
            if gain < GAIN {
                break;
            }
        }
        at.levels.set(x.as_slice(), &known);
    }

    /// What a step and the change of the slope along it tell of the curvature.
    fn learn(&mut self, step: &DVector<f64>, change: &DVector<f64>) {
        let along = step.dot(change);
        if along > 1e-12 {
            let n = step.len();
            let left = DMatrix::identity(n, n) - step * change.transpose() / along;
            self.inverse = &left * &self.inverse * left.transpose();
            self.inverse += step * step.transpose() / along;
        }
    }
}

fn slope(cost: &mut impl FnMut(&DVector<f64>) -> f64, x: &DVector<f64>, here: f64) -> DVector<f64> {
    DVector::from_fn(x.len(), |k, _| {
        let mut ahead = x.clone();
        ahead[k] += DIFFERENCE;
        (cost(&ahead) - here) / DIFFERENCE
    })
}

/// Halvings, and more, of a step that does not gain.
const SHORTER: usize = 8;

/// The first point along a step, shortened ever more, that costs less.
fn shortened(
    cost: &mut impl FnMut(&DVector<f64>) -> f64,
    x: &DVector<f64>,
    mut step: DVector<f64>,
    here: f64,
    memory: Option<usize>,
) -> Option<(DVector<f64>, f64)> {
    for _ in 0..SHORTER {
        let mut next = x + &step;
        next.iter_mut().for_each(|v| *v = v.max(noise::LEAST_SIGMA.ln()));
        if let Some(k) = memory {
            next[k] = next[k].clamp(MEMORY.0.ln(), MEMORY.1.ln());
        }
        let there = cost(&next);
        if there < here {
            return Some((next, there));
        }
        step *= 0.3;
    }
    None
}

/// Where a fit has arrived.
pub(crate) struct Climb {
    pub(super) hand_eye: HandEye,
    pub(super) values: DVector<f64>,
    pub(super) levels: Levels,
    pub(super) log_likelihood: f64,
}
