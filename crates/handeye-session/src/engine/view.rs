//! What a session shows, as JSON: the page, scripts and other programs read this and nothing else.

use handeye::{
    Anchor, Base, Calibration, Camera, Flange, Intrinsics, Mount, Pose, Setup, Target, TargetModel,
    Verdict, calibrate::result::JudgedFinding, model::residual::Residual,
};
use handeye_io::{StoredCapture, Writing};
use serde::Serialize;

use super::{Change, Engine, Flow, LATE_S, Step, rest::RobotSample, say::standing};
use crate::assess::{Assessment, MeasuredCapture, ProposedView};

/// A pixel.
type Pixel = [f64; 2];

/// The whole state.
#[derive(Debug, Clone, Serialize)]
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
    /// Those that were deleted.
    pub deleted: Vec<DeletedView>,
    /// Those that were not taken.
    pub refused: Vec<RefusedView>,
    /// What can be undone.
    pub can_undo: Option<String>,
    /// Whether the captures are being assessed.
    pub assessing: bool,
    /// Changes with every assessment: details of captures are to be asked for again.
    pub assessed: u64,
    /// How far the captures go.
    pub progress: Option<Progress>,
    /// The verification, which is not part of sessions yet.
    pub verify: Option<()>,
    /// The result that was written.
    pub result: Option<ResultView>,
    /// Of a virtual cell.
    pub virtual_cell: Option<VirtualView>,
}

/// A step.
#[derive(Debug, Clone, Serialize)]
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

/// What went wrong.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Problem {
    /// A fixed name.
    pub code: String,
    /// What.
    pub message: String,
    /// What to do.
    pub advice: String,
}

/// The cell.
#[derive(Debug, Clone, Serialize)]
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

/// The camera.
#[derive(Debug, Clone, Serialize)]
pub struct CameraView {
    /// Whether pictures come.
    pub connected: bool,
    /// Whether they come one by one.
    pub single: bool,
    /// Width, px.
    pub width: u32,
    /// Height, px.
    pub height: u32,
    /// Number of the newest picture.
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
    /// How much later pictures come than they are taken, s.
    pub delay_s: Option<f64>,
}

/// The view to take next.
#[derive(Debug, Clone, Serialize)]
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
    /// The outline of its corners in the picture then.
    pub ghost: Vec<Pixel>,
    /// Its corners in the picture then.
    pub ghost_corners: Vec<Pixel>,
    /// How far the robot is from it.
    pub off: Option<Off>,
}

/// A distance of two poses.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Off {
    /// Positions, mm.
    pub mm: f64,
    /// Rotations, degrees.
    pub deg: f64,
}

/// A capture that is waited for.
#[derive(Debug, Clone, Serialize)]
pub struct Taking {
    /// How long, s.
    pub since_s: f64,
    /// For what.
    pub why: String,
}

/// A capture.
#[derive(Debug, Clone, Serialize)]
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

/// What was measured in a capture's picture.
#[derive(Debug, Clone, Serialize)]
pub struct CaptureDetail {
    /// Its name.
    pub id: String,
    /// Its corners in the picture.
    pub points: Vec<Pixel>,
    /// Found minus predicted; `None` while that is not known.
    pub arrows: Option<Vec<Pixel>>,
}

/// A deleted capture.
#[derive(Debug, Clone, Serialize)]
pub struct DeletedView {
    /// Its name.
    pub id: String,
}

/// A capture that was not taken.
#[derive(Debug, Clone, Serialize)]
pub struct RefusedView {
    /// When, s.
    pub time_s: f64,
    /// Why.
    pub why: String,
}

/// How far the captures go.
#[derive(Debug, Clone, Serialize)]
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
pub struct VirtualView {
    /// Whether its robot moves.
    pub driving: bool,
}

impl Engine {
    /// What is shown now; `folder` is where its files are.
    pub fn view(&self, folder: &str, title: &str) -> State {
        let settings = &self.folder.settings;
        let writing = Writing::of(&settings.notation).ok();
        State {
            version: self.version,
            folder: folder.into(),
            title: title.into(),
            step: self.step,
            steps: Step::ALL.into_iter().map(|step| self.step_view(step)).collect(),
            say: self.say(),
            problem: self.problem.clone().or_else(|| self.late_pictures()),
            cell: CellView {
                setup: settings.setup,
                tolerance_mm: settings.tolerance_mm,
                target: settings.target.clone(),
                intrinsics: settings.intrinsics,
                notation: settings.notation.clone(),
                is_virtual: self.sources.is_virtual,
            },
            robot: self.robot_view(writing.as_ref()),
            camera: self.camera_view(),
            next: self.next().map(|next| self.next_view(next, writing.as_ref())),
            taking: self
                .wish
                .as_ref()
                .map(|wish| Taking { since_s: self.now - wish.since, why: wish.why.clone() }),
            automatic: self.automatic,
            captures: self.folder.captures.iter().map(|c| self.capture_view(c)).collect(),
            deleted: self.folder.deleted.iter().map(|id| DeletedView { id: id.clone() }).collect(),
            refused: self
                .folder
                .refused
                .iter()
                .map(|r| RefusedView { time_s: r.time_s, why: r.why.clone() })
                .collect(),
            can_undo: self.changes.last().map(|change| match change {
                Change::Taken(id) => format!("take {id}"),
                Change::Deleted(id) => format!("delete {id}"),
                Change::Restored(id) => format!("restore {id}"),
            }),
            assessing: self.assessing,
            assessed: self.assessments,
            progress: self.assessed.as_ref().map(|a| self.progress(a)),
            verify: None,
            result: self.result_view(),
            virtual_cell: self
                .sources
                .is_virtual
                .then(|| VirtualView { driving: !standing(&self.rest.robot, self.now, "").0 }),
        }
    }

    /// Pictures that come late: captures wait for them, and a cell whose camera answers sooner is quicker.
    fn late_pictures(&self) -> Option<Problem> {
        let late = self.delay().filter(|s| *s > LATE_S)?;
        Some(Problem {
            code: "picture-late".into(),
            message: format!("the pictures come {late:.1} s later than they are taken"),
            advice: "captures wait for that; a smaller picture or no buffer in the camera's software makes it shorter".into(),
        })
    }

    fn step_view(&self, step: Step) -> StepView {
        let known = self.proof(step);
        let state = match step {
            _ if step == self.step => "now",
            _ if step > self.farthest => "locked",
            _ if known.proven => "done",
            _ => "open",
        };
        let shown = state != "locked";
        StepView { name: step, state, proof: shown.then_some(known.text), proven: known.proven }
    }

    fn robot_view(&self, writing: Option<&Writing>) -> RobotView {
        let last: Option<&RobotSample> = self.robot.back();
        let typed = self.sources.robot == Flow::Single;
        let (stands, why) = match last {
            Some(last) if typed => (true, format!("typed {:.0} s ago", self.now - last.time_s)),
            None if typed => (false, "no pose has been typed yet".into()),
            _ => standing(&self.rest.robot, self.now, "the robot"),
        };
        let pose = last.map(|s| s.base_from_flange);
        RobotView {
            connected: last.is_some_and(|s| typed || self.now - s.time_s < 2.0),
            typed,
            stands,
            why,
            columns: writing.map_or(vec![], Writing::names),
            units: writing.map_or(vec![], Writing::units),
            numbers: writing.zip(pose).map_or(vec![], |(w, pose)| w.numbers(&pose)),
            joints_deg: last.filter(|s| !s.joints.is_empty()).map(|s| degrees(&s.joints)),
            base_from_flange: pose,
        }
    }

    fn camera_view(&self) -> CameraView {
        let last = self.pictures.back();
        let single = self.sources.camera == Flow::Single;
        let (stands, why) = match last {
            Some(last) if single => (true, format!("came {:.0} s ago", self.now - last.time_s)),
            _ => standing(&self.rest.picture, self.now, "the picture"),
        };
        let all = self.folder.settings.target.corners().len();
        let corners = last.and_then(|p| p.corners.as_ref().ok());
        CameraView {
            connected: last.is_some_and(|p| single || self.now - p.time_s < 2.0),
            single,
            width: last.map_or(0, |p| p.size.0),
            height: last.map_or(0, |p| p.size.1),
            frame: last.map_or(0, |p| p.frame),
            age_s: last.map_or(0.0, |p| self.now - p.time_s),
            stands,
            why,
            corners: corners.map_or(vec![], |c| c.iter().map(|c| pixel(&c.pixel)).collect()),
            found: corners.map(|c| format!("{} of {all} corners", c.len())),
            missing: last.and_then(|p| p.corners.as_ref().err().cloned()),
            delay_s: self.delay(),
        }
    }

    fn next_view(&self, next: &ProposedView, writing: Option<&Writing>) -> NextView {
        let view = &next.view;
        let pose = view.station.base_from_flange;
        let off = self.robot.back().map(|s| {
            let off = Residual::between(&s.base_from_flange, &pose);
            Off { mm: off.distance * 1e3, deg: off.angle.to_degrees() }
        });
        let ghost_corners: Vec<Pixel> = next.corners.iter().map(pixel).collect();
        NextView {
            number: self.folder.captures.len() + 1,
            reason: view.reason(),
            before_mm: view.before.as_ref().map(|error| error.p95),
            after_mm: view.after.as_ref().map(|error| error.p95),
            columns: writing.map_or(vec![], Writing::names),
            units: writing.map_or(vec![], Writing::units),
            numbers: writing.map_or(vec![], |w| w.numbers(&pose)),
            joints_deg: view.station.joints.as_deref().map(degrees),
            base_from_flange: pose,
            camera_from_target: view.camera_from_target,
            ghost: hull(&ghost_corners),
            ghost_corners,
            off,
        }
    }

    fn capture_view(&self, stored: &StoredCapture) -> CaptureView {
        let assessed = self.assessed.as_ref();
        let result =
            assessed.and_then(|a| a.calibration.captures.iter().find(|c| c.id == stored.id));
        CaptureView {
            id: stored.id.clone(),
            time_s: stored.robot_time_s,
            used: result.is_some_and(|c| c.used),
            reason: result.and_then(|c| c.reason.clone()),
            residual_px: result.and_then(|c| c.residual_px),
            residual_mm: result.and_then(|c| c.residual_mm),
            residual_deg: result.and_then(|c| c.residual_deg),
            held_out_mm: result.and_then(|c| c.held_out_mm),
            corners: result.map_or(0, |c| c.corners),
            corners_3d: result.map_or(0, |c| c.corners_3d),
            base_from_flange: stored.base_from_flange,
            camera_from_target: result.and_then(|c| c.camera_from_target),
        }
    }

    /// What was measured in the captures, beside the state: it is much, and changes with an assessment only.
    pub fn details(&self) -> Vec<CaptureDetail> {
        let one = |m: &MeasuredCapture| CaptureDetail {
            id: m.id.clone(),
            points: m.corners.iter().map(|c| pixel(&c.pixel)).collect(),
            arrows: (!m.residuals.is_empty()).then(|| m.residuals.iter().map(arrow).collect()),
        };
        self.assessed.as_ref().map_or(vec![], |a| a.measured.iter().map(one).collect())
    }

    fn progress(&self, assessed: &Assessment) -> Progress {
        let result = &assessed.calibration;
        Progress {
            captures: result.captures.len(),
            verdict: match assessed.is_only_inaccurate() {
                true => Verdict::Undetermined,
                false => result.verdict,
            },
            reasons: result.reasons.clone(),
            p95_mm: assessed.p95_mm(),
            tolerance_mm: self.folder.settings.tolerance_mm,
            enough: assessed.enough && !self.assessing,
            undetermined: result.undetermined.clone(),
            directions: directions(result),
            history: self.history.clone(),
            findings: result.findings.clone(),
            mount_from_camera: result.hand_eye.mount_from_camera,
            anchor_from_target: result.hand_eye.anchor_from_target,
        }
    }

    fn result_view(&self) -> Option<ResultView> {
        let (written, assessed) = (self.written.as_ref()?, self.assessed.as_ref()?);
        let full = |name: &String| format!("{}/{name}", written.folder);
        Some(ResultView {
            files: written.files.iter().map(full).collect(),
            verdict: assessed.calibration.verdict,
            headline: self.say(),
        })
    }
}

fn pixel(p: &handeye::nalgebra::Vector2<f64>) -> Pixel {
    // a hundredth of a pixel is more than a page shows
    [p.x, p.y].map(|v| (v * 100.0).round() / 100.0)
}

fn arrow(r: &handeye::nalgebra::Vector2<f64>) -> Pixel {
    [r.x, r.y].map(|v| (v * 1e4).round() / 1e4)
}

fn degrees(joints: &[f64]) -> Vec<f64> {
    joints.iter().map(|value| value.to_degrees()).collect()
}

fn directions(result: &Calibration) -> Vec<Direction> {
    let rows = result.hand_eye.covariance.mount_from_camera.as_ref();
    let names = [("about x", 0), ("about y", 1), ("about z", 2), ("x", 3), ("y", 4), ("z", 5)];
    let one = |(name, k): (&'static str, usize)| {
        let sigma = rows.map(|rows| rows[k][k].max(0.0).sqrt());
        let (unit, scale) = if k < 3 { ("deg", 1f64.to_degrees()) } else { ("mm", 1e3) };
        Direction { name, sigma: sigma.map(|s| s * scale), unit }
    };
    names.into_iter().map(one).collect()
}

/// The convex outline of points (A. Andrew, 1979).
fn hull(points: &[Pixel]) -> Vec<Pixel> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turns_right = |a: &Pixel, b: &Pixel, c: &Pixel| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0
    };
    let half = |points: &mut dyn Iterator<Item = &Pixel>| {
        let mut side: Vec<Pixel> = vec![];
        for p in points {
            while side.len() > 1 && turns_right(&side[side.len() - 2], &side[side.len() - 1], p) {
                side.pop();
            }
            side.push(*p);
        }
        side.pop();
        side
    };
    let mut outline = half(&mut sorted.iter());
    outline.extend(half(&mut sorted.iter().rev()));
    outline
}
