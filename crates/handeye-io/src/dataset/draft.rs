//! A manifest written for people: the values of a [`Manifest`], remarks beside its keys, and keys that wait for an
//! answer, which are commented out below their question.

use std::collections::{BTreeMap, BTreeSet};

use handeye::{Setup, TargetModel, TargetSize};

use super::{manifest::Manifest, shapes::TargetSpec};
use crate::target_file::Targets;

/// How a question of a manifest begins.
pub(crate) const QUESTION: &str = "# QUESTION: ";
/// Columns of a remark.
const WIDTH: usize = 80;
/// What stands below the question for a target.
pub(crate) const EXAMPLE_TARGET: TargetModel =
    TargetModel::Checkerboard { columns: 11, rows: 8, square_mm: 30.0 };

/// What somebody must say.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// Line of the manifest, counted from 1.
    pub line: usize,
    /// The question, whole.
    pub text: String,
}

/// Whether a text above a key states or asks.
#[derive(Debug, Clone)]
enum Remark {
    Note(String),
    Question(String),
}

/// A manifest and what is said about its keys. A key is named with its table, as in `robot.direction` and
/// `placements.0.id`; the name of a table is that of its heading.
#[derive(Debug, Clone)]
pub(crate) struct Draft {
    pub(crate) manifest: Manifest,
    head: Vec<String>,
    above: BTreeMap<String, Vec<Remark>>,
    behind: BTreeMap<String, String>,
    below: BTreeMap<String, Vec<String>>,
    open: BTreeSet<String>,
    end: Vec<Remark>,
}

impl Draft {
    /// A manifest with nothing but its setup.
    pub(crate) fn new() -> Self {
        Self {
            manifest: Manifest::new(Setup::EyeInHand),
            head: vec![],
            above: BTreeMap::new(),
            behind: BTreeMap::new(),
            below: BTreeMap::new(),
            open: BTreeSet::new(),
            end: vec![],
        }
    }

    /// The setup, which is asked where it is not known.
    pub(crate) fn set_setup(&mut self, setup: Option<Setup>, question: &str) {
        match setup {
            Some(setup) => self.manifest.setup = setup,
            None => self.ask(&["setup"], question),
        }
    }

    /// The target of which everything is known.
    pub(crate) fn set_target(&mut self, model: TargetModel) {
        self.manifest.target = Some(TargetSpec::Boards(Targets::One(model, TargetSize::Printed)));
    }

    /// The question which target it is, with an example.
    pub(crate) fn ask_target(&mut self, question: &str) {
        self.set_target(EXAMPLE_TARGET);
        self.ask(&["target"], question);
    }

    /// A remark at the top of the file.
    pub(crate) fn head(&mut self, text: impl Into<String>) {
        self.head.push(text.into());
    }

    /// A remark above a key or a table's heading.
    pub(crate) fn note(&mut self, key: &str, text: impl Into<String>) {
        self.above.entry(key.into()).or_default().push(Remark::Note(text.into()));
    }

    /// A remark on the line of a key.
    pub(crate) fn note_behind(&mut self, key: &str, text: impl Into<String>) {
        self.behind.insert(key.into(), text.into());
    }

    /// A line below a key that is commented out: another value that it may have.
    pub(crate) fn note_below(&mut self, key: &str, line: impl Into<String>) {
        self.below.entry(key.into()).or_default().push(line.into());
    }

    /// A remark below everything else.
    pub(crate) fn note_at_end(&mut self, text: impl Into<String>) {
        self.end.push(Remark::Note(text.into()));
    }

    /// A question above the first of these keys, whose values are examples and commented out. The name of a table
    /// stands for all of it.
    pub(crate) fn ask(&mut self, keys: &[&str], question: impl Into<String>) {
        let Some(first) = keys.first() else { return };
        let question = Remark::Question(question.into());
        self.above.entry((*first).into()).or_default().push(question);
        self.open.extend(keys.iter().map(|key| String::from(*key)));
    }

    /// The text of the manifest, and what it asks.
    pub(crate) fn written(&self) -> (String, Vec<Question>) {
        let mut page = Page::default();
        self.head.iter().for_each(|text| page.wrapped("# ", text));
        // tables of numbers and names: this cannot fail
        let values = toml::to_string(&self.manifest).unwrap_or_default();
        let mut place = Place::default();
        let mut is_apart = !self.head.is_empty() && self.above.contains_key("setup");
        for line in values.lines() {
            if line.is_empty() {
                is_apart = true;
                continue;
            }
            let key = place.key(line);
            if std::mem::take(&mut is_apart) {
                page.line("");
            }
            self.above.get(&key).into_iter().flatten().for_each(|remark| page.remark(remark));
            let mark = if self.is_open(&key) { "# " } else { "" };
            let behind = self.behind.get(&key).map(|text| format!("  # {text}"));
            page.line(&format!("{mark}{line}{}", behind.unwrap_or_default()));
            let below = self.below.get(&key).into_iter().flatten();
            below.for_each(|line| page.line(&format!("# {line}")));
        }
        if !self.end.is_empty() {
            page.line("");
        }
        self.end.iter().for_each(|remark| page.remark(remark));
        (page.text, page.questions)
    }

    /// Whether a key, or a table around it, waits for an answer.
    fn is_open(&self, key: &str) -> bool {
        let around = key.match_indices('.').map(|(k, _)| &key[..k]);
        around.chain([key]).any(|name| self.open.contains(name))
    }
}

/// Where in the file a line is.
#[derive(Default)]
struct Place {
    table: String,
    counts: BTreeMap<String, usize>,
}

impl Place {
    /// The name of what stands on a line.
    fn key(&mut self, line: &str) -> String {
        if let Some(list) = line.strip_prefix("[[").and_then(|l| l.strip_suffix("]]")) {
            let count = self.counts.entry(list.into()).or_default();
            self.table = format!("{list}.{count}");
            *count += 1;
        } else if let Some(table) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
            self.table = table.into();
        } else {
            let key = line.split_once('=').map_or(line, |(key, _)| key).trim();
            let is_top = self.table.is_empty();
            return if is_top { key.into() } else { format!("{}.{key}", self.table) };
        }
        self.table.clone()
    }
}

/// The text while it is written.
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

    fn remark(&mut self, remark: &Remark) {
        match remark {
            Remark::Note(text) => self.wrapped("# ", text),
            Remark::Question(text) => {
                let line = self.text.lines().count() + 1;
                self.questions.push(Question { line, text: text.clone() });
                self.wrapped(QUESTION, text);
            }
        }
    }

    fn wrapped(&mut self, first: &str, text: &str) {
        let mut line = first.to_owned();
        for (k, word) in text.split_whitespace().enumerate() {
            if k > 0 && line.chars().count() + 1 + word.chars().count() > WIDTH {
                self.line(line.trim_end());
                line = "#   ".to_owned();
            }
            line += word;
            line += " ";
        }
        self.line(line.trim_end());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::manifest::{RobotDirection, RobotSpec};

    #[test]
    fn remarks_stand_beside_their_keys_and_open_keys_are_commented_out() {
        let mut draft = Draft::new();
        draft.set_setup(None, "who carries the camera?");
        draft.head("of a test");
        draft.manifest.robot = Some(RobotSpec {
            poses: "poses.csv".into(),
            direction: Some(RobotDirection::BaseFromFlange),
            ..RobotSpec::default()
        });
        draft.note_behind("robot.poses", "12 poses");
        draft.note_below("robot.poses", "or \"others.csv\"?");
        draft.ask(&["robot.direction"], "which way?");
        draft.note_at_end("the end");
        let (text, questions) = draft.written();
        assert_eq!(
            text,
            "# of a test\n\n# QUESTION: who carries the camera?\n# setup = \"eye-in-hand\"\n\n[robot]\n\
             poses = \"poses.csv\"  # 12 poses\n# or \"others.csv\"?\n# QUESTION: which way?\n\
             # direction = \"base_from_flange\"\n\n# the end\n"
        );
        let lines: Vec<usize> = questions.iter().map(|q| q.line).collect();
        assert_eq!(lines, [3, 9]);
    }
}
