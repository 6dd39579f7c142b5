//! All corners of a grid measured, and those found that the grid lacks.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::{
    grid::Grid,
    subpixel::{self, FittedCorner, NearCorner, RoughCorner},
};
use crate::{GrayImage, ImageCorner, math::linalg::median};

/// Measured corners by label.
pub(super) type Fitted = BTreeMap<(i32, i32), FittedCorner>;

/// A corner this many times farther from where its neighbours have it than they are themselves, and
/// than its own error is, is none.
const STRAY: f64 = 7.0;
/// But no nearer than this, px: prints and images of whole pixels are rounded.
const NOT_STRAY_PX: f64 = 0.75;

/// A prediction whose variance is this many times that of the neighbours is none.
const UNSURE: f64 = 30.0;
/// A predicted corner may be off by this share of a cell: lenses bend boards.
const OFF_SHARE: f64 = 0.12;

/// Sub-pixel fits in one image.
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
    /// What was not `seen` as a corner of the grid, but predicted, needs neighbours that confirm it.
    pub fn all(&self, grid: &Grid, seen: &Grid) -> Fitted {
        let near = |&k: &(i32, i32)| {
            Some((k, subpixel::approach(self.image, &self.rough(grid, k)?).ok()?))
        };
        let near: BTreeMap<(i32, i32), NearCorner> = grid.corners.keys().filter_map(near).collect();
        let grid = Grid { corners: near.iter().map(|(k, n)| (*k, n.pixel)).collect() };
        let measured = |(k, near): (&(i32, i32), &NearCorner)| {
            let rough = self.rough(&grid, *k)?;
            Some((*k, subpixel::measure(self.image, &rough, near).ok()?))
        };
        let mut fitted = self.consistent(near.iter().filter_map(measured).collect());
        let grid = Grid { corners: fitted.iter().map(|(k, f)| (*k, f.pixel)).collect() };
        let confirmed =
            |k: (i32, i32)| seen.corners.contains_key(&k) || self.predict(&grid, k).is_some();
        fitted.retain(|k, _| confirmed(*k));
        fitted
    }

    /// Without those that lie where their neighbours cannot have them: at the rim of what hides a
    /// board, a crossing of something else is soon found.
    fn consistent(&self, mut fitted: Fitted) -> Fitted {
        let mut grid = Grid { corners: fitted.iter().map(|(k, f)| (*k, f.pixel)).collect() };
        let mut residuals: BTreeMap<(i32, i32), f64> =
            grid.corners.keys().filter_map(|&k| Some((k, self.residual(&grid, k)?))).collect();
        loop {
            let stray = |(k, residual): (&(i32, i32), &f64)| {
                let usual = median(grid.around(*k).filter_map(|(k, _)| residuals.get(&k)).copied());
                let own = fitted.get(k)?.covariance.trace();
                let ratio = residual / (usual * usual + own).sqrt();
                (ratio > STRAY && *residual > NOT_STRAY_PX).then_some((ratio, *k))
            };
            let worst = residuals.iter().filter_map(stray).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, worst)) = worst else { return fitted };
            fitted.remove(&worst);
            grid.corners.remove(&worst);
            residuals.remove(&worst);
            let near: Vec<(i32, i32)> = grid.around(worst).map(|(k, _)| k).collect();
            for k in near {
                match self.residual(&grid, k) {
                    Some(residual) => residuals.insert(k, residual),
                    None => residuals.remove(&k),
                };
            }
        }
    }

    /// Distance of a corner from where its neighbours have it, px, as if they had it exactly.
    fn residual(&self, grid: &Grid, label: (i32, i32)) -> Option<f64> {
        let predicted = grid.predict(label, |k| self.place(k))?;
        Some((grid.corners.get(&label)? - predicted.pixel).norm() / (1.0 + predicted.spread).sqrt())
    }

    /// Where the neighbours have a corner, px, if they are sure.
    fn predict(&self, grid: &Grid, label: (i32, i32)) -> Option<Vector2<f64>> {
        let predicted = grid.predict(label, |k| self.place(k))?;
        (predicted.spread < UNSURE).then_some(predicted.pixel)
    }

    /// The corner that the neighbours predict, if the image has one there.
    pub fn predicted(&self, grid: &Grid, label: (i32, i32)) -> Option<Vector2<f64>> {
        let there = self.predict(grid, label)?;
        let mut with = grid.clone();
        with.corners.insert(label, there);
        let rough = self.rough(&with, label)?;
        let fitted = subpixel::fit(self.image, &rough).ok()?;
        let cell = rough.along_x.norm().min(rough.along_y.norm());
        ((fitted.pixel - there).norm() < OFF_SHARE * cell).then_some(fitted.pixel)
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
