//! The program: on the terminal, and for the package's functions that are commands.

use std::ffi::OsString;

use handeye_cli::Captured;
use handeye_io::target_toml as toml_of;
use pyo3::prelude::*;

use crate::{images::target_from_json, working};

/// Runs a command line, its first word the program's name; its exit code, standard output and standard error.
#[pyfunction]
pub fn command(py: Python<'_>, words: Vec<OsString>) -> PyResult<(u8, String, String)> {
    let done = working::run(py, None, move |_| handeye_cli::captured(words))?;
    let Captured { code, out, err } = done;
    Ok((code, out, err))
}

/// The program itself; its exit code.
#[pyfunction]
pub fn main(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| handeye_cli::main(words))
}

/// The `[target]` of a manifest that declares this target.
#[pyfunction]
pub fn target_toml(json: &str) -> PyResult<String> {
    target_from_json(json).map(|target| toml_of(&target))
}
