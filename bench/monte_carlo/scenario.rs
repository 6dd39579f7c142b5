//! Kinds of simulated cells, each with one thing beside noise that is wrong.

use handeye::{
    Mount, Point, Pose, Session, Setup, SurfaceCorner, detect,
    estimate::predict::Volume,
    math::random::Random,
    simulate::{Cell, CellNoise, DepthSensor, Truth, Viewing},
};
use nalgebra::{Isometry3, Rotation3, SVector, UnitQuaternion, Vector3};

/// One kind of cell. Lengths in mm, angles in degrees.
#[derive(Clone, Copy)]
pub struct Scenario {
    /// What is particular about it.
    pub name: &'static str,
    pub setup: Setup,
    pub captures: usize,
    pub touches: usize,
    /// Robot: position (3D RMS), rotation per axis.
    pub robot: (f64, f64),
    /// Touches (3D RMS).
    pub touch: f64,
    /// The tip beyond where the robot believes it.
    pub tip: f64,
    /// How well the user says the tip is known, per axis.
    pub tip_known: Option<f64>,
    /// Depth noise at 1 m; 0 for no scans.
    pub depth: f64,
    pub fault: Fault,
}

/// What is wrong beside noise.
#[derive(Clone, Copy)]
pub enum Fault {
    None,
    /// The robot is off where it touches: mm per axis, degrees per axis.
    Local(f64, f64),
    /// One touch is off, mm.
    OneTouch(f64),
    /// Touches on neighbouring corners.
    Clustered,
    /// Depth reads too long: share, mm; both with random signs.
    Depth(f64, f64),
    /// The focal length given is too long by this share.
    Focal(f64),
}

pub const BASE: Scenario = Scenario {
    name: "independent errors",
    setup: Setup::EyeToHand,
    captures: 15,
    touches: 9,
    robot: (0.5, 0.03),
    touch: 0.3,
    tip: 0.0,
    tip_known: None,
    depth: 0.3,
    fault: Fault::None,
};
pub const IN_HAND: Scenario = Scenario { setup: Setup::EyeInHand, ..BASE };

pub const SCENARIOS: [Scenario; 24] = [
    BASE,
    Scenario { name: "10 views, 6 touches", captures: 10, touches: 6, ..BASE },
    Scenario { name: "20 views, 12 touches", captures: 20, touches: 12, ..BASE },
    Scenario { name: "robot 0.1 mm", robot: (0.1, 0.006), ..BASE },
    Scenario { name: "robot 0.1, touch 0.05 mm", robot: (0.1, 0.006), touch: 0.05, ..BASE },
    Scenario { name: "cobot 1.5 mm", robot: (1.5, 0.09), ..BASE },
    Scenario { name: "depth 2 mm", depth: 2.0, ..BASE },
    Scenario { name: "no scans", depth: 0.0, ..BASE },
    Scenario { name: "tip off 0.5 mm", tip: 0.5, ..BASE },
    Scenario { name: "tip off 1 mm", tip: 1.0, ..BASE },
    Scenario { name: "robot off where it touches", fault: Fault::Local(0.4, 0.03), ..BASE },
    Scenario { name: "tip known to 0.05 mm", tip_known: Some(0.05), ..BASE },
    Scenario {
        name: "the same, robot off where it touches",
        tip_known: Some(0.05),
        fault: Fault::Local(0.4, 0.03),
        ..BASE
    },
    Scenario { name: "the same, tip off 0.5 mm", tip_known: Some(0.05), tip: 0.5, ..BASE },
    Scenario { name: "clustered touches", fault: Fault::Clustered, ..BASE },
    Scenario { name: "4 touches", touches: 4, ..BASE },
    Scenario { name: "24 touches of 0.1 mm", touches: 24, touch: 0.1, ..BASE },
    Scenario { name: "one touch off 5 mm", fault: Fault::OneTouch(5.0), ..BASE },
    Scenario { name: "depth off 0.05 %, 0.2 mm", fault: Fault::Depth(5e-4, 0.2), ..BASE },
    Scenario { name: "depth off 0.2 %, 0.5 mm", fault: Fault::Depth(2e-3, 0.5), ..BASE },
    Scenario {
        name: "focal length off 0.2 %",
        fault: Fault::Focal(2e-3),
        depth: 0.0,
        robot: (0.1, 0.006),
        ..BASE
    },
    Scenario { name: "eye-in-hand", ..IN_HAND },
    Scenario { name: "eye-in-hand, tip off 0.5 mm", tip: 0.5, ..IN_HAND },
    Scenario { name: "eye-in-hand, robot 0.1 mm", robot: (0.1, 0.006), ..IN_HAND },
];

/// Where the answer is judged, in the camera frame.
pub fn volume(setup: Setup) -> Volume {
    let (near, far) = if setup == Setup::EyeInHand { (0.45, 0.75) } else { (0.95, 1.15) };
    Volume::of_box(&Vector3::new(-0.2, -0.15, near), &Vector3::new(0.2, 0.15, far), "the table")
}

impl Scenario {
    pub fn cell(&self, trial: u64) -> Cell {
        let base = Cell::new(self.setup, 5000 + trial);
        Cell {
            captures: self.captures,
            placements: usize::from(self.setup == Setup::EyeToHand),
            touches: if matches!(self.fault, Fault::Clustered) { 54 } else { self.touches },
            depth: (self.depth > 0.0)
                .then(|| DepthSensor { sigma_at_1m: self.depth * 1e-3, ..DepthSensor::default() }),
            noise: CellNoise {
                robot_absolute_m: self.robot.0 * 1e-3,
                robot_absolute_rad: self.robot.1.to_radians(),
                touch_m: self.touch * 1e-3,
                tip_m: self.tip * 1e-3,
                ..CellNoise::default()
            },
            viewing: Viewing { spin_rad: 90f64.to_radians(), ..base.viewing },
            ..base
        }
    }

    /// One cell's measurements, and the answer that a robot wants that errs as this one does.
    pub fn measured(&self, trial: u64) -> Option<(Session, Truth, Pose<Mount, handeye::Camera>)> {
        let (mut session, truth) = self.cell(trial).session(9000 + trial).ok()?;
        let mut x = truth.hand_eye.mount_from_camera;
        let mut random = Random::new(77 + trial);
        match self.fault {
            Fault::None => {}
            Fault::OneTouch(mm) => {
                let k = trial as usize % session.touches.len();
                let there = session.touches[k].in_base.vector();
                session.touches[k].in_base = Point::from_vector(there + Vector3::x() * mm * 1e-3);
            }
            Fault::Clustered => {
                // three by three neighbours of a 9 x 6 board
                session.touches.retain(|t| t.corner % 9 < 3 && t.corner / 9 < 3);
            }
            Fault::Local(mm, deg) => {
                let moved = displaced(&mut session, &mut random, mm * 1e-3, deg.to_radians());
                if self.setup == Setup::EyeToHand {
                    x = Pose::claim(moved * x.iso());
                }
            }
            Fault::Depth(share, mm) => {
                let sign = |r: &mut Random| if r.normal() > 0.0 { 1.0 } else { -1.0 };
                let (s, b) = (share * sign(&mut random), mm * 1e-3 * sign(&mut random));
                let read = |c: &mut SurfaceCorner| {
                    let p = c.in_camera.vector();
                    c.in_camera = Point::from_vector(p * (1.0 + s + b / p.z));
                };
                session.observations.iter_mut().for_each(|o| o.surface.iter_mut().for_each(read));
                session.placements.iter_mut().for_each(|p| p.surface.iter_mut().for_each(read));
                posed_again(&mut session);
            }
            Fault::Focal(share) => {
                let camera = session.camera?;
                let mut d = SVector::<f64, 9>::zeros();
                (d[0], d[1]) = (camera.fx * share, camera.fy * share);
                session.camera = Some(camera.moved(&d));
                posed_again(&mut session);
            }
        }
        Some((session, truth, x))
    }
}

/// Displaces the robot where it touches; where it then is.
fn displaced(session: &mut Session, random: &mut Random, step: f64, turn: f64) -> Isometry3<f64> {
    let (d, w) = (random.normal3() * step, random.normal3() * turn);
    let middle = session.touches.iter().map(|t| t.in_base.vector()).sum::<Vector3<f64>>()
        / session.touches.len() as f64;
    let r = Rotation3::new(w);
    let moved = Isometry3::from_parts(
        (d + middle - r * middle).into(),
        UnitQuaternion::from_scaled_axis(w),
    );
    for touch in &mut session.touches {
        let p = moved * nalgebra::Point3::from(touch.in_base.vector());
        touch.in_base = Point::from_vector(p.coords);
        touch.base_from_flange = touch.base_from_flange.map(|f| Pose::claim(moved * f.iso()));
    }
    moved
}

fn posed_again(session: &mut Session) {
    let (Some(target), Some(camera)) = (session.target.clone(), session.camera) else { return };
    let poses = |corners: &[_], surface: &[_]| {
        let found = detect::target_poses(corners, surface, &target, &camera);
        found.map_or(vec![], |p| detect::with_symmetries(&p, &target))
    };
    session.observations.iter_mut().for_each(|o| o.candidates = poses(&o.corners, &o.surface));
    session.placements.iter_mut().for_each(|p| p.candidates = poses(&p.corners, &p.surface));
}
