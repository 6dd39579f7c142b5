//! Touches that lie nowhere near the views' answer: not a few that slipped, but all in a wrong unit
//! or frame.

use super::agreement::Views;
use crate::{
    calibration::{Calibration, Verdict},
    diagnose,
    refine::JointFit,
    solve::consensus::median,
    touches::{self, TouchPairs},
};

/// Median distance (m) between touches and the views' answer that no wrong tip and no wrong corner
/// makes.
const ASTRAY: f64 = 1.0;

/// Rejects a session whose touches lie metres from where its views put their corners; whether they
/// do. Views that leave a direction free cannot say.
pub(super) fn astray(
    views: &Views,
    fit: &JointFit,
    paired: &[TouchPairs],
    result: &mut Calibration,
) -> bool {
    if paired.is_empty() || !diagnose::free_directions(fit).is_empty() {
        return false;
    }
    let x = &fit.hand_eye.mount_from_camera;
    let distances: Vec<f64> =
        paired.iter().map(|touch| touches::touch_error(touch, x).norm()).collect();
    let (typical, most) =
        (median(distances.clone()), distances.iter().copied().fold(0.0, f64::max));
    if typical < ASTRAY {
        return false;
    }
    result.reasons.push(format!(
        "the touches lie {typical:.1} m (median; up to {most:.1} m) from where the {} views put their \
         corners: check the length unit of [touches], the same for every column, that their \
         coordinates are in the robot's base, and the tip",
        views.views.len()
    ));
    result.verdict = Verdict::Rejected;
    true
}
