//! What rests on a position of the camera that the user measured.

use crate::{
    calibrate::{
        flow::views::{Views, pairs_of},
        prediction::answers::stated_covariance,
    },
    estimate::{self, JointFit, Problem},
    findings::RobotFinding,
    mistakes,
};

/// Squared distance in standard deviations at which a known position contradicts the data.
const CONTRADICTS: f64 = 12.0;

/// What rests on a position that the user gave, or that the data disagree with it.
pub(crate) fn judge(
    whole: &Problem,
    best: &JointFit,
    views: &Views,
    known_noise: &estimate::KnownNoise,
) -> Option<RobotFinding> {
    let known = whole.known_position.as_ref()?;
    let without = Problem { known_position: None, ..whole.clone() };
    let fit = estimate::joint::refit(&without, best, known_noise);
    let (pairs, setup) = (pairs_of(views), views.session.setup);
    let free = mistakes::free_directions(&fit);
    let x = &fit.hand_eye.mount_from_camera;
    let off = known.axis.dot(&x.translation()) - known.value_m;
    if !free.is_empty() {
        let what = mistakes::in_words(&free, &pairs, setup).join(", ");
        let given_mm = known.value_m * 1e3;
        return Some(RobotFinding::DeterminedByKnownPosition { what, given_mm });
    }
    let along = x.rotation().transpose() * known.axis;
    let own = stated_covariance(&fit)?.fixed_view::<3, 3>(3, 3).into_owned();
    let variance = along.dot(&(own * along)) + known.sigma_m.powi(2);
    let (given_mm, found_mm) = (known.value_m * 1e3, (known.value_m + off) * 1e3);
    (off * off > CONTRADICTS * variance)
        .then_some(RobotFinding::KnownPositionDisagrees { given_mm, found_mm })
}
