//! What a stage notices beside the value that it returns.
//!
//! * [`Notes::note`], [`Notes::of`]: to know; the verdict does not depend on it.
//! * [`Notes::against`]: the result is rejected, and the finding is its first reason.
//! * [`Notes::undetermined`]: the data do not determine something; the verdict is that it is undetermined.
//!
//! What is noticed after the verdict is added by `Calibration::noting`.

use crate::Warning;

/// Findings in the order in which they are reported, and what follows from them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Notes {
    /// What to know.
    pub warnings: Vec<Warning>,
    /// What speaks against an answer, most important first.
    pub reasons: Vec<String>,
    /// What the data do not constrain, in words.
    pub undetermined: Vec<String>,
    /// No answer may be used, whatever else is found.
    pub rejects: bool,
}

impl Notes {
    /// Findings that do not speak against the answer.
    pub fn of<F: Into<Warning>>(findings: impl IntoIterator<Item = F>) -> Self {
        let warnings = findings.into_iter().map(Into::into).collect();
        Self { warnings, ..Self::default() }
    }

    /// A finding for which the answer is rejected.
    pub fn against(finding: impl Into<Warning>) -> Self {
        let finding = finding.into();
        let reasons = vec![finding.message.clone()];
        Self { warnings: vec![finding], reasons, rejects: true, ..Self::default() }
    }

    /// Nothing is determined of `what`, for this reason.
    pub fn undetermined(reason: impl ToString, what: String) -> Self {
        Self { reasons: vec![reason.to_string()], undetermined: vec![what], ..Self::default() }
    }

    /// Adds a finding that does not speak against the answer.
    pub fn note(&mut self, finding: impl Into<Warning>) {
        self.warnings.push(finding.into());
    }

    /// Adds what was noticed later.
    pub fn add(&mut self, later: Self) {
        self.warnings.extend(later.warnings);
        self.reasons.extend(later.reasons);
        self.undetermined.extend(later.undetermined);
        self.rejects |= later.rejects;
    }

    /// Both, one after the other.
    pub fn then(mut self, later: Self) -> Self {
        self.add(later);
        self
    }
}
