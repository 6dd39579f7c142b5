//! Where exactly a checkerboard corner is, and how sure that is.
//!
//! Around a corner at `c` two straight edges cross; with `d₁, d₂` the signed distances of a pixel
//! `p` to them, a lens that blurs with a Gaussian of width `s` and light that changes linearly with
//! `g`, the picture is
//!
//! ```text
//! I(p) = (a + b erf(d₁/(√2 s)) erf(d₂/(√2 s))) (1 + g·(p - p₀)),    dᵢ = nᵢ(θᵢ)·(p - c)
//! ```
//!
//! Its nine parameters `c, θ₁, θ₂, a, b, ln s, g` are fitted to the pixels of a disc by
//! Levenberg-Marquardt; the inverse normal matrix, scaled by the mean squared residual, is their
//! covariance. The product of two error functions is exact for edges at right angles and close for
//! others.
//!
//! After L. Krüger and C. Wöhler, *Accurate chequerboard corner localisation for camera
//! calibration*, Pattern Recognition Letters 32(10), 2011, who fit the same surface with one blur.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI};

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use crate::GrayImage;

/// A corner known to about a pixel, and the board around it.
#[derive(Debug, Clone, Copy)]
pub struct RoughCorner {
    /// About where, px.
    pub pixel: Vector2<f64>,
    /// From this corner to the next one along the board's x, px.
    pub along_x: Vector2<f64>,
    /// From this corner to the next one along the board's y, px.
    pub along_y: Vector2<f64>,
    /// Half the width of the clean cross between the markers of a ChArUco board, as a share of the
    /// cell; 1 where there are no markers.
    pub clean: f64,
}

/// A corner after the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedCorner {
    /// Where, px.
    pub pixel: Vector2<f64>,
    /// How sure, px².
    pub covariance: Matrix2<f64>,
    /// Standard deviation of the blur, px.
    pub blur_px: f64,
    /// White minus black, grey values.
    pub contrast: f64,
}

/// Why a corner was left out.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unfit {
    /// The picture ends too close to it.
    #[error("too close to the picture's edge")]
    AtTheEdge,
    /// The squares are too small to tell their edges apart.
    #[error("the squares are only {0:.1} px wide")]
    TooSmall(f64),
    /// The fit found nothing, or wandered away.
    #[error("the picture does not look like a corner there")]
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
/// Fewer pixels than this do not determine nine parameters.
const FEWEST_PIXELS: usize = 14;
/// Markers are cut out with this margin, px, for their blur.
const MARKER_MARGIN_PX: f64 = 2.0;
/// Most steps of the fit; it usually takes four.
const MOST_STEPS: usize = 30;
/// The fit has converged when the corner moves less than this, px: the next step, were it taken,
/// would be some hundred times smaller.
const STEP_PX: f64 = 3e-3;
/// The small disc's fit ends when the corner moves less than this, px.
const NEAR_STEP_PX: f64 = 0.05;
/// Radius of the small disc, px.
const NEAR_PX: f64 = 6.0;
/// Residuals above this share of the contrast are not a corner's.
const WORST_RESIDUAL: f64 = 0.25;
/// Rounding to 8 bits alone leaves this variance, grey values squared.
const ROUNDING_VARIANCE: f64 = 1.0 / 12.0;
/// Blurs stay in this range (px): a pixel's own square blurs by 0.29, more than the upper bound is
/// not a corner's. Without the lower bound an edge between two pixels would have no place.
const BLUR_PX: (f64, f64) = (0.29, 6.0);
/// A corner with a larger variance (px², both axes) was not measured.
const UNKNOWN_PX2: f64 = 1.0;
/// Edges that cross at a smaller angle (rad) do not fix a point.
const SHALLOWEST_RAD: f64 = 0.15;

type Parameters = SVector<f64, 9>;
type Normal = SMatrix<f64, 9, 9>;

/// Fits the corner model; `erf` is shared among corners.
///
/// Where a large disc sees more than the model knows (halos, glare, bent paper), a smaller one is
/// tried.
pub fn fit(image: &GrayImage, rough: &RoughCorner, erf: &Erf) -> Result<FittedCorner, Unfit> {
    let radius = radius(rough)?;
    fit_disc(image, rough, radius, erf).or_else(|unfit| {
        let smaller = SMALLER * radius;
        if smaller < SMALLEST_PX { Err(unfit) } else { fit_disc(image, rough, smaller, erf) }
    })
}

/// A small disc gets near, the whole one measures.
fn fit_disc(
    image: &GrayImage,
    rough: &RoughCorner,
    radius: f64,
    erf: &Erf,
) -> Result<FittedCorner, Unfit> {
    let small = Disc::gather(image, rough, radius.min(NEAR_PX))?;
    let (near, ..) = small.descend(small.start(rough), NEAR_STEP_PX, erf).ok_or(Unfit::NoCorner)?;
    let centre = small.place(&near);
    not_far(rough, &centre)?;
    let whole = Disc::gather(image, &RoughCorner { pixel: centre, ..*rough }, radius)?;
    let mut start = near;
    start.fixed_rows_mut::<2>(0).fill(0.0);
    let (at, normal, cost) = whole.descend(start, STEP_PX, erf).ok_or(Unfit::NoCorner)?;
    let fitted = whole.judge(&at, &normal, cost).ok_or(Unfit::NoCorner)?;
    not_far(rough, &fitted.pixel)?;
    Ok(fitted)
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

/// The pixels around a corner, relative to `centre`.
struct Disc {
    centre: Vector2<f64>,
    pixels: Vec<(f64, f64, f64)>,
}

impl Disc {
    fn gather(image: &GrayImage, rough: &RoughCorner, radius: f64) -> Result<Self, Unfit> {
        let centre = rough.pixel;
        let cells = Matrix2::from_columns(&[rough.along_x, rough.along_y]);
        let into_cells = cells.try_inverse().ok_or(Unfit::NoCorner)?;
        let margin = MARKER_MARGIN_PX / rough.along_x.norm().min(rough.along_y.norm());
        let hidden = |d: &Vector2<f64>| {
            let q = into_cells * d;
            q.x.abs().min(q.y.abs()) > rough.clean - margin
        };
        let (low_x, low_y) = ((centre.x - radius).ceil(), (centre.y - radius).ceil());
        let (high_x, high_y) = ((centre.x + radius).floor(), (centre.y + radius).floor());
        let (right, bottom) = (image.width() as f64 - 1.0, image.height() as f64 - 1.0);
        if !(low_x >= 0.0 && low_y >= 0.0 && high_x <= right && high_y <= bottom) {
            return Err(Unfit::AtTheEdge);
        }
        let mut pixels = Vec::with_capacity((4.0 * radius * radius) as usize);
        for y in low_y as usize..=high_y as usize {
            for x in low_x as usize..=high_x as usize {
                let d = Vector2::new(x as f64, y as f64) - centre;
                if d.norm_squared() <= radius * radius && !hidden(&d) {
                    pixels.push((d.x, d.y, f64::from(image.at(x, y))));
                }
            }
        }
        if pixels.len() < FEWEST_PIXELS {
            return Err(Unfit::TooSmall(radius / REACH));
        }
        Ok(Self { centre, pixels })
    }

    /// Levenberg-Marquardt until the corner moves less than `step_px`: parameters, `JᵀJ` and cost.
    fn descend(
        &self,
        start: Parameters,
        step_px: f64,
        erf: &Erf,
    ) -> Option<(Parameters, Normal, f64)> {
        let mut at = start;
        let (mut normal, mut gradient, mut cost) = self.linearise(&at, erf);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let step = damped_step(&normal, &gradient, damping)?;
            let mut next = at + step;
            next[6] = next[6].clamp(BLUR_PX.0.ln(), BLUR_PX.1.ln());
            let (n, g, c) = self.linearise(&next, erf);
            if c.is_finite() && c <= cost {
                (at, normal, gradient, cost) = (next, n, g, c);
                damping *= 0.1;
                if step[0].hypot(step[1]) < step_px {
                    return Some((at, normal, cost));
                }
            } else if damping > 1e6 {
                return Some((at, normal, cost)); // rounding: no step makes it better
            } else {
                damping *= 10.0;
            }
        }
        None
    }

    /// Where the corner of these parameters is in the picture.
    fn place(&self, at: &Parameters) -> Vector2<f64> {
        self.centre + Vector2::new(at[0], at[1])
    }

    /// From the board's directions and the mean greys of its quadrants.
    fn start(&self, rough: &RoughCorner) -> Parameters {
        let normal_angle = |along: &Vector2<f64>| along.x.atan2(-along.y);
        let (t1, t2) = (normal_angle(&rough.along_x), normal_angle(&rough.along_y));
        let count = self.pixels.len() as f64;
        let a = self.pixels.iter().map(|p| p.2).sum::<f64>() / count;
        let quadrant = |x: f64, y: f64| {
            let (d1, d2) = (t1.cos() * x + t1.sin() * y, t2.cos() * x + t2.sin() * y);
            d1.signum() * d2.signum()
        };
        let b = self.pixels.iter().map(|&(x, y, i)| (i - a) * quadrant(x, y)).sum::<f64>() / count;
        Parameters::from_column_slice(&[0.0, 0.0, t1, t2, a, 1.2 * b, 0.0, 0.0, 0.0])
    }

    /// `JᵀJ`, `Jᵀr` and `rᵀr` of `r = I - model`.
    fn linearise(&self, at: &Parameters, erf: &Erf) -> (Normal, Parameters, f64) {
        let model = Model::new(at);
        let (mut normal, mut gradient, mut cost) = ([[0.0; 9]; 9], [0.0; 9], 0.0);
        for &(x, y, grey) in &self.pixels {
            let (value, j) = model.at(x, y, erf);
            let r = grey - value;
            cost += r * r;
            // far from both edges only a, b and g matter
            if j[0] == 0.0 && j[1] == 0.0 {
                accumulate::<4>(&mut normal, &mut gradient, &j, r);
            } else {
                accumulate::<0>(&mut normal, &mut gradient, &j, r);
            }
        }
        let full = Normal::from_fn(|m, n| normal[m.min(n)][m.max(n)]);
        (full, Parameters::from(gradient), cost)
    }

    fn judge(&self, at: &Parameters, normal: &Normal, cost: f64) -> Option<FittedCorner> {
        let freedom = self.pixels.len() as f64 - 9.0;
        let variance = (cost / freedom).max(ROUNDING_VARIANCE);
        let blur_px = at[6].exp();
        let crossing = (at[2] - at[3]).sin().abs();
        let sound = variance.sqrt() < WORST_RESIDUAL * at[5].abs()
            && blur_px < 0.99 * BLUR_PX.1
            && crossing > SHALLOWEST_RAD.sin();
        let inverse = normal.cholesky()?.inverse() * variance;
        let covariance: Matrix2<f64> = inverse.fixed_view::<2, 2>(0, 0).into_owned();
        let known = covariance.determinant() > 0.0 && covariance.trace() < UNKNOWN_PX2;
        (sound && known).then(|| FittedCorner {
            pixel: self.place(at),
            covariance,
            blur_px,
            contrast: 2.0 * at[5].abs(),
        })
    }
}

/// Adds one pixel to the upper triangle of `JᵀJ` and to `Jᵀr`, columns `FIRST` and later.
#[inline]
fn accumulate<const FIRST: usize>(
    normal: &mut [[f64; 9]; 9],
    gradient: &mut [f64; 9],
    j: &[f64; 9],
    r: f64,
) {
    for m in FIRST..9 {
        gradient[m] += j[m] * r;
        for n in m..9 {
            normal[m][n] += j[m] * j[n];
        }
    }
}

fn damped_step(normal: &Normal, gradient: &Parameters, damping: f64) -> Option<Parameters> {
    let mut damped = *normal;
    for k in 0..9 {
        damped[(k, k)] *= 1.0 + damping;
    }
    Some(damped.cholesky()?.solve(gradient))
}

/// The model at one set of parameters: `cx cy θ₁ θ₂ a b ln(s) gx gy`.
struct Model {
    p: [f64; 9],
    n1: (f64, f64),
    n2: (f64, f64),
    /// `1/(√2 s)`
    scale: f64,
}

impl Model {
    fn new(at: &Parameters) -> Self {
        let p: [f64; 9] = at.as_slice().try_into().expect("nine parameters");
        let normal = |t: f64| (t.cos(), t.sin());
        Self { p, n1: normal(p[2]), n2: normal(p[3]), scale: FRAC_1_SQRT_2 * (-p[6]).exp() }
    }

    /// Grey value and its derivatives at a pixel.
    #[inline]
    fn at(&self, x: f64, y: f64, erf: &Erf) -> (f64, [f64; 9]) {
        let [cx, cy, _, _, a, b, _, gx, gy] = self.p;
        let (n1, n2) = (self.n1, self.n2);
        let (dx, dy) = (x - cx, y - cy);
        let (d1, d2) = (n1.0 * dx + n1.1 * dy, n2.0 * dx + n2.1 * dy);
        let (e1, slope1) = erf.at(d1 * self.scale);
        let (e2, slope2) = erf.at(d2 * self.scale);
        let light = 1.0 + gx * x + gy * y;
        let dark = a + b * e1 * e2;
        // ∂/∂d₁ and ∂/∂d₂
        let f1 = light * b * slope1 * e2 * self.scale;
        let f2 = light * b * slope2 * e1 * self.scale;
        let jacobian = [
            -(f1 * n1.0 + f2 * n2.0),
            -(f1 * n1.1 + f2 * n2.1),
            f1 * (n1.0 * dy - n1.1 * dx),
            f2 * (n2.0 * dy - n2.1 * dx),
            light,
            light * e1 * e2,
            -(f1 * d1 + f2 * d2),
            dark * x,
            dark * y,
        ];
        (light * dark, jacobian)
    }
}

/// The error function and its derivative, tabulated: cubic between nodes, good to 1e-7 (2e-6 where
/// it is cut off).
pub struct Erf {
    nodes: Vec<(f64, f64)>,
}

/// Nodes per unit.
const NODES: f64 = 32.0;
/// Beyond this the error function is 1 to 2e-6.
const ERF_END: f64 = 3.4;

impl Default for Erf {
    fn default() -> Self {
        Self::new()
    }
}

impl Erf {
    /// Integrates the Gaussian from node to node (Boole's rule).
    pub fn new() -> Self {
        let slope = |x: f64| FRAC_2_SQRT_PI * (-x * x).exp();
        let step = 1.0 / NODES;
        let mut value = 0.0;
        let nodes = (0..=(ERF_END * NODES) as usize + 1).map(|k| {
            let x = k as f64 * step;
            let node = (value, slope(x));
            let at = |s: f64| slope(x + s * step);
            value += step / 90.0
                * (7.0 * at(0.0)
                    + 32.0 * at(0.25)
                    + 12.0 * at(0.5)
                    + 32.0 * at(0.75)
                    + 7.0 * at(1.0));
            node
        });
        Self { nodes: nodes.collect() }
    }

    /// `erf(x)` and `erf'(x)`.
    #[inline]
    pub fn at(&self, x: f64) -> (f64, f64) {
        let (size, sign) = (x.abs(), x.signum());
        if size.is_nan() || size >= ERF_END {
            return (sign, 0.0);
        }
        let k = (size * NODES) as usize;
        let t = size * NODES - k as f64;
        let ((y0, m0), (y1, m1)) = (self.nodes[k], self.nodes[k + 1]);
        let (m0, m1) = (m0 / NODES, m1 / NODES);
        // Hermite: y0 + t m0 + t²(3Δ - 2 m0 - m1) + t³(m0 + m1 - 2Δ)
        let delta = y1 - y0;
        let (p, q) = (3.0 * delta - 2.0 * m0 - m1, m0 + m1 - 2.0 * delta);
        let value = y0 + t * (m0 + t * (p + t * q));
        let slope = (m0 + t * (2.0 * p + 3.0 * t * q)) * NODES;
        (sign * value, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::{Optics, Random, Scene};
    use crate::{Intrinsics, Pose, TargetModel};
    use nalgebra::{Vector3, Vector6};

    #[test]
    fn the_table_is_the_error_function() {
        let erf = Erf::new();
        for (x, wanted) in [(0.0, 0.0), (0.5, 0.520_499_877_8), (1.3, 0.934_007_944_9)] {
            assert!((erf.at(x).0 - wanted).abs() < 1e-7, "{x}");
            assert!((erf.at(-x).0 + wanted).abs() < 1e-7, "{x}");
        }
        let numeric = (erf.at(0.71 + 1e-5).0 - erf.at(0.71 - 1e-5).0) / 2e-5;
        assert!((erf.at(0.71).1 - numeric).abs() < 1e-6);
    }

    #[test]
    fn the_jacobian_matches_central_differences() {
        let erf = Erf::new();
        let at =
            Parameters::from_column_slice(&[0.3, -0.2, 0.4, 1.8, 110.0, -60.0, 0.2, 0.01, -0.02]);
        for (x, y) in [(0.5, 0.1), (-3.0, 2.0), (1.0, -4.0)] {
            let (_, analytic) = Model::new(&at).at(x, y, &erf);
            for k in 0..9 {
                let mut step = Parameters::zeros();
                step[k] = 1e-4;
                let ahead = Model::new(&(at + step)).at(x, y, &erf).0;
                let behind = Model::new(&(at - step)).at(x, y, &erf).0;
                let numeric = (ahead - behind) / 2e-4;
                assert!((analytic[k] - numeric).abs() < 2e-3 * (1.0 + numeric.abs()), "{k}");
            }
        }
    }

    /// Fits every corner of six pictures from starts 0.5 px off: errors and their covariances.
    fn errors(cell_px: f64, optics: &Optics) -> Vec<(Vector2<f64>, Matrix2<f64>)> {
        let mut random = Random::new(42);
        let erf = Erf::new();
        let mut all = vec![];
        for seed in 0..6 {
            let scene = scene(cell_px, &mut random);
            let picture = scene.picture(optics, seed);
            for (rough, truth) in rough_corners(&scene, &mut random) {
                if let Ok(fitted) = fit(&picture, &rough, &erf) {
                    all.push((fitted.pixel - truth, fitted.covariance));
                }
            }
        }
        all
    }

    /// A 10 x 7 board, tilted up to 45 degrees.
    fn scene(cell_px: f64, random: &mut Random) -> Scene {
        let focal = 1000.0;
        let (square, depth) = (0.02, 0.02 * focal / cell_px);
        let tilt = random.between(0.0, 0.78);
        let axis = random.between(0.0, std::f64::consts::TAU);
        let tilt = Vector6::new(tilt * axis.cos(), tilt * axis.sin(), 0.0, 0.0, 0.0, 0.0);
        let roll = Vector6::new(0.0, 0.0, random.between(-0.52, 0.52), 0.0, 0.0, 0.0);
        let centre = Vector6::new(0.0, 0.0, 0.0, -4.5 * square, -3.0 * square, 0.0);
        let away = Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::new(0.0, 0.0, depth));
        Scene {
            target: TargetModel::Checkerboard { columns: 10, rows: 7, square_mm: 20.0 },
            camera_from_target: away.retract(&tilt).retract(&roll).retract(&centre),
            intrinsics: Intrinsics::pinhole(800, 600, focal, focal, 399.5, 299.5),
        }
    }

    fn rough_corners(scene: &Scene, random: &mut Random) -> Vec<(RoughCorner, Vector2<f64>)> {
        let corners = scene.corners();
        let at = |id: u32| corners.iter().find(|c| c.0 == id).map(|c| c.1);
        let one = |&(id, truth): &(u32, Vector2<f64>)| {
            let next = |step: u32, last: bool| {
                let there = if last { truth - at(id - step)? } else { at(id + step)? - truth };
                Some(there)
            };
            let off = Vector2::new(random.between(-0.35, 0.35), random.between(-0.35, 0.35));
            let rough = RoughCorner {
                pixel: truth + off,
                along_x: next(1, id % 10 == 9)?,
                along_y: next(10, id / 10 == 6)?,
                clean: 1.0,
            };
            Some((rough, truth))
        };
        corners.iter().filter_map(one).collect()
    }

    fn rms(errors: &[(Vector2<f64>, Matrix2<f64>)]) -> f64 {
        (errors.iter().map(|e| e.0.norm_squared()).sum::<f64>() / errors.len() as f64).sqrt()
    }

    #[test]
    fn corners_are_found_to_a_few_hundredths_of_a_pixel() {
        // cell px, blur px, noise, goal px
        let cases = [
            (60.0, 0.6, 1.5, 0.009),
            (45.0, 0.9, 2.5, 0.014),
            (45.0, 2.0, 3.0, 0.019),
            (14.0, 0.7, 2.0, 0.010),
            (45.0, 1.0, 8.0, 0.034),
        ];
        for (cell_px, blur_px, noise, goal) in cases {
            let errors = errors(cell_px, &Optics { blur_px, noise, ..Optics::default() });
            assert!(errors.len() > 410, "{} corners", errors.len());
            assert!(rms(&errors) < goal, "{cell_px} {blur_px} {noise}: {}", rms(&errors));
            let ratio = expected_ratio(&errors);
            assert!((0.9..1.15).contains(&ratio), "{cell_px} {blur_px} {noise}: {ratio}");
        }
    }

    /// Mean of the squared errors over their covariances; 1 is expected.
    fn expected_ratio(errors: &[(Vector2<f64>, Matrix2<f64>)]) -> f64 {
        let one = |(e, c): &(Vector2<f64>, Matrix2<f64>)| e.dot(&(c.try_inverse().unwrap() * e));
        errors.iter().map(one).sum::<f64>() / (2.0 * errors.len() as f64)
    }

    #[test]
    fn light_that_fades_does_not_move_corners() {
        let optics = Optics { vignetting: 0.5, noise: 0.5, ..Optics::default() };
        assert!(rms(&errors(45.0, &optics)) < 0.006);
    }

    #[test]
    fn a_lens_out_of_focus_costs_little() {
        let optics = Optics { blur_px: 0.5, defocus_px: 2.0, ..Optics::default() };
        assert!(rms(&errors(45.0, &optics)) < 0.03);
    }

    #[test]
    fn a_flat_picture_has_no_corner() {
        let flat = GrayImage::new(60, 60, vec![90.0; 3600]).unwrap();
        let rough = RoughCorner {
            pixel: Vector2::new(30.0, 30.0),
            along_x: Vector2::new(20.0, 0.0),
            along_y: Vector2::new(0.0, 20.0),
            clean: 1.0,
        };
        assert_eq!(fit(&flat, &rough, &Erf::new()), Err(Unfit::NoCorner));
        let rough = RoughCorner { pixel: Vector2::new(3.0, 30.0), ..rough };
        assert_eq!(fit(&flat, &rough, &Erf::new()), Err(Unfit::AtTheEdge));
    }

    /// A checkerboard of whole black and white pixels, as a rasterised print has it.
    #[test]
    fn perfectly_sharp_corners_are_all_found() {
        let erf = Erf::new();
        for cell in [8.0, 14.77, 29.53, 59.06, 147.64] {
            let edge = |k: usize| 5.3 + cell * k as f64;
            let size = edge(7).ceil() as usize + 5;
            let index = |x: usize| ((x as f64 - edge(0)) / cell).floor() as i64;
            let grey = |x: usize, y: usize| {
                let board = |k: i64| (0..7).contains(&k);
                let black = board(index(x)) && board(index(y)) && (index(x) + index(y)) % 2 == 0;
                if black { 0.0 } else { 255.0 }
            };
            let pixels = (0..size * size).map(|k| grey(k % size, k / size)).collect();
            let image = GrayImage::new(size, size, pixels).unwrap();
            for (i, j) in (1..7).flat_map(|i| (1..7).map(move |j| (i, j))) {
                let on_edge = |k: usize| edge(k).ceil() - 0.5;
                let truth = Vector2::new(on_edge(i), on_edge(j));
                for off in [(0.0, 0.0), (0.4, -0.3), (-0.5, 0.5), (0.7, 0.2)] {
                    let rough = RoughCorner {
                        pixel: truth + Vector2::new(off.0, off.1),
                        along_x: Vector2::new(cell, 0.0),
                        along_y: Vector2::new(0.0, cell),
                        clean: 1.0,
                    };
                    let error = fit(&image, &rough, &erf).map(|f| (f.pixel - truth).norm());
                    assert!(error.is_ok_and(|e| e < 0.05), "{cell} {i} {j} {off:?}: {error:?}");
                }
            }
        }
    }
}
