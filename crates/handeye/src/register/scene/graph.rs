//! One adjustment over all pairs of scans.
//!
//! ```text
//! e_ij = log(B_ij⁻¹ T_j⁻¹ T_i)    de = Ad(T_i⁻¹) (ε_i - ε_j)    for T ← exp(ε) T, T = scene_from_camera
//! ```
//!
//! Each pair counts by its own covariance, less where it contradicts the others (Cauchy). Where the scene lies
//! is free: the covariance is that of the scans among each other (pseudo-inverse).

use nalgebra::{DMatrix, DVector, Isometry3, Matrix6, Vector6};

use crate::{
    math::{lie, linalg},
    register::Dense,
};

/// Most steps.
const MOST_STEPS: usize = 30;
/// The last step is shorter, rad and m.
const SETTLED: f64 = 1e-10;
/// Pairs whose squared error is as many times the usual one count half.
const HALF: f64 = 6.0;
/// The pair that errs most is out beyond so many times the usual error.
const OUT: f64 = 40.0;
/// Why a link is left out.
const CONTRADICTS: &str = "contradicts the other pairs";
/// Median of squares of six standard normal deviates.
const MEDIAN: f64 = 5.348;
/// A registration is no surer than this, rad and m: what its covariance does not know of.
const LEAST: f64 = 1e-6;

/// Where each scan lies: `camera_from_scene`, and its covariance (perturbed on the right), of those that hang
/// together; links that contradict the others are left out.
pub(crate) fn adjust(
    count: usize,
    links: &mut [Link],
) -> Vec<Option<(Isometry3<f64>, Matrix6<f64>)>> {
    for link in links.iter_mut().filter(|link| link.left_out.is_none()) {
        if information(link).is_none() {
            link.left_out = Some("its covariance cannot be inverted".into());
        }
    }
    // what was left out may have held scans in their places: all is laid out anew
    while let Some(adjusted) = adjusted(count, links) {
        let limit = OUT * adjusted.usual.max(MEDIAN);
        if let Some(k) = worst(&adjusted.placed, links, limit) {
            links[k].left_out = Some(CONTRADICTS.into());
        } else if let Some(k) = left_alone(links) {
            let why = "of two pairs that contradict each other it cannot be told which is right";
            links[k].left_out = Some(why.into());
        } else {
            leave_out_others(&adjusted.placed, links);
            return adjusted.poses();
        }
    }
    vec![None; count]
}

/// The link that errs most, if beyond a limit.
fn worst(placed: &[Option<Isometry3<f64>>], links: &[Link], limit: f64) -> Option<usize> {
    let counting = links.iter().enumerate().filter(|(_, link)| link.left_out.is_none());
    let errors = counting.filter_map(|(k, link)| Some((squared(placed, link)?, k)));
    let worst = errors.max_by(|a, b| a.0.total_cmp(&b.0));
    worst.filter(|(error, _)| *error > limit).map(|(_, k)| k)
}

/// A link that alone is left to hold a scan, of which another contradicted it.
fn left_alone(links: &[Link]) -> Option<usize> {
    let counts = |scan: usize| {
        links
            .iter()
            .filter(|l| l.left_out.is_none() && (l.source == scan || l.target == scan))
            .count()
    };
    let is_contradicted = |scan: usize| {
        let by = |l: &Link| l.left_out.as_deref() == Some(CONTRADICTS);
        links.iter().any(|l| by(l) && (l.source == scan || l.target == scan))
    };
    links.iter().position(|link| {
        let is_alone = |scan: usize| is_contradicted(scan) && counts(scan) == 1;
        link.left_out.is_none() && (is_alone(link.source) || is_alone(link.target))
    })
}

/// Links among scans that do not hang together with most.
fn leave_out_others(placed: &[Option<Isometry3<f64>>], links: &mut [Link]) {
    for link in links.iter_mut().filter(|link| link.left_out.is_none()) {
        if placed[link.source].is_none() {
            link.left_out = Some("hangs together with few of the others".into());
        }
    }
}

/// Scans in their places: `scene_from_camera`.
struct Adjusted {
    placed: Vec<Option<Isometry3<f64>>>,
    /// Which scans are placed.
    numbers: Vec<usize>,
    covariance: DMatrix<f64>,
    /// Of squared errors.
    usual: f64,
}

impl Adjusted {
    fn poses(&self) -> Vec<Option<(Isometry3<f64>, Matrix6<f64>)>> {
        let pose = |number: usize| {
            let k = self.numbers.binary_search(&number).ok()?;
            let own = self.covariance.fixed_view::<6, 6>(6 * k, 6 * k);
            let covariance = (own + own.transpose()) * (0.5 * (self.usual / MEDIAN).max(1.0));
            Some((self.placed[number]?.inverse(), covariance))
        };
        (0..self.placed.len()).map(pose).collect()
    }
}

/// Steps until all links that count agree as well as they can; `None` where none hang together.
fn adjusted(count: usize, links: &[Link]) -> Option<Adjusted> {
    let mut placed = spread(count, links)?;
    let numbers: Vec<usize> = (0..count).filter(|k| placed[*k].is_some()).collect();
    for _ in 0..MOST_STEPS {
        let (step, _) = step(&numbers, &placed, links)?;
        for (k, number) in numbers.iter().enumerate() {
            let own: Vector6<f64> = step.fixed_rows::<6>(6 * k).into_owned();
            placed[*number] = placed[*number].map(|t| lie::exp(&own) * t);
        }
        if step.amax() < SETTLED {
            break;
        }
    }
    let (_, covariance) = step(&numbers, &placed, links)?;
    let usual = usual(&placed, links);
    Some(Adjusted { placed, numbers, covariance, usual })
}

/// The largest set of scans that hang together, laid out along the links; that of the first is the scene's frame.
fn spread(count: usize, links: &[Link]) -> Option<Vec<Option<Isometry3<f64>>>> {
    let mut largest: Option<Vec<Option<Isometry3<f64>>>> = None;
    let size = |placed: &Vec<Option<Isometry3<f64>>>| placed.iter().flatten().count();
    let mut seen = vec![false; count];
    for first in 0..count {
        if seen[first] {
            continue;
        }
        let mut placed = vec![None; count];
        placed[first] = Some(Isometry3::identity());
        let mut queue = std::collections::VecDeque::from([first]);
        while let Some(at) = queue.pop_front() {
            seen[at] = true;
            let Some(here) = placed[at] else { continue };
            for link in links.iter().filter(|link| link.left_out.is_none()) {
                let (next, there) = match (link.source == at, link.target == at) {
                    (true, _) => (link.target, here * link.at().inverse()),
                    (_, true) => (link.source, here * link.at()),
                    _ => continue,
                };
                if placed[next].is_none() {
                    placed[next] = Some(there);
                    queue.push_back(next);
                }
            }
        }
        if size(&placed) > largest.as_ref().map_or(1, size) {
            largest = Some(placed);
        }
    }
    largest
}

fn error(placed: &[Option<Isometry3<f64>>], link: &Link) -> Option<(Vector6<f64>, Isometry3<f64>)> {
    let (i, j) = (placed[link.source]?, placed[link.target]?);
    Some((lie::log(&(link.at().inverse() * j.inv_mul(&i))), i))
}

fn information(link: &Link) -> Option<Matrix6<f64>> {
    let covariance = link.found.covariance?;
    linalg::invert_spd(&(covariance + Matrix6::identity() * (LEAST * LEAST)))
}

fn squared(placed: &[Option<Isometry3<f64>>], link: &Link) -> Option<f64> {
    let (error, _) = error(placed, link)?;
    Some(error.dot(&(information(link)? * error)))
}

/// Median of the squared errors of the links that count, as if there were as many more as there are unknowns.
fn usual(placed: &[Option<Isometry3<f64>>], links: &[Link]) -> f64 {
    let counted: Vec<f64> = links
        .iter()
        .filter(|link| link.left_out.is_none())
        .filter_map(|link| squared(placed, link))
        .collect();
    let unknown = placed.iter().flatten().count().saturating_sub(1) as f64;
    let left = (counted.len() as f64 - unknown).max(1.0) / counted.len().max(1) as f64;
    linalg::median(counted) / left
}

/// The step of all poses, and the pseudo-inverse of the normal equations.
fn step(
    numbers: &[usize],
    placed: &[Option<Isometry3<f64>>],
    links: &[Link],
) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let size = 6 * numbers.len();
    let row = |number: usize| numbers.binary_search(&number).ok().map(|k| 6 * k);
    let (mut normal, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
    let half = HALF * usual(placed, links).max(MEDIAN);
    for link in links.iter().filter(|link| link.left_out.is_none()) {
        let Some((error, at)) = error(placed, link) else { continue };
        let information = information(link)?;
        let weight = 1.0 / (1.0 + error.dot(&(information * error)) / half);
        let j = lie::adjoint(&at.inverse());
        let own = j.transpose() * information * j * weight;
        let pull = j.transpose() * information * error * weight;
        let (a, b) = (row(link.source)?, row(link.target)?);
        for (from, sign) in [(a, 1.0), (b, -1.0)] {
            let mut rows = right.fixed_rows_mut::<6>(from);
            rows -= pull * sign;
            for (to, other) in [(a, 1.0), (b, -1.0)] {
                let mut block = normal.fixed_view_mut::<6, 6>(from, to);
                block += own * (sign * other);
            }
        }
    }
    // the scene as a whole is free: hold it, and take what that feigns off again
    let hold = normal.trace() / size as f64;
    for a in 0..size {
        for b in (a % 6..size).step_by(6) {
            normal[(a, b)] += hold;
        }
    }
    let mut inverse = normal.cholesky()?.inverse();
    let feigned = 1.0 / (hold * (numbers.len() as f64).powi(2));
    for a in 0..size {
        for b in (a % 6..size).step_by(6) {
            inverse[(a, b)] -= feigned;
        }
    }
    Some((&inverse * right, inverse))
}

/// Two scans of the scene, and how the first lies in the second.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Which scan was moved.
    pub source: usize,
    /// Onto which.
    pub target: usize,
    /// Their registration.
    pub found: Dense,
    /// Why it does not count; `None` where it does.
    pub left_out: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Verdict,
        math::random::Random,
        register::{Dense, Stop},
    };

    fn some(random: &mut Random, scale: f64) -> Isometry3<f64> {
        let (w, v) = (random.normal3() * scale, random.normal3() * scale);
        lie::exp(&lie::tangent(&w, &v))
    }

    /// Scans in random places, linked as told, each link off by noise of 0.1 mm and 0.1 mrad.
    fn scene(pairs: &[(usize, usize)], count: usize) -> (Vec<Isometry3<f64>>, Vec<Link>) {
        let mut random = Random::new(8);
        let truth: Vec<_> = (0..count).map(|_| some(&mut random, 0.3)).collect();
        let link = |&(source, target): &(usize, usize)| {
            let at = truth[target].inv_mul(&truth[source]) * some(&mut random, 1e-4);
            let found = Dense {
                verdict: Verdict::Accepted,
                reasons: vec![],
                undetermined: vec![],
                target_from_source: at,
                covariance: Some(Matrix6::identity() * 1e-8),
                iterations: 1,
                stop: Stop::Converged,
                inlier_fraction: 1.0,
                size: None,
                agreement: 1.0,
                rms_m: 1e-4,
                sigma: 1.0,
                explained: None,
                places: vec![],
            };
            Link { source, target, found, left_out: None }
        };
        let links = pairs.iter().map(link).collect();
        (truth, links)
    }

    const RING: [(usize, usize); 8] =
        [(0, 1), (1, 2), (2, 3), (3, 4), (0, 4), (0, 2), (1, 3), (2, 4)];

    #[test]
    fn a_wrong_pair_is_left_out_and_moves_nothing() {
        let (truth, mut links) = scene(&RING, 5);
        let wrong = Isometry3::translation(0.05, 0.0, 0.0);
        links[3].found.target_from_source *= wrong;
        let found = adjust(5, &mut links);
        let out: Vec<usize> = (0..8).filter(|k| links[*k].left_out.is_some()).collect();
        assert_eq!(out, [3]);
        for i in 0..5 {
            let between = found[i].unwrap().0 * found[0].unwrap().0.inverse();
            let off = lie::log(&truth[i].inv_mul(&truth[0]).inv_mul(&between));
            assert!(off.amax() < 4e-4, "{off}");
        }
    }

    #[test]
    fn a_scan_that_is_held_by_contradictions_alone_has_no_place() {
        let pairs = [&RING[..], &[(0, 5), (1, 5)]].concat();
        let (_, mut links) = scene(&pairs, 6);
        for (k, shift) in [(8, 0.05), (9, -0.05)] {
            let wrong = Isometry3::translation(shift, 0.3 * shift, 0.0);
            links[k].found.target_from_source *= wrong;
            links[k].found.covariance = Some(Matrix6::identity() * 1e-10);
        }
        let found = adjust(6, &mut links);
        assert!(links[8].left_out.is_some() && links[9].left_out.is_some());
        assert!(found[5].is_none() && found[..5].iter().all(Option::is_some));
    }
}
