//! What ends the program without an answer.

use std::fmt;

/// An end without an answer.
#[derive(Debug)]
pub enum Failure {
    /// The input cannot be read or used: exit code 1.
    Input(String),
    /// The command line is wrong: exit code 2.
    Usage(String),
}

impl Failure {
    /// Process exit code.
    pub fn exit_code(&self) -> u8 {
        match self {
            Failure::Input(_) => 1,
            Failure::Usage(_) => 2,
        }
    }

    /// Bad input, said with its place.
    pub fn input(place: impl fmt::Display, what: impl fmt::Display) -> Self {
        Failure::Input(format!("{place}: {what}"))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Failure::Input(message) | Failure::Usage(message) => f.write_str(message),
        }
    }
}

impl From<handeye::Error> for Failure {
    fn from(error: handeye::Error) -> Self {
        Failure::Input(error.to_string())
    }
}

impl From<handeye_io::Error> for Failure {
    fn from(error: handeye_io::Error) -> Self {
        Failure::Input(error.to_string())
    }
}
