//! A live session: images and poses are handed over one by one.

use std::{
    path::PathBuf,
    sync::{Arc, Mutex},
};

use handeye::{Base, Flange, Pose, Scan};
use handeye_io::read_scan;
use handeye_session::{
    engine::Refusal,
    push::{
        Declared, PushError, Pushed, PushedPose, PushedSession as Session, image_in, with_scan,
    },
    sources::outlet::CameraImage,
};
use pyo3::prelude::*;

use crate::{
    arrays,
    calibration::Calibrated,
    captures::{in_metres, path},
    closed_form::setup,
    errors,
    images::{picture, target},
    scans::scan,
    working,
};

/// A session; `None` once it is closed. Work that a Ctrl-C left behind holds it until it is done.
#[pyclass(frozen, module = "handeye._core")]
pub struct PushedSession {
    session: Arc<Mutex<Option<Session>>>,
}

/// The name of a capture or placement, or why there is none; the state as JSON.
type Answer = (Option<String>, Option<String>, String);

#[pymethods]
impl PushedSession {
    /// Begins a session in a new folder, or goes on with one.
    #[new]
    #[pyo3(signature = (folder, *, setup_name=None, target_json=None, target_file=None, camera_json=None, tolerance_mm=None, notation=None, tip_mm=None))]
    #[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
    fn new(
        py: Python<'_>,
        folder: PathBuf,
        setup_name: Option<&str>,
        target_json: Option<&str>,
        target_file: Option<PathBuf>,
        camera_json: Option<String>,
        tolerance_mm: Option<f64>,
        notation: Option<String>,
        tip_mm: Option<[f64; 3]>,
    ) -> PyResult<Self> {
        let has_target = target_json.is_some() || target_file.is_some();
        let declared = Declared {
            setup: setup_name.map(setup).transpose()?,
            target: has_target.then(|| target(py, target_json, target_file)).transpose()?,
            camera_json,
            tolerance_mm,
            notation,
            tip_mm,
        };
        let opened = working::run(py, None, move |_| Session::open(&folder, &declared))?;
        let session = opened.map_err(|error| exception(py, &error))?;
        Ok(Self { session: Arc::new(Mutex::new(Some(session))) })
    }

    /// Takes a capture: a pose as a matrix or as numbers, an image and perhaps a scan as arrays or paths.
    #[pyo3(signature = (image, *, matrix=None, numbers=None, scan=None))]
    fn push(
        &self,
        py: Python<'_>,
        image: &Bound<'_, PyAny>,
        matrix: Option<&Bound<'_, PyAny>>,
        numbers: Option<String>,
        scan: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Answer> {
        let pose = pose(matrix, numbers)?;
        let image = given_image(image)?;
        let scan = scan.map(|scan| Given::of(scan, |array| self::scan(array, "the scan")));
        let scan: Option<Given<Scan>> = scan.transpose()?;
        self.with(py, move |session| {
            let image = image.read(|file| image_in(file))?;
            let scan = scan.map(|scan| scan.read(|file| read_scan(file, &in_metres())));
            let image = match scan.transpose()? {
                Some(scan) => with_scan(image, &scan),
                None => image,
            };
            let pushed = session.push(pose, image)?;
            Ok(answer(session, pushed))
        })
    }

    /// Takes a touch of a corner: the pose of the flange with the tip there. Its name, and the state as JSON.
    #[pyo3(signature = (*, matrix=None, numbers=None, corner=None))]
    fn touch(
        &self,
        py: Python<'_>,
        matrix: Option<&Bound<'_, PyAny>>,
        numbers: Option<String>,
        corner: Option<u32>,
    ) -> PyResult<(String, String)> {
        let pose = pose(matrix, numbers)?;
        self.with(py, move |session| {
            let id = session.touch(pose, corner)?;
            Ok((id, shown(session)))
        })
    }

    /// Takes the image of a board that lies in the view to be touched, perhaps with the pose of its moment.
    #[pyo3(signature = (image, *, matrix=None, numbers=None))]
    fn place(
        &self,
        py: Python<'_>,
        image: &Bound<'_, PyAny>,
        matrix: Option<&Bound<'_, PyAny>>,
        numbers: Option<String>,
    ) -> PyResult<Answer> {
        let is_known = matrix.is_some() || numbers.is_some();
        let there = is_known.then(|| pose(matrix, numbers)).transpose()?;
        let image = given_image(image)?;
        self.with(py, move |session| {
            let placed = session.place(image.read(|file| image_in(file))?, there)?;
            Ok(answer(session, placed))
        })
    }

    /// What is known now, as JSON.
    fn state(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |session| Ok(shown(session)))
    }

    /// Takes a capture out, or a placement with its touches.
    fn delete(&self, py: Python<'_>, id: String) -> PyResult<String> {
        self.change(py, move |session| session.delete(&id))
    }

    /// Takes a capture out, and proposes its view as the next one.
    fn retake(&self, py: Python<'_>, id: String) -> PyResult<String> {
        self.change(py, move |session| session.retake(&id))
    }

    /// Takes a touch out.
    fn untouch(&self, py: Python<'_>, id: String) -> PyResult<String> {
        self.change(py, move |session| session.untouch(&id))
    }

    /// Takes a deleted capture, placement or touch in again.
    fn restore(&self, py: Python<'_>, id: String) -> PyResult<String> {
        self.change(py, move |session| session.restore(&id))
    }

    /// Undoes the last capture, placement, touch, deletion or restoring.
    fn undo(&self, py: Python<'_>) -> PyResult<String> {
        self.change(py, Session::undo)
    }

    /// Proposes another view.
    fn skip(&self, py: Python<'_>) -> PyResult<String> {
        self.change(py, Session::skip)
    }

    /// Writes the result.
    fn finish(&self, py: Python<'_>) -> PyResult<Calibrated> {
        let finished = self.with(py, Session::finish)?;
        let measured = Some((finished.dataset, finished.session));
        Ok(Calibrated::of(finished.calibration, measured))
    }

    /// Lets the folder go.
    fn close(&self, py: Python<'_>) {
        py.detach(|| {
            let mut held = self.session.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            held.take();
        });
    }
}

impl PushedSession {
    /// Works on the session, without the interpreter.
    fn with<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Session) -> Result<T, PushError> + Send + 'static,
    ) -> PyResult<T> {
        let session = Arc::clone(&self.session);
        let work = move |_: &(dyn Fn(usize, usize) + Sync)| {
            let mut held = session.lock().map_err(|_| refused("the session has failed"))?;
            let session = held.as_mut().ok_or_else(|| refused("the session is closed"))?;
            work(session)
        };
        working::run(py, None, work)?.map_err(|error| exception(py, &error))
    }

    fn change(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Session) -> Result<(), PushError> + Send + 'static,
    ) -> PyResult<String> {
        self.with(py, |session| {
            work(session)?;
            Ok(shown(session))
        })
    }
}

/// An array that was taken over, or the path of a file.
enum Given<T> {
    Array(T),
    File(PathBuf),
}

impl<T> Given<T> {
    fn of(
        object: &Bound<'_, PyAny>,
        array: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>,
    ) -> PyResult<Self> {
        path(object).map_or_else(|| array(object).map(Given::Array), |file| Ok(Given::File(file)))
    }

    fn read<E>(self, read: impl FnOnce(&PathBuf) -> Result<T, E>) -> Result<T, E> {
        match self {
            Given::Array(value) => Ok(value),
            Given::File(file) => read(&file),
        }
    }
}

fn pose(matrix: Option<&Bound<'_, PyAny>>, numbers: Option<String>) -> PyResult<PushedPose> {
    match (matrix, numbers) {
        (Some(matrix), _) => {
            let (r, t) = arrays::pose(matrix, "pose")?;
            Ok(PushedPose::Known(Pose::<Base, Flange>::from_parts(&r, t)))
        }
        (None, Some(numbers)) => Ok(PushedPose::Typed(numbers)),
        (None, None) => Err(errors::input("the pose of the moment is needed")),
    }
}

fn given_image(image: &Bound<'_, PyAny>) -> PyResult<Given<CameraImage>> {
    Given::of(image, |array| Ok(CameraImage::in_memory(Arc::new(picture(array)?))))
}

fn answer(session: &Session, pushed: Pushed) -> Answer {
    let (id, refused) = match pushed {
        Pushed::Taken(id) => (Some(id), None),
        Pushed::Unseen(why) => (None, Some(why)),
    };
    (id, refused, shown(session))
}

fn shown(session: &Session) -> String {
    serde_json::to_string(&session.state()).unwrap_or_default()
}

fn refused(what: &str) -> PushError {
    let message = format!("{what}: open its folder again");
    PushError::Refused(Refusal { message, later: false })
}

fn exception(py: Python<'_>, error: &PushError) -> PyErr {
    match error {
        PushError::Folder(error) => errors::of_files(py, error),
        PushError::Refused(refusal) => errors::input(refusal.to_string()),
    }
}
