//! From measurements to a calibration with a verdict: the flow of the whole core.
//!
//! `repeated`, `places` (of captures of one place one counts) → `agreement` (which captures agree, and on
//! which reading: `gate`, and `masked` for those that hide one another; why the others do not:
//! `rejected`; whether that is a clear majority: `doubt`) →
//! `candidates` (touches of other corners taken out: `wrong_touches`; closed forms, least squares,
//! maximum likelihood, registration of touches, each judged on what it has not seen; the choice by
//! predicted error; methods by name: `named`; what rests on a given position: `known_position`) →
//! `captures` (misfit of every capture and touch) → `verdict` → `scans` (what they say of board and
//! frames). Point pairs alone take the short way
//! through `points`, captures of a ball through `balls`.

mod agreement;
mod alike;
mod alternatives;
mod answers;
mod arm;
mod balls;
mod boards;
mod budget;
mod candidates;
mod captures;
pub mod certificate;
mod config;
mod doubt;
pub mod findings;
mod gate;
mod joint;
mod known_position;
mod masked;
mod moved;
mod movement;
mod named;
mod offset;
mod optics;
mod places;
mod points;
mod prior;
mod reach;
mod rejected;
pub(crate) mod repeated;
pub mod result;
mod scans;
pub mod sequence;
pub(crate) mod settle;
mod sources;
pub mod streams;
pub(crate) mod unknown;
pub mod unscaled;
mod verdict;
pub(crate) mod views;
mod workpiece;
mod wrong_touches;

use crate::{
    Camera, Error, Mount, Pose, Session, Setup, TargetModel, Warning,
    calibrate::result::{Answer, Calibration, UNJUDGED},
    estimate::{evaluate::Misfit, touches},
    model::verdict::Verdict,
};

use agreement::Agreement;
pub use captures::relabelling;
pub use config::{AnswerFrame, Config};
use optics::Optics;
pub use unknown::Unknown;

/// Version of the result's format.
const FORMAT: &str = "handeye-calibration-1";

/// Runs the whole calibration. Bad data end in a verdict, not in an error.
///
/// # Errors
/// [`Error::Invalid`] when the session holds nothing to calibrate from.
pub fn calibrate(session: &Session, config: &Config) -> Result<Calibration, Error> {
    check(session)?;
    let mut session = session.in_order();
    let repeated = repeated::take_out(&mut session);
    let mut result = calibrate_distinct(session, config);
    repeated.report(&mut result);
    Ok(result)
}

/// The same of captures in the order of their names, each of which counts.
pub(crate) fn calibrate_distinct(mut session: Session, config: &Config) -> Calibration {
    let touched_twice = touches::each_once(&mut session.touches);
    if session.observations.is_empty() {
        let mut result = empty(session.setup);
        points::from_points(&session, &mut result);
        verdict::conclude(config, &mut result);
        return result;
    }
    if let Some(TargetModel::Sphere { .. }) = session.target {
        let run = |session: &Session| {
            let mut result = empty(session.setup);
            balls::from_balls(session, config, &mut result);
            verdict::conclude(config, &mut result);
            result
        };
        let mut result = moved::answer_of_the_end(&session, run(&session), run);
        moved::tell(false, &mut result);
        return result;
    }
    let run = |session: &Session| {
        sources::in_one_frame(session, config.answer_frame, |session| {
            let mut result = from_views(session, (session, &Optics::of(session), 0), config);
            verdict::conclude(config, &mut result);
            result
        })
    };
    let mut found = run(&session);
    let of_one_place = places::take_out(&mut session, &found);
    if !of_one_place.is_empty() {
        found = run(&session);
    }
    let mut result = moved::answer_of_the_end(&session, found, run);
    let bent = scans::report(&session, &mut result);
    moved::tell(bent, &mut result);
    of_one_place.report(&mut result);
    result.warnings.extend(touched_twice.into_iter().map(Warning::from));
    result
}

/// Refuses a session that holds nothing.
pub(crate) fn check(session: &Session) -> Result<(), Error> {
    if session.observations.is_empty() && session.correspondences.is_empty() {
        return Err(Error::Invalid(
            "nothing to calibrate from: no captures with a robot pose and a pose or an image of \
             the target, and no point pairs"
                .into(),
        ));
    }
    Ok(())
}

/// Most looks at camera and depth; the second settles it.
const OPTICS_ROUNDS: usize = 3;

/// Calibrates from `session`, which is `given` with camera and depth moved by `optics`.
fn from_views(
    given: &Session,
    (session, optics, round): (&Session, &Optics, usize),
    config: &Config,
) -> Calibration {
    let mut result = empty(session.setup);
    let Some(agreement) = agreement::agree(session, config, &mut result) else { return result };
    let Agreement { views, found, movement } = agreement;
    if round < OPTICS_ROUNDS
        && let Some((moved, next)) = optics::look(given, &views, &found.hand_eye, optics, config)
    {
        let again = from_views(given, (&moved, &next, round + 1), config);
        if again.chosen.is_some() {
            return again;
        }
    }
    let Some((views, arm)) = candidates::estimate(views, &found, optics, config, &mut result)
    else {
        return result;
    };
    // an arm that deviates has its own say about the lens: once more from there
    if round <= OPTICS_ROUNDS
        && let Some((moved, next)) = arm.and_then(|fit| optics.moved_by(given, &fit))
    {
        let again = from_views(given, (&moved, &next, OPTICS_ROUNDS + 1), config);
        if again.chosen.is_some() {
            return again;
        }
    }
    captures::report_captures(&views, &mut result);
    if let Some(moved) = movement {
        movement::apply(moved, &mut result);
    }
    result
}

/// The result of a session that has no answer.
pub(crate) fn without_answer(session: &Session) -> Calibration {
    let mut result = empty(session.setup);
    result.captures = session.observations.iter().map(views::first_report).collect();
    result.captures.iter_mut().for_each(|c| c.used = false);
    result
}

/// A pose of the camera that comes from elsewhere: nothing was measured here, and nothing is said of its error.
pub fn unjudged(setup: Setup, mount_from_camera: Pose<Mount, Camera>) -> Calibration {
    let mut result = empty(setup);
    result.hand_eye.mount_from_camera = Some(mount_from_camera);
    result.method = UNJUDGED.into();
    result.reasons = vec!["it comes from elsewhere, and nothing was measured here".into()];
    (result.time_offset_s, result.scale) = (None, None);
    result
}

fn empty(setup: Setup) -> Calibration {
    Calibration {
        format: FORMAT.into(),
        setup,
        verdict: Verdict::Undetermined,
        reasons: vec![],
        method: String::new(),
        hand_eye: Answer::default(),
        name: format!("{}_from_camera", setup.mount()),
        chosen: None,
        why: String::new(),
        candidates: vec![],
        predicted_tre_mm: None,
        residual: Misfit::default(),
        held_out: Misfit::default(),
        captures: vec![],
        touches: vec![],
        rejected: vec![],
        undetermined: vec![],
        determined: None,
        diversity: None,
        error_budget: vec![],
        advice: vec![],
        time_offset_s: Some(0.0),
        time_offset_sigma_s: None,
        scale: Some(1.0),
        scale_sigma: None,
        target_scale: None,
        movement: None,
        camera: None,
        depth: None,
        scans: None,
        tip: None,
        arm: None,
        certificate: None,
        warnings: vec![],
        findings: vec![],
        run_id: None,
    }
}
