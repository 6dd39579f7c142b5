//! An organised scan, cut into square blocks of pixels.

use nalgebra::Vector3;

use super::patch::{Patch, Sums};
use crate::{Scan, math::parallel};

/// Rows of blocks that a thread works on at once.
const CHUNK: usize = 32;

/// For each block the plane through its points and those of all blocks within `reach` rows and columns,
/// about the mean of its own; `None` where there are fewer than `fewest`, or no plane. With the number of
/// blocks along a row, and of rows.
pub(crate) fn patches(
    scan: &Scan,
    side: usize,
    reach: usize,
    fewest: f64,
    threads: usize,
) -> (Vec<Option<Patch>>, (usize, usize)) {
    let (columns, rows) = (scan.width().div_ceil(side), scan.height().div_ceil(side));
    let parts = parallel::in_order(rows.div_ceil(CHUNK), threads, |k| {
        let range = CHUNK * k..rows.min(CHUNK * (k + 1));
        let mut patches = Vec::with_capacity(columns * range.len());
        let mut band = Band::before(scan, side, reach, range.start);
        for row in range {
            band.next(row + reach < rows);
            patches.extend((0..columns).map(|k| band.patch(k, fewest)));
        }
        patches
    });
    (joined(parts), (columns, rows))
}

/// A block, and those beside it, among so many along a row and rows.
pub fn around(k: usize, size: (usize, usize)) -> impl Iterator<Item = usize> {
    let (columns, rows) = size;
    let beside = |k: usize, end: usize| k.saturating_sub(1)..(k + 2).min(end);
    beside(k / columns, rows)
        .flat_map(move |row| beside(k % columns, columns).map(move |k| row * columns + k))
}

fn joined<T>(mut parts: Vec<Vec<T>>) -> Vec<T> {
    if parts.len() == 1 { parts.remove(0) } else { parts.into_iter().flatten().collect() }
}

/// Some rows of blocks, one below the other.
struct Band<'a> {
    scan: &'a Scan,
    side: usize,
    reach: usize,
    /// The row of blocks that comes next.
    below: usize,
    /// Sums of blocks, and of each with its left and right neighbours.
    rows: Vec<(Vec<Sums>, Vec<Sums>)>,
}

impl<'a> Band<'a> {
    /// Its middle is the row before the first.
    fn before(scan: &'a Scan, side: usize, reach: usize, first: usize) -> Self {
        let empty = vec![Sums::default(); scan.width().div_ceil(side)];
        let rows = vec![(empty.clone(), empty); 2 * reach + 1];
        let below = first.saturating_sub(reach);
        let mut band = Self { scan, side, reach, below, rows };
        let rows = scan.height().div_ceil(side);
        (below..first + reach).for_each(|row| band.next(row < rows));
        band
    }

    /// Goes down by a row, which has nothing in it where there is none.
    fn next(&mut self, is_there: bool) {
        self.rows.rotate_left(1);
        let (blocks, along) = &mut self.rows[2 * self.reach];
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
            let window =
                &blocks[k.saturating_sub(self.reach)..blocks.len().min(k + self.reach + 1)];
            along[k] = Sums::default();
            window.iter().for_each(|block| along[k] += block);
        }
    }

    /// Of a block in the middle row.
    fn patch(&self, k: usize, fewest: f64) -> Option<Patch> {
        let block = &self.rows[self.reach].0[k];
        let mut window = Sums::default();
        self.rows.iter().for_each(|(_, along)| window += &along[k]);
        if block.count == 0.0 || window.count < fewest {
            return None;
        }
        let patch = Patch::of(&window)?;
        let towards = if patch.normal.dot(&patch.mean) > 0.0 { -1.0 } else { 1.0 };
        let facing = Patch { normal: patch.normal * towards, ..patch };
        Some(facing.about(&(Vector3::from(block.first) / block.count), block.count))
    }
}
