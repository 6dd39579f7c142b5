//! Pictures and scans of a board whose pose is known exactly.
//!
//! A pixel is the scene, filtered by the optics' point spread `h` and integrated over the pixel's
//! square: `I = ∫∫ (scene * h)(u, v) du dv + noise`, rounded to 8 bits. The scene is drawn on half
//! pixels, each integrated over its square (exactly inside a field of one colour, over a Fibonacci
//! lattice across an edge); the point spread is applied there, and 2 x 2 of them make a pixel.

use nalgebra::{Vector2, Vector3};

use super::{Random, texture::Texture};
use crate::{Camera, GrayImage, Intrinsics, Point, Pose, Scan, Target, TargetModel};

/// A board in front of a camera.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The board.
    pub target: TargetModel,
    /// Where it is.
    pub camera_from_target: Pose<Camera, Target>,
    /// The camera that looks at it.
    pub intrinsics: Intrinsics,
}

/// What lens and sensor do to a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optics {
    /// Standard deviation of the Gaussian point spread, px.
    pub blur_px: f64,
    /// Radius of the disc of an out-of-focus lens, px; 0 in focus.
    pub defocus_px: f64,
    /// Standard deviation of the noise, grey values.
    pub noise: f64,
    /// Grey of the black squares.
    pub black: f64,
    /// Grey of the white squares.
    pub white: f64,
    /// Grey of everything behind the board.
    pub background: f64,
    /// Share of the light that is missing in the picture's outermost corner.
    pub vignetting: f64,
}

impl Default for Optics {
    fn default() -> Self {
        Self {
            blur_px: 0.8,
            defocus_px: 0.0,
            noise: 2.0,
            black: 40.0,
            white: 210.0,
            background: 120.0,
            vignetting: 0.0,
        }
    }
}

/// How a 3D camera measures depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthSensor {
    /// Standard deviation of a depth at 1 m, in metres; it grows with the square of the distance.
    pub sigma_at_1m: f64,
    /// Depths are multiples of this, m; 0 for none.
    pub step_m: f64,
    /// Nothing is measured where surface normal and ray enclose more than this angle (rad).
    pub steepest_rad: f64,
    /// Distance (m) from the board's plane to the table behind it.
    pub table_behind_m: f64,
}

impl Default for DepthSensor {
    fn default() -> Self {
        Self { sigma_at_1m: 0.5e-3, step_m: 0.0, steepest_rad: 1.3, table_behind_m: 0.05 }
    }
}

impl Scene {
    /// The exact pixels of the corners that the camera sees, with their ids.
    pub fn corners(&self) -> Vec<(u32, Vector2<f64>)> {
        let (width, height) = (f64::from(self.intrinsics.width), f64::from(self.intrinsics.height));
        let inside =
            |p: &Vector2<f64>| p.x > -0.5 && p.y > -0.5 && p.x < width - 0.5 && p.y < height - 0.5;
        let corners = self.target.corners().into_iter().enumerate();
        corners
            .filter_map(|(id, in_target)| {
                let in_camera = self.camera_from_target * in_target;
                let pixel = self.intrinsics.project(&in_camera.vector()).filter(inside)?;
                Some((id as u32, pixel))
            })
            .collect()
    }

    /// The picture, with noise from `seed`.
    pub fn picture(&self, optics: &Optics, seed: u64) -> GrayImage {
        let (width, height) = (self.intrinsics.width as usize, self.intrinsics.height as usize);
        let mut grey = vec![optics.background as f32; width * height];
        if let Some(texture) = Texture::of(&self.target) {
            let window = self.window(&texture, 2 + (4.0 * blur_reach(optics)).ceil() as i64);
            let mut halves = self.half_pixels(&texture, &window, optics);
            halves.blur(2.0 * optics.blur_px);
            halves.defocus(2.0 * optics.defocus_px);
            halves.into_pixels(&window, &mut grey, width, height);
        }
        self.expose(&mut grey, optics, seed);
        GrayImage::new(width, height, grey).expect("as many values as pixels")
    }

    /// The scan, one point per pixel, with noise from `seed`.
    pub fn scan(&self, sensor: &DepthSensor, seed: u64) -> Scan {
        let (width, height) = (self.intrinsics.width as usize, self.intrinsics.height as usize);
        let mut random = Random::new(seed);
        let texture = Texture::of(&self.target);
        let mut ray = RayGrid::new(self);
        let mut points = Vec::with_capacity(width * height);
        for v in 0..height {
            for u in 0..width {
                let noise = random.normal();
                let direction = ray.at(u as f64, v as f64);
                let depth = direction.and_then(|d| self.depth(&d, texture.as_ref(), sensor));
                points.push(match (direction, depth) {
                    (Some(d), Some(z)) => {
                        let z = rounded(z + noise * sensor.sigma_at_1m * z * z, sensor.step_m);
                        [(d.x * z) as f32, (d.y * z) as f32, z as f32]
                    }
                    _ => [f32::NAN; 3],
                });
            }
        }
        Scan::new(width, height, points).expect("as many points as pixels")
    }

    /// True depth (m) along the ray `(x, y, 1)`: of the board, or else of the table behind it.
    fn depth(&self, ray: &Vector3<f64>, texture: Option<&Texture>, s: &DepthSensor) -> Option<f64> {
        let on_board = self.meet(ray, 0.0);
        let hit = on_board.filter(|(at, _)| texture.is_some_and(|t| t.covers(at)));
        let (_, depth) = hit.or_else(|| self.meet(ray, s.table_behind_m))?;
        let normal = self.camera_from_target.rotation().column(2).into_owned();
        let cosine = normal.dot(ray).abs() / ray.norm();
        (cosine > s.steepest_rad.cos()).then_some(depth)
    }

    /// Where a ray meets the plane `z = height` of the target: point there, and depth (m).
    fn meet(&self, ray: &Vector3<f64>, height: f64) -> Option<(Vector2<f64>, f64)> {
        let r = self.camera_from_target.rotation();
        let eye = -r.tr_mul(&self.camera_from_target.translation());
        let along = r.tr_mul(ray);
        let depth = (height - eye.z) / along.z;
        let at = eye + along * depth;
        (depth > 0.0 && depth.is_finite()).then(|| (Vector2::new(at.x, at.y), depth))
    }

    /// The pixels that the board can reach, `margin` more on every side.
    fn window(&self, texture: &Texture, margin: i64) -> Window {
        let whole = Window {
            left: -margin,
            top: -margin,
            right: i64::from(self.intrinsics.width) + margin,
            bottom: i64::from(self.intrinsics.height) + margin,
        };
        let outline: Option<Vec<_>> = texture
            .outline()
            .iter()
            .map(|at| {
                let p = self.camera_from_target * Point::new(at.x, at.y, 0.0);
                self.intrinsics.project(&p.vector())
            })
            .collect();
        outline.map_or(whole, |pixels| whole.around(&pixels, margin))
    }

    fn half_pixels(&self, texture: &Texture, window: &Window, optics: &Optics) -> HalfPixels {
        let (columns, rows) = window.size();
        let mut ray = RayGrid::new(self);
        let mut line = |v: i64| -> Vec<Option<Vector2<f64>>> {
            (window.left..=window.right)
                .map(|u| ray.at(u as f64 - 0.5, v as f64 - 0.5))
                .map(|d| d.and_then(|d| self.meet(&d, 0.0)).map(|(at, _)| at))
                .collect()
        };
        let mut halves = HalfPixels::new(2 * columns, 2 * rows, optics.background as f32);
        let mut above = line(window.top);
        for j in 0..rows {
            let below = line(window.top + j as i64 + 1);
            for i in 0..columns {
                let square = [above[i], above[i + 1], below[i], below[i + 1]];
                if let [Some(a), Some(b), Some(c), Some(d)] = square {
                    halves.draw(texture, optics, i, j, &[a, b, c, d]);
                }
            }
            above = below;
        }
        halves
    }

    /// Vignetting, noise and rounding.
    fn expose(&self, grey: &mut [f32], optics: &Optics, seed: u64) {
        let mut random = Random::new(seed);
        let (width, height) = (self.intrinsics.width as usize, self.intrinsics.height as usize);
        let (cx, cy) = (0.5 * (width as f64 - 1.0), 0.5 * (height as f64 - 1.0));
        let farthest = cx * cx + cy * cy;
        for (i, value) in grey.iter_mut().enumerate() {
            let (x, y) = ((i % width) as f64 - cx, (i / width) as f64 - cy);
            let light = 1.0 - optics.vignetting * (x * x + y * y) / farthest;
            let seen = f64::from(*value) * light + optics.noise * random.normal();
            *value = seen.round().clamp(0.0, 255.0) as f32;
        }
    }
}

fn blur_reach(optics: &Optics) -> f64 {
    optics.blur_px + optics.defocus_px
}

fn rounded(value: f64, step: f64) -> f64 {
    if step > 0.0 { (value / step).round() * step } else { value }
}

/// Rays `(x, y, 1)` of pixels that are asked for row by row: each inversion of the distortion
/// starts from the one before.
struct RayGrid<'a> {
    camera: &'a Intrinsics,
    last: Option<(Vector2<f64>, Vector2<f64>)>,
}

/// Neighbours are this close (px); farther away the inversion starts anew.
const NEIGHBOUR_PX: f64 = 2.0;

impl<'a> RayGrid<'a> {
    fn new(scene: &'a Scene) -> Self {
        Self { camera: &scene.intrinsics, last: None }
    }

    fn at(&mut self, u: f64, v: f64) -> Option<Vector3<f64>> {
        let pixel = Vector2::new(u, v);
        let near = self.last.filter(|(at, _)| (at - pixel).norm() < NEIGHBOUR_PX);
        let n = match near {
            Some((_, start)) => self.newton(&pixel, start),
            None => self.camera.undistort(&pixel),
        };
        self.last = n.map(|n| (pixel, n));
        n.map(|n| Vector3::new(n.x, n.y, 1.0))
    }

    /// Two steps: from a neighbour the first is good to 1e-6 px, the second to 1e-12.
    fn newton(&self, pixel: &Vector2<f64>, mut n: Vector2<f64>) -> Option<Vector2<f64>> {
        let c = self.camera;
        let d = Vector2::new((pixel.x - c.cx) / c.fx, (pixel.y - c.cy) / c.fy);
        for _ in 0..2 {
            let (at, jacobian) = c.distort(&n);
            if jacobian.determinant() < 1e-6 {
                return None;
            }
            n += jacobian.try_inverse()? * (d - at);
        }
        Some(n)
    }
}

/// A rectangle of pixels, right and bottom excluded.
#[derive(Clone, Copy)]
struct Window {
    left: i64,
    top: i64,
    right: i64,
    bottom: i64,
}

impl Window {
    fn size(&self) -> (usize, usize) {
        ((self.right - self.left).max(0) as usize, (self.bottom - self.top).max(0) as usize)
    }

    /// The part of `self` that lies around `pixels`.
    fn around(&self, pixels: &[Vector2<f64>], margin: i64) -> Self {
        let least = |f: fn(&Vector2<f64>) -> f64| {
            pixels.iter().map(f).fold(f64::INFINITY, f64::min).floor() as i64 - margin
        };
        let most = |f: fn(&Vector2<f64>) -> f64| {
            pixels.iter().map(f).fold(f64::NEG_INFINITY, f64::max).ceil() as i64 + margin
        };
        Self {
            left: self.left.max(least(|p| p.x)),
            top: self.top.max(least(|p| p.y)),
            right: self.right.min(most(|p| p.x)),
            bottom: self.bottom.min(most(|p| p.y)),
        }
    }
}

/// The scene on half pixels.
struct HalfPixels {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

/// Points of the Fibonacci lattice that integrates a half pixel crossed by an edge; an edge along
/// the rows is then placed to 1/356 px at worst.
const LATTICE: (usize, usize) = (89, 55);

impl HalfPixels {
    fn new(width: usize, height: usize, value: f32) -> Self {
        Self { width, height, values: vec![value; width * height] }
    }

    /// Draws the four halves of pixel `(i, j)`, whose corners see `square` of the target's plane.
    fn draw(
        &mut self,
        texture: &Texture,
        optics: &Optics,
        i: usize,
        j: usize,
        square: &[Vector2<f64>; 4],
    ) {
        let [a, b, c, d] = square;
        let at = |x: f64, y: f64| {
            a * ((1.0 - x) * (1.0 - y)) + b * (x * (1.0 - y)) + c * ((1.0 - x) * y) + d * (x * y)
        };
        let diagonal = (d - a).norm().max((c - b).norm());
        let middle = at(0.5, 0.5);
        if texture.clearance(&middle) > 0.6 * diagonal {
            let grey = texture.grey(&middle, optics);
            return (0..4).for_each(|k| self.set(i, j, k, grey));
        }
        for (k, (x, y)) in [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)].into_iter().enumerate()
        {
            let centre = at(x + 0.25, y + 0.25);
            let grey = if texture.clearance(&centre) > 0.3 * diagonal {
                texture.grey(&centre, optics)
            } else {
                let (n, step) = LATTICE;
                let sample = |s: usize| {
                    let (p, q) = (s as f64 + 0.5, ((s * step) % n) as f64 + 0.5);
                    texture.grey(&at(x + 0.5 * p / n as f64, y + 0.5 * q / n as f64), optics)
                };
                (0..n).map(sample).sum::<f64>() / n as f64
            };
            self.set(i, j, k, grey);
        }
    }

    /// Half `k` of pixel `(i, j)`.
    fn set(&mut self, i: usize, j: usize, k: usize, grey: f64) {
        self.values[(2 * j + k / 2) * self.width + 2 * i + k % 2] = grey as f32;
    }

    /// Gaussian, `sigma` in half pixels.
    fn blur(&mut self, sigma: f64) {
        if sigma <= 0.0 {
            return;
        }
        let reach = (4.0 * sigma).ceil() as i64;
        let weight = |k: i64| (-0.5 * (k as f64 / sigma).powi(2)).exp();
        let sum: f64 = (-reach..=reach).map(weight).sum();
        let kernel: Vec<f32> = (-reach..=reach).map(|k| (weight(k) / sum) as f32).collect();
        self.along_rows(&kernel);
        self.along_columns(&kernel);
    }

    fn along_rows(&mut self, kernel: &[f32]) {
        let (reach, width) = (kernel.len() / 2, self.width);
        let mut padded = vec![0.0; width + 2 * reach];
        for row in self.values.chunks_exact_mut(width) {
            padded[..reach].fill(row[0]);
            padded[reach..reach + width].copy_from_slice(row);
            padded[reach + width..].fill(row[width - 1]);
            row.fill(0.0);
            for (k, weight) in kernel.iter().enumerate() {
                for (out, value) in row.iter_mut().zip(&padded[k..]) {
                    *out += weight * value;
                }
            }
        }
    }

    fn along_columns(&mut self, kernel: &[f32]) {
        let reach = kernel.len() / 2;
        let mut out = vec![0.0; self.values.len()];
        for (j, row) in out.chunks_exact_mut(self.width).enumerate() {
            for (k, weight) in kernel.iter().enumerate() {
                let from = (j + k).saturating_sub(reach).min(self.height - 1) * self.width;
                for (out, value) in row.iter_mut().zip(&self.values[from..]) {
                    *out += weight * value;
                }
            }
        }
        self.values = out;
    }

    /// Disc of `radius` half pixels.
    fn defocus(&mut self, radius: f64) {
        if radius <= 0.0 {
            return;
        }
        let reach = radius.ceil() as i64;
        let share =
            |dx: i64, dy: i64| (radius + 0.5 - (dx as f64).hypot(dy as f64)).clamp(0.0, 1.0);
        let all = || (-reach..=reach).flat_map(|dy| (-reach..=reach).map(move |dx| (dx, dy)));
        let sum: f64 = all().map(|(dx, dy)| share(dx, dy)).sum();
        let (width, height) = (self.width as i64, self.height as i64);
        let seen = |x: i64, y: i64| -> f32 {
            let one = |(dx, dy): (i64, i64)| {
                let (i, j) = ((x + dx).clamp(0, width - 1), (y + dy).clamp(0, height - 1));
                self.values[(j * width + i) as usize] * (share(dx, dy) / sum) as f32
            };
            all().map(one).sum()
        };
        self.values = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| seen(x, y))
            .collect();
    }

    /// Averages 2 x 2 halves into the pixels of the picture.
    fn into_pixels(self, window: &Window, grey: &mut [f32], width: usize, height: usize) {
        let (columns, rows) = window.size();
        for j in 0..rows {
            let y = window.top + j as i64;
            if y < 0 || y >= height as i64 {
                continue;
            }
            for i in 0..columns {
                let x = window.left + i as i64;
                if x >= 0 && x < width as i64 {
                    let at = 2 * j * self.width + 2 * i;
                    let below = at + self.width;
                    let v = &self.values;
                    grey[y as usize * width + x as usize] =
                        0.25 * (v[at] + v[at + 1] + v[below] + v[below + 1]);
                }
            }
        }
    }
}
