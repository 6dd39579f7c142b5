//! Which mistake explains captures that contradict one another: a file for each, all of them by one residual
//! (`residual.rs`), one score (`score.rs`) and one set of thresholds (`thresholds.rs`).
//!
//! In this order:
//!
//! 1. mistakes about all captures: another `convention` of the robot's numbers, another `order` of images against robot
//!    poses, another `size` of the target. They are compared with each other, and the best explain alike or alone;
//! 2. poses that stood still (`frozen`), whatever else is wrong;
//! 3. where neither explains, captures that do not agree with the others: `exchanged`, taken while something was
//!    `moved`, or `disagreeing`.
//!
//! A calibration asks for 1 with `rejecting` where most captures disagree, for poses that are `inverted` and lengths in
//! another `unit`, and for the `cause` of every capture that it rejects: a `flipped` board, an exchange, the robot pose
//! of another one (`other_pose`). Scans are judged by `flatness` (a bent board) and `frames` (another frame than that
//! of the images).

pub(crate) mod cause;
mod convention;
mod disagreeing;
mod evidence;
mod exchanged;
pub mod flatness;
pub(crate) mod flipped;
pub mod frames;
mod frozen;
pub(crate) mod inverted;
mod moved;
mod order;
mod other_pose;
pub(crate) mod outliers;
pub mod score;
mod size;
mod size_cause;
pub(crate) mod thresholds;
pub(crate) mod unit;

pub use evidence::{Convention, Evidence, Explanation};
pub(crate) use size::{TargetScale, target_scale};
pub(crate) use size_cause::cause_of_size;
pub use thresholds::{FEWEST, REACH};

pub(crate) use crate::estimate::observability::{
    Free, free_directions, free_of, in_words, seen_volume,
};
use outliers::Outliers;
use score::{Score, scored};
use thresholds::{ALIKE, EXPLAINS};

use crate::{
    findings::{Finding, TargetFinding},
    solve::consensus::Consensus,
};

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The captures as declared; `None` when they agree on nothing at all.
    pub declared: Option<Score>,
    /// Explanations, best first.
    pub explanations: Vec<Explanation>,
    /// How many of the first explanations the data cannot tell apart.
    pub alike: usize,
    /// The best convention or order beside them: how far the others are away.
    pub runner_up: Option<Explanation>,
}

/// Looks for every mistake.
pub fn diagnose(evidence: &Evidence) -> Diagnosis {
    let AboutAll { declared, alike: mut found, others, size } = about_all(evidence);
    let (alike, is_explained) = (found.len(), !found.is_empty());
    let frozen: Vec<Explanation> =
        [frozen::robot(evidence), frozen::camera(evidence)].into_iter().flatten().collect();
    let is_frozen = !frozen.is_empty();
    found.extend(frozen);
    if !is_explained {
        // a size that is wrong by a little explains a little
        found.extend(size);
    }
    found.extend(frozen::repeated(evidence));
    if let Some((_, agreed)) = declared.as_ref().filter(|_| !is_explained && !is_frozen) {
        found.extend(about_outliers(evidence, &Outliers::unfitted(&evidence.declared, agreed)));
    }
    Diagnosis {
        declared: declared.map(|(score, _)| score),
        alike: alike.max(usize::from(!found.is_empty())),
        explanations: found,
        runner_up: others.into_iter().find(|other| !other.is_size()),
    }
}

/// The size of the target, or else the order of the robot poses, that explains why most captures contradict one another.
pub(crate) fn rejecting(evidence: &Evidence) -> Option<Finding> {
    let all = about_all(evidence).alike;
    let size =
        all.iter().find(|e| matches!(e.finding, Finding::Target(TargetFinding::ExplainsAll(_))));
    let most_agree = |e: &&Explanation| e.after.is_some_and(|s| s.is_most(evidence.names.len()));
    let order = all.iter().find(|e| !e.is_size() && most_agree(e));
    Some(size.or(order)?.finding.clone())
}

/// What mistakes about all captures explain.
struct AboutAll {
    declared: Option<(Score, Consensus)>,
    /// Those that the data cannot tell apart.
    alike: Vec<Explanation>,
    /// All others, best first.
    others: Vec<Explanation>,
    /// A wrong size, whether it explains much or little.
    size: Option<Explanation>,
}

fn about_all(evidence: &Evidence) -> AboutAll {
    let declared = scored(&evidence.declared);
    let before = declared.as_ref().map_or(f64::INFINITY, |(score, _)| score.score);
    let size = size::wrong_size(evidence, declared.as_ref());
    let mut all = convention::others(evidence, before);
    all.extend(order::orders(evidence));
    all.extend(size.clone());
    let (alike, others) = explaining_alike(all, before);
    AboutAll { declared, alike, others, size }
}

/// The explanations that the data cannot tell apart, where the best lowers the score enough; and all others, best first.
fn explaining_alike(
    mut all: Vec<Explanation>,
    before: f64,
) -> (Vec<Explanation>, Vec<Explanation>) {
    all.sort_by(|a, b| a.score().total_cmp(&b.score()));
    let enough = EXPLAINS * before;
    let best = all.first().map_or(f64::INFINITY, Explanation::score);
    let limit = if best < enough { enough.min(ALIKE * best) } else { 0.0 };
    all.into_iter().partition(|e| e.score() < limit)
}

/// Captures that were exchanged or taken while something was moved; those that disagree where neither is so.
fn about_outliers(evidence: &Evidence, outliers: &Outliers) -> Vec<Explanation> {
    let known = [exchanged::exchanged(evidence, outliers), moved::moved(evidence, outliers)];
    let known: Vec<Explanation> = known.into_iter().flatten().collect();
    if known.is_empty() {
        disagreeing::disagreeing(evidence, outliers).into_iter().collect()
    } else {
        known
    }
}

#[cfg(test)]
mod tests;
