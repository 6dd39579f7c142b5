//! How often noise is as large as what was measured, for any statistic: NaN and numbers without
//! bound have an answer as well.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, Gamma};

/// Median absolute value of a unit normal deviate.
pub(crate) const MAD: f64 = 0.6745;
/// Standard deviations of a normal deviate in its median absolute value.
pub(crate) const SIGMAS_OF_MAD: f64 = 1.4826;

/// Chance that an F-distributed statistic is as large or larger. What is no number tells nothing: 1.
pub(crate) fn of_f(value: f64, degrees: (f64, f64)) -> f64 {
    if value.is_nan() || !(degrees.0 + degrees.1).is_finite() {
        return 1.0;
    }
    // the sum that the distribution forms must be a number as well
    if !(value * degrees.0 + degrees.1).is_finite() {
        return if value > 0.0 { 0.0 } else { 1.0 };
    }
    FisherSnedecor::new(degrees.0, degrees.1).map_or(1.0, |law| law.sf(value))
}

/// The same for a chi-squared one.
pub(crate) fn of_chi_square(value: f64, degrees: usize) -> f64 {
    if value.is_nan() {
        return 1.0;
    }
    ChiSquared::new(degrees.max(1) as f64).map_or(1.0, |law| law.sf(value))
}

/// Chance that a variable with a gamma distribution of this mean and variance is at most `value`.
pub(crate) fn gamma_at_most(value: f64, mean: f64, variance: f64) -> f64 {
    let (shape, rate) = (mean * mean / variance, mean / variance);
    match Gamma::new(shape, rate) {
        Ok(law) if (value * rate).is_finite() => law.cdf(value),
        _ => f64::from(mean <= value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_statistic_has_a_chance() {
        for value in [0.0, 1.0, 1e200, 1e308, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let all = [of_f(value, (3.0, 5.0)), of_chi_square(value, 3)];
            assert!(all.iter().all(|p| (0.0..=1.0).contains(p)), "{value}: {all:?}");
            assert!((0.0..=1.0).contains(&gamma_at_most(value, 1.0, 1e-11)), "{value}");
        }
        assert_eq!(of_f(1.0, (3.0, f64::NAN)), 1.0);
        assert_eq!(of_f(1e308, (3.0, 5.0)), 0.0);
        // tables: 5 % at 7.815 for three degrees, at 5.409 for three over five
        assert!((of_chi_square(7.815, 3) - 0.05).abs() < 1e-4);
        assert!((of_f(5.409, (3.0, 5.0)) - 0.05).abs() < 1e-4);
    }
}
