//! A folder of HALCON's poses: a `.dat` for each capture of the robot, and perhaps of the board, which HALCON's own
//! detector found; images beside them. `P1InP2` takes points of P1 into P2: `ToolInBasePose` is `base_from_flange`.

use std::{collections::BTreeMap, path::Path};

use super::{Declared, Described};
use crate::{
    Error,
    dataset::{
        Draft,
        manifest::{BoardDirection, BoardPosesSpec, ImagesSpec, RobotDirection, RobotSpec},
    },
    error::unusable,
    files,
    table::halcon,
    units::LengthUnit,
};

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
    let mut set = Set { source, declared, draft: Draft::new(), questions: vec![] };
    set.robot(robot)?;
    match board {
        Some(board) => set.board_poses(board)?,
        None => set.pictures(&groups),
    }
    set.draft.note_at_end(
        "the tool of HALCON is taken as the flange: the answer is the camera's place on, or under, that",
    );
    Ok(Some(Described {
        layout: "poses of HALCON",
        folder: source.into(),
        setup: None,
        draft: set.draft,
        questions: set.questions,
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

/// What is described so far.
struct Set<'a> {
    source: &'a Path,
    declared: &'a Declared,
    draft: Draft,
    questions: Vec<String>,
}

/// How the numbers of a pose are read.
const NOTATION: &str = "quaternion-xyzw";
const READ_SO: &str = "read so, whatever the type in the file";

impl Set<'_> {
    fn robot(&mut self, files: &str) -> Result<(), Error> {
        let ways = [("base_from_flange", "ToolInBasePose"), ("flange_from_base", "BaseInToolPose")];
        let is_inverse =
            self.is_inverse("robot", files, ways, [&["toolinbase"], &["baseintool"]])?;
        self.draft.note_behind("robot.notation", READ_SO);
        self.draft.manifest.robot = Some(RobotSpec {
            poses: files.into(),
            notation: Some(NOTATION.into()),
            length_unit: Some(LengthUnit::Metre),
            direction: Some(match is_inverse {
                false => RobotDirection::BaseFromFlange,
                true => RobotDirection::FlangeFromBase,
            }),
            ..RobotSpec::default()
        });
        Ok(())
    }

    fn board_poses(&mut self, files: &str) -> Result<(), Error> {
        let ways =
            [("camera_from_target", "ObjInCameraPose"), ("target_from_camera", "CameraInObjPose")];
        let names: [&[&str]; 2] = [&["objincam", "calobjincam", "calplateincam"], &[]];
        let is_inverse = self.is_inverse("board_poses", files, ways, names)?;
        self.draft.note_behind("board_poses.notation", READ_SO);
        self.draft.manifest.board_poses = Some(BoardPosesSpec {
            poses: files.into(),
            notation: Some(NOTATION.into()),
            length_unit: Some(LengthUnit::Metre),
            direction: Some(match is_inverse {
                false => BoardDirection::CameraFromTarget,
                true => BoardDirection::TargetFromCamera,
            }),
            ..BoardPosesSpec::default()
        });
        Ok(())
    }

    /// Whether poses have the second of two directions (ours and HALCON's word for it): as declared, as parts of the
    /// files' name have it, or asked.
    fn is_inverse(
        &mut self,
        section: &str,
        files: &str,
        [one, other]: [(&str, &str); 2],
        names: [&[&str]; 2],
    ) -> Result<bool, Error> {
        let direction = super::Direction::named(one.0).map_err(|e| unusable(self.source, e))?;
        if let Some(declared) = self.declared.between(direction, self.source)? {
            return Ok(declared != direction);
        }
        let bare: String = files.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
        if let Some(way) = names.iter().position(|all| all.iter().any(|name| bare.contains(name))) {
            return Ok(way == 1);
        }
        let what =
            format!("is {files} {} (HALCON's {}) or {} ({})?", one.0, one.1, other.0, other.1);
        self.draft.ask(&[&format!("{section}.direction")], what.as_str());
        self.questions.push(format!("[{section}] direction: {what}"));
        Ok(false)
    }

    /// `[images]` and the question which target they show.
    fn pictures(&mut self, groups: &BTreeMap<String, Vec<std::path::PathBuf>>) {
        let found = groups.keys().find(|name| !name.ends_with(".dat"));
        self.draft.manifest.images = found.map(ImagesSpec::of);
        let question = match found {
            None => {
                "what did the camera see? ([images] files, or [board_poses] of HALCON's calibration object)"
            }
            Some(_) => "which target is in the images?",
        };
        self.draft.ask_target(question);
        self.questions.push(question.into());
    }
}
