//! `handeye init`: a first manifest for a folder, with the questions that its files leave open.

use std::path::Path;

use handeye_io::{MANIFEST, Question, first_manifest, write_atomically};
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
    let first = first_manifest(&args.folder)?;
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

fn told(path: &Path, questions: &[Question]) -> String {
    let question = |q: &Question| output::wrapped(&format!("  line {:>3}  ", q.line), &q.text);
    let all: String = questions.iter().map(question).collect();
    format!("{} is written; answer in it:\n\n{all}", path.display())
}
