//! `handeye calibrate`: a folder of captures in, a transform to trust out.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{
    Calibration, Config, Session, Setup, Verdict, Warning, calibrate, calibration::SceneKind,
    refine::noise::KnownNoise, register::IcpConfig,
};
use handeye_io::{
    Dataset, WorkspaceFrame,
    export::Format,
    measure::{self, Measured},
    robot, write_atomically,
};

use crate::{
    args::{CalibrateArgs, Manners},
    export,
    failure::Failure,
    output,
    progress::Progress,
    report, solve,
};

pub fn run(args: &CalibrateArgs, manners: &Manners) -> Result<u8, Failure> {
    let config = config(args)?;
    let formats = export::formats(&args.format)?;
    let dataset = open(args)?;
    let (calibration, session) = run_on(&dataset, config, manners)?;
    if !manners.json {
        output::warnings(&calibration, manners);
        output::summary(&calibration);
    }
    if let Some(out) = &args.out {
        write(out, &dataset, &calibration, &session, manners)?;
        export_accepted(out, &calibration, &formats, manners)?;
    }
    if manners.json {
        output::json(&calibration); // last: what fails before is the one document
    }
    Ok(calibration.exit_code())
}

fn export_accepted(
    out: &Path,
    calibration: &Calibration,
    formats: &[Format],
    manners: &Manners,
) -> Result<(), Failure> {
    if calibration.verdict == Verdict::Accepted {
        export::exports(calibration, formats, out)?;
    } else if !formats.is_empty() && !manners.quiet {
        eprintln!("nothing exported: the verdict is not `accepted`");
    }
    Ok(())
}

fn config(args: &CalibrateArgs) -> Result<Config, Failure> {
    let positive = |name: &str, v: f64| {
        if v > 0.0 { Ok(v) } else { Err(Failure::Usage(format!("--{name} must be positive"))) }
    };
    Ok(Config {
        method: args.method.as_deref().map(solve::method).transpose()?,
        icp: IcpConfig {
            max_iterations: args.icp_max_iterations,
            max_correspondence_distance_m: 1e-3
                * positive("icp-max-distance-mm", args.icp_max_distance_mm)?,
            transformation_epsilon: positive("icp-epsilon", args.icp_epsilon)?,
        },
        ..Config::default()
    })
}

fn open(args: &CalibrateArgs) -> Result<Dataset, Failure> {
    Ok(match &args.root {
        Some(root) => Dataset::open_with_root(&args.dataset, root)?,
        None => Dataset::open(&args.dataset)?,
    })
}

/// Measures and calibrates a dataset.
pub fn run_on(
    dataset: &Dataset,
    config: Config,
    manners: &Manners,
) -> Result<(Calibration, Session), Failure> {
    check_workspace(dataset)?;
    let what = if dataset.shape.is_some() { "placing scans" } else { "reading captures" };
    let progress = Progress::new(what, manners);
    let measured = measure::measure(dataset, &|done, all| progress.tell(done, all))?;
    drop(progress);
    let config = Config {
        known: KnownNoise {
            robot_rotation_rad: dataset.noise.robot_rotation,
            robot_position_m: dataset.noise.robot_position,
            touch_m: dataset.noise.touch,
            tip_m: dataset.noise.tip,
        },
        max_error_mm: dataset.limits.max_error.map(|m| m * 1e3),
        ..config
    };
    let mut calibration = calibrate(&measured.session, &config)?;
    explain(&mut calibration, &measured);
    Ok((calibration, measured.session))
}

fn check_workspace(dataset: &Dataset) -> Result<(), Failure> {
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
    Err(Failure::input(&dataset.manifest, what))
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

/// The corrected model of the arm, where one was found.
const ARM: &str = "corrected_arm.json";

/// Writes everything asked for into the folder.
pub fn write(
    out: &Path,
    dataset: &Dataset,
    calibration: &Calibration,
    session: &Session,
    manners: &Manners,
) -> Result<PathBuf, Failure> {
    fs::create_dir_all(out).map_err(|e| Failure::no_folder(out, e))?;
    let json = serde_json::to_string_pretty(calibration).map_err(|e| Failure::input(out, e))?;
    write_atomically(&out.join("calibration.json"), (json + "\n").as_bytes())?;
    match &calibration.arm {
        Some(arm) => write_atomically(&out.join(ARM), robot::arm_file(&arm.model).as_bytes())?,
        // that of an earlier run does not belong to this result
        None => drop(fs::remove_file(out.join(ARM))),
    }
    let page = report::page(dataset, calibration, session);
    let path = out.join("report.html");
    write_atomically(&path, page.as_bytes())?;
    if !manners.quiet {
        eprintln!("report: {}", path.display());
    }
    Ok(path)
}
