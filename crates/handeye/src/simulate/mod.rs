//! Measurements with known truth: for tests, benchmarks and the demo.

pub mod arm;
pub mod cell;
mod mistakes;
pub mod random;
pub mod recording;
pub mod render;
mod robot_error;
mod texture;

pub use arm::{ArmErrors, BuiltArm};
pub use cell::{Cell, CellNoise, Viewing};
pub use mistakes::{Mistake, spoil};
pub use random::Random;
pub use recording::{Recording, Truth};
pub use render::{DepthSensor, Optics, Scene};
