//! Whether the answer can be used.
//!
//! Touches reach the verdict in three ways: when most of them contradict the images it is rejected (`touch_outliers.rs`);
//! they change the predicted error of the joint fit; they determine directions that images do not. The residual of a
//! single touch does not decide.

use super::{
    config::Config,
    evidence::{Choice, Evidence, SCALE},
    limits::{BELIEVABLE, FEWEST_HELD_OUT, LEAST_AGREEING, MOST_PREDICTED_MM},
};
use crate::{
    Camera, Mount, Pose, Setup,
    calibrate::result::{Answer, Calibration, Determined, findings::TOO_IMPRECISE},
    estimate::{evaluate::RmsResidual, predict::PredictedTre},
    mistakes,
    model::verdict::Verdict,
    quaternion_xyzw,
};

/// The result with its verdict: reasons against the answer first.
pub(crate) fn judge(setup: Setup, config: &Config, found: Evidence) -> Calibration {
    Calibration { max_error_mm: Some(limit(config)), ..judged(setup, config, found) }
}

/// Largest predicted error (95 %) that is accepted, mm.
pub(crate) fn limit(config: &Config) -> f64 {
    config.max_error_mm.unwrap_or(MOST_PREDICTED_MM)
}

fn judged(setup: Setup, config: &Config, mut found: Evidence) -> Calibration {
    let contradictions = contradictions(&found);
    if found.notes.rejects || !contradictions.is_empty() {
        // data that contradict themselves leave nothing to determine
        found.notes.undetermined.clear();
        found.determined = None;
        found.notes.reasons.extend(contradictions);
        return found.into_result(setup, Verdict::Rejected);
    }
    if found.unit_and_clock.scale.is_none() {
        found.notes.undetermined.insert(0, SCALE.into());
    }
    let imprecise = imprecision(config, &found);
    let has_answer = found.choice.as_ref().is_some_and(|c| c.hand_eye.mount_from_camera.is_some());
    if !has_answer || !found.notes.undetermined.is_empty() {
        return without_invented_numbers(found).into_result(setup, Verdict::Undetermined);
    }
    if imprecise.is_empty() {
        let tre = found.choice.as_ref().and_then(|c| c.predicted_tre_mm.as_ref());
        found.notes.reasons.extend(tre.map(PredictedTre::in_words));
        return found.into_result(setup, Verdict::Accepted);
    }
    found.notes.reasons.extend(imprecise);
    found.into_result(setup, Verdict::Rejected)
}

/// No invented number for what the data do not determine.
fn without_invented_numbers(mut found: Evidence) -> Evidence {
    let open = &found.notes.undetermined;
    if open.is_empty() {
        return found;
    }
    if found.notes.reasons.is_empty() {
        found.notes.reasons.push(format!(
            "the data do not determine {}: tilt the robot by 30 degrees and more about two axes, \
             {}or give the position along that direction as `known_position`",
            open.join(", "),
            if found.has_corners() { "or touch corners, " } else { "" }
        ));
    }
    found.choice = found.choice.map(|choice| Choice {
        hand_eye: Answer::default(),
        predicted_tre_mm: None,
        why: String::from("no candidate can make up for what is not determined"),
        ..choice
    });
    for candidate in &mut found.candidates {
        (candidate.hand_eye, candidate.predicted_tre_mm) = (Answer::default(), None);
    }
    found.error_budget.iter_mut().for_each(|b| b.at_workpiece_mm = None);
    found.advice.clear();
    found
}

/// What is known of a pose of which something is free.
pub(crate) fn determined(x: &Pose<Mount, Camera>, free: &[mistakes::Free]) -> Determined {
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
fn contradictions(found: &Evidence) -> Vec<String> {
    let held_out = found.choice.as_ref().map(|c| c.held_out).unwrap_or_default();
    contradictions_of(found.used(), found.rejected.len(), &held_out)
}

/// The same of captures that agree and are rejected, and of the leave-one-out residual.
pub(crate) fn contradictions_of(
    used: usize,
    rejected: usize,
    held_out: &RmsResidual,
) -> Vec<String> {
    let mut against = Vec::new();
    let seen = used + rejected;
    if seen > 0 && used > 0 && (used as f64) < LEAST_AGREEING * seen as f64 {
        against.push(format!(
            "only {used} of {seen} captures agree: captures and robot poses may be out of order, or \
             the pose notation is declared wrongly"
        ));
    }
    let (mm, deg) = (held_out.translation_rms_mm, held_out.rotation_rms_deg);
    // what is left of very few captures hardly determines an answer, and misses by rights
    if used < FEWEST_HELD_OUT {
        return against;
    }
    if !is_believable(held_out) {
        against.push(format!(
            "the leave-one-out residual is {:.1} mm and {:.2} degrees (RMS), much more than a working robot and camera leave: check notation, direction and order of the poses, and `setup`",
            mm.unwrap_or(f64::NAN),
            deg.unwrap_or(f64::NAN)
        ));
    }
    against
}

/// Whether a robot and a camera in working order may be that far apart.
pub(crate) fn is_believable(residual: &RmsResidual) -> bool {
    let (deg, mm) = (residual.rotation_rms_deg, residual.translation_rms_mm);
    let within = |value: Option<f64>, most: f64| value.is_none_or(|value| value <= most);
    within(deg, BELIEVABLE.degrees()) && within(mm, BELIEVABLE.millimetres())
}

/// Why the answer is not certain enough.
fn imprecision(config: &Config, found: &Evidence) -> Vec<String> {
    let limit = limit(config);
    let Some(choice) = &found.choice else { return vec![] };
    match &choice.predicted_tre_mm {
        Some(tre) if tre.p95 <= limit => vec![],
        Some(tre) => vec![format!(
            "{TOO_IMPRECISE} in {} is {:.2} mm, more than {limit} mm: add captures with \
             more tilt{}",
            tre.r#where,
            tre.p95,
            if found.has_corners() { ", or touches" } else { "" }
        )],
        None if choice.hand_eye.mount_from_camera.is_none() => vec![],
        None => vec!["too little data to predict an error: add captures or touches".into()],
    }
}
