//! The equations of a fit at one point.

use crate::{
    HandEye,
    estimate::{
        NoiseModel, Problem, Source,
        noise::{COLUMNS, Factor, Variances},
        system::sights::Sights,
        touch_residual::TouchRows,
    },
    solve::{least_squares, least_squares::Vector12},
};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix6};

/// Where the fit stands.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub hand_eye: HandEye,
    pub values: DVector<f64>,
    pub noise: NoiseModel,
}

impl State {
    pub fn new(problem: &Problem, hand_eye: HandEye, noise: NoiseModel) -> Self {
        Self { hand_eye, values: DVector::zeros(problem.extras.len()), noise }
    }

    pub(super) fn moved(&self, step: &DVector<f64>) -> Self {
        let twelve = Vector12::from_fn(|i, _| step[i]);
        Self {
            hand_eye: least_squares::moved(&self.hand_eye, &twelve),
            values: &self.values + step.rows(12, self.values.len()),
            noise: self.noise.clone(),
        }
    }
}

/// Normal equations at one point.
pub(crate) struct System {
    pub h: DMatrix<f64>,
    pub g: DVector<f64>,
    pub(super) cost: f64,
    pub(super) cost_of_sights: f64,
    pub(super) log_determinant: f64,
    pub(super) sights: Sights,
    /// Six rows a view, divided by the root of their covariance.
    pub(super) jacobian: DMatrix<f64>,
    pub(super) residual: DVector<f64>,
    pub(super) views: Vec<ViewNoise>,
    pub(super) boards: Vec<BoardBlock>,
    pub(super) levels: Vec<Level>,
}

/// Unknowns whose prior size is a level that is estimated.
pub(crate) struct Level {
    pub source: Source,
    /// Their numbers among all unknowns.
    pub which: Vec<usize>,
    /// What the level is now.
    pub variance: f64,
    /// The sum of their squares.
    pub squares: f64,
}

impl Level {
    pub(super) fn all(problem: &Problem, state: &State, variances: &Variances) -> Vec<Self> {
        let one = |source: Source| {
            let own = |k: &usize| problem.extras[*k].kind.level() == Some(source);
            let extras: Vec<usize> = (0..problem.extras.len()).filter(own).collect();
            let variance = variances[source.index()];
            let squares = extras.iter().map(|&k| state.values[k].powi(2)).sum();
            Self { source, which: extras.iter().map(|k| 12 + k).collect(), variance, squares }
        };
        let levels = Source::ALL.into_iter().filter(|s| s.is_level()).map(one);
        levels.filter(|level| !level.which.is_empty() && level.variance > 0.0).collect()
    }
}

pub(crate) struct BoardBlock {
    pub(super) rows: TouchRows,
    pub(super) cholesky: Cholesky<f64, Dyn>,
}

/// What a view's six equations were divided by, and the noise's factor, divided likewise.
pub(crate) struct ViewNoise {
    pub factor: Factor,
    pub columns: [Source; COLUMNS],
    pub root: Matrix6<f64>,
}
