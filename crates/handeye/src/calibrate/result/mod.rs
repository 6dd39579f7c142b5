//! The result of a calibration: everything that files and reports show.

pub mod beside;
mod causes;
pub mod certificate;
pub mod findings;
mod origin;
mod robot;
mod scans;

use std::collections::BTreeMap;

use nalgebra::{Matrix6, Vector3};
use serde::{Deserialize, Serialize};

use crate::{
    Anchor, Base, Camera, Flange, HandEye, Intrinsics, Mount, Pose, Setup, Target, Verdict,
    Warning,
    estimate::{
        Source,
        certify::Certificate,
        compensation::Compensation,
        evaluate::{Diversity, RmsResidual},
        predict::PredictedTre,
    },
    findings::{movement::Movement, severity::Severity},
    model::residual::Residual,
};

pub use origin::{Body, BodyFrame, Equipment, FrameNames, InputFile, Origin};
pub use robot::{
    ArmDeviation, ArmHeldOut, ArmResult, BlockGain, CompensationResult, RobotErrorKind,
};
pub use scans::{
    BoardDeviation, CaptureFlatness, CaptureStep, ColourStepResult, FlatnessResult, FramesResult,
    ScanResult, SceneKind, ScenePair, SceneResult,
};

/// A 6 x 6 covariance as rows, rotation (rad) first, then translation (m), perturbed on the right.
pub type Rows = [[f64; 6]; 6];

/// Rows of a covariance.
pub fn rows(m: &Matrix6<f64>) -> Rows {
    std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]))
}

/// The matrix of such rows.
pub fn matrix(rows: &Rows) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| rows[i][j])
}

/// Covariances of both answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
pub struct PoseCovariance {
    /// Of `mount_from_camera`, in the camera frame.
    pub mount_from_camera: Option<Rows>,
    /// Of `anchor_from_target`, in the target frame.
    pub anchor_from_target: Option<Rows>,
}

/// The answer as stored: what is not determined is null.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
pub struct Answer {
    /// Where the camera sits. Mount is the flange (eye-in-hand) or the base (eye-to-hand).
    pub mount_from_camera: Option<Pose<Mount, Camera>>,
    /// Where the target sits. Anchor is the base (eye-in-hand) or the flange (eye-to-hand).
    pub anchor_from_target: Option<Pose<Anchor, Target>>,
    /// Covariance of both, 6 x 6.
    #[serde(default)]
    pub covariance: PoseCovariance,
}

impl Answer {
    /// Both poses, where both are determined.
    pub(crate) fn hand_eye(&self) -> Option<HandEye> {
        Some(HandEye {
            mount_from_camera: self.mount_from_camera?,
            anchor_from_target: self.anchor_from_target?,
        })
    }
}

/// One way to the answer, beside the others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// `closed-form-shah`, `least-squares`, `two-step-svd` ...
    pub name: String,
    /// Its answer.
    pub hand_eye: Answer,
    /// Residual on the captures it was made from.
    pub in_sample: RmsResidual,
    /// Residual on captures left out of it.
    pub held_out: RmsResidual,
    /// RMS distance of touches to its prediction, including touches it was made from; of `joint` with the tool tip that
    /// was found, of all others with the tip as the robot knows it.
    pub touch_rms_mm: Option<f64>,
    /// The error on what it has not seen: touches where there are any, captures otherwise; `None` where no touch was left
    /// out.
    pub held_out_mm: Option<f64>,
    /// Predicted error (rms) where the answer will be used.
    pub predicted_tre_mm: Option<f64>,
    /// What to know about it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// One capture in the result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaptureResult {
    /// Its name.
    pub id: String,
    /// Whether the answer rests on it.
    pub used: bool,
    /// Why not, if not.
    pub reason: Option<String>,
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// Where the camera saw the target, in the reading that was chosen.
    pub camera_from_target: Option<Pose<Camera, Target>>,
    /// Corners found in its image.
    pub corners: usize,
    /// Corners found in its scan.
    pub corners_3d: usize,
    /// RMS distance of its corners to the target model seen from its own best pose.
    pub residual_px: Option<f64>,
    /// RMS distance of its corners to where the answer and the robot pose put them.
    pub reprojection_px: Option<f64>,
    /// Residual of its loop, at the target's first corner.
    pub residual_mm: Option<f64>,
    /// Residual of its loop, rotation.
    pub residual_deg: Option<f64>,
    /// The same residual when the answer was made without it.
    pub held_out_mm: Option<f64>,
    /// The same, rotation.
    pub held_out_deg: Option<f64>,
}

/// One touch in the result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TouchResult {
    /// The placement that was touched.
    pub capture: String,
    /// Which corner.
    pub corner: u32,
    /// Distance between the tip and where the chosen answer puts the corner.
    pub residual_mm: f64,
    /// That difference in the base frame, tip minus prediction.
    pub difference_mm: Vector3<f64>,
    /// Whether the chosen answer was made with it.
    pub used: bool,
}

/// One source of error and its size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BudgetEntry {
    /// `robot`, `picture` ...
    pub source: String,
    /// Standard deviation per axis, in words with units.
    pub sigma: String,
    /// Standard deviation, mm per axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma_mm: Option<f64>,
    /// Standard deviation, degrees per axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma_deg: Option<f64>,
    /// How unsure that standard deviation is, as a part of it; `None` where it was given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma_uncertainty: Option<f64>,
    /// What it contributes to the predicted error (root mean square), mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_workpiece_mm: Option<f64>,
}

/// A change and what it would do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Advice {
    /// What to change.
    pub change: String,
    /// Predicted error (root mean square) then, mm.
    pub predicted_tre_mm: f64,
}

/// Size of the target as the robot's motions see it, over the declared one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    /// Found over declared.
    pub value: f64,
    /// Standard deviation.
    pub sigma: f64,
    /// Whether the answer rests on it, and not on the declared size.
    #[serde(default)]
    pub used: bool,
}

/// The determined part of `mount_from_camera` where the data leave directions free.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Determined {
    /// Its rotation; `None` where a rotation is free.
    pub rotation_xyzw: Option<[f64; 4]>,
    /// Its translation without the components along the free directions; `None` where a rotation is
    /// free.
    pub translation_across_m: Option<[f64; 3]>,
    /// Axes of the mount about which the camera may turn.
    pub free_rotations: Vec<[f64; 3]>,
    /// Directions of the mount along which the camera may shift.
    pub free_translations: Vec<[f64; 3]>,
}

impl Determined {
    /// What is known, for people: one line a quantity, mm.
    pub fn lines(&self) -> Vec<String> {
        let axis = |a: &[f64; 3]| format!("({:.4}, {:.4}, {:.4})", a[0], a[1], a[2]);
        let mut lines = vec![];
        if let Some([x, y, z, w]) = self.rotation_xyzw {
            lines.push(format!("quaternion {x:.7} {y:.7} {z:.7} {w:.7} (x y z w)"));
        }
        if let Some(t) = self.translation_across_m
            && self.free_translations.len() < 3
        {
            let [x, y, z] = t.map(|v| v * 1e3);
            let free: Vec<String> = self
                .free_translations
                .iter()
                .map(|a| format!(" + s {} with s unknown", axis(a)))
                .collect();
            lines.push(format!("translation ({x:.3}, {y:.3}, {z:.3}) mm{}", free.concat()));
        }
        lines.extend(
            self.free_rotations.iter().map(|a| format!("rotation about {} unknown", axis(a))),
        );
        lines
    }
}

/// The camera as the calibration found it, where it was free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CameraResult {
    /// Its parameters.
    pub intrinsics: Intrinsics,
    /// Standard deviation of `fx`, px.
    pub sigma_fx: f64,
    /// Standard deviation of `fy`, px.
    pub sigma_fy: f64,
    /// Standard deviation of `cx`, px.
    pub sigma_cx: f64,
    /// Standard deviation of `cy`, px.
    pub sigma_cy: f64,
}

/// Depth that scans read: `z_read = scale z + bias_mm`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DepthResult {
    /// Factor; one is right.
    pub scale: f64,
    /// Its standard deviation.
    pub sigma_scale: f64,
    /// Offset, mm.
    pub bias_mm: f64,
    /// Its standard deviation, mm.
    pub sigma_bias_mm: f64,
}

/// A tool's tip that is not where the robot believes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TipResult {
    /// Tip minus belief, mm.
    pub offset_mm: [f64; 3],
    /// Standard deviations, mm.
    pub sigma_mm: [f64; 3],
    /// In which frame: `flange`, or `base` where no flange pose was recorded at contact.
    pub frame: String,
}

/// A finished calibration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Version of this format.
    pub format: String,
    /// Who carries the camera.
    pub setup: Setup,
    /// Whether it can be used.
    pub verdict: Verdict,
    /// Why: one sentence a reason, most important first.
    pub reasons: Vec<String>,
    /// Name of the chosen candidate's method.
    pub method: String,
    /// The answer.
    pub hand_eye: Answer,
    /// The answer's name for the user: `base_from_camera` or `flange_from_camera`.
    pub name: String,
    /// Name of the chosen candidate.
    pub chosen: Option<String>,
    /// Why it was chosen.
    pub why: String,
    /// All candidates.
    pub candidates: Vec<Candidate>,
    /// Predicted error where the answer will be used.
    pub predicted_tre_mm: Option<PredictedTre>,
    /// Largest predicted error (95 %) with which an answer is accepted, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_error_mm: Option<f64>,
    /// Residual of the chosen answer.
    pub residual: RmsResidual,
    /// Residual of the chosen method on what was left out.
    pub held_out: RmsResidual,
    /// All captures, in the order of their names.
    pub captures: Vec<CaptureResult>,
    /// All touches.
    pub touches: Vec<TouchResult>,
    /// Names of captures that were left out.
    pub rejected: Vec<String>,
    /// Directions that the data leave free, in words.
    pub undetermined: Vec<String>,
    /// What is known of the answer where a direction is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub determined: Option<Determined>,
    /// What the poses can determine.
    pub diversity: Option<Diversity>,
    /// Where the error comes from.
    pub error_budget: Vec<BudgetEntry>,
    /// What would make the predicted error smaller, the most helpful first.
    #[serde(default)]
    pub advice: Vec<Advice>,
    /// Camera time minus robot time; zero for pairs, which are taken at the same moment, null where
    /// streams do not tell it.
    pub time_offset_s: Option<f64>,
    /// Its standard deviation, where it was estimated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_offset_sigma_s: Option<f64>,
    /// Measured over metric distances to the target: 1 where the target's size is trusted, null where the factor is
    /// unknown and the motions do not determine it.
    pub scale: Option<f64>,
    /// Its standard deviation, where it was estimated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale_sigma: Option<f64>,
    /// Size of the target as the robot sees it, for comparison.
    pub target_scale: Option<Scale>,
    /// Something that moved during the session.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub movement: Option<Movement>,
    /// The camera, where its parameters were part of the fit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraResult>,
    /// The depth of scans, where it was part of the fit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<DepthResult>,
    /// What the scans say of the board and of themselves, where there are scans.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scans: Option<ScanResult>,
    /// The tool's tip, where the data show that it is not where the robot believes it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<TipResult>,
    /// What is wrong with the arm, where that was looked for and found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arm: Option<ArmResult>,
    /// What correcting the robot's poses by place is worth, where it errs so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compensation: Option<CompensationResult>,
    /// What is proven of the least-squares fit, where that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Certificate>,
    /// What to know.
    pub warnings: Vec<Warning>,
    /// Warnings and reasons against the answer, with what each does to it.
    #[serde(default)]
    pub findings: Vec<JudgedFinding>,
    /// Name of the run, from what went in and what came out: also in the page.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run_id: Option<String>,
    /// What its frames are called in ROS and the like, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<FrameNames>,
    /// Version of the program that made it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// When it was made: UTC, as `2026-03-14T09:26:53Z`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub created: Option<String>,
    /// What the data are called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dataset: Option<String>,
    /// The files that it was made from.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<InputFile>,
    /// What stands in the cell, with serial numbers as far as they are known.
    #[serde(default, skip_serializing_if = "Equipment::is_empty")]
    pub equipment: Equipment,
}

/// Method of a pose that comes from elsewhere.
pub(crate) const UNJUDGED: &str = "unjudged";

impl Calibration {
    /// Whether it is a mere pose that comes from elsewhere, without any data to judge it by.
    pub fn is_unjudged(&self) -> bool {
        self.method == UNJUDGED
    }

    /// Errors of the robot, beside noise, that the answer is made for.
    pub fn robot_errors(&self) -> Option<RobotErrorKind> {
        RobotErrorKind::ALL.into_iter().find(|errors| errors.candidate() == self.method)
    }

    /// Standard deviation of the robot's reports, each axis, as it was estimated; zero where it was not.
    pub fn robot_noise(&self) -> Residual {
        let of = |source: Source| self.error_budget.iter().find(|b| b.source == source.name());
        let rotation = of(Source::RobotRotation).and_then(|b| b.sigma_deg);
        let position = of(Source::RobotPosition).and_then(|b| b.sigma_mm);
        Residual::of(rotation.unwrap_or(0.0), position.unwrap_or(0.0))
    }

    /// What corrects the robot's poses by place; where there is nothing of the kind, why not, in a sentence.
    ///
    /// # Errors
    /// The calibration is not accepted, the robot does not err by place as far as the data show, correcting it does not
    /// pay, or the answer is another one than that which the correction goes with.
    pub fn correction(&self) -> Result<&Compensation, String> {
        if self.verdict != Verdict::Accepted {
            return Err("this calibration is not accepted: nothing is corrected with it".into());
        }
        let found = self.compensation.as_ref().ok_or(
            "the data of this calibration do not show a robot error that depends on the pose: there is nothing to correct",
        )?;
        let (place, time) = (&found.by_place, &found.by_time);
        let answer = self.hand_eye.mount_from_camera;
        if found.model.as_ref().is_some_and(|m| answer != Some(m.rigid)) {
            return Err(
                "the answer is another one than that which the correction was made for".into()
            );
        }
        if found.model.as_ref().is_some_and(|m| !m.is_whole()) {
            return Err(
                "the numbers of its correction do not fit together: was the file changed?".into()
            );
        }
        found.model.as_ref().ok_or_else(|| {
            format!(
                "correcting poses does not pay: captures that lie near one another, left out together, are missed by \
                 {:.3} mm RMS instead of {:.3}, those that follow one another by {:.3} instead of {:.3}",
                place.corrected_mm, place.rigid_mm, time.corrected_mm, time.rigid_mm
            )
        })
    }

    /// Process exit code of the verdict: 0 accepted, 3 otherwise.
    pub fn exit_code(&self) -> u8 {
        if self.verdict == Verdict::Accepted { 0 } else { 3 }
    }
}

/// Something that was found beside the answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgedFinding {
    /// Short fixed name, for programs: that of the warning, or `rejected` and `undetermined` for reasons.
    pub code: String,
    /// What it does to the answer.
    pub severity: Severity,
    /// What was seen and where, with its numbers.
    pub message: String,
    /// What it did to the answer, with its numbers, in a few words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub headline: Option<String>,
    /// What to do; `None` where the message says it.
    pub advice: Option<String>,
    /// Its numbers, by name with unit.
    pub data: BTreeMap<String, f64>,
}
