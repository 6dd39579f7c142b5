//! Numbers: motions, matrices, least squares, chance, small sets, threads. Nothing here knows of robots or cameras.

pub(crate) mod gram;
pub(crate) mod jacobi;
pub mod lie;
pub mod linalg;
pub(crate) mod optimize;
pub mod parallel;
pub mod random;
pub(crate) mod statistics;
pub(crate) mod subsets;

pub use jacobi::nearest_rotation;
