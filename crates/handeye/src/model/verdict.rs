//! What is said of an answer.

use serde::{Deserialize, Serialize};

/// Whether the answer can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Use it; the uncertainty is stated.
    Accepted,
    /// Do not: the data contradict it or one another, or it is not as exact as was asked for.
    Rejected,
    /// The data do not determine it; the missing directions are named.
    Undetermined,
}
