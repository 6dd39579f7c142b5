//! Rigid transform between two point sets with known correspondences.
//!
//! `min Σ w_i |R p_i + t - q_i|²`: with the weighted centroids `p̄, q̄` and `H = Σ w (q - q̄)(p - p̄)ᵀ`,
//! `H = U S Vᵀ` gives `R = U diag(1, 1, det(U Vᵀ)) Vᵀ` and `t = q̄ - R p̄`. The result does not
//! depend on any start. Its covariance follows from the scatter of the points and the error of one
//! point (`FLE`), which the residuals underestimate: six of the `3 K` equations were spent on the
//! answer, so `FLE² = Σ w r² / (3 K - 6)` per axis.
//!
//! B. Horn, J. Opt. Soc. Am. A 4(4), 1987; S. Umeyama, IEEE TPAMI 13(4), 1991;
//! J. Fitzpatrick, J. West, C. Maurer, *Predicting error in rigid-body point-based registration*,
//! IEEE T-MI 17(5), 1998.

use nalgebra::{Isometry3, Matrix3, Matrix6, SMatrix, Vector3};

use crate::{Error, lie, linalg, solve};

/// A registration and how sure it is.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidFit {
    /// Takes source points to the target: `target_from_source`.
    pub target_from_source: Isometry3<f64>,
    /// 6 x 6, rotation first, perturbed on the right (in the source frame); `None` with three
    /// points, which leave too little to judge the error by, unless the error was given.
    pub covariance: Option<Matrix6<f64>>,
    /// Root mean square of the residual lengths, m.
    pub rms_m: f64,
    /// Error of one point, per axis, m: given, or estimated from the residuals.
    pub sigma_m: f64,
    /// `3 K - 6`.
    pub degrees_of_freedom: f64,
}

/// Second over first singular value of the scatter below which points count as lying on a line.
/// A spread across the line of 3 % of the spread along it.
pub const COLLINEAR: f64 = 1e-3;

/// Registers `source[i]` to `target[i]`, weighted.
///
/// `sigma_m` is the error of one point per axis where it is known; `None` estimates it.
///
/// # Errors
/// [`Error::TooFewPoints`] below three, [`Error::Collinear`], [`Error::NotFinite`],
/// [`Error::Invalid`] for lists of different lengths or weights that are not positive.
pub fn rigid_fit(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    weights: &[f64],
    sigma_m: Option<f64>,
) -> Result<RigidFit, Error> {
    check(source, target, weights)?;
    let total: f64 = weights.iter().sum();
    let centroid = |points: &[Vector3<f64>]| -> Vector3<f64> {
        points.iter().zip(weights).map(|(p, w)| p * *w).sum::<Vector3<f64>>() / total
    };
    let (p_mean, q_mean) = (centroid(source), centroid(target));
    let h: Matrix3<f64> = source
        .iter()
        .zip(target)
        .zip(weights)
        .map(|((p, q), w)| (q - q_mean) * (p - p_mean).transpose() * *w)
        .sum();
    let (_, s, _) = linalg::svd3(&h);
    if !(s[1] > COLLINEAR * s[0]) {
        return Err(Error::Collinear { ratio: if s[0] > 0.0 { s[1] / s[0] } else { 0.0 } });
    }
    let r = linalg::nearest_rotation(&h).ok_or(Error::Collinear { ratio: s[1] / s[0] })?;
    let fit = solve::isometry(&r, q_mean - r * p_mean);
    Ok(judge(source, target, weights, fit, sigma_m))
}

fn check(source: &[Vector3<f64>], target: &[Vector3<f64>], weights: &[f64]) -> Result<(), Error> {
    if source.len() != target.len() || source.len() != weights.len() {
        return Err(Error::Invalid(format!(
            "{} source points, {} target points and {} weights: their numbers must be equal",
            source.len(),
            target.len(),
            weights.len()
        )));
    }
    if source.len() < 3 {
        return Err(Error::TooFewPoints { found: source.len(), needed: 3 });
    }
    let bad = |v: &Vector3<f64>| v.iter().any(|x| !x.is_finite());
    if let Some(i) = source.iter().zip(target).position(|(p, q)| bad(p) || bad(q)) {
        return Err(Error::NotFinite { what: format!("point pair {}", i + 1) });
    }
    match weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
        Some(i) => Err(Error::Invalid(format!("weight {} is not a positive number", i + 1))),
        None => Ok(()),
    }
}

/// Residuals and covariance of a transform, however it was found.
pub(super) fn judge(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    weights: &[f64],
    fit: Isometry3<f64>,
    sigma_m: Option<f64>,
) -> RigidFit {
    let k = source.len() as f64;
    let mean_weight = weights.iter().sum::<f64>() / k;
    let (mut squares, mut weighted, mut information) = (0.0, 0.0, Matrix6::zeros());
    for ((p, q), w) in source.iter().zip(target).zip(weights) {
        let w = w / mean_weight;
        let r2 = (fit.transform_vector(p) + fit.translation.vector - q).norm_squared();
        squares += r2;
        weighted += w * r2;
        let j = point_jacobian(p);
        information += j.transpose() * j * w;
    }
    let degrees_of_freedom = 3.0 * k - 6.0;
    let sigma = sigma_m.unwrap_or((weighted / degrees_of_freedom).sqrt());
    let enough = sigma_m.is_some() || k > 3.0;
    let covariance = linalg::invert_spd(&information).map(|c| c * (sigma * sigma));
    RigidFit {
        target_from_source: fit,
        covariance: covariance.filter(|_| enough),
        rms_m: (squares / k).sqrt(),
        sigma_m: sigma,
        degrees_of_freedom,
    }
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
        let fit = rigid_fit(&points, &moved(&points), &[1.0; 12], None).unwrap();
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
        let fit = rigid_fit(&points, &q, &[1.0; 12], None).unwrap();
        let error = fit.target_from_source.inv_mul(&(shift * truth()));
        assert!(error.translation.vector.norm() < 1e-12 && error.rotation.angle() < 1e-12);
    }

    #[test]
    fn points_on_a_line_are_refused() {
        let line: Vec<_> = (0..9).map(|i| Vector3::new(0.03 * f64::from(i), 0.0, 1.0)).collect();
        let error = rigid_fit(&line, &moved(&line), &[1.0; 9], None).unwrap_err();
        assert!(matches!(error, Error::Collinear { .. }), "{error}");
        let same = vec![Vector3::new(0.1, 0.2, 0.3); 5];
        assert!(rigid_fit(&same, &moved(&same), &[1.0; 5], None).is_err());
    }

    #[test]
    fn a_mirrored_set_gives_a_rotation_all_the_same() {
        let mut points = grid();
        points[5].z += 0.08;
        let mirrored: Vec<_> = points.iter().map(|p| Vector3::new(-p.x, p.y, p.z)).collect();
        let fit = rigid_fit(&points, &mirrored, &[1.0; 12], None).unwrap();
        let r = fit.target_from_source.rotation.to_rotation_matrix();
        assert!((r.matrix().determinant() - 1.0).abs() < 1e-12);
        assert!(fit.rms_m > 1e-3);
    }
}
