//! What a family of targets must say of itself.

use nalgebra::Vector2;

use super::{
    check,
    kinds::{PlacedTag, TargetModel},
    look::Look,
};
use crate::{
    Error,
    model::{print::Art, texture::Texture},
};

/// The markers on a board: the dictionary, the first of them and how many.
pub(super) type Markers<'a> = (&'a str, u32, u64);

/// The turns of a board under which an image of it looks the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Turns {
    None,
    Half,
    Quarter,
}

/// The corners, the print and the symmetries of one family. Positions are in metres, in the plane of the board.
pub(super) trait Family {
    /// What there is to see of it.
    fn look(&self) -> Look;

    /// Columns and rows of corners.
    fn grid(&self) -> (u32, u32);

    /// The lengths by which it is declared, by their keys; the first tells the scale.
    fn lengths_mm(&self) -> Vec<(&'static str, f64)>;

    /// Where a corner that exists is.
    fn in_plane(&self, id: u32) -> Vector2<f64>;

    /// The id of the corner in a column and a row, counted from the top left.
    fn id_at(&self, column: u32, row: u32) -> u32 {
        row * self.grid().0 + column
    }

    /// Under which turns it looks the same.
    fn turns(&self) -> Turns {
        Turns::None
    }

    /// Its tags, where it is a grid of them.
    fn tags(&self) -> Vec<PlacedTag> {
        vec![]
    }

    /// Its markers, where it has some.
    fn markers(&self) -> Option<Markers<'_>> {
        None
    }

    /// Refuses numbers of corners that no board has.
    fn check_counts(&self) -> Result<(), Error> {
        check::counts(self.grid(), "inner corners", "one row of corners does not fix its pose")
    }

    /// Refuses what else no board of the family has.
    fn check(&self) -> Result<(), Error> {
        match self.markers() {
            Some(markers) => check::markers(markers),
            None => Ok(()),
        }
    }

    /// The diameter of the circle with this id, mm; 0 where there are none.
    fn disc_diameter_mm(&self, _id: u32) -> f64 {
        0.0
    }

    /// What is black on it.
    fn art(&self, target: &TargetModel) -> Result<Art, Error>;

    /// The same as a function of the place; `None` where it is not drawn.
    fn texture(&self, target: &TargetModel) -> Option<Texture>;

    /// The target in words.
    fn in_words(&self) -> String;
}
