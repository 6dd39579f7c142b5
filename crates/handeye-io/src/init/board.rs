//! The board that the images show: all of it is filled in but its lengths, which images do not tell.

use std::path::{Path, PathBuf};

use handeye::{
    TargetModel,
    detect::{Recognised, recognise},
};

use super::groups::Group;
use crate::{dataset::Draft, image::read_image};

/// Images that are looked at.
const MOST_IMAGES: usize = 5;
/// What stands for the length that is asked, mm.
const EXAMPLE_MM: f64 = 30.0;

/// A board, and how many images show it.
pub(super) struct Seen {
    found: Recognised,
    /// Images that were looked at.
    of: usize,
}

/// The board in images from all over a group; `None` where they show none.
pub(super) fn seen(group: &Group, folder: &Path) -> Option<Seen> {
    let step = group.members.len().div_ceil(MOST_IMAGES).max(1);
    let paths: Vec<PathBuf> =
        group.members.iter().step_by(step).map(|member| folder.join(member)).collect();
    let images: Vec<_> = paths.iter().filter_map(|path| read_image(path, None).ok()).collect();
    Some(Seen { found: recognise(&images)?, of: images.len() })
}

/// Puts the board into the manifest, and asks its lengths.
pub(super) fn propose(seen: &Seen, draft: &mut Draft) {
    let target = rounded(seen.found.target.resized(EXAMPLE_MM));
    let (count, of) = (seen.found.images, seen.of);
    let images = if of == 1 { "image" } else { "images" };
    let note = format!("seen in {count} of {of} {images} that were looked at: {}", shape(&target));
    draft.note("target.kind", note);
    let (keys, question) = lengths(&target);
    draft.ask(&keys, question);
    draft.set_target(target);
}

/// The board without its lengths, in words.
fn shape(target: &TargetModel) -> String {
    let (columns, rows) = target.grid();
    match target {
        TargetModel::Checkerboard { .. } => format!("{columns} x {rows} inner corners"),
        TargetModel::Charuco { squares_x, squares_y, dictionary, .. } => {
            format!("{squares_x} x {squares_y} squares with markers of {dictionary}")
        }
        TargetModel::Tag { dictionary, id, .. } => format!("tag {id} of {dictionary}"),
        TargetModel::Aprilgrid { tags_x, tags_y, .. }
        | TargetModel::TagGrid { tags_x, tags_y, .. } => format!("{tags_x} x {tags_y} tags"),
        _ => format!("{columns} x {rows} circles"),
    }
}

/// The keys of its lengths, and the question for them.
fn lengths(target: &TargetModel) -> (Vec<&'static str>, &'static str) {
    match target {
        TargetModel::Charuco { .. } => (
            vec!["target.square_mm", "target.marker_mm"],
            "how long are the sides of a square and of a marker, in mm? Images do not tell. (Measure the print over \
             many squares.)",
        ),
        TargetModel::Aprilgrid { .. } => (
            vec!["target.tag_mm", "target.spacing"],
            "how long is the side of a tag's black square, in mm, and what is the gap between tags over it? Images do not \
             tell the first.",
        ),
        TargetModel::TagGrid { .. } => (
            vec!["target.tag_mm", "target.gap_mm"],
            "how long is the side of a tag's black square, and how wide the gap between two, in mm? Images do not tell.",
        ),
        TargetModel::Tag { .. } => (
            vec!["target.size_mm"],
            "how long is the side of the tag's black square, in mm? Images do not tell.",
        ),
        TargetModel::Checkerboard { .. } => (
            vec!["target.square_mm"],
            "how long is the side of a square, in mm? Images do not tell. (Measure the print over many squares.)",
        ),
        _ => (
            vec!["target.pitch_mm"],
            "how far apart are the centres of neighbouring circles, in mm (of shifted rows: neighbouring rows)? Images \
             do not tell.",
        ),
    }
}

/// Lengths as people print them.
fn rounded(mut target: TargetModel) -> TargetModel {
    let to = |x: &mut f64, digits: f64| *x = (*x * digits).round() / digits;
    match &mut target {
        TargetModel::Charuco { marker_mm, .. } => to(marker_mm, 2.0),
        TargetModel::TagGrid { gap_mm, .. } => to(gap_mm, 2.0),
        TargetModel::Aprilgrid { spacing, .. } => to(spacing, 100.0),
        _ => {}
    }
    target
}
