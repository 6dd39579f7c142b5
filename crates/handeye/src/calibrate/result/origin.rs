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

/// What stands in the cell, as far as it is known: whose result it is when camera or robot are exchanged.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Equipment {
    /// Make and model of the camera, as `Photoneo PhoXi M`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
    /// The camera's serial number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_serial: Option<String>,
    /// Make and model of the robot, as `UR10e`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    /// The robot's serial number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot_serial: Option<String>,
    /// The board, as it is marked: `CB-0417`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub board: Option<String>,
}

impl Equipment {
    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What is known in words, part by part: `camera Photoneo PhoXi M, serial number 2018-03-025`.
    pub fn in_words(&self) -> Vec<String> {
        let part = |part: &str, what: &Option<String>, serial: &Option<String>| {
            let serial = serial.as_ref().map(|number| format!("serial number {number}"));
            let said: Vec<String> = what.clone().into_iter().chain(serial).collect();
            (!said.is_empty()).then(|| format!("{part} {}", said.join(", ")))
        };
        let all = [
            part("camera", &self.camera, &self.camera_serial),
            part("robot", &self.robot, &self.robot_serial),
            part("board", &self.board, &None),
        ];
        all.into_iter().flatten().collect()
    }
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
    /// What stands in the cell.
    pub equipment: Equipment,
}

impl Calibration {
    /// With what it was made from.
    pub fn made_from(self, origin: Origin) -> Self {
        let Origin { version, created, dataset, inputs, equipment } = origin;
        Self { version: Some(version), created, dataset, inputs, equipment, ..self }
    }

    /// With the names of its frames.
    pub fn with_frames(self, frames: Option<FrameNames>) -> Self {
        Self { frames, ..self }
    }
}
