//! Guided live hand-eye calibration. The session is a folder: captures are stored before anyone hears of them, the manifest is
//! an ordinary one, and everything shown is computed from the folder by the functions that `handeye calibrate` uses.
//!
//! [`engine`] decides (pure: inputs in, effects out), [`sources`] give poses and images, [`host`] does what the engine
//! wants done, and [`script`] plays a session without a page.

#![allow(clippy::result_large_err, reason = "an error ends the work: its size costs nothing")]

pub mod assess;
pub mod engine;
pub mod host;
pub mod live;
#[cfg(test)]
mod openapi;
pub mod push;
pub mod script;
pub mod server;
pub mod sources;
