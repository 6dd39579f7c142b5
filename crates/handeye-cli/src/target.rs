//! `handeye target`: a board to print, in true scale.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{TargetModel, model::target::AprilTagFamily};
use handeye_io::{
    Problem,
    drawing::{self, DrawingError, Paper},
    read_target, target_toml, write_atomically,
};
use serde_json::json;

use crate::{
    args::{Manners, TargetArgs},
    failure::Failure,
    output,
};

pub fn run(args: &TargetArgs, manners: &Manners) -> Result<u8, Failure> {
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
    if manners.json {
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
    if let Some(size) = &args.checkerboard {
        let (columns, rows) = pair("checkerboard", size)?;
        let square_mm = needed("square-mm", args.square_mm)?;
        return Ok(TargetModel::Checkerboard { columns, rows, square_mm });
    }
    if let Some(size) = &args.charuco {
        let (squares_x, squares_y) = pair("charuco", size)?;
        return Ok(TargetModel::Charuco {
            squares_x,
            squares_y,
            square_mm: needed("square-mm", args.square_mm)?,
            marker_mm: needed("marker-mm", args.marker_mm)?,
            dictionary: needed("dictionary", args.dictionary.clone())?,
            legacy: args.legacy,
            first_id: args.first_id,
        });
    }
    if let Some(id) = args.tag {
        let dictionary = needed("dictionary", args.dictionary.clone())?;
        return Ok(TargetModel::Tag { dictionary, id, size_mm: needed("size-mm", args.size_mm)? });
    }
    if let Some(target) = grid_of_tags(args)? {
        return Ok(target);
    }
    if let Some(target) = grid_of_circles(args)? {
        return Ok(target);
    }
    let what = "which target? Name a TOML file, or --checkerboard, --charuco, --aprilgrid, \
                --tag-grid, --tag, --circle-grid, --asymmetric-circle-grid, --modified-circle-grid";
    Err(Failure::Usage(what.into()))
}

fn grid_of_tags(args: &TargetArgs) -> Result<Option<TargetModel>, Failure> {
    if let Some(size) = &args.aprilgrid {
        let (tags_x, tags_y) = pair("aprilgrid", size)?;
        return Ok(Some(TargetModel::Aprilgrid {
            tags_x,
            tags_y,
            tag_mm: needed("tag-mm", args.tag_mm)?,
            spacing: args.spacing,
            family: family(&args.family)?,
            first_id: args.first_id,
            corner_squares: !args.no_corner_squares,
            border_bits: args.border_bits,
        }));
    }
    let Some(size) = &args.tag_grid else { return Ok(None) };
    let (tags_x, tags_y) = pair("tag-grid", size)?;
    Ok(Some(TargetModel::TagGrid {
        dictionary: needed("dictionary", args.dictionary.clone())?,
        tags_x,
        tags_y,
        tag_mm: needed("tag-mm", args.tag_mm)?,
        gap_mm: needed("gap-mm", args.gap_mm)?,
        first_id: args.first_id,
    }))
}

fn family(name: &str) -> Result<AprilTagFamily, Failure> {
    AprilTagFamily::named(name)
        .ok_or_else(|| Failure::Usage(format!("--family {name}: write 16h5, 25h9, 36h10 or 36h11")))
}

fn grid_of_circles(args: &TargetArgs) -> Result<Option<TargetModel>, Failure> {
    let pitch = || needed("pitch-mm", args.pitch_mm);
    if let Some(size) = &args.circle_grid {
        let (columns, rows) = pair("circle-grid", size)?;
        return Ok(Some(TargetModel::CircleGrid { columns, rows, pitch_mm: pitch()? }));
    }
    if let Some(size) = &args.asymmetric_circle_grid {
        let (columns, rows) = pair("asymmetric-circle-grid", size)?;
        return Ok(Some(TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm: pitch()? }));
    }
    let Some(size) = &args.modified_circle_grid else { return Ok(None) };
    let (columns, rows) = pair("modified-circle-grid", size)?;
    Ok(Some(TargetModel::ModifiedCircleGrid { columns, rows, pitch_mm: pitch()? }))
}

fn needed<T>(name: &str, value: Option<T>) -> Result<T, Failure> {
    value.ok_or_else(|| Failure::Usage(format!("--{name} is missing")))
}

fn pair(name: &str, text: &str) -> Result<(u32, u32), Failure> {
    let both = text.split_once('x').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    both.ok_or_else(|| {
        Failure::Usage(format!("--{name} {text}: write columns x rows without blanks, such as 9x6"))
    })
}
