//! The session's logic, pure: inputs in, effects out. It has no clock, no files and no threads; time is an input.
//!
//! ```text
//! source ─▶ Input (pose, picture, command, what an effect led to) ─▶ Engine::step ─▶ Effect (store, assess, drive, ..)
//! ```
//!
//! What was confirmed lies in the folder already: an effect stores, its answer comes back as an input, and only then the
//! capture is part of the state.

mod command;
mod hand;
pub mod rest;
mod say;
pub mod view;

use std::{collections::VecDeque, sync::Arc};

use handeye::{Base, Flange, Pose, model::residual::Residual};
use handeye_io::{CellSettings, RefusedCapture, StoredCapture, Writing};

use crate::assess::Assessment;
pub use command::{Command, Destination, Step};
use rest::{Memory, Motion, PictureSample, Rest, RobotSample};

/// What happens to a session.
#[derive(Debug, Clone)]
pub enum Input {
    /// Time goes on, s.
    Clock(f64),
    /// The robot is somewhere.
    Robot(RobotSample),
    /// A picture has come and was looked at.
    Picture(PictureSample),
    /// Somebody asks for something.
    Command(Command),
    /// What the folder holds now.
    Folder(Box<FolderState>),
    /// A capture was stored under this name, or why it was not.
    Stored(Result<String, String>),
    /// A change of the folder could not be made.
    Failed(String),
    /// The captures were assessed.
    Assessed {
        /// Which state of the captures.
        generation: u64,
        /// What they are worth, or why that cannot be said.
        assessment: Result<Arc<Assessment>, String>,
    },
    /// The result was written, or why not.
    Written(Result<Written, String>),
    /// A source has trouble.
    Trouble {
        /// A fixed name.
        code: String,
        /// What.
        message: String,
        /// What to do.
        advice: String,
    },
}

/// How poses or pictures come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// All the time: whether they stand is seen.
    Stream,
    /// One by one, from a person or a program that knows when.
    Single,
}

/// What a session has for sources.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sources {
    /// How poses come.
    pub robot: Flow,
    /// How pictures come.
    pub camera: Flow,
    /// Whether a picture is taken when it is asked for.
    pub takes_pictures: bool,
    /// Whether robot and camera are virtual.
    pub is_virtual: bool,
}

impl Sources {
    /// Those of a virtual cell.
    pub const VIRTUAL: Self =
        Self { robot: Flow::Stream, camera: Flow::Stream, takes_pictures: false, is_virtual: true };
}

/// The files of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The folder.
    pub folder: String,
    /// Names of the files in it.
    pub files: Vec<String>,
}

/// What the folder holds.
#[derive(Debug, Clone, PartialEq)]
pub struct FolderState {
    /// What is known of the cell.
    pub settings: CellSettings,
    /// The captures that stand.
    pub captures: Vec<StoredCapture>,
    /// Names of deleted captures.
    pub deleted: Vec<String>,
    /// Captures that were not taken.
    pub refused: Vec<RefusedCapture>,
}

/// What a session wants to be done.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Store a capture of this picture.
    Store {
        /// The picture's number.
        frame: u64,
        /// Where the robot stood.
        robot: RobotSample,
        /// When the picture was taken, s.
        image_time_s: f64,
    },
    /// Remember a capture that was not taken.
    Refuse(RefusedCapture),
    /// Delete a capture.
    Delete(String),
    /// Take a deleted one in again.
    Restore(String),
    /// Other settings of the cell.
    Configure(Box<CellSettings>),
    /// Assess the captures.
    Assess {
        /// Which state of the captures.
        generation: u64,
        /// Poses that nobody goes to (again).
        not_near: Vec<Pose<Base, Flange>>,
    },
    /// Write the result.
    Write,
    /// Take a picture.
    Grab,
    /// Drive the robot of a virtual cell; no other robot can be moved.
    Drive(Pose<Base, Flange>),
    /// Move the robot of a virtual cell a little, in the camera's axes (mm, degrees).
    Jog([f64; 3], [f64; 3]),
}

/// Why a command is not obeyed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Refusal {
    /// Why.
    pub message: String,
    /// Whether it would be obeyed at another time.
    pub later: bool,
}

/// Samples are kept for so long, s.
const KEPT_S: f64 = 12.0;
/// A capture that is waited for is refused after so long, s.
const PATIENCE_S: f64 = 15.0;
/// A board that is not found while all stands is looked for so long, s.
const LOOKING_S: f64 = 2.5;
/// A robot stands at another pose, rad and m.
const ELSEWHERE: Residual = Residual { angle: 0.03, distance: 0.01 };
/// Approaches from which the delay of the pictures is known.
const APPROACHES: usize = 5;
/// Pictures may be so much later than the latest approach shows, s.
const DELAY_MARGIN_S: f64 = 0.05;
/// Pictures that come later than this are worth a word, s.
const LATE_S: f64 = 0.3;

/// The state of a session.
#[derive(Debug, Clone)]
pub struct Engine {
    now: f64,
    version: u64,
    step: Step,
    farthest: Step,
    sources: Sources,
    folder: FolderState,
    robot: VecDeque<RobotSample>,
    pictures: VecDeque<PictureSample>,
    memory: Memory,
    rest: Rest,
    delays: VecDeque<f64>,
    approach_measured: Option<f64>,
    wish: Option<Wish>,
    automatic: bool,
    storing: bool,
    changes: Vec<Change>,
    skipped: Vec<Pose<Base, Flange>>,
    assessed: Option<Arc<Assessment>>,
    generation: u64,
    assessing: bool,
    assessments: u64,
    history: Vec<(usize, f64)>,
    problem: Option<view::Problem>,
    written: Option<Written>,
    used: hand::Used,
    grabbing: bool,
}

/// A capture that is waited for.
#[derive(Debug, Clone, PartialEq)]
struct Wish {
    since: f64,
    why: String,
    /// Since when all stands, but the board is not found.
    unseen_since: Option<f64>,
}

/// What can be undone.
#[derive(Debug, Clone, PartialEq)]
enum Change {
    Taken(String),
    Deleted(String),
    Restored(String),
}

impl Engine {
    /// A session of a folder as it is; with captures it goes on with them.
    pub fn new(folder: FolderState, sources: Sources) -> (Self, Vec<Effect>) {
        let silent = || Motion::Moves("nothing has come yet".into());
        let step = if folder.captures.is_empty() { Step::Cell } else { Step::Capture };
        let mut engine = Self {
            now: 0.0,
            version: 1,
            step,
            farthest: step,
            sources,
            folder,
            robot: VecDeque::new(),
            pictures: VecDeque::new(),
            memory: Memory::default(),
            rest: Rest {
                robot: silent(),
                picture: silent(),
                ready: Err("nothing has come yet".into()),
            },
            delays: VecDeque::new(),
            approach_measured: None,
            wish: None,
            automatic: false,
            storing: false,
            changes: vec![],
            skipped: vec![],
            assessed: None,
            generation: 0,
            assessing: false,
            assessments: 0,
            history: vec![],
            problem: None,
            written: None,
            used: hand::Used::default(),
            grabbing: false,
        };
        let effects = engine.assess();
        (engine, effects)
    }

    /// Grows whenever what is shown changes.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The time of the last input that had one, s.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// What is known of the cell.
    pub fn settings(&self) -> &CellSettings {
        &self.folder.settings
    }

    /// Takes an input; returns what is to be done.
    ///
    /// # Errors
    /// A command that cannot be obeyed; nothing has changed then.
    pub fn step(&mut self, input: Input) -> Result<Vec<Effect>, Refusal> {
        let effects = match input {
            Input::Clock(now) => {
                self.now = self.now.max(now);
                self.wait()
            }
            Input::Robot(sample) => self.robot_at(sample),
            Input::Picture(sample) => self.picture(sample),
            Input::Command(command) => self.obey(command)?,
            Input::Folder(folder) => self.holds(*folder),
            Input::Stored(stored) => self.stored(stored),
            Input::Failed(why) => {
                self.trouble("not-written", why);
                vec![]
            }
            Input::Assessed { generation, assessment } => self.assessed(generation, assessment),
            Input::Written(written) => self.result(written),
            Input::Trouble { code, message, advice } => {
                (self.grabbing, self.wish) = (false, None);
                self.problem = Some(view::Problem { code, message, advice });
                vec![]
            }
        };
        self.version += 1;
        Ok(effects)
    }

    fn robot_at(&mut self, sample: RobotSample) -> Vec<Effect> {
        // a clock that was set back: what was seen belongs to another time
        if self.robot.back().is_some_and(|last| sample.time_s < last.time_s) {
            self.robot.clear();
            self.memory.robot = None;
            self.memory.robot_far = None;
        }
        self.now = self.now.max(sample.time_s);
        self.robot.push_back(sample);
        while self.robot.len() > 1 && self.robot[0].time_s < self.now - KEPT_S {
            self.robot.pop_front();
        }
        match self.is_by_hand() {
            true => self.wait(),
            false => vec![],
        }
    }

    fn picture(&mut self, sample: PictureSample) -> Vec<Effect> {
        if self.pictures.back().is_some_and(|last| sample.time_s < last.time_s) {
            self.pictures.clear();
            self.memory.picture = None;
        }
        self.now = self.now.max(sample.time_s);
        self.grabbing = false;
        // looked at again, for another board
        self.pictures.retain(|old| old.frame != sample.frame);
        self.pictures.push_back(sample);
        while self.pictures.len() > 1 && self.pictures[0].time_s < self.now - KEPT_S {
            self.pictures.pop_front();
        }
        self.wait()
    }

    /// Judges whether all stands, and takes the capture that is waited for.
    fn wait(&mut self) -> Vec<Effect> {
        let robot = &*self.robot.make_contiguous();
        let pictures = &*self.pictures.make_contiguous();
        let delay = self.delays.iter().copied().reduce(f64::max).map(|s| s + DELAY_MARGIN_S);
        self.rest = rest::judge((robot, pictures), &mut self.memory, delay, self.now);
        // once for each approach
        if let Motion::Stands(since) = self.rest.robot
            && self.approach_measured != Some(since)
            && let Some(late) = rest::delay(&self.rest, robot, pictures)
        {
            self.approach_measured = Some(since);
            self.delays.push_back(late);
            while self.delays.len() > APPROACHES {
                self.delays.pop_front();
            }
        }
        if self.is_by_hand() {
            self.rest.ready = self.ready_by_hand();
        }
        if self.automatic && self.wish.is_none() && !self.storing && self.is_elsewhere() {
            self.wish = Some(Wish { since: self.now, why: String::new(), unseen_since: None });
        }
        self.fulfil()
    }

    /// How much later pictures come than they are taken, s: an upper bound from the last approaches.
    fn delay(&self) -> Option<f64> {
        self.delays.iter().copied().reduce(f64::max)
    }

    /// Whether the robot is where no capture was taken, and none was refused.
    fn is_elsewhere(&self) -> bool {
        let Some(here) = self.robot.back().map(|s| s.base_from_flange) else { return false };
        let near = |pose: &Pose<Base, Flange>| Residual::between(pose, &here).is_within(ELSEWHERE);
        let taken = self.folder.captures.iter().map(|c| c.base_from_flange);
        let refused = self.folder.refused.iter().filter_map(|r| r.base_from_flange);
        self.step == Step::Capture && !taken.chain(refused).any(|pose| near(&pose))
    }

    fn fulfil(&mut self) -> Vec<Effect> {
        let by_hand = self.is_by_hand();
        let Some(wish) = &mut self.wish else { return vec![] };
        let ready = match &self.rest.ready {
            Ok(frame) => Ok(*frame),
            Err(why) => Err(why.clone()),
        };
        match ready {
            Ok(frame) => {
                let (Some(robot), Some(picture)) =
                    (self.robot.back(), self.pictures.iter().find(|p| p.frame == frame))
                else {
                    return vec![];
                };
                let effect = Effect::Store {
                    frame,
                    robot: robot.clone(),
                    image_time_s: picture.time_s - self.delay().unwrap_or(0.0),
                };
                (self.wish, self.storing, self.problem) = (None, true, None);
                self.used.note(frame, robot.time_s);
                vec![effect]
            }
            Err(why) if by_hand => {
                wish.why = why;
                match self.unseen_by_hand() {
                    Some(why) => self.refuse(why),
                    None => self.grab(),
                }
            }
            Err(why) => {
                let stands = matches!(self.rest.robot, Motion::Stands(since) if self.now - since > LOOKING_S);
                let unseen = self.pictures.back().is_some_and(|p| p.corners.is_err());
                let since = match stands && unseen {
                    true => Some(*wish.unseen_since.get_or_insert(self.now)),
                    false => None,
                };
                (wish.unseen_since, wish.why) = (since, why.clone());
                let is_over = since.is_some_and(|since| self.now - since > LOOKING_S)
                    || self.now - wish.since > PATIENCE_S;
                if is_over { self.refuse(why) } else { vec![] }
            }
        }
    }

    fn refuse(&mut self, why: String) -> Vec<Effect> {
        self.wish = None;
        let base_from_flange = self.robot.back().map(|s| s.base_from_flange);
        self.problem = Some(view::Problem {
            code: "not-taken".into(),
            message: format!("no capture was taken: {why}"),
            advice: "go to another pose from where the whole board is seen, or skip this view"
                .into(),
        });
        let refused = RefusedCapture { why, base_from_flange, time_s: self.now };
        let mut effects = vec![Effect::Refuse(refused)];
        self.skipped.extend(base_from_flange);
        effects.extend(self.assess());
        effects
    }

    fn holds(&mut self, folder: FolderState) -> Vec<Effect> {
        let names = |f: &FolderState| f.captures.iter().map(|c| c.id.clone()).collect::<Vec<_>>();
        let has_changed =
            names(&folder) != names(&self.folder) || folder.settings != self.folder.settings;
        self.folder = folder;
        if has_changed { self.assess() } else { vec![] }
    }

    fn stored(&mut self, stored: Result<String, String>) -> Vec<Effect> {
        self.storing = false;
        match stored {
            Ok(id) => self.changes.push(Change::Taken(id)),
            Err(why) => self.trouble("not-written", why),
        }
        vec![]
    }

    fn trouble(&mut self, code: &str, message: String) {
        let advice =
            "the captures before it are safe; put it right and take the capture again".into();
        self.problem = Some(view::Problem { code: code.into(), message, advice });
    }

    /// Asks for a new assessment of the captures that stand.
    fn assess(&mut self) -> Vec<Effect> {
        self.generation += 1;
        self.written = None;
        if self.folder.captures.is_empty() {
            (self.assessed, self.assessing) = (None, false);
            return vec![];
        }
        self.assessing = true;
        let refused = self.folder.refused.iter().filter_map(|r| r.base_from_flange);
        let not_near = self.skipped.iter().copied().chain(refused).collect();
        vec![Effect::Assess { generation: self.generation, not_near }]
    }

    fn assessed(
        &mut self,
        generation: u64,
        assessment: Result<Arc<Assessment>, String>,
    ) -> Vec<Effect> {
        if generation != self.generation {
            return vec![];
        }
        self.assessing = false;
        self.assessments += 1;
        match assessment {
            Ok(assessment) => {
                let count = self.folder.captures.len();
                self.history.retain(|(n, _)| *n < count);
                self.history.extend(assessment.p95_mm().map(|mm| (count, mm)));
                self.assessed = Some(assessment);
            }
            Err(why) => {
                self.assessed = None;
                self.trouble("not-assessed", why);
            }
        }
        vec![]
    }

    fn result(&mut self, written: Result<Written, String>) -> Vec<Effect> {
        match written {
            Ok(written) => {
                self.written = Some(written);
                self.enter(Step::Result);
            }
            Err(why) => self.trouble("not-written", why),
        }
        vec![]
    }

    fn enter(&mut self, step: Step) {
        self.step = step;
        self.farthest = self.farthest.max(step);
        if step != Step::Capture {
            self.wish = None;
        }
    }

    fn obey(&mut self, command: Command) -> Result<Vec<Effect>, Refusal> {
        match command {
            Command::Confirm { step } => self.confirm(step),
            Command::Go { step } => {
                if step > self.farthest {
                    return Err(later(format!(
                        "the step {step:?} is not open yet: confirm those before it"
                    )));
                }
                self.enter(step);
                Ok(vec![])
            }
            Command::Cell { setup, tolerance_mm } => {
                if tolerance_mm.is_some_and(|mm| !(mm > 0.0 && mm.is_finite())) {
                    return Err(wrong("the tolerance is a positive number of millimetres"));
                }
                let old = &self.folder.settings;
                self.configure(CellSettings {
                    setup: setup.unwrap_or(old.setup),
                    tolerance_mm: tolerance_mm.unwrap_or(old.tolerance_mm),
                    ..old.clone()
                })
            }
            Command::Target { target } => {
                target.check().map_err(|e| wrong(e.to_string()))?;
                self.configure(CellSettings { target, ..self.folder.settings.clone() })
            }
            Command::Camera { intrinsics } => {
                if let Some(camera) = &intrinsics {
                    camera.check().map_err(|e| wrong(e.to_string()))?;
                }
                self.configure(CellSettings { intrinsics, ..self.folder.settings.clone() })
            }
            Command::Notation { name } => {
                Writing::of(&name).map_err(wrong)?;
                self.configure(CellSettings { notation: name, ..self.folder.settings.clone() })
            }
            Command::Take => self.want(),
            Command::Automatic { on } => {
                self.automatic = on;
                Ok(vec![])
            }
            Command::Cancel => {
                self.wish = None;
                Ok(vec![])
            }
            Command::Grab if self.sources.takes_pictures => {
                self.grabbing = true;
                Ok(vec![Effect::Grab])
            }
            Command::Grab => Err(wrong("pictures come by themselves in this session")),
            Command::Pose { text } => self.typed(&text),
            Command::Delete { id } => self.delete(id),
            Command::Restore { id } => self.restore(id),
            Command::Retake { id } => self.delete(id),
            Command::Undo => self.undo(),
            Command::Skip { .. } => {
                let next =
                    self.next().ok_or_else(|| later("there is no next view to skip".into()))?;
                self.skipped.push(next.view.station.base_from_flange);
                Ok(self.assess())
            }
            Command::Finish => self.finish(),
            Command::Drive { to } => self.drive(to),
            Command::Jog { move_mm, turn_deg } => match self.sources.is_virtual {
                true => Ok(vec![Effect::Jog(move_mm, turn_deg)]),
                false => Err(only_virtual()),
            },
        }
    }

    fn next(&self) -> Option<&crate::assess::ProposedView> {
        self.assessed.as_ref().filter(|_| !self.assessing)?.next.as_ref()
    }

    fn confirm(&mut self, step: Step) -> Result<Vec<Effect>, Refusal> {
        if step != self.step {
            return Err(later(format!("the session is at another step ({:?})", self.step)));
        }
        let proof = self.proof(step);
        if !proof.proven {
            return Err(later(proof.text));
        }
        match step.next() {
            Some(Step::Result) => self.finish(),
            Some(next) => {
                self.enter(next);
                Ok(vec![])
            }
            None => Ok(vec![]),
        }
    }

    fn configure(&mut self, settings: CellSettings) -> Result<Vec<Effect>, Refusal> {
        let is_other = CellSettings {
            tolerance_mm: self.folder.settings.tolerance_mm,
            notation: self.folder.settings.notation.clone(),
            ..settings.clone()
        } != self.folder.settings;
        if is_other && !(self.folder.captures.is_empty() && self.folder.deleted.is_empty()) {
            return Err(later(
                "there are captures of the cell as it was: begin a session in a new folder for another camera, board or setup".into(),
            ));
        }
        if is_other && self.sources.is_virtual {
            return Err(wrong("a virtual cell has its own setup, camera and board"));
        }
        Ok(vec![Effect::Configure(Box::new(settings))])
    }

    fn want(&mut self) -> Result<Vec<Effect>, Refusal> {
        if self.step != Step::Capture {
            return Err(later("captures are taken in the step `capture`".into()));
        }
        if self.storing {
            return Err(later("a capture is being stored".into()));
        }
        if self.wish.is_none() {
            self.wish = Some(Wish { since: self.now, why: String::new(), unseen_since: None });
        }
        self.problem = None;
        Ok(self.wait())
    }

    fn delete(&mut self, id: String) -> Result<Vec<Effect>, Refusal> {
        if !self.folder.captures.iter().any(|c| c.id == id) {
            return Err(wrong(format!("there is no capture {id}")));
        }
        self.changes.push(Change::Deleted(id.clone()));
        Ok(vec![Effect::Delete(id)])
    }

    fn restore(&mut self, id: String) -> Result<Vec<Effect>, Refusal> {
        if !self.folder.deleted.contains(&id) {
            return Err(wrong(format!("there is no deleted capture {id}")));
        }
        self.changes.push(Change::Restored(id.clone()));
        Ok(vec![Effect::Restore(id)])
    }

    fn undo(&mut self) -> Result<Vec<Effect>, Refusal> {
        match self.changes.pop() {
            None => Err(later("there is nothing to undo".into())),
            Some(Change::Taken(id) | Change::Restored(id)) => Ok(vec![Effect::Delete(id)]),
            Some(Change::Deleted(id)) => Ok(vec![Effect::Restore(id)]),
        }
    }

    fn finish(&mut self) -> Result<Vec<Effect>, Refusal> {
        match self.folder.captures.is_empty() {
            true => Err(later("there are no captures yet".into())),
            false => Ok(vec![Effect::Write]),
        }
    }

    fn drive(&mut self, to: Destination) -> Result<Vec<Effect>, Refusal> {
        if !self.sources.is_virtual {
            return Err(only_virtual());
        }
        match (to, self.next()) {
            (Destination::Next, Some(next)) => {
                Ok(vec![Effect::Drive(next.view.station.base_from_flange)])
            }
            (Destination::Next, None) => Err(later("there is no next view yet".into())),
            (Destination::Check, _) => Err(later("views that verify are not taken yet".into())),
        }
    }
}

fn wrong(message: impl Into<String>) -> Refusal {
    Refusal { message: message.into(), later: false }
}

fn later(message: String) -> Refusal {
    Refusal { message, later: true }
}

fn only_virtual() -> Refusal {
    wrong("no robot is moved but that of a virtual cell: drive it by its pendant")
}
