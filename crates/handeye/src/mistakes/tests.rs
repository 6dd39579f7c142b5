//! Simulated sets with known truth, for the tests of every hypothesis; and the order in which they are asked.

use super::*;
use crate::{
    Pose, Session, Setup, Target,
    simulate::Cell,
    solve::consensus::{self, Readings},
};
use nalgebra::Vector3;

/// A simulated session of an eye-in-hand cell in order.
pub(super) fn session(captures: usize, seed: u64) -> Session {
    let cell = Cell { captures, touches: 0, ..Cell::new(Setup::EyeInHand, seed) };
    cell.session(seed).unwrap().0
}

/// The captures of a simulated set in order.
pub(super) fn in_order(captures: usize, seed: u64) -> Evidence {
    let session = session(captures, seed);
    let of = |o: &crate::Observation| Readings {
        anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
        camera_from_target: o.candidates.iter().map(|c| c.camera_from_target).collect(),
    };
    Evidence {
        setup: session.setup,
        target: session.target.clone(),
        names: (0..captures).map(|k| format!("{k:03}")).collect(),
        declared: session.observations.iter().map(of).collect(),
        conventions: vec![],
    }
}

/// Robot poses replaced by a function of capture and pose.
pub(super) fn with_robot(
    evidence: &Evidence,
    pose: impl Fn(usize, &Readings) -> Pose<crate::Anchor, crate::Mount>,
) -> Evidence {
    let mut wrong = evidence.clone();
    for (k, c) in wrong.declared.iter_mut().enumerate() {
        c.anchor_from_mount = pose(k, &evidence.declared[k]);
    }
    wrong
}

/// Target poses of some captures moved in the target's frame.
pub(super) fn with_target_moved(
    evidence: &Evidence,
    which: &[usize],
    by: Pose<Target, Target>,
) -> Evidence {
    let mut wrong = evidence.clone();
    for &k in which {
        wrong.declared[k].camera_from_target.iter_mut().for_each(|p| *p = *p * by);
    }
    wrong
}

/// A shift, m.
pub(super) fn shift<A, B>(x: f64, y: f64, z: f64) -> Pose<A, B> {
    Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::new(x, y, z))
}

/// What the captures agree on.
pub(super) fn agreed(evidence: &Evidence) -> consensus::Consensus {
    consensus::consensus(&evidence.declared).unwrap()
}

/// The codes of what is found, in order.
fn codes(evidence: &Evidence) -> Vec<&'static str> {
    diagnose(evidence).explanations.iter().map(|e| e.finding.code()).collect()
}

#[test]
fn of_captures_in_order_nothing_is_said() {
    for seed in 0..8 {
        let found = diagnose(&in_order(12, seed));
        assert_eq!(found.explanations, [], "seed {seed}");
        assert!(found.declared.is_some_and(|score| score.is_most(12)), "seed {seed}");
    }
}

/// An explanation of a score.
fn scoring(score: f64) -> Explanation {
    let score = Score { score, rotation_deg: 0.0, translation_mm: 0.0, agree: 12 };
    Explanation::new(
        crate::findings::RobotFinding::OtherConvention { words: String::new() },
        Some(score),
    )
}

#[test]
fn what_explains_lowers_the_score_to_a_third_and_what_is_alike_is_within_a_half_of_the_best() {
    let of = |scores: &[f64]| {
        let (alike, others) = explaining_alike(scores.iter().map(|s| scoring(*s)).collect(), 30.0);
        (alike.len(), others.len())
    };
    assert_eq!(of(&[9.9, 20.0]), (1, 1));
    assert_eq!(of(&[10.1, 20.0]), (0, 2));
    assert_eq!(of(&[2.9, 2.0, 3.1]), (2, 1));
    assert_eq!(of(&[9.0, 9.9, 10.1]), (2, 1), "alike, but it does not explain");
}

#[test]
fn a_mistake_about_all_captures_is_said_before_one_about_some() {
    let right = in_order(12, 3);
    let n = right.declared.len();
    let shifted = with_robot(&right, |k, _| right.declared[(k + n - 1) % n].anchor_from_mount);
    assert_eq!(codes(&shifted), ["order-shifted"]);
    let twice = with_robot(&shifted, |k, c| match k {
        5 => shifted.declared[4].anchor_from_mount,
        _ => c.anchor_from_mount,
    });
    assert_eq!(codes(&twice), ["order-shifted", "robot-pose-frozen"]);
}

#[test]
fn captures_that_stood_still_are_no_outliers_besides() {
    let right = in_order(12, 5);
    let frozen =
        with_robot(&right, |k, _| right.declared[if k == 7 { 6 } else { k }].anchor_from_mount);
    assert_eq!(codes(&frozen), ["robot-pose-frozen"]);
}

#[test]
fn a_calibration_is_rejected_for_a_size_rather_than_for_an_order() {
    let right = in_order(12, 6);
    assert_eq!(rejecting(&right), None);
    let n = right.declared.len();
    let reversed = with_robot(&right, |k, _| right.declared[n - 1 - k].anchor_from_mount);
    assert_eq!(rejecting(&reversed).map(|f| f.code()), Some("order-shifted"));
    let large = Evidence { declared: size::rescaled(&right.declared, 0.5), ..right };
    assert_eq!(rejecting(&large).map(|f| f.code()), Some("target-scale"));
}
