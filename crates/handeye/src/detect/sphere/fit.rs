//! The fit of a ball to all points of a scan, along their rays.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use super::{
    Ball, FEWEST, NoBall,
    candidates::{Candidate, meets, off_axis},
};
use crate::{
    Point, Scan,
    detect::surface::{TUKEY, TUKEY_COST, inflation, tukey},
    math::{linalg::median, statistics::MAD},
};

/// Whether the diameter is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Size {
    Given,
    Free,
}

/// Rays farther from the centre than this part of the radius graze the ball, where pixels mix.
const GRAZING: f64 = 0.8;
/// Points this far from the ball, of its radius, are not looked at.
const FAR: f64 = 0.25;
/// Most rounds of step and weights.
const ROUNDS: usize = 60;
/// A step below this ends them, m.
const SETTLED: f64 = 1e-9;
/// But not before so many rounds: the scatter settles as well.
const LEAST_ROUNDS: usize = 5;
/// The scatter is never taken below this share of the distance: single precision.
const LEAST_SCATTER: f64 = 1e-7;
/// Added to the covariance, m²: (1 µm)².
const FLOOR: f64 = 1e-12;

/// A point of the scan near the ball.
struct Seen {
    ray: Vector3<f64>,
    distance: f64,
    cell: (i64, i64),
}

pub(super) struct Fit {
    sphere: Candidate,
    size: Size,
    scatter: f64,
    /// Residuals and places in the grid of the points that carry weight.
    residuals: Vec<((i64, i64), f64)>,
    cofactor: Matrix4<f64>,
    organised: bool,
}

impl Fit {
    /// # Errors
    /// [`NoBall::TooFew`] points.
    pub fn of(scan: &Scan, start: &Candidate, size: Size) -> Result<Self, NoBall> {
        let mut sphere = *start;
        let mut scatter = FAR * sphere.radius / TUKEY;
        let (mut cofactor, mut residuals) = (Matrix4::identity(), vec![]);
        let seen = near(scan, start);
        for round in 0..ROUNDS {
            let rows: Vec<_> = seen.iter().filter_map(|s| row(s, &sphere)).collect();
            let off = rows.iter().map(|r| r.1.abs()).filter(|e| *e < FAR * sphere.radius);
            let spread = median(off) / MAD;
            let least = LEAST_SCATTER * sphere.centre.norm();
            scatter = spread.min(if round < 2 { f64::INFINITY } else { 1.5 * scatter }).max(least);
            let (mut a, mut b) = (Matrix4::<f64>::zeros(), Vector4::zeros());
            residuals.clear();
            for (j, e, cell) in &rows {
                let w = tukey(e / scatter);
                if w > 0.0 {
                    a += j * j.transpose() * w;
                    b += j * (w * e);
                    residuals.push((*cell, *e));
                }
            }
            if residuals.len() < FEWEST {
                return Err(NoBall::TooFew { points: residuals.len() });
            }
            if size == Size::Given {
                a.fixed_view_mut::<3, 1>(0, 3).fill(0.0);
                a.fixed_view_mut::<1, 3>(3, 0).fill(0.0);
                (a[(3, 3)], b[3]) = (1.0, 0.0);
            }
            let factor = a.cholesky().ok_or(NoBall::TooFew { points: residuals.len() })?;
            let step = factor.solve(&b);
            cofactor = factor.inverse();
            sphere.centre += step.xyz();
            sphere.radius += step.w;
            if round >= LEAST_ROUNDS && step.norm() < SETTLED {
                break;
            }
        }
        let organised = scan.is_organised();
        Ok(Self { sphere, size, scatter, residuals, cofactor, organised })
    }

    pub fn ball(&self) -> Ball {
        let more = if self.organised { inflation(&self.residuals, 4.0) } else { 1.0 };
        let covariance = self.cofactor * (self.scatter * self.scatter * TUKEY_COST * more);
        let own: Matrix3<f64> = covariance.fixed_view::<3, 3>(0, 0).into_owned();
        let squares: f64 = self.residuals.iter().map(|r| r.1 * r.1).sum();
        let sigma_radius = if self.size == Size::Free { covariance[(3, 3)].sqrt() } else { 0.0 };
        Ball {
            centre: Point::from_vector(self.sphere.centre),
            covariance: own + Matrix3::identity() * FLOOR,
            diameter_m: 2.0 * self.sphere.radius,
            sigma_diameter_m: 2.0 * sigma_radius,
            points: self.residuals.len(),
            rms_m: (squares / self.residuals.len() as f64).sqrt(),
        }
    }
}

/// Points whose rays pass the ball, and which are not far from it.
fn near(scan: &Scan, start: &Candidate) -> Vec<Seen> {
    let width = scan.width().max(1);
    let one = |(k, p): (usize, &[f32; 3])| {
        let p = Vector3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
        let finite = p.iter().all(|x| x.is_finite()) && p.z > 0.0;
        let close = finite
            && (p - start.centre).norm() < 2.0 * start.radius
            && off_axis(&p, &start.centre) < 1.2 * start.radius;
        let cell = ((k % width) as i64, (k / width) as i64);
        close.then(|| Seen { ray: p / p.norm(), distance: p.norm(), cell })
    };
    scan.points().iter().enumerate().filter_map(one).collect()
}

/// `∂t/∂(c, r)` and `e`, with the place in the grid: with the outward normal `q` where the ray meets
/// the ball, `∂t/∂c = q/(q·u)` and `∂t/∂r = 1/(q·u)`.
fn row(s: &Seen, sphere: &Candidate) -> Option<(Vector4<f64>, f64, (i64, i64))> {
    let across = sphere.centre - s.ray * s.ray.dot(&sphere.centre);
    if across.norm() > GRAZING * sphere.radius {
        return None;
    }
    let t = meets(&s.ray, sphere)?;
    let q = (s.ray * t - sphere.centre) / sphere.radius;
    let along = q.dot(&s.ray);
    Some(((q / along).push(1.0 / along), s.distance - t, s.cell))
}
