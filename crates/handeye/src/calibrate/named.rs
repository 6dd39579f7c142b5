//! Results of methods that were asked for by name: what the motions leave open is a property of the
//! data, whatever numbers a closed form makes of them.

use super::{joint, verdict};
use crate::{
    calibrate::{answers, config::Config, result::Calibration, views, views::Views},
    estimate::{JointFit, evaluate},
    model::verdict::Verdict,
    solve,
};

/// Where the motions leave something open, the misfit of the likeliest answer stands for the
/// method's own: the latter says nothing against the data.
pub(super) fn judge_by_likeliest(
    views: &Views,
    fit: &JointFit,
    config: &Config,
    result: &mut Calibration,
) {
    if result.undetermined.is_empty() || result.verdict == Verdict::Rejected {
        return;
    }
    let problem = views::views_problem(views.session, &views.views, &fit.extras);
    let left_out = joint::held_out_views(&problem, fit, &config.known);
    result.held_out = evaluate::rms(&left_out);
    captures_held_out(views, &left_out, result);
    if verdict::contradictions(result).is_empty() {
        result.residual =
            evaluate::in_sample(&fit.hand_eye, &answers::as_fitted(fit, &views.views));
        // for the misfits of the captures; the verdict hides it
        result.hand_eye = answers::stored(views, &fit.hand_eye, None);
    }
}

/// Says why the method has no answer where the data determine one.
pub(super) fn name_failure(views: &Views, method: solve::Method, result: &mut Calibration) {
    if !result.undetermined.is_empty() {
        return;
    }
    let Err(error) = solve::solve(&views::pairs_of(views), method) else { return };
    result.reasons.push(format!(
        "{} has no answer for these captures (without a method by name there may be one): {error}",
        method.name()
    ));
    let mount = views.session.setup.mount();
    result.undetermined.push(format!("the pose of the camera on the {mount}"));
}

/// The unit of the distances as the method has found it, where it does.
pub(super) fn report_scale(views: &Views, method: solve::Method, result: &mut Calibration) {
    if method == solve::Method::AndreffScaled
        && result.undetermined.is_empty()
        && let Ok(found) = solve::andreff::solve_with_scale(&views::pairs_of(views))
    {
        result.scale = Some(1.0 / found.scale);
    }
}

/// Misfit of every capture when it was left out.
pub(super) fn captures_held_out(
    views: &Views,
    left_out: &[Option<(f64, f64)>],
    result: &mut Calibration,
) {
    for (&i, left_out) in views.indices.iter().zip(left_out) {
        result.captures[i].held_out_deg = left_out.map(|h| h.0.to_degrees());
        result.captures[i].held_out_mm = left_out.map(|h| h.1 * 1e3);
    }
}
