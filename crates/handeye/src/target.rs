//! What the camera looks at: the corners of a board, in the Target frame.
//!
//! The Target frame lies in the board's plane: x along a row of corners, y along a column, z away
//! from the viewer (x right and y down when the board is read like a page). Its origin is
//! * checkerboard: the first inner corner (id 0);
//! * ChArUco: the outer corner of the first square, as in OpenCV;
//! * tag: the tag's centre.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::{Error, Point, Target};

/// A calibration target and its dimensions. Lengths in millimetres, as people print them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum TargetModel {
    /// Plain checkerboard; `columns` x `rows` INNER corners, id = `row * columns + column`.
    Checkerboard {
        /// Inner corners along x.
        columns: u32,
        /// Inner corners along y.
        rows: u32,
        /// Side of a square.
        square_mm: f64,
    },
    /// Checkerboard with ArUco markers in its white squares; corner ids as in OpenCV.
    Charuco {
        /// Squares along x.
        squares_x: u32,
        /// Squares along y.
        squares_y: u32,
        /// Side of a square.
        square_mm: f64,
        /// Side of a marker.
        marker_mm: f64,
        /// OpenCV's name, e.g. `DICT_6X6_250`.
        dictionary: String,
        /// Layout of OpenCV before 4.6 (first square white when `squares_y` is even).
        #[serde(default)]
        legacy: bool,
    },
    /// One ArUco or AprilTag marker; ids 0 to 3 are its corners in OpenCV's order
    /// (top left, top right, bottom right, bottom left).
    Tag {
        /// OpenCV's name, e.g. `DICT_APRILTAG_36h11`.
        dictionary: String,
        /// Which marker.
        id: u32,
        /// Side of the black border's outer edge.
        size_mm: f64,
    },
    /// A grid of circles; id = `row * columns + column`. Corners can be imported, not yet detected.
    CircleGrid {
        /// Circles along x.
        columns: u32,
        /// Circles along y.
        rows: u32,
        /// Distance between neighbouring centres.
        pitch_mm: f64,
    },
}

/// Most corners a board may declare; larger counts are mistakes or attacks.
const MOST_CORNERS: u64 = 100_000;

impl TargetModel {
    /// Refuses dimensions that no board has.
    pub fn check(&self) -> Result<(), Error> {
        let (columns, rows) = self.grid();
        let invalid = |what: String| Err(Error::Invalid(what));
        if !matches!(self, Self::Tag { .. }) && (columns < 2 || rows < 2) {
            return invalid(format!(
                "target: {columns} x {rows} inner corners; a board needs at least 2 x 2 \
                 (one row of corners does not fix its pose)"
            ));
        }
        if u64::from(columns) * u64::from(rows) > MOST_CORNERS {
            return invalid(format!(
                "target: {columns} x {rows} corners are more than {MOST_CORNERS}"
            ));
        }
        for (name, length) in self.lengths_mm() {
            if !(length.is_finite() && length > 0.0) {
                return invalid(format!(
                    "target: {name} = {length} must be a positive length in mm"
                ));
            }
            if !(0.1..=5000.0).contains(&length) {
                return invalid(format!(
                    "target: {name} = {length} mm is no board's size; is it in millimetres?"
                ));
            }
        }
        if let Self::Charuco { square_mm, marker_mm, .. } = self
            && marker_mm >= square_mm
        {
            return invalid(format!(
                "target: marker_mm = {marker_mm} must be smaller than square_mm = {square_mm}"
            ));
        }
        Ok(())
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Checkerboard { square_mm, .. } => vec![("square_mm", square_mm)],
            Self::Charuco { square_mm, marker_mm, .. } => {
                vec![("square_mm", square_mm), ("marker_mm", marker_mm)]
            }
            Self::Tag { size_mm, .. } => vec![("size_mm", size_mm)],
            Self::CircleGrid { pitch_mm, .. } => vec![("pitch_mm", pitch_mm)],
        }
    }

    /// Columns and rows of corners; a tag counts as 2 x 2.
    pub fn grid(&self) -> (u32, u32) {
        match *self {
            Self::Checkerboard { columns, rows, .. } | Self::CircleGrid { columns, rows, .. } => {
                (columns, rows)
            }
            Self::Charuco { squares_x, squares_y, .. } => {
                (squares_x.saturating_sub(1), squares_y.saturating_sub(1))
            }
            Self::Tag { .. } => (2, 2),
        }
    }

    /// Distance between neighbouring corners, in metres.
    pub fn pitch_m(&self) -> f64 {
        1e-3 * match *self {
            Self::Checkerboard { square_mm, .. } | Self::Charuco { square_mm, .. } => square_mm,
            Self::Tag { size_mm, .. } => size_mm,
            Self::CircleGrid { pitch_mm, .. } => pitch_mm,
        }
    }

    /// Number of corners.
    pub fn len(&self) -> usize {
        let (columns, rows) = self.grid();
        columns as usize * rows as usize
    }

    /// Whether the target has no corners (never, once checked).
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of corner `id` on the board, in metres; `None` if the board has no such corner.
    pub fn corner(&self, id: u32) -> Option<Point<Target>> {
        ((id as usize) < self.len()).then(|| {
            let v = self.in_plane(id);
            Point::new(v.x, v.y, 0.0)
        })
    }

    /// The point at which misfits are stated: the first inner corner, or the centre of a tag.
    pub fn reference(&self) -> Point<Target> {
        let origin = Point::new(0.0, 0.0, 0.0);
        if matches!(self, Self::Tag { .. }) { origin } else { self.corner(0).unwrap_or(origin) }
    }

    /// All corners in the order of their ids, in metres.
    pub fn corners(&self) -> Vec<Point<Target>> {
        (0..self.len() as u32)
            .map(|id| {
                let v = self.in_plane(id);
                Point::new(v.x, v.y, 0.0)
            })
            .collect()
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (columns, _) = self.grid();
        let (column, row) = (f64::from(id % columns), f64::from(id / columns));
        let pitch = self.pitch_m();
        match self {
            Self::Checkerboard { .. } | Self::CircleGrid { .. } => {
                Vector2::new(column * pitch, row * pitch)
            }
            Self::Charuco { .. } => Vector2::new((column + 1.0) * pitch, (row + 1.0) * pitch),
            Self::Tag { .. } => {
                let h = 0.5 * pitch;
                [Vector2::new(-h, -h), Vector2::new(h, -h), Vector2::new(h, h), Vector2::new(-h, h)]
                    [id as usize]
            }
        }
    }

    /// Relabelings under which a picture of the board looks the same, the identity first:
    /// `symmetries()[k][id]` is the id that corner `id` has after turning the board.
    ///
    /// A checkerboard looks the same after half a turn when its numbers of squares have an even
    /// sum; a square one with an odd number of squares also after quarter turns.
    pub fn symmetries(&self) -> Vec<Vec<u32>> {
        let (columns, rows) = self.grid();
        let all: Vec<u32> = (0..self.len() as u32).collect();
        let half: Vec<u32> = all.iter().rev().copied().collect();
        match self {
            Self::Checkerboard { .. } if columns == rows && columns % 2 == 0 => {
                let quarter: Vec<u32> = all
                    .iter()
                    .map(|id| (id % columns) * columns + (columns - 1 - id / columns))
                    .collect();
                let three: Vec<u32> = quarter.iter().map(|&id| half[id as usize]).collect();
                vec![all, quarter, half, three]
            }
            Self::Checkerboard { .. } if (columns + rows) % 2 == 0 => vec![all, half],
            Self::CircleGrid { .. } => vec![all, half],
            _ => vec![all],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkerboard(columns: u32, rows: u32) -> TargetModel {
        TargetModel::Checkerboard { columns, rows, square_mm: 30.0 }
    }

    #[test]
    fn ids_run_along_rows() {
        let corner = checkerboard(11, 8).corner(12).unwrap();
        assert_eq!(corner, Point::new(0.03, 0.03, 0.0));
    }

    #[test]
    fn a_symmetry_is_a_rotation_of_the_board() {
        for board in [checkerboard(8, 6), checkerboard(6, 6), checkerboard(9, 7)] {
            for map in board.symmetries() {
                let at = |id: u32| board.corner(map[id as usize]).unwrap().vector();
                let (columns, _) = board.grid();
                let (x, y) = (at(1) - at(0), at(columns) - at(0));
                assert!((x.cross(&y).z - 0.03f64.powi(2)).abs() < 1e-12, "keeps handedness");
            }
        }
    }

    #[test]
    fn boards_with_an_odd_sum_of_squares_are_unambiguous() {
        assert_eq!(checkerboard(9, 6).symmetries().len(), 1);
        assert_eq!(checkerboard(8, 6).symmetries().len(), 2);
        assert_eq!(checkerboard(6, 6).symmetries().len(), 4);
    }

    #[test]
    fn one_row_is_no_board() {
        let message = checkerboard(9, 1).check().unwrap_err().to_string();
        assert!(message.contains("at least 2 x 2"), "{message}");
    }
}
