//! What was measured: by the robot, by the camera, by touch.

use nalgebra::{Matrix2, Matrix3, Matrix6, Vector2, Vector3, Vector6};
use serde::{Deserialize, Serialize};

use super::residual::Residual;
use crate::{Anchor, Base, Camera, Flange, Mount, Point, Pose, Target};

/// The two ways to hold a camera. Everything behind `anchor_from_mount` sees only one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Setup {
    /// Camera on the flange, target fixed to the base.
    EyeInHand,
    /// Camera fixed to the base, target on the flange.
    EyeToHand,
}

impl Setup {
    /// The robot pose as the solvers take it, the same for both setups.
    pub fn anchor_from_mount(self, base_from_flange: Pose<Base, Flange>) -> Pose<Anchor, Mount> {
        match self {
            Setup::EyeInHand => base_from_flange.rename(), // anchor = base, mount = flange
            Setup::EyeToHand => base_from_flange.inverse().rename(), // anchor = flange, mount = base
        }
    }

    /// As files call it: `eye-in-hand` or `eye-to-hand`.
    pub fn name(self) -> &'static str {
        match self {
            Setup::EyeInHand => "eye-in-hand",
            Setup::EyeToHand => "eye-to-hand",
        }
    }

    /// The setup of that name.
    pub fn from_name(name: &str) -> Option<Setup> {
        [Setup::EyeInHand, Setup::EyeToHand].into_iter().find(|setup| setup.name() == name)
    }

    /// The user's name of the mount: `flange` or `base`.
    pub fn mount(self) -> &'static str {
        match self {
            Setup::EyeInHand => "flange",
            Setup::EyeToHand => "base",
        }
    }

    /// The user's name of the anchor: `base` or `flange`.
    pub fn anchor(self) -> &'static str {
        match self {
            Setup::EyeInHand => "base",
            Setup::EyeToHand => "flange",
        }
    }
}

/// A corner of the target in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageCorner {
    /// Which corner of the target.
    pub id: u32,
    /// Where, in pixels; the centre of the first pixel is (0, 0).
    pub pixel: Vector2<f64>,
    /// Covariance, px².
    pub covariance: Matrix2<f64>,
}

/// A corner of the target as a 3D camera measures it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceCorner {
    /// Which corner of the target.
    pub id: u32,
    /// Where, in the camera frame.
    pub in_camera: Point<Camera>,
    /// Covariance, m².
    pub covariance: Matrix3<f64>,
}

/// The target's pose in one capture, with its covariance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetPose {
    /// Where the target is.
    pub camera_from_target: Pose<Camera, Target>,
    /// 6 x 6, rotation (rad) first, perturbed on the right (in the Target frame). `None` where
    /// it is not known.
    pub covariance: Option<Matrix6<f64>>,
}

/// One robot pose and what the camera saw of the target from there.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Name of the capture.
    pub capture: String,
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// Values of its joints there (rad, m), from the base outwards; empty where none were recorded.
    pub joints: Vec<f64>,
    /// When it was taken, by the camera's clock, s; `None` where that was not recorded.
    pub time_s: Option<f64>,
    /// Twist of the mount relative to the anchor, in the mount frame (rad/s, then m/s), where the robot did not stop.
    /// Where a capture has one, the offset of the two clocks is estimated, with a prior mean of zero.
    pub velocity: Option<Vector6<f64>>,
    /// Corners in the image; empty when only the pose is known.
    pub corners: Vec<ImageCorner>,
    /// Corners in the scan; empty without a scan.
    pub surface: Vec<SurfaceCorner>,
    /// The target's possible poses, best first: relabelings of a symmetric board and the two
    /// solutions of a planar one are all here until the robot poses decide between them.
    pub candidates: Vec<TargetPose>,
}

impl Observation {
    /// A capture of which only both poses are given: no corners, and no covariance.
    pub fn bare(
        capture: String,
        base_from_flange: Pose<Base, Flange>,
        camera_from_target: Pose<Camera, Target>,
    ) -> Self {
        Self {
            capture,
            base_from_flange,
            joints: vec![],
            time_s: None,
            velocity: None,
            corners: vec![],
            surface: vec![],
            candidates: vec![TargetPose { camera_from_target, covariance: None }],
        }
    }
}

/// A board lying in the cell, seen once by the camera and then touched (eye-to-hand). With eye-in-hand the views'
/// own board is touched, and there are no placements.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// Its name.
    pub id: String,
    /// Corners in its image.
    pub corners: Vec<ImageCorner>,
    /// Corners in its scan.
    pub surface: Vec<SurfaceCorner>,
    /// The target's possible poses in its image, as in [`Observation::candidates`].
    pub candidates: Vec<TargetPose>,
    /// Why its image shows no target, where it does not.
    pub not_seen: Option<String>,
}

/// The tool tip on a corner of the target.
#[derive(Debug, Clone, PartialEq)]
pub struct Touch {
    /// Name of the placement that was touched (eye-to-hand).
    pub placement: String,
    /// Which corner of the target.
    pub corner: u32,
    /// Position of the tip as the robot computes it, m.
    pub in_base: Point<Base>,
    /// Where the flange was, if it was recorded.
    pub base_from_flange: Option<Pose<Base, Flange>>,
    /// Values of the joints there, as in [`Observation::joints`].
    pub joints: Vec<f64>,
}

/// One physical point, measured by the camera and known to the robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correspondence {
    /// As the camera measures it.
    pub in_camera: Point<Camera>,
    /// As the robot knows it: in the base (eye-to-hand) or the flange (eye-in-hand).
    pub in_mount: Point<Mount>,
}

/// One capture in the form that the solvers take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PosePair {
    /// Where the robot was.
    pub anchor_from_mount: Pose<Anchor, Mount>,
    /// Where the camera saw the target.
    pub camera_from_target: Pose<Camera, Target>,
}

impl PosePair {
    /// The pair with the camera's distances times `factor`.
    pub fn farther(&self, factor: f64) -> Self {
        Self { camera_from_target: self.camera_from_target.farther(factor), ..*self }
    }
}

/// What a hand-eye calibration finds: the X and Y of `A X = Y B`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HandEye {
    /// The answer: where the camera sits.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// Where the target sits.
    pub anchor_from_target: Pose<Anchor, Target>,
}

impl HandEye {
    /// The same two poses, both frames of the target moved: `target_from_new`.
    pub(crate) fn retarget(&self, target_from_new: Pose<Target, Target>) -> Self {
        Self { anchor_from_target: self.anchor_from_target * target_from_new, ..*self }
    }

    /// `B = X⁻¹ A⁻¹ Y`: where the camera sees the target while the flange is there.
    pub fn camera_from_target(
        &self,
        setup: Setup,
        base_from_flange: &Pose<Base, Flange>,
    ) -> Pose<Camera, Target> {
        let anchor_from_camera =
            setup.anchor_from_mount(*base_from_flange) * self.mount_from_camera;
        anchor_from_camera.inverse() * self.anchor_from_target
    }

    /// `A = Y B X⁻¹`: where the flange is while the camera sees the target there.
    pub fn base_from_flange(
        &self,
        setup: Setup,
        camera_from_target: &Pose<Camera, Target>,
    ) -> Pose<Base, Flange> {
        let anchor_from_camera = self.anchor_from_target * camera_from_target.inverse();
        let anchor_from_mount = anchor_from_camera * self.mount_from_camera.inverse();
        // the setups' map is its own inverse
        setup.anchor_from_mount(anchor_from_mount.rename()).rename()
    }

    /// `Y⁻¹ A X B⁻¹`: the loop that is the identity for exact data, in the Target frame.
    pub fn loop_error(&self, pair: &PosePair) -> Pose<Target, Target> {
        self.anchor_from_target.inverse()
            * pair.anchor_from_mount
            * self.mount_from_camera
            * pair.camera_from_target
    }

    /// By how much a capture's loop fails to close, at the target's origin.
    pub fn loop_residual(&self, pair: &PosePair) -> Residual {
        let e = self.loop_error(pair);
        Residual { angle: e.iso().rotation.angle(), distance: e.translation().norm() }
    }
}

/// The box in which the robot will work, by two opposite corners.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Workspace {
    /// One corner, m; in the base (eye-to-hand) or the camera (eye-in-hand).
    pub minimum: Vector3<f64>,
    /// The opposite corner, m.
    pub maximum: Vector3<f64>,
}

impl PosePair {
    /// `R_A`.
    pub(crate) fn r_a(&self) -> Matrix3<f64> {
        self.anchor_from_mount.rotation()
    }
    /// `t_A`, m.
    pub(crate) fn t_a(&self) -> Vector3<f64> {
        self.anchor_from_mount.translation()
    }
    /// `R_B` of `B = target_from_camera`.
    pub(crate) fn r_b(&self) -> Matrix3<f64> {
        self.camera_from_target.rotation().transpose()
    }
    /// `t_B` of `B = target_from_camera`, m.
    pub(crate) fn t_b(&self) -> Vector3<f64> {
        self.camera_from_target.inverse().translation()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector6;

    #[test]
    fn the_setups_are_inverses_of_each_other() {
        let robot = Pose::identity().retract(&Vector6::new(0.1, 0.2, 0.3, 1.0, 2.0, 3.0));
        let in_hand = Setup::EyeInHand.anchor_from_mount(robot);
        let to_hand = Setup::EyeToHand.anchor_from_mount(robot);
        assert!((in_hand.iso() * to_hand.iso()).translation.vector.norm() < 1e-12);
    }
}
