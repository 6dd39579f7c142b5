//! From measurements to a calibration with a verdict: the flow of the whole core.
//!
//! [`calibrate`] is the only entry point. What it asks, in the order in which it asks:
//!
//! | room | question |
//! |---|---|
//! | `unknowns` | the robot's pose at each capture's time (`streams`); the unit of distances where that is unknown (`unscaled`) |
//! | `captures` | which captures repeat one another, which agree, on which pose candidate (`agreement`)? |
//! | `optics` | where size, intrinsics or depth move far, all target poses are computed again |
//! | `candidates` | closed forms, least squares, maximum likelihood and registration of touches; the choice by predicted error. It asks `touches` (which are of another corner; the fit of views and touches together), `robot` (`arm`: is it as its model says? `place`: does it err by place?) and `prediction` (how far off points will be) |
//! | `captures` | residual of every capture; did anything move (`movement`), and what does that do to the answer (`moved`)? Captures of one place count once (`near_duplicates`), and all runs again; do errors drift (`sequence`)? |
//! | `scans` | image frame or scan frame, where the two disagree (`sources`); what the scans say of the board |
//!
//! What is handed from stage to stage stands in `flow`: every stage returns its value and its `notes`; `evidence` gathers
//! them, and `verdict` alone makes a [`Calibration`] of it. What looks at the result as a whole makes a new one, as does
//! `result::beside` (what was noticed while files were read). Sessions without images of a target, point pairs and
//! captures of a ball, take the short way through `points`.

mod candidates;
mod captures;
mod flow;
mod optics;
mod points;
mod prediction;
pub mod result;
mod robot;
mod scans;
mod touches;
mod unknowns;

pub(crate) use captures::residuals::readings;

use crate::{
    Error, Session, TargetModel, calibrate::result::Calibration, estimate::touch_pairs,
    model::session::Motion,
};

use candidates::Estimated;
pub use captures::residuals::relabelling;
use captures::{
    agreement::{self, Agreement},
    moved, movement, near_duplicates, repeated, residuals, sequence,
};
pub use flow::{
    config::{AnswerFrame, Config},
    evidence::unjudged,
};
use flow::{
    evidence::Evidence,
    notes::Notes,
    unknown::{Task, Unknown},
    verdict, views,
};
use optics::Optics;
use points::{balls, pairs};
pub use result::{beside, certificate, findings};
use scans::sources;
pub use unknowns::streams;
use unknowns::unscaled;

/// Runs the whole calibration. Bad data end in a verdict, not in an error.
///
/// # Errors
/// [`Error::Invalid`] when the session holds nothing to calibrate from, or what has a unit of its own beside distances of
/// unknown scale; where the robot was in motion, [`Error::NotFinite`] on times and poses that are no numbers, and
/// [`Error::TooFewSamples`] without robot poses or captures that show the target.
pub fn calibrate(session: &Session, config: &Config) -> Result<Calibration, Error> {
    if let Some(motion) = &session.motion {
        return in_motion(session, motion, config);
    }
    check(session)?;
    let session = session.in_order();
    let unknown = Unknown::of(&session);
    if !session.unknown_scale {
        return of_captures(session, &Task { config, unknown });
    }
    match unscaled::in_metres(&session, config) {
        Ok((session, scale)) => {
            let unknown = Unknown { scale: Some(scale), ..unknown };
            of_captures(session, &Task { config, unknown })
        }
        Err(error) => {
            let unknown = Unknown { scale: Some(1.0), ..unknown };
            Ok(without_answer(&session, &Task { config, unknown }, &error))
        }
    }
}

/// The calibration of a robot that did not stop: the captures get the robot's poses of their moments.
fn in_motion(session: &Session, motion: &Motion, config: &Config) -> Result<Calibration, Error> {
    let found = streams::synchronize(session, motion, config)?;
    let task = Task { config, unknown: found.unknown };
    let result = match &found.failure {
        None => of_captures(found.session.in_order(), &task)?,
        // at any offset the motions are the same: the calibration names what they leave open
        Some(failure) if failure.motions_may_tell => {
            let unknown = Unknown { time_offset_s: None, ..task.unknown };
            let plain = of_captures(found.session.in_order(), &Task { config, unknown })?;
            streams::without_offset(plain, &failure.error)
        }
        Some(failure) => without_answer(&found.session, &task, &failure.error),
    };
    let first = found.findings(&result);
    Ok(result.noting_first(first))
}

/// The calibration of captures in the order of their names, of which those count that do not repeat one another.
fn of_captures(mut session: Session, task: &Task) -> Result<Calibration, Error> {
    let repeated = repeated::take_out(&mut session);
    let plain = of_distinct(session.clone(), task);
    let with_drift = match session.in_sequence {
        true => sequence::with_drift(&session, task, &plain, |steady| of_distinct(steady, task))?,
        false => None,
    };
    let result = moved::unconfirmed_at_end(&session, with_drift.unwrap_or(plain), task.config);
    Ok(repeated.put_back(result))
}

/// The same of captures in the order of their names, each of which counts.
fn of_distinct(mut session: Session, task: &Task) -> Calibration {
    let mut of_touches = touch_pairs::each_once(&mut session.touches);
    of_touches.extend(touch_pairs::placements_ignored(&session));
    let judged = |found: Evidence| verdict::judge(session.setup, task.config, found);
    if session.observations.is_empty() {
        return judged(pairs::from_points(&session));
    }
    if let Some(TargetModel::Sphere { .. }) = session.target {
        let run = |session: &Session| judged(balls::from_balls(session, task));
        let result = moved::answer_of_the_end(&session, run(&session), run);
        return moved::reported(result, false);
    }
    let config = task.config;
    let run = |session: &Session| {
        sources::in_one_frame(session, config.answer_frame, |session| {
            judged(from_views(session, (session, &Optics::of(session), 0), task))
        })
    };
    let found = run(&session);
    let (session, of_one_place) = near_duplicates::take_out(&session, &found);
    let found = if of_one_place.is_empty() { found } else { run(&session) };
    let result = moved::answer_of_the_end(&session, found, run);
    let scans = scans::of_scans(&session, &result);
    let result = Calibration { scans: scans.result, ..result.noting(scans.warnings) };
    let result = moved::reported(result, scans.is_bent);
    of_one_place.put_back(result).noting(of_touches)
}

/// Refuses a session that holds nothing, or too much.
fn check(session: &Session) -> Result<(), Error> {
    if session.observations.is_empty() && session.correspondences.is_empty() {
        return Err(Error::Invalid(
            "nothing to calibrate from: no captures with a robot pose and a pose or an image of \
             the target, and no point pairs"
                .into(),
        ));
    }
    are_finite(session)?;
    let mut names: Vec<&str> = session.observations.iter().map(|o| o.capture.as_str()).collect();
    names.sort_unstable();
    if let Some(two) = names.windows(2).find(|two| two[0] == two[1]) {
        let what = format!("two captures are called \"{}\": give each a name of its own", two[0]);
        return Err(Error::Invalid(what));
    }
    if session.unknown_scale { unscaled::check(session) } else { Ok(()) }
}

/// Refuses numbers that are none.
fn are_finite(session: &Session) -> Result<(), Error> {
    for o in &session.observations {
        let poses = o.candidates.iter().all(|c| c.camera_from_target.is_finite());
        let others = o.joints.iter().chain(&o.time_s).all(|x| x.is_finite());
        if !(poses && others && o.base_from_flange.is_finite()) {
            let what = "a pose, a joint value or the time is not a finite number; leave it out";
            return Err(Error::Invalid(format!("capture {}: {what}", o.capture)));
        }
    }
    let finite = |v: nalgebra::Vector3<f64>| v.iter().all(|x| x.is_finite());
    let pairs = session.correspondences.iter();
    let points = pairs.flat_map(|c| [c.in_camera.vector(), c.in_mount.vector()]);
    if points.chain(session.touches.iter().map(|t| t.in_base.vector())).all(finite) {
        return Ok(());
    }
    Err(Error::Invalid("a touched or measured point is not a finite number; leave it out".into()))
}

/// Most looks at camera and depth; the second settles it.
const OPTICS_ROUNDS: usize = 3;

/// What views say of `session`, which is `given` with camera and depth moved by `optics`.
fn from_views(
    given: &Session,
    (session, optics, round): (&Session, &Optics, usize),
    task: &Task,
) -> Evidence {
    let (evidence, agreement) = agreement::agree(session, task);
    let Some(Agreement { views, found, movement }) = agreement else { return evidence };
    if round < OPTICS_ROUNDS
        && let Some((moved, next)) =
            optics::moved_session(given, &views, &found.hand_eye, optics, task.config)
    {
        let again = from_views(given, (&moved, &next, round + 1), task);
        if again.choice.as_ref().is_some_and(|c| c.name.is_some()) {
            return again;
        }
    }
    let Estimated { evidence, views, with_arm } =
        candidates::estimate(views, &found, optics, task, evidence);
    let Some(views) = views else { return evidence };
    // an arm that deviates has its own say about the lens: once more from there
    if round <= OPTICS_ROUNDS
        && let Some((moved, next)) = with_arm.and_then(|fit| optics.moved_by(given, &fit))
    {
        let again = from_views(given, (&moved, &next, OPTICS_ROUNDS + 1), task);
        if again.choice.as_ref().is_some_and(|c| c.name.is_some()) {
            return again;
        }
    }
    let evidence = residuals::with_residuals(&views, evidence);
    match movement {
        Some(moved) => movement::covered(moved, evidence),
        None => evidence,
    }
}

/// The result of a session that has no answer, and why.
fn without_answer(session: &Session, task: &Task, error: &Error) -> Calibration {
    let notes = Notes::undetermined(error, views::camera_in_words(session.setup));
    let mut found = Evidence { notes, ..Evidence::of_captures(session, task.unknown.open()) };
    found.captures.iter_mut().for_each(|c| c.used = false);
    verdict::judge(session.setup, task.config, found)
}
