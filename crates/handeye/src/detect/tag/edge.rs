//! The edge of one side of a tag, blurred by a Gaussian of width `s`, in light that changes linearly
//! along it:
//!
//! ```text
//! I(p) = a + g u + b erf(d/(√2 s)),    d = n(θ)·(p - m) - ρ
//! ```
//!
//! with `u` along the side and `m` its middle. `ρ, θ, a, b, ln s, g` are fitted by
//! Levenberg-Marquardt. Where it is known how a lens bends the sides, that is taken off first.

mod model;

use nalgebra::{Matrix2, Vector2};

use super::quads::Quad;
use crate::{
    GrayImage,
    detect::{
        levenberg::{Bounded, Descent, Linearised, descend},
        saturated::is_saturated,
    },
    math::gram::place,
};
pub(super) use model::Parameters;
use model::{LANES, Model, Pixels, products};

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
/// A fit has converged when the edge moves less than this, px: the next step, were it taken, would
/// be some hundred times smaller.
const STEP_PX: f64 = 1e-3;
/// Fewer pixels do not determine six parameters.
const FEWEST_PIXELS: usize = 16;
/// Pieces of a side whose offsets tell how straight it is.
const PIECES: usize = 8;
/// Blurs stay in this range, px.
const BLUR_PX: (f64, f64) = (0.29, 4.0);
/// Residuals above this share of the contrast are not an edge's.
const WORST_RESIDUAL: f64 = 0.35;

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

/// Whether the blur of a tag's sides reaches that of the edges beside them.
pub(super) fn is_crowded(quad: &Quad, around: &Surroundings, blur_px: f64) -> bool {
    (0..4).any(|k| free_px(quad, k, around) < (CLEAR_BLURS + LEAST_BLURS) * blur_px)
}

/// Whether the largest blur that can be measured leaves the sides of a tag alone.
pub(super) fn is_roomy(cell_px: f64) -> bool {
    cell_px > (CLEAR_BLURS + LEAST_BLURS) * BLUR_PX.1
}

/// From a side to the edges beside it, px.
fn free_px(quad: &Quad, k: usize, around: &Surroundings) -> f64 {
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| quad[(k + i) % 4]);
    let along = (b - a).normalize();
    let across = Vector2::new(along.y, -along.x).dot(&(a - (c + d) * 0.5));
    around.clear * across / around.cells
}

/// An edge: `n·(p - middle) = ρ` with the normal `n` at `angle`, and the covariance of `ρ, θ`.
pub(super) struct Line {
    pub middle: Vector2<f64>,
    pub angle: f64,
    pub covariance: Matrix2<f64>,
    pub wobble: Wobble,
    pub at: Parameters,
}

/// How far the pieces of an edge lie off its line, in their own variances.
#[derive(Clone, Copy)]
pub(super) struct Wobble {
    pub squares: f64,
    pub freedom: f64,
}

/// The edge of a side. `shape` is what an earlier round found.
pub(super) fn side(image: &GrayImage, place: &Place, shape: Option<Parameters>) -> Option<Line> {
    let band = Band::gather(image, place)?;
    let start = shape.map_or_else(|| band.start(), moved_back);
    let Descent { at, there, .. } = band.descend(start)?;
    let variance = there.variance().filter(|_| there.count >= FEWEST_PIXELS as f64)?;
    let inverse = there.covariance(variance)?;
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
pub(super) struct Place {
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
    pub fn new(quad: &Quad, k: usize, around: &Surroundings, blur_px: f64) -> Self {
        let (a, b) = (quad[k], quad[(k + 1) % 4]);
        let (length, along) = ((b - a).norm(), (b - a).normalize());
        let outwards = Vector2::new(along.y, -along.x);
        let (cell, free) = (length / around.cells, free_px(quad, k, around));
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

    /// Unit vector along the side.
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

struct Band {
    pixels: Vec<Pixels>,
    count: usize,
    /// Whether some pixels are as bright or as dark as can be.
    saturated: bool,
}

impl Band {
    fn gather(image: &GrayImage, place: &Place) -> Option<Self> {
        let middle = place.middle;
        let reach = place.along().y.abs() * place.half + place.outwards.y.abs() * place.width;
        let rows = range(middle.y, (-reach, reach), image.height());
        let mut band = Self { pixels: vec![], count: 0, saturated: false };
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
        self.saturated |= is_saturated(grey);
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

    fn descend(&self, start: Parameters) -> Option<Descent<6>> {
        let bounded = Bounded::blur(4, BLUR_PX);
        descend(start, |at| Some(self.linearise(at)), &bounded, |step| step[0].abs() < STEP_PX)
    }

    /// Each piece's own offset `Σ jr / Σ j²` from the fitted line, squared, over its variance
    /// `σ² / Σ j²`, with `j = ∂I/∂ρ`. The line has taken two of them.
    fn wobble(&self, at: &Parameters, variance: f64, half: f64) -> Wobble {
        let mut sums = [(0.0, 0.0); PIECES];
        let model = Model::new(at);
        for pixels in &self.pixels {
            let rows = model.rows::<false>(pixels);
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

    fn linearise(&self, at: &Parameters) -> Linearised<6> {
        let products = products(&Model::new(at), &self.pixels, self.saturated);
        let sums = products.map(|lane| lane.iter().map(|v| f64::from(*v)).sum::<f64>());
        let product = |m: usize, n: usize| sums[place::<7>(m, n)];
        Linearised::of(product, product(2, 2)) // `∂I/∂a` of a pixel is its weight
    }
}

/// Pixels of a row or column of `size` from `centre + low` to `centre + high`.
fn range(centre: f64, (low, high): (f64, f64), size: usize) -> std::ops::Range<usize> {
    let first = (centre + low).ceil().max(0.0) as usize;
    let beyond = ((centre + high).floor() + 1.0).max(0.0) as usize;
    first..beyond.min(size)
}

#[cfg(test)]
mod tests {
    use super::*;

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
