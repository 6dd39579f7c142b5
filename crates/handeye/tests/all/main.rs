//! The tests of the core from outside, in one program: it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails loudly")]

mod arm;
mod cells;
mod circles_and_outliers;
mod closed_forms;
mod estimator;
mod few_axes;
mod few_captures;
mod files;
mod findings;
mod fit;
mod places;
mod planned_poses;
mod policy;
mod problem;
mod robustness;
mod rooms;
mod touches;
mod uneven_boards;
mod wrong_lens;
