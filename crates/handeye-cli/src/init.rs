//! `handeye init`: a first manifest for a folder, with the questions that its files leave open.

use std::{
    io::{self, BufRead, IsTerminal},
    path::Path,
};

use handeye_io::{
    Known, MANIFEST, OpenKey, OpenQuestion, Question, answered, first_manifest, open_questions,
    read_target, robot::Notation, write_atomically,
};
use serde_json::json;

use crate::{
    args::{GlobalArgs, InitArgs},
    failure::Failure,
    output,
};

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
        output::print(&told(&path, &first.questions));
    }
    Ok(0)
}

/// What the options say.
fn known(args: &InitArgs) -> Result<Known, Failure> {
    if let Some(name) = &args.robot {
        Notation::named(name)
            .map_err(|e| Failure::Usage(format!("--robot {name} is not known; {e}")))?;
    }
    Ok(Known {
        setup: args.setup.map(Into::into),
        robot: args.robot.clone(),
        target: args.target.as_deref().map(read_target).transpose()?,
    })
}

fn told(path: &Path, questions: &[Question]) -> String {
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
        return format!("\n{path} is written\n\nnext: handeye check {folder}\n");
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
        match answers(&question, input) {
            Some(values) => text = answered(&text, &question, &values),
            None => left_open += 1,
        }
    }
    text
}

/// A value for every key of a question; `None` where it stays open.
fn answers(question: &OpenQuestion, input: &mut impl BufRead) -> Option<Vec<String>> {
    let choices = question.choices();
    for (k, choice) in choices.iter().enumerate() {
        output::note!("  {}  {choice}", k + 1);
    }
    let mut values = vec![];
    for (k, key) in question.keys.iter().enumerate() {
        values.push(answer(key, if k == 0 { &choices } else { &[] }, input)?);
    }
    (!values.is_empty()).then_some(values)
}

/// What a person types for a key, until it is a value; `None` for an empty line, and at the end of the input.
fn answer(key: &OpenKey, choices: &[&str], input: &mut impl BufRead) -> Option<String> {
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
        match key.value(by_number.unwrap_or(&typed)) {
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
    fn questions_are_answered_by_number_by_word_and_again_after_a_mistake() {
        let whole = "setup = \"eye-to-hand\"\n\n[target]\ncolumns = 9\nsquare_mm = 24.5\n";
        assert_eq!(after("2\n9\nwide\n24,5\n"), whole);
        assert_eq!(after("eye-to-hand\n9\n24.5\n"), whole);
    }

    #[test]
    fn what_is_not_answered_stays_open() {
        assert_eq!(after(""), MANIFEST);
        assert_eq!(after("\n9\n\n"), MANIFEST);
        assert_eq!(open_questions(&after("\n9\n25\n")).len(), 1);
    }
}
