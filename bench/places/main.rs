//! Robots that err by place: is the answer as exact as it says, for a tool on the same robot?
//!
//! `cargo run --release -p handeye-bench --bin places -- [TRIALS] [FIRST SEED] [CAPTURES...] [FILE.md]`
//!
//! Prints a table; with a FILE, writes what holds of it for bare pairs between the markers `places` there.
//!
//! Variables: `ONE_BY_ONE` takes bare pairs as taken in any order (else in sequence, where drift is looked for),
//! `JOINTS` keeps joint values and the arm's model, `TOUCHED` has corners touched before and goes to others with the same
//! tool afterwards, `SAY` prints every answer.
//!
//! Of every cell the first captures are calibrated, as bare pose pairs and with their corners; 150 more, taken in the
//! same way, are where the robot works afterwards. The truth is the rigid answer that fits these best.

#[path = "../plain.rs"]
mod plain;
#[path = "../section.rs"]
mod section;

use std::env;

use handeye::{
    Anchor, Calibration, Camera, Config, HandEye, LensSigma, Mount, Point, Pose, PosePair, Session,
    Setup, Target, TargetSize, Workspace, calibrate,
    simulate::{ArmErrors, Cell, CellNoise, Viewing},
};
use nalgebra::{Matrix3x6, Matrix6, Vector3};
use plain::{as_pairs, fitted};

/// Poses where the robot works.
const FRESH: usize = 150;
/// Boards that the tool goes to afterwards, where it touches some beforehand (eye-to-hand).
const FRESH_BOARDS: usize = 40;

/// Lens and board are as they are said to be: the task measures with them, not with refined ones.
const KNOWN: (Option<LensSigma>, TargetSize) =
    (Some(LensSigma { focal_px: Some(0.01), center_px: Some(0.01) }), TargetSize::Measured(1e-6));

#[derive(Clone, Copy)]
struct Kind {
    setup: Setup,
    arm: (&'static str, f64),
    bare: bool,
    captures: usize,
}

/// What an answer is worth.
#[derive(Clone, Copy, Default)]
struct Outcome {
    accepted: bool,
    by_place: bool,
    tre_mm: f64,
    plain_mm: f64,
    white_mm: f64,
    nees: f64,
    covered: f64,
    at_task: f64,
    stated_mm: f64,
    rigid_mm: f64,
    /// Where poses are corrected: what is missed then, and how often it is as small as stated.
    corrected: Option<(f64, f64)>,
}

fn main() {
    let words: Vec<String> = env::args().skip(1).collect();
    let mut arguments = words.iter().filter_map(|a| a.parse::<u64>().ok());
    let trials = arguments.next().unwrap_or(12);
    let first = arguments.next().unwrap_or(1);
    let mut counts: Vec<usize> = arguments.map(|n| n as usize).collect();
    if counts.is_empty() {
        counts = vec![10, 15, 30];
    }
    let file = words.iter().find(|w| w.ends_with(".md"));
    let mut rows = String::new();
    println!(
        "{:<13} {:<11} {:<8} {:>3} {:>6} {:>6} | {:>6} {:>7} {:>7} {:>7} | {:>6} {:>6} {:>6} {:>7} {:>6} {:>7} | {:>6} {:>7} {:>7} {:>6}",
        "setup",
        "arm",
        "poses",
        "N",
        "acc",
        "place",
        "white",
        "TRE",
        "plain",
        "ratio",
        "NEES",
        "med",
        "cov95",
        "within",
        "once",
        "stated",
        "offer",
        "gain",
        "worst",
        "within"
    );
    let touched = env::var("TOUCHED").is_ok();
    for setup in [Setup::EyeToHand, Setup::EyeInHand] {
        let ways = if file.is_some() { &[true][..] } else { &[true, false] };
        for bare in if touched { &[false][..] } else { ways } {
            for arm in [("exact", 0.0), ("industrial", 1.0), ("cobot", 4.0)] {
                for &captures in &counts {
                    let kind = Kind { setup, arm, bare: *bare, captures };
                    rows += &report(kind, first..first + trials);
                }
            }
        }
    }
    if let Some(file) = file {
        let (name, head, columns) = match (touched, env::var("JOINTS").is_ok()) {
            (true, false) => ("places-touched", TOUCHED, TOUCHED_COLUMNS),
            (true, true) => ("places-touched-joints", WITH_BOTH, TOUCHED_COLUMNS),
            (false, true) => ("places-joints", WITH_JOINTS, COLUMNS),
            (false, false) => ("places", HEAD, COLUMNS),
        };
        let remark = format!("{trials} cells a row, seeds from {first}.");
        section::write(file, name, &format!("{head}\n{columns}\n{rows}\n{remark}"));
    }
}

const HEAD: &str = "## Robots that err by place

Simulated cells with a six-axis arm whose links, joint zeros, gears and bending differ from its model (a cobot's
four times as much as an industrial arm's and more), calibrated from bare pose pairs; 150 more poses, taken in the same way, are where the
robot works afterwards. The best answer is the rigid one that fits these best.

- *named*: in how many cells the robot is said to err by place, or to drift.
- *off*: distance of the answer from the best one, mm, root mean square over the target's points; *of plain*: the same over
  that of plain least squares.
- *squared*: the squared error of the six numbers over its stated variance, mean and median; 6 is right.
- *within*: which share of the points lies within the stated 95 % error, of the transform and at the task.
- *corrected*: in how many cells poses are corrected (`compensate`), what they are missed by then over what they were (mean
  and worst), and which share lies within the stated 95 % error.
";
const COLUMNS: &str =
    "| cell | captures | named | off | of plain | squared | within | corrected | missed | within |
|---|---|---|---|---|---|---|---|---|---|";

const WITH_JOINTS: &str = "### With joint values\n\nJoint values and the arm's model are given.\n";
const WITH_BOTH: &str = "### With touches and joint values\n\nThe same.\n";
const TOUCHED: &str = "### With touches

The same arms with the corners of pictures; twelve corners are touched before (on three boards laid into the cell, or on the
one fixed board) with 0.3 mm of hand, and the same tool goes to the corners of 40 other boards afterwards (or to the fixed
board as 150 other poses see it).

- *missed*: how far the tool is off there, mm, root mean square; *within*: which share of the corners lies within the
  stated 95 % error, of the transform and at the task.
";
const TOUCHED_COLUMNS: &str = "| cell | captures | named | missed | stated, 95 % | within |
|---|---|---|---|---|---|";

/// Prints what is found, and gives it as a row.
fn report(kind: Kind, seeds: std::ops::Range<u64>) -> String {
    let seeds: Vec<u64> = seeds.collect();
    let (low, high) = seeds.split_at(seeds.len() / 2);
    let of = |part: &[u64]| part.iter().filter_map(|s| run(kind, *s)).collect::<Vec<_>>();
    let all = std::thread::scope(|scope| {
        let other = scope.spawn(|| of(high));
        let mut all = of(low);
        all.extend(other.join().unwrap_or_default());
        all
    });
    let n = all.len().max(1) as f64;
    let mean = |f: &dyn Fn(&Outcome) -> f64| all.iter().map(f).sum::<f64>() / n;
    let rms = |f: &dyn Fn(&Outcome) -> f64| mean(&|o| f(o).powi(2)).sqrt();
    let mut nees: Vec<f64> = all.iter().map(|o| o.nees).collect();
    nees.sort_by(f64::total_cmp);
    let share = |f: &dyn Fn(&Outcome) -> bool| mean(&|o| f64::from(f(o)));
    let offered: Vec<(f64, Outcome)> =
        all.iter().filter_map(|o| Some((o.corrected?.0, *o))).collect();
    let root = |f: &dyn Fn(&(f64, Outcome)) -> f64| {
        offered.iter().map(|o| f(o).powi(2)).sum::<f64>().sqrt()
    };
    let (tre, plain) = (rms(&|o| o.tre_mm), rms(&|o| o.plain_mm));
    println!(
        "{:<13} {:<11} {:<8} {:>3} {:>6.2} {:>6.2} | {:>6.3} {:>7.3} {:>7.3} {:>7.2} | {:>6.1} {:>6.1} {:>6.2} {:>7.3} {:>6.3} {:>7.3} | {:>6.2} {:>7.2} {:>7.2} {:>6.2}",
        kind.setup.name(),
        kind.arm.0,
        if kind.bare { "bare" } else { "corners" },
        kind.captures,
        share(&|o| o.accepted),
        share(&|o| o.by_place),
        rms(&|o| o.white_mm),
        tre,
        plain,
        tre / plain,
        mean(&|o| o.nees),
        nees.get(nees.len() / 2).copied().unwrap_or(0.0),
        share(&|o| o.nees < 12.59),
        mean(&|o| o.covered),
        mean(&|o| o.at_task),
        rms(&|o| o.stated_mm),
        share(&|o| o.corrected.is_some()),
        root(&|o: &(f64, Outcome)| o.0) / root(&|o| o.1.rigid_mm),
        offered.iter().map(|o| o.0 / o.1.rigid_mm).fold(0.0, f64::max),
        offered.iter().filter_map(|o| o.1.corrected).map(|c| c.1).sum::<f64>()
            / offered.len() as f64,
    );
    if env::var("TOUCHED").is_ok() {
        return format!(
            "| {}, {} | {} | {:.2} | {tre:.3} | {:.3} | {:.2}, {:.2} |\n",
            kind.setup.name(),
            kind.arm.0,
            kind.captures,
            share(&|o| o.by_place),
            rms(&|o| o.stated_mm),
            mean(&|o| o.covered),
            mean(&|o| o.at_task),
        );
    }
    let of_offered = match offered.len() {
        0 => "- | -".to_owned(),
        n => format!(
            "{:.2}, {:.2} | {:.2}",
            root(&|o: &(f64, Outcome)| o.0) / root(&|o| o.1.rigid_mm),
            offered.iter().map(|o| o.0 / o.1.rigid_mm).fold(0.0, f64::max),
            offered.iter().filter_map(|o| o.1.corrected).map(|c| c.1).sum::<f64>() / n as f64
        ),
    };
    format!(
        "| {}, {} | {} | {:.2} | {tre:.3} | {:.2} | {:.1}, {:.1} | {:.2}, {:.2} | {:.2} | {of_offered} |\n",
        kind.setup.name(),
        kind.arm.0,
        kind.captures,
        share(&|o| o.by_place),
        tre / plain,
        mean(&|o| o.nees),
        nees.get(nees.len() / 2).copied().unwrap_or(0.0),
        mean(&|o| o.covered),
        mean(&|o| o.at_task),
        share(&|o| o.corrected.is_some()),
    )
}

fn errors(factor: f64) -> ArmErrors {
    let ArmErrors { length_m, angle_rad, gear_rad, bending_rad } = ArmErrors::default();
    let angle_rad = 0.5 * angle_rad * factor.powf(1.2);
    ArmErrors {
        length_m: 0.5 * length_m * factor,
        angle_rad,
        gear_rad: gear_rad * factor,
        bending_rad: bending_rad * factor,
    }
}

fn cell(kind: Kind, seed: u64) -> Cell {
    let base = Cell::new(kind.setup, 90_000 + seed);
    Cell {
        captures: kind.captures + FRESH,
        placements: 0,
        touches: 0,
        arm: Some(errors(kind.arm.1)),
        noise: CellNoise {
            robot_absolute_m: 0.0,
            robot_absolute_rad: 0.0,
            robot_systematic_m: 0.0,
            robot_systematic_rad: 0.0,
            ..CellNoise::default()
        },
        viewing: Viewing {
            spin_rad: 60f64.to_radians(),
            tilt_rad: 35f64.to_radians(),
            ..base.viewing
        },
        ..base
    }
}

/// A tool touches corners, goes into the answer, and goes to others afterwards: which of them it reaches as stated.
fn run_touched(kind: Kind, seed: u64) -> Option<Outcome> {
    let usual = Cell::new(kind.setup, seed);
    let placements = usual.placements + if usual.placements > 0 { FRESH_BOARDS } else { 0 };
    let cell = Cell { placements, touches: usual.touches, ..cell(kind, seed) };
    let (session, truth) = cell.session(seed).ok()?;
    let mut own = session.clone();
    own.observations.truncate(kind.captures);
    (own.lens_sigma, own.target_size) = KNOWN;
    own.placements.truncate(usual.placements);
    let known = |name: &str| own.placements.iter().any(|o| o.id == name);
    own.touches.retain(|t| usual.placements == 0 || known(&t.placement));
    if env::var("JOINTS").is_err() {
        own.arm = None;
        own.observations.iter_mut().for_each(|o| o.joints.clear());
        own.touches.iter_mut().for_each(|t| t.joints.clear());
    }
    let config = Config { max_error_mm: Some(50.0), ..Config::default() };
    let found = calibrate(&own, &config).ok()?;
    let x = found.hand_eye.mount_from_camera?;
    let noise = CellNoise { touch_m: 0.0, ..cell.noise };
    let (exact, _) = Cell { noise, ..cell.clone() }.session(seed).ok()?;
    let target = session.target.as_ref()?;
    let mut all = vec![];
    for touch in &exact.touches {
        let corner = target.corner(touch.corner)?;
        let corner: Point<Target> = Point::from_vector(corner.vector());
        let seen_from: Vec<(Pose<handeye::Base, Mount>, Pose<Camera, Target>)> = match kind.setup {
            Setup::EyeToHand if known(&touch.placement) => vec![],
            Setup::EyeToHand => {
                let k = exact.placements.iter().position(|o| o.id == touch.placement)?;
                vec![(Pose::identity(), truth.camera_from_target[cell.captures + k])]
            }
            Setup::EyeInHand => (kind.captures..cell.captures)
                .map(|k| {
                    let flange = exact.observations[k].base_from_flange.rename();
                    (flange, truth.camera_from_target[k])
                })
                .collect(),
        };
        // the tip is known by then: the answer is for a robot that knows it
        let tip = touch.base_from_flange? * cell.tip_in_flange;
        all.extend(seen_from.iter().map(|(mount, camera)| {
            ((*mount * x * *camera * corner).vector() - tip.vector()).norm() * 1e3
        }));
    }
    let stated = found.predicted_tre_mm.as_ref()?;
    if env::var("SAY").is_ok() {
        let codes: Vec<&str> = found.warnings.iter().map(|w| w.code.as_ref()).collect();
        println!("    {seed} {} {codes:?} {:?} {:?}", found.method, stated.p95, stated.at_task_p95);
    }
    let within = |mm: f64| all.iter().filter(|e| **e <= mm).count() as f64 / all.len() as f64;
    Some(Outcome {
        accepted: found.verdict == handeye::Verdict::Accepted,
        by_place: is_named(&found),
        tre_mm: (all.iter().map(|e| e * e).sum::<f64>() / all.len() as f64).sqrt(),
        covered: within(stated.p95),
        at_task: within(stated.at_task_p95.unwrap_or(stated.p95)),
        stated_mm: stated.p95,
        ..Outcome::default()
    })
}

fn run(kind: Kind, seed: u64) -> Option<Outcome> {
    if env::var("TOUCHED").is_ok() {
        return run_touched(kind, seed);
    }
    let cell = cell(kind, seed);
    let (session, truth) = cell.session(seed).ok()?;
    let points: Vec<Vector3<f64>> =
        session.target.as_ref()?.corners().iter().map(Point::vector).collect();
    let middle = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let centre = Pose::<Target, Target>::from_parts(&nalgebra::Matrix3::identity(), middle);
    let pair = |k: usize| PosePair {
        anchor_from_mount: kind.setup.anchor_from_mount(session.observations[k].base_from_flange),
        camera_from_target: truth.camera_from_target[k] * centre,
    };
    let fresh: Vec<PosePair> = (kind.captures..kind.captures + FRESH).map(pair).collect();
    let region = env::var("REGION").ok().map(|how| Region::new(&fresh, kind.setup, how == "given"));
    let fresh = region.as_ref().map_or(fresh.clone(), |r| r.inside(&fresh));
    let lever = (points.iter().map(|p| (p - middle).norm_squared()).sum::<f64>() * 2.0
        / 3.0
        / points.len() as f64)
        .sqrt();
    let HandEye { mount_from_camera, anchor_from_target } = cell.hand_eye;
    let start = HandEye { mount_from_camera, anchor_from_target: anchor_from_target * centre };
    let best = fitted(&fresh, &start, lever);
    let mut own = Session { placements: vec![], touches: vec![], ..session.clone() };
    (own.lens_sigma, own.target_size) = KNOWN;
    own.observations.truncate(kind.captures);
    own.in_sequence = kind.bare && env::var("ONE_BY_ONE").is_err();
    if env::var("JOINTS").is_err() {
        own.arm = None;
        own.observations.iter_mut().for_each(|o| o.joints.clear());
    }
    let seen: Vec<PosePair> = own
        .observations
        .iter()
        .map(|o| PosePair {
            anchor_from_mount: kind.setup.anchor_from_mount(o.base_from_flange),
            camera_from_target: o.candidates[0].camera_from_target * centre,
        })
        .collect();
    let plain = fitted(&seen, &start, lever);
    if kind.bare {
        own = as_pairs(&own, |o| Some(o.candidates[0].camera_from_target * centre));
    }
    own.workspace = region.filter(|r| r.is_given).map(|r| r.bounds);
    let config = Config { max_error_mm: Some(50.0), ..Config::default() };
    let found = calibrate(&own, &config).ok()?;
    if env::var("SAY").is_ok() {
        let codes: Vec<&str> = found.warnings.iter().map(|w| w.code.as_ref()).collect();
        println!(
            "    {seed} {} {:?} {codes:?}",
            found.method,
            found.predicted_tre_mm.as_ref().map(|t| (t.rms, t.p95))
        );
    }
    judged(&found, kind.setup, (&best, &plain), &fresh, &points, &centre)
}

/// A part of where the robot works: the half of the targets that is farthest along the base's x (eye-to-hand), or nearest
/// to the camera.
struct Region {
    bounds: Workspace,
    setup: Setup,
    is_given: bool,
}

impl Region {
    fn new(fresh: &[PosePair], setup: Setup, is_given: bool) -> Self {
        let mut all: Vec<Vector3<f64>> = fresh.iter().map(|p| place(setup, p)).collect();
        match setup {
            Setup::EyeToHand => all.sort_by(|a, b| b.x.total_cmp(&a.x)),
            Setup::EyeInHand => all.sort_by(|a, b| a.z.total_cmp(&b.z)),
        }
        all.truncate(fresh.len() / 2);
        let low = all.iter().fold(all[0], |low, p| low.inf(p));
        let high = all.iter().fold(all[0], |high, p| high.sup(p));
        Self { bounds: Workspace { minimum: low, maximum: high }, setup, is_given }
    }

    fn inside(&self, fresh: &[PosePair]) -> Vec<PosePair> {
        let Workspace { minimum, maximum } = &self.bounds;
        let is_inside = |p: &&PosePair| {
            let at = place(self.setup, p);
            (0..3).all(|k| minimum[k] <= at[k] && at[k] <= maximum[k])
        };
        fresh.iter().filter(is_inside).copied().collect()
    }
}

/// Where the target is: in the base, or in the camera.
fn place(setup: Setup, pair: &PosePair) -> Vector3<f64> {
    match setup {
        Setup::EyeToHand => pair.anchor_from_mount.inverse().translation(),
        Setup::EyeInHand => pair.camera_from_target.translation(),
    }
}

/// Whether the robot is said to err by place or by its arm, or something to drift.
fn is_named(found: &Calibration) -> bool {
    let codes = ["robot-errs-by-place", "arm-deviates"];
    found.method == "drift" || found.warnings.iter().any(|w| codes.contains(&w.code.as_str()))
}

fn judged(
    found: &Calibration,
    setup: Setup,
    (best, plain): (&HandEye, &HandEye),
    fresh: &[PosePair],
    points: &[Vector3<f64>],
    centre: &Pose<Target, Target>,
) -> Option<Outcome> {
    let x = found.hand_eye.mount_from_camera?;
    let y = found.hand_eye.anchor_from_target?;
    let y = if found.captures.iter().all(|c| c.corners == 0) { y } else { y * *centre };
    let covariance = found.hand_eye.covariance.mount_from_camera?;
    let covariance = Matrix6::from_fn(|i, j| covariance[i][j]);
    let d = x.local(&best.mount_from_camera);
    let nees = d.dot(&(covariance.try_inverse()? * d));
    let stated = found.predicted_tre_mm.as_ref()?;
    let off = |x: &Pose<Mount, Camera>| distance(x, &best.mount_from_camera, fresh, points, centre);
    let task = |h: &HandEye| missed(h, fresh, points, centre);
    let own = HandEye { mount_from_camera: x, anchor_from_target: y };
    let all = task(&own);
    let within = |mm: f64| all.iter().filter(|e| **e <= mm).count() as f64 / all.len() as f64;
    let joint = found.candidates.iter().find(|c| c.name == "joint" || c.name == "views-only");
    let white = joint.and_then(|c| c.hand_eye.mount_from_camera);
    Some(Outcome {
        accepted: found.verdict == handeye::Verdict::Accepted,
        by_place: is_named(found),
        tre_mm: off(&x),
        white_mm: white.map_or(0.0, |x| off(&x)),
        plain_mm: off(&plain.mount_from_camera),
        nees,
        covered: within(stated.p95),
        at_task: within(stated.at_task_p95.unwrap_or(stated.p95)),
        stated_mm: stated.p95,
        rigid_mm: (all.iter().map(|e| e * e).sum::<f64>() / all.len() as f64).sqrt(),
        corrected: corrected(found, setup, fresh, points, centre),
    })
}

/// What is missed where poses are corrected (RMS, mm), and how often it is as small as stated.
fn corrected(
    found: &Calibration,
    setup: Setup,
    fresh: &[PosePair],
    points: &[Vector3<f64>],
    centre: &Pose<Target, Target>,
) -> Option<(f64, f64)> {
    let model = found.compensation.as_ref()?.model.as_ref()?;
    let bare = found.captures.iter().all(|c| c.corners == 0);
    let y = model.anchor_from_target;
    let y = if bare { y } else { y * *centre };
    let (mut sum, mut within, mut count) = (0.0, 0.0, 0.0);
    for pair in fresh {
        let reported: Pose<handeye::Base, handeye::Flange> = match setup {
            Setup::EyeInHand => pair.anchor_from_mount.rename(),
            Setup::EyeToHand => pair.anchor_from_mount.inverse().rename(),
        };
        let corrected = model.actual(&reported);
        let there = setup.anchor_from_mount(corrected.base_from_flange);
        let flange = corrected.base_from_flange;
        for p in points {
            let p = centre.inverse() * Point::from_vector(*p);
            let seen = model.rigid * (pair.camera_from_target * p);
            let off = (there * seen).vector() - (y * p).vector();
            // in the flange, where the covariance is
            let at: Vector3<f64> = match setup {
                Setup::EyeInHand => seen.vector(),
                Setup::EyeToHand => (y * p).vector(),
            };
            let off: Vector3<f64> = match setup {
                Setup::EyeInHand => flange.rotation().transpose() * off,
                Setup::EyeToHand => off,
            };
            let j = point_jacobian(&at);
            let spread = j * corrected.covariance * j.transpose();
            sum += off.norm_squared();
            within += f64::from(off.dot(&(spread.try_inverse()? * off)) < 7.815);
            count += 1.0;
        }
    }
    Some((f64::sqrt(sum / count) * 1e3, within / count))
}

/// How a point moves with its frame: a step on the right, rotation first.
fn point_jacobian(p: &Vector3<f64>) -> Matrix3x6<f64> {
    let mut j = Matrix3x6::zeros();
    j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-p.cross_matrix());
    j.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
    j
}

/// By how much two answers put the target's points apart, mm RMS.
fn distance(
    a: &Pose<Mount, Camera>,
    b: &Pose<Mount, Camera>,
    fresh: &[PosePair],
    points: &[Vector3<f64>],
    centre: &Pose<Target, Target>,
) -> f64 {
    let mut sum = 0.0;
    for pair in fresh {
        for p in points {
            let seen = pair.camera_from_target * (centre.inverse() * Point::from_vector(*p));
            sum += ((*a * seen).vector() - (*b * seen).vector()).norm_squared();
        }
    }
    (sum / (fresh.len() * points.len()) as f64).sqrt() * 1e3
}

/// How far the robot misses each point of the target where it works, mm.
fn missed(
    h: &HandEye,
    fresh: &[PosePair],
    points: &[Vector3<f64>],
    centre: &Pose<Target, Target>,
) -> Vec<f64> {
    let mut all = vec![];
    for pair in fresh {
        let one: Pose<Anchor, Target> =
            pair.anchor_from_mount * h.mount_from_camera * pair.camera_from_target;
        for p in points {
            let p = centre.inverse() * Point::from_vector(*p);
            all.push(((one * p).vector() - (h.anchor_from_target * p).vector()).norm() * 1e3);
        }
    }
    all
}
