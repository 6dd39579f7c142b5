//! The kinds of targets, as they are declared.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

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

/// A kind of targets.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name in files.
    pub name: &'static str,
    /// One of the kind.
    pub example: fn() -> TargetModel,
    /// The keys that tell how many of what it has, or which one it is: what an option of a program says of it. None for
    /// what is not printed.
    pub counts: &'static [&'static str],
    /// The same in words, for the option's help.
    pub help: &'static str,
}

impl Kind {
    /// Whether it can be printed.
    pub fn is_printed(&self) -> bool {
        !self.counts.is_empty()
    }
}

/// A family of AprilTags.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

/// The place of a marker on a board.
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
