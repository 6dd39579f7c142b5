//! A single ArUco or AprilTag marker: where its four corners are, and how sure that is.
//!
//! Pixels darker than their surroundings form patches; the convex hull of the tag's black border is
//! a quadrilateral, and the bits inside say whether it is the tag, and how it is turned. Each side
//! is then an edge blurred by a Gaussian of width `s`, in light that changes linearly along it:
//!
//! ```text
//! I(p) = a + g u + b erf(d/(√2 s)),    d = n(θ)·(p - m) - ρ
//! ```
//!
//! with `u` along the side and `m` its middle. `ρ, θ, a, b, ln s, g` are fitted by
//! Levenberg-Marquardt; neighbouring sides meet in the corners, which take over the lines'
//! covariances.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use super::board::NotFound;
use super::erf::erf;
use super::homography;
use super::markers::{self, Dictionary};
use super::pyramid::{smoothed, stretched};
use crate::{GrayImage, ImageCorner};

/// A quadrilateral, clockwise in the picture.
type Quad = [Vector2<f64>; 4];

/// A pixel is dark when it is this much darker than the mean around it, grey values.
const DARKER: f64 = 5.0;
/// Radii of the means, as shares of the picture's longer side: a small one for tags in shadow or
/// with little white around them, a large one for blurred ones.
const MEANS: [f64; 2] = [0.01, 0.04];
/// Least radius of a mean, px.
const LEAST_RADIUS: usize = 4;
/// A cell of the tag (border and bits) must be this large, px.
const LEAST_CELL_PX: f64 = 1.6;
/// Share of a hull that the largest quadrilateral in it must cover.
const LEAST_COVER: f64 = 0.9;
/// White minus black, grey values, below which nothing is read.
const LEAST_CONTRAST: f64 = 8.0;
/// Share of the bits, and of the border's cells, that may be read wrong.
const MOST_WRONG: f64 = 0.12;
/// A hull's outermost pixels lie inside the edge by this much, px.
const HALF_PIXEL: f64 = 0.5;

/// The corners of tag `id` (top left, top right, bottom right, bottom left as printed).
///
/// # Errors
/// Why it was not found.
pub fn detect(image: &GrayImage, name: &str, id: u32) -> Result<Vec<ImageCorner>, NotFound> {
    let dictionary =
        Dictionary::named(name).ok_or_else(|| NotFound::UnknownDictionary(name.into()))?;
    let clear = || stretched(&smoothed(image));
    let mut found = coarse(image, image, &dictionary, id);
    if found.is_none() {
        found = coarse(image, &clear(), &dictionary, id);
    }
    let quad = found.ok_or_else(|| NotFound::NoTag { dictionary: name.into(), id })?;
    let cells = dictionary.side() + 2;
    refined(image, quad, cells).ok_or(NotFound::BlurredTag { dictionary: name.into(), id })
}

/// The tag's quadrilateral to about a pixel, its printed top left first: the one read best, the
/// largest of equals. Dark patches are looked for in `clear`.
fn coarse(image: &GrayImage, clear: &GrayImage, dictionary: &Dictionary, id: u32) -> Option<Quad> {
    let longer = image.width().max(image.height()) as f64;
    let least = LEAST_CELL_PX * (dictionary.side() + 2) as f64;
    let radii = MEANS.map(|share| ((share * longer) as usize).max(LEAST_RADIUS));
    let quads = radii.iter().flat_map(|&radius| {
        let hulls = patches(&dark(clear, radius), image.width(), least);
        hulls.into_iter().filter_map(|hull| quadrilateral(&hull, least))
    });
    let read = quads.filter_map(|quad| read(image, &quad, dictionary, id));
    let best = read.min_by(|(e1, q1), (e2, q2)| e1.cmp(e2).then(area(q2).total_cmp(&area(q1))));
    best.map(|(_, quad)| quad)
}

/// Wrong bits, and the quadrilateral turned so that the tag's top left is first.
fn read(image: &GrayImage, quad: &Quad, dictionary: &Dictionary, id: u32) -> Option<(u32, Quad)> {
    let side = dictionary.side();
    let h = homography::from_unit_square(quad);
    let at = |x: f64, y: f64| homography::apply(&h, &Vector2::new(x, y));
    let cells = markers::read_cells(image, (side, 1), at)?;
    let most = |cells: usize| (MOST_WRONG * cells as f64) as u32;
    if cells.contrast < LEAST_CONTRAST || cells.border_errors > most(4 * (side + 1)) {
        return None;
    }
    let reading = dictionary.read(cells.code, [id], most(side * side))?;
    let turned = std::array::from_fn(|k| quad[(k + reading.turns) % 4]);
    Some((reading.errors + cells.border_errors, turned))
}

// ---------------------------------------------------------------- dark patches

/// Which pixels are darker than the mean of the square around them.
fn dark(image: &GrayImage, radius: usize) -> Vec<bool> {
    let (width, height) = (image.width(), image.height());
    let sums = integral(image);
    let sum = |x0: usize, y0: usize, x1: usize, y1: usize| {
        let at = |x: usize, y: usize| sums[y * (width + 1) + x];
        at(x1, y1) + at(x0, y0) - at(x1, y0) - at(x0, y1)
    };
    let mut out = Vec::with_capacity(width * height);
    for y in 0..height {
        let (y0, y1) = (y.saturating_sub(radius), (y + radius + 1).min(height));
        for x in 0..width {
            let (x0, x1) = (x.saturating_sub(radius), (x + radius + 1).min(width));
            let mean = sum(x0, y0, x1, y1) / ((x1 - x0) * (y1 - y0)) as f64;
            out.push(f64::from(image.at(x, y)) < mean - DARKER);
        }
    }
    out
}

/// Sums over all pixels above and left, one row and column more than the picture.
fn integral(image: &GrayImage) -> Vec<f64> {
    let (width, height) = (image.width(), image.height());
    let mut sums = vec![0.0; (width + 1) * (height + 1)];
    for y in 0..height {
        let mut row = 0.0;
        for x in 0..width {
            row += f64::from(image.at(x, y));
            sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + row;
        }
    }
    sums
}

/// Hulls of the connected dark patches at least `least` px wide and high that do not touch the
/// picture's edge.
fn patches(dark: &[bool], width: usize, least: f64) -> Vec<Vec<Vector2<f64>>> {
    let height = dark.len() / width;
    let mut open = dark.to_vec();
    let mut hulls = Vec::new();
    for start in 0..dark.len() {
        if !open[start] {
            continue;
        }
        let rows = flood(&mut open, width, start);
        let left = rows.iter().map(|r| r.1).min().unwrap_or(0);
        let right = rows.iter().map(|r| r.2).max().unwrap_or(0);
        let (top, bottom) = (rows[0].0, rows[rows.len() - 1].0);
        let inside = left > 0 && top > 0 && right + 1 < width && bottom + 1 < height;
        if inside && ((right - left).min(bottom - top) as f64) > 0.5 * least {
            hulls.push(hull(&rows));
        }
    }
    hulls
}

/// Clears one patch; its rows with their first and last pixel.
fn flood(open: &mut [bool], width: usize, start: usize) -> Vec<(usize, usize, usize)> {
    let mut rows = std::collections::BTreeMap::<usize, (usize, usize)>::new();
    let mut waiting = vec![start];
    open[start] = false;
    while let Some(at) = waiting.pop() {
        let (x, y) = (at % width, at / width);
        let row = rows.entry(y).or_insert((x, x));
        *row = (row.0.min(x), row.1.max(x));
        let beside = [
            (x > 0).then(|| at - 1),
            (x + 1 < width).then_some(at + 1),
            at.checked_sub(width),
            Some(at + width).filter(|&below| below < open.len()),
        ];
        for next in beside.into_iter().flatten() {
            if open[next] {
                open[next] = false;
                waiting.push(next);
            }
        }
    }
    rows.into_iter().map(|(y, (left, right))| (y, left, right)).collect()
}

/// Convex hull, clockwise in the picture (A. Andrew, *Another efficient algorithm for convex hulls
/// in two dimensions*, 1979).
fn hull(rows: &[(usize, usize, usize)]) -> Vec<Vector2<f64>> {
    let ends = |&(y, left, right): &(usize, usize, usize)| {
        [left, right].map(|x| Vector2::new(x as f64, y as f64))
    };
    let points: Vec<Vector2<f64>> = rows.iter().flat_map(ends).collect();
    let mut whole = half_hull(points.iter().copied());
    whole.extend(half_hull(points.iter().rev().copied()));
    whole
}

/// The hull of points sorted by rows, down its right side; the last point is left out.
fn half_hull(points: impl Iterator<Item = Vector2<f64>>) -> Vec<Vector2<f64>> {
    let mut kept: Vec<Vector2<f64>> = Vec::new();
    for p in points {
        while let [.., a, b] = kept[..]
            && (b - a).perp(&(p - b)) <= 0.0
        {
            kept.pop();
        }
        kept.push(p);
    }
    kept.pop();
    kept
}

fn polygon_area(points: &[Vector2<f64>]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(a, b)| a.perp(b)).sum::<f64>()
}

fn area(quad: &Quad) -> f64 {
    polygon_area(quad)
}

/// The largest quadrilateral of a hull's points, if it is nearly the whole hull and large enough.
fn quadrilateral(hull: &[Vector2<f64>], least: f64) -> Option<Quad> {
    let n = hull.len();
    if n < 4 {
        return None;
    }
    let mut at = [0, n / 4, n / 2, 3 * n / 4];
    let quad = |at: &[usize; 4]| at.map(|k| hull[k]);
    // each corner in turn goes where the area is largest, until none moves
    for _ in 0..n {
        let before = at;
        for k in 0..4 {
            let (low, high) = (at[(k + 3) % 4], at[(k + 1) % 4]);
            let between = (1..n).map(|s| (low + s) % n).take_while(|&i| i != high);
            let with = |i: usize| {
                let mut other = at;
                other[k] = i;
                area(&quad(&other))
            };
            at[k] = between.max_by(|&i, &j| with(i).total_cmp(&with(j))).unwrap_or(at[k]);
        }
        if at == before {
            break;
        }
    }
    let found = quad(&at);
    let shortest =
        (0..4).map(|k| (found[(k + 1) % 4] - found[k]).norm()).fold(f64::INFINITY, f64::min);
    let whole = polygon_area(hull);
    (shortest > 0.6 * least && area(&found) > LEAST_COVER * whole).then(|| grown(&found))
}

/// From the centres of the outermost dark pixels to the edge.
fn grown(quad: &Quad) -> Quad {
    let centre = quad.iter().sum::<Vector2<f64>>() / 4.0;
    quad.map(|p| p + (p - centre).normalize() * (HALF_PIXEL * 2f64.sqrt()))
}

// ---------------------------------------------------------------- sides

/// Half the width of the band around a side in which its edge is fitted, in cells and px.
const BAND_CELLS: f64 = 0.7;
const BAND_PX: (f64, f64) = (1.5, 6.0);
/// The band ends this much before the corners, in cells, and in px more.
const END_CELLS: f64 = 0.5;
const END_PX: f64 = 1.5;
/// Other edges are farther from the band than this many blurs.
const CLEAR_BLURS: f64 = 3.0;
/// Blur of a common picture, px, before it is measured.
const USUAL_BLUR_PX: f64 = 0.6;
/// Rounds in which the band follows the edge.
const ROUNDS: usize = 3;
/// Most steps of a fit.
const MOST_STEPS: usize = 30;
/// A fit has converged when the edge moves less than this, px.
const STEP_PX: f64 = 1e-4;
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

type Parameters = SVector<f64, 6>;
type Normal = SMatrix<f64, 6, 6>;

/// An edge: `n·(p - middle) = ρ` with the normal `n` at `angle`, and the covariance of `ρ, θ`.
struct Line {
    middle: Vector2<f64>,
    angle: f64,
    rho: f64,
    covariance: Matrix2<f64>,
    wobble: Wobble,
    blur_px: f64,
}

/// How far the pieces of an edge lie off its line, in their own variances.
#[derive(Clone, Copy, Default)]
struct Wobble {
    squares: f64,
    freedom: f64,
}

/// Corners from the edges of all sides.
fn refined(image: &GrayImage, start: Quad, cells: usize) -> Option<Vec<ImageCorner>> {
    let mut quad = start;
    let mut corners = vec![];
    let mut blur_px = USUAL_BLUR_PX;
    for _ in 0..ROUNDS {
        let sides: Option<Vec<Line>> =
            (0..4).map(|k| side(image, [&quad[k], &quad[(k + 1) % 4]], cells, blur_px)).collect();
        let mut sides = sides?;
        let wobble = wobble(&sides);
        sides.iter_mut().for_each(|side| side.covariance *= wobble);
        let met: Option<Vec<ImageCorner>> =
            (0..4).map(|k| meet(k as u32, &sides[(k + 3) % 4], &sides[k])).collect();
        corners = met?;
        quad = std::array::from_fn(|k| corners[k].pixel);
        blur_px = sides.iter().map(|side| side.blur_px).sum::<f64>() / 4.0;
    }
    let near = |k: usize| (quad[k] - start[k]).norm() < 2.0 + 0.1 * area(&start).sqrt();
    let known = |c: &ImageCorner| c.covariance.trace() < UNKNOWN_PX2;
    ((0..4).all(near) && corners.iter().all(known)).then_some(corners)
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
    let pixel = n * Vector2::new(a.rho + n_a.dot(&a.middle), b.rho + n_b.dot(&b.middle));
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

/// The band of pixels around one side: along it, outwards, and grey.
struct Band {
    pixels: Vec<(f64, f64, f64)>,
}

/// The edge from corner `a` to corner `b`; the tag is on the right of that way.
fn side(image: &GrayImage, [a, b]: [&Vector2<f64>; 2], cells: usize, blur_px: f64) -> Option<Line> {
    let (middle, along) = ((a + b) * 0.5, (b - a).normalize());
    let outwards = Vector2::new(along.y, -along.x);
    let band = gather(image, &middle, &outwards, (b - a).norm(), cells, blur_px)?;
    let (at, normal, cost) = band.descend(band.start())?;
    let freedom = band.pixels.len() as f64 - 6.0;
    let variance = (cost / freedom).max(ROUNDING_VARIANCE);
    let inverse = normal.cholesky()?.inverse() * variance;
    let sound = variance.sqrt() < WORST_RESIDUAL * at[3].abs() && at[3] > 0.0;
    sound.then(|| Line {
        middle,
        angle: outwards.y.atan2(outwards.x) + at[1],
        rho: at[0],
        covariance: inverse.fixed_view::<2, 2>(0, 0).into_owned(),
        wobble: band.wobble(&at, variance),
        blur_px: at[4].exp(),
    })
}

fn gather(
    image: &GrayImage,
    middle: &Vector2<f64>,
    outwards: &Vector2<f64>,
    length: f64,
    cells: usize,
    blur_px: f64,
) -> Option<Band> {
    let cell = length / cells as f64;
    let along = Vector2::new(-outwards.y, outwards.x);
    let clear = CLEAR_BLURS * blur_px;
    let width = (BAND_CELLS * cell).min(cell - clear).clamp(BAND_PX.0, BAND_PX.1);
    let half = 0.5 * length - (END_CELLS * cell + END_PX).max(clear);
    let reach = along.abs() * half.max(0.0) + outwards.abs() * width;
    let range = |centre: f64, reach: f64, size: usize| {
        let low = (centre - reach).floor().max(0.0) as usize;
        low..=((centre + reach).ceil().max(0.0) as usize).min(size - 1)
    };
    let mut pixels = Vec::new();
    for y in range(middle.y, reach.y, image.height()) {
        for x in range(middle.x, reach.x, image.width()) {
            let d = Vector2::new(x as f64, y as f64) - middle;
            let (u, v) = (along.dot(&d), outwards.dot(&d));
            if u.abs() <= half && v.abs() <= width {
                pixels.push((u, v, f64::from(image.at(x, y))));
            }
        }
    }
    (pixels.len() >= FEWEST_PIXELS).then_some(Band { pixels })
}

impl Band {
    /// `ρ θ a b ln(s) g`: the edge in the middle, greys by the means of its two sides.
    fn start(&self) -> Parameters {
        let mean = |outside: bool| {
            let side = || self.pixels.iter().filter(|p| (p.1 > 0.0) == outside);
            side().map(|p| p.2).sum::<f64>() / side().count().max(1) as f64
        };
        let (inner, outer) = (mean(false), mean(true));
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
    fn wobble(&self, at: &Parameters, variance: f64) -> Wobble {
        let half = self.pixels.iter().map(|p| p.0.abs()).fold(f64::MIN_POSITIVE, f64::max);
        let mut sums = [(0.0, 0.0); PIECES];
        for &(u, v, grey) in &self.pixels {
            let (value, j) = model(at, u, v);
            let piece = (PIECES as f64 * 0.5 * (1.0 + u / half)) as usize;
            let (jr, jj) = &mut sums[piece.min(PIECES - 1)];
            *jr += j[0] * (grey - value);
            *jj += j[0] * j[0];
        }
        let seen = || sums.iter().filter(|(_, jj)| *jj > 0.0);
        Wobble {
            squares: seen().map(|(jr, jj)| jr * jr / (jj * variance)).sum(),
            freedom: (seen().count() as f64 - 2.0).max(0.0),
        }
    }

    /// `JᵀJ`, `Jᵀr` and `rᵀr` of `r = I - model`.
    fn linearise(&self, at: &Parameters) -> (Normal, Parameters, f64) {
        let (mut normal, mut gradient, mut cost) = (Normal::zeros(), Parameters::zeros(), 0.0);
        for &(u, v, grey) in &self.pixels {
            let (value, j) = model(at, u, v);
            let r = grey - value;
            normal.ger(1.0, &j, &j, 1.0);
            gradient += j * r;
            cost += r * r;
        }
        (normal, gradient, cost)
    }
}

/// Grey value and its derivatives; `u` along the side, `v` outwards, `d = v cos θ + u sin θ - ρ`.
fn model(at: &Parameters, u: f64, v: f64) -> (f64, Parameters) {
    let [rho, theta, a, b, ln_s, g] = (*at).into();
    let (sine, cosine) = theta.sin_cos();
    let scale = (-ln_s).exp() * std::f64::consts::FRAC_1_SQRT_2;
    let d = v * cosine + u * sine - rho;
    let (value, slope) = erf((d * scale) as f32);
    let (value, slope) = (f64::from(value), f64::from(slope));
    let by_d = b * slope * scale;
    let by_theta = by_d * (u * cosine - v * sine);
    let j = Parameters::from([-by_d, by_theta, 1.0, value, -by_d * d, u]);
    (a + g * u + b * value, j)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Intrinsics, Pose, TargetModel,
        simulate::{Optics, Random, Scene},
    };

    const NAMES: [&str; 3] = ["DICT_APRILTAG_36h11", "DICT_6X6_250", "DICT_4X4_50"];

    fn scene(name: &str, id: u32, seed: u64) -> Scene {
        let mut random = Random::new(seed);
        let turn =
            [random.between(-0.6, 0.6), random.between(-0.6, 0.6), random.between(-3.1, 3.1)];
        let at =
            [random.between(-0.05, 0.05), random.between(-0.05, 0.05), random.between(0.3, 0.6)];
        let dictionary = name.into();
        Scene {
            target: TargetModel::Tag { dictionary, id, size_mm: 48.0 },
            camera_from_target: Pose::claim(nalgebra::Isometry3::new(at.into(), turn.into())),
            intrinsics: Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5),
        }
    }

    #[test]
    fn a_rendered_tag_is_found_where_it_is_however_it_is_turned() {
        for (k, name) in NAMES.iter().cycle().take(24).enumerate() {
            let scene = scene(name, k as u32, k as u64);
            let image = scene.picture(&Optics::default(), k as u64);
            let found = detect(&image, name, k as u32).unwrap();
            for (corner, (id, exact)) in found.iter().zip(scene.corners()) {
                let off = (corner.pixel - exact).norm();
                assert!(corner.id == id && off < 0.2, "{name} {k}: corner {id} is {off:.3} px off");
            }
        }
    }

    #[test]
    fn errors_stay_inside_the_covariance() {
        let (mut sum, mut count) = (0.0, 0.0);
        for k in 0..40 {
            let scene = scene(NAMES[0], 7, 100 + k);
            let image = scene.picture(&Optics::default(), k);
            for (corner, (_, exact)) in
                detect(&image, NAMES[0], 7).unwrap().iter().zip(scene.corners())
            {
                let e = corner.pixel - exact;
                sum += e.dot(&(corner.covariance.try_inverse().unwrap() * e)) / 2.0;
                count += 1.0;
            }
        }
        let mean = sum / count;
        println!("normalised error squared {mean:.2}");
        assert!((0.7..1.5).contains(&mean), "{mean}");
    }

    /// Root mean square of the corners' errors (px, per axis), and their mean square over their
    /// covariances.
    fn figures(optics: &Optics) -> (f64, f64) {
        let (mut squares, mut normalised, mut count) = (0.0, 0.0, 0.0);
        for k in 0..40 {
            let scene = scene(NAMES[0], 7, 200 + k);
            let found = detect(&scene.picture(optics, k), NAMES[0], 7).unwrap();
            for (corner, (_, exact)) in found.iter().zip(scene.corners()) {
                let e = corner.pixel - exact;
                squares += e.norm_squared();
                normalised += e.dot(&(corner.covariance.try_inverse().unwrap() * e));
                count += 2.0;
            }
        }
        ((squares / count).sqrt(), normalised / count)
    }

    #[test]
    fn blur_and_noise_are_in_the_covariance() {
        for (blur_px, noise) in [(0.4, 1.0), (0.8, 1.0), (0.8, 4.0), (1.5, 2.0)] {
            let (rms, mean) = figures(&Optics { blur_px, noise, ..Optics::default() });
            println!("blur {blur_px} noise {noise}: {rms:.4} px, normalised {mean:.2}");
            assert!((0.7..1.5).contains(&mean), "blur {blur_px}, noise {noise}: {mean}");
        }
    }

    #[test]
    fn another_tag_is_not_taken_for_the_wanted_one() {
        let image = scene(NAMES[0], 7, 1).picture(&Optics::default(), 1);
        assert!(detect(&image, NAMES[0], 8).is_err());
        assert!(detect(&image, NAMES[1], 7).is_err());
        assert!(detect(&image, "DICT_9X9", 7).is_err());
    }

    #[test]
    fn an_empty_picture_shows_no_tag() {
        let image = GrayImage::new(200, 100, vec![77.0; 20_000]).unwrap();
        let message = detect(&image, NAMES[0], 3).unwrap_err().to_string();
        assert!(message.contains("no tag 3 of DICT_APRILTAG_36h11"), "{message}");
    }

    #[test]
    fn the_edge_model_has_the_right_derivatives() {
        let at = Parameters::from([0.2, 0.03, 100.0, 60.0, 0.1, 0.2]);
        for (u, v) in [(3.0, 0.5), (-7.0, -1.2), (0.4, 0.1)] {
            let (_, j) = model(&at, u, v);
            for k in 0..6 {
                let mut step = Parameters::zeros();
                step[k] = 1e-2;
                let ahead = model(&(at + step), u, v).0;
                let numeric = (ahead - model(&(at - step), u, v).0) / 2e-2;
                assert!((numeric - j[k]).abs() < 3e-3 * (3.0 + numeric.abs()), "{k}");
            }
        }
    }
}
