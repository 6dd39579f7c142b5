//! Captures by their residual: colour, words, legend.

use handeye::calibrate::result::CaptureResult;
use nalgebra::Vector3;

use super::CellData;
use crate::report::{
    colours,
    scene::{Mark, Residuals},
};

/// Median over standard deviation per axis of the length of a vector of normal components.
const MEDIAN_OF_SIGMA: f64 = 1.538;
/// Full colour is for residuals of so many standard deviations at least, so that what may be noise stays pale.
const BEYOND_NOISE: f64 = 6.0;

/// The colours of residuals.
pub struct Scale {
    /// Of the most saturated colour; zero where no capture has a residual.
    top: f64,
    in_mm: bool,
}

impl Scale {
    /// Up to the worst capture that is used, or to what noise alone hardly reaches.
    pub fn of(captures: &[CaptureResult]) -> Self {
        let in_mm = captures.iter().any(|c| c.residual_mm.is_some());
        let scale = Self { top: 0.0, in_mm };
        let used = captures.iter().filter(|c| c.used);
        let mut all: Vec<f64> = used.filter_map(|c| scale.value(c)).collect();
        all.sort_by(f64::total_cmp);
        let Some(median) = all.get(all.len() / 2) else { return scale };
        let noise = BEYOND_NOISE * median / MEDIAN_OF_SIGMA;
        Self { top: all.last().map_or(noise, |worst| worst.max(noise)), ..scale }
    }

    fn value(&self, c: &CaptureResult) -> Option<f64> {
        let px = || c.reprojection_px.or(c.residual_px);
        let value = if self.in_mm { c.residual_mm } else { px() };
        value.filter(|v| v.is_finite())
    }

    fn unit(&self) -> &'static str {
        if self.in_mm { "mm" } else { "px" }
    }

    /// What the page says of it; `None` without residuals.
    pub fn legend(&self) -> Option<Residuals> {
        (self.top > 0.0).then(|| Residuals { top: self.top, unit: self.unit() })
    }

    fn colour(&self, c: &CaptureResult) -> String {
        if !c.used {
            return colours::REJECTED.into();
        }
        let share = if self.top > 0.0 { self.value(c).map_or(0.0, |v| v / self.top) } else { 0.0 };
        colours::residual(share)
    }
}

/// A capture as the view and its card have it.
pub fn mark(c: &CaptureResult, scale: &Scale, at: Vector3<f64>, data: &CellData) -> Mark {
    Mark {
        id: c.id.clone(),
        colour: scale.colour(c),
        is_used: c.used,
        text: text(c),
        at: at.into(),
        links: data.links.get(&c.id).cloned().unwrap_or_default(),
    }
}

fn text(c: &CaptureResult) -> String {
    let mut parts = vec![];
    if let Some(mm) = c.residual_mm {
        parts.push(match c.residual_deg {
            Some(deg) => format!("residual {mm:.3} mm, {deg:.3}\u{b0}"),
            None => format!("residual {mm:.3} mm"),
        });
    }
    if let Some(mm) = c.held_out_mm {
        parts.push(format!("held out {mm:.3} mm"));
    }
    if let Some(px) = c.reprojection_px {
        parts.push(format!("through the robot {px:.2} px"));
    }
    if !c.used {
        parts.insert(0, format!("rejected: {}", c.reason.as_deref().unwrap_or("not used")));
    }
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use handeye::Pose;

    fn capture(mm: f64, used: bool) -> CaptureResult {
        CaptureResult {
            id: format!("{mm}"),
            used,
            reason: (!used).then(|| "blurred".into()),
            base_from_flange: Pose::identity(),
            camera_from_target: None,
            corners: 0,
            corners_3d: 0,
            residual_px: None,
            reprojection_px: None,
            residual_mm: Some(mm),
            residual_deg: None,
            held_out_mm: None,
            held_out_deg: None,
        }
    }

    #[test]
    fn captures_within_noise_stay_pale_and_an_outlier_takes_the_end_of_the_scale() {
        let mut all: Vec<_> = (1..10).map(|k| capture(0.1 * f64::from(k), true)).collect();
        let calm = Scale::of(&all);
        assert!((calm.top - 6.0 / 1.538 * 0.5).abs() < 1e-9, "{}", calm.top);
        all.push(capture(7.0, true));
        all.push(capture(90.0, false));
        let scale = Scale::of(&all);
        assert_eq!(scale.top, 7.0);
        assert_eq!(scale.colour(&all[9]), colours::residual(1.0));
        assert_eq!(scale.colour(&all[10]), colours::REJECTED);
        assert_eq!(text(&all[10]), "rejected: blurred; residual 90.000 mm");
    }

    #[test]
    fn without_residuals_there_is_no_legend() {
        assert!(Scale::of(&[]).legend().is_none());
    }
}
