//! Zivid's data sets: `img01.zdf` beside `pos01.yaml`, the robot's pose as a 4 x 4 matrix in millimetres; under
//! `FloatMatrix`, or, of older samples, `PoseState` as OpenCV writes it.

use std::path::Path;

use super::{Declared, Described, vision};
use crate::{
    Error,
    dataset::{
        Draft,
        manifest::{Fields, RobotDirection, RobotSpec, ScansSpec},
    },
    files,
    tree::Tree,
    units::LengthUnit,
};

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
    let question = "which target is in the scans?";
    let mut draft = Draft::new();
    draft.ask_target(question);
    draft.manifest.robot = Some(RobotSpec {
        poses: "pos*.yaml".into(),
        field: key_of_matrix(source, &names)?.map(|key| Fields::One(key.into())),
        notation: Some("matrix4x4".into()),
        length_unit: Some(LengthUnit::Millimetre),
        direction: Some(RobotDirection::BaseFromFlange),
        ..RobotSpec::default()
    });
    draft.manifest.scans = Some(ScansSpec {
        files: "img*.zdf".into(),
        length_unit: Some(LengthUnit::Millimetre),
        ..ScansSpec::default()
    });
    Ok(Some(Described {
        layout: "Zivid's data set",
        folder: source.into(),
        setup: None,
        draft,
        questions: vec![question.into()],
        notes: vec![],
    }))
}

/// The key under which the matrices stand in their files.
fn key_of_matrix(folder: &Path, names: &[String]) -> Result<Option<&'static str>, Error> {
    let is_pose = |name: &&String| name.starts_with("pos") && name.ends_with(".yaml");
    let Some(first) = names.iter().filter(is_pose).min() else { return Ok(None) };
    let tree = Tree::read(&folder.join(first))?;
    Ok(vision::ZIVID.into_iter().find(|key| tree.get(key).is_some()))
}
