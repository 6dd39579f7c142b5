//! Which captures agree with each other, and on which reading of each picture.

use nalgebra::Vector3;

use super::{doubt, gate, movement, rejected};
use crate::{
    Error, Observation, Pose, PosePair, Target,
    calibrate::{
        config::Config,
        result::Calibration,
        views::{Captures, FARTHEST, Views, first_report},
    },
    estimate::evaluate,
    findings::{CaptureFinding, RobotFinding, robot::Inverted},
    math::linalg::median,
    mistakes::{self, Convention},
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

fn suspect_conventions(
    readings: &[Readings],
    bare: bool,
    found: Option<&Consensus>,
    result: &mut Calibration,
) {
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
    let Some(best) = explaining.iter().min_by(|a, b| a.median_m.total_cmp(&b.median_m)) else {
        return;
    };
    let finding = RobotFinding::Inverted {
        which: inversion(&explaining, best, bare),
        before_mm: declared.map(|d| d.median_m * 1e3),
        after_mm: best.median_m * 1e3,
    };
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
            if !doubt::suspect_size(&readings, session.target.as_ref(), None, result) {
                doubt::suspect_order(&readings, None, result);
            }
            return None;
        }
    };
    let captures = Captures { session, readings: &readings, target_from_corner };
    let (found, fit) = gate::gate(&captures, found, config);
    let indices: Vec<usize> = (0..readings.len()).filter(|&i| found.agrees[i]).collect();
    let used: Vec<&Observation> = indices.iter().map(|&i| &session.observations[i]).collect();
    suspect_units(&used, result);
    rejected::name(&captures, &found, fit.as_ref(), result);
    if !doubt::suspect_size(&readings, session.target.as_ref(), Some(&found), result)
        && !doubt::suspect_order(&readings, Some(&found), result)
    {
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

/// Millimetres read as metres put the flange beyond any robot's reach, and the target beyond any
/// camera's. Captures that do not belong have no say.
fn suspect_units(used: &[&Observation], result: &mut Calibration) {
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
    for finding in target.into_iter().chain(robot) {
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
