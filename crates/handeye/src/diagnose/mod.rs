//! Which mistake explains bad data: inversion, scale, exchange, stale poses.

pub mod explain;
mod size;
mod strays;

use crate::{
    HandEye, Pose, PosePair, Setup, Target,
    detect::sight::{CAMERA, Sight, TARGET_SCALE},
    predict,
    refine::{self, Extra, ExtraKind, JointFit, Problem, View, noise::KnownNoise},
    solve::consensus::{self, Consensus, Readings},
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
        median_m: consensus::median(loops.iter().map(|e| e.translation().norm()).collect()),
        median_rad: consensus::median(loops.iter().map(|e| e.iso().rotation.angle()).collect()),
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
    use statrs::distribution::{ContinuousCDF, FisherSnedecor};
    let size = Extra::about_zero(ExtraKind::Camera(TARGET_SCALE), 1.0);
    let fit_scale = |views: &[View], start: &HandEye| {
        let scaling = |v: &View| View { sight: Some(by_scale(v).into()), ..v.clone() };
        let views = views.iter().map(scaling).collect();
        let problem = Problem { setup, views, boards: vec![], extras: vec![size] };
        let fit = refine::fit_joint(&problem, start, known).ok()?;
        Some((1.0 + fit.extra(size.kind)?.0, fit.extra(size.kind)?.1, fit))
    };
    let (first, _, coarse) = fit_scale(views, &at.hand_eye)?;
    if !(SCALES.0..SCALES.1).contains(&first) {
        return None;
    }
    let (more, sigma, fit) = fit_scale(&rescaled(views, first), &coarse.hand_eye)?;
    let (value, sigma) = (first * more, first * sigma);
    let dof = fit.degrees_of_freedom - 1.0;
    let p_value = FisherSnedecor::new(1.0, dof).ok()?.sf(((value - 1.0) / sigma).powi(2));
    Some(TargetScale { value, sigma, p_value })
}

/// Sizes of the target, over the declared one, that are worth a second look.
const SCALES: (f64, f64) = (0.2, 5.0);

/// Views as they would be with a target `s` times as large.
pub fn rescaled(views: &[View], s: f64) -> Vec<View> {
    let mut all = views.to_vec();
    for view in &mut all {
        let mut iso = *view.pair.camera_from_target.iso();
        iso.translation.vector *= s;
        view.pair.camera_from_target = Pose::claim(iso);
    }
    all
}

/// A larger target is farther away: `t (1 + s) = t + R (Rᵀ t) s`.
fn by_scale(view: &View) -> Sight {
    let c = &view.pair.camera_from_target;
    let mut by = nalgebra::SMatrix::<f64, 6, CAMERA>::zeros();
    let outward = c.rotation().transpose() * c.translation();
    by.fixed_view_mut::<3, 1>(3, TARGET_SCALE).copy_from(&outward);
    Sight::moving(by)
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

/// Directions of `mount_from_camera` that the data leave free, in the user's words.
pub fn undetermined(fit: &JointFit, setup: Setup) -> Vec<String> {
    let Some(covariance) = fit.pose_covariance() else {
        return vec![format!("the pose of the camera on the {}", setup.mount())];
    };
    let x = covariance.fixed_view::<6, 6>(0, 0);
    let r = fit.hand_eye.mount_from_camera.rotation();
    let mut named = Vec::new();
    for (block, limit, what) in [(0, FREE.0, "rotation about"), (3, FREE.1, "translation along")] {
        let s: nalgebra::Matrix3<f64> = x.fixed_view::<3, 3>(block, block).into_owned();
        let eigen = s.symmetric_eigen();
        for k in 0..3 {
            if eigen.eigenvalues[k].max(0.0).sqrt() > limit {
                let axis = r * eigen.eigenvectors.column(k);
                named.push(format!("{what} {} of {}", axis_name(&axis), setup.mount()));
            }
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
