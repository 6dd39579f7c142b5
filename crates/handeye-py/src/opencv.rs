//! What OpenCV's two functions take and give, with a look at the answer before it is given.
//!
//! The answer is that of the method as published. Where its misfit is small and even, and the rotations are about
//! several axes, it is returned at once. Everything else is held against the recommended estimator, which knows its
//! uncertainty, and refused where the two contradict each other, or the estimator refuses the data.

use std::collections::BTreeMap;

use handeye::{
    Base, Calibration, Camera, Config, Flange, HandEye, Method, Mount, Observation, Pose, PosePair,
    Session, Setup, Target, Verdict, calibrate_sequence, calibration, lie, linalg::median, solve,
};
use nalgebra::{Matrix3, Matrix6, Vector3};
use numpy::PyArray2;
use pyo3::{prelude::*, types::PyIterator};

use crate::{
    arrays,
    errors::{self, NotDetermined, Rejected},
};

/// Names and numbers of OpenCV's methods.
const HAND_EYE: [Method; 5] = [
    Method::TsaiLenz,
    Method::ParkMartin,
    Method::HoraudDornaika,
    Method::Andreff,
    Method::Daniilidis,
];
/// Those of its other function.
const ROBOT_WORLD: [Method; 2] = [Method::Shah, Method::Li];
/// With fewer poses the misfit says little.
const FEW: usize = 6;
/// Misfits (root mean square) up to which nothing is wrong: rad, and share of the distance to the target.
const SMALL: (f64, f64) = (5e-3, 5e-3);
/// One pose's misfit is uneven when it is so many times the median one, ...
const UNEVEN: f64 = 6.0;
/// ... and more than rounding.
const ROUNDING: f64 = 1e-7;
/// Rotations about other axes than the first one, rad, below which they count as about one.
const SEVERAL_AXES: f64 = 0.1;
/// Lengths of a cell beyond this are in millimetres.
const LARGEST_M: f64 = 20.0;
/// Answers are the same within so many standard deviations.
const SAME: f64 = 6.0;
/// Predicted errors above this are told, mm.
const INACCURATE_MM: f64 = 10.0;
/// Nobody's answer is better than this: rad, and share of the cell's size.
const BEST: f64 = 1e-6;

type Matrix<'py> = Bound<'py, PyArray2<f64>>;
type HandEyeArrays<'py> = (Matrix<'py>, Matrix<'py>, Vec<String>);
type RobotWorldArrays<'py> = (Matrix<'py>, Matrix<'py>, Matrix<'py>, Matrix<'py>, Vec<String>);

/// `R_cam2gripper`, `t_cam2gripper`, and warnings.
#[pyfunction]
pub fn hand_eye<'py>(
    py: Python<'py>,
    r_gripper2base: &Bound<'py, PyAny>,
    t_gripper2base: &Bound<'py, PyAny>,
    r_target2cam: &Bound<'py, PyAny>,
    t_target2cam: &Bound<'py, PyAny>,
    method: usize,
) -> PyResult<HandEyeArrays<'py>> {
    let method = numbered(&HAND_EYE, method)?;
    let robot = poses(r_gripper2base, t_gripper2base, ["R_gripper2base", "t_gripper2base"])?;
    let camera = poses(r_target2cam, t_target2cam, ["R_target2cam", "t_target2cam"])?;
    same_length([robot.len(), camera.len()], ["R_gripper2base", "R_target2cam"])?;
    let pair = |(a, b): (&Parts, &Parts)| PosePair {
        anchor_from_mount: Pose::from_parts(&a.0, a.1),
        camera_from_target: Pose::from_parts(&b.0, b.1),
    };
    let pairs: Vec<PosePair> = robot.iter().zip(&camera).map(pair).collect();
    let (found, warnings) = Cell { equations: &pairs, is_reversed: false }.solved(py, method)?;
    let x = found.mount_from_camera;
    Ok((
        arrays::of_rotation(py, &x.rotation())?,
        arrays::of_translation(py, &x.translation())?,
        warnings,
    ))
}

/// `R_base2world`, `t_base2world`, `R_gripper2cam`, `t_gripper2cam`, and warnings.
#[pyfunction]
pub fn robot_world_hand_eye<'py>(
    py: Python<'py>,
    r_world2cam: &Bound<'py, PyAny>,
    t_world2cam: &Bound<'py, PyAny>,
    r_base2gripper: &Bound<'py, PyAny>,
    t_base2gripper: &Bound<'py, PyAny>,
    method: usize,
) -> PyResult<RobotWorldArrays<'py>> {
    let method = numbered(&ROBOT_WORLD, method)?;
    let camera = poses(r_world2cam, t_world2cam, ["R_world2cam", "t_world2cam"])?;
    let robot = poses(r_base2gripper, t_base2gripper, ["R_base2gripper", "t_base2gripper"])?;
    same_length([camera.len(), robot.len()], ["R_world2cam", "R_base2gripper"])?;
    // world2cam base2world = gripper2cam base2gripper, as OpenCV has it
    let equation = |(a, b): (&Parts, &Parts)| PosePair {
        anchor_from_mount: Pose::from_parts(&a.0, a.1),
        camera_from_target: Pose::from_parts(&b.0, b.1).inverse(),
    };
    let equations: Vec<PosePair> = camera.iter().zip(&robot).map(equation).collect();
    let cell = Cell { equations: &equations, is_reversed: true };
    let (found, warnings) = cell.solved(py, method)?;
    let (z, x) = (found.mount_from_camera, found.anchor_from_target);
    Ok((
        arrays::of_rotation(py, &z.rotation())?,
        arrays::of_translation(py, &z.translation())?,
        arrays::of_rotation(py, &x.rotation())?,
        arrays::of_translation(py, &x.translation())?,
        warnings,
    ))
}

fn numbered(methods: &[Method], number: usize) -> PyResult<Method> {
    methods.get(number).copied().ok_or_else(|| {
        errors::input(format!(
            "method {number} is none of OpenCV's: there are 0 to {}",
            methods.len() - 1
        ))
    })
}

/// A rotation and a translation.
type Parts = (Matrix3<f64>, Vector3<f64>);

fn poses(
    rotations: &Bound<'_, PyAny>,
    translations: &Bound<'_, PyAny>,
    names: [&str; 2],
) -> PyResult<Vec<Parts>> {
    let (mut r, mut t) = (vec![], vec![]);
    for (k, item) in items(rotations, names[0])?.enumerate() {
        r.push(arrays::rotation(&item?, names[0], k)?);
    }
    for (k, item) in items(translations, names[1])?.enumerate() {
        t.push(arrays::translation(&item?, names[1], k)?);
    }
    same_length([r.len(), t.len()], names)?;
    Ok(r.into_iter().zip(t).collect())
}

fn items<'py>(list: &Bound<'py, PyAny>, name: &str) -> PyResult<Bound<'py, PyIterator>> {
    let items = list.try_iter();
    items.map_err(|_| errors::input(format!("{name} is no list of arrays, one for each pose")))
}

fn same_length(lengths: [usize; 2], names: [&str; 2]) -> PyResult<()> {
    let [a, b] = lengths;
    if a == b {
        return Ok(());
    }
    Err(errors::input(format!(
        "{} has {a} poses but {} has {b}: one of each belongs to every picture",
        names[0], names[1]
    )))
}

/// Equations `A X = Y B`, and which side of them the robot is on.
#[derive(Clone, Copy)]
struct Cell<'a> {
    equations: &'a [PosePair],
    /// `A` is the target in the camera, and `B` the base in the gripper.
    is_reversed: bool,
}

impl Cell<'_> {
    fn solved(self, py: Python<'_>, method: Method) -> PyResult<(HandEye, Vec<String>)> {
        py.detach(|| {
            let found = solve::solve(self.equations, method);
            match &found {
                Ok(found) if self.is_plain(found) => return Ok((*found, vec![])),
                // what the estimator says of the same data is clearer
                Err(handeye::Error::NotFinite { .. } | handeye::Error::TooFewPoses { .. })
                | Ok(_) => {}
                Err(_) => drop(self.examined(None, method)?),
            }
            let found = found.map_err(|error| errors::of_core(&error))?;
            let warnings = self.examined(Some(&found), method)?;
            Ok((found, warnings))
        })
    }

    /// Whether an answer fits well and evenly, and rotations are about several axes.
    fn is_plain(self, found: &HandEye) -> bool {
        let pairs = self.equations;
        if pairs.len() < FEW || turning(pairs) < SEVERAL_AXES {
            return false;
        }
        let errors: Vec<_> = pairs.iter().map(|p| found.loop_error(p)).collect();
        let distance = median(pairs.iter().map(|p| self.seen(p).translation().norm()));
        let is_small_and_even = |all: Vec<f64>, small: f64| {
            let rms = (all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64).sqrt();
            let largest = all.iter().copied().fold(0.0, f64::max);
            rms < small && largest < UNEVEN * median(all) + ROUNDING
        };
        is_small_and_even(errors.iter().map(|e| e.iso().rotation.angle()).collect(), SMALL.0)
            && is_small_and_even(
                errors.iter().map(|e| e.translation().norm() / distance).collect(),
                SMALL.1,
            )
    }

    fn seen(self, pair: &PosePair) -> Pose<Camera, Target> {
        if self.is_reversed { pair.anchor_from_mount.rename() } else { pair.camera_from_target }
    }

    fn reported(self, pair: &PosePair) -> Pose<Base, Flange> {
        if self.is_reversed {
            pair.camera_from_target.rename()
        } else {
            pair.anchor_from_mount.rename()
        }
    }

    /// Warnings, or why the answer is refused.
    fn examined(self, found: Option<&HandEye>, method: Method) -> PyResult<Vec<String>> {
        let size = self.equations.iter().flat_map(|p| {
            [p.anchor_from_mount.translation().amax(), p.camera_from_target.translation().amax()]
        });
        let metre = if size.fold(0.0, f64::max) > LARGEST_M { 1e-3 } else { 1.0 };
        let calibration = self.estimated(metre)?;
        let reasons = || calibration.reasons.join("; ");
        match calibration.verdict {
            Verdict::Accepted => {}
            Verdict::Rejected => return Err(Rejected::new_err(reasons())),
            Verdict::Undetermined => return Err(NotDetermined::new_err(reasons())),
        }
        let left_out = || {
            let which = calibration.rejected.join(", ");
            format!("poses {which} (counted from 0) contradict the others")
        };
        if let Some(found) = found
            && let Some(apart) = apart(&calibration, &self.mount_from_camera(found), metre)
        {
            let why = if calibration.rejected.is_empty() {
                format!(
                    "{} is {apart} from the answer that fits these poses best: take another method, or \
                     handeye.solve",
                    method.name()
                )
            } else {
                format!("{}: leave them out, or take handeye.solve, which does", left_out())
            };
            return Err(Rejected::new_err(why));
        }
        let mut warnings: Vec<String> =
            calibration.warnings.iter().map(|w| w.message.clone()).collect();
        if !calibration.rejected.is_empty() {
            warnings.insert(0, left_out());
        }
        if let Some(tre) = calibration.predicted_tre_mm.filter(|tre| tre.p95 > INACCURATE_MM) {
            let (unit, p95) = if metre == 1.0 { ("m", tre.p95 * 1e-3) } else { ("mm", tre.p95) };
            warnings.insert(
                0,
                format!("the predicted error (95 %) is {p95:.3} {unit}: add poses with more tilt"),
            );
        }
        Ok(warnings)
    }

    /// Where the camera sits on the gripper.
    fn mount_from_camera(self, found: &HandEye) -> Pose<Mount, Camera> {
        if self.is_reversed {
            found.anchor_from_target.inverse().rename()
        } else {
            found.mount_from_camera
        }
    }

    fn estimated(self, metre: f64) -> PyResult<Calibration> {
        let observation = |(k, p): (usize, &PosePair)| {
            let (robot, seen) = (self.reported(p).farther(metre), self.seen(p).farther(metre));
            Observation::bare(k.to_string(), robot, seen)
        };
        let observations = self.equations.iter().enumerate().map(observation).collect();
        let session = Session::of_captures(Setup::EyeInHand, observations);
        // how good is good enough, a script without a job does not say
        let config = Config { max_error_mm: Some(f64::INFINITY), ..Config::default() };
        calibrate_sequence(&session, &BTreeMap::new(), &config)
            .map_err(|error| errors::of_core(&error))
    }
}

/// Spread of the rotations about the second of their axes, rad.
fn turning(pairs: &[PosePair]) -> f64 {
    let first = &pairs[0].anchor_from_mount;
    let turns: Vec<Vector3<f64>> =
        pairs.iter().map(|p| lie::omega(&first.local(&p.anchor_from_mount))).collect();
    let mean = turns.iter().sum::<Vector3<f64>>() / turns.len() as f64;
    let scatter: Matrix3<f64> =
        turns.iter().map(|w| (w - mean) * (w - mean).transpose()).sum::<Matrix3<f64>>()
            / turns.len() as f64;
    let mut values: Vec<f64> = scatter.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values[1].max(0.0).sqrt()
}

/// How far an answer is from the estimator's, where that is clearly more than both are unsure.
fn apart(calibration: &Calibration, found: &Pose<Mount, Camera>, metre: f64) -> Option<String> {
    let answer = calibration.hand_eye.mount_from_camera?;
    let covariance = calibration.hand_eye.covariance.mount_from_camera?;
    let least = Matrix6::identity() * BEST * BEST;
    let weight = (calibration::matrix(&covariance) + least).cholesky()?;
    let off = answer.local(&found.farther(metre));
    (off.dot(&weight.solve(&off)) > 6.0 * SAME * SAME).then(|| {
        let (turn, shift) = (lie::omega(&off).norm().to_degrees(), lie::nu(&off).norm() * 1e3);
        format!("{turn:.2} degrees and {shift:.1} mm")
    })
}
