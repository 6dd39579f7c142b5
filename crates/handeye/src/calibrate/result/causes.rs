//! One cause for several warnings. A board that is bent, or a scan that reads black elsewhere than white, also moves the
//! intrinsics, the depth, or images against scans, as far as it is bent or off itself; that is said with the cause, and not
//! once more as if it were a fault of its own.

use super::ScanResult;
use crate::{
    Calibration, Intrinsics, Session, Warning,
    findings::{CameraFinding, CombinedFinding, Effect, Finding, FramesFinding, TargetFinding},
    math::linalg::median,
    mistakes::flatness,
};

/// What a warning says, where it can be the effect of something else.
fn effect(warning: &Warning) -> Option<Effect> {
    match warning.finding.as_deref()? {
        Finding::Camera(CameraFinding::Refined { .. }) => Some(Effect::Intrinsics),
        Finding::Camera(CameraFinding::DepthOff { .. }) => Some(Effect::Depth),
        Finding::Frames(FramesFinding::Scale { .. }) => Some(Effect::Scale),
        Finding::Frames(FramesFinding::Tilt(_)) => Some(Effect::Tilt),
        Finding::Frames(FramesFinding::Shift(_)) => Some(Effect::Shift),
        _ => None,
    }
}

/// What explains effects, and how far it moves them, mm.
fn cause(warning: &Warning, scans: &ScanResult) -> Option<(Finding, f64)> {
    let finding = warning.finding.as_deref()?;
    let size_mm = match finding {
        Finding::Target(TargetFinding::NotFlat { .. }) => {
            scans.flatness.as_ref()?.peak_to_valley_mm
        }
        Finding::Camera(CameraFinding::DepthByColour { .. }) => {
            scans.colour_step.as_ref()?.black_minus_white_mm.abs()
        }
        _ => return None,
    };
    Some((finding.clone(), size_mm))
}

/// The result with what a cause explains said with that cause, and only there.
pub(crate) fn merged(result: Calibration, session: &Session) -> Calibration {
    let Some(scans) = &result.scans else { return result };
    let mut warnings = result.warnings.clone();
    let mut at = 0;
    while let Some(warning) = warnings.get(at) {
        let Some((cause, size_mm)) = cause(warning, scans) else {
            at += 1;
            continue;
        };
        let is_explained = |effect: &Effect| {
            effect_mm(*effect, &result, session, scans).is_some_and(|e| e < size_mm)
        };
        let effects: Vec<Effect> =
            warnings.iter().filter_map(effect).filter(is_explained).collect();
        if !effects.is_empty() {
            let stays = |w: &Warning| effect(w).is_none_or(|e| !effects.contains(&e));
            let before = warnings[..at].iter().filter(|w| stays(w)).count();
            warnings.retain(stays);
            at = before;
            warnings[at] = CombinedFinding { cause: Box::new(cause), effects }.into();
        }
        at += 1;
    }
    Calibration { warnings, ..result }.recorded()
}

/// How far an effect moves what the camera sees of the board, mm.
fn effect_mm(
    effect: Effect,
    result: &Calibration,
    session: &Session,
    scans: &ScanResult,
) -> Option<f64> {
    let seen = result.captures.iter().filter_map(|c| c.camera_from_target);
    let distance = median(seen.map(|pose| pose.translation().z)) * 1e3;
    let target = session.target.as_ref()?;
    let norm = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    match effect {
        Effect::Intrinsics => {
            let now = result.camera.as_ref()?.intrinsics;
            Some(intrinsics_moved(&session.camera?, &now) * distance)
        }
        Effect::Depth => {
            let depth = result.depth.as_ref()?;
            Some(((depth.scale - 1.0) * distance + depth.bias_mm).abs())
        }
        Effect::Scale => Some(scans.frames.as_ref()?.scale.abs() * distance),
        Effect::Tilt => {
            let tilt = norm(&scans.frames.as_ref()?.tilt_deg).to_radians();
            Some(tilt * flatness::extent(target) * 1e3)
        }
        Effect::Shift => Some(norm(&scans.frames.as_ref()?.shift_mm)),
    }
}

/// By how much directions, and the distances that follow from them, differ between two sets of intrinsics.
fn intrinsics_moved(given: &Intrinsics, now: &Intrinsics) -> f64 {
    let focal = (now.fx / given.fx - 1.0).abs().max((now.fy / given.fy - 1.0).abs());
    let centre = ((now.cx - given.cx) / given.fx).hypot((now.cy - given.cy) / given.fy);
    focal.max(centre)
}
