//! What ends the program without an answer: for people on standard error, for programs, with
//! `--json`, as one document on standard output.

use std::{fmt, io, path::Path};

use handeye_io::Problem;
use serde_json::json;

use crate::output;

/// An end without an answer.
#[derive(Debug)]
pub enum Failure {
    /// The input cannot be read or used: exit code 1.
    Input(Box<Problem>),
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

    /// A file that cannot be used.
    pub fn input(file: impl AsRef<Path>, what: impl fmt::Display) -> Self {
        Self::at(file.as_ref(), "unusable", what)
    }

    /// A file that is there already, and is not written over.
    pub fn in_the_way(file: impl AsRef<Path>, what: impl fmt::Display) -> Self {
        Self::at(file.as_ref(), "in-the-way", what)
    }

    /// A folder that cannot be made.
    pub fn no_folder(folder: impl AsRef<Path>, error: impl fmt::Display) -> Self {
        Self::at(folder.as_ref(), "cannot-write", format_args!("cannot be made: {error}"))
    }

    /// A file that the system does not give.
    pub fn unreadable(file: impl AsRef<Path>, error: &io::Error) -> Self {
        let what = match error.kind() {
            io::ErrorKind::NotFound => "does not exist; check the name".into(),
            _ => format!("cannot be read: {error}"),
        };
        Self::at(file.as_ref(), "cannot-read", what)
    }

    /// JSON that is not what it should be; `named` says what the part is called.
    pub fn in_json(file: impl AsRef<Path>, error: &serde_json::Error, named: &str) -> Self {
        let (file, line) = (file.as_ref(), error.line());
        let what = error.to_string();
        let what = what.split(" at line ").next().unwrap_or(&what);
        let message =
            format!("{}:{line}: {named}{what} (column {})", file.display(), error.column());
        let problem = Problem::new("malformed", message);
        Self::new(Problem { file: Some(file.into()), line: Some(line), ..problem })
    }

    fn at(file: &Path, code: &'static str, what: impl fmt::Display) -> Self {
        let message = format!("{}: {what}", file.display());
        Self::new(Problem { file: Some(file.into()), ..Problem::new(code, message) })
    }

    /// Input that cannot be used.
    pub fn new(problem: Problem) -> Self {
        Failure::Input(Box::new(problem))
    }

    /// The same, in this file.
    pub fn in_file(mut self, file: &Path) -> Self {
        if let Failure::Input(problem) = &mut self {
            problem.message = format!("{}: {}", file.display(), problem.message);
            problem.file = Some(file.into());
        }
        self
    }

    /// For programs: `{"code": ..., "message": ...}` with the place.
    pub fn json(&self) -> serde_json::Value {
        match self {
            Failure::Input(problem) => json!(problem),
            Failure::Usage(message) => json!(Problem::new("wrong-command-line", message.clone())),
        }
    }

    /// Tells a person, and with `--json` a program.
    pub fn tell(&self, json: bool) {
        crate::output::note!("error: {self}");
        if json {
            output::json(&json!({ "error": self.json() }));
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Failure::Input(problem) => f.write_str(&problem.message),
            Failure::Usage(message) => f.write_str(message),
        }
    }
}

impl From<handeye::Error> for Failure {
    fn from(error: handeye::Error) -> Self {
        Failure::new(Problem::from(error))
    }
}

impl From<handeye_io::Error> for Failure {
    fn from(error: handeye_io::Error) -> Self {
        Failure::new(Problem::from(error))
    }
}
