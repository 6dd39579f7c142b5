//! Where the predicted error comes from, and what would make it smaller.
//!
//! The answer is a sum over all measurements, so its covariance is a sum over the sources of their
//! noise: `C = Σ_k C M_k C` with `M_k = Σ Jᵀ V⁻¹ (θ_k G_k) V⁻¹ J`. What a change would do follows
//! from the information as it were then.

use nalgebra::DMatrix;

use crate::calibrate::prediction::workpiece::Workpiece;
use crate::{
    calibrate::result::{Advice, BudgetEntry},
    estimate::{JointFit, NoiseModel, Problem, Sigma, noise::Source},
};

/// Every source of error with its size and its part in the error at the workpiece.
///
/// Of a session without a board, poses that come with their covariance are of scans.
pub(crate) fn budget(
    problem: &Problem,
    fit: &JointFit,
    at: &Workpiece,
    has_board: bool,
) -> Vec<BudgetEntry> {
    let shares = fit.covariance_shares(problem);
    let at_workpiece = |source: Option<Source>| {
        let (_, covariance) = shares.iter().find(|(s, _)| *s == source)?;
        at.rms_mm(covariance)
    };
    let entry = |s: &Sigma| BudgetEntry {
        source: if is_scan(s, has_board) { "scan" } else { s.source.name() }.into(),
        sigma: text(s, has_board),
        sigma_mm: (!s.source.is_rotation() && s.source != Source::Picture).then_some(s.sigma * 1e3),
        sigma_deg: s.source.is_rotation().then_some(s.sigma.to_degrees()),
        sigma_uncertainty: s.uncertainty,
        at_workpiece_mm: at_workpiece(Some(s.source)),
    };
    let mut all: Vec<BudgetEntry> = fit.noise.sigmas.iter().map(entry).collect();
    if !problem.extras.is_empty() {
        all.push(BudgetEntry {
            source: "priors".into(),
            sigma: "tool tip, intrinsics, size, depth and systematic errors, by their priors"
                .into(),
            sigma_mm: None,
            sigma_deg: None,
            sigma_uncertainty: None,
            at_workpiece_mm: at_workpiece(None),
        });
    }
    let uncorrectable = at.uncorrectable_rms_mm();
    if uncorrectable > 0.0 {
        all.push(BudgetEntry {
            source: "robot, by its pose".into(),
            sigma: "errors that depend on its pose, as far as no fixed transform corrects them"
                .into(),
            sigma_mm: None,
            sigma_deg: None,
            sigma_uncertainty: None,
            at_workpiece_mm: Some(uncorrectable),
        });
    }
    all
}

fn is_scan(s: &Sigma, has_board: bool) -> bool {
    s.source == Source::Picture && !has_board
}

fn text(s: &Sigma, has_board: bool) -> String {
    let size = match s.source {
        _ if is_scan(s, has_board) => {
            format!("{:.2} times the noise that the registration of the scans states", s.sigma)
        }
        Source::Picture => format!("{:.2} times the noise of the corners in the images", s.sigma),
        x if x.is_rotation() => format!("{:.4} deg per axis", s.sigma.to_degrees()),
        _ => format!("{:.3} mm per axis", s.sigma * 1e3),
    };
    match s.uncertainty {
        Some(u) => format!("{size} (+- {:.0} %)", u * 100.0),
        None => format!("{size} (given)"),
    }
}

/// What halves one source of noise, in words.
const CHANGES: [(&str, &[Source]); 3] = [
    (
        "a robot twice as accurate: warmed up, and calibrated itself",
        &[Source::RobotRotation, Source::RobotPosition],
    ),
    (
        "images twice as exact: a larger board, better light, calibrated intrinsics",
        &[
            Source::Picture,
            Source::CameraTilt,
            Source::CameraRoll,
            Source::CameraLateral,
            Source::CameraDepth,
        ],
    ),
    ("touches twice as exact: a pointed tip, calibrated well", &[Source::Touch]),
];

/// What halves the noise of scans that are registered, in words.
const SCANS_CHANGE: &str =
    "scans placed twice as exactly: less noise, more in common, shape on all sides";

/// What would help, the most helpful first.
pub(crate) fn advice(
    problem: &Problem,
    fit: &JointFit,
    at: &Workpiece,
    has_board: bool,
) -> Vec<Advice> {
    let mut all = vec![];
    let mut add = |change: &str, covariance: Option<DMatrix<f64>>| {
        if let Some(own) = covariance.and_then(|c| at.rms_mm(&c)) {
            // no change on this list corrects the robot's poses; that they may tell more of its errors is not counted
            let mm = own.hypot(at.uncorrectable_rms_mm());
            all.push(Advice { change: change.into(), predicted_tre_mm: mm });
        }
    };
    let twice = Problem {
        views: [problem.views.clone(), problem.views.clone()].concat(),
        ..problem.clone()
    };
    add("twice as many captures", fit.covariance_for(problem, &twice, &fit.noise));
    if !problem.boards.is_empty() {
        let boards = [problem.boards.clone(), problem.boards.clone()].concat();
        let more = Problem { boards, ..problem.clone() };
        add(
            "twice as many touches, half of them on boards lying elsewhere",
            fit.covariance_for(problem, &more, &fit.noise),
        );
    }
    for (words, sources) in CHANGES {
        if fit.noise.sigmas.iter().any(|s| sources.contains(&s.source)) {
            let of_scans = fit
                .noise
                .sigmas
                .iter()
                .any(|s| sources.contains(&s.source) && is_scan(s, has_board));
            let words = if of_scans { SCANS_CHANGE } else { words };
            add(words, fit.covariance_for(problem, problem, &halved(&fit.noise, sources)));
        }
    }
    all.sort_by(|a, b| a.predicted_tre_mm.total_cmp(&b.predicted_tre_mm));
    all
}

fn halved(noise: &NoiseModel, sources: &[Source]) -> NoiseModel {
    let mut noise = noise.clone();
    noise.sigmas.iter_mut().filter(|s| sources.contains(&s.source)).for_each(|s| s.sigma *= 0.5);
    noise
}
