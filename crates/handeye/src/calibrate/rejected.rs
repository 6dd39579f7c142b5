//! Captures that do not agree are rejected, each with the cause that would restore it
//! ([`mistakes::cause`](crate::mistakes::cause)): offered, never done.

use super::doubt;
use crate::{
    calibrate::{result::Calibration, views::Captures},
    estimate::JointFit,
    findings::{CaptureFinding, captures::Cause},
    mistakes::{cause, flipped::Boards, outliers::Outliers},
    solve::consensus::Consensus,
};

/// More captures than this are named in one sentence.
const MOST_WARNINGS: usize = 8;

/// Names every capture that does not agree, with the likeliest cause.
pub(super) fn name(
    captures: &Captures,
    found: &Consensus,
    fit: Option<&JointFit>,
    result: &mut Calibration,
) {
    let causes = causes(captures, found, fit);
    let wrong: Vec<usize> = causes.iter().map(|(i, _)| *i).collect();
    for (i, cause) in causes {
        result.captures[i].used = false;
        result.captures[i].reason = Some(cause.in_words());
        let capture = captures.session.observations[i].capture.clone();
        result.rejected.push(capture.clone());
        if wrong.len() <= MOST_WARNINGS || !matches!(cause, Cause::Disagrees { .. }) {
            result.warnings.push(CaptureFinding::Rejected { capture, cause }.into());
        }
    }
    if wrong.len() > MOST_WARNINGS {
        let rejected = result.rejected.clone();
        let of = captures.readings.len();
        result.warnings.push(CaptureFinding::ManyRejected { captures: rejected, of }.into());
    }
    doubt::doubt(captures, found, &wrong, result);
}

/// The captures that do not agree, and why.
fn causes(captures: &Captures, found: &Consensus, fit: Option<&JointFit>) -> Vec<(usize, Cause)> {
    let session = captures.session;
    let fit = fit.map(|fit| (fit, session.setup));
    let outliers = Outliers::new(captures.readings, captures.candidates(), found, fit);
    let from_elsewhere =
        session.observations.iter().map(|o| o.corners.is_empty() && o.surface.is_empty());
    let boards = Boards {
        target: session.target.as_ref(),
        target_from_corner: captures.target_from_corner,
        from_elsewhere: from_elsewhere.collect(),
    };
    cause::causes(&outliers, &boards, session)
}
