//! How a target looks on paper: its black shapes, in millimetres.
//!
//! The origin is the top left of the pattern, x to the right, y down. Around it a rim must stay
//! white. Shapes of one drawing belong into one path, filled by the nonzero rule: neighbours then
//! meet without a seam.

use crate::{
    Error, TargetModel,
    detect::markers::{Dictionary, marker_of_square},
};

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

/// Diameter of a circle over the distance between neighbours.
const DISC_SHARE: f64 = 0.5;
/// White around a checkerboard, over the side of a square.
const RIM_SHARE: f64 = 0.25;

/// The drawing of a target. A circle's diameter is half the distance between neighbours.
///
/// # Errors
/// Dimensions that no board has, an unknown dictionary, a dictionary with too few markers.
pub fn art(target: &TargetModel) -> Result<Art, Error> {
    target.check()?;
    match target {
        &TargetModel::Checkerboard { columns, rows, square_mm } => {
            Ok(checkerboard(columns + 1, rows + 1, square_mm, false, (1.0, 1.0)))
        }
        TargetModel::Charuco { squares_x, squares_y, square_mm, marker_mm, dictionary, legacy } => {
            let size = (*squares_x, *squares_y);
            let white_first = *legacy && squares_y % 2 == 0;
            let mut art = checkerboard(size.0, size.1, *square_mm, white_first, (0.0, 0.0));
            art.shapes.extend(markers(
                size,
                *square_mm,
                *marker_mm,
                white_first,
                &named(dictionary)?,
            )?);
            Ok(art)
        }
        TargetModel::Tag { dictionary, id, size_mm } => {
            let dictionary = named(dictionary)?;
            check_marker(&dictionary, *id)?;
            Ok(Art {
                width: *size_mm,
                height: *size_mm,
                white_rim: cell(&dictionary, *size_mm),
                shapes: marker(&dictionary, *id, (0.0, 0.0), *size_mm),
                target_origin: (0.5 * size_mm, 0.5 * size_mm),
            })
        }
        &TargetModel::CircleGrid { columns, rows, pitch_mm } => {
            Ok(circles(columns, rows, pitch_mm))
        }
    }
}

/// Squares of a board; `origin` counts squares from the top left of the pattern.
fn checkerboard(across: u32, down: u32, side: f64, white_first: bool, origin: (f64, f64)) -> Art {
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

/// The markers in the white squares of a ChArUco board.
fn markers(
    (across, down): (u32, u32),
    side: f64,
    size: f64,
    white_first: bool,
    dictionary: &Dictionary,
) -> Result<Vec<Shape>, Error> {
    let mut shapes = vec![];
    let inset = 0.5 * (side - size);
    for j in 0..down {
        for i in 0..across {
            let (column, row) = (i as usize, j as usize);
            if let Some(id) = marker_of_square(column, row, across as usize, white_first) {
                check_marker(dictionary, id)?;
                let at = (f64::from(i) * side + inset, f64::from(j) * side + inset);
                shapes.extend(marker(dictionary, id, at, size));
            }
        }
    }
    Ok(shapes)
}

fn named(name: &str) -> Result<Dictionary, Error> {
    Dictionary::named(name).ok_or_else(|| {
        Error::Invalid(format!(
            "target: the dictionary {name:?} is not known; write OpenCV's name, such as \
             DICT_4X4_50, DICT_6X6_250 or DICT_APRILTAG_36h11"
        ))
    })
}

fn check_marker(dictionary: &Dictionary, id: u32) -> Result<(), Error> {
    if (id as usize) < dictionary.len() {
        return Ok(());
    }
    Err(Error::Invalid(format!(
        "target: marker {id} is needed, but the dictionary ends at {}; take a larger one",
        dictionary.len().saturating_sub(1)
    )))
}

fn cell(dictionary: &Dictionary, size: f64) -> f64 {
    size / (dictionary.side() + 2) as f64
}

/// Runs of black cells, row by row, the border included.
fn marker(dictionary: &Dictionary, id: u32, (left, top): (f64, f64), size: f64) -> Vec<Shape> {
    let (n, cell) = (dictionary.side() + 2, cell(dictionary, size));
    let is_black = |i: usize, j: usize| {
        let border = i == 0 || j == 0 || i == n - 1 || j == n - 1;
        border || dictionary.is_black(id, i - 1, j - 1)
    };
    let mut shapes = vec![];
    for j in 0..n {
        let mut i = 0;
        while i < n {
            let run = (i..n).take_while(|&k| is_black(k, j)).count();
            if run > 0 {
                shapes.push(Shape::Rectangle {
                    x: left + i as f64 * cell,
                    y: top + j as f64 * cell,
                    width: run as f64 * cell,
                    height: cell,
                });
            }
            i += run + 1;
        }
    }
    shapes
}

fn circles(columns: u32, rows: u32, pitch: f64) -> Art {
    let radius = 0.5 * DISC_SHARE * pitch;
    let centres = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let disc = |(i, j): (u32, u32)| Shape::Disc {
        x: radius + f64::from(i) * pitch,
        y: radius + f64::from(j) * pitch,
        radius,
    };
    let extent = |n: u32| f64::from(n - 1) * pitch + 2.0 * radius;
    Art {
        width: extent(columns),
        height: extent(rows),
        white_rim: radius,
        shapes: centres.map(disc).collect(),
        target_origin: (radius, radius),
    }
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
        };
        let message = art(&board).unwrap_err().to_string();
        assert_eq!(
            message,
            "target: marker 50 is needed, but the dictionary ends at 49; take a larger one"
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
