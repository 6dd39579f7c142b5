//! The print on a board: what is black, and how far the next edge is.

use nalgebra::Vector2;

use super::Optics;
use crate::{
    TargetModel,
    detect::markers::{Dictionary, marker_of_square},
};

/// The print on a board. Lengths in units of a cell: a square, or a bit of a single tag.
pub(super) struct Texture {
    columns: f64,
    rows: f64,
    margin: f64,
    pub(super) cell_m: f64,
    /// Origin of the Target frame, in cells from the print's top left.
    origin: Vector2<f64>,
    print: Print,
}

enum Print {
    Squares,
    Markers { dictionary: Dictionary, share: f64, white_first: bool, squares_x: usize },
    Tag { dictionary: Dictionary, id: u32 },
}

impl Texture {
    /// `None` for targets that are not drawn, and unknown dictionaries.
    pub(super) fn of(target: &TargetModel) -> Option<Self> {
        match target {
            TargetModel::Checkerboard { columns, rows, square_mm } => Some(Self {
                columns: f64::from(columns + 1),
                rows: f64::from(rows + 1),
                margin: 1.0,
                cell_m: square_mm * 1e-3,
                origin: Vector2::new(1.0, 1.0),
                print: Print::Squares,
            }),
            TargetModel::Charuco {
                squares_x,
                squares_y,
                square_mm,
                marker_mm,
                dictionary,
                legacy,
            } => Some(Self {
                columns: f64::from(*squares_x),
                rows: f64::from(*squares_y),
                margin: 1.0,
                cell_m: square_mm * 1e-3,
                origin: Vector2::zeros(),
                print: Print::Markers {
                    dictionary: Dictionary::named(dictionary)?,
                    share: marker_mm / square_mm,
                    white_first: *legacy && squares_y % 2 == 0,
                    squares_x: *squares_x as usize,
                },
            }),
            TargetModel::Tag { dictionary, id, size_mm } => {
                let dictionary = Dictionary::named(dictionary)?;
                let cells = (dictionary.side() + 2) as f64;
                Some(Self {
                    columns: cells,
                    rows: cells,
                    margin: 2.0,
                    cell_m: size_mm * 1e-3 / cells,
                    origin: Vector2::new(0.5 * cells, 0.5 * cells),
                    print: Print::Tag { dictionary, id: *id },
                })
            }
            TargetModel::CircleGrid { .. } => None,
        }
    }

    fn in_cells(&self, at: &Vector2<f64>) -> Vector2<f64> {
        at / self.cell_m + self.origin
    }

    /// Points around the paper's edge, in the target's plane (m).
    pub(super) fn outline(&self) -> Vec<Vector2<f64>> {
        let (m, steps) = (self.margin, 16);
        let (w, h) = (self.columns + 2.0 * m, self.rows + 2.0 * m);
        let side = (0..steps).map(|k| f64::from(k) / f64::from(steps));
        let cells = side.flat_map(|s| {
            [(s * w, 0.0), (w, s * h), (w - s * w, h), (0.0, h - s * h)]
                .map(|(x, y)| (x - m, y - m))
        });
        cells.map(|(x, y)| (Vector2::new(x, y) - self.origin) * self.cell_m).collect()
    }

    /// Whether a point of the target's plane is on the paper.
    pub(super) fn covers(&self, at: &Vector2<f64>) -> bool {
        let q = self.in_cells(at);
        let within = |x: f64, n: f64| x > -self.margin && x < n + self.margin;
        within(q.x, self.columns) && within(q.y, self.rows)
    }

    pub(super) fn grey(&self, at: &Vector2<f64>, optics: &Optics) -> f64 {
        let q = self.in_cells(at);
        match (self.covers(at), self.is_black(&q)) {
            (false, _) => optics.background,
            (true, true) => optics.black,
            (true, false) => optics.white,
        }
    }

    fn is_black(&self, q: &Vector2<f64>) -> bool {
        if q.x < 0.0 || q.y < 0.0 || q.x >= self.columns || q.y >= self.rows {
            return false;
        }
        let (i, j) = (q.x as usize, q.y as usize);
        match &self.print {
            Print::Squares => (i + j) % 2 == 0,
            Print::Tag { dictionary, id } => marker_is_black(dictionary, *id, i, j),
            Print::Markers { dictionary, share, white_first, squares_x } => {
                if (i + j + usize::from(*white_first)) % 2 == 0 {
                    return true;
                }
                let n = (dictionary.side() + 2) as f64;
                let bit = |f: f64| ((f - 0.5) / share + 0.5) * n;
                let (x, y) = (bit(q.x.fract()), bit(q.y.fract()));
                let inside = x >= 0.0 && y >= 0.0 && x < n && y < n;
                let id = marker_of_square(i, j, *squares_x, *white_first);
                inside
                    && id.is_some_and(|id| marker_is_black(dictionary, id, x as usize, y as usize))
            }
        }
    }

    /// A lower bound of the distance (m) to the nearest edge of the print.
    pub(super) fn clearance(&self, at: &Vector2<f64>) -> f64 {
        let q = self.in_cells(at);
        let to_line = |x: f64| (x - x.round()).abs();
        let lines = to_line(q.x).min(to_line(q.y));
        let Print::Markers { dictionary, share, .. } = &self.print else {
            return lines * self.cell_m;
        };
        let n = (dictionary.side() + 2) as f64;
        let to_bit = |x: f64| {
            let bit = ((x - x.floor() - 0.5) / share + 0.5) * n;
            (bit - bit.round().clamp(0.0, n)).abs() * share / n
        };
        lines.min(to_bit(q.x)).min(to_bit(q.y)) * self.cell_m
    }
}

fn marker_is_black(dictionary: &Dictionary, id: u32, column: usize, row: usize) -> bool {
    let last = dictionary.side() + 1;
    let border = column == 0 || row == 0 || column >= last || row >= last;
    border || dictionary.is_black(id, column - 1, row - 1)
}
