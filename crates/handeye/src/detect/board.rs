//! Which corner of the board each corner in the picture is.
//!
//! A checkerboard is known by its extent, its sense of rotation and its colours: it is turned so
//! that the square outside of corner 0 is black if that can be (OpenCV's findChessboardCorners does
//! so, its findChessboardCornersSB the opposite), and else so that corner 0 is the one nearest to
//! the picture's top left. A ChArUco board is known by its markers: each one that
//! is read votes for a turn and a shift of the grid.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::circles;
use super::grid::Grid;
use super::homography;
use super::markers::{self, Dictionary, bilinear};
use super::mesh;
use super::pyramid::{Scaled, smoothed};
use super::subpixel::{self, FittedCorner, NearCorner, RoughCorner};
use super::tag;
use crate::{GrayImage, ImageCorner, TargetModel};

/// Why no target was found.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NotFound {
    /// Nothing fits into such a picture.
    #[error("the image is {width} x {height} pixels, smaller than a board can be")]
    SmallImage {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Nothing that looks like a board.
    #[error("no corners at all")]
    NoCorners,
    /// A part of the board only.
    #[error("{found} of {needed} corners found")]
    TooFew {
        /// Corners of the largest grid.
        found: usize,
        /// Corners of the board.
        needed: usize,
    },
    /// A grid of the wrong size.
    #[error(
        "a grid of {columns} x {rows} corners found, the board has {wanted_columns} x \
         {wanted_rows}: is the target declared as it is?"
    )]
    OtherSize {
        /// Columns of the grid.
        columns: u32,
        /// Rows of the grid.
        rows: u32,
        /// Columns of the board.
        wanted_columns: u32,
        /// Rows of the board.
        wanted_rows: u32,
    },
    /// A grid whose markers could not be read.
    #[error(
        "{corners} corners found, but no marker of {dictionary} that belongs to the board: check \
         dictionary, numbers of squares and layout"
    )]
    NoMarkers {
        /// Corners of the largest grid.
        corners: usize,
        /// The declared dictionary.
        dictionary: String,
    },
    /// No dark square with the tag's bits in it.
    #[error("no tag {id} of {dictionary}: check dictionary and id; it needs white around it")]
    NoTag {
        /// The declared dictionary.
        dictionary: String,
        /// The declared tag.
        id: u32,
    },
    /// The tag was read, but one of its edges is no straight line.
    #[error("tag {id} of {dictionary} is there, but its edges are too blurred or covered")]
    BlurredTag {
        /// The declared dictionary.
        dictionary: String,
        /// The declared tag.
        id: u32,
    },
    /// A dictionary that does not exist.
    #[error("unknown marker dictionary {0}")]
    UnknownDictionary(String),
    /// Circles that are not the board.
    #[error("{found} circles found, but no grid of {columns} x {rows} among them")]
    NoGrid {
        /// Circles of the largest group.
        found: usize,
        /// Columns of the board.
        columns: u32,
        /// Rows of the board.
        rows: u32,
    },
    /// A target whose corners must be imported.
    #[error("{0} cannot be detected yet: import its corners")]
    Unsupported(&'static str),
    /// A target without corners.
    #[error("a ball cannot be found in pictures: it is found in 3D scans only")]
    ScansOnly,
}

/// Smallest side of a picture (px) with a board of 2 x 2 corners in it.
const SMALLEST_IMAGE: usize = 24;

/// The target's corners in a picture, in the order of their ids. Pixels; the centre of the top-left
/// pixel is (0, 0).
///
/// A checkerboard must be wholly in the picture (single corners may be hidden); of a ChArUco board
/// a part is enough.
pub fn detect(image: &GrayImage, target: &TargetModel) -> Result<Vec<ImageCorner>, NotFound> {
    let (width, height) = (image.width(), image.height());
    if width.min(height) < SMALLEST_IMAGE {
        return Err(NotFound::SmallImage { width, height });
    }
    if let TargetModel::Tag { dictionary, id, .. } = target {
        return tag::detect(image, dictionary, *id);
    }
    if target.has_circles() {
        return circles::detect(image, target);
    }
    let family = Family::of(target)?;
    let mut best = Err(NotFound::NoCorners);
    let mut since = 0;
    for level in levels(image) {
        let found: Vec<Grid> = mesh::grids(&smoothed(&level.image));
        let grids: Vec<Grid> = found.iter().map(|g| g.map(|p| level.original(p))).collect();
        let found = family.label(image, &grids);
        since = if worth(&found) > worth(&best) { 0 } else { since + 1 };
        best = better(best, found);
        let complete = best.as_ref().is_ok_and(|corners| corners.len() == target.len());
        if complete || (best.is_ok() && since > 0) {
            break;
        }
    }
    best
}

/// Longest side of the smallest level, px, at most.
const COARSEST: usize = 900;
/// Larger pictures (px) are not doubled: their squares are large enough, and memory is finite.
const MOST_TO_DOUBLE: usize = 4_000_000;

/// The picture at half sizes, the smallest first, and last doubled.
fn levels(image: &GrayImage) -> impl Iterator<Item = Scaled<'_>> {
    let halves = Scaled::halves(image, |half| half.width().max(half.height()) <= COARSEST);
    let small = image.width() * image.height() <= MOST_TO_DOUBLE;
    let doubled = small.then_some(image).into_iter().map(Scaled::doubled);
    halves.chain(doubled)
}

type Outcome = Result<Vec<ImageCorner>, NotFound>;

/// The outcome with more corners; of two failures the one that says more.
fn better(a: Outcome, b: Outcome) -> Outcome {
    if worth(&b) > worth(&a) { b } else { a }
}

fn worth(outcome: &Outcome) -> (u32, usize) {
    match outcome {
        Ok(corners) => (2, corners.len()),
        Err(NotFound::TooFew { found, .. }) => (1, *found),
        Err(NotFound::NoMarkers { corners, .. }) => (1, *corners),
        Err(NotFound::OtherSize { columns, rows, .. }) => (1, (columns * rows) as usize),
        Err(_) => (0, 0),
    }
}

/// The targets that are found by their grid of corners.
enum Family {
    Checkerboard { columns: i32, rows: i32 },
    Charuco(Charuco),
}

struct Charuco {
    squares: (i32, i32),
    share: f64,
    name: String,
    dictionary: Dictionary,
    /// The square of each marker.
    square_of: Vec<(i32, i32)>,
}

impl Family {
    fn of(target: &TargetModel) -> Result<Self, NotFound> {
        match target {
            &TargetModel::Checkerboard { columns, rows, .. } => {
                Ok(Self::Checkerboard { columns: columns as i32, rows: rows as i32 })
            }
            TargetModel::Charuco {
                squares_x,
                squares_y,
                square_mm,
                marker_mm,
                dictionary: name,
                legacy,
            } => {
                let unknown = || NotFound::UnknownDictionary(name.clone());
                let dictionary = Dictionary::named(name).ok_or_else(unknown)?;
                let white_first = *legacy && squares_y % 2 == 0;
                Ok(Self::Charuco(Charuco {
                    squares: (*squares_x as i32, *squares_y as i32),
                    share: marker_mm / square_mm,
                    name: name.clone(),
                    dictionary,
                    square_of: marker_squares(
                        *squares_x as usize,
                        *squares_y as usize,
                        white_first,
                    ),
                }))
            }
            TargetModel::Sphere { .. } => Err(NotFound::ScansOnly),
            TargetModel::Aprilgrid { .. } | TargetModel::TagGrid { .. } => {
                Err(NotFound::Unsupported("a grid of tags"))
            }
            // a tag has no grid: it was looked for before
            _ => Err(NotFound::Unsupported("a grid of circles")),
        }
    }

    fn label(&self, image: &GrayImage, grids: &[Grid]) -> Outcome {
        let largest = grids.first().ok_or(NotFound::NoCorners)?;
        match self {
            &Self::Checkerboard { columns, rows } => checkerboard(image, largest, columns, rows),
            Self::Charuco(board) => board.label(image, grids),
        }
    }
}

fn marker_squares(squares_x: usize, squares_y: usize, white_first: bool) -> Vec<(i32, i32)> {
    let squares = (0..squares_y).flat_map(|j| (0..squares_x).map(move |i| (i, j)));
    squares
        .filter(|&(i, j)| markers::marker_of_square(i, j, squares_x, white_first).is_some())
        .map(|(i, j)| (i as i32, j as i32))
        .collect()
}

// ---------------------------------------------------------------- checkerboard

/// Of a board in full extent this share of the corners must be fitted.
const FITTED_SHARE: f64 = 0.8;

fn checkerboard(image: &GrayImage, grid: &Grid, columns: i32, rows: i32) -> Outcome {
    let fits = Fits { image, clean: 1.0 };
    let grown = grow(grid, &fits, (columns, rows));
    let fitted = fits.all(&grown);
    let known = Grid { corners: fitted.iter().map(|(k, f)| (*k, f.pixel)).collect() };
    let window = best_window(&known, (columns, rows))?;
    let (i0, j0, width, height) = window;
    let inside =
        |k: &(i32, i32)| (0..width).contains(&(k.0 - i0)) && (0..height).contains(&(k.1 - j0));
    let origin = known.corners.iter().filter(|(k, _)| inside(k));
    let board = Grid { corners: origin.map(|(k, p)| ((k.0 - i0, k.1 - j0), *p)).collect() };
    let turns = turns_of_board(image, &board, (width, height), (columns, rows));
    let turns = turns.ok_or(NotFound::NoCorners)?;
    let corners = board.corners.keys().map(|&(i, j)| {
        let (x, y) = turned((i, j), (width, height), turns);
        corner((y * columns + x) as u32, &fitted[&(i + i0, j + j0)])
    });
    Ok(sorted(corners.collect()))
}

/// The part of a grid that is the board: first column and row, columns, rows. Larger grids arise
/// where something beside the board looks like corners; the board is the fullest part.
fn best_window(grid: &Grid, (columns, rows): (i32, i32)) -> Result<(i32, i32, i32, i32), NotFound> {
    let needed = (columns * rows) as usize;
    let (low, high) = grid.bounds().ok_or(NotFound::NoCorners)?;
    let mut windows = vec![];
    let mut sizes = vec![(columns, rows), (rows, columns)];
    sizes.dedup();
    for (width, height) in sizes {
        for j in low.1..=high.1 - height + 1 {
            for i in low.0..=high.0 - width + 1 {
                let keys = (j..j + height).flat_map(|y| (i..i + width).map(move |x| (x, y)));
                let count = keys.filter(|k| grid.corners.contains_key(k)).count();
                windows.push((count, (i, j, width, height)));
            }
        }
    }
    windows.sort_by_key(|w| std::cmp::Reverse(w.0));
    let fullest = windows.first().map_or(0, |w| w.0);
    if (fullest as f64) < FITTED_SHARE * needed as f64 {
        return Err(NotFound::TooFew { found: grid.corners.len().min(needed), needed });
    }
    if windows.get(1).is_some_and(|second| second.0 >= fullest) {
        return Err(NotFound::OtherSize {
            columns: (high.0 - low.0 + 1) as u32,
            rows: (high.1 - low.1 + 1) as u32,
            wanted_columns: columns as u32,
            wanted_rows: rows as u32,
        });
    }
    Ok(windows[0].1)
}

fn corner(id: u32, fitted: &FittedCorner) -> ImageCorner {
    ImageCorner { id, pixel: fitted.pixel, covariance: fitted.covariance }
}

fn sorted(mut corners: Vec<ImageCorner>) -> Vec<ImageCorner> {
    corners.sort_by_key(|c| c.id);
    corners
}

/// Clockwise quarter turns of the labels after which the grid lies as the board does.
fn turns_of_board(
    image: &GrayImage,
    grid: &Grid,
    size: (i32, i32),
    board: (i32, i32),
) -> Option<usize> {
    let fits = |turns: &usize| {
        if turns.is_multiple_of(2) { size == board } else { (size.1, size.0) == board }
    };
    let relabelled = |turns: usize| grid.relabel(|k| turned(k, size, turns));
    let all: Vec<usize> = (0..4).filter(fits).collect();
    let is_black = |turns: &usize| first_square_brightness(image, &relabelled(*turns)) < 0.0;
    let black: Vec<usize> = all.iter().copied().filter(is_black).collect();
    let allowed = if black.is_empty() { all } else { black };
    let from_top_left = |turns: usize| {
        let near = relabelled(turns).corners.into_iter().min_by_key(|((i, j), _)| i + j);
        near.map_or(f64::INFINITY, |(_, p)| p.x + p.y)
    };
    allowed.into_iter().min_by(|&a, &b| from_top_left(a).total_cmp(&from_top_left(b)))
}

/// A label of a grid of `size`, after quarter turns.
fn turned(label: (i32, i32), size: (i32, i32), turns: usize) -> (i32, i32) {
    let quarter = |((i, j), (width, height)): ((i32, i32), (i32, i32))| {
        ((height - 1 - j, i), (height, width))
    };
    (0..turns).fold((label, size), |at, _| quarter(at)).0
}

/// Grey of the squares with the colour of the one outside of corner (0, 0), minus that of the
/// others.
fn first_square_brightness(image: &GrayImage, grid: &Grid) -> f64 {
    let one = |(&(i, j), p): (&(i32, i32), &Vector2<f64>)| {
        let (u, v) = (grid.step((i, j), (1, 0))?, grid.step((i, j), (0, 1))?);
        let grey = |a: f64, b: f64| bilinear(image, &(p + (u * a + v * b) * 0.35));
        let own = grey(-1.0, -1.0)? + grey(1.0, 1.0)?;
        let other = grey(1.0, -1.0)? + grey(-1.0, 1.0)?;
        Some(if (i + j) % 2 == 0 { own - other } else { other - own })
    };
    grid.corners.iter().filter_map(one).sum()
}

/// Sub-pixel fits in one picture.
struct Fits<'a> {
    image: &'a GrayImage,
    clean: f64,
}

impl Fits<'_> {
    /// The corner of a label, and the steps to its neighbours.
    fn rough(&self, grid: &Grid, label: (i32, i32)) -> Option<RoughCorner> {
        let step = |d| grid.step(label, d).or_else(|| grid.mean_step(d));
        Some(RoughCorner {
            pixel: *grid.corners.get(&label)?,
            along_x: step((1, 0))?,
            along_y: step((0, 1))?,
            clean: self.clean,
        })
    }

    /// All corners. First every one is approached; then the steps between them are known well enough
    /// to measure each with a disc that does not depend on where the search began.
    fn all(&self, grid: &Grid) -> BTreeMap<(i32, i32), FittedCorner> {
        let near = |&k: &(i32, i32)| {
            Some((k, subpixel::approach(self.image, &self.rough(grid, k)?).ok()?))
        };
        let near: BTreeMap<(i32, i32), NearCorner> = grid.corners.keys().filter_map(near).collect();
        let grid = Grid { corners: near.iter().map(|(k, n)| (*k, n.pixel)).collect() };
        let measured = |(k, near): (&(i32, i32), &NearCorner)| {
            let rough = self.rough(&grid, *k)?;
            Some((*k, subpixel::measure(self.image, &rough, near).ok()?))
        };
        near.iter().filter_map(measured).collect()
    }

    /// The corner that the neighbours predict, if the picture has one there.
    fn predicted(&self, grid: &Grid, label: (i32, i32)) -> Option<Vector2<f64>> {
        let mut with = grid.clone();
        with.corners.insert(label, grid.predict(label)?);
        subpixel::fit(self.image, &self.rough(&with, label)?).ok().map(|fitted| fitted.pixel)
    }
}

/// Adds corners that the finder missed: inside the grid, and rows at its rim while it is smaller
/// than the board.
fn grow(grid: &Grid, fits: &Fits, (columns, rows): (i32, i32)) -> Grid {
    let mut grid = grid.clone();
    for _ in 0..columns.max(rows) {
        let Some((low, high)) = grid.bounds() else { break };
        let (width, height) = (high.0 - low.0 + 1, high.1 - low.1 + 1);
        let (short, long) = (columns.min(rows), columns.max(rows));
        // the grid may lie across
        let rim_x = i32::from(width < if height > short { short } else { long });
        let rim_y = i32::from(height < if width > short { short } else { long });
        let mut added = BTreeMap::new();
        for j in low.1 - rim_y..=high.1 + rim_y {
            for i in low.0 - rim_x..=high.0 + rim_x {
                if !grid.corners.contains_key(&(i, j))
                    && let Some(at) = fits.predicted(&grid, (i, j))
                {
                    added.insert((i, j), at);
                }
            }
        }
        if added.is_empty() {
            break;
        }
        grid.corners.append(&mut added);
    }
    grid
}

// --------------------------------------------------------------------- ChArUco

/// Border cells of a marker that may look white.
const MOST_BORDER_ERRORS: u32 = 3;
/// Least contrast of a marker, grey values.
const LEAST_CONTRAST: f64 = 12.0;
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

impl Charuco {
    fn label(&self, image: &GrayImage, grids: &[Grid]) -> Outcome {
        let fits = Fits { image, clean: 0.5 * (1.0 - self.share) };
        let mut board = Grid::default();
        for grid in grids {
            if let Some(placing) = self.placing(image, grid) {
                let placed = grid.relabel(|k| placing.on_board(k));
                let inside = placed.corners.into_iter().filter(|(k, _)| self.has(*k));
                for (label, at) in inside {
                    board.corners.entry(label).or_insert(at); // larger grids come first
                }
            }
        }
        if board.corners.is_empty() {
            let corners = grids.first().map_or(0, |g| g.corners.len());
            return Err(NotFound::NoMarkers { corners, dictionary: self.name.clone() });
        }
        self.fill(&mut board, &fits);
        let columns = self.squares.0 - 1;
        let fitted = fits.all(&board);
        let corners =
            fitted.iter().map(|(&(i, j), f)| corner(((j - 1) * columns + i - 1) as u32, f));
        let corners: Vec<_> = corners.collect();
        if corners.len() < FEWEST_CORNERS {
            let needed = (columns * (self.squares.1 - 1)) as usize;
            return Err(NotFound::TooFew { found: corners.len(), needed });
        }
        Ok(sorted(corners))
    }

    /// Whether the board has an inner corner there, counted from its outer corner.
    fn has(&self, (i, j): (i32, i32)) -> bool {
        i > 0 && j > 0 && i < self.squares.0 && j < self.squares.1
    }

    fn fill(&self, board: &mut Grid, fits: &Fits) {
        loop {
            let missing = (1..self.squares.1)
                .flat_map(|j| (1..self.squares.0).map(move |i| (i, j)))
                .filter(|k| !board.corners.contains_key(k));
            let mut added: BTreeMap<_, _> =
                missing.filter_map(|k| Some((k, fits.predicted(board, k)?))).collect();
            if added.is_empty() {
                return;
            }
            board.corners.append(&mut added);
        }
    }

    /// The placing most markers vote for.
    fn placing(&self, image: &GrayImage, grid: &Grid) -> Option<Placing> {
        let mut votes: BTreeMap<Placing, u32> = BTreeMap::new();
        for &cell in grid.corners.keys() {
            if let Some(placing) = self.vote(image, grid, cell) {
                *votes.entry(placing).or_default() += 1;
            }
        }
        let (&placing, &most) = votes.iter().max_by_key(|(_, n)| **n)?;
        let second = votes.iter().filter(|(p, _)| **p != placing).map(|(_, n)| *n).max();
        let bits = self.dictionary.side().pow(2);
        let enough = most > second.unwrap_or(0) && (most > 1 || bits > PROOF_BITS);
        enough.then_some(placing)
    }

    /// Reads the marker in the cell right below a corner.
    fn vote(&self, image: &GrayImage, grid: &Grid, (i, j): (i32, i32)) -> Option<Placing> {
        let at = |k| grid.corners.get(&k).copied();
        let quad = [at((i, j))?, at((i + 1, j))?, at((i + 1, j + 1))?, at((i, j + 1))?];
        let h = homography::from_unit_square(&quad);
        let inset = |x: f64| 0.5 + (x - 0.5) * self.share;
        let cells = markers::read_cells(image, self.dictionary.side(), |x, y| {
            homography::apply(&h, &Vector2::new(inset(x), inset(y)))
        })?;
        if cells.border_errors > MOST_BORDER_ERRORS || cells.contrast < LEAST_CONTRAST {
            return None;
        }
        let errors = if self.dictionary.side() > 4 { 2 } else { 0 };
        let reading = self.dictionary.read(cells.code, 0..self.square_of.len() as u32, errors)?;
        // the cell's outer corner on the board is the one that was its first before turning
        let (x, y) = self.square_of[reading.id as usize];
        let first = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)][reading.turns];
        let (a, b) = turned_back(first, reading.turns);
        Some(Placing { turns: reading.turns, shift: (x - a, y - b) })
    }
}

/// Fewer corners do not determine a pose.
const FEWEST_CORNERS: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::{Optics, Random, Scene};
    use crate::{Distortion, Intrinsics, Pose};
    use nalgebra::{Matrix3, Vector3, Vector6};

    fn charuco(squares_x: u32, squares_y: u32, legacy: bool) -> TargetModel {
        TargetModel::Charuco {
            squares_x,
            squares_y,
            square_mm: 20.0,
            marker_mm: 14.0,
            dictionary: "DICT_5X5_100".into(),
            legacy,
        }
    }

    fn checkerboard(columns: u32, rows: u32) -> TargetModel {
        TargetModel::Checkerboard { columns, rows, square_mm: 20.0 }
    }

    /// The board in the middle of the picture, turned in its plane by `roll` and tilted a little.
    fn scene(target: &TargetModel, roll: f64, depth: f64) -> Scene {
        let corners = target.corners();
        let centre =
            corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>() / corners.len() as f64;
        let turn = Vector6::new(0.0, 0.0, roll, 0.0, 0.0, 0.0);
        let tilt = Vector6::new(0.3, -0.2, 0.0, 0.0, 0.0, 0.0);
        let away = Pose::from_parts(&Matrix3::identity(), Vector3::new(0.0, 0.0, depth));
        let back = Vector6::new(0.0, 0.0, 0.0, -centre.x, -centre.y, 0.0);
        let brown = [-0.15, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let pinhole = Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5);
        Scene {
            target: target.clone(),
            camera_from_target: away.retract(&tilt).retract(&turn).retract(&back),
            intrinsics: Intrinsics { distortion: Distortion::BrownConrady(brown), ..pinhole },
        }
    }

    /// Largest distance between corners and truth, px.
    fn farthest(scene: &Scene, found: &[ImageCorner]) -> f64 {
        let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
        found.iter().map(|c| (c.pixel - truth[&c.id]).norm()).fold(0.0, f64::max)
    }

    #[test]
    fn every_turn_of_an_unambiguous_checkerboard_keeps_its_ids() {
        let target = checkerboard(9, 6);
        for k in 0..8 {
            let scene = scene(&target, 0.8 * f64::from(k), 0.45);
            let found = detect(&scene.picture(&Optics::default(), k as u64), &target).unwrap();
            assert_eq!(found.len(), 54);
            assert!(farthest(&scene, &found) < 0.1, "turn {k}: {}", farthest(&scene, &found));
        }
    }

    #[test]
    fn a_symmetric_checkerboard_is_found_up_to_its_symmetry() {
        for target in [checkerboard(8, 6), checkerboard(7, 7), checkerboard(6, 6)] {
            for k in 0..4 {
                let scene = scene(&target, 0.2 + 1.5 * f64::from(k), 0.45);
                let found = detect(&scene.picture(&Optics::default(), 1), &target).unwrap();
                let maps = target.symmetries();
                let all = maps.iter().map(|map| super::super::relabelled(&found, map));
                let least = all.map(|c| farthest(&scene, &c)).fold(f64::INFINITY, f64::min);
                assert!(found.len() == target.len() && least < 0.1, "{target:?} {k}: {least}");
            }
        }
    }

    #[test]
    fn both_charuco_layouts_are_found_in_every_turn() {
        for target in
            [charuco(7, 5, false), charuco(6, 8, false), charuco(6, 8, true), charuco(7, 6, true)]
        {
            for k in 0..4 {
                let scene = scene(&target, 0.3 + 1.6 * f64::from(k), 0.4);
                let found = detect(&scene.picture(&Optics::default(), 2), &target).unwrap();
                assert_eq!(found.len(), target.len(), "{target:?} turn {k}");
                assert!(farthest(&scene, &found) < 0.1, "{target:?} {k}");
            }
        }
    }

    #[test]
    fn a_part_of_a_charuco_board_is_enough() {
        let target = charuco(9, 7, false);
        let mut scene = scene(&target, 0.1, 0.35);
        let aside = Pose::from_parts(&Matrix3::identity(), Vector3::new(0.12, 0.05, 0.0));
        scene.camera_from_target = aside * scene.camera_from_target;
        let found = detect(&scene.picture(&Optics::default(), 3), &target).unwrap();
        assert!(found.len() > 10 && found.len() < 48, "{}", found.len());
        assert!(farthest(&scene, &found) < 0.15);
    }

    #[test]
    fn the_wrong_layout_or_dictionary_is_named() {
        let picture = scene(&charuco(6, 8, false), 0.1, 0.4).picture(&Optics::default(), 4);
        let mut other = charuco(6, 8, false);
        if let TargetModel::Charuco { dictionary, .. } = &mut other {
            *dictionary = "DICT_7X7_100".into();
        }
        let error = detect(&picture, &other).unwrap_err();
        assert!(error.to_string().contains("no marker of DICT_7X7_100"), "{error}");
        if let TargetModel::Charuco { dictionary, .. } = &mut other {
            *dictionary = "DICT_NONSENSE".into();
        }
        assert_eq!(
            detect(&picture, &other),
            Err(NotFound::UnknownDictionary("DICT_NONSENSE".into()))
        );
    }

    #[test]
    fn a_board_of_another_size_is_named() {
        let picture = scene(&checkerboard(9, 6), 0.1, 0.45).picture(&Optics::default(), 5);
        let error = detect(&picture, &checkerboard(7, 5)).unwrap_err();
        assert!(error.to_string().contains("9 x 6"), "{error}");
        let error = detect(&picture, &checkerboard(11, 8)).unwrap_err();
        assert_eq!(error.to_string(), "54 of 88 corners found");
    }

    #[test]
    fn a_hidden_corner_hides_no_board() {
        let target = checkerboard(9, 6);
        let scene = scene(&target, 0.1, 0.45);
        let picture = scene.picture(&Optics::default(), 6);
        let hidden = scene.corners()[22].1;
        let (width, height) = (picture.width(), picture.height());
        let values = picture.values().iter().enumerate().map(|(k, v)| {
            let at = Vector2::new((k % width) as f64, (k / width) as f64);
            if (at - hidden).norm() < 12.0 { 250.0 } else { *v }
        });
        let picture = GrayImage::new(width, height, values.collect()).unwrap();
        let found = detect(&picture, &target).unwrap();
        assert!(found.len() >= 53 - 4 && found.iter().all(|c| c.id != 22), "{}", found.len());
        assert!(farthest(&scene, &found) < 0.2);
    }

    #[test]
    fn pictures_without_a_board_say_so() {
        let target = checkerboard(9, 6);
        let dot = GrayImage::new(1, 1, vec![7.0]).unwrap();
        let error = detect(&dot, &target).unwrap_err().to_string();
        assert_eq!(error, "the image is 1 x 1 pixels, smaller than a board can be");
        for (width, height) in [(24, 24), (25, 301), (640, 480)] {
            let flat = GrayImage::new(width, height, vec![128.0; width * height]).unwrap();
            assert_eq!(detect(&flat, &target), Err(NotFound::NoCorners));
            let mut random = Random::new(9);
            let noise = (0..width * height).map(|_| random.between(0.0, 255.0) as f32).collect();
            assert!(detect(&GrayImage::new(width, height, noise).unwrap(), &target).is_err());
        }
        let broken = GrayImage::new(64, 64, vec![f32::NAN; 4096]).unwrap();
        assert!(detect(&broken, &charuco(7, 5, false)).is_err());
    }

    /// A checkerboard of whole black and white pixels, as a rasterised print has it.
    fn raster(columns: usize, rows: usize, cell: f64, margin: f64) -> GrayImage {
        let size = |n: usize| (2.0 * margin + cell * (n + 1) as f64).ceil() as usize;
        let (width, height) = (size(columns), size(rows));
        let index = |x: usize| ((x as f64 + 0.5 - margin) / cell).floor() as i64;
        let grey = |x: usize, y: usize| {
            let inside = |k: i64, n: usize| (0..=n as i64).contains(&k);
            let board = inside(index(x), columns) && inside(index(y), rows);
            if board && (index(x) + index(y)) % 2 == 0 { 0.0 } else { 255.0 }
        };
        let pixels = (0..width * height).map(|k| grey(k % width, k / width)).collect();
        GrayImage::new(width, height, pixels).unwrap()
    }

    #[test]
    fn a_perfectly_sharp_print_shows_all_corners() {
        for cell in [20.0, 29.53, 47.24, 59.06, 118.11, 147.64, 177.17] {
            for margin in [30.0, 59.37, 100.5] {
                let image = raster(8, 5, cell, margin);
                let found = detect(&image, &checkerboard(8, 5)).map(|c| c.len());
                assert_eq!(found, Ok(40), "cells of {cell} px, margin of {margin} px");
            }
        }
    }
}
