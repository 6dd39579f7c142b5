//! An organised scan, cut into square blocks of pixels.

use nalgebra::Vector3;

use super::patch::{Patch, Sums};
use crate::{Scan, parallel};

/// Rows of blocks that a thread works on at once.
const CHUNK: usize = 32;

/// For each block the plane through its points and those of its eight neighbours, about the mean of its
/// own; `None` where there are fewer than `fewest`, or no plane. With the blocks along a row, and rows.
pub fn patches(
    scan: &Scan,
    side: usize,
    fewest: f64,
    threads: usize,
) -> (Vec<Option<Patch>>, (usize, usize)) {
    let (columns, rows) = (scan.width().div_ceil(side), scan.height().div_ceil(side));
    let parts = parallel::in_order(rows.div_ceil(CHUNK), threads, |k| {
        let range = CHUNK * k..rows.min(CHUNK * (k + 1));
        let mut patches = Vec::with_capacity(columns * range.len());
        let mut band = Band::before(scan, side, range.start);
        for row in range {
            band.next(row + 1 < rows);
            patches.extend((0..columns).map(|k| band.patch(k, fewest)));
        }
        patches
    });
    (joined(parts), (columns, rows))
}

fn joined<T>(mut parts: Vec<Vec<T>>) -> Vec<T> {
    if parts.len() == 1 { parts.remove(0) } else { parts.into_iter().flatten().collect() }
}

/// Three rows of blocks, one below the other.
struct Band<'a> {
    scan: &'a Scan,
    side: usize,
    /// The row of blocks that comes next.
    below: usize,
    /// Sums of blocks, and of each with its left and right neighbours.
    rows: [(Vec<Sums>, Vec<Sums>); 3],
}

impl<'a> Band<'a> {
    /// Its last row is the first one.
    fn before(scan: &'a Scan, side: usize, first: usize) -> Self {
        let empty = || vec![Sums::default(); scan.width().div_ceil(side)];
        let rows = std::array::from_fn(|_| (empty(), empty()));
        let mut band = Self { scan, side, below: first.saturating_sub(1), rows };
        if first > 0 {
            band.next(true);
        }
        band.next(true);
        band
    }

    /// Goes down by a row, which has nothing in it where there is none.
    fn next(&mut self, is_there: bool) {
        self.rows.rotate_left(1);
        let (blocks, along) = &mut self.rows[2];
        blocks.fill(Sums::default());
        if is_there {
            let width = self.scan.width().max(1);
            let lines = self.scan.points().chunks(width).skip(self.below * self.side);
            for line in lines.take(self.side) {
                for (block, points) in blocks.iter_mut().zip(line.chunks(self.side)) {
                    for point in points.iter().filter(|p| p[2].is_finite()) {
                        block.add(point.map(f64::from));
                    }
                }
            }
            self.below += 1;
        }
        for k in 0..blocks.len() {
            along[k] = blocks[k];
            if k > 0 {
                along[k] += &blocks[k - 1];
            }
            if let Some(right) = blocks.get(k + 1) {
                along[k] += right;
            }
        }
    }

    /// Of a block in the middle row.
    fn patch(&self, k: usize, fewest: f64) -> Option<Patch> {
        let [above, (blocks, along), below] = &self.rows;
        let block = &blocks[k];
        let mut window = along[k];
        window += &above.1[k];
        window += &below.1[k];
        if block.count == 0.0 || window.count < fewest {
            return None;
        }
        let patch = Patch::of(&window)?;
        let mean = Vector3::from(block.first) / block.count;
        let held = block.count;
        let normal = if patch.normal.dot(&mean) > 0.0 { -patch.normal } else { patch.normal };
        Some(Patch { mean, normal, held, ..patch })
    }
}
