//! Captures taken one after the other, whose errors may change slowly: odometry drifts, a mount
//! gives way, a robot warms up.
//!
//! The calibration itself takes the errors of captures as independent. Here its answer is put beside
//! a fit with drift ([`crate::estimate::drift`]); where the restricted likelihood gains clearly, drift
//! is part of the model: captures that did not agree only because of it come back in, the captures
//! without their drift are calibrated once more, so that everything else about them is judged, and
//! answer, covariance and predicted error are those of the fit with drift. A camera that walks away in
//! its holder has no one place, and its result is rejected.

use std::collections::BTreeMap;

use nalgebra::{Matrix6, SMatrix, Vector3, Vector6};

use crate::{
    Calibration, Config, Error, HandEye, Observation, PosePair, Session, Verdict, Warning,
    calibrate::{
        flow::{unknown::Task, verdict},
        result::{Answer, Candidate, CaptureResult, PoseCovariance, findings::TOO_IMPRECISE, rows},
    },
    detect::sight::{CLOCK, TARGET_SCALE},
    estimate::{
        Extra, ExtraKind, JointFit,
        drift::{
            self, DriftFit, Free,
            sequence::{Sequence, Side},
        },
        evaluate::{self, RmsResidual},
        predict::{self, PredictedTre},
        touch_pairs,
    },
    findings::{Finding, RobotFinding, StreamFinding, streams::Drift},
    math::lie,
    mistakes,
    model::residual::Residual,
    register::rigid_fit::point_jacobian,
    solve::{View, least_squares},
};

/// Fewer captures do not tell drift from noise.
const FEWEST: usize = 12;

/// Gain of the restricted likelihood that shows drift: its three parameters gain as much by chance
/// in one of two thousand sequences (half of the point of a chi-squared distribution), and there are two
/// sides on which something may give way.
const GAIN: f64 = 8.9;

/// The same of one parameter.
const GAIN_OF_ONE: f64 = 5.4;

/// Correlation of neighbouring residuals that chance exceeds in one of a hundred sequences, times the
/// root of their number of equations.
const BY_CHANCE: f64 = 2.3;

/// Rounds of letting captures in and putting them out.
const ROUNDS: usize = 6;

/// Squared Mahalanobis distance (six axes) that one capture in a hundred
/// thousand exceeds.
const OUTLIER: f64 = 34.0;

/// Names of the candidate.
const NAME: &str = "drift";

/// Prior standard deviation of a factor, and of a time offset (s): far more than any motion
/// leaves open.
const ANYTHING: f64 = 10.0;

/// Captures that are wrong in a way that is no drift.
fn is_no_drift(warning: &Warning) -> bool {
    let Some(finding) = warning.finding.as_deref() else { return false };
    match finding {
        Finding::Robot(found) => matches!(
            found,
            RobotFinding::Inverted { .. }
                | RobotFinding::LengthUnit { .. }
                | RobotFinding::TargetLengthUnit { .. }
        ),
        Finding::Captures(found) => found.says_out_of_order(),
        _ => false,
    }
}

/// The calibration of bare target poses that were taken one after the other, in the order of their times or names
/// (`img_2` before `img_10`), where their errors drift; `None` where no drift is to be seen beside the `plain`
/// calibration, and for anything but bare poses. `run` calibrates a session.
pub(crate) fn with_drift(
    session: &Session,
    task: &Task,
    plain: &Calibration,
    run: impl Fn(Session) -> Calibration,
) -> Result<Option<Calibration>, Error> {
    let bare = session.target.is_none()
        && session.touches.is_empty()
        && session.correspondences.is_empty()
        && session.known_position.is_none()
        && session.observations.iter().all(|o| o.corners.is_empty() && o.candidates.len() == 1);
    let Some(start) = plain.hand_eye.hand_eye() else { return Ok(None) };
    if !bare || task.config.method.is_some() || plain.warnings.iter().any(is_no_drift) {
        return Ok(None);
    }
    let session = session.in_order_of_time();
    let mut used = used(&session, plain);
    if used.iter().filter(|u| **u).count() < FEWEST {
        return Ok(None);
    }
    let mut sequence = sequence(&session, task, &start);
    let least = GAIN.max(gain_by_place(plain));
    let Some(found) = fit(&mut sequence, &mut used, task, (&start, least))? else {
        return Ok(None);
    };
    let free = mistakes::free_directions(&found.fit);
    let held_out = held_out(&found, &used);
    if held_out.translation_rms_mm.is_none() || !verdict::is_believable(&held_out) {
        return Ok(None);
    }
    if !free.is_empty() {
        return Ok((sequence.side == Side::Camera).then(|| loose(&found, plain)));
    }
    let steady = run(without(&session, &sequence, &found).in_order());
    if steady.hand_eye.mount_from_camera.is_none() {
        return Ok(None);
    }
    let names: Vec<String> = session.observations.iter().map(|o| o.capture.clone()).collect();
    let drifting = Drifting { names: &names, sequence: &sequence, found: &found, held_out };
    Ok(Some(drifting.result(task, plain, steady)))
}

/// The result for a camera that walks away in its holder: nobody knows where it sits after the captures.
fn loose(found: &DriftFit, plain: &Calibration) -> Calibration {
    let drift = in_numbers(Side::Camera, found);
    let reasons = vec![format!(
        "errors change slowly from capture to capture: {}; it has no single pose on its mount: fasten it, and take the captures again",
        drift.in_words()
    )];
    plain.clone().rejected_for(reasons).noting([StreamFinding::Drift { drift, is_fitted: false }])
}

/// Which captures of the session the result rests on.
fn used(session: &Session, plain: &Calibration) -> Vec<bool> {
    let by_name: BTreeMap<&str, bool> =
        plain.captures.iter().map(|c| (c.id.as_str(), c.used)).collect();
    let one = |o: &Observation| by_name.get(o.capture.as_str()).copied().unwrap_or(false);
    session.observations.iter().map(one).collect()
}

fn sequence(session: &Session, task: &Task, at: &HandEye) -> Sequence {
    let unknown = &task.unknown;
    let scale = Extra::about_zero(ExtraKind::Camera(TARGET_SCALE), ANYTHING);
    let clock = Extra::about_zero(ExtraKind::Camera(CLOCK), ANYTHING);
    let extras = [unknown.scale.map(|_| scale), unknown.time_offset_s.map(|_| clock)];
    let view = |o: &Observation| {
        let pair = PosePair {
            anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
            camera_from_target: o.candidates[0].camera_from_target,
        };
        unknown.freed(&View::bare(pair), o.velocity.as_ref(), at)
    };
    let views: Vec<View> = session.observations.iter().map(view).collect();
    let n = views.len();
    let at_time: Option<Vec<f64>> = session.observations.iter().map(|o| o.time_s).collect();
    let after = match at_time {
        Some(t) if n > 1 && t[n - 1] > t[0] => {
            let mean = (t[n - 1] - t[0]) / (n - 1) as f64;
            std::iter::once(0.0).chain(t.windows(2).map(|w| (w[1] - w[0]) / mean)).collect()
        }
        _ => vec![1.0; n],
    };
    let extras = extras.into_iter().flatten().collect();
    Sequence { setup: session.setup, side: Side::Target, views, after, extras }
}

/// The fit with drift on the side where it gains most, and the captures that are no outliers to it;
/// `None` where it gains less than `least_gain` on either.
fn fit(
    sequence: &mut Sequence,
    used: &mut Vec<bool>,
    task: &Task,
    (start, least_gain): (&HandEye, f64),
) -> Result<Option<DriftFit>, Error> {
    let known = &task.config.known;
    let mut near = drift::without_drift(sequence, used, start, known)?;
    let mut best: Option<(Side, DriftFit)> = None;
    for side in [Side::Target, Side::Camera] {
        sequence.side = side;
        if !neighbours_alike(sequence, used, &near) {
            continue;
        }
        let white = drift::fit_drift(sequence, used, &near, known, Free::Nothing)?;
        let found = drift::fit_drift(sequence, used, &near, known, Free::Pose)?;
        let least =
            best.as_ref().map_or(white.fit.log_likelihood + least_gain, |b| b.1.fit.log_likelihood);
        if found.fit.log_likelihood > least {
            best = Some((side, found));
        }
    }
    let Some((side, mut found)) = best else { return Ok(None) };
    sequence.side = side;
    let sequence = &*sequence;
    let fit =
        |used: &[bool], near: &JointFit, free| drift::fit_drift(sequence, used, near, known, free);
    let mut free = Free::Pose;
    if task.unknown.scale.is_some() {
        let unit = fit(used, &near, Free::PoseAndUnit)?;
        if unit.fit.log_likelihood - found.fit.log_likelihood > GAIN_OF_ONE {
            (free, found) = (Free::PoseAndUnit, unit);
        }
    }
    for _ in 0..ROUNDS {
        let belongs: Vec<bool> =
            found.views.iter().map(|v| v.squared_mahalanobis < OUTLIER).collect();
        if belongs == *used || belongs.iter().filter(|b| **b).count() < FEWEST {
            break;
        }
        *used = belongs;
        near.hand_eye = found.fit.hand_eye;
        near.values = found.fit.values.clone();
        found = fit(used, &near, free)?;
    }
    Ok(Some(found))
}

/// What errors by place gain, where they are part of the plain calibration: drift must gain more.
fn gain_by_place(plain: &Calibration) -> f64 {
    let gain = |w: &Warning| match w.finding.as_deref() {
        Some(Finding::Robot(RobotFinding::ErrsByPlace { gain, .. })) => Some(*gain),
        _ => None,
    };
    plain.warnings.iter().find_map(gain).unwrap_or(0.0)
}

/// Whether residuals of neighbouring views, each in units of its own noise and in the axes of what may
/// give way, are more alike than chance has it.
fn neighbours_alike(sequence: &Sequence, used: &[bool], near: &JointFit) -> bool {
    let white = |view: &View| {
        let pair = view.with(&near.extras, &near.values);
        let turn = match sequence.side {
            Side::Target => Matrix6::identity(),
            Side::Camera => lie::adjoint(pair.camera_from_target.iso()),
        };
        let r = turn * least_squares::residual(&near.hand_eye, &pair);
        let noise = near.noise.covariance(view, &near.hand_eye, sequence.setup);
        (turn * noise * turn.transpose()).cholesky()?.l().solve_lower_triangular(&r)
    };
    let views = sequence.views.iter().zip(used).filter(|(_, used)| **used);
    let residuals: Vec<Vector6<f64>> = views.filter_map(|(view, _)| white(view)).collect();
    let products: f64 = residuals.windows(2).map(|w| w[0].dot(&w[1])).sum();
    let squares: f64 = residuals.iter().map(Vector6::norm_squared).sum();
    products > BY_CHANCE / (6.0 * residuals.len() as f64).sqrt() * squares
}

fn held_out(found: &DriftFit, used: &[bool]) -> RmsResidual {
    let one = |(v, used): (&drift::sequence::Slow, &bool)| {
        used.then(|| Residual {
            angle: lie::omega(&v.left_out).norm(),
            distance: lie::nu(&v.left_out).norm(),
        })
    };
    evaluate::rms(&found.views.iter().zip(used).map(one).collect::<Vec<_>>())
}

/// The session with the drift taken out, in metres and at the right time.
fn without(session: &Session, sequence: &Sequence, found: &DriftFit) -> Session {
    let mut session = session.clone();
    for (k, o) in session.observations.iter_mut().enumerate() {
        let pair = sequence.views[k].with(&sequence.extras, &found.fit.values);
        o.candidates[0].camera_from_target = pair.camera_from_target.retract(&found.views[k].drift);
    }
    session
}

/// A fit with drift, and the captures that it is of.
struct Drifting<'a> {
    names: &'a [String],
    sequence: &'a Sequence,
    found: &'a DriftFit,
    held_out: RmsResidual,
}

impl Drifting<'_> {
    /// The result with drift, from the `plain` one and the `steady` one, of the captures without their drift.
    fn result(&self, task: &Task, plain: &Calibration, steady: Calibration) -> Calibration {
        let Self { sequence, found, held_out, .. } = *self;
        let fit = &found.fit;
        let inflation = touch_pairs::small_sample(fit.degrees_of_freedom);
        let hand_eye = stated(fit, inflation);
        let tre = predicted(sequence, found, inflation);
        let drift = in_numbers(sequence.side, found);
        let own = Candidate {
            name: NAME.into(),
            hand_eye,
            in_sample: steady.residual,
            held_out,
            touch_rms_mm: None,
            held_out_mm: held_out.translation_rms_mm,
            predicted_tre_mm: tre.as_ref().map(|t| t.rms),
            note: Some(drift.in_words()),
        };
        let factor = fit.extra(ExtraKind::Camera(TARGET_SCALE)).map(|(share, sigma)| {
            let larger = 1.0 + share;
            (1.0 / larger, sigma / larger.powi(2))
        });
        let unit = task.unknown.found(factor, fit.extra(ExtraKind::Camera(CLOCK)));
        let (verdict, reasons) = judged(&steady, tre.as_ref(), task.config);
        let result = Calibration {
            verdict,
            reasons,
            hand_eye,
            chosen: Some(NAME.into()),
            method: NAME.into(),
            why: String::from(
                "the errors of neighbouring captures are correlated, and the other candidates treat them as independent",
            ),
            error_budget: vec![],
            advice: vec![],
            held_out,
            candidates: plain.candidates.iter().map(without_error).chain([own]).collect(),
            captures: self.captures(plain, &steady),
            scale: unit.scale,
            scale_sigma: unit.scale_sigma,
            time_offset_s: unit.time_offset_s,
            time_offset_sigma_s: unit.time_offset_sigma_s,
            predicted_tre_mm: tre,
            ..steady
        };
        result.noting([StreamFinding::Drift { drift, is_fitted: true }])
    }

    /// Target poses as they were given, with the leave-one-out residual of each.
    fn captures(&self, plain: &Calibration, steady: &Calibration) -> Vec<CaptureResult> {
        let given: BTreeMap<&str, Option<_>> =
            plain.captures.iter().map(|c| (c.id.as_str(), c.camera_from_target)).collect();
        let mut all = steady.captures.clone();
        for (name, view) in self.names.iter().zip(&self.found.views) {
            let Some(capture) = all.iter_mut().find(|c| c.id == *name) else { continue };
            capture.camera_from_target = given.get(name.as_str()).copied().flatten();
            let left_out = &view.left_out;
            capture.held_out_deg = Some(lie::omega(left_out).norm().to_degrees());
            capture.held_out_mm = Some(lie::nu(left_out).norm() * 1e3);
        }
        all
    }
}

/// The answer of a fit with its covariance.
fn stated(fit: &JointFit, inflation: f64) -> Answer {
    let block = |k: usize| {
        let own: Matrix6<f64> = fit.covariance.as_ref()?.fixed_view::<6, 6>(k, k).into_owned();
        Some(rows(&(own * inflation)))
    };
    Answer {
        mount_from_camera: Some(fit.hand_eye.mount_from_camera),
        anchor_from_target: Some(fit.hand_eye.anchor_from_target),
        covariance: PoseCovariance { mount_from_camera: block(0), anchor_from_target: block(6) },
    }
}

/// A candidate without the error that is predicted as if errors were independent.
fn without_error(candidate: &Candidate) -> Candidate {
    let hand_eye = Answer { covariance: PoseCovariance::default(), ..candidate.hand_eye };
    Candidate { hand_eye, predicted_tre_mm: None, ..candidate.clone() }
}

/// The verdict on the captures without drift, and on how certain the answer is with it.
fn judged(
    steady: &Calibration,
    tre: Option<&PredictedTre>,
    config: &Config,
) -> (Verdict, Vec<String>) {
    let limit = verdict::limit(config);
    let accepted = steady.verdict == Verdict::Accepted;
    // the reason of an accepted one is the error that is predicted without drift
    let mut reasons = if accepted { vec![] } else { steady.reasons.clone() };
    match tre {
        Some(tre) if tre.p95 <= limit && accepted => reasons.push(tre.in_words()),
        Some(tre) if tre.p95 > limit => {
            reasons.push(format!(
                "{} in {} is {:.2} mm, more than {limit} mm: the errors \
                 drift, so add captures with more tilt, or find out what moves",
                TOO_IMPRECISE, tre.r#where, tre.p95
            ));
            return (Verdict::Rejected, reasons);
        }
        _ => {}
    }
    (steady.verdict, reasons)
}

fn in_numbers(side: Side, found: &DriftFit) -> Drift {
    let d = &found.drift;
    Drift {
        of_camera: side == Side::Camera,
        rotation_deg: d.rotation.to_degrees(),
        position_mm: d.position * 1e3,
        scale: d.scale,
    }
}

/// Predicted error around where the target's origin was seen. Points that the camera locates move
/// with the unit of its distances, and so does their error.
fn predicted(sequence: &Sequence, found: &DriftFit, inflation: f64) -> Option<PredictedTre> {
    let fit = &found.fit;
    let pairs: Vec<PosePair> =
        sequence.views.iter().map(|v| v.with(&fit.extras, &fit.values)).collect();
    let origin = [crate::Point::new(0.0, 0.0, 0.0)];
    let name = "the box around the target's origin in all poses";
    let volume = mistakes::seen_volume(&pairs, &origin, name)?;
    let covariance = fit.covariance.as_ref()? * inflation;
    let scale = fit.extras.iter().position(|e| e.kind == ExtraKind::Camera(TARGET_SCALE));
    let spread = |p: &Vector3<f64>| {
        let mut j = SMatrix::<f64, 3, 7>::zeros();
        j.fixed_view_mut::<3, 6>(0, 0).copy_from(&point_jacobian(p));
        let mut s = SMatrix::<f64, 7, 7>::zeros();
        s.fixed_view_mut::<6, 6>(0, 0).copy_from(&covariance.fixed_view::<6, 6>(0, 0));
        if let Some(k) = scale {
            j.set_column(6, p);
            for i in 0..6 {
                s[(i, 6)] = covariance[(i, 12 + k)];
                s[(6, i)] = s[(i, 6)];
            }
            s[(6, 6)] = covariance[(12 + k, 12 + k)];
        }
        j * s * j.transpose()
    };
    let spread: Vec<_> = volume.points.iter().map(spread).collect();
    Some(predict::tre_of_points(&volume, &spread, |_| Vector3::zeros()))
}

#[cfg(test)]
mod tests;
