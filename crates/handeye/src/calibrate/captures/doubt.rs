//! Whether the captures that agree are the right ones: no clear majority is no answer.

use crate::{
    HandEye,
    calibrate::{
        flow::{
            limits::{FEWEST_CONFIRMED, NEARLY_AS_MANY, SAME_ANSWER},
            notes::Notes,
            views::Captures,
        },
        result::Scale,
    },
    findings::{CaptureFinding, Finding, TargetFinding, target::Size},
    mistakes::{self, Evidence, score::Score},
    model::{residual::Residual, session::Session},
    solve::consensus::{self, Consensus, Readings},
};

/// Rejects an answer that too few captures confirm, or against which nearly as many stand.
pub(crate) fn doubt(captures: &Captures, found: &Consensus, wrong: &[usize]) -> Notes {
    let used = found.agrees.iter().filter(|a| **a).count();
    let (seen, out) = (used + wrong.len(), wrong.len());
    let finding = if out > 0 && (used < FEWEST_CONFIRMED || 2 * used == seen) {
        CaptureFinding::NoMajority { used, of: seen }
    } else if let Some(others) = second_agreement(captures, found, wrong, used) {
        CaptureFinding::TwoAnswers { used, others, rest: out }
    } else {
        return Notes::default();
    };
    Notes::against(finding)
}

/// How many of the captures left out agree on another place of the camera, if nearly as many.
fn second_agreement(
    captures: &Captures,
    found: &Consensus,
    wrong: &[usize],
    used: usize,
) -> Option<usize> {
    let enough = (NEARLY_AS_MANY * used as f64).max(FEWEST_CONFIRMED as f64);
    if (wrong.len() as f64) < enough {
        return None;
    }
    let rest: Vec<Readings> = wrong.iter().map(|&i| captures.readings[i].clone()).collect();
    let second = consensus::consensus(&rest).ok()?;
    let count = second.agrees.iter().filter(|a| **a).count();
    (count as f64 >= enough && !same_answer(&found.hand_eye, &second.hand_eye)).then_some(count)
}

fn same_answer(a: &HandEye, b: &HandEye) -> bool {
    let (a, b) = (&a.mount_from_camera, &b.mount_from_camera);
    Residual::between(a, b).is_within(SAME_ANSWER)
}

/// One order of all robot poses, or one size of the target (and that size), that explains why most captures do not agree
/// as declared.
pub(crate) fn order_or_size(
    readings: &[Readings],
    session: &Session,
    found: Option<&Consensus>,
) -> Option<(Notes, Option<Scale>)> {
    if found.is_some_and(|f| Score::new(readings, f).is_most(readings.len())) {
        return None;
    }
    let evidence = Evidence {
        setup: session.setup,
        target: session.target.clone(),
        names: session.observations.iter().map(|o| o.capture.clone()).collect(),
        declared: readings.to_vec(),
        conventions: vec![],
    };
    let finding = mistakes::rejecting(&evidence)?;
    let size = match finding {
        Finding::Target(TargetFinding::ExplainsAll(Size { value, sigma, .. })) => {
            Some(Scale { value, sigma, used: false })
        }
        _ => None,
    };
    Some((Notes::against(finding), size))
}
