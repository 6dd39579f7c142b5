//! Numbers: motions, matrices, chance, threads. Nothing here knows of robots or cameras.

pub(crate) mod gram;
pub mod jacobi;
pub(crate) mod levenberg;
pub mod lie;
pub mod linalg;
pub mod parallel;
pub mod random;
pub(crate) mod statistics;
