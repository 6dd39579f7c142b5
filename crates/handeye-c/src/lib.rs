//! The C interface: `include/handeye.h` says what each function takes and gives.
//!
//! Nothing unwinds into the caller: a panic becomes `HANDEYE_FAILED`. Pointers are read and written here and nowhere
//! else.

#![allow(clippy::result_large_err, reason = "an error ends the work: its size costs nothing")]

use std::{
    ffi::{CStr, CString, c_char, c_int},
    panic::{self, AssertUnwindSafe},
    path::Path,
    ptr, slice,
};

use handeye::{
    Calibration, Config, HandEye, Method, Pose, PosePair, Scan, Setup, Verdict,
    register::{DenseConfig, DenseMethod, register},
    solve,
};
use handeye_io::{
    Dataset, Problem, RegistrationResult,
    calibrate::{calibrate_dataset, write_results},
    poses_from_json,
    report::dataset_html,
    robot::rotation_near,
};
use nalgebra::{Isometry3, Matrix3, Matrix4, Translation3, Vector3};
use serde::{Deserialize, Serialize};
use serde_json::json;

/// As in the header.
const ACCEPTED: c_int = 0;
const UNUSABLE: c_int = 1;
const WRONG_CALL: c_int = 2;
const NOT_ACCEPTED: c_int = 3;
const FAILED: c_int = 4;
/// What `handeye_solve` calls its text in messages.
const POSES: &str = "poses";
/// Most points of a scan.
const MOST_POINTS: usize = 100_000_000;

/// An end without an answer.
enum End {
    Unusable(Problem),
    WrongCall(String),
}

impl<E: Into<Problem>> From<E> for End {
    fn from(error: E) -> Self {
        End::Unusable(error.into())
    }
}

/// A status and a JSON document.
type Answer = Result<(c_int, String), End>;

/// Runs the work, and gives its document to the caller.
///
/// # Safety
/// `answer` is null or can be written to.
unsafe fn give(answer: *mut *mut c_char, work: impl FnOnce() -> Answer) -> c_int {
    let error = |problem: Problem| json!({ "error": problem }).to_string();
    let (status, text) = match panic::catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(done)) => done,
        Ok(Err(End::Unusable(problem))) => (UNUSABLE, error(problem)),
        Ok(Err(End::WrongCall(what))) => (WRONG_CALL, error(Problem::new("wrong-call", what))),
        Err(_) => (FAILED, error(Problem::new("failed", "a fault of this library".into()))),
    };
    if answer.is_null() {
        return status;
    }
    let text = match CString::new(text) {
        Ok(text) if !text.is_empty() => text.into_raw(),
        _ => ptr::null_mut(),
    };
    // SAFETY: the caller promises that it can be written to.
    unsafe { answer.write(text) };
    status
}

/// Text of the caller.
///
/// # Safety
/// `text` is null or ends with a zero, and lives as long as what is returned.
unsafe fn text<'a>(text: *const c_char, name: &str) -> Result<Option<&'a str>, End> {
    if text.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller promises it.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map(Some).map_err(|_| End::WrongCall(format!("{name} is no UTF-8 text")))
}

fn needed<T>(given: Option<T>, name: &str) -> Result<T, End> {
    given.ok_or_else(|| End::WrongCall(format!("{name} is NULL")))
}

fn method(name: &str) -> Result<Method, End> {
    Method::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Method::ALL.iter().map(|m| m.name()).collect();
        End::WrongCall(format!("no method {name:?}; there are {}", known.join(", ")))
    })
}

fn told(verdict: Verdict, document: &impl Serialize) -> Answer {
    let status = if verdict == Verdict::Accepted { ACCEPTED } else { NOT_ACCEPTED };
    let text = serde_json::to_string(document);
    let failed =
        |error: serde_json::Error| End::Unusable(Problem::new("unusable", error.to_string()));
    Ok((status, text.map_err(failed)?))
}

/// The library's version.
#[unsafe(no_mangle)]
pub extern "C" fn handeye_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Gives back an answer.
///
/// # Safety
/// It came from one of these functions, and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn handeye_free(answer: *mut c_char) {
    if !answer.is_null() {
        // SAFETY: the caller promises that it came from `CString::into_raw`.
        drop(unsafe { CString::from_raw(answer) });
    }
}

/// Calibrates from poses.
///
/// # Safety
/// Texts are null or end with a zero; `answer` is null or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn handeye_solve(
    poses_json: *const c_char,
    method_name: *const c_char,
    answer: *mut *mut c_char,
) -> c_int {
    let work = || {
        // SAFETY: as promised by the caller.
        let (poses, name) =
            unsafe { (text(poses_json, "poses_json")?, text(method_name, "method")?) };
        let poses = poses_from_json(needed(poses, "poses_json")?, Path::new(POSES))?;
        let config = Config { method: name.map(method).transpose()?, ..Config::default() };
        let calibration = poses.calibrate(&config)?;
        told(calibration.verdict, &calibration)
    };
    // SAFETY: as promised by the caller.
    unsafe { give(answer, work) }
}

/// Calibrates a folder.
///
/// # Safety
/// Texts are null or end with a zero; `answer` is null or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn handeye_calibrate(
    dataset: *const c_char,
    root: *const c_char,
    out: *const c_char,
    answer: *mut *mut c_char,
) -> c_int {
    let work = || {
        // SAFETY: as promised by the caller.
        let [dataset, root, out] =
            unsafe { [text(dataset, "dataset")?, text(root, "root")?, text(out, "out")?] };
        let dataset = Path::new(needed(dataset, "dataset")?);
        let dataset = match root {
            Some(root) => Dataset::open_with_root(dataset, Path::new(root))?,
            None => Dataset::open(dataset)?,
        };
        let (calibration, session) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {})?;
        if let Some(out) = out.map(Path::new) {
            let page = dataset_html(&dataset, &calibration, &session);
            write_results(out, Some(&dataset), &calibration, &page)?;
        }
        told(calibration.verdict, &calibration)
    };
    // SAFETY: as promised by the caller.
    unsafe { give(answer, work) }
}

/// Points of a scan.
#[repr(C)]
pub struct HandeyeScan {
    points: *const f32,
    width: usize,
    height: usize,
}

/// # Safety
/// `scan` is null, or its points are `3 * width * height` numbers.
unsafe fn scan(scan: *const HandeyeScan, name: &str) -> Result<Scan, End> {
    // SAFETY: as promised by the caller.
    let scan = needed(unsafe { scan.as_ref() }, name)?;
    let count = scan.width.checked_mul(scan.height).filter(|count| *count <= MOST_POINTS);
    let Some(count) = count.filter(|count| *count > 0 && !scan.points.is_null()) else {
        return Err(End::WrongCall(format!("{name} has no points, or more than {MOST_POINTS}")));
    };
    // SAFETY: the caller promises that there are so many.
    let numbers = unsafe { slice::from_raw_parts(scan.points, 3 * count) };
    let points = numbers.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    needed(Scan::new(scan.width, scan.height, points), name)
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Options {
    method: String,
    max_distance_mm: f64,
    max_iterations: usize,
    global: bool,
    threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        let usual = DenseConfig::default();
        Self {
            method: "auto".into(),
            max_distance_mm: usual.max_correspondence_distance_m * 1e3,
            max_iterations: usual.max_iterations,
            global: false,
            threads: 1,
        }
    }
}

impl Options {
    fn config(&self) -> Result<DenseConfig, End> {
        let method = DenseMethod::from_name(&self.method).ok_or_else(|| {
            let there = DenseMethod::ALL.map(DenseMethod::name).join(", ");
            End::WrongCall(format!("no method {:?}; there are {there}", self.method))
        })?;
        if !(self.max_distance_mm > 0.0 && self.max_distance_mm.is_finite())
            || self.max_iterations == 0
        {
            return Err(End::WrongCall(
                "max_distance_mm and max_iterations must be positive".into(),
            ));
        }
        Ok(DenseConfig {
            method,
            max_correspondence_distance_m: self.max_distance_mm * 1e-3,
            max_iterations: self.max_iterations,
            global: self.global,
            threads: self.threads.max(1),
            ..DenseConfig::default()
        })
    }
}

/// Where one scan lies in another.
///
/// # Safety
/// Scans are null or as the header says; `target_from_source` is null or 16 numbers; text is null or ends with a zero;
/// `answer` is null or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn handeye_register(
    source: *const HandeyeScan,
    target: *const HandeyeScan,
    target_from_source: *const f64,
    options_json: *const c_char,
    answer: *mut *mut c_char,
) -> c_int {
    let work = || {
        // SAFETY: as promised by the caller.
        let (source, target) = unsafe { (scan(source, "source")?, scan(target, "target")?) };
        // SAFETY: as promised by the caller.
        let options = match unsafe { text(options_json, "options_json")? } {
            None => Options::default(),
            Some(text) => serde_json::from_str(text)
                .map_err(|error| End::WrongCall(format!("options_json: {error}")))?,
        };
        let config = options.config()?;
        let start = if target_from_source.is_null() {
            Isometry3::identity()
        } else {
            // SAFETY: as promised by the caller.
            let numbers = unsafe { slice::from_raw_parts(target_from_source, 16) };
            pose(numbers, "target_from_source")?
        };
        let found = RegistrationResult::from(&register(&source, &target, &start, &config)?);
        told(found.verdict, &found)
    };
    // SAFETY: as promised by the caller.
    unsafe { give(answer, work) }
}

/// A rigid transform of sixteen numbers, row by row.
fn pose(numbers: &[f64], name: &str) -> Result<Isometry3<f64>, End> {
    let matrix = Matrix4::from_row_slice(numbers);
    let rotation: Matrix3<f64> = matrix.fixed_view::<3, 3>(0, 0).into_owned();
    let is_whole =
        matrix.row(3) == Matrix4::identity().row(3) && matrix.iter().all(|x| x.is_finite());
    let Some(rotation) = rotation_near(&rotation).ok().filter(|_| is_whole) else {
        let what = format!(
            "{name} is no rigid transform: three rows of rotation and translation, then 0 0 0 1"
        );
        return Err(End::Unusable(Problem::new("unusable", what)));
    };
    let translation: Vector3<f64> = matrix.fixed_view::<3, 1>(0, 3).into_owned();
    Ok(Isometry3::from_parts(Translation3::from(translation), rotation))
}

/// One published method.
///
/// # Safety
/// Texts are null or end with a zero; poses are null or `16 * count` numbers; results are null or take 16 numbers;
/// `error` is null or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn handeye_closed_form(
    setup: *const c_char,
    method_name: *const c_char,
    count: usize,
    base_from_flange: *const f64,
    camera_from_target: *const f64,
    mount_from_camera: *mut f64,
    anchor_from_target: *mut f64,
    error: *mut *mut c_char,
) -> c_int {
    let work = || {
        // SAFETY: as promised by the caller.
        let (setup, name) = unsafe { (text(setup, "setup")?, text(method_name, "method")?) };
        let setup = needed(setup, "setup")?;
        let setup = Setup::from_name(setup).ok_or_else(|| {
            End::WrongCall(format!(
                "setup {setup:?} is neither \"eye-in-hand\" nor \"eye-to-hand\""
            ))
        })?;
        let method = method(needed(name, "method")?)?;
        if mount_from_camera.is_null() || anchor_from_target.is_null() {
            return Err(End::WrongCall("a result is NULL".into()));
        }
        // SAFETY: as promised by the caller.
        let (robot, camera) = unsafe {
            (
                poses(base_from_flange, count, "base_from_flange")?,
                poses(camera_from_target, count, "camera_from_target")?,
            )
        };
        let pair = |(a, b): (Isometry3<f64>, Isometry3<f64>)| PosePair {
            anchor_from_mount: setup.anchor_from_mount(Pose::claim(a)),
            camera_from_target: Pose::claim(b),
        };
        let pairs: Vec<PosePair> = robot.into_iter().zip(camera).map(pair).collect();
        let HandEye { mount_from_camera: x, anchor_from_target: y } = solve::solve(&pairs, method)?;
        for (out, matrix) in [(mount_from_camera, x.matrix()), (anchor_from_target, y.matrix())] {
            // SAFETY: the caller promises that it takes 16 numbers.
            let out = unsafe { slice::from_raw_parts_mut(out, 16) };
            out.copy_from_slice(matrix.transpose().as_slice());
        }
        Ok((ACCEPTED, String::new()))
    };
    // SAFETY: as promised by the caller.
    unsafe { give(error, work) }
}

/// Corrects poses of a robot that errs by place.
///
/// # Safety
/// Text is null or ends with a zero; poses are null or `16 * count` numbers; `corrected` is null or takes as many, and
/// `sigma_m` is null or takes `count`; `error` is null or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn handeye_compensate(
    calibration_json: *const c_char,
    reported: c_int,
    count: usize,
    base_from_flange: *const f64,
    corrected: *mut f64,
    sigma_m: *mut f64,
    error: *mut *mut c_char,
) -> c_int {
    let work = || {
        // SAFETY: as promised by the caller.
        let given = unsafe { text(calibration_json, "calibration_json")? };
        let calibration: Calibration = serde_json::from_str(needed(given, "calibration_json")?)
            .map_err(|e| End::Unusable(Problem::new("malformed", e.to_string())))?;
        // SAFETY: as promised by the caller.
        let poses = unsafe { poses(base_from_flange, count, "base_from_flange")? };
        if corrected.is_null() {
            return Err(End::WrongCall("corrected is NULL".into()));
        }
        let model = match calibration.correction() {
            Ok(model) => model,
            Err(why) => {
                let problem = json!({ "error": Problem::new("no-correction", why) });
                return Ok((NOT_ACCEPTED, problem.to_string()));
            }
        };
        // SAFETY: the caller promises that they take so many numbers.
        let out = unsafe { slice::from_raw_parts_mut(corrected, 16 * count) };
        let mut sigmas = match sigma_m.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { slice::from_raw_parts_mut(sigma_m, count) }),
        };
        for (k, (pose, out)) in poses.into_iter().zip(out.chunks_exact_mut(16)).enumerate() {
            let pose = Pose::claim(pose);
            let found = if reported == 0 { model.command(&pose) } else { model.actual(&pose) };
            out.copy_from_slice(found.base_from_flange.matrix().transpose().as_slice());
            if let Some(sigmas) = &mut sigmas {
                sigmas[k] = found.sigma_m();
            }
        }
        Ok((ACCEPTED, String::new()))
    };
    // SAFETY: as promised by the caller.
    unsafe { give(error, work) }
}

/// # Safety
/// `numbers` is null or `16 * count` numbers.
unsafe fn poses(numbers: *const f64, count: usize, name: &str) -> Result<Vec<Isometry3<f64>>, End> {
    let Some(all) = count.checked_mul(16).filter(|_| !numbers.is_null() && count <= MOST_POINTS)
    else {
        return Err(End::WrongCall(format!(
            "{name} is NULL, or has more than {MOST_POINTS} poses"
        )));
    };
    // SAFETY: the caller promises that there are so many.
    let numbers = unsafe { slice::from_raw_parts(numbers, all) };
    let named = |(k, matrix)| pose(matrix, &format!("{name}[{k}]"));
    numbers.chunks_exact(16).enumerate().map(named).collect()
}
