//! Where a result comes from, and what its frames are called elsewhere.

use serde::{Deserialize, Serialize};

use crate::{Calibration, Camera, Frame, Pose};

/// The frame of the camera's body, such as ROS's `camera_link`.
#[derive(Debug, Clone, Copy)]
pub struct Body;

impl Frame for Body {
    const NAME: &'static str = "body";
}

/// What the frames of a result are called in ROS and the like.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FrameNames {
    /// What carries the camera: flange (eye-in-hand) or base (eye-to-hand), as `tool0`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mount: Option<String>,
    /// The camera's optical frame: x right, y down, z forward; as `camera_color_optical_frame`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
    /// Frames that are fixed to the camera, the nearest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyFrame>,
}

/// A frame that is fixed to the camera.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BodyFrame {
    /// Its name, as `camera_link`.
    pub name: String,
    /// Where the camera's optical frame lies in it.
    pub body_from_camera: Pose<Body, Camera>,
}

/// A file that a result was made from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFile {
    /// As the manifest names it: relative to its folder.
    pub path: String,
    /// SHA-256 of its content, in hexadecimal digits.
    pub sha256: String,
}

/// What a result was made from, by what, and when.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origin {
    /// Version of the program.
    pub version: String,
    /// When it was made: UTC, as `2026-03-14T09:26:53Z`.
    pub created: Option<String>,
    /// What the data are called.
    pub dataset: Option<String>,
    /// All files.
    pub inputs: Vec<InputFile>,
}

impl Calibration {
    /// With what it was made from.
    pub fn made_from(self, origin: Origin) -> Self {
        let Origin { version, created, dataset, inputs } = origin;
        Self { version: Some(version), created, dataset, inputs, ..self }
    }

    /// With the names of its frames.
    pub fn with_frames(self, frames: Option<FrameNames>) -> Self {
        Self { frames, ..self }
    }
}
