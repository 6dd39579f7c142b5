//! The image of an edge, its derivatives, and their products over a band.

use std::f64::consts::FRAC_1_SQRT_2;

use multiversion::multiversion;
use nalgebra::SVector;

use crate::{
    detect::{erf::erf, saturated::share_within},
    math::gram::{accumulate, pairs},
};

pub(in crate::detect) type Parameters = SVector<f64, 6>;

/// Pixels that are computed at once.
pub(super) const LANES: usize = 8;
pub(super) type Lane = [f32; LANES];

/// Along the side, outwards, and grey; a weight of 0 fills up the last ones.
#[derive(Clone, Copy, Default)]
pub(super) struct Pixels {
    pub u: Lane,
    pub v: Lane,
    pub grey: Lane,
    pub weight: Lane,
}

/// Derivatives by the six parameters, and the residual.
pub(super) type Rows = [Lane; 7];
/// Products of two of them.
const PRODUCTS: usize = pairs(7);

/// Products of all pairs of rows, summed over the pixels. Wider registers are used where there are
/// any; they compute the same numbers.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn products(model: &Model, pixels: &[Pixels], saturated: bool) -> [Lane; PRODUCTS] {
    let mut products = [[0.0; LANES]; PRODUCTS];
    if saturated {
        for pixels in pixels {
            accumulate(&mut products, &model.rows::<false>(pixels));
        }
    } else {
        for pixels in pixels {
            accumulate(&mut products, &model.rows::<true>(pixels));
        }
    }
    products
}

/// The model at one set of parameters: `ρ θ a b ln(s) g`.
pub(super) struct Model {
    rho: f32,
    sine: f32,
    cosine: f32,
    a: f32,
    b: f32,
    g: f32,
    /// `1/(√2 s)`
    scale: f32,
}

impl Model {
    pub fn new(at: &Parameters) -> Self {
        let [rho, theta, a, b, ln_s, g] = (*at).into();
        let scale = ((-ln_s).exp() * FRAC_1_SQRT_2) as f32;
        let [rho, a, b, g, sine, cosine] =
            [rho, a, b, g, theta.sin(), theta.cos()].map(|x: f64| x as f32);
        Self { rho, sine, cosine, a, b, g, scale }
    }

    /// Derivatives and residual at pixels, `d = v cos θ + u sin θ - ρ`; of a `PLAIN` image nothing is
    /// saturated.
    #[inline(always)]
    pub fn rows<const PLAIN: bool>(&self, pixels: &Pixels) -> Rows {
        let mut rows = [[0.0; LANES]; 7];
        for k in 0..LANES {
            let (u, v, weight) = (pixels.u[k], pixels.v[k], pixels.weight[k]);
            let d = v * self.cosine + u * self.sine - self.rho;
            let (value, slope) = erf(d * self.scale);
            let seen = self.a + self.g * u + self.b * value;
            let share = if PLAIN { 1.0 } else { share_within(pixels.grey[k], seen) };
            let weight = weight * share;
            let by_d = weight * self.b * slope * self.scale;
            rows[0][k] = -by_d;
            rows[1][k] = by_d * (u * self.cosine - v * self.sine);
            rows[2][k] = weight;
            rows[3][k] = weight * value;
            rows[4][k] = -by_d * d;
            rows[5][k] = weight * u;
            rows[6][k] = weight * (pixels.grey[k] - seen);
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_model_has_the_right_derivatives() {
        let at = Parameters::from([0.2, 0.03, 100.0, 60.0, 0.1, 0.2]);
        for (u, v) in [(3.0, 0.5), (-7.0, -1.2), (0.4, 0.1)] {
            let one = |x: f32| [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            let pixel = Pixels { u: one(u), v: one(v), grey: one(0.0), weight: one(1.0) };
            let rows = Model::new(&at).rows::<false>(&pixel);
            let value = |at: &Parameters| -f64::from(Model::new(at).rows::<false>(&pixel)[6][0]);
            for k in 0..6 {
                let mut step = Parameters::zeros();
                step[k] = 1e-2;
                let numeric = (value(&(at + step)) - value(&(at - step))) / 2e-2;
                let analytic = f64::from(rows[k][0]);
                assert!((numeric - analytic).abs() < 3e-3 * (3.0 + numeric.abs()), "{k}");
            }
        }
    }
}
