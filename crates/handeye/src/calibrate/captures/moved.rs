//! What a movement that was found does to the answer: what is said of it, and the answer of the captures since then.

use crate::{
    Calibration, Session, Setup, Verdict, Warning,
    calibrate::result::{CaptureResult, TouchResult},
    findings::{
        MovementFinding,
        movement::{Movement, MovementKind},
    },
};

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
