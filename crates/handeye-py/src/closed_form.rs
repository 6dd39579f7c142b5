//! Published closed forms, as published.

use handeye::{HandEye, Method, Pose, PosePair, Setup, solve};
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::{arrays, errors};

/// Poses of the robot and of the target, one by one the same moments.
pub fn pairs(
    setup: Setup,
    robot: &[(nalgebra::Matrix3<f64>, nalgebra::Vector3<f64>)],
    camera: &[(nalgebra::Matrix3<f64>, nalgebra::Vector3<f64>)],
) -> Vec<PosePair> {
    let pair = |((r, t), (q, s)): (&(_, _), &(_, _))| PosePair {
        anchor_from_mount: setup.anchor_from_mount(Pose::from_parts(r, *t)),
        camera_from_target: Pose::from_parts(q, *s),
    };
    robot.iter().zip(camera).map(pair).collect()
}

/// `eye-in-hand` or `eye-to-hand`.
pub fn setup(name: &str) -> PyResult<Setup> {
    Setup::from_name(name).ok_or_else(|| {
        errors::input(format!("setup {name:?} is neither \"eye-in-hand\" nor \"eye-to-hand\""))
    })
}

/// The published method of that name.
pub fn method(name: &str) -> PyResult<Method> {
    Method::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Method::ALL.iter().map(|m| m.name()).collect();
        errors::input(format!("no method {name:?}; there are {}", known.join(", ")))
    })
}

/// Refuses lists of different lengths.
pub fn same_length(robot: usize, camera: usize) -> PyResult<()> {
    if robot == camera {
        return Ok(());
    }
    Err(errors::input(format!(
        "{robot} robot poses but {camera} target poses: both lists must have one for each capture"
    )))
}

type Matrices<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

/// `mount_from_camera` and `anchor_from_target`, 4 x 4 each.
#[pyfunction]
pub fn closed_form<'py>(
    py: Python<'py>,
    setup: &str,
    base_from_flange: &Bound<'py, PyAny>,
    camera_from_target: &Bound<'py, PyAny>,
    method: &str,
) -> PyResult<Matrices<'py>> {
    let (setup, method) = (self::setup(setup)?, self::method(method)?);
    let robot = arrays::poses(base_from_flange, "base_from_flange")?;
    let camera = arrays::poses(camera_from_target, "camera_from_target")?;
    same_length(robot.len(), camera.len())?;
    let found = py.detach(|| solve::solve(&pairs(setup, &robot, &camera), method));
    let HandEye { mount_from_camera, anchor_from_target } =
        found.map_err(|error| errors::of_core(&error))?;
    let matrix = |m: nalgebra::Matrix4<f64>| {
        arrays::rows(py, &(0..4).map(|i| (0..4).map(|j| m[(i, j)]).collect()).collect::<Vec<_>>())
    };
    Ok((matrix(mount_from_camera.matrix())?, matrix(anchor_from_target.matrix())?))
}
