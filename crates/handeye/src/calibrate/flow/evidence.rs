//! What the stages have found, before it is judged.

use super::{notes::Notes, views};
use crate::{
    Calibration, Camera, Intrinsics, Mount, Pose, PosePair, Session, Setup, TargetModel, Verdict,
    calibrate::result::{
        Advice, Answer, ArmResult, BudgetEntry, CameraResult, Candidate, CaptureResult,
        CompensationResult, DepthResult, Determined, PoseCovariance, RobotErrorKind, Rows, Scale,
        TipResult, TouchResult, UNJUDGED,
    },
    estimate::{
        evaluate::{Diversity, RmsResidual},
        predict::PredictedTre,
    },
    findings::movement::Movement,
};

/// Version of the result's format.
const FORMAT: &str = "handeye-calibration-1";

/// The unit of distances where it is not determined, in words.
pub(crate) const SCALE: &str = "scale of the measured distances";

/// The time offset where it is not determined, in words.
pub(crate) const TIME_OFFSET: &str = "time offset between camera and robot";

/// All that is known of a session before its verdict.
#[derive(Default)]
pub(crate) struct Evidence {
    /// Findings, and reasons against an answer.
    pub notes: Notes,
    /// All captures, in the order of the session.
    pub captures: Vec<CaptureResult>,
    /// Names of those that do not agree.
    pub rejected: Vec<String>,
    /// What the poses can determine.
    pub diversity: Option<Diversity>,
    /// What is known of the answer where a direction is free.
    pub determined: Option<Determined>,
    /// The chosen answer.
    pub choice: Option<Choice>,
    /// All candidates.
    pub candidates: Vec<Candidate>,
    /// All touches under the chosen answer.
    pub touches: Vec<TouchResult>,
    /// Where the error comes from.
    pub error_budget: Vec<BudgetEntry>,
    /// What would make the predicted error smaller.
    pub advice: Vec<Advice>,
    /// Unit of the distances, and offset of the clocks.
    pub unit_and_clock: UnitAndClock,
    /// Size of the target as the robot sees it.
    pub target_scale: Option<Scale>,
    /// Something that moved.
    pub movement: Option<Movement>,
    /// The camera, where it was refined.
    pub camera: Option<CameraResult>,
    /// The depth of scans, where it is off.
    pub depth: Option<DepthResult>,
    /// The tool's tip, where it is off.
    pub tip: Option<TipResult>,
    /// The arm, where it deviates.
    pub arm: Option<ArmResult>,
    /// What correcting the robot's poses by place is worth.
    pub compensation: Option<CompensationResult>,
}

/// What a candidate is fitted to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum RestsOn {
    /// Views, or whatever else is all that there is.
    #[default]
    Views,
    /// Views and touches, by the joint fit.
    Both,
    /// The same, for a robot with errors beside noise.
    BothFor(RobotErrorKind),
    /// Registered touches.
    Touches,
}

/// The answer that was chosen among the candidates.
#[derive(Clone, Default)]
pub(crate) struct Choice {
    /// Name of the candidate; `None` where there was none.
    pub name: Option<String>,
    /// What it is fitted to.
    pub rests_on: RestsOn,
    /// Why it was chosen.
    pub why: String,
    /// The answer as stored.
    pub hand_eye: Answer,
    /// Its error where it will be used.
    pub predicted_tre_mm: Option<PredictedTre>,
    /// Residual on the captures that it was made from.
    pub residual: RmsResidual,
    /// Leave-one-out residual.
    pub held_out: RmsResidual,
    /// The captures as it sees them; `None` where that is as they were read.
    pub seen: Option<Seen>,
}

/// The captures as an answer sees them that has found more than two poses: with its camera, the size of its target, and
/// its clock.
#[derive(Clone)]
pub(crate) struct Seen {
    /// About the target's first corner, in the order of the views.
    pub pairs: Vec<PosePair>,
    pub camera: Option<Intrinsics>,
    pub target: Option<TargetModel>,
}

/// How measured distances and clocks relate to metres and to the robot's clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UnitAndClock {
    /// Measured over metric distances; `None` where it is free and not determined.
    pub scale: Option<f64>,
    /// Its standard deviation, where it was estimated.
    pub scale_sigma: Option<f64>,
    /// Camera time minus robot time, s; `None` where it is free and not determined.
    pub time_offset_s: Option<f64>,
    /// Its standard deviation, where it was estimated.
    pub time_offset_sigma_s: Option<f64>,
}

impl Default for UnitAndClock {
    fn default() -> Self {
        let (scale, time_offset_s) = (Some(1.0), Some(0.0));
        Self { scale, scale_sigma: None, time_offset_s, time_offset_sigma_s: None }
    }
}

impl Evidence {
    /// That of a session of which nothing but its captures is known.
    pub fn of_captures(session: &Session, unit_and_clock: UnitAndClock) -> Self {
        let captures = session.observations.iter().map(views::first_report).collect();
        Self { captures, unit_and_clock, ..Self::default() }
    }

    /// Number of captures that the answer rests on.
    pub fn used(&self) -> usize {
        self.captures.iter().filter(|c| c.used).count()
    }

    /// Whether the target has corners that could be touched.
    pub fn has_corners(&self) -> bool {
        self.captures.iter().any(|c| c.corners + c.corners_3d > 0)
    }

    /// Whether the data leave something undetermined.
    pub fn is_open(&self) -> bool {
        self.unit_and_clock.scale.is_none() || !self.notes.undetermined.is_empty()
    }

    /// The result, now that the verdict is known.
    pub fn into_result(self, setup: Setup, verdict: Verdict) -> Calibration {
        let Notes { warnings, reasons, mut undetermined, .. } = self.notes;
        let UnitAndClock { scale, scale_sigma, time_offset_s, time_offset_sigma_s } =
            self.unit_and_clock;
        if time_offset_s.is_none() {
            undetermined.push(TIME_OFFSET.into());
        }
        let choice = self.choice.unwrap_or_default();
        Calibration {
            format: FORMAT.into(),
            setup,
            verdict,
            reasons,
            method: choice.name.clone().unwrap_or_default(),
            hand_eye: choice.hand_eye,
            name: format!("{}_from_camera", setup.mount()),
            chosen: choice.name,
            why: choice.why,
            candidates: self.candidates,
            predicted_tre_mm: choice.predicted_tre_mm,
            max_error_mm: None,
            residual: choice.residual,
            held_out: choice.held_out,
            captures: self.captures,
            touches: self.touches,
            rejected: self.rejected,
            undetermined,
            determined: self.determined,
            diversity: self.diversity,
            error_budget: self.error_budget,
            advice: self.advice,
            time_offset_s,
            time_offset_sigma_s,
            scale,
            scale_sigma,
            target_scale: self.target_scale,
            movement: self.movement,
            camera: self.camera,
            depth: self.depth,
            scans: None,
            tip: self.tip,
            arm: self.arm,
            compensation: self.compensation,
            certificate: None,
            warnings,
            findings: vec![],
            run_id: None,
            frames: None,
            version: None,
            created: None,
            dataset: None,
            inputs: vec![],
            equipment: Default::default(),
        }
        .recorded()
    }
}

/// A pose of the camera that comes from elsewhere: nothing was measured here, and nothing is said of its error.
pub fn unjudged(
    setup: Setup,
    mount_from_camera: Pose<Mount, Camera>,
    covariance: Option<Rows>,
) -> Calibration {
    let hand_eye = Answer {
        mount_from_camera: Some(mount_from_camera),
        covariance: PoseCovariance { mount_from_camera: covariance, ..Default::default() },
        ..Answer::default()
    };
    Calibration {
        hand_eye,
        method: UNJUDGED.into(),
        reasons: vec!["it comes from elsewhere, and nothing was measured here".into()],
        time_offset_s: None,
        scale: None,
        ..Evidence::default().into_result(setup, Verdict::Undetermined)
    }
    .recorded()
}
