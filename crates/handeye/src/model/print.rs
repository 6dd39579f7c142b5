//! How a target looks on paper: its black shapes, in millimetres.
//!
//! The origin is the top left of the pattern, x to the right, y down. Around it a rim must stay
//! white. Shapes of one drawing belong into one path, filled by the nonzero rule: neighbours then
//! meet without a seam.

use nalgebra::Vector2;

use super::dictionary::Dictionary;
use crate::{Error, TargetModel};

/// Something black.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// An upright rectangle.
    Rectangle {
        /// Left edge.
        x: f64,
        /// Upper edge.
        y: f64,
        /// Extent to the right.
        width: f64,
        /// Extent downwards.
        height: f64,
    },
    /// A disc.
    Disc {
        /// Centre, from the left.
        x: f64,
        /// Centre, from the top.
        y: f64,
        /// Radius.
        radius: f64,
    },
}

/// A target as it is drawn. Millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct Art {
    /// Extent of the pattern to the right.
    pub width: f64,
    /// Extent of the pattern downwards.
    pub height: f64,
    /// What must stay white around the pattern.
    pub white_rim: f64,
    /// All that is black.
    pub shapes: Vec<Shape>,
    /// Where the origin of the Target frame lies in the pattern.
    pub target_origin: (f64, f64),
}

/// White around a checkerboard, over the side of a square.
const RIM_SHARE: f64 = 0.25;

/// The drawing of a target. A circle's diameter is half the distance between neighbours, in
/// ROS-Industrial's grid 0.4 and 0.8 times that distance.
///
/// # Errors
/// Dimensions that no board has, an unknown dictionary, a dictionary with too few markers; a ball.
pub fn art(target: &TargetModel) -> Result<Art, Error> {
    target.check()?;
    target.art()
}

/// Squares of a board; `origin` counts squares from the top left of the pattern.
pub(super) fn checkerboard(
    across: u32,
    down: u32,
    side: f64,
    white_first: bool,
    origin: (f64, f64),
) -> Art {
    let is_black = |i: u32, j: u32| (i + j + u32::from(white_first)).is_multiple_of(2);
    let squares = (0..down).flat_map(|j| (0..across).map(move |i| (i, j)));
    let shapes = squares
        .filter(|&(i, j)| is_black(i, j))
        .map(|(i, j)| Shape::Rectangle {
            x: f64::from(i) * side,
            y: f64::from(j) * side,
            width: side,
            height: side,
        })
        .collect();
    Art {
        width: f64::from(across) * side,
        height: f64::from(down) * side,
        white_rim: RIM_SHARE * side,
        shapes,
        target_origin: (origin.0 * side, origin.1 * side),
    }
}

pub(super) fn named(name: &str) -> Result<Dictionary, Error> {
    Dictionary::named(name).ok_or_else(|| {
        Error::Invalid(format!(
            "target: the dictionary {name:?} is not known; write OpenCV's name, such as \
             DICT_4X4_50, DICT_6X6_250 or DICT_APRILTAG_36h11"
        ))
    })
}

pub(super) fn check_marker(dictionary: &Dictionary, id: u32) -> Result<(), Error> {
    if (id as usize) < dictionary.len() {
        return Ok(());
    }
    Err(Error::Invalid(format!(
        "target: marker {id} is needed, but the dictionary ends at {}; take a larger one",
        dictionary.len().saturating_sub(1)
    )))
}

pub(super) fn cell(dictionary: &Dictionary, size: f64) -> f64 {
    size / (dictionary.side() + 2) as f64
}

/// Where a marker is drawn, and how.
pub(super) struct Square {
    left: f64,
    top: f64,
    size: f64,
    /// Width of the black border, bits.
    border: u32,
    /// By half a turn.
    turned: bool,
}

impl Square {
    pub(super) fn upright((left, top): (f64, f64), size: f64) -> Self {
        Self { left, top, size, border: 1, turned: false }
    }
}

/// Runs of black cells, row by row, the border included.
pub(super) fn marker(dictionary: &Dictionary, id: u32, square: &Square) -> Vec<Shape> {
    let n = dictionary.side() + 2 * square.border as usize;
    let cell = square.size / n as f64;
    let is_black = |i, j| dictionary.is_cell_black(id, square.border, square.turned, (i, j));
    let mut shapes = vec![];
    for j in 0..n {
        let mut i = 0;
        while i < n {
            let run = (i..n).take_while(|&k| is_black(k, j)).count();
            if run > 0 {
                shapes.push(Shape::Rectangle {
                    x: square.left + i as f64 * cell,
                    y: square.top + j as f64 * cell,
                    width: run as f64 * cell,
                    height: cell,
                });
            }
            i += run + 1;
        }
    }
    shapes
}

/// The discs of a grid of circles.
pub(super) fn circles(target: &TargetModel) -> Art {
    let discs: Vec<(f64, f64, f64)> = (0..)
        .zip(target.corners())
        .map(|(id, at)| {
            let at = 1e3 * at.vector();
            (at.x, at.y, 0.5 * target.disc_diameter_mm(id))
        })
        .collect();
    let least = |f: fn(&(f64, f64, f64)) -> f64| discs.iter().map(f).fold(f64::INFINITY, f64::min);
    let (left, top) = (least(|d| d.0 - d.2), least(|d| d.1 - d.2));
    let (right, bottom) = (-least(|d| -d.0 - d.2), -least(|d| -d.1 - d.2));
    let disc = |&(x, y, radius): &(f64, f64, f64)| Shape::Disc { x: x - left, y: y - top, radius };
    Art {
        width: right - left,
        height: bottom - top,
        white_rim: least(|d| d.2),
        shapes: discs.iter().map(disc).collect(),
        target_origin: (-left, -top),
    }
}

/// A grid of tags that are `gap` apart; around it a gap stays for corner squares or for white.
pub(super) fn tags(target: &TargetModel, dictionary: &Dictionary, border: u32, gap: f64) -> Art {
    let placed = target.tags();
    let corner = |at: Vector2<f64>| at * 1e3;
    let low = placed
        .iter()
        .map(|t| corner(t.top_left))
        .fold(Vector2::repeat(f64::INFINITY), |a, b| a.inf(&b));
    let size = target.pitch_m() * 1e3;
    let high = placed
        .iter()
        .map(|t| corner(t.top_left))
        .fold(Vector2::repeat(f64::NEG_INFINITY), |a, b| a.sup(&b));
    let origin = Vector2::repeat(gap) - low;
    let shapes = placed.iter().flat_map(|tag| {
        let at = corner(tag.top_left) + origin;
        let square = Square { left: at.x, top: at.y, size, border, turned: tag.turned };
        marker(dictionary, tag.marker, &square)
    });
    let extent = (high - low).add_scalar(size + 2.0 * gap);
    Art {
        width: extent.x,
        height: extent.y,
        white_rim: gap,
        shapes: shapes.collect(),
        target_origin: (origin.x, origin.y),
    }
}

/// Which marker of a ChArUco board sits in square `(i, j)`; `None` in a black one.
pub(crate) fn marker_of_square(
    i: usize,
    j: usize,
    squares_x: usize,
    white_first: bool,
) -> Option<u32> {
    let shift = usize::from(white_first);
    if (i + j + shift).is_multiple_of(2) {
        return None;
    }
    // white squares of a row start at column 0 or 1; odd widths alternate their number
    let in_row = |row: usize| (squares_x + usize::from((row + 1 + shift).is_multiple_of(2))) / 2;
    let before: usize = (0..j).map(in_row).sum();
    Some((before + i / 2) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(art: &Art) -> f64 {
        let of = |shape: &Shape| match shape {
            Shape::Rectangle { width, height, .. } => width * height,
            Shape::Disc { radius, .. } => std::f64::consts::PI * radius * radius,
        };
        art.shapes.iter().map(of).sum()
    }

    #[test]
    fn a_checkerboard_has_one_square_more_than_corners_and_starts_black() {
        let board = TargetModel::Checkerboard { columns: 4, rows: 3, square_mm: 20.0 };
        let art = art(&board).unwrap();
        assert_eq!((art.width, art.height), (100.0, 80.0));
        assert_eq!(art.shapes.len(), 10);
        assert_eq!(art.shapes[0], Shape::Rectangle { x: 0.0, y: 0.0, width: 20.0, height: 20.0 });
        assert_eq!(art.target_origin, (20.0, 20.0));
    }

    #[test]
    fn a_marker_is_as_black_as_its_bits() {
        let tag = TargetModel::Tag { dictionary: "DICT_4X4_50".into(), id: 0, size_mm: 60.0 };
        let black = 20 + 16 - 8; // border, and the 8 black bits of marker 0
        assert!((area(&art(&tag).unwrap()) - f64::from(black) * 100.0).abs() < 1e-9);
    }

    #[test]
    fn a_dictionary_that_is_too_small_is_refused() {
        let board = TargetModel::Charuco {
            squares_x: 12,
            squares_y: 12,
            square_mm: 20.0,
            marker_mm: 15.0,
            dictionary: "DICT_4X4_50".into(),
            legacy: false,
            first_id: 0,
        };
        let message = art(&board).unwrap_err().to_string();
        assert_eq!(
            message,
            "target: markers 0 to 71 are needed, but DICT_4X4_50 ends at 49: take fewer markers or a \
             larger dictionary"
        );
    }

    #[test]
    fn circles_are_half_as_wide_as_they_are_apart() {
        let grid = TargetModel::CircleGrid { columns: 3, rows: 2, pitch_mm: 20.0 };
        let art = art(&grid).unwrap();
        assert_eq!((art.width, art.height), (50.0, 30.0));
        assert_eq!(art.shapes[5], Shape::Disc { x: 45.0, y: 25.0, radius: 5.0 });
    }
}
