//! Zivid's data sets: `img01.zdf` beside `pos01.yaml`, the robot's pose as a 4 x 4 matrix in millimetres.

use std::path::Path;

use super::Described;
use crate::{Error, files};

pub(super) fn describe(source: &Path) -> Result<Option<Described>, Error> {
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
    let question = "which target is in the scans?";
    let sections = format!(
        "\n# {question}\n# [target]\n# kind = \"checkerboard\"\n# columns = 7\n# rows = 6\n# square_mm = 30.0\n\n\
         [robot]\nposes = \"pos*.yaml\"\nnotation = \"matrix4x4\"\nlength_unit = \"mm\"\n\
         direction = \"base_from_flange\"\n\n[scans]\nfiles = \"img*.zdf\"\nlength_unit = \"mm\"\n"
    );
    Ok(Some(Described {
        layout: "Zivid's data set",
        folder: source.into(),
        setup: None,
        sections,
        questions: vec![question.into()],
    }))
}
