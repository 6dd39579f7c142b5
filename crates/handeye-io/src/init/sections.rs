//! The manifest's tables, one after the other.

use std::path::Path;

use handeye::TargetModel;

use super::{
    Known,
    groups::Group,
    kind::{self, Kind, Notation, Poses, Touches},
};
use crate::{
    PixelOrigin,
    camera::CameraSpec,
    dataset::{
        Draft, EXAMPLE_TARGET,
        manifest::{
            BoardDirection, BoardPosesSpec, CornersSpec, Fields, FileOr, ImagesSpec, Pairing,
            PlacementSpec, PoseFrame, RobotDirection, RobotSpec, ScansSpec, TipSpec, TouchKind,
            TouchesSpec,
        },
    },
    robot, scan_unit,
    units::{AngleUnit, LengthUnit},
};

/// Files and what they hold.
type Kinds = [(Group, Kind)];

/// Poses of the board that another program found are called so.
const OF_BOARD: [&str; 6] = ["board", "target", "marker", "cpo", "cam_from", "camera_from"];
/// Poses of the robot are called so.
const OF_ROBOT: [&str; 8] = ["robot", "pose", "flange", "gripper", "rpe", "tcp", "arm", "joint"];

pub(super) fn draft(kinds: &Kinds, folder: &Path, known: &Known) -> Draft {
    let mut draft = Draft::new();
    draft.head("What the files prove is filled in. Answer every QUESTION: correct the lines below it and remove their #.");
    draft.set_setup(
        known.setup,
        "does the robot carry the camera (\"eye-in-hand\"), or the board (\"eye-to-hand\")?",
    );
    let seen = kinds
        .iter()
        .any(|(_, k)| matches!(k, Kind::Pictures | Kind::Depth | Kind::Clouds | Kind::Corners));
    let touched = touches(kinds);
    let placements = touched.map_or(vec![], |(_, t)| t.placements.clone());
    let captures = captures(kinds, &placements);
    if seen {
        target(kinds, known, &mut draft);
        camera(kinds, &mut draft);
    }
    robot(kinds, captures, known, &mut draft);
    pictures(kinds, &placements, &mut draft);
    scans(kinds, folder, &placements, &mut draft);
    corners(kinds, &placements, &mut draft);
    if !seen {
        board_poses(kinds, &mut draft);
    }
    if let Some((group, touches)) = touched {
        placed(kinds, touches, &mut draft);
        touched_corners(group, touches, &mut draft);
    }
    draft
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.into()).to_string()
}

/// Groups of one kind that are no placements'.
fn of_kind<'a>(
    kinds: &'a Kinds,
    placements: &[String],
    wanted: impl Fn(&Kind) -> bool,
) -> Vec<&'a Group> {
    let placed = |g: &Group| {
        let stems = g.members.iter().map(|m| crate::files::stem(m));
        stems.into_iter().all(|s| placements.contains(&s))
    };
    let of = kinds.iter().filter(|(g, k)| wanted(k) && !placed(g));
    of.map(|(g, _)| g).collect()
}

/// How many captures the camera has recorded.
fn captures(kinds: &Kinds, placements: &[String]) -> Option<usize> {
    let seen = |k: &Kind| matches!(k, Kind::Pictures | Kind::Depth | Kind::Clouds | Kind::Corners);
    of_kind(kinds, placements, seen).first().map(|g| g.members.len())
}

/// The value of a key that names files; the other groups that may be meant stand below it.
fn files(key: &str, groups: &[&Group], draft: &mut Draft) -> Option<String> {
    let (first, others) = groups.split_first()?;
    draft.note_behind(key, first.size());
    for other in others.iter().take(5) {
        draft.note_below(key, format!("or {}, {}?", quoted(&other.pattern), other.size()));
    }
    Some(first.pattern.clone())
}

// ---------------------------------------------------------------- target, camera

fn target(kinds: &Kinds, known: &Known, draft: &mut Draft) {
    if let Some(target) = &known.target {
        return draft.set_target(target.clone());
    }
    let known: Vec<(&Group, &TargetModel)> = kinds
        .iter()
        .filter_map(|(g, k)| if let Kind::Target(t) = k { Some((g, t)) } else { None })
        .collect();
    if let [(group, target)] = known[..] {
        draft.set_target(target.clone());
        return draft.note("target.kind", format!("as {} says", group.pattern));
    }
    draft.set_target(EXAMPLE_TARGET);
    draft.ask(
        &["target.kind", "target.columns", "target.rows", "target.square_mm"],
        "which board is it: \"checkerboard\", \"charuco\" or \"tag\"? How many INNER corners has \
         it along x and y, and how long is the side of a square? (Measure the print over many \
         squares.)",
    );
    for line in [
        "charuco: squares_x, squares_y, square_mm, marker_mm, dictionary = \"DICT_6X6_250\"",
        "tag: dictionary, id, size_mm",
    ] {
        draft.note_below("target.square_mm", line);
    }
}

fn camera(kinds: &Kinds, draft: &mut Draft) {
    let cameras: Vec<&Group> = of_kind(kinds, &[], |k| matches!(k, Kind::Camera));
    let members = cameras.iter().flat_map(|g| &g.members);
    let names: Vec<String> = members.map(|m| m.to_string_lossy().replace('\\', "/")).collect();
    let Some((first, others)) = names.split_first() else {
        return draft.note("robot", "[camera]: no calibration of the camera was found; it is calibrated from the images. A file of intrinsics, or width, height, fx, fy, cx, cy and distortion, is better.");
    };
    draft.manifest.camera = Some(CameraSpec::of_file(first));
    if others.is_empty() {
        return;
    }
    draft.ask(
        &["camera.file"],
        "which of these is the calibration of the camera that took the images?",
    );
    for name in others {
        draft.note_below("camera.file", format!("file = {}", quoted(name)));
    }
}

// ---------------------------------------------------------------- robot

fn poses_of(kinds: &Kinds, captures: Option<usize>) -> Vec<(&Group, &Poses)> {
    let mut all: Vec<(&Group, &Poses)> = kinds
        .iter()
        .filter_map(|(g, k)| if let Kind::Poses(p) = k { Some((g, p)) } else { None })
        .filter(|(g, _)| !g.is_called(&OF_BOARD))
        .collect();
    all.sort_by_key(|(g, p)| (Some(p.count) != captures, !g.is_called(&OF_ROBOT)));
    all
}

fn robot(kinds: &Kinds, captures: Option<usize>, known: &Known, draft: &mut Draft) {
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
        None => notation(poses.notation, &mut spec, draft),
    }
    if !known.has_maker() {
        spec.length_unit = unit(poses, draft);
    }
    spec.direction = Some(direction(known, draft));
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
        None => notation(Notation::SomeAngles { degrees: false }, &mut spec, draft),
    }
    if !known.has_maker() {
        spec.length_unit = Some(LengthUnit::Millimetre);
        draft.ask(
            &["robot.length_unit"],
            "are the positions in \"m\" or in \"mm\"? (generic notations only)",
        );
    }
    spec.direction = Some(direction(known, draft));
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
fn notation(notation: Notation, spec: &mut RobotSpec, draft: &mut Draft) {
    let name = match notation {
        Notation::Is(name) => name,
        Notation::SomeQuaternion => "quaternion-xyzw",
        Notation::Joints => "joints",
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
fn proven_unit(
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

fn direction(known: &Known, draft: &mut Draft) -> RobotDirection {
    if known.has_maker() {
        draft.note_behind("robot.direction", "what controllers show");
        return RobotDirection::BaseFromFlange;
    }
    draft.ask(
        &["robot.direction"],
        "which pose does the file contain: the flange in the base (\"base_from_flange\", what controllers show), or the base in the flange (\"flange_from_base\")?",
    );
    RobotDirection::BaseFromFlange
}

// ---------------------------------------------------------------- what the camera saw

fn pictures(kinds: &Kinds, placements: &[String], draft: &mut Draft) {
    let groups = of_kind(kinds, placements, |k| matches!(k, Kind::Pictures));
    draft.manifest.images = files("images.files", &groups, draft).map(ImagesSpec::of);
}

fn scans(kinds: &Kinds, folder: &Path, placements: &[String], draft: &mut Draft) {
    let groups = of_kind(kinds, placements, |k| matches!(k, Kind::Depth | Kind::Clouds));
    let Some(first) = groups.first() else { return };
    let files = files("scans.files", &groups, draft).unwrap_or_default();
    let depth = kinds.iter().any(|(g, k)| g.pattern == first.pattern && matches!(k, Kind::Depth));
    let mut spec = ScansSpec { files, ..ScansSpec::default() };
    if scan_unit(&folder.join(&first.members[0])).is_some() {
        // the files say it
    } else if depth {
        spec.depth_scale = Some(0.001);
        draft.ask(
            &["scans.depth_scale"],
            "how many metres is one unit of depth? (0.001 for millimetres)",
        );
        let images = of_kind(kinds, placements, |k| matches!(k, Kind::Pictures));
        let size = |g: &&Group| kind::size_of(g, folder);
        let (of_scan, of_image) = (size(first), images.first().and_then(size));
        if of_scan.is_none() || of_scan != of_image {
            spec.camera = Some(CameraSpec::of_file("depth_camera.yaml"));
            draft.ask(
                &["scans.camera"],
                "has the depth image other intrinsics than the images? (where it has other pixels)",
            );
        }
    } else {
        spec.length_unit = Some(LengthUnit::Millimetre);
        draft.ask(&["scans.length_unit"], "are the points in \"m\" or in \"mm\"?");
    }
    draft.manifest.scans = Some(spec);
}

fn corners(kinds: &Kinds, placements: &[String], draft: &mut Draft) {
    let groups = of_kind(kinds, placements, |k| matches!(k, Kind::Corners));
    let Some(files) = files("corners.files", &groups, draft) else { return };
    draft.manifest.corners = Some(CornersSpec { files, pixel_origin: Some(PixelOrigin::Centre) });
    draft.ask(
        &["corners.pixel_origin"],
        "is (0, 0) the \"centre\" of the first pixel, as in OpenCV, or its outer \"corner\"?",
    );
}

fn board_poses(kinds: &Kinds, draft: &mut Draft) {
    let mut all = kinds.iter().filter(|(g, _)| g.is_called(&OF_BOARD));
    let named = all.find(|(_, k)| matches!(k, Kind::Poses(_))).map(|(g, _)| g.pattern.clone());
    draft.manifest.board_poses = Some(BoardPosesSpec {
        poses: named.unwrap_or("board_poses.csv".into()),
        notation: Some("matrix4x4".into()),
        length_unit: Some(LengthUnit::Metre),
        direction: Some(BoardDirection::CameraFromTarget),
        ..BoardPosesSpec::default()
    });
    draft.ask(
        &["board_poses"],
        "there are no images, scans or corners: what did the camera see? With poses of the board \
         from another program, say where and how they are written.",
    );
}

// ---------------------------------------------------------------- touches

fn touches(kinds: &Kinds) -> Option<(&Group, &Touches)> {
    kinds.iter().find_map(|(g, k)| if let Kind::Touches(t) = k { Some((g, t)) } else { None })
}

/// The files of a placement.
fn placement(kinds: &Kinds, id: &str) -> PlacementSpec {
    let mut spec = PlacementSpec { id: id.into(), ..PlacementSpec::default() };
    for (group, kind) in kinds {
        let own = group.members.iter().find(|m| crate::files::stem(m) == *id);
        let name = own.map(|file| file.to_string_lossy().replace('\\', "/"));
        let key = match kind {
            Kind::Pictures => &mut spec.image,
            Kind::Depth | Kind::Clouds => &mut spec.scan,
            Kind::Corners => &mut spec.corners,
            _ => continue,
        };
        if name.is_some() {
            *key = name;
        }
    }
    spec
}

fn placed(kinds: &Kinds, touches: &Touches, draft: &mut Draft) {
    let specs = touches.placements.iter().map(|id| placement(kinds, id));
    let has_files = |spec: &PlacementSpec| {
        spec.image.is_some() || spec.scan.is_some() || spec.corners.is_some()
    };
    let (mut found, orphans): (Vec<_>, Vec<_>) = specs.partition(has_files);
    for orphan in orphans {
        let question = format!(
            "the touches name a placement {}: which image shows the board there? (not needed where \
             the camera is on the robot and the board is that of the captures)",
            quoted(&orphan.id)
        );
        draft.ask(&[&format!("placements.{}", found.len())], question);
        found.push(PlacementSpec { image: Some("placement.png".into()), ..orphan });
    }
    draft.manifest.placements = found;
}

fn touched_corners(group: &Group, touches: &Touches, draft: &mut Draft) {
    draft.note_behind("touches.file", format!("{} touches", touches.count));
    let mut spec = TouchesSpec { file: Some(group.pattern.clone()), ..TouchesSpec::default() };
    let Some(poses) = &touches.poses else {
        let question = "is the tip in \"m\" or in \"mm\"?";
        let unit = proven_unit("touches.length_unit", &touches.unit, question, draft);
        (spec.kind, spec.length_unit) = (Some(TouchKind::Tip), Some(unit));
        draft.manifest.touches = Some(spec);
        return;
    };
    spec.kind = Some(match poses.notation {
        Notation::Joints => TouchKind::Joints,
        _ => TouchKind::FlangePose,
    });
    if let Notation::Is(name) = poses.notation {
        spec.notation = Some(name.into());
        if let Some((unit, why)) = &poses.unit {
            spec.length_unit = Some(*unit);
            draft.note_behind("touches.length_unit", why.as_str());
        }
    } else {
        let note = "written as in [robot]; else say notation and length_unit here";
        draft.note_below("touches.kind", note);
    }
    spec.tip = Some(TipSpec { in_flange_mm: [0.0, 0.0, 150.0] });
    draft.ask(&["touches.tip"], "where is the tip of the touching tool on the flange, in mm?");
    draft.manifest.touches = Some(spec);
}
