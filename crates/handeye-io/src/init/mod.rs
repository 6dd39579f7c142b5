//! A first manifest for a folder: what its files prove is filled in, the rest is asked.

mod board;
mod fields;
mod groups;
mod kind;
mod robot;
mod sections;

use std::path::Path;

use handeye::{Setup, TargetModel};

use crate::{
    Question, bag,
    error::{Error, unusable},
    robot::Notation,
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

/// What stands at the top of a manifest that waits for answers.
const REQUEST: &str = "What the files prove is filled in. Answer every QUESTION: correct the lines below it and remove their #.";

/// A manifest of which all questions are answered, without the request for answers at its top.
pub fn without_request(manifest: &str) -> String {
    let first = REQUEST.split('.').next().unwrap_or_default();
    if !manifest.trim_start_matches(['#', ' ']).starts_with(first) {
        return manifest.into();
    }
    let below = manifest.lines().skip_while(|line| line.starts_with('#'));
    below.skip_while(|line| line.is_empty()).map(|line| format!("{line}\n")).collect()
}

/// What somebody says of a folder before it is looked at.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Known {
    /// Whether the robot carries the camera or the target.
    pub setup: Option<Setup>,
    /// The notation of the robot's poses, such as `kuka`.
    pub robot: Option<String>,
    /// The target.
    pub target: Option<TargetModel>,
}

impl Known {
    /// Whether the notation is a maker's, which brings its unit; controllers show the flange in the base.
    fn has_maker(&self) -> bool {
        let notation = self.robot.as_deref().and_then(|name| Notation::named(name).ok());
        notation.is_some_and(|notation| notation.length_unit.is_some())
    }
}

/// A first manifest for the files of a folder.
///
/// # Errors
/// [`Error::Read`] if the folder cannot be listed, [`Error::NothingFound`] if it holds no images,
/// scans, corners or poses.
pub fn first_manifest(folder: &Path, known: &Known) -> Result<FirstManifest, Error> {
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
    let (text, questions) = sections::draft(&kinds, folder, known).written();
    Ok(FirstManifest { text, questions })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answered_manifest_asks_for_no_answers() {
        let mut draft = crate::dataset::Draft::new();
        draft.head(REQUEST);
        draft.note("setup", "as the folder says");
        let (text, _) = draft.written();
        assert!(text.starts_with("# What the files prove is filled in."), "{text}");
        let without = without_request(&text);
        assert!(without.starts_with("# as the folder says\nsetup = "), "{without}");
        assert_eq!(without_request(&without), without);
    }
}
