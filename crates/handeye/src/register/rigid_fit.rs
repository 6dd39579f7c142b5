//! Rigid transform between two point sets with known correspondences.
//!
//! `min Σ w_i |R p_i + t - q_i|²`: with the weighted centroids `p̄, q̄` and `H = Σ w (q - q̄)(p - p̄)ᵀ`, the
//! best rotation maximises `tr(Rᵀ H)`, and `t = q̄ - R p̄`. One pass over the points gives `H` and all
//! else that is needed. The result does not depend on any start.
//!
//! Its covariance follows from the scatter of the points and the error of one point (`FLE`), which
//! the residuals underestimate: six of the `3 K` equations were spent on the answer, so
//! `FLE² = Σ w r² / (3 K - 6)` per axis. About the centroid, rotation and translation are independent:
//! `Cov(ω) = FLE² (Σ w (|p|² I - p pᵀ))⁻¹`, `Cov(u) = FLE² / K`, and `v = u + p̄ × ω`.
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
    /// points, which leave too little to judge the error by, unless the error was given.
    pub covariance: Option<Matrix6<f64>>,
    /// Root mean square of the residual lengths, m, weighted like the points.
    pub rms_m: f64,
    /// Error of one point of mean weight, per axis, m: given, or estimated from the residuals.
    pub sigma_m: f64,
    /// `3 K - 6`; one less with a scale.
    pub degrees_of_freedom: f64,
    /// Covariance for a point error of 1 m.
    unit: Matrix6<f64>,
}

/// Second over first singular value of the scatter below which points count as lying on a line.
/// A spread across the line of 3 % of the spread along it.
pub const COLLINEAR: f64 = 1e-3;
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
    fit(source, target, None)
}

/// Registers `source[i]` to `target[i]` (m); a point with twice the weight counts as two.
///
/// # Errors
/// As [`rigid_fit()`], and [`Error::Invalid`] for weights that are not positive.
pub fn weighted_rigid_fit(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    weights: &[f64],
) -> Result<RigidFit, Error> {
    if weights.len() != source.len() {
        return Err(Error::Invalid(format!(
            "{} weights for {} points: their numbers must be equal",
            weights.len(),
            source.len()
        )));
    }
    if let Some(i) = weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
        return Err(Error::Invalid(format!("weight {} is not a positive number", i + 1)));
    }
    fit(source, target, Some(weights))
}

fn fit(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    weights: Option<&[f64]>,
) -> Result<RigidFit, Error> {
    let moments = moments(source, target, weights)?;
    let r = best_rotation(&moments)?;
    let t = moments.q_mean - r * moments.p_mean;
    let fit = Isometry3::from_parts(Translation3::from(t), r);
    let count = source.len() as f64;
    let turned = r.to_rotation_matrix().matrix().component_mul(&moments.cross).sum();
    let spread = moments.p_squared() + moments.q_squared;
    let mut squares = (spread - 2.0 * turned) / moments.weight;
    if squares < ROUNDED * ROUNDED * spread / moments.weight {
        squares = mean_square(&fit, source, target, weights, moments.weight);
    }
    RigidFit::new(fit, &moments, count, squares, 6.0)
}

impl RigidFit {
    /// Of `count` points with these moments, whose residuals are `mean_square` (m²) after so many
    /// parameters were fitted.
    pub(super) fn new(
        target_from_source: Isometry3<f64>,
        moments: &Moments,
        count: f64,
        mean_square: f64,
        parameters: f64,
    ) -> Result<Self, Error> {
        let unit = unit_covariance(moments, count).ok_or(Error::Collinear { ratio: 0.0 })?;
        let degrees_of_freedom = 3.0 * count - parameters;
        let mean_square = mean_square.max(0.0);
        let sigma_m = (mean_square * count / degrees_of_freedom).sqrt();
        Ok(Self {
            target_from_source,
            covariance: (count > 3.0).then(|| unit * (sigma_m * sigma_m)),
            rms_m: mean_square.sqrt(),
            sigma_m,
            degrees_of_freedom,
            unit,
        })
    }

    /// With the error of one point per axis (m) known beforehand: the residuals do not count.
    pub fn with_point_error(mut self, sigma_m: f64) -> Self {
        self.sigma_m = sigma_m;
        self.covariance = Some(self.unit * (sigma_m * sigma_m));
        self
    }

    /// Covariance (m², target frame) with which a point of the source frame lands in the target: its
    /// trace is the expected square of the target registration error.
    pub fn landing_covariance(&self, point: &Vector3<f64>) -> Option<Matrix3<f64>> {
        let turn = self.target_from_source.rotation.to_rotation_matrix();
        let j = turn.matrix() * point_jacobian(point);
        self.covariance.map(|covariance| j * covariance * j.transpose())
    }
}

/// Expected target registration error (RMS, m) at `point` for points with equal errors of `fle_m` (RMS
/// of their lengths): `TRE² = FLE² / K (1 + ⅓ Σ d_k² / f_k²)` over the principal axes of the points,
/// with the distances `d_k` of `point` from them and the RMS distances `f_k` of the points. `None` for
/// points on a line, or fewer than three.
///
/// J. Fitzpatrick, J. West, C. Maurer, IEEE T-MI 17(5), 1998.
pub fn expected_tre(points: &[Vector3<f64>], fle_m: f64, point: &Vector3<f64>) -> Option<f64> {
    let moments = moments(points, points, None).ok()?;
    let axes = (moments.scatter / moments.weight).symmetric_eigen();
    let along = axes.eigenvectors.transpose() * (point - moments.p_mean);
    let total: f64 = axes.eigenvalues.sum();
    let far = along.norm_squared();
    let mut sum = 0.0;
    for k in 0..3 {
        let f_squared = total - axes.eigenvalues[k];
        if !(f_squared > COLLINEAR * total) {
            return None;
        }
        sum += (far - along[k] * along[k]) / f_squared;
    }
    Some(fle_m * ((1.0 + sum / 3.0) / moments.weight).sqrt())
}

/// Checked: as many in one list as in the other, at least three, all finite.
pub(super) fn moments(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    weights: Option<&[f64]>,
) -> Result<Moments, Error> {
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
    let moments = Moments::of(source, target, weights).ok_or(too_few)?;
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

fn mean_square(
    fit: &Isometry3<f64>,
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    weights: Option<&[f64]>,
    total: f64,
) -> f64 {
    let (r, t) = (fit.rotation.to_rotation_matrix(), fit.translation.vector);
    let square = |i: usize| (r * source[i] + t - target[i]).norm_squared();
    let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
    (0..source.len()).map(|i| weight(i) * square(i)).sum::<f64>() / total
}

/// For an error of 1 m of a point with the mean weight.
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
pub fn point_jacobian(p: &Vector3<f64>) -> SMatrix<f64, 3, 6> {
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

    /// Normal equations in all six parameters, weighted.
    fn by_least_squares(points: &[Vector3<f64>], weights: &[f64], sigma: f64) -> Matrix6<f64> {
        let mean = weights.iter().sum::<f64>() / weights.len() as f64;
        let sum: Matrix6<f64> = points
            .iter()
            .zip(weights)
            .map(|(p, w)| point_jacobian(p).transpose() * point_jacobian(p) * (w / mean))
            .sum();
        linalg::invert_spd(&sum).unwrap() * (sigma * sigma)
    }

    fn noisy(random: &mut Random, sigma: f64) -> Vec<Vector3<f64>> {
        moved(&grid()).iter().map(|q| q + random.normal3() * sigma).collect()
    }

    #[test]
    fn the_covariance_is_that_of_the_normal_equations() {
        let weights: Vec<f64> = (0..12).map(|i| 0.5 + f64::from(i % 5)).collect();
        let target = noisy(&mut Random::new(2), 3e-4);
        let fit = weighted_rigid_fit(&grid(), &target, &weights).unwrap();
        let expected = by_least_squares(&grid(), &weights, fit.sigma_m);
        let covariance = fit.covariance.unwrap();
        assert!((covariance - expected).norm() < 1e-9 * expected.norm());
        let residual = |i: usize| {
            (fit.target_from_source.transform_point(&grid()[i].into()).coords - target[i])
                .norm_squared()
        };
        let total: f64 = weights.iter().sum();
        let rms = ((0..12).map(|i| weights[i] * residual(i)).sum::<f64>() / total).sqrt();
        assert!((fit.rms_m - rms).abs() < 1e-9 * rms);
    }

    #[test]
    fn errors_stay_within_the_covariance() {
        let mut random = Random::new(3);
        let runs = 400;
        let (mut sum, mut tre, mut promised, mut formula) = (0.0, 0.0, 0.0, 0.0);
        let far = Vector3::new(0.3, -0.2, 0.7);
        for _ in 0..runs {
            let target = noisy(&mut random, 3e-4);
            let fit = rigid_fit(&grid(), &target).unwrap().with_point_error(3e-4);
            let error = lie::log(&fit.target_from_source.inv_mul(&truth()));
            let covariance = fit.covariance.unwrap();
            sum += error.dot(&(covariance.try_inverse().unwrap() * error)) / 6.0;
            let landed = fit.target_from_source.transform_point(&far.into()).coords;
            tre += (landed - moved(&[far])[0]).norm_squared();
            promised += fit.landing_covariance(&far).unwrap().trace();
            formula += expected_tre(&grid(), 3e-4 * 3f64.sqrt(), &far).unwrap().powi(2);
        }
        // three standard errors of a mean of 400 chi-squares of six degrees
        let mean = sum / f64::from(runs);
        assert!((mean - 1.0).abs() < 0.09, "{mean}");
        assert!((tre / promised - 1.0).abs() < 0.15, "{}", tre / promised);
        assert!((formula / promised - 1.0).abs() < 1e-9, "{}", formula / promised);
    }

    #[test]
    fn a_weight_of_two_counts_as_two_points() {
        let target = noisy(&mut Random::new(4), 3e-4);
        let mut weights = vec![1.0; 12];
        weights[3] = 2.0;
        let weighted = weighted_rigid_fit(&grid(), &target, &weights).unwrap();
        let (mut p, mut q) = (grid(), target.clone());
        p.push(p[3]);
        q.push(q[3]);
        let doubled = rigid_fit(&p, &q).unwrap();
        let off = lie::log(&weighted.target_from_source.inv_mul(&doubled.target_from_source));
        assert!(off.norm() < 1e-12);
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
        let weights = weighted_rigid_fit(&grid(), &grid(), &[0.0; 12]).unwrap_err();
        assert!(weights.to_string().contains("weight 1 "), "{weights}");
        let ball: Vec<_> = (0..3).flat_map(|k| [1.0, -1.0].map(|s| Vector3::ith(k, s))).collect();
        let mirrored: Vec<_> = ball.iter().map(|p| Vector3::new(p.x, p.y, -p.z)).collect();
        let error = rigid_fit(&ball, &mirrored).unwrap_err();
        assert!(matches!(error, Error::NotDetermined { .. }), "{error}");
    }
}
