//! What is found beside the answer, with its numbers: the one room in which a finding gets its code, its sentence, what
//! it does to the answer, and what to do about it.
//!
//! A stage that notices something makes a variant, and code matches on the variant, never on the text. A new finding is
//! a variant in the file of its subject, with a row there (its code, what it does to the answer, headline and advice), its
//! sentence and its numbers, and an entry in the book's list of codes (`book/src/trouble/codes.md`).

pub mod camera;
pub mod captures;
mod combined;
pub mod frames;
pub mod movement;
pub mod robot;
mod row;
pub mod severity;
pub mod streams;
pub mod target;
pub mod touches;
mod warning;

pub use camera::CameraFinding;
pub use captures::CaptureFinding;
pub use combined::{CombinedFinding, Effect};
pub use frames::FramesFinding;
pub(crate) use movement::MovementFinding;
pub use robot::RobotFinding;
pub(crate) use streams::StreamFinding;
pub use target::TargetFinding;
pub use touches::TouchFinding;
pub use warning::Warning;

use std::collections::BTreeMap;

use row::Row;

/// Something that was found, by what it is about.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// Intrinsics, and the depth of scans.
    Camera(CameraFinding),
    /// Captures that do not count, and whether those that do are enough.
    Captures(CaptureFinding),
    /// A cause with what it explains.
    Combined(CombinedFinding),
    /// The frames of images and scans.
    Frames(FramesFinding),
    /// Something moved.
    Movement(MovementFinding),
    /// The robot's poses and its arm.
    Robot(RobotFinding),
    /// Streams of poses, their clocks, and errors that change with time.
    Streams(StreamFinding),
    /// The target's size and shape.
    Target(TargetFinding),
    /// Touches, point pairs and the tool's tip.
    Touches(TouchFinding),
}

/// What the findings of every subject say of themselves.
trait Found {
    /// What is known of its code.
    fn row(&self) -> &'static Row;

    /// What was seen and where, with its numbers.
    fn message(&self) -> String;

    /// Its numbers, by name with unit.
    fn data(&self) -> Vec<(&'static str, f64)>;

    /// What it did to the answer, with its numbers, for the first sentence of a page; `None` where the words of its
    /// code say it all.
    fn headline(&self) -> Option<String> {
        None
    }
}

impl Finding {
    fn found(&self) -> &dyn Found {
        match self {
            Self::Camera(found) => found,
            Self::Captures(found) => found,
            Self::Combined(found) => found,
            Self::Frames(found) => found,
            Self::Movement(found) => found,
            Self::Robot(found) => found,
            Self::Streams(found) => found,
            Self::Target(found) => found,
            Self::Touches(found) => found,
        }
    }

    /// Short fixed name, for programs.
    pub fn code(&self) -> &'static str {
        self.found().row().code
    }

    /// What was seen and where, with its numbers.
    pub fn message(&self) -> String {
        self.found().message()
    }

    /// Its numbers, by name with unit.
    pub fn data(&self) -> BTreeMap<String, f64> {
        let finite = self.found().data().into_iter().filter(|(_, value)| value.is_finite());
        finite.map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// What it did to the answer, with its numbers, for the first sentence of a page; `None` where the words of its
    /// code say it all.
    pub fn headline(&self) -> Option<String> {
        self.found().headline()
    }
}

impl<F: Into<Finding>> From<F> for Warning {
    fn from(found: F) -> Self {
        let finding = found.into();
        let mut warning = Self::new(finding.code(), finding.message());
        warning.finding = Some(Box::new(finding));
        warning
    }
}

impl From<CameraFinding> for Finding {
    fn from(found: CameraFinding) -> Self {
        Self::Camera(found)
    }
}

impl From<CaptureFinding> for Finding {
    fn from(found: CaptureFinding) -> Self {
        Self::Captures(found)
    }
}

impl From<CombinedFinding> for Finding {
    fn from(found: CombinedFinding) -> Self {
        Self::Combined(found)
    }
}

impl From<FramesFinding> for Finding {
    fn from(found: FramesFinding) -> Self {
        Self::Frames(found)
    }
}

impl From<MovementFinding> for Finding {
    fn from(found: MovementFinding) -> Self {
        Self::Movement(found)
    }
}

impl From<RobotFinding> for Finding {
    fn from(found: RobotFinding) -> Self {
        Self::Robot(found)
    }
}

impl From<StreamFinding> for Finding {
    fn from(found: StreamFinding) -> Self {
        Self::Streams(found)
    }
}

impl From<TargetFinding> for Finding {
    fn from(found: TargetFinding) -> Self {
        Self::Target(found)
    }
}

impl From<TouchFinding> for Finding {
    fn from(found: TouchFinding) -> Self {
        Self::Touches(found)
    }
}
