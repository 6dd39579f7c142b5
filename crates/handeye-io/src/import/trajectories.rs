//! Trajectories: lines of `t x y z qx qy qz qw` in seconds and metres, apart by commas (`hand_eye_calibration` of
//! ethz-asl) or blanks (TUM), or in nanoseconds with names above (EuRoC). Robot and camera have a file and a clock each. Neither format says what its poses take to
//! what: that is declared. Of robot and camera one is enough where the data prove the other: only in the right
//! direction do both move as one body does.

use std::path::{Path, PathBuf};

use handeye::{Calibration, Config, Setup, Stamped, Verdict, calibrate, math::linalg::median};

use super::{
    Declared, Direction, Imported, declared, split,
    streams::{self, CAMERA, Directions, ROBOT, Recorded},
};
use crate::{
    Error, Place,
    error::{malformed, undeclared, unusable},
    files,
    robot::{Notation, Units},
    table::{self, Layout, Record},
    units::LengthUnit,
};

/// Usual names of the columns.
const COLUMNS: [&[&str]; 8] = [
    &[
        "t",
        "time",
        "timestamp",
        "time_s",
        "stamp",
        "time_ns",
        "timestamp_ns",
        "time_us",
        "timestamp_us",
        "time_ms",
        "timestamp_ms",
    ],
    &["x", "tx", "t_x", "px", "p_x", "p_RS_R_x"],
    &["y", "ty", "t_y", "py", "p_y", "p_RS_R_y"],
    &["z", "tz", "t_z", "pz", "p_z", "p_RS_R_z"],
    &["qx", "q_x", "q_RS_x"],
    &["qy", "q_y", "q_RS_y"],
    &["qz", "q_z", "q_RS_z"],
    &["qw", "q_w", "q_RS_w"],
];
/// Smaller units of time, as names of columns have them, and the least number that can only be a date in them.
const SMALLER: [(&str, f64, f64); 3] = [("ns", 1e-9, 1e17), ("us", 1e-6, 1e14), ("ms", 1e-3, 1e11)];
/// Nobody's poses are so far apart, s.
const LONGEST_STEP_S: f64 = 100.0;
/// Parts of names of files that are the robot's, or the camera's.
const OF_ROBOT: [&str; 7] = ["robot", "hand", "flange", "gripper", "base", "tool", "vicon"];
const OF_CAMERA: [&str; 6] = ["camera", "cam", "eye", "target", "board", "marker"];

pub(super) fn import(source: &Path, declared: &Declared) -> Result<Option<Imported>, Error> {
    let Some((robot, camera)) = both(source, declared)? else { return Ok(None) };
    let recorded = Recorded { robot: read(&robot)?, camera: read(&camera)? };
    let Some(setup) = declared.setup else {
        return Err(undeclared(source, "--setup", declared::WHO_CARRIES));
    };
    let (directions, proof) = directions(&recorded, setup, declared, source)?;
    let streams = recorded.streams(setup, directions);
    let named = |what: &str, path: &Path, direction: Direction, count: usize| {
        format!("{what}: {count} poses of {}, {}", path.display(), direction.name())
    };
    let mut notes = vec![
        named("robot", &robot, directions.0, streams.robot.len()),
        named("camera", &camera, directions.1, streams.camera.len()),
    ];
    notes.extend(proof);
    Ok(Some(Imported {
        layout: "two trajectories",
        folder: if source.is_dir() { source.into() } else { split(source).0 },
        name: streams::NAME.into(),
        text: streams::text(&streams),
        questions: vec![],
        notes,
        next: "handeye solve {}",
    }))
}

/// The files of robot and camera: as named, or the only two of a folder.
fn both(source: &Path, declared: &Declared) -> Result<Option<(PathBuf, PathBuf)>, Error> {
    if let Some(camera) = &declared.camera {
        return Ok(Some((source.into(), camera.clone())));
    }
    if !source.is_dir() {
        let alone = "is one trajectory: robot and camera have one each; \
                     name the camera's behind the robot's";
        return if is_trajectory(source) { Err(unusable(source, alone)) } else { Ok(None) };
    }
    let all: Vec<PathBuf> = trajectories_in(source)?;
    let names: Vec<String> = all.iter().map(|path| split(path).1).collect();
    let same = common_start(&names);
    let named = |parts: &[&str]| -> Vec<&PathBuf> {
        let has = |name: &str| parts.iter().any(|part| name[same..].to_lowercase().contains(part));
        all.iter().zip(&names).filter(|(_, name)| has(name)).map(|(path, _)| path).collect()
    };
    match (&named(&OF_ROBOT)[..], &named(&OF_CAMERA)[..]) {
        _ if all.is_empty() => Ok(None),
        ([robot], [camera]) if robot != camera => Ok(Some(((*robot).clone(), (*camera).clone()))),
        _ => {
            let what = format!(
                "holds the trajectories {}: name the robot's, and behind it the camera's",
                names.join(", ")
            );
            Err(unusable(source, what))
        }
    }
}

/// How many bytes all names begin with.
fn common_start(names: &[String]) -> usize {
    let Some(first) = names.first() else { return 0 };
    let alike = |name: &String| {
        first
            .char_indices()
            .zip(name.chars())
            .take_while(|((_, a), b)| a == b)
            .map(|((k, a), _)| k + a.len_utf8())
            .last()
    };
    names[1..].iter().map(|name| alike(name).unwrap_or(0)).min().unwrap_or(0)
}

fn trajectories_in(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = std::fs::read_dir(folder)
        .map_err(|error| Error::Read { path: folder.into(), source: error })?;
    let mut all: Vec<PathBuf> =
        entries.filter_map(|e| Some(e.ok()?.path())).filter(|p| is_trajectory(p)).collect();
    all.sort();
    Ok(all)
}

/// Whether a file's first records have eight numbers, the last four of them a quaternion.
fn is_trajectory(path: &Path) -> bool {
    let is_text = ["csv", "txt", "tum"].contains(&files::extension(path).as_str());
    if !is_text || !path.is_file() {
        return false;
    }
    let Ok(records) = records(path) else { return false };
    records.iter().take(3).all(|record| sample(record).is_ok())
}

fn read(path: &Path) -> Result<Vec<Stamped<nalgebra::Isometry3<f64>>>, Error> {
    let all: Vec<Stamped<_>> = records(path)?.iter().map(sample).collect::<Result<_, _>>()?;
    let step = median(all.windows(2).map(|two| (two[1].time_s - two[0].time_s).abs()));
    if step > LONGEST_STEP_S {
        let what = format!("poses {step} s apart: its times cannot be in seconds");
        let advice = "name their unit in a first line: time_ns x y z qx qy qz qw, or time_ms ...";
        return Err(malformed(Place::file(path), what, advice));
    }
    Ok(all)
}

/// The lines of a file, with names where a comment above them has them all.
fn records(path: &Path) -> Result<Vec<Record>, Error> {
    let mut all = table::records(path, &Layout::default())?;
    let Some(first) = all.first().filter(|record| record.names.is_empty()) else { return Ok(all) };
    let text = files::table_text(path)?;
    let comment = text.lines().take_while(|line| line.starts_with('#')).last().unwrap_or_default();
    let comment = comment.trim_start_matches('#');
    let names: Vec<String> = match comment.contains(',') {
        true => comment.split(',').map(|name| name.trim().into()).collect(),
        false => comment.split_whitespace().map(String::from).collect(),
    };
    let named = Record { names: names.clone(), ..first.clone() };
    if names.len() == first.cells.len() && named.names_of(&COLUMNS).is_some() {
        all.iter_mut().for_each(|record| record.names = names.clone());
    }
    Ok(all)
}

/// What a time is to be multiplied with, by its column's name, or because it is a date.
fn seconds(record: &Record, time: f64) -> f64 {
    let name = record.names_of(&COLUMNS[..1]).and_then(|names| names.first().cloned());
    let name = name.unwrap_or_default().to_lowercase();
    let is_named =
        |unit: &str| name.contains(&format!("[{unit}]")) || name.ends_with(&format!("_{unit}"));
    let said = SMALLER.iter().find(|(unit, _, _)| is_named(unit));
    let unit = said.or_else(|| SMALLER.iter().find(|(_, _, least)| time.abs() >= *least));
    unit.map_or(1.0, |(_, factor, _)| *factor)
}

/// The unit of positions, by the name of their column; metres where that says nothing.
fn length_unit(record: &Record) -> LengthUnit {
    let name = record.names_of(&COLUMNS[1..2]).and_then(|names| names.first().cloned());
    let name = name.unwrap_or_default().to_lowercase();
    let is_named = |unit: &LengthUnit| {
        let unit = unit.name();
        name.contains(&format!("[{unit}]")) || name.ends_with(&format!("_{unit}"))
    };
    let known = [LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Inch];
    known.into_iter().find(is_named).unwrap_or(LengthUnit::Metre)
}

fn sample(record: &Record) -> Result<Stamped<nalgebra::Isometry3<f64>>, Error> {
    let advice = "a line holds t x y z qx qy qz qw, in seconds and metres";
    let numbers = record.numbers(&COLUMNS, "a trajectory")?;
    let time_s = numbers[0] * seconds(record, numbers[0]);
    let refuse = |what: String| malformed(record.place.clone(), what, advice);
    let notation = Notation::named("quaternion-xyzw").map_err(refuse)?;
    let units = Units { length: length_unit(record), ..notation.own_units() };
    let pose = notation.pose(&numbers[1..], units).map_err(refuse)?;
    Ok(Stamped { time_s, pose })
}

/// The directions, as declared; of one that was not, the data's proof.
fn directions(
    recorded: &Recorded,
    setup: Setup,
    declared: &Declared,
    source: &Path,
) -> Result<(Directions, Option<String>), Error> {
    let given = (declared.between(ROBOT, source)?, declared.between(CAMERA, source)?);
    let ways: [Directions; 2] = match given {
        (Some(robot), Some(camera)) => return Ok(((robot, camera), None)),
        (Some(robot), None) => [(robot, CAMERA), (robot, CAMERA.inverse())],
        (None, Some(camera)) => [(ROBOT, camera), (ROBOT.inverse(), camera)],
        (None, None) => {
            let question = "do the robot's poses take points of the flange into the base (base_from_flange: where \
                            the flange is), or the other way (flange_from_base)? The camera's are proven by the data";
            return Err(undeclared(source, "--direction", question));
        }
    };
    proven(recorded, setup, ways, source).map(|(way, proof)| (way, Some(proof)))
}

/// The one way of two in which robot and camera move together.
fn proven(
    recorded: &Recorded,
    setup: Setup,
    ways: [Directions; 2],
    source: &Path,
) -> Result<(Directions, String), Error> {
    let found = |way: Directions| {
        calibrate(&recorded.streams(setup, way).session(), &Config::default()).ok()
    };
    let both = ways.map(found);
    let fits = |c: &Option<Calibration>| c.as_ref().is_some_and(|c| c.verdict == Verdict::Accepted);
    let open_one = if ways[0].0 == ways[1].0 { ways.map(|w| w.1) } else { ways.map(|w| w.0) };
    let [first, second] = open_one.map(|d| d.name());
    let said = |k: usize, name: &str| {
        let residual = both[k].as_ref().and_then(|c| c.residual.translation_rms_mm);
        residual.map_or(format!("{name} does not fit"), |mm| {
            format!("as {name} they miss by {mm:.1} mm")
        })
    };
    match both.each_ref().map(fits) {
        [true, false] => {
            Ok((ways[0], format!("proven: {}", [said(0, &first), said(1, &second)].join(", "))))
        }
        [false, true] => {
            Ok((ways[1], format!("proven: {}", [said(1, &second), said(0, &first)].join(", "))))
        }
        _ => {
            let question = format!(
                "{first} or {second}? The data do not tell: {}, {}",
                said(0, &first),
                said(1, &second)
            );
            Err(undeclared(source, "--direction", &question))
        }
    }
}
