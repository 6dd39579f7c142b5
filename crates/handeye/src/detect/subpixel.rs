//! Where exactly a checkerboard corner is, and how sure that is.
//!
//! Around a corner at `c` two straight edges cross; with `d₁, d₂` the signed distances of a pixel
//! `p` to them, a lens that blurs with a Gaussian of width `s` and light that changes linearly with
//! `g`, the image is
//!
//! ```text
//! I(p) = (a + b erf(d₁/(√2 s)) erf(d₂/(√2 s))) (1 + g·(p - p₀)),    dᵢ = nᵢ(θᵢ)·(p - c)
//! ```
//!
//! or, where the light changes much and that fits better, `... + g·(p - p₀)` as under glare. Its nine
//! parameters `c, θ₁, θ₂, a, b, ln s, g` are fitted to the pixels of a disc by
//! Levenberg-Marquardt; the inverse normal matrix, scaled by the mean squared residual, is their
//! covariance. The product of two error functions is exact for edges at right angles and close for
//! others.
//!
//! After L. Krüger and C. Wöhler, *Accurate chequerboard corner localisation for camera
//! calibration*, Pattern Recognition Letters 32(10), 2011, who fit the same surface with one blur.

mod descent;
mod disc;
mod model;
#[cfg(test)]
mod tests;

use nalgebra::{Matrix2, Vector2};

use crate::GrayImage;
use disc::Disc;
use disc::Light;
use model::Parameters;

/// A corner known to about a pixel, and the board around it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RoughCorner {
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
pub(crate) struct FittedCorner {
    /// Where, px.
    pub pixel: Vector2<f64>,
    /// How sure, px².
    pub covariance: Matrix2<f64>,
    /// Standard deviation of the blur, px.
    pub blur_px: f64,
    /// White minus black, grey values.
    pub contrast: f64,
    /// Whether all four quadrants are seen to be what they are: where light drowns one that should be
    /// dark, the corner of a single square looks like a crossing.
    pub in_sight: bool,
}

/// Why a corner was left out.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub(crate) enum Unfit {
    /// The image ends too close to it.
    #[error("too close to the image's edge")]
    AtTheEdge,
    /// The squares are too small to tell their edges apart.
    #[error("the squares are only {0:.1} px wide")]
    TooSmall(f64),
    /// The fit found nothing, or wandered away.
    #[error("the image does not look like a corner there")]
    NoCorner,
}

/// The disc reaches this share of the way to the next parallel edge: the model knows only two edges.
const REACH: f64 = 0.6;
/// Largest disc radius, px: beyond it lens distortion bends the edges.
const WIDEST_PX: f64 = 14.0;
/// The next parallel edge must stay this far outside the disc, px: about three blurs.
const GUARD_PX: f64 = 2.5;
/// Below this radius (px) a disc holds too few pixels for nine parameters.
const SMALLEST_PX: f64 = 2.2;
/// The second disc's radius, as a share of the first's.
const SMALLER: f64 = 0.65;
/// A fit that moves farther than this share of a cell has found another corner.
const FARTHEST: f64 = 0.3;
/// The fit has converged when the corner moves less than this, px: the step after it would be some
/// twenty times smaller.
const STEP_PX: f64 = 5e-3;
/// The small disc's fit ends when the corner moves less than this, px.
const NEAR_STEP_PX: f64 = 0.05;
/// Where light changes by more than this share from the middle of the disc to its rim, it may lie over
/// the image rather than multiply it.
const SLOPED: f64 = 0.03;
/// A disc smaller than this, in blurs, does not tell that from the edges beside it.
const LIGHT_BLURS: f64 = 7.0;
/// Radius of the small disc, px.
const NEAR_PX: f64 = 6.0;

/// A corner to a few hundredths of a pixel, from the pixels next to it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearCorner {
    /// Where, px.
    pub pixel: Vector2<f64>,
    /// The other parameters, relative to `pixel`.
    shape: Parameters,
}

/// Gets near a corner, by a small disc.
///
/// # Errors
/// Why there is none.
pub(crate) fn approach(image: &GrayImage, rough: &RoughCorner) -> Result<NearCorner, Unfit> {
    let disc = Disc::gather(image, rough, radius(rough)?.min(NEAR_PX))?;
    let at = disc.descend(disc.start(rough), NEAR_STEP_PX).ok_or(Unfit::NoCorner)?.at;
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
    let mut disc = Disc::gather(image, &RoughCorner { pixel: near.pixel, ..*rough }, radius)?;
    let mut found = disc.descend(near.shape, STEP_PX).ok_or(Unfit::NoCorner)?;
    let at = found.at;
    let clear = radius > LIGHT_BLURS * at[6].exp();
    if clear && radius * at[7].hypot(at[8]) > SLOPED {
        let multiplied = disc.residual(&found);
        let mut start = at;
        start.fixed_rows_mut::<2>(7).scale_mut(at[4]);
        disc.light = Light::Adds;
        let added = disc.descend(start, STEP_PX);
        match added.filter(|added| disc.residual(added) < multiplied) {
            Some(added) => found = added,
            None => disc.light = Light::Multiplies,
        }
    }
    not_far(rough, &disc.place(&found.at))?;
    disc.judge(&found).ok_or(Unfit::NoCorner)
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
