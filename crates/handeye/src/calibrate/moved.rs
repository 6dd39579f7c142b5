//! What a movement that was found does to the answer: its words, and the answer of the captures since then.

use crate::{
    Calibration, Session, Setup, Verdict, Warning,
    calibrate::result::{CaptureResult, Movement, MovementKind, TouchResult},
};

/// Says what moved. `explained`: what was measured besides says already why captures disagree.
pub(super) fn tell(explained: bool, result: &mut Calibration) {
    let Some(movement) = &result.movement else { return };
    let code = match movement.kind {
        MovementKind::Block if runs_to_the_end(movement) => return,
        MovementKind::Block => "captures-displaced",
        _ if explained => {
            result.movement = None;
            return;
        }
        _ => "moved-during-session",
    };
    let message = in_words(movement, result.setup);
    result.warnings.push(Warning::new(code, message));
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
    let touches = if session.touches.is_empty() {
        ""
    } else {
        "; the touches may be older, and are not used"
    };
    let message = format!(
        "{}. The answer is where the camera is since capture {}, from the {} captures since then alone{touches}",
        in_words(&Movement { widened_mm: 0.0, ..m.clone() }, session.setup),
        m.first,
        session.observations.len() - first,
    );
    end.warnings.insert(0, Warning::new("camera-moved", message));
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
    let message = format!(
        "{}, and these do not determine an answer alone: take more captures as the camera sits now",
        in_words(&Movement { widened_mm: 0.0, ..m.clone() }, all.setup)
    );
    all.warnings.insert(0, Warning::new("camera-moved", message.clone()));
    all.reasons = vec![message];
    all.verdict = Verdict::Rejected;
    all
}

fn in_words(m: &Movement, setup: Setup) -> String {
    let how_far = format!("{:.2} mm and {:.3} degrees", m.displacement_mm, m.rotation_deg);
    let camera = format!("the camera moved on the {}", setup.mount());
    let target = match setup {
        Setup::EyeInHand => "the target moved",
        Setup::EyeToHand => "the target moved on the flange",
    };
    let mut causes: Vec<&str> = vec![];
    if m.camera {
        causes.push(&camera);
    }
    if m.target {
        causes.push(target);
    }
    if m.at_a_place {
        causes.push(match m.kind {
            MovementKind::Block => "the robot errs where these were taken",
            _ => "the robot errs by place, as it went from place to place",
        });
    }
    let causes = causes.join(", or ");
    let covers = if m.widened_mm > 0.0 { "; the stated error covers it" } else { "" };
    match m.kind {
        MovementKind::Block => format!(
            "captures {} to {} agree with one another, {how_far} away from the others: {causes}{covers}",
            m.first, m.last
        ),
        MovementKind::Step => format!(
            "the captures from {} on differ from those before by {how_far}: {causes}{covers}. Tighten what gives way, \
             and take the captures again",
            m.first
        ),
        MovementKind::Slip => format!(
            "errors grow evenly by {how_far} from capture {} to {}: {causes}{covers}. Warm up, tighten what \
             gives way, and take the captures again",
            m.first, m.last
        ),
    }
}
