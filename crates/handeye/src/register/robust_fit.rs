//! Rigid transform between two point sets, some pairs of which are wrong.
//!
//! Many triples of pairs are fitted exactly; the one that leaves the least median residual is right
//! within the error of its points where at least half of the pairs are (Rousseeuw). From there, weights
//! that fall to zero beyond some standard deviations (Tukey's biweight) are used again and again.
//!
//! P. Rousseeuw, *Least median of squares regression*, JASA 79, 1984; J. Tukey's biweight as in P.
//! Huber and E. Ronchetti, *Robust Statistics*, 2nd ed. 2009.

use nalgebra::{Isometry3, Vector3};

use super::rigid_fit::{RigidFit, moments, rigid_fit, weighted_rigid_fit};
use crate::{
    Error,
    math::{linalg, random::Random},
};

/// With fewer pairs, all triples are tried.
const ALL_TRIPLES: usize = 20;
/// Else so many: with half of the pairs wrong, one in eight is right.
const TRIPLES: usize = 600;
/// Median residual length of a spatial normal error, in standard deviations of one axis.
const MEDIAN_LENGTH: f64 = 1.538;
/// Pairs beyond so many standard deviations of one axis do not count: of good ones, 0.1 %. Half the
/// weight is left at half of that.
const BEYOND: f64 = 6.0;
/// Most rounds of weights.
const MOST_ROUNDS: usize = 50;
/// Weights have settled when the fit's residuals change by less than this share.
const SETTLED: f64 = 1e-6;
/// No error of a point is smaller than this share of the set's size: rounding.
const LEAST_ERROR: f64 = 1e-12;

/// A registration that leaves wrong pairs out.
#[derive(Debug, Clone, PartialEq)]
pub struct RobustFit {
    /// Over the pairs that count, weighted.
    pub fit: RigidFit,
    /// Which pairs count at all.
    pub used: Vec<bool>,
}

/// Registers `source[i]` to `target[i]` (m); up to half of the pairs may be wrong.
///
/// # Errors
/// As [`rigid_fit()`]; [`Error::TooFewPoints`] also where less than four agree.
pub fn robust_fit(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> Result<RobustFit, Error> {
    let moments = moments(source, target, None)?;
    let least = LEAST_ERROR * (moments.p_squared() + moments.q_squared).sqrt();
    let mut at = best_triple(source, target)
        .map_or_else(|| rigid_fit(source, target).map(|fit| fit.target_from_source), Ok)?;
    let mut sigma = spread(&at, source, target).max(least);
    let mut found = weighted(&at, sigma, source, target)?;
    for _ in 0..MOST_ROUNDS {
        at = found.fit.target_from_source;
        // may fall, so that good pairs do not hide bad ones, and never rises
        sigma = sigma.min(spread(&at, source, target)).max(least);
        let next = weighted(&at, sigma, source, target)?;
        let change = (next.fit.rms_m - found.fit.rms_m).abs();
        found = next;
        if change <= SETTLED * found.fit.rms_m + least {
            break;
        }
    }
    Ok(found)
}

fn residuals<'a>(
    at: &Isometry3<f64>,
    source: &'a [Vector3<f64>],
    target: &'a [Vector3<f64>],
) -> impl Iterator<Item = f64> + 'a {
    let (r, t) = (at.rotation.to_rotation_matrix(), at.translation.vector);
    source.iter().zip(target).map(move |(p, q)| (r * p + t - q).norm())
}

/// Standard deviation of one axis, by the median. Of few pairs a fit makes the residuals small
/// (Rousseeuw and Leroy 1987).
fn spread(at: &Isometry3<f64>, source: &[Vector3<f64>], target: &[Vector3<f64>]) -> f64 {
    let few = 1.0 + 5.0 / (source.len() as f64 - 2.0);
    few * linalg::median(residuals(at, source, target)) / MEDIAN_LENGTH
}

fn best_triple(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> Option<Isometry3<f64>> {
    let fit = |triple: [usize; 3]| {
        let of = |points: &[Vector3<f64>]| triple.map(|k| points[k]);
        rigid_fit(&of(source), &of(target)).ok().map(|fit| fit.target_from_source)
    };
    let median = |at: &Isometry3<f64>| linalg::median(residuals(at, source, target));
    let judged = triples(source.len()).into_iter().filter_map(fit).map(|at| (median(&at), at));
    judged.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, at)| at)
}

fn triples(count: usize) -> Vec<[usize; 3]> {
    if count < ALL_TRIPLES {
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
        return pairs.flat_map(|(i, j)| (j + 1..count).map(move |k| [i, j, k])).collect();
    }
    let mut random = Random::new(count as u64);
    let mut any = || (random.unit() * count as f64) as usize;
    let all = std::iter::repeat_with(|| [any(), any(), any()]);
    all.filter(|[i, j, k]| i != j && j != k && i != k).take(TRIPLES).collect()
}

/// One round of Tukey's weights.
fn weighted(
    at: &Isometry3<f64>,
    sigma: f64,
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
) -> Result<RobustFit, Error> {
    let weight = |r: f64| (1.0 - (r / (BEYOND * sigma)).powi(2)).max(0.0).powi(2);
    let weights: Vec<f64> = residuals(at, source, target).map(weight).collect();
    let used: Vec<bool> = weights.iter().map(|w| *w > 0.0).collect();
    let kept = |k: &usize| used[*k];
    let of = |points: &[Vector3<f64>]| -> Vec<_> {
        (0..points.len()).filter(kept).map(|k| points[k]).collect()
    };
    let weights: Vec<f64> = weights.iter().copied().filter(|w| *w > 0.0).collect();
    if weights.len() < 4.min(source.len()) {
        return Err(Error::TooFewPoints { found: weights.len(), needed: 4 });
    }
    Ok(RobustFit { fit: weighted_rigid_fit(&of(source), &of(target), &weights)?, used })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lie;

    fn truth() -> Isometry3<f64> {
        Isometry3::new(Vector3::new(0.6, -0.2, 1.1), Vector3::new(2.0, 2.1, -0.3))
    }

    /// Pairs with an error of 0.3 mm; the first `wrong` ones are anywhere.
    fn pairs(
        random: &mut Random,
        count: usize,
        wrong: usize,
    ) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
        let pair = |k: usize| {
            let p =
                Vector3::new(0.4 * random.unit(), 0.3 * random.unit(), 1.0 + 0.1 * random.unit());
            let off = if k < wrong { 0.1 } else { 3e-4 };
            (p, truth().transform_point(&p.into()).coords + random.normal3() * off)
        };
        (0..count).map(pair).unzip()
    }

    #[test]
    fn wrong_pairs_are_left_out_and_the_others_kept() {
        let mut random = Random::new(9);
        for (count, wrong) in [(10, 3), (19, 8), (60, 25), (500, 230)] {
            for _ in 0..20 {
                let (source, target) = pairs(&mut random, count, wrong);
                let robust = robust_fit(&source, &target).unwrap();
                let good = rigid_fit(&source[wrong..], &target[wrong..]).unwrap();
                let off =
                    lie::log(&robust.fit.target_from_source.inv_mul(&good.target_from_source));
                let covariance = good.covariance.unwrap();
                let normalised = off.dot(&(covariance.try_inverse().unwrap() * off));
                assert!(normalised < 6.0, "{count} {wrong}: {normalised}");
                assert!(robust.used[..wrong].iter().filter(|u| **u).count() <= wrong / 50);
                let kept = robust.used[wrong..].iter().filter(|u| **u).count();
                assert!(kept as f64 > 0.9 * (count - wrong) as f64, "{count} {wrong}: {kept}");
            }
        }
    }

    #[test]
    fn without_wrong_pairs_little_is_lost() {
        let mut random = Random::new(10);
        let (mut robust, mut plain) = (0.0, 0.0);
        for _ in 0..200 {
            let (source, target) = pairs(&mut random, 12, 0);
            let off = |at: &Isometry3<f64>| {
                let p = Vector3::new(0.2, 0.15, 1.05).into();
                (at.transform_point(&p) - truth().transform_point(&p)).norm_squared()
            };
            robust += off(&robust_fit(&source, &target).unwrap().fit.target_from_source);
            plain += off(&rigid_fit(&source, &target).unwrap().target_from_source);
        }
        assert!(robust < 1.2 * plain, "{}", robust / plain);
    }

    #[test]
    fn exact_pairs_give_the_truth_beside_wrong_ones() {
        let mut random = Random::new(11);
        let (source, mut target) = pairs(&mut random, 30, 10);
        for (p, q) in source.iter().zip(&mut target).skip(10) {
            *q = truth().transform_point(&(*p).into()).coords;
        }
        let fit = robust_fit(&source, &target).unwrap().fit;
        assert!(lie::log(&fit.target_from_source.inv_mul(&truth())).norm() < 1e-9);
        assert!(fit.rms_m < 1e-9);
    }

    #[test]
    fn three_pairs_are_all_used() {
        let (source, target) = pairs(&mut Random::new(12), 3, 0);
        assert_eq!(robust_fit(&source, &target).unwrap().used, [true; 3]);
        assert!(robust_fit(&source[..2], &target[..2]).is_err());
    }
}
