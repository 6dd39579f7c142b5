//! The fit of the model to a disc, and what it says about the corner.

use nalgebra::{Matrix2, Vector2};

use super::{
    FittedCorner, RoughCorner,
    disc::{Disc, FEWEST_PIXELS},
    model::{Model, Parameters, products, residuals},
};
use crate::{
    detect::levenberg::{Bounded, Descent, Linearised, ROUNDING_VARIANCE, descend},
    math::gram::place,
};

/// No pixel of a disc is more columns or rows away from its middle.
const MOST_ACROSS: i32 = 16;
/// Columns and rows of a square that holds any disc.
const ACROSS: usize = 2 * MOST_ACROSS as usize + 1;
/// In a sharpened image the fit may creep to and fro between pixels, by less than this, px.
const SETTLED_PX: f64 = 0.03;
/// Residuals above this share of the contrast are not a corner's.
const WORST_RESIDUAL: f64 = 0.25;
/// Blurs stay in this range (px): a pixel's own square blurs by 0.29, more than the upper bound is
/// not a corner's. Without the lower bound an edge between two pixels would have no place.
const BLUR_PX: (f64, f64) = (0.29, 6.0);
/// The model's own error, px.
const MODEL_PX: f64 = 1e-3;
/// Pairs of opposite pixels that tell the noise.
const FEWEST_PAIRS: f64 = 40.0;
/// Place and slope of the light: parameters that change sign with half a turn.
const ODD_PARAMETERS: f64 = 4.0;
/// A corner with a larger variance (px², both axes) was not measured.
const UNKNOWN_PX2: f64 = 0.1;
/// Edges that cross at a smaller angle (rad) do not fix a point.
const SHALLOWEST_RAD: f64 = 0.15;
/// Share of a quadrant that may be lost in the other colour's limit.
const MOST_DROWNED: f64 = 0.7;

impl Disc {
    /// Until the corner moves less than `step_px`.
    pub(crate) fn descend(&self, start: Parameters, step_px: f64) -> Option<Descent<9>> {
        let length = |step: &Parameters| step[0].hypot(step[1]);
        let short = |step: &Parameters| length(step) < step_px;
        let bounded = Bounded::blur(6, BLUR_PX);
        let found = descend(start, |at| Some(self.linearise(at)), &bounded, short)?;
        (found.settled || length(&found.step) < SETTLED_PX).then_some(found)
    }

    /// Where the corner of these parameters is in the image.
    pub fn place(&self, at: &Parameters) -> Vector2<f64> {
        self.centre + Vector2::new(at[0], at[1])
    }

    /// From the board's directions and the mean greys of its quadrants.
    pub fn start(&self, rough: &RoughCorner) -> Parameters {
        let normal_angle = |along: &Vector2<f64>| along.x.atan2(-along.y);
        let (t1, t2) = (normal_angle(&rough.along_x), normal_angle(&rough.along_y));
        let count = self.count as f64;
        let a = self.each().map(|p| p.2).sum::<f64>() / count;
        let quadrant = |x: f64, y: f64| {
            let (d1, d2) = (t1.cos() * x + t1.sin() * y, t2.cos() * x + t2.sin() * y);
            d1.signum() * d2.signum()
        };
        let b = self.each().map(|(x, y, i)| (i - a) * quadrant(x, y)).sum::<f64>() / count;
        Parameters::from_column_slice(&[0.0, 0.0, t1, t2, a, 1.2 * b, 0.0, 0.0, 0.0])
    }

    fn linearise(&self, at: &Parameters) -> Linearised<9> {
        let products = products(&Model::new(at, self.light), self);
        let sums = products.map(|lane| lane.iter().map(|v| f64::from(*v)).sum::<f64>());
        Linearised::of(|m, n| sums[place::<10>(m, n)], self.count as f64)
    }

    /// Mean squared residual of the pixels that are not saturated.
    pub fn residual(&self, found: &Descent<9>) -> f64 {
        found.there.cost / self.told(&residuals(&Model::new(&found.at, self.light), self))
    }

    /// Number of pixels that tell something.
    fn told(&self, residuals: &[f32]) -> f64 {
        residuals[..self.count].iter().filter(|r| r.is_finite()).count() as f64
    }

    /// Variance of what is different on opposite sides of the corner. A crossing of edges looks the
    /// same after half a turn, whatever blurs it, and what does not change with half a turn does
    /// not move the corner. `None` where there are few pairs.
    fn odd_variance(&self, at: &Parameters, residuals: &[f32]) -> Option<f64> {
        let whole = self.centre.map(f64::round);
        // columns and rows from a corner of a square that holds the disc
        let middle = self.centre - whole + Vector2::repeat(MOST_ACROSS as f64 + 0.5);
        let (column, row) = (middle.x as f32, middle.y as f32);
        let cell = |k: usize| ((self.x[k] + column) as i32, (self.y[k] + row) as i32);
        let turned = (self.place(at) * 2.0).map(f64::round) - whole * 2.0;
        let turned = turned.map(|t| t as i32 + 2 * MOST_ACROSS);
        let mut square = [[f32::NAN; ACROSS]; ACROSS];
        let inside = |(i, j): (i32, i32)| {
            let range = 0..ACROSS as i32;
            (range.contains(&i) && range.contains(&j)).then_some((i as usize, j as usize))
        };
        for k in 0..self.count {
            let (i, j) = inside(cell(k))?;
            square[j][i] = residuals[k];
        }
        let (mut sum, mut pairs) = (0.0, 0.0);
        for k in 0..self.count {
            let (i, j) = cell(k);
            let opposite = inside((turned.x - i, turned.y - j)).map(|(i, j)| square[j][i]);
            let difference = opposite.map(|opposite| f64::from(residuals[k] - opposite));
            if let Some(difference) = difference.filter(|d| d.is_finite()) {
                // every pair comes twice
                sum += 0.25 * difference * difference;
                pairs += 0.5;
            }
        }
        (pairs >= FEWEST_PAIRS).then(|| sum / (pairs - ODD_PARAMETERS))
    }

    /// Whether no quadrant is lost in the other colour's limit.
    fn is_crossing(&self, at: &Parameters, residuals: &[f32]) -> bool {
        let normals = [at[2], at[3]].map(|t| (t.cos(), t.sin()));
        let (mut all, mut drowned) = ([0.0; 4], [0.0; 4]);
        for ((x, y, grey), residual) in self.each().zip(residuals) {
            let [first, second] =
                normals.map(|(n_x, n_y)| n_x * (x - at[0]) + n_y * (y - at[1]) > 0.0);
            let is_dark = (first == second) == (at[5] < 0.0);
            let quadrant = usize::from(first) + 2 * usize::from(second);
            all[quadrant] += 1.0;
            let is_other = is_dark == (grey > at[4]);
            drowned[quadrant] += f64::from(u8::from(is_other && residual.is_nan()));
        }
        (0..4).all(|k| drowned[k] <= MOST_DROWNED * all[k])
    }

    pub fn judge(&self, Descent { at, there, .. }: &Descent<9>) -> Option<FittedCorner> {
        let residuals = residuals(&Model::new(at, self.light), self);
        // a perfectly sharp print has black and white only; what little it tells is in the normal matrix
        let told = Some(self.told(&residuals)).filter(|told| *told >= FEWEST_PIXELS as f64);
        let there = Linearised { count: told.unwrap_or(there.count), ..*there };
        let all = there.variance()?;
        let variance =
            self.odd_variance(at, &residuals).map_or(all, |odd| odd.max(ROUNDING_VARIANCE));
        let blur_px = at[6].exp();
        let crossing = (at[2] - at[3]).sin().abs();
        let sound = all.sqrt() < WORST_RESIDUAL * at[5].abs()
            && blur_px < 0.99 * BLUR_PX.1
            && crossing > SHALLOWEST_RAD.sin();
        let inverse = there.covariance(variance)?;
        let own = Matrix2::identity() * MODEL_PX.powi(2);
        let covariance: Matrix2<f64> = inverse.fixed_view::<2, 2>(0, 0).into_owned() + own;
        let known = covariance.determinant() > 0.0 && covariance.trace() < UNKNOWN_PX2;
        (sound && known).then(|| FittedCorner {
            pixel: self.place(at),
            covariance,
            blur_px,
            contrast: 2.0 * at[5].abs(),
            in_sight: !self.saturated || self.is_crossing(at, &residuals),
        })
    }
}
