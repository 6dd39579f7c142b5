//! Grids of checkerboard corners in a picture: rough positions with integer labels.
//!
//! Labels start anywhere and may be turned: what they mean on the board is decided later.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::homography;

/// Corners of one grid by (column, row); columns to rows turn clockwise in the picture.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grid {
    /// Where each labelled corner is, px.
    pub corners: BTreeMap<(i32, i32), Vector2<f64>>,
}

/// Neighbours this many cells away predict a corner.
const NEIGHBOURHOOD: i32 = 3;
/// At least this many neighbours predict a corner.
const FEWEST_NEIGHBOURS: usize = 6;

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

    /// Where a corner should be, px, judged by its neighbours; `place` says where labels are on the
    /// board.
    pub fn predict(
        &self,
        at: (i32, i32),
        place: impl Fn((i32, i32)) -> Vector2<f64>,
    ) -> Option<Vector2<f64>> {
        let near = |k: &(i32, i32)| {
            (k.0 - at.0).abs().max((k.1 - at.1).abs()) <= NEIGHBOURHOOD && *k != at
        };
        let (from, to): (Vec<_>, Vec<_>) = self
            .corners
            .iter()
            .filter(|(k, _)| near(k))
            .map(|(k, p)| (place(*k) - place(at), *p))
            .unzip();
        if from.len() < FEWEST_NEIGHBOURS {
            return None;
        }
        let h = homography::fit(&from, &to)?;
        let there = homography::apply(&h, &Vector2::zeros());
        there.iter().all(|x| x.is_finite()).then_some(there)
    }

    /// Every position moved, e.g. back from a scaled picture.
    pub fn map(&self, f: impl Fn(&Vector2<f64>) -> Vector2<f64>) -> Self {
        Self { corners: self.corners.iter().map(|(k, p)| (*k, f(p))).collect() }
    }

    /// Every label changed.
    pub fn relabel(&self, f: impl Fn((i32, i32)) -> (i32, i32)) -> Self {
        Self { corners: self.corners.iter().map(|(k, p)| (f(*k), *p)).collect() }
    }
}
