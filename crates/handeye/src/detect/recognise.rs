//! Which board images show, where nobody has said it.
//!
//! Markers tell the dictionary, and their places to one another how many squares or tags there are (`layout`); grids of
//! corners and of circles tell columns and rows. What is found so is a proposal only: the board is looked for in all
//! images as if it were declared, and of the proposals the one is kept that most corners were found of.

mod layout;

use std::{cmp::Reverse, collections::BTreeMap};

use super::{
    board, circles, mesh,
    outcome::NotFound,
    pyramid::{Scaled, smoothed},
};
use crate::{GrayImage, TargetModel};

/// A board that images show.
#[derive(Debug, Clone, PartialEq)]
pub struct Recognised {
    /// The board. Images do not tell its size: the first of its lengths is 1 mm, and the others are in proportion.
    pub target: TargetModel,
    /// In how many of the images it is found.
    pub images: usize,
}

/// Share of the images that must show the board.
const LEAST_IMAGES: f64 = 0.5;
/// Share of the board's corners that an image must show.
const LEAST_CORNERS: f64 = 0.4;
/// Share of its columns and rows that a grid of corners must fill to tell how many there are.
const LEAST_FULL: f64 = 0.8;
/// Fewer columns or rows are no board.
const FEWEST: u32 = 2;
/// Most sizes of checkerboards that are tried.
const MOST_SIZES: usize = 6;
/// Longest side of the smallest images in which grids are looked for, px, at most.
const COARSEST: usize = 450;

/// The board that most of the images show; `None` where none is found in half of them.
///
/// Checkerboards, ChArUco boards, AprilGrids, grids of tags and of circles, and single tags are known. A few images
/// from all over the session are enough.
pub fn recognise(images: &[GrayImage]) -> Option<Recognised> {
    // smaller ones show no board
    let is_large = |image: &&GrayImage| image.width().min(image.height()) >= board::SMALLEST_IMAGE;
    let images: &[&GrayImage] = &images.iter().filter(is_large).collect::<Vec<_>>();
    let markers = layout::read_all(images);
    best(images, layout::boards(&markers, images))
        .or_else(|| best(images, circle_grids(images)))
        .or_else(|| best(images, checkerboards(images)))
        .or_else(|| best(images, layout::single_tags(&markers, LEAST_IMAGES * images.len() as f64)))
}

/// The proposal of which most corners are found, if it is in enough images.
fn best(images: &[&GrayImage], proposals: Vec<TargetModel>) -> Option<Recognised> {
    let counted = proposals.into_iter().filter_map(|target| {
        let least = LEAST_CORNERS * target.len() as f64;
        let found = images.iter().filter_map(|image| board::detect(image, &target).ok());
        let found: Vec<usize> = found.map(|c| c.len()).filter(|n| *n as f64 >= least).collect();
        let is_shown =
            !found.is_empty() && found.len() as f64 >= LEAST_IMAGES * images.len() as f64;
        is_shown.then(|| (found.iter().sum::<usize>(), Recognised { target, images: found.len() }))
    });
    // of equals the first
    counted.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, found)| found)
}

/// Checkerboards of the sizes that grids of corners have, the most frequent first; columns along the longer side.
fn checkerboards(images: &[&GrayImage]) -> Vec<TargetModel> {
    let mut sizes: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for image in images {
        for size in grid_sizes(image) {
            *sizes.entry(size).or_default() += 1;
        }
    }
    let mut sizes: Vec<_> = sizes.into_iter().collect();
    sizes.sort_by_key(|&((columns, rows), count)| Reverse((count, columns * rows)));
    let board = |((columns, rows), _)| TargetModel::Checkerboard { columns, rows, square_mm: 1.0 };
    sizes.into_iter().take(MOST_SIZES).map(board).collect()
}

/// Columns and rows of the largest grid at each scale, where it is nearly full.
fn grid_sizes(image: &GrayImage) -> Vec<(u32, u32)> {
    let halves = Scaled::halves(image, |half| half.width().max(half.height()) <= COARSEST);
    let mut sizes: Vec<(u32, u32)> = halves
        .filter_map(|level| {
            let largest = mesh::grids(&smoothed(&level.image)).into_iter().next()?;
            let (low, high) = largest.bounds()?;
            let (width, height) = ((high.0 - low.0 + 1) as u32, (high.1 - low.1 + 1) as u32);
            let is_full = largest.corners.len() as f64 >= LEAST_FULL * f64::from(width * height);
            let size = (width.max(height), width.min(height));
            (is_full && size.1 >= FEWEST && size.0 > FEWEST).then_some(size)
        })
        .collect();
    sizes.sort_unstable();
    sizes.dedup();
    sizes
}

/// Grids of circles, of the size that a search for another one names in the first image that shows one whole.
fn circle_grids(images: &[&GrayImage]) -> Vec<TargetModel> {
    let kinds: [fn(u32, u32) -> TargetModel; 2] = [
        |columns, rows| TargetModel::CircleGrid { columns, rows, pitch_mm: 1.0 },
        |columns, rows| TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm: 1.0 },
    ];
    let shown = |image: &&GrayImage| {
        let size = |kind: &fn(u32, u32) -> TargetModel| {
            let tried = kind(FEWEST + 1, FEWEST + 1);
            match circles::detect_with(image, &tried, None) {
                Ok(_) => Some(tried),
                Err(NotFound::OtherSize { columns, rows, .. }) => Some(kind(columns, rows)),
                Err(_) => None,
            }
        };
        kinds.iter().filter_map(size).collect::<Vec<_>>()
    };
    images.iter().map(shown).find(|grids| !grids.is_empty()).unwrap_or_default()
}

#[cfg(test)]
mod tests;
