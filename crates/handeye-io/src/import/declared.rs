//! What the user declares of a source, beyond its files.

use std::path::{Path, PathBuf};

use handeye::Setup;
use nalgebra::Isometry3;

use crate::{
    Error,
    error::{nearest, unusable},
    units::LengthUnit,
};

/// What the user says of a source.
#[derive(Debug, Clone, Default)]
pub struct Declared {
    /// Who carries the camera.
    pub setup: Option<Setup>,
    /// The camera's stream, where the source is the robot's.
    pub camera: Option<PathBuf>,
    /// What poses take to what.
    pub directions: Vec<Direction>,
    /// Which of several sequences.
    pub sequence: Option<String>,
    /// The unit of positions.
    pub length_unit: Option<LengthUnit>,
}

/// `a_from_b`: such a pose takes points of the second frame into the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Direction {
    /// The frame that points are taken into.
    pub to: &'static str,
    /// The frame that they are taken from.
    pub from: &'static str,
}

impl Direction {
    /// All that poses of robots, targets and results can have.
    pub const ALL: [Direction; 8] = [
        Self::of("base", "flange"),
        Self::of("flange", "base"),
        Self::of("camera", "target"),
        Self::of("target", "camera"),
        Self::of("base", "camera"),
        Self::of("camera", "base"),
        Self::of("flange", "camera"),
        Self::of("camera", "flange"),
    ];

    /// `to_from_from`.
    pub(super) const fn of(to: &'static str, from: &'static str) -> Self {
        Self { to, from }
    }

    /// `base_from_flange` and the like; `Err` says which there are.
    pub fn named(name: &str) -> Result<Self, String> {
        let names: Vec<String> = Self::ALL.iter().map(Self::name).collect();
        let found = names.iter().position(|n| n == name).map(|k| Self::ALL[k]);
        found.ok_or_else(|| match nearest(name, names.iter().map(String::as_str)) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("there are {}", names.join(", ")),
        })
    }

    /// As in a manifest.
    pub fn name(&self) -> String {
        format!("{}_from_{}", self.to, self.from)
    }

    /// The other way.
    pub(super) const fn inverse(&self) -> Self {
        Self::of(self.from, self.to)
    }

    /// Who carries the camera, where this is its pose.
    pub(super) fn setup(self) -> Option<Setup> {
        match [self.to, self.from] {
            ["base", "camera"] | ["camera", "base"] => Some(Setup::EyeToHand),
            ["flange", "camera"] | ["camera", "flange"] => Some(Setup::EyeInHand),
            _ => None,
        }
    }

    /// A pose of this direction in that one, which is the same or the inverse.
    pub(super) fn turned(&self, pose: &Isometry3<f64>, wanted: Direction) -> Isometry3<f64> {
        if *self == wanted { *pose } else { pose.inverse() }
    }
}

impl Declared {
    /// What was declared of poses between these two frames.
    pub(super) fn between(
        &self,
        one: Direction,
        source: &Path,
    ) -> Result<Option<Direction>, Error> {
        let mut found = self.directions.iter().filter(|d| **d == one || **d == one.inverse());
        match (found.next(), found.next()) {
            (Some(first), Some(second)) if first != second => {
                let what =
                    format!("is read as {} or as {}, not as both", first.name(), second.name());
                Err(unusable(source, what))
            }
            (first, _) => Ok(first.copied()),
        }
    }
}

/// The question behind a setup that nobody said.
pub(crate) const WHO_CARRIES: &str =
    "who carries the camera: the robot (eye-in-hand), or the cell (eye-to-hand)?";

/// What the files say of the setup, or the user.
pub(super) fn setup(
    own: Option<Setup>,
    given: Option<Setup>,
    source: &Path,
) -> Result<Option<Setup>, Error> {
    match (own, given) {
        (Some(own), Some(given)) if own != given => {
            let what =
                format!("says that it is {}, and {} was asked for", own.name(), given.name());
            Err(unusable(source, what))
        }
        _ => Ok(own.or(given)),
    }
}
