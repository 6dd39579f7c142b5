//! What, besides lens and sensor, makes an image of a board hard.

use nalgebra::{Vector2, Vector3};

use super::{Clutter, Optics, Scene};
use crate::{
    Camera, Point, Pose, Target, TargetModel, math::random::Random, simulate::pattern::noise_at,
};

/// How light, print and surroundings differ from a flat, faultless, evenly lit board alone.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Conditions {
    /// How the print differs from its model.
    pub print: PrintErrors,
    /// Light that one side gets less of.
    pub light: Slope,
    /// A reflection.
    pub glare: Option<Glare>,
    /// Something in front of the board.
    pub occlusion: Option<Occlusion>,
    /// What is behind the board; a plain grey without.
    pub clutter: Option<Clutter>,
    /// Further boards; they lie behind the scene's own.
    pub others: Vec<(TargetModel, Pose<Camera, Target>)>,
}

/// How a print differs from its model.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PrintErrors {
    /// Standard deviation, per axis, of each corner's place, mm; the print between is stretched.
    pub corner_mm: f64,
    /// By how much it is too large, along x and y: 0.01 for one percent.
    pub scale: [f64; 2],
    /// How far the ends of x lie behind the middle, mm: the board is bent like a part of a parabola.
    pub bend_mm: f64,
    /// Of the corners' places.
    pub seed: u64,
}

/// Light that falls off along one direction.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Slope {
    /// Share of the light that is missing where the image ends.
    pub share: f64,
    /// Direction in which it falls off, rad, from x to y.
    pub towards_rad: f64,
}

/// A smooth bright blob on the board, too bright for the sensor in its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glare {
    /// Share of the board's area where even black is white in the image.
    pub share: f64,
    /// Middle of the blob: from 0 to 1 across the corners along x and y.
    pub at: [f64; 2],
}

/// Something opaque before the board, with a texture of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Occlusion {
    /// Its outline.
    pub shape: Shape,
    /// Its mean grey.
    pub grey: f64,
    /// Of its texture.
    pub seed: u64,
}

/// An outline in the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// All on one side of a straight line.
    Side {
        /// Share of the board's area that is hidden.
        share: f64,
        /// Which side, as the direction from the board's middle, rad, from x to y.
        towards_rad: f64,
    },
    /// A disc.
    Disc {
        /// Share of the board's area that is hidden.
        share: f64,
        /// Its middle: from 0 to 1 across the corners along x and y.
        at: [f64; 2],
    },
}

/// A corner of the board as it is in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrueCorner {
    /// Which corner of the target.
    pub id: u32,
    /// Where, exactly.
    pub pixel: Vector2<f64>,
    /// Whether it can be seen; `None` close to the edge of what hides it.
    pub visible: Option<bool>,
}

/// Points along each direction of the board that stand for its area.
const AREA_STEPS: usize = 65;
/// Glare is this many times as bright in its middle as needed to turn black into white.
const GLARE_PEAK: f64 = 4.0;
/// Grey values by which what hides the board varies.
const TEXTURE_CONTRAST: f64 = 50.0;
/// Size of its grain, px.
const GRAIN_PX: f64 = 6.0;
/// Within this distance (px) of the edge of what hides it, a corner is neither visible nor hidden.
const UNSURE_PX: f64 = 10.0;

impl Scene {
    /// The exact pixels of the corners under `conditions`, and whether they can be seen.
    pub fn corners_under(&self, conditions: &Conditions, optics: &Optics) -> Vec<TrueCorner> {
        let cover = conditions.occlusion.map(|o| Cover::new(self, &o.shape));
        let glow = conditions.glare.map(|g| Glow::new(self, &g, optics));
        let paper = Paper::new(&self.target, &conditions.print);
        let state = |pixel: &Vector2<f64>| {
            let under_cover = cover.as_ref().map_or(f64::NEG_INFINITY, |c| c.depth(pixel));
            let in_glare = glow.as_ref().map_or(f64::NEG_INFINITY, |g| g.depth(pixel));
            let depth = under_cover.max(in_glare);
            (depth.abs() > UNSURE_PX).then_some(depth < 0.0)
        };
        let corners = self.target.corners().into_iter().enumerate();
        corners
            .filter_map(|(id, c)| {
                let placed = paper.as_ref().map_or(c, |p| p.placed(&c.vector().xy()));
                let pixel = self.pixel_in_picture(&placed)?;
                Some(TrueCorner { id: id as u32, pixel, visible: state(&pixel) })
            })
            .collect()
    }

    /// Pixels of points spread evenly over the area of the board's corners.
    fn area(&self) -> Vec<Vector2<f64>> {
        let step = |k: usize| (k as f64 + 0.5) / AREA_STEPS as f64;
        let all = (0..AREA_STEPS * AREA_STEPS)
            .map(|k| [step(k % AREA_STEPS), step(k / AREA_STEPS)])
            .filter_map(|at| self.pixel_across(&at));
        all.collect()
    }

    /// Pixel of a place given from 0 to 1 across the corners along x and y.
    fn pixel_across(&self, at: &[f64; 2]) -> Option<Vector2<f64>> {
        let (low, high) = extent(&self.target);
        let across = Vector2::new(at[0], at[1]).component_mul(&(high - low)) + low;
        let in_camera = self.camera_from_target * Point::new(across.x, across.y, 0.0);
        self.intrinsics.project(&in_camera.vector())
    }
}

/// Least and largest coordinates of the corners, m.
fn extent(target: &TargetModel) -> (Vector2<f64>, Vector2<f64>) {
    let corners: Vec<_> = target.corners().iter().map(|c| c.vector().xy()).collect();
    let fold = |f: fn(f64, f64) -> f64| {
        let all = corners.iter().copied();
        all.reduce(|a, b| a.zip_map(&b, f)).unwrap_or_else(Vector2::zeros)
    };
    (fold(f64::min), fold(f64::max))
}

/// The value below which `share` of all lie.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let at = (share.clamp(0.0, 1.0) * values.len() as f64).round() as usize;
    values.get(at.min(values.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

/// An occlusion's outline, in pixels.
pub(super) enum Cover {
    Side { normal: Vector2<f64>, from: f64 },
    Disc { middle: Vector2<f64>, radius: f64 },
}

impl Cover {
    pub(super) fn new(scene: &Scene, shape: &Shape) -> Self {
        let area = scene.area();
        match *shape {
            Shape::Side { share, towards_rad } => {
                let normal = Vector2::new(towards_rad.cos(), towards_rad.sin());
                let along = area.iter().map(|p| p.dot(&normal)).collect();
                Self::Side { normal, from: quantile(along, 1.0 - share) }
            }
            Shape::Disc { share, at } => {
                let middle = scene.pixel_across(&at).unwrap_or_else(Vector2::zeros);
                let away = area.iter().map(|p| (p - middle).norm()).collect();
                Self::Disc { middle, radius: quantile(away, share) }
            }
        }
    }

    /// How deep (px) below it a pixel lies; negative outside.
    pub(super) fn depth(&self, pixel: &Vector2<f64>) -> f64 {
        match self {
            Self::Side { normal, from } => pixel.dot(normal) - from,
            Self::Disc { middle, radius } => radius - (pixel - middle).norm(),
        }
    }
}

/// Grey of an occlusion at a pixel.
pub(super) fn texture_of(occlusion: &Occlusion, pixel: &Vector2<f64>) -> f64 {
    occlusion.grey + TEXTURE_CONTRAST * (noise_at(occlusion.seed, &(pixel / GRAIN_PX)) - 0.5)
}

/// A glare's light, in pixels: a Gaussian.
pub(super) struct Glow {
    middle: Vector2<f64>,
    /// Within it, black is white.
    radius: f64,
    peak: f64,
}

impl Glow {
    pub(super) fn new(scene: &Scene, glare: &Glare, optics: &Optics) -> Self {
        let middle = scene.pixel_across(&glare.at).unwrap_or_else(Vector2::zeros);
        let away = scene.area().iter().map(|p| (p - middle).norm()).collect();
        let peak = GLARE_PEAK * (WHITEST - optics.black);
        Self { middle, radius: quantile(away, glare.share), peak }
    }

    /// Grey values that it adds at a pixel.
    pub(super) fn at(&self, pixel: &Vector2<f64>) -> f64 {
        let ratio = (pixel - self.middle).norm_squared() / (self.radius * self.radius).max(1e-12);
        self.peak * GLARE_PEAK.powf(-ratio)
    }

    fn depth(&self, pixel: &Vector2<f64>) -> f64 {
        self.radius - (pixel - self.middle).norm()
    }
}

/// The largest grey value.
pub(super) const WHITEST: f64 = 255.0;

impl Slope {
    /// Share of the light at a place, given in halves of the image's size from its middle.
    pub(super) fn light(&self, at: &Vector2<f64>) -> f64 {
        let along = Vector2::new(self.towards_rad.cos(), self.towards_rad.sin());
        let farthest = along.abs().sum();
        1.0 - self.share * 0.5 * (1.0 + at.dot(&along) / farthest)
    }
}

/// A print with errors: where each of its places really is.
pub(super) struct Paper {
    errors: PrintErrors,
    /// First corner, and distance between corners (m).
    first: Vector2<f64>,
    pitch: f64,
    /// Middle of the corners, and half of their extent along x (m).
    middle: Vector2<f64>,
    reach: f64,
    /// Displacements (m) of the corners, and of the places beyond them where corners would be.
    columns: i64,
    shifts: Vec<Vector2<f64>>,
}

/// Displaced places beyond the outermost corners, in pitches.
const BEYOND: i64 = 3;
/// Steps until a displaced place is found; each is a fifth and less of the one before.
const INVERSION_STEPS: usize = 8;

impl Paper {
    /// `None` for a faultless print.
    pub(super) fn new(target: &TargetModel, errors: &PrintErrors) -> Option<Self> {
        let faultless = PrintErrors { seed: errors.seed, ..PrintErrors::default() };
        if *errors == faultless {
            return None;
        }
        let (low, high) = extent(target);
        let pitch = target.pitch_m();
        let places = |length: f64| (length / pitch).round() as i64 + 1 + 2 * BEYOND;
        let (columns, rows) = (places(high.x - low.x), places(high.y - low.y));
        let mut random = Random::new(errors.seed ^ 0x9a9e);
        let mut shift = || 1e-3 * errors.corner_mm * random.normal3().xy();
        Some(Self {
            errors: *errors,
            first: low,
            pitch,
            middle: 0.5 * (low + high),
            reach: 0.5 * (high.x - low.x),
            columns,
            shifts: (0..columns * rows).map(|_| shift()).collect(),
        })
    }

    /// Where a place of the faultless print is, m.
    pub(super) fn placed(&self, print: &Vector2<f64>) -> Point<Target> {
        let [x, y] = self.errors.scale;
        let at = (print + self.shift(print)).component_mul(&Vector2::new(1.0 + x, 1.0 + y));
        Point::new(at.x, at.y, self.height(&at))
    }

    /// Which place of the faultless print is at `at`.
    pub(super) fn print(&self, at: &Vector2<f64>) -> Vector2<f64> {
        let [x, y] = self.errors.scale;
        let scaled = at.component_div(&Vector2::new(1.0 + x, 1.0 + y));
        (0..INVERSION_STEPS).fold(scaled, |print, _| scaled - self.shift(&print))
    }

    /// How far the board lies behind its plane at `at`, m.
    pub(super) fn height(&self, at: &Vector2<f64>) -> f64 {
        1e-3 * self.errors.bend_mm * ((at.x - self.middle.x) / self.reach).powi(2)
    }

    /// Between the corners' displacements, and flat at the corners: edges stay straight there.
    fn shift(&self, print: &Vector2<f64>) -> Vector2<f64> {
        let at = (print - self.first) / self.pitch + Vector2::repeat(BEYOND as f64);
        let rows = self.shifts.len() as i64 / self.columns;
        let cell = |x: f64, n: i64| (x.floor() as i64).clamp(0, n - 2);
        let (i, j) = (cell(at.x, self.columns), cell(at.y, rows));
        let flat = |x: f64| x * x * x * ((6.0 * x - 15.0) * x + 10.0);
        let part = |x: f64, i: i64| flat((x - i as f64).clamp(0.0, 1.0));
        let (x, y) = (part(at.x, i), part(at.y, j));
        let shift = |i: i64, j: i64| self.shifts[(j * self.columns + i) as usize];
        (shift(i, j) * (1.0 - x) + shift(i + 1, j) * x) * (1.0 - y)
            + (shift(i, j + 1) * (1.0 - x) + shift(i + 1, j + 1) * x) * y
    }
}

/// Where a ray meets a bent board; `meet` has the place where it meets the plane of a height.
pub(super) fn meet_bent(
    paper: &Paper,
    meet: impl Fn(f64) -> Option<Vector2<f64>>,
) -> Option<Vector2<f64>> {
    (0..INVERSION_STEPS).try_fold(meet(0.0)?, |at, _| meet(paper.height(&at)))
}

/// Where a place of the print is, in the Target frame (m).
pub(super) fn on_paper(paper: Option<&Paper>, print: &Vector2<f64>) -> Vector3<f64> {
    let flat = Point::<Target>::new(print.x, print.y, 0.0);
    paper.map_or(flat, |p| p.placed(print)).vector()
}
