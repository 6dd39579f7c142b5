//! Residual of every capture and touch, and which way round the target lies.

use crate::{
    Calibration, Camera, HandEye, ImageCorner, Intrinsics, Mount, Observation, Placement, Point,
    Pose, Target, TargetModel, TargetPose, Touch,
    calibrate::{
        flow::{
            evidence::{Choice, Evidence, Seen},
            notes::Notes,
            views::{self, Views, own_pose},
        },
        result::CaptureResult,
    },
    detect::{
        self,
        sight::{Sight, TARGET_SCALE},
    },
    estimate::{
        JointFit,
        evaluate::{self, HeldOut},
        touch_pairs::{self, TouchPairs},
    },
    findings::{TouchFinding, touches::Unseen},
    math::{lie, linalg::root_mean},
    model::{residual::Residual, session::Session},
    solve::View,
};

/// Poses of the target in an observation, as an answer sees it: with the camera and the size of the target that the answer has
/// found. All readings of a board that looks alike when it is turned.
pub(crate) fn readings(
    result: &Calibration,
    session: &Session,
    o: &Observation,
) -> Vec<Pose<Camera, Target>> {
    let camera = result.camera.as_ref().map(|c| c.intrinsics).or(session.camera);
    let size = result.target_scale.filter(|s| s.used).map_or(1.0, |s| s.value);
    let target = session.target.as_ref().map(|target| target.resized(size));
    let found = target.as_ref().zip(camera).filter(|_| !o.corners.is_empty());
    let again = found.and_then(|(target, camera)| {
        let poses = detect::target_poses(&o.corners, &[], target, &camera).ok()?;
        Some(detect::with_symmetries(&poses, target))
    });
    let all = again.unwrap_or_else(|| o.candidates.clone());
    all.into_iter().map(|candidate| candidate.camera_from_target).collect()
}

/// Which symmetry of the board the chosen pose stands for: the one that brings the corners of the
/// image's first reading onto those of the chosen one.
pub fn relabelling(o: &Observation, pose: &Pose<Camera, Target>, target: &TargetModel) -> Vec<u32> {
    relabelling_of(&o.candidates, pose, target)
}

pub(crate) fn relabelling_of(
    candidates: &[TargetPose],
    pose: &Pose<Camera, Target>,
    target: &TargetModel,
) -> Vec<u32> {
    let maps = target.symmetries();
    let Some(first) = candidates.first() else { return maps[0].clone() };
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

/// Turns a symmetric target so that its corners lie where they were touched (eye-in-hand): views
/// alone cannot tell the board from itself turned by half a turn, and need not.
pub(crate) fn orient_target(views: &mut Views, fit: &mut JointFit) {
    let Some(target) = &views.session.target else { return };
    if views.session.setup != crate::Setup::EyeInHand || views.session.touches.is_empty() {
        return;
    }
    let base_from_target: Pose<crate::Base, Target> =
        fit.hand_eye.retarget(views.target_from_corner.inverse()).anchor_from_target.rename();
    let cost = |map: &Vec<u32>| -> f64 {
        let distance = |t: &Touch| {
            let corner = target.corner(*map.get(t.corner as usize)?)?;
            Some(((base_from_target * corner).vector() - t.in_base.vector()).norm())
        };
        views.session.touches.iter().filter_map(distance).sum()
    };
    let maps = target.symmetries();
    let Some(map) = maps.iter().min_by(|a, b| cost(a).total_cmp(&cost(b))) else { return };
    if *map != maps[0] {
        // old_from_new takes corner `id` to where corner `map[id]` was
        let old_from_new = detect::symmetry_turn(target, map).inverse();
        turn_all(views, fit, &old_from_new);
    }
}

fn turn_all(views: &mut Views, fit: &mut JointFit, old_from_new: &Pose<Target, Target>) {
    let s = views.target_from_corner;
    let turn = s.inverse() * *old_from_new * s;
    let carry = lie::adjoint(turn.inverse().iso());
    for view in &mut views.views {
        view.pair.camera_from_target = view.pair.camera_from_target * turn;
        view.covariance = view.covariance.map(|c| carry * c * carry.transpose());
        view.sight = view
            .sight
            .take()
            .map(|s: std::sync::Arc<Sight>| grown_from_its_corner(s.carried(&carry), &turn).into());
    }
    fit.hand_eye = fit.hand_eye.retarget(turn);
    let n = fit.information.nrows();
    let mut both = nalgebra::DMatrix::identity(n, n);
    both.fixed_view_mut::<6, 6>(6, 6).copy_from(&carry);
    fit.covariance = fit.covariance.take().map(|c| &both * c * both.transpose());
}

/// A larger board grows away from its first corner, which is another one when the board is turned.
fn grown_from_its_corner(mut sight: Sight, turn: &Pose<Target, Target>) -> Sight {
    let outward = turn.rotation().transpose() * turn.translation();
    for k in 0..3 {
        sight.by_camera[(3 + k, TARGET_SCALE)] += outward[k];
    }
    sight
}

/// A placement in the reading that puts its corners where they were touched.
pub(crate) fn oriented(
    placement: &Placement,
    touches: &[Touch],
    x: &Pose<Mount, Camera>,
    target: &TargetModel,
) -> Placement {
    let cost = |pose: &TargetPose| -> f64 {
        let touched = touches.iter().filter(|t| t.placement == placement.id);
        let distance = |t: &Touch| {
            let predicted: Point<Mount> =
                *x * (pose.camera_from_target * target.corner(t.corner)?);
            Some((predicted.vector() - t.in_base.vector()).norm())
        };
        touched.filter_map(distance).sum()
    };
    let best = placement.candidates.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
    let Some(&best) = best else { return placement.clone() };
    let map = relabelling_of(&placement.candidates, &best.camera_from_target, target);
    let mut placement = placement.clone();
    for corner in &mut placement.surface {
        corner.id = map.get(corner.id as usize).copied().unwrap_or(corner.id);
    }
    placement.corners = detect::relabelled(&placement.corners, &map);
    placement.candidates = vec![best];
    placement
}

/// Pairs touches with what the camera measured of their corners; the others are named.
pub(crate) fn pair_touches(views: &Views, fit: &JointFit) -> (Vec<TouchPairs>, Notes) {
    let Some(target) = &views.session.target else { return <_>::default() };
    let session = views.session;
    let chosen: Vec<Observation> =
        views.used.iter().zip(&views.views).map(|(o, v)| as_chosen(o, v, views, target)).collect();
    let chosen: Vec<&Observation> = chosen.iter().collect();
    let x = fit.hand_eye.mount_from_camera;
    let placements: Vec<Placement> =
        session.placements.iter().map(|p| oriented(p, &session.touches, &x, target)).collect();
    let (paired, missing) =
        touch_pairs::pair_touches(session.setup, target, &chosen, &placements, &session.touches);
    (paired, Notes::of(without_view(session, &missing)))
}

/// One finding for each placement whose touches pair with nothing; touches are sorted by placement.
fn without_view(session: &Session, missing: &[usize]) -> Vec<TouchFinding> {
    let name = |k: &usize| &session.touches[*k].placement;
    let one = |touches: &[usize]| {
        let placement = name(&touches[0]).clone();
        let seen = session.placements.iter().find(|p| p.id == placement);
        let unseen = match seen.map(|p| &p.not_seen) {
            Some(Some(reason)) => Unseen::NotFound(reason.clone()),
            Some(None) => Unseen::NothingSeen,
            None => Unseen::NoPlacement,
        };
        let corners = touches.iter().map(|k| session.touches[*k].corner).collect();
        TouchFinding::WithoutView { placement, corners, unseen }
    };
    missing.chunk_by(|a, b| name(a) == name(b)).map(one).collect()
}

/// The observation with the reading that was chosen: its pose alone, its scan's corners renamed.
fn as_chosen(o: &Observation, v: &View, views: &Views, target: &TargetModel) -> Observation {
    let pose = own_pose(v, views);
    let map = relabelling(o, &pose, target);
    let mut o = o.clone();
    for corner in &mut o.surface {
        corner.id = map.get(corner.id as usize).copied().unwrap_or(corner.id);
    }
    o.candidates = vec![TargetPose { camera_from_target: pose, covariance: v.covariance }];
    o
}

/// The captures with the leave-one-out residual of every view.
pub(crate) fn held_out(
    views: &Views,
    left_out: &HeldOut,
    mut captures: Vec<CaptureResult>,
) -> Vec<CaptureResult> {
    for (&i, left_out) in views.indices.iter().zip(left_out) {
        captures[i].held_out_deg = left_out.map(|h| h.angle.to_degrees());
        captures[i].held_out_mm = left_out.map(|h| h.distance * 1e3);
    }
    captures
}

/// With the residuals, under the chosen answer, of the captures that are used.
pub(crate) fn with_residuals(views: &Views, mut found: Evidence) -> Evidence {
    let Some(choice) = &mut found.choice else { return found };
    let Some(answer) = answer(choice, views) else { return found };
    let as_read = || Seen {
        pairs: views::pairs_of(views),
        camera: views.session.camera,
        target: views.session.target.clone(),
    };
    let seen = choice.seen.take().unwrap_or_else(as_read);
    for (pair, &i) in seen.pairs.iter().zip(&views.indices) {
        let Residual { angle, distance } = answer.loop_residual(pair);
        let capture = &mut found.captures[i];
        capture.camera_from_target =
            Some(pair.camera_from_target * views.target_from_corner.inverse());
        capture.residual_deg = Some(angle.to_degrees());
        capture.residual_mm = Some(distance * 1e3);
    }
    let (Some(target), Some(camera)) = (&views.session.target, &views.session.camera) else {
        return found;
    };
    let (Some(target_seen), Some(camera_seen)) = (&seen.target, &seen.camera) else { return found };
    let own = answer.retarget(views.target_from_corner.inverse());
    let (mut sum, mut count) = (0.0, 0.0);
    for (k, &i) in views.indices.iter().enumerate() {
        let o = views.used[k];
        let pose = own_pose(&views.views[k], views);
        let map = relabelling(o, &pose, target);
        let capture = &mut found.captures[i];
        capture.reprojection_px =
            evaluate::reprojection_px(&own, o, views.session.setup, target_seen, &map, camera_seen);
        capture.residual_px = picture_residual(o, &pose, target, &map, camera);
        if let Some(px) = capture.reprojection_px {
            let n = o.corners.len() as f64;
            (sum, count) = (sum + n * px * px, count + n);
        }
    }
    choice.residual.reprojection_rms_px = (count > 0.0).then(|| f64::sqrt(sum / count));
    found
}

/// The chosen answer about the target's first corner.
fn answer(choice: &Choice, views: &Views) -> Option<HandEye> {
    Some(choice.hand_eye.hand_eye()?.retarget(views.target_from_corner))
}

/// RMS distance (px) of corners to the target model seen from the image's own best pose.
fn picture_residual(
    o: &Observation,
    pose: &Pose<Camera, Target>,
    target: &TargetModel,
    relabel: &[u32],
    camera: &Intrinsics,
) -> Option<f64> {
    let square = |c: &ImageCorner| {
        let corner = target.corner(*relabel.get(c.id as usize)?)?;
        Some((camera.project(&(*pose * corner).vector())? - c.pixel).norm_squared())
    };
    root_mean(o.corners.iter().filter_map(square))
}
