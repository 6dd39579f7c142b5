//! Which captures agree with each other, and on which reading of each picture.

use nalgebra::Vector3;

use super::{doubt, gate, movement, rejected};
use crate::{
    Error, Observation, Pose, PosePair, Target,
    calibrate::{
        config::Config,
        result::Calibration,
        views::{Captures, Views, first_report},
    },
    estimate::evaluate,
    findings::CaptureFinding,
    mistakes,
    model::{session::Session, verdict::Verdict},
    solve::{
        consensus::{self, Consensus, Readings},
        motions,
    },
};

fn no_consensus(session: &Session, readings: &[Readings], error: &Error, result: &mut Calibration) {
    for capture in &mut result.captures {
        capture.used = false;
    }
    let pairs: Vec<PosePair> = readings
        .iter()
        .filter_map(|r| {
            let camera_from_target = *r.camera_from_target.first()?;
            Some(PosePair { anchor_from_mount: r.anchor_from_mount, camera_from_target })
        })
        .collect();
    if let Error::TooFewPoses { .. } = error {
        result.reasons.push(error.to_string());
        result
            .undetermined
            .push(format!("the pose of the camera on the {}", session.setup.mount()));
        return;
    }
    result.diversity = (pairs.len() > 1).then(|| evaluate::diversity(&pairs));
    result.reasons.push(error.to_string());
    result.undetermined.push(format!("the pose of the camera on the {}", session.setup.mount()));
    if !motions::rotates(&pairs) {
        return;
    }
    result.verdict = Verdict::Rejected;
    suspect_conventions(readings, bare(session), None, result);
}

fn suspect_conventions(
    readings: &[Readings],
    bare: bool,
    found: Option<&Consensus>,
    result: &mut Calibration,
) {
    let Some(finding) = mistakes::inverted::inverted(readings, found, bare) else { return };
    result.reasons.push(finding.message());
    result.warnings.insert(0, finding.into());
    result.verdict = Verdict::Rejected;
}

/// The captures that agree.
pub(super) struct Agreement<'a> {
    pub views: Views<'a>,
    pub found: Consensus,
    /// Something that moved between captures.
    pub movement: Option<movement::Suspected>,
}

/// Finds the agreement, names what does not agree, and hands on what does.
pub(super) fn agree<'a>(
    session: &'a Session,
    config: &Config,
    result: &mut Calibration,
) -> Option<Agreement<'a>> {
    let shift = session.target.as_ref().map_or(Vector3::zeros(), |t| t.reference().vector());
    let target_from_corner: Pose<Target, Target> =
        Pose::claim(nalgebra::Isometry3::translation(shift.x, shift.y, shift.z));
    let readings: Vec<Readings> =
        session.observations.iter().map(|o| readings(session, o, &target_from_corner)).collect();
    result.captures = session.observations.iter().map(first_report).collect();
    let found = match consensus::consensus(&readings) {
        Ok(found) => found,
        Err(error) => {
            suspect_units(&session.observations.iter().collect::<Vec<_>>(), result);
            no_consensus(session, &readings, &error, result);
            doubt::suspect_order_or_size(&readings, session, None, result);
            return None;
        }
    };
    let captures = Captures { session, readings: &readings, target_from_corner };
    let (found, fit) = gate::gate(&captures, found, config);
    let indices: Vec<usize> = (0..readings.len()).filter(|&i| found.agrees[i]).collect();
    let used: Vec<&Observation> = indices.iter().map(|&i| &session.observations[i]).collect();
    suspect_units(&used, result);
    rejected::name(&captures, &found, fit.as_ref(), result);
    if !doubt::suspect_order_or_size(&readings, session, Some(&found), result) {
        suspect_conventions(&readings, bare(session), Some(&found), result);
    }
    let of = |&i: &usize| captures.view(i, found.reading[i]);
    warn_few(indices.len(), result);
    let views = Views {
        session,
        used,
        views: indices.iter().map(of).collect(),
        target_from_corner,
        indices,
    };
    let movement = fit.and_then(|fit| movement::look(&captures, &found, &fit));
    Some(Agreement { views, found, movement })
}

/// Fewer captures than this are answered with a warning.
const FEW: usize = 8;

fn warn_few(used: usize, result: &mut Calibration) {
    if used < FEW {
        result.warnings.push(CaptureFinding::Few { used, of_a_ball: false }.into());
    }
}

fn suspect_units(used: &[&Observation], result: &mut Calibration) {
    for finding in mistakes::unit::wrong_units(used) {
        result.reasons.push(finding.message());
        result.warnings.push(finding.into());
        result.verdict = Verdict::Rejected;
    }
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
