//! An end without an answer, for programs.

use std::path::PathBuf;

use serde::Serialize;

use crate::Error;

/// What is wrong with the input, and where, as far as that is known.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Problem {
    /// Short fixed name.
    pub code: &'static str,
    /// What, where, and what to do.
    pub message: String,
    /// The file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Its line, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// The capture it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capture: Option<String>,
}

impl Problem {
    /// A problem of no known place.
    pub fn new(code: &'static str, message: String) -> Self {
        Self { code, message, file: None, line: None, capture: None }
    }
}

impl From<handeye::Error> for Problem {
    fn from(error: handeye::Error) -> Self {
        use handeye::Error as E;
        let code = match error {
            E::TooFewPoses { .. }
            | E::TooFewSamples { .. }
            | E::TooFewPoints { .. }
            | E::NoView(_) => "too-few-data",
            E::Collinear { .. } | E::NotDetermined { .. } => "not-determined",
            _ => "unusable",
        };
        Self::new(code, error.to_string())
    }
}

impl From<Error> for Problem {
    fn from(error: Error) -> Self {
        let place = error.place();
        Self {
            file: Some(place.file),
            line: place.line,
            capture: error.capture().map(String::from),
            ..Self::new(error.code(), error.to_string())
        }
    }
}
