//! Every way to the answer, side by side, and the choice between them.

mod judge;
mod known_position;
mod named;
mod registered;

use crate::{
    Error, HandEye,
    calibrate::{
        captures::residuals,
        flow::{
            config::Config,
            evidence::{Choice, Evidence, RestsOn},
            notes::Notes,
            unknown::{self, Task},
            verdict,
            views::{self, Views, camera_in_words, pairs_of},
        },
        optics::{
            self, MeasuredBy, Optics,
            alternatives::{Alternatives, Averaged},
            size,
        },
        prediction::{
            answers::{as_fitted, blocks, excess, seen_by, stated_covariance, stored},
            budget,
            reach::UsedTouches,
            workpiece::{Workpiece, volume},
        },
        result::{Candidate, Determined, RobotErrorKind, TouchResult},
        robot::Robot,
        touches::{
            touch_outliers,
            touched_boards::{self, Boards},
            views_and_touches::{self, Joint, held_out_views},
        },
    },
    estimate::{
        JointFit, Problem,
        evaluate::{self, Estimator, HeldOut},
        predict::Volume,
        touch_pairs::{self, TouchPairs},
    },
    findings::TouchFinding,
    mistakes,
    solve::{self, Method, consensus::Consensus, least_squares::Matrix12},
};
use judge::{Judge, Judged};
use registered::stored_registration;

/// What is known once a candidate is chosen.
pub(crate) struct Estimated<'a> {
    pub evidence: Evidence,
    /// The views as they were fitted; `None` where nothing could be.
    pub views: Option<Views<'a>>,
    /// The fit in which the arm deviates, where the choice rests on it.
    pub with_arm: Option<JointFit>,
}

/// Makes and judges all candidates, chooses one, and reports the touches.
pub(crate) fn estimate<'a>(
    mut views: Views<'a>,
    found: &Consensus,
    optics: &Optics,
    task: &Task,
    agreed: Evidence,
) -> Estimated<'a> {
    let diversity = Some(evaluate::diversity(&pairs_of(&views)));
    let mut evidence = Evidence { diversity, ..agreed };
    let fitted = match fit_views(&mut views, found, optics, task) {
        Ok(fitted) => fitted,
        Err(error) => {
            let open = Notes::undetermined(error, camera_in_words(views.session.setup));
            evidence.notes.add(open);
            return Estimated { evidence, views: None, with_arm: None };
        }
    };
    let (factor, later) = (unknown::scale(&fitted.fit), unknown::clock(&fitted.fit));
    evidence.unit_and_clock = task.unknown.found(factor, later);
    let Some(volume) = volume(&views, &fitted.fit) else {
        return Estimated { evidence, views: None, with_arm: None };
    };
    let (evidence, with_arm) = fuse(&views, &fitted, &volume, optics, task, evidence);
    Estimated { evidence, views: Some(views), with_arm }
}

/// The fit of views and touches, what it says of camera, depth, tip and arm, and the choice of a candidate.
fn fuse(
    views: &Views,
    Averaged { problem, fit, as_declared }: &Averaged,
    volume: &Volume,
    optics: &Optics,
    task: &Task,
    mut evidence: Evidence,
) -> (Evidence, Option<JointFit>) {
    let config = task.config;
    // touches as pairs of points, for the two-step refinement and reports; below as boards, for the fit
    let (paired, unseen) = residuals::pair_touches(views, fit);
    let (boards, trusted, wrong) = right_touches(views, &paired, optics, (problem, fit));
    let joint = views_and_touches::fit(views, &boards, &problem.extras, fit, &config.known);
    let touched = UsedTouches {
        used: joint.as_ref().map_or(&[][..], |j| &j.used),
        wrong_tip: joint.as_ref().is_some_and(|j| j.wrong_tip.is_some()),
    };
    let (best, whole) = joint.as_ref().map_or((fit, problem), |j| (&j.fit, &j.problem));
    let robot = Robot::estimated(views, (whole, best), touched, volume, config);
    let of_joint = |j: &views_and_touches::Joint| j.findings(views, robot.explains_tip());
    let (tip, of_touches) = joint.as_ref().map(of_joint).unwrap_or_default();
    evidence.notes.add(unseen.then(wrong).then(of_touches));
    let as_declared = joint.as_ref().map_or(*as_declared, |j| j.as_declared);
    let of_size = (1.0 + optics.size, as_declared.size);
    // what a robot errs by place looks like another size, too
    let of_robot = robot.best((whole, best)).1;
    let mut evidence = with_size(evidence, views, (fit, of_robot), of_size, task);
    let (determined, open) = name_free(views, fit, best);
    let known = Notes::of(known_position::judge(whole, best, views, &config.known));
    evidence.notes.add(open.then(known));
    let without = (whole, best);
    let (whole, best) = robot.best(without);
    let refined = optics.refined(views.session, best, as_declared);
    let measured = MeasuredBy { unit_is_free: task.unknown.scale.is_some(), as_declared };
    let workpiece = Workpiece::new(views, volume, best, measured, robot.reach());
    // it goes with the answer for such a robot, and a method asked for by name gives another one
    let compensation = match config.method {
        None => robot.compensation(views, without, &workpiece, config),
        Some(_) => None,
    };
    evidence.notes.add(robot.notes(compensation.as_ref(), &workpiece).then(refined.notes));
    let has_board = views.session.target.is_some();
    let evidence = Evidence {
        determined,
        tip,
        camera: refined.camera,
        depth: refined.depth,
        arm: robot.arm(views, &workpiece),
        compensation,
        error_budget: budget::budget(whole, best, &workpiece, has_board),
        advice: budget::advice(whole, best, &workpiece, has_board),
        ..evidence
    };
    let judge =
        Judge { views, paired: &trusted, config, workpiece: &workpiece, of_robot: robot.errors() };
    let evidence = compare(&judge, (fit, joint.as_ref()), (volume, &paired), task, evidence);
    let rests_on_arm = rests_on_arm(&evidence);
    (evidence, rests_on_arm.then_some(robot).and_then(Robot::into_fit_of_arm))
}

fn rests_on_arm(evidence: &Evidence) -> bool {
    let choice = evidence.choice.as_ref();
    choice.is_some_and(|c| c.rests_on == RestsOn::BothFor(RobotErrorKind::OfArm))
}

/// With what views and touches say of the target's size, unless the answer is rejected anyway.
fn with_size(
    mut evidence: Evidence,
    views: &Views,
    fits: (&JointFit, &JointFit),
    declared: (f64, f64),
    task: &Task,
) -> Evidence {
    if evidence.notes.rejects {
        return evidence;
    }
    if let Some((scale, said)) = size::judge(views, fits, declared, task) {
        evidence.target_scale = Some(scale);
        evidence.notes.add(said);
    }
    evidence
}

/// Makes all candidates and chooses one; a method asked for by name is judged alone.
fn compare(
    judge: &Judge,
    (fit, joint): (&JointFit, Option<&Joint>),
    (volume, paired): (&Volume, &[TouchPairs]),
    task: &Task,
    mut evidence: Evidence,
) -> Evidence {
    let (views, config) = (judge.views, task.config);
    let mut candidates = judge.view_candidates(fit, joint.is_some(), config);
    let (of_touches, notes) = judge.touch_candidates(fit, config);
    evidence.notes.add(notes);
    candidates.extend(of_touches);
    if config.method.is_none() {
        candidates.extend(joint.and_then(|j| judge.joint_candidate(j)));
        candidates.extend(judge.robot_candidate(fit));
    } else if candidates.is_empty() && !evidence.is_open() {
        evidence.notes.add(named::failure(views, config).unwrap_or_default());
    }
    let mut chosen = choose(&candidates, judge.workpiece, volume, config);
    if config.method.is_some() {
        evidence.unit_and_clock = named::unit(views, task, &evidence);
        if evidence.is_open() && !evidence.notes.rejects {
            let own = chosen.map(|(own, _)| own).unwrap_or_default();
            chosen = Some(named::by_likeliest(views, fit, config, &evidence, own));
        }
    }
    if let Some((choice, held_out)) = &mut chosen {
        evidence.captures = residuals::held_out(views, held_out, evidence.captures);
        evidence.touches = touches_at(choice, judge, paired, joint);
        let x = choice.hand_eye.mount_from_camera.as_ref();
        if let (Some(tre), Some(x)) = (&mut choice.predicted_tre_mm, x) {
            tre.map = judge.workpiece.map(x);
        }
    }
    let candidates = candidates.into_iter().map(|c| c.candidate).collect();
    Evidence { choice: chosen.map(|(choice, _)| choice), candidates, ..evidence }
}

/// The likeliest answer of views alone, and what it says beside both poses.
fn fit_views(
    views: &mut Views,
    found: &Consensus,
    optics: &Optics,
    task: &Task,
) -> Result<Averaged, Error> {
    if !optics.extras.is_empty() {
        views.views = optics::with_sights(views);
    }
    task.unknown.set_free(views, &found.hand_eye);
    let extras = [optics.extras.as_slice(), &task.unknown.extras()].concat();
    let problem = views::views_problem(views.session, &views.views, &extras);
    let alternatives = Alternatives::of(views.session);
    let mut averaged = alternatives.fit(&problem, &found.hand_eye, &task.config.known)?;
    residuals::orient_target(views, &mut averaged.fit);
    let problem = views::views_problem(views.session, &views.views, &averaged.problem.extras);
    Ok(Averaged { problem, ..averaged })
}

/// The touches that can be of the corners they name, by board and by pair, and what is said of the others.
fn right_touches(
    views: &Views,
    paired: &[TouchPairs],
    optics: &Optics,
    (problem, fit): (&Problem, &JointFit),
) -> (Boards, Vec<TouchPairs>, Notes) {
    let mut boards = touched_boards::boards(views, fit, optics);
    let wrong = touch_outliers::find(views, &boards, problem, fit);
    wrong.remove_from(&mut boards);
    let right = |p: &&TouchPairs| !wrong.which.contains(&p.touch);
    let trusted = paired.iter().filter(right).cloned().collect();
    (boards, trusted, wrong.notes)
}

/// What the best answer leaves unconstrained, and what views alone would.
fn name_free(views: &Views, fit: &JointFit, best: &JointFit) -> (Option<Determined>, Notes) {
    let (setup, pairs) = (views.session.setup, pairs_of(views));
    let free = mistakes::free_directions(best);
    if !free.is_empty() {
        let undetermined = mistakes::in_words(&free, &pairs, setup);
        let determined = verdict::determined(&best.hand_eye.mount_from_camera, &free);
        return (Some(determined), Notes { undetermined, ..Notes::default() });
    }
    let by_views = mistakes::free_directions(fit);
    let alone = (!by_views.is_empty()).then(|| {
        let what = mistakes::in_words(&by_views, &pairs, setup).join(", ");
        TouchFinding::AloneDetermine { what }
    });
    (None, Notes::of(alone))
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
            let left_out = held_out_views(&problem, fit, self.config);
            let mut own = self.judged(fit, likeliest.into(), &fit.hand_eye, left_out);
            own.candidate.in_sample =
                evaluate::in_sample(&fit.hand_eye, &as_fitted(fit, &self.views.views));
            own.seen = Some(seen_by(fit, self.views));
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
        let left_out =
            evaluate::held_out(estimator, &views.views, &fit.hand_eye, self.config.threads);
        Some(self.judged(fit, name, &answer, left_out))
    }

    /// An answer from views, and what it missed when each was left out.
    fn judged(&self, fit: &JointFit, name: String, answer: &HandEye, left_out: HeldOut) -> Judged {
        let views = self.views;
        let x = answer.mount_from_camera;
        let held_out = evaluate::rms(&left_out);
        let touch_rms = touch_pairs::touch_rms(self.paired, &x).map(|m| m * 1e3);
        let covariance =
            stated_covariance(fit).map(|c| self.of_both(c + excess(&fit.hand_eye, answer), answer));
        let candidate = Candidate {
            name,
            hand_eye: stored(views, answer, covariance.as_ref()),
            in_sample: evaluate::in_sample(answer, &views.views),
            held_out,
            touch_rms_mm: touch_rms,
            held_out_mm: touch_rms.or(held_out.translation_rms_mm),
            predicted_tre_mm: self.workpiece.predicted_rms_mm(&x),
            note: None,
        };
        Judged { rests_on: RestsOn::Views, candidate, held_out: left_out, seen: None }
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
        let left_out = held_out_views(&joint.problem, fit, self.config);
        let held_out = evaluate::rms(&left_out);
        let covariance = stated_covariance(fit).map(|c| self.of_both(c, &fit.hand_eye));
        let touch_held_out = joint.held_out_touches(self.config).map(|m| m * 1e3);
        let candidate = Candidate {
            name: "joint".into(),
            hand_eye: stored(self.views, &fit.hand_eye, covariance.as_ref()),
            in_sample: evaluate::in_sample(&fit.hand_eye, &as_fitted(fit, &self.views.views)),
            held_out,
            touch_rms_mm: joint.touch_rms().map(|m| m * 1e3),
            held_out_mm: touch_held_out.or(held_out.translation_rms_mm),
            predicted_tre_mm: self.workpiece.predicted_rms_mm(&x),
            note: joint.note(),
        };
        let seen = Some(seen_by(fit, self.views));
        Some(Judged { rests_on: RestsOn::Both, candidate, held_out: left_out, seen })
    }
}

impl Judge<'_> {
    /// The answer that does best for a robot that errs by its arm or by place, and does not know.
    fn robot_candidate(&self, fit: &JointFit) -> Option<Judged> {
        let (errors, (x, covariance)) = self.of_robot.zip(self.workpiece.rigid())?;
        let note = match (errors, self.paired.is_empty()) {
            (RobotErrorKind::OfArm, _) => NOTE_WITH_ARM,
            (RobotErrorKind::ByPlace, true) => NOTE_BY_PLACE,
            (RobotErrorKind::ByPlace, false) => NOTE_BY_PLACE_TOUCHED,
        };
        let views = self.views;
        // as robots report them, and as the camera and the target that were found show them
        let (fitted, seen) = (as_fitted(fit, &views.views), seen_by(fit, views));
        let placed = solve::place_target(&seen.pairs, &x);
        let held_out = evaluate::placed_without(&fitted, &x);
        let missed = evaluate::rms(&held_out);
        let touch_rms = touch_pairs::touch_rms(self.paired, &x).map(|m| m * 1e3);
        let candidate = Candidate {
            name: errors.candidate().into(),
            hand_eye: stored_registration(views, fit, &placed, Some(&covariance)),
            in_sample: evaluate::in_sample(&placed, &fitted),
            held_out: missed,
            touch_rms_mm: touch_rms,
            // no touch was left out of it
            held_out_mm: if touch_rms.is_some() { None } else { missed.translation_rms_mm },
            predicted_tre_mm: self.workpiece.predicted_rms_mm(&x),
            note: Some(note.into()),
        };
        let seen = Some(seen);
        Some(Judged { rests_on: RestsOn::BothFor(errors), candidate, held_out, seen })
    }
}

/// What to know of such answers.
const NOTE_WITH_ARM: &str = "the arm's deviations are found, and the answer is made for the tool as it was held, where \
                             it is used: elsewhere views and touches may fit it worse";
const NOTE_BY_PLACE: &str = "robot errors by place are part of the model: the answer is the rigid transform that fits best \
                             at the captures";
const NOTE_BY_PLACE_TOUCHED: &str = "robot errors by place are part of the model: the answer is the rigid transform that \
                                     comes closest to where the tool must be sent, held as in the touches";

/// The least predicted error wins; the residual has no say. With the choice comes the leave-one-out residual of each view.
fn choose(
    candidates: &[Judged],
    workpiece: &Workpiece,
    volume: &Volume,
    config: &Config,
) -> Option<(Choice, HeldOut)> {
    let predicted = candidates.iter().filter(|c| c.candidate.predicted_tre_mm.is_some());
    let best = predicted.min_by(|a, b| by_prediction(a, b)).or(candidates.last())?;
    let x = best
        .candidate
        .hand_eye
        .mount_from_camera
        .filter(|_| best.candidate.predicted_tre_mm.is_some());
    let choice = Choice {
        name: Some(best.candidate.name.clone()),
        rests_on: best.rests_on,
        why: why(best, candidates, volume, config),
        hand_eye: best.candidate.hand_eye,
        predicted_tre_mm: x.and_then(|x| workpiece.tre(&x)),
        residual: best.candidate.in_sample,
        held_out: best.candidate.held_out,
        seen: best.seen.clone(),
    };
    Some((choice, best.held_out.clone()))
}

fn by_prediction(a: &Judged, b: &Judged) -> std::cmp::Ordering {
    let rms = |c: &Judged| c.candidate.predicted_tre_mm.unwrap_or(f64::INFINITY);
    rms(a).total_cmp(&rms(b))
}

fn why(best: &Judged, all: &[Judged], volume: &Volume, config: &Config) -> String {
    if let Some(method) = config.method {
        return format!("{} was asked for by name", method.name());
    }
    let Some(rms) = best.candidate.predicted_tre_mm else {
        return "no candidate has a predicted error".into();
    };
    let others: Vec<String> = all
        .iter()
        .filter(|c| c.candidate.name != best.candidate.name)
        .filter_map(|c| {
            Some(format!("{} {:.2} mm", c.candidate.name, c.candidate.predicted_tre_mm?))
        })
        .collect();
    format!(
        "{} has the least predicted error in {}: {:.2} mm (the others: {})",
        best.candidate.name,
        volume.name,
        rms,
        others.join(", ")
    )
}

/// Where the chosen answer puts each touched corner.
fn touches_at(
    choice: &Choice,
    judge: &Judge,
    paired: &[TouchPairs],
    joint: Option<&Joint>,
) -> Vec<TouchResult> {
    let Some(x) = choice.hand_eye.mount_from_camera else { return vec![] };
    let is_used = |touch: usize| match choice.rests_on {
        RestsOn::Views => false,
        RestsOn::Both | RestsOn::BothFor(_) => joint.is_some_and(|j| j.used.contains(&touch)),
        RestsOn::Touches => judge.paired.iter().any(|p| p.touch == touch),
    };
    let one = |p: &TouchPairs| {
        let difference_mm = touch_pairs::touch_error(p, &x) * 1e3;
        TouchResult {
            capture: p.placement.clone(),
            corner: judge.views.session.touches[p.touch].corner,
            residual_mm: difference_mm.norm(),
            difference_mm,
            used: is_used(p.touch),
        }
    };
    paired.iter().map(one).collect()
}
