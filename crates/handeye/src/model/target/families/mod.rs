//! The families of targets, a file each: where its corners are, what is printed, which turns look the same.
//!
//! A new one is a file here, and in this file its line among the modules, its variant of [`TargetModel`] with what is
//! read of it, and its row in [`KINDS`]. Its print is drawn, looked for, named by an option of the program and read from
//! files with that; only what people mean when they declare it wrongly is known elsewhere.

mod aprilgrid;
mod charuco;
mod checkerboard;
mod circles;
mod sphere;
mod tag;
mod tag_grid;

use serde::{Deserialize, Serialize};

use super::{
    family::Family,
    kinds::{AprilTagFamily, Kind},
    look::Circles,
};
use aprilgrid::Aprilgrid;
use charuco::Charuco;
use checkerboard::Checkerboard;
use circles::CircleGrid;
use sphere::Sphere;
use tag::Tag;
use tag_grid::TagGrid;

/// All kinds, in the order in which people are shown them.
pub const KINDS: [Kind; 9] = [
    checkerboard::KIND,
    charuco::KIND,
    aprilgrid::KIND,
    tag_grid::KIND,
    tag::KIND,
    circles::PLAIN,
    circles::ASYMMETRIC,
    circles::WITH_LARGER,
    sphere::KIND,
];

fn drawn_by_kalibr() -> bool {
    true
}

fn one_bit() -> u32 {
    1
}

/// A calibration target and its dimensions. Lengths in millimetres, as people print them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
        /// Its diameter; without it, estimated from the scans.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        diameter_mm: Option<f64>,
    },
}

impl TargetModel {
    /// Reads something of the target's family.
    pub(super) fn family<T>(&self, read: impl FnOnce(&dyn Family) -> T) -> T {
        match *self {
            Self::Checkerboard { columns, rows, square_mm } => {
                read(&Checkerboard { columns, rows, square_mm })
            }
            Self::Charuco {
                squares_x,
                squares_y,
                square_mm,
                marker_mm,
                ref dictionary,
                legacy,
                first_id,
            } => read(&Charuco {
                squares_x,
                squares_y,
                square_mm,
                marker_mm,
                dictionary,
                legacy,
                first_id,
            }),
            Self::Tag { ref dictionary, id, size_mm } => read(&Tag { dictionary, id, size_mm }),
            Self::CircleGrid { columns, rows, pitch_mm } => {
                read(&CircleGrid { circles: Circles::Plain, columns, rows, pitch_mm })
            }
            Self::AsymmetricCircleGrid { columns, rows, pitch_mm } => {
                read(&CircleGrid { circles: Circles::Asymmetric, columns, rows, pitch_mm })
            }
            Self::ModifiedCircleGrid { columns, rows, pitch_mm } => {
                read(&CircleGrid { circles: Circles::WithLarger, columns, rows, pitch_mm })
            }
            Self::Aprilgrid {
                tags_x,
                tags_y,
                tag_mm,
                spacing,
                family,
                first_id,
                corner_squares,
                border_bits,
            } => read(&Aprilgrid {
                tags_x,
                tags_y,
                tag_mm,
                spacing,
                family,
                first_id,
                corner_squares,
                border_bits,
            }),
            Self::TagGrid { ref dictionary, tags_x, tags_y, tag_mm, gap_mm, first_id } => {
                read(&TagGrid { dictionary, tags_x, tags_y, tag_mm, gap_mm, first_id })
            }
            Self::Sphere { diameter_mm } => read(&Sphere { diameter_mm }),
        }
    }

    /// All its lengths.
    pub(super) fn lengths_mm_mut(&mut self) -> Vec<&mut f64> {
        match self {
            Self::Checkerboard { square_mm: length, .. }
            | Self::Tag { size_mm: length, .. }
            | Self::CircleGrid { pitch_mm: length, .. }
            | Self::AsymmetricCircleGrid { pitch_mm: length, .. }
            | Self::ModifiedCircleGrid { pitch_mm: length, .. }
            | Self::Aprilgrid { tag_mm: length, .. } => vec![length],
            Self::Charuco { square_mm, marker_mm, .. } => vec![square_mm, marker_mm],
            Self::TagGrid { tag_mm, gap_mm, .. } => vec![tag_mm, gap_mm],
            Self::Sphere { diameter_mm } => diameter_mm.iter_mut().collect(),
        }
    }
}
