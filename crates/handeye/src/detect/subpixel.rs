//! Where exactly a checkerboard corner is, and how sure that is.
//!
//! Around a corner at `c` two straight edges cross; with `d₁, d₂` the signed distances of a pixel
//! `p` to them, a lens that blurs with a Gaussian of width `s` and light that changes linearly with
//! `g`, the picture is
//!
//! ```text
//! I(p) = (a + b erf(d₁/(√2 s)) erf(d₂/(√2 s))) (1 + g·(p - p₀)),    dᵢ = nᵢ(θᵢ)·(p - c)
//! ```
//!
//! Its nine parameters `c, θ₁, θ₂, a, b, ln s, g` are fitted to the pixels of a disc by
//! Levenberg-Marquardt; the inverse normal matrix, scaled by the mean squared residual, is their
//! covariance. The product of two error functions is exact for edges at right angles and close for
//! others.
//!
//! After L. Krüger and C. Wöhler, *Accurate chequerboard corner localisation for camera
//! calibration*, Pattern Recognition Letters 32(10), 2011, who fit the same surface with one blur.

use std::{f64::consts::FRAC_1_SQRT_2, ops::Range};

use multiversion::multiversion;
use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use super::erf::erf;
use crate::GrayImage;

/// A corner known to about a pixel, and the board around it.
#[derive(Debug, Clone, Copy)]
pub struct RoughCorner {
    /// About where, px.
    pub pixel: Vector2<f64>,
    /// From this corner to the next one along the board's x, px.
    pub along_x: Vector2<f64>,
    /// From this corner to the next one along the board's y, px.
    pub along_y: Vector2<f64>,
    /// Half the width of the clean cross between the markers around the corner, as a share of the
    /// cell; 1 where there are no markers.
    pub clean: f64,
    /// Where the only marker is, as the signs of its steps along x and y; none if there may be one in
    /// every cell.
    pub marker: Option<[f64; 2]>,
}

/// A corner after the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedCorner {
    /// Where, px.
    pub pixel: Vector2<f64>,
    /// How sure, px².
    pub covariance: Matrix2<f64>,
    /// Standard deviation of the blur, px.
    pub blur_px: f64,
    /// White minus black, grey values.
    pub contrast: f64,
}

/// Why a corner was left out.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unfit {
    /// The picture ends too close to it.
    #[error("too close to the picture's edge")]
    AtTheEdge,
    /// The squares are too small to tell their edges apart.
    #[error("the squares are only {0:.1} px wide")]
    TooSmall(f64),
    /// The fit found nothing, or wandered away.
    #[error("the picture does not look like a corner there")]
    NoCorner,
}

/// The disc reaches this share of the way to the next parallel edge: the model knows only two edges.
const REACH: f64 = 0.6;
/// Largest disc radius, px: beyond it lens distortion bends the edges.
const WIDEST_PX: f64 = 14.0;
/// No pixel of a disc is more columns or rows away from its middle.
const MOST_ACROSS: i32 = 16;
/// Columns and rows of a square that holds any disc.
const ACROSS: usize = 2 * MOST_ACROSS as usize + 1;
/// The next parallel edge must stay this far outside the disc, px: about three blurs.
const GUARD_PX: f64 = 2.5;
/// Below this radius (px) a disc holds too few pixels for nine parameters.
const SMALLEST_PX: f64 = 2.2;
/// The second disc's radius, as a share of the first's.
const SMALLER: f64 = 0.65;
/// A fit that moves farther than this share of a cell has found another corner.
const FARTHEST: f64 = 0.3;
/// Fewer pixels than this do not determine nine parameters.
const FEWEST_PIXELS: usize = 14;
/// Markers are cut out with this margin, px, for their blur.
const MARKER_MARGIN_PX: f64 = 2.0;
/// Most steps of the fit; it usually takes four.
const MOST_STEPS: usize = 30;
/// The fit has converged when the corner moves less than this, px: the step after it would be some
/// twenty times smaller.
const STEP_PX: f64 = 5e-3;
/// Damping below this hardly shortens a step.
const FREE: f64 = 0.05;
/// In a sharpened picture the fit may creep to and fro between pixels, by less than this, px.
const SETTLED_PX: f64 = 0.03;
/// The small disc's fit ends when the corner moves less than this, px.
const NEAR_STEP_PX: f64 = 0.05;
/// Radius of the small disc, px.
const NEAR_PX: f64 = 6.0;
/// Residuals above this share of the contrast are not a corner's.
const WORST_RESIDUAL: f64 = 0.25;
/// Rounding to 8 bits alone leaves this variance, grey values squared.
const ROUNDING_VARIANCE: f64 = 1.0 / 12.0;
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

type Parameters = SVector<f64, 9>;
type Normal = SMatrix<f64, 9, 9>;

/// A corner to a few hundredths of a pixel, from the pixels next to it.
#[derive(Debug, Clone, Copy)]
pub struct NearCorner {
    /// Where, px.
    pub pixel: Vector2<f64>,
    /// The other parameters, relative to `pixel`.
    shape: Parameters,
}

/// Gets near a corner, by a small disc.
///
/// # Errors
/// Why there is none.
pub fn approach(image: &GrayImage, rough: &RoughCorner) -> Result<NearCorner, Unfit> {
    let disc = Disc::gather(image, rough, radius(rough)?.min(NEAR_PX))?;
    let (at, ..) = disc.descend(disc.start(rough), NEAR_STEP_PX).ok_or(Unfit::NoCorner)?;
    let pixel = disc.place(&at);
    not_far(rough, &pixel)?;
    let mut shape = at;
    shape.fixed_rows_mut::<2>(0).fill(0.0);
    Ok(NearCorner { pixel, shape })
}

/// Measures a corner by the largest disc that holds no other edge. Where that sees more than the
/// model knows (halos, glare, bent paper), a smaller one is tried. Of `rough` the steps count.
///
/// # Errors
/// Why it was left out.
pub fn measure(
    image: &GrayImage,
    rough: &RoughCorner,
    near: &NearCorner,
) -> Result<FittedCorner, Unfit> {
    let radius = radius(rough)?;
    measure_disc(image, rough, near, radius).or_else(|unfit| {
        let smaller = SMALLER * radius;
        if smaller < SMALLEST_PX { Err(unfit) } else { measure_disc(image, rough, near, smaller) }
    })
}

fn measure_disc(
    image: &GrayImage,
    rough: &RoughCorner,
    near: &NearCorner,
    radius: f64,
) -> Result<FittedCorner, Unfit> {
    let disc = Disc::gather(image, &RoughCorner { pixel: near.pixel, ..*rough }, radius)?;
    let (at, normal, cost) = disc.descend(near.shape, STEP_PX).ok_or(Unfit::NoCorner)?;
    let fitted = disc.judge(&at, &normal, cost).ok_or(Unfit::NoCorner)?;
    not_far(rough, &fitted.pixel)?;
    Ok(fitted)
}

/// Both steps for a corner alone.
///
/// # Errors
/// Why it was left out.
pub fn fit(image: &GrayImage, rough: &RoughCorner) -> Result<FittedCorner, Unfit> {
    measure(image, rough, &approach(image, rough)?)
}

fn not_far(rough: &RoughCorner, pixel: &Vector2<f64>) -> Result<(), Unfit> {
    let cell = rough.along_x.norm().min(rough.along_y.norm());
    if (pixel - rough.pixel).norm() < FARTHEST * cell { Ok(()) } else { Err(Unfit::NoCorner) }
}

/// Radius of the disc, from the distance to the next edges.
fn radius(rough: &RoughCorner) -> Result<f64, Unfit> {
    let (u, v) = (rough.along_x, rough.along_y);
    let area = u.perp(&v).abs();
    let width = area / u.norm().max(v.norm());
    let radius = (REACH * width).min(width - GUARD_PX).min(WIDEST_PX);
    if radius >= SMALLEST_PX { Ok(radius) } else { Err(Unfit::TooSmall(width)) }
}

/// Pixels that are computed at once.
const LANES: usize = 32;
type Lane = [f32; LANES];
/// Sums that are kept apart, so that a processor adds as many at once.
const SUMS: usize = 8;

/// Pixels relative to the disc's centre; a weight of 0 fills up the last ones.
struct Pixels<'a> {
    x: &'a Lane,
    y: &'a Lane,
    grey: &'a Lane,
    weight: &'a Lane,
}

/// The pixels around a corner, relative to its centre: a multiple of [`LANES`], the last ones with
/// a weight of 0.
struct Disc {
    centre: Vector2<f64>,
    x: Vec<f32>,
    y: Vec<f32>,
    grey: Vec<f32>,
    weight: Vec<f32>,
    count: usize,
}

impl Disc {
    fn gather(image: &GrayImage, rough: &RoughCorner, radius: f64) -> Result<Self, Unfit> {
        let centre = rough.pixel;
        let (low_x, low_y) = ((centre.x - radius).ceil(), (centre.y - radius).ceil());
        let (high_x, high_y) = ((centre.x + radius).floor(), (centre.y + radius).floor());
        let (right, bottom) = (image.width() as f64 - 1.0, image.height() as f64 - 1.0);
        if !(low_x >= 0.0 && low_y >= 0.0 && high_x <= right && high_y <= bottom) {
            return Err(Unfit::AtTheEdge);
        }
        let hidden = markers_around(rough)?;
        let mut disc = Self::with_room((4.0 * radius * radius) as usize + LANES, centre);
        for y in low_y as usize..=high_y as usize {
            let dy = y as f64 - centre.y;
            let half = (radius * radius - dy * dy).max(0.0).sqrt();
            let (first, last) = ((centre.x - half).ceil(), (centre.x + half).floor());
            let seen = first as usize..last as usize + 1;
            match &hidden {
                None => disc.push(image, y, seen),
                Some(hidden) => {
                    let clear = |x: &usize| !hidden(&Vector2::new(*x as f64 - centre.x, dy));
                    seen.filter(clear).for_each(|x| disc.push(image, y, x..x + 1));
                }
            }
        }
        if disc.count < FEWEST_PIXELS {
            return Err(Unfit::TooSmall(radius / REACH));
        }
        disc.fill_up();
        Ok(disc)
    }

    fn with_room(count: usize, centre: Vector2<f64>) -> Self {
        let room = || Vec::with_capacity(count);
        Self { centre, x: room(), y: room(), grey: room(), weight: room(), count: 0 }
    }

    /// Adds a part of a row.
    fn push(&mut self, image: &GrayImage, y: usize, part: Range<usize>) {
        let row = y * image.width();
        self.count += part.len();
        self.grey.extend_from_slice(&image.values()[row + part.start..row + part.end]);
        self.y.resize(self.count, (y as f64 - self.centre.y) as f32);
        self.x.extend(part.map(|x| (x as f64 - self.centre.x) as f32));
    }

    fn fill_up(&mut self) {
        let full = self.count.next_multiple_of(LANES);
        self.weight.resize(self.count, 1.0);
        for values in [&mut self.x, &mut self.y, &mut self.grey, &mut self.weight] {
            values.resize(full, 0.0);
        }
    }

    fn pixels(&self) -> impl Iterator<Item = Pixels<'_>> {
        fn lanes(values: &[f32]) -> std::slice::Iter<'_, Lane> {
            values.as_chunks().0.iter()
        }
        let all =
            lanes(&self.x).zip(lanes(&self.y)).zip(lanes(&self.grey)).zip(lanes(&self.weight));
        all.map(|(((x, y), grey), weight)| Pixels { x, y, grey, weight })
    }

    fn each(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let one = |k: usize| (f64::from(self.x[k]), f64::from(self.y[k]), f64::from(self.grey[k]));
        (0..self.count).map(one)
    }

    /// Levenberg-Marquardt until the corner moves less than `step_px`: parameters, `JᵀJ` and cost
    /// before the last step.
    fn descend(&self, start: Parameters, step_px: f64) -> Option<(Parameters, Normal, f64)> {
        let mut at = start;
        let (mut normal, mut gradient, mut cost) = self.linearise(&at);
        let mut damping = 1e-3;
        let mut last_px = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let mut step = damped_step(&normal, &gradient, damping)?;
            let blur = at[6] + step[6];
            if blur != clamped(blur) && at[6] == clamped(blur) {
                // at the end of its range the blur stays, and the others move alone
                step = damped_step(&without_blur(&normal), &gradient, damping)?;
                step[6] = 0.0;
            }
            let mut next = at + step;
            next[6] = clamped(next[6]);
            let length = step[0].hypot(step[1]);
            if length < step_px && last_px.is_finite() && damping < FREE {
                return Some((next, normal, cost));
            }
            let (n, g, c) = self.linearise(&next);
            if c.is_finite() && c <= cost {
                (at, normal, gradient, cost) = (next, n, g, c);
                damping *= 0.1;
                last_px = length;
            } else if damping > 1e6 {
                return Some((at, normal, cost)); // rounding: no step makes it better
            } else {
                damping *= 10.0;
            }
        }
        (last_px < SETTLED_PX).then_some((at, normal, cost))
    }

    /// Where the corner of these parameters is in the picture.
    fn place(&self, at: &Parameters) -> Vector2<f64> {
        self.centre + Vector2::new(at[0], at[1])
    }

    /// From the board's directions and the mean greys of its quadrants.
    fn start(&self, rough: &RoughCorner) -> Parameters {
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

    /// `JᵀJ`, `Jᵀr` and `rᵀr` of `r = I - model`.
    fn linearise(&self, at: &Parameters) -> (Normal, Parameters, f64) {
        let products = products(&Model::new(at), self);
        let sums = products.map(|lane| lane.iter().map(|v| f64::from(*v)).sum::<f64>());
        let at = |m: usize, n: usize| sums[place(m.min(n), m.max(n))];
        (Normal::from_fn(at), Parameters::from_fn(|m, _| at(m, 9)), at(9, 9))
    }

    /// Variance of what is different on opposite sides of the corner. A crossing of edges looks the
    /// same after half a turn, whatever blurs it, and what does not change with half a turn does
    /// not move the corner. `None` where there are few pairs.
    fn odd_variance(&self, at: &Parameters) -> Option<f64> {
        let residuals = residuals(&Model::new(at), self);
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
            if let Some(opposite) = opposite.filter(|r| r.is_finite()) {
                // every pair comes twice
                sum += 0.25 * f64::from(residuals[k] - opposite).powi(2);
                pairs += 0.5;
            }
        }
        (pairs >= FEWEST_PAIRS).then(|| sum / (pairs - ODD_PARAMETERS))
    }

    fn judge(&self, at: &Parameters, normal: &Normal, cost: f64) -> Option<FittedCorner> {
        let freedom = self.count as f64 - 9.0;
        let odd = self.odd_variance(at);
        let variance = odd.unwrap_or(cost / freedom).max(ROUNDING_VARIANCE);
        let blur_px = at[6].exp();
        let crossing = (at[2] - at[3]).sin().abs();
        let sound = (cost / freedom).sqrt() < WORST_RESIDUAL * at[5].abs()
            && blur_px < 0.99 * BLUR_PX.1
            && crossing > SHALLOWEST_RAD.sin();
        let inverse = normal.cholesky()?.inverse() * variance;
        let own = Matrix2::identity() * MODEL_PX.powi(2);
        let covariance: Matrix2<f64> = inverse.fixed_view::<2, 2>(0, 0).into_owned() + own;
        let known = covariance.determinant() > 0.0 && covariance.trace() < UNKNOWN_PX2;
        (sound && known).then(|| FittedCorner {
            pixel: self.place(at),
            covariance,
            blur_px,
            contrast: 2.0 * at[5].abs(),
        })
    }
}

/// Derivatives by the nine parameters, and the residual.
type Rows = [Lane; 10];
/// Products of two of them.
const PRODUCTS: usize = 55;

/// Where the product of rows `m <= n` is kept.
const fn place(m: usize, n: usize) -> usize {
    m * 10 - m * (m + 1) / 2 + n
}

/// Products of all pairs of rows, summed over the pixels. Wider registers are used where there are
/// any; they compute the same numbers.
#[multiversion(targets("x86_64+avx2"))]
fn products(model: &Model, disc: &Disc) -> [[f32; SUMS]; PRODUCTS] {
    let mut products = [[0.0; SUMS]; PRODUCTS];
    for pixels in disc.pixels() {
        accumulate(&mut products, &model.rows(&pixels));
    }
    products
}

/// Picture minus model at every pixel.
#[multiversion(targets("x86_64+avx2"))]
fn residuals(model: &Model, disc: &Disc) -> Vec<f32> {
    let mut all = Vec::with_capacity(disc.x.len());
    for pixels in disc.pixels() {
        all.extend_from_slice(&model.residual(&pixels));
    }
    all
}

#[inline(always)]
fn accumulate(products: &mut [[f32; SUMS]; PRODUCTS], rows: &Rows) {
    let mut next = 0;
    for m in 0..10 {
        for n in m..10 {
            let mut sum = products[next];
            for from in (0..LANES).step_by(SUMS) {
                for k in 0..SUMS {
                    sum[k] += rows[m][from + k] * rows[n][from + k];
                }
            }
            products[next] = sum;
            next += 1;
        }
    }
}

fn clamped(ln_blur: f64) -> f64 {
    ln_blur.clamp(BLUR_PX.0.ln(), BLUR_PX.1.ln())
}

/// Normal equations in which the blur moves nothing.
fn without_blur(normal: &Normal) -> Normal {
    let mut without = *normal;
    for k in (0..9).filter(|k| *k != 6) {
        (without[(6, k)], without[(k, 6)]) = (0.0, 0.0);
    }
    without
}

fn damped_step(normal: &Normal, gradient: &Parameters, damping: f64) -> Option<Parameters> {
    let mut damped = *normal;
    for k in 0..9 {
        damped[(k, k)] *= 1.0 + damping;
    }
    Some(damped.cholesky()?.solve(gradient))
}

/// The model at one set of parameters: `cx cy θ₁ θ₂ a b ln(s) gx gy`.
struct Model {
    p: [f32; 9],
    n1: (f32, f32),
    n2: (f32, f32),
    /// `1/(√2 s)`
    scale: f32,
}

impl Model {
    fn new(at: &Parameters) -> Self {
        let p = std::array::from_fn(|k| at[k] as f32);
        let normal = |t: f64| (t.cos() as f32, t.sin() as f32);
        let scale = (FRAC_1_SQRT_2 * (-at[6]).exp()) as f32;
        Self { p, n1: normal(at[2]), n2: normal(at[3]), scale }
    }

    /// Picture minus model.
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
            residual[k] = pixels.grey[k] - (1.0 + gx * x + gy * y) * (a + b * e1 * e2);
        }
        residual
    }

    /// Derivatives and residual at pixels.
    #[inline(always)]
    fn rows(&self, pixels: &Pixels) -> Rows {
        let [cx, cy, _, _, a, b, _, gx, gy] = self.p;
        let ((n1x, n1y), (n2x, n2y)) = (self.n1, self.n2);
        let mut rows = [[0.0; LANES]; 10];
        for k in 0..LANES {
            let (x, y, weight) = (pixels.x[k], pixels.y[k], pixels.weight[k]);
            let (dx, dy) = (x - cx, y - cy);
            let (d1, d2) = (n1x * dx + n1y * dy, n2x * dx + n2y * dy);
            let (e1, slope1) = erf(d1 * self.scale);
            let (e2, slope2) = erf(d2 * self.scale);
            let light = weight * (1.0 + gx * x + gy * y);
            let dark = a + b * e1 * e2;
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
            rows[7][k] = weight * dark * x;
            rows[8][k] = weight * dark * y;
            rows[9][k] = weight * pixels.grey[k] - light * dark;
        }
        rows
    }
}

/// Whether a place relative to a corner lies in a marker of the squares around it; `None` where there
/// are no markers.
fn markers_around(
    rough: &RoughCorner,
) -> Result<Option<impl Fn(&Vector2<f64>) -> bool + use<>>, Unfit> {
    if rough.clean >= 1.0 {
        return Ok(None);
    }
    let cells = Matrix2::from_columns(&[rough.along_x, rough.along_y]);
    let into_cells = cells.try_inverse().ok_or(Unfit::NoCorner)?;
    let margin = MARKER_MARGIN_PX / rough.along_x.norm().min(rough.along_y.norm());
    let clean = rough.clean - margin;
    let marker = rough.marker;
    Ok(Some(move |d: &Vector2<f64>| {
        let q = into_cells * d;
        match marker {
            Some([x, y]) => (x * q.x).min(y * q.y) > clean,
            None => q.x.abs().min(q.y.abs()) > clean,
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::{Optics, Random, Scene};
    use crate::{Intrinsics, Pose, TargetModel};
    use nalgebra::{Vector3, Vector6};

    #[test]
    fn the_jacobian_matches_central_differences() {
        let at =
            Parameters::from_column_slice(&[0.3, -0.2, 0.4, 1.8, 110.0, -60.0, 0.2, 0.01, -0.02]);
        for (x, y) in [(0.5, 0.1), (-3.0, 2.0), (1.0, -4.0)] {
            let one = |v: f32| [v; LANES];
            let (x, y, grey, weight) = (&one(x), &one(y), &one(0.0), &one(1.0));
            let pixel = Pixels { x, y, grey, weight };
            let rows = Model::new(&at).rows(&pixel);
            for k in 0..9 {
                let mut step = Parameters::zeros();
                step[k] = 1e-2;
                let value = |at: &Parameters| -f64::from(Model::new(at).rows(&pixel)[9][0]);
                let numeric = (value(&(at + step)) - value(&(at - step))) / 2e-2;
                let analytic = f64::from(rows[k][0]);
                assert!((analytic - numeric).abs() < 3e-3 * (3.0 + numeric.abs()), "{k}");
            }
        }
    }

    #[test]
    fn products_of_rows_have_a_place_each() {
        let all: Vec<usize> = (0..10).flat_map(|m| (m..10).map(move |n| place(m, n))).collect();
        assert_eq!(all, (0..PRODUCTS).collect::<Vec<_>>());
    }

    /// Fits every corner of six pictures from starts 0.5 px off: errors and their covariances.
    fn errors(cell_px: f64, optics: &Optics) -> Vec<(Vector2<f64>, Matrix2<f64>)> {
        let mut random = Random::new(42);
        let mut all = vec![];
        for seed in 0..6 {
            let scene = scene(cell_px, &mut random);
            let picture = scene.picture(optics, seed);
            for (rough, truth) in rough_corners(&scene, &mut random) {
                if let Ok(fitted) = fit(&picture, &rough) {
                    all.push((fitted.pixel - truth, fitted.covariance));
                }
            }
        }
        all
    }

    /// A 10 x 7 board, tilted up to 45 degrees.
    fn scene(cell_px: f64, random: &mut Random) -> Scene {
        let focal = 1000.0;
        let (square, depth) = (0.02, 0.02 * focal / cell_px);
        let tilt = random.between(0.0, 0.78);
        let axis = random.between(0.0, std::f64::consts::TAU);
        let tilt = Vector6::new(tilt * axis.cos(), tilt * axis.sin(), 0.0, 0.0, 0.0, 0.0);
        let roll = Vector6::new(0.0, 0.0, random.between(-0.52, 0.52), 0.0, 0.0, 0.0);
        let centre = Vector6::new(0.0, 0.0, 0.0, -4.5 * square, -3.0 * square, 0.0);
        let away = Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::new(0.0, 0.0, depth));
        Scene {
            target: TargetModel::Checkerboard { columns: 10, rows: 7, square_mm: 20.0 },
            camera_from_target: away.retract(&tilt).retract(&roll).retract(&centre),
            intrinsics: Intrinsics::pinhole(800, 600, focal, focal, 399.5, 299.5),
        }
    }

    fn rough_corners(scene: &Scene, random: &mut Random) -> Vec<(RoughCorner, Vector2<f64>)> {
        let corners = scene.corners();
        let at = |id: u32| corners.iter().find(|c| c.0 == id).map(|c| c.1);
        let one = |&(id, truth): &(u32, Vector2<f64>)| {
            let next = |step: u32, last: bool| {
                let there = if last { truth - at(id - step)? } else { at(id + step)? - truth };
                Some(there)
            };
            let off = Vector2::new(random.between(-0.35, 0.35), random.between(-0.35, 0.35));
            let rough = RoughCorner {
                pixel: truth + off,
                along_x: next(1, id % 10 == 9)?,
                along_y: next(10, id / 10 == 6)?,
                clean: 1.0,
                marker: None,
            };
            Some((rough, truth))
        };
        corners.iter().filter_map(one).collect()
    }

    fn rms(errors: &[(Vector2<f64>, Matrix2<f64>)]) -> f64 {
        (errors.iter().map(|e| e.0.norm_squared()).sum::<f64>() / errors.len() as f64).sqrt()
    }

    #[test]
    fn corners_are_found_to_a_few_hundredths_of_a_pixel() {
        // cell px, blur px, noise, goal px
        let cases = [
            (60.0, 0.6, 1.5, 0.009),
            (45.0, 0.9, 2.5, 0.014),
            (45.0, 2.0, 3.0, 0.019),
            (14.0, 0.7, 2.0, 0.010),
            (45.0, 1.0, 8.0, 0.034),
        ];
        for (cell_px, blur_px, noise, goal) in cases {
            let errors = errors(cell_px, &Optics { blur_px, noise, ..Optics::default() });
            assert!(errors.len() > 410, "{} corners", errors.len());
            assert!(rms(&errors) < goal, "{cell_px} {blur_px} {noise}: {}", rms(&errors));
            let ratio = expected_ratio(&errors);
            assert!((0.9..1.15).contains(&ratio), "{cell_px} {blur_px} {noise}: {ratio}");
        }
    }

    /// Mean of the squared errors over their covariances; 1 is expected.
    fn expected_ratio(errors: &[(Vector2<f64>, Matrix2<f64>)]) -> f64 {
        let one = |(e, c): &(Vector2<f64>, Matrix2<f64>)| e.dot(&(c.try_inverse().unwrap() * e));
        errors.iter().map(one).sum::<f64>() / (2.0 * errors.len() as f64)
    }

    #[test]
    fn light_that_fades_does_not_move_corners() {
        let optics = Optics { vignetting: 0.5, noise: 0.5, ..Optics::default() };
        assert!(rms(&errors(45.0, &optics)) < 0.006);
    }

    #[test]
    fn a_lens_out_of_focus_costs_little() {
        let optics = Optics { blur_px: 0.5, defocus_px: 2.0, ..Optics::default() };
        assert!(rms(&errors(45.0, &optics)) < 0.03);
    }

    #[test]
    fn a_flat_picture_has_no_corner() {
        let flat = GrayImage::new(60, 60, vec![90.0; 3600]).unwrap();
        let rough = RoughCorner {
            pixel: Vector2::new(30.0, 30.0),
            along_x: Vector2::new(20.0, 0.0),
            along_y: Vector2::new(0.0, 20.0),
            clean: 1.0,
            marker: None,
        };
        assert_eq!(fit(&flat, &rough), Err(Unfit::NoCorner));
        let rough = RoughCorner { pixel: Vector2::new(3.0, 30.0), ..rough };
        assert_eq!(fit(&flat, &rough), Err(Unfit::AtTheEdge));
    }

    /// A checkerboard of whole black and white pixels, as a rasterised print has it.
    #[test]
    fn perfectly_sharp_corners_are_all_found() {
        for cell in [8.0, 14.77, 29.53, 59.06, 147.64] {
            let edge = |k: usize| 5.3 + cell * k as f64;
            let size = edge(7).ceil() as usize + 5;
            let index = |x: usize| ((x as f64 - edge(0)) / cell).floor() as i64;
            let grey = |x: usize, y: usize| {
                let board = |k: i64| (0..7).contains(&k);
                let black = board(index(x)) && board(index(y)) && (index(x) + index(y)) % 2 == 0;
                if black { 0.0 } else { 255.0 }
            };
            let pixels = (0..size * size).map(|k| grey(k % size, k / size)).collect();
            let image = GrayImage::new(size, size, pixels).unwrap();
            for (i, j) in (1..7).flat_map(|i| (1..7).map(move |j| (i, j))) {
                let on_edge = |k: usize| edge(k).ceil() - 0.5;
                let truth = Vector2::new(on_edge(i), on_edge(j));
                for off in [(0.0, 0.0), (0.4, -0.3), (-0.5, 0.5), (0.7, 0.2)] {
                    let rough = RoughCorner {
                        pixel: truth + Vector2::new(off.0, off.1),
                        along_x: Vector2::new(cell, 0.0),
                        along_y: Vector2::new(0.0, cell),
                        clean: 1.0,
                        marker: None,
                    };
                    let error = fit(&image, &rough).map(|f| (f.pixel - truth).norm());
                    assert!(error.is_ok_and(|e| e < 0.05), "{cell} {i} {j} {off:?}: {error:?}");
                }
            }
        }
    }
}
