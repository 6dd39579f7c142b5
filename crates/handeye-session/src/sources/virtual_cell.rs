//! A cell that exists in memory alone: to try a session in the first minute, and to test everything with a known truth.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

use handeye::{
    Base, Camera, Error, Flange, GrayImage, HandEye, ImageCorner, Intrinsics, Pose, Scan, Setup,
    Target,
    math::random::Random,
    nalgebra::{Matrix2, Rotation3, UnitQuaternion, Vector2, Vector3},
    simulate::{Cell, CellNoise, DepthSensor, Optics, Scene},
    tools::plan::ArmReach,
};
use handeye_io::{CameraGuess, CellSettings, Urdf};

use super::mistakes::{Event, Mistake};
use crate::engine::rest::RobotSample;

/// What is wrong with a virtual cell, on purpose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Faults {
    /// Images come so much later, s.
    pub image_delay_s: f64,
    /// The robot creeps where it should stand, m/s.
    pub creep_m_s: f64,
    /// Likewise about an axis, rad/s.
    pub creep_rad_s: f64,
    /// What people got wrong.
    pub mistake: Option<Mistake>,
}

/// A virtual robot, camera and board.
pub struct VirtualCell {
    cell: Cell,
    faults: Faults,
    guess: CameraGuess,
    robot: Mutex<Robot>,
    places: Mutex<HandEye>,
    laid: Mutex<Laid>,
    start: Pose<Base, Flange>,
    arm: Option<Mutex<VirtualArm>>,
}

/// The arm of a robot that gives joint values.
struct VirtualArm {
    urdf: Arc<Urdf>,
    /// The last ones, rad or m.
    joints: Vec<f64>,
}

/// A board that lies in the view of the camera.
#[derive(Default)]
struct Laid {
    /// How often one was laid down.
    count: usize,
    /// Where it lies, and since when, s; `None` after it was taken away.
    there: Option<(Pose<Base, Target>, f64)>,
}

/// The robot's motions: true poses, and what it errs by at their ends.
struct Robot {
    legs: Vec<Leg>,
    random: Random,
}

struct Leg {
    starts_s: f64,
    takes_s: f64,
    from: Pose<Base, Flange>,
    to: Pose<Base, Flange>,
    errors: [Vector3<f64>; 4],
}

/// Speeds of the robot.
const SPEED_M_S: f64 = 0.4;
const SPEED_RAD_S: f64 = 1.2;
/// Legs are kept for images that come late.
const KEPT_LEGS: usize = 20;
/// What the robot reports scatters by, m and rad.
const ENCODERS: (f64, f64) = (2e-6, 2e-6);
/// How far off the first guess is, m and rad, along and about each axis.
const GUESS_OFF: (f64, f64) = (0.02, 0.05);
/// How near to a corner the tip is led, along each axis, m.
const TOUCH_M: f64 = 0.1e-3;
/// The camera's image, px.
const SIZE: (u32, u32) = (1280, 800);
/// Its focal length, px.
const FOCAL_PX: f64 = 1200.0;

impl VirtualCell {
    /// A cell; equal seeds give equal cells.
    ///
    /// # Errors
    /// A cell that shows nothing of its board.
    pub fn new(setup: Setup, seed: u64, faults: Faults) -> Result<Self, Error> {
        let centre = |pixels: u32| 0.5 * (f64::from(pixels) - 1.0);
        let camera =
            Intrinsics::pinhole(SIZE.0, SIZE.1, FOCAL_PX, FOCAL_PX, centre(SIZE.0), centre(SIZE.1));
        let noise = CellNoise {
            robot_absolute_m: 0.1e-3,
            robot_absolute_rad: 0.01f64.to_radians(),
            ..CellNoise::default()
        };
        let cell = Cell {
            intrinsics: camera,
            noise,
            captures: 1,
            touches: 0,
            placements: 0,
            ..Cell::new(setup, seed)
        };
        let mut random = Random::new(seed ^ 0x5e55_1011);
        let start = cell.record(seed)?.truth.base_from_flange[0];
        let off = Pose::from_parts(
            Rotation3::new(random.normal3() * GUESS_OFF.1).matrix(),
            random.normal3() * GUESS_OFF.0,
        );
        let guess = CameraGuess {
            mount_from_camera: cell.hand_eye.mount_from_camera * off,
            sigma_mm: GUESS_OFF.0 * 1e3,
            sigma_deg: GUESS_OFF.1.to_degrees(),
        };
        let errors = [Vector3::zeros(); 4];
        let leg = Leg { starts_s: f64::NEG_INFINITY, takes_s: 0.0, from: start, to: start, errors };
        let places = Mutex::new(cell.hand_eye);
        let robot = Mutex::new(Robot { legs: vec![leg], random });
        let laid = Mutex::default();
        Ok(Self { cell, faults, guess, robot, places, laid, start, arm: None })
    }

    /// The same with a robot that gives joint values: those of this arm, where it reaches its poses.
    #[must_use]
    pub fn with_arm(self, urdf: Arc<Urdf>) -> Self {
        let joints = ArmReach::joints_somewhere(urdf.arm(), urdf.limits(), &self.start);
        Self {
            arm: Some(Mutex::new(VirtualArm { urdf, joints: joints.unwrap_or_default() })),
            ..self
        }
    }

    /// Joint values (rad, m) at a pose, near those of before; none where the arm does not reach it, or there is none.
    fn joints(&self, there: &Pose<Base, Flange>) -> Vec<f64> {
        let Some(arm) = &self.arm else { return vec![] };
        let mut arm = arm.lock().unwrap_or_else(PoisonError::into_inner);
        let found = arm.urdf.arm().inverse(there, &arm.joints);
        if let Some(found) = &found {
            arm.joints.clone_from(found);
        }
        found.unwrap_or_default()
    }

    /// What a person would know of it, or declare of it.
    pub fn settings(&self) -> CellSettings {
        let settings = CellSettings {
            setup: self.cell.setup,
            target: self.cell.target.clone(),
            intrinsics: Some(self.cell.intrinsics),
            tolerance_mm: 0.5,
            notation: "ur".into(),
            guess: Some(self.guess),
            tip_mm: Some((self.cell.tip_in_flange.vector() * 1e3).into()),
            scans: None,
            arm: None,
        };
        match &self.faults.mistake {
            Some(mistake) => mistake.declared(settings),
            None => settings,
        }
    }

    /// Where camera and board really sit now.
    pub fn truth(&self) -> HandEye {
        *self.places.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Something happens to camera or board.
    pub fn happens(&self, event: &Event) {
        let mut places = self.places.lock().unwrap_or_else(PoisonError::into_inner);
        *places = event.after(*places);
    }

    /// Drives the robot to where it is to report that it is.
    pub fn drive(&self, to: Pose<Base, Flange>, now: f64) {
        let commanded = self.faults.mistake.as_ref().map_or(to, |mistake| mistake.commanded(&to));
        self.send(commanded, now);
    }

    fn send(&self, to: Pose<Base, Flange>, now: f64) {
        let mut robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
        let noise = &self.cell.noise;
        let (rotation, position) = (
            robot.random.normal3() * noise.robot_absolute_rad,
            robot.random.normal3() * (noise.robot_absolute_m / 3f64.sqrt()),
        );
        let (from, old) = robot.at(now, &self.faults);
        let [_, _, r, p] = old;
        // it reports `true · exp(error)`
        let there = to * error(&rotation, &position).inverse();
        let off = *(from.inverse() * there).iso();
        let takes =
            (off.translation.vector.norm() / SPEED_M_S).max(off.rotation.angle() / SPEED_RAD_S);
        let leg = Leg {
            starts_s: now,
            takes_s: 0.3 + takes,
            from,
            to: there,
            errors: [r, p, rotation, position],
        };
        robot.legs.push(leg);
        if robot.legs.len() > KEPT_LEGS {
            robot.legs.remove(0);
        }
    }

    /// Somebody lays a board into the view of the camera, where the robot reaches it; each time elsewhere.
    pub fn lay(&self, now: f64) {
        let places = self.truth();
        let mut laid = self.laid.lock().unwrap_or_else(PoisonError::into_inner);
        let placements = laid.count + 1;
        let cell = Cell { hand_eye: places, captures: 1, placements, ..self.cell.clone() };
        let Ok(recording) = cell.record(0) else { return };
        let Some(seen) = recording.truth.camera_from_target.last() else { return };
        let base_from_camera: Pose<Base, Camera> = places.mount_from_camera.rename();
        *laid = Laid { count: placements, there: Some((base_from_camera * *seen, now)) };
    }

    /// The board that lies in the view is taken away.
    pub fn take_away(&self) {
        self.laid.lock().unwrap_or_else(PoisonError::into_inner).there = None;
    }

    /// Where a board lies in the view at this moment.
    fn lying(&self, now: f64) -> Option<Pose<Base, Target>> {
        let laid = self.laid.lock().unwrap_or_else(PoisonError::into_inner);
        laid.there.filter(|(_, since)| *since <= now).map(|(there, _)| there)
    }

    /// Somebody leads the tip of its tool to a corner of the board that lies there, by hand: to two tenths of a millimetre.
    pub fn drive_tip(&self, corner: u32, now: f64) {
        let places = self.truth();
        let Some(there) = self.cell.target.corner(corner) else { return };
        let base_from_target: Pose<Base, Target> = match (self.cell.setup, self.lying(now)) {
            (Setup::EyeInHand, _) => Pose::claim(*places.anchor_from_target.iso()),
            (Setup::EyeToHand, Some(there)) => there,
            (Setup::EyeToHand, None) => return,
        };
        let by_hand = {
            let mut robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
            robot.random.normal3() * TOUCH_M
        };
        let at = (base_from_target * there).vector() + by_hand;
        // the tool points into the board
        let rotation = base_from_target.rotation();
        let tip = rotation * self.cell.tip_in_flange.vector();
        self.send(Pose::from_parts(&rotation, at - tip), now);
    }

    /// Somebody drives it to where the camera sees the board, whatever the session expects; each `number` has a pose of its own.
    ///
    /// # Errors
    /// A cell that shows nothing of its board.
    pub fn show_board(&self, number: usize, now: f64) -> Result<(), Error> {
        let cell = Cell { hand_eye: self.truth(), captures: number + 1, ..self.cell.clone() };
        self.send(cell.record(0)?.truth.base_from_flange[number], now);
        Ok(())
    }

    /// Moves it a little, in the camera's axes (mm, degrees).
    pub fn jog(&self, move_mm: [f64; 3], turn_deg: [f64; 3], now: f64) {
        let here = self.reported(now);
        let turn = Rotation3::new(Vector3::from(turn_deg).map(f64::to_radians));
        let step: Pose<Flange, Flange> =
            Pose::from_parts(turn.matrix(), Vector3::from(move_mm) * 1e-3);
        self.send(here * step, now);
    }

    /// What the robot reports.
    pub fn sample(&self, now: f64) -> RobotSample {
        let reported = match self.faults.mistake {
            Some(Mistake::Behind) => self.before(now),
            Some(Mistake::Frozen) => self.start,
            _ => self.reported(now),
        };
        let mut robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
        let noise =
            error(&(robot.random.normal3() * ENCODERS.1), &(robot.random.normal3() * ENCODERS.0));
        let noisy = reported * noise;
        let base_from_flange =
            self.faults.mistake.as_ref().map_or(noisy, |mistake| mistake.reported(&noisy));
        let joints = self.joints(&base_from_flange);
        RobotSample { time_s: now, base_from_flange, typed: vec![], joints }
    }

    /// Where the robot stood before it came here.
    fn before(&self, now: f64) -> Pose<Base, Flange> {
        let robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
        let leg = robot.legs.iter().rev().find(|leg| leg.starts_s <= now);
        leg.unwrap_or(&robot.legs[0]).from
    }

    fn reported(&self, now: f64) -> Pose<Base, Flange> {
        let robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
        let (there, [_, _, rotation, position]) = robot.at(now, &self.faults);
        there * error(&rotation, &position)
    }

    /// Where the flange really is now.
    pub fn standing(&self, now: f64) -> Pose<Base, Flange> {
        let robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
        robot.at(now, &self.faults).0
    }

    /// Where the flange really is in the image that comes at this moment.
    pub fn flange_in_image(&self, now: f64) -> Pose<Base, Flange> {
        self.standing(now - self.faults.image_delay_s)
    }

    fn scene(&self, now: f64) -> Scene {
        let places = self.truth();
        let seen = match self.lying(now - self.faults.image_delay_s) {
            Some(there) => places.mount_from_camera.inverse().rename::<Camera, Base>() * there,
            None => places.camera_from_target(self.cell.setup, &self.flange_in_image(now)),
        };
        let (target, intrinsics) = (self.cell.target.clone(), self.cell.intrinsics);
        Scene { target, camera_from_target: seen, intrinsics }
    }

    /// The corners of that image, projected with noise instead of detected: quick.
    pub fn corners(&self, now: f64, random: &mut Random) -> Vec<ImageCorner> {
        let sigma = self.cell.noise.corner_px;
        let covariance = Matrix2::identity() * sigma * sigma;
        let mut noisy = |(id, exact): (u32, Vector2<f64>)| {
            let pixel = exact + Vector2::new(random.normal(), random.normal()) * sigma;
            ImageCorner { id, pixel, covariance }
        };
        let exact = self.scene(now).corners();
        exact.into_iter().map(&mut noisy).collect()
    }

    /// What a 3D camera measures with that image, a point per pixel; number `frame` decides on its noise.
    pub fn scan(&self, now: f64, frame: u64) -> Scan {
        self.scene(now).scan(&DepthSensor::default(), frame)
    }

    /// The image that comes at this moment; number `frame` decides on its noise.
    pub fn image(&self, now: f64, frame: u64) -> GrayImage {
        let image = self.scene(now).picture(&Optics::default(), frame);
        match self.faults.mistake {
            Some(Mistake::Mirrored) => mirrored(&image).unwrap_or(image),
            _ => image,
        }
    }
}

/// The camera of a virtual cell. Rendering takes long: of a robot that stands a few images come in turn.
#[derive(Default)]
pub struct VirtualCamera {
    seen: Option<Pose<Camera, Target>>,
    standing: VecDeque<Arc<GrayImage>>,
}

/// Images of a robot that stands.
const STANDING: usize = 4;

impl VirtualCamera {
    /// The image that comes at this moment.
    pub fn image(&mut self, cell: &VirtualCell, now: f64, frame: u64) -> Arc<GrayImage> {
        let seen = cell.scene(now).camera_from_target;
        if self.seen.replace(seen) != Some(seen) {
            self.standing.clear();
        }
        let old = (self.standing.len() == STANDING).then(|| self.standing.pop_front()).flatten();
        let image = old.unwrap_or_else(|| Arc::new(cell.image(now, frame)));
        self.standing.push_back(image.clone());
        image
    }
}

impl Robot {
    /// Where it is, and what it errs by at both ends and now.
    fn at(&self, now: f64, faults: &Faults) -> (Pose<Base, Flange>, [Vector3<f64>; 4]) {
        let leg = self.legs.iter().rev().find(|leg| leg.starts_s <= now).unwrap_or(&self.legs[0]);
        let share = if leg.takes_s > 0.0 {
            ((now - leg.starts_s) / leg.takes_s).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let smooth = share * share * (3.0 - 2.0 * share);
        let off = leg.from.inverse() * leg.to;
        let turn = UnitQuaternion::from_scaled_axis(off.iso().rotation.scaled_axis() * smooth);
        let part: Pose<Flange, Flange> =
            Pose::from_parts(turn.to_rotation_matrix().matrix(), off.translation() * smooth);
        let creeping = now - (leg.starts_s.max(0.0) + leg.takes_s);
        let creep: Pose<Flange, Flange> = Pose::from_parts(
            Rotation3::new(Vector3::x() * (faults.creep_rad_s * creeping.max(0.0))).matrix(),
            Vector3::x() * (faults.creep_m_s * creeping.max(0.0)),
        );
        let [r0, p0, r1, p1] = leg.errors;
        let (r, p) = (r0 + (r1 - r0) * smooth, p0 + (p1 - p0) * smooth);
        (leg.from * part * creep, [r0, p0, r, p])
    }
}

fn error(rotation: &Vector3<f64>, position: &Vector3<f64>) -> Pose<Flange, Flange> {
    Pose::from_parts(Rotation3::new(*rotation).matrix(), *position)
}

/// As a camera gives it that swaps left and right.
fn mirrored(image: &GrayImage) -> Option<GrayImage> {
    let (width, height) = (image.width(), image.height());
    let values = image.values().chunks(width).flat_map(|row| row.iter().rev().copied());
    GrayImage::new(width, height, values.collect())
}
