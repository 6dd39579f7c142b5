//! KinHEC: `sequences.parquet`, and the robot's and camera's frames of each sequence in `robot` and `camera`. Poses are
//! `base_ee` and `cam_target`, metres, the quaternion's scalar first. What was measured is taken, never the truth.
//!
//! A. Aiersilan, KinHEC: a kinematic trajectory benchmark for hand-eye and robot-world calibration, 2026.

use std::{collections::BTreeMap, path::Path};

use handeye::{Base, Camera, Flange, Pose, Setup, Stamped, Target};
use nalgebra::Isometry3;
use serde_json::json;

use super::{
    Declared, Imported, declared,
    streams::{self, CAMERA, ROBOT, Recorded},
};
use crate::{
    Error, Place,
    error::{malformed, nearest, undeclared, unusable},
    parquet::Parquet,
    robot::Notation,
};

const SEQUENCES: &str = "sequences.parquet";
/// So many names are listed where none was chosen.
const MOST_LISTED: usize = 24;
/// More frames than that has no sequence.
const MOST_FRAMES: usize = 200_000;

/// A frame of a stream.
struct Frame {
    number: f64,
    stamped: Stamped<Isometry3<f64>>,
}

/// What the table of sequences says of one.
struct Sequence {
    id: String,
    setup: Setup,
    is_synchronous: bool,
    unknown_scale: bool,
    files: [String; 2],
}

pub(super) fn import(source: &Path, declared: &Declared) -> Result<Option<Imported>, Error> {
    let table = source.join(SEQUENCES);
    if !source.is_dir() || !table.is_file() {
        return Ok(None);
    }
    let sequence = sequence(&table, declared)?;
    declared::setup(Some(sequence.setup), declared.setup, source)?;
    let [robot, camera] = &sequence.files;
    let robot = frames(&beside(source, robot)?, "base_ee_meas", &sequence.id)?;
    let camera = frames(&beside(source, camera)?, "cam_target_meas", &sequence.id)?;
    let notes = vec![format!(
        "{}: {} poses of the robot and {} of the camera as measured, {}{}",
        sequence.id,
        robot.len(),
        camera.len(),
        if sequence.is_synchronous { "in pairs" } else { "by two clocks" },
        if sequence.unknown_scale { ", distances known up to one factor" } else { "" },
    )];
    Ok(Some(Imported {
        layout: "KinHEC",
        folder: source.into(),
        name: format!("{}.json", sequence.id),
        text: match sequence.is_synchronous {
            true => pairs(&sequence, &robot, &camera),
            false => two_streams(&sequence, robot, camera),
        },
        questions: vec![],
        notes,
        next: "handeye solve {}",
    }))
}

/// The row of the sequence that was asked for, or of the only one.
fn sequence(path: &Path, declared: &Declared) -> Result<Sequence, Error> {
    let table = Parquet::read(path)?;
    let mut ids = vec![];
    for group in 0..table.groups() {
        let names = table.texts(group, "sequence_id")?;
        ids.extend(names.into_iter().enumerate().map(|(row, name)| (group, row, name)));
    }
    let found = match (&declared.sequence, &ids[..]) {
        (Some(wanted), all) => all.iter().find(|(_, _, id)| id == wanted),
        (None, [only]) => Some(only),
        (None, _) => None,
    };
    if let (Some(wanted), None) = (&declared.sequence, found) {
        let near = nearest(wanted, ids.iter().map(|(_, _, id)| id.as_str()));
        let meant =
            near.map_or(format!("there are {}", listed(&ids)), |n| format!("did you mean {n}?"));
        return Err(unusable(path, format!("has no sequence {wanted}; {meant}")));
    }
    let Some((group, row, id)) = found else {
        let question = format!("which of its {} sequences? {}", ids.len(), listed(&ids));
        return Err(undeclared(path, "--sequence", &question));
    };
    let text = |name: &str| Ok(table.texts(*group, name)?.swap_remove(*row));
    let number = |name: &str| Ok(table.numbers(*group, name)?[*row]);
    let setup = match text("configuration")?.as_str() {
        "eye_in_hand" => Setup::EyeInHand,
        "eye_to_hand" => Setup::EyeToHand,
        other => {
            let what = format!(
                "{id} has the configuration {other:?}: neither eye_in_hand nor eye_to_hand"
            );
            return Err(unusable(path, what));
        }
    };
    Ok(Sequence {
        setup,
        is_synchronous: text("sync")? == "synchronous",
        unknown_scale: number("scale")? != 1.0 || number("scale_drift_std")? > 0.0,
        files: [text("robot_file")?, text("camera_file")?],
        id: id.clone(),
    })
}

fn listed(ids: &[(usize, usize, String)]) -> String {
    let names: Vec<&str> = ids.iter().take(MOST_LISTED).map(|(_, _, id)| id.as_str()).collect();
    let more = ids.len().saturating_sub(MOST_LISTED);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    names.join(", ") + &rest
}

/// A file below the folder, and nowhere else.
fn beside(folder: &Path, name: &str) -> Result<std::path::PathBuf, Error> {
    let is_plain =
        Path::new(name).components().all(|c| matches!(c, std::path::Component::Normal(_)));
    if name.is_empty() || !is_plain {
        return Err(unusable(
            &folder.join(SEQUENCES),
            format!("names the file {name:?}, which does not lie in the folder"),
        ));
    }
    Ok(folder.join(name))
}

/// The frames of a sequence in which something was measured.
fn frames(path: &Path, prefix: &str, id: &str) -> Result<Vec<Frame>, Error> {
    let table = Parquet::read(path)?;
    let mut all = vec![];
    for group in 0..table.groups() {
        let ids = table.texts(group, "sequence_id")?;
        if !ids.iter().any(|own| own == id) {
            continue;
        }
        let column = |name: &str| table.numbers(group, name);
        let (number, time) = (column("frame")?, column("t")?);
        let parts = ["px", "py", "pz", "qw", "qx", "qy", "qz"];
        let parts: Vec<Vec<f64>> = parts
            .iter()
            .map(|part| column(&format!("{prefix}_{part}")))
            .collect::<Result<_, _>>()?;
        for row in (0..ids.len()).filter(|row| ids[*row] == id) {
            let values: Vec<f64> = parts.iter().map(|part| part[row]).collect();
            if values.iter().all(|x| x.is_finite()) {
                let pose = pose(&values).map_err(|what| broken(path, id, number[row], what))?;
                let stamped = Stamped { time_s: time[row], pose };
                all.push(Frame { number: number[row], stamped });
            }
        }
    }
    match all.len() {
        0 => Err(unusable(path, format!("holds no pose of {id} that was measured"))),
        1..=MOST_FRAMES => Ok(all),
        many => Err(unusable(path, format!("{id} has {many} frames, more than {MOST_FRAMES}"))),
    }
}

fn pose(values: &[f64]) -> Result<Isometry3<f64>, String> {
    let notation = Notation::named("quaternion-wxyz")?;
    notation.pose(values, notation.own_units())
}

fn broken(path: &Path, id: &str, frame: f64, what: String) -> Error {
    malformed(
        Place::file(path),
        format!("{id}, frame {frame}: {what}"),
        "generate the data set again",
    )
}

fn two_streams(sequence: &Sequence, robot: Vec<Frame>, camera: Vec<Frame>) -> String {
    let bare = |frames: Vec<Frame>| frames.into_iter().map(|f| f.stamped).collect();
    let recorded = Recorded { robot: bare(robot), camera: bare(camera) };
    let mut streams = recorded.streams(sequence.setup, (ROBOT, CAMERA));
    streams.unknown_scale = sequence.unknown_scale;
    streams::text(&streams)
}

/// Frames of the same number were taken at the same moment.
fn pairs(sequence: &Sequence, robot: &[Frame], camera: &[Frame]) -> String {
    let numbered: BTreeMap<u64, &Frame> = robot.iter().map(|r| (r.number.to_bits(), r)).collect();
    let line = |c: &Frame| {
        let r = numbered.get(&c.number.to_bits())?;
        let pair = json!({
            "id": c.number.to_string(),
            "base_from_flange": Pose::<Base, Flange>::claim(r.stamped.pose),
            "camera_from_target": Pose::<Camera, Target>::claim(c.stamped.pose),
        });
        Some(pair.to_string())
    };
    let lines: Vec<String> = camera.iter().filter_map(line).collect();
    streams::document(sequence.setup, sequence.unknown_scale, &[("pairs", lines)])
}
