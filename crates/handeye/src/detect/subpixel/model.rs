//! The image of a crossing, its derivatives, and their products over a disc.

use std::f64::consts::FRAC_1_SQRT_2;

use multiversion::multiversion;
use nalgebra::SVector;

use super::disc::{Disc, LANES, Lane, Pixels};
use crate::{
    detect::{erf::erf, saturated::share_within, subpixel::disc::Light},
    math::gram::{accumulate, pairs},
};

pub(super) type Parameters = SVector<f64, 9>;

/// The model at one set of parameters: `cx cy θ₁ θ₂ a b ln(s) gx gy`.
pub(super) struct Model {
    p: [f32; 9],
    /// 1 where light multiplies, 0 where it adds.
    multiplies: f32,
    n1: (f32, f32),
    n2: (f32, f32),
    /// `1/(√2 s)`
    scale: f32,
}

impl Model {
    pub fn new(at: &Parameters, light: Light) -> Self {
        let p = std::array::from_fn(|k| at[k] as f32);
        let normal = |t: f64| (t.cos() as f32, t.sin() as f32);
        let scale = (FRAC_1_SQRT_2 * (-at[6]).exp()) as f32;
        let multiplies = f32::from(u8::from(light == Light::Multiplies));
        Self { p, multiplies, n1: normal(at[2]), n2: normal(at[3]), scale }
    }

    /// Image minus model; NaN where both are beyond what an image can have.
    #[inline(always)]
    fn residual(&self, pixels: &Pixels) -> Lane {
        let [cx, cy, _, _, a, b, _, gx, gy] = self.p;
        let ((n1x, n1y), (n2x, n2y)) = (self.n1, self.n2);
        let mut residual = [0.0; LANES];
        for k in 0..LANES {
            let (x, y) = (pixels.x[k], pixels.y[k]);
            let (dx, dy) = (x - cx, y - cy);
            let (e1, _) = erf((n1x * dx + n1y * dy) * self.scale);
            let (e2, _) = erf((n2x * dx + n2y * dy) * self.scale);
            let slope = gx * x + gy * y;
            let (light, veil) = (1.0 + self.multiplies * slope, (1.0 - self.multiplies) * slope);
            let seen = light * (a + b * e1 * e2) + veil;
            let within = share_within(pixels.grey[k], seen) == 1.0;
            residual[k] = if within { pixels.grey[k] - seen } else { f32::NAN };
        }
        residual
    }

    /// Derivatives and residual at pixels; of a `PLAIN` image nothing is saturated, and light
    /// multiplies.
    #[inline(always)]
    pub fn rows<const PLAIN: bool>(&self, pixels: &Pixels) -> Rows {
        let [cx, cy, _, _, a, b, _, gx, gy] = self.p;
        let ((n1x, n1y), (n2x, n2y)) = (self.n1, self.n2);
        let mut rows = [[0.0; LANES]; 10];
        for k in 0..LANES {
            let (x, y, weight) = (pixels.x[k], pixels.y[k], pixels.weight[k]);
            let (dx, dy) = (x - cx, y - cy);
            let (d1, d2) = (n1x * dx + n1y * dy, n2x * dx + n2y * dy);
            let (e1, slope1) = erf(d1 * self.scale);
            let (e2, slope2) = erf(d2 * self.scale);
            let (slope, dark) = (gx * x + gy * y, a + b * e1 * e2);
            let (light, veil, by_slope, weight) = if PLAIN {
                (1.0 + slope, 0.0, dark, weight)
            } else {
                let adds = 1.0 - self.multiplies;
                let (light, veil) = (1.0 + self.multiplies * slope, adds * slope);
                let share = share_within(pixels.grey[k], light * dark + veil);
                (light, veil, self.multiplies * dark + adds, weight * share)
            };
            let light = weight * light;
            // ∂/∂d₁ and ∂/∂d₂
            let f1 = light * b * slope1 * e2 * self.scale;
            let f2 = light * b * slope2 * e1 * self.scale;
            rows[0][k] = -(f1 * n1x + f2 * n2x);
            rows[1][k] = -(f1 * n1y + f2 * n2y);
            rows[2][k] = f1 * (n1x * dy - n1y * dx);
            rows[3][k] = f2 * (n2x * dy - n2y * dx);
            rows[4][k] = light;
            rows[5][k] = light * e1 * e2;
            rows[6][k] = -(f1 * d1 + f2 * d2);
            rows[7][k] = weight * by_slope * x;
            rows[8][k] = weight * by_slope * y;
            rows[9][k] = weight * (pixels.grey[k] - veil) - light * dark;
        }
        rows
    }
}

/// Sums that are kept apart, so that a processor adds as many at once.
const SUMS: usize = 8;
/// Derivatives by the nine parameters, and the residual.
pub(super) type Rows = [Lane; 10];
/// Products of two of them.
const PRODUCTS: usize = pairs(10);

/// Products of all pairs of rows, summed over the pixels. Wider registers are used where there are
/// any; they compute the same numbers.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn products(model: &Model, disc: &Disc) -> [[f32; SUMS]; PRODUCTS] {
    let mut products = [[0.0; SUMS]; PRODUCTS];
    if model.multiplies == 1.0 && !disc.saturated {
        for pixels in disc.pixels() {
            accumulate(&mut products, &model.rows::<true>(&pixels));
        }
    } else {
        for pixels in disc.pixels() {
            accumulate(&mut products, &model.rows::<false>(&pixels));
        }
    }
    products
}

/// Image minus model at every pixel, NaN where both are beyond what an image can have.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn residuals(model: &Model, disc: &Disc) -> Vec<f32> {
    let mut all = Vec::with_capacity(disc.x.len());
    for pixels in disc.pixels() {
        all.extend_from_slice(&model.residual(&pixels));
    }
    all
}
