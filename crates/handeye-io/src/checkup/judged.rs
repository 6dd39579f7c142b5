//! What the calibration of a dataset finds by itself: whether the touches are of the corners that they name, and all
//! that changes its answer or speaks against it. A check that does not report this would contradict the calibration.

use std::cell::OnceCell;

use handeye::{
    Calibration, Config, Session, Verdict, calibrate,
    calibrate::{findings, result::JudgedFinding},
    findings::{
        Finding, TouchFinding,
        severity::{self, Severity},
    },
};

use super::Explanation;
use crate::{Dataset, calibrate::configured};

/// What to do about a finding that is about the touches; no key of the manifest corrects it.
fn by_hand(finding: &Finding) -> Option<&'static str> {
    let Finding::Touches(finding) = finding else { return None };
    match finding {
        TouchFinding::Misread { .. } => {
            Some("correct the ids, the units or the placements of [touches], and check again")
        }
        TouchFinding::TipOff { .. } => {
            Some("calibrate the tool again (`handeye tcp`), or correct the ids of the touches")
        }
        TouchFinding::Outlier { .. } | TouchFinding::Misplaced { .. } => {
            Some("correct the id of that touch, touch the corner again, or remove the line")
        }
        TouchFinding::ViewsDisagree { .. } => {
            Some("check placements and frame of the touches; touch where the robot works")
        }
        _ => None,
    }
}

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
            let finding = warning.finding.as_deref()?;
            let by_hand = Some(by_hand(finding)?.to_owned());
            let own = Explanation::new(finding.code(), warning.message.clone(), vec![]);
            Some(Explanation { by_hand, ..own })
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
