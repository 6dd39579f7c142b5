//! Where camera and target are, from a guess and the captures that were taken so far: the most likely place of both,
//!
//! ```text
//! min  log(X₀⁻¹ X)ᵀ S₀⁻¹ log(X₀⁻¹ X) + Σ r_iᵀ V_i⁻¹ r_i
//! ```
//!
//! One capture determines the pose of the target; two and three determine the camera better than the guess does.

use nalgebra::{Matrix6, Vector6};

use super::Setting;
use crate::{
    Base, Camera, Flange, HandEye, Pose, PosePair, Target,
    math::{
        lie, linalg,
        optimize::{self, Damping, Problem, Rules, Singular, Tried},
    },
    solve::{
        View,
        least_squares::{Matrix12, Vector12, moved, residual_with_jacobian},
    },
};

/// How well the camera's place was guessed: standard deviations about and along each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuessSigma {
    /// rad.
    pub rotation_rad: f64,
    /// m.
    pub position_m: f64,
}

/// A capture that was taken: where the robot was, and where the camera saw the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// Where the target was found.
    pub camera_from_target: Pose<Camera, Target>,
}

const RULES: Rules = Rules {
    most_steps: 50,
    damping: Damping { start: 0.0, negligible: 1e-9, raised: 1e-6, least: 0.0, most: 1e8 },
    slack: 0.0,
    singular: Singular::IsDamped,
};
/// The fit has converged when a step changes the cost by less, or by less than this part of it.
const COST_CHANGE: f64 = 1e-9;
/// Weights depend a little on where camera and target are: rounds of weighing and fitting.
const ROUNDS: usize = 2;

impl GuessSigma {
    /// Its information on `X`.
    pub(super) fn information(&self) -> Matrix6<f64> {
        let (turn, shift) = (self.rotation_rad.powi(-2), self.position_m.powi(-2));
        Matrix6::from_diagonal(&Vector6::new(turn, turn, turn, shift, shift, shift))
    }
}

/// The setting with the place of camera and target that guess and captures make most likely.
pub(super) fn refined(setting: &Setting, sigma: &GuessSigma, taken: &[Taken]) -> Setting {
    let Some(first) = taken.first() else { return setting.clone() };
    let pair = |t: &Taken| PosePair {
        anchor_from_mount: setting.setup.anchor_from_mount(t.base_from_flange),
        camera_from_target: t.camera_from_target,
    };
    let pairs: Vec<PosePair> = taken.iter().map(pair).collect();
    let guess = setting.hand_eye.mount_from_camera;
    let at_first = pair(first);
    let mut now = setting.clone();
    now.hand_eye.anchor_from_target =
        at_first.anchor_from_mount * guess * at_first.camera_from_target;
    for _ in 0..ROUNDS {
        let weights: Vec<Matrix6<f64>> = pairs.iter().map(|pair| now.weight(pair)).collect();
        let fit =
            Informed { pairs: &pairs, weights: &weights, guess, information: sigma.information() };
        let start = fit.normal(&now.hand_eye);
        optimize::descend(&fit, &mut now.hand_eye, start, &RULES);
    }
    now
}

impl Setting {
    /// Inverse covariance of a capture's residual; none where the target is not seen as a whole.
    fn weight(&self, pair: &PosePair) -> Matrix6<f64> {
        let found = || {
            let covariance = linalg::invert_spd(&self.of_picture(&pair.camera_from_target)?)?;
            let view = View { covariance: Some(covariance), ..View::bare(*pair) };
            linalg::invert_spd(&self.model().covariance(&view, &self.hand_eye, self.setup))
        };
        found().unwrap_or_else(Matrix6::zeros)
    }
}

/// Captures and a guess of the camera's place.
struct Informed<'a> {
    pairs: &'a [PosePair],
    weights: &'a [Matrix6<f64>],
    guess: Pose<crate::Mount, Camera>,
    information: Matrix6<f64>,
}

struct Normal {
    h: Matrix12,
    g: Vector12,
    cost: f64,
}

impl Informed<'_> {
    fn normal(&self, at: &HandEye) -> Normal {
        let off = self.guess.local(&at.mount_from_camera);
        let by_step = lie::left_jacobian_inverse(&off) + lie::ad(&off);
        let mut sum = Normal { h: Matrix12::zeros(), g: Vector12::zeros(), cost: 0.0 };
        let weighed = by_step.transpose() * self.information;
        sum.h.fixed_view_mut::<6, 6>(0, 0).copy_from(&(weighed * by_step));
        sum.g.fixed_rows_mut::<6>(0).copy_from(&(weighed * off));
        sum.cost = off.dot(&(self.information * off));
        for (pair, weight) in self.pairs.iter().zip(self.weights) {
            let (r, j) = residual_with_jacobian(at, pair);
            let jw = j.transpose() * weight;
            sum.h += jw * j;
            sum.g += jw * r;
            sum.cost += r.dot(&(weight * r));
        }
        sum
    }
}

impl Problem for Informed<'_> {
    type Point = HandEye;
    type Equations = Normal;
    type Step = Vector12;

    fn equations(&self, at: &HandEye) -> Option<Normal> {
        Some(self.normal(at))
    }

    fn cost(&self, here: &Normal) -> f64 {
        here.cost
    }

    fn step(&self, _: &HandEye, here: &Normal, damping: f64) -> Option<Vector12> {
        let mut h = here.h;
        (0..12).for_each(|k| h[(k, k)] *= 1.0 + damping);
        Some(-(linalg::invert_spd(&h)? * here.g))
    }

    fn moved(&self, at: &HandEye, step: &Vector12) -> HandEye {
        moved(at, step)
    }

    fn is_last(&self, tried: &Tried<Vector12>) -> bool {
        let gain = tried.before - tried.after;
        gain.is_nan() || gain.abs() <= COST_CHANGE * tried.before.max(1.0)
    }
}
