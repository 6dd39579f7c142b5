//! From a folder of images and robot poses, described by its handeye.toml, to a result with a report.
//!
//!     cargo run --release -p handeye-io --example from_a_folder [FOLDER]
//!
//! Without a folder, one is simulated, with known truth.

use std::{
    env,
    error::Error,
    path::{Path, PathBuf},
};

use handeye::{Config, Setup, Verdict, simulate::Cell};
use handeye_io::{
    Dataset,
    calibrate::{calibrate_dataset, write_results},
    report::dataset_html,
    simulated::{self, ScanFormat, Writing},
};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = match env::args_os().nth(1) {
        Some(folder) => PathBuf::from(folder),
        None => simulated_folder()?,
    };
    let dataset = Dataset::open(&folder)?;
    let progress = |done: usize, all: usize| eprint!("\r{done} of {all} captures");
    let (result, session) = calibrate_dataset(&dataset, &Config::default(), &progress)?;

    println!("\n{:?}: {}", result.verdict, result.reasons.join("; "));
    for finding in &result.findings {
        println!("{}: {}", finding.code, finding.message);
    }
    if result.verdict == Verdict::Accepted
        && let Some(found) = result.hand_eye.mount_from_camera
    {
        println!("{}: {:.4?} m", result.name, found.translation().as_slice());
    }
    // calibration.json for programs, report.html for people
    let out = folder.join("result");
    std::fs::create_dir_all(&out)?;
    let page = dataset_html(&dataset, &result, &session);
    println!("report: {}", write_results(&out, Some(&dataset), &result, &page)?.display());
    Ok(())
}

/// A camera on a robot that looks at a ChArUco board from ten poses.
fn simulated_folder() -> Result<PathBuf, Box<dyn Error>> {
    let folder = Path::new(&env::temp_dir()).join("handeye-from-a-folder");
    std::fs::create_dir_all(&folder)?;
    let cell = Cell { captures: 10, touches: 0, ..Cell::new(Setup::EyeInHand, 1) };
    let recording = cell.record(1)?;
    simulated::write(&recording, &folder, Writing { images: true, scans: ScanFormat::Ply })?;
    Ok(folder)
}
