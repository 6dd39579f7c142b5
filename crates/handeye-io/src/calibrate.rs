//! From a dataset to a calibration with its files.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{
    Calibration, Config, Session, Setup, Verdict, Warning, calibrate, calibrate_moving,
    calibration::SceneKind, refine::noise::KnownNoise,
};

use crate::{
    Dataset, Error, Place, WorkspaceFrame, causes,
    error::unusable,
    measure::{self, Measured},
    robot, write_atomically,
};

/// Measures and calibrates a dataset; what its manifest says of noise and limits comes before `config`. `progress` is
/// told how many captures of how many are read.
///
/// # Errors
/// Files that cannot be used, with the capture; bad data end in a verdict.
pub fn calibrate_dataset(
    dataset: &Dataset,
    config: &Config,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<(Calibration, Session), Error> {
    check_workspace(dataset)?;
    let measured = measure::measure(dataset, progress)?;
    let config = Config {
        known: KnownNoise {
            robot_rotation_rad: dataset.noise.robot_rotation,
            robot_position_m: dataset.noise.robot_position,
            touch_m: dataset.noise.touch,
            tip_m: dataset.noise.tip,
        },
        max_error_mm: dataset.limits.max_error.map(|m| m * 1e3),
        answer_frame: dataset.answer_frame,
        ..config.clone()
    };
    let calibrated = match &dataset.motion {
        Some(motion) => {
            let crate::dataset::Motion { robot, joints, times } = motion;
            calibrate_moving(&measured.session, robot, joints, times, &config)
        }
        None => calibrate(&measured.session, &config),
    };
    let mut calibration = calibrated
        .map_err(|source| Error::Values { place: Place::file(&dataset.manifest), source })?;
    explain(&mut calibration, &measured);
    Ok((calibration, measured.session))
}

fn check_workspace(dataset: &Dataset) -> Result<(), Error> {
    let Some(workspace) = &dataset.workspace else { return Ok(()) };
    let wanted = match dataset.setup {
        Setup::EyeInHand => WorkspaceFrame::Camera,
        Setup::EyeToHand => WorkspaceFrame::Base,
    };
    if workspace.frame == wanted {
        return Ok(());
    }
    let what = match dataset.setup {
        Setup::EyeInHand => {
            "[workspace] of an eye-in-hand camera must be given in the camera frame: where in its \
             view will parts lie when they are picked?"
        }
        Setup::EyeToHand => {
            "[workspace] of an eye-to-hand camera must be given in the base frame: where will the \
             robot work?"
        }
    };
    Err(unusable(&dataset.manifest, what))
}

/// Adds to the result what reading the files told.
fn explain(calibration: &mut Calibration, measured: &Measured) {
    calibration.warnings.extend(measured.warnings.iter().cloned());
    if measured.colour_step.is_some() {
        let scans = calibration.scans.get_or_insert_default();
        scans.colour_step = measured.colour_step.clone();
    }
    for (id, reason) in &measured.not_found {
        if let Some(capture) = calibration.captures.iter_mut().find(|c| c.id == *id) {
            capture.reason = Some(reason.clone());
        }
    }
    if let Some(scene) = &measured.scene {
        calibration.scans.get_or_insert_default().scene = Some(scene.clone());
    }
    causes::tell(calibration, &measured.session);
    explain_missing(calibration, measured);
}

/// Says first what most captures miss.
fn explain_missing(calibration: &mut Calibration, measured: &Measured) {
    let (missing, all) = (measured.not_found.len(), calibration.captures.len());
    let Some((id, reason)) = measured.not_found.first().filter(|_| 2 * missing > all) else {
        return;
    };
    let (code, message) = match measured.scene.as_ref().map(|scene| scene.kind) {
        None => (
            "target-not-found",
            format!(
                "the target was not found in {missing} pictures of {all} captures ({id}: {reason}): \
                 check [target]"
            ),
        ),
        Some(SceneKind::Scene) => (
            "scans-not-placed",
            format!(
                "{missing} of {all} scans have no place in the scene ({id}: {reason}): scan a scene with \
                 shape on all sides, from places that see much in common"
            ),
        ),
        Some(SceneKind::Object) => (
            "target-not-found",
            format!(
                "{missing} of {all} scans do not show the object ({id}: {reason}): check [object]"
            ),
        ),
    };
    if measured.scene.is_some() && calibration.verdict != Verdict::Accepted {
        calibration.reasons.insert(0, message.clone());
    }
    calibration.warnings.insert(0, Warning::new(code, message));
}

/// The result's file.
const RESULT: &str = "calibration.json";
/// Its page.
const PAGE: &str = "report.html";
/// The corrected model of the arm, where one was found.
const ARM: &str = "corrected_arm.json";

/// Writes a result, its page and, where one was found, the corrected arm into a folder; returns the page's path.
///
/// # Errors
/// A folder that does not take them.
pub fn write_results(out: &Path, calibration: &Calibration, page: &str) -> Result<PathBuf, Error> {
    let json =
        serde_json::to_string_pretty(calibration).map_err(|e| unusable(out, e.to_string()))?;
    write_atomically(&out.join(RESULT), (json + "\n").as_bytes())?;
    match &calibration.arm {
        Some(arm) => write_atomically(&out.join(ARM), robot::arm_file(&arm.model).as_bytes())?,
        // that of an earlier run does not belong to this result
        None => drop(fs::remove_file(out.join(ARM))),
    }
    let path = out.join(PAGE);
    write_atomically(&path, page.as_bytes())?;
    Ok(path)
}
