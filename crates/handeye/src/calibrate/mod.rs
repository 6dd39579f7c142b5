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
mod arm;
mod balls;
mod boards;
mod budget;
mod candidates;
mod captures;
pub mod certificate;
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
mod workpiece;
mod wrong_touches;

use crate::{
    Camera, Error, Mount, Pose, Session, Setup, TargetModel, Warning,
    calibrate::result::{Answer, Calibration, UNJUDGED},
    estimate::{evaluate::Misfit, noise::KnownNoise, touches},
    model::verdict::Verdict,
    register::IcpConfig,
    solve::Method,
};

pub use captures::relabelling;
use optics::Optics;
pub use unknown::Unknown;

/// What the user wants of a calibration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Config {
    /// A published method to run as published, instead of choosing among candidates.
    pub method: Option<Method>,
    /// Parameters of the nearest-neighbour candidate of the two-step refinement.
    pub icp: IcpConfig,
    /// Noise figures that are known.
    pub known: KnownNoise,
    /// Error (95 %, predicted) that the job tolerates, mm.
    pub max_error_mm: Option<f64>,
    /// What is free beside both poses.
    pub unknown: Unknown,
    /// In which frame the answer is, where images and scans do not agree.
    pub answer_frame: AnswerFrame,
}

/// The frame of the camera in which the answer is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AnswerFrame {
    /// That of the scans, where there are any.
    #[default]
    Scan,
    /// That of the images.
    Image,
}

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
            let mut result = empty(session.setup);
            from_views(session, (session, &Optics::of(session), 0), config, &mut result);
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
    result: &mut Calibration,
) {
    let Some((views, found)) = agreement::agree(session, config, result) else { return };
    if round < OPTICS_ROUNDS
        && let Some((moved, next)) = optics::look(given, &views, &found.hand_eye, optics, config)
    {
        let mut again = empty(session.setup);
        from_views(given, (&moved, &next, round + 1), config, &mut again);
        if again.chosen.is_some() {
            *result = again;
            return;
        }
    }
    let Some((views, arm)) = candidates::estimate(views, &found, optics, config, result) else {
        return;
    };
    // an arm that deviates has its own say about the lens: once more from there
    if round <= OPTICS_ROUNDS
        && let Some((moved, next)) = arm.and_then(|fit| optics.moved_by(given, &fit))
    {
        let mut again = empty(session.setup);
        from_views(given, (&moved, &next, OPTICS_ROUNDS + 1), config, &mut again);
        if again.chosen.is_some() {
            *result = again;
            return;
        }
    }
    captures::report_captures(&views, result);
    if let Some(moved) = views.movement {
        movement::apply(moved, result);
    }
}

/// The result of a session that has no answer.
pub(crate) fn without_answer(session: &Session) -> Calibration {
    let mut result = empty(session.setup);
    result.captures = session.observations.iter().map(agreement::first_report).collect();
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
