//! A surface as surfels that are evenly spread, for the search.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix3, Vector3};

use crate::register::surface::Surface;

/// Cells of directions of normals along an axis from its origin.
const CELLS: f64 = 2.5;

/// A surfel: where it lies, and the direction across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surfel {
    pub p: Vector3<f64>,
    pub n: Vector3<f64>,
}

impl Surfel {
    /// Moved by a rotation and a shift.
    #[inline(always)]
    pub fn moved(&self, r: &Matrix3<f64>, t: &Vector3<f64>) -> Self {
        Self { p: r * self.p + t, n: r * self.n }
    }
}

/// Rotation and shift of a pose.
pub fn parts(pose: &Isometry3<f64>) -> (Matrix3<f64>, Vector3<f64>) {
    (pose.rotation.to_rotation_matrix().into_inner(), pose.translation.vector)
}

/// All surfels of a surface.
pub(crate) fn surfels(surface: &Surface) -> Vec<Surfel> {
    let camera = surface.has_camera();
    let toward = |p: &Vector3<f64>, n: Vector3<f64>| if camera && n.dot(p) > 0.0 { -n } else { n };
    let of = |patch: &crate::register::patch::Patch| Surfel {
        p: patch.mean,
        n: toward(&patch.mean, patch.normal),
    };
    surface.patches.iter().flatten().map(of).collect()
}

/// One surfel of those in a cube of this edge that face one way, m.
pub fn thinned(surfels: &[Surfel], edge: f64) -> Vec<Surfel> {
    let mut kept: BTreeMap<([i32; 3], [i8; 3]), (f64, Surfel)> = BTreeMap::new();
    for surfel in surfels {
        let cell = surfel.p.map(|x| (x / edge).floor());
        let off = (surfel.p / edge - cell).add_scalar(-0.5).norm_squared();
        let key = (cell.map(|x| x as i32).into(), surfel.n.map(|x| x.round() as i8).into());
        let held = kept.entry(key).or_insert((off, *surfel));
        if off < held.0 {
            *held = (off, *surfel);
        }
    }
    kept.into_values().map(|(_, surfel)| surfel).collect()
}

/// About so many surfels, of every direction of normals as many, as far as there are.
pub(crate) fn balanced(surfels: &[Surfel], count: usize, oriented: bool) -> Vec<Surfel> {
    let mut groups: BTreeMap<[i8; 3], Vec<Surfel>> = BTreeMap::new();
    for surfel in surfels {
        let n = surfel.n;
        let rotated = if oriented { n } else { n * n[n.iamax()].signum() };
        groups.entry(rotated.map(|x| (x * CELLS).round() as i8).into()).or_default().push(*surfel);
    }
    let most = share(groups.values().map(Vec::len).collect(), count);
    groups.values().flat_map(|group| even(group, most)).collect()
}

/// So many, evenly from a list.
pub fn even<T: Copy>(all: &[T], count: usize) -> Vec<T> {
    let taken = all.len().min(count);
    (0..taken).map(|k| all[k * all.len() / taken]).collect()
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
