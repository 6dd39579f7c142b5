//! Wrong captures that hide one another.
//!
//! Several captures that are each a little wrong make the noise look larger than it is, and none of
//! them is an outlier any more. So the fit starts from the part of the captures that agrees best and
//! grows, always by the capture that fits next best, until the next one is an outlier, or all that are
//! still outside are one as a group. The best part
//! of good captures is better than all of them: their squared distances, six axes each, fall short by
//! `P(χ²₈ < q)/P(χ²₆ < q)`, with `q` where the part ends.
//!
//! A. Atkinson and M. Riani, *Robust Diagnostic Regression Analysis*, 2000 (forward search);
//! P. Rousseeuw and K. Van Driessen, *Computing LTS regression for large data sets*, 2006
//! (concentration).

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use crate::{Setup, calibrate::flow::limits::VERY_MANY, estimate::JointFit, solve::View};

/// Part of the captures that the search starts from.
const BEST_PART: f64 = 0.6;
/// Fewest captures to start from.
const FEWEST: usize = 6;
/// Chance below which each capture of a group that is improbable as a whole stays out with it.
const UNLIKELY: f64 = 1e-3;
/// Rounds in which that part settles.
const ROUNDS: usize = 6;
/// Steps in which the search grows, at most: of many captures it takes several at once.
const STEPS: usize = 30;
/// The same of very many: each of them says little of the noise, and larger steps do.
const STEPS_OF_MANY: usize = 8;

/// Those of `views` that are outliers to a fit of the others; `fit_of` fits a part of them, from a fit that is near.
pub(crate) fn masked(
    views: &[View],
    all: &JointFit,
    setup: Setup,
    fit_of: impl Fn(&[usize], &JointFit) -> JointFit,
) -> Vec<usize> {
    let start = (BEST_PART * views.len() as f64).ceil() as usize;
    if start < FEWEST {
        return vec![];
    }
    let mut inner = nearest(views, all, setup, start);
    let mut of_inner = fit_of(&inner, all);
    for _ in 1..ROUNDS {
        let next = nearest(views, &of_inner, setup, start);
        if next == inner {
            break;
        }
        inner = next;
        of_inner = fit_of(&inner, &of_inner);
    }
    let steps = if views.len() > VERY_MANY { STEPS_OF_MANY } else { STEPS };
    let step = (views.len() - start).div_ceil(steps).max(1);
    loop {
        let fitted = inner.len() as f64 / views.len() as f64;
        let dof = of_inner.degrees_of_freedom;
        let limit =
            |chance: f64, captures: usize| outlier_limit(chance, captures, dof) / shortfall(fitted);
        let outside = (0..views.len()).filter(|i| !inner.contains(i));
        let distances: Vec<(usize, f64)> = outside
            .filter_map(|i| Some((i, of_inner.squared_mahalanobis(&views[i], setup)?)))
            .collect();
        // where none of those outside is improbable, no part of them is
        if distances.iter().all(|s| s.1 < limit(UNLIKELY, 1)) {
            return vec![];
        }
        let next = distances.iter().map(|s| s.1).fold(f64::INFINITY, f64::min);
        let together = distances.iter().map(|s| s.1).sum::<f64>();
        let chance = IMPROBABLE / ways(views.len(), distances.len());
        let as_a_group = together > limit(chance, distances.len()) && next > limit(UNLIKELY, 1);
        if next > limit(IMPROBABLE, 1) || as_a_group {
            return distances.into_iter().map(|s| s.0).collect();
        }
        if inner.len() + step >= views.len() {
            return vec![];
        }
        inner = nearest(views, &of_inner, setup, inner.len() + step);
        of_inner = fit_of(&inner, &of_inner);
    }
}

/// In how many ways `part` of `count` captures can be picked.
fn ways(count: usize, part: usize) -> f64 {
    (0..part).map(|k| (count - k) as f64 / (part - k) as f64).product()
}

/// The `count` views with the smallest residual in units of the noise, in order.
fn nearest(views: &[View], fit: &JointFit, setup: Setup, count: usize) -> Vec<usize> {
    let distance = |v: &View| fit.distance(v, setup).unwrap_or(f64::INFINITY);
    let mut ranked: Vec<(f64, usize)> =
        views.iter().enumerate().map(|(i, v)| (distance(v), i)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.truncate(count);
    let mut nearest: Vec<usize> = ranked.into_iter().map(|(_, i)| i).collect();
    nearest.sort_unstable();
    nearest
}

/// Mean squared distance of the best part of good captures over that of all.
fn shortfall(part: f64) -> f64 {
    let (Ok(six), Ok(eight)) = (ChiSquared::new(6.0), ChiSquared::new(8.0)) else { return 1.0 };
    if part >= 1.0 { 1.0 } else { eight.cdf(six.inverse_cdf(part)) / part }
}

/// Chance of a capture as far off as it is below which it stays out.
pub(crate) const IMPROBABLE: f64 = 1e-5;

/// Squared distance, six axes a capture, that so many captures exceed with this chance where the
/// noise is estimated from so few equations.
pub(crate) fn outlier_limit(chance: f64, captures: usize, degrees_of_freedom: f64) -> f64 {
    let axes = 6.0 * captures as f64;
    FisherSnedecor::new(axes, degrees_of_freedom.max(1.0))
        .map_or(f64::INFINITY, |f| axes * f.inverse_cdf(1.0 - chance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_counted() {
        assert!((ways(14, 3) - 364.0).abs() < 1e-9);
        assert!((ways(5, 5) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_best_part_of_good_captures_is_better_than_all() {
        assert!((shortfall(1.0) - 1.0).abs() < 1e-12);
        let shares: Vec<f64> = (1..10).map(|k| shortfall(f64::from(k) / 10.0)).collect();
        assert!(shares.is_sorted() && shares[0] > 0.1 && shares[8] < 0.9, "{shares:?}");
        // by hand: the lower half of a chi-squared of six ends at 5.348
        assert!((shortfall(0.5) - 0.560).abs() < 5e-3, "{}", shortfall(0.5));
    }
}
