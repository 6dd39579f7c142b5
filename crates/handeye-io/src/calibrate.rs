//! From a dataset to a calibration with its files.

use std::path::{Path, PathBuf};

use handeye::{
    Calibration, Config, Session, Setup, Verdict, Warning, calibrate,
    calibrate::{findings, result::SceneKind},
    calibrate_moving,
    estimate::noise::KnownNoise,
    findings::{CameraFinding, Finding, FramesFinding},
};

use crate::{
    Dataset, Error, Place, WorkspaceFrame, causes, checkup,
    error::unusable,
    files,
    hash::Hash,
    measure::{self, Measured},
    result_folder::{RESULT, ResultFolder, RunFiles},
    robot,
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
    let config = configured(dataset, config);
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
    if !refuse_basic_mistake(&mut calibration, dataset, &measured)? {
        say_what_is_wrong(&mut calibration, dataset, &measured);
    }
    findings::record(&mut calibration);
    let manifest = files::text(&dataset.manifest)?;
    let inputs = format!("{manifest}{:?}", measured.session);
    calibration.run_id = Some(run_id(&inputs, &calibration));
    Ok((calibration, measured.session))
}

/// A configuration with what the manifest says of noise and limits.
pub(crate) fn configured(dataset: &Dataset, config: &Config) -> Config {
    Config {
        known: KnownNoise {
            robot_rotation_rad: dataset.noise.robot_rotation,
            robot_position_m: dataset.noise.robot_position,
            touch_m: dataset.noise.touch,
            tip_m: dataset.noise.tip,
        },
        max_error_mm: dataset.limits.max_error.map(|m| m * 1e3),
        answer_frame: dataset.answer_frame,
        ..config.clone()
    }
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

/// Whether scans in another unit look like this.
fn is_of_another_unit(warning: &Warning) -> bool {
    match warning.finding.as_deref() {
        Some(Finding::Frames(found)) => !matches!(found, FramesFinding::NotSeparable),
        Some(Finding::Camera(found)) => matches!(found, CameraFinding::DepthOff { .. }),
        _ => false,
    }
}

/// Refuses what rests on another layout of the target, or on scans in another unit: a few captures may fit by chance,
/// and scans would be dropped for images alone. Says whether there is such a mistake.
fn refuse_basic_mistake(
    calibration: &mut Calibration,
    dataset: &Dataset,
    measured: &Measured,
) -> Result<bool, Error> {
    let Some(found) = checkup::basic_mistake(dataset, measured)? else { return Ok(false) };
    calibration.verdict = Verdict::Rejected;
    calibration.undetermined.clear();
    calibration.reasons = vec![found.sentence()];
    calibration.warnings.retain(|w| !is_of_another_unit(w));
    Ok(true)
}

/// Where an answer is not accepted and `check` knows why, that is the first reason.
fn say_what_is_wrong(calibration: &mut Calibration, dataset: &Dataset, measured: &Measured) {
    let nothing_seen = 2 * measured.not_found.len() > dataset.captures.len();
    let is_refused = match calibration.verdict {
        Verdict::Accepted => false,
        Verdict::Rejected => true,
        Verdict::Undetermined => nothing_seen,
    };
    if !is_refused {
        return;
    }
    let Some(why) = checkup::diagnosis(dataset, measured) else { return };
    // what nothing can be determined from is no reason of its own
    let follows = |reason: &String| nothing_seen || why.starts_with(reason.as_str());
    calibration.reasons.retain(|reason| !follows(reason));
    calibration.reasons.insert(0, why);
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
    name_camera_used(calibration);
    causes::tell(calibration, &measured.session);
    explain_missing(calibration, measured);
}

/// A camera calibrated from the views is refined with the robot's poses: what is printed is what was used.
fn name_camera_used(calibration: &mut Calibration) {
    let Some(used) = calibration.camera.map(|c| c.intrinsics) else { return };
    for warning in &mut calibration.warnings {
        if let Some(Finding::Camera(CameraFinding::CalibratedFromViews { calibrated, .. })) =
            warning.finding.as_deref()
        {
            let (calibrated, used) = (*calibrated, Some(used));
            *warning = CameraFinding::CalibratedFromViews { calibrated, used }.into();
        }
    }
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
                "the target was not found in {missing} images of {all} captures ({id}: {reason}): \
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

/// The name of a run: the same inputs and the same result have the same one.
pub(crate) fn run_id(inputs: &str, calibration: &Calibration) -> String {
    let result = serde_json::to_vec(calibration).unwrap_or_default();
    Hash::of(inputs.as_bytes()).and(&result).to_string()
}

/// A result's page.
const PAGE: &str = "report.html";
/// The corrected model of the arm, where one was found.
const ARM: &str = "corrected_arm.json";

/// What was written.
pub struct Written {
    /// The page.
    pub page: PathBuf,
    /// Another run had put its result there in the meantime; this run's files replaced it.
    pub replaced_another_run: bool,
}

/// Writes a result, its page and, where one was found, the corrected arm into a folder; returns the page's path.
///
/// # Errors
/// A folder that does not take them; then its older files are as they were.
pub fn write_results(out: &Path, calibration: &Calibration, page: &str) -> Result<PathBuf, Error> {
    let folder = ResultFolder::open(out)?;
    Ok(write_run(out, &folder, calibration, page, vec![])?.page)
}

/// The same with files in other programs' formats beside them (name and content): all of them together, or none.
///
/// # Errors
/// As [`write_results`].
pub fn write_run(
    out: &Path,
    folder: &ResultFolder,
    calibration: &Calibration,
    page: &str,
    exports: Vec<(String, Vec<u8>)>,
) -> Result<Written, Error> {
    let json =
        serde_json::to_string_pretty(calibration).map_err(|e| unusable(out, e.to_string()))?;
    let mut run = RunFiles { files: exports, absent: vec![] };
    run.files.push((PAGE.to_owned(), page.as_bytes().to_vec()));
    run.files.push((RESULT.to_owned(), (json + "\n").into_bytes()));
    match &calibration.arm {
        Some(arm) => run.files.push((ARM.to_owned(), robot::arm_file(&arm.model).into_bytes())),
        None => run.absent.push(ARM),
    }
    let replaced_another_run = folder.publish(&run)?;
    Ok(Written { page: out.join(PAGE), replaced_another_run })
}
