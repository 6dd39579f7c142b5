//! What the families with tags share: the corners of a tag.

/// Corners of the unit square, from the top left.
pub(super) const CLOCKWISE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// The id of a corner of a grid of tags, by column and row of corners as the ids count them: a tag's corners are 0 to 3
/// around it.
pub(super) fn of_tag(tags_x: u32, column: u32, row: u32) -> u32 {
    let around = [[0, 1], [3, 2]][row as usize % 2][column as usize % 2];
    4 * (row / 2 * tags_x + column / 2) + around
}
