//! What there is in a cell, and what is measured there: cameras, images, scans, targets, robots, observations.

pub mod camera;
pub mod dictionary;
pub mod image;
pub mod kinematics;
pub mod mesh;
pub mod names;
pub mod observation;
pub mod print;
pub mod relative;
pub mod residual;
pub mod scan;
pub mod session;
pub mod target;
pub(crate) mod texture;
pub mod verdict;
