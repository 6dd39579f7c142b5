//! Where the corners of each target are.

use nalgebra::Vector2;

use crate::model::target::kinds::{PlacedTag, TargetModel};

/// Place of a corner that exists, in metres.
pub(super) fn in_plane(target: &TargetModel, id: u32) -> Vector2<f64> {
    let (columns, rows) = target.grid();
    let (column, row) = (f64::from(id % columns), f64::from(id / columns));
    let pitch = target.pitch_m();
    match target {
        TargetModel::Checkerboard { .. } | TargetModel::CircleGrid { .. } => {
            Vector2::new(column, row) * pitch
        }
        TargetModel::Charuco { .. } => Vector2::new(column + 1.0, row + 1.0) * pitch,
        TargetModel::AsymmetricCircleGrid { .. } => {
            Vector2::new(2.0 * column + row % 2.0, row) * pitch
        }
        TargetModel::ModifiedCircleGrid { .. } => {
            Vector2::new(column, row - f64::from(rows - 1)) * pitch
        }
        TargetModel::Tag { .. } => (Vector2::from(CLOCKWISE[id as usize]).add_scalar(-0.5)) * pitch,
        TargetModel::Aprilgrid { tags_x, .. } | TargetModel::TagGrid { tags_x, .. } => {
            let tag = id / 4;
            let at = tag_origin(target, tag % tags_x, tag / tags_x);
            at + Vector2::from(tag_corners(target)[id as usize % 4]) * pitch
        }
        TargetModel::Sphere { .. } => Vector2::zeros(),
    }
}

/// Corners of the unit square, from the top left.
const CLOCKWISE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// Corners of the unit square, from the bottom left.
const COUNTER_CLOCKWISE: [[f64; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];

fn tag_corners(target: &TargetModel) -> [[f64; 2]; 4] {
    if is_aprilgrid(target) { COUNTER_CLOCKWISE } else { CLOCKWISE }
}

fn is_aprilgrid(target: &TargetModel) -> bool {
    matches!(target, TargetModel::Aprilgrid { .. })
}

/// Top left of the tag in a column and a row as the ids count them, in metres. An aprilgrid counts
/// its rows upwards; its origin is the bottom left of the first tag.
fn tag_origin(target: &TargetModel, column: u32, row: u32) -> Vector2<f64> {
    let (tag, step) = match *target {
        TargetModel::Aprilgrid { tag_mm, spacing, .. } => (tag_mm, tag_mm * (1.0 + spacing)),
        TargetModel::TagGrid { tag_mm, gap_mm, .. } => (tag_mm, tag_mm + gap_mm),
        _ => (0.0, 0.0),
    };
    let (x, y) = (f64::from(column) * step, f64::from(row) * step);
    1e-3 * if is_aprilgrid(target) { Vector2::new(x, -y - tag) } else { Vector2::new(x, y) }
}

/// The id of a corner on the board, by column and row from the top left.
pub(super) fn id_at(target: &TargetModel, column: u32, row: u32) -> u32 {
    let (columns, rows) = target.grid();
    let of_tag = |tags_x: u32, row: u32, corners: [[u32; 2]; 2]| {
        4 * (row / 2 * tags_x + column / 2) + corners[row as usize % 2][column as usize % 2]
    };
    match *target {
        TargetModel::Tag { .. } => of_tag(1, row, [[0, 1], [3, 2]]),
        TargetModel::TagGrid { tags_x, .. } => of_tag(tags_x, row, [[0, 1], [3, 2]]),
        TargetModel::Aprilgrid { tags_x, .. } => of_tag(tags_x, rows - 1 - row, [[0, 1], [3, 2]]),
        _ => row * columns + column,
    }
}

/// The corners of a tag of an aprilgrid in OpenCV's order: the dictionary holds it upside down.
const UPSIDE_DOWN: [u32; 4] = [1, 0, 3, 2];

/// The tags of a board, in the order of their corners' ids.
pub(super) fn tags(target: &TargetModel) -> Vec<PlacedTag> {
    let (tags_x, tags_y, first) = match *target {
        TargetModel::Aprilgrid { tags_x, tags_y, first_id, .. }
        | TargetModel::TagGrid { tags_x, tags_y, first_id, .. } => (tags_x, tags_y, first_id),
        _ => return vec![],
    };
    let turned = is_aprilgrid(target);
    let order = if turned { UPSIDE_DOWN } else { [0, 1, 2, 3] };
    let one = |t: u32| PlacedTag {
        marker: first + t,
        corners: order.map(|k| 4 * t + k),
        top_left: tag_origin(target, t % tags_x, t / tags_x),
        side: target.pitch_m(),
        turned,
    };
    (0..tags_x * tags_y).map(one).collect()
}
