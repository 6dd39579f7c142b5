//! The robust fit of a pose to corners in an image and on a scan.

use nalgebra::{
    Isometry3, Matrix2, Matrix2x6, Matrix3, Matrix3x6, Matrix6, Rotation3, UnitQuaternion, Vector2,
    Vector3, Vector6,
};

use super::{
    PosedTarget,
    start::{translation, two_rotations},
};
use crate::{
    Error, ImageCorner, Intrinsics, Pose, SurfaceCorner, TargetModel, TargetPose,
    detect::homography,
    math::{
        lie::{self, hat},
        linalg::median,
        optimize::{self, Damping, Problem, Rules, Singular, Stop, Tried},
    },
};

/// Huber's bound: beyond this many standard deviations a corner pulls with constant force.
const HUBER: f64 = 1.5;
/// Corners farther than this many standard deviations are left out.
const FARTHEST: f64 = 5.0;
/// Rounds of re-weighting; three suffice for a few bad corners.
const ROUNDS: usize = 4;
/// Of one fit with weights held still.
const RULES: Rules = Rules {
    most_steps: 50,
    damping: Damping { least: 1e-12, most: 1e8, ..Damping::from(1e-6) },
    slack: 0.0,
    singular: Singular::Ends,
};
/// A step this small (rad and m alike) ends the run.
const STEP: f64 = 1e-11;
/// Equations' worth of belief in what other images say about lens model and print.
const TYPICAL_EQUATIONS: f64 = 20.0;
/// Four corners determine a pose.
const FEWEST: usize = 4;
/// Half of all squared lengths of a 2-vector of unit normal deviates are below this.
const CHI2_2_MEDIAN: f64 = 1.386_294_361;
/// Half of all lengths of a 3-vector of unit normal deviates are below this.
const FELT_MEDIAN: f64 = 1.538_17;

/// A corner in the image, with its place on the board.
pub(in crate::detect) struct Seen {
    pub id: u32,
    pub in_target: Vector3<f64>,
    pub pixel: Vector2<f64>,
    pub covariance: Matrix2<f64>,
    pub weight: f64,
}

/// A corner in the scan.
pub(in crate::detect) struct Felt {
    pub in_target: Vector3<f64>,
    pub in_camera: Vector3<f64>,
    pub information: Matrix3<f64>,
    pub weight: f64,
}

/// A pose, ready for many points.
pub(in crate::detect) struct At {
    rotation: Matrix3<f64>,
    translation: Vector3<f64>,
}

impl At {
    pub fn of(pose: &Isometry3<f64>) -> Self {
        let rotation = pose.rotation.to_rotation_matrix().into_inner();
        Self { rotation, translation: pose.translation.vector }
    }
}

pub(in crate::detect) struct Fit<'a> {
    pub seen: Vec<Seen>,
    pub felt: Vec<Felt>,
    pub intrinsics: &'a Intrinsics,
    /// `τ²`, px².
    excess: f64,
    /// What other images say it is.
    pub typical_excess: Option<f64>,
    /// Factor on the covariances of the 3D corners.
    pub felt_scale: f64,
}

impl<'a> Fit<'a> {
    pub fn new(
        corners: &[ImageCorner],
        surface: &[SurfaceCorner],
        target: &TargetModel,
        intrinsics: &'a Intrinsics,
    ) -> Result<Self, Error> {
        let at = |id| target.corner(id).map(|p| p.vector());
        let seen = |c: &ImageCorner| {
            let finite = c.pixel.iter().chain(c.covariance.iter()).all(|x| x.is_finite());
            let sound = finite && c.covariance.cholesky().is_some();
            let in_target = at(c.id).filter(|_| sound)?;
            let &ImageCorner { id, pixel, covariance } = c;
            Some(Seen { id, in_target, pixel, covariance, weight: 1.0 })
        };
        let felt = |c: &SurfaceCorner| {
            let information =
                c.covariance.try_inverse().filter(|m| m.iter().all(|x| x.is_finite()))?;
            let in_camera = c.in_camera.vector();
            Some(Felt { in_target: at(c.id)?, in_camera, information, weight: 1.0 })
        };
        let seen: Vec<Seen> = corners.iter().filter_map(seen).collect();
        if seen.len() < FEWEST {
            return Err(Error::TooFewPoints { found: seen.len(), needed: FEWEST });
        }
        let felt = surface.iter().filter_map(felt).collect();
        Ok(Self { seen, felt, intrinsics, excess: 0.0, typical_excess: None, felt_scale: 1.0 })
    }

    /// Both solutions of the homography.
    pub fn starts(&self) -> Result<Vec<Isometry3<f64>>, Error> {
        let pairs: Vec<(Vector3<f64>, Vector2<f64>)> = self
            .seen
            .iter()
            .filter_map(|c| Some((c.in_target, self.intrinsics.undistort(&c.pixel)?)))
            .collect();
        let undetermined = || Error::NotDetermined {
            what: "the target's corners in the image lie on one line".into(),
        };
        let centre = pairs.iter().map(|p| p.0).sum::<Vector3<f64>>() / pairs.len().max(1) as f64;
        let from: Vec<_> = pairs.iter().map(|p| (p.0 - centre).xy()).collect();
        let to: Vec<_> = pairs.iter().map(|p| p.1).collect();
        let h = homography::fit(&from, &to).ok_or_else(undetermined)?;
        let rotations = two_rotations(&h).ok_or_else(undetermined)?;
        let starts = rotations.iter().filter_map(|r| {
            let t = translation(r, &from, &to)?;
            let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix(r));
            Some(Isometry3::from_parts((t - r * centre).into(), rotation))
        });
        Ok(starts.collect())
    }

    /// Robust fit, then a plain one without the corners that do not belong.
    pub(crate) fn polish(&mut self, start: Isometry3<f64>) -> Option<PosedTarget> {
        (self.excess, self.felt_scale) = (0.0, 1.0);
        self.reweight(|_| 1.0);
        let mut pose = self.minimise(start)?;
        for _ in 0..ROUNDS {
            let scale = self.median_scale(&pose);
            self.reweight_by(&pose, scale, |d| (HUBER / d).min(1.0));
            pose = self.minimise(pose)?;
        }
        let scale = self.median_scale(&pose);
        self.reweight_by(&pose, scale, |d| if d < FARTHEST { 1.0 } else { 0.0 });
        for _ in 0..ROUNDS {
            pose = self.minimise(pose)?;
            self.estimate_excess(&pose);
        }
        pose = self.minimise(pose)?;
        self.summary(&pose)
    }

    /// The pose among these that fits best as it is.
    pub fn nearest(&self, poses: &[TargetPose]) -> Option<Isometry3<f64>> {
        let with_cost = |p: &TargetPose| {
            let pose = *p.camera_from_target.iso();
            (self.linearise(&pose).cost, pose)
        };
        let nearest = poses.iter().map(with_cost).min_by(|a, b| a.0.total_cmp(&b.0))?;
        nearest.0.is_finite().then_some(nearest.1)
    }

    fn reweight(&mut self, weight: impl Fn(f64) -> f64) {
        self.seen.iter_mut().for_each(|c| c.weight = weight(0.0));
        self.felt.iter_mut().for_each(|c| c.weight = weight(0.0));
    }

    /// Weights by distance in standard deviations; `scale` multiplies those of the image.
    fn reweight_by(&mut self, pose: &Isometry3<f64>, scale: f64, weight: impl Fn(f64) -> f64) {
        let at = At::of(pose);
        let seen: Vec<f64> = self.seen.iter().map(|c| self.distance(&at, c)).collect();
        for (corner, d) in self.seen.iter_mut().zip(seen) {
            corner.weight = weight((d / scale).max(1e-12));
        }
        let felt: Vec<f64> = self.felt.iter().map(|c| felt_distance(pose, c)).collect();
        let felt_scale = (median(felt.iter().copied()) / FELT_MEDIAN).max(1.0);
        for (corner, d) in self.felt.iter_mut().zip(felt) {
            corner.weight = weight((d / felt_scale).max(1e-12));
        }
    }

    /// Distance of a corner from the model in its own standard deviations.
    fn distance(&self, at: &At, corner: &Seen) -> f64 {
        let Some((r, _)) = self.residual(at, corner) else { return f64::INFINITY };
        let information = self.information(corner);
        r.dot(&(information * r)).sqrt()
    }

    /// How many times larger residuals are than the covariances say (at least 1), by the median and P.
    /// Rousseeuw's factor for few corners, whose residuals a pose makes small (*Least median of squares
    /// regression*, 1984).
    fn median_scale(&self, pose: &Isometry3<f64>) -> f64 {
        let at = At::of(pose);
        let all = self.seen.iter().map(|c| self.distance(&at, c));
        let freedom = (2.0 * self.seen.len() as f64 - 6.0).max(1.0);
        ((1.0 + 5.0 / freedom) * median(all) / CHI2_2_MEDIAN.sqrt()).max(1.0)
    }

    pub fn information(&self, corner: &Seen) -> Matrix2<f64> {
        let whole = corner.covariance + Matrix2::identity() * self.excess;
        whole.try_inverse().unwrap_or_else(Matrix2::zeros)
    }

    /// `π(T p) - u` and its derivative by `δ` of `T exp(δ)`: of every row `b` of `∂π R`, that is `p × b` and `b`.
    #[inline]
    pub fn residual(&self, at: &At, corner: &Seen) -> Option<(Vector2<f64>, Matrix2x6<f64>)> {
        let p = &corner.in_target;
        let (pixel, by_point) =
            self.intrinsics.project_with_jacobian(&(at.rotation * p + at.translation))?;
        let b = by_point * at.rotation;
        let mut j = Matrix2x6::zeros();
        for i in 0..2 {
            let (x, y, z) = (b[(i, 0)], b[(i, 1)], b[(i, 2)]);
            let turns = [p.y * z - p.z * y, p.z * x - p.x * z, p.x * y - p.y * x];
            for (k, value) in turns.into_iter().chain([x, y, z]).enumerate() {
                j[(i, k)] = value;
            }
        }
        Some((pixel - corner.pixel, j))
    }

    /// Infinite cost when a corner is behind the camera.
    fn linearise(&self, pose: &Isometry3<f64>) -> Normal {
        let mut sum = Normal { h: Matrix6::zeros(), g: Vector6::zeros(), cost: 0.0 };
        let at = At::of(pose);
        for corner in self.seen.iter().filter(|c| c.weight > 0.0) {
            let Some((r, j)) = self.residual(&at, corner) else {
                return Normal { cost: f64::INFINITY, ..sum };
            };
            let w = self.information(corner) * corner.weight;
            let (weighted, wr) = (w * j, w * r);
            for a in 0..6 {
                for b in 0..=a {
                    sum.h[(a, b)] += j[(0, a)] * weighted[(0, b)] + j[(1, a)] * weighted[(1, b)];
                }
                sum.g[a] += j[(0, a)] * wr.x + j[(1, a)] * wr.y;
            }
            sum.cost += r.dot(&wr);
        }
        sum.h.fill_upper_triangle_with_lower_triangle();
        for corner in self.felt.iter().filter(|c| c.weight > 0.0) {
            let (point, j) = moved(pose, &corner.in_target);
            let r = point - corner.in_camera;
            let w = corner.information * (corner.weight / self.felt_scale);
            sum.h += j.transpose() * w * j;
            sum.g += j.transpose() * (w * r);
            sum.cost += r.dot(&(w * r));
        }
        sum
    }

    fn minimise(&self, start: Isometry3<f64>) -> Option<Isometry3<f64>> {
        let mut pose = start;
        let here = self.linearise(&pose);
        let end = optimize::descend(self, &mut pose, here, &RULES);
        (end.stop != Stop::Singular && end.there.cost.is_finite()).then_some(pose)
    }

    /// `τ²` so that the squared residuals sum up to the degrees of freedom; the 3D corners' factor
    /// likewise.
    fn estimate_excess(&mut self, pose: &Isometry3<f64>) {
        let at = At::of(pose);
        let used: Vec<(Vector2<f64>, Matrix2<f64>)> = self
            .seen
            .iter()
            .filter(|c| c.weight > 0.0)
            .filter_map(|c| Some((self.residual(&at, c)?.0, c.covariance)))
            .collect();
        let freedom = (2.0 * used.len() as f64 - 6.0).max(1.0);
        let chi2 = |excess: f64| -> f64 {
            let one = |(r, c): &(Vector2<f64>, Matrix2<f64>)| {
                let whole = c + Matrix2::identity() * excess;
                whole.try_inverse().map_or(0.0, |i| r.dot(&(i * r)))
            };
            used.iter().map(one).sum()
        };
        self.excess = if chi2(0.0) <= freedom {
            0.0
        } else {
            let high = used.iter().map(|(r, _)| r.norm_squared()).sum::<f64>() / freedom;
            bisect(0.0, 2.0 * high, |excess| chi2(excess) > freedom)
        };
        if let Some(typical) = self.typical_excess {
            self.excess = (freedom * self.excess + TYPICAL_EQUATIONS * typical)
                / (freedom + TYPICAL_EQUATIONS);
        }
        let felt: Vec<f64> = self
            .felt
            .iter()
            .filter(|c| c.weight > 0.0)
            .map(|c| felt_distance(pose, c).powi(2))
            .collect();
        self.felt_scale = (felt.iter().sum::<f64>() / (3.0 * felt.len().max(1) as f64)).max(1.0);
    }

    fn summary(&self, pose: &Isometry3<f64>) -> Option<PosedTarget> {
        let Normal { h, cost, .. } = self.linearise(pose);
        let covariance = h.cholesky()?.inverse();
        let used: Vec<&Seen> = self.seen.iter().filter(|c| c.weight > 0.0).collect();
        if used.len() < FEWEST {
            return None;
        }
        let at = At::of(pose);
        let square = |c: &&Seen| self.residual(&at, c).map_or(0.0, |(r, _)| r.norm_squared());
        let rms_px = (used.iter().map(square).sum::<f64>() / used.len() as f64).sqrt();
        Some(PosedTarget {
            pose: TargetPose {
                camera_from_target: Pose::claim(*pose),
                covariance: Some(covariance),
            },
            // corners left out count as far ones, or the worse pose could win by leaving out more
            cost: cost + self.penalty(&used),
            rms_px,
            excess_px: self.excess.sqrt(),
            left_out: self.seen.iter().filter(|c| c.weight <= 0.0).map(|c| c.id).collect(),
        })
    }

    /// Makes costs of different `τ` comparable: `Σ ln |Σᵤ + τ² I|`, and a price per left-out corner.
    fn penalty(&self, used: &[&Seen]) -> f64 {
        let log = |c: &&Seen| {
            let whole = c.covariance + Matrix2::identity() * self.excess;
            whole.determinant().ln() - c.covariance.determinant().ln()
        };
        let left_out = (self.seen.len() - used.len()) as f64;
        used.iter().map(log).sum::<f64>() + left_out * FARTHEST * FARTHEST
    }

    /// All corners in front of the camera, which sees the board's face.
    pub(crate) fn is_possible(&self, pose: &Isometry3<f64>) -> bool {
        let eye = pose.inverse().translation.vector;
        let in_front = |c: &Seen| (pose * nalgebra::Point3::from(c.in_target)).z > 0.0;
        eye.z < 0.0 && self.seen.iter().all(in_front)
    }
}

/// `JᵀWJ`, `JᵀWr` and `rᵀWr`.
pub(in crate::detect) struct Normal {
    h: Matrix6<f64>,
    g: Vector6<f64>,
    cost: f64,
}

/// The pose, perturbed on the right.
impl Problem for Fit<'_> {
    type Point = Isometry3<f64>;
    type Equations = Normal;
    type Step = Vector6<f64>;

    fn equations(&self, pose: &Isometry3<f64>) -> Option<Normal> {
        Some(self.linearise(pose))
    }

    fn cost(&self, here: &Normal) -> f64 {
        here.cost
    }

    fn step(&self, _: &Isometry3<f64>, here: &Normal, damping: f64) -> Option<Vector6<f64>> {
        let mut damped = here.h;
        (0..6).for_each(|k| damped[(k, k)] *= 1.0 + damping);
        Some(-damped.cholesky()?.solve(&here.g))
    }

    fn moved(&self, pose: &Isometry3<f64>, step: &Vector6<f64>) -> Isometry3<f64> {
        pose * lie::exp(step)
    }

    fn is_last(&self, tried: &Tried<Vector6<f64>>) -> bool {
        tried.step.norm() < STEP
    }
}

fn felt_distance(pose: &Isometry3<f64>, corner: &Felt) -> f64 {
    let r = pose * nalgebra::Point3::from(corner.in_target) - corner.in_camera;
    r.coords.dot(&(corner.information * r.coords)).sqrt()
}

/// `T p` and its derivative by `δ` of `T exp(δ)`: `R [-[p]ₓ, I]`.
pub(crate) fn moved(pose: &Isometry3<f64>, p: &Vector3<f64>) -> (Vector3<f64>, Matrix3x6<f64>) {
    let r = pose.rotation.to_rotation_matrix().into_inner();
    let mut j = Matrix3x6::zeros();
    j.fixed_view_mut::<3, 3>(0, 0).copy_from(&(-r * hat(p)));
    j.fixed_view_mut::<3, 3>(0, 3).copy_from(&r);
    (r * p + pose.translation.vector, j)
}

/// Where `is_low` turns false, to 1e-12 of the interval.
fn bisect(mut low: f64, mut high: f64, is_low: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_low(middle) { low = middle } else { high = middle }
    }
    high
}
