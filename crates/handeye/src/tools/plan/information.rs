//! Information of a capture on the poses of camera and target, before it is taken.

use nalgebra::{Matrix6, RowVector6, SMatrix, Vector3};

use super::{Setting, of_mount};
use crate::{
    Base, Camera, Error, Flange, HandEye, Pose, PosePair, Target,
    estimate::{
        NoiseModel, Sigma, Source, observability,
        predict::{self, PredictedTre},
        touch_pairs::small_sample,
    },
    math::linalg::{self, FREE_SIGMA},
    register::rigid_fit::point_jacobian,
    solve::{
        View,
        least_squares::{Matrix12, residual_with_jacobian},
    },
};

/// Cosine of the angle between the line of sight and the target's normal below which corners are
/// not found: 70 degrees.
const STEEPEST: f64 = 0.34;

impl Setting {
    pub(super) fn check(&self) -> Result<(), Error> {
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
    pub(super) fn sum(&self, poses: &[Pose<Base, Flange>]) -> Matrix12 {
        let nothing = Matrix12::identity() * FREE_SIGMA.powi(-2);
        poses.iter().filter_map(|p| self.information(p)).fold(nothing, |sum, h| sum + h)
    }

    /// How the target looks from a pose.
    pub(super) fn pair(&self, base_from_flange: &Pose<Base, Flange>) -> PosePair {
        let anchor_from_mount = self.setup.anchor_from_mount(*base_from_flange);
        let camera_from_target = self.hand_eye.camera_from_target(self.setup, base_from_flange);
        PosePair { anchor_from_mount, camera_from_target }
    }

    /// Information of a capture on `(X, Y)`; `None` where the camera does not see the whole target.
    pub(super) fn information(&self, base_from_flange: &Pose<Base, Flange>) -> Option<Matrix12> {
        let pair = self.pair(base_from_flange);
        let covariance = linalg::invert_spd(&self.of_picture(&pair.camera_from_target)?);
        let view = View { covariance: Some(covariance?), ..View::bare(pair) };
        let v = self.model().covariance(&view, &self.hand_eye, self.setup);
        let (_, j) = residual_with_jacobian(&self.hand_eye, &pair);
        Some(j.transpose() * linalg::invert_spd(&v)? * j)
    }

    /// Information of all corners on the target's pose.
    pub(super) fn of_picture(
        &self,
        camera_from_target: &Pose<Camera, Target>,
    ) -> Option<Matrix6<f64>> {
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

    pub(super) fn model(&self) -> NoiseModel {
        let known = |source, sigma| Sigma { source, sigma, uncertainty: None };
        let sigmas = vec![
            known(Source::RobotRotation, self.noise.robot_rotation_rad),
            known(Source::RobotPosition, self.noise.robot_position_m),
            known(Source::Picture, 1.0),
        ];
        NoiseModel { sigmas }
    }

    /// The error that a calibration of so many captures would state.
    pub(super) fn expected(&self, sum: &Matrix12, captures: usize) -> Option<PredictedTre> {
        let s = of_mount(sum)?;
        let free = observability::free_of(&s, &self.hand_eye.mount_from_camera.rotation());
        let factor = small_sample(6.0 * captures as f64 - 12.0);
        free.is_empty().then(|| predict::tre(&self.volume, &(s * factor), |_| Vector3::zeros()))
    }

    pub(super) fn undetermined(&self, sum: &Matrix12, poses: &[Pose<Base, Flange>]) -> Vec<String> {
        let pairs: Vec<PosePair> = poses.iter().map(|p| self.pair(p)).collect();
        let s = of_mount(sum).unwrap_or_else(|| Matrix6::identity() * FREE_SIGMA.powi(2));
        let free = observability::free_of(&s, &self.hand_eye.mount_from_camera.rotation());
        observability::in_words(&free, &pairs, self.setup)
    }
}
