//! A sequence of views of which a part of the error changes slowly: drift.
//!
//! Odometry of a camera adds one small error to the next, a target gives way, a robot warms up, and
//! a robot whose geometry is off errs alike in poses that are alike. The residual of view `k` then has
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
//! All of that is slow as the target has it ([`sequence::Side::Target`]). A camera that moves in its holder is slow
//! in its own axes: then residuals, and all that is said above of them, are those in the camera's axes,
//! `Ad(C_k) r_k` ([`sequence::Side::Camera`]).
//!
//! As `m` grows, drift becomes a random walk, and the start of it goes along with `Y`. `s_k` is the
//! same of the unit of distances, `h_k` how the residual moves with it; only where that is unknown.
//!
//! A Kalman filter over residuals and Jacobian together whitens both at once; what remains is least
//! squares in `(X, Y, extras)`, and the determinants of the filter and of those normal equations
//! give the restricted likelihood of all standard deviations and of `m` (A. Harvey, *Forecasting,
//! structural time series models and the Kalman filter*, 1989, section 3.4). A backward pass tells
//! drift, and what each view misses when it is left out (P. de Jong, *Smoothing and interpolation
//! with the state-space model*, JASA 84, 1989).

mod kalman;
mod search;
pub mod sequence;

use nalgebra::{DMatrix, DVector, SVector};

use super::{
    JointFit, Problem,
    extra::{Extra, ExtraKind},
    noise::{self, KnownNoise, Source},
};
use crate::{
    Error, HandEye,
    detect::sight::TARGET_SCALE,
    estimate::drift::{
        search::Climb,
        sequence::{Drift, EXTRAS, Levels, Sequence, Slow},
    },
    solve::least_squares::{self},
};
use kalman::{covariance, filter, lines, smooth};
use search::{FIRST_STEP, Search};

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
pub(crate) struct DriftFit {
    /// Both poses, extras, their covariance and the noise beside drift.
    pub fit: JointFit,
    /// The drift; all zero where none was looked for.
    pub drift: Drift,
    /// What each view says under all others.
    pub views: Vec<Slow>,
}

/// Rounds of noise and step.
const MOST_ROUNDS: usize = 8;
/// The unknowns have converged when the squared step, in units of the information, is below this.
const STEP: f64 = 1e-5;
/// Fits `(X, Y, extras)`, the noise and the drift that is `free` to the views that are `used`.
/// `near` is a fit of about the same without drift.
///
/// # Errors
/// [`Error::TooFewPoses`] below three used views, [`Error::Invalid`] where lists differ in length, a
/// time is negative or no number, or an extra is no parameter of the camera.
pub(crate) fn fit_drift(
    sequence: &Sequence,
    used: &[bool],
    near: &JointFit,
    known: &KnownNoise,
    free: Free,
) -> Result<DriftFit, Error> {
    check(sequence, used)?;
    let starts = starts(sequence, used, near, known, free);
    Ok(maximise_likelihood(sequence, used, near, known, starts).finish(sequence, used))
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

/// Drift of the unit, per interval, to begin with.
const FIRST_SCALE: f64 = 1e-3;

/// Levels to start from: little drift, or most of the residual.
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
        sum.sqrt().max(noise::LEAST_SIGMA)
    };
    let rotation = level([Source::RobotRotation, Source::CameraTilt]);
    let position = level([Source::RobotPosition, Source::CameraLateral]);
    [(1.0, 0.05), (0.3, 1.0)]
        .into_iter()
        .map(|(kept, moved)| {
            let mut start = white.clone();
            for s in start.noise.sigmas.iter_mut().filter(|s| known.sigma(s.source).is_none()) {
                s.sigma = (s.sigma * kept).max(noise::LEAST_SIGMA);
            }
            // a walk that strays by the residual over a third of the sequence
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

/// Noise and unknowns in turn, until neither moves; from the start that soon is the likeliest.
fn maximise_likelihood(
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
        self.hand_eye = least_squares::moved(&self.hand_eye, &SVector::from_fn(|i, _| step[i]));
        self.values += step.rows(12, sequence.extras.len());
        size
    }
}

fn carried(sequence: &Sequence, near: &JointFit) -> DVector<f64> {
    let value = |e: &Extra| super::extra::value(&near.extras, &near.values, e.kind);
    DVector::from_iterator(sequence.extras.len(), sequence.extras.iter().map(value))
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
            cost: filtered.sum[(0, 0)],
            log_likelihood: self.log_likelihood,
        };
        DriftFit { fit, drift: self.levels.drift, views }
    }
}

/// A fit of the used views without drift, to start from.
///
/// # Errors
/// As [`super::fit_joint`].
pub(crate) fn without_drift(
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
