//! Rigid transform between two sets of measured points with a covariance each.
//!
//! `min Σ r_iᵀ (R S_i Rᵀ + S'_i)⁻¹ r_i`, `r_i = R p_i + t - q_i`: Gauss-Newton steps, the weights of which
//! follow the rotation. The best estimate where points are not equally well known in all directions, as
//! corners that a camera measures in depth.
//!
//! B. Matei and P. Meer, *Optimal rigid motion estimation and performance evaluation with bootstrap*,
//! CVPR 1999; N. Ohta and K. Kanatani, IEICE Trans. E81-D, 1998.

use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3, Vector6};

use super::rigid_fit::{self, point_jacobian};
use crate::{
    Error,
    math::{lie, linalg},
};

/// Most steps; three are usual.
const MOST_STEPS: usize = 30;
/// A step shorter than this share of a standard deviation is the last.
const SETTLED: f64 = 1e-4;

/// A point (m) and its covariance (m²), in the same frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredPoint {
    /// Where it was measured.
    pub at: Vector3<f64>,
    /// How well.
    pub covariance: Matrix3<f64>,
}

/// A registration of measured points.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredFit {
    /// Takes source points to the target: `target_from_source`.
    pub target_from_source: Isometry3<f64>,
    /// 6 x 6, rotation first, perturbed on the right, by the stated covariances alone.
    pub covariance: Matrix6<f64>,
    /// Sum of the normalised residuals' squares: expected to be [`Self::degrees_of_freedom`] where the
    /// stated covariances are right.
    pub chi_squared: f64,
    /// `3 K - 6`.
    pub degrees_of_freedom: f64,
    /// Root mean square of the residual lengths, m.
    pub rms_m: f64,
}

/// Registers `source[i]` to `target[i]`.
///
/// # Errors
/// As [`rigid_fit()`](super::rigid_fit()); [`Error::Invalid`] for a pair whose covariances do not add up
/// to a positive definite one.
pub fn measured_fit(
    source: &[MeasuredPoint],
    target: &[MeasuredPoint],
) -> Result<MeasuredFit, Error> {
    let at = |points: &[MeasuredPoint]| points.iter().map(|p| p.at).collect::<Vec<_>>();
    let start = rigid_fit::rigid_fit(&at(source), &at(target))?.target_from_source;
    let mut fit = start;
    for _ in 0..MOST_STEPS {
        let sums = Sums::at(&fit, source, target)?;
        let covariance = sums.covariance()?;
        let step = -covariance * sums.gradient;
        fit *= lie::exp(&step);
        if step.dot(&(sums.information * step)) < SETTLED * SETTLED {
            break;
        }
    }
    let sums = Sums::at(&fit, source, target)?;
    Ok(MeasuredFit {
        target_from_source: fit,
        covariance: sums.covariance()?,
        chi_squared: sums.chi_squared,
        degrees_of_freedom: 3.0 * source.len() as f64 - 6.0,
        rms_m: (sums.squares / source.len() as f64).sqrt(),
    })
}

struct Sums {
    information: Matrix6<f64>,
    gradient: Vector6<f64>,
    chi_squared: f64,
    squares: f64,
}

impl Sums {
    fn at(
        fit: &Isometry3<f64>,
        source: &[MeasuredPoint],
        target: &[MeasuredPoint],
    ) -> Result<Self, Error> {
        let r = fit.rotation.to_rotation_matrix().into_inner();
        let mut sums = Self {
            information: Matrix6::zeros(),
            gradient: Vector6::zeros(),
            chi_squared: 0.0,
            squares: 0.0,
        };
        for (i, (p, q)) in source.iter().zip(target).enumerate() {
            // all in the source frame, in which the Jacobian is that of a point
            let weight = (p.covariance + r.transpose() * q.covariance * r)
                .cholesky()
                .ok_or_else(|| indefinite(i))?
                .inverse();
            let residual = r.transpose() * (r * p.at + fit.translation.vector - q.at);
            let j = point_jacobian(&p.at);
            sums.information += j.transpose() * weight * j;
            sums.gradient += j.transpose() * weight * residual;
            sums.chi_squared += residual.dot(&(weight * residual));
            sums.squares += residual.norm_squared();
        }
        Ok(sums)
    }

    fn covariance(&self) -> Result<Matrix6<f64>, Error> {
        linalg::invert_spd(&self.information).ok_or(Error::Collinear { ratio: 0.0 })
    }
}

fn indefinite(i: usize) -> Error {
    Error::Invalid(format!(
        "the covariances of point pair {} add up to one that is not positive definite",
        i + 1
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn truth() -> Isometry3<f64> {
        Isometry3::new(Vector3::new(0.6, -0.2, 1.1), Vector3::new(2.0, 2.1, -0.3))
    }

    /// Points that a camera measures well across its axis and badly along it, and a robot
    /// touches equally well in all directions.
    fn measured(random: &mut Random) -> (Vec<MeasuredPoint>, Vec<MeasuredPoint>) {
        let by_camera = Vector3::new(1e-4, 1e-4, 2e-3);
        let pair = |i: i32| {
            let (x, y, z) = (f64::from(i % 4), f64::from(i / 4), f64::from(i % 3));
            let p = Vector3::new(0.05 * x, 0.07 * y, 0.9 + 0.1 * z);
            let q = truth().transform_point(&p.into()).coords;
            let point = |at, sigma: Vector3<f64>, error: Vector3<f64>| MeasuredPoint {
                at: at + error.component_mul(&sigma),
                covariance: Matrix3::from_diagonal(&sigma.component_mul(&sigma)),
            };
            let (a, b) = (random.normal3(), random.normal3());
            (point(p, by_camera, a), point(q, Vector3::repeat(2e-4), b))
        };
        (0..12).map(pair).unzip()
    }

    #[test]
    fn errors_stay_within_the_covariance_and_below_those_of_equal_weights() {
        let mut random = Random::new(6);
        let runs = 400;
        let (mut nees, mut chi, mut ours, mut equal) = (0.0, 0.0, 0.0, 0.0);
        let far = Vector3::new(0.1, 0.1, 1.3);
        for _ in 0..runs {
            let (source, target) = measured(&mut random);
            let fit = measured_fit(&source, &target).unwrap();
            let error = lie::log(&fit.target_from_source.inv_mul(&truth()));
            nees += error.dot(&(fit.covariance.try_inverse().unwrap() * error)) / 6.0;
            chi += fit.chi_squared / fit.degrees_of_freedom;
            let off = |at: &Isometry3<f64>| {
                (at.transform_point(&far.into()) - truth().transform_point(&far.into()))
                    .norm_squared()
            };
            ours += off(&fit.target_from_source);
            let at = |points: &[MeasuredPoint]| points.iter().map(|p| p.at).collect::<Vec<_>>();
            let plain = rigid_fit::rigid_fit(&at(&source), &at(&target)).unwrap();
            equal += off(&plain.target_from_source);
        }
        let runs = f64::from(runs);
        assert!((nees / runs - 1.0).abs() < 0.1, "{}", nees / runs);
        assert!((chi / runs - 1.0).abs() < 0.05, "{}", chi / runs);
        assert!(ours < 0.9 * equal, "{} {}", ours.sqrt(), equal.sqrt());
    }

    #[test]
    fn exact_points_give_the_truth() {
        let (source, _) = measured(&mut Random::new(7));
        let target: Vec<_> = source
            .iter()
            .map(|p| MeasuredPoint { at: truth().transform_point(&p.at.into()).coords, ..*p })
            .collect();
        let fit = measured_fit(&source, &target).unwrap();
        assert!(lie::log(&fit.target_from_source.inv_mul(&truth())).norm() < 1e-12);
        assert!(fit.chi_squared < 1e-12 && fit.rms_m < 1e-12);
    }

    #[test]
    fn a_pair_without_any_variance_is_named() {
        let (mut source, mut target) = measured(&mut Random::new(8));
        source[2].covariance = Matrix3::zeros();
        target[2].covariance = Matrix3::zeros();
        let error = measured_fit(&source, &target).unwrap_err();
        assert!(error.to_string().contains("point pair 3"), "{error}");
    }
}
