//! Registration of point sets.

mod blocks;
mod creases;
pub mod dense;
mod descent;
mod freedom;
pub mod gaps;
mod global;
mod grid_view;
pub mod icp;
pub mod kd_tree;
pub mod measured_fit;
mod mesh_surface;
mod moments;
mod outlook;
mod pair;
mod part_search;
mod patch;
pub mod rigid_fit;
mod rivals;
pub mod robust_fit;
mod rotation;
mod search;
pub mod similarity_fit;
mod size;
mod surface;
mod voxels;

pub use dense::{Dense, DenseConfig, DenseMethod, register, register_surfaces};
pub use gaps::Reference;
pub use icp::{Icp, IcpConfig, Stop, point_to_point};
pub use kd_tree::{KdTree, Neighbour};
pub use measured_fit::{MeasuredFit, MeasuredPoint, measured_fit};
pub use rigid_fit::{RigidFit, rigid_fit, weighted_rigid_fit};
pub use robust_fit::{RobustFit, robust_fit};
pub use similarity_fit::{SimilarityFit, similarity_fit};
pub use size::Size;
pub use surface::Surface;
