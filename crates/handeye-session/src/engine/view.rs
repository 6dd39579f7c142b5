//! From the engine's state to what is shown.

use std::sync::Arc;

use handeye::{Calibration, Verdict, model::residual::Residual};
use handeye_io::{StoredCapture, Writing};

use super::{
    Change, Engine, Flow, Problem, Step,
    rest::RobotSample,
    say::standing,
    shown::{
        CameraView, CaptureDetail, CaptureView, CellView, DeletedView, Direction, NextView, Off,
        Pixel, Progress, RefusedView, ResultView, RobotView, State, StepView, Taking, VirtualView,
    },
    taking::LATE_S,
};
use crate::assess::{Assessment, MeasuredCapture, ProposedView};

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
            steps: self.steps(),
            say: self.say(),
            problem: self
                .problem
                .clone()
                .or_else(|| self.doubt_of_arm())
                .or_else(|| self.late_images()),
            cell: CellView {
                setup: settings.setup,
                tolerance_mm: settings.tolerance_mm,
                target: settings.target.clone(),
                intrinsics: settings.intrinsics,
                notation: settings.notation.clone(),
                is_virtual: self.sources.is_virtual,
            },
            robot: self.robot_view(writing.as_ref()),
            arm: self.arm_view(),
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
                Change::Touched(id) => format!("touch {id}"),
                Change::Untouched(id) => format!("untouch {id}"),
                Change::Placed(id) => format!("place {id}"),
            }),
            assessing: self.assessing,
            assessed: self.assessments,
            touch: self.touch_view(false),
            verify: self.verify_view(),
            progress: self.assessed.as_ref().map(|a| self.progress(a)),
            result: self.result_view(),
            virtual_cell: self
                .sources
                .is_virtual
                .then(|| VirtualView { driving: !standing(&self.rest.robot, self.now, "").0 }),
        }
    }

    /// Images that come late: captures wait for them, and a cell whose camera answers sooner is quicker.
    fn late_images(&self) -> Option<Problem> {
        let late = self.delay().filter(|s| *s > LATE_S)?;
        Some(Problem {
            code: "image-late".into(),
            message: format!("the images come {late:.1} s later than they are taken"),
            advice: "captures wait for that; a smaller image or no buffer in the camera's software makes it shorter".into(),
        })
    }

    fn steps(&self) -> Vec<StepView> {
        Step::ALL.into_iter().map(|step| self.step_view(step)).collect()
    }

    fn step_view(&self, step: Step) -> StepView {
        let known = self.proof(step);
        let is_locked = match step {
            Step::Touch => self.may_touch().is_err(),
            Step::Verify => self.may_verify().is_err(),
            _ => step > self.farthest,
        };
        let state = match step {
            _ if step == self.step => "now",
            _ if is_locked => "locked",
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
            joints_deg: last
                .filter(|s| !s.joints.is_empty())
                .map(|s| self.joint_numbers(&s.joints)),
            base_from_flange: pose,
        }
    }

    fn camera_view(&self) -> CameraView {
        let last = self.images.back();
        let single = self.sources.camera == Flow::Single;
        let (stands, why) = match last {
            Some(last) if single => (true, format!("came {:.0} s ago", self.now - last.time_s)),
            _ => standing(&self.rest.image, self.now, "the image"),
        };
        let all = self.folder.settings.target.corners().len();
        let corners = last.and_then(|p| p.corners.as_ref().ok());
        CameraView {
            connected: last.is_some_and(|p| single || self.now - p.time_s < 2.0),
            single,
            uploads: self.sources.takes_uploads(),
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
        let pose = next.base_from_flange;
        let off = self.robot.back().map(|s| {
            let off = Residual::between(&s.base_from_flange, &pose);
            Off { mm: off.distance * 1e3, deg: off.angle.to_degrees() }
        });
        let ghost_corners: Vec<Pixel> = next.corners.iter().map(pixel).collect();
        NextView {
            number: self.folder.captures.len() + 1,
            reason: next.reason.clone(),
            before_mm: next.before_mm,
            after_mm: next.after_mm,
            columns: writing.map_or(vec![], Writing::names),
            units: writing.map_or(vec![], Writing::units),
            numbers: writing.map_or(vec![], |w| w.numbers(&pose)),
            joints_deg: self.joints_at(next).map(|values| self.joint_numbers(&values)),
            base_from_flange: pose,
            camera_from_target: next.camera_from_target,
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
        let measured =
            |a: &Arc<Assessment>| a.measured.iter().chain(&a.placements).map(one).collect();
        self.assessed.as_ref().map_or(vec![], measured)
    }

    fn progress(&self, assessed: &Assessment) -> Progress {
        let result = &assessed.calibration;
        Progress {
            captures: result.captures.len(),
            verdict: match result.is_only_imprecise() {
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
            verdict: match self.not_verified() {
                Some(_) => Verdict::Rejected,
                None => assessed.calibration.verdict,
            },
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
