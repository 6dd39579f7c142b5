//! Results of ROS programs: easy_handeye's YAML, easy_handeye2's `.calib`, and launch files with a
//! static_transform_publisher, which has the camera as its child: `parent_from_camera`, metres.

use std::path::Path;

use handeye::Setup;
use roxmltree::Document;

use super::{
    Declared,
    results::{Found, pose},
};
use crate::{
    Error, Place,
    error::{malformed, unusable},
    files,
    tree::Tree,
    units::LengthUnit,
};

pub(super) fn easy_handeye(source: &Path, _: &Declared) -> Result<Option<Found>, Error> {
    if !["yaml", "yml", "calib"].contains(&files::extension(source).as_str()) {
        return Ok(None);
    }
    let tree = Tree::read(source)?;
    let Some(parameters) = tree.get("parameters") else { return Ok(None) };
    let (keys, setup) = match (tree.get("transform"), tree.get("transformation")) {
        (Some(new), _) => (numbers_under(new), setup_of(parameters)),
        (None, Some(old)) => (numbers_under(old), setup_of(parameters)),
        (None, None) => return Ok(None),
    };
    let numbers = keys.ok_or_else(|| {
        let what = "the transform has no x, y, z and qx, qy, qz, qw";
        malformed(Place::file(source), what, "was it written by easy_handeye?")
    })?;
    let setup = setup.ok_or_else(|| {
        let what =
            "parameters say neither calibration_type (eye_in_hand, eye_on_base) nor eye_on_hand";
        unusable(source, what)
    })?;
    Ok(Some(Found {
        layout: if tree.get("transform").is_some() {
            "result of easy_handeye2"
        } else {
            "result of easy_handeye"
        },
        pose: pose(&numbers, "quaternion-xyzw", LengthUnit::Metre, source)?,
        setup: Some(setup),
        is_cameras: Some(true),
        notes: optical(parameters.get("tracking_base_frame").and_then(Tree::text)),
    }))
}

/// Translation and quaternion, in one map or in two.
fn numbers_under(transform: &Tree) -> Option<Vec<f64>> {
    let translation = transform.get("translation").unwrap_or(transform);
    let rotation = transform.get("rotation");
    let mut numbers = vec![];
    for key in ["x", "y", "z"] {
        numbers.push(translation.get(key)?.number()?);
    }
    for key in ["x", "y", "z", "w"] {
        let value = match rotation {
            Some(rotation) => rotation.get(key),
            None => transform.get(&format!("q{key}")),
        };
        numbers.push(value?.number()?);
    }
    Some(numbers)
}

/// Who carries the camera, as both versions of easy_handeye say it.
pub(super) fn setup_of(parameters: &Tree) -> Option<Setup> {
    match (parameters.get("calibration_type").and_then(Tree::text), parameters.get("eye_on_hand")) {
        (Some("eye_in_hand"), _) | (None, Some(Tree::Bool(true))) => Some(Setup::EyeInHand),
        (Some("eye_on_base"), _) | (None, Some(Tree::Bool(false))) => Some(Setup::EyeToHand),
        _ => None,
    }
}

/// A frame that is not called optical may have other axes than the camera's.
fn optical(frame: Option<&str>) -> Vec<String> {
    match frame {
        Some(frame) if !frame.contains("optical") => vec![format!(
            "{frame} is taken as the camera's optical frame: x right, y down, z into the scene"
        )],
        _ => vec![],
    }
}

pub(super) fn launch_xml(source: &Path, _: &Declared) -> Result<Option<Found>, Error> {
    if !["launch", "xml"].contains(&files::extension(source).as_str()) {
        return Ok(None);
    }
    let text = files::text(source)?;
    let document = Document::parse(&text).map_err(|e| {
        let place = Place::line(source, e.pos().row as usize);
        malformed(place, format!("is not XML: {e}"), "correct the file")
    })?;
    let publishes = |node: &roxmltree::Node| {
        let program = node.attribute("type").or(node.attribute("exec"));
        program == Some(PUBLISHER)
    };
    let mut nodes = document.descendants().filter(publishes);
    let Some(node) = nodes.next() else { return Ok(None) };
    only_one(nodes.next().is_some(), source)?;
    let words: Vec<String> =
        node.attribute("args").unwrap_or_default().split_whitespace().map(String::from).collect();
    published("result in a launch file", &words, source).map(Some)
}

const PUBLISHER: &str = "static_transform_publisher";

fn only_one(several: bool, source: &Path) -> Result<(), Error> {
    if !several {
        return Ok(());
    }
    let what = format!("starts more than one {PUBLISHER}: leave the camera's alone in a file");
    Err(unusable(source, what))
}

pub(super) fn launch_python(source: &Path, _: &Declared) -> Result<Option<Found>, Error> {
    if files::extension(source) != "py" {
        return Ok(None);
    }
    let text = files::text(source)?;
    let Some((_, after)) = text.split_once(PUBLISHER) else { return Ok(None) };
    only_one(after.contains(PUBLISHER), source)?;
    let list = after.split_once("arguments").and_then(|(_, rest)| rest.split_once('['));
    let list = list.and_then(|(_, rest)| rest.split_once(']')).map(|(list, _)| list);
    let words = list.map(quoted).ok_or_else(|| {
        unusable(source, format!("{PUBLISHER} has no arguments = [...] of plain strings"))
    })?;
    published("result in a ROS 2 launch file", &words, source).map(Some)
}

/// The strings of a Python list.
fn quoted(list: &str) -> Vec<String> {
    list.split(['\'', '"']).skip(1).step_by(2).map(String::from).collect()
}

/// What the publisher's arguments say.
fn published(layout: &'static str, words: &[String], source: &Path) -> Result<Found, Error> {
    let refuse = || {
        let what = format!(
            "the arguments of {PUBLISHER} are neither x y z qx qy qz qw PARENT CHILD (or x y z yaw pitch roll) nor \
             --x ... --child-frame-id"
        );
        malformed(Place::file(source), what, "correct the file")
    };
    let (numbers, frames) = flags(words).or_else(|| in_order(words)).ok_or_else(refuse)?;
    let notation = if numbers.len() == 7 { "quaternion-xyzw" } else { "euler-zyx-intrinsic" };
    let [parent, child] = frames;
    let is_cameras = !is_camera(&parent) || is_camera(&child);
    let (body, camera) = if is_cameras { (&parent, &child) } else { (&child, &parent) };
    let mut notes = vec![
        format!("{body} is taken as the body that carries the camera {camera}"),
        format!("the names of frames are not kept: export with --parent {body} --child {camera}"),
    ];
    if !is_cameras {
        notes.push(format!(
            "{camera} is the parent: the pose is that of {body} in the camera, and is inverted"
        ));
    }
    notes.extend(optical(Some(camera)));
    Ok(Found {
        layout,
        pose: pose(&numbers, notation, LengthUnit::Metre, source)?,
        setup: None,
        is_cameras: Some(is_cameras),
        notes,
    })
}

/// Whether a frame is called like a camera's.
fn is_camera(frame: &str) -> bool {
    let lower = frame.to_lowercase();
    ["optical", "camera", "cam_", "_cam", "depth", "rgb", "sensor"]
        .iter()
        .any(|word| lower.contains(word))
        || lower == "cam"
}

type Published = (Vec<f64>, [String; 2]);

/// `--x 0.1 ... --frame-id base --child-frame-id camera`; what is left out is zero.
fn flags(words: &[String]) -> Option<Published> {
    let value = |flag: &str| {
        let at = words.iter().position(|w| w == flag)?;
        words.get(at + 1)
    };
    let number = |flag: &str, default: f64| {
        value(flag).map_or(Some(default), |word| word.parse::<f64>().ok())
    };
    let frames = [value("--frame-id")?.clone(), value("--child-frame-id")?.clone()];
    let is_euler = ["--yaw", "--pitch", "--roll"].iter().any(|flag| value(flag).is_some());
    let turn: &[(&str, f64)] = match is_euler {
        true => &[("--yaw", 0.0), ("--pitch", 0.0), ("--roll", 0.0)],
        false => &[("--qx", 0.0), ("--qy", 0.0), ("--qz", 0.0), ("--qw", 1.0)],
    };
    let place = [("--x", 0.0), ("--y", 0.0), ("--z", 0.0)];
    let numbers = place.iter().chain(turn).map(|(flag, default)| number(flag, *default));
    Some((numbers.collect::<Option<_>>()?, frames))
}

/// `x y z qx qy qz qw parent child`, or with yaw, pitch and roll; of tf, with a period behind.
fn in_order(words: &[String]) -> Option<Published> {
    let count = words.iter().take_while(|w| w.parse::<f64>().is_ok()).count();
    let numbers = words[..count].iter().filter_map(|w| w.parse().ok()).collect();
    let frames = [words.get(count)?.clone(), words.get(count + 1)?.clone()];
    (count == 6 || count == 7).then_some((numbers, frames))
}
