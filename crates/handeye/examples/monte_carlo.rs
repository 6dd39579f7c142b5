//! The whole calibration on simulated cells, against the truth.
//!
//! `cargo run --release -p handeye --example monte_carlo -- [TRIALS] [TRIALS OF THE FIRST] [FILE] [PART]`
//!
//! Prints a table; with a FILE other than -, writes it between the markers `monte_carlo` there. PART keeps the
//! rows whose names contain it.

#[path = "../../../bench/section.rs"]
mod section;

use std::{collections::BTreeMap, env};

use handeye::{
    Calibration, Config, Mount, Point, Pose, Session, Setup, SurfaceCorner, calibrate,
    calibration::matrix,
    detect,
    linalg::invert_spd,
    predict::{Volume, difference, tre},
    refine::KnownNoise,
    simulate::{Cell, CellNoise, DepthSensor, Random, Truth, Viewing},
};
use nalgebra::{Isometry3, Rotation3, SVector, UnitQuaternion, Vector3};

/// One kind of cell. Lengths in mm, angles in degrees.
#[derive(Clone, Copy)]
struct Scenario {
    name: &'static str,
    setup: Setup,
    captures: usize,
    touches: usize,
    /// Robot: position (3D RMS), rotation per axis.
    robot: (f64, f64),
    /// Touches (3D RMS).
    touch: f64,
    /// The tip beyond where the robot believes it.
    tip: f64,
    /// Depth noise at 1 m; 0 for no scans.
    depth: f64,
    fault: Fault,
}

/// What is wrong beside noise.
#[derive(Clone, Copy)]
enum Fault {
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

const BASE: Scenario = Scenario {
    name: "independent errors",
    setup: Setup::EyeToHand,
    captures: 15,
    touches: 9,
    robot: (0.5, 0.03),
    touch: 0.3,
    tip: 0.0,
    depth: 0.3,
    fault: Fault::None,
};
const IN_HAND: Scenario = Scenario { setup: Setup::EyeInHand, ..BASE };

const SCENARIOS: [Scenario; 21] = [
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
fn volume(setup: Setup) -> Volume {
    let (near, far) = if setup == Setup::EyeInHand { (0.45, 0.75) } else { (0.95, 1.15) };
    Volume::of_box(&Vector3::new(-0.2, -0.15, near), &Vector3::new(0.2, 0.15, far), "the table")
}

impl Scenario {
    fn cell(&self, trial: u64) -> Cell {
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
    fn measured(&self, trial: u64) -> Option<(Session, Truth, Pose<Mount, handeye::Camera>)> {
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

#[derive(Default)]
struct Sums {
    squares: BTreeMap<String, (f64, f64)>,
    trials: f64,
    none: usize,
    predicted: f64,
    bound: (f64, f64),
    nees: f64,
    covered: f64,
    worse: usize,
}

const CHI2_6_95: f64 = 12.592;

impl Sums {
    fn add(&mut self, scenario: &Scenario, trial: u64) {
        let Some((session, _, x)) = scenario.measured(trial) else { return };
        let volume = volume(scenario.setup);
        let square = |found: &Pose<Mount, handeye::Camera>| {
            let d = difference(&x, found);
            volume.points.iter().map(|p| d(p).norm_squared()).sum::<f64>()
                / volume.points.len() as f64
        };
        let result = calibrate(&session, &Config::default()).expect("a session to calibrate from");
        let Some(found) = result.hand_eye.mount_from_camera else {
            self.none += 1;
            return;
        };
        self.trials += 1.0;
        for k in &result.candidates {
            let Some(answer) = k.hand_eye.mount_from_camera else { continue };
            let sum = self.squares.entry(k.name.clone()).or_default();
            *sum = (sum.0 + square(&answer), sum.1 + 1.0);
        }
        let chosen = self.squares.entry("chosen".into()).or_default();
        *chosen = (chosen.0 + square(&found), chosen.1 + 1.0);
        self.judge(&result, &volume, &x, &found, &square);
        if let Some((own, bound)) = known(scenario, &session, &volume, &square) {
            self.bound = (self.bound.0 + bound, self.bound.1 + own);
        }
    }

    fn judge(
        &mut self,
        result: &Calibration,
        volume: &Volume,
        truth: &Pose<Mount, handeye::Camera>,
        found: &Pose<Mount, handeye::Camera>,
        square: &impl Fn(&Pose<Mount, handeye::Camera>) -> f64,
    ) {
        let Some(rows) = result.hand_eye.covariance.mount_from_camera else { return };
        let covariance = matrix(&rows);
        self.predicted += tre(volume, &covariance, |_| Vector3::zeros()).rms.powi(2);
        let error = found.local(truth);
        let nees = error.dot(&(invert_spd(&covariance).expect("a covariance") * error));
        self.nees += nees;
        self.covered += f64::from(nees < CHI2_6_95);
        let initial = result.candidates.iter().find(|k| k.name == "closed-form-shah");
        let stated = result.predicted_tre_mm.as_ref().map_or(0.0, |t| t.p95 * 1e-3);
        if let Some(start) = initial.and_then(|k| k.hand_eye.mount_from_camera) {
            self.worse += usize::from(square(found).sqrt() > square(&start).sqrt() + stated);
        }
    }

    fn rms(&self, name: &str) -> Option<f64> {
        self.squares.get(name).map(|(sum, n)| (sum / n).sqrt() * 1e3)
    }

    fn row(&self, name: &str) -> String {
        let mm = |v: Option<f64>| v.map_or("-".into(), |v| format!("{v:.3}"));
        let n = self.trials;
        let (bound, reached) = ((self.bound.0 / n).sqrt(), (self.bound.1 / n).sqrt() * 1e3);
        let chosen = self.rms("chosen");
        let single = ["closed-form-shah", "least-squares", "views-only", "two-step-svd"];
        let best = single.iter().filter_map(|k| self.rms(k)).fold(f64::INFINITY, f64::min);
        format!(
            "| {name} | {} | {} | {} | {} | **{}** | {:.3} | {:.2} | {:.2} | {:.2} | {:.2} | {:.0} | {} |\n",
            mm(self.rms("closed-form-shah")),
            mm(self.rms("closed-form-park-martin")),
            mm(self.rms("views-only")),
            mm(self.rms("two-step-svd")),
            mm(chosen),
            bound,
            reached / bound,
            chosen.unwrap_or(f64::NAN) / best,
            (self.predicted / n).sqrt() / chosen.unwrap_or(f64::NAN),
            self.nees / n / 6.0,
            100.0 * self.covered / n,
            self.worse
        )
    }
}

/// Squared error of the joint fit that knows the noise, and the bound on it: its own covariance
/// (both m², mm²).
fn known(
    scenario: &Scenario,
    session: &Session,
    volume: &Volume,
    square: &impl Fn(&Pose<Mount, handeye::Camera>) -> f64,
) -> Option<(f64, f64)> {
    let noise = scenario.cell(0).noise;
    let axis = |v: f64| Some(v / 3f64.sqrt());
    let known = KnownNoise {
        robot_rotation_rad: Some(noise.robot_absolute_rad.hypot(noise.robot_repeatability_rad)),
        robot_position_m: axis(noise.robot_absolute_m.hypot(noise.robot_repeatability_m)),
        touch_m: axis(noise.touch_m.max(1e-6)),
    };
    let result = calibrate(session, &Config { known, ..Config::default() }).ok()?;
    let joint = result.candidates.iter().find(|k| k.name == "joint")?;
    let covariance = matrix(&joint.hand_eye.covariance.mount_from_camera?);
    let bound = tre(volume, &covariance, |_| Vector3::zeros()).rms.powi(2);
    Some((square(&joint.hand_eye.mount_from_camera?), bound))
}

const HEAD: &str = "## The estimator against the truth

Simulated cells with a 9 x 6 board of 30 mm and a camera of 1920 x 1200 px about 0.9 m away: error
(root mean square, mm) over a working volume of 400 x 300 x 200 mm. Corners are off by 0.1 px, the
robot by 0.5 mm (3D) and 0.03 degrees per axis, touches by 0.3 mm, depth by 0.3 mm at 1 m, unless the
row says otherwise; 15 views, 9 touches on one placement.

- *bound*: the Cramer-Rao bound, for noise that is known; *reached*: the joint fit that knows the
  noise, over the bound.
- *best single*: the chosen answer over the best of closed form, least squares, views only and
  two-step, had one known which.
- *predicted*: the error that the chosen answer states over its true one; *NEES*: squared error in
  units of the stated covariance, over its expectation; *covered*: how often the 95 % region of the
  answer holds the truth, %.
- *worse*: trials in which the chosen answer was worse than the closed form by more than it states.

| cell | Shah | Park-Martin | views only | two-step | chosen | bound | reached | best single | predicted | NEES | covered | worse |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
";

fn main() {
    let args: Vec<String> = env::args().skip(1).collect();
    let number = |k: usize, or: u64| args.get(k).and_then(|a| a.parse().ok()).unwrap_or(or);
    let (trials, first) = (number(0, 20), number(1, 20));
    let mut table = String::from(HEAD);
    let wanted = |s: &Scenario| args.get(3).is_none_or(|part| s.name.contains(part.as_str()));
    for (k, scenario) in SCENARIOS.iter().enumerate().filter(|(_, s)| wanted(s)) {
        let mut sums = Sums::default();
        (0..if k == 0 { first } else { trials }).for_each(|t| sums.add(scenario, t));
        let row = sums.row(scenario.name);
        eprint!("{row}");
        if sums.none > 0 {
            eprintln!("   {} without an answer", sums.none);
        }
        table += &row;
    }
    table += &format!("\n{first} trials of the first row, {trials} of every other.\n");
    match args.get(2).filter(|file| *file != "-") {
        Some(file) => section::write(file, "monte_carlo", &table),
        None => print!("{table}"),
    }
}
