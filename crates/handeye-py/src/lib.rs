//! The compiled half of the Python package: numbers and files in, numbers and JSON out.
//!
//! What users see is `python/handeye`; it gives these functions their types, names and shapes.

#![allow(clippy::result_large_err, reason = "an error ends the work: its size costs nothing")]

mod arrays;
mod bags;
mod calibration;
mod captures;
mod closed_form;
mod commands;
mod errors;
mod images;
mod opencv;
mod poses;
mod scans;
mod session;
mod simulation;
mod working;

use pyo3::{prelude::*, types::PyDict};

/// Compiled functions of handeye.
#[pymodule]
mod _core {
    use super::{Bound, PyDict, PyDictMethods, PyModule, PyModuleMethods, PyResult};
    #[pymodule_export]
    use super::{
        bags::{bag_contents, extract_bag},
        calibration::{Calibrated, calibrate, solve, solve_streams},
        captures::calibrate_captures,
        closed_form::closed_form,
        commands::{command, main, target_toml},
        errors::{HandEyeError, InputError, NotDetermined, Rejected},
        images::detect,
        opencv::{hand_eye, robot_world_hand_eye},
        poses::{poses_from, poses_to},
        scans::register,
        session::PushedSession,
        simulation::simulate,
    };
    use handeye::Method;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        let methods = PyDict::new(module.py());
        for method in Method::ALL {
            methods.set_item(method.name(), method.source())?;
        }
        module.add("METHODS", methods)
    }
}
