//! The cell of a calibration, in the base frame (m), for the 3D view.

use handeye::{
    Base, Calibration, Camera, Flange, Intrinsics, Point, Pose, Setup, Target, TargetModel,
    calibrate::result::CaptureResult,
};
use nalgebra::Vector3;

use super::scene::{Axes, Layer, Scene};

const FLANGE: &str = "#8a94a3";
const CAMERA: &str = "#2f7fd1";
const BOARD: &str = "#259a5c";
const SEEN: &str = "#e0861a";
const TOUCH: &str = "#cf3a30";

const FLOOR: &str = "#8a94a3";

/// Width and opacity of boards: what was seen is drawn over where the answer puts it.
const BOARD_LINE: (f64, f64) = (3.6, 0.6);
const SEEN_LINE: (f64, f64) = (1.3, 0.95);
/// Pitch of the lines on the floor, m, and the farthest of them.
const FLOOR_M: f64 = 0.1;
const FARTHEST: f64 = 40.0;
/// Diameter of a touched point, px.
const TOUCHED_PX: f64 = 8.0;
/// Depth of the camera's pyramid where no capture tells the size of the cell, m.
const ALONE_M: f64 = 0.15;

/// The scene of a calibration; `None` without an answer.
pub fn scene(
    c: &Calibration,
    target: Option<&TargetModel>,
    camera: Option<&Intrinsics>,
    touched: &[Point<Base>],
) -> Option<Scene> {
    let layers = layers(c, target, camera, touched)?;
    Some(Scene { axes: Axes::Base, layers, states: vec![], values: None })
}

/// What a calibration says of its cell, in the base frame; `None` without an answer.
pub fn layers(
    c: &Calibration,
    target: Option<&TargetModel>,
    camera: Option<&Intrinsics>,
    touched: &[Point<Base>],
) -> Option<Vec<Layer>> {
    let x = c.hand_eye.mount_from_camera?;
    let y = c.hand_eye.anchor_from_target;
    let size = cell_size(&c.captures);
    let outline = target.map_or_else(small_square, outline);
    let mut base = Layer::new("robot base", "#5b6675");
    base.axes(Pose::<Base, Base>::identity().iso(), 0.18 * size, "base");
    let mut frustums = Layer::new("camera", CAMERA);
    let mut seen = Layer::new("target as each capture saw it", SEEN);
    let mut board = Layer::new("target where the answer puts it", BOARD);
    let mut flange = Layer::new("flange poses", FLANGE);
    for (k, capture) in c.captures.iter().filter(|k| k.used).enumerate() {
        let base_from_flange = capture.base_from_flange;
        flange.axes(base_from_flange.iso(), 0.04 * size, "");
        let base_from_camera: Pose<Base, Camera> = match c.setup {
            Setup::EyeInHand => base_from_flange * x.rename::<Flange, Camera>(),
            Setup::EyeToHand => x.rename(),
        };
        if c.setup == Setup::EyeInHand || k == 0 {
            frustum(&mut frustums, &base_from_camera, camera, 0.10 * size);
        }
        if let Some(camera_from_target) = capture.camera_from_target {
            closed(&mut seen, &(base_from_camera * camera_from_target), &outline, SEEN_LINE);
        }
        if let (Setup::EyeToHand, Some(y)) = (c.setup, y) {
            let base_from_target = base_from_flange * y.rename::<Flange, Target>();
            closed(&mut board, &base_from_target, &outline, BOARD_LINE);
        }
    }
    if let (Setup::EyeInHand, Some(y)) = (c.setup, y) {
        closed(&mut board, &y.rename(), &outline, BOARD_LINE);
    }
    if frustums.is_empty() && c.setup == Setup::EyeToHand {
        frustum(&mut frustums, &x.rename(), camera, ALONE_M);
    }
    let mut tips = Layer::new("touched points", TOUCH);
    let places: Vec<[f32; 3]> =
        touched.iter().map(|p| p.vector().map(|x| x as f32).into()).collect();
    tips.dots(&places, TOUCHED_PX);
    let mut all = vec![base, frustums, board, seen, flange, tips, floor(&c.captures)];
    all.retain(|layer| !layer.is_empty());
    Some(all)
}

/// The plane z = 0 of the base, below the robot and all flange poses.
fn floor(captures: &[CaptureResult]) -> Layer {
    let mut layer = Layer::new(&format!("z = 0, every {:.0} mm", 1e3 * FLOOR_M), FLOOR);
    let place = |c: &CaptureResult| c.base_from_flange.translation();
    let reach = |axis: usize| {
        let ends = captures.iter().map(|c| (place(c)[axis] / FLOOR_M).clamp(-FARTHEST, FARTHEST));
        let (low, high) = ends.fold((-1.0, 1.0), |(low, high), x| (x.min(low), x.max(high)));
        (low.floor() as i32 - 1, high.ceil() as i32 + 1)
    };
    let (x, y) = (reach(0), reach(1));
    let at = |i: i32, j: i32| Vector3::new(f64::from(i), f64::from(j), 0.0) * FLOOR_M;
    for i in x.0..=x.1 {
        layer.line(&[at(i, y.0), at(i, y.1)], 1.0, 0.3);
    }
    for j in y.0..=y.1 {
        layer.line(&[at(x.0, j), at(x.1, j)], 1.0, 0.3);
    }
    layer
}

fn cell_size(captures: &[CaptureResult]) -> f64 {
    let far = captures.iter().map(|c| c.base_from_flange.translation().norm()).fold(0.0, f64::max);
    if far > 0.0 { far } else { 1.0 }
}

fn outline(target: &TargetModel) -> Vec<Vector3<f64>> {
    let ids = target.outline();
    let mut points: Vec<_> =
        ids.iter().filter_map(|&id| target.corner(id)).map(|p| p.vector()).collect();
    points.extend(points.first().copied());
    points
}

/// Where nothing tells the target's size.
fn small_square() -> Vec<Vector3<f64>> {
    let s = 0.03;
    [(-s, -s), (s, -s), (s, s), (-s, s), (-s, -s)].map(|(x, y)| Vector3::new(x, y, 0.0)).into()
}

fn frustum(layer: &mut Layer, pose: &Pose<Base, Camera>, camera: Option<&Intrinsics>, depth: f64) {
    let (x, y) = camera.map_or((0.35, 0.27), |k| {
        (0.5 * f64::from(k.width) / k.fx, 0.5 * f64::from(k.height) / k.fy)
    });
    let at = |u: f64, v: f64| (*pose * Point::new(u * depth, v * depth, depth)).vector();
    let corners = [at(-x, -y), at(x, -y), at(x, y), at(-x, y)];
    for k in 0..4 {
        layer.line(&[pose.translation(), corners[k], corners[(k + 1) % 4]], 1.4, 0.85);
    }
}

fn closed(
    layer: &mut Layer,
    pose: &Pose<Base, Target>,
    outline: &[Vector3<f64>],
    (width, alpha): (f64, f64),
) {
    let points: Vec<_> =
        outline.iter().map(|p| (*pose * Point::from_vector(*p)).vector()).collect();
    layer.line(&points, width, alpha);
}
