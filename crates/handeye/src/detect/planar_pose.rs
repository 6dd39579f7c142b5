//! The pose of a flat target from its corners.
//!
//! A homography `H` takes the plane to normalised image coordinates. Its derivative at the plane's
//! origin leaves two rotations, mirror images of each other to first order ([`two_rotations`]);
//! both are polished by Levenberg-Marquardt on
//!
//! ```text
//! Σ |π(T p) - u|²_(Σᵤ + τ² I)  +  Σ |T p - x|²_Σₓ        T = camera_from_target
//! ```
//!
//! with the lens distortion in `π`, Huber's weights, and, if the camera measures surfaces, the 3D
//! corners `x`. `τ` is what lens model and print leave in the residuals beyond the corners' own
//! covariances; it is estimated so that the residuals are as large as they should be.
//!
//! T. Collins and A. Bartoli, *Infinitesimal plane-based pose estimation*, IJCV 109, 2014;
//! P. Huber, *Robust estimation of a location parameter*, 1964.

use nalgebra::{
    Isometry3, Matrix2, Matrix3, Matrix3x6, Matrix6, Rotation3, UnitQuaternion, Vector2, Vector3,
    Vector6,
};

use super::homography;
use crate::lie::{self, hat};
use crate::linalg::median;
use crate::{Error, ImageCorner, Intrinsics, Pose, SurfaceCorner, Target, TargetModel, TargetPose};

/// A pose of the target and how well it explains the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PosedTarget {
    /// Pose and covariance.
    pub pose: TargetPose,
    /// Sum of the squared residuals over their variances.
    pub cost: f64,
    /// Root of the mean squared distance of corners and model, px.
    pub rms_px: f64,
    /// What lens model and print add to a corner's error per axis, px.
    pub excess_px: f64,
    /// Corners that do not fit and were left out.
    pub left_out: Vec<u32>,
}

/// Huber's bound: beyond this many standard deviations a corner pulls with constant force.
const HUBER: f64 = 1.5;
/// Corners farther than this many standard deviations are left out.
const FARTHEST: f64 = 5.0;
/// Rounds of re-weighting; three suffice for a few bad corners.
const ROUNDS: usize = 4;
/// Most steps of one Levenberg-Marquardt run.
const MOST_STEPS: usize = 50;
/// A step this small (rad and m alike) ends the run.
const STEP: f64 = 1e-11;
/// Equations' worth of belief in what other pictures say about lens model and print.
const TYPICAL_EQUATIONS: f64 = 20.0;
/// Poses nearer to each other than this angle (rad) are one solution.
const SAME_RAD: f64 = 1e-3;
/// A solution whose cost exceeds the best by more than this is no candidate: ten standard
/// deviations.
const COST_GAP: f64 = 100.0;
/// Four corners determine a pose.
const FEWEST: usize = 4;
/// Half of all squared lengths of a 2-vector of unit normal deviates are below this.
const CHI2_2_MEDIAN: f64 = 1.386_294_361;

/// All poses of the target that explain its corners, best first: one, or two where the board is so
/// far or so flat that its mirror image looks the same.
///
/// `surface` may be empty. Errors: fewer than four known corners; corners on a line.
pub fn target_poses(
    corners: &[ImageCorner],
    surface: &[SurfaceCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
) -> Result<Vec<PosedTarget>, Error> {
    target_poses_with(corners, surface, target, intrinsics, None)
}

/// As [`target_poses`], with what other pictures of the same camera and target say about lens model
/// and print: the typical `excess_px` of [`PosedTarget`]. A few corners tell little about it
/// themselves.
///
/// # Errors
/// As [`target_poses`].
pub fn target_poses_with(
    corners: &[ImageCorner],
    surface: &[SurfaceCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
    typical_excess_px: Option<f64>,
) -> Result<Vec<PosedTarget>, Error> {
    let mut fit = Fit::new(corners, surface, target, intrinsics)?;
    fit.typical_excess = typical_excess_px.map(|px| px * px);
    let mut found: Vec<PosedTarget> = vec![];
    for start in fit.starts()? {
        let posed = fit.polish(start);
        let possible = |p: &PosedTarget| fit.is_possible(p.pose.camera_from_target.iso());
        found.extend(posed.filter(|p| p.cost.is_finite()).filter(possible));
    }
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let best = found.first().map(|p| p.cost).ok_or_else(|| Error::NotDetermined {
        what: "no pose of the target puts its corners in front of the camera".into(),
    })?;
    let mut kept: Vec<PosedTarget> = vec![];
    for posed in found {
        let pose = posed.pose.camera_from_target;
        let known = kept.iter().any(|k| k.pose.camera_from_target.angle_to(&pose) < SAME_RAD);
        if !known && posed.cost < best + COST_GAP {
            kept.push(posed);
        }
    }
    Ok(kept)
}

/// Fewest pictures that tell what is typical.
const FEWEST_TYPICAL: usize = 4;

/// What lens model and print leave in the corners of all pictures of one camera, px: the median.
/// `None` where the pictures are too few to tell.
pub fn typical_excess<'a>(
    pictures: impl IntoIterator<Item = &'a [ImageCorner]>,
    target: &TargetModel,
    intrinsics: &Intrinsics,
) -> Option<f64> {
    let excess = |corners: &[ImageCorner]| {
        let poses = target_poses(corners, &[], target, intrinsics).ok()?;
        poses.first().map(|p| p.excess_px)
    };
    let mut all: Vec<f64> = pictures.into_iter().filter_map(excess).collect();
    all.sort_by(f64::total_cmp);
    (all.len() >= FEWEST_TYPICAL).then(|| all[all.len() / 2])
}

/// The poses under every labelling that looks the same, see [`TargetModel::symmetries`]: for each
/// pose the given labelling first.
pub fn with_symmetries(poses: &[PosedTarget], target: &TargetModel) -> Vec<TargetPose> {
    let turns: Vec<_> = target.symmetries().iter().map(|map| symmetry_turn(target, map)).collect();
    let one = |posed: &PosedTarget, turn: &Pose<Target, Target>| TargetPose {
        camera_from_target: posed.pose.camera_from_target * *turn,
        covariance: posed.pose.covariance.map(|c| {
            let carry = lie::adjoint(turn.inverse().iso());
            carry * c * carry.transpose()
        }),
    };
    turns.iter().flat_map(|turn| poses.iter().map(move |posed| one(posed, turn))).collect()
}

/// Corners under another labelling, in the order of their new ids.
pub fn relabelled(corners: &[ImageCorner], map: &[u32]) -> Vec<ImageCorner> {
    let one = |c: &ImageCorner| Some(ImageCorner { id: *map.get(c.id as usize)?, ..*c });
    let mut all: Vec<ImageCorner> = corners.iter().filter_map(one).collect();
    all.sort_by_key(|c| c.id);
    all
}

/// The turn of the board that takes corner `map[id]` to corner `id`.
pub fn symmetry_turn(target: &TargetModel, map: &[u32]) -> Pose<Target, Target> {
    let here: Vec<Vector3<f64>> = target.corners().iter().map(|c| c.vector()).collect();
    let there: Vec<Vector3<f64>> =
        map.iter().filter_map(|&id| here.get(id as usize).copied()).collect();
    let (Some(from), Some(into)) = (axes(&there), axes(&here)) else { return Pose::identity() };
    let rotation = into * from.transpose();
    Pose::from_parts(&rotation, here[0] - rotation * there[0])
}

/// Axes that move with the corners: from the first to the second one, and from there towards the
/// corner farthest from that line.
fn axes(corners: &[Vector3<f64>]) -> Option<Matrix3<f64>> {
    let (first, second) = (corners.first()?, corners.get(1)?);
    let x = (second - first).normalize();
    let off = |c: &Vector3<f64>| x.cross(&(c - first)).norm_squared();
    // of equally far ones the first
    let farthest = corners.iter().rev().max_by(|a, b| off(a).total_cmp(&off(b)))?;
    let down = farthest - first;
    let y = (down - x * x.dot(&down)).normalize();
    Some(Matrix3::from_columns(&[x, y, x.cross(&y)]))
}

/// A corner in the picture, with its place on the board.
pub(super) struct Seen {
    pub id: u32,
    pub in_target: Vector3<f64>,
    pub pixel: Vector2<f64>,
    pub covariance: Matrix2<f64>,
    pub weight: f64,
}

/// A corner in the scan.
pub(super) struct Felt {
    pub in_target: Vector3<f64>,
    pub in_camera: Vector3<f64>,
    pub information: Matrix3<f64>,
    pub weight: f64,
}

pub(super) struct Fit<'a> {
    pub seen: Vec<Seen>,
    pub felt: Vec<Felt>,
    pub intrinsics: &'a Intrinsics,
    /// `τ²`, px².
    excess: f64,
    /// What other pictures say it is.
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
    fn starts(&self) -> Result<Vec<Isometry3<f64>>, Error> {
        let pairs: Vec<(Vector3<f64>, Vector2<f64>)> = self
            .seen
            .iter()
            .filter_map(|c| Some((c.in_target, self.intrinsics.undistort(&c.pixel)?)))
            .collect();
        let undetermined = || Error::NotDetermined {
            what: "the target's corners in the picture lie on one line".into(),
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
    pub fn polish(&mut self, start: Isometry3<f64>) -> Option<PosedTarget> {
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

    fn reweight(&mut self, weight: impl Fn(f64) -> f64) {
        self.seen.iter_mut().for_each(|c| c.weight = weight(0.0));
        self.felt.iter_mut().for_each(|c| c.weight = weight(0.0));
    }

    /// Weights by distance in standard deviations; `scale` multiplies those of the picture.
    fn reweight_by(&mut self, pose: &Isometry3<f64>, scale: f64, weight: impl Fn(f64) -> f64) {
        let seen: Vec<f64> = self.seen.iter().map(|c| self.distance(pose, c)).collect();
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
    fn distance(&self, pose: &Isometry3<f64>, corner: &Seen) -> f64 {
        let Some((r, _)) = self.residual(pose, corner) else { return f64::INFINITY };
        let information = self.information(corner);
        r.dot(&(information * r)).sqrt()
    }

    /// How many times larger residuals are than the covariances say (at least 1), by the median.
    fn median_scale(&self, pose: &Isometry3<f64>) -> f64 {
        let all = self.seen.iter().map(|c| self.distance(pose, c));
        (median(all) / CHI2_2_MEDIAN.sqrt()).max(1.0)
    }

    pub fn information(&self, corner: &Seen) -> Matrix2<f64> {
        let whole = corner.covariance + Matrix2::identity() * self.excess;
        whole.try_inverse().unwrap_or_else(Matrix2::zeros)
    }

    /// `π(T p) - u` and its derivative by `δ` of `T exp(δ)`.
    fn residual(
        &self,
        pose: &Isometry3<f64>,
        corner: &Seen,
    ) -> Option<(Vector2<f64>, nalgebra::Matrix2x6<f64>)> {
        let (point, by_pose) = moved(pose, &corner.in_target);
        let (pixel, by_point) = self.intrinsics.project_with_jacobian(&point)?;
        Some((pixel - corner.pixel, by_point * by_pose))
    }

    /// `JᵀWJ`, `JᵀWr` and `rᵀWr`; infinite cost when a corner is behind the camera.
    fn linearise(&self, pose: &Isometry3<f64>) -> (Matrix6<f64>, Vector6<f64>, f64) {
        let (mut normal, mut gradient, mut cost) = (Matrix6::zeros(), Vector6::zeros(), 0.0);
        for corner in self.seen.iter().filter(|c| c.weight > 0.0) {
            let Some((r, j)) = self.residual(pose, corner) else {
                return (normal, gradient, f64::INFINITY);
            };
            let w = self.information(corner) * corner.weight;
            normal += j.transpose() * w * j;
            gradient += j.transpose() * (w * r);
            cost += r.dot(&(w * r));
        }
        for corner in self.felt.iter().filter(|c| c.weight > 0.0) {
            let (point, j) = moved(pose, &corner.in_target);
            let r = point - corner.in_camera;
            let w = corner.information * (corner.weight / self.felt_scale);
            normal += j.transpose() * w * j;
            gradient += j.transpose() * (w * r);
            cost += r.dot(&(w * r));
        }
        (normal, gradient, cost)
    }

    fn minimise(&self, start: Isometry3<f64>) -> Option<Isometry3<f64>> {
        let mut pose = start;
        let (mut normal, mut gradient, mut cost) = self.linearise(&pose);
        let mut damping = 1e-6;
        for _ in 0..MOST_STEPS {
            let mut damped = normal;
            (0..6).for_each(|k| damped[(k, k)] *= 1.0 + damping);
            let step = -damped.cholesky()?.solve(&gradient);
            let next = pose * lie::exp(&step);
            let (n, g, c) = self.linearise(&next);
            if c <= cost {
                (pose, normal, gradient, cost) = (next, n, g, c);
                damping = (damping * 0.1).max(1e-12);
            } else {
                damping *= 10.0;
            }
            if step.norm() < STEP || damping > 1e9 {
                break;
            }
        }
        cost.is_finite().then_some(pose)
    }

    /// `τ²` so that the squared residuals sum up to the degrees of freedom; the 3D corners' factor
    /// likewise.
    fn estimate_excess(&mut self, pose: &Isometry3<f64>) {
        let used: Vec<(Vector2<f64>, Matrix2<f64>)> = self
            .seen
            .iter()
            .filter(|c| c.weight > 0.0)
            .filter_map(|c| Some((self.residual(pose, c)?.0, c.covariance)))
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
        let (normal, _, cost) = self.linearise(pose);
        let covariance = normal.cholesky()?.inverse();
        let used: Vec<&Seen> = self.seen.iter().filter(|c| c.weight > 0.0).collect();
        if used.len() < FEWEST {
            return None;
        }
        let square = |c: &&Seen| self.residual(pose, c).map_or(0.0, |(r, _)| r.norm_squared());
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
    fn is_possible(&self, pose: &Isometry3<f64>) -> bool {
        let eye = pose.inverse().translation.vector;
        let in_front = |c: &Seen| (pose * nalgebra::Point3::from(c.in_target)).z > 0.0;
        eye.z < 0.0 && self.seen.iter().all(in_front)
    }
}

/// Half of all lengths of a 3-vector of unit normal deviates are below this.
const FELT_MEDIAN: f64 = 1.538_17;

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

/// Both rotations whose first two columns explain the homography's derivative at the origin.
///
/// With `R_v` turning the optical axis onto the ray `v` of the origin, `A` the 2 x 2 derivative seen
/// along that ray and `γ` its largest singular value, the upper part of `R_vᵀ R` is `A/γ` and its
/// third row `(b₁, b₂)` follows from unit columns at right angles, up to one common sign.
pub fn two_rotations(h: &Matrix3<f64>) -> Option<[Matrix3<f64>; 2]> {
    if h[(2, 2)].abs() < 1e-12 * h.norm() {
        return None;
    }
    let h = h / h[(2, 2)];
    let (p, q) = (h[(0, 2)], h[(1, 2)]);
    let j = Matrix2::new(
        h[(0, 0)] - h[(2, 0)] * p,
        h[(0, 1)] - h[(2, 1)] * p,
        h[(1, 0)] - h[(2, 0)] * q,
        h[(1, 1)] - h[(2, 1)] * q,
    );
    let ray = Vector3::new(p, q, 1.0);
    let r_v = Rotation3::rotation_between(&Vector3::z(), &ray)?.into_inner();
    let b = Matrix2::new(
        r_v[(0, 0)] - p * r_v[(2, 0)],
        r_v[(0, 1)] - p * r_v[(2, 1)],
        r_v[(1, 0)] - q * r_v[(2, 0)],
        r_v[(1, 1)] - q * r_v[(2, 1)],
    );
    let a = b.try_inverse()? * j;
    let gamma = (a.transpose() * a).symmetric_eigenvalues().max().sqrt();
    let upper = a / gamma;
    let (c1, c2) = (upper.column(0), upper.column(1));
    let b1 = (1.0 - c1.norm_squared()).max(0.0).sqrt();
    let b2 = (1.0 - c2.norm_squared()).max(0.0).sqrt() * if c1.dot(&c2) > 0.0 { -1.0 } else { 1.0 };
    let rotation = |sign: f64| {
        let x = Vector3::new(c1[0], c1[1], sign * b1);
        let y = Vector3::new(c2[0], c2[1], sign * b2);
        r_v * Matrix3::from_columns(&[x, y, x.cross(&y)])
    };
    let both = [rotation(1.0), rotation(-1.0)];
    both.iter().all(|r| r.iter().all(|x| x.is_finite())).then_some(both)
}

/// Translation for a given rotation: `x t_z - t_x = (R p)_x - x (R p)_z` for every point, in least
/// squares.
fn translation(
    r: &Matrix3<f64>,
    from: &[Vector2<f64>],
    to: &[Vector2<f64>],
) -> Option<Vector3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (a, n) in from.iter().zip(to) {
        let p = r * a.push(0.0);
        for (row, value) in [
            (Vector3::new(-1.0, 0.0, n.x), p.x - n.x * p.z),
            (Vector3::new(0.0, -1.0, n.y), p.y - n.y * p.z),
        ] {
            normal += row * row.transpose();
            right += row * value;
        }
    }
    normal.cholesky().map(|c| c.solve(&right))
}

/// Where `is_low` turns false, to 1e-12 of the interval.
fn bisect(mut low: f64, mut high: f64, is_low: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_low(middle) { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_without_symmetry_keeps_its_poses() {
        let tag = TargetModel::Tag { dictionary: "DICT_4X4_50".into(), id: 0, size_mm: 48.0 };
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        for target in [tag, board] {
            let same = symmetry_turn(&target, &target.symmetries()[0]);
            assert!(same.local(&Pose::identity()).norm() < 1e-12, "{target:?}");
        }
    }
    use crate::simulate::Random;
    use crate::{Camera, Distortion};

    fn board() -> TargetModel {
        TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 }
    }

    fn camera() -> Intrinsics {
        let brown = [-0.2, 0.08, 1e-3, -5e-4, 0.01, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let pinhole = Intrinsics::pinhole(1280, 960, 1100.0, 1095.0, 640.0, 470.0);
        Intrinsics { distortion: Distortion::BrownConrady(brown), ..pinhole }
    }

    fn pose(random: &mut Random) -> Pose<Camera, Target> {
        let at = Vector3::new(
            random.between(-0.2, 0.0),
            random.between(-0.2, 0.0),
            random.between(0.6, 1.0),
        );
        let tilt = |random: &mut Random| random.between(-0.7, 0.7);
        let turn = Vector6::new(tilt(random), tilt(random), tilt(random), 0.0, 0.0, 0.0);
        Pose::from_parts(&Matrix3::identity(), at).retract(&turn)
    }

    fn corners(truth: &Pose<Camera, Target>, sigma: f64, random: &mut Random) -> Vec<ImageCorner> {
        let one = |(id, p): (usize, crate::Point<Target>)| {
            let pixel = camera().project(&(*truth * p).vector()).unwrap();
            let noise = Vector2::new(random.normal(), random.normal()) * sigma;
            let covariance = Matrix2::identity() * sigma.max(1e-3).powi(2);
            ImageCorner { id: id as u32, pixel: pixel + noise, covariance }
        };
        board().corners().into_iter().enumerate().map(one).collect()
    }

    #[test]
    fn exact_corners_give_the_exact_pose() {
        let mut random = Random::new(3);
        for _ in 0..50 {
            let truth = pose(&mut random);
            let poses =
                target_poses(&corners(&truth, 0.0, &mut random), &[], &board(), &camera()).unwrap();
            let error = truth.local(&poses[0].pose.camera_from_target).norm();
            assert!(error < 1e-9, "{error}");
        }
    }

    #[test]
    fn errors_stay_inside_the_covariance() {
        let mut random = Random::new(4);
        let trials = 300;
        let mut sum = 0.0;
        for _ in 0..trials {
            let truth = pose(&mut random);
            let seen = corners(&truth, 0.1, &mut random);
            let best = &target_poses(&seen, &[], &board(), &camera()).unwrap()[0].pose;
            let error = truth.local(&best.camera_from_target);
            let information = best.covariance.unwrap().try_inverse().unwrap();
            sum += error.dot(&(information * error)) / 6.0;
        }
        let ratio = sum / f64::from(trials);
        assert!((0.85..1.12).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_few_bad_corners_are_left_out() {
        let mut random = Random::new(5);
        let truth = pose(&mut random);
        let mut seen = corners(&truth, 0.05, &mut random);
        for id in [3, 17, 40] {
            seen[id].pixel.x += 4.0;
        }
        let best = &target_poses(&seen, &[], &board(), &camera()).unwrap()[0];
        assert_eq!(best.left_out, vec![3, 17, 40]);
        assert!(truth.distance_to(&best.pose.camera_from_target) < 1e-3);
    }

    #[test]
    fn residuals_beyond_the_covariance_widen_the_poses_covariance() {
        let mut random = Random::new(6);
        let truth = pose(&mut random);
        let mut seen = corners(&truth, 0.2, &mut random);
        let honest = target_poses(&seen, &[], &board(), &camera()).unwrap();
        seen.iter_mut().for_each(|c| c.covariance *= 0.01);
        let boasting = target_poses(&seen, &[], &board(), &camera()).unwrap();
        let trace = |p: &[PosedTarget]| p[0].pose.covariance.unwrap().trace();
        assert!((trace(&boasting) / trace(&honest) - 1.0).abs() < 0.3);
        assert!((boasting[0].excess_px - 0.2).abs() < 0.05, "{}", boasting[0].excess_px);
    }

    #[test]
    fn a_distant_flat_board_has_two_poses() {
        let mut random = Random::new(7);
        let turn = Vector6::new(0.25, 0.1, 0.0, 0.0, 0.0, 0.0);
        let truth =
            Pose::from_parts(&Matrix3::identity(), Vector3::new(0.0, 0.0, 6.0)).retract(&turn);
        let poses =
            target_poses(&corners(&truth, 0.1, &mut random), &[], &board(), &camera()).unwrap();
        assert_eq!(poses.len(), 2);
        assert!(poses.iter().any(|p| p.pose.camera_from_target.angle_to(&truth) < 0.1));
    }

    #[test]
    fn surface_corners_sharpen_the_depth() {
        let mut random = Random::new(8);
        let truth = pose(&mut random);
        let seen = corners(&truth, 0.1, &mut random);
        let surface: Vec<SurfaceCorner> = board()
            .corners()
            .into_iter()
            .enumerate()
            .map(|(id, p)| SurfaceCorner {
                id: id as u32,
                in_camera: crate::Point::from_vector(
                    (truth * p).vector() + random.normal3() * 1e-4,
                ),
                covariance: Matrix3::identity() * 1e-8,
            })
            .collect();
        let trace = |s: &[SurfaceCorner]| {
            let poses = target_poses(&seen, s, &board(), &camera()).unwrap();
            poses[0].pose.covariance.unwrap().trace()
        };
        assert!(trace(&surface) < 0.25 * trace(&[]));
    }

    #[test]
    fn the_jacobian_matches_central_differences() {
        let mut random = Random::new(9);
        let truth = pose(&mut random);
        let (seen, camera) = (corners(&truth, 0.0, &mut random), camera());
        let fit = Fit::new(&seen, &[], &board(), &camera).unwrap();
        let (_, analytic) = fit.residual(truth.iso(), &fit.seen[30]).unwrap();
        for k in 0..6 {
            let mut step = Vector6::zeros();
            step[k] = 1e-6;
            let at =
                |d: Vector6<f64>| fit.residual(truth.retract(&d).iso(), &fit.seen[30]).unwrap().0;
            let numeric = (at(step) - at(-step)) / 2e-6;
            assert!((analytic.column(k) - numeric).norm() < 1e-4, "{k}");
        }
    }

    #[test]
    fn a_symmetry_of_the_board_explains_the_relabelled_corners() {
        let board = TargetModel::Checkerboard { columns: 6, rows: 6, square_mm: 30.0 };
        let mut random = Random::new(10);
        let truth = pose(&mut random);
        let pixel = |p: crate::Point<Target>| camera().project(&(truth * p).vector()).unwrap();
        let covariance = Matrix2::identity() * 1e-4;
        let seen: Vec<ImageCorner> = (0..36)
            .map(|id| ImageCorner { id, pixel: pixel(board.corner(id).unwrap()), covariance })
            .collect();
        let poses = target_poses(&seen, &[], &board, &camera()).unwrap();
        let all = with_symmetries(&poses[..1], &board);
        for (map, candidate) in board.symmetries().iter().zip(&all) {
            let again = target_poses(&relabelled(&seen, map), &[], &board, &camera()).unwrap();
            let refitted = &again[0].pose;
            assert!(candidate.camera_from_target.local(&refitted.camera_from_target).norm() < 1e-8);
            let difference = candidate.covariance.unwrap() - refitted.covariance.unwrap();
            assert!(difference.norm() < 1e-6 * refitted.covariance.unwrap().norm());
        }
    }

    #[test]
    fn three_corners_are_too_few() {
        let mut random = Random::new(11);
        let seen = corners(&pose(&mut random), 0.0, &mut random);
        let error = target_poses(&seen[..3], &[], &board(), &camera()).unwrap_err();
        assert_eq!(error, Error::TooFewPoints { found: 3, needed: 4 });
        assert!(target_poses(&seen[..9], &[], &board(), &camera()).is_err(), "one row");
    }
}
