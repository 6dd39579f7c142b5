//! Boards in front of a camera, so that they fill a given part of its image.

use std::f64::consts::TAU;

use handeye::{
    Camera, Distortion, Intrinsics, Point, Pose, Target, TargetModel, math::random::Random,
    simulate::Scene,
};
use nalgebra::{Isometry3, UnitQuaternion, Vector2, Vector3};

/// Images of a camera: 1.3, 5 and 12 megapixels.
#[derive(Clone, Copy)]
pub struct Size {
    pub name: &'static str,
    pub width: u32,
    pub height: u32,
}

pub const SIZES: [Size; 3] = [
    Size { name: "1.3 MP", width: 1280, height: 1024 },
    Size { name: "5 MP", width: 2448, height: 2048 },
    Size { name: "12 MP", width: 4096, height: 3000 },
];

/// How far away a board is.
#[derive(Clone, Copy)]
pub enum Distance {
    /// It fills this share of the image's width or height.
    Fill(f64),
    /// The squares in its middle are so many pixels wide, seen square on.
    Square(f64),
}

/// Focal length over the image's width.
const FOCAL: f64 = 1.2;
/// `k1 k2 p1 p2`: corners of the image move by about 4 % of their distance from the middle.
const LENS: [f64; 4] = [-0.16, 0.06, 4e-4, -3e-4];
/// Paper beyond the outermost corners, in distances between corners.
const PAPER: f64 = 1.3;
/// Nearest and farthest board, m; halvings between them.
const NEAREST: f64 = 0.02;
const FARTHEST: f64 = 50.0;
const HALVINGS: usize = 60;

fn camera(size: Size, random: &mut Random) -> Intrinsics {
    let (width, height) = (f64::from(size.width), f64::from(size.height));
    let middle = |length: f64, r: &mut Random| 0.5 * length + r.between(-0.01, 0.01) * length;
    let mut brown = [0.0; 12];
    brown[..4].copy_from_slice(&LENS);
    Intrinsics {
        distortion: Distortion::BrownConrady(brown),
        ..Intrinsics::pinhole(
            size.width,
            size.height,
            FOCAL * width,
            FOCAL * width,
            middle(width, random),
            middle(height, random),
        )
    }
}

/// The board tilted by `tilt` (rad) about a random direction, turned at random in its plane, its
/// middle within `aside` of the image's (in shares of the image's size).
pub fn place(
    target: &TargetModel,
    size: Size,
    (distance, tilt, aside): (Distance, f64, f64),
    random: &mut Random,
) -> Scene {
    let intrinsics = camera(size, random);
    let (direction, roll) = (random.between(0.0, TAU), random.between(0.0, TAU));
    let axis = Vector3::new(direction.cos(), direction.sin(), 0.0);
    let turn = UnitQuaternion::from_scaled_axis(axis * tilt)
        * UnitQuaternion::from_scaled_axis(Vector3::z() * roll);
    let off = Vector2::new(random.between(-aside, aside), random.between(-aside, aside));
    let at = |depth: f64| {
        let (width, height) = (f64::from(size.width), f64::from(size.height));
        let middle = Vector3::new(
            off.x * width / intrinsics.fx * depth,
            off.y * height / intrinsics.fy * depth,
            depth,
        );
        let shift = middle - turn * centre(target);
        Pose::claim(Isometry3::from_parts(shift.into(), turn))
    };
    let depth = match distance {
        Distance::Square(px) => intrinsics.fx * target.pitch_m() / px,
        Distance::Fill(share) => nearest(|depth| fills(target, &intrinsics, &at(depth), share)),
    };
    Scene { target: target.clone(), camera_from_target: at(depth), intrinsics }
}

/// The least depth at which the board still fits.
fn nearest(fits: impl Fn(f64) -> bool) -> f64 {
    let halve = |(near, far): (f64, f64), _| {
        let middle = (near * far).sqrt();
        if fits(middle) { (near, middle) } else { (middle, far) }
    };
    (0..HALVINGS).fold((NEAREST, FARTHEST), halve).1
}

/// Whether the board's paper spans no more than `share` of the image, and lies in it.
fn fills(
    target: &TargetModel,
    camera: &Intrinsics,
    pose: &Pose<Camera, Target>,
    share: f64,
) -> bool {
    let (width, height) = (f64::from(camera.width), f64::from(camera.height));
    let (low, high) = extent(target);
    let beyond = Vector2::repeat(PAPER * target.pitch_m());
    let (low, high) = (low - beyond, high + beyond);
    let corners = [(low.x, low.y), (high.x, low.y), (low.x, high.y), (high.x, high.y)];
    let pixel = |(x, y): (f64, f64)| {
        let p = (*pose * Point::new(x, y, 0.0)).vector();
        // the lens folds over far outside of the image
        (p.x.hypot(p.y) < p.z).then(|| camera.project(&p)).flatten()
    };
    let Some(pixels) = corners.into_iter().map(pixel).collect::<Option<Vec<_>>>() else {
        return false;
    };
    let span = |f: fn(&Vector2<f64>) -> f64, length: f64| {
        let least = pixels.iter().map(f).fold(f64::INFINITY, f64::min);
        let most = pixels.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
        most - least < share * length && least > 0.0 && most < length - 1.0
    };
    span(|p| p.x, width) && span(|p| p.y, height)
}

fn extent(target: &TargetModel) -> (Vector2<f64>, Vector2<f64>) {
    let corners: Vec<_> = target.corners().iter().map(|c| c.vector().xy()).collect();
    let least = corners.iter().fold(Vector2::repeat(f64::INFINITY), |a, b| a.inf(b));
    let most = corners.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |a, b| a.sup(b));
    (least, most)
}

fn centre(target: &TargetModel) -> Vector3<f64> {
    let (low, high) = extent(target);
    (0.5 * (low + high)).push(0.0)
}
