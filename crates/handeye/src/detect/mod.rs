//! What the camera saw of the target.
//!
//! An image goes through three steps: `crossings` and `mesh` find grids of corners, [`board`] decides
//! which corner of the target each one is, and `subpixel` measures where exactly they are; grids
//! of [`circles`], single tags and boards of tags have ways of their own. From the corners,
//! `planar_pose` has the target's pose, and [`surface`] their places on a scan. A ball is found in
//! the scan alone, by [`sphere`].

pub mod board;
mod checkerboard;
pub mod circles;
mod coded;
mod crossings;
mod erf;
mod fits;
mod grid;
pub(crate) mod homography;
mod levenberg;
pub mod markers;
mod mesh;
mod outcome;
mod partial;
pub(crate) mod planar_pose;
mod pyramid;
mod recognise;
pub mod residuals;
mod saturated;
mod several;
pub mod sight;
pub mod sphere;
mod strays;
pub(crate) mod subpixel;
pub mod surface;
pub mod tag;
mod tags;
mod view;

pub use board::{detect, detect_with};
pub use outcome::NotFound;
pub use planar_pose::{
    PosedTarget, best_poses, target_poses, target_poses_with, typical_excess, with_symmetries,
};
pub(crate) use planar_pose::{relabelled, symmetry_turn, target_pose_near, typical_excess_near};
pub use recognise::{Recognised, recognise};
pub use several::detect_several;
pub(crate) use sight::{Sight, sighted};
pub use surface::{Missing, lift};
