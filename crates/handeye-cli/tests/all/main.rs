//! The tests of the program from outside, in one program: it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails loudly")]

mod broken_datasets;
mod checks;
mod commands;
mod compensate;
mod folder;
mod imports;
mod mistakes;
mod plan;
mod real_data;
mod register;
mod scene;
mod scripts;
mod session;
mod simulate_and_demo;
mod solve;
mod view;
