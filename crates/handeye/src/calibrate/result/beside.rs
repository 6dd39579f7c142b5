//! What is known beside a calibration, and belongs into its result: what was noticed while images and scans were
//! measured, and which mistake in the files explains that there is no answer.

use super::{
    CameraResult, CaptureResult, ColourStepResult, ScanResult, SceneKind, SceneResult, causes,
};
use crate::{
    Calibration, Session, Verdict, Warning,
    findings::{
        CameraFinding, CaptureFinding, Finding, FramesFinding,
        captures::{MostMissing, Shown},
    },
};

/// What was noticed while images and scans were measured.
#[derive(Debug, Clone, Default)]
pub struct Measuring {
    /// What to know.
    pub warnings: Vec<Warning>,
    /// Why captures show no target, by name.
    pub not_found: Vec<(String, String)>,
    /// How depths on the two colours of the print differ, where scans tell it.
    pub colour_step: Option<ColourStepResult>,
    /// How scans were placed, where a shape takes a board's place.
    pub scene: Option<SceneResult>,
}

impl Calibration {
    /// The result with what was noticed while the `session` was measured.
    pub fn with(self, measuring: &Measuring, session: &Session) -> Self {
        let named = named_by_what_was_used(measuring.warnings.clone(), self.camera.as_ref());
        let because = |c: &CaptureResult| {
            let found = measuring.not_found.iter().find(|(id, _)| *id == c.id);
            let reason = found.map(|(_, reason)| reason.clone()).or_else(|| c.reason.clone());
            CaptureResult { reason, ..c.clone() }
        };
        let captures = self.captures.iter().map(because).collect();
        let scans = of_scans(self.scans.clone(), measuring);
        let result = Self { captures, scans, ..self.noting(named) };
        let result = causes::merged(result, session);
        match most_missing(&result, measuring) {
            Some(missing) => result.missing(CaptureFinding::MostMissing(missing), measuring),
            None => result,
        }
    }

    /// Says first what most captures miss; without a board nothing else is worth saying of an answer that is not there.
    fn missing(self, finding: CaptureFinding, measuring: &Measuring) -> Self {
        let is_reason = measuring.scene.is_some() && self.verdict != Verdict::Accepted;
        let reason = is_reason.then(|| finding.message());
        let reasons = reason.into_iter().chain(self.reasons.iter().cloned()).collect();
        Self { reasons, ..self }.noting_first([finding])
    }

    /// Refused for a mistake on which all of it rests, such as another layout of the target or scans in another unit: a
    /// few captures may fit by chance.
    pub fn refused_for(self, mistake: String) -> Self {
        let follows_not = |w: &&Warning| !is_of_another_unit(w);
        let warnings = self.warnings.iter().filter(follows_not).cloned().collect();
        Self { warnings, undetermined: vec![], ..self }.rejected_for(vec![mistake])
    }

    /// With the mistake that explains why there is no answer as the first reason. Where `nothing_seen`, or nothing could be
    /// computed, the other reasons follow from it, and are dropped.
    pub fn explained_by(self, mistake: String, nothing_seen: bool) -> Self {
        let follow = nothing_seen || self.chosen.is_none();
        let rest = if follow { vec![] } else { self.reasons.clone() };
        let reasons = std::iter::once(mistake).chain(rest).collect();
        Self { reasons, ..self }.recorded()
    }

    /// With the name of its run.
    pub fn of_run(self, id: String) -> Self {
        Self { run_id: Some(id), ..self }
    }
}

/// Whether scans in another unit look like this.
fn is_of_another_unit(warning: &Warning) -> bool {
    match warning.finding.as_deref() {
        Some(Finding::Frames(found)) => !matches!(found, FramesFinding::NotSeparable),
        Some(Finding::Camera(found)) => matches!(found, CameraFinding::DepthOff { .. }),
        _ => false,
    }
}

/// A camera calibrated from the views is refined with the robot's poses: what is printed is what was used.
fn named_by_what_was_used(warnings: Vec<Warning>, camera: Option<&CameraResult>) -> Vec<Warning> {
    let used = camera.map(|c| c.intrinsics);
    let one = |warning: Warning| match warning.finding.as_deref() {
        Some(Finding::Camera(CameraFinding::CalibratedFromViews { calibrated, .. }))
            if used.is_some() =>
        {
            CameraFinding::CalibratedFromViews { calibrated: *calibrated, used }.into()
        }
        _ => warning,
    };
    warnings.into_iter().map(one).collect()
}

fn of_scans(found: Option<ScanResult>, measuring: &Measuring) -> Option<ScanResult> {
    let Measuring { colour_step, scene, .. } = measuring;
    if colour_step.is_none() && scene.is_none() {
        return found;
    }
    let found = found.unwrap_or_default();
    Some(ScanResult {
        colour_step: colour_step.clone().or(found.colour_step),
        scene: scene.clone().or(found.scene),
        ..found
    })
}

/// What most captures miss, if they do.
fn most_missing(result: &Calibration, measuring: &Measuring) -> Option<MostMissing> {
    let (missing, of) = (measuring.not_found.len(), result.captures.len());
    let (capture, reason) = measuring.not_found.first().filter(|_| 2 * missing > of)?.clone();
    let shown = match measuring.scene.as_ref().map(|scene| scene.kind) {
        None => Shown::Target,
        Some(SceneKind::Scene) => Shown::Scene,
        Some(SceneKind::Object) => Shown::Object,
    };
    Some(MostMissing { shown, missing, of, capture, reason })
}
