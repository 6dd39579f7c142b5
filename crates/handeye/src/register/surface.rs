//! A scan as pieces of its surface, each a plane through the points of a small window.
//!
//! An organised scan is cut into blocks of pixels; a window is a block and its eight neighbours. The
//! block tells the place and the window the normal: on a curved surface the mean of a window lies beside
//! it, by nine times as much as that of a block. Windows across an edge in depth or a crease are no planes,
//! and are left out: their points scatter more than those of most others.

use nalgebra::Vector3;

use super::patch::{Patch, Sums};
use crate::{Scan, linalg};

/// Side of a block in a scan of 100 000 pixels, pixels. It grows with the fourth root of their number: half
/// of finer pixels goes into finer windows, half into quieter ones.
const SIDE: f64 = 2.2;
/// A window must have this share of its pixels.
const FILLED: f64 = 0.6;
/// Scatter across a plane above this many times the usual one is no plane's.
const ROUGH: f64 = 3.0;
/// But where the scatter across is below this share of that along it, nothing is rough.
const FLAT: f64 = 1e-4;

/// A scan's windows that are planes, in a grid.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Windows along a row, and rows.
    pub size: (usize, usize),
    /// Row by row.
    pub patches: Vec<Option<Patch>>,
    /// Mean of all of them, m.
    pub middle: Vector3<f64>,
}

impl Surface {
    /// Of an organised scan.
    pub fn of(scan: &Scan) -> Self {
        let seen = scan.points().len() as f64;
        let side = ((SIDE * (seen / 1e5).powf(0.25)) as usize).max(1);
        let (columns, rows) = (scan.width().div_ceil(side), scan.height().div_ceil(side));
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
                Some(facing_camera(Patch { mean, ..patch }))
            })
            .collect();
        leave_out_rough(&mut patches);
        let count = patches.iter().flatten().count() as f64;
        let middle =
            patches.iter().flatten().map(|p| p.mean).sum::<Vector3<f64>>() / count.max(1.0);
        Self { size: (columns, rows), patches, middle }
    }
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
