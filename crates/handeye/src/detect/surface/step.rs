//! One step between black and white for all captures.
//!
//! Captures `k` tell `s_k ± σ_k`. They vary more than that where the step depends on distance and
//! angle; with `τ²` the variance of the true steps (R. DerSimonian and N. Laird, *Meta-analysis in
//! clinical trials*, Controlled Clinical Trials 7, 1986) the mean and each capture's own step are
//!
//! ```text
//! s = Σ s_k/(σ_k² + τ²) / Σ 1/(σ_k² + τ²)       ŝ_k = (s_k/σ_k² + s/τ²)/(1/σ_k² + 1/τ²)
//! ```

use nalgebra::Matrix3;

use super::{ColouredCorner, Lifted, Missing};
use crate::{Point, SurfaceCorner};

/// Depth of black minus that of white, as one capture shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Along the optical axis, m.
    pub value_m: f64,
    /// Its standard deviation, m.
    pub sigma_m: f64,
    /// Corners that tell it.
    pub corners: usize,
}

/// The same, of all captures.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledStep {
    /// Mean, m.
    pub value_m: f64,
    /// Its standard deviation, m.
    pub sigma_m: f64,
    /// By how much the captures' true steps vary (standard deviation, m).
    pub spread_m: f64,
}

/// A step is believed from this many standard deviations on.
const SIGNIFICANT: f64 = 4.0;

impl PooledStep {
    /// Whether it is more than noise.
    pub fn is_significant(&self) -> bool {
        self.value_m.abs() > SIGNIFICANT * self.sigma_m
    }

    /// What one capture's step is, given all: value and variance (m²).
    fn of_capture(&self, own: &Step) -> (f64, f64) {
        let between = self.spread_m.powi(2);
        if between <= 0.0 {
            return (self.value_m, self.sigma_m.powi(2));
        }
        let (a, b) = (own.sigma_m.powi(-2), between.recip());
        ((own.value_m * a + self.value_m * b) / (a + b), (a + b).recip())
    }
}

/// The mean step and its spread; `None` without captures that tell one.
pub(crate) fn pool(steps: &[Step]) -> Option<PooledStep> {
    let sound = |s: &&Step| s.sigma_m > 0.0 && s.value_m.is_finite() && s.sigma_m.is_finite();
    let steps: Vec<&Step> = steps.iter().filter(sound).collect();
    let mean = |between: f64| {
        let weight = |s: &Step| (s.sigma_m.powi(2) + between).recip();
        let total: f64 = steps.iter().map(|s| weight(s)).sum();
        (steps.iter().map(|s| s.value_m * weight(s)).sum::<f64>() / total, total)
    };
    if steps.is_empty() {
        return None;
    }
    let (value, total) = mean(0.0);
    let q: f64 = steps.iter().map(|s| ((s.value_m - value) / s.sigma_m).powi(2)).sum();
    let squares: f64 = steps.iter().map(|s| s.sigma_m.powi(-4)).sum();
    let room = total - squares / total;
    let between = if room > 0.0 { (q - (steps.len() as f64 - 1.0)).max(0.0) / room } else { 0.0 };
    let (value_m, total) = mean(between);
    Some(PooledStep { value_m, sigma_m: total.sqrt().recip(), spread_m: between.sqrt() })
}

/// A capture's corners on its scan, and those that are not on it.
pub(crate) type OnScan = (Vec<SurfaceCorner>, Vec<Missing>);

/// The corners of every capture with the step of all taken off, where it is significant; otherwise
/// as if all points were measured alike.
pub fn settle(captures: &[Lifted]) -> (Option<PooledStep>, Vec<OnScan>) {
    let steps: Vec<Step> =
        captures.iter().filter_map(|c| Some(c.coloured.as_ref()?.step)).collect();
    let pooled = pool(&steps);
    let believed = pooled.as_ref().filter(|p| p.is_significant());
    let one = |c: &Lifted| match (believed, &c.coloured) {
        (Some(pooled), Some(coloured)) => {
            let (step, variance) = pooled.of_capture(&coloured.step);
            let more = step - coloured.step.value_m;
            let moved = |c: &ColouredCorner| moved(c, more, variance);
            (coloured.corners.iter().map(moved).collect(), coloured.missing.clone())
        }
        _ => (c.found.clone(), c.missing.clone()),
    };
    let settled = captures.iter().map(one).collect();
    (pooled, settled)
}

/// A corner with `more` of the step taken off, which is known to `variance`.
fn moved(c: &ColouredCorner, more: f64, variance: f64) -> SurfaceCorner {
    let p = c.corner.in_camera.vector();
    let ray = p / p.z;
    let unsure: Matrix3<f64> = ray * ray.transpose() * (c.depth_by_step.powi(2) * variance);
    SurfaceCorner {
        in_camera: Point::from_vector(p + ray * (c.depth_by_step * more)),
        covariance: c.corner.covariance + unsure,
        ..c.corner
    }
}
