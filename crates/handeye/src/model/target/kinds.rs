//! What a kind of targets is named by, and parts of targets.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::families::TargetModel;

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
