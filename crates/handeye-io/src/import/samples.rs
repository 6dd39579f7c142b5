//! Samples of ROS programs: pairs of poses in one file.
//!
//! easy_handeye2 keeps `{parameters: {calibration_type}, samples: [{robot, tracking}]}`, or the samples alone; for a
//! camera beside the robot its `robot` is the inverse, `effector_from_base`. moveit_calibration keeps a list of
//! `{effector_wrt_world, object_wrt_sensor}`, sixteen numbers each, or of `[[4 x 4], [4 x 4]]`; who carries the camera
//! it does not say.

use std::path::Path;

use handeye::Setup;

use super::{Declared, Described, WHO_CARRIES, ros, split};
use crate::{
    Error,
    dataset::{
        Draft,
        manifest::{BoardDirection, BoardPosesSpec, Fields, RobotDirection, RobotSpec},
    },
    error::{undeclared, unusable},
    files,
    tree::Tree,
    units::LengthUnit,
};

pub(super) fn describe(source: &Path, declared: &Declared) -> Result<Option<Described>, Error> {
    let is_text = ["yaml", "yml", "json", "samples"].contains(&files::extension(source).as_str());
    if !source.is_file() || !is_text {
        return Ok(None);
    }
    let tree = Tree::read(source)?;
    if let Some(Tree::List(samples)) = tree.get("samples") {
        return easy_handeye(source, &tree, samples, declared).map(Some);
    }
    let Tree::List(samples) = &tree else { return Ok(None) };
    let Some(first) = samples.first() else { return Ok(None) };
    if first.get("effector_wrt_world").is_some() && first.get("object_wrt_sensor").is_some() {
        return Ok(Some(moveit(source, ["*.effector_wrt_world", "*.object_wrt_sensor"])));
    }
    let is_pair = |sample: &Tree| match sample {
        Tree::List(two) => {
            two.len() == 2 && two.iter().all(|m| m.numbers().is_some_and(|n| n.len() == 16))
        }
        _ => false,
    };
    Ok(samples.iter().all(is_pair).then(|| moveit(source, ["*.0", "*.1"])))
}

fn easy_handeye(
    source: &Path,
    tree: &Tree,
    samples: &[Tree],
    declared: &Declared,
) -> Result<Described, Error> {
    let wrong =
        samples.iter().position(|s| s.get("robot").is_none() || s.get("tracking").is_none());
    if let Some(k) = wrong {
        return Err(unusable(source, format!("sample {} has no `robot` and `tracking`", k + 1)));
    }
    let own = tree.get("parameters").and_then(ros::setup_of);
    let setup = own.or(declared.setup).ok_or_else(|| {
        let question = format!(
            "{WHO_CARRIES} The file has no parameters.calibration_type, and the robot's poses have opposite \
             directions in the two"
        );
        undeclared(source, "--setup", &question)
    })?;
    let direction = match setup {
        Setup::EyeInHand => RobotDirection::BaseFromFlange,
        Setup::EyeToHand => RobotDirection::FlangeFromBase,
    };
    let (folder, file) = split(source);
    let draft =
        tables(&file, ["samples.*.robot", "samples.*.tracking"], "quaternion-xyzw", direction);
    Ok(Described {
        layout: "easy_handeye2 samples",
        folder,
        setup: Some(setup),
        draft,
        questions: vec![],
        notes: vec![],
    })
}

fn moveit(source: &Path, fields: [&str; 2]) -> Described {
    let (folder, file) = split(source);
    let draft = tables(&file, fields, "matrix4x4", RobotDirection::BaseFromFlange);
    Described {
        layout: "moveit_calibration samples",
        folder,
        setup: None,
        draft,
        questions: vec![],
        notes: vec![],
    }
}

/// `[robot]` and `[board_poses]`, which stand in the same file.
fn tables(file: &str, fields: [&str; 2], notation: &str, direction: RobotDirection) -> Draft {
    let [robot, board] = fields.map(|field| Some(Fields::One(field.into())));
    let mut draft = Draft::new();
    draft.manifest.robot = Some(RobotSpec {
        poses: file.into(),
        field: robot,
        notation: Some(notation.into()),
        length_unit: Some(LengthUnit::Metre),
        direction: Some(direction),
        ..RobotSpec::default()
    });
    draft.manifest.board_poses = Some(BoardPosesSpec {
        poses: file.into(),
        field: board,
        notation: Some(notation.into()),
        length_unit: Some(LengthUnit::Metre),
        direction: Some(BoardDirection::CameraFromTarget),
        ..BoardPosesSpec::default()
    });
    draft
}
