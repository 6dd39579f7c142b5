//! Corners of the picture as 3D points on the scan.
//!
//! Around a corner the board is flat, so the inverse depth and the ray are linear in the pixel,
//!
//! ```text
//! 1/Z = α + β u + γ v,        X/Z = aₓ + bₓ u + cₓ v,        Y/Z = a_y + b_y u + c_y v
//! ```
//!
//! with `(u, v)` counted from the corner: the point is `(aₓ, a_y, 1)/α`. The rays come from the
//! scan's own grid, so an organised scan needs no intrinsics. The plane is found by least median of
//! squares and polished with Tukey's weights: holes, edges and flying points do not pull. Its window
//! spans half a cell to each side, as many black as white pixels, so that a step between the
//! colours cancels; windows of neighbours do not overlap, so that their errors are independent.
//!
//! The covariance is that of the pixel, carried along the plane, plus that of `α`, carried along the
//! ray: the scatter about the plane over the number of independent points, which correlation among
//! neighbouring pixels makes smaller (G. Bayley and J. Hammersley 1946).
//!
//! P. Rousseeuw, *Least median of squares regression*, JASA 79, 1984; J. Tukey's biweight after
//! A. Beaton, Technometrics 16, 1974.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

use crate::simulate::Random;
use crate::{ImageCorner, Intrinsics, Point, Scan, SurfaceCorner};

/// A corner that has no point on the scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missing {
    /// Which corner.
    pub id: u32,
    /// Why.
    pub reason: Reason,
}

/// Why a corner has no point on the scan.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Reason {
    /// The scan does not reach there.
    #[error("outside of the scan")]
    Outside,
    /// Too little was measured around it.
    #[error("a hole: only {points} points of {window} around it")]
    Hole {
        /// Points that were measured.
        points: usize,
        /// Points the window has room for.
        window: usize,
    },
    /// The points around it do not lie in one plane.
    #[error("a depth edge: only {share:.0} % of the points around it lie in one plane", share = 100.0 * .0)]
    Edge(f64),
    /// The points lie to one side, the corner beyond them.
    #[error("points on one side of it only")]
    OneSided,
    /// An unorganised scan, and nobody told the intrinsics.
    #[error("the scan is not a grid as large as the picture, and no intrinsics are known")]
    NoGrid,
}

/// The window's radius, as a share of the distance to the nearest corner.
const REACH: f64 = 0.5;
/// Limits of the radius, scan pixels.
const RADIUS: (f64, f64) = (2.5, 20.0);
/// Distance to the next corner (scan px) that is assumed for a corner alone.
const LONELY: f64 = 16.0;
/// Fewer points do not make a plane with a measured scatter.
const FEWEST_POINTS: usize = 12;
/// Less than this share of the window measured is a hole.
const HOLE: f64 = 0.5;
/// Less than this share of the points in one plane is an edge.
const ONE_PLANE: f64 = 0.6;
/// The points' centroid may be this far from the corner, in radii.
const ONE_SIDED: f64 = 0.4;
/// Planes tried by least median of squares: with half the points good, one of eight is.
const TRIES: usize = 40;
/// At most this many samples judge a try.
const JUDGES: usize = 150;
/// Tukey's bound, standard deviations.
const TUKEY: f64 = 4.685;
/// Mean of Tukey's weight of unit normal deviates.
const TUKEY_MEAN: f64 = 0.9151;
/// `Σ w r² / Σ w` of unit normal deviates: the weights make the scatter look smaller.
const TUKEY_SHRINK: f64 = 0.8281;
/// Variance of the fit over `scatter² (AᵀWA)⁻¹`, for unit normal deviates: `E[w² r²] E[w] / E[ψ']²`.
const TUKEY_COST: f64 = 0.9633;
/// Rounds of re-weighting.
const ROUNDS: usize = 6;
/// Median absolute value of a unit normal deviate.
const MAD: f64 = 0.6745;
/// The scatter is never taken below this share of the depth: single precision.
const LEAST_SCATTER: f64 = 1e-7;
/// Correlation of neighbouring residuals is believed up to this.
const MOST_CORRELATED: f64 = 0.85;
/// Added to the covariance, m²: (1 µm)², so that it can be inverted.
const FLOOR: f64 = 1e-12;
/// Sizes of picture and scan that agree in ratio to this are aligned pixel by pixel.
const SAME_RATIO: f64 = 0.01;
/// Side of the buckets (px) that sort an unorganised scan.
const BUCKET_PX: f64 = 16.0;

/// Lifts corners of a picture of `width x height` pixels onto its scan.
///
/// An organised scan must be pixel-aligned with the picture, as large or evenly scaled. An
/// unorganised one is projected with `intrinsics`. Points are in the camera frame, in metres.
pub fn lift(
    corners: &[ImageCorner],
    (width, height): (usize, usize),
    scan: &Scan,
    intrinsics: Option<&Intrinsics>,
) -> (Vec<SurfaceCorner>, Vec<Missing>) {
    let (mut found, mut missing) = (vec![], vec![]);
    let source = Source::of(scan, (width, height), intrinsics);
    for corner in corners {
        let lifted = match &source {
            Some(source) => source.lift(corner, spacing(corner, corners)),
            None => Err(Reason::NoGrid),
        };
        match lifted {
            Ok(surface) => found.push(surface),
            Err(reason) => missing.push(Missing { id: corner.id, reason }),
        }
    }
    (found, missing)
}

/// Distance to the nearest other corner, picture px.
fn spacing(corner: &ImageCorner, corners: &[ImageCorner]) -> f64 {
    let others = corners.iter().filter(|c| c.id != corner.id);
    others.map(|c| (c.pixel - corner.pixel).norm()).fold(f64::INFINITY, f64::min)
}

/// A measured point and its pixel, counted from the corner (scan px).
struct Sample {
    at: Vector2<f64>,
    point: Vector3<f64>,
    /// Its place in the grid, for the correlation of neighbours.
    cell: (i64, i64),
}

/// Points with their pixels, in buckets.
type Buckets = BTreeMap<(i64, i64), Vec<(Vector2<f64>, Vector3<f64>)>>;

enum Source<'a> {
    /// One point per scan pixel; scan pixels per picture pixel.
    Grid(&'a Scan, f64),
    /// Points with their pixels, in buckets.
    Cloud(Buckets),
}

impl<'a> Source<'a> {
    fn of(scan: &'a Scan, image: (usize, usize), intrinsics: Option<&Intrinsics>) -> Option<Self> {
        let (x, y) = (scan.width() as f64 / image.0 as f64, scan.height() as f64 / image.1 as f64);
        if scan.is_organised() && (x / y - 1.0).abs() < SAME_RATIO {
            return Some(Self::Grid(scan, x));
        }
        let camera = intrinsics?;
        let mut buckets = Buckets::new();
        for p in scan.points() {
            let point = Vector3::new(p[0].into(), p[1].into(), p[2].into());
            let finite = point.iter().all(|x: &f64| x.is_finite());
            if let Some(pixel) = camera.project(&point).filter(|_| finite) {
                buckets.entry(bucket(&pixel)).or_default().push((pixel, point));
            }
        }
        Some(Self::Cloud(buckets))
    }

    fn lift(&self, corner: &ImageCorner, spacing: f64) -> Result<SurfaceCorner, Reason> {
        let scale = if let Self::Grid(_, scale) = self { *scale } else { 1.0 };
        let centre = corner.pixel.add_scalar(0.5) * scale - Vector2::repeat(0.5);
        let spacing = if spacing.is_finite() { spacing * scale } else { LONELY };
        let radius = (REACH * spacing).clamp(RADIUS.0, RADIUS.1);
        let samples = self.around(&centre, radius)?;
        let plane = Plane::fit(&samples, corner.id.into())?;
        plane.check(&samples, radius)?;
        let rays = Rays::fit(&samples, &plane)?;
        let covariance = corner.covariance * (scale * scale);
        Ok(plane.corner(corner.id, &rays, &covariance, self.inflation(&samples, &plane)))
    }

    fn around(&self, centre: &Vector2<f64>, radius: f64) -> Result<Vec<Sample>, Reason> {
        match self {
            Self::Grid(scan, _) => grid_samples(scan, centre, radius),
            Self::Cloud(buckets) => cloud_samples(buckets, centre, radius),
        }
    }

    /// By how much fewer independent points there are than points.
    fn inflation(&self, samples: &[Sample], plane: &Plane) -> f64 {
        match self {
            Self::Grid(..) => {
                let along = |step| {
                    let r = correlation(samples, plane, step).clamp(0.0, MOST_CORRELATED);
                    (1.0 + r) / (1.0 - r)
                };
                along((1, 0)) * along((0, 1))
            }
            Self::Cloud(_) => 1.0,
        }
    }
}

fn bucket(pixel: &Vector2<f64>) -> (i64, i64) {
    ((pixel.x / BUCKET_PX).floor() as i64, (pixel.y / BUCKET_PX).floor() as i64)
}

fn grid_samples(scan: &Scan, centre: &Vector2<f64>, radius: f64) -> Result<Vec<Sample>, Reason> {
    let (right, bottom) = (scan.width() as f64 - 1.0, scan.height() as f64 - 1.0);
    let inside = (0.0..=right).contains(&centre.x) && (0.0..=bottom).contains(&centre.y);
    if !inside {
        return Err(Reason::Outside);
    }
    let (mut samples, mut window) = (vec![], 0);
    let span = |c: f64, last: f64| {
        ((c - radius).ceil().max(0.0) as usize)..=((c + radius).floor().min(last) as usize)
    };
    for y in span(centre.y, bottom) {
        for x in span(centre.x, right) {
            let at = Vector2::new(x as f64, y as f64) - centre;
            if at.norm() > radius {
                continue;
            }
            window += 1;
            if let Some(point) = scan.at(x, y).filter(|p| p.z > 0.0) {
                samples.push(Sample { at, point, cell: (x as i64, y as i64) });
            }
        }
    }
    let points = samples.len();
    if points < FEWEST_POINTS || (points as f64) < HOLE * window as f64 {
        return Err(Reason::Hole { points, window });
    }
    Ok(samples)
}

fn cloud_samples(
    buckets: &Buckets,
    centre: &Vector2<f64>,
    radius: f64,
) -> Result<Vec<Sample>, Reason> {
    let (low, high) = (bucket(&centre.add_scalar(-radius)), bucket(&centre.add_scalar(radius)));
    let cells = (low.0..=high.0).flat_map(|i| (low.1..=high.1).map(move |j| (i, j)));
    let near = cells.filter_map(|cell| buckets.get(&cell)).flatten();
    let samples: Vec<Sample> = near
        .map(|(pixel, point)| Sample { at: pixel - centre, point: *point, cell: (0, 0) })
        .filter(|s| s.at.norm() <= radius)
        .collect();
    match samples.len() {
        0 => Err(Reason::Outside),
        points if points < FEWEST_POINTS => Err(Reason::Hole { points, window: FEWEST_POINTS }),
        _ => Ok(samples),
    }
}

/// `1/Z = α + β u + γ v`.
struct Plane {
    coefficients: Vector3<f64>,
    weights: Vec<f64>,
    /// Standard deviation of `1/Z` about the plane.
    scatter: f64,
    /// `(AᵀWA)⁻¹`
    cofactor: Matrix3<f64>,
}

fn row(at: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(1.0, at.x, at.y)
}

impl Plane {
    fn fit(samples: &[Sample], seed: u64) -> Result<Self, Reason> {
        let (start, median) = least_median(samples, seed).ok_or(Reason::OneSided)?;
        let least = LEAST_SCATTER * start[0].abs();
        let mut scatter = (median / MAD).max(least);
        let mut plane =
            Self { coefficients: start, weights: vec![], scatter, cofactor: Matrix3::zeros() };
        for _ in 0..ROUNDS {
            let residuals = plane.residuals(samples);
            plane.weights = residuals.iter().map(|r| tukey(r / scatter)).collect();
            let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
            for (s, w) in samples.iter().zip(&plane.weights) {
                let a = row(&s.at);
                normal += a * a.transpose() * *w;
                right += a * (w / s.point.z);
            }
            let factor = normal.cholesky().ok_or(Reason::OneSided)?;
            plane.coefficients = factor.solve(&right);
            plane.cofactor = factor.inverse();
            scatter = plane.weighted_scatter(samples).max(least);
            plane.scatter = scatter;
        }
        Ok(plane)
    }

    fn residuals(&self, samples: &[Sample]) -> Vec<f64> {
        samples.iter().map(|s| 1.0 / s.point.z - row(&s.at).dot(&self.coefficients)).collect()
    }

    /// From the points that carry weight.
    fn weighted_scatter(&self, samples: &[Sample]) -> f64 {
        let squares = self.residuals(samples).into_iter().zip(&self.weights);
        let (sum, count) =
            squares.fold((0.0, 0.0), |(sum, count), (r, w)| (sum + w * r * r, count + w));
        (sum / (count - 3.0 * TUKEY_MEAN).max(1.0) / TUKEY_SHRINK).sqrt()
    }

    fn check(&self, samples: &[Sample], radius: f64) -> Result<(), Reason> {
        let share = self.weights.iter().filter(|w| **w > 0.0).count() as f64 / samples.len() as f64;
        if share < ONE_PLANE {
            return Err(Reason::Edge(share));
        }
        let total: f64 = self.weights.iter().sum();
        let weighted = samples.iter().zip(&self.weights).map(|(s, w)| s.at * *w);
        let centroid = weighted.sum::<Vector2<f64>>() / total;
        if centroid.norm() > ONE_SIDED * radius || self.coefficients[0] <= 0.0 {
            return Err(Reason::OneSided);
        }
        Ok(())
    }

    fn corner(&self, id: u32, rays: &Rays, pixel: &Matrix2<f64>, inflation: f64) -> SurfaceCorner {
        let [alpha, beta, gamma] =
            [self.coefficients[0], self.coefficients[1], self.coefficients[2]];
        let z = 1.0 / alpha;
        let ray = Vector3::new(rays.x[0], rays.y[0], 1.0);
        // ∂(r/ρ)/∂u = r_u/ρ - r ρ_u/ρ²
        let along =
            |rx: f64, ry: f64, slope: f64| Vector3::new(rx, ry, 0.0) * z - ray * (slope * z * z);
        let by_pixel = Matrix3x2::from_columns(&[
            along(rays.x[1], rays.y[1], beta),
            along(rays.x[2], rays.y[2], gamma),
        ]);
        let of_alpha = self.scatter * self.scatter * self.cofactor[(0, 0)] * TUKEY_COST * inflation;
        let covariance = by_pixel * pixel * by_pixel.transpose()
            + ray * ray.transpose() * (z.powi(4) * of_alpha)
            + Matrix3::identity() * FLOOR;
        SurfaceCorner { id, in_camera: Point::from_vector(ray * z), covariance }
    }
}

/// Tukey's biweight.
fn tukey(r: f64) -> f64 {
    let q = r / TUKEY;
    if q.abs() < 1.0 { (1.0 - q * q).powi(2) } else { 0.0 }
}

/// The plane through three samples whose median absolute residual is least, and that residual.
fn least_median(samples: &[Sample], seed: u64) -> Option<(Vector3<f64>, f64)> {
    let samples: Vec<&Sample> = samples.iter().step_by(samples.len().div_ceil(JUDGES)).collect();
    let mut random = Random::new(seed);
    let mut best: Option<(Vector3<f64>, f64)> = None;
    for _ in 0..TRIES {
        let mut pick = || samples[(random.unit() * samples.len() as f64) as usize];
        let three = [pick(), pick(), pick()];
        let a = Matrix3::from_rows(&three.map(|s| row(&s.at).transpose()));
        let b = Vector3::from_iterator(three.iter().map(|s| 1.0 / s.point.z));
        if a.determinant().abs() < 1.0 {
            continue; // (nearly) on a line
        }
        let plane = a.try_inverse()? * b;
        let mut off: Vec<f64> =
            samples.iter().map(|s| (1.0 / s.point.z - row(&s.at).dot(&plane)).abs()).collect();
        let middle = off.len() / 2;
        let median = *off.select_nth_unstable_by(middle, f64::total_cmp).1;
        if best.as_ref().is_none_or(|(_, least)| median < *least) {
            best = Some((plane, median));
        }
    }
    best
}

/// `X/Z` and `Y/Z`, linear in the pixel.
struct Rays {
    x: Vector3<f64>,
    y: Vector3<f64>,
}

impl Rays {
    fn fit(samples: &[Sample], plane: &Plane) -> Result<Self, Reason> {
        let (mut x, mut y) = (Vector3::zeros(), Vector3::zeros());
        for (s, w) in samples.iter().zip(&plane.weights) {
            x += row(&s.at) * (w * s.point.x / s.point.z);
            y += row(&s.at) * (w * s.point.y / s.point.z);
        }
        Ok(Self { x: plane.cofactor * x, y: plane.cofactor * y })
    }
}

/// Correlation of the residuals of neighbours.
fn correlation(samples: &[Sample], plane: &Plane, step: (i64, i64)) -> f64 {
    let residuals = plane.residuals(samples);
    let good = |k: usize| plane.weights[k] > 0.0;
    let places: BTreeMap<(i64, i64), usize> =
        samples.iter().enumerate().filter(|(k, _)| good(*k)).map(|(k, s)| (s.cell, k)).collect();
    let (mut product, mut square, mut pairs, mut count) = (0.0, 0.0, 0.0, 0.0);
    for (&(x, y), &k) in &places {
        square += residuals[k] * residuals[k];
        count += 1.0;
        if let Some(&next) = places.get(&(x + step.0, y + step.1)) {
            product += residuals[k] * residuals[next];
            pairs += 1.0;
        }
    }
    if pairs < 1.0 || square <= 0.0 {
        return 0.0;
    }
    let correlation = (product / pairs) / (square / count);
    // taking the plane off makes neighbours look opposed; and below twice its own error it is zero
    let bias = 3.0 / count;
    if correlation + bias > 2.0 / f64::sqrt(pairs) { correlation + bias } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::{DepthSensor, Scene};
    use crate::{Pose, TargetModel};
    use nalgebra::Vector6;

    fn scene() -> Scene {
        let turn = Vector6::new(0.3, -0.4, 0.2, 0.0, 0.0, 0.0);
        Scene {
            target: TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 },
            camera_from_target: Pose::from_parts(
                &Matrix3::identity(),
                Vector3::new(-0.08, -0.05, 0.6),
            )
            .retract(&turn),
            intrinsics: Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5),
        }
    }

    fn seen(scene: &Scene, sigma: f64, random: &mut Random) -> Vec<ImageCorner> {
        let covariance = Matrix2::identity() * sigma * sigma;
        let mut one = |(id, pixel): (u32, Vector2<f64>)| {
            let noise = Vector2::new(random.normal(), random.normal()) * sigma;
            ImageCorner { id, pixel: pixel + noise, covariance }
        };
        scene.corners().into_iter().map(&mut one).collect()
    }

    fn truth(scene: &Scene, id: u32) -> Vector3<f64> {
        (scene.camera_from_target * scene.target.corner(id).unwrap()).vector()
    }

    fn exact() -> DepthSensor {
        DepthSensor { sigma_at_1m: 0.0, ..DepthSensor::default() }
    }

    #[test]
    fn an_exact_plane_gives_exact_points() {
        let scene = scene();
        let corners = seen(&scene, 0.0, &mut Random::new(1));
        let (found, missing) = lift(&corners, (640, 480), &scene.scan(&exact(), 1), None);
        assert_eq!((found.len(), missing.len()), (54, 0));
        for corner in found {
            assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-7);
        }
    }

    #[test]
    fn a_scan_without_grid_gives_the_same_points() {
        let scene = scene();
        let corners = seen(&scene, 0.0, &mut Random::new(1));
        let grid = scene.scan(&exact(), 1);
        let cloud = Scan::new(grid.points().len(), 1, grid.points().to_vec()).unwrap();
        let (found, _) = lift(&corners, (640, 480), &cloud, Some(&scene.intrinsics));
        assert_eq!(found.len(), 54);
        for corner in found {
            assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-7);
        }
        let (found, missing) = lift(&corners, (640, 480), &cloud, None);
        assert!(found.is_empty() && missing.iter().all(|m| m.reason == Reason::NoGrid));
    }

    #[test]
    fn a_picture_of_twice_the_scans_size_gives_the_same_points() {
        let scene = scene();
        let large = Scene { intrinsics: scene.intrinsics.resized(2.0), ..scene.clone() };
        let corners = seen(&large, 0.0, &mut Random::new(1));
        let (found, _) = lift(&corners, (1280, 960), &scene.scan(&exact(), 1), None);
        assert_eq!(found.len(), 54);
        for corner in found {
            assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-7);
        }
    }

    #[test]
    fn errors_stay_inside_the_covariance() {
        let scene = scene();
        let mut random = Random::new(2);
        let sensor = DepthSensor { sigma_at_1m: 2e-3, ..DepthSensor::default() };
        let (mut sum, mut count) = (0.0, 0.0);
        for seed in 0..12 {
            let corners = seen(&scene, 0.05, &mut random);
            let (found, _) = lift(&corners, (640, 480), &scene.scan(&sensor, seed), None);
            for corner in found {
                let e = corner.in_camera.vector() - truth(&scene, corner.id);
                sum += e.dot(&(corner.covariance.try_inverse().unwrap() * e)) / 3.0;
                count += 1.0;
            }
        }
        let ratio = sum / count;
        assert!((0.85..1.15).contains(&ratio), "{ratio} of {count}");
    }

    fn with_points(scan: &Scan, change: impl Fn(usize, usize, [f32; 3]) -> [f32; 3]) -> Scan {
        let (w, h) = (scan.width(), scan.height());
        let all = scan.points().iter().enumerate().map(|(k, p)| change(k % w, k / w, *p));
        Scan::new(w, h, all.collect()).unwrap()
    }

    #[test]
    fn holes_and_depth_edges_are_named() {
        let scene = scene();
        let corners = seen(&scene, 0.0, &mut Random::new(3));
        let (hole, edge) = (corners[12].pixel, corners[40].pixel);
        let near = |c: Vector2<f64>, x: usize, y: usize| {
            (Vector2::new(x as f64, y as f64) - c).norm() < 9.0
        };
        let scan = with_points(&scene.scan(&exact(), 3), |x, y, p| {
            let step = if near(edge, x, y) && (x as f64) < edge.x { 0.9 } else { 1.0 };
            if near(hole, x, y) { [f32::NAN; 3] } else { p.map(|v| v * step) }
        });
        let (found, missing) = lift(&corners, (640, 480), &scan, None);
        assert_eq!(found.len() + missing.len(), 54);
        let reason = |id| missing.iter().find(|m| m.id == id).map(|m| m.reason);
        assert!(matches!(reason(12), Some(Reason::Hole { .. })), "{missing:?}");
        assert!(matches!(reason(40), Some(Reason::Edge(_) | Reason::OneSided)), "{missing:?}");
    }

    #[test]
    fn flying_points_do_not_pull() {
        let scene = scene();
        let corners = seen(&scene, 0.0, &mut Random::new(4));
        let scan = with_points(&scene.scan(&exact(), 4), |x, y, p| {
            if (x * 7 + y * 13) % 5 == 0 { p.map(|v| v * 1.1) } else { p }
        });
        let (found, _) = lift(&corners, (640, 480), &scan, None);
        assert_eq!(found.len(), 54);
        for corner in found {
            assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-6);
        }
    }

    #[test]
    fn a_corner_outside_of_the_scan_is_named() {
        let scene = scene();
        let mut corners = seen(&scene, 0.0, &mut Random::new(5));
        corners[0].pixel = Vector2::new(-40.0, 10.0);
        let (_, missing) = lift(&corners, (640, 480), &scene.scan(&exact(), 5), None);
        assert_eq!(missing[0], Missing { id: 0, reason: Reason::Outside });
    }
}
