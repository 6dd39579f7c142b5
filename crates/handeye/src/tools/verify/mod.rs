//! The touch test: does the robot find the points that the camera measures?
//!
//! ```text
//! e_k = b_k - mean_over_sightings(M X c)        χ² = eᵀ Σ⁻¹ e
//! ```
//!
//! with `b_k` the touched tip in the base, `c` the point in the camera, `X = mount_from_camera` and
//! `M = base_from_mount`. `Σ` covers all touches together: the error of `X` is shared by all of
//! them, that of a board's pose by the touches of one board, that of a flange pose by what was seen
//! from it; the tip's own error is each touch's own. A calibration that is as good as it says has a
//! `χ²` of as many as there are coordinates.
//!
//! An offset `o` common to all touches is estimated with the same weights; `oᵀ(1ᵀΣ⁻¹1)o` is what it
//! takes off `χ²`, chi-square with 3 degrees of freedom where there is none. Of the share within a
//! tolerance, the lower bound is that of C. Clopper and E. Pearson, *The use of confidence or
//! fiducial limits*, Biometrika 26(4), 1934; lengths follow a gamma distribution matched by moments
//! (F. Satterthwaite, Biometrics Bulletin 2(6), 1946).

mod boards;

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector3};
use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF, Gamma};

use crate::{
    Base, Camera, Error, Mount, Point, Pose, Target,
    math::{linalg, statistics},
    register::rigid_fit::point_jacobian,
};
pub use boards::{add_boards, of_calibration, shared_flange};

/// How confident the bounds are.
pub const CONFIDENCE: f64 = 0.95;
/// Share of the touches that must lie within the tolerance.
pub const SHARE: f64 = 0.95;
/// Chance below which the touches contradict what the calibration says of itself.
pub const LEAST_CHANCE: f64 = 0.01;

/// How a point moves (m, in the base) with one pose (rotation first, perturbed on the right).
pub type ByPose = SMatrix<f64, 3, 6>;

/// One look at a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Sighting {
    /// Where the mount was: the flange pose, or the identity for a camera on the base.
    pub base_from_mount: Pose<Base, Mount>,
    /// The point as the camera measured it.
    pub in_camera: Point<Camera>,
    /// Covariance (m²) of that measurement alone.
    pub covariance: Matrix3<f64>,
    /// Poses of [`Test::poses`] whose errors it shares with others, by number.
    pub shared: Vec<(usize, ByPose)>,
}

/// A point that was seen, once or several times, and touched.
#[derive(Debug, Clone, PartialEq)]
pub struct Touched {
    /// Its name.
    pub id: String,
    /// Where the tip was.
    pub in_base: Point<Base>,
    /// How it was seen; the prediction is the mean of them.
    pub sightings: Vec<Sighting>,
}

/// What is tested, and with what.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// The transform under test.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// Its covariance (in the camera frame); `None` where it states none.
    pub covariance: Option<Matrix6<f64>>,
    /// Covariances of other poses whose errors several sightings share.
    pub poses: Vec<Matrix6<f64>>,
    /// Standard deviation of a touch, m, each axis.
    pub touch_sigma: f64,
    /// The touches.
    pub touches: Vec<Touched>,
}

/// How a corner of a board moves with the board's pose.
pub fn by_board(
    base_from_camera: &Pose<Base, Camera>,
    camera_from_target: &Pose<Camera, Target>,
    corner: &Point<Target>,
) -> ByPose {
    base_from_camera.rotation() * camera_from_target.rotation() * point_jacobian(&corner.vector())
}

/// How a point of the mount moves with the mount's pose.
pub fn by_mount(base_from_mount: &Pose<Base, Mount>, in_mount: &Point<Mount>) -> ByPose {
    base_from_mount.rotation() * point_jacobian(&in_mount.vector())
}

/// A chi-square test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ChiSquare {
    /// The sum of squares.
    pub chi_square: f64,
    /// What it is expected to be.
    pub degrees_of_freedom: usize,
    /// How often it is as large or larger by chance.
    pub p_value: f64,
}

impl ChiSquare {
    fn of(chi_square: f64, degrees_of_freedom: usize) -> Self {
        let p_value = statistics::of_chi_square(chi_square.max(0.0), degrees_of_freedom);
        Self { chi_square, degrees_of_freedom, p_value }
    }
}

/// A shift common to all touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Offset {
    /// Tip minus prediction, m, in the base.
    pub mean: Vector3<f64>,
    /// Standard deviation by what calibration and touches say of themselves, m.
    pub sigma: Vector3<f64>,
    /// Whether it is more than that.
    pub test: ChiSquare,
    /// Whether what is left without it agrees; `None` with one touch.
    pub without: Option<ChiSquare>,
}

/// One touch against its prediction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Where the tip was expected.
    pub predicted: Point<Base>,
    /// Tip minus prediction, m, in the base.
    pub difference: Vector3<f64>,
    /// Root mean square length expected, m; `None` where the calibration states no covariance.
    pub expected: Option<f64>,
}

/// Touches within the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Within {
    /// How many.
    pub count: usize,
    /// Their share.
    pub share: f64,
    /// With 95 % confidence, at least this share of all points lies within.
    pub at_least: f64,
}

/// What the touches say.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// Every touch.
    pub differences: Vec<Difference>,
    /// Root mean square length of the differences, m.
    pub rms: f64,
    /// The largest, m.
    pub max: f64,
    /// With 95 % confidence, 95 of 100 points are off by less, m.
    pub p95_at_most: f64,
    /// All touches against the stated uncertainty; `None` where there is none.
    pub agreement: Option<ChiSquare>,
    /// The common shift; `None` likewise.
    pub offset: Option<Offset>,
}

impl Verification {
    /// How many lie within a tolerance (m).
    pub fn within(&self, tolerance: f64) -> Within {
        let all = self.differences.len();
        let count = self.differences.iter().filter(|d| d.difference.norm() <= tolerance).count();
        let share = count as f64 / all.max(1) as f64;
        Within { count, share, at_least: share_at_least(count, all) }
    }

    /// Whether a common shift, and nothing else, contradicts the calibration.
    pub fn is_shifted(&self) -> bool {
        let Some(offset) = &self.offset else { return false };
        offset.test.p_value < LEAST_CHANCE
            && offset.without.is_some_and(|w| w.p_value >= LEAST_CHANCE)
    }
}

/// Lower bound of Clopper and Pearson.
fn share_at_least(count: usize, all: usize) -> f64 {
    if count == 0 {
        return 0.0;
    }
    let law = Beta::new(count as f64, (all - count + 1) as f64);
    law.map_or(0.0, |b| b.inverse_cdf(1.0 - CONFIDENCE))
}

/// Tests a calibration on touches.
///
/// # Errors
/// [`Error::TooFewPoints`] without touches, [`Error::NotFinite`] on NaN, [`Error::Invalid`] when a
/// covariance is not positive or a touch was never seen.
pub fn verify(test: &Test) -> Result<Verification, Error> {
    check(test)?;
    let predicted: Vec<Point<Base>> = test.touches.iter().map(|t| prediction(test, t)).collect();
    let errors: Vec<Vector3<f64>> =
        test.touches.iter().zip(&predicted).map(|(t, p)| t.in_base.vector() - p.vector()).collect();
    let covariance = test.covariance.map(|s| stacked_covariance(test, &s));
    let expected = |k: usize| {
        covariance.as_ref().map(|c| c.view((3 * k, 3 * k), (3, 3)).trace().max(0.0).sqrt())
    };
    let differences = (0..errors.len())
        .map(|k| Difference {
            predicted: predicted[k],
            difference: errors[k],
            expected: expected(k),
        })
        .collect();
    let weighed = covariance.as_ref().map(|c| weigh(&errors, c)).transpose()?;
    let lengths = || errors.iter().map(|e| e.norm());
    Ok(Verification {
        differences,
        rms: (lengths().map(|l| l * l).sum::<f64>() / errors.len() as f64).sqrt(),
        max: lengths().fold(0.0, f64::max),
        p95_at_most: p95_at_most(&errors),
        agreement: weighed.map(|w| w.0),
        offset: weighed.map(|w| w.1),
    })
}

fn check(test: &Test) -> Result<(), Error> {
    if test.touches.is_empty() {
        return Err(Error::TooFewPoints { found: 0, needed: 1 });
    }
    let finite = |t: &Touched| {
        let seen = |s: &Sighting| {
            s.base_from_mount.is_finite() && s.in_camera.vector().iter().all(|x| x.is_finite())
        };
        t.in_base.vector().iter().all(|x| x.is_finite()) && t.sightings.iter().all(seen)
    };
    if let Some(bad) = test.touches.iter().find(|t| !finite(t)) {
        return Err(Error::NotFinite { what: format!("touch {}", bad.id) });
    }
    match test.touches.iter().find(|t| t.sightings.is_empty()) {
        Some(t) => Err(Error::Invalid(format!("the camera never saw what touch {} touched", t.id))),
        None if !(test.touch_sigma > 0.0) => {
            Err(Error::Invalid("the standard deviation of a touch must be positive".into()))
        }
        None => Ok(()),
    }
}

fn prediction(test: &Test, touched: &Touched) -> Point<Base> {
    let each = touched
        .sightings
        .iter()
        .map(|s| (s.base_from_mount * test.mount_from_camera * s.in_camera).vector());
    Point::from_vector(each.sum::<Vector3<f64>>() / touched.sightings.len() as f64)
}

/// How the prediction moves with the transform under test.
fn by_transform(test: &Test, sighting: &Sighting) -> ByPose {
    let rotation = (sighting.base_from_mount * test.mount_from_camera).rotation();
    rotation * point_jacobian(&sighting.in_camera.vector())
}

/// `Σ` of all touches.
fn stacked_covariance(test: &Test, of_transform: &Matrix6<f64>) -> DMatrix<f64> {
    let n = 3 * test.touches.len();
    let mut all = DMatrix::identity(n, n) * test.touch_sigma.powi(2);
    let sources = 1 + test.poses.len();
    let mut by: Vec<DMatrix<f64>> = vec![DMatrix::zeros(n, 6); sources];
    for (k, touched) in test.touches.iter().enumerate() {
        let share = 1.0 / touched.sightings.len() as f64;
        for s in &touched.sightings {
            let mut add = |source: usize, jacobian: &ByPose| {
                let mut rows = by[source].fixed_view_mut::<3, 6>(3 * k, 0);
                rows += jacobian * share;
            };
            add(0, &by_transform(test, s));
            s.shared.iter().for_each(|(source, jacobian)| add(1 + source, jacobian));
            let r = (s.base_from_mount * test.mount_from_camera).rotation();
            let mut own = all.fixed_view_mut::<3, 3>(3 * k, 3 * k);
            own += r * s.covariance * r.transpose() * share * share;
        }
    }
    for (by, covariance) in by.iter().zip(std::iter::once(of_transform).chain(&test.poses)) {
        all += by * covariance * by.transpose();
    }
    all
}

/// The test of all touches, and the shift they have in common.
fn weigh(errors: &[Vector3<f64>], covariance: &DMatrix<f64>) -> Result<(ChiSquare, Offset), Error> {
    let n = errors.len();
    let w = linalg::inverse_spd(covariance).ok_or_else(|| {
        Error::Invalid("the covariance of the calibration is not positive; was it edited?".into())
    })?;
    let e = DVector::from_iterator(3 * n, errors.iter().flat_map(|e| e.iter().copied()));
    let ones = DMatrix::from_fn(3 * n, 3, |i, j| f64::from(i % 3 == j));
    let information = ones.transpose() * &w * &ones;
    let information = Matrix3::from_column_slice(information.as_slice());
    let spread = linalg::invert_spd(&information)
        .ok_or_else(|| Error::Invalid("the touches leave their mean open".into()))?;
    let pull = ones.transpose() * (&w * &e);
    let pull = Vector3::from_column_slice(pull.as_slice());
    let mean = spread * pull;
    let chi_square = e.dot(&(&w * &e));
    let explained = mean.dot(&pull);
    let offset = Offset {
        mean,
        sigma: spread.diagonal().map(|v| v.max(0.0).sqrt()),
        test: ChiSquare::of(explained, 3),
        without: (n > 1).then(|| ChiSquare::of(chi_square - explained, 3 * n - 3)),
    };
    Ok((ChiSquare::of(chi_square, 3 * n), offset))
}

/// Length below which, with confidence, 95 of 100 differences are.
fn p95_at_most(errors: &[Vector3<f64>]) -> f64 {
    let moment: Matrix3<f64> = errors.iter().map(|e| e * e.transpose()).sum();
    let sum = moment.trace();
    if !(sum > 0.0) {
        return 0.0;
    }
    // 1 where all differences point the same way, 3 where they point every way
    let dimensions = (sum * sum / (moment * moment).trace()).clamp(1.0, 3.0);
    let quantile =
        |shape: f64, p: f64| Gamma::new(shape, 0.5).map_or(f64::NAN, |g| g.inverse_cdf(p));
    let low = quantile(0.5 * dimensions * errors.len() as f64, 1.0 - CONFIDENCE);
    (sum / low * quantile(0.5 * dimensions, SHARE)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Vector6;

    fn transform() -> Pose<Mount, Camera> {
        Pose::identity().retract(&Vector6::new(3.0, 0.1, -0.2, 0.6, 0.1, 1.3))
    }

    /// Standard deviations of the transform: rad, then m.
    const SIGMA: [f64; 2] = [5e-4, 4e-4];
    const TOUCH: f64 = 2e-4;

    fn covariance() -> Matrix6<f64> {
        let [r, t] = SIGMA.map(|s| s * s);
        Matrix6::from_diagonal(&Vector6::new(r, r, r, t, t, t))
    }

    /// Points half a metre around, touched by a robot that is off by as much as is said, and by
    /// `tip` (m).
    fn test(count: usize, tip: Vector3<f64>, random: &mut Random) -> Test {
        let off = Vector6::from_fn(|i, _| SIGMA[i / 3] * random.normal());
        let believed = transform().retract(&off);
        let one = |k: usize| {
            let in_camera: Point<Camera> = Point::from_vector(
                Vector3::new(0.0, 0.0, 0.9)
                    + random.normal3().component_mul(&Vector3::new(0.2, 0.2, 0.1)),
            );
            let there = (transform() * in_camera).vector() + random.normal3() * TOUCH + tip;
            Touched {
                id: k.to_string(),
                in_base: Point::from_vector(there),
                sightings: vec![Sighting {
                    base_from_mount: Pose::identity(),
                    in_camera,
                    covariance: Matrix3::zeros(),
                    shared: vec![],
                }],
            }
        };
        let touches = (0..count).map(one).collect();
        Test {
            mount_from_camera: believed,
            covariance: Some(covariance()),
            poses: vec![],
            touch_sigma: TOUCH,
            touches,
        }
    }

    #[test]
    fn chi_square_is_what_it_should_be_when_the_calibration_says_the_truth() {
        for count in [1, 4, 12] {
            let mut random = Random::new(count as u64);
            let (mut mean, mut low) = (0.0, 0);
            for _ in 0..400 {
                let found = verify(&test(count, Vector3::zeros(), &mut random)).unwrap();
                let agreement = found.agreement.unwrap();
                mean += agreement.chi_square / agreement.degrees_of_freedom as f64 / 400.0;
                low += usize::from(agreement.p_value < 0.05);
            }
            assert!((mean - 1.0).abs() < 0.12, "{count} touches: {mean}");
            assert!((5..40).contains(&low), "{count} touches: {low} of 400 below 5 %");
        }
    }

    #[test]
    fn a_wrong_tip_is_seen_as_a_shift() {
        let tip = Vector3::new(2e-3, -1e-3, 3e-3);
        let mut random = Random::new(3);
        let mut seen = 0;
        for _ in 0..100 {
            let found = verify(&test(8, tip, &mut random)).unwrap();
            let off = (found.offset.unwrap().mean - tip).norm();
            seen += usize::from(found.is_shifted() && off < 4e-3);
        }
        assert!(seen >= 95, "{seen} of 100");
    }

    #[test]
    fn a_wrong_rotation_is_no_shift_alone() {
        let mut wrong = test(8, Vector3::zeros(), &mut Random::new(4));
        wrong.mount_from_camera =
            wrong.mount_from_camera.retract(&Vector6::new(0.02, 0.0, 0.0, 0.0, 0.0, 0.0));
        let found = verify(&wrong).unwrap();
        assert!(found.agreement.unwrap().p_value < 1e-6 && !found.is_shifted());
    }

    #[test]
    fn few_touches_prove_little() {
        let found = verify(&test(12, Vector3::zeros(), &mut Random::new(5))).unwrap();
        let within = found.within(0.02);
        assert_eq!((within.count, within.share), (12, 1.0));
        // 0.05^(1/12)
        assert!((within.at_least - 0.7791).abs() < 1e-3, "{}", within.at_least);
        assert_eq!(found.within(0.0).at_least, 0.0);
    }

    /// The bound covers the true 95 % length in 95 of 100 tests.
    #[test]
    fn the_bound_on_the_error_holds() {
        let mut random = Random::new(6);
        let truth = 2.7955 * TOUCH;
        let mut holds = |_| {
            let errors: Vec<_> = (0..8).map(|_| random.normal3() * TOUCH).collect();
            p95_at_most(&errors) >= truth
        };
        let held = (0..400).filter(|k: &i32| holds(*k)).count();
        assert!(held >= 370, "{held} of 400");
    }

    #[test]
    fn a_touch_that_was_never_seen_is_refused() {
        let mut unseen = test(3, Vector3::zeros(), &mut Random::new(7));
        unseen.touches[1].sightings.clear();
        assert_eq!(
            verify(&unseen).unwrap_err().to_string(),
            "the camera never saw what touch 1 touched"
        );
    }
}
