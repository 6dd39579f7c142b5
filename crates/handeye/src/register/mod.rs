//! Registration of point sets.

pub mod icp;
pub mod rigid_fit;

pub use icp::{Icp, IcpConfig, Stop, point_to_point};
pub use rigid_fit::{RigidFit, rigid_fit};
