//! Every way to the answer, side by side, and the choice between them.

mod judge;
mod registered;

use super::{
    alternatives::{Alternatives, Averaged},
    arm,
    boards::{self, Boards},
    budget, captures,
    joint::{self, Joint, held_out_views},
    known_position, named,
    optics::{self, MeasuredBy, Optics},
    reach::Reach,
    verdict,
    workpiece::{Workpiece, volume},
    wrong_touches,
};
use registered::stored_registration;

use crate::{
    HandEye,
    calibrate::{
        answers::{as_fitted, blocks, excess, stated_covariance, stored},
        candidates::judge::{Judge, Judged},
        config::Config,
        result::{Calibration, Candidate, TouchResult, WITH_ARM},
        views,
        views::{Views, pairs_of},
    },
    estimate::{
        JointFit, Problem,
        evaluate::{self, Estimator},
        predict::Volume,
        touches::{self, TouchPairs},
    },
    findings::TouchFinding,
    mistakes,
    solve::{self, Method, consensus::Consensus, least_squares::Matrix12},
};

/// Makes and judges all candidates, chooses one, and reports the touches. With the views comes the
/// fit in which the arm deviates, where the choice rests on it.
pub(super) fn estimate<'a>(
    mut views: Views<'a>,
    found: &Consensus,
    optics: &Optics,
    config: &Config,
    result: &mut Calibration,
) -> Option<(Views<'a>, Option<JointFit>)> {
    let Averaged { problem, fit, as_declared } =
        fit_views(&mut views, found, optics, config, result)?;
    let volume = volume(&views, &fit)?;
    let paired = captures::pair_touches(&views, &fit, result);
    let (boards, trusted) = right_touches(&views, &paired, optics, (&problem, &fit), result);
    let joint = joint::fit(&views, &boards, &problem.extras, &fit, &config.known);
    if let Some(joint) = &joint {
        joint.warn(&views, result);
    }
    let used = joint.as_ref().map_or(&[][..], |j| &j.used);
    let (best, whole) = joint.as_ref().map_or((&fit, &problem), |j| (&j.fit, &j.problem));
    let as_declared = joint.as_ref().map_or(as_declared, |j| j.as_declared);
    verdict::judge_size(
        &views,
        (&fit, best),
        (1.0 + optics.size, as_declared.size),
        config,
        result,
    );
    let arm = arm::look(&views, whole, best, used, config).unwrap_or_else(|finding| {
        result.warnings.push(finding.into());
        None
    });
    name_free(&views, &fit, best, result);
    known_position::judge(whole, best, &views, &config.known, result);
    let reach = arm.as_ref().and_then(|a| Reach::new(&views, a, &volume));
    let (best, whole) = match (&arm, &reach) {
        (Some(arm), Some(_)) => (&arm.fit, &arm.problem),
        _ => (best, whole),
    };
    let measured = MeasuredBy { unit_is_free: config.unknown.scale, as_declared };
    let workpiece = Workpiece::new(&views, &volume, best, measured, reach.as_ref());
    optics.report(views.session, best, as_declared, result);
    if let Some(arm) = &arm {
        arm.report(&views, workpiece.rms_of_best_mm().filter(|_| reach.is_some()), result);
    }
    let has_board = views.session.target.is_some();
    result.error_budget = budget::budget(whole, best, &workpiece, has_board);
    result.advice = budget::advice(whole, best, &workpiece, has_board);
    let judge =
        Judge { views: &views, paired: &trusted, known: config.known, workpiece: &workpiece };
    compare(&judge, (&fit, joint.as_ref()), &volume, config, result);
    map_error(&workpiece, result);
    result.touches = touches_at(result, &views, &paired, joint.as_ref());
    let rests_on_arm = result.chosen.as_deref() == Some(WITH_ARM);
    let found = arm.filter(|_| rests_on_arm).map(|a| a.fit);
    Some((views, found))
}

/// Makes all candidates and chooses one; a method asked for by name is judged alone.
fn compare(
    judge: &Judge,
    (fit, joint): (&JointFit, Option<&Joint>),
    volume: &Volume,
    config: &Config,
    result: &mut Calibration,
) {
    let mut candidates = judge.view_candidates(fit, joint.is_some(), config);
    candidates.extend(judge.touch_candidates(fit, config, result));
    if config.method.is_none() {
        candidates.extend(joint.and_then(|j| judge.joint_candidate(j)));
        candidates.extend(judge.arm_candidate(fit));
    }
    if let Some(method) = config.method
        && candidates.is_empty()
    {
        named::name_failure(judge.views, method, result);
    }
    choose(candidates, judge.views, volume, config, result);
    if let Some(method) = config.method {
        named::judge_by_likeliest(judge.views, fit, config, result);
        named::report_scale(judge.views, method, result);
    }
}

/// The likeliest answer of views alone, and what it says beside both poses.
fn fit_views(
    views: &mut Views,
    found: &Consensus,
    optics: &Optics,
    config: &Config,
    result: &mut Calibration,
) -> Option<Averaged> {
    let setup = views.session.setup;
    result.diversity = Some(evaluate::diversity(&pairs_of(views)));
    if !optics.extras.is_empty() {
        views.views = optics::with_sights(views);
    }
    config.unknown.set_free(views, &found.hand_eye);
    let extras = [optics.extras.as_slice(), &config.unknown.extras()].concat();
    let problem = views::views_problem(views.session, &views.views, &extras);
    let alternatives = Alternatives::of(views.session);
    let Averaged { problem, mut fit, as_declared } =
        match alternatives.fit(&problem, &found.hand_eye, &config.known) {
            Ok(averaged) => averaged,
            Err(error) => {
                result.reasons.push(error.to_string());
                result
                    .undetermined
                    .push(format!("the pose of the camera on the {}", setup.mount()));
                return None;
            }
        };
    captures::orient_target(views, &mut fit);
    config.unknown.report(&fit, result);
    let problem = views::views_problem(views.session, &views.views, &problem.extras);
    Some(Averaged { problem, fit, as_declared })
}

/// The predicted error of the chosen answer all over the workpiece.
fn map_error(workpiece: &Workpiece, result: &mut Calibration) {
    let x = result.hand_eye.mount_from_camera.as_ref();
    if let (Some(tre), Some(x)) = (&mut result.predicted_tre_mm, x) {
        tre.map = workpiece.map(x);
    }
}

/// The touches that can be of the corners they name, by board and by pair; the others are reported.
fn right_touches(
    views: &Views,
    paired: &[TouchPairs],
    optics: &Optics,
    (problem, fit): (&Problem, &JointFit),
    result: &mut Calibration,
) -> (Boards, Vec<TouchPairs>) {
    let mut boards = boards::boards(views, fit, optics);
    let wrong = wrong_touches::find(views, &boards, problem, fit);
    wrong.left_out_of(&mut boards);
    let right = |p: &&TouchPairs| !wrong.which.contains(&p.touch);
    let trusted = paired.iter().filter(right).cloned().collect();
    wrong.report(result);
    (boards, trusted)
}

/// Names what the best answer leaves free, and what views alone would have.
fn name_free(views: &Views, fit: &JointFit, best: &JointFit, result: &mut Calibration) {
    let (setup, pairs) = (views.session.setup, pairs_of(views));
    let free = mistakes::free_directions(best);
    result.undetermined.extend(mistakes::in_words(&free, &pairs, setup));
    if !free.is_empty() {
        result.determined = Some(verdict::determined(&best.hand_eye.mount_from_camera, &free));
        return;
    }
    let by_views = mistakes::free_directions(fit);
    if !by_views.is_empty() {
        let what = mistakes::in_words(&by_views, &pairs, setup).join(", ");
        result.warnings.push(TouchFinding::AloneDetermine { what }.into());
    }
}

impl Judge<'_> {
    fn view_candidates(&self, fit: &JointFit, touched: bool, config: &Config) -> Vec<Judged> {
        let likeliest = if touched { "views-only" } else { "joint" };
        let closed = |m: Method| (format!("closed-form-{}", m.name()), Estimator::ClosedForm(m));
        let all: Vec<(String, Estimator)> = match config.method {
            Some(method) => vec![closed(method)],
            None => Method::CANDIDATES
                .into_iter()
                .map(closed)
                .chain([("least-squares".into(), Estimator::LeastSquares)])
                .collect(),
        };
        let by_estimator = |(name, estimator)| self.view_candidate(fit, name, &estimator);
        let mut judged: Vec<Judged> = all.into_iter().filter_map(by_estimator).collect();
        if config.method.is_none() {
            let problem = views::views_problem(self.views.session, &self.views.views, &fit.extras);
            let left_out = held_out_views(&problem, fit, &self.known);
            let mut own = self.judged(fit, likeliest.into(), &fit.hand_eye, left_out);
            own.candidate.in_sample =
                evaluate::in_sample(&fit.hand_eye, &as_fitted(fit, &self.views.views));
            judged.push(own);
        }
        judged
    }

    /// One candidate from views alone.
    fn view_candidate(
        &self,
        fit: &JointFit,
        name: String,
        estimator: &Estimator,
    ) -> Option<Judged> {
        let views = self.views;
        let answer = estimator.estimate(&views.views, &fit.hand_eye).ok()?;
        let left_out = evaluate::held_out(estimator, &views.views, &fit.hand_eye);
        Some(self.judged(fit, name, &answer, left_out))
    }

    /// An answer from views, and what it missed when each was left out.
    fn judged(
        &self,
        fit: &JointFit,
        name: String,
        answer: &HandEye,
        left_out: Vec<Option<(f64, f64)>>,
    ) -> Judged {
        let views = self.views;
        let x = answer.mount_from_camera;
        let tre = self.workpiece.tre(&x);
        let held_out = evaluate::rms(&left_out);
        let touch_rms = touches::touch_rms(self.paired, &x).map(|m| m * 1e3);
        let covariance =
            stated_covariance(fit).map(|c| self.of_both(c + excess(&fit.hand_eye, answer), answer));
        let candidate = Candidate {
            name,
            hand_eye: stored(views, answer, covariance.as_ref()),
            in_sample: evaluate::in_sample(answer, &views.views),
            held_out,
            touch_rms_mm: touch_rms,
            held_out_mm: touch_rms.or(held_out.translation_rms_mm),
            predicted_tre_mm: tre.as_ref().map(|t| t.rms),
            note: None,
        };
        Judged { candidate, tre, held_out: left_out }
    }

    /// The same beside that for the target.
    fn of_both(&self, mut own: Matrix12, answer: &HandEye) -> Matrix12 {
        let of_camera = self.of_camera(blocks(&own).0, &answer.mount_from_camera);
        own.fixed_view_mut::<6, 6>(0, 0).copy_from(&of_camera);
        own
    }

    /// The fit of everything.
    fn joint_candidate(&self, joint: &Joint) -> Option<Judged> {
        let fit = &joint.fit;
        let x = fit.hand_eye.mount_from_camera;
        let tre = self.workpiece.tre(&x);
        let left_out = held_out_views(&joint.problem, fit, &self.known);
        let held_out = evaluate::rms(&left_out);
        let covariance = stated_covariance(fit).map(|c| self.of_both(c, &fit.hand_eye));
        let touch_held_out = joint.held_out_touches(&self.known).map(|m| m * 1e3);
        let candidate = Candidate {
            name: "joint".into(),
            hand_eye: stored(self.views, &fit.hand_eye, covariance.as_ref()),
            in_sample: evaluate::in_sample(&fit.hand_eye, &as_fitted(fit, &self.views.views)),
            held_out,
            touch_rms_mm: joint.touch_rms().map(|m| m * 1e3),
            held_out_mm: touch_held_out.or(held_out.translation_rms_mm),
            predicted_tre_mm: tre.as_ref().map(|t| t.rms),
            note: joint.note(),
        };
        Some(Judged { candidate, tre, held_out: left_out })
    }
}

impl Judge<'_> {
    /// The answer that does best for a robot whose arm deviates and which does not know.
    fn arm_candidate(&self, fit: &JointFit) -> Option<Judged> {
        let (x, covariance) = self.workpiece.rigid()?;
        let views = self.views;
        let tre = self.workpiece.tre(&x);
        let placed = solve::place_target(&pairs_of(views), &x);
        let held_out = evaluate::placed_without(&views.views, &x);
        let missed = evaluate::rms(&held_out);
        let touch_rms = touches::touch_rms(self.paired, &x).map(|m| m * 1e3);
        let candidate = Candidate {
            name: WITH_ARM.into(),
            hand_eye: stored_registration(views, fit, &placed, Some(&covariance)),
            in_sample: evaluate::in_sample(&placed, &views.views),
            held_out: missed,
            touch_rms_mm: touch_rms,
            held_out_mm: touch_rms.or(missed.translation_rms_mm),
            predicted_tre_mm: tre.as_ref().map(|t| t.rms),
            note: Some(
                "the arm's deviations are found, and the answer is made for the tool as it was \
                 held, where it is used: elsewhere views and touches may fit it worse"
                    .into(),
            ),
        };
        Some(Judged { candidate, tre, held_out })
    }
}

/// The least predicted error wins; the residual has no say.
fn choose(
    candidates: Vec<Judged>,
    views: &Views,
    volume: &Volume,
    config: &Config,
    result: &mut Calibration,
) {
    let best = candidates.iter().filter(|c| c.tre.is_some()).min_by(|a, b| by_prediction(a, b));
    let best = best.or(candidates.last());
    if let Some(best) = best {
        result.method = best.candidate.name.clone();
        result.chosen = Some(best.candidate.name.clone());
        result.why = why(best, &candidates, volume, config);
        result.hand_eye = best.candidate.hand_eye;
        result.predicted_tre_mm = best.tre.clone();
        result.residual = best.candidate.in_sample;
        result.held_out = best.candidate.held_out;
        named::captures_held_out(views, &best.held_out, result);
    }
    result.candidates = candidates.into_iter().map(|c| c.candidate).collect();
}

fn by_prediction(a: &Judged, b: &Judged) -> std::cmp::Ordering {
    let rms = |c: &Judged| c.tre.as_ref().map_or(f64::INFINITY, |t| t.rms);
    rms(a).total_cmp(&rms(b))
}

fn why(best: &Judged, all: &[Judged], volume: &Volume, config: &Config) -> String {
    if let Some(method) = config.method {
        return format!("{} was asked for by name", method.name());
    }
    let Some(tre) = &best.tre else { return "no candidate has a predicted error".into() };
    let others: Vec<String> = all
        .iter()
        .filter(|c| c.candidate.name != best.candidate.name)
        .filter_map(|c| Some(format!("{} {:.2} mm", c.candidate.name, c.tre.as_ref()?.rms)))
        .collect();
    format!(
        "{} has the least predicted error in {}: {:.2} mm (the others: {})",
        best.candidate.name,
        volume.name,
        tre.rms,
        others.join(", ")
    )
}

/// Where the chosen answer puts each touched corner.
fn touches_at(
    result: &Calibration,
    views: &Views,
    paired: &[TouchPairs],
    joint: Option<&Joint>,
) -> Vec<TouchResult> {
    let Some(x) = result.hand_eye.mount_from_camera else { return vec![] };
    let chosen = |name: &str| result.chosen.as_deref().is_some_and(|n| n.starts_with(name));
    let (registered, fused) = (chosen("two-step"), chosen("joint"));
    let taken = |touch: usize| joint.is_some_and(|j| j.used.contains(&touch));
    let one = |p: &TouchPairs| {
        let difference_mm = touches::touch_error(p, &x) * 1e3;
        TouchResult {
            capture: p.placement.clone(),
            corner: views.session.touches[p.touch].corner,
            residual_mm: difference_mm.norm(),
            difference_mm,
            used: registered || fused && taken(p.touch),
        }
    };
    paired.iter().map(one).collect()
}
