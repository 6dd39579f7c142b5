//! What a cloud shows in which direction from its origin.
//!
//! A cloud that a camera saw, as it saw it, shows one thing in each direction: what is behind was hidden, and where
//! something else would be in front, it would have been seen. Most clouds of several scans, moved clouds and drawings
//! have things behind others, or to all sides. Not all: a sheet looks alike from above and from below, so that the
//! side from which it was seen is believed only where another scan shows the same.

use nalgebra::{Vector2, Vector3};

use super::patch::Patch;

/// No camera's directions are farther from the z axis than this, in multiples of the depth.
const WIDEST: f64 = 3.0;
/// Share of the windows that may be to other sides.
const STRAY: f64 = 0.005;
/// Share of the windows that may be behind others: of a camera's scan they are at the edges of things, and few.
const BEHIND: f64 = 0.015;
/// Behind another is what lies so many times the spread of a window below it.
const BELOW: f64 = 4.0;
/// Share of the windows that may be seen edge on.
const EDGE_ON: f64 = 0.1;
/// Below this square of the cosine a window is seen edge on.
const EDGE: f64 = 0.005;
/// No window.
const NOWHERE: u32 = u32::MAX;

/// For each direction the window nearest to the origin.
#[derive(Debug, Clone)]
pub(crate) struct Outlook {
    cells: Vec<u32>,
    low: Vector2<f64>,
    per_unit: f64,
    columns: usize,
}

impl Outlook {
    /// `None` of a cloud of which a camera at the origin would have seen less, or from other sides.
    pub fn of(patches: &[Option<Patch>], spread: f64) -> Option<Self> {
        let all = || patches.iter().flatten();
        let count = all().count() as f64;
        let is_in_view = |p: &&Patch| p.mean.z > 0.0 && direction(&p.mean).amax() < WIDEST;
        let in_view = || all().filter(is_in_view);
        let edge_on = all().filter(|p| p.facing() < EDGE).count() as f64;
        if edge_on > EDGE_ON * count || (in_view().count() as f64) < (1.0 - STRAY) * count {
            return None;
        }
        let [(left, width), (top, height)] = [0, 1].map(|axis| {
            let along = in_view().map(|p| direction(&p.mean)[axis]).collect();
            inner(along)
        });
        let low = Vector2::new(left, top);
        let per_unit = (count / (width * height)).sqrt();
        if !per_unit.is_finite() || count < 1.0 {
            return None;
        }
        let [columns, rows] = [width, height].map(|s| (s * per_unit) as usize + 1);
        if columns.checked_mul(rows).is_none_or(|cells| cells > 4 * patches.len() + 4) {
            return None;
        }
        let mut outlook = Self { cells: vec![NOWHERE; columns * rows], low, per_unit, columns };
        let depth = |k: u32| patches.get(k as usize)?.as_ref().map(|p| p.mean.z);
        for (k, patch) in patches.iter().enumerate() {
            let Some(patch) = patch.as_ref().filter(is_in_view) else { continue };
            let Some(at) = outlook.cell(&patch.mean) else { continue };
            if depth(outlook.cells[at]).is_none_or(|z| patch.mean.z < z) {
                outlook.cells[at] = k as u32;
            }
        }
        let is_behind = |p: &&Patch| {
            let first = outlook.find(&p.mean).and_then(|k| patches[k].as_ref());
            first.is_some_and(|first| {
                let toward = -first.mean.dot(&first.normal).signum();
                toward * first.normal.dot(&(p.mean - first.mean)) < -BELOW * spread
            })
        };
        let behind = in_view().filter(is_behind).count() as f64;
        (behind <= BEHIND * count).then_some(outlook)
    }

    /// The window that is first in the direction of a place.
    pub fn find(&self, p: &Vector3<f64>) -> Option<usize> {
        let k = self.cells[self.cell(p)?];
        (k != NOWHERE).then_some(k as usize)
    }

    fn cell(&self, p: &Vector3<f64>) -> Option<usize> {
        let at = (direction(p) - self.low) * self.per_unit;
        let rows = self.cells.len() / self.columns;
        let inside = p.z > 0.0
            && (0.0..self.columns as f64).contains(&at.x)
            && (0.0..rows as f64).contains(&at.y);
        inside.then(|| at.y as usize * self.columns + at.x as usize)
    }
}

/// Where almost all of some numbers begin, and how far they reach.
fn inner(mut all: Vec<f64>) -> (f64, f64) {
    if all.is_empty() {
        return (0.0, 0.0);
    }
    let beyond = (all.len() as f64 * STRAY) as usize;
    let last = all.len() - 1 - beyond;
    let low = *all.select_nth_unstable_by(beyond, f64::total_cmp).1;
    let high = *all.select_nth_unstable_by(last, f64::total_cmp).1;
    (low, high - low)
}

fn direction(p: &Vector3<f64>) -> Vector2<f64> {
    p.xy() / p.z
}

#[cfg(test)]
mod tests {
    use crate::{Intrinsics, Scan, math::random::Random, register::Surface, simulate::Room};
    use nalgebra::Isometry3;

    fn cloud(points: impl Iterator<Item = [f32; 3]>) -> Surface {
        let points: Vec<[f32; 3]> = points.collect();
        Surface::of(&Scan::new(points.len(), 1, points).unwrap(), 1).unwrap()
    }

    #[test]
    fn what_a_camera_saw_is_told_from_what_was_moved_or_has_a_back() {
        let mut random = Random::new(2);
        let room = Room::of_a_cell(&mut random);
        let camera = Intrinsics::pinhole(240, 180, 240.0, 240.0, 119.5, 89.5);
        let pose = Isometry3::new([0.05, -0.1, 0.8].into(), [3.0, 0.1, 0.1].into());
        let scan = room.scan(&pose, &camera, 5e-4, &mut random);
        let seen: Vec<[f32; 3]> =
            scan.points().iter().filter(|p| p[2].is_finite()).copied().collect();
        let surface = cloud(seen.iter().copied());
        assert!(surface.has_a_front());
        let beside = |p: &[f32; 3]| [p[0] + 1.0, p[1], p[2]];
        assert!(!cloud(seen.iter().map(beside)).has_a_front());
        let ball = |k: i32| {
            let (z, turn) = (f64::from(k) / 10_000.0 - 1.0, 2.4 * f64::from(k));
            let r = (1.0 - z * z).sqrt();
            [r * turn.cos(), r * turn.sin(), z + 8.0].map(|x| (0.1 * x) as f32)
        };
        assert!(!cloud((0..20_000).map(ball)).has_a_front());
    }
}
