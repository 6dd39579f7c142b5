//! What scans read wrong at the corners, and what they miss.

use handeye::{
    SurfaceCorner, TargetModel, Warning,
    calibrate::result::{CaptureStep, ColourStepResult},
    detect::surface,
    findings::CameraFinding,
    math::linalg::median,
    mistakes::flatness::{self, ScanCorner},
};

use super::{Seen, Shot};

/// Takes the step between black and white, as all captures show it, off the corners in the scans.
pub(super) fn settle_step(
    shots: &[Shot],
    seen: &mut [Seen],
    warnings: &mut Vec<Warning>,
) -> Option<ColourStepResult> {
    if seen.iter().any(|s| s.ball.is_some()) {
        return None;
    }
    let lifted: Vec<surface::Lifted> =
        seen.iter_mut().map(|s| std::mem::take(&mut s.lifted)).collect();
    let (pooled, settled) = surface::settle(&lifted);
    for (s, (surface, missing)) in seen.iter_mut().zip(settled) {
        (s.surface, s.missing) = (surface, missing);
    }
    let pooled = pooled?;
    let noise = corner_noise(seen);
    if pooled.is_significant() && pooled.value_m.abs() > noise {
        let lost = lost_by_step(seen);
        warnings.push(step_warning(&pooled, noise, lost));
    }
    let captures = shots.iter().zip(&lifted).filter_map(|(shot, l)| {
        let step = l.coloured.as_ref()?.step;
        Some(CaptureStep {
            id: shot.id.to_owned(),
            black_minus_white_mm: step.value_m * 1e3,
            sigma_mm: step.sigma_m * 1e3,
        })
    });
    Some(ColourStepResult {
        black_minus_white_mm: pooled.value_m * 1e3,
        sigma_mm: pooled.sigma_m * 1e3,
        spread_mm: pooled.spread_m * 1e3,
        applied: pooled.is_significant(),
        captures: captures.collect(),
    })
}

/// Typical standard deviation of a corner along the optical axis, m.
fn corner_noise(seen: &[Seen]) -> f64 {
    let depth = |c: &SurfaceCorner| c.covariance[(2, 2)].sqrt();
    median(seen.iter().flat_map(|s| &s.surface).map(depth))
}

/// Takes out corners that the step itself leaves without depth, and counts them: both colours around
/// them lie in no one plane, and too few points are of one colour alone.
fn lost_by_step(seen: &mut [Seen]) -> usize {
    let by_step = |m: &surface::Missing| {
        matches!(m.reason, surface::Reason::Edge(_) | surface::Reason::Mixed)
    };
    seen.iter_mut().map(|s| s.missing.extract_if(.., |m| by_step(m)).count()).sum()
}

fn step_warning(step: &surface::PooledStep, noise: f64, lost: usize) -> Warning {
    CameraFinding::DepthByColour {
        black_minus_white_mm: step.value_m * 1e3,
        sigma_mm: step.sigma_m * 1e3,
        noise_mm: noise * 1e3,
        corners_without_depth: lost,
    }
    .into()
}

pub(super) fn warn_missing(shot: &Shot, seen: &Seen, warnings: &mut Vec<Warning>) {
    let Some(first) = seen.missing.first() else { return };
    let (missing, all) = (seen.missing.len(), seen.corners.len());
    warnings.push(Warning::new(
        "corners-without-depth",
        format!(
            "capture {}: {missing} of {all} corners have no point in the scan (corner {}: {})",
            shot.id, first.id, first.reason
        ),
    ));
}

/// Whether the scans prove that the board is bent.
pub(super) fn is_bent(seen: &[Seen], target: &TargetModel) -> bool {
    let corners = |s: &Seen| -> Vec<ScanCorner> {
        let one = |c: &SurfaceCorner| {
            Some((target.corner(c.id)?.vector().xy(), c.in_camera.vector(), c.covariance))
        };
        s.surface.iter().filter_map(one).collect()
    };
    // a board that is named from its other end is bent alike
    let captures: Vec<Vec<ScanCorner>> = seen.iter().map(corners).collect();
    flatness::flatness(&captures).is_some_and(|f| f.is_bent(target))
}
