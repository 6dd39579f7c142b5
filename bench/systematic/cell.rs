//! One cell, its calibration, and how far off that is.

use handeye::{
    Calibration, Camera, Config, Mount, Pose, Setup, Verdict, calibrate,
    predict::{Volume, difference},
    simulate::{Cell, DepthSensor, Truth},
};

use crate::faults::Fault;

/// What there is beside pictures and robot poses.
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
    let error = seen(cell, truth)
        .zip(result.hand_eye.mount_from_camera)
        .map(|(seen, x)| error95(&seen, &truth.hand_eye.mount_from_camera, &x));
    Outcome {
        accepted: result.verdict == Verdict::Accepted,
        true_mm: error.unwrap_or(f64::NAN),
        stated_mm: result.predicted_tre_mm.as_ref().map_or(f64::NAN, |t| t.p95),
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

/// 95 % point of the error over a volume, mm.
fn error95(seen: &Volume, truth: &Pose<Mount, Camera>, found: &Pose<Mount, Camera>) -> f64 {
    let off = difference(truth, found);
    let mut lengths: Vec<f64> = seen.points.iter().map(|p| off(p).norm() * 1e3).collect();
    lengths.sort_by(f64::total_cmp);
    lengths[(lengths.len() * 95 / 100).min(lengths.len() - 1)]
}
