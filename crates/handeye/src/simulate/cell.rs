//! A robot, a camera and a target whose places are known exactly, and what is measured there.
//!
//! The camera sees the target from a part of a hemisphere; each view `B⁻¹ = camera_from_target`
//! asks for the robot pose `A = Y B X⁻¹`. The robot is really there up to its error: it reports
//! `base_from_flange · exp(δ)`. Positions err by so many metres in three dimensions (root mean
//! square), rotations by so many radians about each axis.

use nalgebra::{Matrix3, Rotation3, Vector2, Vector3};

use super::{
    DepthSensor, Optics, PrintErrors,
    arm::{ArmErrors, BuiltArm, usual_arm},
    conditions::{Paper, on_paper},
    robot_error::{Robot, SystematicError},
};
use crate::{
    Base, Camera, Error, Flange, HandEye, Intrinsics, Point, Pose, Setup, Target, TargetModel,
    Touch,
    math::random::Random,
    tools::plan::{Look, spread_corners},
};

/// How wrong everything is that measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellNoise {
    /// How well the robot returns to a place: position (m, 3-D root mean square).
    pub robot_repeatability_m: f64,
    /// The same: rotation (rad, about each axis).
    pub robot_repeatability_rad: f64,
    /// How far the robot is from where it says, another way in every pose: position (m, 3-D RMS).
    pub robot_absolute_m: f64,
    /// The same: rotation (rad, about each axis).
    pub robot_absolute_rad: f64,
    /// How far the arm as it was built is from the one that its controller computes with: an error
    /// that is smooth over the workspace, position (m, 3-D RMS).
    pub robot_systematic_m: f64,
    /// The same: rotation (rad, about each axis).
    pub robot_systematic_rad: f64,
    /// Corners in the image (px, each axis), where they are not detected in rendered images.
    pub corner_px: f64,
    /// How well the tip is led onto a corner (m, 3-D RMS).
    pub touch_m: f64,
    /// Distance (m) between the tool's tip and where the robot believes it; one direction.
    pub tip_m: f64,
}

impl CellNoise {
    /// None at all.
    pub const NONE: Self = Self {
        robot_repeatability_m: 0.0,
        robot_repeatability_rad: 0.0,
        robot_absolute_m: 0.0,
        robot_absolute_rad: 0.0,
        robot_systematic_m: 0.0,
        robot_systematic_rad: 0.0,
        corner_px: 0.0,
        touch_m: 0.0,
        tip_m: 0.0,
    };
}

impl Default for CellNoise {
    /// A usual industrial arm with a carefully led tip.
    fn default() -> Self {
        Self {
            robot_repeatability_m: 0.05e-3,
            robot_repeatability_rad: 0.0,
            robot_absolute_m: 0.5e-3,
            robot_absolute_rad: 0.03f64.to_radians(),
            robot_systematic_m: 0.0,
            robot_systematic_rad: 0.0,
            corner_px: 0.1,
            touch_m: 0.3e-3,
            tip_m: 0.0,
        }
    }
}

/// From where the camera sees the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewing {
    /// Least distance of the target's centre along the optical axis, m.
    pub nearest_m: f64,
    /// Largest one, m.
    pub farthest_m: f64,
    /// Largest angle between the optical axis and the target's normal, rad.
    pub tilt_rad: f64,
    /// Largest turn about the optical axis either way, rad.
    pub spin_rad: f64,
}

/// A cell; equal cells and seeds give equal measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Who carries the camera.
    pub setup: Setup,
    /// What it looks at.
    pub target: TargetModel,
    /// The camera.
    pub intrinsics: Intrinsics,
    /// Where camera and target really sit.
    pub hand_eye: HandEye,
    /// From where the captures are taken.
    pub viewing: Viewing,
    /// How wrong everything is.
    pub noise: CellNoise,
    /// How the arm was built, where the robot errs as its links make it; it adds joint values.
    pub arm: Option<ArmErrors>,
    /// The 3D camera, where there is one.
    pub depth: Option<DepthSensor>,
    /// Pixels of a scan per pixel of an image, along each side.
    pub scan_scale: f64,
    /// How far the ends of the board's x lie behind its middle, mm.
    pub bow_mm: f64,
    /// By which share it was printed too large, along x and along y.
    pub print_scale: [f64; 2],
    /// What lens and sensor do to images.
    pub optics: Optics,
    /// Robot poses with an image.
    pub captures: usize,
    /// Boards laid into the cell to be touched (eye-to-hand).
    pub placements: usize,
    /// Corners touched on each placement, or on the one fixed board (eye-in-hand).
    pub touches: usize,
    /// Where the tool's tip really is.
    pub tip_in_flange: Point<Flange>,
    /// Decides on the views and on what is touched.
    pub seed: u64,
}

/// Views are drawn until the board is in the image, this many times at most.
const MOST_DRAWS: usize = 20_000;
/// The board must be in the image with this many pitches more on every side.
const MARGIN_PITCHES: f64 = 0.6;
/// A board that lies in the cell is tilted against the camera by no more than this, rad.
const LYING_TILT_RAD: f64 = 0.3;
/// The tool is tilted against the board's normal by no more than this when it touches, rad.
const TOOL_TILT_RAD: f64 = 0.3;
// each kind of noise has random numbers of its own: more captures leave the touches as they are
const VIEWS: u64 = 1;
const LYING: u64 = 2;
pub(super) const TOOL: u64 = 3;
pub(super) const ROBOT: u64 = 4;
const PROBE: u64 = 5;
pub(super) const CORNERS: u64 = 6;
pub(super) const PICTURES: u64 = 7;
pub(super) const SCANS: u64 = 8;
const ARM: u64 = 9;

pub(super) fn random(seed: u64, kind: u64, k: usize) -> Random {
    Random::new(Random::new(seed ^ (kind << 56) ^ (k as u64 + 1).rotate_left(32)).bits())
}

impl Cell {
    /// A usual cell: 1920 x 1200 pixels, f = 1800 px, a board of 9 x 6 corners 30 mm apart,
    /// 15 captures, 12 touches. The seed also moves camera and target a little.
    pub fn new(setup: Setup, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let centre_m = Vector3::new(0.12, 0.075, 0.0);
        Self {
            setup,
            target: TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 },
            intrinsics: Intrinsics::pinhole(1920, 1200, 1800.0, 1800.0, 959.5, 599.5),
            hand_eye: usual_places(setup, &centre_m, &mut random),
            viewing: usual_viewing(setup),
            noise: CellNoise::default(),
            arm: None,
            depth: None,
            scan_scale: 1.0,
            bow_mm: 0.0,
            print_scale: [0.0; 2],
            optics: Optics::default(),
            captures: 15,
            placements: if setup == Setup::EyeToHand { 3 } else { 0 },
            touches: if setup == Setup::EyeToHand { 4 } else { 12 },
            tip_in_flange: Point::new(0.004, -0.007, 0.182),
            seed,
        }
    }

    /// Intrinsics of the scans.
    pub fn scan_intrinsics(&self) -> Intrinsics {
        if self.scan_scale == 1.0 {
            self.intrinsics
        } else {
            self.intrinsics.resized(self.scan_scale)
        }
    }

    /// Where the target is seen in captures and placements.
    pub(super) fn views(&self) -> Result<Vec<Pose<Camera, Target>>, Error> {
        let lying = Viewing { tilt_rad: LYING_TILT_RAD.min(self.viewing.tilt_rad), ..self.viewing };
        let view = |k: usize| self.view(&self.viewing, &mut random(self.seed, VIEWS, k));
        let placed = |k: usize| self.view(&lying, &mut random(self.seed, LYING, k));
        (0..self.captures).map(view).chain((0..self.placements).map(placed)).collect()
    }

    fn view(&self, viewing: &Viewing, random: &mut Random) -> Result<Pose<Camera, Target>, Error> {
        let outline = self.outline();
        for _ in 0..MOST_DRAWS {
            let view = self.draw_view(viewing, random);
            if view.is_some_and(|v| self.shows(&v, &outline)) {
                return view.ok_or_else(|| self.no_view(viewing));
            }
        }
        Err(self.no_view(viewing))
    }

    fn no_view(&self, v: &Viewing) -> Error {
        Error::Invalid(format!(
            "the board does not fit into images of {} x {} pixels from {} to {} m: move the \
             camera away, or take a smaller board",
            self.intrinsics.width, self.intrinsics.height, v.nearest_m, v.farthest_m
        ))
    }

    /// The target's centre on a random pixel, its normal tilted in a random direction.
    fn draw_view(&self, v: &Viewing, random: &mut Random) -> Option<Pose<Camera, Target>> {
        let pixel = Vector2::new(
            random.between(0.0, f64::from(self.intrinsics.width)),
            random.between(0.0, f64::from(self.intrinsics.height)),
        );
        let depth_m = random.between(v.nearest_m, v.farthest_m);
        let tilt = v.tilt_rad * random.unit().sqrt();
        let towards = random.between(-std::f64::consts::PI, std::f64::consts::PI);
        let spin = random.between(-v.spin_rad, v.spin_rad);
        let look = Look { centre: pixel, depth_m, tilt, towards, spin };
        look.pose(&self.intrinsics, &self.centre())
    }

    fn centre(&self) -> Vector3<f64> {
        let corners = self.target.corners();
        if corners.is_empty() {
            return Vector3::zeros();
        }
        corners.iter().map(Point::vector).sum::<Vector3<f64>>() / corners.len() as f64
    }

    /// Four points around the corners, in the target.
    fn outline(&self) -> [Vector3<f64>; 4] {
        let margin = MARGIN_PITCHES * self.target.pitch_m();
        let (mut low, mut high) = (self.centre(), self.centre());
        for corner in self.target.corners() {
            (low, high) = (low.inf(&corner.vector()), high.sup(&corner.vector()));
        }
        let (low, high) = (low.add_scalar(-margin), high.add_scalar(margin));
        [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)]
            .map(|(x, y)| Vector3::new(x, y, 0.0))
    }

    fn shows(&self, view: &Pose<Camera, Target>, points: &[Vector3<f64>]) -> bool {
        let (width, height) = (f64::from(self.intrinsics.width), f64::from(self.intrinsics.height));
        points.iter().all(|p| {
            let pixel = self.intrinsics.project(&(*view * Point::from_vector(*p)).vector());
            pixel.is_some_and(|p| p.x > 0.0 && p.y > 0.0 && p.x < width && p.y < height)
        })
    }

    /// Whether the camera sees all corners of the target while the flange is there.
    pub fn shows_target_at(&self, base_from_flange: &Pose<Base, Flange>) -> bool {
        let view = self.hand_eye.camera_from_target(self.setup, base_from_flange);
        let corners: Vec<Vector3<f64>> = self.target.corners().iter().map(Point::vector).collect();
        self.shows(&view, &corners)
    }

    /// What is wrong with the robot.
    pub(super) fn robot(&self) -> Robot {
        let systematic = SystematicError::draw(&self.noise, random(self.seed, ARM, 0));
        Robot { systematic, arm: self.built_arm() }
    }

    /// The arm as it was built.
    pub fn built_arm(&self) -> Option<BuiltArm> {
        let draw = |errors| BuiltArm::draw(usual_arm(), &errors, &mut random(self.seed, ARM, 1));
        self.arm.map(draw)
    }

    /// What is wrong with the board.
    pub(super) fn print_errors(&self) -> PrintErrors {
        let Self { bow_mm: bend_mm, print_scale: scale, .. } = *self;
        PrintErrors { bend_mm, scale, ..PrintErrors::default() }
    }

    /// Every touch of every board.
    pub(super) fn touch_all(&self, truth: &Truth, seed: u64) -> Option<Vec<Touch>> {
        let robot = self.robot();
        let corners = spread_corners(&self.target, self.touches);
        let boards = self.touchable(truth);
        let all = boards.iter().flat_map(|b| corners.iter().map(move |&corner| (b, corner)));
        all.enumerate()
            .map(|(k, ((name, base_from_target), corner))| {
                self.touch(&robot, (name, base_from_target, corner), truth, (seed, k))
            })
            .collect()
    }

    /// Boards that are touched: the name of each, and where it lies.
    fn touchable(&self, truth: &Truth) -> Vec<(String, Pose<Base, Target>)> {
        let HandEye { mount_from_camera, anchor_from_target } = self.hand_eye;
        match self.setup {
            Setup::EyeInHand => vec![("board".into(), anchor_from_target.rename())],
            Setup::EyeToHand => {
                let placed = &truth.camera_from_target[self.captures..];
                let base_from_camera: Pose<Base, Camera> = mount_from_camera.rename();
                let lie = |(k, v): (usize, &Pose<Camera, Target>)| {
                    (placement_name(k), base_from_camera * *v)
                };
                placed.iter().enumerate().map(lie).collect()
            }
        }
    }

    fn touch(
        &self,
        robot: &Robot,
        (placement, base_from_target, corner): (&str, &Pose<Base, Target>, u32),
        truth: &Truth,
        (seed, k): (u64, usize),
    ) -> Option<Touch> {
        let printed = self.target.corner(corner).map_or(Vector2::zeros(), |c| c.vector().xy());
        let on_board = Point::from_vector(on_paper(
            Paper::new(&self.target, &self.print_errors()).as_ref(),
            &printed,
        ));
        let mut probe = random(seed, PROBE, k);
        let missed = probe.normal3() * (self.noise.touch_m / 3f64.sqrt());
        let tip_in_base = (*base_from_target * on_board).vector() + missed;
        let rotation = base_from_target.rotation() * held(&mut random(self.seed, TOOL, k + 1));
        let flange = tip_in_base - rotation * self.tip_in_flange.vector();
        let there: Pose<Base, Flange> = Pose::from_parts(&rotation, flange);
        let (says, joints) = robot.reported(&there, &self.noise, &mut probe)?;
        let believed: Point<Flange> =
            Point::from_vector(self.tip_in_flange.vector() - truth.tip_error);
        let placement = placement.to_owned();
        let (in_base, base_from_flange) = (says * believed, Some(says));
        Some(Touch { placement, corner, in_base, base_from_flange, joints })
    }
}

/// Places of camera and target in a usual cell, moved a little at random.
fn usual_places(setup: Setup, centre_m: &Vector3<f64>, random: &mut Random) -> HandEye {
    let down = Rotation3::new(Vector3::x() * std::f64::consts::PI); // looks at the table
    let mut near = |r: Rotation3<f64>, t: [f64; 3]| {
        let turn = Rotation3::new(random.normal3() * 0.1);
        (r * turn, Vector3::from(t) + random.normal3() * 0.02)
    };
    let ((x_r, x_t), (y_r, y_t)) = match setup {
        Setup::EyeInHand => {
            (near(Rotation3::identity(), [0.06, -0.03, 0.05]), near(down, [0.55, 0.05, 0.02]))
        }
        Setup::EyeToHand => (near(down, [0.65, 0.1, 1.35]), near(down, [0.01, 0.02, 0.06])),
    };
    HandEye {
        mount_from_camera: Pose::from_parts(x_r.matrix(), x_t),
        anchor_from_target: Pose::from_parts(y_r.matrix(), y_t - y_r * centre_m),
    }
}

fn usual_viewing(setup: Setup) -> Viewing {
    let (nearest_m, farthest_m) = match setup {
        Setup::EyeInHand => (0.45, 0.75),
        Setup::EyeToHand => (0.75, 1.05),
    };
    let (tilt_rad, spin_rad) = (35f64.to_radians(), 90f64.to_radians());
    Viewing { nearest_m, farthest_m, tilt_rad, spin_rad }
}

pub(super) fn direction(random: &mut Random) -> Vector3<f64> {
    random.normal3().normalize()
}

pub(super) fn out_of_reach() -> Error {
    Error::Invalid(
        "the simulated arm does not reach all views and touches: take another seed".into(),
    )
}

/// How the tool is held over a board: its z into the board, tilted and turned.
fn held(random: &mut Random) -> Matrix3<f64> {
    let tilt = Vector3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.0);
    let turn = random.between(-1.0, 1.0);
    let rotation =
        Rotation3::new(Vector3::z() * turn) * Rotation3::new(tilt * (TOOL_TILT_RAD / 2f64.sqrt()));
    rotation.into_inner()
}

/// What nobody in a real cell knows.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// Where camera and target sit.
    pub hand_eye: HandEye,
    /// Where the target is in every image: captures first, then placements.
    pub camera_from_target: Vec<Pose<Camera, Target>>,
    /// Where the flange is in every capture.
    pub base_from_flange: Vec<Pose<Base, Flange>>,
    /// Tip minus where the robot believes it, in the flange (m).
    pub tip_error: Vector3<f64>,
}

/// Name of placement `k`.
pub fn placement_name(k: usize) -> String {
    format!("place-{}", k + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_captures_leave_the_first_ones_as_they_were() {
        let cell = Cell::new(Setup::EyeToHand, 3);
        let more = Cell { captures: 20, ..cell.clone() };
        let (few, many) = (cell.session(5).unwrap().0, more.session(5).unwrap().0);
        assert_eq!(few.observations, many.observations[..15]);
        assert_eq!(few.touches, many.touches);
    }

    #[test]
    fn a_board_too_large_for_the_picture_is_refused() {
        let small = Intrinsics::pinhole(64, 48, 1800.0, 1800.0, 31.5, 23.5);
        let cell = Cell { intrinsics: small, ..Cell::new(Setup::EyeInHand, 1) };
        let message = cell.record(1).unwrap_err().to_string();
        assert!(message.contains("does not fit into images of 64 x 48"), "{message}");
    }
}
