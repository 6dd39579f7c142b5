//! A plane through the points around a corner, and the corner on it.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

use super::Reason;
use crate::{
    Point, SurfaceCorner,
    math::{
        linalg::median,
        random::Random,
        statistics::MAD,
        subsets::{self, Draw},
    },
};

/// Planes tried by least median of squares: with half the points good, one of eight is.
const TRIES: usize = 40;
/// At most this many samples judge a try.
const JUDGES: usize = 150;
/// Tukey's bound, standard deviations.
pub(crate) const TUKEY: f64 = 4.685;
/// Mean of Tukey's weight of unit normal deviates.
const TUKEY_MEAN: f64 = 0.9151;
/// `Σ w r² / Σ w` of unit normal deviates: the weights make the scatter look smaller.
const TUKEY_SHRINK: f64 = 0.8281;
/// Variance of the fit over `scatter² (AᵀWA)⁻¹`, for unit normal deviates: `E[w² r²] E[w] / E[ψ']²`.
pub(crate) const TUKEY_COST: f64 = 0.9633;
/// Rounds of re-weighting.
const ROUNDS: usize = 6;
/// The scatter is never taken below this share of the depth: single precision.
const LEAST_SCATTER: f64 = 1e-7;
/// Correlation of neighbouring residuals is believed up to this.
const MOST_CORRELATED: f64 = 0.85;
/// Added to the covariance, m²: (1 µm)², so that it can be inverted.
const FLOOR: f64 = 1e-12;
/// Less than this share of the points in one plane is an edge.
const ONE_PLANE: f64 = 0.6;
/// The points' centroid may be this far from the corner, in radii.
const ONE_SIDED: f64 = 0.4;

/// `1/Z = α + β u + γ v`.
pub(super) struct Plane {
    coefficients: Vector3<f64>,
    pub weights: Vec<f64>,
    /// Standard deviation of `1/Z` about the plane.
    scatter: f64,
    /// `(AᵀWA)⁻¹`
    cofactor: Matrix3<f64>,
}

fn row(at: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(1.0, at.x, at.y)
}

impl Plane {
    pub fn fit(samples: &[Sample], seed: u64) -> Result<Self, Reason> {
        let (start, median) = least_median(samples, seed).ok_or(Reason::OneSided)?;
        let least = LEAST_SCATTER * start[0].abs();
        let mut scatter = (median / MAD).max(least);
        let mut plane =
            Self { coefficients: start, weights: vec![], scatter, cofactor: Matrix3::zeros() };
        for _ in 0..ROUNDS {
            let residuals = plane.residuals(samples);
            plane.weights = residuals.iter().map(|r| tukey(r / scatter)).collect();
            let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
            for (s, w) in samples.iter().zip(&plane.weights) {
                let a = row(&s.at);
                normal += a * a.transpose() * *w;
                right += a * (w / s.point.z);
            }
            let factor = normal.cholesky().ok_or(Reason::OneSided)?;
            plane.coefficients = factor.solve(&right);
            plane.cofactor = factor.inverse();
            scatter = plane.weighted_scatter(samples).max(least);
            plane.scatter = scatter;
        }
        Ok(plane)
    }

    fn residuals(&self, samples: &[Sample]) -> Vec<f64> {
        samples.iter().map(|s| 1.0 / s.point.z - row(&s.at).dot(&self.coefficients)).collect()
    }

    /// From the points that carry weight.
    fn weighted_scatter(&self, samples: &[Sample]) -> f64 {
        let squares = self.residuals(samples).into_iter().zip(&self.weights);
        let (sum, count) =
            squares.fold((0.0, 0.0), |(sum, count), (r, w)| (sum + w * r * r, count + w));
        (sum / (count - 3.0 * TUKEY_MEAN).max(1.0) / TUKEY_SHRINK).sqrt()
    }

    pub fn check(&self, samples: &[Sample], radius: f64) -> Result<(), Reason> {
        let share = self.weights.iter().filter(|w| **w > 0.0).count() as f64 / samples.len() as f64;
        if share < ONE_PLANE {
            return Err(Reason::Edge(share));
        }
        let total: f64 = self.weights.iter().sum();
        let weighted = samples.iter().zip(&self.weights).map(|(s, w)| s.at * *w);
        let centroid = weighted.sum::<Vector2<f64>>() / total;
        if centroid.norm() > ONE_SIDED * radius || self.coefficients[0] <= 0.0 {
            return Err(Reason::OneSided);
        }
        Ok(())
    }

    /// Depth (m) at the corner.
    pub fn depth(&self) -> f64 {
        1.0 / self.coefficients[0]
    }

    /// Variance of that depth, m²; `inflation` as in [`super::samples::Window::inflation`].
    pub(crate) fn depth_variance(&self, inflation: f64) -> f64 {
        self.depth().powi(4) * self.variance(inflation)
    }

    /// Variance of `α`.
    fn variance(&self, inflation: f64) -> f64 {
        self.scatter * self.scatter * self.cofactor[(0, 0)] * TUKEY_COST * inflation
    }

    /// How the depth at the corner moves with what is taken off the depth of some of the points.
    pub(crate) fn depth_by(&self, samples: &[Sample], chosen: &[bool]) -> f64 {
        let moved = samples.iter().zip(&self.weights).zip(chosen).filter(|(_, chosen)| **chosen);
        let sum: Vector3<f64> =
            moved.map(|((s, w), _)| row(&s.at) * (w * s.point.z.powi(-2))).sum();
        -self.depth().powi(2) * (self.cofactor * sum)[0]
    }

    pub fn corner(
        &self,
        id: u32,
        rays: &Rays,
        pixel: &Matrix2<f64>,
        inflation: f64,
    ) -> SurfaceCorner {
        let [alpha, beta, gamma] =
            [self.coefficients[0], self.coefficients[1], self.coefficients[2]];
        let z = 1.0 / alpha;
        let ray = Vector3::new(rays.x[0], rays.y[0], 1.0);
        // ∂(r/ρ)/∂u = r_u/ρ - r ρ_u/ρ²
        let along =
            |rx: f64, ry: f64, slope: f64| Vector3::new(rx, ry, 0.0) * z - ray * (slope * z * z);
        let by_pixel = Matrix3x2::from_columns(&[
            along(rays.x[1], rays.y[1], beta),
            along(rays.x[2], rays.y[2], gamma),
        ]);
        let of_alpha = self.variance(inflation);
        let covariance = by_pixel * pixel * by_pixel.transpose()
            + ray * ray.transpose() * (z.powi(4) * of_alpha)
            + Matrix3::identity() * FLOOR;
        SurfaceCorner { id, in_camera: Point::from_vector(ray * z), covariance }
    }

    /// Residuals of the points that carry weight, with their places in the grid.
    pub(crate) fn placed_residuals(&self, samples: &[Sample]) -> Vec<((i64, i64), f64)> {
        let all = self.residuals(samples).into_iter().zip(samples).zip(&self.weights);
        all.filter(|(_, w)| **w > 0.0).map(|((r, s), _)| (s.cell, r)).collect()
    }
}

/// By how much fewer independent points of a grid there are than points; `unknowns` were fitted.
pub(crate) fn inflation(residuals: &[((i64, i64), f64)], unknowns: f64) -> f64 {
    let places: BTreeMap<(i64, i64), f64> = residuals.iter().copied().collect();
    let along = |step| {
        let r = correlation(&places, unknowns, step).clamp(0.0, MOST_CORRELATED);
        (1.0 + r) / (1.0 - r)
    };
    along((1, 0)) * along((0, 1))
}

/// Correlation of the residuals of neighbours.
fn correlation(places: &BTreeMap<(i64, i64), f64>, unknowns: f64, step: (i64, i64)) -> f64 {
    let (mut product, mut square, mut pairs, mut count) = (0.0, 0.0, 0.0, 0.0);
    for (&(x, y), residual) in places {
        square += residual * residual;
        count += 1.0;
        if let Some(next) = places.get(&(x + step.0, y + step.1)) {
            product += residual * next;
            pairs += 1.0;
        }
    }
    if pairs < 1.0 || square <= 0.0 {
        return 0.0;
    }
    let correlation = (product / pairs) / (square / count);
    // taking the fit off makes neighbours look opposed; and below twice its own error it is zero
    let bias = unknowns / count;
    if correlation + bias > 2.0 / f64::sqrt(pairs) { correlation + bias } else { 0.0 }
}

/// Tukey's biweight.
pub(crate) fn tukey(r: f64) -> f64 {
    let q = r / TUKEY;
    if q.abs() < 1.0 { (1.0 - q * q).powi(2) } else { 0.0 }
}

/// The plane through three samples whose median absolute residual is least, and that residual.
fn least_median(samples: &[Sample], seed: u64) -> Option<(Vector3<f64>, f64)> {
    let samples: Vec<&Sample> = samples.iter().step_by(samples.len().div_ceil(JUDGES)).collect();
    let mut best: Option<(Vector3<f64>, f64)> = None;
    for three in subsets::drawn(samples.len(), TRIES, Draw::Repeating(Random::new(seed))) {
        let three: [&Sample; 3] = three.map(|k| samples[k]);
        let a = Matrix3::from_rows(&three.map(|s| row(&s.at).transpose()));
        let b = Vector3::from_iterator(three.iter().map(|s| 1.0 / s.point.z));
        if a.determinant().abs() < 1.0 {
            continue; // (nearly) on a line
        }
        let plane = a.try_inverse()? * b;
        let off = |s: &&Sample| (1.0 / s.point.z - row(&s.at).dot(&plane)).abs();
        let median = median(samples.iter().map(off));
        if best.as_ref().is_none_or(|(_, least)| median < *least) {
            best = Some((plane, median));
        }
    }
    best
}

/// `X/Z` and `Y/Z`, linear in the pixel.
pub(super) struct Rays {
    x: Vector3<f64>,
    y: Vector3<f64>,
}

impl Rays {
    pub fn fit(samples: &[Sample], plane: &Plane) -> Result<Self, Reason> {
        let (mut x, mut y) = (Vector3::zeros(), Vector3::zeros());
        for (s, w) in samples.iter().zip(&plane.weights) {
            x += row(&s.at) * (w * s.point.x / s.point.z);
            y += row(&s.at) * (w * s.point.y / s.point.z);
        }
        Ok(Self { x: plane.cofactor * x, y: plane.cofactor * y })
    }
}

/// A measured point and its pixel, counted from the corner (scan px).
#[derive(Clone, Copy)]
pub(crate) struct Sample {
    pub at: Vector2<f64>,
    pub point: Vector3<f64>,
    /// Its place in the grid, for the correlation of neighbours.
    pub cell: (i64, i64),
}
