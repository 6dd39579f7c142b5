//! The tests of files from outside, in one program: it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails loudly")]

mod broken_inputs;
mod calibration_schema;
mod check;
mod dataset;
mod exports_read_back;
mod foreign_writers;
mod kinhec;
mod meshes;
mod printed_targets;
mod python_oracles;
mod real_data;
mod scans;
mod simulated;
mod urdf;
mod urdf_arms;
