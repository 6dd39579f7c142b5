//! Which captures agree with each other, and on which reading of each image.

use nalgebra::Vector3;

use super::{
    doubt, gate, movement,
    rejected::{self, Rejected},
};
use crate::{
    Error, Observation, Pose, PosePair, Target,
    calibrate::flow::{
        evidence::Evidence,
        limits::FEW,
        notes::Notes,
        unknown::Task,
        views::{self, Captures, Views},
    },
    estimate::{
        JointFit,
        evaluate::{self, Diversity},
    },
    findings::CaptureFinding,
    mistakes::{inverted::inverted, unit::wrong_units},
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
    let open = Notes::undetermined(error, views::camera_in_words(session.setup));
    if let Error::TooFewPoses { .. } = error {
        return (None, open);
    }
    let diversity = (pairs.len() > 1).then(|| evaluate::diversity(&pairs));
    if !motions::rotates(&pairs) {
        return (diversity, open);
    }
    let inverted = inverted(readings, None, bare(session)).map(Notes::against);
    (diversity, Notes { rejects: true, ..inverted.unwrap_or_default().then(open) })
}

/// The captures that agree.
pub(crate) struct Agreement<'a> {
    pub views: Views<'a>,
    pub found: Consensus,
    /// Something that moved between captures.
    pub movement: Option<movement::Suspected>,
}

/// Finds the agreement, if there is one, names what does not agree, and hands on what does.
pub(crate) fn agree<'a>(session: &'a Session, task: &Task) -> (Evidence, Option<Agreement<'a>>) {
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
    let movement = fit.and_then(|fit| movement::suspected(&captures, &found, &fit));
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
    let units = units(&session.observations.iter().collect::<Vec<_>>());
    let (diversity, open) = no_consensus(session, readings, error);
    let mistake = doubt::order_or_size(readings, session, None);
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
    let units = units(used);
    let Rejected { captures: reported, names, notes } =
        rejected::name(captures, found, fit, all.captures);
    let mistake = doubt::order_or_size(readings, session, Some(found));
    let inverted = || Some((Notes::against(inverted(readings, Some(found), bare(session))?), None));
    let (mistake, target_scale) = mistake.or_else(inverted).unwrap_or_default();
    let notes = mistake.then(units).then(notes).then(few(used.len()));
    Evidence { captures: reported, rejected: names, target_scale, notes, ..all }
}

fn few(used: usize) -> Notes {
    Notes::of((used < FEW).then_some(CaptureFinding::Few { used, of_a_ball: false }))
}

fn units(used: &[&Observation]) -> Notes {
    wrong_units(used).into_iter().map(Notes::against).fold(Notes::default(), Notes::then)
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
