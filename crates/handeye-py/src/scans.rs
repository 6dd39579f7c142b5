//! Registration of scans.

use handeye::{
    Pose, Scan,
    register::{self as registration, DenseConfig, DenseMethod},
};
use handeye_io::RegistrationResult;
use nalgebra::Isometry3;
use pyo3::{exceptions::PyRuntimeError, prelude::*};

use crate::{arrays, errors, working};

/// Where the source lies in the target, as JSON.
#[pyfunction]
#[pyo3(signature = (source, target, *, initial=None, method="symmetric", max_distance_m=0.05, max_iterations=60, is_global=false, threads=1))]
#[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
pub fn register(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    target: &Bound<'_, PyAny>,
    initial: Option<&Bound<'_, PyAny>>,
    method: &str,
    max_distance_m: f64,
    max_iterations: usize,
    is_global: bool,
    threads: usize,
) -> PyResult<String> {
    if !(max_distance_m > 0.0 && max_distance_m.is_finite()) || max_iterations == 0 {
        return Err(errors::input("max_distance_m and max_iterations must be positive"));
    }
    let config = DenseConfig {
        method: self::method(method)?,
        max_correspondence_distance_m: max_distance_m,
        max_iterations,
        global: is_global,
        threads: threads.max(1),
        ..DenseConfig::default()
    };
    let (source, target) = (scan(source, "source")?, scan(target, "target")?);
    let start = initial.map_or(Ok(Isometry3::identity()), |matrix| {
        let (r, t) = arrays::pose(matrix, "initial")?;
        PyResult::Ok(*Pose::<(), ()>::from_parts(&r, t).iso())
    })?;
    let work = move || registration::register(&source, &target, &start, &config);
    let found = working::compute(py, work)?.map_err(|error| errors::of_core(&error))?;
    serde_json::to_string(&RegistrationResult::from(&found))
        .map_err(|error| PyRuntimeError::new_err(error.to_string()))
}

/// Points, N x 3 or as the camera has them, m.
pub fn scan(array: &Bound<'_, PyAny>, name: &str) -> PyResult<Scan> {
    let (columns, rows, points) = arrays::points(array, name)?;
    Scan::new(columns, rows, points).ok_or_else(|| errors::input(format!("{name} has no points")))
}

fn method(name: &str) -> PyResult<DenseMethod> {
    DenseMethod::from_name(name).ok_or_else(|| {
        let there = DenseMethod::ALL.map(DenseMethod::name).join(", ");
        errors::input(format!("no method {name:?}; there are {there}"))
    })
}
