//! A session as it runs: a thread for the engine, one for the folder, and those of its sources. Nothing waits for anything
//! slow: a disk that hangs stops captures, and neither the page nor the robot's numbers.

use std::{
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, Receiver, RecvTimeoutError, Sender},
    },
    thread,
    time::{Duration, Instant},
};

use handeye::detect;
use tokio::sync::{oneshot, watch};

use crate::{
    engine::{Command, Effect, Engine, Input, Refusal, rest::PictureSample},
    host::{Host, Pictures, drive},
    sources::virtual_cell::VirtualCell,
};

/// What is shown, as JSON, and its version.
#[derive(Debug, Clone, Default)]
pub struct Shown {
    /// Grows with every change.
    pub version: u64,
    /// The state.
    pub json: Arc<str>,
}

/// A session that runs, for those who show it and ask things of it.
#[derive(Clone)]
pub struct Live {
    asked: Sender<Message>,
    shown: watch::Receiver<Shown>,
    frames: watch::Receiver<u64>,
    pictures: Arc<Mutex<Pictures>>,
    folder: PathBuf,
}

/// What comes to the engine.
enum Message {
    Input(Input),
    /// A command, and who waits for the answer: the version that has it.
    Command(Command, oneshot::Sender<Result<u64, Refusal>>),
}

/// How often the state is shown anew, at most.
const SHOWN: Duration = Duration::from_millis(100);
/// Between two poses of a virtual robot, and two pictures of its camera.
const POSES: Duration = Duration::from_millis(40);
const PICTURES: Duration = Duration::from_millis(200);

impl Live {
    /// Begins a session with a virtual cell.
    pub fn begin(host: Host, cell: VirtualCell) -> Self {
        let (asked, inbox) = mpsc::channel();
        let (show, shown) = watch::channel(Shown::default());
        let (show_frame, frames) = watch::channel(0);
        let pictures = Arc::new(Mutex::new(Pictures::default()));
        let folder = host.path().to_path_buf();
        let cell = Arc::new(cell);
        let begin = Instant::now();
        let clock = move || begin.elapsed().as_secs_f64();
        robot(cell.clone(), asked.clone(), clock);
        camera(cell.clone(), asked.clone(), pictures.clone(), show_frame, clock);
        let (engine, effects) = Engine::new(host.state(), true);
        let work = worker(host, asked.clone());
        let runner = Runner {
            engine,
            cell,
            work,
            pictures: pictures.clone(),
            show,
            folder: folder.clone(),
            clock: Box::new(clock),
        };
        thread::spawn(move || runner.run(&inbox, effects));
        Self { asked, shown, frames, pictures, folder }
    }

    /// Asks for something; the answer comes at once, what it leads to is in the state.
    ///
    /// # Errors
    /// Why it cannot be obeyed.
    pub async fn command(&self, command: Command) -> Result<u64, Refusal> {
        let (answer, answered) = oneshot::channel();
        let gone = || Refusal { message: "the session has ended".into(), later: true };
        self.asked.send(Message::Command(command, answer)).map_err(|_| gone())?;
        answered.await.unwrap_or_else(|_| Err(gone()))
    }

    /// What is shown, now and from now on.
    pub fn shown(&self) -> watch::Receiver<Shown> {
        self.shown.clone()
    }

    /// Numbers of pictures, now and from now on.
    pub fn frames(&self) -> watch::Receiver<u64> {
        self.frames.clone()
    }

    /// The newest picture, and its number.
    pub fn newest_picture(&self) -> Option<(u64, Arc<handeye::GrayImage>)> {
        self.pictures.lock().unwrap_or_else(PoisonError::into_inner).newest()
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

/// The engine's thread.
struct Runner {
    engine: Engine,
    cell: Arc<VirtualCell>,
    work: Sender<(Effect, Option<Arc<handeye::GrayImage>>)>,
    pictures: Arc<Mutex<Pictures>>,
    show: watch::Sender<Shown>,
    folder: PathBuf,
    clock: Box<dyn Fn() -> f64 + Send>,
}

impl Runner {
    fn run(mut self, inbox: &Receiver<Message>, effects: Vec<Effect>) {
        self.perform(effects);
        let mut shown = Instant::now() - SHOWN;
        loop {
            let mut urgent = false;
            match inbox.recv_timeout(SHOWN) {
                Ok(message) => urgent = self.take(message),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            while let Ok(message) = inbox.try_recv() {
                urgent |= self.take(message);
            }
            let effects = self.engine.step(Input::Clock((self.clock)())).unwrap_or_default();
            self.perform(effects);
            if urgent || shown.elapsed() >= SHOWN {
                shown = Instant::now();
                self.publish();
            }
        }
    }

    /// Whether the state is to be shown at once.
    fn take(&mut self, message: Message) -> bool {
        match message {
            Message::Input(input) => {
                let is_rare =
                    !matches!(input, Input::Robot(_) | Input::Picture(_) | Input::Clock(_));
                let effects = self.engine.step(input).unwrap_or_default();
                self.perform(effects);
                is_rare
            }
            Message::Command(command, answer) => {
                let done = self.engine.step(Input::Command(command));
                let version = done.map(|effects| {
                    self.perform(effects);
                    self.engine.version()
                });
                // whoever asked may be gone
                answer.send(version).ok();
                true
            }
        }
    }

    fn perform(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            if drive(&self.cell, &effect, (self.clock)()) {
                continue;
            }
            let picture = match &effect {
                Effect::Store { frame, .. } => {
                    self.pictures.lock().unwrap_or_else(PoisonError::into_inner).get(*frame)
                }
                _ => None,
            };
            self.work.send((effect, picture)).ok();
        }
    }

    fn publish(&self) {
        let title = self.folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let state = self.engine.view(&self.folder.display().to_string(), &title);
        let json = serde_json::to_string(&state).unwrap_or_default();
        self.show.send_replace(Shown { version: state.version, json: json.into() });
    }
}

/// The folder's thread.
fn worker(
    mut host: Host,
    back: Sender<Message>,
) -> Sender<(Effect, Option<Arc<handeye::GrayImage>>)> {
    let (work, waiting) = mpsc::channel::<(Effect, Option<Arc<handeye::GrayImage>>)>();
    thread::spawn(move || {
        let mut queue = std::collections::VecDeque::new();
        loop {
            if queue.is_empty() {
                let Ok(next) = waiting.recv() else { return };
                queue.push_back(next);
            }
            queue.extend(waiting.try_iter());
            let Some((effect, picture)) = queue.pop_front() else { continue };
            // of several assessments only the last is asked for
            let is_assess = |e: &Effect| matches!(e, Effect::Assess { .. });
            if is_assess(&effect) && queue.iter().any(|(later, _)| is_assess(later)) {
                continue;
            }
            for input in host.perform(effect, picture) {
                if back.send(Message::Input(input)).is_err() {
                    return;
                }
            }
        }
    });
    work
}

fn robot(cell: Arc<VirtualCell>, to: Sender<Message>, clock: impl Fn() -> f64 + Send + 'static) {
    thread::spawn(move || {
        while to.send(Message::Input(Input::Robot(cell.sample(clock())))).is_ok() {
            thread::sleep(POSES);
        }
    });
}

fn camera(
    cell: Arc<VirtualCell>,
    to: Sender<Message>,
    pictures: Arc<Mutex<Pictures>>,
    show_frame: watch::Sender<u64>,
    clock: impl Fn() -> f64 + Send + 'static,
) {
    let ended = AtomicBool::new(false);
    let (target, intrinsics) = (cell.settings().target, cell.settings().intrinsics);
    thread::spawn(move || {
        let mut frame = 0;
        while !ended.load(Ordering::Relaxed) {
            let begin = Instant::now();
            frame += 1;
            let time_s = clock();
            let picture = Arc::new(cell.picture(time_s, frame));
            pictures.lock().unwrap_or_else(PoisonError::into_inner).keep(frame, picture.clone());
            show_frame.send_replace(frame);
            let corners = detect::detect_with(&picture, &target, intrinsics.as_ref());
            let sample = PictureSample {
                frame,
                time_s,
                size: (picture.width() as u32, picture.height() as u32),
                corners: corners.map_err(|e| e.to_string()),
            };
            if to.send(Message::Input(Input::Picture(sample))).is_err() {
                return;
            }
            thread::sleep(PICTURES.saturating_sub(begin.elapsed()));
        }
    });
}
