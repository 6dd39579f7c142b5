//! Where a scanned surface ends, as surfels of the wall that may begin there.
//!
//! A flat part seen from above shows one plane, which says nothing of where it lies. Its outline does: most parts
//! have walls at right angles to what they bound. A surfel with no neighbours to one side stands for a surfel
//! of such a wall, whose normal points to that side.

use nalgebra::Vector3;

use super::shape::Surfel;
use crate::register::kd_tree::KdTree;

/// Neighbours within so many times the distance of surfels.
const AROUND: f64 = 2.6;
/// Most neighbours.
const MOST: usize = 24;
/// Fewer neighbours are no surface.
const FEWEST: usize = 5;
/// A surface ends where it has no neighbours over this angle, rad.
const GAP: f64 = 2.3;
/// Neighbours lie on the same surface within this share of their distance.
const FLUSH: f64 = 0.35;

/// Surfels of walls at the ends of a surface whose surfels are so far apart, m.
pub(crate) fn walls(surfels: &[Surfel], apart: f64) -> Vec<Surfel> {
    let points: Vec<[f32; 3]> = surfels.iter().map(|s| s.p.map(|x| x as f32).into()).collect();
    let tree = KdTree::new(&points);
    let reach = AROUND * apart;
    let wall = |(k, s): (usize, &Surfel)| {
        let x = s.n.cross(&Vector3::ith(s.n.iamin(), 1.0)).normalize();
        let y = s.n.cross(&x);
        let near = tree.nearest_many(&points[k], MOST, reach as f32);
        let angle = |other: &Surfel| {
            let off = other.p - s.p;
            let is_flush = off.dot(&s.n).abs() < FLUSH * off.norm();
            is_flush.then(|| off.dot(&y).atan2(off.dot(&x)))
        };
        let mut angles: Vec<f64> = near
            .iter()
            .filter(|n| n.index as usize != k)
            .filter_map(|n| angle(&surfels[n.index as usize]))
            .collect();
        let toward = widest_gap(&mut angles)?;
        let n = x * toward.cos() + y * toward.sin();
        Some(Surfel { p: s.p + n * (0.5 * apart), n })
    };
    surfels.iter().enumerate().filter_map(wall).collect()
}

/// The middle of the widest gap between directions; `None` where it is no end.
fn widest_gap(angles: &mut [f64]) -> Option<f64> {
    if angles.len() < FEWEST {
        return None;
    }
    angles.sort_by(f64::total_cmp);
    let gap = |k: usize| {
        let next = angles.get(k + 1).copied().unwrap_or(angles[0] + std::f64::consts::TAU);
        (next - angles[k], 0.5 * (next + angles[k]))
    };
    let widest = (0..angles.len()).map(gap).max_by(|a, b| a.0.total_cmp(&b.0))?;
    (widest.0 > GAP).then_some(widest.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_of_a_plate_stands_for_walls_that_face_outwards() {
        let at = |k: usize| Vector3::new((k % 40) as f64 * 1e-3, (k / 40) as f64 * 1e-3, 0.5);
        let plate: Vec<Surfel> = (0..1200).map(|k| Surfel { p: at(k), n: -Vector3::z() }).collect();
        let walls = walls(&plate, 1e-3);
        assert!((120..=140).contains(&walls.len()), "{}", walls.len());
        let middle = Vector3::new(0.0195, 0.0145, 0.5);
        for wall in &walls {
            assert!(wall.n.z.abs() < 1e-9 && wall.n.dot(&(wall.p - middle)) > 0.0, "{wall:?}");
        }
        let straight = walls.iter().filter(|w| w.n.x.abs().max(w.n.y.abs()) > 0.99).count();
        assert!(straight > 100, "{straight}");
    }
}
