//! A result: the calibration.json of a calibration, or a mere pose of the camera, which `import` writes.

use std::path::Path;

use handeye::{
    Base, Calibration, Camera, Flange, Mount, Pose, Setup, calibrate::result::Rows, unjudged,
};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::Value;

use crate::{
    Error,
    error::{in_json, unusable},
    files,
};

/// Reads a calibration.json, by its name or by that of the folder that holds it, or the pose of the camera on the flange
/// or in the base as JSON. A pose has no data to be judged by: its calibration is [`Calibration::is_unjudged`], with the
/// covariance that stands beside it (`covariance`, 6 x 6), if any does.
///
/// # Errors
/// What cannot be read, or is neither; with the line.
pub fn read_result(path: &Path) -> Result<Calibration, Error> {
    let in_folder = path.join("calibration.json");
    let path = if in_folder.is_file() { &in_folder } else { path };
    let text = files::text(path)?;
    match serde_json::from_str::<Value>(&text) {
        Ok(value) if value.get("translation_m").is_some() => pose(&text, value, path),
        _ => read(&text, "is no calibration.json of handeye: ", path),
    }
}

/// The pose of a camera as JSON, and the covariance beside it: what [`read_result`] reads.
pub fn pose_file(
    setup: Setup,
    mount_from_camera: &Pose<Mount, Camera>,
    covariance: Option<&Rows>,
) -> String {
    let iso = *mount_from_camera.iso();
    let json = match setup {
        Setup::EyeToHand => {
            let pose = Pose::<Base, Camera>::claim(iso);
            serde_json::to_string_pretty(&PoseFile { pose, covariance })
        }
        Setup::EyeInHand => {
            let pose = Pose::<Flange, Camera>::claim(iso);
            serde_json::to_string_pretty(&PoseFile { pose, covariance })
        }
    };
    json.unwrap_or_default() + "\n"
}

/// A pose, and the covariance beside it.
#[derive(Serialize)]
struct PoseFile<'a, P> {
    #[serde(flatten)]
    pose: P,
    #[serde(skip_serializing_if = "Option::is_none")]
    covariance: Option<&'a Rows>,
}

/// What may stand beside a pose.
#[derive(Deserialize)]
struct Beside {
    #[serde(default)]
    covariance: Option<Rows>,
}

fn pose(text: &str, mut value: Value, path: &Path) -> Result<Calibration, Error> {
    let Beside { covariance } = read(text, "", path)?;
    let is_beside = value.as_object_mut().and_then(|keys| keys.remove("covariance")).is_some();
    let without = is_beside.then(|| value.to_string());
    let text = without.as_deref().unwrap_or(text);
    match value.get("to").and_then(Value::as_str) {
        Some(to) if to == Setup::EyeToHand.mount() => {
            let pose: Pose<Base, Camera> = read(text, "", path)?;
            Ok(unjudged(Setup::EyeToHand, Pose::claim(*pose.iso()), covariance))
        }
        Some(to) if to == Setup::EyeInHand.mount() => {
            let pose: Pose<Flange, Camera> = read(text, "", path)?;
            Ok(unjudged(Setup::EyeInHand, Pose::claim(*pose.iso()), covariance))
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
