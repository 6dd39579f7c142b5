//! What comes to the engine, and what it wants done.

use std::sync::Arc;

use handeye::{Base, Flange, Pose};
use handeye_io::{CellSettings, RefusedCapture, StoredCapture, StoredPlacement, StoredTouch, Urdf};

use serde::Serialize;

use super::{
    Command,
    rest::{ImageSample, RobotSample},
};
use crate::assess::Assessment;

/// What happens to a session.
#[derive(Debug, Clone)]
pub enum Input {
    /// Time goes on, s.
    Clock(f64),
    /// The robot is somewhere.
    Robot(RobotSample),
    /// An image has come and was looked at.
    Image(ImageSample),
    /// Somebody asks for something.
    Command(Command),
    /// What the folder holds now.
    Folder(Box<FolderState>),
    /// A capture or placement was stored under this name, or why it was not.
    Stored(Result<String, String>),
    /// A touch was stored under this name, or why it was not.
    Touched(Result<String, String>),
    /// A change of the folder could not be made.
    Failed(String),
    /// The captures were assessed.
    Assessed {
        /// Which state of the captures.
        generation: u64,
        /// What they are worth, or why that cannot be said.
        assessment: Result<Arc<Assessment>, String>,
    },
    /// The result was written, or why not.
    Written(Result<Written, String>),
    /// A source has trouble.
    Trouble(Problem),
}

/// What went wrong.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Problem {
    /// A fixed name; it begins with `robot-` where poses do not come.
    pub code: String,
    /// What.
    pub message: String,
    /// What to do.
    pub advice: String,
}

impl Problem {
    /// Whether no poses came from the robot: it is over with the next one.
    pub(super) fn is_of_robot(&self) -> bool {
        self.code.starts_with("robot-")
    }
}

/// How poses or images come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// All the time: whether they stand is seen.
    Stream,
    /// One by one, from a person or a program that knows when.
    Single,
}

/// What a session has for sources.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sources {
    /// How poses come.
    pub robot: Flow,
    /// How images come.
    pub camera: Flow,
    /// Whether an image is taken when it is asked for.
    pub takes_images: bool,
    /// Whether robot and camera are virtual.
    pub is_virtual: bool,
}

impl Sources {
    /// Those of a virtual cell.
    pub const VIRTUAL: Self =
        Self { robot: Flow::Stream, camera: Flow::Stream, takes_images: false, is_virtual: true };

    /// Of somebody who hands over image and pose, and knows that they belong together.
    pub const PUSHED: Self =
        Self { robot: Flow::Single, camera: Flow::Single, takes_images: false, is_virtual: false };

    /// Whether images may be handed over by whoever has one.
    pub fn takes_uploads(self) -> bool {
        self.camera == Flow::Single && !self.takes_images
    }
}

/// The files of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The folder.
    pub folder: String,
    /// Names of the files in it.
    pub files: Vec<String>,
}

/// What the folder holds.
#[derive(Debug, Clone, PartialEq)]
pub struct FolderState {
    /// What is known of the cell.
    pub settings: CellSettings,
    /// The captures that stand.
    pub captures: Vec<StoredCapture>,
    /// The views that verify what is made of them.
    pub verification: Vec<StoredCapture>,
    /// Names of what was deleted: captures, views, placements, touches.
    pub deleted: Vec<String>,
    /// Captures that were not taken.
    pub refused: Vec<RefusedCapture>,
    /// Boards that lie in the view to be touched (eye-to-hand).
    pub placements: Vec<StoredPlacement>,
    /// The name of the one that was laid there last, also where that was deleted since.
    pub laid_last: Option<String>,
    /// Corners that were touched.
    pub touches: Vec<StoredTouch>,
    /// The robot's model.
    pub arm: Option<Arc<Urdf>>,
}

impl FolderState {
    /// A folder in which nothing was done yet.
    pub fn new(settings: CellSettings) -> Self {
        Self {
            settings,
            captures: vec![],
            verification: vec![],
            deleted: vec![],
            refused: vec![],
            placements: vec![],
            laid_last: None,
            touches: vec![],
            arm: None,
        }
    }
}

/// What a session wants to be done.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Store a capture of this image.
    Store {
        /// Whether it is a view that verifies the others.
        verifies: bool,
        /// The image's number.
        frame: u64,
        /// Where the robot stood.
        robot: RobotSample,
        /// When the image was taken, s.
        image_time_s: f64,
    },
    /// Store a placement of this image.
    StorePlacement {
        /// The image's number.
        frame: u64,
        /// When the image was taken, s.
        image_time_s: f64,
    },
    /// Store a touch of this corner.
    StoreTouch {
        /// Which.
        corner: u32,
        /// Of the board of which placement; `None` for the board of the captures.
        placement: Option<String>,
        /// Whether it verifies the captures, and the answer is not made with it.
        verifies: bool,
        /// Where the robot stood.
        robot: RobotSample,
    },
    /// Delete a touch.
    Untouch(String),
    /// Remember a capture that was not taken.
    Refuse(RefusedCapture),
    /// Delete a capture, a view, or a placement with its touches.
    Delete(String),
    /// Take a deleted one in again.
    Restore(String),
    /// Other settings of the cell.
    Configure(Box<CellSettings>),
    /// Read the numbers of all poses again, as those of this notation.
    Reread(String),
    /// Assess the captures.
    Assess {
        /// Which state of the captures.
        generation: u64,
        /// Poses that nobody goes to (again).
        not_near: Vec<Pose<Base, Flange>>,
        /// Whether a next view is wanted even where the captures are enough.
        goes_on: bool,
        /// Joint values of now (rad, m), where the robot's model has some that lead to its pose.
        joints: Option<Vec<f64>>,
    },
    /// Write the result.
    Write,
    /// Take an image.
    Grab,
    /// Drive the robot of a virtual cell; no other robot can be moved.
    Drive(Pose<Base, Flange>),
    /// Drive the tip of a virtual cell's robot to a corner of the board that lies there.
    DriveTip(u32),
    /// Lay a board into the view of a virtual cell's camera, or take it away.
    Lay(bool),
    /// Move the robot of a virtual cell a little, in the camera's axes (mm, degrees).
    Jog([f64; 3], [f64; 3]),
}

impl Effect {
    /// The number of the image that it stores.
    pub fn frame(&self) -> Option<u64> {
        match self {
            Effect::Store { frame, .. } | Effect::StorePlacement { frame, .. } => Some(*frame),
            _ => None,
        }
    }
}
