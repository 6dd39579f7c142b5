//! The proof that a calibration's least squares have no better minimum.

use super::{Calibration, CaptureResult};
use crate::{
    Error, PosePair, Warning,
    estimate::certify::{Certificate, certify},
    solve::{self, Method},
};

impl Calibration {
    /// With its certificate, or with a warning that says why there is none.
    pub fn certified(self) -> Self {
        let message = match certify_result(&self) {
            Ok(Some(found)) => return Self { certificate: Some(found), ..self },
            Ok(None) => "there is no answer, so there is nothing to certify".to_owned(),
            Err(error) => format!("the least-squares fit cannot be certified: {error}"),
        };
        self.noting([Warning::new("not-certified", message)])
    }
}

/// The certificate of a calibration, over the captures it used; where the minimum next to the
/// answer is not proven global, that next to a closed form is tried. `None` without an answer.
///
/// # Errors
/// As [`certify`].
pub fn certify_result(result: &Calibration) -> Result<Option<Certificate>, Error> {
    let Some(answer) = result.hand_eye.hand_eye() else { return Ok(None) };
    let pair = |c: &CaptureResult| {
        Some(PosePair {
            anchor_from_mount: result.setup.anchor_from_mount(c.base_from_flange),
            camera_from_target: c.camera_from_target?,
        })
    };
    let pairs: Vec<PosePair> = result.captures.iter().filter(|c| c.used).filter_map(pair).collect();
    let first = certify(&pairs, &answer)?;
    let again = || certify(&pairs, &solve::solve(&pairs, Method::Shah).ok()?).ok();
    let found =
        if first.certified { first } else { again().filter(|c| c.certified).unwrap_or(first) };
    let (x, at) = (&found.least_squares.mount_from_camera, &answer.mount_from_camera);
    Ok(Some(Certificate {
        rotation_to_answer_deg: x.angle_to(at).to_degrees(),
        translation_to_answer_mm: x.distance_to(at) * 1e3,
        ..found
    }))
}
