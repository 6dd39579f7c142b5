//! The four sides of a tag, and the corners where they meet.
//!
//! Each side is an edge ([`super::edge`]); neighbouring sides meet in the corners, which take over the
//! lines' covariances.

use nalgebra::{Matrix2, Vector2};

use super::{
    edge::{Line, Parameters, Place, Surroundings, is_crowded, side},
    quads::{Quad, area},
};
use crate::{GrayImage, ImageCorner};

/// Blur of a common image, px, before it is measured.
const USUAL_BLUR_PX: f64 = 0.6;
/// A corner with a larger variance (px², both axes) was not measured.
const UNKNOWN_PX2: f64 = 1.0;

/// Rounds in which the corners of a tag are measured that is seen in part.
const ROUNDS_IN_PART: usize = 2;
/// An edge that wobbles by more than its pixels' noise says, as a factor on the variance, is not a
/// tag's where nothing else says that there is one.
const WORST_WOBBLE: f64 = 6.0;
/// Nor is a corner that lies farther from where it should be, px.
const OFF_IN_PART_PX: f64 = 1.0;

/// The corners of a tag by its sides.
pub(super) struct Refined {
    pub corners: [ImageCorner; 4],
    /// Standard deviation of the blur, px.
    pub blur_px: f64,
}

impl Refined {
    /// The corners' pixels.
    pub(crate) fn quad(&self) -> Quad {
        self.corners.each_ref().map(|corner| corner.pixel)
    }
}

/// The corners after one round: good enough to start from.
pub(super) fn approached(image: &GrayImage, start: &Quad, around: &Surroundings) -> Option<Quad> {
    Some(refined(image, start, around, 1)?.quad())
}

/// The corners from the edges of all sides, their ids 0 to 3 as in `start`. In every round the band
/// follows the edges, and their blur.
pub(super) fn refined(
    image: &GrayImage,
    start: &Quad,
    around: &Surroundings,
    rounds: usize,
) -> Option<Refined> {
    let mut quad = *start;
    let mut found = None;
    let mut shapes: [Option<Parameters>; 4] = [None; 4];
    let mut blur_px = USUAL_BLUR_PX;
    for _ in 0..rounds {
        let one = |k: usize| side(image, &Place::new(&quad, k, around, blur_px), shapes[k]);
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
    let moved = |k: usize| (quad[k] - start[k]).norm();
    let near = |k: usize| is_inside(image, &quad[k]) && moved(k) < 2.0 + 0.1 * area(start).sqrt();
    let known = |c: &ImageCorner| c.covariance.trace() < UNKNOWN_PX2;
    ((0..4).all(near) && corners.iter().all(known)).then_some(Refined { corners, blur_px })
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
    // blurred sides are off by what lies beside them
    if is_crowded(&quad, around, blur_px) {
        return [None; 4];
    }
    corners.map(|corner| corner.filter(|c| is_inside(image, &c.pixel)))
}

/// Whether a pixel is in the image.
pub(super) fn is_inside(image: &GrayImage, p: &Vector2<f64>) -> bool {
    let (right, bottom) = (image.width() as f64 - 1.0, image.height() as f64 - 1.0);
    p.x > 0.0 && p.y > 0.0 && p.x < right && p.y < bottom
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
