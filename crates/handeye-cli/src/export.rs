//! `handeye export`: a result in the notations of other programs and of robots.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{Calibration, Verdict};
use handeye_io::{
    export::{CameraPose, Format, render, with_body},
    read_result, write_atomically,
};
use serde_json::json;

use crate::{
    args::{ExportArgs, GlobalArgs},
    failure::Failure,
    output,
};

pub fn run(args: &ExportArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    if args.format.iter().any(|f| f == "list") {
        list(global);
        return Ok(0);
    }
    let formats = formats(&args.format)?;
    check_out(args.out.as_deref(), &formats)?;
    let path = args.calibration.as_ref().ok_or_else(|| {
        Failure::Usage("which calibration? Name the calibration.json of a result".into())
    })?;
    let calibration = of_body(read_result(path)?, args)?;
    check_verdict(path, &calibration, args.force, global)?;
    let frames = Frames { parent: args.parent.as_deref(), child: args.child.as_deref() };
    match &args.out {
        None => show(path, &calibration, &formats, frames, global)?,
        Some(out) => {
            let written = match single_file(out, &formats) {
                true => vec![write_one(path, &calibration, &formats[0], frames, out)?],
                false => write_all(path, &calibration, &formats, frames, out)?,
            };
            tell(&written, global);
        }
    }
    Ok(0)
}

/// With the body of the camera that the arguments name a URDF for.
fn of_body(calibration: Calibration, args: &ExportArgs) -> Result<Calibration, Failure> {
    let (Some(urdf), Some(body)) = (&args.urdf, &args.child) else { return Ok(calibration) };
    let named = calibration.frames.as_ref().and_then(|frames| frames.camera.clone());
    let optical = args.optical.clone().or(named).ok_or_else(|| {
        let question = "which link of the URDF is the camera's optical frame (x right, y down, z forward)? Name it with \
                        --optical, such as camera_color_optical_frame";
        Failure::Usage(question.into())
    })?;
    Ok(with_body(calibration, urdf, body, &optical)?)
}

/// Names and contents of a calibration in the given formats.
pub fn exports(
    calibration: &Calibration,
    formats: &[Format],
    out: &Path,
) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let pose = pose(out, calibration, formats, Frames::default())?;
    let file = |format: &Format| (format.file_name(pose.name), render(&pose, format));
    Ok(formats.iter().map(file).collect())
}

/// Names of frames in the exported file.
#[derive(Clone, Copy, Default)]
struct Frames<'a> {
    parent: Option<&'a str>,
    child: Option<&'a str>,
}

/// The formats of their names.
pub fn formats(names: &[String]) -> Result<Vec<Format>, Failure> {
    let named = |name: &String| {
        Format::named(name).map_err(|e| Failure::Usage(format!("no format {name:?}; {e}")))
    };
    names.iter().map(named).collect()
}

/// Several formats go into a folder, and a name like `x.txt` means a file.
fn check_out(out: Option<&Path>, formats: &[Format]) -> Result<(), Failure> {
    let Some(out) = out.filter(|out| formats.len() > 1 && !out.is_dir()) else { return Ok(()) };
    if out.extension().is_none() && !out.exists() {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "--out {}: {} formats do not fit into one file; name a folder (one that is there, or a \
         name without an ending)",
        out.display(),
        formats.len()
    )))
}

fn list(global: &GlobalArgs) {
    let names = Format::names();
    if global.json {
        output::json(&json!({ "formats": names }));
    } else {
        output::print(&(names.join("\n") + "\neuler-AXES-intrinsic, euler-AXES-extrinsic\n"));
    }
}

/// A result that is not accepted leaves the house only by force; what came from elsewhere leaves as it came.
fn check_verdict(
    path: &Path,
    calibration: &Calibration,
    force: bool,
    global: &GlobalArgs,
) -> Result<(), Failure> {
    if calibration.verdict == Verdict::Accepted {
        return Ok(());
    }
    if calibration.is_unjudged() {
        let what = "nothing here tells how good it is; `handeye verify` tests it on touched points";
        if !global.quiet {
            crate::output::note!("warning [not-judged]: {}: {what}", path.display());
        }
        return Ok(());
    }
    let verdict = match calibration.verdict {
        Verdict::Undetermined => "undetermined",
        _ => "rejected",
    };
    let why = calibration.reasons.first().map_or(String::new(), |r| format!(" ({r})"));
    let what = format!("the verdict is {verdict}{why}");
    if !force {
        return Err(Failure::input(path, what + "; to export it all the same: --force"));
    }
    if !global.quiet {
        crate::output::note!(
            "warning [not-accepted]: {}: {what}; do not move a robot by it",
            path.display()
        );
    }
    Ok(())
}

fn pose<'a>(
    place: &Path,
    calibration: &'a Calibration,
    formats: &[Format],
    frames: Frames<'a>,
) -> Result<CameraPose<'a>, Failure> {
    let pose = CameraPose::of(calibration, frames.parent, frames.child, formats)
        .map_err(Failure::Usage)?;
    pose.ok_or_else(|| {
        let free = match &calibration.undetermined[..] {
            [] => "the data do not determine it".into(),
            free => format!("not determined: {}", free.join(", ")),
        };
        let what = format!(
            "there is no transform to export; {free}; record more poses and calibrate again"
        );
        Failure::input(place, what)
    })
}

/// One format, and a name that is no folder.
fn single_file(out: &Path, formats: &[Format]) -> bool {
    formats.len() == 1 && !out.is_dir() && out.extension().is_some()
}

fn write_one(
    place: &Path,
    calibration: &Calibration,
    format: &Format,
    frames: Frames,
    file: &Path,
) -> Result<PathBuf, Failure> {
    write_atomically(
        file,
        &render(&pose(place, calibration, std::slice::from_ref(format), frames)?, format),
    )?;
    Ok(file.to_path_buf())
}

fn write_all(
    place: &Path,
    calibration: &Calibration,
    formats: &[Format],
    frames: Frames,
    folder: &Path,
) -> Result<Vec<PathBuf>, Failure> {
    let pose = pose(place, calibration, formats, frames)?;
    fs::create_dir_all(folder).map_err(|e| Failure::no_folder(folder, e))?;
    let write = |format: &Format| {
        let file = folder.join(format.file_name(pose.name));
        write_atomically(&file, &render(&pose, format))?;
        Ok(file)
    };
    formats.iter().map(write).collect()
}

/// Without `--out`: to standard output, as far as it is text.
fn show(
    path: &Path,
    calibration: &Calibration,
    formats: &[Format],
    frames: Frames,
    global: &GlobalArgs,
) -> Result<(), Failure> {
    let pose = pose(path, calibration, formats, frames)?;
    let mut texts = vec![];
    for format in formats {
        let name = format.file_name(pose.name);
        let text = String::from_utf8(render(&pose, format)).map_err(|_| {
            Failure::Usage(format!("{name} is no text: say where it goes with --out"))
        })?;
        texts.push((name, text));
    }
    if global.json {
        let entry = |(name, text): &(String, String)| json!({ "file": name, "content": text });
        output::json(&json!({ "exports": texts.iter().map(entry).collect::<Vec<_>>() }));
    } else if let [(_, only)] = &texts[..] {
        output::print(only);
    } else {
        let with_name = |(name, text): &(String, String)| format!("==> {name} <==\n{text}");
        output::print(&texts.iter().map(with_name).collect::<Vec<_>>().join("\n"));
    }
    Ok(())
}

fn tell(written: &[PathBuf], global: &GlobalArgs) {
    if global.json {
        output::json(&json!({ "files": written }));
    } else if !global.quiet {
        for path in written {
            output::print(&format!("{}\n", path.display()));
        }
    }
}
