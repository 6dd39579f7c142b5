//! One cell, its calibration, and how far off that is.

use handeye::{
    Calibration, Camera, Config, Mount, Pose, Setup, Verdict, calibrate,
    estimate::predict::{Volume, difference},
    simulate::{Cell, DepthSensor, Truth},
};

use crate::faults::Fault;

/// What there is beside images and robot poses.
#[derive(Clone, Copy)]
pub struct Kind {
    pub setup: Setup,
    pub touches: usize,
    pub scans: bool,
}

impl Kind {
    pub fn name(&self) -> String {
        let setup = match self.setup {
            Setup::EyeInHand => "in-hand",
            Setup::EyeToHand => "to-hand",
        };
        format!("{setup}-{}t{}", self.touches, if self.scans { "-scans" } else { "" })
    }

    fn cell(&self, seed: u64) -> Cell {
        let usual = Cell::new(self.setup, seed);
        let (placements, touches) = match self.setup {
            Setup::EyeInHand => (0, self.touches),
            Setup::EyeToHand => (if self.touches > 0 { 3 } else { 0 }, self.touches / 3),
        };
        let depth = self.scans.then(DepthSensor::default);
        Cell { placements, touches, depth, ..usual }
    }
}

/// What came of one cell.
pub struct Outcome {
    pub accepted: bool,
    /// 95 % point of the true error over what the camera saw, mm.
    pub true_mm: f64,
    /// The stated one, mm.
    pub stated_mm: f64,
    /// Share of the points of that box whose true error is within the stated one.
    pub within: f64,
    /// Size of the target over the declared one, and its standard deviation.
    pub size: (f64, f64),
}

/// Simulates, spoils and calibrates one cell.
pub fn run(fault: &Fault, kind: Kind, seed: u64) -> Option<Outcome> {
    let mut cell = kind.cell(seed);
    fault.build(&mut cell);
    let recording = cell.record(seed).ok()?;
    let mut session = recording.session();
    fault.spoil(&mut session, &recording, seed);
    let result = calibrate(&session, &Config::default()).ok()?;
    if std::env::var_os("VERBOSE").is_some() {
        println!("  {seed} {:?} {:?}", result.verdict, result.reasons);
        result.warnings.iter().for_each(|w| println!("     {}: {}", w.code, w.message));
    }
    Some(outcome(&cell, &fault.truth(&recording.truth, &cell), &result))
}

fn outcome(cell: &Cell, truth: &Truth, result: &Calibration) -> Outcome {
    let errors = seen(cell, truth)
        .zip(result.hand_eye.mount_from_camera)
        .map(|(seen, x)| errors(&seen, &truth.hand_eye.mount_from_camera, &x));
    let stated_mm = result.predicted_tre_mm.as_ref().map_or(f64::NAN, |t| t.p95);
    let within =
        |all: &Vec<f64>| all.iter().filter(|e| **e <= stated_mm).count() as f64 / all.len() as f64;
    Outcome {
        accepted: result.verdict == Verdict::Accepted,
        true_mm: errors.as_ref().map_or(f64::NAN, |all| all[all.len() * 95 / 100]),
        stated_mm,
        within: errors.as_ref().map_or(f64::NAN, within),
        size: result.target_scale.map_or((f64::NAN, f64::NAN), |s| (s.value, s.sigma)),
    }
}

/// The box around all that the camera really saw.
fn seen(cell: &Cell, truth: &Truth) -> Option<Volume> {
    let corners = cell.target.corners();
    let views = &truth.camera_from_target[..cell.captures];
    let points = views.iter().flat_map(|v| corners.iter().map(|c| (*v * *c).vector()));
    Volume::around(points, "what the camera saw")
}

/// The errors over a volume in order of their size, mm.
fn errors(seen: &Volume, truth: &Pose<Mount, Camera>, found: &Pose<Mount, Camera>) -> Vec<f64> {
    let off = difference(truth, found);
    let mut lengths: Vec<f64> = seen.points.iter().map(|p| off(p).norm() * 1e3).collect();
    lengths.sort_by(f64::total_cmp);
    lengths
}
