//! Whether the answer can be used.

use super::prior::SIZE;
use crate::{
    Camera, Mount, Pose, TargetSize,
    calibrate::{
        config::Config,
        result::{Answer, Calibration, Determined, Scale},
        views::Views,
    },
    estimate::{JointFit, noise::Source},
    findings::{
        TargetFinding,
        target::{Size, SizeOfAnswer},
    },
    math::statistics,
    mistakes,
    model::{session::Session, verdict::Verdict},
    quaternion_xyzw,
};

/// Predicted error (95 %) beyond which an answer is rejected when the user named no limit, mm.
const MOST_PREDICTED_MM: f64 = 10.0;

/// Misfit of captures that were left out beyond which an answer is rejected: no robot and camera
/// in working order are that far apart. mm and degrees.
const MOST_HELD_OUT: (f64, f64) = (15.0, 2.5);

/// Captures from which on those left out say something of the others.
const FEWEST_HELD_OUT: usize = 5;

/// Share of the captures that must agree.
const LEAST_AGREEING: f64 = 0.5;

/// Wrong size of the target that is beyond any printer: the declared size or the focal length is
/// wrong, and so is every distance.
const MOST_SCALE_ERROR: f64 = 0.03;

/// Scale errors of measured distances below this part are within what cameras and their targets do.
const LEAST_SCALE_ERROR: f64 = 0.005;

/// Chance of a scale as far from one as it is below which it is called wrong.
const IMPROBABLE_SCALE: f64 = 1e-3;

/// The verdict: reasons against the answer first.
pub(super) fn conclude(config: &Config, result: &mut Calibration) {
    let contradictions = contradictions(result);
    if result.verdict == Verdict::Rejected || !contradictions.is_empty() {
        // data that contradict themselves leave nothing to determine
        result.undetermined.clear();
        result.determined = None;
        result.reasons.extend(contradictions);
        result.verdict = Verdict::Rejected;
        return;
    }
    let imprecise = imprecision(config, result);
    result.verdict =
        if result.hand_eye.mount_from_camera.is_none() || !result.undetermined.is_empty() {
            hide_undetermined(result);
            Verdict::Undetermined
        } else if imprecise.is_empty() {
            Verdict::Accepted
        } else {
            result.reasons.extend(imprecise);
            Verdict::Rejected
        };
    if result.verdict == Verdict::Accepted
        && let Some(tre) = &result.predicted_tre_mm
    {
        result.reasons.push(tre.in_words());
    }
}

/// No invented number for what the data do not determine.
fn hide_undetermined(result: &mut Calibration) {
    if result.undetermined.is_empty() {
        return;
    }
    if result.reasons.is_empty() {
        result.reasons.push(format!(
            "the data do not determine {}: tilt the robot by 30 degrees and more about two axes, \
             {}or give the position along that direction as `known_position`",
            result.undetermined.join(", "),
            if has_corners(result) { "or touch corners, " } else { "" }
        ));
    }
    result.hand_eye = Answer::default();
    for candidate in &mut result.candidates {
        (candidate.hand_eye, candidate.predicted_tre_mm) = (Answer::default(), None);
    }
    result.predicted_tre_mm = None;
    result.why = String::from("no candidate can make up for what is not determined");
    result.error_budget.iter_mut().for_each(|b| b.at_workpiece_mm = None);
    result.advice.clear();
}

/// Whether the target has corners that could be touched.
fn has_corners(result: &Calibration) -> bool {
    result.captures.iter().any(|c| c.corners + c.corners_3d > 0)
}

/// What is known of a pose of which something is free.
pub(super) fn determined(x: &Pose<Mount, Camera>, free: &[mistakes::Free]) -> Determined {
    let along = |is_rotation: bool| {
        free.iter().filter(move |f| f.is_rotation == is_rotation).map(|f| f.axis)
    };
    let t = x.translation();
    let across = along(false).fold(t, |t, axis| t - axis * axis.dot(&t));
    // a rotation that is free swings the camera about: no position is left
    let turns = along(true).next().is_some();
    Determined {
        rotation_xyzw: (!turns).then(|| quaternion_xyzw(&x.iso().rotation)),
        translation_across_m: (!turns).then(|| across.into()),
        free_rotations: along(true).map(Into::into).collect(),
        free_translations: along(false).map(Into::into).collect(),
    }
}

/// What the data say against themselves.
pub(super) fn contradictions(result: &Calibration) -> Vec<String> {
    let mut against = Vec::new();
    let used = result.captures.iter().filter(|c| c.used).count();
    let seen = used + result.rejected.len();
    if seen > 0 && used > 0 && (used as f64) < LEAST_AGREEING * seen as f64 {
        against.push(format!(
            "only {used} of {seen} captures agree: captures and robot poses may be out of order, or \
             the pose notation is declared wrongly"
        ));
    }
    let (mm, deg) = (result.held_out.translation_rms_mm, result.held_out.rotation_rms_deg);
    // what is left of very few captures hardly determines an answer, and misses by rights
    if used < FEWEST_HELD_OUT {
        return against;
    }
    if mm.is_some_and(|mm| mm > MOST_HELD_OUT.0) || deg.is_some_and(|deg| deg > MOST_HELD_OUT.1) {
        against.push(format!(
            "the leave-one-out residual is {:.1} mm and {:.2} degrees (RMS), far beyond a robot and a camera in order: check order, notation, direction and setup of the poses",
            mm.unwrap_or(f64::NAN),
            deg.unwrap_or(f64::NAN)
        ));
    }
    against
}

/// Why the answer is not sure enough.
fn imprecision(config: &Config, result: &Calibration) -> Vec<String> {
    let limit = config.max_error_mm.unwrap_or(MOST_PREDICTED_MM);
    match &result.predicted_tre_mm {
        Some(tre) if tre.p95 <= limit => vec![],
        Some(tre) => vec![format!(
            "the predicted error (95 %) in {} is {:.2} mm, more than {limit} mm: add captures with \
             more tilt{}",
            tre.r#where,
            tre.p95,
            if has_corners(result) { ", or touches" } else { "" }
        )],
        None if result.hand_eye.mount_from_camera.is_none() => vec![],
        None => vec!["too little data to predict an error: add captures or touches".into()],
    }
}

/// The robot moved farther than this many standard deviations of its own position.
const TRAVELS: f64 = 10.0;

/// Whether the robot's positions say anything of lengths: one that only turned about its flange does
/// not, and its noise would be taken for lengths.
fn travels(views: &Views, fit: &JointFit) -> bool {
    let places: Vec<_> = views.used.iter().map(|o| o.base_from_flange.translation()).collect();
    let count = places.len().max(1) as f64;
    let middle = places.iter().sum::<nalgebra::Vector3<f64>>() / count;
    let squares: f64 = places.iter().map(|p| (p - middle).norm_squared()).sum();
    let sigma = fit.noise.sigma(Source::RobotPosition).unwrap_or(0.0);
    (squares / count).sqrt() > TRAVELS * sigma
}

/// The size of the target as all data have it, and whether the answer rests on it.
pub(super) fn judge_size(
    views: &Views,
    (by_views, best): (&JointFit, &JointFit),
    (declared, as_declared): (f64, f64),
    config: &Config,
    result: &mut Calibration,
) {
    if config.unknown.scale || views.views.len() < 5 || result.verdict == Verdict::Rejected {
        return;
    }
    if !travels(views, by_views) {
        return;
    }
    let found = mistakes::target_scale(&views.views, by_views, &config.known, views.session.setup);
    let Some(mistakes::TargetScale { value, sigma, .. }) = found else { return };
    let used = as_declared < 0.5;
    // how far the target that the views are about is from the declared one already
    let (value, sigma) = (value * declared, sigma * declared);
    result.target_scale = Some(Scale { value, sigma, used });
    let answer =
        best.extra(SIZE).map_or((value, sigma), |(x, s)| (declared * (1.0 + x), declared * s));
    let dof = (by_views.degrees_of_freedom - 1.0).max(1.0);
    let p_value = statistics::of_f(((value - 1.0) / sigma).powi(2), (1.0, dof));
    let off = (value - 1.0).abs();
    let improbable = p_value < IMPROBABLE_SCALE;
    let told = match (&views.session.target, views.session.target_size) {
        _ if used => SizeOfAnswer::Estimated,
        // distances that came from elsewhere are taken as they are: small errors of scale are left to the user
        (None, _) if off > LEAST_SCALE_ERROR && improbable => SizeOfAnswer::Declared,
        // beyond what the prior of a printed target reaches
        (Some(_), TargetSize::Printed) if off > MOST_SCALE_ERROR && improbable => {
            SizeOfAnswer::Declared
        }
        (Some(_), TargetSize::Measured(_)) if improbable => SizeOfAnswer::Measured,
        _ => return,
    };
    let (value, sigma) = if used { answer } else { (value, sigma) };
    result.target_scale = Some(Scale { value, sigma, used });
    let finding = size_finding(views.session, declared, (value, sigma), told);
    if (value - 1.0).abs() > MOST_SCALE_ERROR {
        result.reasons.push(finding.message());
        result.verdict = Verdict::Rejected;
    }
    result.warnings.push(finding.into());
}

/// Of the session's target, which is `resized` times as large as the declared one.
fn size_finding(
    session: &Session,
    resized: f64,
    (value, sigma): (f64, f64),
    answer: SizeOfAnswer,
) -> TargetFinding {
    let Some(target) = &session.target else { return TargetFinding::Distances { value, sigma } };
    TargetFinding::Size(Size {
        value,
        sigma,
        declared_mm: target.pitch_m() * 1e3 / resized,
        cause: mistakes::cause_of_size(value, target),
        beyond_printing: (value - 1.0).abs() > MOST_SCALE_ERROR,
        answer,
    })
}
