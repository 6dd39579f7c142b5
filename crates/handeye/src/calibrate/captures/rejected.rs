//! Captures that do not agree are rejected, each with the cause that would restore it
//! ([`mistakes::cause`](crate::mistakes::cause)): offered, never done.

use super::doubt;
use crate::{
    calibrate::{
        flow::{notes::Notes, views::Captures},
        result::CaptureResult,
    },
    estimate::JointFit,
    findings::{CaptureFinding, captures::Cause},
    mistakes::{cause, flipped::Boards, outliers::Outliers},
    solve::consensus::Consensus,
};

/// More captures than this are named in one sentence.
const MOST_WARNINGS: usize = 8;

/// Captures that do not agree.
pub(crate) struct Rejected {
    /// All captures of the session, those that do not agree with the reason.
    pub captures: Vec<CaptureResult>,
    /// Names of those that do not.
    pub names: Vec<String>,
    pub notes: Notes,
}

/// Names every capture that does not agree, with the likeliest cause.
pub(crate) fn name(
    captures: &Captures,
    found: &Consensus,
    fit: Option<&JointFit>,
    mut reported: Vec<CaptureResult>,
) -> Rejected {
    let (mut names, mut notes) = (vec![], Notes::default());
    let causes = causes(captures, found, fit);
    let wrong: Vec<usize> = causes.iter().map(|(i, _)| *i).collect();
    for (i, cause) in causes {
        reported[i].used = false;
        reported[i].reason = Some(cause.in_words());
        let capture = captures.session.observations[i].capture.clone();
        names.push(capture.clone());
        if wrong.len() <= MOST_WARNINGS || !matches!(cause, Cause::Disagrees { .. }) {
            notes.note(CaptureFinding::Rejected { capture, cause });
        }
    }
    if wrong.len() > MOST_WARNINGS {
        let of = captures.readings.len();
        notes.note(CaptureFinding::ManyRejected { captures: names.clone(), of });
    }
    notes.add(doubt::doubt(captures, found, &wrong));
    Rejected { captures: reported, names, notes }
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
