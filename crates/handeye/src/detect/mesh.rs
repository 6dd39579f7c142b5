//! Crossings joined into grids along their edges.
//!
//! From a crossing its four edges are followed until black and white change sides: there the next
//! crossing lies. So every connection of a grid has been seen as an edge in the image, and lens
//! distortion or slant do not matter. Two crossings are joined when each is found from the other, and
//! a connection counts when it borders a square whose four sides are all joined.

use std::collections::{BTreeMap, VecDeque};

use nalgebra::Vector2;

use super::{
    crossings::{Circle, Crossing, crossings, sample},
    grid::Grid,
};
use crate::GrayImage;

/// Distance from the edge at which its sides are seen, px.
const SIDE: f64 = 2.0;
/// Step along an edge, px.
const STEP: f64 = 1.5;
/// Share of a crossing's contrast that its edges must keep.
const KEPT: f64 = 0.3;
/// Largest correction across the edge, px a step.
const SIDESTEP: f64 = 0.6;
/// A crossing may lie this far from the place where the sides change, px, or
const NEAR: f64 = 2.5;
/// this share of the edge's length.
const NEAR_SHARE: f64 = 0.15;
/// An edge arrives at a crossing within this angle of one of its rays, rad.
const ALIGNED: f64 = 0.5;
/// Side of a cell of the map of crossings, px.
const CELL: f64 = 8.0;

/// All grids in a smoothed image, the largest first.
pub(super) fn grids(smooth: &GrayImage) -> Vec<Grid> {
    let mesh = Mesh::new(smooth);
    let mut grids = mesh.grids();
    grids.sort_by_key(|grid| std::cmp::Reverse(grid.corners.len()));
    grids
}

/// Where an edge ends: a crossing, and which of its rays points back.
type End = (usize, usize);

/// Crossings and their connections.
struct Mesh {
    crossings: Vec<Crossing>,
    joined: Vec<[Option<End>; 4]>,
}

impl Mesh {
    fn new(smooth: &GrayImage) -> Self {
        let mut map = Map::new(smooth, crossings(smooth));
        let mut ends = vec![];
        // crossings that are found on the way are followed as well
        while ends.len() < map.crossings.len() {
            let from = ends.len();
            ends.push(std::array::from_fn(|ray| map.end_of(smooth, from, ray)));
        }
        let mutual = |from: usize, ray: usize, end: End| {
            let back: &[Option<End>; 4] = &ends[end.0];
            back[end.1] == Some((from, ray))
        };
        let joined = ends
            .iter()
            .enumerate()
            .map(|(from, e)| {
                std::array::from_fn(|ray| e[ray].filter(|&end| mutual(from, ray, end)))
            })
            .collect();
        Self { crossings: map.crossings, joined }
    }

    /// Whether the square clockwise of a connection is closed.
    fn is_closed(&self, from: usize, ray: usize) -> bool {
        let (mut at, mut out) = (from, ray);
        for _ in 0..4 {
            let Some((next, back)) = self.joined[at][out] else { return false };
            // the ray that points back is two quarters from straight on; turn clockwise
            (at, out) = (next, (back + 3) % 4);
        }
        (at, out) == (from, ray)
    }

    /// Whether a connection borders a closed square on either side.
    fn counts(&self, from: usize, ray: usize) -> bool {
        let other_side = |(next, back): End| self.is_closed(next, back);
        self.is_closed(from, ray) || self.joined[from][ray].is_some_and(other_side)
    }

    fn grids(&self) -> Vec<Grid> {
        let mut labels: Vec<Option<Label>> = vec![None; self.crossings.len()];
        let mut grids = vec![];
        for start in 0..self.crossings.len() {
            if labels[start].is_none() {
                let grid = self.spread(start, &mut labels);
                if grid.corners.len() >= 4 {
                    grids.push(grid);
                }
            }
        }
        grids
    }

    /// Labels all that is connected to a crossing.
    fn spread(&self, start: usize, labels: &mut [Option<Label>]) -> Grid {
        let mut corners = BTreeMap::new();
        let mut queue = VecDeque::from([start]);
        labels[start] = Some(Label { at: (0, 0), turns: 0 });
        corners.insert((0, 0), self.crossings[start].at);
        while let Some(from) = queue.pop_front() {
            let Some(own) = labels[from] else { continue };
            for ray in 0..4 {
                let Some((next, back)) = self.joined[from][ray] else { continue };
                if labels[next].is_some() || !self.counts(from, ray) {
                    continue;
                }
                let label = own.beyond(ray, back);
                // a place that is taken: the connection is wrong somewhere, and this one stays out
                if let std::collections::btree_map::Entry::Vacant(place) = corners.entry(label.at) {
                    place.insert(self.crossings[next].at);
                    labels[next] = Some(label);
                    queue.push_back(next);
                }
            }
        }
        Grid { corners }
    }
}

/// Place of a crossing in its grid, and the direction of its ray 0 in clockwise quarter turns.
#[derive(Clone, Copy)]
struct Label {
    at: (i32, i32),
    turns: usize,
}

/// Steps in the four directions, clockwise in the image.
const DIRECTIONS: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

impl Label {
    /// The label of the crossing that `ray` leads to, whose ray `back` points back.
    fn beyond(&self, ray: usize, back: usize) -> Self {
        let direction = (ray + self.turns) % 4;
        let (di, dj) = DIRECTIONS[direction];
        Self { at: (self.at.0 + di, self.at.1 + dj), turns: (direction + 2 + 4 - back) % 4 }
    }
}

/// Crossings by place.
struct Map {
    crossings: Vec<Crossing>,
    cells: Vec<Vec<usize>>,
    columns: usize,
    circle: Circle,
}

impl Map {
    fn new(smooth: &GrayImage, found: Vec<Crossing>) -> Self {
        let count = |n: usize| (n as f64 / CELL) as usize + 1;
        let (columns, rows) = (count(smooth.width()), count(smooth.height()));
        let cells = vec![vec![]; columns * rows];
        let mut map = Self { crossings: vec![], cells, columns, circle: Circle::default() };
        found.into_iter().for_each(|crossing| map.insert(crossing));
        map
    }

    fn insert(&mut self, crossing: Crossing) {
        let cell = self.cell(&crossing.at);
        if let Some(cell) = self.cells.get_mut(cell) {
            cell.push(self.crossings.len());
            self.crossings.push(crossing);
        }
    }

    fn cell(&self, at: &Vector2<f64>) -> usize {
        (at.y.max(0.0) / CELL) as usize * self.columns + (at.x.max(0.0) / CELL) as usize
    }

    /// The nearest crossing within a radius.
    fn nearest(&self, at: &Vector2<f64>, radius: f64) -> Option<usize> {
        let low = (at.add_scalar(-radius) / CELL).map(|x| x.max(0.0) as usize);
        let high = (at.add_scalar(radius) / CELL).map(|x| x.max(0.0) as usize);
        let mut best = (radius * radius, None);
        for j in low.y..=high.y {
            for i in low.x..=high.x.min(self.columns - 1) {
                for &k in self.cells.get(j * self.columns + i).into_iter().flatten() {
                    let distance = (self.crossings[k].at - at).norm_squared();
                    if distance < best.0 {
                        best = (distance, Some(k));
                    }
                }
            }
        }
        best.1
    }

    /// The crossing at the end of an edge, and the ray there that points back.
    fn end_of(&mut self, smooth: &GrayImage, from: usize, ray: usize) -> Option<End> {
        let crossing = self.crossings[from];
        let end = follow(smooth, &crossing, ray)?;
        let length = (end - crossing.at).norm();
        let radius = NEAR.max(NEAR_SHARE * length);
        let next = match self.nearest(&end, radius) {
            Some(next) => next,
            None => {
                let (x, y) = (end.x.round() as usize, end.y.round() as usize);
                self.insert(self.circle.crossing_at(smooth, x, y)?);
                self.nearest(&end, radius)?
            }
        };
        let there = &self.crossings[next];
        let back = (crossing.at - there.at).normalize();
        // black and white have changed sides: seen from there, the edge is of the other kind
        let other_kind = [(ray + 1) % 2, (ray + 1) % 2 + 2];
        let aligned = |k: &usize| there.ray(*k).dot(&back) > ALIGNED.cos();
        other_kind.into_iter().find(aligned).map(|k| (next, k))
    }
}

/// Follows an edge from a crossing to where black and white change sides.
fn follow(smooth: &GrayImage, crossing: &Crossing, ray: usize) -> Option<Vector2<f64>> {
    let black_clockwise = if ray.is_multiple_of(2) { 1.0 } else { -1.0 };
    let least = KEPT * crossing.contrast;
    // closer to a slanted crossing, the sides belong to its other edge
    let clear = (SIDE + 1.0) / crossing.slant();
    let mut direction = crossing.ray(ray);
    let mut at = crossing.at + direction * clear;
    let mut last_clear = at;
    let mut lost = 0.0;
    let longest = (smooth.width() + smooth.height()) as f64;
    for _ in 0..(longest / STEP) as usize {
        let across = Vector2::new(-direction.y, direction.x);
        let (p, q) = (at + across * SIDE, at - across * SIDE);
        let (clockwise, other) = (sample(smooth, p.x, p.y)?, sample(smooth, q.x, q.y)?);
        let contrast = black_clockwise * (other - clockwise);
        if contrast > least {
            last_clear = at;
            lost = 0.0;
            let middle = sample(smooth, at.x, at.y)?;
            let slope = (clockwise - other) / (2.0 * SIDE);
            let off = (0.5 * (clockwise + other) - middle) / slope;
            at += across * (0.5 * off).clamp(-SIDESTEP, SIDESTEP);
            direction = (at - crossing.at).normalize();
        } else if contrast < -least {
            return Some((last_clear + at) * 0.5);
        } else {
            lost += STEP;
            if lost > 2.0 * clear + STEP {
                return None;
            }
        }
        at += direction * STEP;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::pyramid::smoothed;

    /// Boards of 12 px squares, slanted by `skew`: origin (px), squares along x and y.
    fn boards(skew: f64, all: &[(f64, f64, i64, i64)]) -> GrayImage {
        let grey = |k: usize| {
            let (x, y) = ((k % 240) as f64, (k / 240) as f64);
            let black = all.iter().any(|&(left, top, columns, rows)| {
                let j = ((y - top) / 12.0).floor() as i64;
                let i = ((x - left - skew * (y - top)) / 12.0).floor() as i64;
                (0..columns).contains(&i) && (0..rows).contains(&j) && (i + j) % 2 == 0
            });
            if black { 30.0 } else { 200.0 }
        };
        GrayImage::new(240, 160, (0..240 * 160).map(grey).collect()).unwrap()
    }

    #[test]
    fn boards_are_grids_of_their_own_the_largest_first() {
        for skew in [0.0, 0.4, -0.7] {
            let image = boards(skew, &[(60.3, 20.6, 4, 4), (120.2, 40.4, 7, 6)]);
            let found = grids(&smoothed(&image));
            let sizes: Vec<usize> = found.iter().map(|g| g.corners.len()).collect();
            assert_eq!(sizes, [30, 9], "{skew}");
            for grid in &found {
                let middle = *grid.corners.keys().nth(grid.corners.len() / 2).unwrap();
                let step = |d| grid.step(middle, d).unwrap();
                let (x, y) = (step((1, 0)), step((0, 1)));
                assert!(x.perp(&y) > 0.0, "labels turn clockwise in the image");
                assert!((x.perp(&y) - 144.0).abs() < 20.0, "{skew}: {x} {y}");
            }
        }
    }

    #[test]
    fn a_hole_is_gone_around() {
        let mut values = boards(0.1, &[(40.0, 20.0, 9, 8)]).values().to_vec();
        for y in 60..75 {
            values[y * 240 + 80..y * 240 + 105].fill(120.0);
        }
        let found = grids(&smoothed(&GrayImage::new(240, 160, values).unwrap()));
        let count = found[0].corners.len();
        assert!(found.len() == 1 && (48..56).contains(&count), "{count}");
        let (low, high) = found[0].bounds().unwrap();
        assert_eq!((high.0 - low.0, high.1 - low.1).max((high.1 - low.1, high.0 - low.0)), (7, 6));
    }
}
