//! Beside the calibration itself: finding a tool's tip, planning poses, and testing results.

pub mod halves;
pub mod held_out;
pub mod pivot;
pub mod plan;
pub mod repeat;
pub mod verify;
