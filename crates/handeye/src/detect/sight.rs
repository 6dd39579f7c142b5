//! How a target's pose, and how well it explains its corners, depend on camera and scale.
//!
//! In one view, with `ξ` the motion of the target's pose, `c` that of the parameters of camera and
//! target, and corners as residuals `ρ + J_ξ ξ + J_c c` of weight `W`, the best pose moves with `c`,
//! and what the corners themselves say about `c` is a parabola:
//!
//! ```text
//! ξ(c) = -H_ξξ⁻¹ H_ξc c          S = H_cc - H_cξ H_ξξ⁻¹ H_ξc          s = g_c - H_cξ H_ξξ⁻¹ g_ξ
//! ```
//!
//! So a fit over many views keeps one pose a view, and yet knows all corners. The model of a scan:
//! it reads `z' = (1 + scale) z + bias` along the ray.

use nalgebra::{Isometry3, Matrix3, Matrix6, SMatrix, SVector, Vector2, Vector3, Vector6};

use super::planar_pose::{Fit, PosedTarget, moved};
use crate::{
    Camera, ImageCorner, Intrinsics, Pose, SurfaceCorner, Target, TargetModel,
    model::camera::PARAMETERS,
};

/// Number of parameters of camera and target that a target pose may depend on.
pub const CAMERA: usize = PRINT + SHAPES;
/// The target is larger by this share.
pub(crate) const TARGET_SCALE: usize = 0;
/// Depths in scans are too large by this share.
pub const DEPTH_SCALE: usize = 1;
/// Depths in scans are too large by this (m).
pub(crate) const DEPTH_BIAS: usize = 2;
/// The first of the lens' parameters, `Intrinsics::by_parameters`.
pub const LENS: usize = 3;
/// The camera's clock is farther ahead of the robot's by this (s).
pub(crate) const CLOCK: usize = 12;
/// The first of the target's deviations from its shape: its y is longer than its x by this share, and the second
/// derivatives of its height by x x, x y and y y (1/m), about its middle.
pub const PRINT: usize = 13;
/// How many there are.
pub(crate) const SHAPES: usize = 4;

/// How a point of a target moves with the deviations of its shape.
pub fn by_shape(in_target: &Vector3<f64>, middle: &Vector3<f64>) -> SMatrix<f64, 3, SHAPES> {
    let (x, y) = (in_target.x - middle.x, in_target.y - middle.y);
    let mut j = SMatrix::zeros();
    j[(1, 0)] = y;
    (j[(2, 1)], j[(2, 2)], j[(2, 3)]) = (0.5 * x * x, x * y, 0.5 * y * y);
    j
}

/// What one view knows beyond its best pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    /// How the best target pose, perturbed on the right, moves with the parameters.
    pub by_camera: SMatrix<f64, 6, CAMERA>,
    /// Information of the view's own corners on the parameters, its pose being free.
    pub information: SMatrix<f64, CAMERA, CAMERA>,
    /// Gradient of half the view's own cost by the parameters.
    pub gradient: SVector<f64, CAMERA>,
}

impl Sight {
    /// A view of which only this is known: how its pose moves.
    pub fn moving(by_camera: SMatrix<f64, 6, CAMERA>) -> Self {
        Self { by_camera, information: SMatrix::zeros(), gradient: SVector::zeros() }
    }

    /// How a pose of unknown corners moves with the size of the target: the larger, the farther
    /// away, `t (1 + s) = t + R (Rᵀ t) s`.
    pub(crate) fn by_size(camera_from_target: &Pose<Camera, Target>) -> Vector6<f64> {
        let outward = camera_from_target.rotation().transpose() * camera_from_target.translation();
        Vector6::new(0.0, 0.0, 0.0, outward.x, outward.y, outward.z)
    }

    /// The same for a pose in another frame of the target: `carry = Ad(new_from_old)`.
    pub(crate) fn carried(&self, carry: &Matrix6<f64>) -> Self {
        Self { by_camera: carry * self.by_camera, ..self.clone() }
    }
}

/// The best pose near `start`, and what the view knows beyond it. `None` where corners are too few.
pub(crate) fn sighted(
    corners: &[ImageCorner],
    surface: &[SurfaceCorner],
    target: &TargetModel,
    intrinsics: &Intrinsics,
    typical_excess_px: Option<f64>,
    start: &Pose<Camera, Target>,
) -> Option<(PosedTarget, Sight)> {
    let mut fit = Fit::new(corners, surface, target, intrinsics).ok()?;
    fit.typical_excess = typical_excess_px.map(|px| px * px);
    let posed = fit.polish(*start.iso())?;
    let about = About { reference: target.reference().vector(), middle: target.middle().vector() };
    let sight = sight(&fit, posed.pose.camera_from_target.iso(), &about)?;
    Some((posed, sight))
}

const ALL: usize = 6 + CAMERA;

/// The points of a target about which its size and its shape deviate.
struct About {
    reference: Vector3<f64>,
    middle: Vector3<f64>,
}

impl About {
    /// How a point in the camera moves with size and shape, in the target's axes.
    fn by_target(&self, in_target: &Vector3<f64>) -> (Vector3<f64>, SMatrix<f64, 3, SHAPES>) {
        (in_target - self.reference, by_shape(in_target, &self.middle))
    }
}

/// Eliminates the pose from the equations of one view.
fn sight(fit: &Fit, pose: &Isometry3<f64>, about: &About) -> Option<Sight> {
    let mut h = SMatrix::<f64, ALL, ALL>::zeros();
    let mut g = SVector::<f64, ALL>::zeros();
    for corner in fit.seen.iter().filter(|c| c.weight > 0.0) {
        let (r, j) = by_picture(fit, pose, &corner.in_target, about)?;
        let w = fit.information(corner) * corner.weight;
        let weighted = j.transpose() * w;
        h += weighted * j;
        g += weighted * (r - corner.pixel);
    }
    for corner in fit.felt.iter().filter(|c| c.weight > 0.0) {
        let (point, mut j) = by_scan(pose, &corner.in_target, &corner.in_camera, about);
        let pixel = fit.seen.iter().find(|s| s.in_target == corner.in_target).map(|s| s.pixel);
        let normal = pose.rotation * Vector3::z();
        if let Some(moved) =
            pixel.and_then(|p| by_ray(fit.intrinsics, &corner.in_camera, &p, &normal))
        {
            j.fixed_view_mut::<3, PARAMETERS>(0, 6 + LENS).copy_from(&-moved);
        }
        let weighted = j.transpose() * (corner.information * (corner.weight / fit.felt_scale));
        h += weighted * j;
        g += weighted * (point - corner.in_camera);
    }
    let own: Matrix6<f64> = h.fixed_view::<6, 6>(0, 0).into_owned();
    let cross = h.fixed_view::<6, CAMERA>(0, 6).into_owned();
    let by_camera = -own.cholesky()?.solve(&cross);
    Some(Sight {
        by_camera,
        information: h.fixed_view::<CAMERA, CAMERA>(6, 6) + cross.transpose() * by_camera,
        gradient: g.fixed_rows::<CAMERA>(6) + by_camera.transpose() * g.fixed_rows::<6>(0),
    })
}

type Rows<const N: usize> = (SVector<f64, N>, SMatrix<f64, N, ALL>);

/// Pixel of a corner and its derivative by pose and parameters.
fn by_picture(
    fit: &Fit,
    pose: &Isometry3<f64>,
    in_target: &Vector3<f64>,
    about: &About,
) -> Option<Rows<2>> {
    let (point, by_pose) = moved(pose, in_target);
    let (pixel, by_point) = fit.intrinsics.project_with_jacobian(&point)?;
    let mut j = SMatrix::<f64, 2, ALL>::zeros();
    j.fixed_view_mut::<2, 6>(0, 0).copy_from(&(by_point * by_pose));
    let by_point_of_target = by_point * pose.rotation.to_rotation_matrix();
    let (by_scale, by_shape) = about.by_target(in_target);
    j.fixed_view_mut::<2, 1>(0, 6 + TARGET_SCALE).copy_from(&(by_point_of_target * by_scale));
    j.fixed_view_mut::<2, SHAPES>(0, 6 + PRINT).copy_from(&(by_point_of_target * by_shape));
    j.fixed_view_mut::<2, 9>(0, 6 + LENS).copy_from(&fit.intrinsics.by_parameters(&point));
    Some((pixel, j))
}

/// Place of a corner in the camera frame, and the derivative of its residual in the scan.
fn by_scan(
    pose: &Isometry3<f64>,
    in_target: &Vector3<f64>,
    measured: &Vector3<f64>,
    about: &About,
) -> Rows<3> {
    let (point, by_pose) = moved(pose, in_target);
    let mut j = SMatrix::<f64, 3, ALL>::zeros();
    j.fixed_view_mut::<3, 6>(0, 0).copy_from(&by_pose);
    let column = |k: usize, j: &mut SMatrix<f64, 3, ALL>, by: Vector3<f64>| {
        j.fixed_view_mut::<3, 1>(0, 6 + k).copy_from(&by);
    };
    let (by_scale, by_shape) = about.by_target(in_target);
    column(TARGET_SCALE, &mut j, pose.rotation * by_scale);
    let rotation = pose.rotation.to_rotation_matrix();
    j.fixed_view_mut::<3, SHAPES>(0, 6 + PRINT).copy_from(&(rotation * by_shape));
    column(DEPTH_SCALE, &mut j, *measured);
    column(DEPTH_BIAS, &mut j, measured / measured.z.max(f64::MIN_POSITIVE));
    (point, j)
}

/// Corners of scans that lie as near to the rays of their pixels were lifted along these, px.
const ON_RAY: f64 = 0.5;

/// Whether a corner in a scan was lifted along the ray of its pixel.
pub(crate) fn on_ray(camera: &Intrinsics, in_camera: &Vector3<f64>, pixel: &Vector2<f64>) -> bool {
    camera.project(in_camera).is_some_and(|p| (p - pixel).norm() < ON_RAY)
}

/// How a corner that was lifted along the ray of its pixel moves over the scanned plane with the lens.
fn by_ray(
    camera: &Intrinsics,
    in_camera: &Vector3<f64>,
    pixel: &Vector2<f64>,
    normal: &Vector3<f64>,
) -> Option<SMatrix<f64, 3, PARAMETERS>> {
    if !on_ray(camera, in_camera, pixel) {
        return None;
    }
    let (_, by_point) = camera.project_with_jacobian(in_camera)?;
    let mut both = Matrix3::zeros();
    both.fixed_rows_mut::<2>(0).copy_from(&by_point);
    both.fixed_rows_mut::<1>(2).copy_from(&normal.transpose());
    let mut still = SMatrix::<f64, 3, PARAMETERS>::zeros();
    still.fixed_rows_mut::<2>(0).copy_from(&-camera.by_parameters(in_camera));
    both.lu().solve(&still)
}

/// A scan's corners where another lens lifts them onto the scanned plane; those that were not lifted along the rays of
/// their pixels stay.
pub(crate) fn lifted_again(
    surface: &[SurfaceCorner],
    corners: &[ImageCorner],
    from: &Intrinsics,
    to: &Intrinsics,
) -> Vec<SurfaceCorner> {
    let count = surface.len().max(1) as f64;
    let middle = surface.iter().map(|c| c.in_camera.vector()).sum::<Vector3<f64>>() / count;
    let scatter: Matrix3<f64> = surface
        .iter()
        .map(|c| (c.in_camera.vector() - middle) * (c.in_camera.vector() - middle).transpose())
        .sum();
    let eigen = scatter.symmetric_eigen();
    let normal: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    let again = |c: &SurfaceCorner| {
        let pixel = corners.iter().find(|p| p.id == c.id)?.pixel;
        let here = c.in_camera.vector();
        let ray = Some(to.ray(&pixel)?).filter(|_| on_ray(from, &here, &pixel))?;
        let depth = here.dot(&normal) / Some(ray.dot(&normal)).filter(|d| d.abs() > 1e-3)?;
        Some(SurfaceCorner { in_camera: crate::Point::from_vector(ray * depth), ..*c })
    };
    surface.iter().map(|c| again(c).unwrap_or(*c)).collect()
}

/// A scan's corners with the depth that a scan of this scale and bias should have read.
pub fn corrected(surface: &[SurfaceCorner], scale: f64, bias_m: f64) -> Vec<SurfaceCorner> {
    let one = |c: &SurfaceCorner| {
        let p = c.in_camera.vector();
        let factor = (1.0 - bias_m / p.z) / (1.0 + scale);
        SurfaceCorner {
            in_camera: crate::Point::from_vector(p * factor),
            covariance: c.covariance * factor.powi(2),
            ..*c
        }
    };
    surface.iter().map(one).collect()
}
