//! Which captures agree with each other, and on which reading of each picture.

use nalgebra::Vector3;

use super::{doubt, gate, movement, rejected};
use crate::{
    Error, Observation, Pose, PosePair, Target,
    calibrate::{
        evidence::Evidence,
        notes::Notes,
        rejected::Rejected,
        unknown::Task,
        views::{self, Captures, FARTHEST, Views},
    },
    estimate::{
        JointFit,
        evaluate::{self, Diversity},
    },
    findings::{CaptureFinding, RobotFinding, robot::Inverted},
    math::linalg::median,
    mistakes::{self, Convention},
    model::session::Session,
    solve::{
        consensus::{self, Consensus, Readings},
        motions,
    },
};

/// What is said of a session no captures of which agree.
fn no_consensus(
    session: &Session,
    readings: &[Readings],
    error: &Error,
) -> (Option<Diversity>, Notes) {
    let pairs: Vec<PosePair> = readings
        .iter()
        .filter_map(|r| {
            let camera_from_target = *r.camera_from_target.first()?;
            Some(PosePair { anchor_from_mount: r.anchor_from_mount, camera_from_target })
        })
        .collect();
    let open = Notes::open(error, views::camera_in_words(session.setup));
    if let Error::TooFewPoses { .. } = error {
        return (None, open);
    }
    let diversity = (pairs.len() > 1).then(|| evaluate::diversity(&pairs));
    if !motions::rotates(&pairs) {
        return (diversity, open);
    }
    let inverted = suspect_conventions(readings, bare(session), None).unwrap_or_default();
    (diversity, Notes { rejects: true, ..inverted.then(open) })
}

/// An inversion explains the data when most captures agree under it, the misfit in position falls
/// to less than this part, and that in rotation does not rise (rotations alone often fit both ways).
const EXPLAINS: f64 = 0.2;
/// Of fewer captures than this only a misfit (m) as large as an inversion brings is to be explained.
const FEWEST_TO_JUDGE: usize = 5;
const LARGE: f64 = 0.01;
/// A misfit (m) up to this is rounding: there is nothing to explain.
const ROUNDING: f64 = 1e-7;

/// Robot poses inverted, target poses inverted, and the other setup can explain the same data equally well; target
/// poses from our own detection are not in doubt.
fn inversion(
    explaining: &[&mistakes::Evidence],
    best: &mistakes::Evidence,
    bare: bool,
) -> Inverted {
    let alike = |c: Convention| {
        explaining.iter().any(|e| e.convention == c && e.median_m < 2.0 * best.median_m)
    };
    match (alike(Convention::RobotInverted), bare && alike(Convention::TargetInverted)) {
        (true, true) => Inverted::Either,
        (false, true) => Inverted::Target,
        _ => Inverted::Robot,
    }
}

/// Poses that are inverted, where most captures agree as soon as they are turned round.
fn suspect_conventions(
    readings: &[Readings],
    bare: bool,
    found: Option<&Consensus>,
) -> Option<Notes> {
    let all = mistakes::conventions(readings, found);
    let declared = all.iter().find(|e| e.convention == Convention::AsDeclared).copied();
    let better = |e: &&mistakes::Evidence| {
        e.convention != Convention::AsDeclared
            && (bare || e.convention != Convention::TargetInverted)
            && 2 * e.agree > readings.len()
            && declared.is_none_or(|d| {
                // a few captures can be left out until the rest fits anything, and fit anything themselves
                d.median_m > if readings.len() < FEWEST_TO_JUDGE { LARGE } else { ROUNDING }
                    && e.agree >= d.agree
                    && e.median_m < EXPLAINS * d.median_m
                    && e.median_rad < 1.2 * d.median_rad + 1e-3
            })
    };
    let explaining: Vec<&mistakes::Evidence> = all.iter().filter(better).collect();
    let best = explaining.iter().min_by(|a, b| a.median_m.total_cmp(&b.median_m))?;
    Some(Notes::against(RobotFinding::Inverted {
        which: inversion(&explaining, best, bare),
        before_mm: declared.map(|d| d.median_m * 1e3),
        after_mm: best.median_m * 1e3,
    }))
}

/// The captures that agree.
pub(super) struct Agreement<'a> {
    pub views: Views<'a>,
    pub found: Consensus,
    /// Something that moved between captures.
    pub movement: Option<movement::Suspected>,
}

/// Finds the agreement, if there is one, names what does not agree, and hands on what does.
pub(super) fn agree<'a>(session: &'a Session, task: &Task) -> (Evidence, Option<Agreement<'a>>) {
    let shift = session.target.as_ref().map_or(Vector3::zeros(), |t| t.reference().vector());
    let target_from_corner: Pose<Target, Target> =
        Pose::claim(nalgebra::Isometry3::translation(shift.x, shift.y, shift.z));
    let readings: Vec<Readings> =
        session.observations.iter().map(|o| readings(session, o, &target_from_corner)).collect();
    let all = Evidence::of_captures(session, task.unknown.open());
    let found = match consensus::consensus(&readings) {
        Ok(found) => found,
        Err(error) => return (none_agree(session, &readings, &error, all), None),
    };
    let captures = Captures { session, readings: &readings, target_from_corner };
    let (found, fit) = gate::gate(&captures, found, task.config);
    let indices: Vec<usize> = (0..readings.len()).filter(|&i| found.agrees[i]).collect();
    let used: Vec<&Observation> = indices.iter().map(|&i| &session.observations[i]).collect();
    let evidence = some_agree(&captures, (&found, &used), fit.as_ref(), all);
    let of = |&i: &usize| captures.view(i, found.reading[i]);
    let views = Views {
        session,
        used,
        views: indices.iter().map(of).collect(),
        target_from_corner,
        indices,
    };
    let movement = fit.and_then(|fit| movement::look(&captures, &found, &fit));
    (evidence, Some(Agreement { views, found, movement }))
}

/// What is known where no captures agree.
fn none_agree(
    session: &Session,
    readings: &[Readings],
    error: &Error,
    mut all: Evidence,
) -> Evidence {
    all.captures.iter_mut().for_each(|c| c.used = false);
    let units = suspect_units(&session.observations.iter().collect::<Vec<_>>());
    let (diversity, open) = no_consensus(session, readings, error);
    let mistake = doubt::suspect_whole(readings, session.target.as_ref(), None);
    let (mistake, target_scale) = mistake.unwrap_or_default();
    Evidence { diversity, target_scale, notes: mistake.then(units).then(open), ..all }
}

/// What is known where some do: why the others do not, and whether those are the right ones.
fn some_agree(
    captures: &Captures,
    (found, used): (&Consensus, &[&Observation]),
    fit: Option<&JointFit>,
    all: Evidence,
) -> Evidence {
    let (session, readings) = (captures.session, captures.readings);
    let units = suspect_units(used);
    let Rejected { captures: reported, names, notes } =
        rejected::name(captures, found, fit, all.captures);
    let mistake = doubt::suspect_whole(readings, session.target.as_ref(), Some(found));
    let inverted = || {
        let notes = suspect_conventions(readings, bare(session), Some(found))?;
        Some((notes, None))
    };
    let (mistake, target_scale) = mistake.or_else(inverted).unwrap_or_default();
    let notes = mistake.then(units).then(notes).then(few(used.len()));
    Evidence { captures: reported, rejected: names, target_scale, notes, ..all }
}

/// Fewer captures than this are answered with a warning.
const FEW: usize = 8;

fn few(used: usize) -> Notes {
    Notes::of((used < FEW).then_some(CaptureFinding::Few { used, of_a_ball: false }))
}

/// Millimetres read as metres put the flange beyond any robot's reach, and the target beyond any
/// camera's. Captures that do not belong have no say.
fn suspect_units(used: &[&Observation]) -> Notes {
    let reach = |o: &&Observation| o.base_from_flange.translation().norm();
    let far = used.iter().map(reach).fold(0.0, f64::max);
    let distance = |o: &&Observation| {
        let seen = o.candidates.first()?;
        Some(seen.camera_from_target.translation().norm())
    };
    let distance = median(used.iter().filter_map(distance));
    let target =
        (distance > FARTHEST).then_some(RobotFinding::TargetLengthUnit { distance_m: distance });
    let robot = (far > FARTHEST).then_some(RobotFinding::LengthUnit { farthest_m: far });
    let all = target.into_iter().chain(robot).map(Notes::against);
    all.fold(Notes::default(), Notes::then)
}

/// Whether the target poses came from elsewhere; those of scanned shapes are our own, with a covariance.
fn bare(session: &Session) -> bool {
    let mut poses = session.observations.iter().flat_map(|o| &o.candidates);
    session.observations.iter().all(|o| o.corners.is_empty())
        && (session.target.is_some() || poses.all(|pose| pose.covariance.is_none()))
}

fn readings(
    session: &Session,
    o: &Observation,
    target_from_corner: &Pose<Target, Target>,
) -> Readings {
    let about_corner = |c: &crate::TargetPose| c.camera_from_target * *target_from_corner;
    Readings {
        anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
        camera_from_target: o.candidates.iter().map(about_corner).collect(),
    }
}
