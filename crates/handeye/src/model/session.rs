//! Everything that was measured in one cell, and what is known beforehand.

use std::cmp::Ordering;

use nalgebra::Vector3;

use super::{kinematics::Arm, names::natural};
use crate::{
    Base, Camera, Correspondence, Flange, Intrinsics, Mount, Observation, Placement, Point, Pose,
    Setup, Target, Touch, Workspace, model::target::kinds::TargetModel,
};

/// Everything that was measured in one cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// Who carries the camera.
    pub setup: Setup,
    /// What the camera looked at; `None` for bare poses or points.
    pub target: Option<TargetModel>,
    /// How well the target's size is known.
    pub target_size: TargetSize,
    /// The camera, where images were used.
    pub camera: Option<Intrinsics>,
    /// How well the camera's lens is known, where that was stated.
    pub lens_sigma: Option<LensSigma>,
    /// Whether the camera was calibrated from the images of this session.
    pub camera_from_views: bool,
    /// Captures, in any order.
    pub observations: Vec<Observation>,
    /// Boards lying in the cell (eye-to-hand).
    pub placements: Vec<Placement>,
    /// Touched corners.
    pub touches: Vec<Touch>,
    /// Points known to camera and robot, where that is all there is.
    pub correspondences: Vec<Correspondence>,
    /// Where the answer will be used, in the base (eye-to-hand) or the camera (eye-in-hand).
    pub workspace: Option<Workspace>,
    /// What is known of the camera's place on the mount.
    pub known_position: Option<KnownPosition>,
    /// The arm as its maker describes it, where that is known.
    pub arm: Option<Arm>,
    /// Whether distances to the target are known only up to a common scale, which is then estimated: for bare target
    /// poses.
    pub unknown_scale: bool,
    /// Whether the captures were taken one after the other, in the order of their times or names, so that errors may
    /// drift: looked for in bare target poses.
    pub in_sequence: bool,
    /// What the robot recorded, where it did not stop for the captures: `base_from_flange` of the captures is then
    /// ignored, and the robot's pose is interpolated at their `time_s`.
    pub motion: Option<Motion>,
}

/// A value and its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stamped<P> {
    /// By the clock of whoever measured it, s.
    pub time_s: f64,
    /// The value.
    pub pose: P,
}

/// What a robot in motion recorded, by its own clock.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Where its flange was.
    pub robot: Vec<Stamped<Pose<Base, Flange>>>,
    /// Its joint values (rad, m); empty where they are not known.
    pub joints: Vec<Stamped<Vec<f64>>>,
}

/// Robot and camera poses, each by its own clock, in any order.
#[derive(Debug, Clone, PartialEq)]
pub struct Streams {
    /// Who carries the camera.
    pub setup: Setup,
    /// What the robot reported.
    pub robot: Vec<Stamped<Pose<Base, Flange>>>,
    /// Where the camera saw the target.
    pub camera: Vec<Stamped<Pose<Camera, Target>>>,
    /// Whether distances to the target are known only up to a common scale.
    pub unknown_scale: bool,
}

impl Streams {
    /// The session of which these are the measurements: a capture for each pose of the target, named by its time.
    pub fn session(&self) -> Session {
        let capture = |s: &Stamped<Pose<Camera, Target>>| Observation {
            time_s: Some(s.time_s),
            ..Observation::bare(format!("{:.6} s", s.time_s), Pose::identity(), s.pose)
        };
        Session {
            unknown_scale: self.unknown_scale,
            in_sequence: true,
            motion: Some(Motion { robot: self.robot.clone(), joints: vec![] }),
            ..Session::of_captures(self.setup, self.camera.iter().map(capture).collect())
        }
    }
}

/// How well the size of a target is known beforehand.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum TargetSize {
    /// As declared, unless the printer scaled it or nobody measured it: the data may say otherwise.
    #[default]
    Printed,
    /// It was measured, with this standard deviation relative to the size (0.01 is 1 %): data that say otherwise are wrong.
    Measured(f64),
}

/// Standard deviations of a given lens, as its calibration states them: data that say otherwise are wrong.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LensSigma {
    /// Of the focal length, px.
    pub focal_px: Option<f64>,
    /// Of the principal point, px per axis.
    pub center_px: Option<f64>,
}

impl Session {
    /// What the poses of the target were read from, in a word for people.
    pub(crate) fn read_from(&self) -> &'static str {
        if self.target.is_some() { "image" } else { "target pose" }
    }

    /// Captures alone: no target model, camera, touches, or anything else that was measured.
    pub fn of_captures(setup: Setup, observations: Vec<Observation>) -> Self {
        Self {
            setup,
            target: None,
            target_size: TargetSize::default(),
            camera: None,
            lens_sigma: None,
            camera_from_views: false,
            observations,
            placements: vec![],
            touches: vec![],
            correspondences: vec![],
            workspace: None,
            known_position: None,
            arm: None,
            unknown_scale: false,
            in_sequence: false,
            motion: None,
        }
    }

    /// Captures and touches in the order of their names, whatever order they came in.
    pub(crate) fn in_order(&self) -> Self {
        let mut session = self.clone();
        let timed = session.in_sequence && session.observations.iter().all(|o| o.time_s.is_some());
        let time = |o: &Observation| o.time_s.filter(|_| timed).unwrap_or(0.0);
        session.observations.sort_by(|a, b| {
            time(a).total_cmp(&time(b)).then_with(|| natural(&a.capture, &b.capture))
        });
        session.placements.sort_by(|a, b| natural(&a.id, &b.id));
        session.touches.sort_by(|a, b| {
            natural(&a.placement, &b.placement)
                .then(a.corner.cmp(&b.corner))
                .then_with(|| by_axes(&a.in_base, &b.in_base))
        });
        session.correspondences.sort_by(|a, b| by_axes(&a.in_camera, &b.in_camera));
        session
    }

    /// The same with captures in the order of their times, those without one last.
    pub(crate) fn in_order_of_time(&self) -> Self {
        let mut session = self.in_order();
        let time = |o: &Observation| o.time_s.unwrap_or(f64::INFINITY);
        session.observations.sort_by(|a, b| time(a).total_cmp(&time(b)));
        session
    }
}

/// The order of two points by x, then y, then z.
fn by_axes<F>(a: &Point<F>, b: &Point<F>) -> Ordering {
    let both = [a, b].map(Point::vector);
    (0..3).fold(Ordering::Equal, |order, k| order.then(both[0][k].total_cmp(&both[1][k])))
}

/// The camera's position along one direction, as measured by other means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownPosition {
    /// The direction, in the mount; of unit length.
    pub axis: Vector3<f64>,
    /// The position along it (m).
    pub value_m: f64,
    /// Its standard deviation (m).
    pub sigma_m: f64,
}

impl KnownPosition {
    /// Residual of an answer in standard deviations.
    pub(crate) fn residual(&self, x: &Pose<Mount, Camera>) -> f64 {
        (self.axis.dot(&x.translation()) - self.value_m) / self.sigma_m
    }
}
