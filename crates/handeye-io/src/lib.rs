//! What cameras, robots and teach pendants write, as handeye's types; results and reports back.
//!
//! Units and conventions convert here, once: inside all is metres, radians and `a_from_b`. What a
//! file does not prove and the user did not declare is refused with the question to answer.

#![allow(clippy::result_large_err, reason = "an error ends the reading: its size costs nothing")]

pub mod bag;
pub mod calibrate;
mod camera;
pub mod checkup;
mod dataset;
pub mod drawing;
mod error;
pub mod export;
mod files;
mod hash;
mod image;
mod import;
mod init;
pub mod measure;
mod mesh;
mod npy;
mod origin;
mod packed;
mod pairs_file;
mod pairs_table;
pub mod parallel;
mod parquet;
mod pixel_origin;
pub mod plan;
mod ply;
mod problem;
mod records;
mod registration;
pub mod report;
mod result_file;
mod result_folder;
pub mod robot;
mod scan;
#[cfg(test)]
mod schema;
mod session_folder;
mod shapes;
pub mod simulated;
mod table;
mod target_file;
mod touch_file;
mod tree;
pub mod units;
mod xml;

pub use camera::{intrinsics_from_json, read_intrinsics};
pub use dataset::{
    CaptureSource, Dataset, FIXED_BOARD, ImageSource, Limits, MANIFEST, MemoryCapture, MemoryCell,
    Noise, OpenKey, OpenQuestion, PixelOrigin, PlacementSource, Question, RobotFile, RobotPoses,
    Shape, WorkspaceBox, WorkspaceFrame, Writing, answered_with, columns, open_questions,
    read_robot_poses,
};
pub use error::{Error, Place};
pub use files::{process, temporary_folder, write_atomically};
pub use image::{image_size, read_image, read_image_bytes, small_jpeg};
pub use import::{Declared, Direction, Imported, import};
pub use init::{FirstManifest, Known, first_manifest, without_request};
pub use mesh::{is_mesh, points_on, read_mesh, spacing_on};
pub use pairs_file::{MeasuredPoses, PosesFile, poses_from_json, read_poses};
pub use pairs_table::{is_pairs_table, read_motions_table, read_pairs_table};
pub use problem::Problem;
pub use registration::{FoundPlace, RegistrationResult, Transform};
pub use result_file::{pose_file, read_result};
pub use result_folder::ResultFolder;
pub use robot::Urdf;
pub use scan::{ScanOptions, read_scan, scan_size, scan_unit};
pub use session_folder::{
    ArmLinks, CameraGuess, CellSettings, NewCapture, NewPlacement, NewTouch, RefusedCapture,
    ScanSettings, SessionFolder, StoredCapture, StoredPlacement, StoredTouch,
};
pub use target_file::{NamedTarget, Targets, read_target, read_targets, target_toml};
pub use touch_file::{TouchedPoint, read_touched_points};
