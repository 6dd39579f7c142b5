//! The four sides of a tag, and the corners where they meet.
//!
//! Each side is an edge blurred by a Gaussian of width `s`, in light that changes linearly along it:
//!
//! ```text
//! I(p) = a + g u + b erf(d/(√2 s)),    d = n(θ)·(p - m) - ρ
//! ```
//!
//! with `u` along the side and `m` its middle. `ρ, θ, a, b, ln s, g` are fitted by
//! Levenberg-Marquardt; neighbouring sides meet in the corners, which take over the lines'
//! covariances. Where it is known how a lens bends the sides, that is taken off first.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use super::quads::{Quad, area};
use crate::detect::erf::erf;
use crate::{GrayImage, ImageCorner};

/// Half the width of the band around a side in which its edge is fitted, as a share of the way to
/// the next edges, and px.
const BAND_SHARE: f64 = 0.7;
const BAND_PX: (f64, f64) = (1.5, 6.0);
/// The band ends this much before the corners, in cells, and in px more.
const END_CELLS: f64 = 0.5;
const END_PX: f64 = 1.5;
/// Other edges are farther from the band than this many blurs, unless it becomes narrower than so
/// many: then black and white themselves are not seen, and nothing is known.
const CLEAR_BLURS: f64 = 3.0;
const LEAST_BLURS: f64 = 1.7;
/// Blur of a common picture, px, before it is measured.
const USUAL_BLUR_PX: f64 = 0.6;
/// Most steps of a fit.
const MOST_STEPS: usize = 30;
/// A fit has converged when the edge moves less than this, px: the next step, were it taken, would
/// be some hundred times smaller.
const STEP_PX: f64 = 1e-3;
/// Fewer pixels do not determine six parameters.
const FEWEST_PIXELS: usize = 16;
/// Pieces of a side whose offsets tell how straight it is.
const PIECES: usize = 8;
/// Blurs stay in this range, px.
const BLUR_PX: (f64, f64) = (0.29, 4.0);
/// Rounding to 8 bits alone leaves this variance.
const ROUNDING_VARIANCE: f64 = 1.0 / 12.0;
/// Residuals above this share of the contrast are not an edge's.
const WORST_RESIDUAL: f64 = 0.35;
/// A corner with a larger variance (px², both axes) was not measured.
const UNKNOWN_PX2: f64 = 1.0;

/// Rounds in which the corners of a tag are measured that is seen in part.
const ROUNDS_IN_PART: usize = 2;
/// An edge that wobbles by more than its pixels' noise says, as a factor on the variance, is not a
/// tag's where nothing else says that there is one.
const WORST_WOBBLE: f64 = 6.0;
/// Nor is a corner that lies farther from where it should be, px.
const OFF_IN_PART_PX: f64 = 1.0;

/// What lies beside a tag's sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings {
    /// Cells along a side, border included.
    pub cells: f64,
    /// Cells from a side to the next edge on either side: of the bits within, of what is around.
    pub clear: f64,
    /// How far the lens moves the middle of each side outwards from the line between its corners, px.
    pub bows: [f64; 4],
}

type Parameters = SVector<f64, 6>;
type Normal = SMatrix<f64, 6, 6>;

/// An edge: `n·(p - middle) = ρ` with the normal `n` at `angle`, and the covariance of `ρ, θ`.
struct Line {
    middle: Vector2<f64>,
    angle: f64,
    covariance: Matrix2<f64>,
    wobble: Wobble,
    at: Parameters,
}

/// How far the pieces of an edge lie off its line, in their own variances.
#[derive(Clone, Copy, Default)]
struct Wobble {
    squares: f64,
    freedom: f64,
}

/// The corners after one round: good enough to start from.
pub(super) fn approached(image: &GrayImage, start: &Quad, around: &Surroundings) -> Option<Quad> {
    Some(refined(image, start, around, 1)?.map(|corner| corner.pixel))
}

/// The corners from the edges of all sides, their ids 0 to 3 as in `start`. In every round the band
/// follows the edges, and their blur.
pub(super) fn refined(
    image: &GrayImage,
    start: &Quad,
    around: &Surroundings,
    rounds: usize,
) -> Option<[ImageCorner; 4]> {
    let mut quad = *start;
    let mut found = None;
    let mut shapes: [Option<Parameters>; 4] = [None; 4];
    let mut blur_px = USUAL_BLUR_PX;
    for _ in 0..rounds {
        let one = |k: usize| {
            let place = Place::new(&quad, k, around, blur_px);
            side(image, &place, shapes[k])
        };
        let mut sides = [one(0)?, one(1)?, one(2)?, one(3)?];
        let wobble = wobble(&sides);
        sides.iter_mut().for_each(|side| side.covariance *= wobble);
        let met = |k: usize| meet(k as u32, &sides[(k + 3) % 4], &sides[k]);
        let corners = [met(0)?, met(1)?, met(2)?, met(3)?];
        quad = corners.each_ref().map(|corner| corner.pixel);
        shapes = sides.each_ref().map(|side| Some(side.at));
        blur_px = sides.iter().map(|side| side.at[4].exp()).sum::<f64>() / 4.0;
        found = Some(corners);
    }
    let corners = found?;
    let size = Vector2::new(image.width() as f64 - 1.0, image.height() as f64 - 1.0);
    let inside = |p: &Vector2<f64>| p.x > 0.0 && p.y > 0.0 && p.x < size.x && p.y < size.y;
    let moved = |k: usize| (quad[k] - start[k]).norm();
    let near = |k: usize| inside(&quad[k]) && moved(k) < 2.0 + 0.1 * area(start).sqrt();
    let known = |c: &ImageCorner| c.covariance.trace() < UNKNOWN_PX2;
    ((0..4).all(near) && corners.iter().all(known)).then_some(corners)
}

/// The corners whose two sides are where `start` has them, of a tag of which a part may be hidden or
/// too bright. Nothing else says that there is a tag: each side must look like an edge, and lie where
/// it should.
pub(super) fn seen_in_part(
    image: &GrayImage,
    start: &Quad,
    around: &Surroundings,
) -> [Option<ImageCorner>; 4] {
    let mut quad = *start;
    let mut corners = [None; 4];
    let mut blur_px = USUAL_BLUR_PX;
    for _ in 0..ROUNDS_IN_PART {
        let one = |k: usize| {
            let mut line = side(image, &Place::new(&quad, k, around, blur_px), None)?;
            let wobble = (line.wobble.squares / line.wobble.freedom.max(1.0)).max(1.0);
            line.covariance *= wobble;
            (wobble < WORST_WOBBLE).then_some(line)
        };
        let sides = [one(0), one(1), one(2), one(3)];
        let met = |k: usize| {
            let (a, b) = (sides[(k + 3) % 4].as_ref()?, sides[k].as_ref()?);
            let corner = meet(k as u32, a, b)?;
            let near = (corner.pixel - start[k]).norm() < OFF_IN_PART_PX;
            (near && corner.covariance.trace() < UNKNOWN_PX2).then_some(corner)
        };
        corners = [met(0), met(1), met(2), met(3)];
        quad = std::array::from_fn(|k| corners[k].map_or(start[k], |corner| corner.pixel));
        let blurs = || sides.iter().flatten().map(|side| side.at[4].exp());
        blur_px = blurs().sum::<f64>() / blurs().count().max(1) as f64;
        if corners.iter().all(Option::is_none) {
            break;
        }
    }
    let size = Vector2::new(image.width() as f64 - 1.0, image.height() as f64 - 1.0);
    let inside = |p: &Vector2<f64>| p.x > 0.0 && p.y > 0.0 && p.x < size.x && p.y < size.y;
    corners.map(|corner| corner.filter(|c| inside(&c.pixel)))
}

/// By how much larger the lines' covariances are than their pixels' noise says: light, print, paper
/// and lens bend edges over many pixels. All four sides share it, at least 1.
fn wobble(sides: &[Line]) -> f64 {
    let squares: f64 = sides.iter().map(|side| side.wobble.squares).sum();
    let freedom: f64 = sides.iter().map(|side| side.wobble.freedom).sum();
    (squares / freedom.max(1.0)).max(1.0)
}

/// Where two lines meet: `N c = ρ + N m`, and `dc = N⁻¹ (dρᵢ - tᵢ·(c - mᵢ) dθᵢ)`.
fn meet(id: u32, a: &Line, b: &Line) -> Option<ImageCorner> {
    let normal = |l: &Line| Vector2::new(l.angle.cos(), l.angle.sin());
    let (n_a, n_b) = (normal(a), normal(b));
    let n = Matrix2::from_rows(&[n_a.transpose(), n_b.transpose()]).try_inverse()?;
    let pixel = n * Vector2::new(a.at[0] + n_a.dot(&a.middle), b.at[0] + n_b.dot(&b.middle));
    let variance = |l: &Line| {
        let tangent = Vector2::new(-l.angle.sin(), l.angle.cos());
        let j = Vector2::new(1.0, -tangent.dot(&(pixel - l.middle)));
        j.dot(&(l.covariance * j))
    };
    let covariance =
        n * Matrix2::from_diagonal(&Vector2::new(variance(a), variance(b))) * n.transpose();
    let finite = pixel.iter().chain(covariance.iter()).all(|x| x.is_finite());
    finite.then_some(ImageCorner { id, pixel, covariance })
}

/// The edge of a side. `shape` is what an earlier round found.
fn side(image: &GrayImage, place: &Place, shape: Option<Parameters>) -> Option<Line> {
    let band = Band::gather(image, place)?;
    let start = shape.map_or_else(|| band.start(), moved_back);
    let (at, normal, cost) = band.descend(start)?;
    let freedom = band.count as f64 - 6.0;
    let variance = (cost / freedom).max(ROUNDING_VARIANCE);
    let inverse = normal.cholesky()?.inverse() * variance;
    let sound = variance.sqrt() < WORST_RESIDUAL * at[3].abs() && at[3] > 0.0;
    sound.then(|| Line {
        middle: place.middle,
        angle: place.outwards.y.atan2(place.outwards.x) + at[1],
        covariance: inverse.fixed_view::<2, 2>(0, 0).into_owned(),
        wobble: band.wobble(&at, variance, place.half),
        at,
    })
}

/// The same greys and blur, with the edge in the middle.
fn moved_back(mut at: Parameters) -> Parameters {
    (at[0], at[1]) = (0.0, 0.0);
    at
}

/// A band of pixels around one side.
struct Place {
    middle: Vector2<f64>,
    outwards: Vector2<f64>,
    /// How far the lens moves the middle outwards, px, and how that fades along the side, 1/px.
    bow: f64,
    bend: f64,
    /// Half the band's length along the side and half its width across, px.
    half: f64,
    width: f64,
}

impl Place {
    /// From corner `k` to the next one.
    fn new(quad: &Quad, k: usize, around: &Surroundings, blur_px: f64) -> Self {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| quad[(k + i) % 4]);
        let (length, along) = ((b - a).norm(), (b - a).normalize());
        let outwards = Vector2::new(along.y, -along.x);
        let across = outwards.dot(&(a - (c + d) * 0.5));
        let (cell, free) = (length / around.cells, around.clear * across / around.cells);
        let clear = CLEAR_BLURS * blur_px;
        let width = (free - clear).max(LEAST_BLURS * blur_px).min(BAND_SHARE * free);
        Self {
            middle: (a + b) * 0.5,
            outwards,
            bow: around.bows[k],
            bend: around.bows[k] / (0.5 * length).powi(2),
            half: (0.5 * length - (END_CELLS * cell + END_PX).max(clear)).max(0.0),
            width: width.clamp(BAND_PX.0, BAND_PX.1),
        }
    }

    /// Along the side and outwards from it, the bow taken off.
    fn straightened(&self, d: &Vector2<f64>) -> (f64, f64) {
        let (u, v) = (self.along().dot(d), self.outwards.dot(d));
        (u, v - self.bow + self.bend * u * u)
    }

    fn along(&self) -> Vector2<f64> {
        Vector2::new(-self.outwards.y, self.outwards.x)
    }

    /// First and last `x - middle.x` of the band in a row.
    fn columns(&self, dy: f64) -> (f64, f64) {
        let within = |n: &Vector2<f64>, most: f64| {
            if n.x.abs() < 1e-9 {
                let inside = (n.y * dy).abs() <= most;
                return if inside { (f64::NEG_INFINITY, f64::INFINITY) } else { (0.0, -1.0) };
            }
            let (a, b) = ((-most - n.y * dy) / n.x, (most - n.y * dy) / n.x);
            (a.min(b), a.max(b))
        };
        let (a, b) = (within(&self.along(), self.half), within(&self.outwards, self.width));
        (a.0.max(b.0), a.1.min(b.1))
    }
}

/// Pixels that are computed at once.
const LANES: usize = 8;
type Lane = [f32; LANES];

/// Along the side, outwards, and grey; a weight of 0 fills up the last ones.
#[derive(Clone, Copy, Default)]
struct Pixels {
    u: Lane,
    v: Lane,
    grey: Lane,
    weight: Lane,
}

struct Band {
    pixels: Vec<Pixels>,
    count: usize,
}

impl Band {
    fn gather(image: &GrayImage, place: &Place) -> Option<Self> {
        let middle = place.middle;
        let reach = place.along().y.abs() * place.half + place.outwards.y.abs() * place.width;
        let rows = range(middle.y, (-reach, reach), image.height());
        let mut band = Self { pixels: vec![], count: 0 };
        for y in rows {
            let dy = y as f64 - middle.y;
            for x in range(middle.x, place.columns(dy), image.width()) {
                let at = place.straightened(&Vector2::new(x as f64 - middle.x, dy));
                band.push(at, image.at(x, y));
            }
        }
        (band.count >= FEWEST_PIXELS).then_some(band)
    }

    fn push(&mut self, (u, v): (f64, f64), grey: f32) {
        let k = self.count % LANES;
        if k == 0 {
            self.pixels.push(Pixels::default());
        }
        if let Some(last) = self.pixels.last_mut() {
            (last.u[k], last.v[k]) = (u as f32, v as f32);
            (last.grey[k], last.weight[k]) = (grey, 1.0);
        }
        self.count += 1;
    }

    /// `ρ θ a b ln(s) g`: the edge in the middle, greys by the means of its two sides.
    fn start(&self) -> Parameters {
        let mut sums = [(0.0, 0.0); 2];
        for k in 0..self.count {
            let (p, k) = (&self.pixels[k / LANES], k % LANES);
            let (sum, count) = &mut sums[usize::from(p.v[k] > 0.0)];
            (*sum, *count) = (*sum + f64::from(p.grey[k]), *count + 1.0);
        }
        let [inner, outer] = sums.map(|(sum, count)| sum / f64::max(count, 1.0));
        Parameters::from([0.0, 0.0, 0.5 * (inner + outer), 0.6 * (outer - inner), 0.0, 0.0])
    }

    fn descend(&self, start: Parameters) -> Option<(Parameters, Normal, f64)> {
        let mut at = start;
        let (mut normal, mut gradient, mut cost) = self.linearise(&at);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let mut damped = normal;
            (0..6).for_each(|k| damped[(k, k)] *= 1.0 + damping);
            let step = damped.cholesky()?.solve(&gradient);
            let mut next = at + step;
            next[4] = next[4].clamp(BLUR_PX.0.ln(), BLUR_PX.1.ln());
            let (n, g, c) = self.linearise(&next);
            if c.is_finite() && c <= cost {
                (at, normal, gradient, cost) = (next, n, g, c);
                damping *= 0.1;
                if step[0].abs() < STEP_PX {
                    break;
                }
            } else if damping > 1e6 {
                break; // rounding: no step makes it better
            } else {
                damping *= 10.0;
            }
        }
        cost.is_finite().then_some((at, normal, cost))
    }

    /// Each piece's own offset `Σ jr / Σ j²` from the fitted line, squared, over its variance
    /// `σ² / Σ j²`, with `j = ∂I/∂ρ`. The line has taken two of them.
    fn wobble(&self, at: &Parameters, variance: f64, half: f64) -> Wobble {
        let mut sums = [(0.0, 0.0); PIECES];
        let model = Model::new(at);
        for pixels in &self.pixels {
            let rows = model.rows(pixels);
            for k in 0..LANES {
                let share = 0.5 * (1.0 + f64::from(pixels.u[k]) / half);
                let (jr, jj) = &mut sums[((PIECES as f64 * share) as usize).min(PIECES - 1)];
                let (j, r) = (f64::from(rows[0][k]), f64::from(rows[6][k]));
                (*jr, *jj) = (*jr + j * r, *jj + j * j);
            }
        }
        let seen = || sums.iter().filter(|(_, jj)| *jj > 0.0);
        Wobble {
            squares: seen().map(|(jr, jj)| jr * jr / (jj * variance)).sum(),
            freedom: (seen().count() as f64 - 2.0).max(0.0),
        }
    }

    /// `JᵀJ`, `Jᵀr` and `rᵀr` of `r = I - model`.
    fn linearise(&self, at: &Parameters) -> (Normal, Parameters, f64) {
        let model = Model::new(at);
        let mut products = [[0.0; LANES]; PRODUCTS];
        for pixels in &self.pixels {
            accumulate(&mut products, &model.rows(pixels));
        }
        let sums = products.map(|lane| lane.iter().map(|v| f64::from(*v)).sum::<f64>());
        let at = |m: usize, n: usize| sums[place(m.min(n), m.max(n))];
        (Normal::from_fn(at), Parameters::from_fn(|m, _| at(m, 6)), at(6, 6))
    }
}

/// Pixels of a row or column of `size` from `centre + low` to `centre + high`.
fn range(centre: f64, (low, high): (f64, f64), size: usize) -> std::ops::Range<usize> {
    let first = (centre + low).ceil().max(0.0) as usize;
    let beyond = ((centre + high).floor() + 1.0).max(0.0) as usize;
    first..beyond.min(size)
}

/// Derivatives by the six parameters, and the residual.
type Rows = [Lane; 7];
/// Products of two of them.
const PRODUCTS: usize = 28;

/// Where the product of rows `m <= n` is kept.
const fn place(m: usize, n: usize) -> usize {
    m * 7 - m * (m + 1) / 2 + n
}

/// Adds the products of all pairs of rows.
#[inline]
fn accumulate(products: &mut [Lane; PRODUCTS], rows: &Rows) {
    let mut next = 0;
    for m in 0..7 {
        for n in m..7 {
            for k in 0..LANES {
                products[next][k] += rows[m][k] * rows[n][k];
            }
            next += 1;
        }
    }
}

/// The model at one set of parameters: `ρ θ a b ln(s) g`.
struct Model {
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
    fn new(at: &Parameters) -> Self {
        let [rho, theta, a, b, ln_s, g] = (*at).into();
        let scale = ((-ln_s).exp() * FRAC_1_SQRT_2) as f32;
        let [rho, a, b, g, sine, cosine] =
            [rho, a, b, g, theta.sin(), theta.cos()].map(|x: f64| x as f32);
        Self { rho, sine, cosine, a, b, g, scale }
    }

    /// Derivatives and residual at pixels; `d = v cos θ + u sin θ - ρ`.
    #[inline]
    fn rows(&self, pixels: &Pixels) -> Rows {
        let mut rows = [[0.0; LANES]; 7];
        for k in 0..LANES {
            let (u, v, weight) = (pixels.u[k], pixels.v[k], pixels.weight[k]);
            let d = v * self.cosine + u * self.sine - self.rho;
            let (value, slope) = erf(d * self.scale);
            let by_d = weight * self.b * slope * self.scale;
            rows[0][k] = -by_d;
            rows[1][k] = by_d * (u * self.cosine - v * self.sine);
            rows[2][k] = weight;
            rows[3][k] = weight * value;
            rows[4][k] = -by_d * d;
            rows[5][k] = weight * u;
            rows[6][k] = weight * (pixels.grey[k] - (self.a + self.g * u + self.b * value));
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
            let rows = Model::new(&at).rows(&pixel);
            let value = |at: &Parameters| -f64::from(Model::new(at).rows(&pixel)[6][0]);
            for k in 0..6 {
                let mut step = Parameters::zeros();
                step[k] = 1e-2;
                let numeric = (value(&(at + step)) - value(&(at - step))) / 2e-2;
                let analytic = f64::from(rows[k][0]);
                assert!((numeric - analytic).abs() < 3e-3 * (3.0 + numeric.abs()), "{k}");
            }
        }
    }

    #[test]
    fn products_of_rows_have_a_place_each() {
        let all: Vec<usize> = (0..7).flat_map(|m| (m..7).map(move |n| place(m, n))).collect();
        assert_eq!(all, (0..PRODUCTS).collect::<Vec<_>>());
    }

    #[test]
    fn a_band_holds_the_pixels_near_its_side_and_no_others() {
        let image = GrayImage::new(60, 50, vec![9.0; 3000]).unwrap();
        for turn in 0..12 {
            let (y, x) = (f64::from(turn) * std::f64::consts::FRAC_PI_6).sin_cos();
            let (middle, outwards) = (Vector2::new(29.3, 24.8), Vector2::new(x, y));
            let (half, width) = (12.41, 3.31);
            let place = Place { middle, outwards, bow: 0.0, bend: 0.0, half, width };
            let inside = |k: usize| {
                let d = Vector2::new((k % 60) as f64, (k / 60) as f64) - middle;
                place.along().dot(&d).abs() <= half && outwards.dot(&d).abs() <= width
            };
            let band = Band::gather(&image, &place).unwrap();
            assert_eq!(band.count, (0..3000).filter(|&k| inside(k)).count(), "{turn}");
        }
    }
}
