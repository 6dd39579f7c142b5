//! `handeye init`: a first manifest for a folder, with the questions that its files leave open.

use handeye_io::{MANIFEST, handeye_init, write_atomically};
use serde_json::json;

use crate::{
    args::{InitArgs, Manners},
    failure::Failure,
    output,
};

pub fn run(args: &InitArgs, manners: &Manners) -> Result<u8, Failure> {
    let path = args.folder.join(MANIFEST);
    if path.exists() && !args.force {
        let what = "is there already; to write over it: --force";
        return Err(Failure::in_the_way(path, what));
    }
    let text = handeye_init(&args.folder)?;
    write_atomically(&path, text.as_bytes())?;
    let questions: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .filter_map(|(k, line)| Some((k + 1, line.split_once("QUESTION: ")?.1)))
        .collect();
    if manners.json {
        let entry =
            |&(line, question): &(usize, &str)| json!({ "line": line, "question": question });
        let questions: Vec<_> = questions.iter().map(entry).collect();
        output::json(&json!({ "manifest": path, "questions": questions }));
    } else {
        let mut shown = format!("{} is written. Open questions:\n", path.display());
        for (line, question) in questions {
            shown += &format!("  line {line:>2}: {question}\n");
        }
        output::print(&shown);
    }
    Ok(0)
}
