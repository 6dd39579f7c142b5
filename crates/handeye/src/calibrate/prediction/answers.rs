//! Answers as candidates and results state them: their covariance, and the target about its own origin.

use nalgebra::{Matrix6, SVector};

use super::workpiece::inflation;
use crate::{
    HandEye,
    calibrate::{
        flow::{evidence::Seen, views::Views},
        optics::{self, prior::SIZE},
        result::{Answer, PoseCovariance, rows},
    },
    estimate::JointFit,
    solve::{View, least_squares::Matrix12},
};

/// The answer for files: about the target's own origin again.
pub(crate) fn stored(views: &Views, answer: &HandEye, covariance: Option<&Matrix12>) -> Answer {
    let carry = crate::math::lie::adjoint(views.target_from_corner.iso());
    let moved = answer.retarget(views.target_from_corner.inverse());
    Answer {
        mount_from_camera: Some(moved.mount_from_camera),
        anchor_from_target: Some(moved.anchor_from_target),
        covariance: PoseCovariance {
            mount_from_camera: covariance.map(|c| rows(&blocks(c).0)),
            anchor_from_target: covariance
                .map(|c| rows(&(carry * blocks(c).1 * carry.transpose()))),
        },
    }
}

/// Covariance of X and Y in their own frames, widened for noise estimated from few captures, and
/// for data that fit worse than their noise says.
pub(crate) fn stated_covariance(fit: &JointFit) -> Option<Matrix12> {
    fit.pose_covariance().zip(inflation(fit)).map(|(c, factor)| c * factor)
}

/// The views where a fit's camera puts them.
pub(crate) fn as_fitted(fit: &JointFit, views: &[View]) -> Vec<View> {
    let moved = |v: &View| View { pair: v.with(&fit.extras, &fit.values), ..v.clone() };
    views.iter().map(moved).collect()
}

/// The captures as a fit sees them.
pub(crate) fn seen_by(fit: &JointFit, views: &Views) -> Seen {
    let size = fit.extra(SIZE).map_or(1.0, |x| 1.0 + x.0);
    Seen {
        pairs: as_fitted(fit, &views.views).iter().map(|v| v.pair).collect(),
        camera: views.session.camera.map(|camera| optics::camera_of(&camera, fit)),
        target: views.session.target.as_ref().map(|target| target.resized(size)),
    }
}

/// What an answer is more uncertain than the likeliest one: their difference and the likeliest one's error are
/// independent (J. Hausman, Econometrica 46(6), 1978), and it is the only sample of its covariance.
pub(crate) fn excess(likeliest: &HandEye, answer: &HandEye) -> Matrix12 {
    let x = likeliest.mount_from_camera.local(&answer.mount_from_camera);
    let y = likeliest.anchor_from_target.local(&answer.anchor_from_target);
    let off = SVector::<f64, 12>::from_iterator(x.iter().chain(&y).copied());
    off * off.transpose()
}

pub(crate) fn blocks(covariance: &Matrix12) -> (Matrix6<f64>, Matrix6<f64>) {
    (
        covariance.fixed_view::<6, 6>(0, 0).into_owned(),
        covariance.fixed_view::<6, 6>(6, 6).into_owned(),
    )
}
