//! The joint maximum-likelihood fit: views, touches and whatever else is free, in one.
//!
//! Unknowns are `X = mount_from_camera`, `Y = anchor_from_target` and a list of extras `x` with
//! priors. Every robot pose, and every pose of the target in a picture, is an unknown of its own
//! as well; to first order these leave the problem in closed form, and what remains are misfits
//! with covariances that are sums over sources of error:
//!
//! ```text
//! view i:   r_i = log(C_i⁻¹ X⁻¹ A_i⁻¹ Y)           V_i = Σ_k θ_k G_ik
//! board b:  e_b = tip - corner (super::touched)      V_b likewise
//! minimise  Σ rᵀ V⁻¹ r + Σ (x/σ)²                    by Levenberg-Marquardt
//! ```
//!
//! Given those, restricted maximum likelihood (REML) moves the `θ`: with `u = V⁻¹ r`, `J` the
//! Jacobian and `H = Σ Jᵀ V⁻¹ J`, the score of `log θ_k` is
//!
//! ```text
//! θ_k/2 (Σ uᵀ G_k u - Σ tr(V⁻¹ G_k) + tr(H⁻¹ Σ Jᵀ V⁻¹ G_k V⁻¹ J))
//! ```
//!
//! and Fisher's scoring divides it by `θ_k θ_l/2 Σ tr(V⁻¹ G_k V⁻¹ G_l)`. Few captures tell little
//! about the noise, so each component carries a prior worth [`PRIOR_VIEWS`] captures.
//!
//! D. Harville, *Maximum likelihood approaches to variance component estimation*, JASA 72, 1977;
//! M. Ulrich and M. Hillemann, *Uncertainty-aware hand-eye calibration*, IEEE T-RO 40, 2024.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix6, OMatrix, SMatrix, SVector, U6, Vector6};

use super::{
    extra::{Extra, ExtraKind},
    noise::{self, COLUMNS, Factor, KnownNoise, NoiseModel, Sigma, Source},
    pose_fit::{self, Matrix12, Vector12, View},
    touched::{self, TouchRows, TouchedBoard},
};
use crate::{Error, HandEye, Setup, lie, linalg};

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
    /// Logarithm of the restricted likelihood, up to a constant.
    pub log_likelihood: f64,
}

/// Most rounds of step and noise update.
const MOST_ROUNDS: usize = 100;
/// The noise has converged when no standard deviation changes by more than this part.
const SIGMA_CHANGE: f64 = 3e-4;
/// The unknowns have converged when the squared step, in units of their own information, is below
/// this. One more step follows, which squares the rest.
const STEP: f64 = 1e-8;
/// A step longer than this, in the same units, comes from a start and not from noise.
const FAR: f64 = 1.0;
/// Captures' worth of prior belief in the first noise level.
pub const PRIOR_VIEWS: f64 = 2.0;
/// Touches' worth of prior belief in the first level of their noise.
const PRIOR_TOUCHES: f64 = 2.0;
/// Weight of rotation against translation in the fit whose misfit gives the first noise level,
/// m per rad.
const FIRST_WEIGHT: f64 = 0.3;
/// Prior share of the misfit in rotation that is the robot's: a robot reports its orientation
/// several times better than one picture tells a board's tilt.
const ROBOT_ROTATION_SHARE: f64 = 0.3;

/// Fits everything, noise included.
///
/// # Errors
/// [`Error::TooFewPoses`] below three views.
pub fn fit_joint(
    problem: &Problem,
    start: &HandEye,
    known: &KnownNoise,
) -> Result<JointFit, Error> {
    if problem.views.len() < crate::solve::FEWEST_POSES {
        return Err(crate::solve::too_few(problem.views.len()));
    }
    let start = pose_fit::fit_fixed_weights(&problem.views, start, FIRST_WEIGHT);
    let prior = first_noise(problem, &start, known);
    let state = State::new(problem, start, prior.clone());
    Ok(climb(problem, state, &prior, known))
}

/// Fits `X`, `Y` and the noise to views alone.
///
/// # Errors
/// As [`fit_joint`].
pub fn fit_views(
    views: &[View],
    start: &HandEye,
    known: &KnownNoise,
    setup: Setup,
) -> Result<JointFit, Error> {
    let problem = Problem { setup, views: views.to_vec(), boards: vec![], extras: vec![] };
    fit_joint(&problem, start, known)
}

/// Fits the unknowns again for other problem, from an answer that is near: noise starts at, and
/// is drawn towards, what `near` found.
pub fn refit(problem: &Problem, near: &JointFit, known: &KnownNoise) -> JointFit {
    let values = carried_values(problem, near);
    let state = State { hand_eye: near.hand_eye, values, noise: near.noise.clone() };
    let prior = first_noise(problem, &near.hand_eye, known);
    climb(problem, state, &prior, known)
}

/// Fits the unknowns for noise that is known.
pub fn fit_with_noise(problem: &Problem, near: &JointFit) -> JointFit {
    let values = carried_values(problem, near);
    let mut state = State { hand_eye: near.hand_eye, values, noise: near.noise.clone() };
    let mut system = System::at(problem, &state);
    for _ in 0..MOST_ROUNDS {
        let moved = system.advance(problem, &mut state);
        system = System::at(problem, &state);
        if moved < STEP {
            break;
        }
    }
    system.finish(problem, state)
}

/// Information and gradient at an answer, for a problem that may have more unknowns.
pub(crate) fn normal_equations(problem: &Problem, at: &JointFit) -> (DMatrix<f64>, DVector<f64>) {
    let values = carried_values(problem, at);
    let state = State { hand_eye: at.hand_eye, values, noise: at.noise.clone() };
    let system = System::at(problem, &state);
    (system.h, system.g)
}

fn carried_values(problem: &Problem, near: &JointFit) -> DVector<f64> {
    let value = |e: &Extra| super::extra::value(&near.extras, &near.values, e.kind);
    DVector::from_iterator(problem.extras.len(), problem.extras.iter().map(value))
}

/// Where the fit stands.
#[derive(Debug, Clone)]
struct State {
    hand_eye: HandEye,
    values: DVector<f64>,
    noise: NoiseModel,
}

impl State {
    fn new(problem: &Problem, hand_eye: HandEye, noise: NoiseModel) -> Self {
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

/// Steps and noise updates side by side, until neither moves; then one last step.
fn climb(problem: &Problem, mut state: State, prior: &NoiseModel, known: &KnownNoise) -> JointFit {
    let mut system = System::at(problem, &state);
    for round in 0..MOST_ROUNDS {
        let moved = system.advance(problem, &mut state);
        // far from the answer the misfit is not noise
        let changed = if round == 0 && moved > FAR {
            f64::INFINITY
        } else {
            system.update_noise(&mut state.noise, prior, known)
        };
        system = System::at(problem, &state);
        if moved < STEP && changed < SIGMA_CHANGE {
            break;
        }
    }
    system.advance(problem, &mut state);
    System::at(problem, &state).finish(problem, state)
}

/// The level of the misfit, shared between the sources.
fn first_noise(problem: &Problem, start: &HandEye, known: &KnownNoise) -> NoiseModel {
    let views = &problem.views;
    let (mut rotation, mut position) = (0.0, 0.0);
    for view in views {
        let r = pose_fit::misfit(start, &view.pair);
        rotation += lie::omega(&r).norm_squared();
        position += lie::nu(&r).norm_squared();
    }
    let level = |sum: f64| (0.5 * sum / (3.0 * views.len() as f64 - 6.0).max(3.0)).sqrt().max(1e-9);
    let mut noise = NoiseModel::start(acting(problem));
    for s in &mut noise.sigmas {
        let sigma = match s.source {
            Source::Picture => 1.0,
            Source::Touch => level(position),
            Source::RobotRotation => level(rotation) * ROBOT_ROTATION_SHARE,
            s if s.is_rotation() => level(rotation),
            _ => level(position),
        };
        s.sigma = known.sigma(s.source).unwrap_or(sigma);
    }
    levelled(problem, start, noise, known)
}

/// The same shares at the height that makes the misfit of the views as large as expected.
fn levelled(
    problem: &Problem,
    start: &HandEye,
    mut noise: NoiseModel,
    known: &KnownNoise,
) -> NoiseModel {
    let views_only = Problem { boards: vec![], extras: vec![], ..problem.clone() };
    let mut state = State::new(&views_only, *start, noise.clone());
    for _ in 0..2 {
        System::at(&views_only, &state).advance(&views_only, &mut state);
    }
    let cost = System::at(&views_only, &state).cost;
    let dof = 6.0 * problem.views.len() as f64 - 12.0;
    let level = (cost / dof.max(6.0)).sqrt().max(1e-6);
    for s in &mut noise.sigmas {
        if !matches!(s.source, Source::Picture | Source::Touch) && known.sigma(s.source).is_none() {
            s.sigma *= level;
        }
    }
    let touch = touch_level(problem, &state, &noise);
    if let Some(s) = noise.sigmas.iter_mut().find(|s| s.source == Source::Touch)
        && known.sigma(Source::Touch).is_none()
    {
        s.sigma = touch;
    }
    noise
}

/// RMS misfit of the touches per axis, where the views put them, but not beyond what a hand does.
fn touch_level(problem: &Problem, state: &State, noise: &NoiseModel) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for board in &problem.boards {
        let rows = touched::rows(
            board,
            &state.hand_eye,
            &[],
            &DVector::zeros(0),
            &noise.variances(),
            problem.setup,
        );
        sum += rows.residual.norm_squared();
        count += rows.residual.len() as f64;
    }
    (sum / f64::max(count, 1.0)).sqrt().clamp(1e-9, LARGEST_TOUCH)
}

/// First belief in the error of a tip led by hand, m per axis: at most this.
const LARGEST_TOUCH: f64 = 0.25e-3;

/// The sources that act on this problem.
fn acting(problem: &Problem) -> impl Iterator<Item = Source> {
    let seen = |b: &TouchedBoard| b.seen.is_some_and(|v| v.covariance.is_none());
    let bare =
        problem.views.iter().any(|v| v.covariance.is_none()) || problem.boards.iter().any(seen);
    let pictured = problem.views.iter().any(|v| v.covariance.is_some());
    let touched = !problem.boards.is_empty();
    Source::ALL.into_iter().filter(move |s| match s {
        Source::RobotRotation | Source::RobotPosition => true,
        Source::Picture => pictured,
        Source::Touch => touched,
        _ => bare,
    })
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
struct System {
    h: DMatrix<f64>,
    g: DVector<f64>,
    cost: f64,
    log_determinant: f64,
    views: Vec<ViewBlock>,
    boards: Vec<BoardBlock>,
}

type Variances = [f64; Source::ALL.len()];

impl System {
    fn at(problem: &Problem, state: &State) -> Self {
        let p = 12 + problem.extras.len();
        let variances = state.noise.variances();
        let mut system = Self {
            h: DMatrix::zeros(p, p),
            g: DVector::zeros(p),
            cost: 0.0,
            log_determinant: 0.0,
            views: Vec::with_capacity(problem.views.len()),
            boards: vec![],
        };
        for view in &problem.views {
            system.add_view(view_block(problem, view, state, &variances));
        }
        for board in &problem.boards {
            system.add_board(board_block(problem, board, state, &variances));
        }
        system.add_priors(problem, state);
        system
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
            self.h[(12 + k, 12 + k)] += weight;
            self.g[12 + k] += weight * state.values[k];
            self.cost += weight * state.values[k].powi(2);
        }
    }

    /// One damped step that lowers the cost; its squared length in units of the information.
    fn advance(&self, problem: &Problem, state: &mut State) -> f64 {
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
        let prior = |(e, x): (&Extra, &f64)| (x / e.prior_sigma).powi(2);
        cost + problem.extras.iter().zip(&state.values).map(prior).sum::<f64>()
    }

    /// One step of Fisher's scoring on every component that is not known; the largest relative
    /// change of a standard deviation.
    fn update_noise(&self, noise: &mut NoiseModel, prior: &NoiseModel, known: &KnownNoise) -> f64 {
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

    fn finish(self, problem: &Problem, state: State) -> JointFit {
        let covariance = linalg::inverse_spd(&self.h);
        let rows = self.boards.iter().map(|b| b.rows.residual.len()).sum::<usize>();
        let equations = 6 * self.views.len() + rows;
        let log_h = Cholesky::new(self.h.clone()).map_or(f64::INFINITY, |c| {
            2.0 * c.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
        });
        let log_prior: f64 = problem.extras.iter().map(|e| 2.0 * e.prior_sigma.ln()).sum();
        JointFit {
            hand_eye: state.hand_eye,
            extras: problem.extras.clone(),
            values: state.values,
            covariance,
            information: self.h,
            gradient: self.g,
            noise: state.noise,
            chi_squared: self.cost,
            degrees_of_freedom: equations as f64 - 12.0,
            log_likelihood: -0.5 * (self.log_determinant + log_h + log_prior + self.cost),
        }
    }
}

/// Least standard deviation, far below any instrument.
const LEAST_SIGMA: f64 = 1e-12;

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
    let view = View { pair, ..*view };
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

impl JointFit {
    /// Covariance of `(X, Y)`, marginal over everything else.
    pub fn pose_covariance(&self) -> Option<Matrix12> {
        self.covariance.as_ref().map(|c| c.fixed_view::<12, 12>(0, 0).into_owned())
    }

    /// Squared Mahalanobis distance of a capture that the fit has not seen: its misfit against its
    /// own noise and the fit's uncertainty together.
    pub fn surprise(&self, view: &View, setup: Setup) -> Option<f64> {
        let pair = view.with(&self.extras, &self.values);
        let (r, j) = pose_fit::misfit_with_jacobian(&self.hand_eye, &pair);
        let own = self.noise.covariance(view, &self.hand_eye, setup);
        let expected = own + j * self.pose_covariance()? * j.transpose();
        Some(r.dot(&(linalg::invert_spd(&expected)? * r)))
    }

    /// Misfit of every touch of a board, in the base (m).
    pub(crate) fn touch_misfits(
        &self,
        problem: &Problem,
        board: &TouchedBoard,
    ) -> Vec<nalgebra::Vector3<f64>> {
        let rows = self.touch_rows(problem, board);
        (0..board.corners.len()).map(|k| rows.residual.fixed_rows::<3>(3 * k).into()).collect()
    }

    fn touch_rows(&self, problem: &Problem, board: &TouchedBoard) -> TouchRows {
        let values = carried_values(problem, self);
        let variances = self.noise.variances();
        let (at, extras) = (&self.hand_eye, &problem.extras);
        touched::rows(board, at, extras, &values, &variances, problem.setup)
    }

    /// Squared Mahalanobis distance of touches that the fit has not seen, as [`Self::surprise`].
    pub(crate) fn surprise_of_touch(&self, problem: &Problem, board: &TouchedBoard) -> Option<f64> {
        let rows = self.touch_rows(problem, board);
        let spread = &rows.jacobian * self.covariance.as_ref()? * rows.jacobian.transpose();
        let cholesky = Cholesky::new(rows.covariance + spread)?;
        Some(rows.residual.dot(&cholesky.solve(&rows.residual)))
    }

    /// The value and standard deviation of an extra, if it was free.
    pub fn extra(&self, kind: ExtraKind) -> Option<(f64, f64)> {
        let k = self.extras.iter().position(|e| e.kind == kind)?;
        let variance = self.covariance.as_ref()?[(12 + k, 12 + k)];
        Some((self.values[k], variance.max(0.0).sqrt()))
    }
}
