//! Maximum likelihood over pose pairs, with the noise of robot and camera estimated alongside.
//!
//! ```text
//! r_i = log(C_i⁻¹ X⁻¹ A_i⁻¹ Y)        cov(r_i) = S_i = Σ_k θ_k G_ik
//! ∂r/∂X = -J_l⁻¹(r) Ad(C_i⁻¹)          ∂r/∂Y = J_r⁻¹(r)
//! ```
//!
//! with `X = mount_from_camera`, `Y = anchor_from_target`, both perturbed on the right. To first
//! order this is the marginal of the full problem in which every robot pose is an unknown of its
//! own. Given the noise, Levenberg-Marquardt finds `X, Y`; given those, restricted maximum
//! likelihood (REML) gives the `θ`: with `u_i = S_i⁻¹ r_i`, `H = Σ JᵀS⁻¹J`,
//!
//! ```text
//! θ_k ← θ_k · Σ u_iᵀ G_ik u_i / (Σ tr(S_i⁻¹ G_ik) - tr(H⁻¹ Σ J_iᵀ S_i⁻¹ G_ik S_i⁻¹ J_i))
//! ```
//!
//! D. Harville, *Maximum likelihood approaches to variance component estimation*, JASA 72, 1977;
//! M. Ulrich and M. Hillemann, *Uncertainty-aware hand-eye calibration*, IEEE T-RO 40, 2024.

use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::noise::{KnownNoise, NoiseModel, Sigma, Source};
use crate::{Error, HandEye, PosePair, Setup, lie, linalg};

/// One capture as the fit sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Robot pose and target pose.
    pub pair: PosePair,
    /// Covariance of the target pose, in the Target frame; `None` when unknown.
    pub covariance: Option<Matrix6<f64>>,
}

/// Information and covariance matrices of both unknowns: X first, then Y.
pub type Matrix12 = SMatrix<f64, 12, 12>;
type Vector12 = SVector<f64, 12>;
type Matrix6x12 = SMatrix<f64, 6, 12>;

/// Both unknowns, and how sure they are.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseFit {
    /// The answer.
    pub hand_eye: HandEye,
    /// Covariance of `(X, Y)`; `None` where the views leave a direction free.
    pub covariance: Option<Matrix12>,
    /// Information of `(X, Y)`.
    pub information: Matrix12,
    /// Noise of each source, per axis.
    pub noise: NoiseModel,
    /// `Σ rᵀ S⁻¹ r`.
    pub chi_squared: f64,
    /// Equations minus unknowns.
    pub degrees_of_freedom: f64,
}

/// Steps of one fit; it takes five from a closed form.
const MOST_STEPS: usize = 100;
/// The fit has converged when a step changes the cost by less than this part of it.
const COST_CHANGE: f64 = 1e-14;
/// Rounds of noise estimation.
const MOST_ROUNDS: usize = 200;
/// Noise estimation has converged when no standard deviation changes by more than this part.
const SIGMA_CHANGE: f64 = 1e-4;

/// The misfit of one view, `r_i`.
pub fn misfit(hand_eye: &HandEye, pair: &PosePair) -> Vector6<f64> {
    lie::log(hand_eye.loop_error(pair).inverse().iso())
}

/// The misfit and its Jacobian by `(X, Y)`.
pub fn misfit_with_jacobian(
    hand_eye: &HandEye,
    pair: &PosePair,
) -> (Vector6<f64>, SMatrix<f64, 6, 12>) {
    let r = misfit(hand_eye, pair);
    let by_x =
        -lie::left_jacobian_inverse(&r) * lie::adjoint(pair.camera_from_target.inverse().iso());
    let mut j = Matrix6x12::zeros();
    j.fixed_view_mut::<6, 6>(0, 0).copy_from(&by_x);
    j.fixed_view_mut::<6, 6>(0, 6).copy_from(&lie::right_jacobian_inverse(&r));
    (r, j)
}

/// Normal equations at one point, for weights held still.
struct Normal {
    h: Matrix12,
    g: Vector12,
    cost: f64,
}

fn normal(views: &[View], weights: &[Matrix6<f64>], at: &HandEye) -> Normal {
    let mut sum = Normal { h: Matrix12::zeros(), g: Vector12::zeros(), cost: 0.0 };
    for (view, w) in views.iter().zip(weights) {
        let (r, j) = misfit_with_jacobian(at, &view.pair);
        let jw = j.transpose() * w;
        sum.h += jw * j;
        sum.g += jw * r;
        sum.cost += r.dot(&(w * r));
    }
    sum
}

fn moved(at: &HandEye, step: &Vector12) -> HandEye {
    let half = |k: usize| Vector6::from_fn(|i, _| step[k + i]);
    HandEye {
        mount_from_camera: at.mount_from_camera.retract(&half(0)),
        anchor_from_target: at.anchor_from_target.retract(&half(6)),
    }
}

/// Levenberg-Marquardt for weights held still.
fn minimise(views: &[View], weights: &[Matrix6<f64>], start: &HandEye) -> (HandEye, Normal) {
    let mut at = *start;
    let mut here = normal(views, weights, &at);
    let mut damping = 0.0;
    for _ in 0..MOST_STEPS {
        let Some(step) = damped_step(&here, damping) else {
            damping = raised(damping);
            if damping > 1e8 {
                break;
            }
            continue;
        };
        let next = moved(&at, &step);
        let there = normal(views, weights, &next);
        let gain = here.cost - there.cost;
        if gain < 0.0 && gain.abs() > COST_CHANGE * here.cost && damping < 1e8 {
            damping = raised(damping);
            continue;
        }
        let done = gain.abs() <= COST_CHANGE * here.cost || !gain.is_finite();
        if gain >= 0.0 {
            (at, here) = (next, there);
            damping *= 0.1;
        }
        if done {
            break;
        }
    }
    (at, here)
}

fn raised(damping: f64) -> f64 {
    if damping < 1e-9 { 1e-6 } else { damping * 10.0 }
}

fn damped_step(at: &Normal, damping: f64) -> Option<Vector12> {
    let mut h = at.h;
    for k in 0..12 {
        h[(k, k)] *= 1.0 + damping;
    }
    let inverse = linalg::invert_spd(&h)?;
    let step = -(inverse * at.g);
    // one round of refinement of the linear solution
    Some(step - inverse * (at.g + h * step))
}

/// Fits both unknowns for noise that is known.
///
/// The weights follow the fit: robot noise is carried to the target through `X` or `Y`.
pub fn fit(views: &[View], start: &HandEye, noise: &NoiseModel, setup: Setup) -> PoseFit {
    let mut at = *start;
    for _ in 0..3 {
        let weights = weights(views, &at, noise, setup);
        let (next, _) = minimise(views, &weights, &at);
        let still = next.mount_from_camera.distance_to(&at.mount_from_camera) < 1e-12;
        at = next;
        if still {
            break;
        }
    }
    let weights = weights(views, &at, noise, setup);
    let normal = normal(views, &weights, &at);
    PoseFit {
        hand_eye: at,
        covariance: linalg::invert_spd(&normal.h),
        information: normal.h,
        noise: noise.clone(),
        chi_squared: normal.cost,
        degrees_of_freedom: 6.0 * views.len() as f64 - 12.0,
    }
}

fn weights(views: &[View], at: &HandEye, noise: &NoiseModel, setup: Setup) -> Vec<Matrix6<f64>> {
    let weight = |view: &View| {
        linalg::invert_spd(&noise.covariance(view, at, setup)).unwrap_or_else(Matrix6::zeros)
    };
    views.iter().map(weight).collect()
}

/// Fits both unknowns with one weight for all: 1 rad of misfit costs as much as `metres_per_rad`.
pub fn fit_fixed_weights(views: &[View], start: &HandEye, metres_per_rad: f64) -> HandEye {
    let rotation = metres_per_rad * metres_per_rad;
    let weight = Matrix6::from_diagonal(&Vector6::new(rotation, rotation, rotation, 1.0, 1.0, 1.0));
    minimise(views, &vec![weight; views.len()], start).0
}

/// Fits both unknowns and the noise of every source, by REML.
///
/// Few captures tell little about the noise, so each component carries a prior worth
/// `PRIOR_VIEWS` captures at the common level of the misfit, shared out as in `first_noise`.
pub fn fit_estimating_noise(
    views: &[View],
    start: &HandEye,
    known: &KnownNoise,
    setup: Setup,
) -> Result<PoseFit, Error> {
    if views.len() < crate::solve::FEWEST_POSES {
        return Err(crate::solve::too_few(views.len()));
    }
    let start = fit_fixed_weights(views, start, FIRST_WEIGHT);
    let prior = levelled(views, &start, first_noise(views, &start, known), known, setup);
    let mut at = fit(views, &start, &prior, setup);
    for _ in 0..MOST_ROUNDS {
        let noise = updated_noise(views, &at, &prior, known, setup);
        let change = at.noise.largest_change(&noise);
        at = fit(views, &at.hand_eye, &noise, setup);
        if change < SIGMA_CHANGE {
            break;
        }
    }
    Ok(at)
}

/// Weight of rotation against translation in the fit whose misfit gives the first noise level,
/// m per rad.
const FIRST_WEIGHT: f64 = 0.3;
/// Captures' worth of prior belief in the first noise level.
const PRIOR_VIEWS: f64 = 2.0;
/// Prior share of the misfit in rotation that is the robot's: a robot reports its orientation
/// several times better than one picture tells a board's tilt.
const ROBOT_ROTATION_SHARE: f64 = 0.3;

/// The level of the misfit, shared between robot and camera.
fn first_noise(views: &[View], start: &HandEye, known: &KnownNoise) -> NoiseModel {
    let (mut rotation, mut position) = (0.0, 0.0);
    for view in views {
        let r = misfit(start, &view.pair);
        rotation += lie::omega(&r).norm_squared();
        position += lie::nu(&r).norm_squared();
    }
    let level = |sum: f64| (0.5 * sum / (3.0 * views.len() as f64 - 6.0).max(3.0)).sqrt().max(1e-9);
    let mut noise = NoiseModel::start(views.iter().any(|v| v.covariance.is_none()));
    for s in &mut noise.sigmas {
        let sigma = match s.source {
            Source::Picture => 1.0,
            Source::RobotRotation => level(rotation) * ROBOT_ROTATION_SHARE,
            s if s.is_rotation() => level(rotation),
            _ => level(position),
        };
        s.sigma = known.sigma(s.source).unwrap_or(sigma);
    }
    noise
}

/// The same shares at the height that makes the misfit as large as expected.
fn levelled(
    views: &[View],
    start: &HandEye,
    mut noise: NoiseModel,
    known: &KnownNoise,
    setup: Setup,
) -> NoiseModel {
    let at = fit(views, start, &noise, setup);
    let level = (at.chi_squared / at.degrees_of_freedom.max(6.0)).sqrt().max(1e-6);
    for s in &mut noise.sigmas {
        if s.source != Source::Picture && known.sigma(s.source).is_none() {
            s.sigma *= level;
        }
    }
    noise
}

/// One REML step on every component that is not known.
fn updated_noise(
    views: &[View],
    at: &PoseFit,
    prior: &NoiseModel,
    known: &KnownNoise,
    setup: Setup,
) -> NoiseModel {
    let Some(covariance) = &at.covariance else { return at.noise.clone() };
    let weights = weights(views, &at.hand_eye, &at.noise, setup);
    let update = |(s, first): (&Sigma, &Sigma)| {
        if known.sigma(s.source).is_some() {
            return *s;
        }
        let (found, expected) = moments(views, &weights, &at.hand_eye, covariance, s.source, setup);
        let theta = s.sigma * s.sigma;
        let belief = PRIOR_VIEWS * s.source.axes() / theta;
        let factor = (found + belief * first.sigma.powi(2) / theta) / (expected.max(0.0) + belief);
        Sigma { source: s.source, sigma: (s.sigma * factor.sqrt()).max(1e-12) }
    };
    NoiseModel { sigmas: at.noise.sigmas.iter().zip(&prior.sigmas).map(update).collect() }
}

/// `Σ uᵀ G u` and its expectation, the two sides of the REML equation of one component.
fn moments(
    views: &[View],
    weights: &[Matrix6<f64>],
    hand_eye: &HandEye,
    covariance: &Matrix12,
    source: Source,
    setup: Setup,
) -> (f64, f64) {
    let (mut found, mut expected) = (0.0, 0.0);
    for (view, w) in views.iter().zip(weights) {
        let g = source.shape(view, hand_eye, setup);
        let (r, j) = misfit_with_jacobian(hand_eye, &view.pair);
        let (u, wj) = (w * r, w * j);
        found += u.dot(&(g * u));
        expected += (w * g).trace() - (covariance * (wj.transpose() * g * wj)).trace();
    }
    (found, expected)
}

impl PoseFit {
    /// Squared Mahalanobis distance of a capture that the fit has not seen: its misfit against its
    /// own noise and the fit's uncertainty together.
    pub fn surprise(&self, view: &View, setup: Setup) -> Option<f64> {
        let (r, j) = misfit_with_jacobian(&self.hand_eye, &view.pair);
        let own = self.noise.covariance(view, &self.hand_eye, setup);
        let expected = own + j * self.covariance? * j.transpose();
        Some(r.dot(&(linalg::invert_spd(&expected)? * r)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{assert_same, exact_pairs, truths};

    fn views(count: usize) -> Vec<View> {
        exact_pairs(&truths()[0], count)
            .into_iter()
            .map(|pair| View { pair, covariance: None })
            .collect()
    }

    #[test]
    fn jacobian_matches_central_differences() {
        let truth = truths()[0];
        let off = moved(&truth, &Vector12::from_fn(|i, _| 0.3 * (i as f64 + 1.0).sin()));
        for view in views(5) {
            let (_, j) = misfit_with_jacobian(&off, &view.pair);
            for k in 0..12 {
                let mut step = Vector12::zeros();
                step[k] = 1e-6;
                let ahead = misfit(&moved(&off, &step), &view.pair);
                let behind = misfit(&moved(&off, &-step), &view.pair);
                let numeric = (ahead - behind) / 2e-6;
                assert!((j.column(k) - numeric).norm() < 1e-6, "column {k}");
            }
        }
    }

    #[test]
    fn exact_views_give_the_truth_from_a_bad_start() {
        let truth = truths()[0];
        let off = moved(&truth, &Vector12::from_fn(|i, _| 0.1 * (i as f64 + 1.0).cos()));
        let found =
            fit_estimating_noise(&views(12), &off, &KnownNoise::default(), Setup::EyeInHand)
                .unwrap();
        assert_same(found.hand_eye.mount_from_camera, truth.mount_from_camera, "X");
        assert_same(found.hand_eye.anchor_from_target, truth.anchor_from_target, "Y");
    }
}
