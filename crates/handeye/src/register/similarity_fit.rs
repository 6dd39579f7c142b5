//! Transform and scale between two point sets with known correspondences.
//!
//! `min Σ |s R p_i + t - q_i|²`: `R` as for a rigid fit, `s = tr(Rᵀ H) / Σ |p - p̄|²`, `t = q̄ - s R p̄`. Scale
//! and rotation are independent about the centroid: `Var(ln s) = FLE² / s² Σ |p - p̄|²`.
//!
//! S. Umeyama, IEEE TPAMI 13(4), 1991.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::{RigidFit, rigid_fit};
use crate::Error;

/// A registration with its scale.
#[derive(Debug, Clone, PartialEq)]
pub struct SimilarityFit {
    /// Of the source points times [`scale`](Self::scale); its covariance counts the scale in.
    pub rigid: RigidFit,
    /// A length in the target over the same length in the source.
    pub scale: f64,
    /// Standard deviation of the scale.
    pub scale_sigma: f64,
}

/// Registers `scale * source[i]` to `target[i]` (m).
///
/// # Errors
/// As [`rigid_fit()`](super::rigid_fit()).
pub fn similarity_fit(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
) -> Result<SimilarityFit, Error> {
    let moments = rigid_fit::moments(source, target, None)?;
    let r = rigid_fit::best_rotation(&moments)?;
    let turned = r.to_rotation_matrix().matrix().component_mul(&moments.cross).sum();
    let scale = turned / moments.p_squared();
    let t = moments.q_mean - r * moments.p_mean * scale;
    let at = Isometry3::from_parts(Translation3::from(t), r);
    let squares = (moments.q_squared - scale * turned) / moments.weight;
    let scaled = moments.scaled(scale);
    let mut rigid = RigidFit::new(at, &scaled, source.len() as f64, squares, 7.0)?;
    let log_variance = rigid.sigma_m.powi(2) / scaled.p_squared();
    let middle = scaled.p_mean;
    if let Some(covariance) = &mut rigid.covariance {
        let mut shift = covariance.fixed_view_mut::<3, 3>(3, 3);
        shift += middle * middle.transpose() * log_variance;
    }
    Ok(SimilarityFit { rigid, scale, scale_sigma: scale * log_variance.sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{lie, random::Random};

    fn points() -> Vec<Vector3<f64>> {
        (0..12)
            .map(|i| Vector3::new(0.05 * f64::from(i % 4), 0.07 * f64::from(i / 4), 1.0))
            .collect()
    }

    fn truth() -> Isometry3<f64> {
        Isometry3::new(Vector3::new(0.6, -0.2, 1.1), Vector3::new(2.0, 2.1, -0.3))
    }

    fn moved(scale: f64) -> Vec<Vector3<f64>> {
        points().iter().map(|p| truth().transform_point(&(p * scale).into()).coords).collect()
    }

    #[test]
    fn millimetres_for_metres_are_found() {
        let fit = similarity_fit(&points(), &moved(1000.0)).unwrap();
        assert!((fit.scale - 1000.0).abs() < 1e-9);
        assert!(lie::log(&fit.rigid.target_from_source.inv_mul(&truth())).norm() < 1e-9);
        assert!(fit.rigid.rms_m < 1e-4 && fit.scale_sigma < 1e-3);
    }

    #[test]
    fn errors_stay_within_the_covariance() {
        let mut random = Random::new(5);
        let runs = 400;
        let (mut pose, mut scale) = (0.0, 0.0);
        for _ in 0..runs {
            let target: Vec<_> = moved(1.01).iter().map(|q| q + random.normal3() * 3e-4).collect();
            let fit = similarity_fit(&points(), &target).unwrap();
            let error = lie::log(&fit.rigid.target_from_source.inv_mul(&truth()));
            let covariance = fit.rigid.covariance.unwrap();
            pose += error.dot(&(covariance.try_inverse().unwrap() * error)) / 6.0;
            scale += ((fit.scale - 1.01) / fit.scale_sigma).powi(2);
        }
        let runs = f64::from(runs);
        // 29 degrees of freedom: squares over an estimated variance are 29/27 on average
        assert!((pose / runs * 27.0 / 29.0 - 1.0).abs() < 0.12, "{}", pose / runs);
        assert!((scale / runs * 27.0 / 29.0 - 1.0).abs() < 0.25, "{}", scale / runs);
    }
}
