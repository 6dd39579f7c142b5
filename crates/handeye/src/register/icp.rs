//! Iterative closest point, point to point.
//!
//! Repeats: match every source point, moved by the current transform, with its nearest target
//! point; drop matches farther than the gate; fit a rigid transform to the matches. The parameters
//! are those that PCL's users know.
//!
//! **What comes back is the whole transform**, the start included: do not multiply by the start
//! again. (A correction that was estimated on points already moved by the start does need it:
//! `T = T_corr * T_init`.)
//!
//! P. Besl and N. McKay, IEEE TPAMI 14(2), 1992.

use nalgebra::{Isometry3, Vector3};

use super::{RigidFit, kd_tree::KdTree, rigid_fit};
use crate::{Error, math::lie};

/// When to match and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IcpConfig {
    /// Most rounds.
    pub max_iterations: usize,
    /// Matches farther apart are dropped, m.
    pub max_correspondence_distance_m: f64,
    /// Stop when a round turns by less than this (rad) and shifts by less than this (m).
    pub transformation_epsilon: f64,
}

impl Default for IcpConfig {
    fn default() -> Self {
        Self {
            max_iterations: 50,
            max_correspondence_distance_m: 0.01,
            transformation_epsilon: 1e-9,
        }
    }
}

/// Why the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The transform no longer changes.
    Converged,
    /// The residuals no longer change.
    Fitness,
    /// Nothing was near enough.
    NoMatches,
    /// The rounds were used up.
    MaxIterations,
}

/// Result of an iteration.
#[derive(Debug, Clone, PartialEq)]
pub struct Icp {
    /// The whole transform, start included, with residuals over the last matches.
    pub fit: RigidFit,
    /// Rounds.
    pub iterations: usize,
    /// Why it ended.
    pub stop: Stop,
    /// Index of the match of each source point; `None` beyond the gate.
    pub matches: Vec<Option<usize>>,
}

/// Registers `source` to `target` from the start `target_from_source`.
///
/// # Errors
/// As [`rigid_fit`](super::rigid_fit()); also when fewer than three points find a match.
pub(crate) fn point_to_point(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    target_from_source: &Isometry3<f64>,
    config: &IcpConfig,
) -> Result<Icp, Error> {
    let places: Vec<[f32; 3]> = target.iter().map(|q| q.map(|x| x as f32).into()).collect();
    let tree = KdTree::new(&places);
    let mut at = *target_from_source;
    let mut stop = Stop::MaxIterations;
    let mut iterations = 0;
    let mut matches = nearest(source, &tree, &at, config);
    while iterations < config.max_iterations {
        iterations += 1;
        let (p, q) = matched(source, target, &matches);
        let next = rigid_fit(&p, &q)?.target_from_source;
        let change = lie::log(&at.inv_mul(&next)).amax();
        at = next;
        matches = nearest(source, &tree, &at, config);
        if change < config.transformation_epsilon {
            stop = Stop::Converged;
            break;
        }
    }
    let (p, q) = matched(source, target, &matches);
    if p.len() < 3 {
        return Err(Error::TooFewPoints { found: p.len(), needed: 3 });
    }
    let fit = rigid_fit(&p, &q)?;
    Ok(Icp { fit, iterations, stop, matches })
}

fn matched(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    matches: &[Option<usize>],
) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
    source.iter().zip(matches).filter_map(|(p, m)| m.map(|k| (*p, target[k]))).unzip()
}

/// Nearest target point of each moved source point.
fn nearest(
    source: &[Vector3<f64>],
    tree: &KdTree,
    at: &Isometry3<f64>,
    config: &IcpConfig,
) -> Vec<Option<usize>> {
    let gate = config.max_correspondence_distance_m as f32;
    let find = |p: &Vector3<f64>| {
        let p = at.transform_vector(p) + at.translation.vector;
        tree.nearest(&p.map(|x| x as f32).into(), gate).map(|found| found.index as usize)
    };
    source.iter().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<Vector3<f64>> {
        (0..54)
            .map(|i| Vector3::new(0.03 * f64::from(i % 9), 0.03 * f64::from(i / 9), 1.0))
            .collect()
    }

    fn apply(t: &Isometry3<f64>, points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        points.iter().map(|p| t.transform_vector(p) + t.translation.vector).collect()
    }

    fn truth() -> Isometry3<f64> {
        Isometry3::new(Vector3::new(0.6, -0.2, 1.1), Vector3::new(2.0, 2.1, -0.3))
    }

    fn start() -> Isometry3<f64> {
        truth() * lie::exp(&nalgebra::Vector6::new(0.004, -0.003, 0.005, 0.003, -0.002, 0.004))
    }

    /// Six touched corners, far apart.
    fn touched() -> Vec<Vector3<f64>> {
        [0, 8, 22, 31, 45, 53].iter().map(|&i| corners()[i]).collect()
    }

    fn rms(t: &Isometry3<f64>, from: &[Vector3<f64>], to: &[Vector3<f64>]) -> f64 {
        let moved = apply(t, from);
        let sum: f64 = moved.iter().zip(to).map(|(a, b)| (a - b).norm_squared()).sum();
        (sum / from.len() as f64).sqrt()
    }

    fn close(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
        lie::log(&a.inv_mul(b)).norm() < 1e-9
    }

    /// A run started from T_init returns the whole transform; times T_init it would be applied
    /// twice. Both ways of working give the same answer when composed rightly, and the residual
    /// unmasks the wrong composition.
    #[test]
    fn a_registration_with_a_start_already_contains_it() {
        let config = IcpConfig { max_correspondence_distance_m: 0.02, ..IcpConfig::default() };
        let (p, b) = (touched(), apply(&truth(), &touched()));
        let whole = point_to_point(&p, &b, &start(), &config).unwrap();
        let (result, reported) = (whole.fit.target_from_source, whole.fit.rms_m);
        assert!(close(&result, &truth()));
        assert!((rms(&result, &p, &b) - reported).abs() < 1e-12);
        assert!(rms(&(result * start()), &p, &b) > 0.1, "the start applied twice is far off");

        let already_moved = apply(&start(), &p);
        let correction =
            point_to_point(&already_moved, &b, &Isometry3::identity(), &config).unwrap();
        let composed = correction.fit.target_from_source * start();
        assert!(close(&composed, &result));
        let forgotten = correction.fit.target_from_source;
        assert!(rms(&forgotten, &p, &b) > 0.1, "a correction alone is not the answer");
    }

    #[test]
    fn with_known_correspondences_the_start_does_not_matter() {
        let (p, b) = (touched(), apply(&truth(), &touched()));
        let direct = rigid_fit(&p, &b).unwrap().target_from_source;
        for start in [start(), Isometry3::identity(), truth().inverse()] {
            let moved = apply(&start, &p);
            let correction = rigid_fit(&moved, &b).unwrap().target_from_source;
            assert!(close(&(correction * start), &direct));
        }
    }

    #[test]
    fn a_start_off_by_more_than_half_a_square_is_matched_wrongly() {
        let far = truth() * lie::exp(&nalgebra::Vector6::new(0.0, 0.0, 0.0, 0.024, 0.0, 0.0));
        let config = IcpConfig { max_correspondence_distance_m: 0.02, ..IcpConfig::default() };
        let icp = point_to_point(&touched(), &apply(&truth(), &corners()), &far, &config).unwrap();
        assert!(!close(&icp.fit.target_from_source, &truth()), "neighbours alias on a grid");
    }

    #[test]
    fn nothing_within_the_gate_is_an_error() {
        let config = IcpConfig { max_correspondence_distance_m: 1e-6, ..IcpConfig::default() };
        let error = point_to_point(&touched(), &apply(&truth(), &touched()), &start(), &config);
        assert!(matches!(error, Err(Error::TooFewPoints { .. })));
    }
}
