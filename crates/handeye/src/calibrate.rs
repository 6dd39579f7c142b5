//! From measurements to a calibration with a verdict: the flow of the whole core.
//!
//! consensus (which captures agree, and on which reading) → closed forms → least squares and
//! maximum likelihood → registration of touches → every candidate judged on what it has not seen
//! → choice by predicted error → verdict.

use nalgebra::{Matrix6, Vector3};

use crate::{
    Camera, Correspondence, Error, HandEye, Intrinsics, Mount, Observation, Placement, Pose,
    PosePair, Setup, Target, TargetModel, Touch, Warning, Workspace,
    calibration::{
        Answer, BudgetEntry, Calibration, Candidate, CaptureResult, Misfit, PoseCovariance, Scale,
        TouchResult, Verdict, rows,
    },
    diagnose::{self, Convention},
    evaluate::{self, Estimator},
    predict::{self, Volume},
    refine::{
        self, PoseFit, View,
        noise::{KnownNoise, Source},
    },
    register::IcpConfig,
    solve::{
        self, Method,
        consensus::{self, Consensus, Readings},
        motions,
    },
    touches::{self, Registration, TouchPairs},
};

/// Everything that was measured in one cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// Who carries the camera.
    pub setup: Setup,
    /// What the camera looked at; `None` for bare poses or points.
    pub target: Option<TargetModel>,
    /// The camera, where pictures were used.
    pub camera: Option<Intrinsics>,
    /// Captures, in any order.
    pub observations: Vec<Observation>,
    /// Boards lying in the cell (eye-to-hand).
    pub placements: Vec<Placement>,
    /// Touched corners.
    pub touches: Vec<Touch>,
    /// Points known to camera and robot, where that is all there is.
    pub correspondences: Vec<Correspondence>,
    /// Where the answer will be used, in the base (eye-to-hand) or the camera (eye-in-hand).
    pub workspace: Option<Workspace>,
}

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
}

/// Version of the result's format.
const FORMAT: &str = "handeye-calibration-1";

/// Predicted error (95 %) beyond which an answer is rejected when the user named no limit, mm.
const MOST_PREDICTED_MM: f64 = 10.0;
/// Misfit of captures that were left out beyond which an answer is rejected: no robot and camera
/// in working order are that far apart. mm and degrees.
const MOST_HELD_OUT: (f64, f64) = (15.0, 2.5);
/// Share of the captures that must agree.
const LEAST_AGREEING: f64 = 0.5;
/// Wrong size of the target that is beyond any printer: the declared size or the focal length is
/// wrong, and so is every distance.
const MOST_SCALE_ERROR: f64 = 0.03;
/// Chance of a scale as far from one as it is below which it is called wrong.
const IMPROBABLE_SCALE: f64 = 1e-3;
/// Scale errors below this part are within what printers and lenses do.
const LEAST_SCALE_ERROR: f64 = 0.005;

/// Runs the whole calibration. Bad data end in a verdict, not in an error.
///
/// # Errors
/// [`Error::Invalid`] when the session holds nothing to calibrate from.
pub fn calibrate(session: &Session, config: &Config) -> Result<Calibration, Error> {
    let session = in_order(session);
    let mut result = empty(&session);
    if session.observations.is_empty() && session.correspondences.is_empty() {
        return Err(Error::Invalid(
            "nothing to calibrate from: no captures with a robot pose and a picture of the target, \
             and no point pairs"
                .into(),
        ));
    }
    if session.observations.is_empty() {
        from_points(&session, config, &mut result);
    } else {
        from_views(&session, config, &mut result);
    }
    conclude(config, &mut result);
    Ok(result)
}

/// Captures and touches in the order of their names, whatever order they came in.
fn in_order(session: &Session) -> Session {
    let mut session = session.clone();
    session.observations.sort_by(|a, b| natural(&a.capture, &b.capture));
    session.placements.sort_by(|a, b| natural(&a.id, &b.id));
    let at = |t: &Touch| t.in_base.vector();
    session.touches.sort_by(|a, b| {
        natural(&a.placement, &b.placement).then(a.corner.cmp(&b.corner)).then_with(|| {
            at(a).as_slice().partial_cmp(at(b).as_slice()).unwrap_or(std::cmp::Ordering::Equal)
        })
    });
    let key = |c: &Correspondence| c.in_camera.vector();
    session.correspondences.sort_by(|a, b| {
        key(a).as_slice().partial_cmp(key(b).as_slice()).unwrap_or(std::cmp::Ordering::Equal)
    });
    session
}

/// Order of names in which `img_2` comes before `img_10`.
pub fn natural(a: &str, b: &str) -> std::cmp::Ordering {
    let (mut a, mut b) = (a.chars().peekable(), b.chars().peekable());
    loop {
        let order = match (a.peek(), b.peek()) {
            (None, None) => return std::cmp::Ordering::Equal,
            (None, _) => return std::cmp::Ordering::Less,
            (_, None) => return std::cmp::Ordering::Greater,
            (Some(x), Some(y)) if x.is_ascii_digit() && y.is_ascii_digit() => {
                let number = |it: &mut std::iter::Peekable<std::str::Chars>| {
                    let mut digits = String::new();
                    while let Some(c) = it.next_if(char::is_ascii_digit) {
                        digits.push(c);
                    }
                    let value = digits.trim_start_matches('0').to_owned();
                    (value.len(), value, digits.len())
                };
                number(&mut a).cmp(&number(&mut b))
            }
            (Some(_), Some(_)) => a.next().cmp(&b.next()),
        };
        if order != std::cmp::Ordering::Equal {
            return order;
        }
    }
}

fn empty(session: &Session) -> Calibration {
    Calibration {
        format: FORMAT.into(),
        setup: session.setup,
        verdict: Verdict::Undetermined,
        reasons: vec![],
        method: String::new(),
        hand_eye: Answer::default(),
        name: format!("{}_from_camera", session.setup.mount()),
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
        diversity: None,
        error_budget: vec![],
        scale: None,
        warnings: vec![],
    }
}

// ---------------------------------------------------------------- captures

/// What the views of a session say, once readings are chosen.
struct Views<'a> {
    session: &'a Session,
    /// Observations that are used, in order.
    used: Vec<&'a Observation>,
    /// The same as pose pairs about the target's first corner, so that misfits are those there.
    views: Vec<View>,
    /// The target frame about its first corner, seen from the target's own.
    target_from_corner: Pose<Target, Target>,
}

fn from_views(session: &Session, config: &Config, result: &mut Calibration) {
    let corner = session.target.as_ref().and_then(|t| t.corner(0));
    let shift = corner.map_or(Vector3::zeros(), |c| c.vector());
    let target_from_corner: Pose<Target, Target> =
        Pose::claim(nalgebra::Isometry3::translation(shift.x, shift.y, shift.z));
    let readings: Vec<Readings> = session
        .observations
        .iter()
        .map(|o| Readings {
            anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
            camera_from_target: o
                .candidates
                .iter()
                .map(|c| c.camera_from_target * target_from_corner)
                .collect(),
        })
        .collect();
    result.captures = session.observations.iter().map(first_report).collect();
    let found = match consensus::consensus(&readings) {
        Ok(found) => found,
        Err(error) => return no_consensus(session, &readings, &error, result),
    };
    let found = readmit(session, &readings, found, config, &target_from_corner);
    name_rejected(session, &readings, &found, result);
    suspect_conventions(&readings, Some(&found), result);
    let used: Vec<usize> = (0..readings.len()).filter(|&i| found.agrees[i]).collect();
    let views = Views {
        session,
        used: used.iter().map(|&i| &session.observations[i]).collect(),
        views: used
            .iter()
            .map(|&i| {
                view(&session.observations[i], &readings[i], found.reading[i], &target_from_corner)
            })
            .collect(),
        target_from_corner,
    };
    estimate(&views, &found, config, result);
    report_captures(&views, &used, &found, result);
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
        let Ok(fit) = refine::fit_estimating_noise(&views, &found.hand_eye, &config.known, setup)
        else {
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

fn first_report(o: &Observation) -> CaptureResult {
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
    if let Some(axis) = motions::single_axis(&pairs) {
        let mount = session.setup.mount();
        let axis = diagnose::axis_name(&axis);
        result.undetermined.push(format!("translation along the rotation axis {axis} of {mount}"));
        return;
    }
    result.undetermined.push(format!("the pose of the camera on the {}", session.setup.mount()));
    if !motions::rotates(&pairs) {
        return;
    }
    result.verdict = Verdict::Rejected;
    suspect_conventions(readings, None, result);
}

/// Names every capture that does not agree, with the likeliest reason.
fn name_rejected(
    session: &Session,
    readings: &[Readings],
    found: &Consensus,
    result: &mut Calibration,
) {
    let limit = typical(readings, found);
    let exchanged = diagnose::exchanged(readings, found, limit);
    let id = |i: usize| session.observations[i].capture.clone();
    for i in 0..readings.len() {
        if found.agrees[i] || readings[i].camera_from_target.is_empty() {
            continue;
        }
        let other = exchanged.iter().find(|(picture, _)| *picture == i).map(|(_, robot)| *robot);
        let mutual = other.is_some_and(|j| exchanged.contains(&(j, i)));
        let reason = match other {
            Some(j) if mutual => {
                format!("its picture and that of capture {} look exchanged", id(j))
            }
            Some(j) => format!("its picture fits the robot pose of capture {}", id(j)),
            None => disagreement(readings, found, i),
        };
        result.captures[i].used = false;
        result.captures[i].reason = Some(reason.clone());
        result.rejected.push(id(i));
        let code = if other.is_some() { "captures-exchanged" } else { "capture-rejected" };
        result.warnings.push(Warning::new(code, format!("capture {} left out: {reason}", id(i))));
    }
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

/// An inversion explains the data when the misfit falls to a third or more captures agree.
fn suspect_conventions(readings: &[Readings], found: Option<&Consensus>, result: &mut Calibration) {
    let all = diagnose::conventions(readings, found);
    let declared = all.iter().find(|e| e.convention == Convention::AsDeclared).copied();
    let better = |e: &&diagnose::Evidence| {
        e.convention != Convention::AsDeclared
            && 2 * e.agree > readings.len()
            && declared
                .is_none_or(|d| e.median_m * 3.0 < d.median_m && e.median_rad < d.median_rad * 1.5)
    };
    let Some(best) = all.iter().filter(better).min_by(|a, b| a.median_m.total_cmp(&b.median_m))
    else {
        return;
    };
    let before =
        declared.map_or("no agreement at all".into(), |d| format!("{:.1} mm", d.median_m * 1e3));
    let (code, what) = match best.convention {
        Convention::TargetInverted => (
            "target-poses-inverted",
            "the target poses look inverted: they take camera points to the target",
        ),
        _ => (
            "robot-poses-inverted",
            "the robot poses look inverted (flange_from_base), or the camera is mounted the other \
             way (eye-in-hand against eye-to-hand)",
        ),
    };
    let message = format!(
        "{what}: read so, the median misfit falls from {before} to {:.1} mm; check `direction` and \
         `setup`",
        best.median_m * 1e3
    );
    result.reasons.push(message.clone());
    result.warnings.insert(0, Warning::new(code, message));
    result.verdict = Verdict::Rejected;
}

// ---------------------------------------------------------------- candidates

fn estimate(views: &Views, found: &Consensus, config: &Config, result: &mut Calibration) {
    let setup = views.session.setup;
    let pairs: Vec<PosePair> = views.views.iter().map(|v| v.pair).collect();
    result.diversity = Some(evaluate::diversity(&pairs));
    let fit =
        match refine::fit_estimating_noise(&views.views, &found.hand_eye, &config.known, setup) {
            Ok(fit) => fit,
            Err(error) => {
                result.reasons.push(error.to_string());
                result
                    .undetermined
                    .push(format!("the pose of the camera on the {}", setup.mount()));
                return;
            }
        };
    result.undetermined = diagnose::undetermined(&fit, setup);
    result.error_budget = budget(&fit);
    judge_scale(views, &fit, config, result);
    let covariance = stated_covariance(&fit);
    let Some(volume) = volume(views, &fit) else { return };
    let paired = pair_touches(views, result);
    let mut candidates = view_candidates(views, &fit, &covariance, &volume, &paired, config);
    candidates.extend(touch_candidates(views, &fit, &volume, &paired, config, result));
    if let Some((posterior, touch_cov)) = fit_covariances(&covariance, &candidates) {
        compare_sources(&candidates, &posterior, &touch_cov, result);
    }
    choose(candidates, &volume, config, result);
    report_touches(views, &paired, result);
}

/// A candidate with what its choice needs.
struct Judged {
    candidate: Candidate,
    mount_from_camera: Pose<Mount, Camera>,
    tre: Option<predict::PredictedTre>,
    covariance: Option<Matrix6<f64>>,
}

/// Covariance of X and Y in their own frames, widened for noise estimated from few captures, and
/// for data that fit worse than their noise says.
fn stated_covariance(fit: &PoseFit) -> Option<refine::pose_fit::Matrix12> {
    let dof = fit.degrees_of_freedom;
    let misfit = if dof > 0.0 { (fit.chi_squared / dof).max(1.0) } else { 1.0 };
    fit.covariance.map(|c| c * (misfit * touches::small_sample(dof)))
}

fn blocks(covariance: &refine::pose_fit::Matrix12) -> (Matrix6<f64>, Matrix6<f64>) {
    (
        covariance.fixed_view::<6, 6>(0, 0).into_owned(),
        covariance.fixed_view::<6, 6>(6, 6).into_owned(),
    )
}

fn view_candidates(
    views: &Views,
    fit: &PoseFit,
    covariance: &Option<refine::pose_fit::Matrix12>,
    volume: &Volume,
    paired: &[TouchPairs],
    config: &Config,
) -> Vec<Judged> {
    let mut all: Vec<(String, Estimator)> = Method::ALL
        .into_iter()
        .map(|m| (format!("closed-form-{}", m.name()), Estimator::ClosedForm(m)))
        .collect();
    all.push(("least-squares".into(), Estimator::LeastSquares));
    all.push(("maximum-likelihood".into(), Estimator::WithNoise(fit.noise.clone())));
    if let Some(method) = config.method {
        all.retain(|(_, e)| *e == Estimator::ClosedForm(method));
    }
    all.into_iter()
        .filter_map(|(name, estimator)| {
            view_candidate(views, fit, covariance, volume, paired, name, &estimator)
        })
        .collect()
}

/// One candidate from views alone. Its predicted error is that of the most likely answer plus, in
/// full, the distance of the two: given the views, that is its expected error.
fn view_candidate(
    views: &Views,
    fit: &PoseFit,
    covariance: &Option<refine::pose_fit::Matrix12>,
    volume: &Volume,
    paired: &[TouchPairs],
    name: String,
    estimator: &Estimator,
) -> Option<Judged> {
    let setup = views.session.setup;
    let answer = match estimator {
        Estimator::WithNoise(_) => fit.hand_eye,
        other => other.estimate(&views.views, &fit.hand_eye, setup).ok()?,
    };
    let x = answer.mount_from_camera;
    let tre = covariance.as_ref().map(|c| {
        predict::tre(volume, &blocks(c).0, predict::difference(&fit.hand_eye.mount_from_camera, &x))
    });
    let held_out =
        evaluate::rms(&evaluate::held_out(estimator, &views.views, &fit.hand_eye, setup));
    let touch_rms = touches::touch_rms(paired, &x).map(|m| m * 1e3);
    let candidate = Candidate {
        name,
        hand_eye: stored(views, &answer, covariance.as_ref()),
        in_sample: evaluate::in_sample(&answer, &views.views),
        held_out,
        touch_rms_mm: touch_rms,
        held_out_mm: touch_rms.or(held_out.translation_rms_mm),
        predicted_tre_mm: tre.as_ref().map(|t| t.rms),
        note: None,
    };
    let covariance = covariance.as_ref().map(|c| blocks(c).0);
    Some(Judged { candidate, mount_from_camera: x, tre, covariance })
}

/// The answer for files: about the target's own origin again.
fn stored(
    views: &Views,
    answer: &HandEye,
    covariance: Option<&refine::pose_fit::Matrix12>,
) -> Answer {
    let carry = crate::lie::adjoint(views.target_from_corner.iso());
    let moved = answer.retarget(views.target_from_corner.inverse());
    Answer {
        mount_from_camera: Some(moved.mount_from_camera),
        anchor_from_target: Some(moved.anchor_from_target),
        covariance: PoseCovariance {
            mount_from_camera: covariance.map(|c| rows(&blocks(c).0)),
            anchor_from_target: covariance
                .map(|c| rows(&(carry * blocks(c).1 * carry.transpose()))),
        },
    }
}

fn pair_touches(views: &Views, result: &mut Calibration) -> Vec<TouchPairs> {
    let Some(target) = &views.session.target else { return vec![] };
    let chosen: Vec<Observation> =
        views.used.iter().zip(&views.views).map(|(o, v)| relabelled(o, v, views, target)).collect();
    let chosen: Vec<&Observation> = chosen.iter().collect();
    let (paired, missing) = touches::pair_touches(
        views.session.setup,
        target,
        &chosen,
        &views.session.placements,
        &views.session.touches,
    );
    for k in missing {
        let touch = &views.session.touches[k];
        result.warnings.push(Warning::new(
            "touch-without-view",
            format!(
                "touch of corner {} of placement {:?} left out: the camera shows no such corner \
                 there; give the placement a picture or scan",
                touch.corner, touch.placement
            ),
        ));
    }
    paired
}

/// The observation with the reading that was chosen: its pose first, its scan's corners renamed.
fn relabelled(o: &Observation, v: &View, views: &Views, target: &TargetModel) -> Observation {
    let pose = v.pair.camera_from_target * views.target_from_corner.inverse();
    let mut o = o.clone();
    let map = relabelling(&o, &pose, target);
    for corner in &mut o.surface {
        corner.id = map.get(corner.id as usize).copied().unwrap_or(corner.id);
    }
    o.candidates = vec![crate::TargetPose { camera_from_target: pose, covariance: v.covariance }];
    o
}

/// Which symmetry of the board the chosen pose stands for: the one that brings the corners of the
/// picture's first reading onto those of the chosen one.
pub fn relabelling(o: &Observation, pose: &Pose<Camera, Target>, target: &TargetModel) -> Vec<u32> {
    let maps = target.symmetries();
    let Some(first) = o.candidates.first() else { return maps[0].clone() };
    let cost = |map: &Vec<u32>| -> f64 {
        (0..target.len() as u32)
            .filter_map(|id| {
                let as_read = first.camera_from_target * target.corner(id)?;
                let as_chosen = *pose * target.corner(map[id as usize])?;
                Some((as_read.vector() - as_chosen.vector()).norm_squared())
            })
            .sum()
    };
    maps.iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).cloned().unwrap_or_default()
}

fn touch_candidates(
    views: &Views,
    fit: &PoseFit,
    volume: &Volume,
    paired: &[TouchPairs],
    config: &Config,
    result: &mut Calibration,
) -> Vec<Judged> {
    if paired.is_empty() || config.method.is_some() {
        return vec![];
    }
    let kinds =
        [("two-step-svd", Registration::Svd), ("two-step-icp", Registration::Icp(config.icp))];
    let mut all = Vec::new();
    for (name, registration) in kinds {
        match touch_candidate(fit, volume, paired, name, registration) {
            Ok(mut judged) => {
                judged.candidate.in_sample = Misfit::default();
                let placed = solve::place_target(&pairs_of(views), &judged.mount_from_camera);
                judged.candidate.in_sample = evaluate::in_sample(&placed, &views.views);
                judged.candidate.hand_eye.anchor_from_target =
                    stored(views, &placed, None).anchor_from_target;
                all.push(judged);
            }
            Err(error) => result
                .warnings
                .push(Warning::new("touches-not-enough", format!("no {name} candidate: {error}"))),
        }
    }
    all
}

fn pairs_of(views: &Views) -> Vec<PosePair> {
    views.views.iter().map(|v| v.pair).collect()
}

fn touch_candidate(
    fit: &PoseFit,
    volume: &Volume,
    paired: &[TouchPairs],
    name: &str,
    registration: Registration,
) -> Result<Judged, Error> {
    let all: Vec<&TouchPairs> = paired.iter().collect();
    let start = fit.hand_eye.mount_from_camera;
    let found = touches::fit_touches(&all, &start, registration)?;
    let x = found.mount_from_camera;
    let tre = found.covariance.map(|c| predict::tre(volume, &c, |_| Vector3::zeros()));
    let wrong = found.wrong_matches;
    let note = match (registration, found.stop) {
        (Registration::Icp(_), Some((rounds, stop))) => Some(format!(
            "{rounds} iterations, {stop:?}; {} of the matches are other corners than were touched",
            wrong
        )),
        _ if found.covariance.is_none() => {
            Some("three touches leave nothing to judge their error by; touch more".into())
        }
        _ => None,
    };
    // nearest neighbours that differ from the touched corners prove the match wrong
    let usable = wrong == 0;
    Ok(Judged {
        candidate: Candidate {
            name: name.into(),
            hand_eye: Answer {
                mount_from_camera: Some(x),
                anchor_from_target: None,
                covariance: PoseCovariance {
                    mount_from_camera: found.covariance.as_ref().map(rows),
                    anchor_from_target: None,
                },
            },
            in_sample: Misfit::default(),
            held_out: Misfit::default(),
            touch_rms_mm: touches::touch_rms(paired, &x).map(|m| m * 1e3),
            held_out_mm: touches::held_out(paired, &start, registration).map(|m| m * 1e3),
            predicted_tre_mm: tre.as_ref().filter(|_| usable).map(|t| t.rms),
            note,
        },
        mount_from_camera: x,
        tre: tre.filter(|_| usable),
        covariance: found.covariance,
    })
}

fn fit_covariances(
    covariance: &Option<refine::pose_fit::Matrix12>,
    candidates: &[Judged],
) -> Option<(Matrix6<f64>, Matrix6<f64>)> {
    let touch = candidates.iter().find(|c| c.candidate.name == "two-step-svd")?.covariance?;
    Some((blocks(covariance.as_ref()?).0, touch))
}

/// Chance of a disagreement between views and touches below which it is called systematic.
const CONFLICT: f64 = 0.001;

fn compare_sources(
    candidates: &[Judged],
    views: &Matrix6<f64>,
    touched: &Matrix6<f64>,
    result: &mut Calibration,
) {
    let of = |name: &str| candidates.iter().find(|c| c.candidate.name == name);
    let (Some(a), Some(b)) = (of("maximum-likelihood"), of("two-step-svd")) else { return };
    let found =
        touches::consistency((&a.mount_from_camera, views), (&b.mount_from_camera, touched));
    let Some((_, p)) = found else { return };
    if p < CONFLICT {
        let gap = a.candidate.touch_rms_mm.unwrap_or(f64::NAN);
        result.warnings.push(Warning::new(
            "views-and-touches-disagree",
            format!(
                "views and touches disagree: the touched corners lie {gap:.2} mm (RMS) from where \
                 the views put them, p = {p:.1e}; check the tool tip first, then the robot's \
                 calibration"
            ),
        ));
    }
}

/// The least predicted error wins; the residual has no say.
fn choose(candidates: Vec<Judged>, volume: &Volume, config: &Config, result: &mut Calibration) {
    let best = candidates.iter().filter(|c| c.tre.is_some()).min_by(|a, b| by_prediction(a, b)).or(
        candidates
            .iter()
            .rfind(|c| config.method.is_none() || c.candidate.name.starts_with("closed")),
    );
    if let Some(best) = best {
        result.method = best.candidate.name.clone();
        result.chosen = Some(best.candidate.name.clone());
        result.why = why(best, &candidates, volume, config);
        result.hand_eye = best.candidate.hand_eye;
        result.predicted_tre_mm = best.tre.clone();
        result.residual = best.candidate.in_sample;
        result.held_out = best.candidate.held_out;
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

// ---------------------------------------------------------------- points only

fn from_points(session: &Session, config: &Config, result: &mut Calibration) {
    let touches: Vec<TouchPairs> = session
        .correspondences
        .iter()
        .enumerate()
        .map(|(k, pair)| TouchPairs {
            touch: k,
            placement: k.to_string(),
            pairs: vec![*pair],
            base_from_mount: vec![Pose::identity()],
        })
        .collect();
    let all: Vec<&TouchPairs> = touches.iter().collect();
    let found = match touches::fit_touches(&all, &Pose::identity(), Registration::Svd) {
        Ok(found) => found,
        Err(error) => {
            result.reasons.push(error.to_string());
            let what = match error {
                Error::Collinear { .. } => "rotation about the line of the points",
                _ => "the pose of the camera",
            };
            result.undetermined.push(what.into());
            return;
        }
    };
    let volume = point_volume(session, &touches, &found.mount_from_camera);
    let tre = found.covariance.zip(volume).map(|(c, v)| predict::tre(&v, &c, |_| Vector3::zeros()));
    let held_out =
        touches::held_out(&touches, &Pose::identity(), Registration::Svd).map(|m| m * 1e3);
    let misfit = |mm: Option<f64>| Misfit { translation_rms_mm: mm, ..Misfit::default() };
    let candidate = Candidate {
        name: "point-pairs-svd".into(),
        hand_eye: Answer {
            mount_from_camera: Some(found.mount_from_camera),
            anchor_from_target: None,
            covariance: PoseCovariance {
                mount_from_camera: found.covariance.as_ref().map(rows),
                anchor_from_target: None,
            },
        },
        in_sample: misfit(Some(found.rms_m * 1e3)),
        held_out: misfit(held_out),
        touch_rms_mm: Some(found.rms_m * 1e3),
        held_out_mm: held_out,
        predicted_tre_mm: tre.as_ref().map(|t| t.rms),
        note: None,
    };
    weak_directions(&touches, result);
    result.method = candidate.name.clone();
    result.chosen = Some(candidate.name.clone());
    result.why = "point pairs alone have one answer: their rigid registration".into();
    result.hand_eye = candidate.hand_eye;
    result.residual = candidate.in_sample;
    result.held_out = candidate.held_out;
    result.predicted_tre_mm = tre;
    result.candidates = vec![candidate];
    let _ = config;
}

fn point_volume(
    session: &Session,
    touches: &[TouchPairs],
    x: &Pose<Mount, Camera>,
) -> Option<Volume> {
    match &session.workspace {
        Some(w) => Some(workspace_volume(session.setup, w, x)),
        None => touches::touched_volume(touches)
            .map(|v| Volume { name: "the box around the points".into(), ..v }),
    }
}

/// Spread across a line of points, over the spread along it, below which the user is warned.
const NEARLY_COLLINEAR: f64 = 0.05;

fn weak_directions(touches: &[TouchPairs], result: &mut Calibration) {
    let points: Vec<Vector3<f64>> = touches.iter().map(|t| t.pairs[0].in_camera.vector()).collect();
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let scatter: nalgebra::Matrix3<f64> =
        points.iter().map(|p| (p - mean) * (p - mean).transpose()).sum();
    let mut s: Vec<f64> =
        scatter.symmetric_eigen().eigenvalues.iter().map(|e| e.max(0.0).sqrt()).collect();
    s.sort_by(|a, b| b.total_cmp(a));
    let ratio = s[1] / s[0];
    if ratio < NEARLY_COLLINEAR.sqrt() {
        result.warnings.push(Warning::new(
            "points-nearly-collinear",
            format!(
                "the points lie nearly on a line (spread across it {:.0} % of that along it): the \
                 rotation about that line is weak; add points away from it",
                ratio * 100.0
            ),
        ));
    }
}

// ---------------------------------------------------------------- verdict and report

/// Where the answer will be used, in the camera frame.
fn volume(views: &Views, fit: &PoseFit) -> Option<Volume> {
    if let Some(w) = &views.session.workspace {
        return Some(workspace_volume(views.session.setup, w, &fit.hand_eye.mount_from_camera));
    }
    let corners: Vec<crate::Point<Target>> = match &views.session.target {
        Some(target) => {
            target.corners().iter().map(|c| views.target_from_corner.inverse() * *c).collect()
        }
        None => vec![crate::Point::new(0.0, 0.0, 0.0)],
    };
    diagnose::seen_volume(&pairs_of(views), &corners)
}

fn workspace_volume(setup: Setup, w: &Workspace, x: &Pose<Mount, Camera>) -> Volume {
    let volume = Volume::of_box(&w.minimum, &w.maximum, "the workspace box of the manifest");
    match setup {
        Setup::EyeInHand => volume, // declared in the camera frame
        Setup::EyeToHand => {
            let camera_from_mount = x.iso().inverse();
            volume.map(|p| {
                camera_from_mount.transform_vector(p) + camera_from_mount.translation.vector
            })
        }
    }
}

fn budget(fit: &PoseFit) -> Vec<BudgetEntry> {
    let text = |s: &refine::Sigma| match s.source {
        Source::Picture => format!("{:.2} times what the corners' scatter says", s.sigma),
        k if k.is_rotation() => format!("{:.4} deg per axis", s.sigma.to_degrees()),
        _ => format!("{:.3} mm per axis", s.sigma * 1e3),
    };
    let entry = |s: &refine::Sigma| BudgetEntry {
        source: s.source.name().into(),
        sigma: text(s),
        sigma_mm: (!s.source.is_rotation() && s.source != Source::Picture).then_some(s.sigma * 1e3),
        sigma_deg: s.source.is_rotation().then_some(s.sigma.to_degrees()),
    };
    fit.noise.sigmas.iter().map(entry).collect()
}

fn judge_scale(views: &Views, fit: &PoseFit, config: &Config, result: &mut Calibration) {
    if views.views.len() < 5 {
        return;
    }
    let found = diagnose::target_scale(&views.views, fit, &config.known, views.session.setup);
    let Some(diagnose::TargetScale { value, sigma, p_value }) = found else { return };
    result.scale = Some(Scale { value, sigma });
    if p_value > IMPROBABLE_SCALE || (value - 1.0).abs() < LEAST_SCALE_ERROR {
        return;
    }
    let size = views.session.target.as_ref().map_or(String::new(), |t| {
        let declared = t.pitch_m() * 1e3;
        format!(" ({:.2} mm instead of {declared} mm)", declared * value)
    });
    let message = format!(
        "the robot's motions say that the target is {:.1} +- {:.1} % {} than declared{size}: \
         measure the print with a caliper; if it is right, the focal length or the robot's own \
         scale is wrong",
        (value - 1.0).abs() * 100.0,
        sigma * 100.0,
        if value > 1.0 { "larger" } else { "smaller" },
    );
    if (value - 1.0).abs() > MOST_SCALE_ERROR {
        result.reasons.push(message.clone());
        result.verdict = Verdict::Rejected;
    }
    result.warnings.push(Warning::new("target-scale", message));
}

fn report_captures(views: &Views, used: &[usize], found: &Consensus, result: &mut Calibration) {
    let Some(answer) = answer(result, views) else { return };
    let setup = views.session.setup;
    let estimator = match result.chosen.as_deref().and_then(|n| n.strip_prefix("closed-form-")) {
        Some(method) => {
            Method::from_name(method).map_or(Estimator::LeastSquares, Estimator::ClosedForm)
        }
        None if result.chosen.as_deref() == Some("least-squares") => Estimator::LeastSquares,
        None => Estimator::MaximumLikelihood,
    };
    let estimator = match estimator {
        Estimator::MaximumLikelihood => {
            refine::fit_estimating_noise(&views.views, &answer, &KnownNoise::default(), setup)
                .map_or(Estimator::LeastSquares, |f| Estimator::WithNoise(f.noise))
        }
        other => other,
    };
    let held_out = evaluate::held_out(&estimator, &views.views, &answer, setup);
    for (k, &i) in used.iter().enumerate() {
        let (angle, distance) = evaluate::loop_misfit(&answer, &views.views[k].pair);
        let capture = &mut result.captures[i];
        let pose = views.views[k].pair.camera_from_target * views.target_from_corner.inverse();
        capture.camera_from_target = Some(pose);
        capture.residual_deg = Some(angle.to_degrees());
        capture.residual_mm = Some(distance * 1e3);
        capture.held_out_deg = held_out[k].map(|h| h.0.to_degrees());
        capture.held_out_mm = held_out[k].map(|h| h.1 * 1e3);
    }
    report_pixels(views, used, found, &answer, result);
}

fn answer(result: &Calibration, views: &Views) -> Option<HandEye> {
    let stored = HandEye {
        mount_from_camera: result.hand_eye.mount_from_camera?,
        anchor_from_target: result.hand_eye.anchor_from_target?,
    };
    Some(stored.retarget(views.target_from_corner))
}

fn report_pixels(
    views: &Views,
    used: &[usize],
    _found: &Consensus,
    answer: &HandEye,
    result: &mut Calibration,
) {
    let (Some(target), Some(camera)) = (&views.session.target, &views.session.camera) else {
        return;
    };
    let own = answer.retarget(views.target_from_corner.inverse());
    let mut squares = (0.0, 0.0);
    for (k, &i) in used.iter().enumerate() {
        let o = views.used[k];
        let pose = views.views[k].pair.camera_from_target * views.target_from_corner.inverse();
        let map = relabelling(o, &pose, target);
        let capture = &mut result.captures[i];
        capture.reprojection_px =
            evaluate::reprojection_px(&own, o, views.session.setup, target, &map, camera);
        capture.residual_px = picture_residual(o, &pose, target, &map, camera);
        if let Some(px) = capture.reprojection_px {
            let n = o.corners.len() as f64;
            squares = (squares.0 + n * px * px, squares.1 + n);
        }
    }
    result.residual.reprojection_rms_px =
        (squares.1 > 0.0).then(|| f64::sqrt(squares.0 / squares.1));
}

/// RMS distance (px) of corners to the target model seen from the picture's own best pose.
fn picture_residual(
    o: &Observation,
    pose: &Pose<Camera, Target>,
    target: &TargetModel,
    relabel: &[u32],
    camera: &Intrinsics,
) -> Option<f64> {
    let squares: Vec<f64> = o
        .corners
        .iter()
        .filter_map(|c| {
            let corner = target.corner(*relabel.get(c.id as usize)?)?;
            Some((camera.project(&(*pose * corner).vector())? - c.pixel).norm_squared())
        })
        .collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

fn report_touches(views: &Views, paired: &[TouchPairs], result: &mut Calibration) {
    let Some(x) = result.hand_eye.mount_from_camera else { return };
    let by_touches = result.chosen.as_deref().is_some_and(|n| n.starts_with("two-step"));
    result.touches = paired
        .iter()
        .map(|p| {
            let error = touches::touch_error(p, &x) * 1e3;
            TouchResult {
                capture: p.placement.clone(),
                corner: views.session.touches[p.touch].corner,
                residual_mm: error.norm(),
                difference_mm: error,
                used: by_touches,
            }
        })
        .collect();
}

/// The verdict: reasons against the answer first.
fn conclude(config: &Config, result: &mut Calibration) {
    if result.verdict == Verdict::Rejected {
        return;
    }
    let against = objections(config, result);
    result.verdict =
        if result.hand_eye.mount_from_camera.is_none() || !result.undetermined.is_empty() {
            hide_undetermined(result);
            Verdict::Undetermined
        } else if against.is_empty() {
            Verdict::Accepted
        } else {
            Verdict::Rejected
        };
    result.reasons.extend(against);
    if result.verdict == Verdict::Accepted
        && let Some(tre) = &result.predicted_tre_mm
    {
        result.reasons.push(format!(
            "95 of 100 points in {} are predicted within {:.2} mm",
            tre.r#where, tre.p95
        ));
    }
}

/// No invented number for what the data do not determine.
fn hide_undetermined(result: &mut Calibration) {
    if result.undetermined.is_empty() {
        return;
    }
    if result.reasons.is_empty() {
        result.reasons.push(format!(
            "the data do not determine {}: tilt the robot by 30 degrees and more about two axes, \
             or touch corners",
            result.undetermined.join(", ")
        ));
    }
    result.hand_eye = Answer::default();
    result.predicted_tre_mm = None;
}

fn objections(config: &Config, result: &Calibration) -> Vec<String> {
    let mut against = Vec::new();
    let seen = result
        .captures
        .iter()
        .filter(|c| c.used || !result.rejected.is_empty() && result.rejected.contains(&c.id))
        .count();
    let used = result.captures.iter().filter(|c| c.used).count();
    if seen > 0 && (used as f64) < LEAST_AGREEING * seen as f64 {
        against.push(format!(
            "only {used} of {seen} captures agree: pictures and robot poses may be out of order, or \
             a pose notation is read wrongly"
        ));
    }
    let held_out = result.held_out;
    if held_out.translation_rms_mm.is_some_and(|mm| mm > MOST_HELD_OUT.0)
        || held_out.rotation_rms_deg.is_some_and(|deg| deg > MOST_HELD_OUT.1)
    {
        against.push(format!(
            "captures left out are missed by {:.1} mm and {:.2} degrees (RMS): far beyond a robot \
             and camera in order",
            held_out.translation_rms_mm.unwrap_or(f64::NAN),
            held_out.rotation_rms_deg.unwrap_or(f64::NAN)
        ));
    }
    if let Some(tre) = &result.predicted_tre_mm {
        let limit = config.max_error_mm.unwrap_or(MOST_PREDICTED_MM);
        if !(tre.p95 <= limit) {
            against.push(format!(
                "the predicted error (95 %) in {} is {:.2} mm, more than {limit} mm",
                tre.r#where, tre.p95
            ));
        }
    } else if result.hand_eye.mount_from_camera.is_some() {
        against.push("too little data to predict an error: add captures or touches".into());
    }
    against
}
