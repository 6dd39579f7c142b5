//! How far off a point will be: the target registration error (TRE).
//!
//! A point `p` of the camera frame lands at `X p`. An error `δ` of `X`, perturbed on the right,
//! moves it by `R_X J δ` with `J = [-[p]ₓ, I]`, so its covariance is `J S Jᵀ` and its mean square
//! `tr(J S Jᵀ)`. Over a volume: the mean of that, and the 95 % point of the error's length.
//!
//! J. Fitzpatrick, J. West, C. Maurer, IEEE T-MI 17(5), 1998; M. Danilchenko and J. Fitzpatrick,
//! *General approach to first-order error prediction in rigid point registration*, IEEE T-MI 30(3),
//! 2011.

use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3};
use serde::{Deserialize, Serialize};

use crate::{Camera, Mount, Pose, math::statistics, register::rigid_fit::point_jacobian};

/// Predicted error over a volume, in millimetres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PredictedTre {
    /// Root mean square over the volume.
    pub rms: f64,
    /// 95 of 100 points are off by less.
    pub p95: f64,
    /// The same as `p95` for a robot that goes to a point once: with what it errs from pose to pose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_task_p95: Option<f64>,
    /// Which volume, in words.
    pub r#where: String,
    /// The error in three slices through the volume.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<TreMap>,
}

impl PredictedTre {
    /// With an error (RMS, mm) that is independent of it, whose 95 % point is so many times as large.
    pub(crate) fn widened(self, rms_mm: f64, p95_over_rms: f64) -> Self {
        let wide = |p95: f64| p95.hypot(p95_over_rms * rms_mm);
        let at_task_p95 = self.at_task_p95.map(wide);
        Self { rms: self.rms.hypot(rms_mm), p95: wide(self.p95), at_task_p95, ..self }
    }

    /// As the reason of an accepted answer.
    pub(crate) fn in_words(&self) -> String {
        let Self { p95, r#where: volume, rms, .. } = self;
        let more = self.at_task_p95.filter(|mm| *mm > 1.01 * p95);
        let at_task = more.map_or(String::new(), |mm| {
            format!("; {mm:.2} mm (95 %) for a single robot move to a point, robot error included")
        });
        format!(
            "predicted position error: {p95:.2} mm for 95 % of the points in {volume}; {rms:.2} mm RMS{at_task}"
        )
    }
}

/// Predicted error (95 %) in three orthogonal slices through the middle of a volume.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TreMap {
    /// The frame of the box: `camera`, `base` or `flange`.
    pub frame: String,
    /// Lower corner of the box, mm.
    pub minimum_mm: [f64; 3],
    /// Upper corner of the box, mm.
    pub maximum_mm: [f64; 3],
    /// The slices.
    pub slices: Vec<TreSlice>,
}

/// One slice of a [`TreMap`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TreSlice {
    /// Axes (0, 1, 2 for x, y, z) along columns and rows.
    pub axes: [usize; 2],
    /// Rows of cells, from lower to higher; each the error (95 %) at its middle, mm; `None` where
    /// the camera does not see.
    pub p95_mm: Vec<Vec<Option<f64>>>,
}

/// Points spread over the volume in which the answer will be used, in the camera frame (m).
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// Sample points.
    pub points: Vec<Vector3<f64>>,
    /// Which volume, in words.
    pub name: String,
    /// The frame in which it is a box: `camera`, `base` or `flange`.
    pub frame: &'static str,
    /// Lower and upper corner in that frame, m.
    pub corners: (Vector3<f64>, Vector3<f64>),
    /// From that frame to the camera.
    pub camera_from_box: Isometry3<f64>,
}

/// Sample points along each edge of the box.
const SAMPLES: usize = 5;

impl Volume {
    /// A grid over the box around some points.
    pub fn around(points: impl Iterator<Item = Vector3<f64>>, name: &str) -> Option<Self> {
        let (low, high) = points.fold(
            (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)),
            |(low, high), p| (low.inf(&p), high.sup(&p)),
        );
        low.iter().chain(&high).all(|x| x.is_finite()).then(|| Self::of_box(&low, &high, name))
    }

    /// A grid over a box.
    pub fn of_box(low: &Vector3<f64>, high: &Vector3<f64>, name: &str) -> Self {
        let at = |k: usize, n: usize| low[k] + (high[k] - low[k]) * n as f64 / (SAMPLES - 1) as f64;
        let n = 0..SAMPLES;
        let points = n
            .clone()
            .flat_map(|i| n.clone().map(move |j| (i, j)))
            .flat_map(|(i, j)| (0..SAMPLES).map(move |k| (i, j, k)))
            .map(|(i, j, k)| Vector3::new(at(0, i), at(1, j), at(2, k)))
            .collect();
        Self {
            points,
            name: name.into(),
            frame: "camera",
            corners: (*low, *high),
            camera_from_box: Isometry3::identity(),
        }
    }

    /// The same box, in another frame than the camera's.
    pub fn seen_from(mut self, camera_from_box: &Isometry3<f64>, frame: &'static str) -> Self {
        for p in &mut self.points {
            *p = camera_from_box.transform_vector(p) + camera_from_box.translation.vector;
        }
        (self.camera_from_box, self.frame) = (*camera_from_box, frame);
        self
    }
}

/// Covariance (m²) of where `p` lands, up to the rotation of `X`.
pub fn point_covariance(p: &Vector3<f64>, covariance: &Matrix6<f64>) -> Matrix3<f64> {
    let j = point_jacobian(p);
    j * covariance * j.transpose()
}

/// Predicted error of an answer with this covariance; `offset` adds what a second answer, known to
/// be better, says of the first (m, at each point).
pub fn tre(
    volume: &Volume,
    covariance: &Matrix6<f64>,
    offset: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> PredictedTre {
    let spread: Vec<Matrix3<f64>> =
        volume.points.iter().map(|p| point_covariance(p, covariance)).collect();
    tre_of_points(volume, &spread, offset)
}

/// As [`tre`], where the covariance of each point (m²) is known.
pub(crate) fn tre_of_points(
    volume: &Volume,
    spread: &[Matrix3<f64>],
    offset: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> PredictedTre {
    let moment = |(p, s): (&Vector3<f64>, &Matrix3<f64>)| moments(s, &offset(p));
    let moments: Vec<(f64, f64)> = volume.points.iter().zip(spread).map(moment).collect();
    let mean = moments.iter().map(|m| m.0).sum::<f64>() / moments.len().max(1) as f64;
    let rms = mean.sqrt();
    PredictedTre {
        rms: rms * 1e3,
        // where a few far points carry most of the mean square, the rest is no bound for them
        p95: quantile95(&moments).max(rms) * 1e3,
        at_task_p95: None,
        r#where: volume.name.clone(),
        map: None,
    }
}

/// Mean and variance of the squared length of `N(b, s)`.
fn moments(s: &Matrix3<f64>, b: &Vector3<f64>) -> (f64, f64) {
    (s.trace() + b.norm_squared(), 2.0 * (s * s).trace() + 4.0 * b.dot(&(s * b)))
}

/// Cells along each edge of a slice.
const CELLS: usize = 16;

/// The error in slices through the middle of a volume; `spread` and `offset` as in `tre_of_points`,
/// `None` where the camera does not see.
pub fn map(
    volume: &Volume,
    spread: impl Fn(&Vector3<f64>) -> Option<Matrix3<f64>>,
    offset: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> TreMap {
    let (low, high) = volume.corners;
    let middle = 0.5 * (low + high);
    let along = |axis: usize, k: usize| {
        low[axis] + (high[axis] - low[axis]) * (k as f64 + 0.5) / CELLS as f64
    };
    let at = |p: &Vector3<f64>| {
        let c = &volume.camera_from_box;
        let p = c.transform_vector(p) + c.translation.vector;
        Some(quantile95(&[moments(&spread(&p)?, &offset(&p))]) * 1e3)
    };
    let slice = |axes: [usize; 2]| {
        let cell = |row: usize, column: usize| {
            let mut p = middle;
            (p[axes[0]], p[axes[1]]) = (along(axes[0], column), along(axes[1], row));
            at(&p)
        };
        let row = |row: usize| (0..CELLS).map(|column| cell(row, column)).collect();
        TreSlice { axes, p95_mm: (0..CELLS).map(row).collect() }
    };
    TreMap {
        frame: volume.frame.into(),
        minimum_mm: (low * 1e3).into(),
        maximum_mm: (high * 1e3).into(),
        slices: [[0, 1], [0, 2], [1, 2]].map(slice).into(),
    }
}

/// Steps in which the 95 % point is found, at most; three or four are the rule.
const STEPS: usize = 100;
/// Share of errors within which the 95 % point is found.
const EXACT: f64 = 1e-11;
/// 95 % point of the normal distribution.
const NORMAL_95: f64 = 1.644_853_627;

/// Length below which 95 % of the errors lie: squared lengths are matched to gamma distributions by their two moments,
/// and the mixture over the volume is inverted between the 95 % points of its parts (E. Wilson and M. Hilferty, *The
/// distribution of chi-square*, PNAS 17, 1931), by false position.
fn quantile95(moments: &[(f64, f64)]) -> f64 {
    let beyond = |length: f64| {
        let share = |&(mean, variance): &(f64, f64)| {
            if variance <= 1e-12 * mean * mean {
                return f64::from(mean <= length * length);
            }
            statistics::gamma_at_most(length * length, mean, variance)
        };
        moments.iter().map(share).sum::<f64>() / moments.len().max(1) as f64 - 0.95
    };
    let most = 10.0 * moments.iter().map(|m| m.0).fold(0.0, f64::max).sqrt();
    if !(most > 0.0 && most.is_finite()) {
        return most;
    }
    let about = moments.iter().filter(|m| m.0 > 0.0).map(|(mean, variance)| {
        let ninth = variance / (9.0 * mean * mean);
        (mean * (1.0 - ninth + NORMAL_95 * ninth.sqrt()).powi(3)).sqrt()
    });
    let (least, largest) =
        about.fold((most, 0.0), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
    let (mut low, mut high) = (0.95 * least, (1.05 * largest).min(most));
    let (mut at_low, mut at_high) = (beyond(low), beyond(high));
    if at_low >= 0.0 {
        (low, at_low) = (0.0, -0.95);
    }
    if at_high < 0.0 {
        (high, at_high) = (most, 0.05);
    }
    let mut last = None;
    for step in 0..STEPS {
        // every third step halves: a mixture may have steps
        let line = low - at_low * (high - low) / (at_high - at_low);
        let at = if step % 3 == 2 { 0.5 * (low + high) } else { line };
        let found = beyond(at);
        if found.abs() < EXACT || high - low < 1e-12 * high {
            return at;
        }
        // of an end that stays twice only half counts (the Illinois rule)
        let is_low = found < 0.0;
        let half = if last == Some(is_low) { 0.5 } else { 1.0 };
        if is_low {
            (low, at_low, at_high) = (at, found, half * at_high);
        } else {
            (high, at_high, at_low) = (at, found, half * at_low);
        }
        last = Some(is_low);
    }
    high
}

/// By how much two answers place a point of the camera differently, m, in the axes of `X`.
pub fn difference(
    a: &Pose<Mount, Camera>,
    b: &Pose<Mount, Camera>,
) -> impl Fn(&Vector3<f64>) -> Vector3<f64> {
    let relative = a.iso().inv_mul(b.iso());
    move |p| relative.transform_vector(p) + relative.translation.vector - p
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume() -> Volume {
        Volume::of_box(&Vector3::new(-0.2, -0.1, 0.8), &Vector3::new(0.2, 0.1, 1.0), "box")
    }

    #[test]
    fn a_pure_shift_is_the_same_everywhere() {
        let mut s = Matrix6::zeros();
        for k in 3..6 {
            s[(k, k)] = 1e-6;
        }
        let found = tre(&volume(), &s, |_| Vector3::zeros());
        assert!((found.rms - 3f64.sqrt()).abs() < 1e-9);
        // the 95 % point of a chi distribution with three degrees of freedom
        assert!((found.p95 - 2.7955).abs() < 0.01, "{}", found.p95);
    }

    #[test]
    fn a_rotation_error_grows_with_the_distance() {
        let s = Matrix6::from_diagonal(&nalgebra::Vector6::new(1e-6, 1e-6, 1e-6, 0.0, 0.0, 0.0));
        let near = volume();
        let mut far = near.clone();
        far.points.iter_mut().for_each(|p| *p *= 2.0);
        let (near, far) =
            (tre(&near, &s, |_| Vector3::zeros()), tre(&far, &s, |_| Vector3::zeros()));
        assert!((far.rms / near.rms - 2.0).abs() < 1e-9);
    }

    #[test]
    fn what_a_few_far_points_miss_by_is_not_hidden_by_the_others() {
        let mut volume = volume();
        volume.points[0] *= 100.0;
        let far = volume.points[0];
        let off = |p: &Vector3<f64>| if *p == far { Vector3::x() } else { Vector3::zeros() };
        let found = tre(&volume, &(Matrix6::identity() * 1e-8), off);
        assert!(found.p95 >= found.rms, "{} {}", found.p95, found.rms);
    }

    #[test]
    fn a_known_difference_counts_in_full() {
        let found = tre(&volume(), &Matrix6::zeros(), |_| Vector3::new(0.0, 3e-3, 4e-3));
        assert!((found.rms - 5.0).abs() < 1e-9 && (found.p95 - 5.0).abs() < 1e-6);
    }
}
