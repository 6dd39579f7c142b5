//! `handeye calibrate`: a folder of captures in, a transform to trust out.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{Calibration, Config, Session, Verdict, calibrate::findings, register::IcpConfig};
use handeye_io::{
    Dataset, ResultFolder,
    calibrate::{calibrate_dataset, write_run},
    checkup::can_be_checked,
    export::Format,
    report::dataset_html,
};

use crate::{
    args::{Acceptance, CalibrateArgs, GlobalArgs},
    export,
    failure::Failure,
    output,
    progress::Progress,
    solve,
};

pub fn run(args: &CalibrateArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let config = config(args)?;
    let formats = export::formats(&args.format)?;
    let mut dataset = open(args)?;
    dataset.limits.max_error =
        args.acceptance.max_error()?.map(|mm| mm * 1e-3).or(dataset.limits.max_error);
    let folder = args.out.as_deref().map(result_folder).transpose()?;
    let (calibration, session) = run_on(&dataset, &config, global)?;
    if args.acceptance.oneline && !global.json {
        output::print(&output::line(&calibration, &args.dataset));
    } else if !global.json {
        output::warnings(&calibration, global);
        output::summary(&calibration);
        let unseen = calibration.captures.iter().all(|c| c.camera_from_target.is_none());
        let refused = calibration.verdict == Verdict::Rejected
            || calibration.verdict == Verdict::Undetermined && unseen;
        if refused && !calibration.is_only_imprecise() && can_be_checked(&dataset) {
            output::print(&format!("\nnext: handeye check {}\n", output::word(&args.dataset)));
        }
    }
    if let (Some(out), Some(folder)) = (&args.out, &folder) {
        let exports = export_accepted(out, &calibration, &formats, global)?;
        let page = dataset_html(&dataset, &calibration, &session);
        write((out, folder), &dataset, (&calibration, &page), exports, global)?;
    }
    if global.json {
        output::json(&calibration); // last: what fails before is the one document
    }
    Ok(args.acceptance.exit_code(&calibration))
}

impl Acceptance {
    /// The largest predicted error to accept, mm.
    pub fn max_error(&self) -> Result<Option<f64>, Failure> {
        match self.max_error_mm {
            Some(mm) if !(mm > 0.0) => {
                Err(Failure::Usage("--max-error-mm must be positive".into()))
            }
            given => Ok(given),
        }
    }

    /// The exit code of a result.
    pub fn exit_code(&self, calibration: &Calibration) -> u8 {
        match findings::reservation(calibration) {
            Some(_) if self.strict => WITH_FINDINGS,
            _ => calibration.exit_code(),
        }
    }
}

/// Exit code of a result that is accepted with findings that changed the answer, where that is asked.
const WITH_FINDINGS: u8 = 4;

/// The folder for the results, made where it is missing.
pub fn result_folder(out: &Path) -> Result<ResultFolder, Failure> {
    fs::create_dir_all(out).map_err(|e| Failure::no_folder(out, e))?;
    Ok(ResultFolder::open(out)?)
}

/// Names and contents of the exports asked for, where the verdict allows any.
fn export_accepted(
    out: &Path,
    calibration: &Calibration,
    formats: &[Format],
    global: &GlobalArgs,
) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    if formats.is_empty() {
        return Ok(vec![]);
    }
    if calibration.verdict == Verdict::Accepted {
        return export::exports(calibration, formats, out);
    }
    if !global.quiet {
        crate::output::note!("nothing exported: the verdict is not `accepted`");
    }
    Ok(vec![])
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
    config: &Config,
    global: &GlobalArgs,
) -> Result<(Calibration, Session), Failure> {
    let what = if dataset.shape.is_some() { "placing scans" } else { "reading captures" };
    let progress = Progress::new(what, global);
    Ok(calibrate_dataset(dataset, config, &|done, all| progress.tell(done, all))?)
}

/// Writes everything that belongs to a run into its folder, together; returns the page's path.
pub fn write(
    (out, folder): (&Path, &ResultFolder),
    dataset: &Dataset,
    (calibration, page): (&Calibration, &str),
    exports: Vec<(String, Vec<u8>)>,
    global: &GlobalArgs,
) -> Result<PathBuf, Failure> {
    let written = write_run((out, folder), Some(dataset), calibration, page, exports)?;
    if !global.quiet {
        if written.replaced_another_run {
            crate::output::note!(
                "note: another run wrote its result into {} while this one was working; the files \
                 there are now those of this run ({})",
                out.display(),
                calibration.run_id.as_deref().unwrap_or("without a name")
            );
        }
        crate::output::note!("report: {}", written.page.display());
    }
    Ok(written.page)
}
