//! Which mistake explains bad data: inversion, scale, exchange, stale poses; a board that is not
//! flat; pictures and scans that do not agree.

pub mod explain;
pub mod flatness;
pub mod frames;
pub mod score;
mod size;
mod strays;

pub use size::{cause_of_size, size_finding};

use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::{
    HandEye, Pose, PosePair, Setup, Target,
    detect::sight::{CAMERA, Sight, TARGET_SCALE},
    estimate::{self, Extra, ExtraKind, JointFit, Problem, noise::KnownNoise, predict},
    math::{linalg::median, statistics},
    solve::{
        View,
        consensus::{self, Consensus, Readings},
        motions,
    },
};

/// A mistake in how all poses were written or read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// As declared.
    AsDeclared,
    /// The robot poses take the base to the flange, not the flange to the base (or the camera is
    /// mounted the other way: the numbers are the same).
    RobotInverted,
    /// The target poses take the camera to the target, not the target to the camera.
    TargetInverted,
}

/// The share of captures that agree under a convention, and their median misfit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// Which convention.
    pub convention: Convention,
    /// Captures that agree.
    pub agree: usize,
    /// Median misfit of all captures, m.
    pub median_m: f64,
    /// Median misfit of all captures, rad.
    pub median_rad: f64,
}

/// How well all captures fit under each convention, the declared one first.
pub fn conventions(captures: &[Readings], declared: Option<&Consensus>) -> Vec<Evidence> {
    let mut all = Vec::new();
    all.extend(declared.map(|c| evidence(captures, c, Convention::AsDeclared)));
    for convention in [Convention::RobotInverted, Convention::TargetInverted] {
        let turned = reread(captures, convention);
        if let Ok(found) = consensus::consensus(&turned) {
            all.push(evidence(&turned, &found, convention));
        }
    }
    all
}

fn reread(captures: &[Readings], convention: Convention) -> Vec<Readings> {
    let mut turned = captures.to_vec();
    for capture in &mut turned {
        match convention {
            Convention::AsDeclared => {}
            Convention::RobotInverted => {
                capture.anchor_from_mount = capture.anchor_from_mount.inverse().rename();
            }
            Convention::TargetInverted => {
                capture.camera_from_target.iter_mut().for_each(|c| *c = c.inverse().rename());
            }
        }
    }
    turned
}

fn evidence(captures: &[Readings], found: &Consensus, convention: Convention) -> Evidence {
    let loops: Vec<Pose<Target, Target>> = captures
        .iter()
        .zip(&found.reading)
        .filter(|(c, _)| !c.camera_from_target.is_empty())
        .map(|(c, &k)| {
            found.hand_eye.loop_error(&PosePair {
                anchor_from_mount: c.anchor_from_mount,
                camera_from_target: c.camera_from_target[k],
            })
        })
        .collect();
    Evidence {
        convention,
        agree: found.agrees.iter().filter(|a| **a).count(),
        median_m: median(loops.iter().map(|e| e.translation().norm())),
        median_rad: median(loops.iter().map(|e| e.iso().rotation.angle())),
    }
}

/// Size of the target as the robot's motions see it, over the declared one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetScale {
    /// The factor on the measured distances that fits best.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Chance of a factor as far from one when the declared size is right.
    pub p_value: f64,
}

/// Finds the size of the target that fits best. The noise is estimated again at that size: a wrong
/// size would otherwise pass for noise and hide itself.
pub fn target_scale(
    views: &[View],
    at: &JointFit,
    known: &KnownNoise,
    setup: Setup,
) -> Option<TargetScale> {
    let size = Extra::about_zero(ExtraKind::Camera(TARGET_SCALE), 1.0);
    let fit_scale = |views: &[View], start: &HandEye| {
        let views = views.iter().map(of_any_size).collect();
        let problem =
            Problem { setup, views, boards: vec![], extras: vec![size], known_position: None };
        let fit = estimate::fit_joint(&problem, start, known).ok()?;
        Some((1.0 + fit.extra(size.kind)?.0, fit.extra(size.kind)?.1, fit))
    };
    let (first, _, coarse) = fit_scale(views, &at.hand_eye)?;
    if !(SCALES.0..SCALES.1).contains(&first) {
        return None;
    }
    let (more, sigma, fit) = fit_scale(&rescaled(views, first), &coarse.hand_eye)?;
    let (value, sigma) = (first * more, first * sigma);
    let dof = fit.degrees_of_freedom - 1.0;
    let p_value = statistics::of_f(((value - 1.0) / sigma).powi(2), (1.0, dof));
    Some(TargetScale { value, sigma, p_value })
}

/// Sizes of the target, over the declared one, that are worth a second look.
const SCALES: (f64, f64) = (0.2, 5.0);

/// Views as they would be with a target `s` times as large.
pub fn rescaled(views: &[View], s: f64) -> Vec<View> {
    let mut all = views.to_vec();
    for view in &mut all {
        view.pair.camera_from_target = view.pair.camera_from_target.farther(s);
    }
    all
}

/// A view of which the size of its target is open.
fn of_any_size(view: &View) -> View {
    let mut by = nalgebra::SMatrix::<f64, 6, CAMERA>::zeros();
    by.set_column(TARGET_SCALE, &Sight::by_size(&view.pair.camera_from_target));
    View { sight: Some(Sight::moving(by).into()), ..view.clone() }
}

/// A capture whose picture fits another capture's robot pose: `(picture, robot pose)`.
pub fn exchanged(
    captures: &[Readings],
    found: &Consensus,
    limit: (f64, f64),
) -> Vec<(usize, usize)> {
    let wrong: Vec<usize> = (0..captures.len())
        .filter(|&i| !found.agrees[i] && !captures[i].camera_from_target.is_empty())
        .collect();
    let fits = |picture: usize, robot: usize| {
        captures[picture].camera_from_target.iter().any(|&camera_from_target| {
            let anchor_from_mount = captures[robot].anchor_from_mount;
            let e = found.hand_eye.loop_error(&PosePair { anchor_from_mount, camera_from_target });
            e.iso().rotation.angle() < limit.0 && e.translation().norm() < limit.1
        })
    };
    let other = |picture: usize| (0..captures.len()).find(|&j| j != picture && fits(picture, j));
    wrong.iter().filter_map(|&i| other(i).map(|j| (i, j))).collect()
}

/// Largest standard deviations of an answer that still counts as determined: 3 degrees, 20 mm.
const FREE: (f64, f64) = (0.052, 0.02);

/// What the data leave free of `mount_from_camera`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// A rotation, or else a translation.
    pub is_rotation: bool,
    /// About or along which direction, in the mount.
    pub axis: Vector3<f64>,
}

/// Directions of `mount_from_camera` that the data leave free.
pub fn free_directions(fit: &JointFit) -> Vec<Free> {
    let Some(covariance) = fit.pose_covariance() else {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        return [true, false]
            .into_iter()
            .flat_map(|is_rotation| axes.map(|axis| Free { is_rotation, axis }))
            .collect();
    };
    let of_mount = covariance.fixed_view::<6, 6>(0, 0).into_owned();
    free_of(&of_mount, &fit.hand_eye.mount_from_camera.rotation())
}

/// The same for a covariance of `mount_from_camera`, whose rotation is `r`.
pub(crate) fn free_of(covariance: &Matrix6<f64>, r: &Matrix3<f64>) -> Vec<Free> {
    let mut free = Vec::new();
    for (block, limit) in [(0, FREE.0), (3, FREE.1)] {
        let s: Matrix3<f64> = covariance.fixed_view::<3, 3>(block, block).into_owned();
        let eigen = s.symmetric_eigen();
        for k in 0..3 {
            if eigen.eigenvalues[k].max(0.0).sqrt() > limit {
                let axis = r * eigen.eigenvectors.column(k);
                // the same direction has the same sign in every run
                let sign = if axis[axis.iamax()] < 0.0 { -1.0 } else { 1.0 };
                free.push(Free { is_rotation: block == 0, axis: axis * sign });
            }
        }
    }
    free
}

/// Cosine of the angle between a direction and the robot's one axis up to which they are the same.
const ALONG: f64 = 0.999;

/// Free directions in the user's words.
pub fn in_words(free: &[Free], pairs: &[PosePair], setup: Setup) -> Vec<String> {
    let mount = setup.mount();
    let count = |is_rotation| free.iter().filter(|f| f.is_rotation == is_rotation).count();
    let mut named = Vec::new();
    let single = motions::single_axis(pairs);
    for (is_rotation, all, what) in [
        (true, "the rotation of the camera on", "rotation about"),
        (false, "the position of the camera on", "translation along"),
    ] {
        if count(is_rotation) == 3 {
            named.push(format!("{all} {mount}"));
            continue;
        }
        for f in free.iter().filter(|f| f.is_rotation == is_rotation) {
            let turning = single.is_some_and(|a| a.dot(&f.axis).abs() > ALONG);
            let which = if turning { "the rotation axis " } else { "" };
            named.push(format!("{what} {which}{} of {mount}", axis_name(&f.axis)));
        }
    }
    named
}

/// `x`, `y`, `z`, or the direction in numbers.
pub fn axis_name(axis: &nalgebra::Vector3<f64>) -> String {
    let axis = axis.normalize();
    let k = axis.iamax();
    if axis[k].abs() > 0.9998 {
        return ["x", "y", "z"][k].into();
    }
    format!("({:.2}, {:.2}, {:.2})", axis.x, axis.y, axis.z)
}

/// Points of the target as seen in all captures, in the camera frame, under a name.
pub fn seen_volume(
    pairs: &[PosePair],
    corners: &[crate::Point<Target>],
    name: &str,
) -> Option<predict::Volume> {
    let points = pairs
        .iter()
        .flat_map(|p| corners.iter().map(move |c| (p.camera_from_target * *c).vector()));
    predict::Volume::around(points, name)
}
