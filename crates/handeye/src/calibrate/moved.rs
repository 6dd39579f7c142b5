//! What a movement that was found does to the answer: what is said of it, and the answer of the captures since then.

use crate::{
    Calibration, Session, Setup, Verdict,
    calibrate::result::{CaptureResult, TouchResult},
    findings::{
        MovementFinding,
        movement::{Movement, MovementKind},
    },
};

/// Says what moved. `explained`: what was measured besides says already why captures disagree.
pub(super) fn tell(explained: bool, result: &mut Calibration) {
    let Some(movement) = &result.movement else { return };
    let of =
        |finding: fn(Movement, Setup) -> MovementFinding| finding(movement.clone(), result.setup);
    let finding = match movement.kind {
        MovementKind::Block if runs_to_the_end(movement) => return,
        MovementKind::Block => of(MovementFinding::Displaced),
        _ if explained => {
            result.movement = None;
            return;
        }
        _ => of(MovementFinding::Covered),
    };
    result.warnings.push(finding.into());
}

/// Whether a block says where the camera is now: `answer_of_the_end` has dealt with it.
fn runs_to_the_end(m: &Movement) -> bool {
    m.kind == MovementKind::Block && m.camera && m.at_end && !m.at_a_place
}

/// The answer for where the camera is now, where the captures of a block that runs to the end say that it moved: that of
/// these captures alone, if they determine one; `run` calibrates a session.
pub(super) fn answer_of_the_end(
    session: &Session,
    all: Calibration,
    run: impl Fn(&Session) -> Calibration,
) -> Calibration {
    let Some(m) = &all.movement else { return all };
    let first = session.observations.iter().position(|o| o.capture == m.first);
    let Some(first) = first.filter(|_| runs_to_the_end(m)) else { return all };
    let mut end = run(&since(session, first));
    if end.verdict != Verdict::Accepted {
        return not_determined(all);
    }
    let mut before: Vec<CaptureResult> = all.captures[..first].to_vec();
    for capture in before.iter_mut().filter(|c| c.used) {
        capture.used = false;
        capture.reason = Some("taken before the camera or the target moved".into());
    }
    let names = before.iter().map(|c| c.id.clone());
    end.rejected = names.chain(end.rejected).collect();
    end.captures = before.into_iter().chain(end.captures).collect();
    end.touches = all.touches.iter().map(|t| TouchResult { used: false, ..t.clone() }).collect();
    let finding = MovementFinding::AnswerOfTheEnd {
        movement: m.clone(),
        setup: session.setup,
        captures: session.observations.len() - first,
        touches: !session.touches.is_empty(),
    };
    end.warnings.insert(0, finding.into());
    end.movement = all.movement;
    end
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
fn not_determined(mut all: Calibration) -> Calibration {
    let Some(m) = &all.movement else { return all };
    let finding = MovementFinding::TooFewSince(m.clone(), all.setup);
    all.reasons = vec![finding.message()];
    all.warnings.insert(0, finding.into());
    all.verdict = Verdict::Rejected;
    all
}
