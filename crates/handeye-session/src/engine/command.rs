//! What people and scripts ask of a session: the same from the page, by HTTP and from a file.

use handeye::{Intrinsics, Setup, TargetModel};
use serde::{Deserialize, Serialize, de::Error};
use serde_json::{Map, Value};

/// A step of a session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Step {
    /// Who carries the camera, and which error is tolerated.
    Cell,
    /// Images come.
    Camera,
    /// Poses come.
    Robot,
    /// The board is found.
    Board,
    /// Captures are taken.
    Capture,
    /// Corners are touched, for those who want that: a second instrument beside the camera.
    Touch,
    /// Views are taken that verify the captures, for those who want that.
    Verify,
    /// The result is written.
    Result,
}

impl Step {
    /// All, in order.
    pub const ALL: [Step; 8] = [
        Step::Cell,
        Step::Camera,
        Step::Robot,
        Step::Board,
        Step::Capture,
        Step::Touch,
        Step::Verify,
        Step::Result,
    ];

    /// As the page and scripts call it.
    pub fn name(self) -> &'static str {
        match self {
            Step::Cell => "cell",
            Step::Camera => "camera",
            Step::Robot => "robot",
            Step::Board => "board",
            Step::Capture => "capture",
            Step::Touch => "touch",
            Step::Verify => "verify",
            Step::Result => "result",
        }
    }

    /// The one after it.
    pub fn next(self) -> Option<Step> {
        Self::ALL.into_iter().find(|step| *step > self)
    }
}

/// A command: `{"do": "take"}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "do", rename_all = "lowercase", deny_unknown_fields)]
pub enum Command {
    /// What a step shows is right: go on.
    Confirm {
        /// The step.
        step: Step,
    },
    /// To another step.
    Go {
        /// The step.
        step: Step,
    },
    /// Setup and tolerance.
    Cell {
        /// Who carries the camera.
        #[serde(default)]
        setup: Option<Setup>,
        /// Error that is tolerated (95 %), mm.
        #[serde(default)]
        tolerance_mm: Option<f64>,
    },
    /// The board.
    Target {
        /// As a manifest's `[target]` has it.
        target: TargetModel,
    },
    /// The camera's intrinsics; `null` to calibrate them from the views.
    Camera {
        /// As `camera` in a result has them.
        intrinsics: Option<Intrinsics>,
    },
    /// How poses are typed and shown.
    Notation {
        /// A name of a robot's notation, such as `ur`.
        name: String,
        /// Whether the poses that were typed until now were typed in it, and are to be read again.
        #[serde(default)]
        reread: bool,
    },
    /// Take a capture as soon as robot and image stand; in the step `verify` a view that verifies the others.
    Take,
    /// Take captures without being asked, once at each pose.
    Automatic {
        /// Whether.
        on: bool,
    },
    /// No longer wait for a standstill.
    Cancel,
    /// Take an image to look at, where images are taken when they are asked for.
    Grab,
    /// A pose read from the pendant.
    Pose {
        /// Its numbers, in the notation.
        text: String,
    },
    /// Take a capture or a verification view out, or a placement with its touches.
    Delete {
        /// Its name.
        id: String,
    },
    /// Take it in again; a touch likewise.
    Restore {
        /// Its name.
        id: String,
    },
    /// Take a capture out, and propose its view as the next one.
    Retake {
        /// Its name.
        id: String,
    },
    /// Undo the last capture, placement, touch, deletion or restoring.
    Undo,
    /// Propose another view, not near this one.
    Skip {
        /// Why, in a person's words.
        #[serde(default)]
        why: String,
    },
    /// Where the tip of the tool that touches corners is in the flange, mm.
    Tip {
        /// x, y and z.
        in_flange_mm: [f64; 3],
    },
    /// Take the image of a board that was laid into the view to be touched, as soon as it stands (eye-to-hand).
    Place,
    /// The tip is at a corner of the board; of the newest placement with eye-to-hand.
    Touch {
        /// Which; the proposed one unless said.
        #[serde(default)]
        corner: Option<u32>,
    },
    /// Take a touch out.
    Untouch {
        /// Its name.
        id: String,
    },
    /// The captures are enough: write the result.
    Finish,
    /// Virtual cell: drive the robot.
    Drive {
        /// Where to.
        to: Destination,
    },
    /// Virtual cell: move the robot a little, in the camera's axes.
    Jog {
        /// By so much, mm.
        #[serde(default)]
        move_mm: [f64; 3],
        /// About its axes by so much, degrees.
        #[serde(default)]
        turn_deg: [f64; 3],
    },
}

impl Command {
    /// Reads a command, and refuses what it does not know of it.
    ///
    /// # Errors
    /// What is none.
    pub fn from_json(text: &[u8]) -> Result<Self, serde_json::Error> {
        let given: Map<String, Value> = serde_json::from_slice(text)?;
        let command: Self = serde_json::from_slice(text)?;
        let known = serde_json::to_value(&command)?;
        // of commands without keys of their own serde takes any
        match given.keys().find(|key| known.get(key).is_none()) {
            Some(key) => Err(serde_json::Error::custom(format!("unknown key `{key}`"))),
            None => Ok(command),
        }
    }
}

/// Where the robot of a virtual cell can be driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Destination {
    /// The next view.
    Next,
    /// The corner to touch.
    Touch,
    /// Somewhere else: a board is laid into the camera's view, to be touched.
    Placement,
}
