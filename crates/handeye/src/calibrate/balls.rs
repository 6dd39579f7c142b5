//! Captures of a ball: one point in the camera each, and nothing of its rotation.
//!
//! The target's frame of a ball is at its centre and has the axes of the anchor.

use nalgebra::{Matrix6, Vector3};

use super::{Config, Session, agreement, verdict, workpiece::workspace_volume};
use crate::{
    Camera, Mount, Observation, Pose, PosePair, Warning,
    calibration::{
        Answer, BudgetEntry, Calibration, Candidate, Misfit, PoseCovariance, Verdict, rows,
    },
    diagnose, evaluate,
    linalg::median,
    predict::{self, PredictedTre, Volume},
    solve::points::{self, PointFit, PointView},
    touches,
};

/// Name of the method.
const METHOD: &str = "ball-least-squares";

pub(super) fn from_balls(session: &Session, config: &Config, result: &mut Calibration) {
    result.captures = session.observations.iter().map(agreement::first_report).collect();
    let seen: Vec<usize> =
        (0..session.observations.len()).filter(|&i| view(session, i).is_some()).collect();
    for (i, capture) in result.captures.iter_mut().enumerate() {
        capture.used = seen.contains(&i);
        capture.reason = (!capture.used).then(|| "no ball was found in its scan".to_owned());
    }
    if !session.touches.is_empty() {
        result.warnings.push(Warning::new(
            "touches-without-corners",
            "a ball has no corners: the touches are left out",
        ));
    }
    let views: Vec<PointView> = seen.iter().filter_map(|&i| view(session, i)).collect();
    if let Some(method) = config.method {
        let what = format!("a ball shows no rotation: the method {} cannot use it", method.name());
        result.warnings.push(Warning::new("method-not-for-balls", what));
    }
    match points::fit_points(&views) {
        Ok(fit) => conclude(session, &seen, &views, &fit, result),
        Err(error) => {
            result.reasons.push(error.to_string());
            let what = format!("the pose of the camera on the {}", session.setup.mount());
            result.undetermined.push(what);
        }
    }
}

/// One capture with its ball's centre.
fn view(session: &Session, i: usize) -> Option<PointView> {
    let o: &Observation = &session.observations[i];
    let ball = o.surface.first()?;
    Some(PointView {
        anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
        in_camera: ball.in_camera,
        covariance: ball.covariance,
    })
}

fn conclude(
    session: &Session,
    seen: &[usize],
    views: &[PointView],
    fit: &PointFit,
    result: &mut Calibration,
) {
    let missed = points::held_out(views, fit);
    report_captures(seen, (views, fit), &missed, result);
    let pairs: Vec<PosePair> =
        views.iter().zip(&fit.agrees).filter(|(_, a)| **a).map(|(v, _)| pair(v, fit)).collect();
    result.diversity = Some(evaluate::diversity(&pairs));
    if pairs.len() < FEW {
        let what = format!("only {} captures agree: too few to judge the noise well", pairs.len());
        result.warnings.push(Warning::new("few-captures", what));
    }
    let factor = touches::small_sample(fit.degrees_of_freedom);
    let covariance = fit.covariance * factor;
    let own: Matrix6<f64> = covariance.fixed_view::<6, 6>(0, 0).into_owned();
    let free = diagnose::free_of(&own, &fit.mount_from_camera.rotation());
    result.undetermined.extend(diagnose::in_words(&free, &pairs, session.setup));
    if !free.is_empty() {
        result.determined = Some(verdict::determined(&fit.mount_from_camera, &free));
    }
    let volume = volume(session, views, &fit.mount_from_camera);
    let tre =
        volume.filter(|_| factor.is_finite()).map(|v| predict::tre(&v, &own, |_| Vector3::zeros()));
    let mut of_target = Matrix6::zeros();
    of_target.fixed_view_mut::<3, 3>(3, 3).copy_from(&covariance.fixed_view::<3, 3>(6, 6));
    let answer = Answer {
        mount_from_camera: Some(fit.mount_from_camera),
        anchor_from_target: Some(Pose::from_parts(
            &nalgebra::Matrix3::identity(),
            fit.in_anchor.vector(),
        )),
        covariance: PoseCovariance {
            mount_from_camera: Some(rows(&own)),
            anchor_from_target: Some(rows(&of_target)),
        },
    };
    fill(answer, (fit, &missed), tre, views, result);
}

/// Fewer captures are answered with a warning.
const FEW: usize = 8;

fn fill(
    answer: Answer,
    (fit, missed): (&PointFit, &[Option<f64>]),
    tre: Option<PredictedTre>,
    views: &[PointView],
    result: &mut Calibration,
) {
    let agreeing = fit.misfits_m.iter().zip(&fit.agrees).filter(|(_, a)| **a).map(|(m, _)| *m);
    let in_sample = misfit(agreeing);
    let held_out = misfit(missed.iter().flatten().copied());
    result.method = METHOD.into();
    result.chosen = Some(METHOD.into());
    result.why =
        "centres of a ball have one answer: the camera that puts them all at one place".into();
    result.hand_eye = answer;
    result.residual = in_sample;
    result.held_out = held_out;
    result.error_budget = budget(fit, views);
    result.candidates = vec![Candidate {
        name: METHOD.into(),
        hand_eye: answer,
        in_sample,
        held_out,
        touch_rms_mm: None,
        held_out_mm: held_out.translation_rms_mm,
        predicted_tre_mm: tre.as_ref().map(|t| t.rms),
        note: None,
    }];
    result.predicted_tre_mm = tre;
    if fit.degrees_of_freedom < 1.0 && result.undetermined.is_empty() {
        result.reasons.push("nothing is left to judge the noise by: take more captures".into());
        result.verdict = Verdict::Rejected;
    }
}

fn misfit(values: impl Iterator<Item = f64>) -> Misfit {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v * v, n + 1.0));
    let rms = (count > 0.0).then(|| (sum / count).sqrt() * 1e3);
    Misfit { translation_rms_mm: rms, ..Misfit::default() }
}

fn budget(fit: &PointFit, views: &[PointView]) -> Vec<BudgetEntry> {
    let per_axis = |v: &PointView| (v.covariance.trace() / 3.0).sqrt() * 1e3;
    let scan = median(views.iter().map(per_axis));
    let one = |source: &str, mm: f64| BudgetEntry {
        source: source.into(),
        sigma: format!("{mm:.3} mm"),
        sigma_mm: Some(mm),
        sigma_deg: None,
        sigma_uncertainty: None,
        at_workpiece_mm: None,
    };
    vec![
        one("robot, at the ball", fit.robot_sigma_m * 1e3),
        one("centre of the ball in a scan", scan),
    ]
}

/// The capture as a pose, the ball's axes being those of the anchor.
fn pair(v: &PointView, fit: &PointFit) -> PosePair {
    let turn = v.anchor_from_mount.rotation() * fit.mount_from_camera.rotation();
    let camera_from_target = Pose::from_parts(&turn.transpose(), v.in_camera.vector());
    PosePair { anchor_from_mount: v.anchor_from_mount, camera_from_target }
}

fn report_captures(
    seen: &[usize],
    (views, fit): (&[PointView], &PointFit),
    missed: &[Option<f64>],
    result: &mut Calibration,
) {
    for (k, &i) in seen.iter().enumerate() {
        let capture = &mut result.captures[i];
        capture.camera_from_target = Some(pair(&views[k], fit).camera_from_target);
        capture.residual_mm = Some(fit.misfits_m[k] * 1e3);
        capture.held_out_mm = missed[k].map(|m| m * 1e3);
        capture.used = fit.agrees[k];
        if !capture.used {
            let mm = fit.misfits_m[k] * 1e3;
            capture.reason = Some(format!("its ball is {mm:.1} mm from where the others put it"));
            result.rejected.push(capture.id.clone());
        }
    }
}

fn volume(session: &Session, views: &[PointView], x: &Pose<Mount, Camera>) -> Option<Volume> {
    match &session.workspace {
        Some(w) => Some(workspace_volume(session.setup, w, x)),
        None => {
            let centres = views.iter().map(|v| v.in_camera.vector());
            Volume::around(centres, "the box in which the camera saw the ball")
        }
    }
}
