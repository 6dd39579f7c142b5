//! The size of the target as all data have it, against the declared one.

use super::prior::SIZE;
use crate::{
    TargetSize,
    calibrate::{
        flow::{
            limits::{IMPROBABLE_SIZE, LEAST_SIZE_ERROR, MOST_SIZE_ERROR},
            notes::Notes,
            unknown::Task,
            views::Views,
        },
        result::Scale,
    },
    estimate::{JointFit, noise::Source},
    findings::{
        TargetFinding,
        target::{Size, SizeOfAnswer},
    },
    math::statistics,
    mistakes,
    model::session::Session,
};

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

/// Fewer views say nothing of the size beside both poses.
const FEWEST: usize = 5;

/// The size of the target as all data have it, and whether the answer rests on it; `None` where the data do not tell it.
pub(crate) fn judge(
    views: &Views,
    (by_views, best): (&JointFit, &JointFit),
    (declared, as_declared): (f64, f64),
    task: &Task,
) -> Option<(Scale, Notes)> {
    if task.unknown.scale.is_some() || views.views.len() < FEWEST || !travels(views, by_views) {
        return None;
    }
    let found =
        mistakes::target_scale(&views.views, by_views, &task.config.known, views.session.setup);
    let mistakes::TargetScale { value, sigma, .. } = found?;
    let used = as_declared < 0.5;
    // how far the target that the views are about is from the declared one already
    let (value, sigma) = (value * declared, sigma * declared);
    let answer =
        best.extra(SIZE).map_or((value, sigma), |(x, s)| (declared * (1.0 + x), declared * s));
    let dof = (by_views.degrees_of_freedom - 1.0).max(1.0);
    let p_value = statistics::of_f(((value - 1.0) / sigma).powi(2), (1.0, dof));
    let off = (value - 1.0).abs();
    let improbable = p_value < IMPROBABLE_SIZE;
    let said = match (&views.session.target, views.session.target_size) {
        _ if used => SizeOfAnswer::Estimated,
        // distances that came from elsewhere are taken as they are: small errors of scale are left to the user
        (None, _) if off > LEAST_SIZE_ERROR && improbable => SizeOfAnswer::Declared,
        // beyond what the prior of a printed target reaches
        (Some(_), TargetSize::Printed) if off > MOST_SIZE_ERROR && improbable => {
            SizeOfAnswer::Declared
        }
        (Some(_), TargetSize::Measured(_)) if improbable => SizeOfAnswer::Measured,
        _ => return Some((Scale { value, sigma, used }, Notes::default())),
    };
    let (value, sigma) = if used { answer } else { (value, sigma) };
    let finding = size_finding(views.session, declared, (value, sigma), said);
    let is_beyond = (value - 1.0).abs() > MOST_SIZE_ERROR;
    let notes = if is_beyond { Notes::against(finding) } else { Notes::of([finding]) };
    Some((Scale { value, sigma, used }, notes))
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
        beyond_printing: (value - 1.0).abs() > MOST_SIZE_ERROR,
        answer,
    })
}
