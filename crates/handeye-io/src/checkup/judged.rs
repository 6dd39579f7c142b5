//! What the calibration of a dataset finds by itself: whether the touches are of the corners that they name, and all
//! that changes its answer or speaks against it. A check that does not report this would contradict the calibration.

use std::cell::OnceCell;

use handeye::{
    Calibration, Config, Session, Verdict, calibrate,
    calibrate::{findings, result::JudgedFinding},
    findings::severity::{self, Severity},
};

use super::Explanation;
use crate::{Dataset, calibrate::configured};

/// Findings of a calibration that are about its touches, and what to do where no key of the manifest corrects them.
const ABOUT_TOUCHES: [(&str, &str); 4] = [
    (
        "touches-misread",
        "correct the ids, the units or the placements of [touches], and check again",
    ),
    ("tip-off", "calibrate the tool again (`handeye tcp`), or correct the ids of the touches"),
    ("touch-rejected", "correct the id of that touch, touch the corner again, or remove the line"),
    (
        "views-and-touches-disagree",
        "check placements and frame of the touches; touch where the robot works",
    ),
];

/// The code of a reason that has none of its own.
const REJECTED: &str = "rejected";

/// A dataset and its calibration, which runs when it is asked for, once.
pub(super) struct Judged<'a> {
    pub dataset: &'a Dataset,
    pub session: &'a Session,
    calibration: OnceCell<Option<Calibration>>,
}

impl<'a> Judged<'a> {
    pub fn new(dataset: &'a Dataset, session: &'a Session) -> Self {
        Self { dataset, session, calibration: OnceCell::new() }
    }

    fn calibration(&self) -> Option<&Calibration> {
        let run = || {
            let config = configured(self.dataset, &Config::default());
            calibrate(self.session, &config).ok()
        };
        self.calibration.get_or_init(run).as_ref()
    }

    /// What is wrong with the touches, where the captures agree.
    pub fn wrong_touches(&self) -> Vec<Explanation> {
        if self.session.touches.is_empty() {
            return vec![];
        }
        let explained = |warning: &handeye::Warning| {
            let (code, by_hand) = ABOUT_TOUCHES.iter().find(|(code, _)| *code == warning.code)?;
            let by_hand = Some((*by_hand).to_owned());
            Some(Explanation { by_hand, ..Explanation::new(code, warning.message.clone(), vec![]) })
        };
        let warnings = self.calibration().map_or(&[][..], |result| &result.warnings);
        warnings.iter().filter_map(explained).collect()
    }

    /// All that changes the answer or speaks against it. Captures that do not determine an answer are no mistake.
    pub fn findings(&self) -> Vec<Explanation> {
        let Some(result) = self.calibration() else { return vec![] };
        let matters = |f: &JudgedFinding| match f.severity {
            Severity::Info => false,
            Severity::ChangesAnswer => true,
            Severity::Rejects => result.verdict == Verdict::Rejected,
        };
        let explained = |f: JudgedFinding| {
            let code = severity::known(&f.code).unwrap_or(REJECTED);
            Explanation { by_hand: f.advice, ..Explanation::new(code, f.message, vec![]) }
        };
        findings::findings(result).into_iter().filter(matters).map(explained).collect()
    }
}
