//! The scene on cells, some to a pixel: drawn, and gathered into pixels.

use nalgebra::Vector2;

use super::{Optics, psf::Kernel};
use crate::{
    model::texture::{Nearby, Texture},
    simulate::psf::CELLS,
};

/// A rectangle of pixels, right and bottom excluded.
#[derive(Clone, Copy)]
pub(super) struct Window {
    pub(super) left: i64,
    pub(super) top: i64,
    pub(super) right: i64,
    pub(super) bottom: i64,
}

impl Window {
    /// An image of `size`, and `margin` more on every side.
    pub(super) fn whole((width, height): (u32, u32), margin: i64) -> Self {
        let (right, bottom) = (i64::from(width) + margin, i64::from(height) + margin);
        Self { left: -margin, top: -margin, right, bottom }
    }

    /// The part of `self` that lies in `other`.
    pub(super) fn within(&self, other: &Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }

    pub(super) fn size(&self) -> (usize, usize) {
        ((self.right - self.left).max(0) as usize, (self.bottom - self.top).max(0) as usize)
    }

    /// The part of `self` that lies around `pixels`.
    pub(super) fn around(&self, pixels: &[Vector2<f64>], margin: i64) -> Self {
        let least = |f: fn(&Vector2<f64>) -> f64| {
            pixels.iter().map(f).fold(f64::INFINITY, f64::min).floor() as i64 - margin
        };
        let most = |f: fn(&Vector2<f64>) -> f64| {
            pixels.iter().map(f).fold(f64::NEG_INFINITY, f64::max).ceil() as i64 + margin
        };
        self.within(&Self {
            left: least(|p| p.x),
            top: least(|p| p.y),
            right: most(|p| p.x),
            bottom: most(|p| p.y),
        })
    }
}

/// The scene on the cells of a window.
pub(super) struct Canvas {
    window: Window,
    width: usize,
    values: Vec<f32>,
}

/// Points of the Fibonacci lattice that integrates a cell with more than one straight edge.
const LATTICE: (usize, usize) = (55, 34);

impl Canvas {
    pub(super) fn new(window: Window, grey: f64) -> Self {
        let (columns, rows) = window.size();
        let width = CELLS * columns;
        Self { window, width, values: vec![grey as f32; width * CELLS * rows] }
    }

    pub(super) fn window(&self) -> Window {
        self.window
    }

    /// Draws the cells of pixel `(u, v)` of the image, whose corners see `square` of the print.
    pub(super) fn draw(
        &mut self,
        texture: &Texture,
        optics: &Optics,
        (u, v): (i64, i64),
        square: &[Vector2<f64>; 4],
    ) {
        let (i, j) = ((u - self.window.left) as usize, (v - self.window.top) as usize);
        let pixel = Pixel::new(texture, optics, square);
        let whole = pixel.whole();
        if whole == Some(None) {
            return;
        }
        for k in 0..CELLS * CELLS {
            let (column, row) = (k % CELLS, k / CELLS);
            let cell = &mut self.values[(CELLS * j + row) * self.width + CELLS * i + column];
            let behind = f64::from(*cell);
            *cell = whole.flatten().unwrap_or_else(|| pixel.cell((column, row), behind)) as f32;
        }
    }

    /// Paints cells by the place of their centres in the image (px); `None` leaves what is there.
    pub(super) fn paint(&mut self, grey: impl Fn(&Vector2<f64>) -> Option<f64>) {
        let all = self.window;
        self.paint_in(&all, grey);
    }

    /// The same, within `part` of the image.
    pub(super) fn paint_in(&mut self, part: &Window, grey: impl Fn(&Vector2<f64>) -> Option<f64>) {
        let (all, part) = (self.window, part.within(&self.window));
        let (cells, side) = (CELLS as i64, 1.0 / CELLS as f64);
        let columns = cells * (part.left - all.left)..cells * (part.right - all.left);
        let rows = cells * (part.top - all.top)..cells * (part.bottom - all.top);
        let first =
            Vector2::new(all.left as f64, all.top as f64) + Vector2::repeat(0.5 * side - 0.5);
        for j in rows {
            for i in columns.clone() {
                if let Some(grey) = grey(&(first + Vector2::new(i as f64, j as f64) * side)) {
                    self.values[j as usize * self.width + i as usize] = grey as f32;
                }
            }
        }
    }

    /// Gathers what reaches the pixels of the rows `from..to` of the image `grey`.
    pub(super) fn gather(
        &self,
        kernel: &Kernel,
        grey: &mut [f32],
        (width, height): (usize, usize),
        (from, to): (i64, i64),
    ) {
        let planes = Planes::of(self, kernel.reach());
        let (left, right) = (self.window.left.max(0), self.window.right.min(width as i64));
        if left >= right {
            return;
        }
        let mut pixels = vec![0.0; self.window.size().0];
        for y in from.max(self.window.top).max(0)..to.min(self.window.bottom).min(height as i64) {
            planes.gather(kernel, (y - self.window.top) as usize, &mut pixels);
            let seen = &pixels[(left - self.window.left) as usize..];
            let row = &mut grey[y as usize * width..][left as usize..right as usize];
            row.iter_mut().zip(seen).for_each(|(value, seen)| *value = *seen);
        }
    }
}

/// A pixel that sees a part of the print.
struct Pixel<'a> {
    texture: &'a Texture,
    optics: &'a Optics,
    /// What its corners see, row by row.
    square: &'a [Vector2<f64>; 4],
    /// No point of it is farther from its middle, m.
    reach: f64,
    /// A cell's sides along the image's rows and columns, in the print, m.
    sides: [Vector2<f64>; 2],
}

impl<'a> Pixel<'a> {
    fn new(texture: &'a Texture, optics: &'a Optics, square: &'a [Vector2<f64>; 4]) -> Self {
        let [a, b, c, d] = square;
        let reach = 0.6 * (d - a).norm().max((c - b).norm());
        let sides = [(b + d) - (a + c), (c + d) - (a + b)].map(|v| v * (0.5 / CELLS as f64));
        Self { texture, optics, square, reach, sides }
    }

    /// The point of the print at a place in the pixel, from (0, 0) to (1, 1).
    fn at(&self, x: f64, y: f64) -> Vector2<f64> {
        let [a, b, c, d] = self.square;
        a * ((1.0 - x) * (1.0 - y)) + b * (x * (1.0 - y)) + c * ((1.0 - x) * y) + d * (x * y)
    }

    /// `None` beside the paper.
    fn ink(&self, at: &Vector2<f64>) -> Option<f64> {
        let is_black = self.texture.is_black_at(at)?;
        Some(if is_black { self.optics.black } else { self.optics.white })
    }

    /// What it sees if it sees the same everywhere.
    fn whole(&self) -> Option<Option<f64>> {
        let sides = Sides::of(self.texture, &self.at(0.5, 0.5), self.reach)?;
        let (one, other) = (self.ink(&sides.one), self.ink(&sides.other));
        (one == other).then_some(one)
    }

    /// The mean over a cell; `behind` is seen beside the paper.
    fn cell(&self, (column, row): (usize, usize), behind: f64) -> f64 {
        let seen = |at: &Vector2<f64>| self.ink(at).unwrap_or(behind);
        let side = 1.0 / CELLS as f64;
        let (x, y) = (column as f64 * side, row as f64 * side);
        let centre = self.at(x + 0.5 * side, y + 0.5 * side);
        if let Some(sides) = Sides::of(self.texture, &centre, side * self.reach) {
            let (one, other) = (seen(&sides.one), seen(&sides.other));
            return one + (other - one) * sides.share_of_other(&self.sides);
        }
        let (n, step) = LATTICE;
        let sample = |s: usize| {
            let (p, q) = (s as f64 + 0.5, ((s * step) % n) as f64 + 0.5);
            seen(&self.at(x + side * p / n as f64, y + side * q / n as f64))
        };
        (0..n).map(sample).sum::<f64>() / n as f64
    }
}

/// A field that at most one straight edge crosses: points of the print on either side of the edge.
struct Sides {
    one: Vector2<f64>,
    other: Vector2<f64>,
    /// Direction that the edge is crossed in from `one` to `other`: 0 along x, 1 along y.
    axis: usize,
    /// How far the field's middle is on the other side, m.
    beyond: f64,
}

impl Sides {
    /// `None` where there may be more than one edge.
    fn of(texture: &Texture, middle: &Vector2<f64>, reach: f64) -> Option<Self> {
        let (axis, beyond) = match texture.nearby(middle, reach) {
            Nearby::Nothing => {
                let (axis, beyond) = (0, f64::INFINITY);
                return Some(Self { one: *middle, other: *middle, axis, beyond });
            }
            Nearby::Upright(right) => (0, right),
            Nearby::Level(below) => (1, below),
            Nearby::Edges => return None,
        };
        let mut aside = Vector2::zeros();
        aside[axis] = 1.0;
        let on_edge = middle - aside * beyond;
        Some(Self { one: on_edge - aside * reach, other: on_edge + aside * reach, axis, beyond })
    }

    /// How much of a parallelogram with these sides lies on the other side. Along the axis it is the
    /// sum of two uniform distributions, as wide as the sides.
    fn share_of_other(&self, sides: &[Vector2<f64>; 2]) -> f64 {
        let (a, b) = (sides[0][self.axis].abs(), sides[1][self.axis].abs());
        let (wide, narrow) = (a.max(b), a.min(b));
        let half = 0.5 * (wide + narrow);
        if self.beyond.abs() >= half {
            return if self.beyond > 0.0 { 1.0 } else { 0.0 };
        }
        if narrow < 1e-6 * wide {
            return (0.5 + self.beyond / wide).clamp(0.0, 1.0);
        }
        let square = |x: f64| x.max(0.0).powi(2);
        let (far, near) = (half, 0.5 * (wide - narrow));
        let x = self.beyond;
        (square(x + far) - square(x + near) - square(x - near)) / (2.0 * wide * narrow)
    }
}

/// A canvas whose every row is stored in `CELLS` planes: first the first cells of all its pixels,
/// then the second ones. What is beyond the canvas is as its outermost cells are.
struct Planes {
    /// Pixels of a plane, `beyond` of them on either side outside of the canvas.
    length: usize,
    beyond: usize,
    rows: Vec<Vec<f32>>,
}

impl Planes {
    fn of(canvas: &Canvas, reach: usize) -> Self {
        let beyond = reach / CELLS + 1;
        let length = canvas.width / CELLS + 2 * beyond;
        let last = canvas.width.saturating_sub(1);
        let split = |row: &[f32]| -> Vec<f32> {
            let cell = |plane: usize, k: usize| {
                row[(CELLS * k + plane).saturating_sub(CELLS * beyond).min(last)]
            };
            (0..CELLS).flat_map(|p| (0..length).map(move |k| cell(p, k))).collect()
        };
        let rows = canvas.values.chunks_exact(canvas.width.max(1)).map(split).collect();
        Self { length, beyond, rows }
    }

    /// Row `j` of cells; beyond the canvas, the outermost.
    fn row(&self, j: i64) -> &[f32] {
        &self.rows[j.clamp(0, self.rows.len() as i64 - 1) as usize]
    }

    /// Row `j` of pixels.
    fn gather(&self, kernel: &Kernel, j: usize, pixels: &mut [f32]) {
        let first = (CELLS * j + CELLS / 2) as i64 - kernel.reach() as i64;
        let rows = |k: usize| self.row(first + k as i64);
        pixels.fill(0.0);
        match kernel {
            Kernel::Separable(line) => {
                let mut sum = vec![0.0; CELLS * self.length];
                line.iter().enumerate().for_each(|(k, w)| add(&mut sum, rows(k), *w));
                self.along(&sum, line, pixels);
            }
            Kernel::Square(field) => {
                field.iter().enumerate().for_each(|(k, line)| self.along(rows(k), line, pixels));
            }
        }
    }

    /// Adds a row of cells, weighted by `line` around each pixel's centre.
    fn along(&self, row: &[f32], line: &[f32], pixels: &mut [f32]) {
        let first = CELLS * self.beyond + CELLS / 2 - line.len() / 2;
        for (k, weight) in line.iter().enumerate().filter(|(_, w)| **w != 0.0) {
            let cell = first + k;
            add(pixels, &row[cell % CELLS * self.length + cell / CELLS..], *weight);
        }
    }
}

fn add(row: &mut [f32], values: &[f32], weight: f32) {
    row.iter_mut().zip(values).for_each(|(out, value)| *out += weight * value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_beyond_an_edge_is_that_of_many_points() {
        let sides = [Vector2::new(0.8, 0.3), Vector2::new(-0.5, 0.9)];
        let upright = [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)];
        for sides in [sides, upright] {
            for (axis, beyond) in [(0, -0.7), (0, -0.3), (0, 0.0), (1, 0.12), (1, 0.45), (1, 2.0)] {
                let n = 400;
                let middle = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
                let is_other = |k: &usize| {
                    let at = sides[0] * middle(k % n) + sides[1] * middle(k / n);
                    at[axis] + beyond > 0.0
                };
                let counted = (0..n * n).filter(is_other).count() as f64 / (n * n) as f64;
                let (one, other) = (Vector2::zeros(), Vector2::zeros());
                let share = Sides { one, other, axis, beyond }.share_of_other(&sides);
                assert!((share - counted).abs() < 3e-3, "{axis} {beyond}: {share} {counted}");
            }
        }
    }
}
