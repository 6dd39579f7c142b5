//! The table of the robot: which file has its poses, and how they are written.

use super::{
    Known,
    groups::Group,
    kind::{Kind, Notation, Poses},
    sections::{Kinds, quoted},
};
use crate::{
    dataset::{
        Draft,
        manifest::{Fields, FileOr, Pairing, PoseFrame, RobotDirection, RobotSpec},
    },
    robot,
    units::{AngleUnit, LengthUnit},
};

/// Poses of the board that another program found are called so.
pub(super) const OF_BOARD: [&str; 6] =
    ["board", "target", "marker", "cpo", "cam_from", "camera_from"];
/// Poses of the robot are called so.
const OF_ROBOT: [&str; 8] = ["robot", "pose", "flange", "gripper", "rpe", "tcp", "arm", "joint"];

fn poses_of(kinds: &Kinds, captures: Option<usize>) -> Vec<(&Group, &Poses)> {
    let mut all: Vec<(&Group, &Poses)> = kinds
        .iter()
        .filter_map(|(g, k)| if let Kind::Poses(p) = k { Some((g, p)) } else { None })
        .filter(|(g, _)| !g.is_called(&OF_BOARD))
        .collect();
    all.sort_by_key(|(g, p)| (Some(p.count) != captures, !g.is_called(&OF_ROBOT)));
    all
}

pub(super) fn robot(kinds: &Kinds, captures: Option<usize>, known: &Known, draft: &mut Draft) {
    let all = poses_of(kinds, captures);
    let Some(((group, poses), others)) = all.split_first() else {
        return unknown_poses(kinds, known, draft);
    };
    draft.note_behind("robot.poses", format!("{} poses in {}", poses.count, group.size()));
    for (other, poses) in others.iter().take(5) {
        let line = format!("or {}, {} poses?", quoted(&other.pattern), poses.count);
        draft.note_below("robot.poses", line);
    }
    let mut spec = RobotSpec { poses: group.pattern.clone(), ..RobotSpec::default() };
    match &known.robot {
        Some(name) => spec.notation = Some(name.clone()),
        None => notation(poses.notation, &poses.called_as, &mut spec, draft),
    }
    if !known.has_maker() {
        spec.length_unit = unit(poses, draft);
    }
    spec.direction = Some(direction(known.has_maker() || is_of_maker(poses.notation), draft));
    if poses.notation != Notation::Joints {
        spec.frame = Some(flange_or_tool(draft));
    }
    draft.manifest.robot = Some(spec);
    if let Some(captures) = captures.filter(|c| *c != poses.count) {
        draft.manifest.captures.pairing = Pairing::Number;
        draft.ask(
            &["captures"],
            format!(
                "{} poses, but {captures} captures of the camera{}: which belong together? Those of \
                 one number in their names (\"number\"), or some rows of the poses (rows = \
                 \"1..{captures}\" in [robot])?",
                poses.count,
                gaps(kinds, poses.count)
            ),
        );
    }
}

fn unknown_poses(kinds: &Kinds, known: &Known, draft: &mut Draft) {
    let all = possible_poses(kinds);
    let (keys, question) = if all.is_empty() {
        (vec!["robot.poses"], "where are the robot's poses?")
    } else {
        (
            vec!["robot.poses", "robot.field"],
            "which of these are the robot's poses? (field = the keys that lead to one pose, * for \
             every element; columns = [..] chooses from tables)",
        )
    };
    draft.ask(&keys, question);
    let mut spec = RobotSpec { poses: "poses.csv".into(), ..RobotSpec::default() };
    if let Some((first, others)) = all.split_first() {
        spec.poses = first.pattern.clone();
        spec.field = first.field.clone().map(Fields::One);
        let last = if first.field.is_some() { "robot.field" } else { "robot.poses" };
        draft.note_behind(last, first.size.as_str());
        for other in others {
            let field =
                other.field.as_ref().map_or(String::new(), |f| format!("  field = {}", quoted(f)));
            let poses = quoted(&other.pattern);
            draft.note_below(last, format!("or poses = {poses}{field}  # {}", other.size));
        }
    }
    match &known.robot {
        Some(name) => spec.notation = Some(name.clone()),
        None => notation(Notation::SomeAngles { degrees: false }, &[], &mut spec, draft),
    }
    if !known.has_maker() {
        spec.length_unit = Some(LengthUnit::Millimetre);
        draft.ask(
            &["robot.length_unit"],
            "are the positions in \"m\" or in \"mm\"? (generic notations only)",
        );
    }
    spec.direction = Some(direction(known.has_maker(), draft));
    spec.frame = Some(flange_or_tool(draft));
    draft.manifest.robot = Some(spec);
}

/// Files in which poses may stand.
struct Candidate {
    pattern: String,
    field: Option<String>,
    count: usize,
    size: String,
}

/// Where poses may stand, those with most of them first.
fn possible_poses(kinds: &Kinds) -> Vec<Candidate> {
    let mut all: Vec<Candidate> = Vec::new();
    for (group, kind) in kinds {
        let Kind::Table(fields) = kind else { continue };
        let pattern = group.pattern.clone();
        if fields.is_empty() {
            let (count, size) = (group.members.len(), group.size());
            all.push(Candidate { pattern: pattern.clone(), field: None, count, size });
        }
        all.extend(fields.iter().take(5).map(|f| {
            let count = f.count * group.members.len();
            let field = (!f.path.is_empty()).then(|| f.path.clone());
            let size = format!("{count} of {} numbers", f.numbers);
            Candidate { pattern: pattern.clone(), field, count, size }
        }));
    }
    all.sort_by_key(|candidate| std::cmp::Reverse(candidate.count));
    all.truncate(6);
    all
}

/// The notation, as far as the numbers prove it; the rest is asked.
fn notation(notation: Notation, called_as: &[&str], spec: &mut RobotSpec, draft: &mut Draft) {
    let name = match notation {
        Notation::Is(name) => name,
        Notation::SomeQuaternion => "quaternion-xyzw",
        Notation::Joints => "joints",
        Notation::SomeAngles { .. } if !called_as.is_empty() => called_as[0],
        Notation::SomeAngles { degrees: true } => "kuka",
        Notation::SomeAngles { degrees: false } => "ur",
    };
    spec.notation = Some(name.into());
    if notation == Notation::Joints {
        spec.angle_unit = Some(AngleUnit::Degree);
        spec.dh = Some(FileOr::File("robot_dh.json".into()));
    }
    let question: String = match notation {
        Notation::Is(_) => return,
        Notation::SomeQuaternion => {
            "a position and a unit quaternion: does its scalar stand last (\"quaternion-xyzw\"), \
             or first (\"quaternion-wxyz\", and \"abb\")?"
                .into()
        }
        Notation::Joints => {
            draft.ask(&["robot.angle_unit"], "joint values: in \"deg\" or in \"rad\"?");
            let of_arm =
                "which file holds the Denavit-Hartenberg parameters of the arm? (or urdf = {...})";
            return draft.ask(&["robot.dh"], of_arm);
        }
        Notation::SomeAngles { .. } if !called_as.is_empty() => {
            let quoted: Vec<String> = called_as.iter().map(|name| quoted(name)).collect();
            format!(
                "the numbers are called as {} have them: whose robot is it? (or euler-zyx-intrinsic and the like)",
                quoted.join(" and ")
            )
        }
        Notation::SomeAngles { degrees: true } => format!(
            "a position and three angles in degrees: whose robot, or in which order? {}, or \
             euler-zyx-intrinsic and the like",
            robot::names_in_degrees()
        ),
        Notation::SomeAngles { degrees: false } => format!(
            "how are the poses written? {}, euler-zyx-intrinsic (with angle_unit), joints ...",
            robot::usual_names()
        ),
    };
    draft.ask(&["robot.notation", "robot.angle_unit", "robot.dh"], question);
}

/// The unit of positions: makers' notations bring theirs.
fn unit(poses: &Poses, draft: &mut Draft) -> Option<LengthUnit> {
    let generic = match poses.notation {
        Notation::Is(name) => name.starts_with("quaternion") || name == "matrix4x4",
        Notation::Joints => false,
        _ => true,
    };
    if !generic {
        return None;
    }
    let question =
        "are the positions in \"m\" or in \"mm\"? (not needed with a robot maker's notation)";
    Some(proven_unit("robot.length_unit", &poses.unit, question, draft))
}

/// A unit that the numbers prove, or the question which it is.
pub(super) fn proven_unit(
    key: &str,
    unit: &Option<(LengthUnit, String)>,
    question: &str,
    draft: &mut Draft,
) -> LengthUnit {
    let Some((unit, why)) = unit else {
        draft.ask(&[key], question);
        return LengthUnit::Millimetre;
    };
    draft.note_behind(key, why.as_str());
    *unit
}

/// Which poses have no image, where the names of images are numbered and some are missing in between.
fn gaps(kinds: &Kinds, poses: usize) -> String {
    let pictures =
        kinds.iter().find(|(_, k)| matches!(k, Kind::Pictures | Kind::Clouds | Kind::Depth));
    let Some((group, _)) = pictures else { return String::new() };
    let number = |m: &std::path::PathBuf| {
        let stem = crate::files::stem(m);
        let digits: String = stem.chars().rev().take_while(char::is_ascii_digit).collect();
        digits.chars().rev().collect::<String>().parse::<usize>().ok()
    };
    let Some(numbers) = group.members.iter().map(number).collect::<Option<Vec<usize>>>() else {
        return String::new();
    };
    let first = numbers.iter().copied().min().unwrap_or(0);
    let missing: Vec<String> = (first..first.saturating_add(poses.max(numbers.len())))
        .filter(|n| !numbers.contains(n))
        .map(|n| n.to_string())
        .collect();
    match missing.len() {
        1..=5 if missing.len() + numbers.len() == poses => {
            format!(" (no image of number {})", missing.join(", "))
        }
        _ => String::new(),
    }
}

/// Controllers show the pose of the active tool; the numbers do not prove which it is.
fn flange_or_tool(draft: &mut Draft) -> PoseFrame {
    draft.ask(
        &["robot.frame"],
        "are these the poses of the \"flange\", or of the active \"tool\"? Controllers show the active tool (TCP): it is \
         the flange only where tool 0 or no tool was active. For the tool, say in [robot.tool] where it is on the flange \
         (translation_mm, rotation_xyzw)",
    );
    PoseFrame::Flange
}

/// Whether the file itself proves a maker's notation, as its controller writes it.
fn is_of_maker(notation: Notation) -> bool {
    match notation {
        Notation::Is(name) => robot::Notation::named(name).is_ok_and(|n| n.length_unit.is_some()),
        _ => false,
    }
}

fn direction(is_controllers: bool, draft: &mut Draft) -> RobotDirection {
    if is_controllers {
        draft.note_behind("robot.direction", "what controllers show");
        return RobotDirection::BaseFromFlange;
    }
    draft.ask(
        &["robot.direction"],
        "which pose does the file contain: the flange in the base (\"base_from_flange\", what controllers show), or the base in the flange (\"flange_from_base\")?",
    );
    RobotDirection::BaseFromFlange
}
