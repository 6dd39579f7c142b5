//! What the calibration of the dataset finds by itself: a check that says nothing of it would contradict it.

use handeye::{
    Config, Session, Verdict, calibrate,
    calibrate::{
        findings,
        result::{Finding, Severity},
    },
};

use super::Explanation;
use crate::{Dataset, calibrate::configured};

/// The code of a reason that has none of its own.
const REJECTED: &str = "rejected";

/// Findings of a calibration that change its answer or speak against it. Captures that do not determine an answer are
/// no mistake.
pub(super) fn found_by_calibration(dataset: &Dataset, session: &Session) -> Vec<Explanation> {
    let config = configured(dataset, &Config::default());
    let Ok(result) = calibrate(session, &config) else { return vec![] };
    let matters = |f: &Finding| match f.severity {
        Severity::Info => false,
        Severity::ChangesAnswer => true,
        Severity::Rejects => result.verdict == Verdict::Rejected,
    };
    let explained = |f: Finding| Explanation {
        code: findings::known(&f.code).unwrap_or(REJECTED),
        message: f.message,
        after: None,
        p_value: None,
        captures: vec![],
        changes: vec![],
        by_hand: f.advice,
    };
    findings::findings(&result).into_iter().filter(matters).map(explained).collect()
}
