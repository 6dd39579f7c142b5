//! Calibrations: from poses, from a folder, from their own JSON.

use std::path::PathBuf;

use handeye::{
    Base, Calibration, Config, Flange, Observation, Pose, RelativeMotion, Session, Stamped,
    Streams, estimate::noise::KnownNoise, model::session::KnownPosition,
};
use handeye_io::{
    Dataset,
    calibrate::{calibrate_dataset, write_results},
    export::{self, CameraPose, Format},
    report::{calibration_html, dataset_html},
};
use nalgebra::{Matrix3, Vector3};
use pyo3::{exceptions::PyRuntimeError, prelude::*, types::PyBytes};

use crate::{
    arrays,
    closed_form::{method, same_length, setup},
    errors, working,
};

/// A pose (4 x 4, row by row), its covariance (6 x 6), and whether the robot was seen near there.
type Corrected = (Vec<f64>, Vec<f64>, bool);

/// A result, with what its report shows beside it.
#[pyclass(frozen, module = "handeye._core")]
pub struct Calibrated {
    calibration: Calibration,
    measured: Option<(Dataset, Session)>,
}

impl Calibrated {
    /// A result, with what its report shows beside it.
    pub fn of(calibration: Calibration, measured: Option<(Dataset, Session)>) -> Self {
        Self { calibration, measured }
    }
}

#[pymethods]
impl Calibrated {
    /// From the JSON that `json` gives.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let calibration = serde_json::from_str(text)
            .map_err(|error| errors::input(format!("no calibration of handeye: {error}")))?;
        Ok(Self { calibration, measured: None })
    }

    /// As in `calibration.json`.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.calibration)
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }

    /// The report as one page.
    fn report(&self, py: Python<'_>, title: &str) -> String {
        py.detach(|| match &self.measured {
            Some((dataset, session)) => dataset_html(dataset, &self.calibration, session),
            None => calibration_html(title, &self.calibration),
        })
    }

    /// Writes `calibration.json`, `report.html` and, where one was found, the corrected arm into a folder.
    fn write(&self, py: Python<'_>, out: PathBuf, title: &str) -> PyResult<PathBuf> {
        let page = self.report(py, title);
        let dataset = self.measured.as_ref().map(|(dataset, _)| dataset);
        write_results(&out, dataset, &self.calibration, &page).map_err(|e| errors::of_files(py, &e))
    }

    /// Poses of the flange, corrected.
    fn compensate(
        &self,
        base_from_flange: &Bound<'_, PyAny>,
        reported: bool,
    ) -> PyResult<Vec<Corrected>> {
        let model = self.calibration.correction().map_err(errors::NotDetermined::new_err)?;
        let one = |(r, t): &(Matrix3<f64>, Vector3<f64>)| {
            let pose = Pose::from_parts(r, *t);
            let found = if reported { model.actual(&pose) } else { model.command(&pose) };
            let flat = found.base_from_flange.matrix().transpose().as_slice().to_vec();
            (flat, found.covariance.as_slice().to_vec(), found.is_inside())
        };
        Ok(arrays::poses(base_from_flange, "base_from_flange")?.iter().map(one).collect())
    }

    /// The usual name and the content of a file in another program's format.
    fn export<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        child: Option<&str>,
    ) -> PyResult<(String, Bound<'py, PyBytes>)> {
        let named = Format::named(format)
            .map_err(|there| errors::input(format!("no format {format:?}: {there}")))?;
        let camera = CameraPose::of(&self.calibration, None, child, std::slice::from_ref(&named))
            .map_err(errors::input)?;
        let Some(camera) = camera else {
            return Err(errors::NotDetermined::new_err(self.calibration.reasons.join("; ")));
        };
        let content = export::render(&camera, &named);
        Ok((named.file_name(&self.calibration.name), PyBytes::new(py, &content)))
    }
}

/// What a user says of the robot's noise.
pub fn noise(
    robot_rotation_deg: Option<f64>,
    robot_position_mm: Option<f64>,
) -> PyResult<KnownNoise> {
    for (name, value) in
        [("robot_rotation_deg", robot_rotation_deg), ("robot_position_mm", robot_position_mm)]
    {
        if value.is_some_and(|v| !(v > 0.0)) {
            return Err(errors::input(format!(
                "{name} must be positive; leave it out where it is not known"
            )));
        }
    }
    Ok(KnownNoise {
        robot_rotation_rad: robot_rotation_deg.map(f64::to_radians),
        robot_position_m: robot_position_mm.map(|mm| mm * 1e-3),
        touch_m: None,
        tip_m: None,
    })
}

/// The camera's place along one direction of the mount: the direction, mm, and its standard deviation, mm.
type Known = ([f64; 3], f64, f64);

fn known_position((axis, value_mm, sigma_mm): Known) -> PyResult<KnownPosition> {
    let axis = Vector3::from(axis).try_normalize(1e-9).filter(|a| a.norm().is_finite());
    let axis = axis.ok_or_else(|| errors::input("the axis of known_position has no length"))?;
    let is_known = value_mm.is_finite() && sigma_mm.is_finite() && sigma_mm > 0.0;
    if !is_known {
        return Err(errors::input("known_position needs a position and a standard deviation, mm"));
    }
    Ok(KnownPosition { axis, value_m: value_mm * 1e-3, sigma_m: sigma_mm * 1e-3 })
}

/// From poses of the same moments.
#[pyfunction]
#[pyo3(signature = (setup_name, base_from_flange, camera_from_target, *, ids, method_name=None, robot_rotation_deg=None, robot_position_mm=None, unknown_scale=false, known=None, motions_m=None))]
#[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
pub fn solve(
    py: Python<'_>,
    setup_name: &str,
    base_from_flange: &Bound<'_, PyAny>,
    camera_from_target: &Bound<'_, PyAny>,
    ids: Vec<String>,
    method_name: Option<&str>,
    robot_rotation_deg: Option<f64>,
    robot_position_mm: Option<f64>,
    unknown_scale: bool,
    known: Option<Known>,
    motions_m: Option<f64>,
) -> PyResult<Calibrated> {
    let robot = arrays::poses(base_from_flange, "base_from_flange")?;
    let camera = arrays::poses(camera_from_target, "camera_from_target")?;
    same_length(robot.len(), camera.len())?;
    check_ids(&ids, robot.len())?;
    let poses = ids.into_iter().zip(robot).zip(camera);
    let setup = setup(setup_name)?;
    let mut session = if let Some(distance_m) = motions_m {
        let motion = |((id, (r, t)), (q, s)): ((String, (_, _)), (_, _))| RelativeMotion {
            id,
            mount_motion: Pose::from_parts(&r, t),
            camera_motion: Pose::from_parts(&q, s),
        };
        Session::of_motions(setup, poses.map(motion).collect(), distance_m)
    } else {
        let observation = |((id, (r, t)), (q, s)): ((String, (_, _)), (_, _))| {
            Observation::bare(id, Pose::from_parts(&r, t), Pose::from_parts(&q, s))
        };
        let session = Session::of_captures(setup, poses.map(observation).collect());
        Session { unknown_scale, in_sequence: true, ..session }
    };
    session.known_position = known.map(known_position).transpose()?;
    check_distances(&session)?;
    let config = Config {
        method: method_name.map(method).transpose()?,
        known: noise(robot_rotation_deg, robot_position_mm)?,
        ..Config::default()
    };
    let work = move || handeye::calibrate(&session, &config);
    let calibration = working::compute(py, work)?.map_err(|error| errors::of_core(&error))?;
    Ok(Calibrated { calibration, measured: None })
}

/// Refuses names that are too few or many, or not all different.
pub fn check_ids(ids: &[String], poses: usize) -> PyResult<()> {
    if ids.len() != poses {
        return Err(errors::input(format!("{} ids for {poses} poses", ids.len())));
    }
    let mut sorted: Vec<&String> = ids.iter().collect();
    sorted.sort();
    match sorted.windows(2).find(|two| two[0] == two[1]) {
        Some(twice) => Err(errors::input(format!("the id {:?} is there twice", twice[0]))),
        None => Ok(()),
    }
}

/// Refuses poses that no robot has.
pub fn check_distances_of(robot: &[(Matrix3<f64>, Vector3<f64>)]) -> PyResult<()> {
    let far = |(r, t): &(_, _)| Pose::<Base, Flange>::from_parts(r, *t).is_too_far();
    match robot.iter().position(far) {
        Some(k) => Err(errors::input(format!("base_from_flange[{k}] lies beyond any robot"))),
        None => Ok(()),
    }
}

fn check_distances(session: &Session) -> PyResult<()> {
    let far = session.observations.iter().find(|o| {
        o.base_from_flange.is_too_far()
            || o.candidates.iter().any(|c| c.camera_from_target.is_too_far())
    });
    match far {
        Some(o) => {
            Err(errors::input(format!("pose {} lies beyond any robot or camera", o.capture)))
        }
        None => Ok(()),
    }
}

/// From two streams of stamped poses, whose clocks may differ.
#[pyfunction]
#[pyo3(signature = (setup_name, robot_times, base_from_flange, camera_times, camera_from_target, *, unknown_scale=false))]
pub fn solve_streams(
    py: Python<'_>,
    setup_name: &str,
    robot_times: Vec<f64>,
    base_from_flange: &Bound<'_, PyAny>,
    camera_times: Vec<f64>,
    camera_from_target: &Bound<'_, PyAny>,
    unknown_scale: bool,
) -> PyResult<Calibrated> {
    let robot = arrays::poses(base_from_flange, "base_from_flange")?;
    let camera = arrays::poses(camera_from_target, "camera_from_target")?;
    for (times, poses, name) in
        [(robot_times.len(), robot.len(), "robot"), (camera_times.len(), camera.len(), "camera")]
    {
        if times != poses {
            return Err(errors::input(format!("{times} {name} times for {poses} {name} poses")));
        }
    }
    check_distances_of(&robot)?;
    let robot = robot_times.into_iter().zip(robot);
    let camera = camera_times.into_iter().zip(camera);
    let streams = Streams {
        setup: setup(setup_name)?,
        robot: robot
            .map(|(time_s, (r, t))| Stamped { time_s, pose: Pose::from_parts(&r, t) })
            .collect(),
        camera: camera
            .map(|(time_s, (r, t))| Stamped { time_s, pose: Pose::from_parts(&r, t) })
            .collect(),
        unknown_scale,
    };
    if let Some(k) = streams.camera.iter().position(|s| s.pose.is_too_far()) {
        return Err(errors::input(format!("camera_from_target[{k}] lies beyond any camera")));
    }
    let work = move || handeye::calibrate(&streams.session(), &Config::default());
    let calibration = working::compute(py, work)?.map_err(|error| errors::of_core(&error))?;
    Ok(Calibrated { calibration, measured: None })
}

/// From a folder with its manifest.
#[pyfunction]
#[pyo3(signature = (dataset, *, root=None, method_name=None, progress=None))]
pub fn calibrate(
    py: Python<'_>,
    dataset: PathBuf,
    root: Option<PathBuf>,
    method_name: Option<&str>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Calibrated> {
    let config = Config { method: method_name.map(method).transpose()?, ..Config::default() };
    let work = move |tell: &(dyn Fn(usize, usize) + Sync)| {
        let dataset = match &root {
            Some(root) => Dataset::open_with_root(&dataset, root)?,
            None => Dataset::open(&dataset)?,
        };
        let (calibration, session) = calibrate_dataset(&dataset, &config, tell)?;
        Ok(Calibrated { calibration, measured: Some((dataset, session)) })
    };
    working::run(py, progress.as_ref(), work)?.map_err(|error| errors::of_files(py, &error))
}
