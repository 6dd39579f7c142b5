//! `handeye import`: a manifest for the data set of another program.

use handeye_io::{MANIFEST, import, write_atomically};
use serde_json::json;

use crate::{
    args::{ImportArgs, Manners},
    failure::Failure,
    output,
};

pub fn run(args: &ImportArgs, manners: &Manners) -> Result<u8, Failure> {
    let imported = import(&args.source, args.setup.map(Into::into))?;
    let path = imported.folder.join(MANIFEST);
    if path.exists() && !args.force {
        let what = "is there already; to write over it: --force";
        return Err(Failure::in_the_way(path, what));
    }
    write_atomically(&path, imported.manifest.as_bytes())?;
    if manners.json {
        let questions = &imported.questions;
        output::json(
            &json!({ "layout": imported.layout, "manifest": path, "questions": questions }),
        );
        return Ok(0);
    }
    let mut text = format!("{}: {} is written", imported.layout, path.display());
    text += if imported.questions.is_empty() { "\n" } else { "; answer in it:\n\n" };
    text += &imported.questions.iter().map(|q| output::wrapped("  ", q)).collect::<String>();
    output::print(&text);
    Ok(0)
}
