//! What was found beside the answer, by how much it matters to an answer of this verdict.

use std::collections::BTreeMap;

use super::{Calibration, JudgedFinding};
use crate::{
    Warning,
    findings::{
        frames::{PARTS_OF_DISAGREE, PICTURE_AND_SCAN_DISAGREE},
        severity::{Severity, row},
    },
    model::verdict::Verdict,
};

/// How a reason begins that speaks of nothing but the precision.
pub(crate) const TOO_IMPRECISE: &str = "the predicted error (95 %)";

/// What a code does to an answer of this verdict: in one that is accepted, nothing rejects; in one that is not,
/// nothing changes it.
fn severity(code: &str, verdict: Verdict) -> Severity {
    let of_code = row(code).map_or(Severity::Info, |row| row.severity);
    match (verdict, of_code) {
        (Verdict::Accepted, Severity::Rejects) => Severity::ChangesAnswer,
        (_, severity) => severity,
    }
}

/// All findings of a result: the reasons against it first, then its warnings in their order.
pub fn findings(result: &Calibration) -> Vec<JudgedFinding> {
    let accepted = result.verdict == Verdict::Accepted;
    let is_own = |reason: &&String| !accepted && !result.warnings.iter().any(|w| w.says(reason));
    let code = if result.verdict == Verdict::Undetermined { "undetermined" } else { "rejected" };
    let reasons = result.reasons.iter().filter(is_own);
    let of_reason = |reason: &String| judged(code, Severity::Rejects, reason.clone());
    let of_warning = |w: &Warning| {
        let is_reason = !accepted && result.is_reason(w);
        let severity =
            if is_reason { Severity::Rejects } else { severity(&w.code, result.verdict) };
        let headline = w.finding.as_ref().and_then(|f| f.headline());
        let data = w.finding.as_ref().map(|f| f.data()).unwrap_or_default();
        JudgedFinding { headline, data, ..judged(&w.code, severity, w.message.clone()) }
    };
    reasons.map(of_reason).chain(result.warnings.iter().map(of_warning)).collect()
}

fn judged(code: &str, severity: Severity, message: String) -> JudgedFinding {
    let advice = row(code).map(|row| row.advice.to_owned()).filter(|words| !words.is_empty());
    let code = code.to_owned();
    JudgedFinding { code, severity, message, headline: None, advice, data: BTreeMap::new() }
}

/// Where a result is accepted with findings that change it: the sentence that says so first.
pub fn reservation(result: &Calibration) -> Option<String> {
    if result.verdict != Verdict::Accepted {
        return None;
    }
    let all = if result.findings.is_empty() { findings(result) } else { result.findings.clone() };
    let is_told = all.iter().any(|f| f.code == PICTURE_AND_SCAN_DISAGREE.code);
    let is_part = |code: &str| is_told && PARTS_OF_DISAGREE.iter().any(|row| row.code == code);
    let mut codes: Vec<String> = vec![];
    let mut headlines: Vec<String> = vec![];
    for f in all {
        let changes = f.severity == Severity::ChangesAnswer && !is_part(&f.code);
        if changes && !codes.contains(&f.code) {
            let of_code = row(&f.code).map(|row| row.headline).filter(|words| !words.is_empty());
            let of_code = of_code.map(str::to_owned);
            headlines.push(f.headline.or(of_code).unwrap_or(f.message));
            codes.push(f.code);
        }
    }
    (!headlines.is_empty()).then(|| format!("Accepted, but: {}", headlines.join("; ")))
}

impl Calibration {
    /// Whether a finding is among the reasons of the verdict: a reason that is a finding has its sentence.
    pub fn is_reason(&self, warning: &Warning) -> bool {
        self.reasons.iter().any(|reason| warning.says(reason))
    }

    /// Whether nothing speaks against the answer but that it may be wrong by more than is allowed: more captures can
    /// put that right.
    pub fn is_only_imprecise(&self) -> bool {
        matches!(&self.reasons[..], [only] if only.starts_with(TOO_IMPRECISE))
            && self.verdict == Verdict::Rejected
    }

    /// With what was noticed beside it, after what is said already.
    pub(crate) fn noting<F: Into<Warning>>(self, later: impl IntoIterator<Item = F>) -> Self {
        let later = later.into_iter().map(Into::into);
        let warnings = self.warnings.iter().cloned().chain(later).collect();
        Self { warnings, ..self }.recorded()
    }

    /// The same, to be said first.
    pub(crate) fn noting_first<F: Into<Warning>>(self, first: impl IntoIterator<Item = F>) -> Self {
        let first = first.into_iter().map(Into::into);
        let warnings = first.chain(self.warnings.iter().cloned()).collect();
        Self { warnings, ..self }.recorded()
    }

    /// Rejected, with these reasons alone.
    pub(crate) fn rejected_for(self, reasons: Vec<String>) -> Self {
        Self { verdict: Verdict::Rejected, reasons, ..self }.recorded()
    }

    /// With the findings of what it is now.
    pub(crate) fn recorded(self) -> Self {
        Self { findings: findings(&self), ..self }
    }
}
