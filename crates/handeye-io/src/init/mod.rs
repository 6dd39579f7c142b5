//! A first manifest for a folder: what its files prove is filled in, the rest is asked.

mod fields;
mod groups;
mod kind;
mod sections;

use std::path::Path;

use crate::{
    bag,
    error::{Error, unusable},
};
use groups::Group;
use kind::Kind;

/// A manifest that waits for answers.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstManifest {
    /// Its text; the lines below a question are commented out.
    pub text: String,
    /// What the files do not prove.
    pub questions: Vec<Question>,
}

/// What somebody must say.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// Line of the manifest, counted from 1.
    pub line: usize,
    /// The question, whole.
    pub text: String,
}

/// A first manifest for the files of a folder.
///
/// # Errors
/// [`Error::Read`] if the folder cannot be listed, [`Error::NothingFound`] if it holds no pictures,
/// scans, corners or poses.
pub fn first_manifest(folder: &Path) -> Result<FirstManifest, Error> {
    let groups = groups::groups(folder)?;
    let kinds: Vec<(Group, Kind)> = groups
        .into_iter()
        .map(|group| {
            let kind = kind::kind(&group, folder);
            (group, kind)
        })
        .collect();
    let useful = |kind: &Kind| !matches!(kind, Kind::Nothing | Kind::Camera | Kind::Target(_));
    if !kinds.iter().any(|(_, kind)| useful(kind)) {
        if bag::is_bag(folder) {
            return Err(unusable(folder, bag::ADVICE));
        }
        return Err(Error::NothingFound { folder: folder.into() });
    }
    let mut page = Page::default();
    sections::write(&kinds, folder, &mut page);
    Ok(FirstManifest { text: page.text, questions: page.questions })
}

/// How a question of a manifest begins.
pub(crate) const QUESTION: &str = "# QUESTION: ";

/// Columns of a manifest.
const WIDTH: usize = 80;

/// The manifest while it is written.
#[derive(Default)]
struct Page {
    text: String,
    questions: Vec<Question>,
}

impl Page {
    fn line(&mut self, line: &str) {
        self.text += line;
        self.text += "\n";
    }

    /// A table's heading, with a blank line above.
    fn table(&mut self, heading: &str) {
        self.line("");
        self.line(heading);
    }

    fn note(&mut self, text: &str) {
        self.wrapped("# ", "#   ", text);
    }

    /// A question, and below it the lines that wait for the answer.
    fn ask(&mut self, question: &str, answers: &[&str]) {
        let line = self.text.lines().count() + 1;
        self.questions.push(Question { line, text: question.into() });
        self.wrapped(QUESTION, "#   ", question);
        answers.iter().for_each(|answer| self.line(&format!("# {answer}")));
    }

    fn wrapped(&mut self, first: &str, next: &str, text: &str) {
        let mut line = first.to_owned();
        for (k, word) in text.split_whitespace().enumerate() {
            if k > 0 && line.chars().count() + 1 + word.chars().count() > WIDTH {
                self.line(line.trim_end());
                line = next.to_owned();
            }
            line += word;
            line += " ";
        }
        self.line(line.trim_end());
    }
}
