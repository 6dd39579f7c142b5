//! The families of targets, a file each: where its corners are, what is printed, which turns look the same.

mod aprilgrid;
mod charuco;
mod checkerboard;
mod circles;
mod sphere;
mod tag;
mod tag_grid;

pub(super) use aprilgrid::Aprilgrid;
pub(super) use charuco::Charuco;
pub(super) use checkerboard::Checkerboard;
pub(super) use circles::CircleGrid;
pub(super) use sphere::Sphere;
pub(super) use tag::Tag;
pub(super) use tag_grid::TagGrid;
