//! Points where two edges cross as on a checkerboard, and the directions of their edges.
//!
//! In the smoothed image `L` such a point is a saddle, however the edges are turned or slanted:
//!
//! ```text
//! D = L_xy² - L_xx L_yy > 0,    ∇L = 0
//! ```
//!
//! Local maxima of `D` are candidates. On a ring around a crossing the image is above and below the
//! centre's grey twice each, with edges on opposite sides; what has no such ring is none.
//!
//! After P. Beaudet, *Rotationally invariant image operators*, ICPR 1978 (the determinant), and
//! S. Bennett and J. Lasenby, *ChESS*, CVIU 118, 2014 (the ring).

use std::f64::consts::{PI, TAU};

use multiversion::multiversion;
use nalgebra::{Matrix2, Vector2};

use crate::GrayImage;

/// A crossing of two edges. Angles grow clockwise in the image (y points down).
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    /// Where, px, to about half a pixel.
    pub at: Vector2<f64>,
    /// Angles of its four edges, clockwise. Clockwise of edges 0 and 2 lies black, of 1 and 3 white.
    pub rays: [f64; 4],
    /// White minus black, grey values.
    pub contrast: f64,
}

impl Crossing {
    /// Direction of an edge.
    pub fn ray(&self, k: usize) -> Vector2<f64> {
        let (sin, cos) = self.rays[k % 4].sin_cos();
        Vector2::new(cos, sin)
    }

    /// Sine of the angle at which the edges cross.
    pub(crate) fn slant(&self) -> f64 {
        (self.rays[1] - self.rays[0]).sin().abs()
    }
}

/// Square root of the least `D` of a candidate, grey values per px²: that of a contrast of about 8.
const FAINTEST: f32 = 1.0;
/// A candidate is the largest in a square of this half width, px.
const APART: usize = 2;
/// Rows and columns of that square.
const WINDOW: usize = 2 * APART + 1;
/// Radii of the ring, px: the second is for small squares.
const RADII: [f64; 2] = [4.5, 3.0];
/// Samples on the ring.
const SAMPLES: usize = 32;
/// Least contrast on the ring, grey values.
const LEAST_CONTRAST: f64 = 6.0;
/// Each of the four sectors must differ from the centre by this share of the contrast.
const LEAST_SECTOR: f64 = 0.12;
/// Edges on opposite sides must be in line, rad.
const IN_LINE: f64 = 0.5;
/// Edges that cross at a smaller angle (rad) are none.
const SHALLOWEST: f64 = 0.22;
/// A saddle lies this near to its candidate, px.
const NEAR: f64 = 1.5;

/// All crossings of a smoothed image, by rows.
pub(super) fn crossings(smooth: &GrayImage) -> Vec<Crossing> {
    let circle = Circle::default();
    let all = candidates(smooth);
    all.into_iter().filter_map(|(x, y)| circle.crossing_at(smooth, x, y)).collect()
}

/// Directions of the samples on the ring.
pub(super) struct Circle {
    directions: [(f64, f64); SAMPLES],
}

impl Default for Circle {
    fn default() -> Self {
        let direction = |k: usize| {
            let (sin, cos) = angle(k as f64).sin_cos();
            (cos, sin)
        };
        Self { directions: std::array::from_fn(direction) }
    }
}

impl Circle {
    /// The crossing at a pixel, if there is one.
    pub(crate) fn crossing_at(&self, smooth: &GrayImage, x: usize, y: usize) -> Option<Crossing> {
        let at = saddle(smooth, x, y)?;
        let grey = |radius: &f64| self.around(smooth, &at, *radius);
        RADII.iter().find_map(|radius| crossing_of(&at, &grey(radius)?))
    }

    /// Grey values on a ring, relative to its centre.
    fn around(&self, smooth: &GrayImage, at: &Vector2<f64>, radius: f64) -> Option<[f64; SAMPLES]> {
        let centre = sample(smooth, at.x, at.y)?;
        let mut grey = [0.0; SAMPLES];
        for (value, (cos, sin)) in grey.iter_mut().zip(&self.directions) {
            *value = sample(smooth, at.x + radius * cos, at.y + radius * sin)? - centre;
        }
        Some(grey)
    }
}

/// Pixels with a locally largest `D`.
fn candidates(smooth: &GrayImage) -> Vec<(usize, usize)> {
    let (width, height) = (smooth.width(), smooth.height());
    if width.min(height) < 4 * APART + 3 {
        return vec![];
    }
    let mut found = vec![];
    // of a few rows only, that they stay at hand
    let mut rows: [Vec<f32>; WINDOW] = std::array::from_fn(|_| vec![0.0; width]);
    for last in 2..height {
        determinant(smooth, last, &mut rows[last % WINDOW]);
        let Some(y) = last.checked_sub(APART).filter(|y| *y >= APART) else { continue };
        let window: [&[f32]; WINDOW] = std::array::from_fn(|k| &rows[(y + k - APART) % WINDOW][..]);
        for x in APART..width - APART {
            if window[APART][x] > FAINTEST * FAINTEST && is_peak(&window, x) {
                found.push((x, y));
            }
        }
    }
    found
}

/// Whether no neighbour is larger; of equals the first counts.
fn is_peak(window: &[&[f32]; WINDOW], x: usize) -> bool {
    let own = window[APART][x];
    window.iter().enumerate().all(|(j, row)| {
        let near = &row[x - APART..=x + APART];
        near.iter()
            .enumerate()
            .all(|(i, &other)| if (j, i) < (APART, APART) { other < own } else { other <= own })
    })
}

/// `D` of a row, 0 at the rim. The second derivatives along the axes come from neighbours two pixels
/// away, the mixed one from diagonal neighbours: so `D` depends little on how edges are turned.
#[multiversion(targets("x86_64+avx2"))]
fn determinant(smooth: &GrayImage, y: usize, out: &mut [f32]) {
    let (width, height) = (smooth.width(), smooth.height());
    if y < 2 || y + 2 >= height {
        out.fill(0.0);
        return;
    }
    let row = |y: usize| &smooth.values()[y * width..(y + 1) * width];
    let n = width - 4;
    let (above2, above, here, below, below2) =
        (&row(y - 2)[2..], row(y - 1), row(y), row(y + 1), &row(y + 2)[2..]);
    let (al, ar, bl, br) = (&above[1..][..n], &above[3..][..n], &below[1..][..n], &below[3..][..n]);
    let (left, middle, right) = (&here[..n], &here[2..][..n], &here[4..][..n]);
    let (up, down) = (&above2[..n], &below2[..n]);
    let out = &mut out[2..][..n];
    for k in 0..n {
        let twice = middle[k] + middle[k];
        let xx = left[k] + right[k] - twice;
        let yy = up[k] + down[k] - twice;
        let xy = al[k] + br[k] - ar[k] - bl[k];
        out[k] = (xy * xy - xx * yy) * (1.0 / 16.0);
    }
}

/// The saddle next to a pixel, by a Newton step.
fn saddle(smooth: &GrayImage, x: usize, y: usize) -> Option<Vector2<f64>> {
    let inside = x >= 2 && y >= 2 && x + 2 < smooth.width() && y + 2 < smooth.height();
    if !inside {
        return None;
    }
    let l = |dx: isize, dy: isize| {
        f64::from(smooth.at(x.wrapping_add_signed(dx), y.wrapping_add_signed(dy)))
    };
    let gradient = Vector2::new(l(1, 0) - l(-1, 0), l(0, 1) - l(0, -1)) * 0.5;
    let twice = 2.0 * l(0, 0);
    let xy = 0.25 * (l(1, 1) + l(-1, -1) - l(1, -1) - l(-1, 1));
    let xx = 0.25 * (l(2, 0) + l(-2, 0) - twice);
    let yy = 0.25 * (l(0, 2) + l(0, -2) - twice);
    let step = -(Matrix2::new(xx, xy, xy, yy).try_inverse()? * gradient);
    (step.amax() < NEAR).then(|| Vector2::new(x as f64, y as f64) + step)
}

/// The edges that a ring around the saddle crosses.
fn crossing_of(at: &Vector2<f64>, grey: &[f64; SAMPLES]) -> Option<Crossing> {
    let least = grey.iter().copied().fold(f64::INFINITY, f64::min);
    let most = grey.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let contrast = most - least;
    if contrast < LEAST_CONTRAST {
        return None;
    }
    let mut edges = [0.0; 4];
    let (mut count, mut first_is_black) = (0, false);
    for k in 0..SAMPLES {
        let (now, next) = (grey[k], grey[(k + 1) % SAMPLES]);
        if (now < 0.0) != (next < 0.0) {
            if count == 4 {
                return None;
            }
            edges[count] = angle(k as f64 + now / (now - next));
            if count == 0 {
                first_is_black = next < 0.0;
            }
            count += 1;
        }
    }
    if count != 4 || !sectors_are_clear(grey, &edges, LEAST_SECTOR * contrast) {
        return None;
    }
    let straight = |a: f64, b: f64| (b - a - PI).abs() < IN_LINE;
    if !straight(edges[0], edges[2]) || !straight(edges[1], edges[3]) {
        return None;
    }
    let (a, b) = (0.5 * (edges[0] + edges[2] - PI), 0.5 * (edges[1] + edges[3] - PI));
    if !(SHALLOWEST..PI - SHALLOWEST).contains(&(b - a)) {
        return None;
    }
    let rays = if first_is_black { [a, b, a + PI, b + PI] } else { [b, a + PI, b + PI, a + TAU] };
    Some(Crossing { at: *at, rays, contrast })
}

fn angle(k: f64) -> f64 {
    k * (TAU / SAMPLES as f64)
}

/// Whether the image goes far enough up or down between all neighbouring edges.
fn sectors_are_clear(grey: &[f64; SAMPLES], edges: &[f64; 4], least: f64) -> bool {
    let index = |edge: f64| (edge / angle(1.0)).ceil() as usize;
    (0..4).all(|k| {
        let end = if k == 3 { index(edges[0]) + SAMPLES } else { index(edges[k + 1]) };
        (index(edges[k])..end).any(|s| grey[s % SAMPLES].abs() > least)
    })
}

/// Grey value between pixels; `None` outside.
pub(super) fn sample(image: &GrayImage, x: f64, y: f64) -> Option<f64> {
    if !(x >= 0.0 && y >= 0.0) {
        return None;
    }
    let (i, j) = (x as i32 as usize, y as i32 as usize); // the shorter integer is the quicker one
    let width = image.width();
    if i + 1 >= width || j + 1 >= image.height() {
        return None;
    }
    let (a, b) = ((x - f64::from(i as i32)) as f32, (y - f64::from(j as i32)) as f32);
    let top = &image.values()[j * width + i..][..2];
    let bottom = &image.values()[(j + 1) * width + i..][..2];
    let (t, u) = (top[0] + a * (top[1] - top[0]), bottom[0] + a * (bottom[1] - bottom[0]));
    Some(f64::from(t + b * (u - t)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::pyramid::smoothed;

    /// Two straight edges through a point, black clockwise of the first, drawn with soft edges.
    fn cross(at: &Vector2<f64>, a: f64, b: f64) -> GrayImage {
        let side = |x: f64, y: f64, angle: f64| {
            let d = (y - at.y) * angle.cos() - (x - at.x) * angle.sin();
            d.clamp(-1.0, 1.0)
        };
        let grey = |k: usize| {
            let (x, y) = ((k % 40) as f64, (k / 40) as f64);
            (120.0 + 50.0 * side(x, y, a) * side(x, y, b)) as f32
        };
        GrayImage::new(40, 40, (0..1600).map(grey).collect()).unwrap()
    }

    #[test]
    fn a_crossing_knows_its_edges_and_their_sides() {
        for turn in 0..24 {
            for slant in [0.65, 0.9, 1.57, 2.2, 2.5] {
                let at = Vector2::new(20.3, 19.6);
                let a = f64::from(turn) * TAU / 24.0;
                let found = crossings(&smoothed(&cross(&at, a, a + slant)));
                assert_eq!(found.len(), 1, "{turn} {slant}: {found:?}");
                let crossing = found[0];
                assert!((crossing.at - at).norm() < 0.3, "{turn} {slant}: {}", crossing.at);
                // between both edges, going clockwise, lies black
                let off = |k: usize, angle: f64| {
                    let d = (crossing.rays[k] - angle).rem_euclid(PI);
                    d.min(PI - d)
                };
                // blur widens a narrow sector
                let most = if slant.sin() < 0.7 { 0.25 } else { 0.15 };
                let (first, second) = (off(0, a), off(1, a + slant));
                assert!(first.max(second) < most, "{turn} {slant}: {first} {second}");
            }
        }
    }

    #[test]
    fn an_edge_a_corner_and_a_blob_are_no_crossings() {
        let grey = |k: usize, what: usize| {
            let (x, y) = ((k % 40) as f64, (k / 40) as f64);
            let black = match what {
                0 => x + 0.3 * y > 25.0,
                1 => x > 20.0 && y > 20.0,
                2 => (x - 20.0).hypot(y - 20.0) < 6.0,
                _ => (x > 20.0 && y > 20.0) || y < 12.0,
            };
            if black { 20.0 } else { 220.0 }
        };
        for what in 0..4 {
            let image = GrayImage::new(40, 40, (0..1600).map(|k| grey(k, what)).collect()).unwrap();
            assert!(crossings(&smoothed(&image)).is_empty(), "{what}");
        }
    }
}
