//! Captures that do not belong: exchanged, moved, standing still, repeated.

use super::exchanged;
use crate::{
    HandEye, PosePair,
    math::linalg::median,
    mistakes::score::{FEWEST, Fault, Finding, pair, scored},
    solve::consensus::{Consensus, Readings},
};

/// Captures beyond the agreement: exchanged, or from before or after something moved.
pub(super) fn strays(captures: &[Readings], found: &Consensus) -> Vec<Finding> {
    let limit = limits(captures, found);
    let mut all = Vec::new();
    let swapped: Vec<(usize, usize)> = exchanged(captures, found, limit)
        .into_iter()
        .filter(|&(i, j)| i < j && exchanged_back(captures, found, limit, (j, i)))
        .collect();
    if !swapped.is_empty() {
        let mut corrected = captures.to_vec();
        for &(i, j) in &swapped {
            let other = corrected[j].camera_from_target.clone();
            corrected[j].camera_from_target =
                std::mem::replace(&mut corrected[i].camera_from_target, other);
        }
        let after = scored(&corrected).map(|(s, _)| s);
        all.push(Finding { fault: Fault::Exchanged(swapped), after });
    }
    all.extend(moved(captures, found, limit));
    let out: Vec<usize> = (0..captures.len()).filter(|&i| !found.agrees[i]).collect();
    let rest = captures.len() - out.len();
    if all.is_empty()
        && out.len() > 1
        && rest >= FEWEST
        && out.len() as f64 > MOST_STRAYS * captures.len() as f64
    {
        all.push(Finding { fault: Fault::Disagreeing(out), after: None });
    }
    all
}

/// More captures than this part that agree with no others are not left out in silence.
const MOST_STRAYS: f64 = 0.15;

/// Whether the second picture fits the first robot pose as well.
fn exchanged_back(
    captures: &[Readings],
    found: &Consensus,
    limit: (f64, f64),
    (picture, robot): (usize, usize),
) -> bool {
    captures[picture].camera_from_target.iter().any(|&camera_from_target| {
        let anchor_from_mount = captures[robot].anchor_from_mount;
        let e = found.hand_eye.loop_error(&PosePair { anchor_from_mount, camera_from_target });
        e.iso().rotation.angle() < limit.0 && e.translation().norm() < limit.1
    })
}

/// Misfit that still belongs: several times the median of those that agree. rad and m.
fn limits(captures: &[Readings], found: &Consensus) -> (f64, f64) {
    let (angles, distances): (Vec<f64>, Vec<f64>) = (0..captures.len())
        .filter(|&i| found.agrees[i] && !captures[i].camera_from_target.is_empty())
        .map(|i| {
            let e = found.hand_eye.loop_error(&pair(&captures[i], found.reading[i]));
            (e.iso().rotation.angle(), e.translation().norm())
        })
        .unzip();
    (5.0 * median(angles).max(5e-4), 5.0 * median(distances).max(3e-4))
}

/// A run of captures that agree with each other, but not with the rest: the target, or the camera,
/// was somewhere else during it.
fn moved(captures: &[Readings], found: &Consensus, limit: (f64, f64)) -> Option<Finding> {
    let n = captures.len();
    let out: Vec<usize> = (0..n).filter(|&i| !found.agrees[i]).collect();
    let (first, last) = (*out.first()?, *out.last()?);
    // one capture is a stray, not a run; most of them, and enough, must not have moved
    let rest = n - out.len();
    if out.len() < 2 || last - first + 1 != out.len() || rest <= out.len() || rest < FEWEST {
        return None;
    }
    let HandEye { mount_from_camera: x, anchor_from_target: y } = found.hand_eye;
    let by_target = together(captures, &out, limit, |p| {
        let there = p.anchor_from_mount * x * p.camera_from_target;
        HandEye { mount_from_camera: x, anchor_from_target: there }
    });
    let by_camera = together(captures, &out, limit, |p| {
        let there = p.anchor_from_mount.inverse() * y * p.camera_from_target.inverse();
        HandEye { mount_from_camera: there, anchor_from_target: y }
    });
    let fault = match by_target <= by_camera {
        true => Fault::TargetMoved(first, last),
        false => Fault::CameraMoved(first, last),
    };
    (by_target.min(by_camera) < 1.0).then_some(Finding { fault, after: None })
}

/// Largest misfit of a run, over `limit`, when one of its captures, the best one, says where the
/// part that moved was.
fn together(
    captures: &[Readings],
    run: &[usize],
    limit: (f64, f64),
    place: impl Fn(&PosePair) -> HandEye,
) -> f64 {
    let readings = |i: usize| (0..captures[i].camera_from_target.len()).map(move |k| (i, k));
    let misfit = |there: &HandEye, p: &PosePair| {
        let e = there.loop_error(p);
        (e.iso().rotation.angle() / limit.0).hypot(e.translation().norm() / limit.1)
    };
    let worst = |there: HandEye| {
        let best = |&i: &usize| {
            let all = readings(i).map(|(i, k)| misfit(&there, &pair(&captures[i], k)));
            all.fold(f64::INFINITY, f64::min)
        };
        run.iter().map(best).fold(0.0, f64::max)
    };
    run.iter()
        .flat_map(|&i| readings(i))
        .map(|(i, k)| worst(place(&pair(&captures[i], k))))
        .fold(f64::INFINITY, f64::min)
        / ONE_FOR_ALL
}

/// A place told by one capture has its error at the end of the arm between camera and target: so
/// many times the misfit of captures that were fitted together.
const ONE_FOR_ALL: f64 = 3.0;

/// Robot poses this close were stored twice, not reached twice. rad and m.
const SAME_ROBOT: (f64, f64) = (1e-6, 1e-6);
/// Target poses this close show the same picture.
const SAME_VIEW: (f64, f64) = (3e-3, 1e-3);
/// A motion beyond this is none of noise. rad and m.
const MOTION: (f64, f64) = (0.03, 0.01);

/// Poses that stood still.
pub(super) fn repeats(captures: &[Readings]) -> Vec<Finding> {
    let robot_same = |i: usize, j: usize| same_robot(&captures[i], &captures[j]);
    let apart = |i: usize, j: usize| {
        let (a, b) = (&captures[i].anchor_from_mount, &captures[j].anchor_from_mount);
        a.angle_to(b) > MOTION.0 || a.distance_to(b) > MOTION.1
    };
    let view = |i: usize, j: usize, near: (f64, f64)| {
        captures[i].camera_from_target.iter().any(|a| {
            captures[j]
                .camera_from_target
                .iter()
                .any(|b| a.angle_to(b) < near.0 && a.distance_to(b) < near.1)
        })
    };
    let groups = [
        (partners(captures.len(), |i, j| robot_same(i, j) && !view(i, j, MOTION)), 0),
        (partners(captures.len(), |i, j| apart(i, j) && view(i, j, SAME_VIEW)), 1),
        (partners(captures.len(), |i, j| robot_same(i, j) && view(i, j, SAME_VIEW)), 2),
    ];
    let finding = |(which, kind): (Vec<usize>, usize)| {
        let fault = match kind {
            0 => Fault::RobotStill(which),
            1 => Fault::CameraStill(which),
            _ => Fault::Repeated(which),
        };
        Finding { fault, after: None }
    };
    groups.into_iter().filter(|(which, _)| !which.is_empty()).map(finding).collect()
}

/// Whether two captures have one and the same robot pose.
pub(super) fn same_robot(a: &Readings, b: &Readings) -> bool {
    let (a, b) = (&a.anchor_from_mount, &b.anchor_from_mount);
    a.angle_to(b) < SAME_ROBOT.0 && a.distance_to(b) < SAME_ROBOT.1
}

/// Everyone who has a partner.
fn partners(n: usize, with: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    (0..n).filter(|&i| (0..n).any(|j| j != i && with(i.min(j), i.max(j)))).collect()
}
