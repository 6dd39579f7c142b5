//! Starts without one: pairs of windows that lie to each other alike in both scans.
//!
//! Two windows whose normals differ say where a rigid body is: the normals how it is turned, the middle
//! between them where. How far they are apart, and the three angles between both normals and the line that
//! joins them, are the same from everywhere, so pairs that may be the same are found by these four numbers.
//! What each of them proposes is scored by how much of the source comes to lie on the target. Most of a cell
//! is table, which says little: windows are chosen such that every direction of normals has as many.
//!
//! B. Drost et al., *Model globally, match locally*, CVPR 2010; C. Papazov, D. Burschka, *An efficient RANSAC
//! for 3D object recognition in noisy and occluded scenes*, ACCV 2010.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::{kd_tree::KdTree, surface::Surface};
use crate::math::parallel;

/// Windows of the source, and of the target, of which pairs are made.
const PAIRED: (usize, usize) = (300, 500);
/// Windows of the source that score a proposal, the first of which decide whether the others are asked.
const SCORING: (usize, usize) = (32, 160);
/// Windows of the target on which they may come to lie.
const LAID_ON: usize = 12000;
/// Cells of directions of normals along an axis from its origin.
const CELLS: f64 = 2.5;
/// Pairs are no farther apart than this share of the source's radius, ...
const LONGEST: f64 = 0.8;
/// ... and no nearer than this share of that.
const SHORTEST: f64 = 0.15;
/// Steps in which the longest distance is counted.
const LENGTHS: f64 = 20.0;
/// Angles are counted in steps of 12 degrees.
const ANGLE: f64 = 0.21;
/// Normals of a pair differ by 25 degrees or more.
const ALIKE: f64 = 0.906;
/// Lines that join a pair agree within 15 degrees once their normals do.
const JOINED: f64 = 0.966;
/// Normals of a window and that on which it lies agree within 25 degrees.
const FLUSH: f64 = 0.906;
/// Windows lie on one another within this share of the source's radius.
const NEAR: f64 = 0.05;
/// Proposals whose first windows score less than this share of what they could are dropped.
const HOPELESS: f64 = 0.125;
/// Proposals that are scored.
const PROPOSED: usize = 40_000;
/// Pairs with more counterparts than this say little.
const COMMON: usize = 80;
/// Starts.
const STARTS: usize = 32;
/// Starts differ by more than this share of the source's radius.
const APART: f64 = 0.08;

/// A window's place and normal.
#[derive(Clone, Copy)]
struct Place {
    p: Vector3<f64>,
    n: Vector3<f64>,
}

/// What stays when both windows of a pair move together.
type Key = [u8; 4];

/// Where the source may be, the most promising first.
pub fn starts(source: &Surface, target: &Surface, threads: usize) -> Vec<Isometry3<f64>> {
    let both_face = source.is_facing && target.is_facing;
    let radius = source.radius();
    let chosen = (choose(source, PAIRED.0), choose(target, PAIRED.1));
    let pairs = |places: &[Place]| pairs(places, LONGEST * radius, both_face);
    let (from, to) = (pairs(&chosen.0), pairs(&chosen.1));
    let matches = matches(&from, &to);
    let scorer = Scorer::new(source, target, NEAR * radius, both_face);
    let chunk = matches.len().div_ceil(64).max(1);
    let parts = parallel::in_order(matches.len().div_ceil(chunk), threads, |k| {
        let range = chunk * k..matches.len().min(chunk * (k + 1));
        let mut scored = vec![];
        for &(a, b) in &matches[range] {
            let pair = |places: &[Place], [i, j]: [u16; 2]| {
                [places[usize::from(i)], places[usize::from(j)]]
            };
            let proposed = proposals(&pair(&chosen.0, a), &pair(&chosen.1, b), both_face);
            scored.extend(proposed.into_iter().filter_map(|at| Some((scorer.score(&at)?, at))));
        }
        scored
    });
    let mut scored = parts.concat();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut starts: Vec<Isometry3<f64>> = vec![];
    for (_, at) in scored {
        if starts.iter().all(|s| source.moved(s, &at) > APART * radius) {
            starts.push(at);
        }
        if starts.len() == STARTS {
            break;
        }
    }
    starts
}

/// About so many windows, of every direction as many, as far as there are.
fn choose(surface: &Surface, count: usize) -> Vec<Place> {
    let mut groups: BTreeMap<[i8; 3], Vec<Place>> = BTreeMap::new();
    for patch in surface.patches.iter().flatten() {
        let n = patch.normal;
        let turned = if surface.is_facing { n } else { n * n[n.iamax()].signum() };
        let cell = turned.map(|x| (x * CELLS).round() as i8).into();
        groups.entry(cell).or_default().push(Place { p: patch.mean, n });
    }
    let most = share(groups.values().map(Vec::len).collect(), count);
    let even = |group: &Vec<Place>| {
        let taken = group.len().min(most);
        (0..taken).map(|k| group[k * group.len() / taken]).collect::<Vec<_>>()
    };
    groups.values().flat_map(even).collect()
}

/// The most that each group may give when all together give about so many.
fn share(mut sizes: Vec<usize>, count: usize) -> usize {
    sizes.sort_unstable();
    let mut left = count;
    for (k, size) in sizes.iter().enumerate() {
        let each = left / (sizes.len() - k);
        if *size >= each {
            return each.max(1);
        }
        left -= size;
    }
    usize::MAX
}

/// All pairs of windows, in the order of their keys.
fn pairs(places: &[Place], longest: f64, oriented: bool) -> Vec<(Key, [u16; 2])> {
    let mut pairs = vec![];
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places.iter().enumerate() {
            if let Some(key) = key(a, b, longest, oriented) {
                pairs.push((key, [i as u16, j as u16]));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

fn key(a: &Place, b: &Place, longest: f64, oriented: bool) -> Option<Key> {
    let line = b.p - a.p;
    let length = line.norm();
    let cosine = a.n.dot(&b.n);
    if !(SHORTEST * longest..longest).contains(&length) || cosine.abs() > ALIKE {
        return None;
    }
    let angle = |cosine: f64| {
        let cosine = if oriented { cosine } else { cosine.abs() };
        (cosine.clamp(-1.0, 1.0).acos() / ANGLE) as u8
    };
    let angles = [a.n.dot(&line) / length, b.n.dot(&line) / length, cosine].map(angle);
    Some([(LENGTHS * length / longest) as u8, angles[0], angles[1], angles[2]])
}

/// Pairs of both scans with the same key, of all kinds alike.
fn matches(from: &[(Key, [u16; 2])], to: &[(Key, [u16; 2])]) -> Vec<([u16; 2], [u16; 2])> {
    let mut kinds = vec![];
    for group in from.chunk_by(|a, b| a.0 == b.0) {
        let first = to.partition_point(|(key, _)| *key < group[0].0);
        let count = to[first..].partition_point(|(key, _)| *key == group[0].0);
        if (1..=COMMON).contains(&count) {
            kinds.push((group, &to[first..first + count]));
        }
    }
    // rarest first; of each kind so many pairs that all kinds have a say
    kinds.sort_by_key(|(group, others)| (group.len() * others.len(), group[0].0));
    let mut chosen = vec![];
    for (k, (group, others)) in kinds.iter().enumerate() {
        let each = (PROPOSED - chosen.len()) / (kinds.len() - k);
        let taken = (each / others.len()).clamp(1, group.len());
        for k in 0..taken {
            let pair = group[k * group.len() / taken].1;
            chosen.extend(others.iter().map(|other| (pair, other.1)));
        }
        if chosen.len() >= PROPOSED {
            break;
        }
    }
    chosen
}

/// Motions that bring a pair onto another: one, or with normals of unknown sides some of four.
fn proposals(from: &[Place; 2], to: &[Place; 2], oriented: bool) -> Vec<Isometry3<f64>> {
    let signs: &[[f64; 2]] = if oriented {
        &[[1.0, 1.0]]
    } else {
        &[[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
    };
    let line = |pair: &[Place; 2]| (pair[1].p - pair[0].p).normalize();
    let middle = |pair: &[Place; 2]| (pair[0].p + pair[1].p) * 0.5;
    let turned = |sign: &[f64; 2]| {
        let rotation = axes(&(from[0].n * sign[0]), &(from[1].n * sign[1]))?;
        let rotation = axes(&to[0].n, &to[1].n)? * rotation.transpose();
        let is_joined = (rotation * line(from)).dot(&line(to)) >= JOINED;
        let t = middle(to) - rotation * middle(from);
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        is_joined.then(|| Isometry3::from_parts(Translation3::from(t), rotation))
    };
    signs.iter().filter_map(turned).collect()
}

/// Axes along the sum, the difference and the cross product of two normals.
fn axes(a: &Vector3<f64>, b: &Vector3<f64>) -> Option<Matrix3<f64>> {
    let x = (a + b).try_normalize(1e-6)?;
    let y = (a - b).try_normalize(1e-6)?;
    Some(Matrix3::from_columns(&[x, y, x.cross(&y)]))
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// How much of the source comes to lie on the target.
struct Scorer {
    asked: Vec<Place>,
    laid_on: Vec<Place>,
    tree: KdTree,
    near: f64,
    oriented: bool,
}

impl Scorer {
    fn new(source: &Surface, target: &Surface, near: f64, oriented: bool) -> Self {
        // from all over the scan first
        let asked = choose(source, SCORING.1);
        let step = (1..).find(|step| step * 5 > 3 * asked.len() && gcd(*step, asked.len()) == 1);
        let step = step.unwrap_or(1);
        let asked = (0..asked.len()).map(|k| asked[k * step % asked.len()]).collect();
        let laid_on: Vec<Place> = target
            .every(target.stride(LAID_ON as f64))
            .into_iter()
            .filter_map(|k| target.patches[k as usize].as_ref())
            .map(|patch| Place { p: patch.mean, n: patch.normal })
            .collect();
        let places: Vec<[f32; 3]> =
            laid_on.iter().map(|place| place.p.map(|x| x as f32).into()).collect();
        Self { asked, laid_on, tree: KdTree::new(&places), near, oriented }
    }

    /// `None` of what is hopeless.
    fn score(&self, at: &Isometry3<f64>) -> Option<f64> {
        let (r, t) = (at.rotation.to_rotation_matrix().into_inner(), at.translation.vector);
        let one = |place: &Place| {
            let p = (r * place.p + t).map(|x| x as f32).into();
            let Some(found) = self.tree.nearest(&p, self.near as f32) else { return 0.0 };
            let cosine = (r * place.n).dot(&self.laid_on[found.index as usize].n);
            let cosine = if self.oriented { cosine } else { cosine.abs() };
            if cosine < FLUSH { 0.0 } else { 1.0 - f64::from(found.squared).sqrt() / self.near }
        };
        let first = self.asked.len().min(SCORING.0);
        let score: f64 = self.asked[..first].iter().map(one).sum();
        if score < HOPELESS * first as f64 {
            return None;
        }
        Some(score + self.asked[first..].iter().map(one).sum::<f64>())
    }
}
