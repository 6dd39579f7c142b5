//! Which corners of a checkerboard a part of it shows.
//!
//! A checkerboard has no markers. Where a part of it is hidden, its corners have ids only if the part
//! can lie in one way on the board: its sides that are sides of the board tell, and the colours. A
//! side of the part is a side of the board when all along it one more row of squares follows and then
//! white.

use nalgebra::Vector2;

use super::{grid::Grid, markers::bilinear};
use crate::{GrayImage, TargetModel};

/// Fewer corners are no part of a board.
const FEWEST_CORNERS: usize = 8;
/// Fewer corners along a side do not tell that it is the board's.
const FEWEST_ALONG: usize = 2;
/// Share of the corners along a side that must tell so.
const AGREEING: f64 = 0.8;
/// Where the squares outside of a side, and the margin beyond them, are looked at: steps from the
/// side's corners.
const SQUARE: f64 = 0.5;
const MARGIN: f64 = 1.2;
/// Where the last square must end, steps.
const LAST: (f64, f64) = (0.88, 1.12);
/// Grey values may be off by this share of the contrast.
const SIMILAR: f64 = 0.3;

/// A grid laid on a board: clockwise quarter turns, then a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lie {
    turns: usize,
    shift: (i32, i32),
}

/// The grid with the board's labels, if there is only one way (but for turns that nobody can tell).
pub(super) fn on_board(image: &GrayImage, grid: &Grid, target: &TargetModel) -> Option<Grid> {
    let (low, high) = grid.bounds()?;
    let size = (high.0 - low.0 + 1, high.1 - low.1 + 1);
    if grid.corners.len() < FEWEST_CORNERS || size.0.min(size.1) < 2 {
        return None;
    }
    let grid = grid.relabel(|(i, j)| (i - low.0, j - low.1));
    let sides = sides(image, &grid, size);
    let placed = |lie: &Lie| {
        grid.relabel(|k| {
            let (x, y) = turned(k, size, lie.turns);
            (x + lie.shift.0, y + lie.shift.1)
        })
    };
    let all: Vec<Grid> = lies(size, target, &sides).iter().map(placed).collect();
    let black: Vec<&Grid> =
        all.iter().filter(|grid| first_square_brightness(image, grid) < 0.0).collect();
    let allowed = if black.is_empty() { all.iter().collect() } else { black };
    let same =
        |a: &Grid, b: &Grid| target.symmetries().iter().any(|map| is_turned(a, b, map, target));
    let first = *allowed.first()?;
    if !allowed.iter().all(|other| same(first, other)) {
        return None;
    }
    let from_top_left = |grid: &Grid| {
        let near = grid.corners.iter().min_by_key(|((i, j), _)| i + j);
        near.map_or(f64::INFINITY, |(_, p)| p.x + p.y)
    };
    allowed.into_iter().min_by(|a, b| from_top_left(a).total_cmp(&from_top_left(b))).cloned()
}

/// All ways to lay a grid of `size` on the board so that the grid's sides that are the board's come
/// to lie there.
fn lies(size: (i32, i32), target: &TargetModel, sides: &[bool; 4]) -> Vec<Lie> {
    let (columns, rows) = target.grid();
    let (columns, rows) = (columns as i32, rows as i32);
    let mut all = vec![];
    for turns in 0..4 {
        let (width, height) = if turns % 2 == 0 { size } else { (size.1, size.0) };
        // a clockwise turn takes the right side to the bottom
        let is_side = |k: usize| sides[(k + 4 - turns) % 4];
        for y in 0..=rows - height {
            for x in 0..=columns - width {
                let at_side = [x + width == columns, y + height == rows, x == 0, y == 0];
                if (0..4).all(|k| at_side[k] || !is_side(k)) {
                    all.push(Lie { turns, shift: (x, y) });
                }
            }
        }
    }
    all
}

/// Whether a turn of the board that nobody can tell takes one grid to the other.
fn is_turned(a: &Grid, b: &Grid, map: &[u32], target: &TargetModel) -> bool {
    let id = |(i, j): &(i32, i32)| target.id_at(u32::try_from(*i).ok()?, u32::try_from(*j).ok()?);
    a.corners.iter().all(|(k, pixel)| {
        let turned = id(k).and_then(|id| map.get(id as usize).copied());
        b.corners.iter().any(|(other, at)| at == pixel && id(other) == turned)
    })
}

/// Outward and along a side: right, bottom, left, top.
const SIDES: [((i32, i32), (i32, i32)); 4] =
    [((1, 0), (0, 1)), ((0, 1), (-1, 0)), ((-1, 0), (0, -1)), ((0, -1), (1, 0))];

/// Which sides of the grid are sides of the board.
fn sides(image: &GrayImage, grid: &Grid, (width, height): (i32, i32)) -> [bool; 4] {
    let last = [width - 1, height - 1, 0, 0];
    std::array::from_fn(|k| {
        let at_side = |at: &&(i32, i32)| if k % 2 == 0 { at.0 == last[k] } else { at.1 == last[k] };
        let corners = grid.corners.keys().filter(at_side);
        let told: Vec<bool> = corners.filter_map(|at| ends(image, grid, *at, SIDES[k])).collect();
        let agreeing = told.iter().filter(|ends| **ends).count();
        agreeing >= FEWEST_ALONG && agreeing as f64 >= AGREEING * told.len() as f64
    })
}

/// Whether the board ends one square outward of a corner; `None` if these squares are not in sight.
fn ends(
    image: &GrayImage,
    grid: &Grid,
    at: (i32, i32),
    (out, along): ((i32, i32), (i32, i32)),
) -> Option<bool> {
    let vector = |(x, y): (i32, i32)| Vector2::new(f64::from(x), f64::from(y));
    let (out, along) = (vector(out), vector(along));
    let grey = |o: f64, a: f64| bilinear(image, &grid.beside(at, out * o + along * a)?);
    let (one, other) = (grey(SQUARE, SQUARE)?, grey(SQUARE, -SQUARE)?);
    let (black, white) = (one.min(other), one.max(other));
    // the black square lies on this side of the edge through the corner
    let side = if one < other { SQUARE } else { -SQUARE };
    let near = |a: f64, b: f64| (a - b).abs() < SIMILAR * (white - black);
    // inside of the corner the colours are the other way round
    if !(near(grey(-SQUARE, -side)?, black) && near(grey(-SQUARE, side)?, white)) {
        return None;
    }
    let margin = near(grey(MARGIN, SQUARE)?, white) && near(grey(MARGIN, -SQUARE)?, white);
    let middle = 0.5 * (black + white);
    Some(margin && grey(LAST.0, side)? < middle && grey(LAST.1, side)? > middle)
}

/// Grey of the squares with the colour of the one outside of corner (0, 0), minus that of the
/// others.
pub(crate) fn first_square_brightness(image: &GrayImage, grid: &Grid) -> f64 {
    let one = |(&(i, j), p): (&(i32, i32), &Vector2<f64>)| {
        let (u, v) = (grid.step((i, j), (1, 0))?, grid.step((i, j), (0, 1))?);
        let grey = |a: f64, b: f64| bilinear(image, &(p + (u * a + v * b) * 0.35));
        let own = grey(-1.0, -1.0)? + grey(1.0, 1.0)?;
        let other = grey(1.0, -1.0)? + grey(-1.0, 1.0)?;
        Some(if (i + j) % 2 == 0 { own - other } else { other - own })
    };
    grid.corners.iter().filter_map(one).sum()
}

/// A label of a grid of `size`, after quarter turns.
pub(crate) fn turned(label: (i32, i32), size: (i32, i32), turns: usize) -> (i32, i32) {
    let quarter = |((i, j), (width, height)): ((i32, i32), (i32, i32))| {
        ((height - 1 - j, i), (height, width))
    };
    (0..turns).fold((label, size), |at, _| quarter(at)).0
}

#[cfg(test)]
mod tests {
    use super::super::{board, relabelled};
    use super::*;
    use crate::{ImageCorner, Intrinsics, Pose};
    use crate::{
        math::random::Random,
        simulate::{Optics, Scene},
    };
    use nalgebra::{Matrix3, Vector3, Vector6};

    fn scene(columns: u32, rows: u32, roll: f64) -> Scene {
        let target = TargetModel::Checkerboard { columns, rows, square_mm: 20.0 };
        let middle = -0.01 * Vector2::new(f64::from(columns - 1), f64::from(rows - 1));
        let back = Vector6::new(0.0, 0.0, 0.0, middle.x, middle.y, 0.0);
        let away = Pose::from_parts(&Matrix3::identity(), Vector3::new(0.0, 0.0, 0.42));
        let turn = Vector6::new(0.0, 0.0, roll, 0.0, 0.0, 0.0);
        let tilt = Vector6::new(0.2, -0.3, 0.0, 0.0, 0.0, 0.0);
        let camera_from_target = away.retract(&tilt).retract(&turn).retract(&back);
        let intrinsics = Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5);
        Scene { target, camera_from_target, intrinsics }
    }

    /// The scene with a grainy thing over the places of the board (in squares from corner 0) that
    /// are `hidden`.
    fn covered(scene: &Scene, hidden: impl Fn(f64, f64) -> bool) -> GrayImage {
        let picture = scene.picture(&Optics::default(), 3);
        let target_from_camera = scene.camera_from_target.inverse();
        let mut random = Random::new(5);
        let width = picture.width();
        let grey = |(k, grey): (usize, &f32)| {
            let pixel = Vector2::new((k % width) as f64, (k / width) as f64);
            let grain = random.between(90.0, 130.0) as f32;
            let ray = (pixel - Vector2::new(399.5, 299.5)) / 900.0;
            let ray = target_from_camera.iso().rotation * ray.push(1.0);
            let eye = target_from_camera.iso().translation.vector;
            let on_board = (eye - ray * (eye.z / ray.z)) / 0.02;
            if hidden(on_board.x, on_board.y) { grain } else { *grey }
        };
        let values = picture.values().iter().enumerate().map(grey).collect();
        GrayImage::new(width, picture.height(), values).unwrap()
    }

    /// Corners that are where the truth has them, up to turns that nobody can tell.
    fn right(scene: &Scene, found: &[ImageCorner]) -> bool {
        let truth = scene.corners();
        let near =
            |c: &ImageCorner| truth.iter().any(|t| t.0 == c.id && (t.1 - c.pixel).norm() < 0.3);
        let maps = scene.target.symmetries();
        maps.iter().any(|map| relabelled(found, map).iter().all(near))
    }

    #[test]
    fn a_corner_of_the_board_and_all_of_a_side_tell_the_ids() {
        for (columns, rows) in [(9, 6), (8, 6), (7, 7), (8, 8)] {
            for k in 0..4 {
                let scene = scene(columns, rows, 0.3 + 1.57 * f64::from(k));
                let picture = covered(&scene, |x, y| 0.7 * x + 0.2 * y > 3.8);
                let found = board::detect(&picture, &scene.target).unwrap();
                assert!((20..41).contains(&found.len()), "{columns} {k}: {}", found.len());
                assert!(right(&scene, &found), "{columns} x {rows}, turn {k}");
            }
        }
    }

    #[test]
    fn a_part_that_may_lie_elsewhere_has_no_ids() {
        let scene = scene(9, 6, 0.2);
        // one side of the board, without its ends; and its middle
        for (low, high) in [(-9.0, 3.5), (1.5, 5.5)] {
            let seen = move |x: f64, y: f64| (low..high).contains(&x) && (0.6..4.5).contains(&y);
            let picture = covered(&scene, |x, y| !seen(x, y));
            let error = board::detect(&picture, &scene.target).unwrap_err().to_string();
            assert!(error.contains("a partial checkerboard is ambiguous"), "{error}");
        }
    }

    #[test]
    fn what_covers_the_board_along_its_lines_is_not_its_end() {
        let scene = scene(9, 6, 0.2);
        // grey, from where the margin would begin
        let picture = covered(&scene, |x, y| x > 7.0 || y > 4.0);
        let found = board::detect(&picture, &scene.target).unwrap();
        assert!(right(&scene, &found), "the two other sides are in sight");
        let picture = covered(&scene, |x, y| x > 6.0 || y > 4.0);
        assert!(board::detect(&picture, &scene.target).is_err(), "six may be all of a short side");
        let picture = covered(&scene, |x, _| !(1.0..6.0).contains(&x));
        assert!(board::detect(&picture, &scene.target).is_err(), "two sides of six, across");
    }

    #[test]
    fn parts_on_both_sides_of_a_bar_are_one_board() {
        let scene = scene(9, 6, 0.4);
        let picture = covered(&scene, |x, _| (2.7..4.3).contains(&x));
        let found = board::detect(&picture, &scene.target).unwrap();
        assert!((36..43).contains(&found.len()), "{}", found.len());
        assert!(right(&scene, &found));
    }
}
