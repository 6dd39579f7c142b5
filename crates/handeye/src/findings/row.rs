//! What a code does to the answer, and what is said of it.
//!
//! A code decides what its finding does to the answer: nothing (`info`), the answer is another one because of it
//! (`changes-answer`), or there is no answer to use (`rejects`). An answer that is accepted with a finding that changes
//! it is neither green nor red: page and terminal say first what changed.

use serde::{Deserialize, Serialize};

/// What a finding does to the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// Worth knowing; the answer is as it would be without.
    Info,
    /// The answer is another one because of it: what was declared or measured was corrected or rejected.
    ChangesAnswer,
    /// There is no answer to use because of it.
    Rejects,
}

/// What is known of a code. It does not decide the verdict: a finding rejects the result where its stage adds it with
/// `Notes::against`. The severity says what page and `check` show.
pub(crate) struct Row {
    pub code: &'static str,
    pub severity: Severity,
    /// What it did to the answer, in a sentence for the top of a page; empty where the message is that short.
    pub headline: &'static str,
    /// Empty where the message says what to do.
    pub advice: &'static str,
}

impl Row {
    pub(super) const fn info(code: &'static str) -> Self {
        Self { code, severity: Severity::Info, headline: "", advice: "" }
    }

    pub(super) const fn changes(
        code: &'static str,
        headline: &'static str,
        advice: &'static str,
    ) -> Self {
        Self { code, severity: Severity::ChangesAnswer, headline, advice }
    }

    pub(super) const fn rejects(code: &'static str, advice: &'static str) -> Self {
        Self { code, severity: Severity::Rejects, headline: "", advice }
    }
}
