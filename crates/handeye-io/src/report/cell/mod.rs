//! The cell of a calibration, in the base frame (m), for the 3D view.

mod data;
mod residual;
mod shapes;

use handeye::{
    Base, Calibration, Camera, Flange, Pose, Setup, Target, calibrate::result::CaptureResult,
};
use nalgebra::{Isometry3, Vector3};

pub use data::{CaptureScan, CellData};

use super::{
    colours,
    scene::{Axes, Body, Layer, Mark, Packed, Residuals, Scene},
};

const BASE: &str = "#5b6675";
const FLANGE: &str = "#8a94a3";
const CAMERA: &str = "#2f7fd1";
const BOARD: &str = "#259a5c";
const TOUCH: &str = "#cf3a30";
const FLOOR: &str = "#8a94a3";
const ARM: &str = "#a9b2be";

/// Pitch of the lines on the floor, m, and the farthest of them.
const FLOOR_M: f64 = 0.1;
const FARTHEST: f64 = 40.0;
/// Diameter of a touched point, px.
const TOUCHED_PX: f64 = 8.0;
/// Depth of the camera's pyramid where no capture tells the size of the cell, m.
const ALONE_M: f64 = 0.15;
/// Depth of the camera's pyramid, length of a flange's axes and radius of an arm's links, in sizes of the cell.
const DEPTH: f64 = 0.10;
const AXIS: f64 = 0.04;
const LINK: f64 = 0.022;
/// Pyramids of more captures are smaller, so that they do not fill the cell.
const FEW_CAPTURES: f64 = 25.0;

/// What is drawn of a calibration.
pub struct Cell {
    /// One over the other.
    pub layers: Vec<Layer>,
    /// The captures that can be selected.
    pub captures: Vec<Mark>,
    /// What their colours mean.
    pub residuals: Option<Residuals>,
    /// Radius of an arm's links, m.
    pub link_m: f64,
}

/// The scene of a calibration; `None` without an answer.
pub fn scene(c: &Calibration, data: &CellData) -> Option<Scene> {
    let Cell { layers, captures, residuals, link_m } = cell(c, data, 0)?;
    Some(Scene { captures, residuals, link_m, ..Scene::new(Axes::Base, layers) })
}

/// The cell in the base frame; `None` without an answer. Its captures are numbered from `first` on.
pub fn cell(c: &Calibration, data: &CellData, first: usize) -> Option<Cell> {
    let drawing = Drawing::new(c, data, first)?;
    let scale = residual::Scale::of(&c.captures);
    let captures =
        c.captures.iter().map(|k| residual::mark(k, &scale, drawing.pointed_at(k), data)).collect();
    let mut tips = Layer::new("touched points", TOUCH);
    let places: Vec<[f32; 3]> =
        data.touched.iter().map(|p| p.vector().map(|x| x as f32).into()).collect();
    tips.dots(&places, TOUCHED_PX);
    let mut layers = vec![
        drawing.base(),
        drawing.cameras(),
        drawing.boards(),
        drawing.seen(),
        drawing.flanges(),
        tips,
        floor(&c.captures),
    ];
    if !data.links.is_empty() {
        layers.insert(1, Layer::new("robot arm at the selected capture", ARM).with_links());
    }
    layers.retain(|layer| !layer.is_empty());
    layers.extend(drawing.scans());
    Some(Cell { layers, captures, residuals: scale.legend(), link_m: LINK * drawing.size })
}

/// What all layers are drawn from.
struct Drawing<'a> {
    c: &'a Calibration,
    data: &'a CellData,
    mount_from_camera: Isometry3<f64>,
    /// Reach of the robot in this calibration, m.
    size: f64,
    /// Number of the first capture.
    first: usize,
}

impl<'a> Drawing<'a> {
    fn new(c: &'a Calibration, data: &'a CellData, first: usize) -> Option<Self> {
        let mount_from_camera = *c.hand_eye.mount_from_camera?.iso();
        Some(Self { c, data, mount_from_camera, size: cell_size(&c.captures), first })
    }

    /// Captures and their numbers.
    fn captures(&self) -> impl Iterator<Item = (usize, &'a CaptureResult)> {
        let first = self.first;
        self.c.captures.iter().enumerate().map(move |(k, capture)| (first + k, capture))
    }

    fn base_from_camera(&self, capture: &CaptureResult) -> Pose<Base, Camera> {
        base_from_camera(self.c.setup, &self.mount_from_camera, capture)
    }

    /// Where the result puts the target.
    fn base_from_target(&self, capture: &CaptureResult) -> Option<Pose<Base, Target>> {
        let anchor_from_target = self.c.hand_eye.anchor_from_target?;
        Some(match self.c.setup {
            Setup::EyeInHand => anchor_from_target.rename(),
            Setup::EyeToHand => {
                capture.base_from_flange * anchor_from_target.rename::<Flange, Target>()
            }
        })
    }

    /// What moves with the robot stands for a capture: the camera, or the middle of the target.
    fn pointed_at(&self, capture: &CaptureResult) -> Vector3<f64> {
        let camera = || self.base_from_camera(capture);
        let seen = || capture.camera_from_target.map(|pose| camera() * pose);
        match self.c.setup {
            Setup::EyeInHand => camera().translation(),
            Setup::EyeToHand => self
                .base_from_target(capture)
                .or_else(seen)
                .map_or(capture.base_from_flange.translation(), |pose| {
                    (pose.iso() * nalgebra::Point3::from(self.middle())).coords
                }),
        }
    }

    fn middle(&self) -> Vector3<f64> {
        let has_corners = |t: &&handeye::TargetModel| !t.is_empty();
        let target = self.data.target.as_ref().filter(has_corners);
        target.map_or(Vector3::zeros(), |t| t.middle().vector())
    }

    /// A body at each capture: dashed at those that were rejected.
    fn at_captures(
        &self,
        layer: &mut Layer,
        mut body: Body,
        pose: impl Fn(&CaptureResult) -> Option<Isometry3<f64>>,
    ) {
        let mut rejected = body.dashed();
        for (number, capture) in self.captures() {
            let Some(pose) = pose(capture) else { continue };
            let body = if capture.used { &mut body } else { &mut rejected };
            body.copy(&pose, Some(number));
        }
        layer.body(body);
        layer.body(rejected);
    }

    fn base(&self) -> Layer {
        let mut layer = Layer::new("robot base", BASE);
        let mut foot = shapes::disc(0.055 * self.size, 0.025 * self.size, BASE);
        foot.copy(&Isometry3::identity(), None);
        layer.body(foot);
        layer.axes(&Isometry3::identity(), 0.18 * self.size);
        layer.label(&Vector3::zeros(), "base", None);
        layer
    }

    fn cameras(&self) -> Layer {
        let camera = self.data.camera.as_ref();
        if self.c.setup == Setup::EyeToHand {
            let depth = if self.c.captures.is_empty() { ALONE_M } else { DEPTH * self.size };
            let mut layer = Layer::new("camera", CAMERA);
            let mut body = shapes::camera(camera, depth, Some(CAMERA));
            body.copy(&self.mount_from_camera, None);
            layer.body(body);
            layer.label(&self.mount_from_camera.translation.vector, "camera", None);
            return layer;
        }
        let mut layer = Layer::new("camera", CAMERA).by_residual();
        let crowd = self.c.captures.len() as f64 / FEW_CAPTURES;
        let depth = DEPTH * self.size / crowd.max(1.0).cbrt();
        let pose = |k: &CaptureResult| Some(*self.base_from_camera(k).iso());
        self.at_captures(&mut layer, shapes::camera(camera, depth, None), pose);
        for (number, capture) in self.captures() {
            let at = self.base_from_camera(capture).translation();
            layer.label(&at, "camera", Some(number));
        }
        layer
    }

    /// Where the result puts the target.
    fn boards(&self) -> Layer {
        let target = self.data.target.as_ref();
        let name = shapes::name(target);
        let place = |k: &CaptureResult| self.base_from_target(k);
        let mut layer = Layer::new(&format!("{name} by the result"), BOARD);
        let Some(y) = self.c.hand_eye.anchor_from_target else { return layer };
        if self.c.setup == Setup::EyeInHand {
            let (mut plate, mut face) = (shapes::plate(target, Some(BOARD)), shapes::print(target));
            plate.copy(y.iso(), None);
            face.copy(y.iso(), None);
            layer.body(plate);
            layer.body(face);
            let middle = y.iso() * nalgebra::Point3::from(self.middle());
            layer.label(&middle.coords, name, None);
            return layer;
        }
        layer = layer.by_residual();
        let pose = |k: &CaptureResult| place(k).map(|pose| *pose.iso());
        self.at_captures(&mut layer, shapes::plate(target, None), pose);
        let mut face = shapes::print(target).for_selected();
        for (number, capture) in self.captures() {
            let Some(pose) = place(capture) else { continue };
            face.copy(pose.iso(), Some(number));
            layer.label(&self.pointed_at(capture), name, Some(number));
        }
        layer.body(face);
        layer
    }

    /// The target as each capture alone has it.
    fn seen(&self) -> Layer {
        let target = self.data.target.as_ref();
        let name = format!("{} as each capture saw it", shapes::name(target));
        let mut layer = Layer::new(&name, CAMERA).by_residual();
        let seen =
            |k: &CaptureResult| Some(*(self.base_from_camera(k) * k.camera_from_target?).iso());
        self.at_captures(&mut layer, shapes::outline(target), seen);
        layer
    }

    fn flanges(&self) -> Layer {
        let mut layer = Layer::new("flange poses", FLANGE);
        let radius = 0.9 * AXIS * self.size;
        let mut disc = shapes::disc(radius, 0.25 * radius, FLANGE).for_selected();
        for (number, capture) in self.captures() {
            disc.copy(capture.base_from_flange.iso(), Some(number));
            let at = capture.base_from_flange.translation();
            layer.label(&at, "flange", Some(number));
        }
        let ring = shapes::flange(radius, AXIS * self.size, FLANGE);
        self.at_captures(&mut layer, ring, |k| Some(*k.base_from_flange.iso()));
        layer.body(disc);
        layer
    }

    /// All scans in the base frame; they are many points, and are switched on by the reader.
    fn scans(&self) -> Vec<Layer> {
        let layer = |scan: &CaptureScan| {
            let (number, capture) = self.captures().find(|(_, k)| k.id == scan.capture)?;
            let colour = colours::LAYERS[number % colours::LAYERS.len()];
            let cloud = Packed::thinned(&scan.points, scan.of)?;
            let layer = Layer::new("scans, brought together by the result", colour);
            let pose = self.base_from_camera(capture);
            Some(layer.with(Some(cloud)).placed(&[*pose.iso()]).of_capture(number).hidden())
        };
        self.data.scans.iter().filter_map(layer).collect()
    }
}

/// Where the camera was.
pub fn base_from_camera(
    setup: Setup,
    mount_from_camera: &Isometry3<f64>,
    capture: &CaptureResult,
) -> Pose<Base, Camera> {
    match setup {
        Setup::EyeInHand => {
            capture.base_from_flange * Pose::<Flange, Camera>::claim(*mount_from_camera)
        }
        Setup::EyeToHand => Pose::claim(*mount_from_camera),
    }
}

/// The plane z = 0 of the base, below the robot and all flange poses.
fn floor(captures: &[CaptureResult]) -> Layer {
    let mut layer = Layer::new(&format!("z = 0, every {:.0} mm", 1e3 * FLOOR_M), FLOOR).ground();
    let place = |c: &CaptureResult| c.base_from_flange.translation();
    let reach = |axis: usize| {
        let used = captures.iter().filter(|c| c.used);
        let ends = used.map(|c| (place(c)[axis] / FLOOR_M).clamp(-FARTHEST, FARTHEST));
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

/// The farthest flange from the base, m; of rejected captures only where there are no others.
fn cell_size(captures: &[CaptureResult]) -> f64 {
    let far = |all: &mut dyn Iterator<Item = &CaptureResult>| {
        all.map(|c| c.base_from_flange.translation().norm()).fold(0.0, f64::max)
    };
    let used = far(&mut captures.iter().filter(|c| c.used));
    let far = if used > 0.0 { used } else { far(&mut captures.iter()) };
    if far > 0.0 { far } else { 1.0 }
}
