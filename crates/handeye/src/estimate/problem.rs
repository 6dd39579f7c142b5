//! What is to be fitted, and the answer.

use crate::{
    HandEye, KnownPosition, Setup,
    estimate::{Extra, ExtraKind, NoiseModel, TouchedBoard},
    solve::View,
};
use nalgebra::{DMatrix, DVector};

/// All that the fit rests on.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Who carries the camera.
    pub setup: Setup,
    /// Captures.
    pub views: Vec<View>,
    /// Touched boards.
    pub boards: Vec<TouchedBoard>,
    /// What is free beside `X` and `Y`.
    pub extras: Vec<Extra>,
    /// What the user knows of where the camera sits.
    pub known_position: Option<KnownPosition>,
}

impl Problem {
    /// The same where nothing stands for what views and touches differ by.
    pub(crate) fn without_systematic(&self) -> Self {
        let keep = |e: &&Extra| !matches!(e.kind, ExtraKind::Systematic(_));
        Self { extras: self.extras.iter().filter(keep).copied().collect(), ..self.clone() }
    }

    /// The same with another prior of the tip, m per axis.
    pub(crate) fn with_tip(&self, prior_sigma: f64) -> Self {
        let with_prior = |e: &Extra| match e.kind {
            ExtraKind::Tip(_) => Extra { prior_sigma, ..*e },
            _ => *e,
        };
        Self { extras: self.extras.iter().map(with_prior).collect(), ..self.clone() }
    }
}

/// The answer, and how sure it is.
#[derive(Debug, Clone, PartialEq)]
pub struct JointFit {
    /// Both poses.
    pub hand_eye: HandEye,
    /// What else was free.
    pub extras: Vec<Extra>,
    /// The values of the extras.
    pub values: DVector<f64>,
    /// Covariance of `(X, Y, extras)`; `None` where a direction is free.
    pub covariance: Option<DMatrix<f64>>,
    /// Information of `(X, Y, extras)`.
    pub information: DMatrix<f64>,
    /// Gradient of half the cost by `(X, Y, extras)`; zero to within the last step.
    pub gradient: DVector<f64>,
    /// Noise of each source, per axis.
    pub noise: NoiseModel,
    /// `Σ rᵀ V⁻¹ r`.
    pub chi_squared: f64,
    /// Equations minus unknowns.
    pub degrees_of_freedom: f64,
    /// The cost that was minimised, priors included.
    pub cost: f64,
    /// Logarithm of the restricted likelihood, up to a constant.
    pub log_likelihood: f64,
}
