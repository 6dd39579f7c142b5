//! The families of targets, a file each: where its corners are, what is printed, which turns look the same.
//!
//! A new one is a file here, its variant of [`TargetModel`] with its lengths in `kinds.rs`, and in this file its line among
//! the modules, what is read of its variant, and its row in [`KINDS`]. Its print is drawn, looked for, named by an option
//! of the program and read from files with that; only what people mean when they declare it wrongly is known elsewhere.

mod aprilgrid;
mod charuco;
mod checkerboard;
mod circles;
mod sphere;
mod tag;
mod tag_grid;

use super::{
    family::Family,
    kinds::{Kind, TargetModel},
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
}
