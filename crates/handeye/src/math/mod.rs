//! Numbers: motions, matrices, chance, threads. Nothing here knows of robots or cameras.

pub(crate) mod gram;
pub(crate) mod jacobi;
pub mod lie;
pub mod linalg;
pub mod parallel;
pub mod random;
pub(crate) mod statistics;
