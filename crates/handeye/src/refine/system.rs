//! The equations of the joint fit at one point: steps, noise updates, and what they are made of.
//!
//! The method is told in [`super::joint`].

use std::ops::AddAssign;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix6, OMatrix, SMatrix, SVector, U6, Vector6};

use super::{
    JointFit, Problem,
    extra::{Extra, ExtraKind},
    joint::{LEAST_SIGMA, PRIOR_TOUCHES, PRIOR_VIEWS, STEP},
    noise::{self, COLUMNS, Factor, KnownNoise, NoiseModel, Sigma, Source},
    pose_fit::{self, Vector12, View},
    touched::{self, TouchRows, TouchedBoard},
};
use crate::{HandEye, Setup, lie, linalg};

/// Where the fit stands.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub hand_eye: HandEye,
    pub values: DVector<f64>,
    pub noise: NoiseModel,
}

impl State {
    pub fn new(problem: &Problem, hand_eye: HandEye, noise: NoiseModel) -> Self {
        Self { hand_eye, values: DVector::zeros(problem.extras.len()), noise }
    }

    fn moved(&self, step: &DVector<f64>) -> Self {
        let twelve = Vector12::from_fn(|i, _| step[i]);
        Self {
            hand_eye: pose_fit::moved(&self.hand_eye, &twelve),
            values: &self.values + step.rows(12, self.values.len()),
            noise: self.noise.clone(),
        }
    }
}

/// One block of equations, divided by the root of its covariance.
struct ViewBlock {
    residual: Vector6<f64>,
    jacobian: OMatrix<f64, U6, Dyn>,
    factor: Factor,
    columns: [Source; COLUMNS],
    root: Matrix6<f64>,
}

struct BoardBlock {
    rows: TouchRows,
    cholesky: Cholesky<f64, Dyn>,
}

/// Normal equations at one point.
pub(super) struct System {
    pub h: DMatrix<f64>,
    pub g: DVector<f64>,
    cost: f64,
    cost_of_sights: f64,
    log_determinant: f64,
    sights: Sights,
    views: Vec<ViewBlock>,
    boards: Vec<BoardBlock>,
}

type Variances = [f64; Source::ALL.len()];

/// What all corners say about the camera beyond the poses: `Σ (cᵀ S c + 2 sᵀ c)/θ_picture`.
struct Sights {
    information: DMatrix<f64>,
    gradient: DVector<f64>,
}

/// A picture's noise is not less than this part of what its corners state (variance): exact data
/// would leave nothing to divide by.
const LEAST_PICTURE: f64 = 1e-6;

impl Sights {
    fn of(problem: &Problem, variances: &Variances) -> Self {
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
        let scale = 1.0 / variances[Source::Picture.index()].max(LEAST_PICTURE);
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

    fn cost(&self, values: &DVector<f64>) -> f64 {
        values.dot(&(&self.information * values)) + 2.0 * self.gradient.dot(values)
    }
}

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
            views: Vec::with_capacity(problem.views.len()),
            boards: vec![],
        };
        for view in &problem.views {
            system.add_view(view_block(problem, view, state, &variances));
        }
        for board in &problem.boards {
            system.add_board(board_block(problem, board, state, &variances));
        }
        system.add_sights(state);
        system.add_priors(problem, state);
        system
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

    fn add_view(&mut self, block: ViewBlock) {
        self.h.gemm_tr(1.0, &block.jacobian, &block.jacobian, 1.0);
        self.g.gemv_tr(1.0, &block.jacobian, &block.residual, 1.0);
        self.cost += block.residual.norm_squared();
        self.log_determinant += 2.0 * block.root.diagonal().iter().map(|d| d.ln()).sum::<f64>();
        self.views.push(block);
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

    fn add_priors(&mut self, problem: &Problem, state: &State) {
        for (k, extra) in problem.extras.iter().enumerate() {
            let weight = extra.prior_sigma.powi(-2);
            let away = state.values[k] - extra.prior_mean;
            self.h[(12 + k, 12 + k)] += weight;
            self.g[12 + k] += weight * away;
            self.cost += weight * away.powi(2);
        }
    }

    /// One damped step that lowers the cost; its squared length in units of the information.
    pub fn advance(&self, problem: &Problem, state: &mut State) -> f64 {
        let mut damping = 0.0;
        for _ in 0..20 {
            if let Some(step) = self.step(damping) {
                let length = step.dot(&(&self.h * &step));
                let next = state.moved(&step);
                let there = self.cost_at(problem, &next);
                if there <= self.cost * (1.0 + 1e-12) || length < STEP {
                    *state = next;
                    return length;
                }
            }
            damping = if damping == 0.0 { 1e-4 } else { damping * 10.0 };
        }
        0.0
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
        for (view, block) in problem.views.iter().zip(&self.views) {
            let r = view_misfit(problem, view, state);
            let white = block.root.solve_lower_triangular(&r);
            cost += white.map_or(f64::INFINITY, |w| w.norm_squared());
        }
        let variances = state.noise.variances();
        for (board, block) in problem.boards.iter().zip(&self.boards) {
            let rows = touched::rows(
                board,
                &state.hand_eye,
                &problem.extras,
                &state.values,
                &variances,
                problem.setup,
            );
            cost += rows.residual.dot(&block.cholesky.solve(&rows.residual));
        }
        let prior = |(e, x): (&Extra, &f64)| ((x - e.prior_mean) / e.prior_sigma).powi(2);
        let priors: f64 = problem.extras.iter().zip(&state.values).map(prior).sum();
        cost + priors + self.sights.cost(&state.values)
    }

    /// One step of Fisher's scoring on every component that is not known; the largest relative
    /// change of a standard deviation.
    pub fn update_noise(
        &self,
        noise: &mut NoiseModel,
        prior: &NoiseModel,
        known: &KnownNoise,
    ) -> f64 {
        let Some(covariance) = linalg::inverse_spd(&self.h) else { return 0.0 };
        let moments = self.moments(&covariance);
        let free: Vec<usize> = (0..noise.sigmas.len())
            .filter(|&k| known.sigma(noise.sigmas[k].source).is_none())
            .collect();
        let n = free.len();
        let (mut score, mut information) = (DVector::zeros(n), DMatrix::zeros(n, n));
        for (row, &k) in free.iter().enumerate() {
            let Sigma { source, sigma, .. } = noise.sigmas[k];
            let theta = sigma * sigma;
            let first = prior.sigmas[k].sigma.powi(2);
            let belief = prior_equations(source);
            let i = source.index();
            score[row] = 0.5 * theta * (moments.found[i] - moments.expected[i])
                + 0.5 * belief * (first / theta - 1.0);
            information[(row, row)] += 0.5 * belief * (first / theta).max(1.0);
            for (column, &l) in free.iter().enumerate() {
                let other = noise.sigmas[l];
                let t = moments.information[(i, other.source.index())];
                information[(row, column)] += 0.5 * theta * other.sigma.powi(2) * t;
            }
        }
        let Some(inverse) = linalg::inverse_spd(&information) else { return 0.0 };
        let step = &inverse * score;
        let mut largest: f64 = 0.0;
        for (row, &k) in free.iter().enumerate() {
            let s = &mut noise.sigmas[k];
            let change = (0.5 * step[row].clamp(-2.0, 2.0)).exp();
            s.sigma = (s.sigma * change).max(LEAST_SIGMA);
            s.uncertainty = Some(0.5 * inverse[(row, row)].max(0.0).sqrt());
            if s.sigma > LEAST_SIGMA {
                largest = largest.max((change - 1.0).abs());
            }
        }
        largest
    }

    /// Both sides of the REML equations, and their information, by number of the source.
    fn moments(&self, covariance: &DMatrix<f64>) -> Moments {
        let mut sum = Moments::default();
        for block in &self.views {
            sum.add_view(block, covariance);
        }
        for block in &self.boards {
            sum.add_board(block, covariance);
        }
        sum
    }

    /// The information as a sum over the sources whose noise it weighs; `None` stands for priors.
    pub fn shares(&self, noise: &NoiseModel) -> Vec<(Option<Source>, DMatrix<f64>)> {
        let p = self.h.nrows();
        let share = |source: Source, theta: f64| {
            let mut m = DMatrix::zeros(p, p);
            for block in &self.views {
                for (c, own) in block.columns.iter().enumerate() {
                    if *own == source {
                        let through = block.jacobian.tr_mul(&block.factor.column(c));
                        m.ger(theta, &through, &through, 1.0);
                    }
                }
            }
            for block in &self.boards {
                let vj = block.cholesky.solve(&block.rows.jacobian);
                for (_, shape) in block.rows.shapes.iter().filter(|(own, _)| *own == source) {
                    m += vj.tr_mul(&(shape * &vj)) * theta;
                }
            }
            m
        };
        let mut all: Vec<(Option<Source>, DMatrix<f64>)> = noise
            .sigmas
            .iter()
            .map(|s| (Some(s.source), share(s.source, s.sigma * s.sigma)))
            .collect();
        if let Some((_, m)) = all.iter_mut().find(|(s, _)| *s == Some(Source::Picture)) {
            let n = self.sights.information.nrows();
            m.view_mut((12, 12), (n, n)).add_assign(&self.sights.information);
        }
        let rest = all.iter().fold(self.h.clone(), |rest, (_, m)| rest - m);
        all.push((None, rest));
        all
    }

    /// The cost without what the corners say about the camera.
    pub fn cost_of_poses(&self) -> f64 {
        self.cost - self.cost_of_sights
    }

    pub fn finish(self, problem: &Problem, state: State) -> JointFit {
        let covariance = linalg::inverse_spd(&self.h);
        let rows = self.boards.iter().map(|b| b.rows.residual.len()).sum::<usize>();
        let equations = 6 * self.views.len() + rows;
        let log_h = Cholesky::new(self.h.clone()).map_or(f64::INFINITY, |c| {
            2.0 * c.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
        });
        let log_prior: f64 = problem.extras.iter().map(|e| 2.0 * e.prior_sigma.ln()).sum();
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
            log_likelihood: -0.5 * (self.log_determinant + log_h + log_prior + self.cost),
        }
    }
}

fn prior_equations(source: Source) -> f64 {
    source.axes() * if source == Source::Touch { PRIOR_TOUCHES } else { PRIOR_VIEWS }
}

#[derive(Default)]
struct Moments {
    found: SVector<f64, 8>,
    expected: SVector<f64, 8>,
    information: SMatrix<f64, 8, 8>,
}

impl Moments {
    fn add_view(&mut self, block: &ViewBlock, covariance: &DMatrix<f64>) {
        let u = block.factor.transpose() * block.residual;
        let traces = block.factor.transpose() * block.factor;
        // p x columns
        let through = block.jacobian.tr_mul(&block.factor);
        let spent = covariance * &through;
        for (c, source) in block.columns.iter().enumerate() {
            let i = source.index();
            self.found[i] += u[c] * u[c];
            self.expected[i] += traces[(c, c)] - through.column(c).dot(&spent.column(c));
            for (d, other) in block.columns.iter().enumerate() {
                self.information[(i, other.index())] += traces[(c, d)].powi(2);
            }
        }
    }

    fn add_board(&mut self, block: &BoardBlock, covariance: &DMatrix<f64>) {
        let inverse = block.cholesky.inverse();
        let u = &inverse * &block.rows.residual;
        let vj = &inverse * &block.rows.jacobian;
        let products: Vec<DMatrix<f64>> =
            block.rows.shapes.iter().map(|(_, g)| &inverse * g).collect();
        for ((source, g), product) in block.rows.shapes.iter().zip(&products) {
            let i = source.index();
            self.found[i] += u.dot(&(g * &u));
            self.expected[i] += product.trace() - (covariance * vj.tr_mul(&(g * &vj))).trace();
            for ((other, _), second) in block.rows.shapes.iter().zip(&products) {
                let trace = product.component_mul(&second.transpose()).sum();
                self.information[(i, other.index())] += trace;
            }
        }
    }
}

fn systematic_in_camera(problem: &Problem, state: &State) -> Option<Matrix6<f64>> {
    let systematic = |e: &Extra| matches!(e.kind, ExtraKind::Systematic(_));
    if problem.setup == Setup::EyeInHand || !problem.extras.iter().any(systematic) {
        return None;
    }
    let (mut sum, mut count) = (nalgebra::Vector3::zeros(), 0.0);
    for board in &problem.boards {
        let Some(seen) = &board.seen else { continue };
        let c = seen.with(&problem.extras, &state.values).camera_from_target;
        for corner in &board.corners {
            sum += c.iso().transform_vector(&corner.in_target) + c.translation();
            count += 1.0;
        }
    }
    Some(touched::systematic_carry(&(sum / f64::max(count, 1.0))))
}

/// `X` as the views see it: with the systematic difference, where the mount is the base.
fn seen_hand_eye(problem: &Problem, state: &State) -> (HandEye, Option<Matrix6<f64>>) {
    let carry = systematic_in_camera(problem, state);
    let Some(carry) = carry else { return (state.hand_eye, None) };
    let at = |k| super::extra::value(&problem.extras, &state.values, ExtraKind::Systematic(k));
    let delta = carry * Vector6::from_fn(|k, _| at(k));
    let mount_from_camera = state.hand_eye.mount_from_camera.retract(&delta);
    (HandEye { mount_from_camera, ..state.hand_eye }, Some(carry))
}

fn view_misfit(problem: &Problem, view: &View, state: &State) -> Vector6<f64> {
    let (hand_eye, _) = seen_hand_eye(problem, state);
    pose_fit::misfit(&hand_eye, &view.with(&problem.extras, &state.values))
}

fn view_block(problem: &Problem, view: &View, state: &State, variances: &Variances) -> ViewBlock {
    let (hand_eye, carry) = seen_hand_eye(problem, state);
    let pair = view.with(&problem.extras, &state.values);
    let view = View { pair, ..view.clone() };
    let (r, j) = pose_fit::misfit_with_jacobian(&hand_eye, &pair);
    let factor = noise::factor(&view, &hand_eye, problem.setup);
    let columns = noise::columns(&view);
    let covariance = noise::covariance(&factor, &columns, variances);
    let root = covariance.cholesky().map_or_else(Matrix6::identity, |c| c.l());
    let white = |m: &OMatrix<f64, U6, Dyn>| {
        let mut m = m.clone();
        root.solve_lower_triangular_mut(&mut m);
        m
    };
    let mut jacobian = OMatrix::<f64, U6, Dyn>::zeros(12 + problem.extras.len());
    jacobian.fixed_view_mut::<6, 12>(0, 0).copy_from(&j);
    let by_x: Matrix6<f64> = j.fixed_view::<6, 6>(0, 0).into_owned();
    let by_c = (!problem.extras.is_empty()).then(|| -lie::left_jacobian_inverse(&r));
    for (k, extra) in problem.extras.iter().enumerate() {
        let column = match (extra.kind, &carry, &by_c) {
            (ExtraKind::Camera(which), _, Some(by_c)) => by_c * view.by_camera(which),
            // to first order: the exact derivative of exp(carry δ) differs by the square of δ
            (ExtraKind::Systematic(axis), Some(carry), _) => by_x * carry.column(axis),
            _ => continue,
        };
        jacobian.column_mut(12 + k).copy_from(&column);
    }
    let mut white_factor = factor;
    root.solve_lower_triangular_mut(&mut white_factor);
    let mut residual = r;
    root.solve_lower_triangular_mut(&mut residual);
    ViewBlock { residual, jacobian: white(&jacobian), factor: white_factor, columns, root }
}

fn board_block(
    problem: &Problem,
    board: &TouchedBoard,
    state: &State,
    variances: &Variances,
) -> BoardBlock {
    let rows = touched::rows(
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
