//! Data sets and results of other programs: recognised, and described by a file of ours beside them.
//!
//! A data set gets a manifest, and nothing is converted: the manifest says how its files are to be read, directions
//! and units included. What a manifest cannot describe is written anew: two streams of poses by two clocks as
//! `pairs.json` for `solve`, a result as a pose. What a program's layout says of itself is taken, what it leaves open is
//! declared, proven from the data, or asked.

mod calibration_rs;
mod declared;
mod halcon;
mod industrial;
mod kinhec;
mod opencv;
mod results;
mod ros;
mod samples;
mod streams;
mod tabb;
mod trajectories;
mod vision;
mod zivid;

use std::path::{Path, PathBuf};

use handeye::Setup;

use crate::{Error, MANIFEST, bag, dataset::Draft, error::unusable, files};
pub(crate) use declared::WHO_CARRIES;
pub use declared::{Declared, Direction};

/// What was recognised, and the file that belongs beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// Whose layout it is.
    pub layout: &'static str,
    /// Where the file belongs.
    pub folder: PathBuf,
    /// What it is called.
    pub name: String,
    /// Its text.
    pub text: String,
    /// What it does not say, and somebody must add.
    pub questions: Vec<String>,
    /// What was taken from where, or proven by the data.
    pub notes: Vec<String>,
    /// What to run on it, `{}` in place of its path.
    pub next: &'static str,
}

impl Imported {
    /// Its text, for a file in this folder: a manifest that lies elsewhere than what it names says where that is.
    ///
    /// # Errors
    /// A folder that is not there.
    pub fn text_in(&self, folder: &Path) -> Result<String, Error> {
        let real = |path: &Path| {
            let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
            match path.canonicalize() {
                // where there are no links, a path is what it says
                Err(error) if error.kind() == std::io::ErrorKind::Unsupported => Ok(path.into()),
                found => found.map_err(|source| Error::Read { path: path.into(), source }),
            }
        };
        let (here, there) = (real(folder)?, real(&self.folder)?);
        if self.name != MANIFEST || here == there {
            return Ok(self.text.clone());
        }
        let root = toml::Value::from(files::relative(&here, &there));
        Ok(format!("root = {root} # what names of files are relative to\n{}", self.text))
    }
}

/// What a layout says of a data set.
struct Described {
    layout: &'static str,
    folder: PathBuf,
    setup: Option<Setup>,
    /// All but the setup.
    draft: Draft,
    questions: Vec<String>,
    /// What was taken from where, or left.
    notes: Vec<String>,
}

/// Describes a data set whose layout it knows.
type Layout = fn(&Path, &Declared) -> Result<Option<Described>, Error>;
/// Writes anew what no manifest can describe.
type Rewritten = fn(&Path, &Declared) -> Result<Option<Imported>, Error>;

/// Layouts of data sets, in the order in which they are tried.
const SETS: [Layout; 6] = [
    samples::describe,
    industrial::describe,
    tabb::describe,
    zivid::describe,
    calibration_rs::describe,
    halcon::describe,
];
/// All others, likewise.
const OTHERS: [Rewritten; 3] = [kinhec::import, trajectories::import, results::import];
/// What is recognised.
const KNOWN: &str = "samples of easy_handeye2 (samples with `robot` and `tracking`) and of moveit_calibration \
                     (`effector_wrt_world` and `object_wrt_sensor`), cal_data.yaml of robot_cal_tools, data sets \
                     of industrial_calibration, Tabb's layout (robot_cali.txt), Zivid's (img01.zdf and pos01.yaml), \
                     manifests of calibration-rs, folders of HALCON's poses, trajectories (lines of \
                     t x y z qx qy qz qw) of robot and camera, KinHEC; and results of easy_handeye, \
                     moveit_calibration, ROS 2 launch files, Zivid, OpenCV, HALCON, Mech-Mind";

/// Recognises a file or folder of another program; `declared` is what its files do not say.
///
/// # Errors
/// What cannot be read; a layout that is none of those known; a declaration that contradicts the files; a question
/// that must be answered before anything can be written.
pub fn import(source: &Path, declared: &Declared) -> Result<Imported, Error> {
    std::fs::metadata(source)
        .map_err(|error| Error::Read { path: source.into(), source: error })?;
    if bag::is_bag(source) {
        return Err(unusable(source, bag::ADVICE));
    }
    let sets: &[Layout] = if declared.camera.is_some() { &[] } else { &SETS };
    for layout in sets {
        if let Some(described) = layout(source, declared)? {
            return with_setup(described, declared.setup, source);
        }
    }
    for layout in OTHERS {
        if let Some(imported) = layout(source, declared)? {
            return Ok(imported);
        }
    }
    Err(unusable(
        source,
        format!("is nothing that is known here; there are {KNOWN}. For other files: handeye init"),
    ))
}

fn with_setup(set: Described, given: Option<Setup>, source: &Path) -> Result<Imported, Error> {
    let mut questions = set.questions;
    let mut draft = set.draft;
    draft.head(set.layout);
    let setup = declared::setup(set.setup, given, source)?;
    if setup.is_none() {
        questions.insert(0, WHO_CARRIES.into());
    }
    draft.set_setup(setup, WHO_CARRIES);
    Ok(Imported {
        layout: set.layout,
        folder: set.folder,
        name: MANIFEST.into(),
        text: draft.written().0,
        questions,
        notes: set.notes,
        next: "handeye calibrate {}",
    })
}

/// The folder a file lies in, and its name.
fn split(file: &Path) -> (PathBuf, String) {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    (folder.into(), file.file_name().unwrap_or_default().to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests;
