//! Findings about something that moved during the session.

use super::{Found, row::Row};
use serde::{Deserialize, Serialize};

use crate::Setup;

/// Something that moved during the session, or captures that say so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Movement {
    /// How.
    pub kind: MovementKind,
    /// Whether it may be the camera that moved.
    pub camera: bool,
    /// Whether it may be the target that moved.
    pub target: bool,
    /// First capture of a block, after a step, or of a slip.
    pub first: String,
    /// Last one.
    pub last: String,
    /// Whether the captures run to the end of the session.
    pub at_end: bool,
    /// Whether the robot poses of a block lie at a place of their own, or the robot went from place to place, and may err
    /// there.
    pub at_a_place: bool,
    /// How far, at the target (mm).
    pub displacement_mm: f64,
    /// By which angle.
    pub rotation_deg: f64,
    /// How probable a movement is.
    pub probability: f64,
    /// By how much the predicted error was widened (mm, squares added).
    pub widened_mm: f64,
}

/// How something moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MovementKind {
    /// Captures one after the other are rejected, and agree with one another.
    Block,
    /// At once, between two captures.
    Step,
    /// Evenly from the first capture to the last.
    Slip,
}

/// What is found about movements.
#[derive(Debug, Clone, PartialEq)]
pub enum MovementFinding {
    /// Captures that were rejected one after the other agree with one another.
    Displaced(Movement, Setup),
    /// Something moved, and the stated error covers it.
    Covered(Movement, Setup),
    /// The camera moved, and the answer is where it is since then.
    AnswerOfTheEnd {
        /// What moved.
        movement: Movement,
        /// Who carries the camera.
        setup: Setup,
        /// Captures since then.
        captures: usize,
        /// Whether there are touches, which may be older.
        touches: bool,
    },
    /// The camera moved, and the captures since then do not determine an answer.
    TooFewSince(Movement, Setup),
    /// The last capture does not agree with those before it: nothing says whether the camera was moved before it.
    UnconfirmedEnd {
        /// The capture.
        capture: String,
        /// How far it is from the others, where the camera saw the target (mm).
        displacement_mm: f64,
        /// By which angle.
        rotation_deg: f64,
    },
    /// During a run of captures the target, or the camera, was somewhere else.
    Elsewhere {
        /// The target, or else the camera.
        is_target: bool,
        /// Who carries the camera.
        setup: Setup,
        /// First capture of the run.
        first: String,
        /// Last one.
        last: String,
        /// Whether the run is the end of the session, so that it shows how things are now.
        is_now: bool,
    },
}

impl MovementFinding {
    /// What was seen and where, with its numbers.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Displaced(movement, setup) | Self::Covered(movement, setup) => {
                in_words(movement, *setup, movement.widened_mm > 0.0)
            }
            Self::AnswerOfTheEnd { movement, setup, captures, touches } => format!(
                "{}. The result is the camera's pose from capture {} on, from these {captures} captures alone{}",
                in_words(movement, *setup, false),
                movement.first,
                if *touches { "; the touches may be older, and are not used" } else { "" }
            ),
            Self::TooFewSince(movement, setup) => format!(
                "{}, and these do not determine an answer alone: take more captures with the camera at its current pose",
                in_words(movement, *setup, false)
            ),
            Self::UnconfirmedEnd { capture, displacement_mm, rotation_deg } => format!(
                "the last capture, {capture}, is {displacement_mm:.2} mm and {rotation_deg:.3} degrees away from the \
                 others, and whether the camera was moved before it is unknown: take another capture, which shows it, \
                 or leave {capture} out if nothing was moved"
            ),
            Self::Elsewhere { is_target: true, first, last, .. } => format!(
                "the target lay elsewhere during captures {first} to {last}: it was moved in the session; leave them \
                 out"
            ),
            Self::Elsewhere { is_now: true, setup, first, .. } => format!(
                "the camera was moved on the {} before capture {first}; leave the captures before that out: the \
                 calibration is to be for where the camera is now",
                setup.mount()
            ),
            Self::Elsewhere { setup, first, last, .. } => format!(
                "the camera had another pose on the {} during captures {first} to {last}: it was moved in the session; \
                 leave them out",
                setup.mount()
            ),
        }
    }
}

const CAPTURES_DISPLACED: Row = Row::changes(
    "captures-displaced",
    "captures were rejected one after the other and agree with one another",
    "find out whether something moved or the robot errs there",
);
const MOVED_DURING_SESSION: Row = Row::changes(
    "moved-during-session",
    "something moved during the session, and the stated error covers it",
    "tighten the mounts of camera, target and tool, and take the captures again",
);
const CAMERA_MOVED: Row = Row::changes(
    "camera-moved",
    "the camera moved during the session, and the result is its pose since then",
    "fasten the camera and the target, and take the captures again",
);
const TARGET_MOVED: Row = Row::info("target-moved");
const LAST_CAPTURE_DISPLACED: Row = Row::changes(
    "last-capture-displaced",
    "the last capture does not agree with the others, and the stated error covers that the camera was moved before it",
    "take another capture: it shows whether the camera was moved",
);

/// All codes of this subject.
pub(super) const ROWS: &[&Row] = &[
    &CAPTURES_DISPLACED,
    &MOVED_DURING_SESSION,
    &CAMERA_MOVED,
    &TARGET_MOVED,
    &LAST_CAPTURE_DISPLACED,
];

impl Found for MovementFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Displaced(..) => &CAPTURES_DISPLACED,
            Self::Covered(..) => &MOVED_DURING_SESSION,
            Self::AnswerOfTheEnd { .. } | Self::TooFewSince(..) => &CAMERA_MOVED,
            Self::UnconfirmedEnd { .. } => &LAST_CAPTURE_DISPLACED,
            Self::Elsewhere { is_target, .. } => {
                if *is_target {
                    &TARGET_MOVED
                } else {
                    &CAMERA_MOVED
                }
            }
        }
    }

    fn message(&self) -> String {
        MovementFinding::message(self)
    }

    fn headline(&self) -> Option<String> {
        match self {
            Self::Covered(movement, _) if movement.widened_mm > 0.0 => Some(format!(
                "something moved by {:.2} mm during the session, and the stated error covers it",
                movement.displacement_mm
            )),
            Self::AnswerOfTheEnd { movement, .. } => Some(format!(
                "the camera moved by {:.2} mm during the session, and the result is its pose since then",
                movement.displacement_mm
            )),
            Self::UnconfirmedEnd { capture, displacement_mm, .. } => Some(format!(
                "the last capture, {capture}, is {displacement_mm:.2} mm away from the others, and the stated error \
                 covers that the camera was moved before it"
            )),
            _ => None,
        }
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        if let Self::UnconfirmedEnd { displacement_mm, rotation_deg, .. } = self {
            return vec![("displacement_mm", *displacement_mm), ("rotation_deg", *rotation_deg)];
        }
        let (Self::Displaced(m, _)
        | Self::Covered(m, _)
        | Self::AnswerOfTheEnd { movement: m, .. }
        | Self::TooFewSince(m, _)) = self
        else {
            return vec![];
        };
        vec![
            ("displacement_mm", m.displacement_mm),
            ("rotation_deg", m.rotation_deg),
            ("probability", m.probability),
        ]
    }
}

/// What moved by how much, with the possible causes; `covered` says that the stated error covers it.
fn in_words(m: &Movement, setup: Setup, covered: bool) -> String {
    let how_far = format!("{:.2} mm and {:.3} degrees", m.displacement_mm, m.rotation_deg);
    let camera = format!("the camera moved on the {}", setup.mount());
    let target = match setup {
        Setup::EyeInHand => "the target moved",
        Setup::EyeToHand => "the target moved on the flange",
    };
    let mut causes: Vec<&str> = vec![];
    if m.camera {
        causes.push(&camera);
    }
    if m.target {
        causes.push(target);
    }
    if m.at_a_place {
        causes.push(match m.kind {
            MovementKind::Block => "the robot errs by as much at these poses",
            _ => "the robot's error changed with its pose",
        });
    }
    let causes = causes.join(", or ");
    let covers = if covered { "; the stated error covers it" } else { "" };
    match m.kind {
        MovementKind::Block => format!(
            "captures {} to {} agree with one another, {how_far} away from the others: {causes}{covers}",
            m.first, m.last
        ),
        MovementKind::Step => format!(
            "the captures from {} on differ from those before by {how_far}: {causes}{covers}. Tighten loose mounts, \
             and take the captures again",
            m.first
        ),
        MovementKind::Slip => format!(
            "errors grow evenly by {how_far} from capture {} to {}: {causes}{covers}. Warm up, tighten \
             loose mounts, and take the captures again",
            m.first, m.last
        ),
    }
}
