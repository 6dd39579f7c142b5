//! ROS bags.

use std::path::PathBuf;

use handeye_io::{
    Targets,
    bag::{self, BagOptions, Motion, RobotSource, Stamps},
    read_targets,
};
use pyo3::{prelude::*, types::PyBool};
use serde::Serialize;

use crate::{closed_form::setup, errors, images::target_from_json, working};

/// What a bag holds, as JSON.
#[pyfunction]
#[pyo3(signature = (bag))]
pub fn bag_contents(py: Python<'_>, bag: PathBuf) -> PyResult<String> {
    let found = working::run(py, None, move |tell| bag::contents(&bag, &|| tell(0, 0)))?;
    found.map_err(|error| errors::of_files(py, &error)).and_then(|found| json(&found))
}

/// A folder of captures out of a bag; what became of it, as JSON.
#[pyfunction]
#[pyo3(signature = (bag, out, *, base=None, flange=None, pose=None, joints=None, urdf=None, setup_name=None, target_json=None, target_file=None, image=None, depth=None, camera_info=None, motion="auto", most=150, stamps="header"))]
#[allow(clippy::too_many_arguments, reason = "each is one of Python's keywords")]
pub fn extract_bag(
    py: Python<'_>,
    bag: PathBuf,
    out: PathBuf,
    base: Option<String>,
    flange: Option<String>,
    pose: Option<String>,
    joints: Option<&Bound<'_, PyAny>>,
    urdf: Option<PathBuf>,
    setup_name: Option<&str>,
    target_json: Option<&str>,
    target_file: Option<PathBuf>,
    image: Option<String>,
    depth: Option<String>,
    camera_info: Option<String>,
    motion: &str,
    most: usize,
    stamps: &str,
) -> PyResult<String> {
    let target = match (target_json, target_file) {
        (Some(text), _) => {
            Some(Targets::One(target_from_json(text)?, handeye::TargetSize::Printed))
        }
        (None, Some(file)) => {
            Some(read_targets(&file).map_err(|error| errors::of_files(py, &error))?)
        }
        (None, None) => None,
    };
    let motion = match motion {
        "auto" => Motion::Auto,
        "still" => Motion::Still,
        "moving" => Motion::Moving,
        other => {
            let what = format!("motion is {other:?}: \"auto\", \"still\" or \"moving\" is needed");
            return Err(errors::input(what));
        }
    };
    let stamps = match stamps {
        "header" => Stamps::Header,
        "recorded" => Stamps::Recorded,
        other => {
            let what = format!("stamps is {other:?}: \"header\" or \"recorded\" is needed");
            return Err(errors::input(what));
        }
    };
    let robot = robot(base, flange, pose, joints)?;
    let setup = setup_name.map(setup).transpose()?;
    let camera = camera_info;
    let options =
        BagOptions { setup, target, image, depth, camera, robot, urdf, motion, most, stamps };
    let done =
        working::run(py, None, move |tell| bag::extract(&bag, &out, &options, &|| tell(0, 0)))?;
    done.map_err(|error| errors::of_files(py, &error)).and_then(|done| json(&done))
}

/// Where the robot's poses come from.
fn robot(
    base: Option<String>,
    flange: Option<String>,
    pose: Option<String>,
    joints: Option<&Bound<'_, PyAny>>,
) -> PyResult<RobotSource> {
    // False, True, or the topic
    let joints = match joints {
        None => None,
        Some(given) => match given.cast::<PyBool>() {
            Ok(flag) => flag.is_true().then_some(None),
            Err(_) => Some(Some(given.extract::<String>()?)),
        },
    };
    match (base, flange, pose, joints) {
        (None, None, Some(topic), None) => Ok(RobotSource::Poses { topic }),
        (Some(base), Some(flange), None, Some(topic)) => {
            Ok(RobotSource::Joints { topic, base, flange })
        }
        (Some(base), Some(flange), None, None) => Ok(RobotSource::Frames { base, flange }),
        _ => Err(errors::input(
            "say where the robot's poses are: base and flange (frames, as \"base_link\" and \"tool0\"), or pose (a \
             topic), not both; handeye.bag_contents(bag) names them",
        )),
    }
}

fn json(value: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| errors::input(error.to_string()))
}
