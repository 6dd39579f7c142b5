//! Images and scans of a board whose pose is known exactly.
//!
//! A pixel is the scene, filtered by the optics' point spread `h` and integrated over the pixel's
//! square: `I = ∫∫ (scene * h)(u, v) du dv + noise`, rounded to what the sensor resolves. The scene is
//! drawn on cells, 4 x 4 to a pixel (`canvas`), each integrated over its square (exactly where no edge or
//! one straight edge crosses it, else over a Fibonacci lattice); point spread and sensitive area of
//! a pixel are one kernel on these cells (`psf`).

use nalgebra::{Rotation3, Vector2, Vector3};

use super::{
    Conditions,
    canvas::{Canvas, Window},
    conditions::{Cover, Glow, Paper, WHITEST, meet_bent, on_paper, texture_of},
    psf::Kernel,
};
use crate::{
    Camera, GrayImage, Intrinsics, Point, Pose, Scan, Target, TargetModel, math::random::Random,
    model::texture::Texture,
};

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

/// What lens and sensor do to an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optics {
    /// Standard deviation of the Gaussian point spread, px.
    pub blur_px: f64,
    /// Radius of the disc of an out-of-focus lens, px; 0 in focus.
    pub defocus_px: f64,
    /// Length of the streak that a motion leaves while the shutter is open, px; 0 at rest.
    pub motion_px: f64,
    /// Direction of that motion in the image, rad, from x to y.
    pub motion_rad: f64,
    /// Side of the square of a pixel that is sensitive, px: 1 for the whole of it.
    pub aperture_px: f64,
    /// Standard deviation of the noise of reading the sensor, grey values.
    pub noise: f64,
    /// Shot noise: variance (grey values squared) per grey value of light.
    pub shot: f64,
    /// How finely grey values are stored.
    pub depth: BitDepth,
    /// Grey of the black squares.
    pub black: f64,
    /// Grey of the white squares.
    pub white: f64,
    /// Grey of everything behind the board.
    pub background: f64,
    /// Share of the light that is missing in the image's outermost corner.
    pub vignetting: f64,
}

impl Default for Optics {
    fn default() -> Self {
        Self {
            blur_px: 0.8,
            defocus_px: 0.0,
            motion_px: 0.0,
            motion_rad: 0.0,
            aperture_px: 1.0,
            noise: 2.0,
            shot: 0.0,
            depth: BitDepth::Eight,
            black: 40.0,
            white: 210.0,
            background: 120.0,
            vignetting: 0.0,
        }
    }
}

/// How finely a sensor resolves grey values; 255 is white in either case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BitDepth {
    /// Whole grey values.
    Eight,
    /// Sixteenths of grey values.
    Twelve,
}

impl BitDepth {
    /// Distance between two grey values that differ.
    pub fn step(self) -> f64 {
        match self {
            Self::Eight => 1.0,
            Self::Twelve => 1.0 / 16.0,
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
    /// Black is read farther by this along the optical axis, m.
    pub black_step_m: f64,
    /// All distances are too large by this share.
    pub scale: f64,
    /// The scan's frame is turned against the image's by this rotation vector (rad) ...
    pub turn_rad: Vector3<f64>,
    /// ... and moved by this (m): a point `p` of the image's frame is read at `R p + shift`.
    pub shift_m: Vector3<f64>,
}

impl Default for DepthSensor {
    fn default() -> Self {
        Self {
            sigma_at_1m: 0.5e-3,
            step_m: 0.0,
            steepest_rad: 1.3,
            table_behind_m: 0.05,
            black_step_m: 0.0,
            scale: 0.0,
            turn_rad: Vector3::zeros(),
            shift_m: Vector3::zeros(),
        }
    }
}

impl DepthSensor {
    /// Where the scan's own frame has what the image's has at `camera_from_target`.
    pub(super) fn sees(&self, camera_from_target: &Pose<Camera, Target>) -> Pose<Camera, Target> {
        let moved: Pose<Camera, Camera> =
            Pose::from_parts(Rotation3::new(self.turn_rad).matrix(), self.shift_m);
        moved * *camera_from_target
    }

    /// What it reads, without noise, for a true depth (m).
    pub(super) fn reads(&self, depth: f64, is_black: bool) -> f64 {
        (1.0 + self.scale) * depth + if is_black { self.black_step_m } else { 0.0 }
    }
}

impl Scene {
    /// The exact pixels of the corners that the camera sees, with their ids.
    pub fn corners(&self) -> Vec<(u32, Vector2<f64>)> {
        let corners = self.target.corners().into_iter().enumerate();
        corners.filter_map(|(id, c)| Some((id as u32, self.pixel_in_picture(&c)?))).collect()
    }

    /// Pixel of a point, unless it is outside of the image.
    pub(super) fn pixel_in_picture(&self, in_target: &Point<Target>) -> Option<Vector2<f64>> {
        let (width, height) = (f64::from(self.intrinsics.width), f64::from(self.intrinsics.height));
        let inside =
            |p: &Vector2<f64>| p.x > -0.5 && p.y > -0.5 && p.x < width - 0.5 && p.y < height - 0.5;
        let in_camera = self.camera_from_target * *in_target;
        self.intrinsics.project(&in_camera.vector()).filter(inside)
    }

    /// The image, with noise from `seed`.
    pub fn picture(&self, optics: &Optics, seed: u64) -> GrayImage {
        self.picture_under(&Conditions::default(), optics, seed)
    }

    /// The image under `conditions`, with noise from `seed`.
    pub fn picture_under(&self, conditions: &Conditions, optics: &Optics, seed: u64) -> GrayImage {
        let size = (self.intrinsics.width, self.intrinsics.height);
        let glow = conditions.glare.map(|g| Glow::new(self, &g, optics));
        let texture = Texture::of(&self.target);
        let paper = Paper::new(&self.target, &conditions.print);
        let cover = conditions.occlusion.map(|o| (o, Cover::new(self, &o.shape)));
        let others = self.others(conditions);
        let alone = conditions.clutter.is_none() && cover.is_none() && others.is_empty();
        let window = match &texture {
            Some(t) if alone => self.window(t, paper.as_ref(), margin(optics)),
            _ => Window::whole(size, margin(optics)),
        };
        let paint = |canvas: &mut Canvas| {
            if let Some(clutter) = &conditions.clutter {
                clutter.paint(canvas, size);
            }
            others.iter().for_each(|(scene, t)| scene.draw(canvas, t, None, optics));
            if let Some(texture) = &texture {
                self.draw(canvas, texture, paper.as_ref(), optics);
            }
            if let Some((occlusion, cover)) = &cover {
                canvas.paint(|at| (cover.depth(at) > 0.0).then(|| texture_of(occlusion, at)));
            }
        };
        develop((&window, paint), size, (conditions, glow), optics, seed)
    }

    /// The further boards, before the same camera.
    fn others(&self, conditions: &Conditions) -> Vec<(Self, Texture)> {
        let one = |(target, pose): &(TargetModel, Pose<Camera, Target>)| {
            let intrinsics = self.intrinsics;
            let scene = Self { target: target.clone(), camera_from_target: *pose, intrinsics };
            Some((scene, Texture::of(target)?))
        };
        conditions.others.iter().filter_map(one).collect()
    }

    /// The scan, one point per pixel, with noise from `seed`.
    pub fn scan(&self, sensor: &DepthSensor, seed: u64) -> Scan {
        self.scan_under(&Conditions::default(), sensor, seed)
    }

    /// The scan of a print with errors, with noise from `seed`; light has no say.
    pub(crate) fn scan_under(
        &self,
        conditions: &Conditions,
        sensor: &DepthSensor,
        seed: u64,
    ) -> Scan {
        let (width, height) = (self.intrinsics.width as usize, self.intrinsics.height as usize);
        let mut random = Random::new(seed);
        let scene =
            Self { camera_from_target: sensor.sees(&self.camera_from_target), ..self.clone() };
        let texture = Texture::of(&self.target);
        let paper = Paper::new(&self.target, &conditions.print);
        let mut ray = RayGrid::new(&scene);
        let mut points = Vec::with_capacity(width * height);
        for v in 0..height {
            for u in 0..width {
                let noise = random.normal();
                let direction = ray.at(u as f64, v as f64);
                let depth = direction
                    .and_then(|d| scene.depth(&d, (texture.as_ref(), paper.as_ref()), sensor));
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

    /// What is read, without noise, along the ray `(x, y, 1)` (m): of the board, or else of the
    /// table behind it.
    fn depth(
        &self,
        ray: &Vector3<f64>,
        (texture, paper): (Option<&Texture>, Option<&Paper>),
        s: &DepthSensor,
    ) -> Option<f64> {
        let normal = self.camera_from_target.rotation().column(2).into_owned();
        let colour = |print: &Vector2<f64>| texture.and_then(|t| t.is_black_at(print));
        let on_board =
            || self.on_board(ray, paper).and_then(|(p, z)| Some((colour(&p)?, z, normal)));
        let on_ball = || self.on_ball(ray).map(|(z, normal)| (false, z, normal));
        let on_table = || Some((false, self.meet(ray, s.table_behind_m)?.1, normal));
        let (is_black, depth, normal) = on_board().or_else(on_ball).or_else(on_table)?;
        let cosine = normal.dot(ray).abs() / ray.norm();
        (cosine > s.steepest_rad.cos()).then(|| s.reads(depth, is_black))
    }

    /// Depth (m) where a ray meets a ball, and the normal there.
    fn on_ball(&self, ray: &Vector3<f64>) -> Option<(f64, Vector3<f64>)> {
        let TargetModel::Sphere { diameter_mm: Some(diameter_mm) } = self.target else {
            return None;
        };
        let (radius, centre) = (0.5e-3 * diameter_mm, self.camera_from_target.translation());
        let along = ray.dot(&centre) / ray.norm_squared();
        let root = along.powi(2) - (centre.norm_squared() - radius * radius) / ray.norm_squared();
        let depth = (root > 0.0).then(|| along - root.sqrt()).filter(|z| *z > 0.0)?;
        Some((depth, (ray * depth - centre) / radius))
    }

    /// Where a ray meets the board: place of the faultless print (m), and depth (m).
    pub(super) fn on_board(
        &self,
        ray: &Vector3<f64>,
        paper: Option<&Paper>,
    ) -> Option<(Vector2<f64>, f64)> {
        let Some(paper) = paper else { return self.meet(ray, 0.0) };
        let at = meet_bent(paper, |height| self.meet(ray, height).map(|(at, _)| at))?;
        Some((paper.print(&at), self.meet(ray, paper.height(&at))?.1))
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
    fn window(&self, texture: &Texture, paper: Option<&Paper>, margin: i64) -> Window {
        let whole = Window::whole((self.intrinsics.width, self.intrinsics.height), margin);
        let outline: Option<Vec<_>> = texture
            .outline()
            .iter()
            .map(|at| {
                let at = on_paper(paper, at);
                let p = self.camera_from_target * Point::new(at.x, at.y, at.z);
                self.intrinsics.project(&p.vector())
            })
            .collect();
        outline.map_or(whole, |pixels| whole.around(&pixels, margin))
    }

    /// Which place of the faultless print is seen along a ray.
    fn on_print(&self, ray: &Vector3<f64>, paper: Option<&Paper>) -> Option<Vector2<f64>> {
        self.on_board(ray, paper).map(|(print, _)| print)
    }

    fn draw(&self, canvas: &mut Canvas, texture: &Texture, paper: Option<&Paper>, optics: &Optics) {
        let window = self.window(texture, paper, margin(optics)).within(&canvas.window());
        let (columns, rows) = window.size();
        if columns == 0 || rows == 0 {
            return;
        }
        let mut ray = RayGrid::new(self);
        let mut line = |v: i64| -> Vec<Option<Vector2<f64>>> {
            (window.left..=window.right)
                .map(|u| ray.at(u as f64 - 0.5, v as f64 - 0.5))
                .map(|d| d.and_then(|d| self.on_print(&d, paper)))
                .collect()
        };
        let mut above = line(window.top);
        for j in 0..rows {
            let v = window.top + j as i64;
            let below = line(v + 1);
            for i in 0..columns {
                let square = [above[i], above[i + 1], below[i], below[i + 1]];
                if let [Some(a), Some(b), Some(c), Some(d)] = square {
                    canvas.draw(texture, optics, (window.left + i as i64, v), &[a, b, c, d]);
                }
            }
            above = below;
        }
    }
}

/// Pixels beyond the image whose light spreads into it.
pub(super) fn margin(optics: &Optics) -> i64 {
    let spread = 4.0 * (optics.blur_px + optics.defocus_px) + optics.motion_px;
    2 + (spread + (optics.aperture_px - 1.0).max(0.0)).ceil() as i64
}

/// Rows of pixels that are drawn at a time: memory for all cells of a large image would be much.
const STRIP: i64 = 128;

/// Lens, light and sensor: what becomes of the scene in front of the camera, which `paint` draws
/// wherever it can reach the image: in `window`.
pub(super) fn develop(
    (window, paint): (&Window, impl Fn(&mut Canvas)),
    (width, height): (u32, u32),
    light: (&Conditions, Option<Glow>),
    optics: &Optics,
    seed: u64,
) -> GrayImage {
    let size = (width as usize, height as usize);
    let mut grey = vec![optics.background as f32; size.0 * size.1];
    let (kernel, margin) = (Kernel::of(optics), margin(optics));
    for top in (0..i64::from(height)).step_by(STRIP as usize) {
        let bottom = (top + STRIP).min(i64::from(height));
        let strip = Window { top: top - margin, bottom: bottom + margin, ..*window };
        let mut canvas = Canvas::new(strip.within(window), optics.background);
        if canvas.window().size().0 > 0 && canvas.window().size().1 > 0 {
            paint(&mut canvas);
            canvas.gather(&kernel, &mut grey, size, (top, bottom));
        }
    }
    expose(&mut grey, size, light, optics, seed);
    GrayImage::new(size.0, size.1, grey).expect("as many values as pixels")
}

/// Uneven light, vignetting, glare, noise and rounding.
fn expose(
    grey: &mut [f32],
    (width, height): (usize, usize),
    (conditions, glow): (&Conditions, Option<Glow>),
    optics: &Optics,
    seed: u64,
) {
    let mut random = Random::new(seed);
    let (cx, cy) = (0.5 * (width as f64 - 1.0), 0.5 * (height as f64 - 1.0));
    let farthest = cx * cx + cy * cy;
    let step = optics.depth.step();
    for (i, value) in grey.iter_mut().enumerate() {
        let (u, v) = ((i % width) as f64, (i / width) as f64);
        let (x, y) = (u - cx, v - cy);
        let corners = 1.0 - optics.vignetting * (x * x + y * y) / farthest;
        let slope = conditions.light.light(&Vector2::new(x / cx.max(1.0), y / cy.max(1.0)));
        let glow = glow.as_ref().map_or(0.0, |g| g.at(&Vector2::new(u, v)));
        let light = f64::from(*value) * corners * slope + glow;
        let sigma = optics.noise.hypot((optics.shot * light.max(0.0)).sqrt());
        let seen = light + sigma * random.normal();
        *value = ((seen / step).round() * step).clamp(0.0, WHITEST) as f32;
    }
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
