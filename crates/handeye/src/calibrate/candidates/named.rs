//! Results of methods that were asked for by name: what the motions leave open is a property of the
//! data, whatever numbers a closed form makes of them.

use crate::{
    calibrate::{
        flow::{
            config::Config,
            evidence::{Choice, Evidence, UnitAndClock},
            notes::Notes,
            unknown::Task,
            verdict,
            views::{self, Views, camera_in_words},
        },
        prediction::answers,
        touches::views_and_touches,
    },
    estimate::{
        JointFit,
        evaluate::{self, HeldOut},
    },
    solve,
};

/// Where the motions leave something open, with the residual of the likeliest answer in place of the
/// method's own, which says nothing against the data.
pub(crate) fn by_likeliest(
    views: &Views,
    fit: &JointFit,
    config: &Config,
    found: &Evidence,
    own: Choice,
) -> (Choice, HeldOut) {
    let problem = views::views_problem(views.session, &views.views, &fit.extras);
    let left_out = views_and_touches::held_out_views(&problem, fit, config);
    let held_out = evaluate::rms(&left_out);
    let choice = Choice { held_out, ..own };
    let (used, rejected) = (found.used(), found.rejected.len());
    if !verdict::contradictions_of(used, rejected, &held_out).is_empty() {
        return (choice, left_out);
    }
    let choice = Choice {
        residual: evaluate::in_sample(&fit.hand_eye, &answers::as_fitted(fit, &views.views)),
        // for the residuals of the captures; the verdict hides it
        hand_eye: answers::stored(views, &fit.hand_eye, None),
        seen: Some(answers::seen_by(fit, views)),
        ..choice
    };
    (choice, left_out)
}

/// Why the method has no answer where the data determine one.
pub(crate) fn failure(views: &Views, config: &Config) -> Option<Notes> {
    let method = config.method?;
    let error = solve::solve(&views::pairs_of(views), method).err()?;
    let reason = format!(
        "{} has no answer for these captures (without a method by name there may be one): {error}",
        method.name()
    );
    Some(Notes::undetermined(reason, camera_in_words(views.session.setup)))
}

/// The unit of the distances as the method has found it, where it does.
pub(crate) fn unit(views: &Views, task: &Task, found: &Evidence) -> UnitAndClock {
    let estimated = found.unit_and_clock;
    if task.config.method != Some(solve::Method::AndreffScaled) || found.is_open() {
        return estimated;
    }
    match solve::andreff::solve_with_scale(&views::pairs_of(views)) {
        Ok(own) => {
            let taken_out = task.unknown.scale.unwrap_or(1.0);
            UnitAndClock { scale: Some(1.0 / own.scale * taken_out), ..estimated }
        }
        Err(_) => estimated,
    }
}
