//! Calibrations of images, scans and poses that stand in memory.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::Arc,
};

use handeye::{Config, GrayImage, Pose, Scan};
use handeye_io::{
    Dataset, Error, ImageSource, Limits, MemoryCapture, MemoryCell, Place, ScanOptions,
    calibrate::calibrate_dataset, read_image, read_scan, units::LengthUnit,
};
use pyo3::{prelude::*, types::PyString};

use crate::{
    arrays,
    calibration::{Calibrated, check_distances_of, check_ids, noise},
    closed_form::{method, same_length, setup},
    errors,
    images::{picture, target},
    scans::scan,
    working,
};

/// Images and scans as Python has them: arrays, or paths of files.
struct Objects {
    images: BTreeMap<String, Py<PyAny>>,
    scans: BTreeMap<String, Py<PyAny>>,
}

/// The path that an object is, if it is one.
pub fn path(object: &Bound<'_, PyAny>) -> Option<PathBuf> {
    let is_path = object.is_instance_of::<PyString>() || object.hasattr("__fspath__").ok()?;
    is_path.then(|| object.extract().ok()).flatten()
}

/// Scans are in metres where their files do not say it.
pub fn in_metres() -> ScanOptions {
    ScanOptions { length_unit: Some(LengthUnit::Metre), ..Default::default() }
}

/// What the object of a capture is: read from its file without the interpreter, or taken out of its array.
fn taken<T>(
    capture: &str,
    objects: &BTreeMap<String, Py<PyAny>>,
    from_file: impl FnOnce(&PathBuf) -> Result<T, Error>,
    from_array: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>,
) -> Result<T, Error> {
    let unusable = |what: String| {
        let place = Place::file(Path::new(&format!("capture {capture}")));
        Error::Unusable { place, what }
    };
    let object = objects.get(capture).ok_or_else(|| unusable("is not there".into()))?;
    let file = Python::attach(|py| path(object.bind(py)));
    match file {
        Some(file) => from_file(&file),
        None => Python::attach(|py| {
            from_array(object.bind(py)).map_err(|error| unusable(error.value(py).to_string()))
        }),
    }
}

impl ImageSource for Objects {
    fn image(&self, capture: &str) -> Result<GrayImage, Error> {
        taken(capture, &self.images, |file| read_image(file, None), picture)
    }

    fn scan(&self, capture: &str) -> Result<Scan, Error> {
        let read = |file: &PathBuf| read_scan(file, &in_metres());
        taken(capture, &self.scans, read, |array| scan(array, "the scan"))
    }
}

/// From images, and scans where there are some, with a pose of the robot for each.
#[pyfunction]
#[pyo3(signature = (setup_name, base_from_flange, images, *, ids, scans=None, target_json=None, target_file=None, camera_json=None, method_name=None, robot_rotation_deg=None, robot_position_mm=None, max_error_mm=None, progress=None))]
#[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
pub fn calibrate_captures(
    py: Python<'_>,
    setup_name: &str,
    base_from_flange: &Bound<'_, PyAny>,
    images: Vec<Py<PyAny>>,
    ids: Vec<String>,
    scans: Option<Vec<Option<Py<PyAny>>>>,
    target_json: Option<&str>,
    target_file: Option<PathBuf>,
    camera_json: Option<&str>,
    method_name: Option<&str>,
    robot_rotation_deg: Option<f64>,
    robot_position_mm: Option<f64>,
    max_error_mm: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Calibrated> {
    let robot = arrays::poses(base_from_flange, "base_from_flange")?;
    same_length(robot.len(), images.len())?;
    check_ids(&ids, robot.len())?;
    check_distances_of(&robot)?;
    let scans = scans.unwrap_or_else(|| robot.iter().map(|_| None).collect());
    if scans.len() != images.len() {
        let what = format!("{} scans for {} images", scans.len(), images.len());
        return Err(errors::input(what));
    }
    if max_error_mm.is_some_and(|mm| !(mm > 0.0)) {
        return Err(errors::input("max_error_mm must be positive"));
    }
    let cell = MemoryCell {
        setup: setup(setup_name)?,
        target: target(py, target_json, target_file)?,
        camera_json,
        noise: noise(robot_rotation_deg, robot_position_mm)?,
        limits: Limits { max_error: max_error_mm.map(|mm| mm * 1e-3) },
    };
    let captures = ids.iter().zip(&robot).zip(&scans).map(|((id, (r, t)), scan)| MemoryCapture {
        id: id.clone(),
        base_from_flange: Pose::from_parts(r, *t),
        has_image: true,
        has_scan: scan.is_some(),
    });
    let captures = captures.collect();
    let scans = ids.iter().cloned().zip(scans).filter_map(|(id, scan)| Some((id, scan?)));
    let scans = scans.collect();
    let pictures = Arc::new(Objects { images: ids.into_iter().zip(images).collect(), scans });
    let config = Config { method: method_name.map(method).transpose()?, ..Config::default() };
    let dataset = py
        .detach(|| Dataset::in_memory(cell, captures, pictures))
        .map_err(|error| errors::of_files(py, &error))?;
    let work = move |tell: &(dyn Fn(usize, usize) + Sync)| {
        let (calibration, session) = calibrate_dataset(&dataset, &config, tell)?;
        Ok(Calibrated::of(calibration, Some((dataset, session))))
    };
    working::run(py, progress.as_ref(), work)?.map_err(|error| errors::of_files(py, &error))
}
