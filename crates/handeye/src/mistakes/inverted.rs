//! Poses the other way round, where nobody offers other conventions of a file.
//!
//! No data tell robot poses inverted from the camera on the other body, nor, where target poses came from elsewhere, from
//! those inverted: `A⁻¹ X = Y B` is `A Y = X B⁻¹`. One fit with the robot poses inverted stands for all of them.

use super::{
    score::{Score, combined, scored},
    thresholds::{EXPLAINS, FEWEST_TO_JUDGE, LARGE, ROUNDING},
};
use crate::{
    PosePair,
    findings::{RobotFinding, robot::Inverted},
    model::residual::Residual,
    solve::{
        Method,
        consensus::{Consensus, Readings},
        solve,
    },
};

/// Whether most captures agree with the poses inverted, clearly better than as declared. `from_elsewhere` says that the
/// target poses are not our own, so that they may be inverted as well.
pub(crate) fn inverted(
    captures: &[Readings],
    declared: Option<&Consensus>,
    from_elsewhere: bool,
) -> Option<RobotFinding> {
    let before = declared.map(|found| Score::new(captures, found));
    if before.is_some_and(|before| before.score < least_to_explain(captures.len())) {
        return None;
    }
    let inverted = the_other_way(captures);
    if before.is_some_and(|before| cannot_explain(&inverted, &before)) {
        return None;
    }
    let (after, _) = scored(&inverted)?;
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

/// A closed form of captures that all agree is at most so many times as far off as what they agree on.
const CLOSED_FORM: f64 = 10.0;

/// Whether captures that all agree as declared are far from agreeing the other way: all of them would have to, and a closed
/// form would be near what they agree on.
fn cannot_explain(inverted: &[Readings], before: &Score) -> bool {
    if before.agree < inverted.len() || inverted.iter().any(|c| c.camera_from_target.len() != 1) {
        return false;
    }
    let pairs: Vec<PosePair> = inverted.iter().map(|c| c.pair(0)).collect();
    let Ok(hand_eye) = solve(&pairs, Method::Shah) else { return false };
    let residuals: Vec<Residual> = pairs.iter().map(|p| hand_eye.loop_residual(p)).collect();
    combined(&residuals) > CLOSED_FORM * before.score
}

/// The score from which on there is something to explain: of a few captures outliers can be rejected until the rest fits
/// anything, and they fit anything themselves.
fn least_to_explain(captures: usize) -> f64 {
    if captures < FEWEST_TO_JUDGE { LARGE } else { ROUNDING }
}

fn the_other_way(captures: &[Readings]) -> Vec<Readings> {
    let one = |c: &Readings| Readings {
        anchor_from_mount: c.anchor_from_mount.inverse().rename(),
        camera_from_target: c.camera_from_target.clone(),
    };
    captures.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        mistakes::tests::{agreed, in_order, shift, with_robot},
        solve::consensus,
    };

    #[test]
    fn inverted_poses_are_named_and_right_ones_are_not() {
        for seed in 0..4 {
            let right = in_order(12, seed);
            assert_eq!(inverted(&right.declared, Some(&agreed(&right)), true), None);
            let wrong = the_other_way(&right.declared);
            let agreed = consensus::consensus(&wrong).ok();
            let which = |from_elsewhere| match inverted(&wrong, agreed.as_ref(), from_elsewhere) {
                Some(RobotFinding::Inverted { which, after_mm, .. }) if after_mm < 3.0 => which,
                other => panic!("seed {seed}: {other:?}"),
            };
            assert_eq!((which(false), which(true)), (Inverted::Robot, Inverted::Either));
        }
    }

    #[test]
    fn captures_that_all_agree_are_not_searched_once_more() {
        let right = in_order(12, 2);
        let before = Score::new(&right.declared, &agreed(&right));
        assert!(cannot_explain(&the_other_way(&right.declared), &before));
        assert!(!cannot_explain(&right.declared, &before));
        // one that does not agree: anything may be
        let one_less = Score { agree: 11, ..before };
        assert!(!cannot_explain(&the_other_way(&right.declared), &one_less));
    }

    #[test]
    fn few_captures_are_judged_only_where_they_contradict_one_another_by_a_centimetre() {
        let millimetres = |mm: f64| crate::mistakes::score::combined(&[Residual::of(0.0, mm)]);
        assert!(least_to_explain(4) > millimetres(9.0) && least_to_explain(4) < millimetres(11.0));
        assert!(least_to_explain(5) < millimetres(0.001));
        let rough = with_robot(&in_order(4, 1), |k, c| {
            c.anchor_from_mount * shift(0.004 * (k as f64 - 1.5), 0.0, 0.0)
        });
        assert_eq!(inverted(&rough.declared, Some(&agreed(&rough)), false), None);
    }

    #[test]
    fn where_nothing_agrees_as_declared_most_must_agree_inverted() {
        let wrong = the_other_way(&in_order(12, 7).declared);
        assert!(inverted(&wrong, None, false).is_some());
        let mut most = wrong;
        let n = most.len();
        (0..7).for_each(|k| most[k].anchor_from_mount = most[(k + 8) % n].anchor_from_mount);
        assert_eq!(inverted(&most, None, false), None);
    }
}
