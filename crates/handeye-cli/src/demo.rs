//! `handeye demo`: the whole job on a small dataset inside the program.
//!
//! The dataset in `demo/` was made by `handeye simulate` with the options in `demo/README.txt`, so
//! the truth is known, and the answer is compared with it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::Args;
use handeye::{Calibration, Camera, Config, Mount, Pose};
use handeye_io::{Dataset, process, report::dataset_html, temporary_folder, write_atomically};
use serde::{Deserialize, Serialize};

use crate::{args::GlobalArgs, browser, calibrate, failure::Failure, output};

/// Arguments of `demo`.
#[derive(Args)]
#[command(after_help = "Example:\n\
\x20 handeye demo --out demo")]
pub struct DemoArgs {
    /// Folder for dataset, result and report [default: a folder for temporary files].
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// Open the report in a browser.
    #[arg(long)]
    pub open: bool,
}

/// Name and content of embedded files.
macro_rules! embedded {
    ($($name:literal)*) => {
        &[$(($name, include_bytes!(concat!("../demo/", $name)))),*]
    };
}

const FILES: &[(&str, &[u8])] = embedded! {
    "handeye.toml" "robot.csv" "touches.csv" "truth.json"
    "images/001.png" "images/002.png" "images/003.png" "images/004.png" "images/005.png"
    "images/006.png" "images/007.png" "images/008.png" "images/009.png" "images/010.png"
    "images/011.png" "images/012.png" "images/place-1.png" "images/place-2.png"
    "scans/001.png" "scans/002.png" "scans/003.png" "scans/004.png" "scans/005.png"
    "scans/006.png" "scans/007.png" "scans/008.png" "scans/009.png" "scans/010.png"
    "scans/011.png" "scans/012.png" "scans/place-1.png" "scans/place-2.png"
};

#[derive(Deserialize)]
struct Truth {
    mount_from_camera: Pose<Mount, Camera>,
}

/// Distance of the answer from the truth.
#[derive(Serialize)]
struct Off {
    translation_mm: f64,
    rotation_deg: f64,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    calibration: &'a Calibration,
    off: Option<Off>,
    dataset: PathBuf,
    report: PathBuf,
}

pub fn run(args: &DemoArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let out = args.out.clone().unwrap_or_else(temporary);
    let folder = out.join("dataset");
    unpack(&folder)?;
    let dataset = Dataset::open(&folder)?;
    let (calibration, session) = calibrate::run_on(&dataset, &Config::default(), global)?;
    let still = GlobalArgs { quiet: true, ..global.clone() };
    let page = dataset_html(&dataset, &calibration, &session);
    let results = calibrate::result_folder(&out)?;
    let report =
        calibrate::write((&out, &results), &dataset, (&calibration, &page), vec![], &still)?;
    tell(
        &Told {
            calibration: &calibration,
            off: off(&calibration)?,
            dataset: folder,
            report: report.clone(),
        },
        global,
    );
    if args.open {
        browser::open(&report);
    }
    Ok(calibration.exit_code())
}

/// A folder of this user's own: others may have run the demo on the same machine.
fn temporary() -> PathBuf {
    temporary_folder().join(format!("handeye-demo-{}", process()))
}

fn unpack(folder: &Path) -> Result<(), Failure> {
    for (name, content) in FILES {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(|e| Failure::no_folder(parent, e))?;
        write_atomically(&path, content)?;
    }
    Ok(())
}

/// How far the answer is from the truth.
fn off(calibration: &Calibration) -> Result<Option<Off>, Failure> {
    let truth = FILES.iter().find(|(name, _)| *name == "truth.json").map_or(&[][..], |f| f.1);
    let truth: Truth =
        serde_json::from_slice(truth).map_err(|e| Failure::input("the demo's truth", e))?;
    Ok(calibration.hand_eye.mount_from_camera.map(|found| Off {
        translation_mm: found.distance_to(&truth.mount_from_camera) * 1e3,
        rotation_deg: found.angle_to(&truth.mount_from_camera).to_degrees(),
    }))
}

fn tell(told: &Told, global: &GlobalArgs) {
    if global.json {
        return output::json(told);
    }
    output::warnings(told.calibration, global);
    output::summary(told.calibration);
    let mut text = String::new();
    if let Some(off) = &told.off {
        text = format!(
            "\nthe truth is known here: off by {:.2} mm, {:.3} deg\n",
            off.translation_mm, off.rotation_deg
        );
    }
    let (dataset, report) = (told.dataset.display(), told.report.display());
    output::print(&format!("{text}dataset  {dataset}\nreport   {report}\n"));
}
