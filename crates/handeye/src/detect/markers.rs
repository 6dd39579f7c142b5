//! Reading the cells of ArUco and AprilTag markers in an image.

use nalgebra::Vector2;

use crate::GrayImage;
pub use crate::model::dictionary::{Dictionary, Reading};

/// What the cells of a marker, border included, look like in an image.
#[derive(Debug, Clone)]
pub(crate) struct Cells {
    /// The inner bits.
    pub code: u64,
    /// Border cells that are not black.
    pub border_errors: u32,
    /// Mean grey of the white cells minus that of the black ones.
    pub contrast: f64,
}

/// Samples per side of a cell.
const SAMPLES: [f64; 3] = [0.3, 0.5, 0.7];
/// Share of a neighbour's light in a cell where the blur's standard deviation is about 0.4 cells.
const NEIGHBOUR: f64 = 0.17;
/// Rounds of sharpening.
const SHARPENINGS: usize = 5;

/// Mean greys of the cells of a marker, border included, row by row.
#[derive(Debug, Clone)]
pub(crate) struct Greys {
    grey: Vec<f64>,
    /// Cells along a side.
    cells: usize,
    /// Width of the border, cells.
    border: usize,
}

impl Greys {
    /// Of a marker of `side` bits with a border, `border` bits wide, that covers the unit square of
    /// `pixel_at`. `None` when a part lies outside the image.
    pub fn of(
        image: &GrayImage,
        (side, border): (usize, usize),
        pixel_at: impl Fn(f64, f64) -> Vector2<f64>,
    ) -> Option<Self> {
        let n = side + 2 * border;
        let mut grey = vec![0.0; n * n];
        for (i, cell) in grey.iter_mut().enumerate() {
            let (column, row) = ((i % n) as f64, (i / n) as f64);
            for a in SAMPLES {
                for b in SAMPLES {
                    let at = pixel_at((column + a) / n as f64, (row + b) / n as f64);
                    *cell += bilinear(image, &at)? / (SAMPLES.len() * SAMPLES.len()) as f64;
                }
            }
        }
        Some(Self { grey, cells: n, border })
    }

    /// What the cells say.
    pub fn read(&self) -> Cells {
        let (n, border) = (self.cells, self.border);
        let threshold = two_means(&self.grey);
        let (mut code, mut border_errors, mut inner) = (0, 0, 0);
        for (i, &cell) in self.grey.iter().enumerate() {
            let (column, row, black) = (i % n, i / n, cell < threshold);
            let inner_bit = |k: usize| (border..n - border).contains(&k);
            if !(inner_bit(column) && inner_bit(row)) {
                border_errors += u32::from(!black);
            } else {
                code |= u64::from(black) << inner;
                inner += 1;
            }
        }
        Cells { code, border_errors, contrast: contrast(&self.grey, threshold) }
    }

    /// The greys before a blur that mixed neighbouring cells, with white around the marker; by van
    /// Cittert's iteration `x ← x + (y - K x)`.
    pub(crate) fn sharpened(&self) -> Self {
        let white = self.grey.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut sharp = self.grey.clone();
        for _ in 0..SHARPENINGS {
            let blurred = self.blurred(&sharp, white);
            for (x, (y, seen)) in sharp.iter_mut().zip(self.grey.iter().zip(blurred)) {
                *x += y - seen;
            }
        }
        Self { grey: sharp, ..*self }
    }

    /// Each cell with its neighbours' light in it, along rows and then along columns.
    fn blurred(&self, grey: &[f64], white: f64) -> Vec<f64> {
        let n = self.cells;
        let at = |grey: &[f64], inside: bool, k: usize| if inside { grey[k] } else { white };
        let mixed = |own: f64, before: f64, after: f64| {
            (1.0 - 2.0 * NEIGHBOUR) * own + NEIGHBOUR * (before + after)
        };
        let across = |k: usize| {
            let (before, after) = (!k.is_multiple_of(n), !(k + 1).is_multiple_of(n));
            mixed(grey[k], at(grey, before, k.wrapping_sub(1)), at(grey, after, k + 1))
        };
        let rows: Vec<f64> = (0..n * n).map(across).collect();
        let down = |k: usize| {
            let (before, after) = (k >= n, k + n < n * n);
            mixed(rows[k], at(&rows, before, k.wrapping_sub(n)), at(&rows, after, k + n))
        };
        (0..n * n).map(down).collect()
    }
}

/// The grey halfway between the dark and the bright cells (Ridler and Calvard 1978).
fn two_means(grey: &[f64]) -> f64 {
    let mut threshold = grey.iter().sum::<f64>() / grey.len() as f64;
    for _ in 0..10 {
        let (dark, bright) = means(grey, threshold);
        threshold = 0.5 * (dark + bright);
    }
    threshold
}

fn contrast(grey: &[f64], threshold: f64) -> f64 {
    let (dark, bright) = means(grey, threshold);
    bright - dark
}

fn means(grey: &[f64], threshold: f64) -> (f64, f64) {
    let mean = |bright: bool| {
        let side = || grey.iter().filter(|&&g| (g >= threshold) == bright);
        if side().count() == 0 { threshold } else { side().sum::<f64>() / side().count() as f64 }
    };
    (mean(false), mean(true))
}

/// Grey value between pixels; `None` outside.
pub(crate) fn bilinear(image: &GrayImage, at: &Vector2<f64>) -> Option<f64> {
    let (x, y) = (at.x.floor(), at.y.floor());
    let inside =
        x >= 0.0 && y >= 0.0 && x + 1.0 < image.width() as f64 && y + 1.0 < image.height() as f64;
    if !inside {
        return None;
    }
    let (i, j, a, b) = (x as usize, y as usize, at.x - x, at.y - y);
    let grey = |i, j| f64::from(image.at(i, j));
    let top = grey(i, j) * (1.0 - a) + grey(i + 1, j) * a;
    let bottom = grey(i, j + 1) * (1.0 - a) + grey(i + 1, j + 1) * a;
    Some(top * (1.0 - b) + bottom * b)
}
