//! What the camera looks at: the corners of a board, in the Target frame.
//!
//! The Target frame lies in the board's plane: x along a row of corners, y along a column, z away
//! from the viewer (x right and y down when the board is read like a page). Its origin is
//! * checkerboard, grid of circles, asymmetric or not: the first inner corner or circle (id 0);
//! * grid of circles with a larger one: the larger one, as in ROS-Industrial;
//! * ChArUco: the outer corner of the first square, as in OpenCV;
//! * tag: the tag's centre;
//! * grid of tags: the first corner (id 0), as in OpenCV and Kalibr;
//! * ball: its centre.

mod alike;
mod check;
mod layout;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::{Point, Target};

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
        /// The first marker: boards that are seen together have different ones.
        #[serde(default)]
        first_id: u32,
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
    /// A grid of circles; id = `row * columns + column`.
    CircleGrid {
        /// Circles along x.
        columns: u32,
        /// Circles along y.
        rows: u32,
        /// Distance between neighbouring centres.
        pitch_mm: f64,
    },
    /// OpenCV's asymmetric grid of circles: every second row is shifted by `pitch_mm`. Circle
    /// `(column, row)` has id `row * columns + column` and lies at
    /// `((2 column + row mod 2) pitch, row pitch)`.
    AsymmetricCircleGrid {
        /// Circles in each row.
        columns: u32,
        /// Rows.
        rows: u32,
        /// Distance between neighbouring rows: half of that between neighbours in a row.
        pitch_mm: f64,
    },
    /// ROS-Industrial's grid of circles with one larger circle, at the bottom left;
    /// id = `row * columns + column`, row 0 at the top.
    ModifiedCircleGrid {
        /// Circles along x.
        columns: u32,
        /// Circles along y.
        rows: u32,
        /// Distance between neighbouring centres.
        pitch_mm: f64,
    },
    /// Kalibr's grid of AprilTags, tag 0 at the bottom left. The corners of the `t`-th tag are
    /// `4 t` (its bottom left) to `4 t + 3`, counter-clockwise.
    Aprilgrid {
        /// Tags along x.
        tags_x: u32,
        /// Tags along y.
        tags_y: u32,
        /// Side of a tag's black square.
        tag_mm: f64,
        /// Gap between tags over `tag_mm`.
        spacing: f64,
        /// Family of the tags.
        family: AprilTagFamily,
        /// Marker of the tag at the bottom left.
        #[serde(default)]
        first_id: u32,
        /// Whether black squares fill the crossings of the gaps, as Kalibr draws them.
        #[serde(default = "drawn_by_kalibr")]
        corner_squares: bool,
        /// Width of a tag's black border in bits: 1, or 2 as Kalibr's own drawings have it.
        #[serde(default = "one_bit")]
        border_bits: u32,
    },
    /// OpenCV's `GridBoard` of markers. The corners of the `t`-th marker are `4 t` (its top left)
    /// to `4 t + 3`, clockwise.
    TagGrid {
        /// OpenCV's name, e.g. `DICT_6X6_250`.
        dictionary: String,
        /// Markers along x.
        tags_x: u32,
        /// Markers along y.
        tags_y: u32,
        /// Side of a marker's black square.
        tag_mm: f64,
        /// Distance between neighbouring markers' black squares.
        gap_mm: f64,
        /// The marker at the top left.
        #[serde(default)]
        first_id: u32,
    },
    /// A ball. It has no corners and is found in 3D scans only.
    Sphere {
        /// Its diameter; every scan finds it for itself where it is not told.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        diameter_mm: Option<f64>,
    },
}

fn drawn_by_kalibr() -> bool {
    true
}

fn one_bit() -> u32 {
    1
}

/// A family of AprilTags.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum AprilTagFamily {
    /// 4 x 4 bits, 30 tags.
    #[serde(rename = "16h5", alias = "t16h5", alias = "tag16h5")]
    Tag16h5,
    /// 5 x 5 bits, 35 tags.
    #[serde(rename = "25h9", alias = "t25h9", alias = "tag25h9")]
    Tag25h9,
    /// 6 x 6 bits, 2320 tags.
    #[serde(rename = "36h10", alias = "t36h10", alias = "tag36h10")]
    Tag36h10,
    /// 6 x 6 bits, 587 tags.
    #[serde(rename = "36h11", alias = "t36h11", alias = "tag36h11")]
    Tag36h11,
}

impl AprilTagFamily {
    /// The family of a name, with or without the `t` or `tag` in front.
    pub fn named(name: &str) -> Option<Self> {
        let all = [Self::Tag16h5, Self::Tag25h9, Self::Tag36h10, Self::Tag36h11];
        let short = |family: &Self| family.dictionary().trim_start_matches("DICT_APRILTAG_");
        let wanted = name.strip_prefix("tag").or(name.strip_prefix('t')).unwrap_or(name);
        all.into_iter().find(|family| short(family) == wanted)
    }

    /// OpenCV's name of the dictionary. It holds each tag turned by half a turn.
    pub fn dictionary(self) -> &'static str {
        match self {
            Self::Tag16h5 => "DICT_APRILTAG_16h5",
            Self::Tag25h9 => "DICT_APRILTAG_25h9",
            Self::Tag36h10 => "DICT_APRILTAG_36h10",
            Self::Tag36h11 => "DICT_APRILTAG_36h11",
        }
    }
}

impl TargetModel {
    /// Columns and rows of corners; 2 x 2 to a tag, none to a ball.
    pub fn grid(&self) -> (u32, u32) {
        match *self {
            Self::Checkerboard { columns, rows, .. }
            | Self::CircleGrid { columns, rows, .. }
            | Self::AsymmetricCircleGrid { columns, rows, .. }
            | Self::ModifiedCircleGrid { columns, rows, .. } => (columns, rows),
            Self::Charuco { squares_x, squares_y, .. } => {
                (squares_x.saturating_sub(1), squares_y.saturating_sub(1))
            }
            Self::Tag { .. } => (2, 2),
            Self::Aprilgrid { tags_x, tags_y, .. } | Self::TagGrid { tags_x, tags_y, .. } => {
                (tags_x.saturating_mul(2), tags_y.saturating_mul(2))
            }
            Self::Sphere { .. } => (0, 0),
        }
    }

    /// Whether the target is a grid of circles.
    pub fn has_circles(&self) -> bool {
        matches!(
            self,
            Self::CircleGrid { .. }
                | Self::AsymmetricCircleGrid { .. }
                | Self::ModifiedCircleGrid { .. }
        )
    }

    /// The length that tells the target's scale, in metres: between neighbouring corners, circles
    /// or rows of circles, along a tag's side, across a ball (0 where that is not known).
    pub fn pitch_m(&self) -> f64 {
        1e-3 * match *self {
            Self::Checkerboard { square_mm, .. } | Self::Charuco { square_mm, .. } => square_mm,
            Self::Tag { size_mm, .. } => size_mm,
            Self::CircleGrid { pitch_mm, .. }
            | Self::AsymmetricCircleGrid { pitch_mm, .. }
            | Self::ModifiedCircleGrid { pitch_mm, .. } => pitch_mm,
            Self::Aprilgrid { tag_mm, .. } | Self::TagGrid { tag_mm, .. } => tag_mm,
            Self::Sphere { diameter_mm } => diameter_mm.unwrap_or(0.0),
        }
    }

    /// The same board, all its lengths multiplied by `factor`.
    pub fn resized(&self, factor: f64) -> Self {
        let mut other = self.clone();
        match &mut other {
            Self::Checkerboard { square_mm, .. } => *square_mm *= factor,
            Self::Charuco { square_mm, marker_mm, .. } => {
                *square_mm *= factor;
                *marker_mm *= factor;
            }
            Self::Tag { size_mm, .. } => *size_mm *= factor,
            Self::CircleGrid { pitch_mm, .. }
            | Self::AsymmetricCircleGrid { pitch_mm, .. }
            | Self::ModifiedCircleGrid { pitch_mm, .. } => *pitch_mm *= factor,
            Self::Aprilgrid { tag_mm, .. } => *tag_mm *= factor,
            Self::TagGrid { tag_mm, gap_mm, .. } => {
                *tag_mm *= factor;
                *gap_mm *= factor;
            }
            Self::Sphere { diameter_mm } => {
                diameter_mm.iter_mut().for_each(|d| *d *= factor);
            }
        }
        other
    }

    /// Number of corners.
    pub fn len(&self) -> usize {
        let (columns, rows) = self.grid();
        columns as usize * rows as usize
    }

    /// Whether the target has no corners: a ball.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of corner `id` on the board, in metres; `None` if the board has no such corner.
    pub fn corner(&self, id: u32) -> Option<Point<Target>> {
        ((id as usize) < self.len()).then(|| {
            let v = layout::in_plane(self, id);
            Point::new(v.x, v.y, 0.0)
        })
    }

    /// The point at which misfits are stated: the first inner corner, or the centre of a tag.
    pub fn reference(&self) -> Point<Target> {
        let origin = Point::new(0.0, 0.0, 0.0);
        if matches!(self, Self::Tag { .. }) { origin } else { self.corner(0).unwrap_or(origin) }
    }

    /// The middle of all corners.
    pub fn middle(&self) -> Point<Target> {
        let all = self.corners();
        let sum = all.iter().map(Point::vector).sum::<nalgebra::Vector3<f64>>();
        Point::from_vector(sum / all.len().max(1) as f64)
    }

    /// All corners in the order of their ids, in metres.
    pub fn corners(&self) -> Vec<Point<Target>> {
        (0..self.len() as u32).filter_map(|id| self.corner(id)).collect()
    }

    /// The id of the corner in a column and a row, both counted from 0 at the top left.
    pub fn id_at(&self, column: u32, row: u32) -> Option<u32> {
        let (columns, rows) = self.grid();
        (column < columns && row < rows).then(|| layout::id_at(self, column, row))
    }

    /// The outermost corners, once around the board; none of a ball.
    pub fn outline(&self) -> Vec<u32> {
        let (columns, rows) = self.grid();
        let (right, bottom) = (columns.saturating_sub(1), rows.saturating_sub(1));
        let around = [(0, 0), (right, 0), (right, bottom), (0, bottom)];
        around.into_iter().filter_map(|(column, row)| self.id_at(column, row)).collect()
    }

    /// The tags of an aprilgrid or tag grid, in the order of their corners' ids; none of others.
    pub fn tags(&self) -> Vec<PlacedTag> {
        layout::tags(self)
    }

    /// Relabelings under which a picture of the board looks the same, the identity first:
    /// `symmetries()[k][id]` is the id that corner `id` has after turning the board.
    ///
    /// A checkerboard looks the same after half a turn when its numbers of squares have an even
    /// sum; a square one with an odd number of squares also after quarter turns. A grid of circles
    /// looks the same after half a turn, a square one after quarter turns, an asymmetric one after
    /// half a turn if its number of rows is even.
    pub fn symmetries(&self) -> Vec<Vec<u32>> {
        let (columns, rows) = self.grid();
        let all: Vec<u32> = (0..self.len() as u32).collect();
        let half: Vec<u32> = all.iter().rev().copied().collect();
        let quarters = match self {
            Self::Checkerboard { .. } => columns == rows && columns % 2 == 0,
            Self::CircleGrid { .. } => columns == rows,
            _ => false,
        };
        let halves = match self {
            Self::Checkerboard { .. } => (columns + rows) % 2 == 0,
            Self::CircleGrid { .. } => true,
            Self::AsymmetricCircleGrid { .. } => rows % 2 == 0,
            _ => false,
        };
        if quarters {
            let quarter: Vec<u32> = all
                .iter()
                .map(|id| (id % columns) * columns + (columns - 1 - id / columns))
                .collect();
            let three: Vec<u32> = quarter.iter().map(|&id| half[id as usize]).collect();
            vec![all, quarter, half, three]
        } else if halves {
            vec![all, half]
        } else {
            vec![all]
        }
    }
}

/// Where a marker sits on a board.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedTag {
    /// Which marker of the dictionary.
    pub marker: u32,
    /// The ids of the corners that OpenCV calls top left, top right, bottom right, bottom left:
    /// those of the marker upright as the dictionary has it.
    pub corners: [u32; 4],
    /// The board's top left of the tag's black square, in metres.
    pub top_left: Vector2<f64>,
    /// Side of the black square, in metres.
    pub side: f64,
    /// Whether the dictionary's marker stands on its head when the board is read like a page.
    pub turned: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

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

    fn aprilgrid(tags_x: u32, tags_y: u32) -> TargetModel {
        TargetModel::Aprilgrid {
            tags_x,
            tags_y,
            tag_mm: 80.0,
            spacing: 0.25,
            family: AprilTagFamily::Tag36h11,
            first_id: 0,
            corner_squares: true,
            border_bits: 1,
        }
    }

    fn tag_grid(tags_x: u32, tags_y: u32) -> TargetModel {
        TargetModel::TagGrid {
            dictionary: "DICT_4X4_50".into(),
            tags_x,
            tags_y,
            tag_mm: 40.0,
            gap_mm: 10.0,
            first_id: 0,
        }
    }

    fn asymmetric(columns: u32, rows: u32) -> TargetModel {
        TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm: 20.0 }
    }

    #[test]
    fn half_a_turn_about_x_takes_an_aprilgrid_to_kalibrs_frame() {
        // Kalibr's points of tag 4 of 3 columns: x right, y up, from the bottom left of tag 0
        let (left, bottom, side) = (0.1, 0.1, 0.08);
        let kalibr = [
            (left, bottom),
            (left + side, bottom),
            (left + side, bottom + side),
            (left, bottom + side),
        ];
        for (k, (x, y)) in (0..).zip(kalibr) {
            let corner = aprilgrid(3, 2).corner(16 + k).unwrap().vector();
            assert!((corner - Vector3::new(x, -y, 0.0)).norm() < 1e-12, "{k}");
        }
    }

    #[test]
    fn a_tag_grid_has_the_corners_of_opencvs_grid_board() {
        let corner = |id| tag_grid(3, 2).corner(id).unwrap();
        assert_eq!(corner(1), Point::new(0.04, 0.0, 0.0));
        assert_eq!(corner(6), Point::new(0.09, 0.04, 0.0));
        assert_eq!(corner(15), Point::new(0.0, 0.09, 0.0));
    }

    #[test]
    fn every_second_row_of_an_asymmetric_grid_is_shifted() {
        assert_eq!(asymmetric(4, 11).corner(1), Some(Point::new(0.04, 0.0, 0.0)));
        assert_eq!(asymmetric(4, 11).corner(4), Some(Point::new(0.02, 0.02, 0.0)));
    }

    #[test]
    fn the_larger_circle_is_the_origin() {
        let board = TargetModel::ModifiedCircleGrid { columns: 10, rows: 10, pitch_mm: 25.0 };
        assert_eq!(board.corner(90), Some(Point::new(0.0, 0.0, 0.0)));
        assert_eq!(board.corner(9), Some(Point::new(0.225, -0.225, 0.0)));
    }

    /// Whether a board turned by a symmetry has a corner wherever it had one.
    fn turns_onto_itself(board: &TargetModel, map: &[u32]) -> bool {
        let turn = crate::detect::symmetry_turn(board, map);
        (0..).zip(board.corners()).all(|(id, here): (usize, _)| {
            board
                .corner(map[id])
                .is_some_and(|c| ((turn * c).vector() - here.vector()).norm() < 1e-9)
        })
    }

    #[test]
    fn symmetries_turn_a_board_onto_itself() {
        let circles = |columns, rows| TargetModel::CircleGrid { columns, rows, pitch_mm: 20.0 };
        let modified = TargetModel::ModifiedCircleGrid { columns: 5, rows: 5, pitch_mm: 20.0 };
        for (board, count) in [
            (circles(7, 5), 2),
            (circles(6, 6), 4),
            (asymmetric(4, 11), 1),
            (asymmetric(4, 8), 2),
            (modified, 1),
            (aprilgrid(6, 6), 1),
            (tag_grid(3, 3), 1),
            (TargetModel::Sphere { diameter_mm: Some(50.0) }, 1),
        ] {
            let maps = board.symmetries();
            assert_eq!(maps.len(), count, "{board:?}");
            assert!(maps.iter().all(|map| turns_onto_itself(&board, map)), "{board:?}");
        }
    }

    #[test]
    fn rows_and_columns_lead_to_the_corners_there() {
        for board in [aprilgrid(3, 2), tag_grid(3, 2), checkerboard(5, 4), asymmetric(3, 4)] {
            let (columns, rows) = board.grid();
            let at = |column, row| {
                board.id_at(column, row).and_then(|id| board.corner(id)).unwrap().vector()
            };
            for (i, j) in (1..columns).flat_map(|i| (1..rows).map(move |j| (i, j))) {
                assert!(at(i, j).x > at(i - 1, j).x && at(i, j).y > at(i, j - 1).y, "{board:?}");
            }
            assert_eq!(board.id_at(columns, 0), None);
            assert_eq!(board.outline().len(), 4);
        }
    }

    #[test]
    fn the_tags_of_an_aprilgrid_stand_on_their_heads() {
        let board = aprilgrid(3, 2);
        let tags = board.tags();
        assert_eq!((tags.len(), tags[4].marker), (6, 4));
        // OpenCV's top left is the bottom right of the page
        let at = |id| board.corner(id).unwrap().vector().xy();
        let right = at(tags[4].corners[0]);
        assert!((right - tags[4].top_left - Vector2::repeat(tags[4].side)).norm() < 1e-12);
    }

    #[test]
    fn more_tags_than_the_dictionary_has_are_refused() {
        let message = |board: TargetModel| board.check().unwrap_err().to_string();
        assert_eq!(
            message(tag_grid(8, 7)),
            "target: markers 0 to 55 are needed, but DICT_4X4_50 ends at 49: take \
             fewer markers or a larger dictionary"
        );
        let mut board = aprilgrid(6, 6);
        assert!(board.check().is_ok());
        if let TargetModel::Aprilgrid { family, .. } = &mut board {
            *family = AprilTagFamily::Tag16h5;
        }
        assert!(message(board).contains("DICT_APRILTAG_16h5 ends at 29"));
        assert!(message(aprilgrid(0, 3)).contains("at least 1 x 1"));
        assert!(message(aprilgrid(u32::MAX, u32::MAX)).contains("more than 100000"));
    }

    #[test]
    fn senseless_dimensions_are_refused() {
        let message = |board: TargetModel| board.check().unwrap_err().to_string();
        let mut board = aprilgrid(2, 2);
        if let TargetModel::Aprilgrid { spacing, .. } = &mut board {
            *spacing = 24.0;
        }
        assert!(message(board).contains("divided by tag_mm"));
        let mut board = aprilgrid(2, 2);
        if let TargetModel::Aprilgrid { border_bits, .. } = &mut board {
            *border_bits = 0;
        }
        assert!(message(board).contains("must be 1, or 2"));
        assert!(message(asymmetric(4, 1)).contains("one row of circles"));
        assert!(message(TargetModel::Sphere { diameter_mm: Some(f64::NAN) }).contains("positive"));
    }

    #[test]
    fn families_have_the_names_of_their_tags() {
        assert_eq!(AprilTagFamily::named("t36h11"), Some(AprilTagFamily::Tag36h11));
        assert_eq!(AprilTagFamily::named("25h9"), Some(AprilTagFamily::Tag25h9));
        assert_eq!(AprilTagFamily::named("36h9"), None);
        for family in ["16h5", "25h9", "36h10", "36h11"] {
            let family = AprilTagFamily::named(family).unwrap();
            assert!(crate::model::dictionary::Dictionary::named(family.dictionary()).is_some());
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
