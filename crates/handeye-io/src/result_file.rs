//! A result: the calibration.json of a calibration, or a mere pose of the camera, which `import` writes.

use std::path::Path;

use handeye::{Base, Calibration, Camera, Flange, Pose, Setup, unjudged};
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::{
    Error,
    error::{in_json, unusable},
    files,
};

/// Reads a calibration.json, by its name or by that of the folder that holds it, or the pose of the camera on the flange
/// or in the base as JSON. A pose has no data to be judged by: its calibration is [`Calibration::is_unjudged`], without any covariance.
///
/// # Errors
/// What cannot be read, or is neither; with the line.
pub fn read_result(path: &Path) -> Result<Calibration, Error> {
    let in_folder = path.join("calibration.json");
    let path = if in_folder.is_file() { &in_folder } else { path };
    let text = files::text(path)?;
    match serde_json::from_str::<Value>(&text) {
        Ok(value) if value.get("translation_m").is_some() => pose(&text, &value, path),
        _ => read(&text, "is no calibration.json of handeye: ", path),
    }
}

fn pose(text: &str, value: &Value, path: &Path) -> Result<Calibration, Error> {
    match value.get("to").and_then(Value::as_str) {
        Some(to) if to == Setup::EyeToHand.mount() => {
            let pose: Pose<Base, Camera> = read(text, "", path)?;
            Ok(unjudged(Setup::EyeToHand, Pose::claim(*pose.iso())))
        }
        Some(to) if to == Setup::EyeInHand.mount() => {
            let pose: Pose<Flange, Camera> = read(text, "", path)?;
            Ok(unjudged(Setup::EyeInHand, Pose::claim(*pose.iso())))
        }
        _ => {
            let what = "is a pose that does not say whose: \"to\" must be \"flange\" (the robot carries the camera) \
                        or \"base\", and \"from\" \"camera\"";
            Err(unusable(path, what))
        }
    }
}

fn read<T: DeserializeOwned>(text: &str, named: &str, path: &Path) -> Result<T, Error> {
    serde_json::from_str(text).map_err(|e| in_json(path, &e, named))
}
