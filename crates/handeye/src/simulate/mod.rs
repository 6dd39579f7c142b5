//! Measurements with known truth: for tests, benchmarks and the demo.

pub mod cell;
pub mod random;
pub mod render;

pub use cell::{Cell, CellNoise, Recording, Truth, Viewing};
pub use random::Random;
pub use render::{DepthSensor, Optics, Scene};
