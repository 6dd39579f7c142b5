//! From a dataset to a calibration with its files.

use std::path::{Path, PathBuf};

use handeye::{
    Calibration, Config, Session, Setup, Verdict, calibrate,
    estimate::noise::KnownNoise,
    tools::halves::{Halves, halves},
};

use crate::{
    Dataset, Error, Place, WorkspaceFrame, checkup,
    error::unusable,
    hash::Hash,
    measure::{self, Measured},
    origin, parallel,
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
    check_workspace(dataset)?; // before all is measured
    let measured = measure::measure(dataset, progress)?;
    let calibration = calibrate_measured(dataset, &measured, config)?;
    let manifest = dataset.manifest_text()?;
    let inputs = format!("{manifest}{:?}", measured.session);
    let id = run_id(&inputs, &calibration);
    let calibration = calibration.of_run(id).made_from(origin::of_dataset(dataset)?);
    Ok((calibration.with_frames(dataset.frames.clone()), measured.session))
}

/// The same of captures that are measured; without the names and sums of the files that the result comes from.
///
/// # Errors
/// A workspace in another frame than the setup's; captures that make no sense.
pub fn calibrate_measured(
    dataset: &Dataset,
    measured: &Measured,
    config: &Config,
) -> Result<Calibration, Error> {
    check_workspace(dataset)?;
    let config = configured(dataset, config);
    let calibration = calibrate(&measured.session, &config)
        .map_err(|source| Error::Values { place: Place::file(&dataset.manifest), source })?
        .with(&measured.noticed, &measured.session);
    explained(calibration, dataset, measured)
}

/// A calibration of the poses in a file, with the version, the time and the file's sum.
///
/// # Errors
/// A file that cannot be read any more.
pub fn made_from_file(calibration: Calibration, file: &Path) -> Result<Calibration, Error> {
    Ok(calibration.made_from(origin::of_file(file)?))
}

/// Measures a dataset and calibrates the halves of its captures; as [`calibrate_dataset`].
///
/// # Errors
/// As [`calibrate_dataset`]; fewer captures than have halves.
pub fn halves_of_dataset(
    dataset: &Dataset,
    config: &Config,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Halves>, Error> {
    check_workspace(dataset)?;
    let session = measure::measure(dataset, progress)?.session;
    halves(&session, &configured(dataset, config))
        .map_err(|source| Error::Values { place: Place::file(&dataset.manifest), source })
}

/// A configuration with what the manifest says of noise and limits, which comes before what `config` says.
pub(crate) fn configured(dataset: &Dataset, config: &Config) -> Config {
    Config {
        known: KnownNoise {
            robot_rotation_rad: dataset.noise.robot_rotation,
            robot_position_m: dataset.noise.robot_position,
            touch_m: dataset.noise.touch,
            tip_m: dataset.noise.tip,
        }
        .or(config.known),
        max_error_mm: dataset.limits.max_error.map(|m| m * 1e3).or(config.max_error_mm),
        answer_frame: dataset.answer_frame.unwrap_or(config.answer_frame),
        threads: parallel::or_all(config.threads),
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

/// A result with what reading the files says of it: a mistake on which all of it rests, or one that explains why it is
/// not accepted.
fn explained(
    calibration: Calibration,
    dataset: &Dataset,
    measured: &Measured,
) -> Result<Calibration, Error> {
    if let Some(found) = checkup::basic_mistake(dataset, measured)? {
        return Ok(calibration.refused_for(found.sentence()));
    }
    let nothing_seen = 2 * measured.noticed.not_found.len() > dataset.captures.len();
    let is_refused = match calibration.verdict {
        Verdict::Accepted => false,
        Verdict::Rejected => true,
        Verdict::Undetermined => nothing_seen,
    };
    let why = is_refused.then(|| checkup::diagnosis(dataset, measured)).flatten();
    Ok(match why {
        Some(why) => calibration.explained_by(why, nothing_seen),
        None => calibration,
    })
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

/// The same in the words of the URDF that it was given as.
const URDF: &str = "corrected_arm.urdf";
/// The same as Universal Robots' description package reads it.
const KINEMATICS: &str = "corrected_kinematics.yaml";

/// The corrected arm in the words of the file that it was given as, names and contents: a URDF, and for an arm of
/// Universal Robots its `kinematics`. None where no arm was corrected, or it was not given as a URDF.
fn corrected_files(dataset: &Dataset, calibration: &Calibration) -> Vec<(String, Vec<u8>)> {
    let (Some(urdf), Some(arm)) = (&dataset.urdf, &calibration.arm) else { return vec![] };
    let files = [
        (URDF, robot::corrected::urdf(urdf, &arm.model)),
        (KINEMATICS, robot::corrected::kinematics(urdf, &arm.model)),
    ];
    let whole = |(name, text): (&str, Option<String>)| Some((name.to_owned(), text?.into_bytes()));
    files.into_iter().filter_map(whole).collect()
}

/// What was written.
pub struct Written {
    /// The page.
    pub page: PathBuf,
    /// Another run had put its result there in the meantime; this run's files replaced it.
    pub replaced_another_run: bool,
}

/// Writes a result, its page and, where one was found, the corrected arm into a folder; returns the page's path. With the
/// `dataset`, an arm that was given as a URDF is written as one too.
///
/// # Errors
/// A folder that does not take them; then its older files are as they were.
pub fn write_results(
    out: &Path,
    dataset: Option<&Dataset>,
    calibration: &Calibration,
    page: &str,
) -> Result<PathBuf, Error> {
    let folder = ResultFolder::open(out)?;
    Ok(write_run((out, &folder), dataset, calibration, page, vec![])?.page)
}

/// The same with files in other programs' formats beside them (name and content): all of them together, or none.
///
/// # Errors
/// As [`write_results`].
pub fn write_run(
    (out, folder): (&Path, &ResultFolder),
    dataset: Option<&Dataset>,
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
    let corrected = dataset.map_or_else(Vec::new, |d| corrected_files(d, calibration));
    let is_absent = |name: &&str| corrected.iter().all(|(there, _)| there != name);
    run.absent.extend([URDF, KINEMATICS].iter().copied().filter(is_absent));
    run.files.extend(corrected);
    let replaced_another_run = folder.publish(&run)?;
    Ok(Written { page: out.join(PAGE), replaced_another_run })
}
