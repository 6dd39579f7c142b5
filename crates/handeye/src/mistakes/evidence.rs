//! What hypotheses are about, and what they answer.

use super::score::Score;
use crate::{Setup, TargetModel, findings::Finding, solve::consensus::Readings};

/// Another meaning of the robot's numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Convention {
    /// What the robot poses are, and what they are declared to be.
    pub words: String,
    /// The captures with that meaning.
    pub captures: Vec<Readings>,
}

/// The captures of a set that show the target.
#[derive(Debug, Clone, PartialEq)]
pub struct Evidence {
    /// Which body carries the camera.
    pub setup: Setup,
    /// The declared target; `None` where target poses came from elsewhere.
    pub target: Option<TargetModel>,
    /// Names of the captures.
    pub names: Vec<String>,
    /// The captures as declared.
    pub declared: Vec<Readings>,
    /// Other meanings of the same numbers, as many captures each.
    pub conventions: Vec<Convention>,
}

impl Evidence {
    /// Names of some captures.
    pub fn named(&self, which: &[usize]) -> Vec<String> {
        which.iter().map(|&i| self.names[i].clone()).collect()
    }
}

/// A mistake that explains captures.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// Which.
    pub finding: Finding,
    /// The captures with it corrected; `None` where correcting needs new captures.
    pub after: Option<Score>,
    /// Chance of evidence as strong when nothing is wrong; `None` where the scores say it.
    pub p_value: Option<f64>,
    /// The convention that it is; `None` for other mistakes.
    pub convention: Option<usize>,
    /// Captures concerned; empty where all are.
    pub captures: Vec<usize>,
    /// Captures to leave out for an answer of how things are now; empty where that corrects nothing.
    pub obsolete: Vec<usize>,
}

impl Explanation {
    /// One that concerns all captures.
    pub(super) fn new(finding: impl Into<Finding>, after: Option<Score>) -> Self {
        Self {
            finding: finding.into(),
            after,
            p_value: None,
            convention: None,
            captures: vec![],
            obsolete: vec![],
        }
    }

    /// Whether it is the size of the target.
    pub(super) fn is_size(&self) -> bool {
        self.p_value.is_some()
    }

    /// The score with the mistake corrected; infinite where that needs new captures.
    pub(super) fn score(&self) -> f64 {
        self.after.map_or(f64::INFINITY, |after| after.score)
    }
}
