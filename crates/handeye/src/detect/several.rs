//! Several targets in one image.

use nalgebra::Vector2;

use super::{
    board::{self},
    grid::Grid,
    strays::without_strays,
};
use crate::{
    GrayImage, ImageCorner, Intrinsics, TargetModel, detect::outcome::Outcome,
    model::target::look::Look,
};

/// A corner of a grid is one of a board that was found when it lies this near to it, over the least
/// distance between that board's corners.
const SAME: f64 = 0.3;
/// A grid is taken when more than this share of its corners is.
const TAKEN: f64 = 0.5;

/// The corners of each of several targets, in the order of `targets`: as
/// [`detect_with`](super::detect_with) for each, but what is one board is not taken for another one.
///
/// Boards with markers are looked for first, then checkerboards, the larger ones first.
///
/// Targets that cannot be told apart, see [`TargetModel::mistaken_for`], are not told apart.
pub fn detect_several(
    image: &GrayImage,
    targets: &[&TargetModel],
    camera: Option<&Intrinsics>,
) -> Vec<Outcome> {
    let mut order: Vec<usize> = (0..targets.len()).collect();
    let is_plain = |k: usize| matches!(targets[k].look(), Look::Squares);
    order.sort_by_key(|&k| (is_plain(k), std::cmp::Reverse(targets[k].len())));
    let mut boards: Vec<Vec<ImageCorner>> = vec![];
    let mut found: Vec<(usize, Outcome)> = vec![];
    for k in order {
        let outcome = if is_plain(k) && !boards.is_empty() {
            let found = board::search(image, targets[k], &|grids| free(grids, &boards));
            without_strays(found, targets[k], (image.width(), image.height()), camera)
        } else {
            board::detect_with(image, targets[k], camera)
        };
        boards.extend(outcome.iter().cloned());
        found.push((k, outcome));
    }
    found.sort_by_key(|(k, _)| *k);
    found.into_iter().map(|(_, outcome)| outcome).collect()
}

/// The grids that are none of the boards.
fn free(mut grids: Vec<Grid>, boards: &[Vec<ImageCorner>]) -> Vec<Grid> {
    let taken: Vec<Taken> = boards.iter().map(|board| Taken::of(board)).collect();
    grids.retain(|grid| {
        let is_taken = |p: &&Vector2<f64>| taken.iter().any(|board| board.has(p));
        let count = grid.corners.values().filter(is_taken).count();
        (count as f64) <= TAKEN * grid.corners.len() as f64
    });
    grids
}

/// The corners of a board, and how near to them nothing else can be, px.
struct Taken<'a> {
    corners: &'a [ImageCorner],
    near: f64,
}

impl<'a> Taken<'a> {
    fn of(corners: &'a [ImageCorner]) -> Self {
        let distance = |a: usize, b: usize| (corners[a].pixel - corners[b].pixel).norm();
        let pairs = (0..corners.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let least = pairs.map(|(a, b)| distance(a, b)).fold(f64::INFINITY, f64::min);
        Self { corners, near: SAME * least }
    }

    fn has(&self, pixel: &Vector2<f64>) -> bool {
        self.corners.iter().any(|c| (c.pixel - pixel).norm() < self.near)
    }
}

#[cfg(test)]
mod tests;
