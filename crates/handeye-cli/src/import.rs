//! `handeye import`: what other programs recorded or found, described by a file of ours.

use handeye_io::{Declared, Direction, import, write_atomically};
use serde_json::json;

use crate::{
    args::{ImportArgs, Manners},
    failure::Failure,
    output,
};

pub fn run(args: &ImportArgs, manners: &Manners) -> Result<u8, Failure> {
    let imported = import(&args.source, &declared(args)?)?;
    let path = args.out.clone().unwrap_or_else(|| imported.folder.join(&imported.name));
    if path.exists() && !args.force {
        let what = "is there already; to write over it: --force";
        return Err(Failure::in_the_way(path, what));
    }
    write_atomically(&path, imported.text.as_bytes())?;
    let next = imported.next.replace("{}", &output::word(&path));
    if manners.json {
        let key = if imported.name == handeye_io::MANIFEST { "manifest" } else { "file" };
        output::json(&json!({
            "layout": imported.layout,
            key: path,
            "questions": imported.questions,
            "notes": imported.notes,
            "next": next,
        }));
        return Ok(0);
    }
    let mut text = format!("{}: {} is written", imported.layout, path.display());
    text += if imported.questions.is_empty() { "\n" } else { "; answer in it:\n\n" };
    let lines = imported.questions.iter().chain(&imported.notes);
    text += &lines.map(|line| output::wrapped("  ", line)).collect::<String>();
    if imported.questions.is_empty() {
        text += &format!("\nnext: {next}\n");
    }
    output::print(&text);
    Ok(0)
}

fn declared(args: &ImportArgs) -> Result<Declared, Failure> {
    let direction = |name: &String| {
        Direction::named(name)
            .map_err(|e| Failure::Usage(format!("--direction {name} is not known; {e}")))
    };
    Ok(Declared {
        setup: args.setup.map(Into::into),
        camera: args.camera.clone(),
        directions: args.direction.iter().map(direction).collect::<Result<_, _>>()?,
        sequence: args.sequence.clone(),
        length_unit: args.length_unit.map(Into::into),
    })
}
