//! ArUco and AprilTag markers: their bits, and how to read them.
//!
//! A marker of `n x n` bits has a border of one black bit around it. Bits are packed row by row
//! from the top left, the first bit the lowest; a set bit is black. The tables are those of OpenCV's
//! predefined dictionaries.
//!
//! S. Garrido-Jurado et al., *Automatic generation and detection of highly reliable fiducial
//! markers under occlusion*, Pattern Recognition 47(6), 2014; E. Olson, *AprilTag*, ICRA 2011.

use calib_targets_aruco::builtins;
use nalgebra::Vector2;

use crate::GrayImage;

/// A family of markers, by OpenCV's name.
#[derive(Debug, Clone, Copy)]
pub struct Dictionary {
    side: usize,
    codes: &'static [u64],
}

/// A marker that was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// Which marker.
    pub id: u32,
    /// Quarter turns, clockwise in the picture, by which the marker is turned.
    pub turns: usize,
    /// Bits that were read wrong.
    pub errors: u32,
}

impl Dictionary {
    /// OpenCV's name, e.g. `DICT_6X6_250`, with or without its `DICT_`.
    pub fn named(name: &str) -> Option<Self> {
        let table = builtins::builtin_dictionary(name)
            .or_else(|| builtins::builtin_dictionary(&format!("DICT_{name}")))?;
        Some(Self { side: table.marker_size(), codes: table.codes() })
    }

    /// Bits along a side, without the border.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Number of markers.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Whether there are no markers.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty()
    }

    /// Whether bit `(column, row)` of a marker is black; `false` for a marker that does not exist.
    pub fn is_black(&self, id: u32, column: usize, row: usize) -> bool {
        let code = self.codes.get(id as usize).copied().unwrap_or(0);
        code >> (row * self.side + column) & 1 == 1
    }

    /// The nearest of the markers `ids`, with at most `most_errors` wrong bits.
    pub fn read(
        &self,
        code: u64,
        ids: impl IntoIterator<Item = u32>,
        most_errors: u32,
    ) -> Option<Reading> {
        let mut seen = code; // the code turned back, quarter by quarter
        let turned: [u64; 4] = std::array::from_fn(|_| {
            let now = seen;
            seen = turned_back(seen, self.side);
            now
        });
        let distances = ids.into_iter().filter_map(|id| {
            let wanted = *self.codes.get(id as usize)?;
            let (turns, errors) = (0..4)
                .map(|turns| (turns, (turned[turns] ^ wanted).count_ones()))
                .min_by_key(|&(_, errors)| errors)?;
            Some(Reading { id, turns, errors })
        });
        distances.min_by_key(|reading| reading.errors).filter(|r| r.errors <= most_errors)
    }
}

/// The code after a quarter turn counter-clockwise.
fn turned_back(code: u64, side: usize) -> u64 {
    let bit = |column: usize, row: usize| code >> (row * side + column) & 1;
    let at = |k: usize| bit(side - 1 - k / side, k % side) << k;
    (0..side * side).map(at).sum()
}

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

/// Reads the cells of a marker that covers the unit square of `pixel_at`. `None` when a part lies
/// outside the picture.
pub fn read_cells(
    image: &GrayImage,
    side: usize,
    pixel_at: impl Fn(f64, f64) -> Vector2<f64>,
) -> Option<Cells> {
    let n = side + 2;
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
        if column == 0 || row == 0 || column == n - 1 || row == n - 1 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marker_is_read_in_all_four_orientations() {
        let dictionary = Dictionary::named("DICT_6X6_250").unwrap();
        let code = dictionary.codes[17];
        let mut turned = code;
        for turns in [0, 3, 2, 1] {
            let reading = dictionary.read(turned, 0..250, 2).unwrap();
            assert_eq!(reading, Reading { id: 17, turns, errors: 0 });
            turned = turned_back(turned, 6); // three quarter turns clockwise
        }
    }

    #[test]
    fn too_many_wrong_bits_are_no_marker() {
        let dictionary = Dictionary::named("APRILTAG_36h11").unwrap();
        let code = dictionary.codes[3] ^ 0b111;
        assert_eq!(dictionary.read(code, 0..587, 3).unwrap().errors, 3);
        assert!(dictionary.read(code, 0..587, 2).is_none());
    }

    #[test]
    fn the_published_marker_zero_of_4x4_is_the_one_we_read() {
        let dictionary = Dictionary::named("DICT_4X4_50").unwrap();
        let white = ["1011", "0101", "0011", "0010"];
        for (row, bits) in white.iter().enumerate() {
            for (column, bit) in bits.bytes().enumerate() {
                assert_eq!(dictionary.is_black(0, column, row), bit == b'0');
            }
        }
    }
}
