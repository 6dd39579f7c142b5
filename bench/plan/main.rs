//! Views planned one after the other, in simulated cells with four arms, until the calibration says that it is good enough;
//! beside views at random, on a half-sphere and on a pyramid.
//!
//! `plan FOLDER_OF_URDFS SEEDS FIRST [OUT.json] [BENCHMARK.md]`; `arms.py` writes the URDFs, `judge.py` reads the JSON and says
//! whether anything collided. `KNOWN=1` declares the robot's noise, `ARM=scara` runs one arm alone, `TRACE=1` goes on to less of the tolerance.

mod four_axes;
#[path = "../section.rs"]
mod section;

use std::{collections::BTreeMap, env, fs, path::Path, time::Instant};

use handeye::{
    Base, Calibration, Config, Flange, HandEye, LensSigma, Observation, Point, Pose, Session,
    Setup, TargetSize, Verdict, Workspace, calibrate,
    detect::detect,
    estimate::{
        KnownNoise,
        predict::{Volume, difference},
    },
    math::{linalg::median, random::Random},
    simulate::{Cell, DepthSensor},
    tools::plan::{
        ArmReach, Cuboid, ENOUGH, ExpectedNoise, FEWEST_ENOUGH, GuessSigma, Look, Obstacle,
        Planner, Reach, Setting, Station, Surroundings, Taken, TouchNoise, Viewing,
    },
};
use handeye_io::robot::{Urdf, parts};
use nalgebra::{Isometry3, Matrix3, Rotation3, Vector2, Vector3, Vector6};
use serde_json::json;

/// The tolerance, mm at 95 %.
const TOLERANCE: f64 = 0.35;
/// That of the arm with four axes: its height comes from touches, all of which share the error of the tip.
const TOLERANCE_FOUR_AXES: f64 = 0.5;
/// No strategy takes more captures.
const MOST: usize = 60;
/// Every so many of the counts of captures of a strategy that is not planned is looked at first.
const STRIDE: usize = 4;
/// Corners that are touched at most where views leave something open.
const MOST_TOUCHES: usize = 12;
/// The first captures of an arm with four axes: until it is known where the camera is, no view is sure to show the whole board.
const BY_HAND: usize = 3;
/// How far off the first guess is.
const GUESS_MM: f64 = 50.0;
const GUESS_DEG: f64 = 10.0;

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Strategy {
    Planned,
    Random,
    HalfSphere,
    Pyramid,
}

struct Trial {
    cell: Cell,
    /// What is known well: the truth.
    exact: Planner,
    /// Where a person drives before anything is planned.
    first: Vec<Station>,
    /// Where the robot works, in the camera (eye-in-hand) or the base.
    works: Workspace,
    /// mm at 95 %.
    tolerance: f64,
}

/// Whether the robot's noise is declared, as from its data sheet; other strategies are not run then.
fn is_known() -> bool {
    env::var("KNOWN").is_ok()
}

fn is_traced() -> bool {
    env::var("TRACE").is_ok()
}

fn tolerance(arm: &str) -> f64 {
    if arm == "scara" { TOLERANCE_FOUR_AXES } else { TOLERANCE }
}

fn direction(random: &mut Random) -> Vector3<f64> {
    random.normal3().normalize()
}

/// Where the board lies, or where the board on the flange is seen, from the base, m: how far and how high the camera is.
fn place(arm: &str, setup: Setup) -> (f64, f64) {
    match (arm, setup) {
        ("kr10", Setup::EyeInHand) => (0.5, 0.0),
        // this one turns its flange up only high above its base
        ("kr10", Setup::EyeToHand) => (0.4, 1.95),
        _ => (0.45, 1.35),
    }
}

fn hand_eye(arm: &str, setup: Setup, random: &mut Random) -> HandEye {
    let down = Rotation3::new(Vector3::x() * std::f64::consts::PI);
    let centre = Vector3::new(0.12, 0.075, 0.0);
    let mut near = |r: Rotation3<f64>, t: Vector3<f64>| {
        (r * Rotation3::new(random.normal3() * 0.1), t + random.normal3() * 0.02)
    };
    let (at, high) = place(arm, setup);
    let ((x_r, x_t), (y_r, y_t)) = match setup {
        Setup::EyeInHand => (
            near(Rotation3::identity(), Vector3::new(0.06, -0.03, 0.05)),
            near(down, Vector3::new(at, 0.0, 0.02)),
        ),
        Setup::EyeToHand => {
            (near(down, Vector3::new(at, 0.0, high)), near(down, Vector3::new(0.01, 0.02, 0.06)))
        }
    };
    HandEye {
        mount_from_camera: Pose::from_parts(x_r.matrix(), x_t),
        anchor_from_target: Pose::from_parts(y_r.matrix(), y_t - y_r * centre),
    }
}

fn table() -> Obstacle {
    let shape = Cuboid {
        middle: Isometry3::translation(0.5, 0.0, -0.06),
        half: Vector3::new(0.8, 0.8, 0.05),
    };
    Obstacle { name: "table".into(), shape }
}

impl Trial {
    fn new(arm: &str, file: &Path, setup: Setup, seed: u64) -> Option<Trial> {
        let mut random = Random::new(seed ^ 0x51);
        let base = Cell::new(setup, seed);
        let mut noise = base.noise;
        noise.robot_repeatability_m = 0.0;
        let mut tip_in_flange = base.tip_in_flange;
        if arm == "scara" {
            noise.tip_m = random.normal3().norm() * four_axes::TIP_M;
            tip_in_flange = Point::from_vector(four_axes::TIP);
        }
        let hand_eye = hand_eye(arm, setup, &mut random);
        let cell = Cell {
            captures: 1,
            placements: 0,
            touches: 0,
            depth: Some(DepthSensor::default()),
            hand_eye,
            noise,
            tip_in_flange,
            ..base
        };
        let urdf = Urdf::read(file, "base_link", "tool0").expect("a URDF");
        let (solids, _) = parts(&urdf, file);
        let usual = Viewing::usual(&cell.intrinsics, &cell.target);
        let (nearest_m, farthest_m) = match setup {
            Setup::EyeInHand if arm == "scara" => (0.2, 0.6),
            Setup::EyeInHand => (0.4, 0.75),
            Setup::EyeToHand => (0.7, 1.1),
        };
        let viewing = Viewing { nearest_m, farthest_m, ..usual };
        let (at, high) = place(arm, setup);
        let works = match setup {
            Setup::EyeInHand => Workspace {
                minimum: Vector3::new(-0.15, -0.1, nearest_m),
                maximum: Vector3::new(0.15, 0.1, farthest_m),
            },
            Setup::EyeToHand => Workspace {
                minimum: Vector3::new(at - 0.2, -0.15, high - 1.25),
                maximum: Vector3::new(at + 0.2, 0.15, high - 0.85),
            },
        };
        let volume = Volume::of_box(&works.minimum, &works.maximum, "where it works");
        let volume = match setup {
            Setup::EyeInHand => volume,
            Setup::EyeToHand => {
                volume.seen_from(&hand_eye.mount_from_camera.iso().inverse(), "base")
            }
        };
        let setting = Setting {
            setup,
            target: cell.target.clone(),
            camera: cell.intrinsics,
            hand_eye,
            noise: ExpectedNoise {
                robot_position_m: 0.5e-3 / 3f64.sqrt(),
                robot_rotation_rad: 0.03f64.to_radians(),
                depth_at_1m: Some(DepthSensor::default().sigma_at_1m),
                ..ExpectedNoise::default()
            },
            volume,
        };
        let surroundings = Surroundings {
            parts: solids,
            obstacles: vec![table()],
            clearance_m: 0.01,
            ignored: vec![],
        };
        let limits = urdf.limits().to_vec();
        let mut reach = ArmReach {
            arm: urdf.arm().clone(),
            now: vec![0.0; limits.len()],
            limits,
            surroundings,
        };
        // a person drives there first: the board is seen about the middle of the image
        let firsts = if reach.arm.joints.len() < 6 { BY_HAND } else { 1 };
        let drawn = (0..400 * firsts).filter_map(|_| {
            let there = match reach.arm.joints.len() < 6 {
                true => {
                    let now: Vec<f64> =
                        reach.limits.iter().map(|(l, h)| random.between(*l, *h)).collect();
                    reach.arm.base_from_flange(&now)
                }
                false => {
                    let look = Look {
                        centre: Vector2::new(
                            random.between(700.0, 1200.0),
                            random.between(450.0, 750.0),
                        ),
                        depth_m: random.between(nearest_m + 0.05, farthest_m - 0.05),
                        tilt: random.between(0.0, 0.35),
                        towards: random.between(0.0, std::f64::consts::TAU),
                        spin: random.between(-1.5, 1.5),
                    };
                    let view = look.pose(&cell.intrinsics, &Vector3::new(0.12, 0.075, 0.0))?;
                    setting.hand_eye.base_from_flange(setup, &view)
                }
            };
            let joints = ArmReach::joints_somewhere(&reach.arm, &reach.limits, &there)?;
            let neighbours =
                reach.surroundings.clone().ignoring_neighbours(&reach.arm, &reach.limits, &[]);
            let free = neighbours.collision(&reach.arm, &joints).is_none();
            let station = Station { base_from_flange: there, joints: Some(joints) };
            (free && cell.shows_target_at(&there)).then_some(station)
        });
        let first: Vec<Station> = drawn.take(firsts).collect();
        if first.len() < firsts {
            return None;
        }
        reach.now = first[firsts - 1].joints.clone()?;
        reach.surroundings = reach.surroundings.ignoring_neighbours(&reach.arm, &reach.limits, &[]);
        let exact = Planner {
            setting,
            guess: None,
            taken: vec![],
            failed: vec![],
            viewing,
            reach: Reach::Arm(reach),
            candidates: 2000,
            threads: handeye_io::parallel::threads([]),
        };
        Some(Trial { cell, exact, first, works, tolerance: tolerance(arm) })
    }

    /// All that is measured at these poses; board and lens are known well, as after a careful calibration of both.
    fn session(&self, poses: &[Pose<Base, Flange>], touched: &[u32], seed: u64) -> Session {
        let mut session = match self.exact.reach.has_few_joints() {
            true => four_axes::session(&self.cell, poses, touched, seed),
            false => {
                let cell = Cell { captures: poses.len(), ..self.cell.clone() };
                cell.record_at(poses, seed).expect("a recording").session()
            }
        };
        session.observations.retain(|o| !o.candidates.is_empty());
        session.target_size = TargetSize::Measured(1e-4);
        session.lens_sigma = Some(LensSigma { focal_px: Some(0.3), center_px: Some(0.3) });
        session.workspace = Some(self.works);
        session
    }

    fn answer(&self, poses: &[Pose<Base, Flange>], touched: &[u32], seed: u64) -> Calibration {
        let robot = KnownNoise {
            robot_position_m: Some(0.5e-3 / 3f64.sqrt()),
            robot_rotation_rad: Some(0.03f64.to_radians()),
            ..KnownNoise::default()
        };
        let tip_m = self.exact.reach.has_few_joints().then_some(four_axes::TIP_M);
        let known = KnownNoise { tip_m, ..if is_known() { robot } else { KnownNoise::default() } };
        let config = Config { known, ..Config::default() };
        calibrate(&self.session(poses, touched, seed), &config).expect("a session")
    }

    /// Where captures are enough, mm; TRACE goes on, to see what another limit would do.
    fn limit(&self) -> f64 {
        if is_traced() { 0.7 * self.tolerance } else { ENOUGH * self.tolerance }
    }

    /// Corners that the planner wants to have touched after the first captures: of a robot that only turns about the vertical,
    /// views leave its height open.
    fn touches(&self, planner: &Planner) -> Vec<u32> {
        if !self.exact.reach.has_few_joints() {
            return vec![];
        }
        let noise = TouchNoise { tip_m: four_axes::TIP_M, ..TouchNoise::default() };
        let planned = planner.touches(MOST_TOUCHES, &noise, Some(self.tolerance));
        planned.iter().map(|touch| touch.corner).collect()
    }

    /// The 95 % point of the true error where the calibration predicts it, mm.
    fn true_error(&self, calibration: &Calibration) -> f64 {
        let Some(x) = calibration.hand_eye.mount_from_camera else { return f64::INFINITY };
        let off = difference(&self.cell.hand_eye.mount_from_camera, &x);
        let mut all: Vec<f64> =
            self.exact.setting.volume.points.iter().map(|p| off(p).norm() * 1e3).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() * 95 / 100]
    }

    /// Fixed and random strategies: their looks, in order, as far as they are reached.
    fn given(&self, strategy: Strategy, seed: u64) -> Vec<Station> {
        let mut random = Random::new(seed ^ 0xabc);
        let v = &self.exact.viewing;
        let camera = &self.cell.intrinsics;
        let centre = Vector3::new(0.12, 0.075, 0.0);
        let middle = Vector2::new(0.5 * f64::from(camera.width), 0.5 * f64::from(camera.height));
        let turn = std::f64::consts::TAU;
        let mut all = self.first.clone();
        if let Reach::Arm(reach) = &self.exact.reach
            && self.exact.reach.has_few_joints()
        {
            all.extend(four_axes::random_stations(
                reach,
                &self.cell,
                MOST - all.len(),
                &mut random,
            ));
            return all;
        }
        for k in 0..4000 {
            if all.len() >= MOST {
                break;
            }
            let ring = (k % 8) as f64 / 8.0 * turn + 0.2 * (k / 8) as f64;
            let look = match strategy {
                Strategy::Planned => break,
                Strategy::Random => Look {
                    centre: Vector2::new(
                        random.between(0.15, 0.85) * f64::from(camera.width),
                        random.between(0.15, 0.85) * f64::from(camera.height),
                    ),
                    depth_m: random.between(v.nearest_m, v.farthest_m),
                    tilt: random.between(0.0, 0.61),
                    towards: random.between(0.0, turn),
                    spin: random.between(-1.57, 1.57),
                },
                // the camera always looks at the middle of the board, from all around
                Strategy::HalfSphere => Look {
                    centre: middle,
                    depth_m: 0.5 * (v.nearest_m + v.farthest_m),
                    tilt: if k % 9 == 8 { 0.0 } else { [0.35, 0.6][k / 9 % 2] },
                    towards: ring,
                    spin: 0.0,
                },
                // the corners of two squares, one above the other, and looking straight
                Strategy::Pyramid => Look {
                    centre: middle,
                    depth_m: [v.nearest_m + 0.05, v.farthest_m - 0.05][k / 4 % 2],
                    tilt: 0.45,
                    towards: (k % 4) as f64 / 4.0 * turn + 0.785 + 0.15 * (k / 8) as f64,
                    spin: 0.3 * (k / 8) as f64,
                },
            };
            let Some(view) = look.pose(camera, &centre) else { continue };
            let there = self.cell.hand_eye.base_from_flange(self.cell.setup, &view);
            if !self.cell.shows_target_at(&there) {
                continue;
            }
            if let Ok(station) = self.exact.reach.station(&there, &all) {
                all.push(station);
            }
        }
        all
    }
}

/// What one strategy needed in one cell.
struct Run {
    /// After each capture: stated and true error, mm.
    trace: Vec<(usize, f64, f64)>,
    captures: Option<usize>,
    touches: usize,
    true_mm: f64,
    stations: Vec<Station>,
    milliseconds: Vec<f64>,
    unseen: usize,
}

fn planned(trial: &Trial, seed: u64) -> Run {
    let mut random = Random::new(seed ^ 0x77);
    let turn = direction(&mut random) * GUESS_DEG.to_radians();
    let shift = direction(&mut random) * GUESS_MM * 1e-3;
    let off = Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z);
    let mut planner = trial.exact.clone();
    planner.setting.hand_eye.mount_from_camera =
        trial.cell.hand_eye.mount_from_camera.retract(&off);
    planner.setting.hand_eye.anchor_from_target =
        Pose::from_parts(&Matrix3::identity(), Vector3::zeros());
    planner.guess = Some(GuessSigma { rotation_rad: 0.1, position_m: 0.03 });
    let mut stations = trial.first.clone();
    let (mut trace, mut milliseconds, mut unseen) = (vec![], vec![], 0);
    let ended = |captures, touches, true_mm, (trace, stations, milliseconds, unseen)| Run {
        trace,
        captures,
        touches,
        true_mm,
        stations,
        milliseconds,
        unseen,
    };
    let mut touched: Option<Vec<u32>> = None;
    loop {
        let poses: Vec<_> = stations.iter().map(|s| s.base_from_flange).collect();
        let seen = trial.session(&poses, &[], seed);
        planner.taken = taken(&seen);
        if planner.taken.len() >= FEWEST_ENOUGH {
            let touched = touched.get_or_insert_with(|| trial.touches(&planner));
            let answer = trial.answer(&poses, touched, seed);
            let touches = touched.len();
            let (stated, true_mm) = (stated(&answer), trial.true_error(&answer));
            trace.push((stations.len(), stated, true_mm));
            if stated <= trial.limit() {
                let captures = Some(stations.len());
                return ended(captures, touches, true_mm, (trace, stations, milliseconds, unseen));
            }
        }
        if stations.len() >= MOST {
            return ended(None, 0, f64::NAN, (trace, stations, milliseconds, unseen));
        }
        if let Reach::Arm(arm) = &mut planner.reach {
            arm.now = stations[stations.len() - 1].joints.clone().expect("joints");
        }
        let began = Instant::now();
        let next = planner.next();
        milliseconds.push(began.elapsed().as_secs_f64() * 1e3);
        let next = match next {
            Ok(next) => next,
            Err(error) => {
                eprintln!("after {} captures: {error}", stations.len());
                return ended(None, 0, f64::NAN, (trace, stations, milliseconds, unseen));
            }
        };
        unseen += usize::from(!trial.cell.shows_target_at(&next.station.base_from_flange));
        stations.push(next.station);
    }
}

fn taken(session: &Session) -> Vec<Taken> {
    let of = |o: &Observation| Taken {
        base_from_flange: o.base_from_flange,
        camera_from_target: o.candidates[0].camera_from_target,
    };
    session.observations.iter().map(of).collect()
}

fn fixed(trial: &Trial, strategy: Strategy, seed: u64) -> Run {
    let stations = trial.given(strategy, seed);
    let poses: Vec<_> = stations.iter().map(|s| s.base_from_flange).collect();
    let none = Run {
        trace: vec![],
        captures: None,
        touches: 0,
        true_mm: f64::NAN,
        stations: vec![],
        milliseconds: vec![],
        unseen: 0,
    };
    let first = &poses[..poses.len().min(FEWEST_ENOUGH)];
    let seen = taken(&trial.session(first, &[], seed));
    let touched = trial.touches(&Planner { taken: seen, ..trial.exact.clone() });
    // first in large steps, then within the one where they become enough
    let enough = |count: usize| {
        let answer = trial.answer(&poses[..count], &touched, seed);
        (stated(&answer) <= trial.limit()).then(|| (count, trial.true_error(&answer)))
    };
    let counts: Vec<usize> = (FEWEST_ENOUGH..=poses.len()).step_by(2).collect();
    let coarse = (0..counts.len()).step_by(STRIDE);
    let found = { coarse }.find_map(|k| {
        let there = enough(counts[k])?;
        let between = &counts[(k + 1).saturating_sub(STRIDE)..k];
        Some(between.iter().find_map(|count| enough(*count)).unwrap_or(there))
    });
    match found {
        Some((count, true_mm)) => Run { captures: Some(count), true_mm, ..none },
        None => none,
    }
}

/// The error (95 %) that an accepted calibration states, mm.
fn stated(calibration: &Calibration) -> f64 {
    let error = calibration.predicted_tre_mm.as_ref().map(|error| error.p95);
    error.filter(|_| calibration.verdict == Verdict::Accepted).unwrap_or(f64::INFINITY)
}

fn median_of(runs: &[Run]) -> f64 {
    median(runs.iter().map(|r| r.captures.map_or(MOST as f64 + 1.0, |n| n as f64)))
}

/// In how many rendered images of planned views the board is found as a whole.
fn detected(trial: &Trial, stations: &[Station], seed: u64) -> (usize, usize) {
    let poses: Vec<_> = stations.iter().map(|s| s.base_from_flange).collect();
    let cell = Cell { captures: poses.len(), ..trial.cell.clone() };
    let recording = cell.record_at(&poses, seed).expect("a recording");
    let found = (0..poses.len()).filter(|k| {
        detect(&recording.picture(*k), &cell.target).is_ok_and(|c| c.len() == cell.target.len())
    });
    (found.count(), poses.len())
}

fn main() {
    let args: Vec<String> = env::args().collect();
    let folder = Path::new(&args[1]);
    let (seeds, first): (u64, u64) =
        (args[2].parse().expect("seeds"), args[3].parse().expect("first"));
    let mut rows = vec![];
    let mut judged = vec![];
    let mut times = vec![];
    let (mut found, mut rendered) = (0, 0);
    let only = env::var("ARM").ok();
    let arms = ["ur5e", "fr3", "kr10", "scara"];
    for arm in arms.into_iter().filter(|&arm| only.as_deref().is_none_or(|only| only == arm)) {
        for setup in [Setup::EyeInHand, Setup::EyeToHand] {
            // it cannot show the board on its flange to a camera above
            if arm == "scara" && setup == Setup::EyeToHand {
                continue;
            }
            let mut all: BTreeMap<Strategy, Vec<Run>> = BTreeMap::new();
            let mut none = 0;
            for seed in first..first + seeds {
                let Some(trial) = Trial::new(arm, &folder.join(format!("{arm}.urdf")), setup, seed)
                else {
                    none += 1;
                    continue;
                };
                let run = planned(&trial, seed);
                judged.push(json!({
                    "arm": arm,
                    "setup": setup,
                    "trace": run.trace,
                    "joints": run.stations.iter().map(|s| s.joints.clone()).collect::<Vec<_>>(),
                }));
                times.extend(run.milliseconds.iter().copied());
                if seed < first + 4 {
                    let (seen, count) = detected(&trial, &run.stations, seed);
                    (found, rendered) = (found + seen, rendered + count);
                }
                all.entry(Strategy::Planned).or_default().push(run);
                let is_compared = !is_traced() && !is_known();
                // an arm that cannot tilt its flange can go to neither half-sphere nor pyramid
                let others: &[Strategy] = match (is_compared, arm) {
                    (false, _) => &[],
                    (true, "scara") => &[Strategy::Random],
                    (true, _) => &[Strategy::Random, Strategy::HalfSphere, Strategy::Pyramid],
                };
                for &strategy in others {
                    all.entry(strategy).or_default().push(fixed(&trial, strategy, seed));
                }
            }
            let Some(planned) = all.get(&Strategy::Planned) else {
                println!("{arm}: no start is found in {none} cells");
                continue;
            };
            let done: Vec<&Run> = planned.iter().filter(|r| r.captures.is_some()).collect();
            let held = done.iter().filter(|r| r.true_mm <= tolerance(arm)).count();
            let medians: Vec<f64> = all.values().map(|runs| median_of(runs)).collect();
            let views: usize = planned.iter().map(|r| r.stations.len() - 1).sum();
            let unseen: usize = planned.iter().map(|r| r.unseen).sum();
            let over = |k: usize| {
                medians.get(k).map_or("-".into(), |other| format!("{:.2}", medians[0] / other))
            };
            let touches = median(done.iter().map(|r| r.touches as f64));
            let line = format!(
                "| {arm}, {} | {} | {} | {touches} | {} | {} | {} | {} of {} | {} of {} | {unseen} of {views} |",
                match setup {
                    Setup::EyeInHand => "eye-in-hand",
                    Setup::EyeToHand => "eye-to-hand",
                },
                planned.len(),
                medians[0],
                over(1),
                over(2),
                over(3),
                done.len(),
                planned.len(),
                held,
                done.len(),
            );
            println!("{line}   (no start: {none}; medians {medians:?})");
            rows.push(line);
        }
    }
    times.sort_by(f64::total_cmp);
    let slowest = times[times.len() * 99 / 100];
    println!(
        "next view of 2000: median {:.0} ms, 99 % {slowest:.0} ms; found in {found} of {rendered} images",
        median(times.iter().copied())
    );
    if let Some(out) = args.get(4) {
        fs::write(out, serde_json::to_string(&judged).expect("JSON")).expect("a file");
    }
    if let Some(file) = args.get(5) {
        let (name, heading, noise) = match is_known() {
            true => ("plan_declared", "Planned views, the robot's noise declared", "is declared"),
            false => ("plan", "Planned views", "is not declared: the captures tell it"),
        };
        let text = format!(
            "## {heading}\n\nSimulated cells with four arms, {seeds} seeds from {first}: a robot that errs by 0.5 mm (three \
             dimensions) and 0.03 degrees per axis, which {noise}; a first guess of the camera's place that is off by {GUESS_MM} mm \
             and {GUESS_DEG} degrees, one capture to begin with ({BY_HAND} of the arm with four axes). Views are taken one after the other, until the calibration states \
             an error (95 %) below {ENOUGH} of the tolerance of {TOLERANCE} mm, {MOST} at most. The views of an arm with four axes \
             leave its height open: after {FEWEST_ENOUGH} captures the corners that the planner asks for are touched, with a tip that is \
             known to {} mm per axis and off by as much, so that its tolerance is {TOLERANCE_FOUR_AXES} mm; only random views stand \
             beside it: it can go to neither half-sphere nor pyramid.\n\n\
             - *captures*: median of those that were needed; *touches*: median of the corners touched; *over random*, *half-sphere*, *pyramid*: the same over the median \
             of views at random (board whole, up to 35 degrees of tilt), all around on a half-sphere, and on a pyramid; \
             *done*: cells that ended; *holds*: those whose true error (95 %) is below the tolerance then; *unseen*: views that \
             did not show the whole board.\n\n\
             | arm | cells | captures | touches | over random | half-sphere | pyramid | done | holds | unseen |\n|---|---|---|---|---|---|---|---|---|---|\n{}\n\n\
             The next view of 2000 ways to look, by {} threads: {:.0} ms (median), {slowest:.0} ms (99 %). In rendered images of planned views the \
             whole board is found in {found} of {rendered}.",
            four_axes::TIP_M * 1e3,
            rows.join("\n"),
            handeye_io::parallel::threads([]),
            median(times.iter().copied()),
        );
        section::write(file, name, &text);
    }
}
