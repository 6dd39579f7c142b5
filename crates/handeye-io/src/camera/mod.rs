//! Intrinsics as calibration tools write them.

mod found;
mod numpy;
mod trees;
mod visp;

use std::path::Path;

use handeye::{Distortion, Intrinsics, LensSigma, intrinsics::LensModel};
use serde::{Deserialize, Serialize};

use crate::{
    error::{Error, Place, malformed},
    files,
    tree::Tree,
};
use found::Found;
pub(crate) use trees::Maker;

/// The intrinsics of a manifest: a file, or the values themselves, or both.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CameraSpec {
    /// ROS camera_info, OpenCV FileStorage, Kalibr camchain, ViSP XML, JSON or NPZ.
    pub(crate) file: Option<String>,
    /// Which of the file's cameras.
    pub(crate) camera: Option<String>,
    /// Pixels in a row of the images.
    pub(crate) width: Option<u32>,
    /// Rows of the images.
    pub(crate) height: Option<u32>,
    pub(crate) fx: Option<f64>,
    pub(crate) fy: Option<f64>,
    pub(crate) cx: Option<f64>,
    pub(crate) cy: Option<f64>,
    /// none, plumb_bob (OpenCV's 4, 5, 8 or 12 coefficients), rational_polynomial, or equidistant (a fisheye lens).
    pub(crate) distortion_model: Option<String>,
    /// Its coefficients, in OpenCV's order.
    pub(crate) distortion: Option<Vec<f64>>,
    /// Width of the images over the calibrated width.
    pub(crate) resized: Option<f64>,
    /// Standard deviation of the given focal length, where the calibration states it. Data that say otherwise are then
    /// wrong; without it the data may move the intrinsics.
    pub(crate) focal_sigma_px: Option<f64>,
    /// Standard deviation of the given principal point per axis, likewise.
    pub(crate) center_sigma_px: Option<f64>,
    /// Model of the lens to calibrate from the views; beside given intrinsics, to check them.
    pub(crate) calibrate: Option<LensModel>,
}

impl CameraSpec {
    /// The intrinsics of a file.
    pub(crate) fn of_file(name: impl Into<String>) -> Self {
        Self { file: Some(name.into()), ..Self::default() }
    }

    /// Whether nothing is given but the wish to calibrate, and perhaps the size of the images.
    pub(crate) fn is_open(&self) -> bool {
        let Self { width, height, calibrate, .. } = *self;
        let nothing = Self { width, height, calibrate, ..Self::default() };
        self.calibrate.is_some() && *self == nothing
    }

    /// How well the intrinsics are known, in pixels of the images.
    pub(crate) fn sigma(&self) -> Result<Option<LensSigma>, String> {
        let all =
            [("focal_sigma_px", self.focal_sigma_px), ("center_sigma_px", self.center_sigma_px)];
        for (key, px) in all.iter().filter_map(|(key, px)| Some((key, (*px)?))) {
            if !(px > 0.0 && px < MOST_SIGMA_PX) {
                return Err(format!(
                    "{key} = {px} is no standard deviation of an intrinsic parameter"
                ));
            }
        }
        let scale = self.resized.unwrap_or(1.0);
        let [focal_px, center_px] = all.map(|(_, px)| px.map(|px| px * scale));
        let stated = focal_px.is_some() || center_px.is_some();
        Ok(stated.then_some(LensSigma { focal_px, center_px }))
    }
}

/// A lens that is known no better is not calibrated, px.
const MOST_SIGMA_PX: f64 = 1000.0;
/// Images may differ from the calibrated size by the rounding of a resize, px.
const ROUNDING_PX: u32 = 1;

/// The intrinsics for images of size `picture`, if that is known.
pub(crate) fn read(
    spec: &CameraSpec,
    root: &Path,
    place: &Place,
    picture: Option<(u32, u32)>,
) -> Result<Intrinsics, Error> {
    let found = match &spec.file {
        Some(file) => in_file(&root.join(file), spec.camera.as_deref())?.overridden_by(spec),
        None => Found::default().overridden_by(spec),
    };
    let camera = resized(found.intrinsics(place, picture, spec.resized)?, spec, picture, place)?;
    camera.check().map_err(|source| Error::Values { place: place.clone(), source })?;
    Ok(camera)
}

/// Reads the intrinsics of a calibration file; `camera` names one of several in it, `picture` is
/// the size of the images, for files that do not say it.
///
/// # Errors
/// What is no calibration, holds several cameras, or leaves the distortion model or the size open.
pub fn read_intrinsics(
    path: &Path,
    camera: Option<&str>,
    picture: Option<(u32, u32)>,
) -> Result<Intrinsics, Error> {
    let camera = camera.map(String::from);
    let file = Some(path.to_string_lossy().into_owned());
    let spec = CameraSpec { file, camera, ..CameraSpec::default() };
    read(&spec, Path::new(""), &Place::file(path), picture)
}

/// The intrinsics that the keys of `[camera]` of a manifest give, as JSON; `picture` is the size of the images, where the keys
/// and the file that they name do not say it.
///
/// # Errors
/// What is no intrinsics, or says more than intrinsics do; [`Error::Undeclared`] where the size is open.
pub fn intrinsics_from_json(text: &str, picture: Option<(u32, u32)>) -> Result<Intrinsics, Error> {
    let place = Place::file(Path::new("intrinsics"));
    let advice = "give the keys of [camera] of a manifest, such as fx, fy, cx, cy";
    let spec: CameraSpec = serde_json::from_str(text)
        .map_err(|e| malformed(place.clone(), format!("no intrinsics: {e}"), advice))?;
    if spec.calibrate.is_some() || spec.focal_sigma_px.is_some() || spec.center_sigma_px.is_some() {
        let what = "intrinsics alone are taken here, without `calibrate` and standard deviations";
        return Err(malformed(place, what, "leave these keys out"));
    }
    read(&spec, Path::new(""), &place, picture)
}

/// What the file of the intrinsics says of the camera itself.
pub(crate) fn maker(spec: &CameraSpec, root: &Path) -> Result<Maker, Error> {
    let Some(file) = &spec.file else { return Ok(Maker::default()) };
    let path = root.join(file);
    if files::extension(&path) == "npz" {
        return Ok(Maker::default());
    }
    Ok(trees::maker(&Tree::read(&path)?, spec.camera.as_deref()))
}

fn in_file(path: &Path, camera: Option<&str>) -> Result<Found, Error> {
    if files::extension(path) == "npz" {
        return numpy::intrinsics(path);
    }
    let tree = Tree::read(path)?;
    match visp::intrinsics(&tree, path)? {
        Some(found) => Ok(found),
        None => trees::intrinsics(&tree, camera, path),
    }
}

/// Scales to the images' size where the manifest says they were resized.
fn resized(
    camera: Intrinsics,
    spec: &CameraSpec,
    picture: Option<(u32, u32)>,
    place: &Place,
) -> Result<Intrinsics, Error> {
    let factor = spec.resized.unwrap_or(1.0);
    if !(0.01..=100.0).contains(&factor) {
        return Err(malformed(
            place.clone(),
            format!("resized = {factor}"),
            "give image width / calibrated width",
        ));
    }
    let camera = if factor == 1.0 { camera } else { camera.resized(factor) };
    let Some((width, height)) = picture else { return Ok(camera) };
    if camera.width.abs_diff(width) > ROUNDING_PX || camera.height.abs_diff(height) > ROUNDING_PX {
        let ratio = f64::from(width) / f64::from(camera.width) * factor;
        return Err(malformed(
            place.clone(),
            format!(
                "the intrinsics are for {} x {} pixels, but the images have {width} x {height}",
                camera.width, camera.height
            ),
            format!(
                "if the images were resized, say resized = {ratio:.4}; if they were cropped, \
                 calibrate again"
            ),
        ));
    }
    Ok(Intrinsics { width, height, ..camera })
}

/// Distortion of a model's usual name and its coefficients.
pub(crate) fn distortion(
    model: Option<&str>,
    k: &[f64],
    place: &Place,
) -> Result<Distortion, Error> {
    let wrong = |what: String, advice: &str| Err(malformed(place.clone(), what, advice));
    if k.iter().all(|x| *x == 0.0) {
        return Ok(Distortion::None);
    }
    match model.map(|m| m.to_lowercase().replace([' ', '-'], "_")).as_deref() {
        Some("equidistant" | "fisheye" | "kannala_brandt" | "kannalabrandt" | "kb4") => match *k {
            [a, b, c, d] => Ok(Distortion::KannalaBrandt([a, b, c, d])),
            _ => wrong(format!("{} coefficients for the equidistant model", k.len()), "it has 4"),
        },
        Some("none") => {
            wrong("distortion_model = \"none\" with coefficients".into(), "say the model")
        }
        Some(
            "plumb_bob"
            | "radtan"
            | "brown_conrady"
            | "rational_polynomial"
            | "opencv_standard"
            | "opencv"
            | "thin_prism",
        ) => brown_conrady(k, place),
        Some(other) => wrong(
            format!("the distortion model \"{other}\" is not known"),
            "there are none, plumb_bob, rational_polynomial and equidistant; or calibrate again",
        ),
        None if k.len() == 4 => Err(Error::Undeclared {
            place: place.clone(),
            key: "distortion_model".into(),
            question: "are the 4 coefficients k1 k2 p1 p2 (\"plumb_bob\") or those of a fisheye \
                       lens (\"equidistant\")?"
                .into(),
        }),
        None => brown_conrady(k, place),
    }
}

/// OpenCV's order; a tilted sensor is not modelled.
fn brown_conrady(k: &[f64], place: &Place) -> Result<Distortion, Error> {
    let tilted = k.len() == 14 && k[12..].iter().any(|t| *t != 0.0);
    if tilted || !matches!(k.len(), 1 | 2 | 4 | 5 | 8 | 12 | 14) {
        let what = format!("{} distortion coefficients", k.len());
        let advice = "4, 5, 8 or 12 in OpenCV's order are understood (a tilted sensor is not)";
        return Err(malformed(place.clone(), what, advice));
    }
    let mut all = [0.0; 12];
    all.iter_mut().zip(k).for_each(|(to, from)| *to = *from);
    Ok(Distortion::BrownConrady(all))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_coefficients_without_a_model_are_a_question() {
        let message = distortion(None, &[0.1, 0.0, 0.0, 0.0], &Place::default()).unwrap_err();
        assert!(
            message.to_string().contains("distortion_model is missing; are the 4 coefficients")
        );
    }

    #[test]
    fn zeros_are_no_distortion() {
        assert_eq!(distortion(None, &[0.0; 4], &Place::default()).unwrap(), Distortion::None);
    }

    #[test]
    fn pictures_of_another_size_are_refused_with_the_factor() {
        let camera = Intrinsics::pinhole(1920, 1080, 1500.0, 1500.0, 960.0, 540.0);
        let spec = CameraSpec::default();
        let error = resized(camera, &spec, Some((1280, 720)), &Place::default()).unwrap_err();
        assert!(error.to_string().contains("say resized = 0.6667"), "{error}");
        let spec = CameraSpec { resized: Some(0.6667), ..spec };
        let small = resized(camera, &spec, Some((1280, 720)), &Place::default()).unwrap();
        assert_eq!((small.width, small.height), (1280, 720));
    }
}
