//! What the scans say of the board and of themselves, and how they were placed without one.

use serde::{Deserialize, Serialize};

/// What the scans say of the board and of themselves.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ScanResult {
    /// Depth on black against depth on white.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour_step: Option<ColourStepResult>,
    /// Whether the board is flat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flatness: Option<FlatnessResult>,
    /// Whether images and scans put the board at one place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<FramesResult>,
    /// How the scans were placed without a board.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneResult>,
}

/// What the camera looked at instead of a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SceneKind {
    /// A still scene: its scans were registered with one another.
    Scene,
    /// An object of known shape: it was registered with each scan.
    Object,
}

/// How scans were placed by the shape that they show.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneResult {
    /// What the camera looked at.
    pub kind: SceneKind,
    /// Scans whose place is known: in the scene, or against the object.
    pub placed: usize,
    /// All pairs that were registered.
    pub pairs: Vec<ScenePair>,
}

/// Two scans that were registered, or the object with a scan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScenePair {
    /// Capture whose scan was moved; `object` where that was the object.
    pub source: String,
    /// Capture onto whose scan.
    pub target: String,
    /// Share of the source that lies on the target.
    pub overlap: f64,
    /// Of the places where both show something, the share at which it is the same.
    pub agreement: f64,
    /// RMS distance of the surfaces; null where hardly anything lies together.
    pub rms_mm: Option<f64>,
    /// Whether the pair counts.
    pub used: bool,
    /// Why not, if not.
    pub reason: Option<String>,
    /// Motions that the common surface leaves free.
    pub undetermined: Vec<String>,
}

impl SceneResult {
    /// How many of so many scans were placed, and by what, for people.
    pub fn sentence(&self, scans: usize) -> String {
        let placed = self.placed;
        match self.kind {
            SceneKind::Object => format!("the object was found in {placed} of {scans} scans"),
            SceneKind::Scene => {
                let (used, all) = (self.pairs.iter().filter(|p| p.used).count(), self.pairs.len());
                format!("{placed} of {scans} scans were brought together by {used} of {all} pairs")
            }
        }
    }
}

/// How much farther black is read than white, along the optical axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ColourStepResult {
    /// Depth of black minus that of white, mean over the captures, mm.
    pub black_minus_white_mm: f64,
    /// Its standard deviation, mm.
    pub sigma_mm: f64,
    /// By how much the captures' own steps vary (standard deviation), mm.
    pub spread_mm: f64,
    /// Whether it is more than noise, and was taken off the points on black.
    pub applied: bool,
    /// What each capture says.
    pub captures: Vec<CaptureStep>,
}

/// The step in one capture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaptureStep {
    /// Name of the capture.
    pub id: String,
    /// Depth of black minus that of white, mm.
    pub black_minus_white_mm: f64,
    /// Its standard deviation, mm.
    pub sigma_mm: f64,
}

/// How flat the board is, as its corners in the scans have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlatnessResult {
    /// RMS deviation of the corners, mean over the captures, from their plane, mm.
    pub rms_mm: f64,
    /// Highest minus lowest corner of the quadratic surface that fits all captures, mm.
    pub peak_to_valley_mm: f64,
    /// Its standard deviation, mm.
    pub sigma_mm: f64,
    /// Chance that noise alone looks so bent.
    pub chance: f64,
    /// Mean deviation of every corner.
    pub map: Vec<BoardDeviation>,
    /// What each capture says.
    pub captures: Vec<CaptureFlatness>,
}

/// Mean deviation of one corner from the board's plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BoardDeviation {
    /// Place on the board, target frame, mm.
    pub x_mm: f64,
    /// Place on the board, target frame, mm.
    pub y_mm: f64,
    /// Along the target's z, away from the viewer, mm.
    pub deviation_mm: f64,
    /// Its standard deviation, mm.
    pub sigma_mm: f64,
}

/// How flat the board is in one capture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaptureFlatness {
    /// Name of the capture.
    pub id: String,
    /// RMS deviation of its corners from their plane, noise included, mm.
    pub rms_mm: f64,
    /// Highest minus lowest corner of its own quadratic surface, mm.
    pub peak_to_valley_mm: f64,
    /// Its standard deviation, mm.
    pub sigma_mm: f64,
    /// Chance that noise alone looks so bent.
    pub chance: f64,
}

/// Where the scans put the board, against where the images put it: what an image has at `p`, the
/// scan has at `(1 + scale) R p + shift`, in the camera frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FramesResult {
    /// Distances are larger in the scan by this share.
    pub scale: f64,
    /// Its standard deviation.
    pub sigma_scale: f64,
    /// Rotation vector of `R`, degrees.
    pub tilt_deg: [f64; 3],
    /// Standard deviations, degrees.
    pub sigma_tilt_deg: [f64; 3],
    /// Shift, mm.
    pub shift_mm: [f64; 3],
    /// Standard deviations, mm.
    pub sigma_shift_mm: [f64; 3],
    /// Which of `scale`, `tilt`, `shift` are more than noise, the one that explains most first. They
    /// are estimated together, with the others zero; each of the others as if it came on top.
    pub proven: Vec<String>,
    /// Chance that noise makes frames that agree differ so.
    pub chance: f64,
}
