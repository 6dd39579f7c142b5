//! What OpenCV's two functions take and give, with a look at the answer before it is given.
//!
//! The answer is that of the method as published. Where its residual is small, alike in all poses, without order, no
//! better with the target in another size, and the rotations are about several axes, it is returned at once. Everything
//! else is held against the recommended estimator, which knows its uncertainty: what that refuses, and answers that are
//! grossly off beside it, are refused; what it has to say else comes as a warning.

use handeye::{
    Base, Calibration, Camera, Config, Flange, HandEye, Method, Mount, Observation, Pose, PosePair,
    Session, Setup, Target, Verdict,
    calibrate::result,
    math::{lie, linalg::median},
    solve,
};
use nalgebra::{Matrix3, Matrix6, SMatrix, SVector, Vector3};
use numpy::PyArray2;
use pyo3::{prelude::*, types::PyIterator};

use crate::{
    arrays,
    errors::{self, NotDetermined, Rejected},
    working,
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
/// With fewer poses the residual says little.
const FEW: usize = 6;
/// Residuals (root mean square) up to which nothing is wrong: rad, and share of the distance to the target.
const SMALL: (f64, f64) = (5e-3, 5e-3);
/// One pose's residual is uneven when it is so many times the largest that is usual, ...
const UNEVEN: f64 = 1.5;
/// Median of the length of three normal numbers.
const MEDIAN_LENGTH: f64 = 1.538;
/// ... and more than rounding.
const ROUNDING: f64 = 1e-7;
/// Rotations about other axes than the first one, rad, below which they count as about one.
const SEVERAL_AXES: f64 = 0.1;
/// So many times as large positions of robot and target are not in one unit.
const MOST_UNLIKE: f64 = 100.0;
/// Lengths of a cell beyond this are in millimetres.
const LARGEST_M: f64 = 20.0;
/// Another size of the target, and neighbours that err alike, count from so many standard deviations on.
const ORDERLY: f64 = 3.0;
/// Answers are the same within so many standard deviations.
const SAME: f64 = 6.0;
/// They are grossly different from here on: degrees, and share of the distance to the target.
const GROSS: (f64, f64) = (2.0, 0.05);
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
    let (found, warnings) = Cell { equations: pairs, is_reversed: false }.solved(py, method)?;
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
    let (found, warnings) = Cell { equations, is_reversed: true }.solved(py, method)?;
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
        "{} has {a} poses but {} has {b}: one of each belongs to every image",
        names[0], names[1]
    )))
}

/// Equations `A X = Y B`, and which side of them the robot is on.
struct Cell {
    equations: Vec<PosePair>,
    /// `A` is the target in the camera, and `B` the base in the gripper.
    is_reversed: bool,
}

impl Cell {
    fn solved(self, py: Python<'_>, method: Method) -> PyResult<(HandEye, Vec<String>)> {
        let found = py.detach(|| solve::solve(&self.equations, method));
        match &found {
            Ok(found) if self.is_plain(found) => return Ok((*found, vec![])),
            Err(
                error @ (handeye::Error::NotFinite { .. } | handeye::Error::TooFewPoses { .. }),
            ) => {
                return Err(errors::of_core(error));
            }
            _ => {}
        }
        let (given, name) = (found.as_ref().ok().copied(), method.name());
        // where the method failed, what the estimator says of the same data is clearer
        let warnings = working::compute(py, move || self.examined(given.as_ref(), name))??;
        Ok((found.map_err(|error| errors::of_core(&error))?, warnings))
    }

    /// Whether nothing in an answer calls for a closer look.
    fn is_plain(&self, found: &HandEye) -> bool {
        let pairs = &self.equations;
        if pairs.len() < FEW || turning(pairs) < SEVERAL_AXES || self.is_behind() {
            return false;
        }
        let errors: Vec<_> = pairs.iter().map(|p| found.loop_error(p)).collect();
        let is_small_and_even = |all: Vec<f64>, small: f64| {
            let rms = (all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64).sqrt();
            let largest = all.iter().copied().fold(0.0, f64::max);
            // of so many lengths the largest is about this many times the median one
            let usual = (2.0 * (all.len() as f64).ln() + 3.0).sqrt() / MEDIAN_LENGTH;
            rms < small && largest < UNEVEN * usual * median(all) + ROUNDING
        };
        let distance = self.distance();
        let angles = errors.iter().map(|e| e.iso().rotation.angle()).collect();
        let shifts: Vec<Vector3<f64>> = errors.iter().map(|e| e.translation() / distance).collect();
        is_small_and_even(angles, SMALL.0)
            && is_small_and_even(shifts.iter().map(Vector3::norm).collect(), SMALL.1)
            && !is_in_order(&shifts)
            && !is_of_another_size(pairs, found, distance)
    }

    /// Median distance to the target.
    fn distance(&self) -> f64 {
        median(self.equations.iter().map(|p| self.seen(p).translation().norm()))
    }

    /// What is wrong with the units, where positions of robot and target are of very different size.
    fn units(&self) -> Option<String> {
        let robot = median(self.equations.iter().map(|p| self.reported(p).translation().norm()));
        let ratio = robot / self.distance();
        let (larger, times) = if ratio > 1.0 { ("robot", ratio) } else { ("target", 1.0 / ratio) };
        (times.is_finite() && times > MOST_UNLIKE).then(|| {
            format!(
                "positions of the {larger} are some {times:.0} times as large as the other ones: is one list in \
                 millimetres, and the other in metres?"
            )
        })
    }

    /// Whether most targets are behind the camera.
    fn is_behind(&self) -> bool {
        let behind = self.equations.iter().filter(|p| self.seen(p).translation().z <= 0.0);
        2 * behind.count() > self.equations.len()
    }

    fn seen(&self, pair: &PosePair) -> Pose<Camera, Target> {
        if self.is_reversed { pair.anchor_from_mount.rename() } else { pair.camera_from_target }
    }

    fn reported(&self, pair: &PosePair) -> Pose<Base, Flange> {
        if self.is_reversed {
            pair.camera_from_target.rename()
        } else {
            pair.anchor_from_mount.rename()
        }
    }

    /// Warnings, or why the answer is refused.
    fn examined(&self, found: Option<&HandEye>, method: &str) -> PyResult<Vec<String>> {
        let size = self.equations.iter().flat_map(|p| {
            [p.anchor_from_mount.translation().amax(), p.camera_from_target.translation().amax()]
        });
        let metre = if size.fold(0.0, f64::max) > LARGEST_M { 1e-3 } else { 1.0 };
        let calibration = self.estimated(metre)?;
        let reasons = || {
            self.units()
                .into_iter()
                .chain(calibration.reasons.clone())
                .collect::<Vec<_>>()
                .join("; ")
        };
        match calibration.verdict {
            Verdict::Accepted => {}
            Verdict::Rejected => return Err(Rejected::new_err(reasons())),
            Verdict::Undetermined => return Err(NotDetermined::new_err(reasons())),
        }
        let left_out = || {
            let which = calibration.rejected.join(", ");
            format!("poses {which} (counted from 0) contradict the others")
        };
        let mut warnings: Vec<String> =
            calibration.warnings.iter().map(|w| w.message.clone()).collect();
        if !calibration.rejected.is_empty() {
            warnings.insert(0, left_out());
        }
        if let Some(found) = found
            && let Some((degrees, m)) = apart(&calibration, &self.mount_from_camera(found), metre)
        {
            let is_gross = degrees > GROSS.0 || m > GROSS.1 * self.distance() * metre;
            if !calibration.rejected.is_empty() {
                let advice = "leave them out, or take handeye.solve, which does";
                return Err(Rejected::new_err(format!("{}: {advice}", left_out())));
            }
            let what = format!(
                "{method} is {degrees:.2} degrees and {:.1} mm from the answer that fits these poses best: take \
                 another method, or handeye.solve",
                1e3 * m
            );
            if is_gross {
                return Err(Rejected::new_err(what));
            }
            warnings.insert(0, what);
        }
        if self.is_behind() {
            let what = "most targets lie behind the camera (z < 0): are all poses inverted, or is z backwards?";
            warnings.insert(0, what.into());
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
    fn mount_from_camera(&self, found: &HandEye) -> Pose<Mount, Camera> {
        if self.is_reversed {
            found.anchor_from_target.inverse().rename()
        } else {
            found.mount_from_camera
        }
    }

    fn estimated(&self, metre: f64) -> PyResult<Calibration> {
        let observation = |(k, p): (usize, &PosePair)| {
            let (robot, seen) = (self.reported(p).farther(metre), self.seen(p).farther(metre));
            Observation::bare(k.to_string(), robot, seen)
        };
        let observations = self.equations.iter().enumerate().map(observation).collect();
        let session =
            Session { in_sequence: true, ..Session::of_captures(Setup::EyeInHand, observations) };
        // how good is good enough, a script without a job does not say
        let config = Config { max_error_mm: Some(f64::INFINITY), ..Config::default() };
        handeye::calibrate(&session, &config).map_err(|error| errors::of_core(&error))
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

/// Whether neighbours err alike: a target or a robot that moves.
fn is_in_order(errors: &[Vector3<f64>]) -> bool {
    let mean = errors.iter().sum::<Vector3<f64>>() / errors.len() as f64;
    let all: f64 = errors.iter().map(|e| (e - mean).norm_squared()).sum();
    let neighbours: f64 = errors.windows(2).map(|two| (two[0] - mean).dot(&(two[1] - mean))).sum();
    // of independent errors about all / (3 n) (n - 1), squared
    neighbours > ORDERLY * all / (3.0 * errors.len() as f64).sqrt() && all.sqrt() > ROUNDING
}

/// Whether targets of another size would fit clearly better: the residual of the positions by both places and a factor.
fn is_of_another_size(pairs: &[PosePair], found: &HandEye, distance: f64) -> bool {
    type Vector7 = SVector<f64, 7>;
    let (x, y) = (found.mount_from_camera, found.anchor_from_target);
    let mut information = SMatrix::<f64, 7, 7>::zeros();
    let mut gradient = Vector7::zeros();
    let mut squares = 0.0;
    for pair in pairs {
        let (a, b) = (&pair.anchor_from_mount, &pair.camera_from_target);
        // R_A (R_X s t_B + t_X) + t_A = t_Y
        let seen = a.rotation() * (x.rotation() * b.translation());
        let residual =
            (seen + a.rotation() * x.translation() + a.translation() - y.translation()) / distance;
        for k in 0..3 {
            let mut row = Vector7::zeros();
            row.fixed_rows_mut::<3>(0).copy_from(&a.rotation().row(k).transpose());
            row[3 + k] = -1.0;
            row[6] = seen[k] / distance;
            information += row * row.transpose();
            gradient += row * residual[k];
            squares += residual[k] * residual[k];
        }
    }
    let Some(inverse) = information.cholesky().map(|c| c.inverse()) else { return false };
    let change = -inverse * gradient;
    let left = (squares + change.dot(&gradient)).max(0.0) / (3.0 * pairs.len() as f64 - 7.0);
    change[6].abs() > ORDERLY * (left * inverse[(6, 6)]).sqrt() + ROUNDING
}

/// Degrees and metres between an answer and the estimator's, where that is clearly more than that is unsure.
fn apart(calibration: &Calibration, found: &Pose<Mount, Camera>, metre: f64) -> Option<(f64, f64)> {
    let answer = calibration.hand_eye.mount_from_camera?;
    let covariance = calibration.hand_eye.covariance.mount_from_camera?;
    let least = Matrix6::identity() * BEST * BEST;
    let weight = (result::matrix(&covariance) + least).cholesky()?;
    let off = answer.local(&found.farther(metre));
    let is_same = off.dot(&weight.solve(&off)) <= 6.0 * SAME * SAME;
    (!is_same).then(|| (lie::omega(&off).norm().to_degrees(), lie::nu(&off).norm()))
}
