//! `handeye init`: a first manifest for a folder, with the questions that its files leave open.

use std::{
    io::{self, BufRead, IsTerminal},
    path::{Path, PathBuf},
};

use clap::Args;

use handeye::model::target::KINDS;
use handeye_io::{
    Dataset, Known, MANIFEST, OpenKey, OpenQuestion, Question, answered_with, first_manifest,
    open_questions, read_target, robot::Notation, without_request, write_atomically,
};
use serde_json::json;

use crate::{args::GlobalArgs, failure::Failure, output, simulate::SetupArg};

/// Arguments of `init`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye init cell/\n\
\x20 handeye init cell/ --setup eye-to-hand --robot kuka --target board.toml\n\
\n\
On a terminal the questions are asked one after the other; an empty answer leaves one open. Elsewhere, and with \
--no-dialogue, they stand in the file.")]
pub struct InitArgs {
    /// Folder with images, scans and robot poses.
    pub folder: PathBuf,
    /// Where the camera is mounted.
    #[arg(long, value_enum)]
    pub setup: Option<SetupArg>,
    /// The robot's maker, or the notation of its poses: kuka, ur, abb, fanuc, quaternion-xyzw, ...
    #[arg(long, value_name = "NOTATION")]
    pub robot: Option<String>,
    /// A manifest or another TOML file with the `[target]`, such as `handeye target` writes.
    #[arg(long, value_name = "FILE")]
    pub target: Option<PathBuf>,
    /// Ask nothing here: the questions stand in the file.
    #[arg(long)]
    pub no_dialogue: bool,
    /// Overwrite an existing manifest.
    #[arg(long)]
    pub force: bool,
}

pub fn run(args: &InitArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let path = args.folder.join(MANIFEST);
    if path.exists() && !args.force {
        let what = "is there already; to write over it: --force";
        return Err(Failure::in_the_way(path, what));
    }
    let first = first_manifest(&args.folder, &known(args)?)?;
    let is_person = io::stdin().is_terminal() && io::stderr().is_terminal();
    if is_person && !global.json && !global.quiet && !args.no_dialogue {
        let text = dialogue(first.text, &mut io::stdin().lock());
        write_atomically(&path, text.as_bytes())?;
        output::print(&finished(args, &path, &open_questions(&text)));
        return Ok(0);
    }
    write_atomically(&path, first.text.as_bytes())?;
    if global.json {
        let entry = |q: &Question| json!({ "line": q.line, "question": q.text });
        let questions: Vec<_> = first.questions.iter().map(entry).collect();
        output::json(&json!({ "manifest": path, "questions": questions }));
    } else {
        output::print(&written(&path, &first.questions));
    }
    Ok(0)
}

/// What the options say.
fn known(args: &InitArgs) -> Result<Known, Failure> {
    if let Some(name) = &args.robot {
        if name == "joints" {
            let what = "for joint values leave --robot out: their unit and the arm are asked";
            return Err(Failure::Usage(what.into()));
        }
        Notation::named(name)
            .map_err(|e| Failure::Usage(format!("--robot {name} is not known; {e}")))?;
    }
    Ok(Known {
        setup: args.setup.map(Into::into),
        robot: args.robot.clone(),
        target: args.target.as_deref().map(read_target).transpose()?,
    })
}

fn written(path: &Path, questions: &[Question]) -> String {
    let question = |q: &Question| output::wrapped(&format!("  line {:>3}  ", q.line), &q.text);
    let all: String = questions.iter().map(question).collect();
    if all.is_empty() {
        return format!("{} is written; nothing is open\n", path.display());
    }
    format!("{} is written; answer in it:\n\n{all}", path.display())
}

fn finished(args: &InitArgs, path: &Path, open: &[OpenQuestion]) -> String {
    let path = path.display();
    if open.is_empty() {
        let folder = output::word(&args.folder);
        return match Dataset::open(&args.folder) {
            Ok(_) => format!("\n{path} is written\n\nnext: handeye check {folder}\n"),
            Err(error) => {
                let what = output::wrapped("  ", &error.to_string());
                format!("\n{path} is written, but it cannot be used yet:\n\n{what}")
            }
        };
    }
    let left: String = open.iter().map(|q| output::wrapped("  ", &q.text)).collect();
    format!("\n{path} is written; these are open, answer in it:\n\n{left}")
}

/// Asks every question; the manifest with the answers. At the end of the input the rest stays open.
fn dialogue(mut text: String, input: &mut impl BufRead) -> String {
    let count = open_questions(&text).len();
    let (mut number, mut left_open) = (0, 0);
    while let Some(question) = open_questions(&text).into_iter().nth(left_open) {
        number += 1;
        output::note!(
            "\n{}",
            output::wrapped(&format!("{number}/{count}  "), &question.text).trim_end()
        );
        let found = match question.keys.first().map(|key| key.name.as_str()) {
            None => {
                output::note!("  (answer this one in the file)");
                None
            }
            Some("kind") => board(input),
            Some(_) => lines(&question.keys, &question.choices(), input),
        };
        match found {
            Some(lines) => text = answered_with(&text, &question, &lines),
            None => left_open += 1,
        }
    }
    if open_questions(&text).is_empty() { without_request(&text) } else { text }
}

/// A line for every key; `None` where one stays open.
fn lines(keys: &[OpenKey], choices: &[&str], input: &mut impl BufRead) -> Option<Vec<String>> {
    let mut lines = vec![];
    for (k, key) in keys.iter().enumerate() {
        match answer(key, if k == 0 { choices } else { &[] }, input) {
            Some(value) => lines.push(format!("{} = {value}", key.name)),
            None if k == 0 => return None,
            None => {
                output::note!("  this question stays open; the answers to it are not kept");
                return None;
            }
        }
    }
    Some(lines)
}

/// A target: its kind, and the keys that it has.
fn board(input: &mut impl BufRead) -> Option<Vec<String>> {
    let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
    let kind = answer(&OpenKey::new("kind", "\"checkerboard\""), &names, input)?;
    let chosen = KINDS.iter().find(|known| kind.trim_matches('"') == known.name)?;
    let example = serde_json::to_value((chosen.example)()).ok()?;
    let keys =
        example.as_object()?.iter().filter(|(key, value)| *key != "kind" && !value.is_null());
    let keys: Vec<OpenKey> =
        keys.map(|(key, value)| OpenKey::new(key, value.to_string())).collect();
    let lines = lines(&keys, &[], input)?;
    Some([vec![format!("kind = {kind}")], lines].concat())
}

/// What a person types for a key, until it is a value; `None` for an empty line, and at the end of the input.
fn answer(key: &OpenKey, choices: &[&str], input: &mut impl BufRead) -> Option<String> {
    for (k, choice) in choices.iter().enumerate() {
        output::note!("  {}  {choice}", k + 1);
    }
    // a notation may be any
    let is_choice =
        choices.iter().any(|c| key.example.trim_matches('"') == *c) && key.name != "notation";
    loop {
        output::to_stderr(format_args!(
            "  {} (such as {}; empty: later) > ",
            key.name, key.example
        ));
        let mut line = String::new();
        let typed = match input.read_line(&mut line) {
            Ok(1..) => line.trim(),
            _ => "",
        };
        if typed.is_empty() {
            return None;
        }
        let by_number = typed.parse::<usize>().ok().and_then(|n| choices.get(n.wrapping_sub(1)));
        let said = by_number.copied().unwrap_or(typed);
        if is_choice && !choices.contains(&said.trim_matches('"')) {
            output::note!("  {typed} is none of these: 1 to {}, or the word", choices.len());
            continue;
        }
        match key.value(said) {
            Ok(value) => return Some(value),
            Err(what) => output::note!("  {what}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MANIFEST: &str = "# QUESTION: the camera on the robot (\"eye-in-hand\") or beside it (\"eye-to-hand\")?\n\
                            # setup = \"eye-in-hand\"\n\n[target]\n# QUESTION: how long is a square?\n\
                            # columns = 11\n# square_mm = 30.0\n";

    fn after(typed: &str) -> String {
        dialogue(MANIFEST.into(), &mut typed.as_bytes())
    }

    #[test]
    fn a_board_has_the_keys_of_its_kind() {
        let manifest = "[target]\n# QUESTION: which board?\n# kind = \"checkerboard\"\n# columns = 11\n\n[robot]\n";
        let with = |typed: &str| dialogue(manifest.into(), &mut typed.as_bytes());
        let tag = with("tag\nDICT_4X4_50\n7\n40,5\n");
        assert!(
            tag.starts_with("[target]\nkind = \"tag\"\ndictionary = \"DICT_4X4_50\"\n"),
            "{tag}"
        );
        assert!(tag.contains("\nid = 7\nsize_mm = 40.5\n\n[robot]\n"), "{tag}");
        assert_eq!(with("chessboard\n99\n"), manifest);
    }

    #[test]
    fn questions_are_answered_by_number_by_word_and_again_after_a_mistake() {
        let whole = "setup = \"eye-to-hand\"\n\n[target]\ncolumns = 9\nsquare_mm = 24.5\n";
        assert_eq!(after("3\n2\n9\nwide\n24,5\n"), whole);
        assert_eq!(after("eye-to-hand\n9\n24.5\n"), whole);
    }

    #[test]
    fn what_is_not_answered_stays_open() {
        assert_eq!(after(""), MANIFEST);
        assert_eq!(after("\n9\n\n"), MANIFEST);
        assert_eq!(open_questions(&after("\n9\n25\n")).len(), 1);
    }
}
