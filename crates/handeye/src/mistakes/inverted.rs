//! Poses the other way round, where nobody offers other readings of a file.
//!
//! No data tell robot poses inverted from the camera on the other body, nor, where target poses came from elsewhere, from
//! those inverted: `A⁻¹ X = Y B` is `A Y = X B⁻¹`. One fit with the robot poses inverted stands for all of them.

use super::{
    score::{Score, scored},
    thresholds::{EXPLAINS, FEWEST_TO_JUDGE, LARGE, ROUNDING},
};
use crate::{
    findings::{RobotFinding, robot::Inverted},
    solve::consensus::{Consensus, Readings},
};

/// Whether most captures agree with the poses inverted, clearly better than as declared. `from_elsewhere` says that the
/// target poses are not our own, so that they may be inverted as well.
pub(crate) fn inverted(
    captures: &[Readings],
    declared: Option<&Consensus>,
    from_elsewhere: bool,
) -> Option<RobotFinding> {
    let before = declared.map(|found| Score::new(captures, found));
    // of a few captures outliers can be rejected until the rest fits anything, and they fit anything themselves
    let least = if captures.len() < FEWEST_TO_JUDGE { LARGE } else { ROUNDING };
    if before.is_some_and(|before| before.score < least) {
        return None;
    }
    let (after, _) = scored(&the_other_way(captures))?;
    let is_better =
        |before: Score| after.agree >= before.agree && after.score < EXPLAINS * before.score;
    (after.is_most(captures.len()) && before.is_none_or(is_better)).then(|| {
        RobotFinding::Inverted {
            which: if from_elsewhere { Inverted::Either } else { Inverted::Robot },
            before_mm: before.map(|score| score.translation_mm),
            after_mm: after.translation_mm,
        }
    })
}

fn the_other_way(captures: &[Readings]) -> Vec<Readings> {
    let one = |c: &Readings| Readings {
        anchor_from_mount: c.anchor_from_mount.inverse().rename(),
        camera_from_target: c.camera_from_target.clone(),
    };
    captures.iter().map(one).collect()
}
