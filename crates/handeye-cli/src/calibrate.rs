//! `handeye calibrate`: a folder of captures in, a transform to trust out.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{Calibration, Config, Session, Verdict, register::IcpConfig};
use handeye_io::{
    Dataset,
    calibrate::{calibrate_dataset, write_results},
    export::Format,
    report::dataset_html,
};

use crate::{
    args::{CalibrateArgs, Manners},
    export,
    failure::Failure,
    output,
    progress::Progress,
    solve,
};

pub fn run(args: &CalibrateArgs, manners: &Manners) -> Result<u8, Failure> {
    let config = config(args)?;
    let formats = export::formats(&args.format)?;
    let dataset = open(args)?;
    let (calibration, session) = run_on(&dataset, &config, manners)?;
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
    config: &Config,
    manners: &Manners,
) -> Result<(Calibration, Session), Failure> {
    let what = if dataset.shape.is_some() { "placing scans" } else { "reading captures" };
    let progress = Progress::new(what, manners);
    Ok(calibrate_dataset(dataset, config, &|done, all| progress.tell(done, all))?)
}

/// Writes everything asked for into the folder.
pub fn write(
    out: &Path,
    dataset: &Dataset,
    calibration: &Calibration,
    session: &Session,
    manners: &Manners,
) -> Result<PathBuf, Failure> {
    fs::create_dir_all(out).map_err(|e| Failure::no_folder(out, e))?;
    let page = dataset_html(dataset, calibration, session);
    let report = write_results(out, calibration, &page)?;
    if !manners.quiet {
        eprintln!("report: {}", report.display());
    }
    Ok(report)
}
