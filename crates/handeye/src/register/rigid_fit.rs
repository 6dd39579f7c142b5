//! Rigid transform between two point sets with known correspondences.
//!
//! `min Σ |R p_i + t - q_i|²`: with the centroids `p̄, q̄` and `H = Σ (q - q̄)(p - p̄)ᵀ`, the
//! best rotation maximises `tr(Rᵀ H)`, and `t = q̄ - R p̄`. One pass over the points gives `H` and all
//! else that is needed. The result does not depend on any start.
//!
//! Its covariance follows from the scatter of the points and the error of one point (`FLE`), which
//! the residuals underestimate: six of the `3 K` equations were spent on the answer, so
//! `FLE² = Σ r² / (3 K - 6)` per axis. About the centroid, rotation and translation are independent:
//! `Cov(ω) = FLE² (Σ (|p|² I - p pᵀ))⁻¹`, `Cov(u) = FLE² / K`, and `v = u + p̄ × ω`.
//!
//! B. Horn, J. Opt. Soc. Am. A 4(4), 1987; S. Umeyama, IEEE TPAMI 13(4), 1991;
//! J. Fitzpatrick, J. West, C. Maurer, *Predicting error in rigid-body point-based registration*,
//! IEEE T-MI 17(5), 1998.

use nalgebra::{Isometry3, Matrix3, Matrix6, SMatrix, Translation3, Vector3};

use super::{moments::Moments, rotation};
use crate::{Error, math::lie};

/// A registration and how sure it is.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidFit {
    /// Takes source points to the target: `target_from_source`.
    pub target_from_source: Isometry3<f64>,
    /// 6 x 6, rotation first, perturbed on the right (in the source frame); `None` with three
    /// points, which leave too little to judge the error by.
    pub covariance: Option<Matrix6<f64>>,
    /// Root mean square of the residual lengths, m.
    pub rms_m: f64,
    /// Error of one point per axis, m, estimated from the residuals.
    pub sigma_m: f64,
    /// `3 K - 6`.
    pub degrees_of_freedom: f64,
}

/// Second over first singular value of the scatter below which points count as lying on a line.
/// A spread across the line of 3 % of the spread along it.
pub(crate) const COLLINEAR: f64 = 1e-3;
/// Sum of the lesser two singular values, the last with its sign, over the first: below this a mirrored
/// set leaves the rotation open.
const MIRRORED: f64 = 1e-6;
/// Residuals below this share of the spread are lost in the rounding of moments.
const ROUNDED: f64 = 1e-5;

/// Registers `source[i]` to `target[i]` (m).
///
/// # Errors
/// [`Error::TooFewPoints`] below three, [`Error::Collinear`], [`Error::NotFinite`],
/// [`Error::NotDetermined`] for a mirrored set of which no rotation is best, [`Error::Invalid`] for
/// lists of different lengths.
pub fn rigid_fit(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> Result<RigidFit, Error> {
    let moments = moments(source, target)?;
    let r = best_rotation(&moments)?;
    let t = moments.q_mean - r * moments.p_mean;
    let fit = Isometry3::from_parts(Translation3::from(t), r);
    let count = source.len() as f64;
    let turned = r.to_rotation_matrix().matrix().component_mul(&moments.cross).sum();
    let spread = moments.p_squared() + moments.q_squared;
    let mut squares = (spread - 2.0 * turned) / moments.weight;
    if squares < ROUNDED * ROUNDED * spread / moments.weight {
        squares = mean_square(&fit, source, target);
    }
    let unit = unit_covariance(&moments, count).ok_or(Error::Collinear { ratio: 0.0 })?;
    let degrees_of_freedom = 3.0 * count - 6.0;
    let squares = squares.max(0.0);
    let sigma_m = (squares * count / degrees_of_freedom).sqrt();
    Ok(RigidFit {
        target_from_source: fit,
        covariance: (count > 3.0).then(|| unit * (sigma_m * sigma_m)),
        rms_m: squares.sqrt(),
        sigma_m,
        degrees_of_freedom,
    })
}

/// Checked: as many in one list as in the other, at least three, all finite.
pub(super) fn moments(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> Result<Moments, Error> {
    if source.len() != target.len() {
        return Err(Error::Invalid(format!(
            "{} source points and {} target points: their numbers must be equal",
            source.len(),
            target.len()
        )));
    }
    let too_few = Error::TooFewPoints { found: source.len(), needed: 3 };
    if source.len() < 3 {
        return Err(too_few);
    }
    let moments = Moments::of(source, target).ok_or(too_few)?;
    if !(moments.p_squared() + moments.q_squared).is_finite() {
        let bad = |v: &Vector3<f64>| v.iter().any(|x| !x.is_finite());
        return Err(match source.iter().zip(target).position(|(p, q)| bad(p) || bad(q)) {
            Some(i) => Error::NotFinite { what: format!("point pair {}", i + 1) },
            None => {
                Error::Invalid("the points are too far from each other for their squares".into())
            }
        });
    }
    Ok(moments)
}

/// Refused where the points lie on a line, or mirror each other.
pub(super) fn best_rotation(moments: &Moments) -> Result<nalgebra::UnitQuaternion<f64>, Error> {
    let bound = 0.5 * (moments.p_squared() + moments.q_squared);
    let found = rotation::align(&moments.cross, bound).ok_or(Error::Collinear { ratio: 0.0 })?;
    let clear = found.is_clear();
    if clear && rotation::spread_is_clear(&moments.scatter) {
        return Ok(found.rotation);
    }
    let [first, second, last] = found.singular().into();
    // errors of the points tell of a turn about their line, but not the true one
    let [along, across, _] = rotation::eigenvalues(&moments.scatter).into();
    let ratio = (second / first).min(across / along);
    if !(ratio > COLLINEAR) {
        return Err(Error::Collinear { ratio: ratio.max(0.0) });
    }
    if clear {
        return Ok(found.rotation);
    }
    if !(second + last > MIRRORED * first) {
        return Err(Error::NotDetermined {
            what: "one point set is the mirror image of the other, and no rotation fits better than all \
                   others; is an axis of one of them reversed, or are points mixed up?"
                .into(),
        });
    }
    Ok(found.rotation)
}

fn mean_square(fit: &Isometry3<f64>, source: &[Vector3<f64>], target: &[Vector3<f64>]) -> f64 {
    let (r, t) = (fit.rotation.to_rotation_matrix(), fit.translation.vector);
    let squares = source.iter().zip(target).map(|(p, q)| (r * p + t - q).norm_squared());
    squares.sum::<f64>() / source.len() as f64
}

/// For an error of 1 m of a point.
fn unit_covariance(moments: &Moments, count: f64) -> Option<Matrix6<f64>> {
    let scale = count / moments.weight;
    let inertia = (Matrix3::identity() * moments.p_squared() - moments.scatter) * scale;
    let turn = inertia.try_inverse()?;
    let arm = lie::hat(&moments.p_mean);
    let both = arm * turn;
    let shift = Matrix3::identity() / count + both * arm.transpose();
    let mut covariance = Matrix6::zeros();
    covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    covariance.fixed_view_mut::<3, 3>(3, 0).copy_from(&both);
    covariance.fixed_view_mut::<3, 3>(0, 3).copy_from(&both.transpose());
    covariance.fixed_view_mut::<3, 3>(3, 3).copy_from(&shift);
    Some(covariance)
}

/// `∂(T exp(δ) p)/∂δ` up to the rotation of `T`: `[-[p]ₓ, I]`.
pub(crate) fn point_jacobian(p: &Vector3<f64>) -> SMatrix<f64, 3, 6> {
    let mut j = SMatrix::<f64, 3, 6>::zeros();
    j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-lie::hat(p));
    j.fixed_view_mut::<3, 3>(0, 3).copy_from(&Matrix3::identity());
    j
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{linalg, random::Random};

    pub(crate) fn grid() -> Vec<Vector3<f64>> {
        (0..12)
            .map(|i| Vector3::new(0.05 * f64::from(i % 4), 0.07 * f64::from(i / 4), 1.0))
            .collect()
    }

    fn truth() -> Isometry3<f64> {
        Isometry3::new(Vector3::new(0.6, -0.2, 1.1), Vector3::new(2.0, 2.1, -0.3))
    }

    fn moved(points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        points.iter().map(|p| truth().transform_vector(p) + truth().translation.vector).collect()
    }

    #[test]
    fn exact_points_of_a_plane_give_the_truth() {
        let points = grid();
        let fit = rigid_fit(&points, &moved(&points)).unwrap();
        let error = fit.target_from_source.inv_mul(&truth());
        assert!(error.translation.vector.norm() < 1e-12 && error.rotation.angle() < 1e-12);
        assert!(fit.rms_m < 1e-12);
    }

    #[test]
    fn moving_the_target_moves_only_the_answer() {
        let points = grid();
        let shift = Isometry3::new(Vector3::new(-3.0, 0.4, 0.0), Vector3::new(0.0, 0.0, 1.2));
        let q: Vec<_> = moved(&points)
            .iter()
            .map(|p| shift.transform_vector(p) + shift.translation.vector)
            .collect();
        let fit = rigid_fit(&points, &q).unwrap();
        let error = fit.target_from_source.inv_mul(&(shift * truth()));
        assert!(error.translation.vector.norm() < 1e-12 && error.rotation.angle() < 1e-12);
    }

    #[test]
    fn points_on_a_line_are_refused() {
        let line: Vec<_> = (0..9).map(|i| Vector3::new(0.03 * f64::from(i), 0.0, 1.0)).collect();
        let error = rigid_fit(&line, &moved(&line)).unwrap_err();
        assert!(matches!(error, Error::Collinear { .. }), "{error}");
        let mut random = Random::new(6);
        let mut shaken = |points: &[Vector3<f64>], sigma: f64| -> Vec<Vector3<f64>> {
            points.iter().map(|p| p + random.normal3() * sigma).collect()
        };
        for _ in 0..200 {
            let (source, target) = (shaken(&line, 1e-3), shaken(&moved(&line), 2e-3));
            let error = rigid_fit(&source, &target).unwrap_err();
            assert!(matches!(error, Error::Collinear { .. }), "{error}");
        }
        let same = vec![Vector3::new(0.1, 0.2, 0.3); 5];
        assert!(rigid_fit(&same, &moved(&same)).is_err());
    }

    #[test]
    fn a_mirrored_set_gives_a_rotation_all_the_same() {
        let mut points = grid();
        points[5].z += 0.08;
        let mirrored: Vec<_> = points.iter().map(|p| Vector3::new(-p.x, p.y, p.z)).collect();
        let fit = rigid_fit(&points, &mirrored).unwrap();
        let r = fit.target_from_source.rotation.to_rotation_matrix();
        assert!((r.matrix().determinant() - 1.0).abs() < 1e-12);
        assert!(fit.rms_m > 1e-3);
    }

    fn noisy(random: &mut Random, sigma: f64) -> Vec<Vector3<f64>> {
        moved(&grid()).iter().map(|q| q + random.normal3() * sigma).collect()
    }

    #[test]
    fn the_covariance_is_that_of_the_normal_equations() {
        let target = noisy(&mut Random::new(2), 3e-4);
        let fit = rigid_fit(&grid(), &target).unwrap();
        let jacobians = grid();
        let jacobians = jacobians.iter().map(point_jacobian);
        let sum: Matrix6<f64> = jacobians.map(|j| j.transpose() * j).sum();
        let expected = linalg::invert_spd(&sum).unwrap() * (fit.sigma_m * fit.sigma_m);
        let covariance = fit.covariance.unwrap();
        assert!((covariance - expected).norm() < 1e-9 * expected.norm());
        let residual = |(p, q): (&Vector3<f64>, &Vector3<f64>)| {
            (fit.target_from_source.transform_point(&(*p).into()).coords - q).norm_squared()
        };
        let rms = (grid().iter().zip(&target).map(residual).sum::<f64>() / 12.0).sqrt();
        assert!((fit.rms_m - rms).abs() < 1e-9 * rms);
    }

    #[test]
    fn errors_stay_within_the_covariance() {
        let mut random = Random::new(3);
        let runs = 400;
        let mut sum = 0.0;
        for _ in 0..runs {
            let target = noisy(&mut random, 3e-4);
            let fit = rigid_fit(&grid(), &target).unwrap();
            let error = lie::log(&fit.target_from_source.inv_mul(&truth()));
            let covariance = fit.covariance.unwrap() * (3e-4 / fit.sigma_m).powi(2);
            sum += error.dot(&(covariance.try_inverse().unwrap() * error)) / 6.0;
        }
        // three standard errors of a mean of 400 chi-squares of six degrees
        let mean = sum / f64::from(runs);
        assert!((mean - 1.0).abs() < 0.09, "{mean}");
    }

    #[test]
    fn far_from_the_origin_no_digits_are_lost() {
        let away = Vector3::new(4e3, -7e3, 2e3);
        let points: Vec<_> = grid().iter().map(|p| p + away).collect();
        let fit = rigid_fit(&points, &points).unwrap();
        assert!(fit.rms_m < 1e-9 && fit.target_from_source.rotation.angle() < 1e-9);
    }

    #[test]
    fn bad_points_are_named() {
        let mut points = grid();
        points[4].y = f64::NAN;
        let error = rigid_fit(&grid(), &points).unwrap_err();
        assert!(error.to_string().contains("point pair 5"), "{error}");
        assert!(matches!(rigid_fit(&grid()[..2], &grid()[..2]), Err(Error::TooFewPoints { .. })));
        assert!(matches!(rigid_fit(&grid(), &grid()[1..]), Err(Error::Invalid(_))));
        let ball: Vec<_> = (0..3).flat_map(|k| [1.0, -1.0].map(|s| Vector3::ith(k, s))).collect();
        let mirrored: Vec<_> = ball.iter().map(|p| Vector3::new(p.x, p.y, -p.z)).collect();
        let error = rigid_fit(&ball, &mirrored).unwrap_err();
        assert!(matches!(error, Error::NotDetermined { .. }), "{error}");
    }
}
