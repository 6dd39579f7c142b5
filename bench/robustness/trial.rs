//! One simulated session, spoilt, calibrated, and compared with the answer of the captures that
//! were left as they are.

use handeye::{
    Calibration, Camera, Config, Mount, Pose, Session, Setup, Verdict, calibrate,
    estimate::predict::{Volume, difference},
    math::random::Random,
    simulate::{Cell, CellNoise, DepthSensor, Mistake, Truth, spoil},
};

/// Captures of a session, fewest and most.
const CAPTURES: (u64, u64) = (8, 20);
/// How many times worse than usual (0.5 mm, 0.03 degrees) robots are: precise, usual, a cobot.
const ROBOTS: [f64; 3] = [0.2, 1.0, 3.0];
/// Largest share of spoilt captures.
const MOST_SPOILT: f64 = 0.4;
/// An accepted answer is silently wrong beyond so many times its stated error (95 %), and this, mm.
const SILENT: (f64, f64) = (3.0, 1.0);
/// An answer is as good as the oracle's up to this ratio of their errors.
pub const AS_GOOD: f64 = 1.2;

/// What came of one session.
pub struct Outcome {
    pub captures: usize,
    pub spoilt: Vec<(usize, Mistake)>,
    pub result: Calibration,
    /// Root mean square error over what the camera saw, mm; `None` without an accepted answer.
    pub error: Option<f64>,
    /// The same of the calibration that was given the clean captures only.
    pub oracle: Option<f64>,
    /// Accepted, and far more wrong than stated.
    pub silent: bool,
}

impl Outcome {
    /// Error over that of the oracle.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.error? / self.oracle?)
    }

    /// Whether it is as good as the oracle; where that has no answer, none is asked for.
    pub fn solved(&self) -> bool {
        self.oracle.is_none() || self.ratio().is_some_and(|r| r < AS_GOOD)
    }

    /// Clean captures that were left out.
    pub fn wronged(&self) -> usize {
        let left_out = |i: &usize| !self.result.captures[*i].used;
        let clean = |i: &usize| !self.spoilt.iter().any(|(k, _)| k == i);
        (0..self.captures).filter(clean).filter(left_out).count()
    }

    /// Spoilt captures that were used.
    pub fn missed(&self, kind: Mistake) -> usize {
        self.of(kind).filter(|&i| self.result.captures[i].used).count()
    }

    /// Spoilt captures by kind.
    pub fn of(&self, kind: Mistake) -> impl Iterator<Item = usize> + '_ {
        self.spoilt.iter().filter(move |(_, k)| *k == kind).map(|(i, _)| *i)
    }

    /// Spoilt captures whose reason says what happened.
    pub fn named(&self, kind: Mistake) -> usize {
        let words: &[&str] = match kind {
            Mistake::Turned => &["rotated"],
            Mistake::Exchanged => &["exchanged"],
            Mistake::Stale => &["robot pose equals that of", "robot pose of the"],
            Mistake::Shifted => {
                &["robot pose of the", "robot pose belongs", "robot pose equals that of"]
            }
            Mistake::WrongDetection | Mistake::Mirrored | Mistake::Moving => &["disagrees"],
        };
        let says = |i: &usize| {
            let reason = self.result.captures[*i].reason.as_deref().unwrap_or("");
            words.iter().any(|w| reason.contains(w))
        };
        self.of(kind).filter(says).count()
    }
}

/// The session of a seed: setup, number of captures and touches, and mistakes all follow from it.
pub fn trial(seed: u64) -> Option<Outcome> {
    let mut random = Random::new(seed ^ 0x0b57);
    let cell = cell(seed, &mut random);
    let (mut session, truth) = cell.session(seed).ok()?;
    let clean = session.clone();
    let most = (MOST_SPOILT * cell.captures as f64) as u64;
    let count = (random.bits() % (most + 1)) as usize;
    let kinds = kinds(&mut random);
    let spoilt = spoil(&mut session, &kinds, count, &mut random);
    let known = without(&clean, &spoilt);
    let result = calibrate(&session, &Config::default()).ok()?;
    let oracle = calibrate(&known, &Config::default()).ok()?;
    let seen = seen(&cell, &truth)?;
    let x = truth.hand_eye.mount_from_camera;
    let judged = |r: &Calibration| accepted(r).map(|found| errors(&seen, &x, &found));
    let error = judged(&result);
    let stated = result.predicted_tre_mm.as_ref().map_or(0.0, |t| t.p95);
    let silent = error.is_some_and(|(_, p95)| p95 > SILENT.0 * stated && p95 > SILENT.1);
    Some(Outcome {
        captures: cell.captures,
        spoilt,
        error: error.map(|e| e.0),
        oracle: judged(&oracle).map(|e| e.0),
        result,
        silent,
    })
}

/// A session whose robot poses are all one off, or in the opposite order.
pub fn whole_file(seed: u64) -> Option<Calibration> {
    let mut random = Random::new(seed ^ 0xf11e);
    let (mut session, _) = cell(seed, &mut random).session(seed).ok()?;
    let mut robot: Vec<_> = session.observations.iter().map(|o| o.base_from_flange).collect();
    match random.bits() % 3 {
        0 => robot.rotate_left(1),
        1 => robot.rotate_right(1),
        _ => robot.reverse(),
    }
    session.observations.iter_mut().zip(robot).for_each(|(o, pose)| o.base_from_flange = pose);
    calibrate(&session, &Config::default()).ok()
}

fn cell(seed: u64, random: &mut Random) -> Cell {
    let setup = if seed.is_multiple_of(2) { Setup::EyeInHand } else { Setup::EyeToHand };
    let captures = (CAPTURES.0 + random.bits() % (CAPTURES.1 - CAPTURES.0 + 1)) as usize;
    let usual = Cell::new(setup, seed);
    let touched = !random.bits().is_multiple_of(2);
    let (placements, touches) = if touched { (usual.placements, usual.touches) } else { (0, 0) };
    let worse = ROBOTS[(random.bits() % ROBOTS.len() as u64) as usize];
    let noise = CellNoise {
        robot_absolute_m: worse * usual.noise.robot_absolute_m,
        robot_absolute_rad: worse * usual.noise.robot_absolute_rad,
        ..usual.noise
    };
    let depth = random.bits().is_multiple_of(4).then(DepthSensor::default);
    Cell { captures, placements, touches, noise, depth, ..usual }
}

/// One kind of mistake, or all of them mixed.
fn kinds(random: &mut Random) -> Vec<Mistake> {
    match Mistake::ALL.get((random.bits() % 8) as usize) {
        Some(&kind) => vec![kind],
        None => Mistake::ALL.to_vec(),
    }
}

fn without(clean: &Session, spoilt: &[(usize, Mistake)]) -> Session {
    let mut session = clean.clone();
    let mut k = 0;
    session.observations.retain(|_| {
        k += 1;
        !spoilt.iter().any(|(i, _)| i + 1 == k)
    });
    session
}

fn accepted(result: &Calibration) -> Option<Pose<Mount, Camera>> {
    (result.verdict == Verdict::Accepted).then_some(result.hand_eye.mount_from_camera?)
}

/// The box around all that the camera really saw.
fn seen(cell: &Cell, truth: &Truth) -> Option<Volume> {
    let corners = cell.target.corners();
    let views = &truth.camera_from_target[..cell.captures];
    let points = views.iter().flat_map(|v| corners.iter().map(|c| (*v * *c).vector()));
    Volume::around(points, "what the camera saw")
}

/// Root mean square and 95 % point of the error, mm.
fn errors(seen: &Volume, truth: &Pose<Mount, Camera>, found: &Pose<Mount, Camera>) -> (f64, f64) {
    let off = difference(truth, found);
    let mut lengths: Vec<f64> = seen.points.iter().map(|p| off(p).norm() * 1e3).collect();
    lengths.sort_by(f64::total_cmp);
    let rms = (lengths.iter().map(|l| l * l).sum::<f64>() / lengths.len() as f64).sqrt();
    (rms, lengths[(lengths.len() * 95 / 100).min(lengths.len() - 1)])
}
