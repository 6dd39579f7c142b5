//! Tabb and Ahmad Yousef's layout: `robot_cali.txt` (a count, then 4 x 4 matrices in millimetres, `flange_from_base`),
//! `calibration_object.txt` (a checkerboard), images in `images/camera0` (and `camera1` ...).

use std::path::Path;

use handeye::{Setup, TargetModel};

use super::{Declared, Described};
use crate::{
    Error,
    dataset::{
        Draft,
        manifest::{ImagesSpec, RobotDirection, RobotSpec},
    },
    error::unusable,
    files,
    units::LengthUnit,
};

pub(super) fn describe(source: &Path, _: &Declared) -> Result<Option<Described>, Error> {
    let folder = if source.is_dir() { source.to_path_buf() } else { super::split(source).0 };
    let (poses, board) = (folder.join("robot_cali.txt"), folder.join("calibration_object.txt"));
    let is_meant = source.is_dir() || source.file_name() == poses.file_name();
    if !is_meant || !poses.is_file() || !board.is_file() {
        return Ok(None);
    }
    let text = files::text(&board)?;
    let value = |key: &str| {
        let words: Vec<&str> = text.split_whitespace().collect();
        let found =
            words.windows(2).find(|two| two[0] == key).and_then(|two| two[1].parse::<f64>().ok());
        found.ok_or_else(|| unusable(&board, format!("says nothing of {key}")))
    };
    let (width, height) = (value("chess_mm_width")?, value("chess_mm_height")?);
    if width != height {
        return Err(unusable(
            &board,
            format!("has fields of {width} x {height} mm: squares are needed"),
        ));
    }
    let target = TargetModel::Checkerboard {
        columns: value("chess_width")? as u32,
        rows: value("chess_height")? as u32,
        square_mm: width,
    };
    target.check().map_err(|e| unusable(&board, e.to_string()))?;
    let camera = folder.join("images/camera0");
    let mut endings: Vec<String> = std::fs::read_dir(&camera)
        .map_err(|error| Error::Read { path: camera.clone(), source: error })?
        .filter_map(|entry| Some(files::extension(&entry.ok()?.path())))
        .filter(|ending| ["png", "jpg", "jpeg", "tif", "tiff", "bmp"].contains(&ending.as_str()))
        .collect();
    endings.sort();
    let Some(ending) = endings.first() else {
        return Err(unusable(&camera, "holds no images"));
    };
    let mut questions = vec![];
    if folder.join("images/camera1").is_dir() {
        questions.push("only images/camera0 is described: one manifest for each camera".into());
    }
    let mut draft = Draft::new();
    draft.set_target(target);
    draft.manifest.robot = Some(RobotSpec {
        poses: "robot_cali.txt".into(),
        notation: Some("matrix4x4".into()),
        length_unit: Some(LengthUnit::Millimetre),
        direction: Some(RobotDirection::FlangeFromBase),
        ..RobotSpec::default()
    });
    draft.manifest.images = Some(ImagesSpec::of(format!("images/camera0/*.{ending}")));
    Ok(Some(Described {
        layout: "Tabb and Ahmad Yousef's layout",
        folder,
        setup: Some(Setup::EyeInHand),
        draft,
        questions,
        notes: vec![],
    }))
}
