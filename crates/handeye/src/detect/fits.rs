//! All corners of a grid measured, and those found that the grid lacks.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::grid::Grid;
use super::subpixel::{self, FittedCorner, NearCorner, RoughCorner};
use crate::{GrayImage, ImageCorner};

/// About so many corners tell how sure corners usually are.
const SAMPLES: usize = 16;

/// Sub-pixel fits in one picture.
pub(super) struct Fits<'a> {
    pub image: &'a GrayImage,
    /// As in [`RoughCorner`].
    pub clean: f64,
    /// Whether markers are only between columns, and rows, `2k` and `2k + 1`.
    pub pairs: bool,
    /// Places of the columns and rows of labels on the board, in any unit; evenly spaced where there
    /// are none.
    pub lines: Option<&'a [Vec<f64>; 2]>,
}

impl Fits<'_> {
    /// Where a label is on the board.
    fn place(&self, (i, j): (i32, i32)) -> Vector2<f64> {
        let on = |lines: &[f64], k: i32| {
            let line = usize::try_from(k).ok().and_then(|k| lines.get(k));
            line.copied().unwrap_or(f64::NAN)
        };
        match self.lines {
            Some([x, y]) => Vector2::new(on(x, i), on(y, j)),
            None => Vector2::new(f64::from(i), f64::from(j)),
        }
    }

    /// The corner of a label, and the steps to its neighbours.
    fn rough(&self, grid: &Grid, label: (i32, i32)) -> Option<RoughCorner> {
        let step = |d| self.step(grid, label, d).or_else(|| self.mean_step(grid, d));
        Some(RoughCorner {
            pixel: *grid.corners.get(&label)?,
            along_x: step((1, 0))?,
            along_y: step((0, 1))?,
            clean: self.clean,
            marker: self.pairs.then(|| [label.0, label.1].map(towards_pair)),
        })
    }

    /// The board's shortest step, px, judged by the neighbours ahead and behind: the shorter of both.
    fn step(&self, grid: &Grid, at: (i32, i32), (di, dj): (i32, i32)) -> Option<Vector2<f64>> {
        let here = grid.corners.get(&at)?;
        let side = |sign: i32| {
            let next = (at.0 + sign * di, at.1 + sign * dj);
            let there = grid.corners.get(&next)?;
            let length = (self.place(next) - self.place(at)).norm();
            Some((there - here) * (f64::from(sign) * self.shortest() / length))
        };
        match (side(1), side(-1)) {
            (Some(a), Some(b)) => Some(if a.norm() < b.norm() { a } else { b }),
            (a, b) => a.or(b),
        }
    }

    fn mean_step(&self, grid: &Grid, direction: (i32, i32)) -> Option<Vector2<f64>> {
        let all = || grid.corners.keys().filter_map(|&at| self.step(grid, at, direction));
        let count = all().count();
        (count > 0).then(|| all().sum::<Vector2<f64>>() / count as f64)
    }

    /// Distance of the closest columns or rows on the board.
    fn shortest(&self) -> f64 {
        let gaps = |lines: &'_ Vec<f64>| {
            lines.windows(2).map(|w| (w[1] - w[0]).abs()).fold(f64::INFINITY, f64::min)
        };
        self.lines.map_or(1.0, |[x, y]| gaps(x).min(gaps(y)))
    }

    /// All corners. First every one is approached; then the steps between them are known well enough
    /// to measure each with a disc that does not depend on where the search began.
    pub fn all(&self, grid: &Grid) -> BTreeMap<(i32, i32), FittedCorner> {
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
    pub fn predicted(&self, grid: &Grid, label: (i32, i32)) -> Option<Vector2<f64>> {
        self.predicted_fit(grid, label).map(|fitted| fitted.pixel)
    }

    /// The same with its covariance.
    pub fn predicted_fit(&self, grid: &Grid, label: (i32, i32)) -> Option<FittedCorner> {
        let mut with = grid.clone();
        with.corners.insert(label, grid.predict(label, |k| self.place(k))?);
        subpixel::fit(self.image, &self.rough(&with, label)?).ok()
    }

    /// The variance (px², both axes) that a corner of the grid usually has: the median of some.
    pub fn usual_variance(&self, grid: &Grid) -> f64 {
        let apart = grid.corners.len() / SAMPLES + 1;
        let fit = |label: &(i32, i32)| subpixel::fit(self.image, &self.rough(grid, *label)?).ok();
        let some = grid.corners.keys().step_by(apart).filter_map(fit);
        let mut variances: Vec<f64> = some.map(|c| c.covariance.trace()).collect();
        variances.sort_by(f64::total_cmp);
        variances.get(variances.len() / 2).copied().unwrap_or(f64::INFINITY)
    }
}

/// The direction from a column to the other one of its pair.
fn towards_pair(column: i32) -> f64 {
    if column % 2 == 0 { 1.0 } else { -1.0 }
}

/// A measured corner with its id.
pub(super) fn corner(id: u32, fitted: &FittedCorner) -> ImageCorner {
    ImageCorner { id, pixel: fitted.pixel, covariance: fitted.covariance }
}

/// In the order of their ids.
pub(super) fn sorted(mut corners: Vec<ImageCorner>) -> Vec<ImageCorner> {
    corners.sort_by_key(|c| c.id);
    corners
}
