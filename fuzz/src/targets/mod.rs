//! What is fed with broken input.

pub mod bag;
pub mod camera;
pub mod detect;
pub mod image;
pub mod import;
pub mod lift;
pub mod manifest;
pub mod poses;
pub mod scan;
pub mod touches;

/// What reads some bytes.
pub type Target = fn(&[u8]);

/// All of them, by name.
pub const ALL: [(&str, Target); 10] = [
    ("bag", bag::run),
    ("camera", camera::run),
    ("detect", detect::run),
    ("image", image::run),
    ("import", import::run),
    ("lift", lift::run),
    ("manifest", manifest::run),
    ("poses", poses::run),
    ("scan", scan::run),
    ("touches", touches::run),
];
