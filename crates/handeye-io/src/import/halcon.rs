//! A folder of HALCON's poses: a `.dat` for each capture of the robot, and perhaps of the board, which HALCON's own
//! detector found; pictures beside them. `P1InP2` takes points of P1 into P2: `ToolInBasePose` is `base_from_flange`.

use std::{collections::BTreeMap, path::Path};

use super::{Declared, Described, quoted};
use crate::{Error, error::unusable, files, table::halcon};

/// Captures have at least so many files each.
const FEWEST: usize = 3;
/// Parts of names of the robot's poses, and of the board's.
const OF_ROBOT: [&str; 3] = ["robot", "tool", "hand"];
const OF_BOARD: [&str; 5] = ["obj", "cal", "board", "plate", "caltab"];
const PICTURES: [&str; 6] = ["png", "tif", "tiff", "jpg", "jpeg", "bmp"];

pub(super) fn describe(source: &Path, declared: &Declared) -> Result<Option<Described>, Error> {
    if !source.is_dir() {
        return Ok(None);
    }
    let groups = groups(source)?;
    let mut poses = vec![];
    for (name, paths) in groups.iter().filter(|(name, _)| name.ends_with(".dat")) {
        if halcon::is_pose(&files::text(&paths[0])?) {
            poses.push(name.as_str());
        }
    }
    let named = |parts: &[&str]| -> Vec<&str> {
        let has = |name: &&&str| parts.iter().any(|part| name.to_lowercase().contains(part));
        poses.iter().filter(has).copied().collect()
    };
    let (robot, board) = match (&poses[..], &named(&OF_ROBOT)[..], &named(&OF_BOARD)[..]) {
        ([], ..) => return Ok(None),
        ([only], ..) => (*only, None),
        (_, [robot], []) => (*robot, None),
        (_, [robot], [board]) if robot != board => (*robot, Some(*board)),
        _ => {
            let what = format!(
                "holds HALCON's poses {}: which are the robot's? Put \"robot\" into their names, \"obj\" into those \
                 of the calibration object",
                poses.join(", ")
            );
            return Err(unusable(source, what));
        }
    };
    let mut questions = vec![];
    let mut sections = table(
        "robot",
        robot,
        ["base_from_flange", "flange_from_base"],
        source,
        declared,
        &mut questions,
    )?;
    if let Some(board) = board {
        let directions = ["camera_from_target", "target_from_camera"];
        sections += &table("board_poses", board, directions, source, declared, &mut questions)?;
    } else {
        sections = pictures(&groups, &mut questions) + &sections;
    }
    sections += "# the tool of HALCON is taken as the flange: the answer is the camera's place on, or under, that\n";
    Ok(Some(Described {
        layout: "poses of HALCON",
        folder: source.into(),
        setup: None,
        sections,
        questions,
        notes: vec![],
    }))
}

/// Files of one kind whose names differ by their last number: `robot_pose_*.dat`.
fn groups(folder: &Path) -> Result<BTreeMap<String, Vec<std::path::PathBuf>>, Error> {
    let entries = std::fs::read_dir(folder)
        .map_err(|error| Error::Read { path: folder.into(), source: error })?;
    let mut groups: BTreeMap<String, Vec<std::path::PathBuf>> = BTreeMap::new();
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let (stem, ending) = (files::stem(&path), files::extension(&path));
        let start = stem.trim_end_matches(|c: char| c.is_ascii_digit());
        if start.len() < stem.len() && (ending == "dat" || PICTURES.contains(&ending.as_str())) {
            groups.entry(format!("{start}*.{ending}")).or_default().push(path);
        }
    }
    groups.retain(|_, paths| paths.len() >= FEWEST);
    groups.values_mut().for_each(|paths| paths.sort());
    Ok(groups)
}

/// `[robot]` or `[board_poses]`; the direction as declared, as the name has it, or asked.
fn table(
    section: &str,
    files: &str,
    directions: [&str; 2],
    source: &Path,
    declared: &Declared,
    questions: &mut Vec<String>,
) -> Result<String, Error> {
    let bare: String = files.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
    let one = super::Direction::named(directions[0]).map_err(|e| unusable(source, e))?;
    let said = declared.between(one, source)?.map(|d| d.name());
    let in_name = |names: &[&str]| names.iter().any(|name| bare.contains(name));
    let said = said.or_else(|| match section {
        "robot" if in_name(&["toolinbase"]) => Some(directions[0].into()),
        "robot" if in_name(&["baseintool"]) => Some(directions[1].into()),
        "board_poses" if in_name(&["objincam", "calobjincam", "calplateincam"]) => {
            Some(directions[0].into())
        }
        _ => None,
    });
    let direction = match said {
        Some(direction) => format!("direction = \"{direction}\"\n"),
        None => {
            let halcons = if section == "robot" {
                ["ToolInBasePose", "BaseInToolPose"]
            } else {
                ["ObjInCameraPose", "CameraInObjPose"]
            };
            let what = format!(
                "is {files} {} (HALCON's {}) or {} ({})?",
                directions[0], halcons[0], directions[1], halcons[1]
            );
            questions.push(format!("[{section}] direction: {what}"));
            format!("# {what}\n# direction = \"{}\"\n", directions[0])
        }
    };
    Ok(format!(
        "\n[{section}]\nposes = {}\nnotation = \"quaternion-xyzw\" # read so, whatever the type in the file\n\
         length_unit = \"m\"\n{direction}",
        quoted(files)
    ))
}

/// `[images]` and the question which target they show.
fn pictures(
    groups: &BTreeMap<String, Vec<std::path::PathBuf>>,
    questions: &mut Vec<String>,
) -> String {
    let found: Vec<&String> = groups.keys().filter(|name| !name.ends_with(".dat")).collect();
    let question = match found[..] {
        [] => {
            "what did the camera see? ([images] files, or [board_poses] of HALCON's calibration object)"
        }
        _ => "which target is in the images?",
    };
    questions.push(question.into());
    let images = match found[..] {
        [first, ..] => format!("\n[images]\nfiles = {}\n", quoted(first)),
        [] => String::new(),
    };
    format!("\n# {question}\n# [target]\n# kind = \"circle-grid\"\n{images}")
}
