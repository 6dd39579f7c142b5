//! Grids of checkerboard corners in an image: rough positions with integer labels.
//!
//! Labels start anywhere and may be turned: what they mean on the board is decided later.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector2};

use super::homography;

/// Corners of one grid by (column, row); columns to rows turn clockwise in the image.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grid {
    /// Where each labelled corner is, px.
    pub corners: BTreeMap<(i32, i32), Vector2<f64>>,
}

/// Neighbours this many cells away predict a corner.
const NEIGHBOURHOOD: i32 = 3;
/// At least this many neighbours predict a corner.
const FEWEST_NEIGHBOURS: usize = 6;

/// So many of a grid's corners say where another one continues it.
const MOST_CONTINUED: usize = 24;
/// There its corners may be off by this much, steps.
const EVEN: f64 = 0.3;
/// A gap wider than this (steps) is not bridged.
const WIDEST_GAP: u32 = 6;

impl Grid {
    /// Smallest and largest column and row.
    pub fn bounds(&self) -> Option<((i32, i32), (i32, i32))> {
        let columns = || self.corners.keys().map(|k| k.0);
        let rows = || self.corners.keys().map(|k| k.1);
        Some(((columns().min()?, rows().min()?), (columns().max()?, rows().max()?)))
    }

    /// The step (px) to the next corner in direction `(di, dj)`: the shorter one of both sides.
    pub fn step(&self, at: (i32, i32), (di, dj): (i32, i32)) -> Option<Vector2<f64>> {
        let here = self.corners.get(&at)?;
        let ahead = self.corners.get(&(at.0 + di, at.1 + dj)).map(|p| p - here);
        let behind = self.corners.get(&(at.0 - di, at.1 - dj)).map(|p| here - p);
        match (ahead, behind) {
            (Some(a), Some(b)) => Some(if a.norm() < b.norm() { a } else { b }),
            (a, b) => a.or(b),
        }
    }

    /// Where a corner should be, judged by its neighbours; `place` says where labels are on the
    /// board.
    pub fn predict(
        &self,
        at: (i32, i32),
        place: impl Fn((i32, i32)) -> Vector2<f64>,
    ) -> Option<Prediction> {
        let others = self.around(at).filter(|(k, _)| *k != at);
        prediction(&others.map(|(k, p)| (place(k) - place(at), p)).collect::<Vec<_>>())
    }

    /// Where a place is that lies `offset` steps from a corner, px.
    pub fn beside(&self, at: (i32, i32), offset: Vector2<f64>) -> Option<Vector2<f64>> {
        let steps = |k: (i32, i32)| Vector2::new(f64::from(k.0 - at.0), f64::from(k.1 - at.1));
        let near = self.around(at).map(|(k, p)| (steps(k) - offset, p));
        prediction(&near.collect::<Vec<_>>()).map(|p| p.pixel)
    }

    /// The corners around a label and the one there.
    pub fn around(
        &self,
        at: (i32, i32),
    ) -> impl Iterator<Item = ((i32, i32), Vector2<f64>)> + use<'_> {
        let near = -NEIGHBOURHOOD..=NEIGHBOURHOOD;
        let labels =
            near.clone().flat_map(move |j| near.clone().map(move |i| (at.0 + i, at.1 + j)));
        labels.filter_map(|k| Some((k, *self.corners.get(&k)?)))
    }

    /// Another grid with the labels that it has as the continuation of this one.
    pub(crate) fn continued(&self, other: &Self) -> Option<Self> {
        let middle = other.corners.values().sum::<Vector2<f64>>() / other.corners.len() as f64;
        let mut near: Vec<_> = self.corners.iter().collect();
        near.sort_by(|a, b| (a.1 - middle).norm().total_cmp(&(b.1 - middle).norm()));
        near.truncate(MOST_CONTINUED);
        let labels: Vec<_> =
            near.iter().map(|(k, _)| Vector2::new(f64::from(k.0), f64::from(k.1))).collect();
        let pixels: Vec<_> = near.iter().map(|(_, p)| **p).collect();
        let h = homography::fit(&pixels, &labels)?;
        let mut turned = other.clone();
        for _ in 0..4 {
            if let Some(moved) = self.shifted(&turned, &h) {
                return Some(moved);
            }
            turned = turned.relabel(|(i, j)| (-j, i));
        }
        None
    }

    /// A grid shifted to where `h` has its pixels, if that is near, free and evenly spaced.
    fn shifted(&self, other: &Self, h: &Matrix3<f64>) -> Option<Self> {
        let offset = |(k, p): (&(i32, i32), &Vector2<f64>)| {
            homography::apply(h, p) - Vector2::new(f64::from(k.0), f64::from(k.1))
        };
        let sum = other.corners.iter().map(offset).sum::<Vector2<f64>>();
        let shift = (sum / other.corners.len() as f64).map(f64::round);
        let even = other.corners.iter().all(|c| (offset(c) - shift).amax() < EVEN);
        let (x, y) = (shift.x as i32, shift.y as i32);
        let moved = other.relabel(|(i, j)| (i.saturating_add(x), j.saturating_add(y)));
        let free = moved.corners.keys().all(|k| !self.corners.contains_key(k));
        let close = |a: i32, b: i32| a.abs_diff(b) <= WIDEST_GAP;
        let near = |k: &(i32, i32)| self.corners.keys().any(|o| close(k.0, o.0) && close(k.1, o.1));
        (even && free && moved.corners.keys().any(near)).then_some(moved)
    }

    /// Every position moved, e.g. back from a scaled image.
    pub fn map(&self, f: impl Fn(&Vector2<f64>) -> Vector2<f64>) -> Self {
        Self { corners: self.corners.iter().map(|(k, p)| (*k, f(p))).collect() }
    }

    /// Every label changed.
    pub(crate) fn relabel(&self, f: impl Fn((i32, i32)) -> (i32, i32)) -> Self {
        Self { corners: self.corners.iter().map(|(k, p)| (f(*k), *p)).collect() }
    }
}

/// A corner as its neighbours have it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prediction {
    /// Where, px.
    pub pixel: Vector2<f64>,
    /// Its variance over that of a neighbour.
    pub spread: f64,
}

fn prediction(neighbours: &[(Vector2<f64>, Vector2<f64>)]) -> Option<Prediction> {
    if neighbours.len() < FEWEST_NEIGHBOURS {
        return None;
    }
    homography::origin(neighbours).map(|(pixel, spread)| Prediction { pixel, spread })
}
