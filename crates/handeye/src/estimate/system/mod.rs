//! The equations of the joint fit at one point, and the step that they give.
//!
//! The method is told in [`super::joint`]; `views` has the equations of a view, `sights` what the
//! corners say about the camera, `reml` the noise that the residuals show, `regressors` what noise passes
//! off as information, `groups` what the answer is without some of the views.

mod groups;
mod regressors;
mod reml;
mod sights;
pub(super) mod state;
mod views;

use std::ops::AddAssign;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::{
    JointFit, Problem,
    extra::Extra,
    noise::NoiseModel,
    touch_residual::{self, TouchedBoard},
};
use crate::{
    estimate::{
        noise::Variances,
        system::state::{BoardBlock, Level, State, System},
    },
    math::{
        linalg::{self, FREE_SIGMA},
        optimize::{self, Damping, Rules, Singular, Tried},
    },
    solve::least_squares,
};
pub(crate) use groups::Steps;
use sights::Sights;
use views::{SeenMount, divide};

/// A step shorter than this, squared and in units of the information, needs no check: the model is
/// as good as linear there.
const NEAR: f64 = 1e-2;

/// Of the search for one step that lowers the cost, the undamped one first.
const RULES: Rules = Rules {
    most_steps: 20,
    damping: Damping {
        start: 0.0,
        negligible: f64::MIN_POSITIVE,
        raised: 1e-4,
        least: 0.0,
        most: f64::INFINITY,
    },
    slack: 1e-12,
    singular: Singular::IsDamped,
};

impl System {
    pub fn at(problem: &Problem, state: &State) -> Self {
        let p = 12 + problem.extras.len();
        let variances = state.noise.variances();
        let mut system = Self {
            h: DMatrix::zeros(p, p),
            g: DVector::zeros(p),
            cost: 0.0,
            cost_of_sights: 0.0,
            log_determinant: 0.0,
            sights: Sights::of(problem, &variances),
            jacobian: DMatrix::zeros(6 * problem.views.len(), p),
            residual: DVector::zeros(6 * problem.views.len()),
            views: Vec::with_capacity(problem.views.len()),
            boards: vec![],
            levels: Level::all(problem, state, &variances),
        };
        system.add_views(problem, state, &variances);
        for board in &problem.boards {
            system.add_board(board_block(problem, board, state, &variances));
        }
        system.add_sights(state);
        system.add_priors(problem, state, &variances);
        system.add_known_position(problem, state);
        (0..12).for_each(|k| system.h[(k, k)] += FREE_SIGMA.powi(-2));
        system
    }

    /// Whether the prior size of unknowns is a level that is estimated.
    pub(crate) fn has_levels(&self) -> bool {
        !self.levels.is_empty()
    }

    fn add_known_position(&mut self, problem: &Problem, state: &State) {
        let Some(known) = &problem.known_position else { return };
        let x = &state.hand_eye.mount_from_camera;
        let j = known.axis.transpose() * x.rotation() / known.sigma_m;
        let e = known.residual(x);
        for a in 0..3 {
            self.g[3 + a] += j[a] * e;
            for b in 0..3 {
                self.h[(3 + a, 3 + b)] += j[a] * j[b];
            }
        }
        self.cost += e * e;
    }

    /// A root `W` of the covariance, `C = W Wᵀ`.
    fn covariance_root(&self) -> Option<DMatrix<f64>> {
        let n = self.h.nrows();
        let (scaled, scale) = linalg::scaled(&self.h)?;
        if let Some(cholesky) = Cholesky::new(scaled) {
            let inverse = cholesky.l().solve_lower_triangular(&DMatrix::identity(n, n))?;
            return Some(DMatrix::from_fn(n, n, |i, j| inverse[(j, i)] * scale[i]));
        }
        let eigen = self.covariance()?.symmetric_eigen();
        let roots = eigen.eigenvalues.map(|v| v.max(0.0).sqrt());
        Some(eigen.eigenvectors * DMatrix::from_diagonal(&roots))
    }

    /// Inverse of the information; what the data leave free has [`FREE_SIGMA`].
    fn covariance(&self) -> Option<DMatrix<f64>> {
        linalg::inverse_with_free(&self.h)
    }

    /// The same, believed only as far as it is not the robot's own noise that passes for information.
    pub(crate) fn stated_covariance(&self, noise: &NoiseModel) -> Option<DMatrix<f64>> {
        self.covariance().map(|c| self.believed(c, noise))
    }

    fn add_sights(&mut self, state: &State) {
        let sights = &self.sights;
        let moved = &sights.information * &state.values;
        let p = state.values.len();
        self.h.view_mut((12, 12), (p, p)).add_assign(&sights.information);
        self.g.rows_mut(12, p).add_assign(&sights.gradient + moved);
        self.cost_of_sights = sights.cost(&state.values);
        self.cost += self.cost_of_sights;
    }

    fn add_views(&mut self, problem: &Problem, state: &State, variances: &Variances) {
        let seen = SeenMount::of(problem, state);
        for (i, view) in problem.views.iter().enumerate() {
            let noise = self.fill(6 * i, view, problem, state, &seen, variances);
            self.views.push(noise);
        }
        add_squares(&mut self.h, &self.jacobian);
        self.g.gemv_tr(1.0, &self.jacobian, &self.residual, 1.0);
        self.cost += self.residual.norm_squared();
        for view in &self.views {
            let product: f64 = view.root.diagonal().iter().product();
            self.log_determinant += 2.0 * product.ln();
        }
    }

    fn add_board(&mut self, block: BoardBlock) {
        let u = block.cholesky.solve(&block.rows.residual);
        let vj = block.cholesky.solve(&block.rows.jacobian);
        self.h.gemm_tr(1.0, &block.rows.jacobian, &vj, 1.0);
        self.g.gemv_tr(1.0, &block.rows.jacobian, &u, 1.0);
        self.cost += block.rows.residual.dot(&u);
        let root = block.cholesky.l_dirty();
        self.log_determinant += 2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>();
        self.boards.push(block);
    }

    fn add_priors(&mut self, problem: &Problem, state: &State, variances: &Variances) {
        for (k, extra) in problem.extras.iter().enumerate() {
            let weight = extra.prior_variance(variances).recip();
            let away = state.values[k] - extra.prior_mean;
            self.h[(12 + k, 12 + k)] += weight;
            self.g[12 + k] += weight * away;
            self.cost += weight * away.powi(2);
        }
    }

    /// One damped step that lowers the cost; its squared length in units of the information.
    pub(crate) fn advance(&self, problem: &Problem, state: &mut State) -> f64 {
        let here = Cost(self.cost);
        let end = optimize::descend(&Advance { problem, system: self }, state, here, &RULES);
        end.step.map_or(0.0, |step| step.length)
    }

    fn step(&self, damping: f64) -> Option<DVector<f64>> {
        let mut h = self.h.clone();
        (0..h.nrows()).for_each(|k| h[(k, k)] *= 1.0 + damping);
        let (scaled, scale) = linalg::scaled(&h)?;
        let cholesky = Cholesky::new(scaled)?;
        let solve =
            |g: &DVector<f64>| cholesky.solve(&g.component_mul(&scale)).component_mul(&scale);
        let step = solve(&self.g);
        // one round of refinement of the linear solution
        let rest = &self.g - &h * &step;
        Some(-(&step + solve(&rest)))
    }

    /// The cost elsewhere, for the weights of here.
    fn cost_at(&self, problem: &Problem, state: &State) -> f64 {
        let mut cost = 0.0;
        let seen = SeenMount::of(problem, state);
        for (view, noise) in problem.views.iter().zip(&self.views) {
            let pair = view.with(&problem.extras, &state.values);
            let mut r = least_squares::residual(&seen.hand_eye, &pair);
            divide(&noise.root, r.as_mut_slice());
            cost += r.norm_squared();
        }
        let variances = state.noise.variances();
        for (board, block) in problem.boards.iter().zip(&self.boards) {
            let rows = touch_residual::rows(
                board,
                &state.hand_eye,
                &problem.extras,
                &state.values,
                &variances,
                problem.setup,
            );
            cost += rows.residual.dot(&block.cholesky.solve(&rows.residual));
        }
        let known = problem.known_position.as_ref();
        cost += known.map_or(0.0, |k| k.residual(&state.hand_eye.mount_from_camera).powi(2));
        let prior =
            |(e, x): (&Extra, &f64)| (x - e.prior_mean).powi(2) / e.prior_variance(&variances);
        let priors: f64 = problem.extras.iter().zip(&state.values).map(prior).sum();
        cost + priors + self.sights.cost(&state.values)
    }

    /// The cost without what the corners say about the camera.
    pub(crate) fn cost_of_poses(&self) -> f64 {
        self.cost - self.cost_of_sights
    }

    pub fn finish(self, problem: &Problem, state: State) -> JointFit {
        let covariance = self.stated_covariance(&state.noise);
        let rows = self.boards.iter().map(|b| b.rows.residual.len()).sum::<usize>();
        let equations = 6 * self.views.len() + rows;
        let log_h = Cholesky::new(self.h.clone()).map_or(f64::INFINITY, |c| {
            2.0 * c.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
        });
        let variances = state.noise.variances();
        let log_prior: f64 = problem.extras.iter().map(|e| e.prior_variance(&variances).ln()).sum();
        let chi_squared = self.cost_of_poses();
        JointFit {
            hand_eye: state.hand_eye,
            extras: problem.extras.clone(),
            values: state.values,
            covariance,
            information: self.h,
            gradient: self.g,
            noise: state.noise,
            chi_squared,
            degrees_of_freedom: equations as f64 - 12.0,
            cost: self.cost,
            log_likelihood: -0.5 * (self.log_determinant + log_h + log_prior + self.cost),
        }
    }
}

/// The cost of a state, for the equations and weights of another.
#[derive(Clone, Copy)]
struct Cost(f64);

struct Step {
    by: DVector<f64>,
    /// Squared, in units of the information.
    length: f64,
}

/// One step from where a system stands: the next one needs a system with the noise of there.
struct Advance<'a> {
    problem: &'a Problem,
    system: &'a System,
}

impl optimize::Problem for Advance<'_> {
    type Point = State;
    type Equations = Cost;
    type Step = Step;

    fn equations(&self, at: &State) -> Option<Cost> {
        Some(Cost(self.system.cost_at(self.problem, at)))
    }

    fn cost(&self, here: &Cost) -> f64 {
        here.0
    }

    fn step(&self, _: &State, _: &Cost, damping: f64) -> Option<Step> {
        let by = self.system.step(damping)?;
        let length = by.dot(&(&self.system.h * &by));
        Some(Step { by, length })
    }

    fn moved(&self, at: &State, step: &Step) -> State {
        at.moved(&step.by)
    }

    fn is_last(&self, tried: &Tried<Step>) -> bool {
        tried.is_taken
    }

    fn is_trusted(&self, step: &Step, _: f64, _: bool) -> bool {
        step.length < NEAR
    }
}

/// `H + JᵀJ`, both halves.
fn add_squares(h: &mut DMatrix<f64>, j: &DMatrix<f64>) {
    let columns: Vec<&[f64]> = j.as_slice().chunks_exact(j.nrows().max(1)).collect();
    for (a, left) in columns.iter().enumerate() {
        for (b, right) in columns[..=a].iter().enumerate() {
            let sum = sum_of_products(left, right);
            h[(a, b)] += sum;
            if a != b {
                h[(b, a)] += sum;
            }
        }
    }
}

/// In four sums, which a processor adds side by side.
fn sum_of_products(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    sums[0] + sums[1] + (sums[2] + sums[3]) + rest
}

fn board_block(
    problem: &Problem,
    board: &TouchedBoard,
    state: &State,
    variances: &Variances,
) -> BoardBlock {
    let rows = touch_residual::rows(
        board,
        &state.hand_eye,
        &problem.extras,
        &state.values,
        variances,
        problem.setup,
    );
    let n = rows.covariance.nrows();
    let cholesky = Cholesky::new(rows.covariance.clone())
        .unwrap_or_else(|| Cholesky::pack_dirty(DMatrix::identity(n, n)));
    BoardBlock { rows, cholesky }
}
