//! Another meaning of the robot's numbers: notation, units, direction, transposed rotations, mirrored axes.
//!
//! Whoever reads the file offers the conventions; here the loops that captures close under each decide. Rotation and
//! translation must both count: permuting Euler axes conjugates every rotation by a fixed one, which `X` takes up, and
//! only the translations tell. What `X` cannot take up are the invariants of `A X = X B`: the motions of robot and camera
//! have the same angle (H. Chen, *A screw motion approach to uniqueness analysis of head-eye geometry*, CVPR 1991); they
//! sift conventions without a fit.
//!
//! No data tell an axis of the base mirrored from any other one mirrored: the base is turned.

use super::{
    evidence::{Convention, Evidence, Explanation},
    score::{combined, scored},
    thresholds::SIFTED,
};
use crate::{
    Camera, Pose, PosePair, Target,
    findings::RobotFinding,
    math::{lie, linalg::median},
    solve::{self, Method, consensus::Readings, few_axes},
};

/// Conventions that are fitted in full, best first by their quick scores.
const MOST_FITTED: usize = 8;
/// Quick scores beyond this part of the declared one are not worth a fit, unless all are bad.
const WORTH_A_FIT: f64 = 3.0;
/// A declared score (units of the score) up to which quick scores are trusted to choose what is fitted.
const QUICK: f64 = 10.0;

/// Every convention that is worth a fit, with its score; `before` is the declared score.
pub(super) fn others(evidence: &Evidence, before: f64) -> Vec<Explanation> {
    let all = &evidence.conventions;
    let mut quick: Vec<(f64, usize)> =
        all.iter().enumerate().map(|(k, c)| (quick_score(&c.captures), k)).collect();
    quick.sort_by(|a, b| a.0.total_cmp(&b.0));
    // symmetric boards and outliers spoil the quick score: then fit all that the invariants allow
    let is_ambiguous = all.iter().flat_map(|c| &c.captures).any(|c| c.camera_from_target.len() > 1);
    let is_spoilt =
        is_ambiguous && quick.first().is_some_and(|(score, _)| *score > before.min(QUICK));
    if is_spoilt {
        quick.retain(|(_, k)| angle_residual(&all[*k].captures) <= SIFTED);
    } else {
        quick.truncate(MOST_FITTED);
        quick.retain(|(score, _)| *score < WORTH_A_FIT * before);
    }
    quick.into_iter().filter_map(|(_, k)| convention(evidence, k)).collect()
}

fn convention(evidence: &Evidence, k: usize) -> Option<Explanation> {
    let Convention { words, captures } = &evidence.conventions[k];
    let (after, _) = scored(captures)?;
    let finding = RobotFinding::OtherConvention { words: words.clone() };
    Some(Explanation { convention: Some(k), ..Explanation::new(finding, Some(after)) })
}

/// One closed form over all captures in their first pose candidates; a robot of one axis has its own.
fn quick_score(captures: &[Readings]) -> f64 {
    let pairs: Vec<PosePair> =
        captures.iter().filter(|c| !c.camera_from_target.is_empty()).map(|c| c.pair(0)).collect();
    let found = solve::solve(&pairs, Method::Shah).ok().or_else(|| few_axes::solve(&pairs));
    found.map_or(f64::INFINITY, |found| {
        combined(&pairs.iter().map(|p| found.loop_residual(p)).collect::<Vec<_>>())
    })
}

/// Pairs of captures at which the invariants are taken, at most.
const MOST_INVARIANTS: usize = 400;

/// Median over motions of the difference between the robot's angle and the camera's, rad.
fn angle_residual(captures: &[Readings]) -> f64 {
    let n = captures.len();
    let all: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let step = (all.len() / MOST_INVARIANTS).max(1);
    let motions = all.iter().step_by(step);
    median(motions.filter_map(|&(i, j)| angle_difference(&captures[i], &captures[j])))
}

/// The least difference of both angles over the pose candidates of two captures.
fn angle_difference(a: &Readings, b: &Readings) -> Option<f64> {
    let robot = a.anchor_from_mount.angle_to(&b.anchor_from_mount);
    let camera = |x: &Pose<Camera, Target>, y: &Pose<Camera, Target>| {
        lie::angle(&x.iso().rotation.inverse(), &y.iso().rotation.inverse())
    };
    let angles = a
        .camera_from_target
        .iter()
        .flat_map(|x| b.camera_from_target.iter().map(move |y| camera(x, y)));
    angles.map(|angle| (robot - angle).abs()).reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::tests::{in_order, with_robot};

    /// The rotations transposed.
    fn transposed(evidence: &Evidence) -> Evidence {
        with_robot(evidence, |_, c| {
            let p = c.anchor_from_mount;
            Pose::from_parts(&p.rotation().transpose(), p.translation())
        })
    }

    fn named(words: &str, of: &Evidence) -> Convention {
        Convention { words: words.into(), captures: of.declared.clone() }
    }

    #[test]
    fn the_right_convention_scores_as_a_robot_and_wrong_ones_far_above() {
        let right = in_order(10, 2);
        let wrong = transposed(&right);
        let conventions = vec![named("wrong", &wrong), named("right", &right)];
        let found = others(&Evidence { conventions, ..wrong.clone() }, f64::INFINITY);
        assert_eq!(found.iter().map(|e| e.convention).collect::<Vec<_>>(), [Some(1), Some(0)]);
        assert_eq!(found[0].finding.message(), "right");
        assert!(found[0].score() < 3.0 && found[1].score() > 30.0, "{found:?}");
    }

    #[test]
    fn what_is_three_times_worse_by_a_closed_form_is_not_fitted() {
        let right = in_order(10, 2);
        let conventions = vec![named("wrong", &transposed(&right))];
        let score = quick_score(&conventions[0].captures);
        let offered = Evidence { conventions, ..right };
        assert_eq!(others(&offered, score / 2.9).len(), 1);
        assert_eq!(others(&offered, score / 3.1).len(), 0);
    }

    #[test]
    fn angles_of_motions_tell_a_wrong_rotation_and_no_order_of_axes() {
        let right = in_order(10, 2);
        assert!(angle_residual(&right.declared) < 0.01);
        let doubled = with_robot(&right, |_, c| {
            let p = c.anchor_from_mount;
            Pose::from_parts(&(p.rotation() * p.rotation()), p.translation())
        });
        assert!(angle_residual(&doubled.declared) > SIFTED);
    }
}
