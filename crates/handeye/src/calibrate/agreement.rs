//! Which captures agree with each other, and on which reading of each picture.

use nalgebra::Vector3;

use super::{Config, Session};
use crate::{
    Error, Observation, Pose, PosePair, Target, Warning,
    calibration::{Calibration, CaptureResult, Verdict},
    diagnose::{self, Convention},
    evaluate,
    refine::{self, View},
    solve::{
        consensus::{self, Consensus, Readings},
        motions,
    },
};

/// What the views of a session say, once readings are chosen.
pub(super) struct Views<'a> {
    pub session: &'a Session,
    /// Observations that are used, in order.
    pub used: Vec<&'a Observation>,
    /// The same as pose pairs about the target's first corner, so that misfits are those there.
    pub views: Vec<View>,
    /// The target frame about its first corner, seen from the target's own.
    pub target_from_corner: Pose<Target, Target>,
    /// Which observations of the session they are.
    pub indices: Vec<usize>,
}
/// Chance of a capture as far off as it is below which it stays out.
const IMPROBABLE: f64 = 1e-5;

/// Rounds of letting captures back in.
const READMISSIONS: usize = 5;

/// Lets captures back in that the gate was too strict for: those that are no surprise to a fit
/// that has not seen them.
fn readmit(
    session: &Session,
    readings: &[Readings],
    mut found: Consensus,
    config: &Config,
    target_from_corner: &Pose<Target, Target>,
) -> Consensus {
    let setup = session.setup;
    let view =
        |i: usize, k: usize| view(&session.observations[i], &readings[i], k, target_from_corner);
    for _ in 0..READMISSIONS {
        let used: Vec<usize> = (0..readings.len()).filter(|&i| found.agrees[i]).collect();
        let views: Vec<View> = used.iter().map(|&i| view(i, found.reading[i])).collect();
        let Ok(fit) = refine::fit_views(&views, &found.hand_eye, &config.known, setup) else {
            break;
        };
        let limit = surprise_limit(fit.degrees_of_freedom);
        let mut changed = false;
        for i in (0..readings.len()).filter(|i| !used.contains(i)) {
            let best = (0..readings[i].camera_from_target.len())
                .filter_map(|k| Some((k, fit.surprise(&view(i, k), setup)?)))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((k, d2)) = best
                && d2 < limit
            {
                (found.reading[i], found.agrees[i], changed) = (k, true, true);
            }
        }
        found.hand_eye = fit.hand_eye;
        if !changed {
            break;
        }
    }
    found
}

/// Squared distance, in units of six axes, that noise estimated from so few equations reaches with
/// probability [`IMPROBABLE`].
fn surprise_limit(degrees_of_freedom: f64) -> f64 {
    use statrs::distribution::{ContinuousCDF, FisherSnedecor};
    let dof = degrees_of_freedom.max(1.0);
    FisherSnedecor::new(6.0, dof).map_or(f64::INFINITY, |f| 6.0 * f.inverse_cdf(1.0 - IMPROBABLE))
}

pub(super) fn first_report(o: &Observation) -> CaptureResult {
    let reason = o.candidates.is_empty().then(|| "the target was not found in it".to_owned());
    CaptureResult {
        id: o.capture.clone(),
        used: reason.is_none(),
        reason,
        base_from_flange: o.base_from_flange,
        camera_from_target: o.candidates.first().map(|c| c.camera_from_target),
        corners: o.corners.len(),
        corners_3d: o.surface.len(),
        residual_px: None,
        reprojection_px: None,
        residual_mm: None,
        residual_deg: None,
        held_out_mm: None,
        held_out_deg: None,
    }
}

/// One capture as the fits see it: pose and covariance moved to the target's first corner.
fn view(
    o: &Observation,
    readings: &Readings,
    k: usize,
    target_from_corner: &Pose<Target, Target>,
) -> View {
    let carry = crate::lie::adjoint(target_from_corner.inverse().iso());
    View {
        pair: PosePair {
            anchor_from_mount: readings.anchor_from_mount,
            camera_from_target: readings.camera_from_target[k],
        },
        covariance: o.candidates[k].covariance.map(|c| carry * c * carry.transpose()),
        sight: None,
    }
}

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

/// Names every capture that does not agree, with the likeliest reason.
fn name_rejected(
    session: &Session,
    readings: &[Readings],
    found: &Consensus,
    result: &mut Calibration,
) {
    let wrong: Vec<usize> = (0..readings.len())
        .filter(|&i| !found.agrees[i] && !readings[i].camera_from_target.is_empty())
        .collect();
    // where most disagree, a chance fit to another capture explains nothing
    let few = (wrong.len() as f64) < MOST_EXPLAINED * readings.len() as f64;
    let limit = typical(readings, found);
    let exchanged = if few { diagnose::exchanged(readings, found, limit) } else { vec![] };
    for &i in &wrong {
        let (code, reason) = match explained(session, &exchanged, i) {
            Some(reason) => ("captures-exchanged", reason),
            None => ("capture-rejected", disagreement(readings, found, i)),
        };
        result.captures[i].used = false;
        result.captures[i].reason = Some(reason.clone());
        let id = &session.observations[i].capture;
        result.rejected.push(id.clone());
        if wrong.len() <= MOST_WARNINGS {
            let message = format!("capture {id} left out: {reason}");
            result.warnings.push(Warning::new(code, message));
        }
    }
    if wrong.len() > MOST_WARNINGS {
        let message = format!(
            "{} of {} captures disagree with the others and are left out: {}",
            wrong.len(),
            readings.len(),
            result.rejected.join(", ")
        );
        result.warnings.push(Warning::new("captures-rejected", message));
    }
}

/// Share of wrong captures up to which each is explained.
const MOST_EXPLAINED: f64 = 0.4;
/// More wrong captures than this are named in one sentence.
const MOST_WARNINGS: usize = 8;

/// The other capture whose robot pose a picture fits, in words.
fn explained(session: &Session, exchanged: &[(usize, usize)], i: usize) -> Option<String> {
    let (_, j) = *exchanged.iter().find(|(picture, _)| *picture == i)?;
    let other = &session.observations[j].capture;
    Some(if exchanged.contains(&(j, i)) {
        format!("its picture and that of capture {other} look exchanged")
    } else {
        format!("its picture fits the robot pose of capture {other}")
    })
}

fn disagreement(readings: &[Readings], found: &Consensus, i: usize) -> String {
    let pair = PosePair {
        anchor_from_mount: readings[i].anchor_from_mount,
        camera_from_target: readings[i].camera_from_target[found.reading[i]],
    };
    let (angle, distance) = evaluate::loop_misfit(&found.hand_eye, &pair);
    format!(
        "it disagrees with the others by {:.1} mm and {:.2} degrees: a robot pose of another \
         moment, a moved target, or a wrong detection",
        distance * 1e3,
        angle.to_degrees()
    )
}

/// Misfits up to which a capture is as good as those that agree: three times their median.
fn typical(readings: &[Readings], found: &Consensus) -> (f64, f64) {
    let (angles, distances): (Vec<f64>, Vec<f64>) = (0..readings.len())
        .filter(|&i| found.agrees[i])
        .map(|i| {
            evaluate::loop_misfit(
                &found.hand_eye,
                &PosePair {
                    anchor_from_mount: readings[i].anchor_from_mount,
                    camera_from_target: readings[i].camera_from_target[found.reading[i]],
                },
            )
        })
        .unzip();
    (3.0 * consensus::median(angles).max(1e-3), 3.0 * consensus::median(distances).max(5e-4))
}

/// An inversion explains the data when most captures agree under it, the misfit in position falls
/// to less than this part, and that in rotation does not rise (rotations alone often fit both ways).
const EXPLAINS: f64 = 0.2;

/// In words. Robot poses inverted, target poses inverted, and the other setup can explain the same
/// data equally well; target poses from our own detection are not in doubt.
fn inversion(
    explaining: &[&diagnose::Evidence],
    best: &diagnose::Evidence,
    bare: bool,
) -> (&'static str, &'static str) {
    let alike = |c: Convention| {
        explaining.iter().any(|e| e.convention == c && e.median_m < 2.0 * best.median_m)
    };
    match (alike(Convention::RobotInverted), bare && alike(Convention::TargetInverted)) {
        (true, true) => (
            "poses-inverted",
            "either the robot poses look inverted (flange_from_base), or the target poses \
             (target_from_camera), or the camera is mounted the other way (eye-in-hand against \
             eye-to-hand); the data cannot tell between these",
        ),
        (false, true) => (
            "target-poses-inverted",
            "the target poses look inverted: they take camera points to the target",
        ),
        _ => (
            "robot-poses-inverted",
            "the robot poses look inverted (flange_from_base), or the camera is mounted the other \
             way (eye-in-hand against eye-to-hand)",
        ),
    }
}

fn suspect_conventions(
    readings: &[Readings],
    bare: bool,
    found: Option<&Consensus>,
    result: &mut Calibration,
) {
    let all = diagnose::conventions(readings, found);
    let declared = all.iter().find(|e| e.convention == Convention::AsDeclared).copied();
    let better = |e: &&diagnose::Evidence| {
        e.convention != Convention::AsDeclared
            && (bare || e.convention != Convention::TargetInverted)
            && 2 * e.agree > readings.len()
            && declared.is_none_or(|d| {
                e.median_m < EXPLAINS * d.median_m && e.median_rad < 1.2 * d.median_rad + 1e-3
            })
    };
    let explaining: Vec<&diagnose::Evidence> = all.iter().filter(better).collect();
    let Some(best) = explaining.iter().min_by(|a, b| a.median_m.total_cmp(&b.median_m)) else {
        return;
    };
    let before =
        declared.map_or("no agreement at all".into(), |d| format!("{:.1} mm", d.median_m * 1e3));
    let (code, what) = inversion(&explaining, best, bare);
    let message = format!(
        "{what}: read so, the median misfit falls from {before} to {:.1} mm; check `direction` and \
         `setup`",
        best.median_m * 1e3
    );
    result.reasons.push(message.clone());
    result.warnings.insert(0, Warning::new(code, message));
    result.verdict = Verdict::Rejected;
}

/// Finds the agreement, names what does not agree, and hands on what does.
pub(super) fn agree<'a>(
    session: &'a Session,
    config: &Config,
    result: &mut Calibration,
) -> Option<(Views<'a>, Consensus)> {
    let shift = session.target.as_ref().map_or(Vector3::zeros(), |t| t.reference().vector());
    let target_from_corner: Pose<Target, Target> =
        Pose::claim(nalgebra::Isometry3::translation(shift.x, shift.y, shift.z));
    let readings: Vec<Readings> =
        session.observations.iter().map(|o| readings(session, o, &target_from_corner)).collect();
    result.captures = session.observations.iter().map(first_report).collect();
    suspect_units(session, result);
    let found = match consensus::consensus(&readings) {
        Ok(found) => found,
        Err(error) => {
            no_consensus(session, &readings, &error, result);
            return None;
        }
    };
    let found = readmit(session, &readings, found, config, &target_from_corner);
    name_rejected(session, &readings, &found, result);
    suspect_conventions(&readings, bare(session), Some(&found), result);
    let indices: Vec<usize> = (0..readings.len()).filter(|&i| found.agrees[i]).collect();
    let of = |&i: &usize| {
        view(&session.observations[i], &readings[i], found.reading[i], &target_from_corner)
    };
    warn_few(indices.len(), result);
    let views = Views {
        session,
        used: indices.iter().map(|&i| &session.observations[i]).collect(),
        views: indices.iter().map(of).collect(),
        target_from_corner,
        indices,
    };
    Some((views, found))
}

/// Fewer captures than this are answered with a warning.
const FEW: usize = 8;

fn warn_few(used: usize, result: &mut Calibration) {
    if used < FEW {
        result.warnings.push(Warning::new(
            "few-captures",
            format!(
                "only {used} captures: too few to notice a wrong one or to judge the noise well; \
                 take 10 to 15"
            ),
        ));
    }
}

/// Robot positions beyond this, m, are no robot's.
const FARTHEST: f64 = 20.0;

/// Millimetres read as metres put the flange beyond any robot's reach.
fn suspect_units(session: &Session, result: &mut Calibration) {
    let reach = |o: &Observation| o.base_from_flange.translation().norm();
    let far = session.observations.iter().map(reach).fold(0.0, f64::max);
    if far > FARTHEST {
        let message = format!(
            "the robot poses lie up to {far:.0} m from the base: were millimetres read as metres? \
             check the length unit"
        );
        result.reasons.push(message.clone());
        result.warnings.push(Warning::new("robot-length-unit", message));
        result.verdict = Verdict::Rejected;
    }
}

/// Whether the target poses came from elsewhere.
fn bare(session: &Session) -> bool {
    session.observations.iter().all(|o| o.corners.is_empty())
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
