//! What a movement that was found does to the answer: what is said of it, and the answer of the captures since then; and
//! an end of the session that leaves open whether anything moved.

use nalgebra::Vector6;

use super::{
    movement::{NAMED, PRIOR, WIDE, displaced},
    residuals::readings,
};
use crate::{
    Calibration, Config, Session, Setup, Verdict, Warning,
    calibrate::{
        flow::verdict,
        result::{CaptureResult, TouchResult, matrix, rows},
    },
    findings::{
        CaptureFinding, Finding, MovementFinding,
        captures::Cause,
        movement::{Movement, MovementKind},
    },
    math::{lie, linalg::root_mean},
    model::residual::Residual,
};

/// A knock that nobody sees moves a camera by less.
const KNOCK: Residual = Residual { angle: 0.05, distance: 0.03 };

/// With what is said of a movement. `explained`: what was measured besides says already why captures disagree.
pub(crate) fn reported(result: Calibration, explained: bool) -> Calibration {
    let Some(movement) = result.movement.clone() else { return result };
    let of: fn(Movement, Setup) -> MovementFinding = match movement.kind {
        MovementKind::Block if runs_to_the_end(&movement) => return result,
        MovementKind::Block => MovementFinding::Displaced,
        _ if explained => return Calibration { movement: None, ..result },
        _ => MovementFinding::Covered,
    };
    let finding = of(movement, result.setup);
    result.noting([finding])
}

/// Whether a block says where the camera is now: `answer_of_the_end` has dealt with it.
fn runs_to_the_end(m: &Movement) -> bool {
    m.kind == MovementKind::Block && m.camera && m.at_end && !m.at_a_place
}

/// The answer for where the camera is now, where the captures of a block that runs to the end say that it moved: that of
/// these captures alone, if they determine one; `run` calibrates a session.
pub(crate) fn answer_of_the_end(
    session: &Session,
    all: Calibration,
    run: impl Fn(&Session) -> Calibration,
) -> Calibration {
    let Some(m) = &all.movement else { return all };
    let first = session.observations.iter().position(|o| o.capture == m.first);
    let Some(first) = first.filter(|_| runs_to_the_end(m)) else { return all };
    let end = run(&since(session, first));
    if end.verdict != Verdict::Accepted {
        return not_determined(all);
    }
    let mut before: Vec<CaptureResult> = all.captures[..first].to_vec();
    for capture in before.iter_mut().filter(|c| c.used) {
        capture.used = false;
        capture.reason = Some("taken before the camera or the target moved".into());
    }
    let names = before.iter().map(|c| c.id.clone());
    let finding = MovementFinding::AnswerOfTheEnd {
        movement: m.clone(),
        setup: session.setup,
        captures: session.observations.len() - first,
        touches: !session.touches.is_empty(),
    };
    let unused = |t: &TouchResult| TouchResult { used: false, ..t.clone() };
    Calibration {
        rejected: names.chain(end.rejected.iter().cloned()).collect(),
        captures: before.into_iter().chain(end.captures.iter().cloned()).collect(),
        touches: all.touches.iter().map(unused).collect(),
        movement: all.movement,
        ..end.noting_first([finding])
    }
}

/// What was measured from a capture on. Of touches, and of the images of the boards that were touched, nobody knows
/// when they were taken.
fn since(session: &Session, first: usize) -> Session {
    let mut after = session.clone();
    after.observations.drain(..first);
    after.placements.clear();
    after.touches.clear();
    after
}

/// Where too few captures were taken since the camera moved, nobody knows where it is.
fn not_determined(all: Calibration) -> Calibration {
    let Some(m) = &all.movement else { return all };
    let finding = Warning::from(MovementFinding::TooFewSince(m.clone(), all.setup));
    let reasons = vec![finding.message.clone()];
    all.rejected_for(reasons).noting_first([finding])
}

/// Where the last capture does not agree with those before it, and is off by no more than a knock may do, the camera may
/// have been moved just before it: nothing after it says that it was not. The stated error then reaches as far.
pub(crate) fn unconfirmed_at_end(
    session: &Session,
    result: Calibration,
    config: &Config,
) -> Calibration {
    if result.verdict != Verdict::Accepted || ended_in_block(&result) {
        return result;
    }
    let Some((id, delta)) = last_displaced(session, &result) else { return result };
    let squares = result
        .captures
        .iter()
        .filter(|c| c.used)
        .filter_map(|c| Some(displaced(&delta, &c.camera_from_target?.translation()).powi(2)));
    let off_mm = root_mean(squares).unwrap_or(0.0) * 1e3;
    let limit = verdict::limit(config);
    let mut wide = result;
    let stated = &mut wide.hand_eye.covariance.mount_from_camera;
    *stated = stated.as_ref().map(|own| rows(&(matrix(own) + delta * delta.transpose())));
    wide.predicted_tre_mm = wide.predicted_tre_mm.map(|tre| tre.widened(off_mm, WIDE));
    let p95_mm = wide.predicted_tre_mm.as_ref().map_or(f64::INFINITY, |tre| tre.p95);
    let finding = MovementFinding::UnconfirmedEnd {
        capture: id,
        displacement_mm: off_mm,
        rotation_deg: lie::omega(&delta).norm().to_degrees(),
    };
    if p95_mm > limit {
        let reasons = vec![finding.message()];
        return wide.rejected_for(reasons).noting_first([finding]);
    }
    wide.reasons = wide.predicted_tre_mm.iter().map(|tre| tre.in_words()).collect();
    wide.noting_first([finding])
}

/// Whether something else is known to be wrong with a capture: its board is turned, it is exchanged with another one.
fn is_explained(result: &Calibration, id: &str) -> bool {
    result.warnings.iter().any(|warning| match warning.finding.as_deref() {
        Some(Finding::Captures(CaptureFinding::Rejected { capture, cause })) => {
            capture == id && !matches!(cause, Cause::Disagrees { .. })
        }
        _ => false,
    })
}

/// Whether what moved at the end is known already.
fn ended_in_block(result: &Calibration) -> bool {
    result.movement.as_ref().is_some_and(|m| m.kind == MovementKind::Block && m.at_end)
}

/// The last capture that saw the target, where it was rejected, and what it says the camera is displaced by, in the reading
/// that says the least.
fn last_displaced(session: &Session, result: &Calibration) -> Option<(String, Vector6<f64>)> {
    let found = result.hand_eye.hand_eye()?;
    let last = session.observations.iter().rfind(|o| !o.candidates.is_empty())?;
    if !result.rejected.contains(&last.capture) {
        return None;
    }
    let anchor_from_mount = result.setup.anchor_from_mount(last.base_from_flange);
    let mount_from_target = anchor_from_mount.inverse() * found.anchor_from_target;
    let displaced = readings(result, session, last).into_iter().map(|camera_from_target| {
        let now = mount_from_target * camera_from_target.inverse();
        found.mount_from_camera.local(&now)
    });
    let delta = displaced.min_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    // where many captures are outliers, the last one is probably another one, and no knock
    let others = (result.rejected.len() - 1) as f64;
    if PRIOR / (PRIOR + others) < 1.0 - NAMED {
        return None;
    }
    let by = Residual { angle: lie::omega(&delta).norm(), distance: lie::nu(&delta).norm() };
    let is_knock = by.is_within(KNOCK) && !is_explained(result, &last.capture);
    is_knock.then(|| (last.capture.clone(), delta))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use crate::{Base, Flange, Pose, calibrate, simulate::Cell};
    use nalgebra::{Isometry3, Vector3};

    /// A cell in which the captures that `is_moved` names (by their number from the end) are displaced.
    fn cell(
        setup: Setup,
        seed: u64,
        by: Isometry3<f64>,
        is_moved: fn(usize) -> bool,
    ) -> Calibration {
        let cell = Cell { touches: 0, ..Cell::new(setup, seed) };
        let (mut session, _) = cell.session(seed).unwrap();
        let n = session.observations.len();
        for o in session
            .observations
            .iter_mut()
            .enumerate()
            .filter(|(k, _)| is_moved(n - k))
            .map(|o| o.1)
        {
            o.base_from_flange = match setup {
                Setup::EyeToHand => Pose::<Base, Flange>::claim(by * o.base_from_flange.iso()),
                Setup::EyeInHand => Pose::<Base, Flange>::claim(o.base_from_flange.iso() * by),
            };
        }
        calibrate(&session, &Config::default()).unwrap()
    }

    fn knock(mm: f64) -> Isometry3<f64> {
        Isometry3::new(
            Vector3::new(0.6, -0.64, 0.48) * mm * 1e-3,
            Vector3::new(2e-4 * mm, 0.0, 0.0),
        )
    }

    fn p95(found: &Calibration) -> f64 {
        found.predicted_tre_mm.as_ref().unwrap().p95
    }

    #[test]
    fn a_knock_before_the_last_capture_is_covered_or_the_result_is_rejected() {
        for (setup, seed) in [(Setup::EyeToHand, 1), (Setup::EyeInHand, 2), (Setup::EyeToHand, 3)] {
            let found = cell(setup, seed, knock(4.0), |from_end| from_end == 1);
            let first = &found.findings[0];
            assert_eq!(first.code, "last-capture-displaced", "{:?}", found.warnings);
            assert!(found.verdict == Verdict::Accepted && p95(&found) > 4.0, "{}", p95(&found));
            assert!(
                first.message.contains(&found.captures.last().unwrap().id),
                "{}",
                first.message
            );
            let far = cell(setup, seed, knock(20.0), |from_end| from_end == 1);
            assert_eq!(far.verdict, Verdict::Rejected);
            assert!(far.reasons[0].contains("take another capture"), "{}", far.reasons[0]);
        }
    }

    #[test]
    fn a_wrong_capture_that_others_follow_or_that_no_knock_explains_widens_nothing() {
        for (by, is_moved) in [
            (knock(5.0), (|from_end| from_end == 2) as fn(usize) -> bool),
            (knock(300.0), |from_end| from_end == 1),
        ] {
            let found = cell(Setup::EyeToHand, 4, by, is_moved);
            assert!(found.captures.iter().any(|c| !c.used));
            assert!(found.warnings.iter().all(|w| w.code != "last-capture-displaced"));
            assert!(found.verdict == Verdict::Accepted && p95(&found) < 2.0, "{}", p95(&found));
        }
    }
}
