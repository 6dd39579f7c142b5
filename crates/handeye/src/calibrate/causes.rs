//! One cause for several warnings. A board that is bent, or a scan that reads black elsewhere than white, also moves the
//! intrinsics, the depth, or images against scans, as far as it is bent or off itself; that is said with the cause, and not
//! once more as if it were a fault of its own.

use crate::{
    Calibration, Intrinsics, Session, Warning,
    calibrate::result::ScanResult,
    findings::{CameraFinding, Finding, FramesFinding, TargetFinding},
    math::linalg::median,
    mistakes::flatness,
};

/// What a cause can look like beside itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Effect {
    Intrinsics,
    Depth,
    Scale,
    Tilt,
    Shift,
}

impl Effect {
    fn of(warning: &Warning) -> Option<Self> {
        match warning.finding.as_deref()? {
            Finding::Camera(CameraFinding::Refined { .. }) => Some(Self::Intrinsics),
            Finding::Camera(CameraFinding::DepthOff { .. }) => Some(Self::Depth),
            Finding::Frames(FramesFinding::Scale { .. }) => Some(Self::Scale),
            Finding::Frames(FramesFinding::Tilt(_)) => Some(Self::Tilt),
            Finding::Frames(FramesFinding::Shift(_)) => Some(Self::Shift),
            _ => None,
        }
    }

    /// In words beside its cause.
    fn in_words(self) -> &'static str {
        match self {
            Self::Intrinsics => "other intrinsics than the given ones",
            Self::Depth => "depth that is off",
            Self::Scale => "scans of another scale than images",
            Self::Tilt => "scans rotated against images",
            Self::Shift => "scans shifted against images",
        }
    }
}

/// How far a cause moves what it explains, mm.
fn cause_mm(warning: &Warning, scans: &ScanResult) -> Option<f64> {
    match warning.finding.as_deref()? {
        Finding::Target(TargetFinding::NotFlat { .. }) => {
            Some(scans.flatness.as_ref()?.peak_to_valley_mm)
        }
        Finding::Camera(CameraFinding::DepthByColour { .. }) => {
            Some(scans.colour_step.as_ref()?.black_minus_white_mm.abs())
        }
        _ => None,
    }
}

/// The result with what a cause explains said with that cause, and only there.
pub(super) fn merged(result: Calibration, session: &Session) -> Calibration {
    let Some(scans) = &result.scans else { return result };
    let mut warnings = result.warnings.clone();
    let mut at = 0;
    while let Some(cause) = warnings.get(at) {
        let Some(size_mm) = cause_mm(cause, scans) else {
            at += 1;
            continue;
        };
        let is_explained = |effect: &Effect| {
            effect_mm(*effect, &result, session, scans).is_some_and(|e| e < size_mm)
        };
        let effects = warnings.iter().filter_map(Effect::of);
        let explained: Vec<Effect> = effects.filter(is_explained).collect();
        if !explained.is_empty() {
            let words: Vec<&str> = explained.iter().map(|effect| effect.in_words()).collect();
            warnings[at].message += &format!(
                "; it also looks like {}, no farther off than this explains, and the answer takes that into \
                 account: correct this first",
                words.join(" and ")
            );
            let stays = |w: &Warning| Effect::of(w).is_none_or(|e| !explained.contains(&e));
            let before = warnings[..at].iter().filter(|w| stays(w)).count();
            warnings.retain(stays);
            at = before;
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
