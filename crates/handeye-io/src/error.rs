//! Why a file cannot be used: where, what, and what to do next.

use std::{
    fmt, io,
    path::{Path, PathBuf},
};

/// Where in the input something stands.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Place {
    /// The file.
    pub file: PathBuf,
    /// Its line, counted from 1.
    pub line: Option<usize>,
    /// The key or the path of the value in a structured file.
    pub field: Option<String>,
}

impl Place {
    /// A whole file.
    pub fn file(path: &Path) -> Self {
        Self { file: path.into(), ..Self::default() }
    }
    /// A line of a file, counted from 1.
    pub fn line(path: &Path, line: usize) -> Self {
        Self { line: Some(line), ..Self::file(path) }
    }
    /// A value of a structured file.
    pub fn field(path: &Path, field: impl Into<String>) -> Self {
        Self { field: Some(field.into()), ..Self::file(path) }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        match &self.field {
            Some(field) => write!(f, " [{field}]"),
            None => Ok(()),
        }
    }
}

/// Why a file cannot be used or written. Every message says where, what, and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system does not give the file.
    #[error("{}: {}", path.display(), reading(source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The operating system does not take the file.
    #[error("{}: cannot be written: {source}; check the folder, its permissions and the free space", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The content is not what it should be.
    #[error("{place}: {what}; {advice}")]
    Malformed {
        /// Where.
        place: Place,
        /// What was wrong.
        what: String,
        /// What to do.
        advice: String,
    },
    /// JSON that is not what it should be.
    #[error("{place}: {what}")]
    Json {
        /// The file and line.
        place: Place,
        /// What was wrong, in which part, and what to do.
        what: String,
    },
    /// The content is understood, and of no use.
    #[error("{place}: {what}")]
    Unusable {
        /// Where.
        place: Place,
        /// Why, and what to do.
        what: String,
    },
    /// Something that decides the numbers was not declared and cannot be proven.
    #[error("{place}: {key} is missing; {question}")]
    Undeclared {
        /// Where it belongs.
        place: Place,
        /// The manifest's key.
        key: String,
        /// The question to answer.
        question: String,
    },
    /// A size that is refused before any memory is taken.
    #[error("{place}: {what} is {found}, more than the limit of {limit}; {advice}")]
    TooLarge {
        /// Where.
        place: Place,
        /// Which quantity.
        what: String,
        /// Its value.
        found: u64,
        /// What is accepted.
        limit: u64,
        /// What to do.
        advice: String,
    },
    /// Two lists that belong together differ in length.
    #[error("{place}: {left} {left_name} but {right} {right_name}; {advice}")]
    CountMismatch {
        /// Where they are named.
        place: Place,
        /// Length of the first.
        left: usize,
        /// What the first holds.
        left_name: String,
        /// Length of the second.
        right: usize,
        /// What the second holds.
        right_name: String,
        /// What to do.
        advice: String,
    },
    /// A pattern that names no file.
    #[error("{place}: no file matches \"{pattern}\" below {}; check the name and the folder", root.display())]
    NoFiles {
        /// Where the pattern stands.
        place: Place,
        /// The pattern.
        pattern: String,
        /// The folder it was looked for in.
        root: PathBuf,
    },
    /// Values that the core refuses.
    #[error("{place}: {source}")]
    Values {
        /// Where they come from.
        place: Place,
        /// What the core said.
        source: handeye::Error,
    },
    /// A folder without anything to calibrate from.
    #[error("{}: nothing found here that the camera saw or the robot reported; put the captures' images (or scans, or lists of corners) and the robot's poses into the folder, or name the one that has them", folder.display())]
    NothingFound {
        /// The folder.
        folder: PathBuf,
    },
    /// An error in what belongs to one capture.
    #[error("{source}")]
    Capture {
        /// Its name.
        id: String,
        /// What is wrong.
        source: Box<Error>,
    },
}

impl Error {
    /// The sentence without the file that it is about, for those who know the file.
    pub fn without_place(&self) -> String {
        match self {
            Error::Malformed { what, advice, .. } => format!("{what}; {advice}"),
            Error::Json { what, .. } | Error::Unusable { what, .. } => what.clone(),
            Error::Undeclared { key, question, .. } => format!("{key} is missing; {question}"),
            Error::Values { source, .. } => source.to_string(),
            _ => self.to_string(),
        }
    }

    /// Short fixed name, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Error::Read { .. } => "cannot-read",
            Error::Write { .. } => "cannot-write",
            Error::Malformed { .. } | Error::Json { .. } => "malformed",
            Error::Undeclared { .. } => "undeclared",
            Error::TooLarge { .. } => "too-large",
            Error::CountMismatch { .. } => "count-mismatch",
            Error::NoFiles { .. } => "no-files",
            Error::Values { .. } | Error::Unusable { .. } => "unusable",
            Error::NothingFound { .. } => "nothing-found",
            Error::Capture { source, .. } => source.code(),
        }
    }

    /// Where it is.
    pub fn place(&self) -> Place {
        match self {
            Error::Read { path, .. } | Error::Write { path, .. } => Place::file(path),
            Error::Malformed { place, .. }
            | Error::Json { place, .. }
            | Error::Unusable { place, .. }
            | Error::Undeclared { place, .. }
            | Error::TooLarge { place, .. }
            | Error::CountMismatch { place, .. }
            | Error::NoFiles { place, .. }
            | Error::Values { place, .. } => place.clone(),
            Error::NothingFound { folder } => Place::file(folder),
            Error::Capture { source, .. } => source.place(),
        }
    }

    /// The same, in this capture.
    pub(crate) fn in_capture(self, id: &str) -> Self {
        Error::Capture { id: id.into(), source: Box::new(self) }
    }

    /// The capture it belongs to, where it belongs to one.
    pub fn capture(&self) -> Option<&str> {
        match self {
            Error::Capture { id, .. } => Some(id),
            _ => None,
        }
    }
}

fn reading(source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::NotFound => "does not exist; check the name and the folder".into(),
        io::ErrorKind::PermissionDenied => "may not be read; check its permissions".into(),
        _ => format!("cannot be read: {source}; check the file"),
    }
}

/// Shorthand for [`Error::Malformed`].
pub(crate) fn malformed(place: Place, what: impl Into<String>, advice: impl Into<String>) -> Error {
    Error::Malformed { place, what: what.into(), advice: advice.into() }
}

/// Shorthand for [`Error::Json`]; `named` says what the part is called.
pub(crate) fn in_json(path: &Path, error: &serde_json::Error, named: &str) -> Error {
    let what = error.to_string();
    let what = what.split(" at line ").next().unwrap_or(&what);
    let what = format!("{named}{what} (column {})", error.column());
    Error::Json { place: Place::line(path, error.line()), what }
}

/// Shorthand for [`Error::Unusable`].
pub(crate) fn unusable(path: &Path, what: impl Into<String>) -> Error {
    Error::Unusable { place: Place::file(path), what: what.into() }
}

/// What is said of a format whose reader is not in this program.
#[cfg(not(all(feature = "e57", feature = "netcdf", feature = "sqlite")))]
pub(crate) fn not_built_in(path: &Path, format: &str, feature: &str) -> Error {
    let what = format!(
        "is a file in {format}, which this program was built without; build it with `--features {feature}`"
    );
    unusable(path, what)
}

/// Shorthand for [`Error::Undeclared`] of a file.
pub(crate) fn undeclared(path: &Path, key: &str, question: &str) -> Error {
    Error::Undeclared { place: Place::file(path), key: key.into(), question: question.into() }
}

/// The candidate nearest to a misspelt word, if one is near.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|c| (edit_distance(&word.to_lowercase(), &c.to_lowercase()), c))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, c)| *d <= 1 + c.len().min(word.len()) / 3)
        .map(|(_, c)| c)
}

/// Levenshtein distance of two short words.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().take(64).enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let change = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_reads_like_a_compiler_message() {
        let place = Place { line: Some(3), ..Place::field(Path::new("a.csv"), "x") };
        assert_eq!(place.to_string(), "a.csv:3 [x]");
    }

    #[test]
    fn the_nearest_word_is_offered_only_when_it_is_near() {
        assert_eq!(nearest("lenght_unit", ["length_unit", "angle_unit"]), Some("length_unit"));
        assert_eq!(nearest("colour", ["length_unit", "angle_unit"]), None);
    }
}
