//! What a session shows, as JSON: the page, scripts and other programs read this and nothing else.

use handeye::{
    Anchor, Base, Camera, Flange, Intrinsics, Mount, Pose, Setup, Target, TargetModel, Verdict,
    calibrate::result::JudgedFinding,
};
use serde::Serialize;

use super::{Problem, Step};

/// A pixel.
pub type Pixel = [f64; 2];

/// The whole state.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct State {
    /// Grows with every change.
    pub version: u64,
    /// The folder.
    pub folder: String,
    /// What it is called.
    pub title: String,
    /// The step that is shown.
    pub step: Step,
    /// All steps.
    pub steps: Vec<StepView>,
    /// What to do next.
    pub say: String,
    /// What went wrong last.
    pub problem: Option<Problem>,
    /// What is known of the cell.
    pub cell: CellView,
    /// The robot.
    pub robot: RobotView,
    /// Its model, where one was given.
    pub arm: Option<ArmView>,
    /// The camera.
    pub camera: CameraView,
    /// The view to take next.
    pub next: Option<NextView>,
    /// The capture that is waited for.
    pub taking: Option<Taking>,
    /// Whether captures are taken without being asked.
    pub automatic: bool,
    /// The captures that stand.
    pub captures: Vec<CaptureView>,
    /// Those that were deleted; placements and touches likewise.
    pub deleted: Vec<DeletedView>,
    /// Those that were not taken.
    pub refused: Vec<RefusedView>,
    /// What can be undone.
    pub can_undo: Option<String>,
    /// Whether the captures are being assessed.
    pub assessing: bool,
    /// Changes with every assessment: details of captures are to be asked for again.
    pub assessed: u64,
    /// Corners to touch and those that were; `None` where none can be.
    pub touch: Option<TouchView>,
    /// Views that verify the captures; `None` as long as none can be taken.
    pub verify: Option<VerifyView>,
    /// How far the captures go.
    pub progress: Option<Progress>,
    /// The result that was written.
    pub result: Option<ResultView>,
    /// Of a virtual cell.
    pub virtual_cell: Option<VirtualView>,
}

/// A step.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct StepView {
    /// Which.
    pub name: Step,
    /// `done`, `now`, `open` or `locked`.
    pub state: &'static str,
    /// What is known of its choice.
    pub proof: Option<String>,
    /// Whether that is enough to go on.
    pub proven: bool,
}

/// The cell.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct CellView {
    /// Who carries the camera.
    pub setup: Setup,
    /// Error that is tolerated (95 %), mm.
    pub tolerance_mm: f64,
    /// The board.
    pub target: TargetModel,
    /// The camera's intrinsics, where they are given.
    pub intrinsics: Option<Intrinsics>,
    /// How poses are shown.
    pub notation: String,
    /// Whether it is a virtual one.
    pub is_virtual: bool,
}

/// The robot.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct RobotView {
    /// Whether poses come.
    pub connected: bool,
    /// Whether they are typed from the pendant.
    pub typed: bool,
    /// Whether it stands.
    pub stands: bool,
    /// In a sentence.
    pub why: String,
    /// Names of the numbers.
    pub columns: Vec<&'static str>,
    /// Their units.
    pub units: Vec<&'static str>,
    /// Its pose in the notation.
    pub numbers: Vec<f64>,
    /// Its joint values, degrees or mm.
    pub joints_deg: Option<Vec<f64>>,
    /// Where the flange is.
    pub base_from_flange: Option<Pose<Base, Flange>>,
}

/// The robot's model.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ArmView {
    /// Names of its joints, from the base outwards.
    pub joints: Vec<String>,
    /// Their units, `°` or `mm`.
    pub units: Vec<&'static str>,
    /// Whether the robot gives its joint values; otherwise they are found by inverse kinematics, near those before.
    pub measured: bool,
    /// Where base, joints and flange are now, in the base, m; `None` where no joint values are known.
    pub points: Option<Vec<[f64; 3]>>,
    /// And at the next view.
    pub next_points: Option<Vec<[f64; 3]>>,
}

/// The camera.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct CameraView {
    /// Whether images come.
    pub connected: bool,
    /// Whether they come one by one.
    pub single: bool,
    /// Whether they may be uploaded.
    pub uploads: bool,
    /// Width, px.
    pub width: u32,
    /// Height, px.
    pub height: u32,
    /// Number of the newest image.
    pub frame: u64,
    /// How long ago it came, s.
    pub age_s: f64,
    /// Whether it stands.
    pub stands: bool,
    /// In a sentence.
    pub why: String,
    /// Corners in it.
    pub corners: Vec<Pixel>,
    /// How many were found.
    pub found: Option<String>,
    /// Why none were.
    pub missing: Option<String>,
    /// How much later images come than they are taken, s.
    pub delay_s: Option<f64>,
}

/// The view to take next.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct NextView {
    /// The number of the capture that it will be.
    pub number: usize,
    /// How it looks and what it brings.
    pub reason: String,
    /// The error before, mm.
    pub before_mm: Option<f64>,
    /// The error after it, mm.
    pub after_mm: Option<f64>,
    /// Names of the numbers.
    pub columns: Vec<&'static str>,
    /// Their units.
    pub units: Vec<&'static str>,
    /// The pose in the notation.
    pub numbers: Vec<f64>,
    /// Joint values, degrees or mm, where the arm is known.
    pub joints_deg: Option<Vec<f64>>,
    /// Where the flange is to be.
    pub base_from_flange: Pose<Base, Flange>,
    /// Where the board is to be seen.
    pub camera_from_target: Pose<Camera, Target>,
    /// The outline of its corners in the image then.
    pub ghost: Vec<Pixel>,
    /// Its corners in the image then.
    pub ghost_corners: Vec<Pixel>,
    /// How far the robot is from it.
    pub off: Option<Off>,
}

/// A distance of two poses.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Off {
    /// Positions, mm.
    pub mm: f64,
    /// Rotations, degrees.
    pub deg: f64,
}

/// Corners that are touched.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TouchView {
    /// Where the tip is in the flange, mm.
    pub tip_mm: Option<[f64; 3]>,
    /// The corner to touch next.
    pub corner: u32,
    /// Corners in a row of the board.
    pub columns: u32,
    /// Whether boards are laid into the view to be touched: the robot carries the one of the captures.
    pub lays: bool,
    /// Boards that were laid there.
    pub placements: Vec<PlacementShown>,
    /// The one whose corners are touched now.
    pub placement: Option<String>,
    /// What lies in the view of a virtual cell's camera that stands beside the robot; `None` of other cells.
    pub lying: Option<Lying>,
    /// Those that were touched.
    pub touches: Vec<TouchShown>,
    /// How far the tip was from where the answer puts the corners, RMS over the touches that are used, mm.
    pub rms_mm: Option<f64>,
    /// Whether the tip of a virtual cell's tool was led to the corner.
    pub at_corner: bool,
}

/// What lies in the view of a virtual cell's camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Lying {
    /// No board but the one that the robot carries.
    Nothing,
    /// A board that no placement shows yet.
    New,
    /// The board of the newest placement.
    Placed,
}

/// A board that was laid into the view to be touched.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct PlacementShown {
    /// Its name; its image and corners are asked for as those of a capture.
    pub id: String,
    /// How many of its corners were touched.
    pub touches: usize,
}

/// A corner that was touched.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TouchShown {
    /// Its name.
    pub id: String,
    /// Of the board of which placement.
    pub placement: Option<String>,
    /// Which corner.
    pub corner: u32,
    /// How far the tip was from where the answer puts it, mm.
    pub residual_mm: Option<f64>,
    /// Whether the answer was made with it.
    pub used: bool,
}

/// Views and touches that verify what was made of the captures.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct VerifyView {
    /// Those that were taken.
    pub views: Vec<VerifyShown>,
    /// How far they are from where they were predicted, RMS, mm.
    pub rms_mm: Option<f64>,
    /// What was expected of it, mm.
    pub expected_mm: Option<f64>,
    /// Whether views and touches agree with the calibration; `None` without any, or where some cannot be assessed and no other
    /// contradicts.
    pub agrees: Option<bool>,
    /// Corners that are touched to verify, how far the tip was from where they were predicted; `None` where none can be.
    pub touch: Option<TouchView>,
    /// What to do next where corners are touched.
    pub say_touch: Option<String>,
    /// How far touches were expected to be from there, RMS, mm.
    pub touches_expected_mm: Option<f64>,
}

/// A view that verifies.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct VerifyShown {
    /// Its name.
    pub id: String,
    /// How far the board is from where it was predicted, mm.
    pub distance_mm: Option<f64>,
    /// And rotated against it, degrees.
    pub angle_deg: Option<f64>,
}

/// A capture that is waited for.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Taking {
    /// How long, s.
    pub since_s: f64,
    /// For what.
    pub why: String,
}

/// A capture.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct CaptureView {
    /// Its name.
    pub id: String,
    /// When it was taken, s.
    pub time_s: Option<f64>,
    /// Whether the calibration uses it.
    pub used: bool,
    /// Why not.
    pub reason: Option<String>,
    /// Its residual, px.
    pub residual_px: Option<f64>,
    /// Its residual, mm.
    pub residual_mm: Option<f64>,
    /// Its residual, degrees.
    pub residual_deg: Option<f64>,
    /// Its leave-one-out residual, mm.
    pub held_out_mm: Option<f64>,
    /// Corners found.
    pub corners: usize,
    /// Corners found in 3D.
    pub corners_3d: usize,
    /// Where the robot stood.
    pub base_from_flange: Pose<Base, Flange>,
    /// Where the board was.
    pub camera_from_target: Option<Pose<Camera, Target>>,
}

/// What was measured in a capture's image.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct CaptureDetail {
    /// Its name.
    pub id: String,
    /// Its corners in the image.
    pub points: Vec<Pixel>,
    /// Found minus predicted; `None` while that is not known.
    pub arrows: Option<Vec<Pixel>>,
}

/// A deleted capture, placement or touch.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct DeletedView {
    /// Its name.
    pub id: String,
}

/// A capture that was not taken.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct RefusedView {
    /// When, s.
    pub time_s: f64,
    /// Why.
    pub why: String,
}

/// How far the captures go.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Progress {
    /// How many captures.
    pub captures: usize,
    /// The verdict on them; undetermined, too, while nothing is wrong but that the tolerance is not reached yet.
    pub verdict: Verdict,
    /// Why.
    pub reasons: Vec<String>,
    /// The error that the calibration states (95 %), mm.
    pub p95_mm: Option<f64>,
    /// What is tolerated, mm.
    pub tolerance_mm: f64,
    /// Whether it is enough.
    pub enough: bool,
    /// Directions that are not determined.
    pub undetermined: Vec<String>,
    /// Standard deviations of the camera's pose.
    pub directions: Vec<Direction>,
    /// Captures and the stated error (95 %, mm) after them.
    pub history: Vec<(usize, f64)>,
    /// What was noticed.
    pub findings: Vec<JudgedFinding>,
    /// Where the camera sits.
    pub mount_from_camera: Option<Pose<Mount, Camera>>,
    /// Where the board sits.
    pub anchor_from_target: Option<Pose<Anchor, Target>>,
}

/// How well the camera's pose is known in a direction.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Direction {
    /// `x`, or `about x`: in the camera.
    pub name: &'static str,
    /// Standard deviation; `None` while it is free.
    pub sigma: Option<f64>,
    /// `mm` or `deg`.
    pub unit: &'static str,
}

/// The result.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ResultView {
    /// Its files.
    pub files: Vec<String>,
    /// Its verdict.
    pub verdict: Verdict,
    /// The verdict in a sentence.
    pub headline: String,
}

/// Of a virtual cell.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct VirtualView {
    /// Whether its robot moves.
    pub driving: bool,
}
