//! Registration of point sets.

pub mod icp;
mod moments;
pub mod rigid_fit;
mod rotation;

pub use icp::{Icp, IcpConfig, Stop, point_to_point};
pub use rigid_fit::{RigidFit, rigid_fit, weighted_rigid_fit};
