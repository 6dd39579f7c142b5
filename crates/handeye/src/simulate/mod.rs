//! Measurements with known truth: for tests, benchmarks and the demo.

pub mod arm;
mod canvas;
pub mod cell;
pub mod clutter;
pub mod conditions;
mod mistakes;
mod pattern;
mod psf;
pub mod recording;
pub mod render;
mod robot_error;
pub mod room;
#[cfg(test)]
mod tests;

pub use arm::{ArmErrors, BuiltArm};
pub use cell::{Cell, CellNoise, Truth, Viewing};
pub(crate) use conditions::PrintErrors;
pub use conditions::{Conditions, Glare, Occlusion, Shape, TrueCorner};
pub use mistakes::{Mistake, spoil};
pub use pattern::{Clutter, Pattern};
pub use recording::Recording;
pub use render::{DepthSensor, Optics, Scene};
pub use room::{Room, Solid, Thing};
