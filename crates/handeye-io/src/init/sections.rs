//! The manifest's tables, one after the other.

use std::path::Path;

use handeye::TargetModel;

use super::{
    Page,
    groups::Group,
    kind::{self, Kind, Notation, Poses, Touches},
};
use crate::{scan_unit, target_file::target_toml};

/// Files and what they hold.
type Kinds = [(Group, Kind)];

/// Poses of the board that another program found are called so.
const OF_BOARD: [&str; 6] = ["board", "target", "marker", "cpo", "cam_from", "camera_from"];
/// Poses of the robot are called so.
const OF_ROBOT: [&str; 8] = ["robot", "pose", "flange", "gripper", "rpe", "tcp", "arm", "joint"];

pub(super) fn write(kinds: &Kinds, folder: &Path, page: &mut Page) {
    page.note("What the files prove is filled in. Answer every QUESTION: correct the lines below it and remove their #.");
    page.line("");
    page.ask(
        "does the robot carry the camera (\"eye-in-hand\"), or the board (\"eye-to-hand\")?",
        &["setup = \"eye-in-hand\""],
    );
    let seen = kinds
        .iter()
        .any(|(_, k)| matches!(k, Kind::Pictures | Kind::Depth | Kind::Clouds | Kind::Corners));
    let touched = touches(kinds);
    let placements = touched.map_or(vec![], |(_, t)| t.placements.clone());
    let captures = captures(kinds, &placements);
    if seen {
        target(kinds, page);
        camera(kinds, page);
    }
    robot(kinds, captures, page);
    pictures(kinds, &placements, page);
    scans(kinds, folder, &placements, page);
    corners(kinds, &placements, page);
    if !seen {
        board_poses(kinds, page);
    }
    if let Some((group, touches)) = touched {
        placed(kinds, touches, page);
        touched_corners(group, touches, page);
    }
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

/// `files = ...`, and the other groups that may be meant.
fn files(groups: &[&Group], page: &mut Page) {
    let Some((first, others)) = groups.split_first() else { return };
    page.line(&format!("files = {}  # {}", quoted(&first.pattern), first.size()));
    for other in others.iter().take(5) {
        page.line(&format!("# or {}, {}?", quoted(&other.pattern), other.size()));
    }
}

// ---------------------------------------------------------------- target, camera

fn target(kinds: &Kinds, page: &mut Page) {
    let known: Vec<(&Group, &TargetModel)> = kinds
        .iter()
        .filter_map(|(g, k)| if let Kind::Target(t) = k { Some((g, t)) } else { None })
        .collect();
    page.table("[target]");
    if let [(group, target)] = known[..] {
        page.note(&format!("as {} says", group.pattern));
        let text = target_toml(target);
        text.lines().filter(|l| l.contains('=')).for_each(|l| page.line(l));
        return;
    }
    page.ask(
        "which board is it: \"checkerboard\", \"charuco\" or \"tag\"? How many INNER corners has \
         it along x and y, and how long is the side of a square? (Measure the print over many \
         squares.)",
        &["kind = \"checkerboard\"", "columns = 11", "rows = 8", "square_mm = 30.0"],
    );
    page.note("charuco: squares_x, squares_y, square_mm, marker_mm, dictionary = \"DICT_6X6_250\"");
    page.note("tag: dictionary, id, size_mm");
}

fn camera(kinds: &Kinds, page: &mut Page) {
    let cameras: Vec<&Group> = of_kind(kinds, &[], |k| matches!(k, Kind::Camera));
    let names: Vec<String> = cameras
        .iter()
        .flat_map(|g| &g.members)
        .map(|m| format!("file = {}", quoted(&m.to_string_lossy().replace('\\', "/"))))
        .collect();
    match &names[..] {
        [] => {
            page.line("");
            page.note("[camera]: no calibration of the camera was found; it is calibrated from the pictures. A file of intrinsics, or width, height, fx, fy, cx, cy and distortion, is better.");
        }
        [only] => {
            page.table("[camera]");
            page.line(only);
        }
        several => {
            page.table("[camera]");
            let lines: Vec<&str> = several.iter().map(String::as_str).collect();
            page.ask(
                "which of these is the calibration of the camera that took the images?",
                &lines,
            );
        }
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

fn robot(kinds: &Kinds, captures: Option<usize>, page: &mut Page) {
    page.table("[robot]");
    let all = poses_of(kinds, captures);
    let Some(((group, poses), others)) = all.split_first() else {
        return unknown_poses(kinds, page);
    };
    let count = format!("{} poses in {}", poses.count, group.size());
    page.line(&format!("poses = {}  # {count}", quoted(&group.pattern)));
    for (other, poses) in others.iter().take(5) {
        page.line(&format!("# or {}, {} poses?", quoted(&other.pattern), poses.count));
    }
    notation(poses.notation, page);
    unit(poses, page);
    direction(page);
    if let Some(captures) = captures.filter(|c| *c != poses.count) {
        page.line("");
        page.ask(
            &format!(
                "{} poses, but {captures} captures of the camera: which belong together? Those of \
                 one number in their names, or some rows of the poses (rows = \"1..{captures}\" in \
                 [robot])?",
                poses.count
            ),
            &["[captures]", "pairing = \"number\""],
        );
    }
}

fn unknown_poses(kinds: &Kinds, page: &mut Page) {
    let lines = possible_poses(kinds);
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    if lines.is_empty() {
        page.ask("where are the robot's poses?", &["poses = \"poses.csv\""]);
    } else {
        page.ask(
            "which of these are the robot's poses? (field = the keys that lead to one pose, * for \
             every element; columns = [..] chooses from tables)",
            &lines,
        );
    }
    notation(Notation::SomeAngles { degrees: false }, page);
    page.ask(
        "are the positions in \"m\" or in \"mm\"? (generic notations only)",
        &["length_unit = \"mm\""],
    );
    direction(page);
}

/// Where poses may stand, those with most of them first.
fn possible_poses(kinds: &Kinds) -> Vec<String> {
    let mut all: Vec<(usize, String)> = Vec::new();
    for (group, kind) in kinds {
        let Kind::Table(fields) = kind else { continue };
        let poses = format!("poses = {}", quoted(&group.pattern));
        if fields.is_empty() {
            all.push((group.members.len(), poses.clone()));
        }
        all.extend(fields.iter().take(5).map(|f| {
            let (count, field) = (f.count * group.members.len(), quoted(&f.path));
            let named = if f.path.is_empty() { String::new() } else { format!("field = {field}") };
            (count, format!("{poses}  {named}  # {count} of {} numbers", f.numbers))
        }));
    }
    all.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    let split = |(_, line): (usize, String)| line.replacen("  field", "\n# field", 1);
    all.into_iter().take(6).map(split).collect()
}

fn notation(notation: Notation, page: &mut Page) {
    match notation {
        Notation::Is(name) => page.line(&format!("notation = {}", quoted(name))),
        Notation::SomeQuaternion => page.ask(
            "a position and a unit quaternion: does its scalar stand last (\"quaternion-xyzw\"), \
             or first (\"quaternion-wxyz\", and \"abb\")?",
            &["notation = \"quaternion-xyzw\""],
        ),
        Notation::Joints => page.ask(
            "joint values: in \"deg\" or in \"rad\", and with which Denavit-Hartenberg parameters?",
            &["notation = \"joints\"", "angle_unit = \"deg\"", "dh = \"robot_dh.json\""],
        ),
        Notation::SomeAngles { degrees: true } => page.ask(
            "a position and three angles in degrees: whose robot, or in which order? kuka, fanuc, \
             yaskawa, kawasaki, staubli, doosan, denso, or euler-zyx-intrinsic and the like",
            &["notation = \"kuka\""],
        ),
        Notation::SomeAngles { degrees: false } => page.ask(
            "how are the poses written? ur, kuka, fanuc, abb, yaskawa, kawasaki, staubli, doosan, \
             denso, matrix4x4, quaternion-xyzw, quaternion-wxyz, rotation-vector, \
             euler-zyx-intrinsic (with angle_unit), joints ...",
            &["notation = \"ur\""],
        ),
    }
}

/// Makers' notations bring their units.
fn unit(poses: &Poses, page: &mut Page) {
    let generic = match poses.notation {
        Notation::Is(name) => name.starts_with("quaternion") || name == "matrix4x4",
        Notation::Joints => return,
        _ => true,
    };
    match &poses.unit {
        Some((unit, why)) if generic => page.line(&format!("length_unit = \"{unit}\"  # {why}")),
        None if generic => page.ask(
            "are the positions in \"m\" or in \"mm\"? (not needed with a robot maker's notation)",
            &["length_unit = \"mm\""],
        ),
        _ => {}
    }
}

fn direction(page: &mut Page) {
    page.ask(
        "where is the flange in the base (\"base_from_flange\", what controllers show), or the \
         other way (\"flange_from_base\")?",
        &["direction = \"base_from_flange\""],
    );
}

// ---------------------------------------------------------------- what the camera saw

fn pictures(kinds: &Kinds, placements: &[String], page: &mut Page) {
    let groups = of_kind(kinds, placements, |k| matches!(k, Kind::Pictures));
    if !groups.is_empty() {
        page.table("[images]");
        files(&groups, page);
    }
}

fn scans(kinds: &Kinds, folder: &Path, placements: &[String], page: &mut Page) {
    let groups = of_kind(kinds, placements, |k| matches!(k, Kind::Depth | Kind::Clouds));
    let Some(first) = groups.first() else { return };
    page.table("[scans]");
    files(&groups, page);
    let depth = kinds.iter().any(|(g, k)| g.pattern == first.pattern && matches!(k, Kind::Depth));
    if scan_unit(&folder.join(&first.members[0])).is_some() {
        return;
    }
    if !depth {
        return page.ask("are the points in \"m\" or in \"mm\"?", &["length_unit = \"mm\""]);
    }
    page.ask(
        "how many metres is one unit of depth? (0.001 for millimetres)",
        &["depth_scale = 0.001"],
    );
    let images = of_kind(kinds, placements, |k| matches!(k, Kind::Pictures));
    let size = |g: &&Group| kind::size_of(g, folder);
    let (of_scan, of_image) = (size(first), images.first().and_then(size));
    if of_scan.is_none() || of_scan != of_image {
        page.line("");
        page.ask(
            "has the depth image other intrinsics than the images? (where it has other pixels)",
            &["[scans.camera]", "file = \"depth_camera.yaml\""],
        );
    }
}

fn corners(kinds: &Kinds, placements: &[String], page: &mut Page) {
    let groups = of_kind(kinds, placements, |k| matches!(k, Kind::Corners));
    if groups.is_empty() {
        return;
    }
    page.table("[corners]");
    files(&groups, page);
    page.ask(
        "is (0, 0) the \"centre\" of the first pixel, as in OpenCV, or its outer \"corner\"?",
        &["pixel_origin = \"centre\""],
    );
}

fn board_poses(kinds: &Kinds, page: &mut Page) {
    let all = kinds.iter().filter(|(g, _)| g.is_called(&OF_BOARD));
    let named = all.filter(|(_, k)| matches!(k, Kind::Poses(_))).map(|(g, _)| quoted(&g.pattern));
    let names: Vec<String> = named.map(|name| format!("poses = {name}")).collect();
    let usual = "poses = \"board_poses.csv\"".to_owned();
    let poses = names.first().unwrap_or(&usual);
    page.line("");
    page.ask(
        "there are no images, scans or corners: what did the camera see? With poses of the board \
         from another program, say where and how they are written.",
        &[
            "[board_poses]",
            poses,
            "notation = \"matrix4x4\"",
            "length_unit = \"m\"",
            "direction = \"camera_from_target\"",
        ],
    );
}

// ---------------------------------------------------------------- touches

fn touches(kinds: &Kinds) -> Option<(&Group, &Touches)> {
    kinds.iter().find_map(|(g, k)| if let Kind::Touches(t) = k { Some((g, t)) } else { None })
}

/// Key of a placement's file in the manifest.
fn key(kind: &Kind) -> Option<&'static str> {
    match kind {
        Kind::Pictures => Some("image"),
        Kind::Depth | Kind::Clouds => Some("scan"),
        Kind::Corners => Some("corners"),
        _ => None,
    }
}

fn placed(kinds: &Kinds, touches: &Touches, page: &mut Page) {
    let mut orphans = Vec::new();
    for id in &touches.placements {
        let mut lines = Vec::new();
        for (group, kind) in kinds {
            let own = group.members.iter().find(|m| crate::files::stem(m) == *id);
            if let (Some(file), Some(key)) = (own, key(kind)) {
                let name = file.to_string_lossy().replace('\\', "/");
                lines.push(format!("{key} = {}", quoted(&name)));
            }
        }
        if lines.is_empty() {
            orphans.push(id);
            continue;
        }
        page.table("[[placements]]");
        page.line(&format!("id = {}", quoted(id)));
        lines.iter().for_each(|line| page.line(line));
    }
    for id in orphans {
        page.line("");
        let (id, question) = (
            format!("id = {}", quoted(id)),
            format!(
                "the touches name a placement {id}: which image shows the board there? (not \
                 needed where the camera is on the robot and the board is that of the captures)"
            ),
        );
        page.ask(&question, &["[[placements]]", &id, "image = \"placement.png\""]);
    }
}

fn touched_corners(group: &Group, touches: &Touches, page: &mut Page) {
    page.table("[touches]");
    page.line(&format!("file = {}  # {} touches", quoted(&group.pattern), touches.count));
    let Some(poses) = &touches.poses else {
        page.line("kind = \"tip\"");
        match &touches.unit {
            Some((unit, why)) => page.line(&format!("length_unit = \"{unit}\"  # {why}")),
            None => page.ask("is the tip in \"m\" or in \"mm\"?", &["length_unit = \"mm\""]),
        }
        return;
    };
    match poses.notation {
        Notation::Joints => page.line("kind = \"joints\""),
        _ => page.line("kind = \"flange-pose\""),
    }
    match (poses.notation, &poses.unit) {
        (Notation::Is(name), unit) => {
            page.line(&format!("notation = {}", quoted(name)));
            if let Some((unit, why)) = unit {
                page.line(&format!("length_unit = \"{unit}\"  # {why}"));
            }
        }
        _ => page.note("written as in [robot]; else say notation and length_unit here"),
    }
    page.line("");
    page.ask(
        "where is the tip of the touching tool on the flange, in mm?",
        &["[touches.tip]", "in_flange_mm = [0.0, 0.0, 150.0]"],
    );
}
