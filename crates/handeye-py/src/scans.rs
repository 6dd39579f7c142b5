//! Registration of scans.

use handeye::{
    Scan, Verdict,
    calibration::rows,
    register::{self as registration, DenseConfig, DenseMethod, Stop},
};
use nalgebra::{Isometry3, Translation3};
use pyo3::{prelude::*, types::PyDict};

use crate::{arrays, errors, working};

/// Where the source lies in the target, with all that is known of it.
#[pyfunction]
#[pyo3(signature = (source, target, *, initial=None, method="auto", max_distance_m=0.05, max_iterations=60, is_global=false, threads=1))]
#[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
pub fn register<'py>(
    py: Python<'py>,
    source: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
    initial: Option<&Bound<'py, PyAny>>,
    method: &str,
    max_distance_m: f64,
    max_iterations: usize,
    is_global: bool,
    threads: usize,
) -> PyResult<Bound<'py, PyDict>> {
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
    let start = match initial {
        None => Isometry3::identity(),
        Some(matrix) => {
            let (r, t) = arrays::pose(matrix, "initial")?;
            let r = handeye::Pose::<(), ()>::from_parts(&r, t).iso().rotation;
            Isometry3::from_parts(Translation3::from(t), r)
        }
    };
    let found =
        working::run(py, None, move |_| registration::register(&source, &target, &start, &config))?
            .map_err(|error| errors::of_core(&error))?;
    let answer = PyDict::new(py);
    let matrix = found.target_from_source.to_homogeneous();
    let matrix: Vec<Vec<f64>> = (0..4).map(|i| (0..4).map(|j| matrix[(i, j)]).collect()).collect();
    answer.set_item("target_from_source", arrays::rows(py, &matrix)?)?;
    let covariance = found.covariance.as_ref().map(|c| rows(c).map(Vec::from).to_vec());
    answer.set_item("covariance", covariance.map(|c| arrays::rows(py, &c)).transpose()?)?;
    answer.set_item(
        "verdict",
        match found.verdict {
            Verdict::Accepted => "accepted",
            Verdict::Rejected => "rejected",
            Verdict::Undetermined => "undetermined",
        },
    )?;
    answer.set_item("reasons", found.reasons)?;
    answer.set_item("undetermined", found.undetermined)?;
    answer.set_item("iterations", found.iterations)?;
    answer.set_item(
        "stop",
        match found.stop {
            Stop::Converged => "converged",
            Stop::Fitness => "fitness",
            Stop::NoMatches => "no-matches",
            Stop::MaxIterations => "max-iterations",
        },
    )?;
    answer.set_item("inlier_fraction", found.inlier_fraction)?;
    answer.set_item("agreement", found.agreement)?;
    answer.set_item("rms_m", found.rms_m)?;
    answer.set_item("residual_sigma", found.sigma)?;
    answer.set_item("size_ratio", found.size.map(|s| s.ratio))?;
    answer.set_item("size_sigma", found.size.map(|s| s.sigma))?;
    Ok(answer)
}

fn scan(array: &Bound<'_, PyAny>, name: &str) -> PyResult<Scan> {
    let (columns, rows, points) = arrays::points(array, name)?;
    Scan::new(columns, rows, points).ok_or_else(|| errors::input(format!("{name} has no points")))
}

fn method(name: &str) -> PyResult<DenseMethod> {
    Ok(match name {
        "auto" => DenseMethod::Auto,
        "point-to-point" => DenseMethod::PointToPoint,
        "point-to-plane" => DenseMethod::PointToPlane,
        "gicp" => DenseMethod::PlaneToPlane,
        _ => {
            let there = "auto, point-to-point, point-to-plane, gicp";
            return Err(errors::input(format!("no method {name:?}; there are {there}")));
        }
    })
}
