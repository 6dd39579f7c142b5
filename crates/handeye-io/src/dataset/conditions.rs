//! What a manifest says of the cell beside its captures: how well things are known, what the job tolerates, what stands
//! there.

use handeye::{
    LensSigma, Pose, Workspace, calibrate::result::Equipment, model::session::KnownPosition,
    tools::plan::GuessSigma,
};
use nalgebra::{Matrix3, Vector3};

use super::{
    Guess, Limits, Noise, WorkspaceBox,
    manifest::{GuessSpec, KnownPositionSpec, Manifest, NoiseSpec, WorkspaceSpec},
    opening::Opening,
};
use crate::{
    camera,
    error::{Error, malformed},
};

/// How well a camera's place is guessed, unless that is said: 6 degrees and 30 mm.
const USUAL_GUESS: GuessSigma = GuessSigma { rotation_rad: 0.1, position_m: 0.03 };
/// No camera is farther from its robot.
const FARTHEST_M: f64 = 100.0;

impl Opening {
    /// What the manifest says of camera and robot, and the file of the intrinsics of the camera.
    pub(super) fn equipment(&self) -> Result<Equipment, Error> {
        let stated = self.manifest.equipment.clone();
        let Some(spec) = &self.manifest.camera else { return Ok(stated) };
        let found = camera::maker(spec, &self.root)?;
        // YAML takes a number's leading zeros away
        let number = |serial: &str| serial.trim().trim_start_matches('0').to_lowercase();
        let serial = [&stated.camera_serial, &found.serial];
        if let [Some(of_manifest), Some(of_file)] = serial
            && number(of_manifest) != number(of_file)
        {
            let what = format!(
                "the camera has the serial number {of_manifest}, and {} holds the intrinsics of {of_file}",
                spec.file.as_deref().unwrap_or("the file")
            );
            let advice = "give the intrinsics of this camera, or correct the number";
            return Err(malformed(self.source.place("equipment.camera_serial"), what, advice));
        }
        Ok(Equipment {
            camera: stated.camera.or(found.model),
            camera_serial: stated.camera_serial.or(found.serial),
            ..stated
        })
    }

    /// How well the manifest says that the lens is known.
    pub(super) fn lens_sigma(&self) -> Result<Option<LensSigma>, Error> {
        let Some(spec) = &self.manifest.camera else { return Ok(None) };
        spec.sigma().map_err(|what| {
            malformed(
                self.source.place("camera"),
                what,
                "give the standard deviation that the calibration of the camera states, in pixels",
            )
        })
    }

    pub(super) fn workspace(&self, spec: &WorkspaceSpec) -> Result<WorkspaceBox, Error> {
        let (minimum, maximum) = (Vector3::from(spec.minimum_mm), Vector3::from(spec.maximum_mm));
        if !(0..3)
            .all(|i| minimum[i] < maximum[i] && minimum[i].is_finite() && maximum[i].is_finite())
        {
            return Err(malformed(
                self.source.place("workspace"),
                "minimum_mm is not below maximum_mm",
                "give two opposite corners of the box",
            ));
        }
        let corners = Workspace { minimum: minimum / 1000.0, maximum: maximum / 1000.0 };
        Ok(WorkspaceBox { frame: spec.frame, corners })
    }

    /// The camera's place as a person guesses it.
    pub(super) fn guess(&self, spec: &GuessSpec) -> Result<Guess, Error> {
        let wrong = |what: &str, advice: &str| {
            malformed(self.source.place("guess"), what.to_owned(), advice.to_owned())
        };
        let [axis, right] = [spec.optical_axis, spec.image_x].map(Vector3::from);
        let z = axis.try_normalize(1e-9);
        let x = z.and_then(|z| (right - z * z.dot(&right)).try_normalize(1e-3));
        let (Some(z), Some(x)) = (z, x) else {
            return Err(wrong(
                "optical_axis and image_x are not two directions",
                "optical_axis = [0, 0, 1], image_x = [1, 0, 0] is a camera that looks along z, with x to the right of its image",
            ));
        };
        let rotation = self.positive("guess.sigma_deg", spec.sigma_deg, 1f64.to_radians())?;
        let position = self.positive("guess.sigma_mm", spec.sigma_mm, 1e-3)?;
        let sigma = GuessSigma {
            rotation_rad: rotation.unwrap_or(USUAL_GUESS.rotation_rad),
            position_m: position.unwrap_or(USUAL_GUESS.position_m),
        };
        let position = Vector3::from(spec.translation_mm) * 1e-3;
        if !position.iter().all(|p| p.abs() < FARTHEST_M) {
            return Err(wrong("is no position of a camera", "give millimetres"));
        }
        let rotation = Matrix3::from_columns(&[x, z.cross(&x), z]);
        Ok(Guess { mount_from_camera: Pose::from_parts(&rotation, position), sigma })
    }

    pub(super) fn known_position(&self, spec: &KnownPositionSpec) -> Result<KnownPosition, Error> {
        let axis = Vector3::from(spec.axis).try_normalize(1e-9).filter(|a| a.norm().is_finite());
        let axis = axis.ok_or_else(|| {
            malformed(
                self.source.place("known_position.axis"),
                "the axis has no length",
                "give a direction of the body that carries the camera, such as [0, 0, 1]",
            )
        })?;
        if !spec.value_mm.is_finite() {
            let what = "value_mm is not a number";
            let advice = "give the camera's position along the axis, mm";
            return Err(malformed(self.source.place("known_position.value_mm"), what, advice));
        }
        let sigma = self.positive("known_position.sigma_mm", Some(spec.sigma_mm), 1e-3)?;
        let sigma_m = sigma.unwrap_or(1e-3);
        Ok(KnownPosition { axis, value_m: spec.value_mm * 1e-3, sigma_m })
    }

    pub(super) fn noise(&self, spec: &NoiseSpec) -> Result<Noise, Error> {
        let positive = |key: &str, value: Option<f64>, unit: f64| {
            self.positive(&format!("noise.{key}"), value, unit)
        };
        Ok(Noise {
            image_px: positive("image_px", spec.image_px, 1.0)?,
            robot_position: positive("robot_position_mm", spec.robot_position_mm, 1e-3)?,
            robot_rotation: positive(
                "robot_rotation_deg",
                spec.robot_rotation_deg,
                1f64.to_radians(),
            )?,
            depth: positive("depth_mm", spec.depth_mm, 1e-3)?,
            touch: positive("touch_mm", spec.touch_mm, 1e-3)?,
            tip: positive("tip_mm", spec.tip_mm, 1e-3)?,
        })
    }

    pub(super) fn limits(&self, m: &Manifest) -> Result<Limits, Error> {
        let of_limits = self.positive("limits.max_error_mm", m.limits.max_error_mm, 1e-3)?;
        let of_answer = self.positive("answer.max_error_mm", m.answer.max_error_mm, 1e-3)?;
        if of_limits.is_some() && of_answer.is_some() {
            return Err(malformed(
                self.source.place("limits.max_error_mm"),
                "max_error_mm stands under [limits] and under [answer]",
                "leave one of them out",
            ));
        }
        Ok(Limits { max_error: of_answer.or(of_limits) })
    }

    fn positive(&self, key: &str, value: Option<f64>, unit: f64) -> Result<Option<f64>, Error> {
        match value {
            Some(v) if !(v.is_finite() && v > 0.0) => Err(malformed(
                self.source.place(key),
                format!("{v} is not positive"),
                "correct it, or leave it out",
            )),
            _ => Ok(value.map(|v| v * unit)),
        }
    }
}
