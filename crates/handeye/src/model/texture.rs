//! The print on a board: what is black, and how far the next edge is.

use nalgebra::Vector2;

use crate::{
    TargetModel,
    model::{dictionary::Dictionary, print::marker_of_square},
};

/// The print on a board. Lengths in units of a cell: a square, a bit of a single tag, a tag of a
/// grid, the distance between circles (or rows of circles).
pub(crate) struct Texture {
    columns: f64,
    rows: f64,
    margin: f64,
    pub(crate) cell_m: f64,
    /// Origin of the Target frame, in cells from the print's top left.
    origin: Vector2<f64>,
    print: Print,
}

enum Print {
    Squares,
    Markers { dictionary: Dictionary, share: f64, white_first: bool, squares_x: usize, first: u32 },
    Tag { dictionary: Dictionary, id: u32 },
    Tags(Tags),
    Discs(Discs),
}

impl Texture {
    /// `None` for targets that are not drawn, and unknown dictionaries.
    pub(crate) fn of(target: &TargetModel) -> Option<Self> {
        target.texture()
    }

    /// A checkerboard of so many squares; `origin` counts squares from the print's top left.
    pub(super) fn squares(
        (columns, rows): (u32, u32),
        square_mm: f64,
        origin: Vector2<f64>,
    ) -> Self {
        Self {
            columns: f64::from(columns),
            rows: f64::from(rows),
            margin: 1.0,
            cell_m: square_mm * 1e-3,
            origin,
            print: Print::Squares,
        }
    }

    /// With markers in its white squares, of this share of a square's side.
    pub(super) fn with_markers(
        self,
        dictionary: Dictionary,
        share: f64,
        white_first: bool,
        first: u32,
    ) -> Self {
        let squares_x = self.columns as usize;
        Self { print: Print::Markers { dictionary, share, white_first, squares_x, first }, ..self }
    }

    /// A single tag.
    pub(super) fn tag(dictionary: Dictionary, id: u32, size_mm: f64) -> Self {
        let cells = (dictionary.side() + 2) as f64;
        Self {
            columns: cells,
            rows: cells,
            margin: 2.0,
            cell_m: size_mm * 1e-3 / cells,
            origin: Vector2::new(0.5 * cells, 0.5 * cells),
            print: Print::Tag { dictionary, id },
        }
    }

    /// A grid of circles.
    pub(super) fn circles(target: &TargetModel) -> Self {
        let cell_m = target.pitch_m();
        let centres = || target.corners().into_iter().map(|c| c.vector().xy() / cell_m);
        let low = centres().fold(Vector2::repeat(f64::INFINITY), |a, b| a.inf(&b));
        let high = centres().fold(Vector2::repeat(f64::NEG_INFINITY), |a, b| a.sup(&b));
        let radius = |id| 0.5e-3 * target.disc_diameter_mm(id) / cell_m;
        let discs = (0..).zip(centres()).map(|(id, at)| (at - low, radius(id)));
        let extent = high - low;
        Self {
            columns: extent.x,
            rows: extent.y,
            margin: 1.0,
            cell_m,
            origin: -low,
            print: Print::Discs(Discs::new(discs, (extent.x as usize + 1, extent.y as usize + 1))),
        }
    }

    /// A grid of tags, with its border in bits and whether squares fill the crossings of its gaps.
    pub(super) fn tags(
        target: &TargetModel,
        dictionary: Dictionary,
        spacing: f64,
        (border, corner_squares): (u32, bool),
    ) -> Self {
        let (columns, rows) = target.grid();
        let placed = target.tags();
        let cell_m = target.pitch_m();
        let corner = placed.iter().map(|t| t.top_left / cell_m);
        let low = corner.fold(Vector2::repeat(f64::INFINITY), |a, b| a.inf(&b));
        let across = columns as usize / 2;
        let mut ids = vec![0; placed.len()];
        for tag in &placed {
            let at = (tag.top_left / cell_m - low) / (1.0 + spacing);
            ids[at.y.round() as usize * across + at.x.round() as usize] = tag.marker;
        }
        let extent = |n: u32| f64::from(n / 2) * (1.0 + spacing) + spacing;
        Self {
            columns: extent(columns),
            rows: extent(rows),
            margin: spacing,
            cell_m,
            origin: Vector2::repeat(spacing) - low,
            print: Print::Tags(Tags {
                dictionary,
                ids,
                across,
                spacing,
                border,
                corner_squares,
                turned: placed.first().is_some_and(|t| t.turned),
            }),
        }
    }

    fn in_cells(&self, at: &Vector2<f64>) -> Vector2<f64> {
        at / self.cell_m + self.origin
    }

    /// Points around the paper's edge, in the target's plane (m).
    pub(crate) fn outline(&self) -> Vec<Vector2<f64>> {
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
    pub(crate) fn covers(&self, at: &Vector2<f64>) -> bool {
        let q = self.in_cells(at);
        let within = |x: f64, n: f64| x > -self.margin && x < n + self.margin;
        within(q.x, self.columns) && within(q.y, self.rows)
    }

    /// Whether a point of the target's plane is black; `None` beside the paper.
    pub(crate) fn is_black_at(&self, at: &Vector2<f64>) -> Option<bool> {
        self.covers(at).then(|| self.is_black(&self.in_cells(at)))
    }

    fn is_black(&self, q: &Vector2<f64>) -> bool {
        if let Print::Discs(discs) = &self.print {
            return discs.distance(q) < 0.0;
        }
        if q.x < 0.0 || q.y < 0.0 || q.x >= self.columns || q.y >= self.rows {
            return false;
        }
        let (i, j) = (q.x as usize, q.y as usize);
        match &self.print {
            Print::Squares => (i + j) % 2 == 0,
            Print::Tags(tags) => tags.is_black(q),
            Print::Discs(_) => false,
            Print::Tag { dictionary, id } => marker_is_black(dictionary, *id, i, j),
            Print::Markers { dictionary, share, white_first, squares_x, first } => {
                if (i + j + usize::from(*white_first)) % 2 == 0 {
                    return true;
                }
                let n = (dictionary.side() + 2) as f64;
                let bit = |f: f64| ((f - 0.5) / share + 0.5) * n;
                let (x, y) = (bit(q.x.fract()), bit(q.y.fract()));
                let inside = x >= 0.0 && y >= 0.0 && x < n && y < n;
                let id = marker_of_square(i, j, *squares_x, *white_first);
                let id = id.and_then(|id| id.checked_add(*first));
                inside
                    && id.is_some_and(|id| marker_is_black(dictionary, id, x as usize, y as usize))
            }
        }
    }

    /// A lower bound of the distance (m) to the nearest edge of the print.
    pub(crate) fn clearance(&self, at: &Vector2<f64>) -> f64 {
        let q = self.in_cells(at);
        let (x, y) = self.beyond_lines(&q);
        let lines = x.abs().min(y.abs());
        let cells = match &self.print {
            Print::Discs(discs) => lines.min(discs.distance(&q).abs()),
            _ => lines,
        };
        cells * self.cell_m
    }

    /// What edges may lie within `reach` (m) of a point.
    pub(crate) fn nearby(&self, at: &Vector2<f64>, reach: f64) -> Nearby {
        let q = self.in_cells(at);
        let reach = reach / self.cell_m;
        let (x, y) = self.beyond_lines(&q);
        match (&self.print, x.abs() < reach, y.abs() < reach) {
            (Print::Discs(discs), _, _) if discs.distance(&q).abs() < reach => Nearby::Edges,
            (_, false, false) => Nearby::Nothing,
            (_, true, true) => Nearby::Edges,
            _ if self.finest() < 2.0 * reach => Nearby::Edges,
            (_, true, false) => Nearby::Upright(x * self.cell_m),
            (_, false, true) => Nearby::Level(y * self.cell_m),
        }
    }

    /// How far a point is to the right of the nearest upright line along which colours may change,
    /// and how far below the nearest level one, in cells.
    fn beyond_lines(&self, q: &Vector2<f64>) -> (f64, f64) {
        let m = self.margin;
        let nearest = |x: f64, extent: f64| {
            let from = |line: f64| x - line;
            let paper = smaller(from(-m), from(extent + m));
            match &self.print {
                Print::Squares | Print::Tag { .. } => from(x.round()),
                Print::Markers { dictionary, share, .. } => {
                    let n = (dictionary.side() + 2) as f64;
                    let bit = ((x - x.floor() - 0.5) / share + 0.5) * n;
                    smaller(from(x.round()), (bit - bit.round().clamp(0.0, n)) * share / n)
                }
                Print::Tags(tags) => smaller(tags.beyond_line(x), paper),
                Print::Discs(_) => paper,
            }
        };
        (nearest(q.x, self.columns), nearest(q.y, self.rows))
    }

    /// Least distance between two lines along which colours may change, in cells.
    fn finest(&self) -> f64 {
        match &self.print {
            Print::Squares | Print::Tag { .. } | Print::Discs(_) => 1.0,
            Print::Markers { dictionary, share, .. } => {
                let bit = share / (dictionary.side() + 2) as f64;
                bit.min(0.5 * (1.0 - share))
            }
            Print::Tags(tags) => tags.spacing.min(1.0 / tags.cells()),
        }
    }
}

/// Edges of the print near a point.
pub(crate) enum Nearby {
    /// None.
    Nothing,
    /// One upright line; the point is so far to the right of it, m.
    Upright(f64),
    /// One level line; the point is so far below it, m.
    Level(f64),
    /// Anything.
    Edges,
}

fn smaller(a: f64, b: f64) -> f64 {
    if a.abs() < b.abs() { a } else { b }
}

/// A grid of tags with gaps between; lengths in tags, from the outer corner of the gap at the top
/// left.
struct Tags {
    dictionary: Dictionary,
    /// Row by row from the top left.
    ids: Vec<u32>,
    across: usize,
    spacing: f64,
    border: u32,
    corner_squares: bool,
    turned: bool,
}

impl Tags {
    /// Which tag or gap along one direction, and where in it: negative in the gap before the tag.
    fn place(&self, x: f64) -> (usize, f64) {
        let period = 1.0 + self.spacing;
        let k = (x / period).floor().max(0.0);
        (k as usize, x - k * period - self.spacing)
    }

    fn cells(&self) -> f64 {
        (self.dictionary.side() + 2 * self.border as usize) as f64
    }

    fn is_black(&self, q: &Vector2<f64>) -> bool {
        let ((i, x), (j, y)) = (self.place(q.x), self.place(q.y));
        if x < 0.0 || y < 0.0 {
            return self.corner_squares && x < 0.0 && y < 0.0;
        }
        let cell = |x: f64| ((x * self.cells()) as usize).min(self.cells() as usize - 1);
        let id = (i < self.across).then(|| self.ids.get(j * self.across + i)).flatten();
        id.is_some_and(|&id| {
            self.dictionary.is_cell_black(id, self.border, self.turned, (cell(x), cell(y)))
        })
    }

    /// How far a coordinate is beyond the nearest line.
    fn beyond_line(&self, x: f64) -> f64 {
        let (n, x) = (self.cells(), self.place(x).1);
        // the gap before the tag, or the lines between its bits
        if x < 0.0 { smaller(x, x + self.spacing) } else { (x * n - (x * n).round()) / n }
    }
}

/// Discs, each in the cell that its centre is in; no two of one cell.
struct Discs {
    columns: usize,
    /// Centre and radius; a cell without a disc has none.
    cells: Vec<Option<(Vector2<f64>, f64)>>,
    largest: f64,
}

impl Discs {
    fn new(
        discs: impl Iterator<Item = (Vector2<f64>, f64)>,
        (columns, rows): (usize, usize),
    ) -> Self {
        let mut all = Self { columns, cells: vec![None; columns * rows], largest: 0.0 };
        for (centre, radius) in discs {
            let (i, j) = (centre.x.round() as usize, centre.y.round() as usize);
            all.cells[j * columns + i] = Some((centre, radius));
            all.largest = all.largest.max(radius);
        }
        all
    }

    /// Distance to the nearest disc's edge, negative inside; far from all, a lower bound.
    fn distance(&self, q: &Vector2<f64>) -> f64 {
        let (i, j) = (q.x.round() as i64, q.y.round() as i64);
        let near = (j - 1..=j + 1).flat_map(|j| (i - 1..=i + 1).map(move |i| (i, j)));
        let discs = near.filter_map(|(i, j)| {
            let (i, j) = (usize::try_from(i).ok()?, usize::try_from(j).ok()?);
            let cell = (i < self.columns).then(|| self.cells.get(j * self.columns + i)).flatten();
            *cell?
        });
        // centres in other cells are 1.5 cells away or more
        let farther = 1.5 - self.largest;
        discs.map(|(centre, radius)| (q - centre).norm() - radius).fold(farther, f64::min)
    }
}

fn marker_is_black(dictionary: &Dictionary, id: u32, column: usize, row: usize) -> bool {
    let last = dictionary.side() + 1;
    let border = column == 0 || row == 0 || column >= last || row >= last;
    border || dictionary.is_black(id, column - 1, row - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::model::print::{Shape, art};
    use crate::model::target::{KINDS, kinds::AprilTagFamily};

    /// One of each kind, and what else is drawn otherwise.
    fn boards() -> Vec<TargetModel> {
        let examples = KINDS.iter().filter(|kind| kind.is_printed()).map(|kind| (kind.example)());
        examples.chain(variants()).collect()
    }

    fn variants() -> Vec<TargetModel> {
        let (columns, rows, pitch_mm) = (5, 4, 20.0);
        let dictionary = || "DICT_5X5_100".to_string();
        let aprilgrid = |corner_squares, border_bits| TargetModel::Aprilgrid {
            tags_x: 3,
            tags_y: 2,
            tag_mm: 30.0,
            spacing: 0.3,
            family: AprilTagFamily::Tag36h11,
            first_id: 7,
            corner_squares,
            border_bits,
        };
        vec![
            TargetModel::Charuco {
                squares_x: columns,
                squares_y: rows,
                square_mm: 20.0,
                marker_mm: 15.0,
                dictionary: dictionary(),
                legacy: true,
                first_id: 30,
            },
            TargetModel::CircleGrid { columns, rows, pitch_mm },
            TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm },
            TargetModel::ModifiedCircleGrid { columns, rows, pitch_mm },
            aprilgrid(true, 1),
            aprilgrid(false, 2),
            TargetModel::TagGrid {
                dictionary: dictionary(),
                tags_x: 2,
                tags_y: 3,
                tag_mm: 30.0,
                gap_mm: 8.0,
                first_id: 11,
            },
        ]
    }

    fn holds(shape: &Shape, at: &Vector2<f64>) -> bool {
        match *shape {
            Shape::Rectangle { x, y, width, height } => {
                at.x >= x && at.y >= y && at.x < x + width && at.y < y + height
            }
            Shape::Disc { x, y, radius } => (at - Vector2::new(x, y)).norm() < radius,
        }
    }

    #[test]
    fn what_is_rendered_is_what_is_printed() {
        for target in boards() {
            let (art, texture) = (art(&target).unwrap(), Texture::of(&target).unwrap());
            let mut random = Random::new(5);
            let mut black = 0;
            for _ in 0..4000 {
                let on_art = Vector2::new(
                    random.between(-3.0, art.width + 3.0),
                    random.between(-3.0, art.height + 3.0),
                );
                let at =
                    (on_art - Vector2::from([art.target_origin.0, art.target_origin.1])) * 1e-3;
                if texture.clearance(&at) < 1e-7 {
                    continue; // on an edge
                }
                let printed = art.shapes.iter().any(|s| holds(s, &on_art));
                let rendered = texture.is_black_at(&at) == Some(true);
                assert_eq!(printed, rendered, "{target:?} at {on_art}");
                black += usize::from(printed);
            }
            assert!(black > 500, "{target:?}");
        }
    }

    #[test]
    fn no_edge_is_nearer_than_the_clearance() {
        for target in boards() {
            let texture = Texture::of(&target).unwrap();
            let outline = texture.outline();
            let low = outline.iter().fold(outline[0], |a, b| a.inf(b));
            let high = outline.iter().fold(outline[0], |a, b| a.sup(b));
            let mut random = Random::new(6);
            let (mut inside, mut sum) = (0, 0.0);
            for _ in 0..2000 {
                let at = Vector2::new(random.between(low.x, high.x), random.between(low.y, high.y));
                let clear = texture.clearance(&at);
                let angle = random.between(0.0, std::f64::consts::TAU);
                let near = at + 0.999 * clear * Vector2::new(angle.cos(), angle.sin());
                assert_eq!(texture.is_black_at(&at), texture.is_black_at(&near), "{target:?}");
                inside += usize::from(clear > 0.0);
                sum += clear;
            }
            assert!(inside > 1900 && sum > 0.0, "{target:?}");
        }
    }
}
