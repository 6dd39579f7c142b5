//! Do several calibrations of one cell agree?
//!
//! Each result is `Tᵢ = M exp(δᵢ)` with `δᵢ ~ N(0, Sᵢ)`. The mean `M` minimises
//! `Q = Σ ξᵢᵀ Sᵢ⁻¹ ξᵢ` with `ξᵢ = log(M⁻¹ Tᵢ)`; results that agree within their covariances have a
//! `Q` that follows chi-square with `6 (n - 1)` degrees of freedom. Where they do not, the results have errors of their
//! own beside those that they state: `Sᵢ + τ S̄` with `S̄` the mean of the `Sᵢ` and `τ` so large that `Q` is `6 (n - 1)`.
//! A result that states far too small an error counts for no more than the others then. Results that differ by less than
//! they state have errors in common (lens, target, the robot at these places), which their mean keeps: the share
//! `ρ = 1 - Q / (6 (n - 1))` of their variances is one error `e` of all, `Lᵢ e` in each with the root `Lᵢ Lᵢᵀ = Sᵢ`, and
//! with `C = (Σ Sᵢ⁻¹)⁻¹` the mean has `(1 - ρ) C + ρ A Aᵀ`, `A = C Σ Sᵢ⁻¹ Lᵢ`.
//!
//! T. Barfoot and P. Furgale, *Associating uncertainty with three-dimensional poses for use in
//! estimation problems*, IEEE T-RO 30(3), 2014; W. Cochran, *The combination of estimates from
//! different experiments*, Biometrics 10(1), 1954; R. Paule and J. Mandel, *Consensus values and weighting factors*,
//! Journal of Research of the National Bureau of Standards 87(5), 1982.

use nalgebra::{Matrix6, Vector3, Vector6};
use serde::Serialize;

use crate::{
    Camera, Error, Mount, Pose,
    math::{lie, linalg::invert_spd, statistics},
};

/// One result: the camera's pose, with its covariance if it has one (rotation first, in the camera
/// frame).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repetition {
    /// The answer.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// How sure it is.
    pub covariance: Option<Matrix6<f64>>,
}

/// The mean, and whether the results agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeat {
    /// Mean, weighted by the inverse covariances; unweighted where one is missing.
    pub mean: Pose<Mount, Camera>,
    /// Covariance of the mean: as the results state it, or larger where they spread more, or by less, which shows errors
    /// that they share; `None` where one states none.
    pub covariance: Option<Matrix6<f64>>,
    /// The test; `None` where a covariance is missing.
    pub agreement: Option<Agreement>,
    /// Which result it is without which the others agree, where all of them do not.
    pub odd_one_out: Option<usize>,
}

/// The chi-square test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Agreement {
    /// `Q`.
    pub chi_square: f64,
    /// `6 (n - 1)`.
    pub degrees_of_freedom: usize,
    /// How often results that agree differ by as much or more.
    pub p_value: f64,
}

impl Agreement {
    /// Whether they differ no more than by chance.
    pub fn is_given(&self) -> bool {
        self.p_value >= LEAST_CHANCE
    }

    /// Whether they differ by less than by chance: they have errors in common.
    pub fn is_of_shared_errors(&self) -> bool {
        self.p_value > 1.0 - LEAST_CHANCE
    }

    /// The share of their variances that they seem to have in common.
    fn shared(&self) -> f64 {
        (1.0 - self.chi_square / self.degrees_of_freedom as f64).max(0.0)
    }

    fn exceeds_its_expectation(&self) -> bool {
        self.chi_square > self.degrees_of_freedom as f64
    }
}

/// Scatter about the mean.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scatter {
    /// `sqrt(Σ d² / n)` of the distances `d` to the mean.
    pub rms: f64,
    /// Largest of them.
    pub max: f64,
    /// The same root along each axis.
    pub axes: [f64; 3],
    /// `sqrt(Σ d² / (n - 1))`: how far a single result is expected from the truth, as far as the
    /// results scatter at random.
    pub standard_deviation: f64,
}

/// Results that agree differ by chance alone; below this chance they do not agree.
pub(super) const LEAST_CHANCE: f64 = 0.01;
/// Fewest results of which one can be the odd one.
const FEWEST_FOR_ODD: usize = 3;
/// Halvings of the range in which the spread beside the stated errors lies.
const HALVINGS: usize = 40;
/// Rounds of Gauss-Newton; nearby poses need three.
const MOST_ROUNDS: usize = 50;
/// A step shorter than this (rad, m) ends it.
const SMALL_STEP: f64 = 1e-13;

/// The mean of some results, and whether they agree.
///
/// # Errors
/// Fewer than two results, and a covariance that is singular.
pub fn repeat(results: &[Repetition]) -> Result<Repeat, Error> {
    if results.len() < 2 {
        let advice = "calibrate the same cell again".into();
        return Err(Error::TooFewPoses { found: results.len(), needed: 2, advice });
    }
    let Some(covariances) = results.iter().map(|r| r.covariance).collect::<Option<Vec<_>>>() else {
        let (mean, _) = mean(results, &vec![Matrix6::identity(); results.len()])?;
        return Ok(Repeat { mean, covariance: None, agreement: None, odd_one_out: None });
    };
    let weights = covariances.iter().enumerate().map(|(k, s)| information(k, s));
    let weights = weights.collect::<Result<Vec<_>, _>>()?;
    let (plain, covariance) = mean(results, &weights)?;
    let test = agreement(results, &weights, &plain);
    let odd_one_out = if test.is_given() { None } else { odd_one_out(results, &weights) };
    let (mean, covariance) = match test.exceeds_its_expectation() {
        true => with_spread(results, &covariances)?,
        false => (plain, with_shared(&covariances, &covariance, test.shared())),
    };
    let (covariance, agreement) = (Some(covariance), Some(test));
    Ok(Repeat { mean, covariance, agreement, odd_one_out })
}

/// The covariance of the mean of results that have a share of their variances in common.
fn with_shared(all: &[Matrix6<f64>], independent: &Matrix6<f64>, share: f64) -> Matrix6<f64> {
    let weighted = |s: &Matrix6<f64>| {
        let root = s.cholesky()?.unpack();
        Some(root.try_inverse()?.transpose()) // S⁻¹ L
    };
    let sum: Option<Matrix6<f64>> =
        all.iter().map(weighted).try_fold(Matrix6::zeros(), |sum, w| Some(sum + w?));
    let Some(sum) = sum else { return *independent };
    let of_shared = independent * sum;
    independent * (1.0 - share) + of_shared * of_shared.transpose() * share
}

/// The mean of results that have errors beside the stated ones, as large as their spread says.
fn with_spread(
    results: &[Repetition],
    covariances: &[Matrix6<f64>],
) -> Result<(Pose<Mount, Camera>, Matrix6<f64>), Error> {
    let common = covariances.iter().sum::<Matrix6<f64>>() / covariances.len() as f64;
    let with = |more: f64| {
        let weights =
            covariances.iter().enumerate().map(|(k, s)| information(k, &(s + common * more)));
        let weights = weights.collect::<Result<Vec<_>, _>>()?;
        let found = mean(results, &weights)?;
        let spread = agreement(results, &weights, &found.0).exceeds_its_expectation();
        Ok::<_, Error>((found, spread))
    };
    let mut range = (0.0, 1.0);
    while with(range.1)?.1 {
        range = (range.1, 2.0 * range.1);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (range.0 + range.1);
        range = if with(middle)?.1 { (middle, range.1) } else { (range.0, middle) };
    }
    Ok(with(range.1)?.0)
}

/// The only one without which the others agree.
fn odd_one_out(results: &[Repetition], weights: &[Matrix6<f64>]) -> Option<usize> {
    if results.len() < FEWEST_FOR_ODD {
        return None;
    }
    let agree_without = |k: &usize| {
        let keep = |i: &usize| i != k;
        let others: Vec<Repetition> = (0..results.len()).filter(keep).map(|i| results[i]).collect();
        let weights: Vec<_> = (0..results.len()).filter(keep).map(|i| weights[i]).collect();
        mean(&others, &weights).is_ok_and(|(m, _)| agreement(&others, &weights, &m).is_given())
    };
    let mut found = (0..results.len()).filter(agree_without);
    found.next().filter(|_| found.next().is_none())
}

fn information(k: usize, covariance: &Matrix6<f64>) -> Result<Matrix6<f64>, Error> {
    invert_spd(covariance).ok_or_else(|| {
        Error::Invalid(format!(
            "the covariance of result {} is not positive definite; was it edited?",
            k + 1
        ))
    })
}

/// Gauss-Newton on SE(3): `log(exp(-d) M⁻¹ T) ≈ ξ - J_l⁻¹(ξ) d`.
fn mean(
    results: &[Repetition],
    weights: &[Matrix6<f64>],
) -> Result<(Pose<Mount, Camera>, Matrix6<f64>), Error> {
    let mut mean = results[0].mount_from_camera;
    let mut covariance = Matrix6::zeros();
    for _ in 0..MOST_ROUNDS {
        let (mut h, mut g) = (Matrix6::zeros(), Vector6::zeros());
        for (result, w) in results.iter().zip(weights) {
            let xi = mean.local(&result.mount_from_camera);
            let j = lie::left_jacobian_inverse(&xi);
            h += j.transpose() * w * j;
            g += j.transpose() * w * xi;
        }
        covariance = invert_spd(&h)
            .ok_or_else(|| Error::Invalid("the results leave their mean open".into()))?;
        let step = covariance * g;
        mean = mean.retract(&step);
        if step.norm() < SMALL_STEP {
            break;
        }
    }
    Ok((mean, covariance))
}

fn agreement(
    results: &[Repetition],
    weights: &[Matrix6<f64>],
    mean: &Pose<Mount, Camera>,
) -> Agreement {
    let one = |(r, w): (&Repetition, &Matrix6<f64>)| {
        let xi = mean.local(&r.mount_from_camera);
        xi.dot(&(w * xi))
    };
    let chi_square = results.iter().zip(weights).map(one).sum();
    let degrees_of_freedom = 6 * (results.len() - 1);
    let p_value = statistics::of_chi_square(chi_square, degrees_of_freedom);
    Agreement { chi_square, degrees_of_freedom, p_value }
}

/// Scatter, m, of where the results put a point of the camera; axes of the mount.
pub fn scatter_at(
    point_in_camera: &Vector3<f64>,
    results: &[Repetition],
    mean: &Pose<Mount, Camera>,
) -> Scatter {
    let at = |pose: &Pose<Mount, Camera>| pose.rotation() * point_in_camera + pose.translation();
    scatter(results.iter().map(|r| at(&r.mount_from_camera) - at(mean)))
}

/// Scatter of the orientation, rad; axes of the camera.
pub fn scatter_of_rotation(results: &[Repetition], mean: &Pose<Mount, Camera>) -> Scatter {
    scatter(results.iter().map(|r| lie::omega(&mean.local(&r.mount_from_camera))))
}

fn scatter(differences: impl Iterator<Item = Vector3<f64>>) -> Scatter {
    let all: Vec<Vector3<f64>> = differences.collect();
    let count = (all.len() as f64).max(1.0);
    let rms = |sum: f64| (sum / count).sqrt();
    let sum: f64 = all.iter().map(|d| d.norm_squared()).sum();
    Scatter {
        rms: rms(sum),
        max: all.iter().map(|d| d.norm()).fold(0.0, f64::max),
        axes: std::array::from_fn(|k| rms(all.iter().map(|d| d[k] * d[k]).sum())),
        standard_deviation: (sum / (count - 1.0).max(1.0)).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn truth() -> Pose<Mount, Camera> {
        Pose::identity().retract(&Vector6::new(0.7, -1.9, 0.4, 0.5, -0.2, 1.1))
    }

    /// Standard deviations per axis: 1 mrad and 0.5 mm, with a correlation between both.
    fn covariance() -> Matrix6<f64> {
        let mut l = Matrix6::from_diagonal(&Vector6::new(1e-3, 1e-3, 1e-3, 5e-4, 5e-4, 5e-4));
        l[(4, 0)] = 3e-4;
        l[(3, 1)] = -3e-4;
        l * l.transpose()
    }

    fn noisy(random: &mut Random, size: f64) -> Repetition {
        let root = covariance().cholesky().unwrap().unpack();
        let white = Vector6::from_fn(|_, _| random.normal());
        let pose = truth().retract(&(root * white * size));
        Repetition { mount_from_camera: pose, covariance: Some(covariance()) }
    }

    #[test]
    fn equal_results_agree_exactly_and_share_their_error() {
        let one = Repetition { mount_from_camera: truth(), covariance: Some(covariance()) };
        let repeat = repeat(&[one; 3]).unwrap();
        assert!(repeat.mean.local(&truth()).norm() < 1e-12);
        assert!((repeat.agreement.unwrap().p_value - 1.0).abs() < 1e-9);
        // three independent ones would differ: all of their error is shared, and stays in the mean
        let own = covariance();
        assert!((repeat.covariance.unwrap() - own).norm() < 1e-9 * own.norm());
    }

    #[test]
    fn honest_covariances_give_uniform_p_values() {
        let mut random = Random::new(3);
        let mut below = [0; 10];
        let cells = 1000;
        for _ in 0..cells {
            let results: Vec<_> = (0..4).map(|_| noisy(&mut random, 1.0)).collect();
            let p = repeat(&results).unwrap().agreement.unwrap().p_value;
            below[((p * 10.0) as usize).min(9)] += 1;
        }
        for count in below {
            assert!((f64::from(count) - 100.0).abs() < 40.0, "four sigma: {below:?}");
        }
    }

    #[test]
    fn results_three_times_as_scattered_as_they_say_disagree() {
        let mut random = Random::new(4);
        let results: Vec<_> = (0..4).map(|_| noisy(&mut random, 3.0)).collect();
        assert!(repeat(&results).unwrap().agreement.unwrap().p_value < 1e-6);
    }

    #[test]
    fn the_odd_one_out_is_named_where_the_others_agree() {
        let mut random = Random::new(6);
        let mut results: Vec<_> = (0..4).map(|_| noisy(&mut random, 1.0)).collect();
        assert_eq!(repeat(&results).unwrap().odd_one_out, None);
        let far =
            results[2].mount_from_camera.retract(&Vector6::new(0.0, 0.0, 0.0, 0.01, 0.0, 0.0));
        results[2].mount_from_camera = far;
        assert_eq!(repeat(&results).unwrap().odd_one_out, Some(2));
        // two against two, and two alone: nobody is
        results[1].mount_from_camera = far;
        assert_eq!(repeat(&results).unwrap().odd_one_out, None);
        assert_eq!(
            repeat(&results[1..2].iter().chain(&results[3..]).copied().collect::<Vec<_>>())
                .unwrap()
                .odd_one_out,
            None
        );
    }

    #[test]
    fn results_that_spread_more_than_they_say_make_the_mean_as_uncertain() {
        let mut random = Random::new(8);
        let (mut squares, cells) = (0.0, 400);
        for _ in 0..cells {
            let results: Vec<_> = (0..8).map(|_| noisy(&mut random, 3.0)).collect();
            let found = repeat(&results).unwrap();
            let d = truth().local(&found.mean);
            squares += d.dot(&(found.covariance.unwrap().try_inverse().unwrap() * d));
        }
        let mean = squares / (6.0 * f64::from(cells));
        assert!((0.9..1.2).contains(&mean), "{mean}");
    }

    #[test]
    fn errors_that_all_results_share_stay_in_their_mean() {
        let mut random = Random::new(10);
        let (mut squares, cells) = (0.0, 400);
        for _ in 0..cells {
            // nine tenths of the variance that each states is in all of them
            let shared = truth().local(&noisy(&mut random, 1.0).mount_from_camera) * 0.9f64.sqrt();
            let one = |random: &mut Random| {
                let own = truth().local(&noisy(random, 1.0).mount_from_camera) * 0.1f64.sqrt();
                let mount_from_camera = truth().retract(&(own + shared));
                Repetition { mount_from_camera, ..noisy(random, 1.0) }
            };
            let results: Vec<_> = (0..5).map(|_| one(&mut random)).collect();
            let found = repeat(&results).unwrap();
            assert!(found.agreement.unwrap().is_of_shared_errors());
            let d = truth().local(&found.mean);
            squares += d.dot(&(found.covariance.unwrap().try_inverse().unwrap() * d));
        }
        let mean = squares / (6.0 * f64::from(cells));
        assert!((0.85..1.15).contains(&mean), "{mean}");
    }

    #[test]
    fn a_rough_result_beside_a_fine_one_hardly_makes_the_mean_less_certain() {
        let fine = Repetition { mount_from_camera: truth(), covariance: Some(covariance()) };
        let rough = Repetition { covariance: Some(covariance() * 100.0), ..fine };
        let found = repeat(&[fine, rough]).unwrap().covariance.unwrap();
        // errors in common, of weights 100 to 1 and sizes 1 to 10
        let factor = (found.trace() / covariance().trace()).sqrt();
        assert!((factor - 110.0 / 101.0).abs() < 1e-6, "{factor}");
    }

    #[test]
    fn a_result_that_states_far_too_small_an_error_is_not_believed_alone() {
        let mut random = Random::new(9);
        let mut off = [0.0, 0.0];
        for _ in 0..100 {
            let mut results: Vec<_> = (0..6).map(|_| noisy(&mut random, 1.0)).collect();
            off[0] += truth().distance_to(&repeat(&results).unwrap().mean).powi(2);
            results[4].mount_from_camera = noisy(&mut random, 3.0).mount_from_camera;
            results[4].covariance = results[4].covariance.map(|s| s / 1e4);
            off[1] += truth().distance_to(&repeat(&results).unwrap().mean).powi(2);
        }
        // weighted as it says, it would be the answer: errors nine times as large, 54 times those of the mean of six
        assert!(off[1] < 10.0 * off[0], "{off:?}");
    }

    #[test]
    fn moving_the_mount_moves_the_mean_and_nothing_else() {
        let mut random = Random::new(5);
        let results: Vec<_> = (0..3).map(|_| noisy(&mut random, 1.0)).collect();
        let new_from_old =
            Pose::<Mount, Mount>::identity().retract(&Vector6::new(1.0, 0.2, -2.0, 3.0, 1.0, 0.0));
        let moved: Vec<_> = results
            .iter()
            .map(|r| Repetition { mount_from_camera: new_from_old * r.mount_from_camera, ..*r })
            .collect();
        let (a, b) = (repeat(&results).unwrap(), repeat(&moved).unwrap());
        assert!((new_from_old * a.mean).local(&b.mean).norm() < 1e-9);
        let (p, q) = (a.agreement.unwrap().p_value, b.agreement.unwrap().p_value);
        assert!((p - q).abs() < 1e-6);
    }

    #[test]
    fn without_covariances_there_is_a_mean_but_no_test() {
        let one = Repetition { mount_from_camera: truth(), covariance: None };
        let other =
            Repetition { mount_from_camera: truth().retract(&Vector6::repeat(2e-3)), ..one };
        let repeat = repeat(&[one, other]).unwrap();
        assert!((repeat.mean.local(&truth()) + Vector6::repeat(1e-3)).norm() < 1e-9);
        assert!(repeat.agreement.is_none() && repeat.covariance.is_none());
    }

    #[test]
    fn scatter_grows_with_the_lever_arm() {
        let turned = |a: f64| Repetition {
            mount_from_camera: truth().retract(&Vector6::new(a, 0.0, 0.0, 0.0, 0.0, 0.0)),
            covariance: None,
        };
        let results = [turned(1e-3), turned(-1e-3)];
        let far = Vector3::new(0.0, 0.0, 0.5);
        assert!(scatter_at(&Vector3::zeros(), &results, &truth()).rms < 1e-12);
        let at_far = scatter_at(&far, &results, &truth());
        assert!((at_far.rms - 0.5e-3).abs() < 1e-8, "no more than the largest");
        assert!((at_far.standard_deviation - 0.5e-3 * 2.0_f64.sqrt()).abs() < 1e-8);
        assert!((at_far.max - 0.5e-3).abs() < 1e-8);
        assert!((scatter_of_rotation(&results, &truth()).max - 1e-3).abs() < 1e-12);
    }
}
