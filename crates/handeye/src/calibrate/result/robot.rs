//! What a result says of the robot, beside noise: an arm that deviates, errors by place.

use serde::{Deserialize, Serialize};

use crate::{
    Anchor, Camera, Mount, Pose, Target,
    estimate::compensation::Compensation,
    model::kinematics::{Arm, Parameter},
};

/// What was wrong with the arm, where joint values and its model were given and the data show it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ArmResult {
    /// The arm as it is.
    pub model: Arm,
    /// What differs from the model that was given.
    pub deviations: Vec<ArmDeviation>,
    /// Where the camera sits, for a robot that computes with the corrected model.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// Where the target sits, likewise.
    pub anchor_from_target: Pose<Anchor, Target>,
    /// The tool's tip minus what the robot believes, in the flange, mm; null without touches.
    pub tip_offset_mm: Option<[f64; 3]>,
    /// Residual of captures left out.
    pub held_out: ArmHeldOut,
    /// Standard deviation of the robot's position with the model that was given, mm per axis.
    pub robot_before_mm: f64,
    /// The same with the corrected one.
    pub robot_after_mm: f64,
    /// Predicted error (root mean square) of a robot that computes with the corrected model.
    pub predicted_tre_mm: Option<f64>,
}

/// One parameter of the arm that differs from its model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ArmDeviation {
    /// Number of the joint; the first one is 1.
    pub joint: usize,
    /// Which parameter.
    pub parameter: Parameter,
    /// Found minus given: degrees for angles, mm for lengths.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Whether the data told it, or it is about what was believed beforehand.
    pub observed: bool,
}

/// RMS residual of captures left out, mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ArmHeldOut {
    /// With the model that was given.
    pub before_mm: Option<f64>,
    /// With the corrected one.
    pub after_mm: Option<f64>,
}

/// What correcting the robot's poses by place is worth: captures are left out in blocks, those near one another, and
/// those that follow one another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CompensationResult {
    /// Blocks of captures that lie near one another.
    pub by_place: BlockGain,
    /// Blocks of captures that follow one another.
    pub by_time: BlockGain,
    /// What corrects poses; null where it would not take away a tenth of what is missed.
    pub model: Option<Compensation>,
}

impl CompensationResult {
    /// That of both which gains less.
    pub fn worse(&self) -> BlockGain {
        let gain = |g: &BlockGain| g.corrected_mm / g.rigid_mm;
        if gain(&self.by_place) > gain(&self.by_time) { self.by_place } else { self.by_time }
    }
}

/// What captures miss that are left out, mm: root mean square over the points of the target.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BlockGain {
    /// By the rigid answer.
    pub rigid_mm: f64,
    /// With poses corrected.
    pub corrected_mm: f64,
}

/// Errors of the robot, beside noise, that an answer is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotErrorKind {
    /// The arm deviates from its model.
    OfArm,
    /// They belong to the place where the robot is.
    ByPlace,
}

impl RobotErrorKind {
    pub(super) const ALL: [Self; 2] = [Self::OfArm, Self::ByPlace];

    /// Name of the candidate that is made for them.
    pub fn candidate(self) -> &'static str {
        match self {
            Self::OfArm => "joint-with-arm",
            Self::ByPlace => "joint-by-place",
        }
    }
}
