//! Where the residual of a loop `C⁻¹ X⁻¹ A⁻¹ Y = exp(r)` comes from, and that of a touch.
//!
//! The robot errs at the flange, the camera in its own axes at the target, the tip where it is led
//! by hand. Each source of error is one variance component, and each residual a sum of them:
//!
//! ```text
//! cov(r_i) = B_i Θ B_iᵀ        Θ = diag(θ_source(column))
//! ```
//!
//! with known factors `B_i` and unknown `θ` (rad² or m², or a pure factor on a covariance that came
//! with the image).

use nalgebra::{Isometry3, Matrix3, Matrix6, SMatrix};
use serde::{Deserialize, Serialize};

use crate::{HandEye, PosePair, Setup, math::lie, solve::View};

/// One source of error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// Rotation the robot reports, at the flange.
    RobotRotation,
    /// Position the robot reports, at the flange.
    RobotPosition,
    /// Factor on the covariance of target poses that came from corners.
    Picture,
    /// Rotation of a target pose of unknown covariance, out of the image plane.
    CameraTilt,
    /// Rotation of such a pose about the optical axis.
    CameraRoll,
    /// Position of such a pose across the optical axis.
    CameraLateral,
    /// Position of such a pose along the optical axis.
    CameraDepth,
    /// How well the tip is led onto a corner.
    Touch,
    /// Rotation error of the robot that is alike at places near one another, at the flange.
    PlaceRotation,
    /// Position error of that kind.
    PlacePosition,
}

pub(crate) type Variances = [f64; Source::ALL.len()];

impl Source {
    /// Every source, in the order of their numbers.
    pub const ALL: [Source; 10] = [
        Source::RobotRotation,
        Source::RobotPosition,
        Source::Picture,
        Source::CameraTilt,
        Source::CameraRoll,
        Source::CameraLateral,
        Source::CameraDepth,
        Source::Touch,
        Source::PlaceRotation,
        Source::PlacePosition,
    ];

    /// Its number.
    pub(super) fn index(self) -> usize {
        self as usize
    }

    /// Words for people.
    pub fn name(self) -> &'static str {
        match self {
            Source::RobotRotation => "robot rotation",
            Source::RobotPosition => "robot position",
            Source::Picture => "image",
            Source::CameraTilt => "camera tilt",
            Source::CameraRoll => "camera roll",
            Source::CameraLateral => "camera lateral",
            Source::CameraDepth => "camera depth",
            Source::Touch => "touch",
            Source::PlaceRotation => "robot rotation by place",
            Source::PlacePosition => "robot position by place",
        }
    }

    /// Whether the standard deviation is an angle.
    pub fn is_rotation(self) -> bool {
        matches!(
            self,
            Source::RobotRotation | Source::CameraTilt | Source::CameraRoll | Source::PlaceRotation
        )
    }

    /// Whether it is the level of unknowns, and not noise of a measurement.
    pub fn is_level(self) -> bool {
        matches!(self, Source::PlaceRotation | Source::PlacePosition)
    }

    /// How many axes share this standard deviation.
    pub(super) fn axes(self) -> f64 {
        match self {
            Source::Picture => 6.0,
            Source::RobotRotation | Source::RobotPosition | Source::Touch => 3.0,
            Source::PlaceRotation | Source::PlacePosition => 3.0,
            Source::CameraTilt | Source::CameraLateral => 2.0,
            Source::CameraRoll | Source::CameraDepth => 1.0,
        }
    }
}

/// Columns of the factor of one view.
pub(super) const COLUMNS: usize = 12;
/// `B_i` of one view: robot rotation and position, then what the camera adds.
pub(super) type Factor = SMatrix<f64, 6, COLUMNS>;

/// The source behind each column of a view's factor.
pub(super) fn columns(view: &View) -> [Source; COLUMNS] {
    use Source::*;
    let mut all = [Picture; COLUMNS];
    all[..3].fill(RobotRotation);
    all[3..6].fill(RobotPosition);
    if view.covariance.is_none() {
        all[6..].copy_from_slice(&[
            CameraTilt,
            CameraTilt,
            CameraRoll,
            CameraLateral,
            CameraLateral,
            CameraDepth,
        ]);
    }
    all
}

/// `B_i`, in the Target frame, rotation first.
pub(super) fn factor(view: &View, pair: &PosePair, hand_eye: &HandEye, setup: Setup) -> Factor {
    let mut b = Factor::zeros();
    let target_from_flange: Isometry3<f64> = match setup {
        // the mount is the flange: through the camera
        Setup::EyeInHand => (hand_eye.mount_from_camera * pair.camera_from_target).iso().inverse(),
        // the anchor is the flange
        Setup::EyeToHand => hand_eye.anchor_from_target.iso().inverse(),
    };
    b.fixed_view_mut::<6, 6>(0, 0).copy_from(&lie::adjoint(&target_from_flange));
    b.fixed_view_mut::<6, 6>(0, 6).copy_from(&camera_factor(view));
    b
}

/// The camera's columns: a root of the covariance that came with the pose, or its own axes.
pub(super) fn camera_factor(view: &View) -> Matrix6<f64> {
    match &view.covariance {
        Some(covariance) => root(covariance),
        None => {
            let turned = view.pair.camera_from_target.rotation().transpose();
            both(&turned, &turned)
        }
    }
}

/// `L` with `L Lᵀ = S`; zeros where `S` is no covariance.
fn root(s: &Matrix6<f64>) -> Matrix6<f64> {
    s.cholesky().map_or_else(Matrix6::zeros, |c| c.l())
}

fn both(rotation: &Matrix3<f64>, translation: &Matrix3<f64>) -> Matrix6<f64> {
    let mut g = Matrix6::zeros();
    g.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation);
    g.fixed_view_mut::<3, 3>(3, 3).copy_from(translation);
    g
}

/// Standard deviation of one source, per axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sigma {
    /// Which source.
    pub source: Source,
    /// rad, m, or a factor (for [`Source::Picture`]).
    pub sigma: f64,
    /// Standard deviation of `sigma` over `sigma`; `None` where it was given, not estimated.
    pub uncertainty: Option<f64>,
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
    /// How well the tool tip is known, m per axis; [`super::extra::TIP_PRIOR`] where not given.
    #[serde(default)]
    pub tip_m: Option<f64>,
}

impl KnownNoise {
    /// These figures, and those of `other` where there are none.
    pub fn or(self, other: Self) -> Self {
        Self {
            robot_rotation_rad: self.robot_rotation_rad.or(other.robot_rotation_rad),
            robot_position_m: self.robot_position_m.or(other.robot_position_m),
            touch_m: self.touch_m.or(other.touch_m),
            tip_m: self.tip_m.or(other.tip_m),
        }
    }

    /// What the user knows of a source.
    pub(super) fn sigma(&self, source: Source) -> Option<f64> {
        let known = match source {
            Source::RobotRotation => self.robot_rotation_rad,
            Source::RobotPosition => self.robot_position_m,
            Source::Touch => self.touch_m,
            _ => None,
        };
        known.map(|sigma| sigma.max(LEAST_SIGMA))
    }
}

impl NoiseModel {
    /// A cautious start for the estimation: a good industrial robot, camera and hand.
    pub(super) fn start(sources: impl Iterator<Item = Source>) -> Self {
        let sigma = |source: Source| match source {
            Source::Picture => 1.0,
            Source::Touch => 0.3e-3,
            s if s.is_rotation() => 2e-3,
            _ => 1e-3,
        };
        let one = |source| Sigma { source, sigma: sigma(source), uncertainty: None };
        Self { sigmas: sources.map(one).collect() }
    }

    /// Standard deviation of a source, if it acts.
    pub fn sigma(&self, source: Source) -> Option<f64> {
        self.sigmas.iter().find(|s| s.source == source).map(|s| s.sigma)
    }

    /// Variances by number of the source; zero where it does not act.
    pub(super) fn variances(&self) -> [f64; Source::ALL.len()] {
        let mut all = [0.0; Source::ALL.len()];
        for s in &self.sigmas {
            all[s.source.index()] = s.sigma * s.sigma;
        }
        all
    }

    /// Covariance of a view's residual, in the Target frame.
    pub fn covariance(&self, view: &View, hand_eye: &HandEye, setup: Setup) -> Matrix6<f64> {
        covariance(&factor(view, &view.pair, hand_eye, setup), &columns(view), &self.variances())
    }
}

/// `B Θ Bᵀ`, kept away from zero: exact data have no noise at all.
pub(super) fn covariance(
    b: &Factor,
    columns: &[Source; COLUMNS],
    variances: &[f64; Source::ALL.len()],
) -> Matrix6<f64> {
    let mut s = Matrix6::zeros();
    for (column, source) in b.as_slice().chunks_exact(6).zip(columns) {
        let variance = variances[source.index()];
        for (k, x) in column.iter().enumerate() {
            let share = variance * x;
            s.as_mut_slice()[6 * k + k..6 * k + 6]
                .iter_mut()
                .zip(&column[k..])
                .for_each(|(s, y)| *s += share * y);
        }
    }
    s.fill_upper_triangle_with_lower_triangle();
    for k in 0..3 {
        s[(k, k)] += LEAST_ROTATION.powi(2);
        s[(k + 3, k + 3)] += LEAST_POSITION.powi(2);
    }
    s
}

/// Floor of the rotation noise, rad: far below any instrument.
pub(super) const LEAST_ROTATION: f64 = 1e-9;
/// Floor of the position noise, m.
pub(super) const LEAST_POSITION: f64 = 1e-9;

/// Least standard deviation (rad, m): far below any instrument, and far enough above rounding that
/// the rounding of large information does not pass for information on what is free.
pub(super) const LEAST_SIGMA: f64 = 1e-7;
