//! How far the answer moves where a group of views is left out.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::super::{Problem, extra::ExtraKind};
use crate::{
    estimate::system::state::{State, System},
    math::linalg,
};

/// What leaving out a group of views does.
pub(crate) struct Steps {
    /// Its pull, with the information of all views.
    pub by_all: DVector<f64>,
    /// The step to the answer of the others.
    pub by_others: DVector<f64>,
}

impl System {
    /// The step that follows where each group of views is left out in turn: with the information of all views, and
    /// with that of the others.
    pub(crate) fn steps_without(
        &self,
        problem: &Problem,
        state: &State,
        groups: &[Vec<usize>],
    ) -> Option<Vec<Steps>> {
        groups.iter().map(|group| self.step_without(problem, state, group)).collect()
    }

    fn step_without(&self, problem: &Problem, state: &State, group: &[usize]) -> Option<Steps> {
        let mut h = self.h.clone();
        let mut g = self.g.clone();
        for &i in group {
            let j = self.jacobian.rows(6 * i, 6).into_owned();
            h -= j.tr_mul(&j);
            g -= j.tr_mul(&self.residual.rows(6 * i, 6));
            let (information, gradient) = self.said_by_corners(problem, state, i);
            let p = gradient.len();
            let mut own = h.view_mut((12, 12), (p, p));
            own -= information;
            let mut own = g.rows_mut(12, p);
            own -= gradient;
        }
        let solved = |h: &DMatrix<f64>| {
            let (scaled, scale) = linalg::scaled(h)?;
            let cholesky = Cholesky::new(scaled)?;
            Some(-cholesky.solve(&g.component_mul(&scale)).component_mul(&scale))
        };
        Some(Steps { by_all: solved(&self.h)?, by_others: solved(&h)? })
    }

    /// What the corners of one view say of the camera, and how it pulls here.
    fn said_by_corners(
        &self,
        problem: &Problem,
        state: &State,
        i: usize,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let p = problem.extras.len();
        let mut information = DMatrix::zeros(p, p);
        let mut gradient = DVector::zeros(p);
        let Some(sight) = &problem.views[i].sight else { return (information, gradient) };
        let scale = 1.0 / super::sights::variance(&state.noise.variances());
        let number = |k: usize| match problem.extras[k].kind {
            ExtraKind::Camera(which) => Some(which),
            _ => None,
        };
        for (k, a) in (0..p).filter_map(|k| Some((k, number(k)?))) {
            gradient[k] += sight.gradient[a] * scale;
            for (l, b) in (0..p).filter_map(|l| Some((l, number(l)?))) {
                information[(k, l)] += sight.information[(a, b)] * scale;
            }
        }
        gradient += &information * &state.values;
        (information, gradient)
    }
}
