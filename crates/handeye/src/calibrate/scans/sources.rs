//! In which frame the answer is, where images and scans do not agree: that of the scans, if there are any.
//!
//! Both are fused as long as they put the target at one place. Where they do not, an answer from both together would be
//! true of neither. Who gives scans is going to transform scans, so the answer is then made from the scans alone, or
//! from the images alone where the user asks for the images' frame, and the other one is named beside it. Neither is
//! chosen because it predicts a smaller error.
//!
//! With `P_i` and `S_i` the target's pose in image and scan, the disagreement is the mean of `S_i P_i⁻¹` over the
//! captures, at the middle of the target; it counts where it is more than noise (Hotelling's test of a mean) and more
//! than a share of the stated error.

use nalgebra::{Matrix6, Vector3, Vector6};

use super::scan_offset::{self, Found};
use crate::{
    Calibration, Camera, ImageCorner, Intrinsics, Pose, SurfaceCorner, Target, TargetModel,
    TargetPose, Verdict,
    calibrate::flow::config::AnswerFrame,
    detect::{
        self,
        sight::{corrected, lifted_again, on_ray},
    },
    estimate::predict,
    findings::{
        FramesFinding,
        frames::{Frame, OtherAnswer},
    },
    math::{lie, statistics},
    model::{residual::Residual, session::Session},
    register,
};

/// Fewest corners in a scan that make a pose.
const FEWEST: usize = 4;
/// Fewest captures whose mean has a covariance of six dimensions.
const FEWEST_CAPTURES: usize = 8;
/// Chance of a mean as far off as it is below which images and scans disagree.
const IMPROBABLE: f64 = 1e-3;
/// A disagreement up to this share of the stated error (95 %) is part of it.
const NEGLIGIBLE: f64 = 0.5;
/// Half of a usual workpiece, m: a rotation between the frames moves its ends by so much times the angle.
const HALF_EXTENT: f64 = 0.15;
/// A difference of depth up to this is one that the fit of both finds, m.
const OF_DEPTH: f64 = 2e-3;
/// Disagreement of few captures that needs no test: 0.5 degrees, 2 mm.
const LARGE: Residual = Residual { angle: 0.0087, distance: 0.002 };

/// What a target pose is made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    Image,
    Scan,
}

/// How far images and scans put the target apart, in the camera frame.
struct Gap {
    /// Mean rotation (rad) and shift of the target's middle (m).
    mean: Vector6<f64>,
    /// Chance of such a mean where both agree.
    chance: f64,
}

/// Runs the calibration on images and scans together, or in the frame of one of them where they disagree.
pub(crate) fn in_one_frame(
    session: &Session,
    frame: AnswerFrame,
    run: impl Fn(&Session) -> Calibration,
) -> Calibration {
    let scans = session.observations.iter().filter(|o| o.surface.len() >= FEWEST).count();
    let (Some(target), Some(camera)) = (&session.target, &session.camera) else {
        return run(session);
    };
    if 2 * scans < session.observations.len() || scans == 0 {
        return run(session);
    }
    let offset = match scan_offset::find(session) {
        Found::Nothing => return fused_or_one(session, (target, camera), frame, &run),
        Found::NotSeparable => {
            return not_separable(fused_or_one(session, (target, camera), frame, &run));
        }
        Found::Offset(offset) => offset,
    };
    let without = &offset.taken_out(session);
    let image = fused_or_one(without, (target, camera), frame, &run);
    match (frame, image.hand_eye.mount_from_camera) {
        (AnswerFrame::Scan, _) => {
            let moved = offset.in_scan_frame(&image);
            if on_rays(session, camera) {
                return offset_or_lens((session, moved), (without, &image), (target, camera), &run);
            }
            let scans = run(&restricted(session, Source::Scan, target, camera));
            if !contradicts(&scans, &moved) {
                return moved;
            }
            // a wrong lens looks much like an offset, and is then taken out as one: scans alone know of neither
            let fused = fused_or_one(session, (target, camera), frame, &run);
            if fused.verdict == Verdict::Accepted && !contradicts(&scans, &fused) {
                return fused;
            }
            if moved.verdict == Verdict::Accepted && scans.verdict == Verdict::Accepted {
                let finding = offset.not_confirmed(&scans, &moved);
                return scans.noting_first([finding]);
            }
            moved
        }
        (AnswerFrame::Image, Some(x)) => image.noting_first([offset.warning(&x, frame)]),
        (AnswerFrame::Image, None) => image,
    }
}

/// Gain of the logarithm of the likelihood that tells an offset from a lens that is off.
const CLEAR: f64 = 3.0;

/// A wrong lens looks much like an offset, and either can be taken out as the other. Which of both it is, images and
/// scans say that agree better, capture by capture, where it is taken out; where they do not tell, the stated error
/// covers the distance of both answers.
fn offset_or_lens(
    (session, moved): (&Session, Calibration),
    (without, image): (&Session, &Calibration),
    (target, camera): (&TargetModel, &Intrinsics),
    run: impl Fn(&Session) -> Calibration,
) -> Calibration {
    let fused = run(session);
    if fused.verdict != Verdict::Accepted || fused.camera.is_none() || session.camera_from_views {
        return moved;
    }
    let of_lens = agreement(&differences(session, target, camera, &fused));
    let of_offset = agreement(&differences(without, target, camera, image));
    let (Some(of_lens), Some(of_offset)) = (of_lens, of_offset) else { return moved };
    let apart = farthest_mm(&fused, &moved).unwrap_or(0.0);
    let gain = of_lens - of_offset;
    let answer = if gain > 0.0 { fused } else { moved };
    if gain.abs() >= CLEAR {
        return answer;
    }
    let tre = answer.predicted_tre_mm.clone().map(|tre| tre.widened(0.5 * apart, 2.0));
    Calibration { predicted_tre_mm: tre, ..answer }
}

/// Logarithm of the likelihood of differences that should be zero, but for noise of their own size.
fn agreement(all: &[Vector6<f64>]) -> Option<f64> {
    let n = all.len() as f64;
    if all.len() < FEWEST_CAPTURES {
        return None;
    }
    let scatter = all.iter().map(|x| x * x.transpose()).sum::<Matrix6<f64>>() / n;
    let determinant = scatter.cholesky()?.l().diagonal().iter().map(|d| 2.0 * d.ln()).sum::<f64>();
    Some(-0.5 * n * determinant)
}

/// Largest distance (mm) of two answers where the target was seen.
fn farthest_mm(a: &Calibration, b: &Calibration) -> Option<f64> {
    let off = predict::difference(
        a.hand_eye.mount_from_camera.as_ref()?,
        b.hand_eye.mount_from_camera.as_ref()?,
    );
    let seen = a.captures.iter().filter_map(|c| c.camera_from_target);
    Some(seen.map(|p| off(&p.translation()).norm() * 1e3).fold(0.0, f64::max))
}

/// Whether the corners in the scans were lifted along the rays of their pixels: sideways they are then where the images
/// put them, and do not know the frame of the scans by themselves.
fn on_rays(session: &Session, camera: &Intrinsics) -> bool {
    let on = |o: &crate::Observation| -> Vec<bool> {
        let pixel = |c: &SurfaceCorner| o.corners.iter().find(|p| p.id == c.id).map(|p| p.pixel);
        let one = |c: &SurfaceCorner| Some(on_ray(camera, &c.in_camera.vector(), &pixel(c)?));
        o.surface.iter().filter_map(one).collect()
    };
    let all: Vec<bool> = session.observations.iter().flat_map(on).collect();
    2 * all.iter().filter(|on| **on).count() >= all.len()
}

/// Whether an answer lies farther from that of the scans alone than the latter may err.
fn contradicts(scans: &Calibration, answer: &Calibration) -> bool {
    let apart = farthest_mm(scans, answer).zip(scans.predicted_tre_mm.as_ref());
    apart.is_some_and(|(mm, tre)| mm > tre.p95)
}

/// Images and scans together where they agree, one of them where they do not.
fn fused_or_one(
    session: &Session,
    (target, camera): (&TargetModel, &Intrinsics),
    frame: AnswerFrame,
    run: impl Fn(&Session) -> Calibration,
) -> Calibration {
    let fused = run(session);
    let Some(gap) = gap(session, target, camera, &fused) else { return fused };
    // an answer that is not accepted states no error that could hide a disagreement
    let accepted = fused.predicted_tre_mm.as_ref().filter(|_| fused.verdict == Verdict::Accepted);
    let stated = accepted.map_or(0.0, |t| t.p95 * 1e-3);
    if !gap.counts(stated) {
        return fused;
    }
    let (wanted, other) = match frame {
        AnswerFrame::Scan => (Source::Scan, Source::Image),
        AnswerFrame::Image => (Source::Image, Source::Scan),
    };
    let one = run(&restricted(session, wanted, target, camera));
    let beside = run(&restricted(session, other, target, camera));
    in_frame_of(wanted, one, &beside, &gap)
}

/// A disagreement that cannot be told from others is none that an answer can rest on.
fn not_separable(result: Calibration) -> Calibration {
    let finding = FramesFinding::NotSeparable;
    let reasons = [vec![finding.message()], result.reasons.clone()].concat();
    result.rejected_for(reasons).noting([finding])
}

impl Gap {
    fn size(&self) -> (f64, f64) {
        (lie::omega(&self.mean).norm(), lie::nu(&self.mean).norm())
    }

    fn counts(&self, stated_m: f64) -> bool {
        let (angle, _) = self.size();
        let mut shift = lie::nu(&self.mean).into_owned();
        // small errors of depth are among the unknowns of the fit
        shift.z -= shift.z.clamp(-OF_DEPTH, OF_DEPTH);
        let effect = shift.norm().hypot(angle * HALF_EXTENT);
        self.chance < IMPROBABLE && effect > NEGLIGIBLE * stated_m
    }
}

/// The mean difference over the captures that the fused answer rests on.
fn gap(
    session: &Session,
    target: &TargetModel,
    camera: &Intrinsics,
    fused: &Calibration,
) -> Option<Gap> {
    mean_of(&differences(session, target, camera, fused))
}

/// How far images and scans put the target apart, capture by capture, under the lens, depth and size that were found.
fn differences(
    session: &Session,
    target: &TargetModel,
    camera: &Intrinsics,
    fused: &Calibration,
) -> Vec<Vector6<f64>> {
    let size = fused.target_scale.filter(|s| s.used).map_or(1.0, |s| s.value);
    let target = &target.resized(size);
    let given = camera;
    let camera = fused.camera.map_or(*given, |c| c.intrinsics);
    let middle =
        target.corners().iter().map(|c| c.vector()).sum::<Vector3<f64>>() / target.len() as f64;
    let depth = fused.depth.map_or((0.0, 0.0), |d| (d.scale - 1.0, d.bias_mm * 1e-3));
    let counts = fused.hand_eye.mount_from_camera.is_some();
    let difference = |k: usize| {
        let (o, report) = (&session.observations[k], fused.captures.get(k)?);
        if o.surface.len() < FEWEST || o.corners.is_empty() || counts && !report.used {
            return None;
        }
        let lifted = lifted_again(&o.surface, &o.corners, given, &camera);
        let surface = corrected(&lifted, depth.0, depth.1);
        let scan = scan_pose(&surface, target)?.camera_from_target;
        let near = |p: &TargetPose| {
            let start = &p.camera_from_target;
            Some(detect::sighted(&o.corners, &[], target, &camera, None, start)?.0)
        };
        let images = o.candidates.iter().filter_map(near);
        images
            .map(|image| apart(&image.pose.camera_from_target, &scan, &middle))
            .min_by(|a, b| lie::omega(a).norm().total_cmp(&lie::omega(b).norm()))
    };
    (0..session.observations.len()).filter_map(difference).collect()
}

/// Rotation (rad) and shift of the middle (m) from one pose of the target to another, in the camera frame.
fn apart(
    from: &Pose<Camera, Target>,
    to: &Pose<Camera, Target>,
    middle: &Vector3<f64>,
) -> Vector6<f64> {
    let turn = lie::so3_log(&(to.iso().rotation * from.iso().rotation.inverse()));
    let at = |p: &Pose<Camera, Target>| p.rotation() * middle + p.translation();
    let shift = at(to) - at(from);
    Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z)
}

/// Hotelling's test of the mean against zero.
fn mean_of(all: &[Vector6<f64>]) -> Option<Gap> {
    let n = all.len() as f64;
    let mean = all.iter().sum::<Vector6<f64>>() / n;
    if all.len() < FEWEST_CAPTURES {
        let (angle, distance) = (lie::omega(&mean).norm(), lie::nu(&mean).norm());
        let large = angle > LARGE.angle || distance > LARGE.distance;
        return (!all.is_empty()).then_some(Gap { mean, chance: if large { 0.0 } else { 1.0 } });
    }
    let scatter = |s: Matrix6<f64>, x: &Vector6<f64>| s + (x - mean) * (x - mean).transpose();
    let covariance = all.iter().fold(Matrix6::zeros(), scatter) / (n - 1.0);
    let t2 = n * mean.dot(&(covariance.try_inverse()? * mean));
    let f = t2 * (n - 6.0) / (6.0 * (n - 1.0));
    Some(Gap { mean, chance: statistics::of_f(f, (6.0, n - 6.0)) })
}

/// The session with target poses from one of both alone.
fn restricted(
    session: &Session,
    source: Source,
    target: &TargetModel,
    camera: &Intrinsics,
) -> Session {
    let mut session = session.clone();
    let of = |corners: &[ImageCorner], surface: &[SurfaceCorner], known: &[TargetPose]| match source
    {
        Source::Image => detect::target_poses(corners, &[], target, camera)
            .map_or(vec![], |posed| detect::with_symmetries(&posed, target)),
        // where a board stands in the scan does not depend on the lens, and what its symmetries are does not on the scan
        Source::Scan => known
            .iter()
            .filter_map(|k| scan_pose(&renamed(surface, known, k, target), target))
            .collect(),
    };
    for o in &mut session.observations {
        o.candidates = of(&o.corners, &o.surface, &o.candidates);
    }
    for p in &mut session.placements {
        p.candidates = of(&p.corners, &p.surface, &p.candidates);
    }
    match source {
        Source::Image => {
            session.observations.iter_mut().for_each(|o| o.surface.clear());
            session.placements.iter_mut().for_each(|p| p.surface.clear());
        }
        // nothing is left that lens or size could explain: the scan alone says where the target is
        Source::Scan => session.camera = None,
    }
    session
}

/// Corners of a scan under the names that one pose candidate of a symmetric board gives them.
fn renamed(
    surface: &[SurfaceCorner],
    candidates: &[TargetPose],
    chosen: &TargetPose,
    target: &TargetModel,
) -> Vec<SurfaceCorner> {
    let map = crate::calibrate::captures::residuals::relabelling_of(
        candidates,
        &chosen.camera_from_target,
        target,
    );
    let one = |c: &SurfaceCorner| Some(SurfaceCorner { id: *map.get(c.id as usize)?, ..*c });
    surface.iter().filter_map(one).collect()
}

/// The target's pose from its corners in the scan alone.
fn scan_pose(surface: &[SurfaceCorner], target: &TargetModel) -> Option<TargetPose> {
    if surface.len() < FEWEST {
        return None;
    }
    let (model, seen): (Vec<Vector3<f64>>, Vec<Vector3<f64>>) = surface
        .iter()
        .filter_map(|c| Some((target.corner(c.id)?.vector(), c.in_camera.vector())))
        .unzip();
    let fit = register::rigid_fit(&model, &seen).ok()?;
    Some(TargetPose {
        camera_from_target: Pose::claim(fit.target_from_source),
        covariance: fit.covariance,
    })
}

/// The answer of one source, with what the other one says beside it.
fn in_frame_of(
    source: Source,
    answer: Calibration,
    beside: &Calibration,
    gap: &Gap,
) -> Calibration {
    let (angle, distance) = gap.size();
    let finding = FramesFinding::Disagree {
        used: match source {
            Source::Scan => Frame::Scans,
            Source::Image => Frame::Images,
        },
        distance_mm: distance * 1e3,
        angle_deg: angle.to_degrees(),
        other: other_answer(&answer, beside),
    };
    let reason = (answer.verdict != Verdict::Accepted).then(|| finding.message());
    let reasons = answer.reasons.iter().cloned().chain(reason).collect();
    Calibration { reasons, ..answer }.noting([finding])
}

/// How far the other source's answer lies away.
fn other_answer(answer: &Calibration, beside: &Calibration) -> Option<OtherAnswer> {
    let own = answer.hand_eye.mount_from_camera?;
    let theirs = beside.hand_eye.mount_from_camera?;
    let seen = answer.captures.iter().filter_map(|c| c.camera_from_target);
    let points: Vec<Vector3<f64>> = seen.map(|p| p.translation()).collect();
    let off = predict::difference(&own, &theirs);
    let mean = points.iter().map(|p| off(p).norm()).sum::<f64>() / points.len().max(1) as f64;
    let position_mm = (theirs.translation() * 1e3).into();
    Some(OtherAnswer { position_mm, differs_mm: mean * 1e3 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn differences(mean: Vector6<f64>, sigma: f64, count: usize, seed: u64) -> Vec<Vector6<f64>> {
        let mut random = Random::new(seed);
        (0..count).map(|_| mean + Vector6::from_fn(|_, _| sigma * random.normal())).collect()
    }

    #[test]
    fn noise_alone_is_no_disagreement() {
        let false_alarms = (0..200)
            .filter(|seed| {
                let gap = mean_of(&differences(Vector6::zeros(), 1e-3, 12, *seed)).unwrap();
                gap.counts(1e-4)
            })
            .count();
        assert!(false_alarms <= 2, "{false_alarms}");
    }

    #[test]
    fn a_common_shift_is_one_where_it_exceeds_the_stated_error() {
        let shift = Vector6::new(0.0, 0.0, 0.0, 2e-3, 0.0, 0.0);
        let gap = mean_of(&differences(shift, 2e-4, 12, 1)).unwrap();
        assert!(gap.chance < 1e-6);
        assert!(gap.counts(1e-3));
        assert!(!gap.counts(10e-3));
    }

    #[test]
    fn few_captures_disagree_only_by_much() {
        let shift = |m: f64| vec![Vector6::new(0.0, 0.0, 0.0, 0.0, m, 0.0); 3];
        assert!(mean_of(&shift(5e-3)).unwrap().counts(1e-3));
        assert!(!mean_of(&shift(1e-3)).unwrap().counts(1e-4));
        assert!(mean_of(&[]).is_none());
    }
}
