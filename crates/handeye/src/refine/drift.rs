//! A sequence of views of which a part of the error changes slowly: drift.
//!
//! Odometry of a camera adds one small error to the next; a mount gives way, a robot warms up, and
//! a robot whose geometry is off errs alike in poses that are alike. The misfit of view `k` then has
//! two parts,
//!
//! ```text
//! r_k = δ_k + h_k s_k + ε_k            ε_k ~ N(0, B_k Θ B_kᵀ)   as in [`super::noise`]
//! δ_k = φ_k δ_(k-1) + η_k              η_k ~ N(0, (1 - φ_k²) Ad(C_k⁻¹) Σ Ad(C_k⁻¹)ᵀ)
//! φ_k = exp(-w_k / m)                  Σ   = ½ m diag(ρ² I, τ² I)
//! ```
//!
//! with `w_k` the time between two views and `m` the time after which drift is forgotten, both in
//! mean intervals: per interval the drift moves by `ρ` (rad) and `τ` (m) in the axes of the camera.
//! As `m` grows, drift becomes a random walk, and the start of it goes along with `Y`. `s_k` is the
//! same of the unit of distances, `h_k` how the misfit moves with it; only where that is unknown.
//!
//! A Kalman filter over misfits and Jacobian together whitens both at once; what remains is least
//! squares in `(X, Y, extras)`, and the determinants of the filter and of those normal equations
//! give the restricted likelihood of all standard deviations and of `m` (A. Harvey, *Forecasting,
//! structural time series models and the Kalman filter*, 1989, section 3.4). A backward pass tells
//! drift, and what each view misses when it is left out (P. de Jong, *Smoothing and interpolation
//! with the state-space model*, JASA 84, 1989).

use nalgebra::{DMatrix, DVector, Matrix6, SMatrix, SVector, Vector6};

use super::{
    JointFit, Problem,
    extra::{Extra, ExtraKind},
    joint,
    noise::{self, COLUMNS, Factor, KnownNoise, NoiseModel, Source},
    pose_fit::{self, View},
};
use crate::{
    Error, HandEye, Setup,
    detect::sight::{Sight, TARGET_SCALE},
    lie, linalg,
};

/// Views in the order in which they were taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    /// Who carries the camera.
    pub setup: Setup,
    /// All of them, those that are not used too.
    pub views: Vec<View>,
    /// Time from the view before to each, in mean intervals; that of the first is not used.
    pub after: Vec<f64>,
    /// What is free beside `X` and `Y`; parameters of the camera only, two at most.
    pub extras: Vec<Extra>,
}

/// How the slow part of the error moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// Turn in one interval, rad per axis.
    pub rotation: f64,
    /// Shift in one interval, m per axis.
    pub position: f64,
    /// Change of the unit of distances in one interval, as a part of it.
    pub scale: f64,
    /// After how many intervals it is forgotten.
    pub memory: f64,
}

impl Drift {
    const NONE: Self = Self { rotation: 0.0, position: 0.0, scale: 0.0, memory: 1.0 };
}

/// What may drift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Free {
    /// Nothing: errors are independent.
    Nothing,
    /// The pose of the target.
    Pose,
    /// Also the unit of distances, where that is among the extras.
    PoseAndUnit,
}

/// What a sequence says.
#[derive(Debug, Clone, PartialEq)]
pub struct DriftFit {
    /// Both poses, extras, their covariance and the noise beside drift.
    pub fit: JointFit,
    /// The drift; all zero where none was looked for.
    pub drift: Drift,
    /// What each view says under all others.
    pub views: Vec<Slow>,
}

/// One view of a sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slow {
    /// The slow part of its misfit, perturbing `camera_from_target` on the right.
    pub drift: Vector6<f64>,
    /// Its misfit where drift is told by the other views alone (rotation, rad; position, m).
    pub left_out: Vector6<f64>,
    /// The square of that in units of its standard deviation; six on average.
    pub surprise: f64,
}

/// Largest number of extras.
const EXTRAS: usize = 2;
/// Largest number of columns of the Jacobian.
const WIDTH: usize = 12 + EXTRAS;
/// Misfit and Jacobian side by side.
const BOTH: usize = 1 + WIDTH;
/// Drift of the pose and of the unit.
const STATE: usize = 7;

type Rows = SMatrix<f64, 6, BOTH>;
type Square = SMatrix<f64, STATE, STATE>;
type Gain = SMatrix<f64, STATE, 6>;
type See = SMatrix<f64, 6, STATE>;

/// Standard deviation (rad, m) of what nothing determines.
const FREE_SIGMA: f64 = 10.0;
/// Rounds of noise and step.
const MOST_ROUNDS: usize = 8;
/// The unknowns have converged when the squared step, in units of the information, is below this.
const STEP: f64 = 1e-5;
/// Belief in the logarithm of each standard deviation beforehand: a factor of ten either way.
const BELIEF: f64 = 2.3;

/// One view, about where the fit stands.
struct Line {
    rows: Rows,
    factor: Factor,
    columns: [Source; COLUMNS],
    /// `Ad(C⁻¹)` for the pose, one for the unit.
    carry: Matrix6<f64>,
    see: See,
    after: f64,
    used: bool,
}

/// Fits `(X, Y, extras)`, the noise and the drift that is `free` to the views that are `used`.
/// `near` is a fit of about the same without drift.
///
/// # Errors
/// [`Error::TooFewPoses`] below three used views, [`Error::Invalid`] where lists differ in length, a
/// time is negative or no number, or an extra is no parameter of the camera.
pub fn fit_drift(
    sequence: &Sequence,
    used: &[bool],
    near: &JointFit,
    known: &KnownNoise,
    free: Free,
) -> Result<DriftFit, Error> {
    check(sequence, used)?;
    let starts = starts(sequence, used, near, known, free);
    Ok(climb(sequence, used, near, known, starts).finish(sequence, used))
}

fn check(sequence: &Sequence, used: &[bool]) -> Result<(), Error> {
    let n = sequence.views.len();
    let camera = |e: &Extra| matches!(e.kind, ExtraKind::Camera(_));
    if used.len() != n || sequence.after.len() != n {
        return Err(Error::Invalid(format!(
            "{n} views, {} times between them and {} marks of use: these must be as many",
            sequence.after.len(),
            used.len()
        )));
    }
    if sequence.extras.len() > EXTRAS || !sequence.extras.iter().all(camera) {
        return Err(Error::Invalid(format!(
            "a sequence has at most {EXTRAS} unknowns beside both poses, all of the camera"
        )));
    }
    if let Some(k) = sequence.after.iter().position(|w| !(w.is_finite() && *w >= 0.0)) {
        return Err(Error::Invalid(format!("the time before view {} must not be negative", k + 1)));
    }
    let count = used.iter().filter(|u| **u).count();
    if count < crate::solve::FEWEST_POSES {
        return Err(crate::solve::too_few(count));
    }
    Ok(())
}

/// Where the noise stands: logarithms of the standard deviations, and of the memory.
#[derive(Clone)]
struct Levels {
    noise: NoiseModel,
    drift: Drift,
    free: bool,
}

impl Levels {
    /// What is free, as logarithms.
    fn get(&self, known: &KnownNoise) -> Vec<f64> {
        let free = |s: &&noise::Sigma| known.sigma(s.source).is_none();
        let mut all: Vec<f64> =
            self.noise.sigmas.iter().filter(free).map(|s| s.sigma.ln()).collect();
        if self.free {
            let d = &self.drift;
            all.extend([d.memory.ln(), d.rotation.ln(), d.position.ln()]);
            all.extend((d.scale > 0.0).then(|| d.scale.ln()));
        }
        all
    }

    fn set(&mut self, values: &[f64], known: &KnownNoise) {
        let mut values = values.iter().map(|v| v.exp());
        for s in self.noise.sigmas.iter_mut().filter(|s| known.sigma(s.source).is_none()) {
            s.sigma = values.next().unwrap_or(s.sigma);
        }
        let d = &mut self.drift;
        for value in [&mut d.memory, &mut d.rotation, &mut d.position, &mut d.scale] {
            *value = values.next().unwrap_or(*value);
        }
    }
}

/// Longest and shortest memory, in intervals.
const MEMORY: (f64, f64) = (0.5, 1e4);
/// Drift of the unit, per interval, to begin with.
const FIRST_SCALE: f64 = 1e-3;

/// Levels to start from: little drift, or most of the misfit.
fn starts(
    sequence: &Sequence,
    used: &[bool],
    near: &JointFit,
    known: &KnownNoise,
    free: Free,
) -> Vec<Levels> {
    let drifts = free != Free::Nothing;
    let white = Levels { noise: near.noise.clone(), drift: Drift::NONE, free: drifts };
    if !drifts {
        return vec![white];
    }
    let scale = free == Free::PoseAndUnit && scaled(sequence);
    let n = used.iter().filter(|u| **u).count() as f64;
    let level = |of: [Source; 2]| {
        let sum: f64 = of.iter().filter_map(|s| near.noise.sigma(*s)).map(|s| s * s).sum();
        sum.sqrt().max(joint::LEAST_SIGMA)
    };
    let rotation = level([Source::RobotRotation, Source::CameraTilt]);
    let position = level([Source::RobotPosition, Source::CameraLateral]);
    [(1.0, 0.05), (0.3, 1.0)]
        .into_iter()
        .map(|(kept, moved)| {
            let mut start = white.clone();
            for s in start.noise.sigmas.iter_mut().filter(|s| known.sigma(s.source).is_none()) {
                s.sigma *= kept;
            }
            // a walk that strays by the misfit over a third of the sequence
            let step = moved * (3.0 / n).sqrt();
            start.drift = Drift {
                rotation: rotation * step,
                position: position * step,
                scale: if scale { FIRST_SCALE } else { 0.0 },
                memory: n,
            };
            start
        })
        .collect()
}

fn scaled(sequence: &Sequence) -> bool {
    sequence.extras.iter().any(|e| e.kind == ExtraKind::Camera(TARGET_SCALE))
}

/// Where a fit has arrived.
struct Climb {
    hand_eye: HandEye,
    values: DVector<f64>,
    levels: Levels,
    log_likelihood: f64,
}

/// Noise and unknowns in turn, until neither moves; from the start that soon is the likeliest.
fn climb(
    sequence: &Sequence,
    used: &[bool],
    near: &JointFit,
    known: &KnownNoise,
    starts: Vec<Levels>,
) -> Climb {
    let from = |levels: Levels| {
        let scale = scaled(sequence) && levels.drift.scale > 0.0;
        let first = levels.get(known);
        let hessian = DMatrix::identity(first.len(), first.len()) * FIRST_STEP;
        let search = Search { known: *known, first, scale, inverse: hessian };
        let values = carried(sequence, near);
        let log_likelihood = f64::NEG_INFINITY;
        (Climb { hand_eye: near.hand_eye, values, levels, log_likelihood }, search)
    };
    let mut all: Vec<(Climb, Search)> = starts.into_iter().map(from).collect();
    for (at, search) in &mut all {
        // the first step is taken before the noise is looked for
        for round in 0..2 {
            at.advance(sequence, used, (round > 0).then_some(&mut *search));
        }
    }
    all.sort_by(|a, b| b.0.log_likelihood.total_cmp(&a.0.log_likelihood));
    let (mut at, mut search) = all.swap_remove(0);
    for _ in 0..MOST_ROUNDS {
        if at.advance(sequence, used, Some(&mut search)) < STEP {
            break;
        }
    }
    at
}

impl Climb {
    /// Looks for the likeliest noise, and takes one step; its squared length in units of the
    /// information.
    fn advance(&mut self, sequence: &Sequence, used: &[bool], search: Option<&mut Search>) -> f64 {
        let lines = lines(sequence, used, &self.hand_eye, &self.values);
        if let Some(search) = search {
            search.likeliest(sequence, &lines, self);
        }
        let filtered = filter(&lines, &self.levels);
        self.log_likelihood = filtered.log_likelihood(sequence, &self.values);
        let Some((step, size)) = filtered.step(sequence, &self.values) else { return 0.0 };
        self.hand_eye = pose_fit::moved(&self.hand_eye, &SVector::from_fn(|i, _| step[i]));
        self.values += step.rows(12, sequence.extras.len());
        size
    }
}

fn carried(sequence: &Sequence, near: &JointFit) -> DVector<f64> {
    let value = |e: &Extra| super::extra::value(&near.extras, &near.values, e.kind);
    DVector::from_iterator(sequence.extras.len(), sequence.extras.iter().map(value))
}

fn lines(
    sequence: &Sequence,
    used: &[bool],
    hand_eye: &HandEye,
    values: &DVector<f64>,
) -> Vec<Line> {
    let one = |k: usize| {
        let view = &sequence.views[k];
        let pair = view.with(&sequence.extras, values);
        let (r, j) = pose_fit::misfit_with_jacobian(hand_eye, &pair);
        let by_c = -lie::left_jacobian_inverse(&r);
        let mut rows = Rows::zeros();
        rows.column_mut(0).copy_from(&r);
        rows.fixed_view_mut::<6, 12>(0, 1).copy_from(&j);
        for (e, extra) in sequence.extras.iter().enumerate() {
            if let ExtraKind::Camera(which) = extra.kind {
                rows.column_mut(13 + e).copy_from(&(by_c * view.by_camera(which)));
            }
        }
        let mut see = See::zeros();
        see.fixed_view_mut::<6, 6>(0, 0).fill_with_identity();
        see.column_mut(6).copy_from(&Sight::by_size(&pair.camera_from_target));
        Line {
            rows,
            factor: noise::factor(view, &pair, hand_eye, sequence.setup),
            columns: noise::columns(view),
            carry: lie::adjoint(pair.camera_from_target.inverse().iso()),
            see,
            after: if k == 0 { 0.0 } else { sequence.after[k] },
            used: used[k],
        }
    };
    (0..sequence.views.len()).map(one).collect()
}

/// What the filter leaves: misfit and Jacobian whitened, squared and summed.
struct Filtered {
    sum: SMatrix<f64, BOTH, BOTH>,
    log_determinant: f64,
}

/// Before one view: drift of misfit and Jacobian, and its covariance.
struct Before {
    state: SMatrix<f64, STATE, BOTH>,
    spread: Square,
}

/// Stationary covariance of the drift in the axes of this view, per unit of `1 - φ²`.
fn spread(line: &Line, drift: &Drift) -> Square {
    let turn = drift.rotation.powi(2);
    let shift = drift.position.powi(2);
    let own = Vector6::new(turn, turn, turn, shift, shift, shift);
    let mut all = Square::zeros();
    let carried = line.carry * Matrix6::from_diagonal(&own) * line.carry.transpose();
    all.fixed_view_mut::<6, 6>(0, 0).copy_from(&carried);
    all[(6, 6)] = drift.scale.powi(2);
    all * (0.5 * drift.memory)
}

fn before(line: &Line, drift: &Drift, last: Option<Before>) -> Before {
    let own = spread(line, drift);
    match last {
        None => Before { state: SMatrix::zeros(), spread: own },
        Some(last) => {
            let phi = (-line.after / drift.memory).exp();
            // 1 - φ² without loss of digits
            let fresh = -(-2.0 * line.after / drift.memory).exp_m1();
            Before { state: last.state * phi, spread: last.spread * (phi * phi) + own * fresh }
        }
    }
}

/// Covariance of a view's misfit under what came before, as root and inverse.
fn innovation(line: &Line, before: &Before, levels: &Levels) -> (Matrix6<f64>, Matrix6<f64>) {
    let own = noise::covariance(&line.factor, &line.columns, &levels.noise.variances());
    let all = own + line.see * before.spread * line.see.transpose();
    let root = all.cholesky();
    let inverse = root.as_ref().map_or_else(Matrix6::identity, |c| c.inverse());
    (root.map_or_else(Matrix6::identity, |c| c.l()), inverse)
}

fn filter(lines: &[Line], levels: &Levels) -> Filtered {
    let mut out = Filtered { sum: SMatrix::zeros(), log_determinant: 0.0 };
    let mut last = None;
    for line in lines {
        let mut here = before(line, &levels.drift, last);
        if line.used {
            let (root, inverse) = innovation(line, &here, levels);
            let new = line.rows - line.see * here.state;
            let white = root.solve_lower_triangular(&new).unwrap_or(new);
            out.sum += white.tr_mul(&white);
            out.log_determinant += 2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>();
            let gain: Gain = here.spread * line.see.transpose() * inverse;
            here.state += gain * new;
            here.spread -= gain * line.see * here.spread;
            here.spread = 0.5 * (here.spread + here.spread.transpose());
        }
        last = Some(here);
    }
    out
}

impl Filtered {
    /// Information and gradient of `(X, Y, extras)`.
    fn normal(&self, sequence: &Sequence, values: &DVector<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let p = 12 + sequence.extras.len();
        let mut h = DMatrix::from_fn(p, p, |i, j| self.sum[(1 + i, 1 + j)]);
        let mut g = DVector::from_fn(p, |i, _| self.sum[(1 + i, 0)]);
        (0..12).for_each(|k| h[(k, k)] += FREE_SIGMA.powi(-2));
        for (k, extra) in sequence.extras.iter().enumerate() {
            h[(12 + k, 12 + k)] += extra.prior_sigma.powi(-2);
            g[12 + k] += (values[k] - extra.prior_mean) / extra.prior_sigma.powi(2);
        }
        (h, g)
    }

    /// The step of Gauss and Newton, and its squared length in units of the information.
    fn step(&self, sequence: &Sequence, values: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
        let (h, g) = self.normal(sequence, values);
        let step = -(covariance(&h)? * &g);
        let size = -step.dot(&g);
        step.iter().all(|s| s.is_finite()).then_some((step, size))
    }

    fn log_likelihood(&self, sequence: &Sequence, values: &DVector<f64>) -> f64 {
        let (h, g) = self.normal(sequence, values);
        let Some((scaled, scale)) = linalg::scaled(&h) else { return f64::NEG_INFINITY };
        let Some(root) = nalgebra::Cholesky::new(scaled) else { return f64::NEG_INFINITY };
        let log = |d: &f64| d.ln();
        let log_h: f64 = 2.0 * root.l_dirty().diagonal().iter().map(log).sum::<f64>()
            - 2.0 * scale.iter().map(log).sum::<f64>();
        let scaled_g = g.component_mul(&scale);
        let least = self.sum[(0, 0)] - scaled_g.dot(&root.solve(&scaled_g));
        -0.5 * (self.log_determinant + log_h + least)
    }
}

fn covariance(h: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    linalg::inverse_spd(h).or_else(|| linalg::inverse_with_free(h, FREE_SIGMA))
}

/// Steps of the search for the likeliest noise.
const MOST_STEPS: usize = 40;
/// Difference for derivatives by logarithms of standard deviations.
const DIFFERENCE: f64 = 1e-5;
/// The search has ended when a step gains less.
const GAIN: f64 = 1e-3;
/// Longest step of one logarithm.
const LONGEST: f64 = 1.5;
/// Inverse of the curvature to begin with.
const FIRST_STEP: f64 = 0.1;

/// The search for the likeliest noise and drift, by the method of Broyden, Fletcher, Goldfarb and
/// Shanno.
struct Search {
    known: KnownNoise,
    /// Where the logarithms are believed to be.
    first: Vec<f64>,
    /// Whether the unit of distances drifts.
    scale: bool,
    /// Inverse of the curvature.
    inverse: DMatrix<f64>,
}

impl Search {
    /// The place of the memory among the logarithms, where drift is free.
    fn memory(&self, levels: &Levels) -> Option<usize> {
        levels.free.then(|| self.first.len() - 3 - usize::from(self.scale))
    }

    fn likeliest(&mut self, sequence: &Sequence, lines: &[Line], at: &mut Climb) {
        let mut levels = at.levels.clone();
        let memory = self.memory(&levels);
        let (known, first, values) = (self.known, self.first.clone(), &at.values);
        let mut cost = |x: &DVector<f64>| {
            levels.set(x.as_slice(), &known);
            // any memory is as likely as any other
            let believed = (0..x.len()).filter(|k| memory != Some(*k));
            let beliefs: f64 = believed.map(|k| ((x[k] - first[k]) / BELIEF).powi(2)).sum();
            0.5 * beliefs - filter(lines, &levels).log_likelihood(sequence, values)
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
        next.iter_mut().for_each(|v| *v = v.max(joint::LEAST_SIGMA.ln()));
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

impl Climb {
    fn finish(self, sequence: &Sequence, used: &[bool]) -> DriftFit {
        let lines = lines(sequence, used, &self.hand_eye, &self.values);
        let filtered = filter(&lines, &self.levels);
        let (information, gradient) = filtered.normal(sequence, &self.values);
        let count = used.iter().filter(|u| **u).count() as f64;
        let views = smooth(&lines, &self.levels);
        let fit = JointFit {
            hand_eye: self.hand_eye,
            extras: sequence.extras.clone(),
            values: self.values,
            covariance: covariance(&information),
            information,
            gradient,
            noise: self.levels.noise,
            chi_squared: filtered.sum[(0, 0)],
            degrees_of_freedom: 6.0 * count - 12.0,
            log_likelihood: self.log_likelihood,
        };
        DriftFit { fit, drift: self.levels.drift, views }
    }
}

/// One view on the way forward, for the way back.
struct Pass {
    state: SVector<f64, STATE>,
    spread: Square,
    inverse: Matrix6<f64>,
    /// Misfit minus what was expected.
    new: Vector6<f64>,
}

/// Drift of every view given all others, and what it then misses.
fn smooth(lines: &[Line], levels: &Levels) -> Vec<Slow> {
    let mut passes: Vec<Pass> = vec![];
    let mut last = None;
    for line in lines {
        let mut here = before(line, &levels.drift, last);
        let (_, inverse) = innovation(line, &here, levels);
        let new = line.rows - line.see * here.state;
        passes.push(Pass {
            state: here.state.column(0).into_owned(),
            spread: here.spread,
            inverse,
            new: new.column(0).into_owned(),
        });
        if line.used {
            let gain: Gain = here.spread * line.see.transpose() * inverse;
            here.state += gain * new;
            here.spread -= gain * line.see * here.spread;
            here.spread = 0.5 * (here.spread + here.spread.transpose());
        }
        last = Some(here);
    }
    let (mut rho, mut back) = (SVector::<f64, STATE>::zeros(), Square::zeros());
    let mut all = vec![];
    for k in (0..lines.len()).rev() {
        let (line, pass) = (&lines[k], &passes[k]);
        let phi = lines.get(k + 1).map_or(1.0, |l| (-l.after / levels.drift.memory).exp());
        let see = &line.see;
        // how the next state moves with this one, and with this misfit
        let (next, gain) = if line.used {
            let gain: Gain = pass.spread * see.transpose() * pass.inverse * phi;
            (Square::identity() * phi - gain * see, gain)
        } else {
            (Square::identity() * phi, Gain::zeros())
        };
        let u = pass.inverse * pass.new - gain.transpose() * rho;
        let m = pass.inverse + gain.transpose() * back * gain;
        (rho, back) = if line.used {
            (
                see.transpose() * pass.inverse * pass.new + next.transpose() * rho,
                see.transpose() * pass.inverse * see + next.transpose() * back * next,
            )
        } else {
            (next.transpose() * rho, next.transpose() * back * next)
        };
        let drift = see * (pass.state + pass.spread * rho);
        let (left_out, spread) = if line.used {
            let spread = linalg::invert_spd(&m).unwrap_or_else(Matrix6::zeros);
            (spread * u, spread)
        } else {
            let own = noise::covariance(&line.factor, &line.columns, &levels.noise.variances());
            let smoothed = pass.spread - pass.spread * back * pass.spread;
            let misfit: Vector6<f64> = line.rows.column(0).into_owned();
            (misfit - drift, own + see * smoothed * see.transpose())
        };
        let weighted = linalg::invert_spd(&spread).map_or_else(Vector6::zeros, |w| w * left_out);
        all.push(Slow { drift, left_out, surprise: left_out.dot(&weighted) });
    }
    all.reverse();
    all
}

/// A fit of the used views without drift, to start from.
///
/// # Errors
/// As [`super::fit_joint`].
pub fn without_drift(
    sequence: &Sequence,
    used: &[bool],
    start: &HandEye,
    known: &KnownNoise,
) -> Result<JointFit, Error> {
    let views =
        sequence.views.iter().zip(used).filter(|(_, u)| **u).map(|(v, _)| v.clone()).collect();
    let problem = Problem {
        setup: sequence.setup,
        views,
        boards: vec![],
        extras: sequence.extras.clone(),
        known_position: None,
    };
    super::fit_joint(&problem, start, known)
}

#[cfg(test)]
mod tests;
