//! `handeye target`: a board to print, in true scale.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::TargetModel;
use handeye_io::{
    Problem,
    drawing::{self, DrawingError, Paper},
    read_target, target_toml, write_atomically,
};
use serde_json::json;

use crate::{
    args::{GlobalArgs, TargetArgs},
    boards,
    failure::Failure,
    output,
};

pub fn run(args: &TargetArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let kind = Kind::of(&args.out)?;
    let target = target(args)?;
    let paper = Paper::named(&args.paper).map_err(|e| Failure::Usage(e.to_string()))?;
    let sheet = drawing::sheet(&target, &paper).map_err(|e| refused(args, e))?;
    let description = describe(&args.out, &target)?;
    let title = target.in_words();
    let content = match kind {
        Kind::Pdf => drawing::pdf(&sheet, &title),
        Kind::Svg => drawing::svg(&sheet, &title).into_bytes(),
    };
    write_atomically(&args.out, &content)?;
    write_atomically(&description, target_toml(&target).as_bytes())?;
    if global.json {
        let size = [sheet.width, sheet.height];
        output::json(&json!({
            "drawing": args.out, "description": description, "target": target, "paper_mm": size
        }));
    } else {
        output::print(&format!(
            "{title}\n{}: {} x {} mm; print it at 100 % and measure the ruler\n{}: its [target]\n",
            args.out.display(),
            sheet.width,
            sheet.height,
            description.display()
        ));
    }
    Ok(0)
}

enum Kind {
    Pdf,
    Svg,
}

impl Kind {
    fn of(out: &Path) -> Result<Self, Failure> {
        match out.extension().map(|e| e.to_string_lossy().to_lowercase()).as_deref() {
            Some("pdf") => Ok(Kind::Pdf),
            Some("svg") => Ok(Kind::Svg),
            _ => Err(Failure::Usage(format!("--out {}: ends in .pdf or .svg", out.display()))),
        }
    }
}

fn refused(args: &TargetArgs, error: DrawingError) -> Failure {
    match (&args.target, error) {
        (Some(file), error) => Failure::input(file, error),
        (None, DrawingError::Target(error)) => Failure::Usage(error.to_string()),
        (None, error) => Failure::new(Problem::new("unusable", error.to_string())),
    }
}

/// The TOML beside the drawing; one that describes another board is not written over.
fn describe(out: &Path, target: &TargetModel) -> Result<PathBuf, Failure> {
    let path = out.with_extension("toml");
    if path.exists() && !read_target(&path).is_ok_and(|there| there == *target) {
        let what =
            "is there already and describes another target; remove it, or choose another --out";
        return Err(Failure::in_the_way(path, what));
    }
    if let Some(folder) = out.parent().filter(|f| !f.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|e| Failure::no_folder(folder, e))?;
    }
    Ok(path)
}

/// The target of a file, or of the options.
fn target(args: &TargetArgs) -> Result<TargetModel, Failure> {
    if let Some(file) = &args.target {
        return Ok(read_target(file)?);
    }
    args.board.target(args).unwrap_or_else(|| {
        let what = format!("which target? Name a TOML file, or {}", boards::options());
        Err(Failure::Usage(what))
    })
}
