//! A session as it runs: a thread for the engine, one for the folder, and those of its sources. Nothing waits for anything
//! slow: a disk that hangs stops captures, and neither the page nor the robot's numbers.

use std::{
    collections::VecDeque,
    path::{Path, PathBuf},
    sync::{
        Arc,
        mpsc::{self, Receiver, RecvTimeoutError, Sender},
    },
    thread,
    time::{Duration, Instant},
};

use tokio::sync::{oneshot, watch};

use crate::{
    engine::{Command, Effect, Engine, Flow, Input, Refusal, Sources, shown::CaptureDetail},
    host::{Host, drive},
    sources::{
        command, folder,
        outlet::{CameraImage, Outlet, Wanted},
        upload::Uploads,
        ur_rtde::{self, UrRobot},
        virtual_cell::{VirtualCamera, VirtualCell},
    },
};

/// Where poses and images come from.
pub enum Cell {
    /// A virtual cell.
    Virtual(Box<VirtualCell>),
    /// Poses are typed; images come from somewhere.
    Hand(Camera),
    /// Poses stream from a robot of Universal Robots; images come from somewhere.
    Ur(UrRobot, Camera),
}

/// Where images come from, one by one.
pub enum Camera {
    /// A folder in which another program saves them.
    Folder(PathBuf),
    /// A command that takes one, with `{out}` for the file that it writes.
    Command(String),
    /// Whoever has the page, or a script: they are uploaded.
    Upload,
}

/// What is shown, as JSON, and its version.
#[derive(Debug, Clone, Default)]
pub struct Shown {
    /// Grows with every change.
    pub version: u64,
    /// The state.
    pub json: Arc<str>,
    /// What was measured in captures.
    pub details: Arc<Vec<CaptureDetail>>,
}

/// A session that runs, for those who show it and ask things of it.
#[derive(Clone)]
pub struct Live {
    asked: Sender<Asked>,
    shown: watch::Receiver<Shown>,
    frames: watch::Receiver<u64>,
    outlet: Outlet,
    uploads: Option<Uploads>,
    folder: PathBuf,
}

/// The version of the state that has it, or why a command is not obeyed.
type Answer = Result<u64, Refusal>;

/// A command, and who waits for the answer.
struct Asked(Command, oneshot::Sender<Answer>);

fn gone() -> Refusal {
    Refusal { message: "the session has ended".into(), later: true }
}

/// How often the state is shown anew, at most.
const SHOWN: Duration = Duration::from_millis(100);
/// Inputs are waited for so long before commands are looked at.
const TICK: Duration = Duration::from_millis(20);
/// Between two poses of a virtual robot, and two images of its camera.
const POSES: Duration = Duration::from_millis(40);
const IMAGES: Duration = Duration::from_millis(200);

impl Live {
    /// Begins a session.
    pub fn begin(host: Host, cell: Cell) -> Self {
        let (asked, asking) = mpsc::channel();
        let (inputs, inbox) = mpsc::channel();
        let (show, shown) = watch::channel(Shown::default());
        let (show_frame, frames) = watch::channel(0);
        let folder = host.path().to_path_buf();
        let state = host.state();
        let outlet = Outlet::new(inputs.clone(), Wanted::of(&state.settings), show_frame);
        let (sources, equipment) = connect(cell, &outlet);
        let uploads = sources.takes_uploads().then(|| Uploads::to(outlet.clone(), &folder));
        let (engine, effects) = Engine::new(state, sources);
        let mut runner = Runner {
            engine,
            equipment,
            work: worker(host, inputs),
            outlet: outlet.clone(),
            show,
            folder: folder.clone(),
            details: Arc::default(),
            detailed: 0,
        };
        runner.publish(); // there is a state from the first moment
        thread::spawn(move || runner.run((&inbox, &asking), effects));
        Self { asked, shown, frames, outlet, uploads, folder }
    }

    /// Asks for something; the answer comes at once, what it leads to is in the state.
    ///
    /// # Errors
    /// Why it cannot be obeyed.
    pub async fn command(&self, command: Command) -> Result<u64, Refusal> {
        self.ask(command)?.await.unwrap_or_else(|_| Err(gone()))
    }

    /// The same from a thread that may wait.
    ///
    /// # Errors
    /// Why it cannot be obeyed.
    pub fn command_blocking(&self, command: Command) -> Result<u64, Refusal> {
        self.ask(command)?.blocking_recv().unwrap_or_else(|_| Err(gone()))
    }

    fn ask(&self, command: Command) -> Result<oneshot::Receiver<Answer>, Refusal> {
        let (answer, answered) = oneshot::channel();
        self.asked.send(Asked(command, answer)).map_err(|_| gone())?;
        Ok(answered)
    }

    /// What is shown, now and from now on.
    pub fn shown(&self) -> watch::Receiver<Shown> {
        self.shown.clone()
    }

    /// Numbers of images, now and from now on.
    pub fn frames(&self) -> watch::Receiver<u64> {
        self.frames.clone()
    }

    /// The newest image, and its number.
    pub fn newest_image(&self) -> Option<(u64, CameraImage)> {
        self.outlet.images().newest()
    }

    /// Where images are uploaded; `None` where they come otherwise.
    pub fn uploads(&self) -> Option<&Uploads> {
        self.uploads.as_ref()
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

/// What effects for sources go to.
enum Equipment {
    Virtual(Arc<VirtualCell>),
    Command(Sender<()>),
    Nothing,
}

/// Starts the threads of the sources.
fn connect(cell: Cell, outlet: &Outlet) -> (Sources, Equipment) {
    match cell {
        Cell::Virtual(cell) => {
            let cell = Arc::new(*cell);
            virtual_robot(cell.clone(), outlet.clone());
            virtual_camera(cell.clone(), outlet.clone());
            (Sources::VIRTUAL, Equipment::Virtual(cell))
        }
        Cell::Hand(camera) => connect_camera(camera, Flow::Single, outlet),
        Cell::Ur(robot, camera) => {
            ur_rtde::stream(robot, outlet.clone());
            connect_camera(camera, Flow::Stream, outlet)
        }
    }
}

/// Starts the thread of a camera whose images come one by one, beside a robot whose poses come like this.
fn connect_camera(camera: Camera, robot: Flow, outlet: &Outlet) -> (Sources, Equipment) {
    let sources =
        |takes_images| Sources { robot, camera: Flow::Single, takes_images, is_virtual: false };
    match camera {
        Camera::Folder(path) => {
            folder::watch(path, outlet.clone());
            (sources(false), Equipment::Nothing)
        }
        Camera::Upload => (sources(false), Equipment::Nothing),
        Camera::Command(line) => {
            (sources(true), Equipment::Command(command::grabber(line, outlet.clone())))
        }
    }
}

/// The engine's thread.
struct Runner {
    engine: Engine,
    equipment: Equipment,
    work: Sender<(Effect, Option<CameraImage>)>,
    outlet: Outlet,
    show: watch::Sender<Shown>,
    folder: PathBuf,
    details: Arc<Vec<CaptureDetail>>,
    detailed: u64,
}

impl Runner {
    fn run(mut self, (inbox, asking): (&Receiver<Input>, &Receiver<Asked>), effects: Vec<Effect>) {
        self.perform(effects);
        let mut shown: Option<Instant> = None;
        loop {
            let mut urgent = false;
            match inbox.recv_timeout(TICK) {
                Ok(input) => urgent = self.take(input),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            while let Ok(input) = inbox.try_recv() {
                urgent |= self.take(input);
            }
            while let Ok(asked) = asking.try_recv() {
                self.answer(asked);
                urgent = true;
            }
            if urgent || shown.is_none_or(|at| at.elapsed() >= SHOWN) {
                let effects = self.engine.step(Input::Clock(self.outlet.now())).unwrap_or_default();
                self.perform(effects);
                shown = Some(Instant::now());
                self.publish();
            }
        }
    }

    /// Whether the state is to be shown at once.
    fn take(&mut self, input: Input) -> bool {
        let is_rare = !matches!(input, Input::Robot(_) | Input::Image(_) | Input::Clock(_));
        if let Input::Folder(state) = &input {
            self.outlet.want(Wanted::of(&state.settings));
        }
        let effects = self.engine.step(input).unwrap_or_default();
        self.perform(effects);
        is_rare
    }

    fn answer(&mut self, Asked(command, answer): Asked) {
        let done = self.engine.step(Input::Command(command));
        let version = done.map(|effects| {
            self.perform(effects);
            self.engine.version()
        });
        // whoever asked may be gone
        answer.send(version).ok();
    }

    fn perform(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            match (&effect, &self.equipment) {
                (
                    Effect::Drive(_) | Effect::DriveTip(_) | Effect::Lay(_) | Effect::Jog(..),
                    Equipment::Virtual(cell),
                ) => {
                    drive(cell, &effect, self.outlet.now());
                }
                (Effect::Grab, Equipment::Command(ask)) => _ = ask.send(()),
                _ => {
                    let image = effect.frame().and_then(|frame| self.outlet.images().get(frame));
                    self.work.send((effect, image)).ok();
                }
            }
        }
    }

    fn publish(&mut self) {
        let title = self.folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let state = self.engine.view(&self.folder.display().to_string(), &title);
        if self.detailed != state.assessed {
            (self.detailed, self.details) = (state.assessed, Arc::new(self.engine.details()));
        }
        let json = serde_json::to_string(&state).unwrap_or_default().into();
        let details = self.details.clone();
        self.show.send_replace(Shown { version: state.version, json, details });
    }
}

/// The folder's thread.
fn worker(mut host: Host, back: Sender<Input>) -> Sender<(Effect, Option<CameraImage>)> {
    let (work, waiting) = mpsc::channel::<(Effect, Option<CameraImage>)>();
    let is_assess = |effect: &Effect| matches!(effect, Effect::Assess { .. });
    thread::spawn(move || {
        let mut queue = VecDeque::new();
        loop {
            if queue.is_empty() {
                let Ok(next) = waiting.recv() else { return };
                queue.push_back(next);
            }
            queue.extend(waiting.try_iter());
            let Some((effect, image)) = queue.pop_front() else { continue };
            // of several assessments only the last is asked for
            if is_assess(&effect) && queue.iter().any(|(later, _)| is_assess(later)) {
                continue;
            }
            for input in host.perform(effect, image) {
                if back.send(input).is_err() {
                    return;
                }
            }
        }
    });
    work
}

fn virtual_robot(cell: Arc<VirtualCell>, outlet: Outlet) {
    thread::spawn(move || {
        while outlet.robot(cell.sample(outlet.now())) {
            thread::sleep(POSES);
        }
    });
}

fn virtual_camera(cell: Arc<VirtualCell>, outlet: Outlet) {
    thread::spawn(move || {
        let mut camera = VirtualCamera::default();
        for frame in 1.. {
            let begin = Instant::now();
            let time_s = outlet.now();
            let image = camera.image(&cell, time_s, frame);
            if !outlet.image(CameraImage::in_memory(image), time_s) {
                return;
            }
            thread::sleep(IMAGES.saturating_sub(begin.elapsed()));
        }
    });
}
