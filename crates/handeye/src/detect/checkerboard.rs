//! A checkerboard is known by its extent, its sense of rotation and its colours.
//!
//! It is turned so that the square outside of corner 0 is black if that can be (OpenCV's
//! findChessboardCorners does so, its findChessboardCornersSB the opposite), and else so that corner 0
//! is the one nearest to the image's top left.

use std::collections::BTreeMap;

use super::{
    fits::{Fits, corner, sorted},
    grid::Grid,
    partial,
};
use crate::{
    GrayImage, TargetModel,
    detect::{
        outcome::{NotFound, Outcome},
        partial::{first_square_brightness, turned},
    },
};

/// Of a board in full extent this share of the corners must be fitted.
const FITTED_SHARE: f64 = 0.8;
/// A grid beside a larger one may be the board when it has this share of its corners.
const LARGE_PART: f64 = 0.5;

/// Most grids that are taken for the board, one after the other.
const MOST_GRIDS: usize = 6;

/// The corners of a checkerboard in grids, the largest first. Where that is another board, one of the
/// next may be the one.
pub(super) fn label(image: &GrayImage, grids: &[Grid], target: &TargetModel) -> Outcome {
    let first = labelled(image, grids, target);
    let smaller = (1..grids.len()).take_while(|&k| first.is_err() && k < MOST_GRIDS);
    let worthwhile = |grid: &Grid| grid.corners.len() as f64 >= LARGE_PART * target.len() as f64;
    let mut others = smaller.filter(|&k| worthwhile(&grids[k]));
    let other = others.find_map(|k| labelled(image, &grids[k..], target).ok());
    other.map_or(first, Ok)
}

fn labelled(image: &GrayImage, grids: &[Grid], target: &TargetModel) -> Outcome {
    let (columns, rows) = target.grid();
    let size = (columns as i32, rows as i32);
    let fits = Fits { image, clean: 1.0, pairs: false, lines: None };
    let seen = joined(image, grids);
    let fitted = fits.all(&grow(&seen, &fits, size), &seen);
    let sure = fitted.iter().filter(|(_, f)| f.in_sight);
    let extent = Grid { corners: sure.map(|(k, f)| (*k, f.pixel)).collect() }.bounds();
    let (low, high) = extent.ok_or(NotFound::NoCorners)?;
    let inside =
        |k: &(i32, i32)| (low.0..=high.0).contains(&k.0) && (low.1..=high.1).contains(&k.1);
    let within = fitted.iter().filter(|(k, _)| inside(k));
    let known = Grid { corners: within.map(|(k, f)| (*k, f.pixel)).collect() };
    let board = match whole(image, &known, size) {
        Ok(board) => board,
        Err(reason) => partial::on_board(image, &known, target).ok_or(reason)?,
    };
    // places tell which corner is which, labels have changed
    let corners = fitted.values().filter_map(|fit| {
        let (k, _) = board.corners.iter().find(|(_, p)| **p == fit.pixel)?;
        Some(corner(target.id_at(k.0 as u32, k.1 as u32)?, fit))
    });
    Ok(sorted(corners.collect()))
}

/// A board of which nearly all corners are seen.
fn whole(image: &GrayImage, known: &Grid, board: (i32, i32)) -> Result<Grid, NotFound> {
    let (i0, j0, width, height) = best_window(known, board)?;
    let inside =
        |k: &(i32, i32)| (0..width).contains(&(k.0 - i0)) && (0..height).contains(&(k.1 - j0));
    let seen = known.corners.iter().filter(|(k, _)| inside(k));
    let seen = Grid { corners: seen.map(|(k, p)| ((k.0 - i0, k.1 - j0), *p)).collect() };
    let turns = turns_of_board(image, &seen, (width, height), board).ok_or(NotFound::NoCorners)?;
    Ok(seen.relabel(|k| turned(k, (width, height), turns)))
}

/// The largest grid and those that continue it beyond a gap.
fn joined(image: &GrayImage, grids: &[Grid]) -> Grid {
    let Some((largest, others)) = grids.split_first() else { return Grid::default() };
    let mut all = largest.clone();
    for other in others {
        if let Some(more) = all.continued(other) {
            let same = |grid| first_square_brightness(image, grid).is_sign_positive();
            if same(&all) == same(&more) {
                all.corners.extend(more.corners);
            }
        }
    }
    all
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
        return Err(NotFound::PartOfBoard { found: grid.corners.len().min(needed), needed });
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
