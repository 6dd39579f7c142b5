//! Reading the cells of ArUco and AprilTag markers in a picture.

use nalgebra::Vector2;

use crate::GrayImage;
pub use crate::dictionary::{Dictionary, Reading};

/// Which marker of a ChArUco board sits in square `(i, j)`; `None` in a black one.
pub fn marker_of_square(i: usize, j: usize, squares_x: usize, white_first: bool) -> Option<u32> {
    let shift = usize::from(white_first);
    if (i + j + shift).is_multiple_of(2) {
        return None;
    }
    // white squares of a row start at column 0 or 1; odd widths alternate their number
    let in_row = |row: usize| (squares_x + usize::from((row + 1 + shift).is_multiple_of(2))) / 2;
    let before: usize = (0..j).map(in_row).sum();
    Some((before + i / 2) as u32)
}

/// What the cells of a marker, border included, look like in a picture.
#[derive(Debug, Clone)]
pub struct Cells {
    /// The inner bits.
    pub code: u64,
    /// Border cells that are not black.
    pub border_errors: u32,
    /// Mean grey of the white cells minus that of the black ones.
    pub contrast: f64,
}

/// Samples per side of a cell.
const SAMPLES: [f64; 3] = [0.3, 0.5, 0.7];

/// Reads the cells of a marker of `side` bits with a border, `border` bits wide, that covers the unit
/// square of `pixel_at`. `None` when a part lies
/// outside the picture.
pub fn read_cells(
    image: &GrayImage,
    (side, border): (usize, usize),
    pixel_at: impl Fn(f64, f64) -> Vector2<f64>,
) -> Option<Cells> {
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
    let threshold = two_means(&grey);
    let (mut code, mut border_errors, mut inner) = (0, 0, 0);
    for (i, &cell) in grey.iter().enumerate() {
        let (column, row, black) = (i % n, i / n, cell < threshold);
        let inner_bit = |k: usize| (border..n - border).contains(&k);
        if !(inner_bit(column) && inner_bit(row)) {
            border_errors += u32::from(!black);
        } else {
            code |= u64::from(black) << inner;
            inner += 1;
        }
    }
    Some(Cells { code, border_errors, contrast: contrast(&grey, threshold) })
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
pub fn bilinear(image: &GrayImage, at: &Vector2<f64>) -> Option<f64> {
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
