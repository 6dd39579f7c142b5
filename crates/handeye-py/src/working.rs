//! Long work beside the interpreter: other Python threads run on, progress is told, and Ctrl-C ends it.

use std::{
    panic,
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, Receiver, RecvTimeoutError},
    },
    thread,
    time::{Duration, Instant},
};

use pyo3::{exceptions::PyRuntimeError, prelude::*};

/// How often signals are looked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// How long a worker that was stopped is waited for, where it writes files.
const CLEARING: Duration = Duration::from_secs(2);

/// What the worker sends.
enum News<T> {
    Progress(usize, usize),
    Done(thread::Result<T>),
}

/// Ends the worker where it tells its progress.
struct Stopped;

/// Lets the worker clear up behind itself, for a while: the interpreter may end after it.
fn await_end<T>(receiver: &Mutex<Receiver<News<T>>>) {
    let Ok(receiver) = receiver.lock() else { return };
    let began = Instant::now();
    while began.elapsed() < CLEARING {
        match receiver.recv_timeout(PATIENCE) {
            Ok(News::Progress(..)) | Err(RecvTimeoutError::Timeout) => {}
            Ok(News::Done(_)) | Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// The result of work that only computes: after a Ctrl-C nobody waits for it.
pub fn compute<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    awaited(py, None, |_| {}, move |_| work())
}

/// The result of work that is told how to tell its progress; `progress` is called with what is done, and all.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T + Send + 'static,
) -> PyResult<T> {
    awaited(py, progress, await_end, work)
}

fn awaited<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    when_stopped: fn(&Mutex<Receiver<News<T>>>),
    work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T + Send + 'static,
) -> PyResult<T> {
    let (sender, receiver) = mpsc::channel();
    let stop = Arc::new(AtomicBool::new(false));
    let is_stopped = Arc::clone(&stop);
    thread::spawn(move || {
        let teller = sender.clone();
        let tell = move |done, all| {
            if is_stopped.load(Ordering::Relaxed) {
                panic::resume_unwind(Box::new(Stopped));
            }
            // nobody listens any more after a Ctrl-C
            teller.send(News::Progress(done, all)).ok();
        };
        let done = panic::catch_unwind(panic::AssertUnwindSafe(|| work(&tell)));
        sender.send(News::Done(done)).ok();
    });
    let told = |news: Result<News<T>, RecvTimeoutError>| -> PyResult<Option<T>> {
        py.check_signals()?;
        match news {
            Ok(News::Progress(done, all)) => {
                if let Some(progress) = progress {
                    progress.call1(py, (done, all))?;
                }
                Ok(None)
            }
            Ok(News::Done(Ok(result))) => Ok(Some(result)),
            Ok(News::Done(Err(_))) | Err(RecvTimeoutError::Disconnected) => {
                Err(PyRuntimeError::new_err("handeye failed; please report this with its data"))
            }
            Err(RecvTimeoutError::Timeout) => Ok(None),
        }
    };
    let receiver = Mutex::new(receiver);
    loop {
        let news = py.detach(|| match receiver.lock() {
            Ok(receiver) => receiver.recv_timeout(PATIENCE),
            Err(_) => Err(RecvTimeoutError::Disconnected),
        });
        match told(news) {
            Ok(Some(result)) => return Ok(result),
            Ok(None) => {}
            Err(error) => {
                stop.store(true, Ordering::Relaxed);
                py.detach(|| when_stopped(&receiver));
                return Err(error);
            }
        }
    }
}
