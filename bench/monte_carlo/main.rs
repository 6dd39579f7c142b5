//! The whole calibration on simulated cells, against the truth.
//!
//! `cargo run --release -p handeye-bench --bin monte_carlo -- [TRIALS] [TRIALS OF THE FIRST] [FILE] [PART]`
//!
//! Prints a table; with a FILE other than -, writes it between the markers `monte_carlo` there. PART keeps the
//! rows whose names contain it.

mod scenario;
#[path = "../section.rs"]
mod section;

use std::{collections::BTreeMap, env};

use handeye::{
    Calibration, Config, Mount, Pose, Session, calibrate,
    calibrate::result::matrix,
    estimate::{
        KnownNoise,
        predict::{Volume, difference, tre},
    },
    math::linalg::invert_spd,
};
use nalgebra::Vector3;
use scenario::{SCENARIOS, Scenario, volume};

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

/// What the user says of the cell.
fn config(scenario: &Scenario) -> Config {
    let tip_m = scenario.tip_known.map(|mm| mm * 1e-3);
    Config { known: KnownNoise { tip_m, ..KnownNoise::default() }, ..Config::default() }
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
        let result = calibrate(&session, &config(scenario)).expect("a session to calibrate from");
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
        tip_m: scenario.tip_known.map(|mm| mm * 1e-3),
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
