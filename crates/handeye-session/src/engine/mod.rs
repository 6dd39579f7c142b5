//! The session's logic, pure: inputs in, effects out. It has no clock, no files and no threads; time is an input.
//!
//! ```text
//! source ─▶ Input (pose, image, command, what an effect led to) ─▶ Engine::step ─▶ Effect (store, assess, drive, ..)
//! ```
//!
//! What was confirmed lies in the folder already: an effect stores, its answer comes back as an input, and only then the
//! capture is part of the state.

mod arm;
mod command;
mod hand;
mod inputs;
mod obey;
mod placement;
pub mod rest;
mod say;
pub mod shown;
mod taking;
pub(crate) mod touch;
mod verify;
mod view;

use std::{collections::VecDeque, sync::Arc};

use handeye::{Base, Flange, Pose};
use handeye_io::CellSettings;

use crate::assess::{Assessment, ProposedView};
pub use command::{Command, Destination, Step};
pub use inputs::{Effect, Flow, FolderState, Input, Problem, Sources, Written};
pub use obey::Refusal;
use placement::LyingBoard;
use rest::{ImageSample, Memory, Motion, Rest, RobotSample};
use taking::Wish;

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
    arm: arm::ArmNow,
    images: VecDeque<ImageSample>,
    memory: Memory,
    rest: Rest,
    delays: VecDeque<f64>,
    approach_measured: Option<f64>,
    wish: Option<Wish>,
    automatic: bool,
    storing: bool,
    changes: Vec<Change>,
    skipped: Vec<Pose<Base, Flange>>,
    /// A capture that is to be taken again, and its view.
    again: Option<(String, ProposedView)>,
    assessed: Option<Arc<Assessment>>,
    generation: u64,
    assessing: bool,
    assessments: u64,
    history: Vec<(usize, f64)>,
    problem: Option<Problem>,
    written: Option<Written>,
    used: hand::Used,
    grabbing: bool,
    /// Poses are being read again.
    rereading: bool,
    /// The corner to which the tip of a virtual cell's tool is led, and since when, s.
    tip_to: Option<(u32, f64)>,
    /// The board that lies in the view of a virtual cell's camera.
    lies: Option<LyingBoard>,
}

/// What can be undone.
#[derive(Debug, Clone, PartialEq)]
enum Change {
    Taken(String),
    Deleted(String),
    Restored(String),
    Touched(String),
    Untouched(String),
    Placed(String),
}

impl Engine {
    /// A session of a folder as it is; with captures it goes on with them.
    pub fn new(folder: FolderState, sources: Sources) -> (Self, Vec<Effect>) {
        let silent = || Motion::Moves("nothing has come yet".into());
        let arm = arm::ArmNow::of_last_capture(&folder);
        let step = if folder.captures.is_empty() { Step::Cell } else { Step::Capture };
        let mut engine = Self {
            now: 0.0,
            version: 1,
            step,
            farthest: step,
            sources,
            folder,
            robot: VecDeque::new(),
            arm,
            images: VecDeque::new(),
            memory: Memory::default(),
            rest: Rest {
                robot: silent(),
                image: silent(),
                ready: Err("nothing has come yet".into()),
            },
            delays: VecDeque::new(),
            approach_measured: None,
            wish: None,
            automatic: false,
            storing: false,
            changes: vec![],
            skipped: vec![],
            again: None,
            assessed: None,
            generation: 0,
            assessing: false,
            assessments: 0,
            history: vec![],
            problem: None,
            written: None,
            used: hand::Used::default(),
            grabbing: false,
            rereading: false,
            tip_to: None,
            lies: None,
        };
        let effects = engine.assess();
        (engine, effects)
    }

    /// At the captures from the beginning: whoever begins the session has declared what the steps before them ask.
    #[must_use]
    pub fn declared(mut self) -> Self {
        self.enter(Step::Capture);
        self
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
            Input::Image(sample) => self.image(sample),
            Input::Command(command) => self.obey(command)?,
            Input::Folder(folder) => self.holds(*folder),
            Input::Stored(stored) => self.stored(stored),
            Input::Touched(touched) => self.touched(touched),
            Input::Failed(why) => {
                self.rereading = false;
                self.trouble("not-written", why);
                vec![]
            }
            Input::Assessed { generation, assessment } => self.assessed(generation, assessment),
            Input::Written(written) => self.result(written),
            Input::Trouble(problem) => {
                (self.grabbing, self.wish) = (false, None);
                self.problem = Some(problem);
                vec![]
            }
        };
        self.version += 1;
        Ok(effects)
    }

    /// What the folder holds now; where that is something else, it is assessed anew.
    fn holds(&mut self, folder: FolderState) -> Vec<Effect> {
        let has_changed = folder != self.folder;
        self.rereading = false;
        self.folder = folder;
        self.again.take_if(|(id, _)| self.folder.captures.iter().any(|c| c.id == *id));
        if !has_changed {
            return vec![];
        }
        self.written = None;
        self.assess()
    }

    fn stored(&mut self, stored: Result<String, String>) -> Vec<Effect> {
        self.storing = false;
        match stored {
            Ok(id) => {
                let is_placement = self.folder.placements.iter().any(|p| p.id == id);
                let change = match is_placement {
                    true => self.placed(id),
                    false => {
                        self.again = None;
                        Change::Taken(id)
                    }
                };
                self.changes.push(change);
            }
            Err(why) => self.trouble("not-written", why),
        }
        vec![]
    }

    fn trouble(&mut self, code: &str, message: String) {
        let advice =
            "the captures before it are safe; put it right and take the capture again".into();
        self.problem = Some(Problem { code: code.into(), message, advice });
    }

    /// Asks for a new assessment of the captures that stand.
    fn assess(&mut self) -> Vec<Effect> {
        self.generation += 1;
        if self.folder.captures.is_empty() {
            (self.assessed, self.assessing) = (None, false);
            return vec![];
        }
        self.assessing = true;
        let refused = self.folder.refused.iter().filter_map(|r| r.base_from_flange);
        let seen = self.folder.verification.iter().map(|view| view.base_from_flange);
        let not_near = self.skipped.iter().copied().chain(refused).chain(seen).collect();
        let goes_on = self.step == Step::Verify;
        let joints = self.joints_now().map(<[f64]>::to_vec);
        vec![Effect::Assess { generation: self.generation, not_near, goes_on, joints }]
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
        self.farthest = self.farthest.max(step);
        if step != self.step {
            // what was asked for in one step is not done in another
            self.wish = None;
            if ![self.step, step].iter().all(|s| matches!(s, Step::Capture | Step::Touch)) {
                self.again = None;
            }
        }
        self.step = step;
    }
}
