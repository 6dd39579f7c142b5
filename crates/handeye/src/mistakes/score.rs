//! One residual for a capture, one score for all of them.
//!
//! The loop `E = Y⁻¹ A X C` of a capture is the identity where it fits. Its angle and its distance count together,
//!
//! ```text
//! d² = (angle(E) / 0.05°)² + (|t(E)| / 0.7 mm)²        score² = exp(mean ln(1 + d²)) - 1
//! ```
//!
//! The mean of the logarithm takes in every capture and lets none dominate: a few outliers cost little, a convention that
//! fits three captures alone costs much (the Cauchy loss; F. Hampel et al., *Robust Statistics*, 1986).

use super::thresholds::{BELIEVABLE, UNIT};
use crate::{
    model::residual::Residual,
    solve::consensus::{self, Consensus, Readings},
};

/// How well the captures agree under one convention.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Score {
    /// Combined residual, in units of an industrial robot's error.
    pub score: f64,
    /// Median residual of all captures, degrees.
    pub rotation_deg: f64,
    /// Median residual of all captures, mm.
    pub translation_mm: f64,
    /// Captures that agree; none where the median residual is beyond what cells in order reach.
    pub agree: usize,
}

impl Score {
    /// Of captures under what they agree on.
    pub(crate) fn new(captures: &[Readings], found: &Consensus) -> Self {
        let all: Vec<Residual> = (0..captures.len())
            .filter(|&i| !captures[i].camera_from_target.is_empty())
            .map(|i| found.hand_eye.loop_residual(&captures[i].pair(found.reading[i])))
            .collect();
        let median = Residual::median(&all);
        // the consensus compares captures with one another: bad ones that are alike would agree
        let agree = if median.is_within(BELIEVABLE) { agreeing(found).len() } else { 0 };
        Self {
            score: combined(&all),
            rotation_deg: median.angle.to_degrees(),
            translation_mm: median.distance * 1e3,
            agree,
        }
    }

    /// Whether most of so many captures agree.
    pub fn is_most(&self, captures: usize) -> bool {
        2 * self.agree > captures
    }
}

/// The score of captures, and what they agree on.
pub fn scored(captures: &[Readings]) -> Option<(Score, Consensus)> {
    let found = consensus::consensus(captures).ok()?;
    Some((Score::new(captures, &found), found))
}

/// One number for the residuals of all captures.
pub(super) fn combined(all: &[Residual]) -> f64 {
    let log = |r: &Residual| r.over(UNIT).powi(2).ln_1p();
    (all.iter().map(log).sum::<f64>() / all.len().max(1) as f64).exp_m1().sqrt()
}

/// Captures that agree.
pub(super) fn agreeing(found: &Consensus) -> Vec<usize> {
    (0..found.agrees.len()).filter(|&i| found.agrees[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_outlier_costs_little_and_half_of_them_much() {
        let (good, bad) = (UNIT, Residual::of(20.0, 300.0));
        let of =
            |outliers: usize| combined(&[vec![good; 10 - outliers], vec![bad; outliers]].concat());
        assert!((of(0) - 2f64.sqrt()).abs() < 1e-12, "{}", of(0));
        assert!(of(1) < 4.0 && of(5) > 30.0, "{} {}", of(1), of(5));
    }

    #[test]
    fn most_is_more_than_half() {
        let of = |agree| Score { score: 1.0, rotation_deg: 0.0, translation_mm: 0.0, agree };
        assert!(of(5).is_most(9) && !of(5).is_most(10));
    }
}
