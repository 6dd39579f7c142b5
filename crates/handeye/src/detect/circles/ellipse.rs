//! Where exactly the image of a circle is, and how sure that is.
//!
//! The image of a disc is bounded by an ellipse `|A (p - c)| = 1`, `A` symmetric. With `d(p)` the
//! distance of a pixel from it, positive inside, a lens that blurs with a Gaussian of width `s`
//! (the pixel's own square included) and light that changes linearly with `g`, the image is
//!
//! ```text
//! I(p) = (a + b erf((d(p) - κ s²/2) / (√2 s))) (1 + g·p),    d(p) = (1 - ρ) / |∇ρ|,  ρ = |A (p - c)|
//! ```
//!
//! `κ` is the ellipse's curvature: blurring moves a curved edge towards its centre, by half the
//! curvature times the blur's variance (the mean of `κ t²/2` over the tangent). The ten parameters
//! `c, A, a, b, ln s, g` are fitted to the pixels of a ring around the ellipse by
//! Levenberg-Marquardt; the inverse normal matrix, scaled by the mean squared residual, is their
//! covariance.
//!
//! `c` is the centre of the ellipse, not the image of the circle's centre: see `view`.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Matrix2, SVector, Vector2};

use crate::{
    GrayImage,
    detect::{
        erf::erf,
        levenberg::{Bounded, Descent, Linearised, descend},
        saturated::share_within,
    },
};

/// An ellipse known to about a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rough {
    pub centre: Vector2<f64>,
    /// `S` of `dᵀ S⁻¹ d = 1`.
    pub shape: Matrix2<f64>,
    pub dark: bool,
    /// The next circle's edge is this many times farther from the centre than this one's.
    pub clear: f64,
}

/// An ellipse after the fit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ellipse {
    pub centre: Vector2<f64>,
    /// Of the centre, px².
    pub covariance: Matrix2<f64>,
    /// `S` of `dᵀ S⁻¹ d = 1`.
    pub shape: Matrix2<f64>,
}

/// Half the width of the ring in the first fit, px.
const FIRST_RING_PX: f64 = 4.0;
/// In the second: this many blurs and this many px.
const RING_BLURS: f64 = 3.2;
const RING_PX: f64 = 0.7;
/// The ring reaches this share of the way to the next circle's edge.
const REACH: f64 = 0.65;
/// Of more pixels than this only every n-th is taken, in the first fit and in the second: they tell
/// the centre to a thousandth of a pixel.
const MOST_PIXELS: (usize, usize) = (300, 1200);
/// Fewer do not determine ten parameters.
const FEWEST_PIXELS: usize = 24;
/// A fit has converged when the centre moves less than this, px.
const STEP_PX: (f64, f64) = (0.05, 2e-3);
/// Blur before it is measured, px.
const USUAL_BLUR_PX: f64 = 0.8;
/// Blurs stay in this range, px: a pixel's own square blurs by 0.29.
const BLUR_PX: (f64, f64) = (0.29, 8.0);
/// Residuals above this share of the contrast are not an ellipse's.
const WORST_RESIDUAL: f64 = 0.06;
/// Inside minus outside, grey values, below which there is no circle.
const LEAST_CONTRAST: f64 = 8.0;
/// A lens sharper than the pixels shows edges that are not quite the model's: they move by this many
/// px times what a Gaussian blur leaves of the pixels' frequency.
const ALIAS_PX: f64 = 0.12;
/// A fit that moves the centre by more than this share of the half axis, or changes the size by
/// more, has found something else.
const FARTHEST: f64 = 0.35;
/// An ellipse with a larger variance (px², both axes) was not measured.
const UNKNOWN_PX2: f64 = 1.0;

type Parameters = SVector<f64, 10>;

/// Fits the ellipse; `None` where there is none.
pub(super) fn fit(image: &GrayImage, rough: &Rough) -> Option<Ellipse> {
    let first = Ring::gather(image, rough, FIRST_RING_PX, MOST_PIXELS.0)?;
    let near = first.descend(first.start(rough)?, STEP_PX.0)?.at;
    let found =
        Rough { centre: first.centre + near.fixed_rows::<2>(0), shape: shape(&near)?, ..*rough };
    similar(rough, &found)?;
    let width = (RING_BLURS * near[7].exp() + RING_PX).max(2.0);
    let ring = Ring::gather(image, &found, width, MOST_PIXELS.1)?;
    let mut start = near;
    start.fixed_rows_mut::<2>(0).fill(0.0);
    let Descent { at, there, .. } = ring.descend(start, STEP_PX.1)?;
    let ellipse = ring.judge(&at, &there, rough.dark)?;
    similar(rough, &Rough { centre: ellipse.centre, shape: ellipse.shape, ..*rough })?;
    Some(ellipse)
}

/// Whether a fit is still at the ellipse it began with.
fn similar(rough: &Rough, found: &Rough) -> Option<()> {
    let (before, after) = (rough.shape.determinant(), found.shape.determinant());
    let moved = (found.centre - rough.centre).norm() / before.powf(0.25);
    // half axes to the fourth power
    let near = moved < FARTHEST + 0.5 / before.powf(0.25);
    let same = (after / before).ln().abs() < 4.0 * (FARTHEST + 1.0 / before.powf(0.25));
    (near && same).then_some(())
}

/// `S = A⁻²`.
fn shape(at: &Parameters) -> Option<Matrix2<f64>> {
    let a = Matrix2::new(at[2], at[3], at[3], at[4]);
    let inverse = a.try_inverse()?;
    let shape = inverse * inverse;
    (a.determinant() > 0.0 && a.trace() > 0.0).then_some(shape)
}

/// `A = S^(-1/2)`.
fn matrix(shape: &Matrix2<f64>) -> Option<Matrix2<f64>> {
    let eigen = shape.symmetric_eigen();
    let sound = eigen.eigenvalues.iter().all(|l| l.is_finite() && *l > 0.0);
    let roots = Matrix2::from_diagonal(&eigen.eigenvalues.map(|l| 1.0 / l.sqrt()));
    sound.then(|| eigen.eigenvectors * roots * eigen.eigenvectors.transpose())
}

/// The pixels around an ellipse, relative to `centre`, with their grey values.
struct Ring {
    centre: Vector2<f64>,
    pixels: Vec<(f64, f64, f64)>,
}

impl Ring {
    fn gather(image: &GrayImage, rough: &Rough, width: f64, most: usize) -> Option<Self> {
        let (a, centre) = (matrix(&rough.shape)?, rough.centre);
        let farthest = 1.0 + REACH * (rough.clear - 1.0).max(0.0);
        // the box around the ellipse, widened by the ring
        let half = Vector2::new(rough.shape[(0, 0)].sqrt(), rough.shape[(1, 1)].sqrt());
        let (right, bottom) = (image.width() as f64 - 1.0, image.height() as f64 - 1.0);
        let edge = Vector2::new(right, bottom);
        // the ellipse must be in the image, the ring around it is cut off where that ends
        let inside = (centre - half).min() >= 0.0 && (edge - centre - half).min() >= 0.0;
        if !inside {
            return None;
        }
        let low = (centre - half.add_scalar(width)).sup(&Vector2::zeros());
        let high = (centre + half.add_scalar(width)).inf(&edge);
        let axes = rough.shape.symmetric_eigenvalues().map(f64::sqrt);
        let expected = std::f64::consts::PI * (axes.sum()) * 2.0 * width;
        let every = expected as usize / most + 1;
        let mut pixels = Vec::with_capacity(expected as usize / every + 16);
        for y in low.y.ceil() as usize..=high.y.floor() as usize {
            for x in low.x.ceil() as usize..=high.x.floor() as usize {
                if !(x + 3 * y).is_multiple_of(every) {
                    continue;
                }
                let p = Vector2::new(x as f64, y as f64) - centre;
                let q = a * p;
                let rho = q.norm().max(1e-9);
                let distance = (1.0 - rho) * rho / (a * q).norm().max(1e-12);
                if distance.abs() <= width && rho <= farthest {
                    pixels.push((p.x, p.y, f64::from(image.at(x, y))));
                }
            }
        }
        (pixels.len() >= FEWEST_PIXELS).then_some(Self { centre, pixels })
    }

    /// From the rough ellipse and the mean greys inside and outside.
    fn start(&self, rough: &Rough) -> Option<Parameters> {
        let a = matrix(&rough.shape)?;
        let mean = |inside: bool| {
            let side = || {
                self.pixels.iter().filter(|p| ((a * Vector2::new(p.0, p.1)).norm() < 1.0) == inside)
            };
            let count = side().count();
            (count > 0).then(|| side().map(|p| p.2).sum::<f64>() / count as f64)
        };
        let (inside, outside) = (mean(true)?, mean(false)?);
        let (middle, half) = (0.5 * (inside + outside), 0.6 * (inside - outside));
        Some(Parameters::from_column_slice(&[
            0.0,
            0.0,
            a[(0, 0)],
            a[(0, 1)],
            a[(1, 1)],
            middle,
            half,
            USUAL_BLUR_PX.ln(),
            0.0,
            0.0,
        ]))
    }

    /// Until the centre moves less than `step_px`.
    fn descend(&self, start: Parameters, step_px: f64) -> Option<Descent<10>> {
        let short = |step: &Parameters| step[0].hypot(step[1]) < step_px;
        descend(start, |at| self.linearise(at), &Bounded::blur(7, BLUR_PX), short)
            .filter(|found| found.settled)
    }

    fn linearise(&self, at: &Parameters) -> Option<Linearised<10>> {
        let model = Model::new(at)?;
        let (mut sums, mut count) = ([[0.0; 11]; 11], 0.0);
        for &(x, y, grey) in &self.pixels {
            let (value, j) = model.at(x, y);
            let weight = f64::from(share_within(grey as f32, value as f32).powi(2));
            let row: [f64; 11] = std::array::from_fn(|k| j.get(k).copied().unwrap_or(grey - value));
            count += weight;
            for m in 0..11 {
                for n in m..11 {
                    sums[m][n] += weight * row[m] * row[n];
                }
            }
        }
        let there = Linearised::of(|m, n| sums[m][n], count);
        there.cost.is_finite().then_some(there)
    }

    fn judge(&self, at: &Parameters, there: &Linearised<10>, dark: bool) -> Option<Ellipse> {
        let variance = there.variance()?;
        let contrast = 2.0 * at[6].abs();
        let noise_free = (variance.sqrt() / contrast).min(1.0);
        let sound = contrast > LEAST_CONTRAST
            && (at[6] < 0.0) == dark
            && noise_free < WORST_RESIDUAL.max(WORST_NOISE / contrast)
            && at[7].exp() < 0.99 * BLUR_PX.1;
        let inverse = there.covariance(variance)?;
        let alias = ALIAS_PX * (-2.0 * (std::f64::consts::PI * at[7].exp()).powi(2)).exp();
        let floor = Matrix2::identity() * (alias * alias);
        let covariance: Matrix2<f64> = inverse.fixed_view::<2, 2>(0, 0) + floor;
        let known = covariance.determinant() > 0.0 && covariance.trace() < UNKNOWN_PX2;
        let ellipse =
            Ellipse { centre: self.centre + at.fixed_rows::<2>(0), covariance, shape: shape(at)? };
        (sound && known).then_some(ellipse)
    }
}

/// Noise of a poor camera, grey values: residuals up to this do not speak against an ellipse.
const WORST_NOISE: f64 = 12.0;

/// The model at one set of parameters: `cx cy a11 a12 a22 a b ln(s) gx gy`.
struct Model {
    p: [f64; 10],
    /// `det A²`
    determinant: f64,
    /// `1/(√2 s)`
    scale: f64,
    /// `s²`
    variance: f64,
}

impl Model {
    fn new(at: &Parameters) -> Option<Self> {
        let p: [f64; 10] = at.as_slice().try_into().ok()?;
        let determinant = p[2] * p[4] - p[3] * p[3];
        let s = p[7].exp();
        (determinant > 0.0 && p[2] > 0.0 && s.is_finite()).then_some(Self {
            p,
            determinant: determinant * determinant,
            scale: FRAC_1_SQRT_2 / s,
            variance: s * s,
        })
    }

    /// Grey value and its derivatives at a pixel. The derivatives are those at the ellipse's
    /// nearest point, where the model changes.
    #[inline]
    fn at(&self, x: f64, y: f64) -> (f64, [f64; 10]) {
        let [cx, cy, a11, a12, a22, a, b, _, gx, gy] = self.p;
        let (dx, dy) = (x - cx, y - cy);
        let (qx, qy) = (a11 * dx + a12 * dy, a12 * dx + a22 * dy);
        let rho = (qx * qx + qy * qy).sqrt().max(1e-9);
        let (nx, ny) = (qx / rho, qy / rho);
        let (mx, my) = (a11 * nx + a12 * ny, a12 * nx + a22 * ny);
        let slope = (mx * mx + my * my).sqrt();
        // κ = det(A²) / |A² p|³ at the point of the ellipse on the same ray, where A² p = ∇ρ
        let curvature = self.determinant / (slope * slope * slope);
        let shift = 0.5 * curvature * self.variance;
        let d = (1.0 - rho) / slope - shift;
        let (e, de) = erf((d * self.scale) as f32);
        let (e, de) = (f64::from(e), f64::from(de));
        let light = 1.0 + gx * x + gy * y;
        let dark = a + b * e;
        let f = light * b * de * self.scale; // ∂I/∂d
        let (ex, ey) = (dx / rho, dy / rho);
        let g = -f / slope;
        let jacobian = [
            -g * mx,
            -g * my,
            g * nx * ex,
            g * (nx * ey + ny * ex),
            g * ny * ey,
            light,
            light * e,
            -f * (d + 2.0 * shift),
            dark * x,
            dark * y,
        ];
        (light * dark, jacobian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jacobian_matches_central_differences_at_the_ellipse() {
        let at = Parameters::from_column_slice(&[
            0.3, -0.2, 0.12, 0.02, 0.17, 110.0, -60.0, -0.1, 0.002, -0.004,
        ]);
        let model = |at: &Parameters, on: &Vector2<f64>| Model::new(at).unwrap().at(on.x, on.y);
        let a = Matrix2::new(at[2], at[3], at[3], at[4]).try_inverse().unwrap();
        let points: Vec<Vector2<f64>> = (0..12)
            .map(|k| f64::from(k) * 0.5)
            .map(|t| Vector2::new(0.3, -0.2) + a * Vector2::new(t.cos(), t.sin()))
            .collect();
        for k in 0..10 {
            let mut step = Parameters::zeros();
            step[k] = 1e-3;
            let numeric =
                |on: &Vector2<f64>| (model(&(at + step), on).0 - model(&(at - step), on).0) / 2e-3;
            // how the curvature changes along the ellipse is left out of the derivatives
            let largest = points.iter().map(|on| numeric(on).abs()).fold(0.0, f64::max);
            for on in &points {
                let off = (model(&at, on).1[k] - numeric(on)).abs();
                assert!(off < 0.05 * largest, "{k}: {off} of {largest}");
            }
        }
    }
}
