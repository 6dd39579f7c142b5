//! Poses that bring two surfels of the scan onto two of the part.
//!
//! Two surfels whose normals differ say where a rigid body is: the normals how it is rotated, the middle
//! between them where. How far they are apart, and the three angles between both normals and the line that
//! joins them, are the same from everywhere, so pairs that may be the same are found by these four numbers.
//!
//! B. Drost et al., *Model globally, match locally*, CVPR 2010; C. Papazov, D. Burschka, *An efficient RANSAC
//! for 3D object recognition in noisy and occluded scenes*, ACCV 2010.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::shape::Surfel;

/// Pairs are no nearer than this share of the longest distance.
const SHORTEST: f64 = 0.12;
/// Steps in which the longest distance is counted.
const LENGTHS: f64 = 24.0;
/// Angles are counted in steps of 12 degrees.
const ANGLE: f64 = 0.21;
/// Normals of a pair differ by 25 degrees or more.
const ALIKE: f64 = 0.906;
/// Lines that join a pair agree within 11 degrees once their normals do.
const JOINED: f64 = 0.98;
/// Counterparts of a pair that are tried.
const TRIED: usize = 60;

/// What stays when both surfels of a pair move together.
type Key = [u8; 4];

/// Two pairs of surfels, by their numbers: of the scan, and of the part.
pub(crate) type Match = ([u16; 2], [u16; 2]);

/// All pairs of surfels that are no farther apart than this, m, in the order of their keys.
pub fn pairs(surfels: &[Surfel], longest: f64, oriented: bool) -> Vec<(Key, [u16; 2])> {
    let mut pairs = vec![];
    for (i, a) in surfels.iter().enumerate() {
        for (j, b) in surfels.iter().enumerate() {
            if let Some(key) = key(a, b, longest, oriented) {
                pairs.push((key, [i as u16, j as u16]));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

fn key(a: &Surfel, b: &Surfel, longest: f64, oriented: bool) -> Option<Key> {
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

/// Pairs of both with the same key, about so many, of all keys alike.
pub fn matches(scan: &[(Key, [u16; 2])], part: &[(Key, [u16; 2])], most: usize) -> Vec<Match> {
    let mut kinds = vec![];
    for group in scan.chunk_by(|a, b| a.0 == b.0) {
        let first = part.partition_point(|(key, _)| *key < group[0].0);
        let count = part[first..].partition_point(|(key, _)| *key == group[0].0);
        if count > 0 {
            kinds.push((group, &part[first..first + count]));
        }
    }
    // rarest first; of each kind so many pairs that all kinds have a say
    kinds.sort_by_key(|(group, others)| (group.len() * others.len().min(TRIED), group[0].0));
    let mut chosen = vec![];
    for (k, (group, others)) in kinds.iter().enumerate() {
        let each = most.saturating_sub(chosen.len()) / (kinds.len() - k);
        let tried = others.len().min(TRIED);
        let taken = (each / tried).clamp(1, group.len());
        for a in 0..taken {
            let pair = group[a * group.len() / taken].1;
            // others of them for each, where there are more
            let other = |b: usize| others[(b * others.len() / tried + a) % others.len()].1;
            chosen.extend((0..tried).map(|b| (pair, other(b))));
        }
        if chosen.len() >= most {
            break;
        }
    }
    chosen
}

/// Poses that bring a pair onto another: one, or with normals of unknown sides some of four.
pub fn poses(from: [Surfel; 2], to: [Surfel; 2], oriented: bool) -> Vec<Isometry3<f64>> {
    let signs: &[[f64; 2]] = if oriented {
        &[[1.0, 1.0]]
    } else {
        &[[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
    };
    let line = |pair: &[Surfel; 2]| (pair[1].p - pair[0].p).normalize();
    let middle = |pair: &[Surfel; 2]| (pair[0].p + pair[1].p) * 0.5;
    let rotated = |sign: &[f64; 2]| {
        let rotation = axes(&(from[0].n * sign[0]), &(from[1].n * sign[1]))?;
        let rotation = axes(&to[0].n, &to[1].n)? * rotation.transpose();
        let is_joined = (rotation * line(&from)).dot(&line(&to)) >= JOINED;
        let t = middle(&to) - rotation * middle(&from);
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        is_joined.then(|| Isometry3::from_parts(Translation3::from(t), rotation))
    };
    signs.iter().filter_map(rotated).collect()
}

/// Axes along the sum, the difference and the cross product of two normals.
fn axes(a: &Vector3<f64>, b: &Vector3<f64>) -> Option<Matrix3<f64>> {
    let x = (a + b).try_normalize(1e-6)?;
    let y = (a - b).try_normalize(1e-6)?;
    Some(Matrix3::from_columns(&[x, y, x.cross(&y)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        math::{lie, random::Random},
        register::search::shape::parts,
    };

    #[test]
    fn a_pair_that_was_moved_has_the_same_key_and_tells_the_motion() {
        let mut random = Random::new(7);
        for _ in 0..50 {
            let surfel = |random: &mut Random| Surfel {
                p: random.normal3() * 0.02,
                n: random.normal3().normalize(),
            };
            let pair = [surfel(&mut random), surfel(&mut random)];
            let truth = Isometry3::new(random.normal3(), random.normal3());
            let (r, t) = parts(&truth);
            let moved = pair.map(|s| s.moved(&r, &t));
            let Some(before) = key(&pair[0], &pair[1], 0.15, true) else { continue };
            let after = key(&moved[0], &moved[1], 0.15, true).unwrap();
            assert!(before.iter().zip(after).all(|(a, b)| a.abs_diff(b) <= 1));
            let found = poses(pair, moved, true);
            assert_eq!(found.len(), 1);
            let off = lie::log(&truth.inv_mul(&found[0]));
            assert!(off.norm() < 1e-6, "{off}");
        }
    }
}
