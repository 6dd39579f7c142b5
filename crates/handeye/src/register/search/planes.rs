//! Planes that are too wide to be of the part: a table, a floor, the wall of a bin.
//!
//! Everything flat fits onto a table, so what lies on one says nothing of where the part is. But nothing
//! of the part is below it either.

use nalgebra::Vector3;

use super::shape::Surfel;

/// Surfels from which planes are proposed.
const PROPOSING: usize = 120;
/// Planes that are looked at, those with most surfels first.
const TRIED: usize = 5;
/// Most planes.
const MOST: usize = 3;
/// A plane's surfels agree within 14 degrees.
const ALIKE: f64 = 0.97;
/// A plane has at least this share of the scan.
const LARGE: f64 = 0.08;
/// A plane wider than so many times the part's diameter is none of its faces.
const WIDER: f64 = 1.08;
/// Share of a plane's surfels that may lie beyond each end of it, by outliers.
const BEYOND: f64 = 0.01;

/// `n · p = d`, the normal towards the side that is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane {
    pub n: Vector3<f64>,
    pub d: f64,
}

impl Plane {
    pub fn height(&self, p: &Vector3<f64>) -> f64 {
        self.n.dot(p) - self.d
    }

    fn holds(&self, s: &Surfel, within: f64) -> bool {
        self.height(&s.p).abs() < within && self.n.dot(&s.n).abs() > ALIKE
    }
}

/// Planes wider than the part, and the surfels that lie on none. Surfels lie on a plane within a distance, m. Where
/// normals point to the camera, they tell the upper side of a plane.
pub fn removed(
    surfels: &[Surfel],
    diameter: f64,
    within: f64,
    has_camera: bool,
) -> (Vec<Plane>, Vec<Surfel>) {
    let (mut planes, mut left) = (vec![], surfels.to_vec());
    while planes.len() < MOST {
        let Some(plane) = widest(&left, diameter, within, surfels.len()) else { break };
        left.retain(|s| plane.height(&s.p).abs() >= within);
        planes.push(plane);
    }
    // else, most of what stands on a plane is on its upper side
    for plane in planes.iter_mut().filter(|_| !has_camera) {
        let above = left.iter().filter(|s| plane.height(&s.p) > 0.0).count();
        if 2 * above < left.len() {
            *plane = Plane { n: -plane.n, d: -plane.d };
        }
    }
    (planes, left)
}

/// Of the planes with most surfels, the first that is wide.
fn widest(surfels: &[Surfel], diameter: f64, within: f64, all: usize) -> Option<Plane> {
    let step = (surfels.len() / PROPOSING).max(1);
    let proposed = surfels.iter().step_by(step).map(|s| Plane { n: s.n, d: s.n.dot(&s.p) });
    let held = |plane: &Plane| surfels.iter().filter(|s| plane.holds(s, 2.0 * within)).count();
    let mut counted: Vec<(usize, Plane)> = proposed.map(|plane| (held(&plane), plane)).collect();
    counted.sort_by_key(|found| std::cmp::Reverse(found.0));
    let mut tried: Vec<Plane> = vec![];
    for (_, proposed) in counted {
        let is_new =
            |t: &Plane| (t.d - proposed.d).abs() > 4.0 * within || t.n.dot(&proposed.n) < ALIKE;
        if tried.len() == TRIED || !tried.iter().all(is_new) {
            continue;
        }
        tried.push(proposed);
        if let Some(plane) = fitted(surfels, proposed, 2.0 * within)
            .and_then(|plane| fitted(surfels, plane, within))
            .filter(|plane| is_wide(surfels, plane, diameter, within, all))
        {
            return Some(plane);
        }
    }
    None
}

fn is_wide(surfels: &[Surfel], plane: &Plane, diameter: f64, within: f64, all: usize) -> bool {
    let on: Vec<&Surfel> = surfels.iter().filter(|s| plane.holds(s, within)).collect();
    on.len() as f64 > LARGE * all as f64 && extent(&on, &plane.n) > WIDER * diameter
}

/// The plane through the surfels on it.
fn fitted(surfels: &[Surfel], plane: Plane, within: f64) -> Option<Plane> {
    let on: Vec<&Surfel> = surfels.iter().filter(|s| plane.holds(s, within)).collect();
    let count = on.len() as f64;
    let mean = on.iter().map(|s| s.p).sum::<Vector3<f64>>() / count.max(1.0);
    let scatter =
        on.iter().map(|s| (s.p - mean) * (s.p - mean).transpose()).sum::<nalgebra::Matrix3<f64>>();
    let eigen = scatter.symmetric_eigen();
    let n = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into_owned();
    let n = if n.dot(&plane.n) < 0.0 { -n } else { n };
    (on.len() >= 3).then(|| Plane { n, d: n.dot(&mean) })
}

/// The longest distance across some surfels, along eight directions of a plane.
fn extent(on: &[&Surfel], n: &Vector3<f64>) -> f64 {
    let aside = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
    let other = n.cross(&aside);
    let along = |k: usize| {
        let angle = std::f64::consts::PI * k as f64 / 8.0;
        let direction = aside * angle.cos() + other * angle.sin();
        let mut all: Vec<f64> = on.iter().map(|s| direction.dot(&s.p)).collect();
        all.sort_by(f64::total_cmp);
        let beyond = (all.len() as f64 * BEYOND) as usize;
        all[all.len() - 1 - beyond] - all[beyond]
    };
    (0..8).map(along).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Surfels of a square of this side (m) at this height.
    fn square(side: f64, z: f64) -> impl Iterator<Item = Surfel> {
        (0..900).map(move |k| {
            let at = |n: usize| (n as f64 / 29.0 - 0.5) * side;
            Surfel { p: Vector3::new(at(k % 30), at(k / 30), z), n: -Vector3::z() }
        })
    }

    #[test]
    fn a_table_is_taken_away_and_the_top_of_the_part_stays() {
        // seen from below along z: the table is behind the part
        let all: Vec<Surfel> = square(0.5, 0.6).chain(square(0.1, 0.57)).collect();
        let (planes, left) = removed(&all, 0.15, 1e-3, true);
        assert_eq!((planes.len(), left.len()), (1, 900));
        assert!((planes[0].height(&left[0].p) - 0.03).abs() < 1e-9, "{planes:?}");
    }

    #[test]
    fn a_side_of_the_part_is_no_table() {
        let all: Vec<Surfel> = square(0.1, 0.57).collect();
        let (planes, left) = removed(&all, 0.15, 1e-3, true);
        assert_eq!((planes.len(), left.len()), (0, 900));
    }
}
