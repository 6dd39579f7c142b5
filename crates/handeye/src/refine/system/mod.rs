//! The equations of the joint fit at one point: steps, noise updates, and what they are made of.
//!
//! The method is told in [`super::joint`].

use std::ops::AddAssign;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix6, SMatrix, SVector, Vector6};

use super::{
    JointFit, Problem,
    extra::{Extra, ExtraKind},
    joint::{LEAST_SIGMA, PRIOR_TOUCHES, PRIOR_VIEWS},
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

/// A step shorter than this, squared and in units of the information, needs no check: the model is
/// as good as linear there.
const NEAR: f64 = 1e-2;

/// Standard deviation (rad, m) of what nothing determines: far beyond any answer, and yet a number
/// that the algebra can work with. No measurement notices it.
const FREE_SIGMA: f64 = 10.0;

/// What a view's six equations were divided by, and the noise's factor, divided likewise.
struct ViewNoise {
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
    /// Six rows a view, divided by the root of their covariance.
    jacobian: DMatrix<f64>,
    residual: DVector<f64>,
    views: Vec<ViewNoise>,
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
            jacobian: DMatrix::zeros(6 * problem.views.len(), p),
            residual: DVector::zeros(6 * problem.views.len()),
            views: Vec::with_capacity(problem.views.len()),
            boards: vec![],
        };
        system.add_views(problem, state, &variances);
        for board in &problem.boards {
            system.add_board(board_block(problem, board, state, &variances));
        }
        system.add_sights(state);
        system.add_priors(problem, state);
        system.add_known_position(problem, state);
        (0..12).for_each(|k| system.h[(k, k)] += FREE_SIGMA.powi(-2));
        system
    }

    fn add_known_position(&mut self, problem: &Problem, state: &State) {
        let Some(known) = &problem.known_position else { return };
        let x = &state.hand_eye.mount_from_camera;
        let j = known.axis.transpose() * x.rotation() / known.sigma_m;
        let e = known.misfit(x);
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
        linalg::inverse_spd(&self.h).or_else(|| linalg::inverse_with_free(&self.h, FREE_SIGMA))
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

    /// Writes the equations of one view.
    fn fill(
        &mut self,
        row: usize,
        view: &View,
        problem: &Problem,
        state: &State,
        seen: &SeenMount,
        variances: &Variances,
    ) -> ViewNoise {
        let pair = view.with(&problem.extras, &state.values);
        let (r, j) = pose_fit::misfit_with_jacobian(&seen.hand_eye, &pair);
        let mut factor = noise::factor(view, &pair, &seen.hand_eye, problem.setup);
        let columns = noise::columns(view);
        let covariance = noise::covariance(&factor, &columns, variances);
        let root = covariance.cholesky().map_or_else(Matrix6::identity, |c| c.l());
        self.residual.fixed_rows_mut::<6>(row).copy_from(&r);
        self.jacobian.fixed_view_mut::<6, 12>(row, 0).copy_from(&j);
        if !problem.extras.is_empty() {
            let by_x: Matrix6<f64> = j.fixed_view::<6, 6>(0, 0).into_owned();
            let by_c = -lie::left_jacobian_inverse(&r);
            for (k, extra) in problem.extras.iter().enumerate() {
                let column = match (extra.kind, &seen.carry) {
                    (ExtraKind::Camera(which), _) => by_c * view.by_camera(which),
                    // to first order: the derivative of exp(carry δ) differs by the square of δ
                    (ExtraKind::Systematic(axis), Some(carry)) => by_x * carry.column(axis),
                    _ => continue,
                };
                self.jacobian.fixed_view_mut::<6, 1>(row, 12 + k).copy_from(&column);
            }
        }
        let rows = self.jacobian.nrows();
        divide(&root, &mut self.residual.as_mut_slice()[row..row + 6]);
        for column in self.jacobian.as_mut_slice().chunks_exact_mut(rows) {
            divide(&root, &mut column[row..row + 6]);
        }
        factor.as_mut_slice().chunks_exact_mut(6).for_each(|column| divide(&root, column));
        ViewNoise { factor, columns, root }
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
                let near = length < NEAR;
                if near || self.cost_at(problem, &next) <= self.cost * (1.0 + 1e-12) {
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
        let seen = SeenMount::of(problem, state);
        for (view, noise) in problem.views.iter().zip(&self.views) {
            let pair = view.with(&problem.extras, &state.values);
            let mut r = pose_fit::misfit(&seen.hand_eye, &pair);
            divide(&noise.root, r.as_mut_slice());
            cost += r.norm_squared();
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
        let known = problem.known_position.as_ref();
        cost += known.map_or(0.0, |k| k.misfit(&state.hand_eye.mount_from_camera).powi(2));
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
        let Some(root) = self.covariance_root() else { return 0.0 };
        let moments = self.moments(&root);
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
    fn moments(&self, root: &DMatrix<f64>) -> Moments {
        let mut sum = Moments::default();
        // what the unknowns take away of each equation
        let spent = &self.jacobian * root;
        for (i, view) in self.views.iter().enumerate() {
            sum.add_view(view, &self.residual.fixed_rows::<6>(6 * i).into(), &spent, 6 * i);
        }
        let covariance = root * root.transpose();
        for block in &self.boards {
            sum.add_board(block, &covariance);
        }
        sum
    }

    /// The information as a sum over the sources whose noise it weighs; `None` stands for priors.
    pub fn shares(&self, noise: &NoiseModel) -> Vec<(Option<Source>, DMatrix<f64>)> {
        let p = self.h.nrows();
        let share = |source: Source, theta: f64| {
            let mut m = DMatrix::zeros(p, p);
            for (i, view) in self.views.iter().enumerate() {
                for (c, own) in view.columns.iter().enumerate() {
                    if *own == source {
                        let rows = self.jacobian.fixed_rows::<6>(6 * i);
                        let through = rows.tr_mul(&view.factor.column(c));
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
        let covariance = self.covariance();
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
    fn add_view(
        &mut self,
        view: &ViewNoise,
        residual: &Vector6<f64>,
        spent: &DMatrix<f64>,
        row: usize,
    ) {
        let u = view.factor.transpose() * residual;
        let traces = view.factor.transpose() * view.factor;
        for (c, source) in view.columns.iter().enumerate() {
            let i = source.index();
            let f: [f64; 6] = view.factor.column(c).into_owned().into();
            let taken: f64 = spent
                .as_slice()
                .chunks_exact(spent.nrows())
                .map(|column| dot(&f, &column[row..row + 6]).powi(2))
                .sum();
            self.found[i] += u[c] * u[c];
            self.expected[i] += traces[(c, c)] - taken;
            for (d, other) in view.columns.iter().enumerate() {
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
struct SeenMount {
    hand_eye: HandEye,
    /// How the systematic difference moves `X`.
    carry: Option<Matrix6<f64>>,
}

impl SeenMount {
    fn of(problem: &Problem, state: &State) -> Self {
        let Some(carry) = systematic_in_camera(problem, state) else {
            return Self { hand_eye: state.hand_eye, carry: None };
        };
        let at = |k| super::extra::value(&problem.extras, &state.values, ExtraKind::Systematic(k));
        let delta = carry * Vector6::from_fn(|k, _| at(k));
        let mount_from_camera = state.hand_eye.mount_from_camera.retract(&delta);
        Self { hand_eye: HandEye { mount_from_camera, ..state.hand_eye }, carry: Some(carry) }
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

/// `L⁻¹ x` in place.
fn divide(root: &Matrix6<f64>, x: &mut [f64]) {
    for i in 0..6 {
        let known: f64 = (0..i).map(|k| root[(i, k)] * x[k]).sum();
        x[i] = (x[i] - known) / root[(i, i)];
    }
}

fn dot(a: &[f64; 6], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
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
