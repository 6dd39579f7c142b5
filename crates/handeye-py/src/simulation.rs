//! Datasets whose truth is known.

use std::path::PathBuf;

use handeye::{
    Intrinsics, TargetModel,
    simulate::{ArmErrors, Cell, CellNoise, DepthSensor, Optics},
};
use handeye_io::simulated::{self, ScanFormat, Writing};
use pyo3::prelude::*;

use crate::{closed_form::setup, errors, images, working};

/// Most captures: more are mistakes.
const MOST: usize = 999;
/// Largest side of an image, px.
const LARGEST_PX: u32 = 10_000;
/// Focal length in image widths.
const FOCAL: f64 = 0.9375;

/// Writes a dataset and its truth; names of the files.
#[pyfunction]
#[pyo3(signature = (out, setup_name, *, seed=1, captures=15, width=1920, height=1200, target_json=None, images=true, scans=false, arm=false, exact=false, force=false))]
#[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
pub fn simulate(
    py: Python<'_>,
    out: PathBuf,
    setup_name: &str,
    seed: u64,
    captures: usize,
    width: u32,
    height: u32,
    target_json: Option<&str>,
    images: bool,
    scans: bool,
    arm: bool,
    exact: bool,
    force: bool,
) -> PyResult<Vec<String>> {
    if !(1..=MOST).contains(&captures) {
        return Err(errors::input(format!("captures must be between 1 and {MOST}")));
    }
    if !(1..=LARGEST_PX).contains(&width) || !(1..=LARGEST_PX).contains(&height) {
        return Err(errors::input(format!("images have 1 to {LARGEST_PX} pixels a side")));
    }
    let target = match target_json {
        None => TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 },
        Some(text) => images::target_from_json(text)?,
    };
    let usual = Cell::new(setup(setup_name)?, seed);
    let cell = Cell { target, intrinsics: camera(width, height), captures, ..usual };
    let cell = with_noise(cell, exact, scans);
    let cell = if arm { with_arm(cell, exact) } else { cell };
    if let Some(foreign) = simulated::foreign(&out).filter(|_| !force) {
        return Err(errors::input(format!(
            "{}: was not written by `simulate`, or was edited since: name another folder, or say force=True",
            foreign.display()
        )));
    }
    let work = move |_: &(dyn Fn(usize, usize) + Sync)| {
        let recording = cell.record(seed).map_err(Failed::Core)?;
        let writing = Writing { images, scans: ScanFormat::Ply };
        simulated::write(&recording, &out, writing).map_err(Failed::Files)
    };
    working::run(py, None, work)?.map_err(|error| match error {
        Failed::Core(error) => errors::of_core(&error),
        Failed::Files(error) => errors::of_files(py, &error),
    })
}

fn camera(width: u32, height: u32) -> Intrinsics {
    let (w, h) = (f64::from(width), f64::from(height));
    Intrinsics::pinhole(width, height, FOCAL * w, FOCAL * w, 0.5 * (w - 1.0), 0.5 * (h - 1.0))
}

/// The usual noise, or none of anything; with a depth sensor, or without.
fn with_noise(cell: Cell, exact: bool, scans: bool) -> Cell {
    let sensor = DepthSensor::default();
    if !exact {
        return Cell { depth: scans.then_some(sensor), ..cell };
    }
    Cell {
        noise: CellNoise::NONE,
        optics: Optics { noise: 0.0, ..cell.optics },
        depth: scans.then_some(DepthSensor { sigma_at_1m: 0.0, ..sensor }),
        ..cell
    }
}

/// With an arm that gives joint values; its errors take the place of those of a robot that only gives poses.
fn with_arm(cell: Cell, exact: bool) -> Cell {
    let noise = CellNoise { robot_absolute_m: 0.0, robot_absolute_rad: 0.0, ..cell.noise };
    Cell { arm: Some(if exact { ArmErrors::NONE } else { ArmErrors::default() }), noise, ..cell }
}

/// Where it went wrong.
enum Failed {
    Core(handeye::Error),
    Files(handeye_io::Error),
}
