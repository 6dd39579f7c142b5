//! What the camera saw of the target.

pub mod markers;
pub mod subpixel;
