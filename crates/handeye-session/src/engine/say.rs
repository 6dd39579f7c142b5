//! What to do next, in one sentence, and what is known of each step.

use handeye::{
    Setup, Verdict, calibrate::findings::reservation, mistakes, model::residual::Residual,
};
use handeye_io::StoredCapture;

use super::{
    Engine, Flow, Step,
    placement::say_waiting,
    rest::{Motion, RobotSample},
    taking::{ELSEWHERE, KNOWN},
};
use crate::assess::{Assessment, ProposedView};

/// What is known of a step's choice.
pub(super) struct Proof {
    /// A sentence.
    pub(super) text: String,
    /// Whether it is enough to go on.
    pub(super) proven: bool,
}

pub(super) fn proof(proven: bool, text: impl Into<String>) -> Proof {
    Proof { text: text.into(), proven }
}

/// No flange is nearer to the origin of its base, m.
const NEAREST_M: f64 = 0.005;
/// None is farther, on tracks and gantries either, m.
const FARTHEST_M: f64 = 20.0;

impl Engine {
    pub(super) fn proof(&self, step: Step) -> Proof {
        match step {
            Step::Cell => self.cell_proof(),
            Step::Camera => self.camera_proof(),
            Step::Robot => self.robot_proof(),
            Step::Board => self.board_proof(),
            Step::Capture => self.capture_proof(),
            Step::Touch => self.touch_proof(),
            Step::Verify => self.verify_proof(),
            Step::Result => match &self.written {
                Some(written) => proof(true, format!("written to {}", written.folder)),
                None => proof(false, "no result is written yet"),
            },
        }
    }

    fn cell_proof(&self) -> Proof {
        let who = match self.folder.settings.setup {
            Setup::EyeInHand => "the robot carries the camera (eye-in-hand)",
            Setup::EyeToHand => {
                "the camera stands beside the robot, which carries the board (eye-to-hand)"
            }
        };
        proof(true, format!("{who}; {} mm are tolerated (95 %)", self.folder.settings.tolerance_mm))
    }

    fn camera_proof(&self) -> Proof {
        let Some(last) = self.images.back() else {
            return proof(false, "no image has come yet");
        };
        let (width, height) = last.size;
        let silent = self.now - last.time_s;
        if silent > 2.0 && self.sources.camera == Flow::Stream {
            return proof(false, format!("no image for {silent:.0} s"));
        }
        let given = self.folder.settings.intrinsics.map(|c| (c.width, c.height));
        if given.is_some_and(|size| size.0 > 0 && size != (width, height)) {
            let (w, h) = given.unwrap_or_default();
            return proof(
                false,
                format!(
                    "the images have {width} x {height} pixels, the intrinsics are for {w} x {h}"
                ),
            );
        }
        let lens = if given.is_some() {
            "intrinsics are given"
        } else {
            "intrinsics are calibrated from the views"
        };
        proof(true, format!("images of {width} x {height} pixels; {lens}"))
    }

    fn robot_proof(&self) -> Proof {
        let typed = self.sources.robot == Flow::Single;
        let Some(last) = self.robot.back() else {
            let missing = match typed {
                true => "type the pose that the pendant shows",
                false => "the robot has not sent a pose yet",
            };
            return proof(false, missing);
        };
        let silent = self.now - last.time_s;
        if silent > 2.0 && !typed {
            return proof(false, format!("no pose for {silent:.0} s"));
        }
        if let Some(why) = self.arm_contradicts() {
            return proof(false, why);
        }
        let at = last.base_from_flange.translation() * 1e3;
        let place = format!("the flange is at x {:.1}, y {:.1}, z {:.1} mm", at.x, at.y, at.z);
        let far = at.norm() * 1e-3;
        let (least, most) = mistakes::REACH;
        if (least..most).contains(&far) {
            return proof(true, place);
        }
        let is_possible = (NEAREST_M..FARTHEST_M).contains(&far);
        let asked = "are its lengths in another unit, or is this another notation?";
        proof(
            is_possible,
            format!(
                "{place}: {far:.3} m from the origin of the base, where arms are {least} to {most} m from it; {asked}"
            ),
        )
    }

    fn board_proof(&self) -> Proof {
        match self.images.back().map(|p| &p.corners) {
            None => proof(false, "no image has come yet"),
            Some(Ok(found)) => {
                let all = self.folder.settings.target.corners().len();
                proof(true, format!("{} of {all} corners are found", found.len()))
            }
            Some(Err(why)) => proof(false, format!("the board is not found: {why}")),
        }
    }

    fn capture_proof(&self) -> Proof {
        let count = self.folder.captures.len();
        let Some(assessed) = self.assessed.as_ref().filter(|_| !self.assessing) else {
            return proof(false, captures(count));
        };
        let limit = self.folder.settings.tolerance_mm;
        match assessed.p95_mm() {
            _ if assessed.enough => {
                let mm = assessed.p95_mm().unwrap_or_default();
                proof(true, format!("{count} captures; {mm:.2} mm (95 %), of {limit} mm"))
            }
            Some(mm) => proof(
                false,
                format!("{count} captures; {mm:.2} mm (95 %), {limit} mm are tolerated"),
            ),
            None if count == 1 => proof(false, "1 capture does not determine the answer yet"),
            None => proof(false, format!("{count} captures do not determine the answer yet")),
        }
    }

    /// What to do next.
    pub(super) fn say(&self) -> String {
        let known = self.proof(self.step);
        match self.step {
            Step::Cell => "Is this your cell? Confirm who carries the camera, and which error your job tolerates.".into(),
            Step::Camera | Step::Robot | Step::Board if !known.proven => {
                format!("{}.", capitalised(&known.text))
            }
            Step::Camera => "Is this the image of your camera? Confirm it.".into(),
            Step::Robot if self.sources.robot == Flow::Single => {
                "Is this where the flange is, in the notation of your robot? Confirm it.".into()
            }
            Step::Robot => "Move the robot by hand: do the numbers move with it? Then confirm it.".into(),
            Step::Board => "The board is found. Confirm that its size is measured, not read off a drawing.".into(),
            Step::Capture => self.say_capture(),
            Step::Touch => self.say_touch(),
            Step::Verify => self.say_verify(),
            Step::Result => self.say_result(),
        }
    }

    /// What is being done.
    pub(super) fn say_busy(&self) -> Option<String> {
        if self.storing {
            return Some("The capture is being stored.".into());
        }
        if let Some(wish) = self.wish.as_ref().filter(|wish| wish.is_placement) {
            return Some(say_waiting(wish));
        }
        if let Some(wish) = &self.wish {
            let why = if wish.why.is_empty() { "waiting for a standstill" } else { &wish.why };
            return Some(format!("Hold still: {why}."));
        }
        self.assessing.then(|| "The captures are being assessed.".into())
    }

    fn say_capture(&self) -> String {
        if let Some(busy) = self.say_busy() {
            return busy;
        }
        let Some(assessed) = &self.assessed else {
            return match self.folder.captures.is_empty() {
                true => "Move the robot until the camera sees the whole board, then take the first capture.".into(),
                false => first_views(&self.folder.captures),
            };
        };
        let outlier = self.newest_outlier();
        if let Some(why) = assessed.contradiction()
            && !(outlier.is_some() && assessed.is_open_at_end())
        {
            return contradiction(why, self.folder.captures.len());
        }
        if let Some(id) = outlier {
            return self.say_outlier(assessed, id);
        }
        if assessed.enough {
            let mm = assessed.p95_mm().unwrap_or_default();
            let limit = self.folder.settings.tolerance_mm;
            let stated =
                format!("the calibration states {mm:.2} mm (95 %), and {limit} mm are tolerated");
            // what changes the answer is said with it
            return match reservation(&assessed.calibration) {
                Some(but) => format!("Enough: {stated}. {but}."),
                None => format!("Enough: {stated}. Go on."),
            };
        }
        match (&assessed.next, &assessed.no_next) {
            (Some(next), _) if self.is_at(next) => {
                "The robot is at the view: take the capture.".into()
            }
            (Some(next), _) => format!("Drive to the next view: {}.", next.reason),
            (None, Some(_)) if self.folder.captures.len() < 4 => first_views(&self.folder.captures),
            (None, Some(why)) => format!("No next view is found: {why}."),
            (None, None) => "No next view is found.".into(),
        }
    }

    /// The newest capture, where it does not fit to those before it.
    pub(super) fn newest_outlier(&self) -> Option<&str> {
        let assessed = self.assessed.as_ref().filter(|_| !self.assessing)?;
        let id = &self.folder.captures.last()?.id;
        let captures = &assessed.calibration.captures;
        let used = captures.iter().filter(|c| c.used).count();
        // one that repeats another, or shows no board, says nothing against the others
        let is_outlier = assessed.calibration.rejected.contains(id);
        // few captures do not tell which of them is wrong
        let is_known = captures.len() > KNOWN && 2 * used > captures.len();
        (is_outlier && is_known).then_some(&id[..])
    }

    /// That is the moment to look around.
    fn say_outlier(&self, assessed: &Assessment, id: &str) -> String {
        let capture = assessed.calibration.captures.iter().find(|c| c.id == id);
        let why =
            capture.and_then(|c| c.reason.as_deref()).unwrap_or("it does not fit to the others");
        format!(
            "Capture {id} is rejected as an outlier: {}. {WHETHER_MOVED}.",
            why.trim_end_matches('.')
        )
    }

    /// Whether a robot whose poses stream stands at the view, so far as the planner tells views apart.
    pub(super) fn is_at(&self, next: &ProposedView) -> bool {
        self.sources.robot == Flow::Stream && self.was_at(next)
    }

    /// Whether the last pose that came is that of a view.
    pub(super) fn was_at(&self, next: &ProposedView) -> bool {
        let there = &next.base_from_flange;
        let near =
            |s: &RobotSample| Residual::between(&s.base_from_flange, there).is_within(ELSEWHERE);
        self.robot.back().is_some_and(near)
    }

    fn say_result(&self) -> String {
        let Some(assessed) = &self.assessed else { return "There is no result yet.".into() };
        if let Some(why) = self.not_verified() {
            return format!("{}.", capitalised(&why));
        }
        let result = &assessed.calibration;
        match (result.verdict, assessed.p95_mm()) {
            (Verdict::Accepted, Some(mm)) => {
                let what = reservation(result).unwrap_or_else(|| "Accepted".into());
                let verified = self.verified();
                format!(
                    "{what}: {mm:.2} mm (95 %){verified}. Copy the transform, or open the report."
                )
            }
            (Verdict::Rejected, _) => {
                format!("Rejected: {}. Do not use this transform.", reasons(&result.reasons))
            }
            _ => format!("Undetermined: {}. Take more captures.", reasons(&result.reasons)),
        }
    }
}

fn reasons(all: &[String]) -> String {
    let text = all
        .first()
        .map_or("the captures do not determine the answer", |first| first.trim_end_matches('.'));
    text.to_owned()
}

/// What is wrong comes before where to drive next.
pub(super) fn contradiction((why, code): (&str, Option<&str>), captures: usize) -> String {
    let why = match why.ends_with('?') {
        true => why.to_owned(),
        false => format!("{}.", why.trim_end_matches('.')),
    };
    match captures < KNOWN {
        true => format!(
            "These captures do not fit together: {why} Take another one wherever the whole board is seen: from {KNOWN} on the cause can be found."
        ),
        false => format!("Something is wrong: {why} {}", code.map_or(REMEDY, remedy)),
    }
}

/// What to do about what is wrong, where nothing more is known.
const REMEDY: &str = "Put it right before you go on.";

/// At which step that is put right which a finding names. The captures are read again with what is changed there.
fn remedy(code: &str) -> &'static str {
    match code {
        "poses-inverted" | "robot-poses-inverted" => {
            "See at the step Cell whether the camera is where it is said to be, and at the step Robot whether these are poses of the flange in the base, in this notation."
        }
        "robot-length-unit" | "target-length-unit" => {
            "Choose the notation of the pendant at the step Robot, and enter the size of the board at the step Board."
        }
        "target-scale" | "target-size-contradicted" => {
            "Measure the board, and enter its size at the step Board."
        }
        "camera-refined" | "camera-bends" => {
            "Give other intrinsics at the step Camera, or have them calibrated there."
        }
        "stale-robot-pose" | "robot-pose-frozen" => {
            "See that each pose is read when the robot stands, and take those captures again."
        }
        _ => REMEDY,
    }
}

/// What to do about a newest capture that does not fit.
pub(super) const WHETHER_MOVED: &str = "Take another one: it shows whether camera or board were moved. If one was, begin a new session; if none was, delete this capture";

fn captures(count: usize) -> String {
    match count {
        1 => "1 capture".into(),
        _ => format!("{count} captures"),
    }
}

/// Views before anything can be planned: they differ in what every cell needs.
fn first_views(captures: &[StoredCapture]) -> String {
    let tilt = match captures.len() {
        1 => "Tilt the view by about 25 degrees about the image's x",
        2 => "Now tilt it by about 25 degrees about the image's y",
        _ => "Now rotate it by about 40 degrees about the optical axis, tilted",
    };
    format!("{tilt}, with the whole board in the image, and take a capture.")
}

pub(super) fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Whether a device stands, and a sentence on that.
pub(super) fn standing(motion: &Motion, now: f64, name: &str) -> (bool, String) {
    match motion {
        Motion::Stands(since) => (true, format!("{name} stands since {:.1} s", now - since)),
        Motion::Moves(why) => (false, why.clone()),
    }
}
