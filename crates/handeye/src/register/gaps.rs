//! How far points lie from a surface that was scanned.
//!
//! The distance is taken along the normal of the plane through the target's points around the nearest
//! one: the distance from the point itself would never be less than half the spacing of the scan. Beside
//! the rim of a scan such a plane goes on where nothing was seen; a point there has no counterpart.

use nalgebra::{Isometry3, Vector3};

use super::{
    kd_tree::KdTree,
    patch::{Patch, Sums},
};
use crate::math::parallel;

/// Points through which a plane is laid.
const AROUND: usize = 16;
/// Variance across over that along, above which points are no plane.
const FLAT: f64 = 0.1;
/// Sideways a counterpart may be so many times as far as the farthest point of its plane.
const BESIDE: f64 = 1.5;
/// Points that are taken at a time.
const CHUNK: usize = 4096;

/// A scanned surface from which distances are taken.
pub struct Reference<'a> {
    points: &'a [[f32; 3]],
    tree: KdTree,
}

impl<'a> Reference<'a> {
    /// Points that are not finite are left out.
    pub fn new(points: &'a [[f32; 3]]) -> Self {
        Self { points, tree: KdTree::new(points) }
    }

    /// Distances of moved points from the surface, m; NaN where it shows nothing within `within_m`. They are
    /// the same with any number of threads.
    pub fn gaps(
        &self,
        points: &[[f32; 3]],
        target_from_source: &Isometry3<f64>,
        within_m: f64,
        threads: usize,
    ) -> Vec<f32> {
        let gap = |p: &[f32; 3]| {
            let moved = target_from_source * nalgebra::Point3::from(p.map(f64::from));
            self.gap(&moved.coords, within_m).map_or(f32::NAN, |gap| gap as f32)
        };
        let chunk = |k: usize| -> Vec<f32> {
            points[k * CHUNK..points.len().min((k + 1) * CHUNK)].iter().map(gap).collect()
        };
        parallel::in_order(points.len().div_ceil(CHUNK), threads, chunk).concat()
    }

    fn gap(&self, p: &Vector3<f64>, within: f64) -> Option<f64> {
        let nearest = self.tree.nearest(&p.map(|x| x as f32).into(), within as f32)?;
        let at = self.points[nearest.index as usize];
        let off = p - Vector3::from(at.map(f64::from));
        let around = self.tree.nearest_many(&at, AROUND, within as f32);
        let reach = around.last().map_or(0.0, |last| f64::from(last.squared).sqrt());
        let mut sums = Sums::default();
        for near in &around {
            let [x, y, z] = self.points[near.index as usize];
            sums.add([x - at[0], y - at[1], z - at[2]].map(f64::from));
        }
        match Patch::of(&sums).filter(|plane| plane.across <= FLAT * plane.along) {
            None => Some(off.norm()),
            Some(plane) => {
                let beside = off - plane.normal * off.dot(&plane.normal);
                let across = (off - plane.mean).dot(&plane.normal).abs();
                (beside.norm() <= BESIDE * reach).then_some(across)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plate of 100 x 60 mm at z = 0.5 m, a point each millimetre.
    fn plate() -> Vec<[f32; 3]> {
        (0..6000).map(|k| [(k % 100) as f32 * 1e-3, (k / 100) as f32 * 1e-3, 0.5]).collect()
    }

    fn shifted(x: f64, y: f64, z: f64) -> Isometry3<f64> {
        Isometry3::translation(x, y, z)
    }

    #[test]
    fn points_off_by_a_known_shift_are_off_by_that() {
        let plate = plate();
        let reference = Reference::new(&plate);
        for shift in [0.0, 2e-4, 3e-3, -1e-2] {
            let gaps = reference.gaps(&plate, &shifted(0.0, 0.0, shift), 0.05, 1);
            assert!(gaps.iter().all(|g| (f64::from(*g) - shift.abs()).abs() < 1e-6), "{shift}");
        }
    }

    #[test]
    fn a_shift_along_the_surface_is_no_distance_and_beyond_its_rim_nothing_is() {
        let plate = plate();
        let reference = Reference::new(&plate);
        let gaps = reference.gaps(&plate, &shifted(0.0203, 0.0, 0.0), 0.05, 1);
        let beyond = |k: usize| k % 100 > 85;
        for (k, gap) in gaps.iter().enumerate().filter(|(k, _)| k % 100 < 79 || beyond(*k)) {
            assert!(if beyond(k) { gap.is_nan() } else { *gap < 1e-6 }, "{k} {gap}");
        }
        let gaps = reference.gaps(&plate, &shifted(0.0, 0.0, 0.06), 0.05, 1);
        assert!(gaps.iter().all(|gap| gap.is_nan()));
    }

    #[test]
    fn distances_do_not_depend_on_the_number_of_threads() {
        let plate = plate();
        let reference = Reference::new(&plate);
        let with = |threads| {
            let gaps = reference.gaps(&plate, &shifted(0.01, 0.0, 1e-3), 0.05, threads);
            gaps.iter().map(|gap| gap.to_bits()).collect::<Vec<u32>>()
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn of_a_line_and_of_nothing_distances_are_those_of_points() {
        let line: Vec<[f32; 3]> = (0..50).map(|k| [k as f32 * 1e-3, 0.0, 0.0]).collect();
        let gaps =
            Reference::new(&line).gaps(&[[0.01, 3e-3, 4e-3]], &Isometry3::identity(), 0.05, 1);
        assert!((gaps[0] - 5e-3).abs() < 1e-6);
        let nothing = Reference::new(&[[f32::NAN; 3]]);
        assert!(nothing.gaps(&[[0.0; 3]], &Isometry3::identity(), 1.0, 1)[0].is_nan());
    }
}
