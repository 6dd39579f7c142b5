//! The joint maximum-likelihood fit: views, touches and whatever else is free, in one.
//!
//! Unknowns are `X = mount_from_camera`, `Y = anchor_from_target` and a list of extras `x` with
//! priors. Every robot pose, and every pose of the target in an image, is an unknown of its own
//! as well; to first order these leave the problem in closed form, and what remains are residuals
//! with covariances that are sums over sources of error:
//!
//! ```text
//! view i:   r_i = log(C_i⁻¹ X⁻¹ A_i⁻¹ Y)           V_i = Σ_k θ_k G_ik
//! board b:  e_b = tip - corner (super::touched)      V_b likewise
//! minimise  Σ rᵀ V⁻¹ r + Σ ((x - x₀)/σ)² + Σ (cᵀ S_i c + 2 s_iᵀ c)/θ_picture
//! ```
//!
//! by Levenberg-Marquardt. `C_i` and the touched boards move with the camera's parameters `c`, which
//! are among the `x`; what the corners of a view say about these themselves is the last sum
//! ([`crate::detect::sight`]).
//!
//! Given those, restricted maximum likelihood (REML) moves the `θ`: with `u = V⁻¹ r`, `J` the
//! Jacobian and `H = Σ Jᵀ V⁻¹ J`, the score of `log θ_k` is
//!
//! ```text
//! θ_k/2 (Σ uᵀ G_k u - Σ tr(V⁻¹ G_k) + tr(H⁻¹ Σ Jᵀ V⁻¹ G_k V⁻¹ J))
//! ```
//!
//! and Fisher's scoring divides it by `θ_k θ_l/2 Σ tr(V⁻¹ G_k V⁻¹ G_l)`. Few captures tell little
//! about the noise, so each component carries a prior worth two captures.
//!
//! Errors of the robot by place are unknowns like any other ([`super::place`]), believed to be about as large as
//! their level says. Levels are estimated along with the noise: with `b` the `n` unknowns of one level and `C_b`
//! their covariance, the score of `log θ` is `½ (bᵀb/θ - n + tr C_b/θ)`. A level is as likely to be zero as any
//! other number: its prior falls off exponentially, over the rms residual of the first fit (D. Simpson and others,
//! *Penalising model component complexity*, Statistical Science 32, 2017).
//!
//! D. Harville, *Maximum likelihood approaches to variance component estimation*, JASA 72, 1977;
//! M. Ulrich and M. Hillemann, *Uncertainty-aware hand-eye calibration*, IEEE T-RO 40, 2024.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::{
    extra::{Extra, ExtraKind},
    noise::{KnownNoise, NoiseModel, Sigma, Source},
    system::Steps,
    touch_residual::{self, TouchRows, TouchedBoard},
};
use crate::{
    Error, HandEye, Setup,
    estimate::{
        noise::LEAST_SIGMA,
        problem::{JointFit, Problem},
        system::state::{State, System},
    },
    math::{lie, linalg},
    solve::least_squares::{self, Matrix12, View},
};

/// Most rounds of step and noise update.
const MOST_ROUNDS: usize = 100;
/// The noise has converged when no standard deviation changes by more than this part.
const SIGMA_CHANGE: f64 = 1e-3;
/// The unknowns have converged when the squared step, in units of their own information, is below
/// this. One more step follows, which squares the rest.
const STEP: f64 = 1e-6;
/// The same where unknowns are as large as a level that is estimated: it moves them all a little.
const STEP_WITH_LEVELS: f64 = 1e-3;
/// A step longer than this, in the same units, comes from a start and not from noise.
const FAR: f64 = 1.0;
/// Captures' worth of the prior of the first noise level.
pub(super) const PRIOR_VIEWS: f64 = 2.0;
/// Touches' worth of the prior of the first level of their noise.
pub(super) const PRIOR_TOUCHES: f64 = 2.0;
/// Weight of rotation against translation in the fit whose residual gives the first noise level,
/// m per rad.
const FIRST_WEIGHT: f64 = 0.3;
/// Prior share of the residual in rotation that is the robot's: a robot reports its orientation
/// several times better than one image tells a board's tilt.
const ROBOT_ROTATION_SHARE: f64 = 0.3;
/// The same in position: the camera's depth and what rotations do at a distance are in it as well.
const ROBOT_POSITION_SHARE: f64 = 0.85;

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
    let start = least_squares::fit_fixed_weights(&problem.views, start, FIRST_WEIGHT);
    let mut state = State::new(problem, start, NoiseModel::start(acting(problem)));
    let prior = first_noise(problem, &state, known);
    state.noise = prior.clone();
    Ok(maximise_likelihood(problem, state, &prior, known))
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
    let problem = Problem {
        setup,
        views: views.to_vec(),
        boards: vec![],
        extras: vec![],
        known_position: None,
    };
    fit_joint(&problem, start, known)
}

/// Fits the unknowns again for other problem, from an answer that is near: noise starts at, and
/// is drawn towards, what `near` found.
pub fn refit(problem: &Problem, near: &JointFit, known: &KnownNoise) -> JointFit {
    let mut state = near.state(problem, &near.noise);
    let prior = first_noise(problem, &state, known);
    let found = |s: &Sigma| near.noise.sigmas.iter().find(|n| n.source == s.source).copied();
    state.noise.sigmas = prior.sigmas.iter().map(|s| found(s).unwrap_or(*s)).collect();
    maximise_likelihood(problem, state, &prior, known)
}

/// Fits the unknowns again for another prior, from an answer that is near and under its noise.
pub(crate) fn refit_under_noise_of(problem: &Problem, near: &JointFit) -> JointFit {
    let mut state = near.state(problem, &near.noise);
    for _ in 0..MOST_ROUNDS {
        if System::at(problem, &state).advance(problem, &mut state) < STEP {
            break;
        }
    }
    System::at(problem, &state).finish(problem, state)
}

/// Information and gradient at an answer, for a problem that may have more unknowns.
pub(crate) fn normal_equations(problem: &Problem, at: &JointFit) -> (DMatrix<f64>, DVector<f64>) {
    let system = System::at(problem, &at.state(problem, &at.noise));
    (system.h, system.g)
}

fn carried_values(problem: &Problem, near: &JointFit) -> DVector<f64> {
    let value = |e: &Extra| super::extra::value(&near.extras, &near.values, e.kind);
    DVector::from_iterator(problem.extras.len(), problem.extras.iter().map(value))
}

/// Steps and noise updates side by side, until neither moves; then one last step.
fn maximise_likelihood(
    problem: &Problem,
    mut state: State,
    prior: &NoiseModel,
    known: &KnownNoise,
) -> JointFit {
    let mut system = System::at(problem, &state);
    for round in 0..MOST_ROUNDS {
        let moved = system.advance(problem, &mut state);
        // how large unknowns of a level are follows from the level: its score is that at its own answer
        if system.has_levels() {
            system = System::at(problem, &state);
        }
        // far from the answer the residual is not noise
        let changed = if round == 0 && moved > FAR {
            f64::INFINITY
        } else {
            system.update_noise(&mut state.noise, prior, known)
        };
        system = System::at(problem, &state);
        let step = if system.has_levels() { STEP_WITH_LEVELS } else { STEP };
        if moved < step && changed < SIGMA_CHANGE {
            break;
        }
    }
    system.advance(problem, &mut state);
    System::at(problem, &state).finish(problem, state)
}

/// The level of the residual, shared between the sources.
fn first_noise(problem: &Problem, start: &State, known: &KnownNoise) -> NoiseModel {
    let views = &problem.views;
    let (mut rotation, mut position) = (0.0, 0.0);
    for view in views {
        let pair = view.with(&problem.extras, &start.values);
        let r = least_squares::residual(&start.hand_eye, &pair);
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
            Source::RobotPosition => level(position) * ROBOT_POSITION_SHARE,
            s if s.is_rotation() => level(rotation),
            _ => level(position),
        };
        s.sigma = known.sigma(s.source).unwrap_or(sigma);
    }
    levelled(problem, start, noise, known)
}

/// The same shares at the height that makes the residual of the views as large as expected.
fn levelled(
    problem: &Problem,
    start: &State,
    mut noise: NoiseModel,
    known: &KnownNoise,
) -> NoiseModel {
    let of_views = |e: &Extra| matches!(e.kind, ExtraKind::Camera(_) | ExtraKind::Arm(_));
    let kept: Vec<usize> =
        (0..problem.extras.len()).filter(|&k| of_views(&problem.extras[k])).collect();
    let extras = kept.iter().map(|&k| problem.extras[k]).collect();
    let views_only = Problem { boards: vec![], extras, ..problem.clone() };
    let mut state = State::new(&views_only, start.hand_eye, noise.clone());
    state.values = DVector::from_iterator(kept.len(), kept.iter().map(|&k| start.values[k]));
    for _ in 0..2 {
        System::at(&views_only, &state).advance(&views_only, &mut state);
    }
    let cost = System::at(&views_only, &state).cost_of_poses();
    let dof = 6.0 * problem.views.len() as f64 - 12.0;
    let level = (cost.max(0.0) / dof.max(6.0)).sqrt().max(1e-6);
    for s in &mut noise.sigmas {
        let has_own = matches!(s.source, Source::Picture | Source::Touch) || s.source.is_level();
        if !has_own && known.sigma(s.source).is_none() {
            s.sigma *= level;
        }
    }
    let touch = touch_level(problem, &state, &noise);
    if let Some(s) = noise.sigmas.iter_mut().find(|s| s.source == Source::Touch)
        && known.sigma(Source::Touch).is_none()
    {
        s.sigma = touch;
    }
    noise.sigmas.iter_mut().for_each(|s| s.sigma = s.sigma.max(LEAST_SIGMA));
    noise
}

/// RMS residual of the touches per axis, where the views put them, but not beyond what a hand does.
fn touch_level(problem: &Problem, state: &State, noise: &NoiseModel) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for board in &problem.boards {
        let rows = touch_residual::rows(
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
    (TOUCH_SHARE * (sum / f64::max(count, 1.0)).sqrt()).clamp(1e-9, LARGEST_TOUCH)
}

/// Share of that residual which is taken to be the hand's: the answer of the views errs as well.
const TOUCH_SHARE: f64 = 0.75;
/// Prior of the error of a tip led by hand, m per axis: at most this.
const LARGEST_TOUCH: f64 = 0.25e-3;

/// The sources that act on this problem.
fn acting(problem: &Problem) -> impl Iterator<Item = Source> {
    let seen = |b: &TouchedBoard| b.seen.as_ref().is_some_and(|v| v.covariance.is_none());
    let bare =
        problem.views.iter().any(|v| v.covariance.is_none()) || problem.boards.iter().any(seen);
    let pictured = problem.views.iter().any(|v| v.covariance.is_some());
    let touched = !problem.boards.is_empty();
    Source::ALL.into_iter().filter(move |s| match s {
        Source::RobotRotation | Source::RobotPosition => true,
        Source::Picture => pictured,
        Source::Touch => touched,
        level if level.is_level() => problem.extras.iter().any(|e| e.kind.level() == Some(*level)),
        _ => bare,
    })
}

impl JointFit {
    /// Covariance of `(X, Y)`, marginal over everything else.
    pub fn pose_covariance(&self) -> Option<Matrix12> {
        self.covariance.as_ref().map(|c| c.fixed_view::<12, 12>(0, 0).into_owned())
    }

    /// The covariance of `(X, Y, extras)` as a sum over the sources of noise; `None` stands for what
    /// was believed of the extras beforehand, and for all else that is in it.
    pub(crate) fn covariance_shares(
        &self,
        problem: &Problem,
    ) -> Vec<(Option<Source>, DMatrix<f64>)> {
        let Some(covariance) = &self.covariance else { return vec![] };
        let system = System::at(problem, &self.state(problem, &self.noise));
        let Some(by_noise) = system.stated_covariance(&self.noise) else { return vec![] };
        let carried =
            |(source, m): (Option<Source>, DMatrix<f64>)| (source, &by_noise * m * &by_noise);
        let mut shares: Vec<_> = system.shares(&self.noise).into_iter().map(carried).collect();
        let of_noise = shares.iter().filter(|s| s.0.is_some());
        let rest = of_noise.fold(covariance.clone(), |rest, (_, share)| rest - share);
        shares.iter_mut().filter(|s| s.0.is_none()).for_each(|s| s.1.copy_from(&rest));
        shares
    }

    /// The covariance of `(X, Y, extras)` as it were with other data of the same kind, or with
    /// other noise: what does not come from noise stays.
    pub(crate) fn covariance_for(
        &self,
        own: &Problem,
        problem: &Problem,
        noise: &NoiseModel,
    ) -> Option<DMatrix<f64>> {
        let of = |problem: &Problem, noise: &NoiseModel| {
            System::at(problem, &self.state(problem, noise)).stated_covariance(noise)
        };
        let other = self.covariance.as_ref()? - of(own, &self.noise)?;
        Some(of(problem, noise)? + other)
    }

    /// How far `(X, Y, extras)` move, to first order, where each group of views is left out in turn.
    pub(crate) fn steps_without(
        &self,
        problem: &Problem,
        groups: &[Vec<usize>],
    ) -> Option<Vec<Steps>> {
        let state = self.state(problem, &self.noise);
        System::at(problem, &state).steps_without(problem, &state, groups)
    }

    fn state(&self, problem: &Problem, noise: &NoiseModel) -> State {
        let values = carried_values(problem, self);
        State { hand_eye: self.hand_eye, values, noise: noise.clone() }
    }

    /// Squared Mahalanobis distance of a capture that the fit has not seen: its residual against its
    /// own noise and the fit's uncertainty together.
    pub fn squared_mahalanobis(&self, view: &View, setup: Setup) -> Option<f64> {
        let pair = view.with(&self.extras, &self.values);
        let (r, j) = least_squares::residual_with_jacobian(&self.hand_eye, &pair);
        let own = self.noise.covariance(view, &self.hand_eye, setup);
        let expected = own + j * self.pose_covariance()? * j.transpose();
        Some(r.dot(&(linalg::invert_spd(&expected)? * r)))
    }

    /// Squared Mahalanobis distance of a capture against its own noise alone.
    pub(crate) fn distance(&self, view: &View, setup: Setup) -> Option<f64> {
        let r = least_squares::residual(&self.hand_eye, &view.with(&self.extras, &self.values));
        let own = self.noise.covariance(view, &self.hand_eye, setup);
        Some(r.dot(&(linalg::invert_spd(&own)? * r)))
    }

    /// Residual of every touch of a board, in the base (m).
    pub(crate) fn touch_residuals(
        &self,
        problem: &Problem,
        board: &TouchedBoard,
    ) -> Vec<nalgebra::Vector3<f64>> {
        let rows = self.touch_rows(problem, board);
        (0..board.corners.len()).map(|k| rows.residual.fixed_rows::<3>(3 * k).into()).collect()
    }

    /// Residual of every touch of a board, in the base (m), and its covariance without what the touch
    /// itself adds.
    pub(crate) fn expected_touches(
        &self,
        problem: &Problem,
        board: &TouchedBoard,
    ) -> Option<Vec<(nalgebra::Vector3<f64>, nalgebra::Matrix3<f64>)>> {
        let (rows, all) = self.unseen_touches(problem, board)?;
        let one = |k: usize| {
            (
                rows.residual.fixed_rows::<3>(3 * k).into(),
                all.fixed_view::<3, 3>(3 * k, 3 * k).into(),
            )
        };
        Some((0..board.corners.len()).map(one).collect())
    }

    fn touch_rows(&self, problem: &Problem, board: &TouchedBoard) -> TouchRows {
        let values = carried_values(problem, self);
        let variances = self.noise.variances();
        let (at, extras) = (&self.hand_eye, &problem.extras);
        touch_residual::rows(board, at, extras, &values, &variances, problem.setup)
    }

    /// Squared residual of touches over the variance of the noise.
    pub(crate) fn squared_residual_over_noise(
        &self,
        problem: &Problem,
        board: &TouchedBoard,
    ) -> Option<f64> {
        let rows = self.touch_rows(problem, board);
        let noise = Cholesky::new(rows.covariance)?;
        Some(rows.residual.dot(&noise.solve(&rows.residual)))
    }

    /// Squared Mahalanobis distance of touches that the fit has not seen, as [`Self::squared_mahalanobis`].
    pub(crate) fn squared_mahalanobis_of_touch(
        &self,
        problem: &Problem,
        board: &TouchedBoard,
    ) -> Option<f64> {
        let (rows, all) = self.unseen_touches(problem, board)?;
        let cholesky = Cholesky::new(all)?;
        Some(rows.residual.dot(&cholesky.solve(&rows.residual)))
    }

    /// Touches as the fit expects them, and the covariance of their residuals when it has not seen
    /// them.
    fn unseen_touches(
        &self,
        problem: &Problem,
        board: &TouchedBoard,
    ) -> Option<(TouchRows, nalgebra::DMatrix<f64>)> {
        let rows = self.touch_rows(problem, board);
        let spread = &rows.jacobian * self.covariance.as_ref()? * rows.jacobian.transpose();
        let all = &rows.covariance + spread;
        Some((rows, all))
    }

    /// The value and standard deviation of an extra, if it was free.
    pub fn extra(&self, kind: ExtraKind) -> Option<(f64, f64)> {
        let k = self.extras.iter().position(|e| e.kind == kind)?;
        let variance = self.covariance.as_ref()?[(12 + k, 12 + k)];
        Some((self.values[k], variance.max(0.0).sqrt()))
    }
}
