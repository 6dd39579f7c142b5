//! The families of targets, a file each: where its corners are, what is printed, which turns look the same.

pub(super) mod aprilgrid;
pub(super) mod charuco;
pub(super) mod checkerboard;
pub(super) mod circles;
pub(super) mod sphere;
pub(super) mod tag;
pub(super) mod tag_grid;

pub(super) use aprilgrid::Aprilgrid;
pub(super) use charuco::Charuco;
pub(super) use checkerboard::Checkerboard;
pub(super) use circles::CircleGrid;
pub(super) use sphere::Sphere;
pub(super) use tag::Tag;
pub(super) use tag_grid::TagGrid;
