//! What rests on a position of the camera that the user measured.

use super::{
    agreement::Views,
    candidates::{pairs_of, stated_covariance},
};
use crate::{
    Warning,
    calibrate::result::Calibration,
    estimate::{self, JointFit, Problem},
    mistakes,
};

/// Squared distance in standard deviations at which a known position contradicts the data.
const CONTRADICTS: f64 = 12.0;

/// Says what rests on a position that the user gave, or that the data disagree with it.
pub(super) fn judge(
    whole: &Problem,
    best: &JointFit,
    views: &Views,
    known_noise: &estimate::KnownNoise,
    result: &mut Calibration,
) {
    let Some(known) = &whole.known_position else { return };
    let without = Problem { known_position: None, ..whole.clone() };
    let fit = estimate::joint::refit(&without, best, known_noise);
    let (pairs, setup) = (pairs_of(views), views.session.setup);
    let free = mistakes::free_directions(&fit);
    let x = &fit.hand_eye.mount_from_camera;
    let off = known.axis.dot(&x.translation()) - known.value_m;
    if !free.is_empty() {
        let what = mistakes::in_words(&free, &pairs, setup).join(", ");
        result.warnings.push(Warning::new(
            "determined-by-known-position",
            format!(
                "the data do not determine {what}: it rests on the `known_position` of {:.1} mm \
                 alone, and nothing checks that; touch a corner, or tilt the robot",
                known.value_m * 1e3
            ),
        ));
    } else if let Some(covariance) = stated_covariance(&fit) {
        let along = x.rotation().transpose() * known.axis;
        let own = covariance.fixed_view::<3, 3>(3, 3).into_owned();
        let variance = along.dot(&(own * along)) + known.sigma_m.powi(2);
        if off * off > CONTRADICTS * variance {
            result.warnings.push(Warning::new(
                "known-position-disagrees",
                format!(
                    "`known_position` says {:.1} mm, the data {:.1} mm: measure it again, or \
                     leave it out",
                    known.value_m * 1e3,
                    (known.value_m + off) * 1e3
                ),
            ));
        }
    }
}
