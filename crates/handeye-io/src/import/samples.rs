//! Samples of ROS programs: pairs of poses in one file.
//!
//! easy_handeye2 keeps `{parameters: {calibration_type}, samples: [{robot, tracking}]}`, or the samples alone; for a
//! camera beside the robot its `robot` is the inverse, `effector_from_base`. moveit_calibration keeps a list of
//! `{effector_wrt_world, object_wrt_sensor}`, sixteen numbers each, or of `[[4 x 4], [4 x 4]]`; who carries the camera
//! it does not say.

use std::path::Path;

use handeye::Setup;

use super::{Declared, Described, declared::WHO_CARRIES, quoted, ros, split};
use crate::{
    Error,
    error::{undeclared, unusable},
    files,
    tree::Tree,
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
        Setup::EyeInHand => "base_from_flange",
        Setup::EyeToHand => "flange_from_base",
    };
    let (folder, file) = split(source);
    let sections =
        sections(&file, ["samples.*.robot", "samples.*.tracking"], "quaternion-xyzw", direction);
    Ok(Described {
        layout: "easy_handeye2 samples",
        folder,
        setup: Some(setup),
        sections,
        questions: vec![],
        notes: vec![],
    })
}

fn moveit(source: &Path, fields: [&str; 2]) -> Described {
    let (folder, file) = split(source);
    let sections = sections(&file, fields, "matrix4x4", "base_from_flange");
    Described {
        layout: "moveit_calibration samples",
        folder,
        setup: None,
        sections,
        questions: vec![],
        notes: vec![],
    }
}

fn sections(file: &str, fields: [&str; 2], notation: &str, direction: &str) -> String {
    let file = quoted(file);
    format!(
        "\n[robot]\nposes = {file}\nfield = \"{}\"\nnotation = \"{notation}\"\nlength_unit = \"m\"\n\
         direction = \"{direction}\"\n\n[board_poses]\nposes = {file}\nfield = \"{}\"\nnotation = \"{notation}\"\n\
         length_unit = \"m\"\ndirection = \"camera_from_target\"\n",
        fields[0], fields[1]
    )
}
