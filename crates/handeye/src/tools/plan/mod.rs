//! Where to take the captures: of the poses that the robot can reach, the few most informative ones.
//!
//! What a capture will say is known before it is taken: from where camera and target roughly sit
//! follows how the target will look, and from that its share in the information on `(X, Y)`,
//!
//! ```text
//! H = Σ J_iᵀ V_i⁻¹ J_i        V_i = image (all corners) + robot        S_X = [H⁻¹]_XX
//! ```
//!
//! which adds up over captures. So the next pose is the one that improves the sum most. The first
//! six raise `log det H`: every direction has to be determined at all. The others lower the
//! expected error where the answer will be used, `tr(S_X M)` with `M` the mean of `J_gᵀ J_g` over
//! the volume. Ten poses chosen so are worth fifteen at random.
//!
//! G. Nemhauser, L. Wolsey, M. Fisher, *An analysis of approximations for maximizing submodular set
//! functions*, Math. Programming 14, 1978; J. Yang, J. Rebello, S. Waslander, *Next-best-view
//! selection for robot eye-in-hand calibration*, 2023.

mod collision;
mod guess;
mod information;
mod looks;
mod planner;
mod reach;
mod refusals;
mod solids;
mod touches;
mod travel;

pub use collision::{Collision, Obstacle, On, Part, Surroundings};
pub use guess::{GuessSigma, Taken};
pub use looks::{Look, Viewing};
use nalgebra::{Matrix6, Vector3};

use crate::{
    Base, Error, Flange, HandEye, Intrinsics, Pose, Setup, TargetModel,
    estimate::predict::{PredictedTre, Volume},
    math::linalg,
    model::residual::Residual,
    register::rigid_fit::point_jacobian,
    solve::least_squares::Matrix12,
};

/// What is known of a cell before its captures are taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Who carries the camera.
    pub setup: Setup,
    /// What the camera will look at.
    pub target: TargetModel,
    /// The camera.
    pub camera: Intrinsics,
    /// Roughly where camera and target sit: from a drawing, a ruler, or an earlier calibration.
    pub hand_eye: HandEye,
    /// How well everything will be measured.
    pub noise: ExpectedNoise,
    /// Where the answer will be used.
    pub volume: Volume,
}

/// Standard deviations to be expected, each per axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedNoise {
    /// Rotation that the robot reports, rad.
    pub robot_rotation_rad: f64,
    /// Position that the robot reports, m.
    pub robot_position_m: f64,
    /// A corner in the image, px.
    pub corner_px: f64,
    /// Depth of a corner in the scan at a distance of 1 m, growing with its square (m); `None`
    /// without scans.
    pub depth_at_1m: Option<f64>,
}

impl Default for ExpectedNoise {
    /// A usual industrial arm, and corners well in focus.
    fn default() -> Self {
        Self {
            robot_rotation_rad: 0.03f64.to_radians(),
            robot_position_m: 0.3e-3,
            corner_px: 0.1,
            depth_at_1m: None,
        }
    }
}

/// Captures to take, in this order.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The poses chosen.
    pub choices: Vec<Choice>,
    /// Directions that all of them do not determine, in words.
    pub undetermined: Vec<String>,
}

/// One pose chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Its place in the list of reachable poses.
    pub candidate: usize,
    /// The error of the answer once this capture and those before are taken; `None` while they do
    /// not determine it.
    pub predicted_tre: Option<PredictedTre>,
}

/// Poses up to this many are chosen for what they determine, further ones for the error.
const FIRST: usize = 6;
/// Robots err alike in poses that are alike: turned and shifted by less, a second one
/// tells nothing new.
const ALIKE: Residual = Residual { angle: 0.05, distance: 0.02 };

/// Chooses `count` of the `reachable` poses (`base_from_flange`), to be taken beside those that are
/// `taken` already. Poses from where the whole target is not in the image are passed over, and so
/// are poses too like one that is taken.
///
/// ```
/// use handeye::{Setup, tools::plan, estimate::predict::Volume, simulate::Cell};
/// use nalgebra::Vector3;
///
/// let cell = Cell { captures: 80, ..Cell::new(Setup::EyeInHand, 1) };
/// let reachable = cell.record(1)?.truth.base_from_flange;
/// let (low, high) = (Vector3::new(-0.1, -0.1, 0.4), Vector3::new(0.1, 0.1, 0.6));
/// let setting = plan::Setting {
///     setup: cell.setup,
///     target: cell.target.clone(),
///     camera: cell.intrinsics,
///     hand_eye: cell.hand_eye,
///     noise: plan::ExpectedNoise::default(),
///     volume: Volume::of_box(&low, &high, "the gripper's reach"),
/// };
/// let plan = plan::choose(&setting, &[], &reachable, 10)?;
/// let expected = plan.choices[9].predicted_tre.as_ref().map(|e| e.rms);
/// assert!(expected.is_some_and(|mm| mm < 0.3));
/// # Ok::<(), handeye::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooFewPoses`] when fewer than `count` poses can be used; [`Error::NotFinite`] and
/// [`Error::Invalid`] for a setting or poses that make no sense.
pub fn choose(
    setting: &Setting,
    taken: &[Pose<Base, Flange>],
    reachable: &[Pose<Base, Flange>],
    count: usize,
) -> Result<Plan, Error> {
    setting.check()?;
    finite(taken)?;
    finite(reachable)?;
    let mut poses = taken.to_vec();
    let mut sum = setting.sum(taken);
    let mut free: Vec<(usize, Matrix12)> = reachable
        .iter()
        .enumerate()
        .filter_map(|(k, pose)| Some((k, setting.information(pose)?)))
        .collect();
    let moment = moment(&setting.volume);
    let mut choices = vec![];
    while choices.len() < count {
        free.retain(|(k, _)| !poses.iter().any(|p| alike(p, &reachable[*k])));
        let gain = |h: &Matrix12| {
            if poses.len() < FIRST {
                log_determinant(&(sum + h))
            } else {
                -error(&(sum + h), &moment)
            }
        };
        let gains = free.iter().map(|(_, h)| gain(h));
        // the first of equals
        let Some((best, _)) = gains.enumerate().rev().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            return Err(Error::TooFewPoses {
                found: choices.len(),
                needed: count,
                advice:
                    "only so many of the reachable poses show the whole target and differ from \
                         each other and from those taken; offer more poses"
                        .into(),
            });
        };
        let (candidate, h) = free.remove(best);
        sum += h;
        poses.push(reachable[candidate]);
        choices.push(Choice { candidate, predicted_tre: setting.expected(&sum, poses.len()) });
    }
    Ok(Plan { choices, undetermined: setting.undetermined(&sum, &poses) })
}

/// The error to be expected of captures at these poses (`base_from_flange`); `None` where they do
/// not determine the answer. Poses that do not show the whole target add nothing.
///
/// # Errors
/// As [`choose`], but for too few poses.
pub fn predict(
    setting: &Setting,
    poses: &[Pose<Base, Flange>],
) -> Result<Option<PredictedTre>, Error> {
    setting.check()?;
    finite(poses)?;
    let seen = poses.iter().filter(|p| setting.information(p).is_some()).count();
    Ok(setting.expected(&setting.sum(poses), seen))
}

fn finite(poses: &[Pose<Base, Flange>]) -> Result<(), Error> {
    match poses.iter().position(|p| !p.is_finite()) {
        Some(k) => Err(Error::NotFinite { what: format!("pose {} of the robot", k + 1) }),
        None => Ok(()),
    }
}

fn alike(a: &Pose<Base, Flange>, b: &Pose<Base, Flange>) -> bool {
    Residual::between(a, b).is_within(ALIKE)
}

/// Mean of `JᵀJ` over the volume.
fn moment(volume: &Volume) -> Matrix6<f64> {
    let one = |p: &Vector3<f64>| {
        let j = point_jacobian(p);
        j.transpose() * j
    };
    volume.points.iter().map(one).sum::<Matrix6<f64>>() / volume.points.len() as f64
}

fn log_determinant(h: &Matrix12) -> f64 {
    let root = h.cholesky();
    root.map_or(f64::NEG_INFINITY, |c| c.l_dirty().diagonal().iter().map(|d| d.ln()).sum())
}

/// Mean square error (m²) over the volume.
fn error(h: &Matrix12, moment: &Matrix6<f64>) -> f64 {
    of_mount(h).map_or(f64::INFINITY, |s| (s * moment).trace())
}

/// Covariance of `X`.
fn of_mount(h: &Matrix12) -> Option<Matrix6<f64>> {
    linalg::invert_spd(h).map(|c| c.fixed_view::<6, 6>(0, 0).into_owned())
}

pub use planner::{ENOUGH, FEWEST_ENOUGH, NextView, Planner, Route, Stop, USUAL_CANDIDATES};
pub use reach::{ArmReach, NearReach, Reach, Station, USUALLY_NEAR, Unreached};
pub use solids::{Capsule, Cuboid};
pub use touches::{PlannedTouch, TouchNoise, spread_corners};

#[cfg(test)]
mod tests;
