//! Where the misfit of a loop `C⁻¹ X⁻¹ A⁻¹ Y = exp(r)` comes from.
//!
//! The robot errs at the flange, the camera in its own axes at the target. Each source of error is
//! one variance component: `cov(r_i) = Σ_k θ_k G_ik`, with known `G_ik` and unknown `θ_k` (rad² or
//! m², or a pure factor on a covariance that came with the picture).

use nalgebra::{Isometry3, Matrix3, Matrix6};
use serde::{Deserialize, Serialize};

use super::View;
use crate::{HandEye, Setup, lie};

/// One source of error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// Rotation the robot reports, at the flange.
    RobotRotation,
    /// Position the robot reports, at the flange.
    RobotPosition,
    /// Factor on the covariance of target poses that came from corners.
    Picture,
    /// Rotation of a target pose of unknown covariance, out of the picture plane.
    CameraTilt,
    /// Rotation of such a pose about the optical axis.
    CameraRoll,
    /// Position of such a pose across the optical axis.
    CameraLateral,
    /// Position of such a pose along the optical axis.
    CameraDepth,
}

impl Source {
    /// Sources that act on views with a covariance of their own.
    pub const WITH_COVARIANCE: [Source; 3] =
        [Source::RobotRotation, Source::RobotPosition, Source::Picture];
    /// Sources that act on views that are bare poses.
    pub const BARE: [Source; 6] = [
        Source::RobotRotation,
        Source::RobotPosition,
        Source::CameraTilt,
        Source::CameraRoll,
        Source::CameraLateral,
        Source::CameraDepth,
    ];

    /// Words for people.
    pub fn name(self) -> &'static str {
        match self {
            Source::RobotRotation => "robot rotation",
            Source::RobotPosition => "robot position",
            Source::Picture => "picture",
            Source::CameraTilt => "camera tilt",
            Source::CameraRoll => "camera roll",
            Source::CameraLateral => "camera lateral",
            Source::CameraDepth => "camera depth",
        }
    }

    /// Whether the standard deviation is an angle.
    pub fn is_rotation(self) -> bool {
        matches!(self, Source::RobotRotation | Source::CameraTilt | Source::CameraRoll)
    }

    /// How many axes share this standard deviation.
    pub(super) fn axes(self) -> f64 {
        match self {
            Source::Picture => 6.0,
            Source::RobotRotation | Source::RobotPosition => 3.0,
            Source::CameraTilt | Source::CameraLateral => 2.0,
            Source::CameraRoll | Source::CameraDepth => 1.0,
        }
    }

    /// `G_ik`, in the Target frame, rotation first.
    pub(super) fn shape(self, view: &View, hand_eye: &HandEye, setup: Setup) -> Matrix6<f64> {
        let in_camera = |rotation: [f64; 3], translation: [f64; 3]| {
            let r = view.pair.camera_from_target.rotation();
            let turned = |d: [f64; 3]| r.transpose() * Matrix3::from_diagonal(&d.into()) * r;
            both(&turned(rotation), &turned(translation))
        };
        match self {
            Source::RobotRotation => at_flange(view, hand_eye, setup, 1.0, 0.0),
            Source::RobotPosition => at_flange(view, hand_eye, setup, 0.0, 1.0),
            Source::Picture => view.covariance.unwrap_or_else(Matrix6::zeros),
            Source::CameraTilt => in_camera([1.0, 1.0, 0.0], [0.0; 3]),
            Source::CameraRoll => in_camera([0.0, 0.0, 1.0], [0.0; 3]),
            Source::CameraLateral => in_camera([0.0; 3], [1.0, 1.0, 0.0]),
            Source::CameraDepth => in_camera([0.0; 3], [0.0, 0.0, 1.0]),
        }
    }
}

fn both(rotation: &Matrix3<f64>, translation: &Matrix3<f64>) -> Matrix6<f64> {
    let mut g = Matrix6::zeros();
    g.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation);
    g.fixed_view_mut::<3, 3>(3, 3).copy_from(translation);
    g
}

/// Isotropic noise at the flange, carried to the target.
fn at_flange(
    view: &View,
    hand_eye: &HandEye,
    setup: Setup,
    rotation: f64,
    position: f64,
) -> Matrix6<f64> {
    let target_from_flange: Isometry3<f64> = match setup {
        // the mount is the flange: through the camera
        Setup::EyeInHand => {
            (hand_eye.mount_from_camera * view.pair.camera_from_target).iso().inverse()
        }
        // the anchor is the flange
        Setup::EyeToHand => hand_eye.anchor_from_target.iso().inverse(),
    };
    let carry = lie::adjoint(&target_from_flange);
    let noise = both(&(Matrix3::identity() * rotation), &(Matrix3::identity() * position));
    carry * noise * carry.transpose()
}

/// Standard deviation of one source, per axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sigma {
    /// Which source.
    pub source: Source,
    /// rad, m, or a factor (for [`Source::Picture`]).
    pub sigma: f64,
}

/// Standard deviations of all sources that act.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NoiseModel {
    /// One entry a source.
    pub sigmas: Vec<Sigma>,
}

/// Noise figures that the user knows; what is left out is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct KnownNoise {
    /// Robot rotation, rad per axis.
    pub robot_rotation_rad: Option<f64>,
    /// Robot position, m per axis.
    pub robot_position_m: Option<f64>,
    /// Touching, m per axis.
    pub touch_m: Option<f64>,
}

impl KnownNoise {
    /// What the user knows of a source.
    pub(super) fn sigma(&self, source: Source) -> Option<f64> {
        match source {
            Source::RobotRotation => self.robot_rotation_rad,
            Source::RobotPosition => self.robot_position_m,
            _ => None,
        }
    }
}

impl NoiseModel {
    /// Largest relative change of a standard deviation.
    pub(super) fn largest_change(&self, other: &NoiseModel) -> f64 {
        let change = |(a, b): (&Sigma, &Sigma)| (b.sigma / a.sigma - 1.0).abs();
        self.sigmas.iter().zip(&other.sigmas).map(change).fold(0.0, f64::max)
    }

    /// A cautious start for the estimation: a good industrial robot and a good camera.
    pub fn start(bare: bool) -> Self {
        let sources: &[Source] = if bare { &Source::BARE } else { &Source::WITH_COVARIANCE };
        let sigma = |source: Source| match source {
            Source::Picture => 1.0,
            s if s.is_rotation() => 2e-3,
            _ => 1e-3,
        };
        Self {
            sigmas: sources.iter().map(|&source| Sigma { source, sigma: sigma(source) }).collect(),
        }
    }

    /// Standard deviation of a source, if it acts.
    pub fn sigma(&self, source: Source) -> Option<f64> {
        self.sigmas.iter().find(|s| s.source == source).map(|s| s.sigma)
    }

    /// Covariance of a view's misfit, in the Target frame.
    pub fn covariance(&self, view: &View, hand_eye: &HandEye, setup: Setup) -> Matrix6<f64> {
        let sum: Matrix6<f64> = self
            .sigmas
            .iter()
            .map(|s| s.source.shape(view, hand_eye, setup) * (s.sigma * s.sigma))
            .sum();
        // exact data have no noise at all: keep the weights finite
        sum + both(
            &(Matrix3::identity() * LEAST_ROTATION.powi(2)),
            &(Matrix3::identity() * LEAST_POSITION.powi(2)),
        )
    }
}

/// Floor of the rotation noise, rad: far below any instrument.
const LEAST_ROTATION: f64 = 1e-9;
/// Floor of the position noise, m.
const LEAST_POSITION: f64 = 1e-9;
