//! The cell as lines and points, in the base frame (m), for the 3D view.

use handeye::{
    Base, Calibration, Camera, Flange, Intrinsics, Point, Pose, Setup, Target, TargetModel,
    calibration::CaptureResult,
};
use nalgebra::Vector3;
use serde::Serialize;

/// Everything the 3D view draws.
#[derive(Serialize, Default)]
pub struct Scene {
    lines: Vec<Line>,
    points: Vec<Dot>,
    labels: Vec<Label>,
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Serialize)]
struct Line {
    points: Vec<[f64; 3]>,
    colour: &'static str,
    width: f64,
    alpha: f64,
}

#[derive(Serialize)]
struct Dot {
    at: [f64; 3],
    colour: &'static str,
    radius: f64,
}

#[derive(Serialize)]
struct Label {
    at: [f64; 3],
    text: String,
}

/// Colours of the view, also used by its legend.
pub const FLANGE: &str = "#8a94a3";
/// Camera frustums.
pub const CAMERA: &str = "#1f6fb2";
/// Boards where the answer puts them.
pub const BOARD: &str = "#1d7a46";
/// Boards where each capture saw them.
pub const SEEN: &str = "#d97a00";
/// Touches.
pub const TOUCH: &str = "#b3261e";

/// The scene of a calibration; `None` without an answer.
pub fn scene(
    c: &Calibration,
    target: Option<&TargetModel>,
    camera: Option<&Intrinsics>,
    touched: &[Point<Base>],
) -> Option<Scene> {
    let x = c.hand_eye.mount_from_camera?;
    let y = c.hand_eye.anchor_from_target;
    let mut scene = Scene::default();
    let size = cell_size(&c.captures);
    scene.axes(&Pose::identity(), 0.18 * size, "base");
    let outline = target.map_or_else(small_cross, outline);
    for (k, capture) in c.captures.iter().filter(|k| k.used).enumerate() {
        let base_from_flange = capture.base_from_flange;
        scene.axes(&base_from_flange.rename(), 0.04 * size, "");
        let base_from_camera: Pose<Base, Camera> = match c.setup {
            Setup::EyeInHand => base_from_flange * x.rename::<Flange, Camera>(),
            Setup::EyeToHand => x.rename(),
        };
        if c.setup == Setup::EyeInHand || k == 0 {
            scene.frustum(&base_from_camera, camera, 0.10 * size);
        }
        if let Some(camera_from_target) = capture.camera_from_target {
            scene.board(&(base_from_camera * camera_from_target), &outline, SEEN, 1.0, 0.55);
        }
        if let (Setup::EyeToHand, Some(y)) = (c.setup, y) {
            let base_from_target = base_from_flange * y.rename::<Flange, Target>();
            scene.board(&base_from_target, &outline, BOARD, 1.0, 0.55);
        }
    }
    if let (Setup::EyeInHand, Some(y)) = (c.setup, y) {
        scene.board(&y.rename(), &outline, BOARD, 2.5, 1.0);
    }
    if c.captures.is_empty() && c.setup == Setup::EyeToHand {
        scene.frustum(&x.rename(), camera, 0.15);
    }
    for p in touched {
        scene.points.push(Dot { at: p.vector().into(), colour: TOUCH, radius: 4.0 });
    }
    scene.frame();
    Some(scene)
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

fn small_cross() -> Vec<Vector3<f64>> {
    let s = 0.03;
    vec![
        Vector3::new(-s, -s, 0.0),
        Vector3::new(s, -s, 0.0),
        Vector3::new(s, s, 0.0),
        Vector3::new(-s, s, 0.0),
        Vector3::new(-s, -s, 0.0),
    ]
}

impl Scene {
    fn line(&mut self, points: &[Vector3<f64>], colour: &'static str, width: f64, alpha: f64) {
        let points = points.iter().map(|p| [p.x, p.y, p.z]).collect();
        self.lines.push(Line { points, colour, width, alpha });
    }

    fn axes(&mut self, pose: &Pose<Base, Base>, length: f64, name: &str) {
        let origin = pose.translation();
        let colours = ["#c0392b", "#27994e", "#2c5fc9"];
        for (k, colour) in colours.into_iter().enumerate() {
            let tip = origin + pose.rotation().column(k) * length;
            let (width, alpha) = if name.is_empty() { (1.2, 0.7) } else { (3.0, 1.0) };
            self.line(&[origin, tip], colour, width, alpha);
        }
        if !name.is_empty() {
            self.labels.push(Label { at: origin.into(), text: name.into() });
        }
    }

    fn frustum(&mut self, pose: &Pose<Base, Camera>, camera: Option<&Intrinsics>, depth: f64) {
        let (x, y) = camera.map_or((0.35, 0.27), |k| {
            (0.5 * f64::from(k.width) / k.fx, 0.5 * f64::from(k.height) / k.fy)
        });
        let at = |u: f64, v: f64| (*pose * Point::new(u * depth, v * depth, depth)).vector();
        let corners = [at(-x, -y), at(x, -y), at(x, y), at(-x, y)];
        for k in 0..4 {
            self.line(&[pose.translation(), corners[k], corners[(k + 1) % 4]], CAMERA, 1.2, 0.8);
        }
    }

    fn board(
        &mut self,
        pose: &Pose<Base, Target>,
        outline: &[Vector3<f64>],
        colour: &'static str,
        width: f64,
        alpha: f64,
    ) {
        let points: Vec<_> =
            outline.iter().map(|p| (*pose * Point::from_vector(*p)).vector()).collect();
        self.line(&points, colour, width, alpha);
    }

    fn frame(&mut self) {
        let all =
            self.lines.iter().flat_map(|l| &l.points).chain(self.points.iter().map(|p| &p.at));
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in all {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        (self.low, self.high) = (low, high);
    }
}
