//! Zivid's data sets: `img01.zdf` beside `pos01.yaml`, the robot's pose as a 4 x 4 matrix in millimetres; under
//! `FloatMatrix`, or, of older samples, `PoseState` as OpenCV writes it.

use std::path::Path;

use super::{Declared, Described, vision};
use crate::{Error, files, tree::Tree};

pub(super) fn describe(source: &Path, _: &Declared) -> Result<Option<Described>, Error> {
    if !source.is_dir() {
        return Ok(None);
    }
    let entries = std::fs::read_dir(source)
        .map_err(|error| Error::Read { path: source.into(), source: error })?;
    let names: Vec<String> =
        entries.filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned())).collect();
    let count = |start: &str, ending: &str| {
        let fits = |name: &&String| {
            name.starts_with(start) && name.ends_with(ending) && files::last_number(name).is_some()
        };
        names.iter().filter(fits).count()
    };
    if count("img", ".zdf") == 0 || count("pos", ".yaml") == 0 {
        return Ok(None);
    }
    let field = key_of_matrix(source, &names)?;
    let question = "which target is in the scans?";
    let sections = format!(
        "\n# {question}\n# [target]\n# kind = \"checkerboard\"\n# columns = 7\n# rows = 6\n# square_mm = 30.0\n\n\
         [robot]\nposes = \"pos*.yaml\"\n{field}notation = \"matrix4x4\"\nlength_unit = \"mm\"\n\
         direction = \"base_from_flange\"\n\n[scans]\nfiles = \"img*.zdf\"\nlength_unit = \"mm\"\n"
    );
    Ok(Some(Described {
        layout: "Zivid's data set",
        folder: source.into(),
        setup: None,
        sections,
        questions: vec![question.into()],
        notes: vec![],
    }))
}

/// The line of the manifest that says where the matrices stand in their files.
fn key_of_matrix(folder: &Path, names: &[String]) -> Result<String, Error> {
    let is_pose = |name: &&String| name.starts_with("pos") && name.ends_with(".yaml");
    let Some(first) = names.iter().filter(is_pose).min() else { return Ok(String::new()) };
    let tree = Tree::read(&folder.join(first))?;
    let key = vision::ZIVID.into_iter().find(|key| tree.get(key).is_some());
    Ok(key.map_or(String::new(), |key| format!("field = \"{key}\"\n")))
}
