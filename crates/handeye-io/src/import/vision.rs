//! Results of vision programs: Zivid's and OpenCV's YAML, HALCON's `.dat`, Mech-Mind's ExtrinsicParameters.

use std::path::Path;

use super::{
    Declared, Direction, opencv,
    results::{Found, pose},
    split,
};
use crate::{
    Error, Place,
    error::{malformed, undeclared, unusable},
    files,
    table::{self, halcon},
    tree::Tree,
    units::LengthUnit,
};

/// Keys of Zivid's matrices, in millimetres: of its own format, and of its older samples (OpenCV's).
pub(super) const ZIVID: [&str; 2] = ["FloatMatrix", "PoseState"];

/// A 4 x 4 matrix in a YAML, XML or JSON file, or a rotation and a translation beside each other.
pub(super) fn zivid_or_opencv(source: &Path, declared: &Declared) -> Result<Option<Found>, Error> {
    if !["yaml", "yml", "xml", "json"].contains(&files::extension(source).as_str()) {
        return Ok(None);
    }
    let Tree::Map(entries) = Tree::read(source)? else { return Ok(None) };
    let all = opencv::transforms(&entries);
    let named: Vec<&opencv::Transform> = all.iter().filter(|t| t.direction.is_some()).collect();
    let transform = match (&all[..], &named[..]) {
        ([], _) => return Ok(None),
        (_, [one]) => *one,
        ([one], _) => one,
        _ => {
            let names: Vec<&str> = all.iter().map(|t| t.name.as_str()).collect();
            let what = format!(
                "holds {}: leave one in it, or call it cam2gripper or cam2base",
                names.join(", ")
            );
            return Err(unusable(source, what));
        }
    };
    let (key, own) = (&transform.name, transform.direction);
    let found = |layout, unit, is_cameras, notes| {
        let pose = pose(&transform.numbers, "matrix4x4", unit, source)?;
        let setup = own.and_then(Direction::setup);
        Ok(Some(Found { layout, pose, setup, is_cameras, notes }))
    };
    if ZIVID.contains(&key.as_str()) {
        let unit = declared.length_unit.unwrap_or(LengthUnit::Millimetre);
        let note = format!(
            "{key} is taken as Zivid's hand-eye transform: the pose of the camera, in {}",
            unit.name()
        );
        return found("result of Zivid", unit, Some(true), vec![note]);
    }
    let unit = match declared.length_unit {
        Some(unit) => unit,
        None if Direction::named(key).is_ok() => LengthUnit::Metre, // as this program exports it
        None => {
            let question = format!("is the position in {key} in m, mm, cm or inch?");
            return Err(undeclared(source, "--length-unit", &question));
        }
    };
    let read = own.map_or(String::new(), |d| format!(" is read as {}, and", d.name()));
    let notes = vec![format!("{key}{read} is in {}", unit.name())];
    found("matrix of OpenCV", unit, own.map(|d| d.from == "camera"), notes)
}

/// HALCON's `P1InP2` takes points of P1 into P2. What a file holds, its name or a comment may say.
pub(super) fn halcon(source: &Path, _: &Declared) -> Result<Option<Found>, Error> {
    if files::extension(source) != "dat" {
        return Ok(None);
    }
    let text = files::text(source)?;
    if !halcon::is_pose(&text) {
        return Ok(None);
    }
    let [record] = &table::records(source, &table::Layout::default())?[..] else { return Ok(None) };
    let numbers = record.numbers(&halcon::COLUMNS, "a pose of HALCON")?;
    let said = in_words(&text).or_else(|| in_words(&split(source).1));
    Ok(Some(Found {
        layout: "pose of HALCON",
        pose: pose(&numbers, "quaternion-xyzw", LengthUnit::Metre, source)?,
        setup: said.and_then(Direction::setup),
        is_cameras: said.map(|d| d.from == "camera"),
        notes: said.map(|d| format!("read as {}", d.name())).into_iter().collect(),
    }))
}

/// `ToolInCamPose` and the like, in a name or a comment.
fn in_words(text: &str) -> Option<Direction> {
    let bare: String = text.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
    let names = [
        ("toolincam", Direction::of("camera", "flange")),
        ("baseincam", Direction::of("camera", "base")),
        ("camintool", Direction::of("flange", "camera")),
        ("caminbase", Direction::of("base", "camera")),
    ];
    names.into_iter().find(|(name, _)| bare.contains(name)).map(|(_, direction)| direction)
}

/// What stands in front of the numbers.
const MECH_MIND: &str = "ExtrinsicParameters:";

/// `x y z qw qx qy qz`, millimetres, or a 4 x 4 matrix: where the camera sits.
pub(super) fn mech_mind(source: &Path, declared: &Declared) -> Result<Option<Found>, Error> {
    if files::extension(source) != "txt" {
        return Ok(None);
    }
    let text = files::text(source)?;
    let Some(rest) = text.trim_start().strip_prefix(MECH_MIND) else { return Ok(None) };
    let spaced: String =
        rest.chars().map(|c| if ",;:=[]()".contains(c) { ' ' } else { c }).collect();
    let numbers: Vec<f64> = spaced.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    let notation = match numbers.len() {
        7 if has_scalar_last(rest) => "quaternion-xyzw",
        7 => "quaternion-wxyz",
        16 => "matrix4x4",
        count => {
            let what = format!("{count} numbers behind {MECH_MIND}: x y z qw qx qy qz are needed");
            return Err(malformed(Place::file(source), what, "name the file as it was saved"));
        }
    };
    let unit = declared.length_unit.unwrap_or(LengthUnit::Millimetre);
    Ok(Some(Found {
        layout: "result of Mech-Mind",
        pose: pose(&numbers, notation, unit, source)?,
        setup: None,
        is_cameras: Some(true),
        notes: vec![format!("read as the pose of the camera: {notation}, {}", unit.name())],
    }))
}

/// Where names stand beside the numbers, whether `qx` comes before `qw`.
fn has_scalar_last(text: &str) -> bool {
    let lower = text.to_lowercase();
    matches!((lower.find("qw"), lower.find("qx")), (Some(w), Some(x)) if x < w)
}
