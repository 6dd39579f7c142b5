//! A run of captures during which the target, or the camera on its mount, was somewhere else.
//!
//! The run agrees with itself, and one of its captures, the best, tells where the part was: `Y = A X C` where the target was
//! moved, `X = A⁻¹ Y C⁻¹` where the camera was.

use super::{
    evidence::{Evidence, Explanation},
    outliers::Outliers,
    thresholds::{FEWEST, ONE_FOR_ALL},
};
use crate::{HandEye, PosePair, findings::MovementFinding};

/// Whether the outliers are one run that a moved target or camera explains.
pub(super) fn moved(evidence: &Evidence, outliers: &Outliers) -> Option<Explanation> {
    let n = evidence.names.len();
    let run: Vec<usize> = (0..n).filter(|&i| !outliers.found.agrees[i]).collect();
    let (first, last) = (*run.first()?, *run.last()?);
    // one capture is an outlier, not a run; most of them, and enough, must not have moved
    let rest = n - run.len();
    if run.len() < 2 || last - first + 1 != run.len() || rest <= run.len() || rest < FEWEST {
        return None;
    }
    let by_target = together(outliers, &run, target_there);
    let by_camera = together(outliers, &run, camera_there);
    let is_target = by_target <= by_camera;
    let is_now = last + 1 == n;
    // a camera that was bumped is to be calibrated where it is now
    let obsolete = if is_now && !is_target { (0..first).collect() } else { run.clone() };
    let finding = MovementFinding::Elsewhere {
        is_target,
        setup: evidence.setup,
        first: evidence.names[first].clone(),
        last: evidence.names[last].clone(),
        is_now,
    };
    (by_target.min(by_camera) < ONE_FOR_ALL).then(|| Explanation {
        captures: run,
        obsolete,
        ..Explanation::new(finding, None)
    })
}

/// Both poses with the target where one capture sees it.
fn target_there(at: &HandEye, p: &PosePair) -> HandEye {
    let there = p.anchor_from_mount * at.mount_from_camera * p.camera_from_target;
    HandEye { anchor_from_target: there, ..*at }
}

/// Both poses with the camera where one capture tells it to be.
fn camera_there(at: &HandEye, p: &PosePair) -> HandEye {
    let from_anchor = p.anchor_from_mount.inverse() * at.anchor_from_target;
    HandEye { mount_from_camera: from_anchor * p.camera_from_target.inverse(), ..*at }
}

/// Largest residual of a run in units of one that still agrees, where its best capture tells the place of what was moved.
fn together(outliers: &Outliers, run: &[usize], there: fn(&HandEye, &PosePair) -> HandEye) -> f64 {
    let views = run.iter().flat_map(|&i| &outliers.candidates[i]);
    let answers = views.map(|view| there(&outliers.found.hand_eye, &view.pair));
    answers.map(|answer| worst(outliers, run, &answer)).fold(f64::INFINITY, f64::min)
}

/// Largest residual of a run under an answer, each capture in its best pose candidate.
fn worst(outliers: &Outliers, run: &[usize], answer: &HandEye) -> f64 {
    let best = |&i: &usize| {
        let all = outliers.candidates[i]
            .iter()
            .map(|view| answer.loop_residual(&view.pair).over(outliers.typical));
        all.fold(f64::INFINITY, f64::min)
    };
    run.iter().map(best).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Setup,
        findings::Finding,
        mistakes::tests::{agreed, in_order, shift, with_robot},
    };

    fn found(wrong: &Evidence) -> Option<(bool, bool, Explanation)> {
        let agreed_on = agreed(wrong);
        let found = moved(wrong, &Outliers::unfitted(&wrong.declared, &agreed_on))?;
        let Finding::Movement(MovementFinding::Elsewhere { is_target, is_now, .. }) = found.finding
        else {
            panic!("{found:?}")
        };
        Some((is_target, is_now, found))
    }

    /// A target that lies 3 cm beside is the same as a robot that says so in its base.
    fn target_moved(right: &Evidence, run: std::ops::Range<usize>) -> Evidence {
        with_robot(right, |k, c| match run.contains(&k) {
            true => shift(0.03, 0.0, 0.0) * c.anchor_from_mount,
            false => c.anchor_from_mount,
        })
    }

    /// A camera that sits 3 cm beside is the same as a flange that does.
    fn camera_moved(right: &Evidence, run: std::ops::Range<usize>) -> Evidence {
        with_robot(right, |k, c| match run.contains(&k) {
            true => c.anchor_from_mount * shift(0.03, 0.0, 0.0),
            false => c.anchor_from_mount,
        })
    }

    #[test]
    fn a_target_that_lay_elsewhere_is_left_out_during_that_time() {
        let (is_target, is_now, found) = found(&target_moved(&in_order(14, 1), 4..8)).unwrap();
        assert!(is_target && !is_now);
        assert_eq!((found.captures, found.obsolete), (vec![4, 5, 6, 7], vec![4, 5, 6, 7]));
    }

    #[test]
    fn of_a_bumped_camera_the_captures_before_are_left_out() {
        let right = in_order(14, 1);
        assert_eq!(right.setup, Setup::EyeInHand);
        let (is_target, is_now, found) = found(&camera_moved(&right, 9..14)).unwrap();
        assert!(!is_target && is_now);
        assert_eq!((found.captures.len(), found.obsolete), (5, (0..9).collect()));
    }

    #[test]
    fn one_capture_is_no_run_and_neither_are_two_apart_or_half_of_all() {
        let right = in_order(14, 1);
        assert!(found(&target_moved(&right, 4..5)).is_none());
        let apart = target_moved(&target_moved(&right, 4..5), 8..9);
        assert!(found(&apart).is_none());
        assert!(found(&target_moved(&in_order(6, 1), 3..6)).is_none());
    }

    #[test]
    fn outliers_in_a_run_that_disagree_with_one_another_moved_nowhere() {
        let right = in_order(14, 1);
        let wrong = with_robot(&right, |k, c| match k {
            4..8 => shift(0.03 * k as f64, 0.02 * (k * k) as f64, 0.0) * c.anchor_from_mount,
            _ => c.anchor_from_mount,
        });
        assert!(found(&wrong).is_none());
    }
}
