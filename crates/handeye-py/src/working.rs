//! Long work beside the interpreter: other Python threads run on, progress is told, and Ctrl-C ends it.

use std::{
    panic,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, RecvTimeoutError},
    },
    thread,
    time::Duration,
};

use pyo3::{exceptions::PyRuntimeError, prelude::*};

/// How often signals are looked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// What the worker sends.
enum News<T> {
    Progress(usize, usize),
    Done(thread::Result<T>),
}

/// Ends the worker where it tells its progress.
struct Stopped;

/// The result of work that is told how to tell its progress; `progress` is called with what is done, and all.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
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
    let receiver = std::sync::Mutex::new(receiver);
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
                return Err(error);
            }
        }
    }
}
