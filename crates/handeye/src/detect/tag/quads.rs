//! Quadrilaterals: the hulls that are nearly one.

use nalgebra::Vector2;

use super::patches;
use crate::GrayImage;

/// A quadrilateral, clockwise in the image, px.
pub(crate) type Quad = [Vector2<f64>; 4];

/// Radii of the means, as shares of the image's longer side: a small one for tags in shadow or
/// with little white around them, a large one for blurred ones.
const MEANS: [f64; 2] = [0.01, 0.04];
/// Least radius of a mean, px.
const LEAST_RADIUS: usize = 4;
/// Share of a hull that the largest quadrilateral in it must cover.
const LEAST_COVER: f64 = 0.9;
/// A hull's outermost pixels lie inside the edge by this much, px.
const HALF_PIXEL: f64 = 0.5;

/// All dark quadrilaterals with sides of about `least` px and more; `touching` ones are told from
/// their neighbours.
pub(super) fn quads(image: &GrayImage, least: f64, touching: bool) -> Vec<Quad> {
    let longer = image.width().max(image.height()) as f64;
    let radii = MEANS.map(|share| ((share * longer) as usize).max(LEAST_RADIUS));
    let inside = HALF_PIXEL + f64::from(u8::from(touching));
    let mut found = vec![];
    for radius in radii {
        let hulls = patches::hulls(image, radius, least, touching);
        found.extend(hulls.iter().filter_map(|hull| quadrilateral(hull, least, inside)));
    }
    found
}

fn polygon_area(points: &[Vector2<f64>]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(a, b)| a.perp(b)).sum::<f64>()
}

/// Area, px².
pub(super) fn area(quad: &Quad) -> f64 {
    polygon_area(quad)
}

/// The largest quadrilateral of a hull's points, if it is nearly the whole hull and large enough.
fn quadrilateral(hull: &[Vector2<f64>], least: f64, inside: f64) -> Option<Quad> {
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
    (shortest > 0.6 * least && area(&found) > LEAST_COVER * whole).then(|| grown(&found, inside))
}

/// From the centres of the outermost dark pixels to the edge.
fn grown(quad: &Quad, inside: f64) -> Quad {
    let centre = quad.iter().sum::<Vector2<f64>>() / 4.0;
    quad.map(|p| p + (p - centre).normalize() * (inside * 2f64.sqrt()))
}
