//! The manifest's tables, one after the other.

use std::path::Path;

use handeye::TargetModel;

use super::{
    Known, REQUEST, board,
    groups::Group,
    kind::{self, Kind, Notation, Touches},
    robot,
};
use crate::{
    PixelOrigin,
    camera::CameraSpec,
    dataset::{
        Draft, EXAMPLE_TARGET,
        manifest::{
            BoardDirection, BoardPosesSpec, CornersSpec, ImagesSpec, PlacementSpec, ScansSpec,
            TipSpec, TouchKind, TouchesSpec,
        },
    },
    scan_unit,
    units::LengthUnit,
};

/// Files and what they hold.
pub(super) type Kinds = [(Group, Kind)];

pub(super) fn draft(kinds: &Kinds, folder: &Path, known: &Known) -> Draft {
    let mut draft = Draft::new();
    draft.head(REQUEST);
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
        target(kinds, folder, &placements, known, &mut draft);
        camera(kinds, &mut draft);
    }
    robot::robot(kinds, captures, known, &mut draft);
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

pub(super) fn quoted(text: &str) -> String {
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

fn target(kinds: &Kinds, folder: &Path, placements: &[String], known: &Known, draft: &mut Draft) {
    if let Some(target) = &known.target {
        return draft.set_target(target.clone());
    }
    let said: Vec<(&Group, &TargetModel)> = kinds
        .iter()
        .filter_map(|(g, k)| if let Kind::Target(t) = k { Some((g, t)) } else { None })
        .collect();
    if let [(group, target)] = said[..] {
        draft.set_target(target.clone());
        return draft.note("target.kind", format!("as {} says", group.pattern));
    }
    let pictures = of_kind(kinds, placements, |k| matches!(k, Kind::Pictures));
    if let Some(seen) = pictures.first().and_then(|group| board::seen(group, folder)) {
        return board::propose(&seen, draft);
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
    let mut all = kinds.iter().filter(|(g, _)| g.is_called(&robot::OF_BOARD));
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
        let unit = robot::proven_unit("touches.length_unit", &touches.unit, question, draft);
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
