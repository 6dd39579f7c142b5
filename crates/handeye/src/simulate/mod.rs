//! Measurements with known truth: for tests, benchmarks and the demo.

pub mod random;
pub mod render;

pub use random::Random;
pub use render::{DepthSensor, Optics, Scene};
