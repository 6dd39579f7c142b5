//! Unknowns beside `X` and `Y`, each with a prior: `x ~ N(x₀, σ²)`.

use nalgebra::{DVector, Vector6};

use super::noise::{Source, Variances};
use crate::{PosePair, model::residual::Residual, solve::least_squares::View};

/// What the unknown changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExtraKind {
    /// A parameter of the camera or the target, by its number in [`crate::detect::sight`].
    Camera(usize),
    /// Where the tip is beyond where the robot believes it, axis of the flange (m); of the base
    /// where no flange pose was recorded at contact.
    Tip(usize),
    /// A deviation of the arm from its model, by its number among those that are free (rad, m).
    Arm(usize),
    /// Strength of one wave of the robot's rotation error over the places it goes to, by its column in
    /// `View::by_robot` (rad); the level of all of them is [`Source::PlaceRotation`].
    PlaceTurn(usize),
    /// The same of its position error (m), with the level [`Source::PlacePosition`].
    PlaceShift(usize),
    /// Systematic difference between the views and the touched places, in units of its own size.
    Systematic(usize),
}

impl ExtraKind {
    /// The noise that says how large the unknown is believed to be, where that is estimated.
    pub fn level(self) -> Option<Source> {
        match self {
            Self::PlaceTurn(_) => Some(Source::PlaceRotation),
            Self::PlaceShift(_) => Some(Source::PlacePosition),
            _ => None,
        }
    }

    /// Its column in [`View::by_robot`], where it is an error of the robot.
    pub(crate) fn of_robot(self) -> Option<usize> {
        match self {
            Self::Arm(which) | Self::PlaceTurn(which) | Self::PlaceShift(which) => Some(which),
            _ => None,
        }
    }
}

/// One unknown beside `X` and `Y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extra {
    /// What it changes.
    pub kind: ExtraKind,
    /// Mean of its prior.
    pub prior_mean: f64,
    /// Standard deviation of its prior; a factor on it, where the kind has a [level](ExtraKind::level).
    pub prior_sigma: f64,
}

impl Extra {
    /// Variance of its prior.
    pub(super) fn prior_variance(&self, variances: &Variances) -> f64 {
        let level = self.kind.level().map_or(1.0, |source| variances[source.index()]);
        self.prior_sigma.powi(2) * level
    }

    /// An unknown whose prior mean is zero.
    pub fn about_zero(kind: ExtraKind, prior_sigma: f64) -> Self {
        Self { kind, prior_mean: 0.0, prior_sigma }
    }
}

/// Size of a systematic difference of unit strength, per axis, at the middle of the touched places.
pub(crate) const SYSTEMATIC: Residual =
    Residual { angle: 0.04 / 180.0 * std::f64::consts::PI, distance: 0.5e-3 };

/// Standard deviation of a tool tip that was measured with care, m per axis.
pub const TIP_PRIOR: f64 = 0.5e-3;

/// Three coordinates of the tip.
pub fn tip(prior_sigma: f64) -> [Extra; 3] {
    std::array::from_fn(|k| Extra::about_zero(ExtraKind::Tip(k), prior_sigma))
}

/// Six coordinates of a systematic difference of this strength.
pub fn systematic(strength: f64) -> [Extra; 6] {
    std::array::from_fn(|k| Extra::about_zero(ExtraKind::Systematic(k), strength))
}

/// The value of an unknown; zero where it is not free.
pub(super) fn value(extras: &[Extra], values: &DVector<f64>, kind: ExtraKind) -> f64 {
    extras.iter().position(|e| e.kind == kind).map_or(0.0, |k| values[k])
}

impl View {
    /// The pair at other values of the camera's parameters and of the arm's.
    pub(crate) fn with(&self, extras: &[Extra], values: &DVector<f64>) -> PosePair {
        let mut pair = self.pair;
        if self.sight.is_none() && self.by_robot.is_none() {
            return pair;
        }
        let (mut of_target, mut of_robot) = (Vector6::zeros(), Vector6::zeros());
        for (extra, value) in extras.iter().zip(values) {
            match extra.kind {
                ExtraKind::Camera(which) => of_target += self.by_camera(which) * *value,
                kind => {
                    if let Some(which) = kind.of_robot() {
                        of_robot += self.by_robot(which) * *value;
                    }
                }
            }
        }
        pair.camera_from_target = pair.camera_from_target.retract(&of_target);
        if self.by_robot.is_some() {
            pair.anchor_from_mount = pair.anchor_from_mount.retract(&of_robot);
        }
        pair
    }
}
