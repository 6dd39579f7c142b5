//! Errors as Python's exceptions.

use pyo3::{create_exception, exceptions::PyValueError, prelude::*};

create_exception!(handeye, HandEyeError, PyValueError, "What handeye refuses, and why.");
create_exception!(
    handeye,
    InputError,
    HandEyeError,
    "Input that cannot be used: where, what, and what to do."
);
create_exception!(
    handeye,
    NotDetermined,
    HandEyeError,
    "The data leave part of the answer free; the message names it."
);

create_exception!(
    handeye,
    Rejected,
    HandEyeError,
    "There is an answer, and the data contradict it or themselves; the message says how."
);

/// Of numbers.
pub fn of_core(error: &handeye::Error) -> PyErr {
    use handeye::Error as E;
    let text = error.to_string();
    match error {
        E::Collinear { .. }
        | E::NotDetermined { .. }
        | E::NoView(_)
        | E::TooFewPoses { .. }
        | E::TooFewPoints { .. }
        | E::TooFewSamples { .. } => NotDetermined::new_err(text),
        _ => InputError::new_err(text),
    }
}

/// Of files; the place stands in attributes as well.
pub fn of_files(py: Python<'_>, error: &handeye_io::Error) -> PyErr {
    let place = error.place();
    let exception = InputError::new_err(error.to_string());
    let value = exception.value(py);
    let told = value
        .setattr("code", error.code())
        .and_then(|()| value.setattr("file", place.file))
        .and_then(|()| value.setattr("line", place.line))
        .and_then(|()| value.setattr("capture", error.capture()));
    match told {
        Ok(()) => exception,
        Err(other) => other,
    }
}

/// Of one number or array.
pub fn input(what: impl Into<String>) -> PyErr {
    InputError::new_err(what.into())
}
