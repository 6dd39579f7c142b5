//! What a file says of a camera, before it is complete.

use handeye::Intrinsics;

use super::{CameraSpec, distortion};
use crate::error::{Error, Place, malformed};

#[derive(Debug, Clone, Default)]
pub(super) struct Found {
    pub(super) size: (Option<u32>, Option<u32>),
    pub(super) fx: Option<f64>,
    pub(super) fy: Option<f64>,
    pub(super) cx: Option<f64>,
    pub(super) cy: Option<f64>,
    pub(super) model: Option<String>,
    pub(super) distortion: Vec<f64>,
}

/// A skew above this fraction of the focal length is more than a rounding error.
const MOST_SKEW: f64 = 1e-6;

impl Found {
    /// From a 3x3 camera matrix, row by row.
    pub(super) fn from_matrix(k: &[f64], place: &Place) -> Result<Found, Error> {
        let wrong = |what: String, advice: &str| Err(malformed(place.clone(), what, advice));
        let &[fx, skew, cx, zero, fy, cy, ..] = k else {
            return wrong(format!("a camera matrix of {} numbers", k.len()), "it has 9");
        };
        if k.len() != 9 || k[6..] != [0.0, 0.0, 1.0] || zero != 0.0 {
            return wrong("is no camera matrix".into(), "it is fx 0 cx, 0 fy cy, 0 0 1");
        }
        if skew.abs() > MOST_SKEW * fx.abs() {
            return wrong(
                format!("the camera matrix has a skew of {skew}"),
                "calibrate without skew",
            );
        }
        let (fx, fy, cx, cy) = (Some(fx), Some(fy), Some(cx), Some(cy));
        Ok(Found { fx, fy, cx, cy, ..Found::default() })
    }

    /// Values of the manifest go before the file's.
    pub(super) fn overridden_by(self, spec: &CameraSpec) -> Found {
        Found {
            size: (spec.width.or(self.size.0), spec.height.or(self.size.1)),
            fx: spec.fx.or(self.fx),
            fy: spec.fy.or(self.fy),
            cx: spec.cx.or(self.cx),
            cy: spec.cy.or(self.cy),
            model: spec.distortion_model.clone().or(self.model),
            distortion: spec.distortion.clone().unwrap_or(self.distortion),
        }
    }

    /// Complete intrinsics; a size that is not said is the images', before they were resized.
    pub(super) fn intrinsics(
        &self,
        place: &Place,
        picture: Option<(u32, u32)>,
        resized: Option<f64>,
    ) -> Result<Intrinsics, Error> {
        let needed = |value: Option<f64>, key: &str| {
            value.ok_or_else(|| missing(place, key, "which value did the calibration find?"))
        };
        let before = |n: u32| (f64::from(n) / resized.unwrap_or(1.0)).round() as u32;
        let size = |value: Option<u32>, seen: Option<u32>, key: &str| {
            let question = "for which size of image, in pixels, was the camera calibrated?";
            value.or(seen.map(before)).ok_or_else(|| missing(place, key, question))
        };
        Ok(Intrinsics {
            width: size(self.size.0, picture.map(|p| p.0), "width")?,
            height: size(self.size.1, picture.map(|p| p.1), "height")?,
            fx: needed(self.fx, "fx")?,
            fy: needed(self.fy, "fy")?,
            cx: needed(self.cx, "cx")?,
            cy: needed(self.cy, "cy")?,
            distortion: distortion(self.model.as_deref(), &self.distortion, place)?,
        })
    }
}

fn missing(place: &Place, key: &str, question: &str) -> Error {
    Error::Undeclared { place: place.clone(), key: key.into(), question: question.into() }
}
