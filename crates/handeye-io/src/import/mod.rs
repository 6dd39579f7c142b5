//! Data sets of other programs: recognised, and described by a manifest beside them.
//!
//! Nothing is converted: the manifest says how their files are to be read, directions and units included. What a
//! program's layout says of itself is taken, what it leaves open is asked.

mod industrial;
mod samples;
mod tabb;
mod zivid;

use std::path::{Path, PathBuf};

use handeye::Setup;

use crate::{Error, error::unusable};

/// A data set that was recognised.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// Whose layout it is.
    pub layout: &'static str,
    /// Where the manifest belongs.
    pub folder: PathBuf,
    /// Its text.
    pub manifest: String,
    /// What it does not say, and somebody must add.
    pub questions: Vec<String>,
}

/// What a layout says of the set.
struct Described {
    layout: &'static str,
    folder: PathBuf,
    setup: Option<Setup>,
    /// All but the line of the setup.
    sections: String,
    questions: Vec<String>,
}

/// Describes a source whose layout it knows.
type Layout = fn(&Path) -> Result<Option<Described>, Error>;

/// Layouts, in the order in which they are tried.
const LAYOUTS: [Layout; 4] =
    [samples::describe, industrial::describe, tabb::describe, zivid::describe];
/// What is recognised.
const KNOWN: &str = "samples of easy_handeye2 (samples with `robot` and `tracking`) and of moveit_calibration \
                     (`effector_wrt_world` and `object_wrt_sensor`), cal_data.yaml of robot_cal_tools, data sets \
                     of industrial_calibration, Tabb's layout (robot_cali.txt), Zivid's (img01.zdf and pos01.yaml)";

/// Recognises a file or folder of another program. `setup` says who carries the camera, where the files do not.
///
/// # Errors
/// What cannot be read; a layout that is none of those known; a setup that contradicts the files.
pub fn import(source: &Path, setup: Option<Setup>) -> Result<Imported, Error> {
    std::fs::metadata(source)
        .map_err(|error| Error::Read { path: source.into(), source: error })?;
    for layout in LAYOUTS {
        if let Some(described) = layout(source)? {
            return with_setup(described, setup, source);
        }
    }
    Err(unusable(
        source,
        format!(
            "is no data set that is known here; there are {KNOWN}. For other files: handeye init"
        ),
    ))
}

fn with_setup(set: Described, given: Option<Setup>, source: &Path) -> Result<Imported, Error> {
    if let (Some(own), Some(given)) = (set.setup, given)
        && own != given
    {
        let what = format!("says that it is {}, and {} was asked for", own.name(), given.name());
        return Err(unusable(source, what));
    }
    let mut questions = set.questions;
    let line = match set.setup.or(given) {
        Some(setup) => format!("setup = \"{}\"", setup.name()),
        None => {
            let what =
                "who carries the camera: the robot (eye-in-hand), or the cell (eye-to-hand)?";
            questions.insert(0, what.into());
            format!("# {what}\n# setup = \"eye-in-hand\"")
        }
    };
    let manifest = format!("# {}\n{line}\n{}", set.layout, set.sections);
    Ok(Imported { layout: set.layout, folder: set.folder, manifest, questions })
}

/// The folder a file lies in, and its name.
fn split(file: &Path) -> (PathBuf, String) {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    (folder.into(), file.file_name().unwrap_or_default().to_string_lossy().into_owned())
}

/// A TOML string.
fn quoted(text: &str) -> String {
    toml::Value::String(text.into()).to_string()
}

#[cfg(test)]
mod tests;
