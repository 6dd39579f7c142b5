//! Corners from points whose colour is known.
//!
//! A 3D camera may read black farther or nearer than white: amplitudes bias times of flight, and
//! the pattern of structured light is dimmer on black. The model is a step `s` of the depth along
//! the optical axis, the point staying on its ray,
//!
//! ```text
//! z_read = z + s on black,   z_read = z on white
//! ```
//!
//! Both colours lie on one plane, so the planes through the white and the black points around a
//! corner tell `s` by their distance there. Whether white or black is right they cannot tell.
//! White is taken to be right: it sends back more light, and it is what such cameras are adjusted
//! with.
//!
//! Colours come from the target's model, over a homography of the corners nearby. Points that an
//! edge of the print may have mixed are left out.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::{
    Missing, Reason, Window, Windows, lift_all, on_plane,
    plane::{Plane, TUKEY, tukey},
    samples::FEWEST_POINTS,
    step::Step,
};
use crate::{
    ImageCorner, SurfaceCorner, TargetModel,
    detect::{homography, surface::plane::Sample},
    math::{linalg::median, statistics::MAD},
    model::texture::Texture,
};

/// What the colours of a print say in one capture.
#[derive(Debug, Clone, PartialEq)]
pub struct Coloured {
    /// The corners, from points of known colour, the capture's own step taken off.
    pub corners: Vec<ColouredCorner>,
    /// Corners without enough points of known colour.
    pub missing: Vec<Missing>,
    /// The step that this capture shows.
    pub step: Step,
}

/// A corner from points of known colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColouredCorner {
    /// The corner.
    pub corner: SurfaceCorner,
    /// How its depth moves with the step that is taken off: 0 where all points are white, -1 where
    /// all are black.
    pub depth_by_step: f64,
}

/// Points nearer than this (scan px) to an edge of the print may have seen both colours.
const MIXED_PX: f64 = 1.2;
/// Corners nearby that tell where on the board a pixel is.
const NEIGHBOURS: usize = 9;
/// Fewer corners with points of both colours tell no step.
const FEWEST_CORNERS: usize = 3;
/// Rounds of re-weighting.
const ROUNDS: usize = 5;

/// The points around a corner that have a colour, and which of them are black.
struct Painted {
    samples: Vec<Sample>,
    black: Vec<bool>,
}

/// Lifts corners from points of known colour; `None` where too few tell a step.
pub(super) fn lift(
    corners: &[ImageCorner],
    windows: &Windows,
    target: &TargetModel,
) -> Option<Coloured> {
    let texture = Texture::of(target)?;
    let paint = |corner: &ImageCorner, window: &Window| {
        let map = board_from_scan(corner, corners, window, target)?;
        Some(painted(window, &map, &texture))
    };
    let both: Vec<Option<Painted>> = windows
        .iter()
        .map(|(corner, window)| window.as_ref().ok().and_then(|w| paint(corner, w)))
        .collect();
    let seen = windows.iter().zip(&both);
    let steps: Vec<(f64, f64)> = seen
        .filter_map(|((corner, window), p)| step_at(corner, window.as_ref().ok()?, p.as_ref()?))
        .collect();
    let step = combined(&steps)?;
    let painted_at = |id: u32| {
        let k = windows.iter().position(|(c, _)| c.id == id)?;
        both[k].as_ref()
    };
    let (corners, missing) = lift_all(windows, |corner, window| {
        let painted = painted_at(corner.id).ok_or(Reason::Mixed)?;
        lift_one(corner, window, painted, step.value_m)
    });
    Some(Coloured { corners, missing, step })
}

/// Homography that takes pixels of the scan, counted from a corner, to the board (m).
fn board_from_scan(
    corner: &ImageCorner,
    corners: &[ImageCorner],
    window: &Window,
    target: &TargetModel,
) -> Option<Matrix3<f64>> {
    let mut near: Vec<&ImageCorner> = corners.iter().collect();
    let away = |c: &ImageCorner| (c.pixel - corner.pixel).norm_squared();
    near.sort_by(|a, b| away(a).total_cmp(&away(b)).then(a.id.cmp(&b.id)));
    let pairs = near.iter().filter_map(|c| {
        let on_scan = c.pixel.add_scalar(0.5) * window.scale - Vector2::repeat(0.5);
        Some((on_scan - window.centre, target.corner(c.id)?.vector().xy()))
    });
    let (from, to): (Vec<_>, Vec<_>) = pairs.take(NEIGHBOURS).unzip();
    homography::fit(&from, &to)
}

fn painted(window: &Window, map: &Matrix3<f64>, texture: &Texture) -> Painted {
    let at = |p: Vector2<f64>| homography::apply(map, &p);
    let here = at(Vector2::zeros());
    let pixel_m = (at(Vector2::x()) - here).norm().max((at(Vector2::y()) - here).norm());
    let colour = |s: &&Sample| {
        let place = at(s.at);
        let clear = texture.clearance(&place) > MIXED_PX * pixel_m;
        Some((**s, texture.is_black_at(&place).filter(|_| clear)?))
    };
    let (samples, black) = window.samples.iter().filter_map(|s| colour(&s)).unzip();
    Painted { samples, black }
}

/// Depth of black minus that of white at a corner, and its variance (m²).
fn step_at(corner: &ImageCorner, window: &Window, painted: &Painted) -> Option<(f64, f64)> {
    let one = |black: bool| {
        let of_colour = painted.samples.iter().zip(&painted.black).filter(|(_, b)| **b == black);
        let samples: Vec<Sample> = of_colour.map(|(s, _)| *s).collect();
        if samples.len() < FEWEST_POINTS {
            return None;
        }
        let plane = Plane::fit(&samples, corner.id.into()).ok()?;
        let variance = plane.depth_variance(window.inflation(&samples, &plane));
        (plane.depth() > 0.0 && variance.is_finite()).then(|| (plane.depth(), variance))
    };
    let (black, white) = (one(true)?, one(false)?);
    Some((black.0 - white.0, black.1 + white.1))
}

/// The step that all corners of a capture tell together; corners far from it have no say.
fn combined(steps: &[(f64, f64)]) -> Option<Step> {
    if steps.len() < FEWEST_CORNERS {
        return None;
    }
    let mut value = median(steps.iter().map(|s| s.0));
    let mut sigma = f64::INFINITY;
    for _ in 0..ROUNDS {
        let off = |s: &(f64, f64)| (s.0 - value) / s.1.sqrt();
        let scale = (median(steps.iter().map(|s| off(s).abs())) / MAD).max(1.0);
        let weights: Vec<f64> = steps.iter().map(|s| tukey(off(s) / scale) / s.1).collect();
        let total: f64 = weights.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        value = steps.iter().zip(&weights).map(|(s, w)| s.0 * w).sum::<f64>() / total;
        sigma = scale / total.sqrt();
    }
    let near = |s: &&(f64, f64)| (s.0 - value).abs() < TUKEY * s.1.sqrt();
    let corners = steps.iter().filter(near).count();
    Some(Step { value_m: value, sigma_m: sigma, corners })
}

fn lift_one(
    corner: &ImageCorner,
    window: &Window,
    painted: &Painted,
    step_m: f64,
) -> Result<ColouredCorner, Reason> {
    let points = painted.samples.len();
    if points < FEWEST_POINTS {
        return Err(Reason::Mixed);
    }
    let samples: Vec<Sample> = painted
        .samples
        .iter()
        .zip(&painted.black)
        .map(|(s, black)| if *black { nearer(s, step_m) } else { *s })
        .collect();
    let plane = Plane::fit(&samples, corner.id.into())?;
    let depth_by_step = plane.depth_by(&samples, &painted.black);
    Ok(ColouredCorner { corner: on_plane(corner, window, &samples, &plane)?, depth_by_step })
}

/// The sample with its depth less by `step_m`, on the same ray.
fn nearer(sample: &Sample, step_m: f64) -> Sample {
    let point: Vector3<f64> = sample.point * (1.0 - step_m / sample.point.z);
    Sample { point, ..*sample }
}
