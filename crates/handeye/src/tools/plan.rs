//! Where to take the captures: of the poses that the robot can reach, the few that tell most.
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

use nalgebra::{Matrix6, RowVector6, SMatrix, Vector3};

use crate::{
    Base, Camera, Error, Flange, HandEye, Intrinsics, Pose, PosePair, Setup, Target, TargetModel,
    estimate::{
        NoiseModel, Sigma, Source, observability,
        predict::{self, PredictedTre, Volume},
        touch_pairs::small_sample,
    },
    math::linalg::{self, FREE_SIGMA},
    model::residual::Residual,
    register::rigid_fit::point_jacobian,
    solve::{
        View,
        least_squares::{Matrix12, residual_with_jacobian},
    },
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
    /// What all of them still leave free, in words.
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
/// Cosine of the angle between the line of sight and the target's normal below which corners are
/// not found: 70 degrees.
const STEEPEST: f64 = 0.34;

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

impl Setting {
    fn check(&self) -> Result<(), Error> {
        self.target.check()?;
        self.camera.check()?;
        let HandEye { mount_from_camera: x, anchor_from_target: y } = &self.hand_eye;
        if !(x.is_finite() && y.is_finite()) {
            return Err(Error::NotFinite { what: "the place of camera or target".into() });
        }
        let n = &self.noise;
        let sound = |s: f64, least: f64| s.is_finite() && s >= least;
        if !(sound(n.robot_rotation_rad, 0.0) && sound(n.robot_position_m, 0.0)) {
            return Err(Error::Invalid("the robot's noise must be zero or more".into()));
        }
        if !sound(n.corner_px, f64::MIN_POSITIVE)
            || n.depth_at_1m.is_some_and(|s| !sound(s, f64::MIN_POSITIVE))
        {
            return Err(Error::Invalid("the noise of corners and depth must be positive".into()));
        }
        let points = &self.volume.points;
        if points.is_empty() || points.iter().any(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(Error::Invalid("the volume must have points, all of them finite".into()));
        }
        Ok(())
    }

    /// Information of several captures, and of next to nothing.
    fn sum(&self, poses: &[Pose<Base, Flange>]) -> Matrix12 {
        let nothing = Matrix12::identity() * FREE_SIGMA.powi(-2);
        poses.iter().filter_map(|p| self.information(p)).fold(nothing, |sum, h| sum + h)
    }

    /// How the target looks from a pose.
    fn pair(&self, base_from_flange: &Pose<Base, Flange>) -> PosePair {
        let anchor_from_mount = self.setup.anchor_from_mount(*base_from_flange);
        let HandEye { mount_from_camera, anchor_from_target } = self.hand_eye;
        let anchor_from_camera = anchor_from_mount * mount_from_camera;
        let camera_from_target = anchor_from_camera.inverse() * anchor_from_target;
        PosePair { anchor_from_mount, camera_from_target }
    }

    /// Information of a capture on `(X, Y)`; `None` where the camera does not see the whole target.
    fn information(&self, base_from_flange: &Pose<Base, Flange>) -> Option<Matrix12> {
        let pair = self.pair(base_from_flange);
        let covariance = linalg::invert_spd(&self.of_picture(&pair.camera_from_target)?);
        let view = View { covariance: Some(covariance?), ..View::bare(pair) };
        let v = self.model().covariance(&view, &self.hand_eye, self.setup);
        let (_, j) = residual_with_jacobian(&self.hand_eye, &pair);
        Some(j.transpose() * linalg::invert_spd(&v)? * j)
    }

    /// Information of all corners on the target's pose.
    fn of_picture(&self, camera_from_target: &Pose<Camera, Target>) -> Option<Matrix6<f64>> {
        let rotation = camera_from_target.rotation();
        let size = (f64::from(self.camera.width), f64::from(self.camera.height));
        let mut sum = Matrix6::zeros();
        for corner in self.target.corners() {
            let p = (*camera_from_target * corner).vector();
            let (pixel, by_point) = self.camera.project_with_jacobian(&p)?;
            let inside = pixel.x > 0.0 && pixel.y > 0.0 && pixel.x < size.0 && pixel.y < size.1;
            if !inside || !(rotation.column(2).dot(&p) > STEEPEST * p.norm()) {
                return None;
            }
            let by_pose: SMatrix<f64, 3, 6> = rotation * point_jacobian(&corner.vector());
            let j = by_point * by_pose / self.noise.corner_px;
            sum += j.transpose() * j;
            if let Some(sigma) = self.noise.depth_at_1m {
                let j: RowVector6<f64> = by_pose.row(2) / (sigma * p.z * p.z);
                sum += j.transpose() * j;
            }
        }
        Some(sum)
    }

    fn model(&self) -> NoiseModel {
        let known = |source, sigma| Sigma { source, sigma, uncertainty: None };
        let sigmas = vec![
            known(Source::RobotRotation, self.noise.robot_rotation_rad),
            known(Source::RobotPosition, self.noise.robot_position_m),
            known(Source::Picture, 1.0),
        ];
        NoiseModel { sigmas }
    }

    /// The error that a calibration of so many captures would state.
    fn expected(&self, sum: &Matrix12, captures: usize) -> Option<PredictedTre> {
        let s = of_mount(sum)?;
        let free = observability::free_of(&s, &self.hand_eye.mount_from_camera.rotation());
        let factor = small_sample(6.0 * captures as f64 - 12.0);
        free.is_empty().then(|| predict::tre(&self.volume, &(s * factor), |_| Vector3::zeros()))
    }

    fn undetermined(&self, sum: &Matrix12, poses: &[Pose<Base, Flange>]) -> Vec<String> {
        let pairs: Vec<PosePair> = poses.iter().map(|p| self.pair(p)).collect();
        let s = of_mount(sum).unwrap_or_else(|| Matrix6::identity() * FREE_SIGMA.powi(2));
        let free = observability::free_of(&s, &self.hand_eye.mount_from_camera.rotation());
        observability::in_words(&free, &pairs, self.setup)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector6};

    use super::*;
    use crate::{Point, simulate::Cell};

    /// A cell, and poses from where the camera sees the target.
    fn cell(setup: Setup, count: usize) -> (Setting, Vec<Pose<Base, Flange>>) {
        let cell = Cell { captures: count, ..Cell::new(setup, 3) };
        let (near, far) = if setup == Setup::EyeInHand { (0.45, 0.75) } else { (0.95, 1.15) };
        let (low, high) = (Vector3::new(-0.2, -0.15, near), Vector3::new(0.2, 0.15, far));
        let setting = Setting {
            setup,
            target: cell.target.clone(),
            camera: cell.intrinsics,
            hand_eye: cell.hand_eye,
            noise: ExpectedNoise { depth_at_1m: Some(0.3e-3), ..ExpectedNoise::default() },
            volume: Volume::of_box(&low, &high, "box"),
        };
        (setting, cell.record(1).unwrap().truth.base_from_flange)
    }

    fn indices(plan: &Plan) -> Vec<usize> {
        plan.choices.iter().map(|c| c.candidate).collect()
    }

    #[test]
    fn every_capture_lowers_the_error_and_the_last_figure_is_that_of_all() {
        for setup in [Setup::EyeInHand, Setup::EyeToHand] {
            let (setting, reachable) = cell(setup, 40);
            let plan = choose(&setting, &[], &reachable, 12).unwrap();
            assert!(plan.undetermined.is_empty());
            let mm: Vec<Option<f64>> =
                plan.choices.iter().map(|c| c.predicted_tre.as_ref().map(|t| t.rms)).collect();
            let known: Vec<f64> = mm.iter().flatten().copied().collect();
            assert!(known.len() >= 8 && mm[0].is_none(), "{mm:?}");
            assert!(known.windows(2).all(|w| w[1] < w[0]), "{mm:?}");
            let chosen: Vec<_> = indices(&plan).into_iter().map(|k| reachable[k]).collect();
            let again = predict(&setting, &chosen).unwrap().unwrap();
            assert!((again.rms - known[known.len() - 1]).abs() < 1e-9);
        }
    }

    #[test]
    fn what_is_taken_already_counts_and_is_not_taken_again() {
        let (setting, reachable) = cell(Setup::EyeInHand, 40);
        let whole = choose(&setting, &[], &reachable, 10).unwrap();
        let first: Vec<_> = indices(&whole)[..4].iter().map(|&k| reachable[k]).collect();
        let rest = choose(&setting, &first, &reachable, 6).unwrap();
        assert_eq!(indices(&rest), indices(&whole)[4..]);
        assert_eq!(rest.choices[5].predicted_tre, whole.choices[9].predicted_tre);
        let twice = [reachable.as_slice(), &reachable].concat();
        assert_eq!(indices(&choose(&setting, &[], &twice, 10).unwrap()), indices(&whole));
    }

    #[test]
    fn poses_that_do_not_show_the_target_are_passed_over() {
        let (setting, mut reachable) = cell(Setup::EyeInHand, 12);
        let away = Rotation3::new(Vector3::x() * 1.5);
        let turned = Vector6::new(away.scaled_axis().x, 0.0, 0.0, 0.0, 0.0, 0.0);
        for pose in &mut reachable[..6] {
            *pose = pose.retract(&turned);
        }
        let plan = choose(&setting, &[], &reachable, 6).unwrap();
        assert!(indices(&plan).iter().all(|k| *k >= 6));
        let refused = choose(&setting, &[], &reachable, 7).unwrap_err();
        assert!(matches!(refused, Error::TooFewPoses { found: 6, needed: 7, .. }), "{refused}");
    }

    #[test]
    fn a_robot_of_one_axis_is_told_what_stays_free_and_gets_no_figure() {
        let (setting, _) = cell(Setup::EyeInHand, 1);
        let down = Rotation3::new(Vector3::x() * std::f64::consts::PI);
        let at = setting.hand_eye.anchor_from_target * Point::new(0.12, 0.075, 0.0);
        let over = |k: usize| {
            let turn = Rotation3::new(Vector3::z() * (0.4 * k as f64 - 1.2));
            let shift = Vector3::new(0.02 * k as f64 - 0.06, 0.01 * k as f64 - 0.03, 0.7);
            let flange = at.vector() + shift;
            Pose::from_parts((down * turn).matrix(), flange)
        };
        let reachable: Vec<Pose<Base, Flange>> = (0..7).map(over).collect();
        let plan = choose(&setting, &[], &reachable, 5).unwrap();
        assert!(plan.choices.iter().all(|c| c.predicted_tre.is_none()));
        assert_eq!(plan.undetermined, ["translation along the rotation axis z of flange"]);
        assert_eq!(predict(&setting, &reachable).unwrap(), None);
    }

    #[test]
    fn no_capture_is_no_plan_and_no_error() {
        let (setting, reachable) = cell(Setup::EyeToHand, 3);
        let plan = choose(&setting, &[], &reachable, 0).unwrap();
        assert!(plan.choices.is_empty() && plan.undetermined.len() == 2, "{plan:?}");
        assert_eq!(predict(&setting, &[]).unwrap(), None);
    }

    #[test]
    fn bad_settings_and_poses_are_refused_in_words() {
        let (good, reachable) = cell(Setup::EyeInHand, 8);
        let refused = |setting: &Setting| choose(setting, &[], &reachable, 3).unwrap_err();
        let noise = |change: &dyn Fn(&mut ExpectedNoise)| {
            let mut setting = good.clone();
            change(&mut setting.noise);
            refused(&setting).to_string()
        };
        assert!(noise(&|n| n.robot_position_m = -1e-3).contains("robot's noise"));
        assert!(noise(&|n| n.robot_rotation_rad = f64::NAN).contains("robot's noise"));
        assert!(noise(&|n| n.corner_px = 0.0).contains("must be positive"));
        assert!(noise(&|n| n.depth_at_1m = Some(f64::INFINITY)).contains("must be positive"));
        let mut empty = good.clone();
        empty.volume.points.clear();
        assert!(refused(&empty).to_string().contains("volume"));
        let mut astray = good.clone();
        astray.hand_eye.mount_from_camera =
            Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::repeat(f64::NAN));
        assert!(matches!(refused(&astray), Error::NotFinite { .. }));
        let nowhere =
            Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::repeat(f64::INFINITY));
        let poses = [reachable.as_slice(), &[nowhere]].concat();
        let message = choose(&good, &[], &poses, 3).unwrap_err().to_string();
        assert_eq!(message, "pose 9 of the robot is not finite");
        assert!(choose(&good, &[nowhere], &reachable, 3).is_err());
        assert!(predict(&good, &poses).is_err());
    }
}
