//! A finding in the form in which files and pages have it.

use serde::{Deserialize, Serialize};

use super::Finding;

/// A finding about a result, or about the data that it was made from.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Warning {
    /// Short fixed name, for programs: `tip-off`.
    pub code: String,
    /// What was seen and where, in a sentence for people.
    pub message: String,
    /// What it says, with its numbers; `None` for what was noticed in files, and in a result that was read back.
    #[serde(skip)]
    pub finding: Option<Box<Finding>>,
}

/// Equal for who reads them: a result that was written and read back is the same.
impl PartialEq for Warning {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code && self.message == other.message
    }
}

impl Warning {
    /// Whether a sentence is the one of this finding.
    pub(crate) fn says(&self, sentence: &str) -> bool {
        self.message == sentence
    }

    /// From its two parts.
    pub fn new(code: &str, message: impl Into<String>) -> Self {
        Self { code: code.into(), message: message.into(), finding: None }
    }
}
