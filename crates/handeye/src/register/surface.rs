//! A scan as pieces of its surface, each a plane through the points of a small window.
//!
//! An organised scan is cut into blocks of pixels, a cloud in any order into cubes; a window is a block
//! and its neighbours. The block tells the place and the window the normal: on a curved surface the mean of
//! a window lies beside it, by nine times as much as that of a block. Windows across an edge in depth or a
//! crease are no planes, and are left out: their points scatter more than those of most others.

use nalgebra::Vector3;

use super::{
    grid_view::GridView,
    kd_tree::KdTree,
    patch::{Patch, Sums},
    voxels::Voxels,
};
use crate::{Scan, linalg};

/// Side of a block in a scan of 100 000 points, pixels; the square root of the points in a cube. It grows
/// with the fourth root of their number: half of finer pixels goes into finer windows, half into quieter ones.
const SIDE: f64 = 2.2;
/// A window must have this share of the points of nine blocks.
const FILLED: f64 = 0.6;
/// Scatter across a plane above this many times the usual one is no plane's.
const ROUGH: f64 = 3.0;
/// But where the scatter across is below this share of that along it, nothing is rough.
const FLAT: f64 = 1e-4;

/// A scan's windows that are planes.
pub struct Surface {
    /// Of an organised scan row by row, of a cloud one after the other.
    pub patches: Vec<Option<Patch>>,
    /// Of the mean of all of them, m.
    pub middle: Vector3<f64>,
    /// Whether normals point to the side from which the surface was seen.
    pub is_facing: bool,
    /// Windows along a row, of an organised scan.
    columns: Option<usize>,
    finder: Finder,
}

/// How windows near a place are found.
enum Finder {
    /// In the direction from the camera.
    Camera(GridView),
    /// The nearest, by its number.
    Nearest(KdTree),
}

impl Surface {
    /// `None` where nothing in the scan is a surface.
    pub fn of(scan: &Scan, threads: usize) -> Option<Self> {
        Self::of_grid(scan).or_else(|| Self::of_cloud(scan.points(), threads))
    }

    /// `None` where rows and columns are not those of a camera.
    fn of_grid(scan: &Scan) -> Option<Self> {
        if !scan.is_organised() {
            return None;
        }
        let side = (side(scan.points().len()) as usize).max(1);
        let size = (scan.width().div_ceil(side), scan.height().div_ceil(side));
        let (columns, rows) = size;
        let blocks = blocks(scan, side, columns, rows);
        let windows = windows(&blocks, columns, rows);
        let fewest = FILLED * (9 * side * side) as f64;
        let mut patches: Vec<Option<Patch>> = windows
            .iter()
            .zip(&blocks)
            .map(|(window, block)| {
                let patch =
                    Patch::of(window).filter(|_| window.count >= fewest && block.count > 0.0)?;
                let mean = Vector3::from(block.first) / block.count;
                Some(facing_camera(Patch { mean, held: block.count, ..patch }))
            })
            .collect();
        leave_out_rough(&mut patches);
        let finder = Finder::Camera(GridView::of(&patches, size)?);
        let middle = middle(&patches);
        Some(Self { patches, middle, is_facing: true, columns: Some(columns), finder })
    }

    fn of_cloud(points: &[[f32; 3]], threads: usize) -> Option<Self> {
        let held = side(points.len()).powi(2);
        let voxels = Voxels::of(points, held, threads)?;
        let mut patches = voxels.patches(FILLED * 9.0 * held, threads);
        leave_out_rough(&mut patches);
        patches.retain(Option::is_some);
        let means: Vec<[f32; 3]> =
            patches.iter().flatten().map(|p| p.mean.map(|x| x as f32).into()).collect();
        let finder = Finder::Nearest(KdTree::new(&means));
        let middle = middle(&patches);
        Some(Self { patches, middle, is_facing: false, columns: None, finder })
    }

    /// A window near a place, the nearest or that in the same direction.
    #[inline(always)]
    pub fn find(&self, p: &Vector3<f64>, within: f64) -> Option<&Patch> {
        match &self.finder {
            Finder::Camera(view) => view.find(&self.patches, p),
            Finder::Nearest(tree) => {
                let found = tree.nearest(&p.map(|x| x as f32).into(), within as f32)?;
                self.patches[found.index as usize].as_ref()
            }
        }
    }

    /// Whether a window is one of those in every so manieth row and column.
    #[inline(always)]
    pub fn is_in(&self, k: usize, stride: usize) -> bool {
        match self.columns {
            _ if stride == 1 => true,
            Some(columns) => {
                (k % columns).is_multiple_of(stride) && (k / columns).is_multiple_of(stride)
            }
            None => k.is_multiple_of(stride * stride),
        }
    }
}

fn side(points: usize) -> f64 {
    SIDE * (points as f64 / 1e5).powf(0.25)
}

fn middle(patches: &[Option<Patch>]) -> Vector3<f64> {
    let count = patches.iter().flatten().count() as f64;
    patches.iter().flatten().map(|p| p.mean).sum::<Vector3<f64>>() / count.max(1.0)
}

fn facing_camera(patch: Patch) -> Patch {
    let away = patch.normal.dot(&patch.mean) > 0.0;
    Patch { normal: if away { -patch.normal } else { patch.normal }, ..patch }
}

fn blocks(scan: &Scan, side: usize, columns: usize, rows: usize) -> Vec<Sums> {
    let mut blocks = vec![Sums::default(); columns * rows];
    for (y, row) in scan.points().chunks(scan.width().max(1)).enumerate() {
        let line = &mut blocks[(y / side) * columns..][..columns];
        for (block, points) in line.iter_mut().zip(row.chunks(side)) {
            for point in points {
                if point[2].is_finite() {
                    block.add(point.map(f64::from));
                }
            }
        }
    }
    blocks
}

/// Each block with its neighbours: sums along rows, then along columns.
fn windows(blocks: &[Sums], columns: usize, rows: usize) -> Vec<Sums> {
    let three = |all: &[Sums], at: usize, step: usize, first: bool, last: bool| {
        let mut sum = all[at];
        if !first {
            sum += &all[at - step];
        }
        if !last {
            sum += &all[at + step];
        }
        sum
    };
    let along: Vec<Sums> = (0..blocks.len())
        .map(|k| three(blocks, k, 1, k % columns == 0, (k + 1) % columns == 0))
        .collect();
    (0..blocks.len())
        .map(|k| three(&along, k, columns, k < columns, k / columns + 1 == rows))
        .collect()
}

fn leave_out_rough(patches: &mut [Option<Patch>]) {
    let usual = linalg::median(patches.iter().flatten().map(|p| p.across));
    for patch in patches {
        *patch = patch.filter(|p| p.across <= (ROUGH * usual).max(FLAT * p.along));
    }
}
