//! Boards whose grid is known by the markers in it: ChArUco boards, and AprilGrids whose gaps have
//! squares in their crossings, so that every corner of a tag is one of a grid with two kinds of steps.
//!
//! Each marker that is read votes for a turn and a shift of the grid.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::{
    fits::{Fits, corner, sorted},
    grid::Grid,
    homography,
    markers::{self, Dictionary},
    tags::Board,
};
use crate::{
    GrayImage, ImageCorner, TargetModel,
    detect::outcome::{NotFound, Outcome, worth},
    model::{
        print::marker_of_square,
        target::look::{MarkedSquares, Tags},
    },
};

/// Fewer corners do not determine a pose.
const FEWEST_CORNERS: usize = 4;

/// Border cells of a marker that may look white.
const MOST_BORDER_ERRORS: u32 = 3;
/// Least contrast of a marker, grey values.
const LEAST_CONTRAST: f64 = 12.0;
/// Corners of a grid and of tags are the same ones within this, px, or
const AGREED_PX: f64 = 2.0;
/// this share of the tag's side.
const AGREED: f64 = 0.05;
/// Share of the markers of a grid that must lie on the board as the best placement has them.
const LEAST_AGREEING: f64 = 0.5;
/// Markers with more bits than this do not occur by chance: one of them is proof enough.
const PROOF_BITS: usize = 24;

/// A turn (clockwise quarters) and a shift that take grid labels to the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Placing {
    turns: usize,
    shift: (i32, i32),
}

impl Placing {
    /// Board label of a grid label. Turning the board clockwise by `turns` gave the grid.
    fn on_board(&self, label: (i32, i32)) -> (i32, i32) {
        let (i, j) = turned_back(label, self.turns);
        (i + self.shift.0, j + self.shift.1)
    }
}

fn turned_back((i, j): (i32, i32), turns: usize) -> (i32, i32) {
    (0..turns).fold((i, j), |(i, j), _| (j, -i))
}

/// A board of corners with markers between them. Labels are columns and rows of the board's corners.
pub(super) struct Coded<'a> {
    target: &'a TargetModel,
    /// Side of a marker over that of its cell.
    share: f64,
    /// Width of a marker's black border, bits.
    border: usize,
    /// Whether corners lie in pairs, at both ends of a tag's side.
    in_pairs: bool,
    /// Half the width of the cross around a corner that is free of markers' bits, over the shortest
    /// step.
    clean: f64,
    name: String,
    dictionary: Dictionary,
    /// Quarter turns in which the markers stand on the board.
    turns: usize,
    /// The first marker.
    first: u32,
    /// The corner above and left of each marker; one may lie outside of the board.
    cells: Vec<(i32, i32)>,
    /// Places of columns and rows, in metres.
    lines: [Vec<f64>; 2],
}

fn dictionary(name: &str) -> Result<Dictionary, NotFound> {
    Dictionary::named(name).ok_or_else(|| NotFound::UnknownDictionary(name.into()))
}

impl<'a> Coded<'a> {
    /// A checkerboard with markers in its white squares.
    pub fn charuco(target: &'a TargetModel, print: &MarkedSquares) -> Result<Self, NotFound> {
        let (squares_x, squares_y) = print.squares;
        let squares =
            (0..squares_y as usize).flat_map(|j| (0..squares_x as usize).map(move |i| (i, j)));
        let has_marker = |&(i, j): &(usize, usize)| {
            marker_of_square(i, j, squares_x as usize, print.white_first).is_some()
        };
        Ok(Coded {
            target,
            share: print.share,
            border: 1,
            in_pairs: false,
            clean: 0.5 * (1.0 - print.share),
            name: print.dictionary.clone(),
            dictionary: dictionary(&print.dictionary)?,
            turns: 0,
            first: print.first_id,
            cells: squares.filter(has_marker).map(|(i, j)| (i as i32 - 1, j as i32 - 1)).collect(),
            lines: lines(target),
        })
    }

    /// Tags whose corners touch black squares.
    pub fn tags(target: &'a TargetModel, print: &Tags) -> Result<Self, NotFound> {
        let dictionary = dictionary(&print.dictionary)?;
        let border = print.border_bits as usize;
        let bits = dictionary.side() + 2 * border;
        let label_of: BTreeMap<u32, (i32, i32)> =
            labels(target).filter_map(|k| Some((id_of(target, k)?, k))).collect();
        // of a tag's corners the one that is read first
        let first_of = |corners: &[u32; 4]| corners.iter().filter_map(|id| label_of.get(id)).min();
        let tags = target.tags();
        Ok(Coded {
            target,
            share: 1.0,
            border,
            in_pairs: true,
            clean: (border as f64 / bits as f64 / print.gap).min(1.0),
            name: print.dictionary.clone(),
            dictionary,
            turns: if tags.first().is_some_and(|tag| tag.turned) { 2 } else { 0 },
            first: print.first_id,
            cells: tags.iter().filter_map(|tag| first_of(&tag.corners).copied()).collect(),
            lines: lines(target),
        })
    }
}

/// Whether a place has two corners or more around it: far from all others nothing is foreseen.
fn is_beside(board: &Grid, (i, j): (i32, i32)) -> bool {
    let around = (-1..=1).flat_map(|di| (-1..=1).map(move |dj| (i + di, j + dj)));
    around.filter(|k| board.corners.contains_key(k)).count() >= 2
}

/// All columns and rows of a board, row by row.
fn labels(target: &TargetModel) -> impl Iterator<Item = (i32, i32)> + use<> {
    let (columns, rows) = target.grid();
    (0..rows as i32).flat_map(move |j| (0..columns as i32).map(move |i| (i, j)))
}

fn id_of(target: &TargetModel, (i, j): (i32, i32)) -> Option<u32> {
    target.id_at(u32::try_from(i).ok()?, u32::try_from(j).ok()?)
}

fn lines(target: &TargetModel) -> [Vec<f64>; 2] {
    let (columns, rows) = target.grid();
    let place = |column, row| {
        let corner = target.id_at(column, row).and_then(|id| target.corner(id));
        corner.map_or_else(Vector2::zeros, |p| p.vector().xy())
    };
    [
        (0..columns).map(|column| place(column, 0).x).collect(),
        (0..rows).map(|row| place(0, row).y).collect(),
    ]
}

impl Coded<'_> {
    pub fn label(&self, image: &GrayImage, grids: &[Grid]) -> Outcome {
        let mut board = Grid::default();
        let mut contradiction = None;
        for grid in grids {
            let placed = match self.placing(image, grid) {
                Ok(Some(placing)) => grid.relabel(|k| placing.on_board(k)),
                Ok(None) => continue,
                Err(error) => {
                    contradiction.get_or_insert(error);
                    continue;
                }
            };
            let inside = placed.corners.into_iter().filter(|(k, _)| self.has(*k));
            for (label, at) in inside {
                board.corners.entry(label).or_insert(at); // larger grids come first
            }
        }
        if board.corners.is_empty() {
            if let Some(error) = contradiction {
                return Err(error);
            }
            let corners = grids.first().map_or(0, |g| g.corners.len());
            return Err(NotFound::NoMarkers { corners, dictionary: self.name.clone() });
        }
        self.measured(image, board)
    }

    /// Where the grid shows a part of the board only, tags that are read by themselves may show more
    /// of it; unless they say otherwise where both see a corner.
    pub fn with_tags(&self, image: &GrayImage, found: Outcome) -> Outcome {
        let Some(Ok(tags)) = Board::of(self.target) else { return found };
        let rough = tags.rough(image);
        let known = found.iter().flatten().filter_map(|c| Some((c, rough.get(&c.id)?)));
        let agrees = |(c, (pixel, side)): (&ImageCorner, &(Vector2<f64>, f64))| {
            (c.pixel - pixel).norm() < AGREED_PX.max(AGREED * side)
        };
        let agreed: Vec<bool> = known.map(agrees).collect();
        if found.is_ok() && (agreed.is_empty() || agreed.contains(&false)) {
            return found;
        }
        let pixels = rough.iter().map(|(id, (pixel, _))| (*id, *pixel));
        let exact = found.iter().flatten().map(|c| (c.id, c.pixel));
        let all: BTreeMap<u32, Vector2<f64>> = pixels.chain(exact).collect();
        let with_label = |k| Some((k, *all.get(&id_of(self.target, k)?)?));
        let corners = labels(self.target).filter_map(with_label).collect();
        let more = self.measured(image, Grid { corners });
        if worth(&more) > worth(&found) { more } else { found }
    }

    fn measured(&self, image: &GrayImage, mut board: Grid) -> Outcome {
        let fits =
            Fits { image, clean: self.clean, pairs: self.in_pairs, lines: Some(&self.lines) };
        let seen = board.clone();
        self.fill(&mut board, &fits);
        let fitted = fits.all(&board, &seen);
        let with_id = fitted.iter().filter_map(|(k, f)| Some(corner(id_of(self.target, *k)?, f)));
        let corners: Vec<_> = with_id.collect();
        if corners.len() < FEWEST_CORNERS {
            return Err(NotFound::TooFew { found: corners.len(), needed: self.target.len() });
        }
        Ok(sorted(corners))
    }

    fn has(&self, label: (i32, i32)) -> bool {
        id_of(self.target, label).is_some()
    }

    fn markers(&self) -> std::ops::Range<u32> {
        self.first..self.first.saturating_add(self.cells.len() as u32)
    }

    /// Adds corners where the ones beside them say they are.
    fn fill(&self, board: &mut Grid, fits: &Fits) {
        loop {
            let missing = labels(self.target).filter(|k| !board.corners.contains_key(k));
            let beside = missing.filter(|k| is_beside(board, *k));
            let mut added: BTreeMap<_, _> =
                beside.filter_map(|k| Some((k, fits.predicted(board, k)?))).collect();
            if added.is_empty() {
                return;
            }
            board.corners.append(&mut added);
        }
    }

    /// The placement most markers vote for, if enough do; an error where most of those that were read lie elsewhere:
    /// then the board is another one than declared, and a part that fits does so by chance.
    fn placing(&self, image: &GrayImage, grid: &Grid) -> Result<Option<Placing>, NotFound> {
        let mut votes: BTreeMap<Placing, usize> = BTreeMap::new();
        for &cell in grid.corners.keys() {
            if let Some(placing) = self.vote(image, grid, cell) {
                *votes.entry(placing).or_default() += 1;
            }
        }
        let Some((&placing, &most)) = votes.iter().max_by_key(|(_, n)| **n) else {
            return Ok(None);
        };
        let read = votes.values().sum::<usize>();
        if (most as f64) < LEAST_AGREEING * read as f64 {
            return Err(NotFound::OtherLayout { read, agreeing: most });
        }
        let second = votes.iter().filter(|(p, _)| **p != placing).map(|(_, n)| *n).max();
        let bits = self.dictionary.side().pow(2);
        let enough = most > second.unwrap_or(0) && (most > 1 || bits > PROOF_BITS);
        Ok(enough.then_some(placing))
    }

    /// Reads the marker in the cell right below a corner.
    fn vote(&self, image: &GrayImage, grid: &Grid, (i, j): (i32, i32)) -> Option<Placing> {
        let at = |k| grid.corners.get(&k).copied();
        let quad = [at((i, j))?, at((i + 1, j))?, at((i + 1, j + 1))?, at((i, j + 1))?];
        let h = homography::from_unit_square(&quad);
        let inset = |x: f64| 0.5 + (x - 0.5) * self.share;
        let bits = (self.dictionary.side(), self.border);
        let greys = markers::Greys::of(image, bits, |x, y| {
            homography::apply(&h, &Vector2::new(inset(x), inset(y)))
        })?;
        let cells = greys.read();
        if cells.border_errors > MOST_BORDER_ERRORS || cells.contrast < LEAST_CONTRAST {
            return None;
        }
        let errors = if self.dictionary.side() > 4 { 2 } else { 0 };
        let reading = self.dictionary.read(cells.code, self.markers(), errors)?;
        let turns = (reading.turns + self.turns) % 4;
        // the cell's first corner on the board is the one that was its first before turning
        let (x, y) = self.cells[(reading.id - self.first) as usize];
        let first = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)][turns];
        let (a, b) = turned_back(first, turns);
        Some(Placing { turns, shift: (x - a, y - b) })
    }
}

#[cfg(test)]
mod tests;
