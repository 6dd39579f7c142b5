//! A tag as a whole, where the blur of its sides reaches that of its bits.
//!
//! Cells count from the tag's top left, `u` along its upper side and `v` down its left one. A lens
//! that blurs with a Gaussian of width `s` sees edges `u = i` as wide as `σ = s |∇u|`, so that white
//! less black is
//!
//! ```text
//! T(u, v) = 1 - 2 Σ A_i(u) A_j(v)  over black cells i, j
//! A_i(u) = (erf((u - i)/(√2 σ)) - erf((u - i - 1)/(√2 σ))) / 2
//! I(p) = a + b T + g·(p - m)
//! ```
//!
//! which is exact along edges. Where edges meet that are not at right angles in the image, so that `u` and
//! `v` are blurred with the correlation `ρ = ∇u·∇v / (|∇u||∇v|)`, the share of a cell is, by Mehler's
//! expansion of the bivariate normal distribution with `φ` the normal density,
//!
//! ```text
//! A_i A_j + Σ ρ^k/k! D_i D_j,    D_i = φ^(k-1)((u - i)/σ) - φ^(k-1)((u - i - 1)/σ),    k = 1, 2, 3
//! ```
//!
//! The four corners, `a, b, ln s, g` are fitted to
//! the pixels in and around the tag by Levenberg-Marquardt. With the homography from the unit square in
//! which a pixel is at `(x, y)`, a corner at `c` that moves by `ε J c` moves the image there by
//! `ε [w, ±x(1-x); ±y(1-y), w] J c`, `w` being its bilinear weight and the sign that of two corners on a
//! diagonal.

use std::f32::consts::{FRAC_1_SQRT_2, SQRT_2};

use multiversion::multiversion;
use nalgebra::{Matrix2, Matrix3, RowVector2, SVector, Vector2};

use super::{
    quads::{Quad, area},
    sides::is_inside,
};
use crate::{
    GrayImage, ImageCorner,
    detect::{
        erf::erf,
        homography,
        levenberg::{Bounded, Descent, Linearised, descend},
        saturated::share_within,
    },
};

/// Lines between cells along a side, at most, and room for more.
pub(super) const LINES: usize = 16;
type Lines = [f32; LINES];
/// Derivatives and residual of a pixel, and room for more.
const ROW: usize = 16;
type Row = [f64; ROW];
/// Corners, `a b ln(s) gx gy`.
const UNKNOWN: usize = 13;
type Parameters = SVector<f64, UNKNOWN>;
const BLUR: usize = 10;

/// Pixels are fitted this far around the tag, in cells, if nothing else begins before.
const AROUND: f64 = 1.0;
/// Blurs from there to what begins.
const CLEAR_BLURS: f64 = 2.5;
/// Most pixels of a tag: of a larger one every second is fitted, or fewer.
const MOST_PIXELS: f64 = 4000.0;
/// Fewer do not determine the parameters.
const FEWEST_PIXELS: usize = 60;
/// Blurs stay in this range, px.
const BLUR_PX: (f64, f64) = (0.29, 12.0);
/// The fit has converged when no corner moves farther than this along an axis, px.
const STEP_PX: f64 = 2e-3;
/// A corner that moves farther than this share of the tag's side has found another tag.
const FARTHEST: f64 = 0.1;
/// Residuals above this share of the contrast are not a tag's.
const WORST_RESIDUAL: f64 = 0.2;
/// The model's own error, px.
const MODEL_PX: f64 = 3e-3;
/// A corner with a larger variance (px², both axes) was not measured.
const UNKNOWN_PX2: f64 = 1.0;

/// What a tag looks like, and what is around it.
pub(super) struct Pattern {
    /// Cells along a side, border included.
    pub cells: usize,
    /// By row and column of cells: 1 where it is black, else 0.
    pub black: [Lines; LINES],
    /// White around the tag, in cells.
    pub white: f64,
}

/// The corners of a tag that is at `start` to some pixels; the lens bends its sides by `bows`.
pub(super) fn fit(
    image: &GrayImage,
    start: &Quad,
    pattern: &Pattern,
    bows: [f64; 4],
    blur_px: f64,
) -> Option<[ImageCorner; 4]> {
    let tag = Tag::gather(image, start, pattern, bows, blur_px)?;
    let bounded = Bounded::blur(BLUR, BLUR_PX);
    let short = |step: &Parameters| step.rows(0, 8).amax() < STEP_PX;
    let found = descend(tag.start(start, blur_px), |at| tag.linearise(at), &bounded, short)?;
    let corners = found.settled.then(|| tag.judge(start, &found)).flatten()?;
    corners.iter().all(|c| is_inside(image, &c.pixel)).then_some(corners)
}

struct Tag<'a> {
    pattern: &'a Pattern,
    bows: [f64; 4],
    middle: Vector2<f64>,
    /// Relative to the middle, and grey.
    pixels: Vec<(Vector2<f64>, f64)>,
}

impl<'a> Tag<'a> {
    fn gather(
        image: &GrayImage,
        quad: &Quad,
        pattern: &'a Pattern,
        bows: [f64; 4],
        blur_px: f64,
    ) -> Option<Self> {
        let cells = pattern.cells as f64;
        let (height, longest) = sizes(quad);
        let clear = pattern.white - CLEAR_BLURS * blur_px * cells / height;
        let margin = clear.clamp(0.0, AROUND) / cells;
        let into = homography::from_unit_square(quad).try_inverse()?;
        let (low, high) = bounds(image, quad, margin * longest)?;
        let count = (high - low).add_scalar(1.0).product();
        let every = ((count / MOST_PIXELS).sqrt().ceil() as usize).max(1);
        let middle = quad.iter().sum::<Vector2<f64>>() / 4.0;
        let mut pixels = vec![];
        for y in (low.y as usize..=high.y as usize).step_by(every) {
            for x in (low.x as usize..=high.x as usize).step_by(every) {
                let p = Vector2::new(x as f64, y as f64);
                let at = homography::apply(&into, &p);
                if at.iter().all(|t| (-margin..=1.0 + margin).contains(t)) {
                    pixels.push((p - middle, f64::from(image.at(x, y))));
                }
            }
        }
        (pixels.len() >= FEWEST_PIXELS).then_some(Self { pattern, bows, middle, pixels })
    }

    /// Greys by the brightest and the darkest pixels.
    fn start(&self, quad: &Quad, blur_px: f64) -> Parameters {
        let fold = |f: fn(f64, f64) -> f64, from| self.pixels.iter().map(|p| p.1).fold(from, f);
        let (dark, bright) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
        let mut at = Parameters::zeros();
        for (k, corner) in quad.iter().enumerate() {
            at.fixed_rows_mut::<2>(2 * k).copy_from(corner);
        }
        (at[8], at[9], at[BLUR]) = (0.5 * (dark + bright), 0.5 * (bright - dark), blur_px.ln());
        at
    }

    fn linearise(&self, at: &Parameters) -> Option<Linearised<UNKNOWN>> {
        let view = self.view(at)?;
        let sums = products(&view, self);
        // `∂I/∂a` of a pixel is its weight
        let there = Linearised::of(|m, n| sums[m][n], sums[8][8]);
        there.cost.is_finite().then_some(there)
    }

    fn view(&self, at: &Parameters) -> Option<View> {
        let quad: Quad = std::array::from_fn(|k| at.fixed_rows::<2>(2 * k).into_owned());
        let into = homography::from_unit_square(&quad).try_inverse()?;
        let bow = |k: usize| {
            let along = (quad[(k + 1) % 4] - quad[k]).normalize();
            Vector2::new(along.y, -along.x) * (4.0 * self.bows[k])
        };
        let view = View {
            into,
            corners: [Matrix2::zeros(); 4],
            bows: [bow(0), bow(1), bow(2), bow(3)],
            shape: std::array::from_fn(|k| at[8 + k]),
        };
        Some(View { corners: quad.map(|corner| view.straight(&corner).1), ..view })
    }

    fn judge(&self, start: &Quad, found: &Descent<UNKNOWN>) -> Option<[ImageCorner; 4]> {
        let at = &found.at;
        let variance = found.there.variance()?;
        let sound = at[9] > 0.0
            && variance.sqrt() < WORST_RESIDUAL * at[9]
            && found.there.count >= FEWEST_PIXELS as f64
            && at[BLUR].exp() < 0.99 * BLUR_PX.1;
        let own = Matrix2::identity() * MODEL_PX.powi(2);
        let covariance = found.there.covariance(variance)?;
        let farthest = FARTHEST * area(start).sqrt();
        let corner = |k: usize| ImageCorner {
            id: k as u32,
            pixel: at.fixed_rows::<2>(2 * k).into_owned(),
            covariance: covariance.fixed_view::<2, 2>(2 * k, 2 * k) + own,
        };
        let corners = [corner(0), corner(1), corner(2), corner(3)];
        let near = |c: &ImageCorner| (c.pixel - start[c.id as usize]).norm() < farthest;
        let known = |c: &ImageCorner| c.covariance.trace() < UNKNOWN_PX2;
        (sound && corners.iter().all(|c| near(c) && known(c))).then_some(corners)
    }
}

/// A tag at one set of parameters.
struct View {
    /// From pixels to the unit square, and its derivatives at the corners.
    into: Matrix3<f64>,
    corners: [Matrix2<f64>; 4],
    /// Four times how far the middles of the sides are moved, px.
    bows: [Vector2<f64>; 4],
    /// `a b ln(s) gx gy`
    shape: [f64; 5],
}

impl View {
    /// Where a pixel is in the unit square, and the derivative of that: straight first, then with the
    /// lens' bows between the sides taken off.
    #[inline(always)]
    fn place(&self, pixel: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        let (at, _) = self.straight(pixel);
        let (x, y) = (at.x, at.y);
        let [top, right, bottom, left] = &self.bows;
        let across = (top * (1.0 - y) + bottom * y) * (x * (1.0 - x));
        let down = (right * x + left * (1.0 - x)) * (y * (1.0 - y));
        self.straight(&(pixel - across - down))
    }

    #[inline(always)]
    fn straight(&self, pixel: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        let h = &self.into;
        let row = |k: usize| h[(k, 0)] * pixel.x + h[(k, 1)] * pixel.y + h[(k, 2)];
        let scale = 1.0 / row(2);
        let at = Vector2::new(row(0) * scale, row(1) * scale);
        let slope = |k: usize, n: usize| (h[(k, n)] - at[k] * h[(2, n)]) * scale;
        (at, Matrix2::new(slope(0, 0), slope(0, 1), slope(1, 0), slope(1, 1)))
    }
}

/// Terms of Mehler's expansion.
const TERMS: usize = 3;

/// Columns, or rows, at one place: share of each, its derivatives by the place and by `ln σ`, and the
/// terms of Mehler's expansion.
struct Shares {
    value: Lines,
    slope: Lines,
    by_blur: Lines,
    terms: [Lines; TERMS],
}

#[inline(always)]
fn shares(at: f32, sigma: f32) -> Shares {
    let scale = FRAC_1_SQRT_2 / sigma;
    let (mut value, mut slope, mut by_blur) = ([0.0; LINES], [0.0; LINES], [0.0; LINES]);
    let mut terms = [[0.0; LINES]; TERMS];
    for i in 0..LINES {
        let z = (at - i as f32) * scale;
        let (e, de) = erf(z);
        (value[i], slope[i], by_blur[i]) = (0.5 * e, 0.5 * de * scale, -0.5 * de * z);
        let (x, density) = (z * SQRT_2, 0.5 * FRAC_1_SQRT_2 * de);
        (terms[0][i], terms[1][i], terms[2][i]) = (density, -x * density, (x * x - 1.0) * density);
    }
    for lines in [&mut value, &mut slope, &mut by_blur].into_iter().chain(&mut terms) {
        for i in 0..LINES - 1 {
            lines[i] -= lines[i + 1];
        }
        lines[LINES - 1] = 0.0;
    }
    Shares { value, slope, by_blur, terms }
}

/// `T`, and its derivatives by `u`, `v` and `ln s` but for Mehler's terms.
#[inline(always)]
fn seen(pattern: &Pattern, u: &Shares, v: &Shares, rho: f32) -> [f32; 4] {
    let (mut value, mut slope, mut by_blur) = ([0.0; LINES], [0.0; LINES], [0.0; LINES]);
    let factors = [rho, rho * rho / 2.0, rho * rho * rho / 6.0];
    let mut terms = [[0.0; LINES]; TERMS];
    for (j, row) in pattern.black.iter().enumerate().take(pattern.cells) {
        for i in 0..LINES {
            value[i] += row[i] * v.value[j];
            slope[i] += row[i] * v.slope[j];
            by_blur[i] += row[i] * v.by_blur[j];
        }
        for k in 0..TERMS {
            for i in 0..LINES {
                terms[k][i] += row[i] * v.terms[k][j];
            }
        }
    }
    let (mut t, mut tu, mut tv, mut ts) = (0.0, 0.0, 0.0, 0.0);
    for i in 0..LINES {
        t += u.value[i] * value[i];
        tu += u.slope[i] * value[i];
        tv += u.value[i] * slope[i];
        ts += u.by_blur[i] * value[i] + u.value[i] * by_blur[i];
        for k in 0..TERMS {
            t += factors[k] * u.terms[k][i] * terms[k][i];
        }
    }
    [1.0 - 2.0 * t, -2.0 * tu, -2.0 * tv, -2.0 * ts]
}

/// Derivatives and residual of a pixel.
#[inline(always)]
fn row(view: &View, tag: &Tag, d: &Vector2<f64>, grey: f64) -> Row {
    let cells = tag.pattern.cells as f64;
    let [a, b, ln_s, gx, gy] = view.shape;
    let blur = ln_s.exp();
    let (at, slope) = view.place(&(tag.middle + d));
    let (du, dv) = (slope.row(0) * cells, slope.row(1) * cells);
    let u = shares((at.x * cells) as f32, (du.norm() * blur) as f32);
    let v = shares((at.y * cells) as f32, (dv.norm() * blur) as f32);
    let rho = du.dot(&dv) / (du.norm() * dv.norm());
    let [t, tu, tv, ts] = seen(tag.pattern, &u, &v, rho as f32).map(f64::from);
    let model = a + b * t + gx * d.x + gy * d.y;
    let weight = f64::from(share_within(grey as f32, model as f32));
    // the image at a place loses what moves there from before it
    let flow = RowVector2::new(tu, tv) * (-b * cells);
    let (x, y) = (at.x, at.y);
    let weights = [(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y];
    let mut row = [0.0; ROW];
    for k in 0..4 {
        let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
        let (aside_x, aside_y) = (sign * x * (1.0 - x), sign * y * (1.0 - y));
        let moved = Matrix2::new(weights[k], aside_x, aside_y, weights[k]) * view.corners[k];
        let by = flow * moved;
        (row[2 * k], row[2 * k + 1]) = (by.x, by.y);
    }
    row[8..=UNKNOWN].copy_from_slice(&[1.0, t, b * ts, d.x, d.y, grey - model]);
    row.map(|value| value * weight)
}

/// Products of all pairs of derivatives and residuals, summed over the pixels.
#[multiversion(targets("x86_64+avx2"))]
fn products(view: &View, tag: &Tag) -> [Row; UNKNOWN + 1] {
    let mut sums = [[0.0; ROW]; UNKNOWN + 1];
    for (d, grey) in &tag.pixels {
        let row = row(view, tag, d, *grey);
        for m in 0..=UNKNOWN {
            for n in 0..ROW {
                sums[m][n] += row[m] * row[n];
            }
        }
    }
    sums
}

/// The least height of a quadrilateral over a side, and its longest side, px.
fn sizes(quad: &Quad) -> (f64, f64) {
    let side = |k: usize| (quad[(k + 1) % 4] - quad[k]).norm();
    let height = |k: usize| {
        let along = (quad[(k + 1) % 4] - quad[k]) / side(k);
        let far = |i: usize| along.perp(&(quad[(k + i) % 4] - quad[k]));
        far(2).min(far(3))
    };
    let fold = |f: fn(f64, f64) -> f64, of: &dyn Fn(usize) -> f64| (1..4).map(of).fold(of(0), f);
    (fold(f64::min, &height), fold(f64::max, &side))
}

/// First and last pixel of a quadrilateral and a margin, as far as it is in the image.
fn bounds(image: &GrayImage, quad: &Quad, margin: f64) -> Option<(Vector2<f64>, Vector2<f64>)> {
    let last = Vector2::new(image.width() as f64 - 1.0, image.height() as f64 - 1.0);
    let fold = |f: fn(f64, f64) -> f64| quad.iter().skip(1).fold(quad[0], |a, b| a.zip_map(b, f));
    let low = fold(f64::min).add_scalar(-margin).sup(&Vector2::zeros()).map(f64::ceil);
    let high = fold(f64::max).add_scalar(margin).inf(&last).map(f64::floor);
    (low.x <= high.x && low.y <= high.y).then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Intrinsics, Pose, TargetModel};
    use crate::{
        math::random::Random,
        simulate::{Optics, Scene},
    };
    use nalgebra::Isometry3;

    /// A tag of 6 cells with some bits.
    fn pattern() -> Pattern {
        let white = [(2, 2), (3, 1), (4, 4), (1, 3), (2, 3)];
        let black =
            |row: usize, column: usize| row < 6 && column < 6 && !white.contains(&(row, column));
        let line =
            |row: usize| std::array::from_fn(|column| f32::from(u8::from(black(row, column))));
        Pattern { cells: 6, black: std::array::from_fn(line), white: 2.0 }
    }

    fn at(u: f32, v: f32, (sigma_u, sigma_v): (f32, f32), rho: f32) -> [f32; 4] {
        seen(&pattern(), &shares(u, sigma_u), &shares(v, sigma_v), rho)
    }

    #[test]
    fn the_derivatives_are_those_of_the_picture() {
        for (u, v) in [(0.1, 0.3), (2.2, 2.9), (5.8, 6.1), (3.0, 1.4)] {
            let (sigma, step) = ((0.35f32, 0.25f32), 2e-2);
            let [_, tu, tv, ts] = at(u, v, sigma, 0.0);
            let slope = |a: [f32; 4], b: [f32; 4]| (a[0] - b[0]) / (2.0 * step);
            let by_u = slope(at(u + step, v, sigma, 0.0), at(u - step, v, sigma, 0.0));
            let by_v = slope(at(u, v + step, sigma, 0.0), at(u, v - step, sigma, 0.0));
            let wider = |k: f32| (sigma.0 * k.exp(), sigma.1 * k.exp());
            let by_s = slope(at(u, v, wider(step), 0.0), at(u, v, wider(-step), 0.0));
            for (analytic, numeric) in [(tu, by_u), (tv, by_v), (ts, by_s)] {
                assert!((analytic - numeric).abs() < 5e-3, "{u} {v}: {analytic} {numeric}");
            }
        }
    }

    #[test]
    fn oblique_edges_are_blurred_as_by_many_shifts() {
        let (sigma, rho) = ((0.3, 0.4), 0.6);
        let mut random = Random::new(3);
        let shifts: Vec<(f64, f64)> = (0..200_000)
            .map(|_| {
                let (a, b) = (random.normal(), random.normal());
                (a, rho * a + (1.0 - rho * rho).sqrt() * b)
            })
            .collect();
        for (u, v) in [(2.0, 2.0), (3.1, 1.2), (0.0, 6.0), (4.6, 4.3)] {
            let sharp = |u: f64, v: f64| {
                let (column, row) = (u.floor(), v.floor());
                let inside = (0.0..6.0).contains(&column) && (0.0..6.0).contains(&row);
                let black = inside && pattern().black[row as usize][column as usize] > 0.5;
                if black { -1.0 } else { 1.0 }
            };
            let sum: f64 =
                shifts.iter().map(|(a, b)| sharp(u + sigma.0 * a, v + sigma.1 * b)).sum();
            let mean = sum / shifts.len() as f64;
            let [t, ..] = at(u as f32, v as f32, (sigma.0 as f32, sigma.1 as f32), rho as f32);
            assert!((f64::from(t) - mean).abs() < 0.02, "{u} {v}: {t} {mean}");
        }
    }

    #[test]
    fn corners_and_light_move_the_picture_as_the_derivatives_say() {
        let quad = [(20.0, 22.0), (61.0, 15.0), (70.0, 66.0), (14.0, 58.0)];
        let quad = quad.map(|(x, y)| Vector2::new(x, y));
        let grey = |k: usize| (k * 37 % 90) as f32 + 80.0;
        let image = GrayImage::new(90, 90, (0..8100).map(grey).collect()).unwrap();
        let pattern = pattern();
        let tag = Tag::gather(&image, &quad, &pattern, [0.3, -0.2, 0.1, 0.4], 2.0).unwrap();
        let mut at = tag.start(&quad, 2.0);
        (at[8], at[9], at[11], at[12]) = (120.0, 70.0, 0.1, -0.2);
        let rows = |at: &Parameters| {
            let view = tag.view(at).unwrap();
            let of = |(d, grey): &(Vector2<f64>, f64)| row(&view, &tag, d, *grey);
            tag.pixels.iter().map(of).collect::<Vec<Row>>()
        };
        let analytic = rows(&at);
        for k in 0..UNKNOWN {
            let mut step = Parameters::zeros();
            step[k] = 5e-3;
            let (after, before) = (rows(&(at + step)), rows(&(at - step)));
            let (mut off, mut all) = (0.0, 0.0);
            for (row, (after, before)) in analytic.iter().zip(after.iter().zip(&before)) {
                let numeric = (before[UNKNOWN] - after[UNKNOWN]) / 1e-2;
                off += (row[k] - numeric).powi(2);
                all += numeric.powi(2);
            }
            // a corner that moves changes the size of cells, too, against which the blur is smaller or
            // larger, and the angle at which edges meet: that is left out
            let most = if k < 8 { 0.2 } else { 0.06 };
            let share = f64::sqrt(off / all);
            assert!(share < most, "{k}: off by {share:.3}");
        }
    }

    /// Root mean square of the corners' errors, px, and their mean square over their covariances.
    fn figures(optics: &Optics) -> (f64, f64) {
        let mut random = Random::new(8);
        let (mut normalised, mut squares, mut count) = (0.0, 0.0, 0.0);
        for k in 0..40 {
            let mut turn = || random.between(-0.7, 0.7);
            let (turn, id) = ([turn(), turn(), 4.0 * turn()], k as u32);
            let scene = Scene {
                target: TargetModel::Tag { dictionary: "DICT_5X5_100".into(), id, size_mm: 40.0 },
                camera_from_target: Pose::claim(Isometry3::new(
                    [0.0, 0.0, 0.4].into(),
                    turn.into(),
                )),
                intrinsics: Intrinsics::pinhole(320, 240, 600.0, 600.0, 159.5, 119.5),
            };
            let image = scene.picture(optics, k);
            let truth = scene.corners();
            let print = super::super::Print::new("DICT_5X5_100", 1, None, false).unwrap();
            let mut off = || random.between(-1.5, 1.5);
            let start = std::array::from_fn(|k| truth[k].1 + Vector2::new(off(), off()));
            let pattern = print.pattern(id).unwrap();
            let found = fit(&image, &start, &pattern, [0.0; 4], 2.0).unwrap();
            for (corner, (_, exact)) in found.iter().zip(&truth) {
                let e = corner.pixel - exact;
                normalised += e.dot(&(corner.covariance.try_inverse().unwrap() * e));
                squares += e.norm_squared();
                count += 2.0;
            }
        }
        (f64::sqrt(squares / count), normalised / count)
    }

    #[test]
    fn blurred_tags_have_corners_within_their_covariance() {
        let blurred = Optics { blur_px: 2.4, ..Optics::default() };
        let overexposed = Optics { white: 330.0, ..blurred };
        for (optics, most_px) in [(blurred, 0.03), (overexposed, 0.05)] {
            let (rms_px, mean) = figures(&optics);
            println!("white {}: {rms_px:.4} px, normalised {mean:.2}", optics.white);
            assert!((0.8..1.25).contains(&mean) && rms_px < most_px, "{mean} {rms_px}");
        }
    }
}
