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
mod families;
mod family;
pub(crate) mod kinds;
mod layout;
pub(crate) mod look;

pub use families::KINDS;
pub(crate) use kinds::PlacedTag;
pub use kinds::{AprilTagFamily, Kind, TargetModel};

use crate::{Error, Point, Target};
use family::Turns;
use look::Look;

use super::{print::Art, texture::Texture};

impl TargetModel {
    /// Columns and rows of corners; 2 x 2 to a tag, none to a ball.
    pub fn grid(&self) -> (u32, u32) {
        self.family(|family| family.grid())
    }

    /// The length that tells the target's scale, in metres: between neighbouring corners, circles
    /// or rows of circles, along a tag's side, across a ball (0 where that is not known).
    pub fn pitch_m(&self) -> f64 {
        1e-3 * self.family(|family| family.lengths_mm().first().map_or(0.0, |(_, mm)| *mm))
    }

    /// The same board, all its lengths multiplied by `factor`.
    pub fn resized(&self, factor: f64) -> Self {
        let mut other = self.clone();
        other.lengths_mm_mut().into_iter().for_each(|length| *length *= factor);
        other
    }

    /// The target in words.
    pub fn in_words(&self) -> String {
        self.family(|family| family.in_words())
    }

    /// What is black on it; [`print::art`](super::print::art) checks it first.
    pub(super) fn art(&self) -> Result<Art, Error> {
        self.family(|family| family.art(self))
    }

    /// The same as a function of the place; `None` where it is not drawn.
    pub(super) fn texture(&self) -> Option<Texture> {
        self.family(|family| family.texture(self))
    }

    /// The diameter of the circle with this id, mm; 0 where there are none.
    pub(super) fn disc_diameter_mm(&self, id: u32) -> f64 {
        self.family(|family| family.disc_diameter_mm(id))
    }

    /// What there is to see of it.
    pub(crate) fn look(&self) -> Look {
        self.family(|family| family.look())
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
            let v = self.family(|family| family.in_plane(id));
            Point::new(v.x, v.y, 0.0)
        })
    }

    /// The point at which residuals are stated: the first inner corner, or the centre of a tag.
    pub fn reference(&self) -> Point<Target> {
        let origin = Point::new(0.0, 0.0, 0.0);
        if matches!(self.look(), Look::Tag { .. }) {
            origin
        } else {
            self.corner(0).unwrap_or(origin)
        }
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
        (column < columns && row < rows).then(|| self.family(|family| family.id_at(column, row)))
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
        self.family(|family| family.tags())
    }

    /// Relabelings under which an image of the board looks the same, the identity first:
    /// `symmetries()[k][id]` is the id that corner `id` has after turning the board.
    pub fn symmetries(&self) -> Vec<Vec<u32>> {
        let (columns, _) = self.grid();
        let all: Vec<u32> = (0..self.len() as u32).collect();
        let half: Vec<u32> = all.iter().rev().copied().collect();
        match self.family(|family| family.turns()) {
            Turns::None => vec![all],
            Turns::Half => vec![all, half],
            Turns::Quarter => {
                let quarter: Vec<u32> = all
                    .iter()
                    .map(|id| (id % columns) * columns + (columns - 1 - id / columns))
                    .collect();
                let three: Vec<u32> = quarter.iter().map(|&id| half[id as usize]).collect();
                vec![all, quarter, half, three]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use nalgebra::Vector3;

    fn checkerboard(columns: u32, rows: u32) -> TargetModel {
        TargetModel::Checkerboard { columns, rows, square_mm: 30.0 }
    }

    #[test]
    fn every_kind_is_in_the_table_by_its_name_in_files() {
        let unknown: serde_json::Error =
            serde_json::from_str::<TargetModel>(r#"{"kind":"none"}"#).unwrap_err();
        let unknown = unknown.to_string();
        let (_, expected) = unknown.split_once("expected one of ").unwrap();
        let mut in_files: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
        let mut listed = KINDS.map(|kind| kind.name).to_vec();
        in_files.sort_unstable();
        listed.sort_unstable();
        assert_eq!(in_files, listed);
        for kind in KINDS {
            let example = (kind.example)();
            assert_eq!(serde_json::to_value(&example).unwrap()["kind"], kind.name);
            assert!(example.check().is_ok(), "{}", kind.name);
        }
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
