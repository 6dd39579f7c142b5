//! A session for programs that have camera and robot already: they hand over an image and the pose of its moment, taken while
//! both stood, and get back what that was worth.
//!
//! ```text
//! pose, image ─▶ Engine ─▶ Store, Assess ─▶ Host ─▶ Pushed (its name, or why it shows nothing), State
//! ```
//!
//! Corners that the tip of its tool touches are handed over likewise, and images of boards that are laid down for that.
//!
//! A call returns when all that it leads to is done. There are no threads, and the only clock is the number of pushes: the same
//! pushes give the same bytes. The folder is that of any session; `handeye session` and a program can take turns.

mod declared;
mod touching;

use std::{collections::VecDeque, fs, path::Path, sync::Arc};

use handeye::{Base, Flange, Pose, Scan};
use handeye_io::{
    Error, RefusedCapture, ScanSettings, SessionFolder, image_size, intrinsics_from_json,
    read_image, simulated,
};

use crate::{
    engine::{
        Command, Effect, Engine, Input, Refusal, Sources, Step,
        rest::RobotSample,
        shown::{State, StepView},
    },
    host::{Finished, Host},
    sources::{
        folder,
        outlet::{CameraImage, Wanted},
    },
};
pub use declared::Declared;

/// Where the flange was in the base.
#[derive(Debug, Clone, PartialEq)]
pub enum PushedPose {
    /// As a transform.
    Known(Pose<Base, Flange>),
    /// As numbers of the session's notation, as they are typed from a pendant.
    Typed(String),
}

/// What became of an image, with or without a pose.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Pushed {
    /// A capture, or a placement, of this name.
    Taken(String),
    /// Nothing: the image does not show the board.
    Unseen(String),
}

/// Why something is not done.
#[derive(Debug, thiserror::Error)]
pub enum PushError {
    /// A folder or file cannot be used.
    #[error(transparent)]
    Folder(#[from] Error),
    /// The session refuses it; it is as it was.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

/// A session whose captures are pushed.
pub struct PushedSession {
    engine: Engine,
    host: Host,
    /// Intrinsics that do not say the size of their images.
    camera_json: Option<String>,
    /// The images' size, px; not known before the first one.
    size: Option<Size>,
    now: f64,
    frame: u64,
}

type Size = (u32, u32);

/// Between two pushes, s: so long that nothing of the one is taken for a motion to the other.
const PUSH_S: f64 = 60.0;

impl PushedSession {
    /// Begins a session in a new folder, or goes on with one.
    ///
    /// # Errors
    /// A new folder without setup and target, what is declared wrongly or of another cell, a folder that holds something
    /// else or that another session writes to.
    pub fn open(path: &Path, declared: &Declared) -> Result<Self, PushError> {
        let fresh = match SessionFolder::is_one(path) {
            true => None,
            false => Some(declared.over(&declared.cell()?, None)?),
        };
        let mut folder = SessionFolder::open(path, fresh.as_ref())?;
        let size = size_of_images(&folder);
        let settings = declared.over(folder.settings(), size)?;
        if settings != *folder.settings() {
            folder.is_of_cell(&settings)?;
            folder.set(&settings)?;
        }
        let waits = settings.intrinsics.is_none();
        let camera_json = declared.camera_json.clone().filter(|_| waits);
        let host = Host::new(folder);
        let (engine, effects) = Engine::new(host.state(), Sources::PUSHED);
        let (now, engine) = (last_time(&host), engine.declared());
        let mut session = Self { engine, host, camera_json, size, now, frame: 0 };
        session.perform(effects, None)?;
        Ok(session)
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.host.path()
    }

    /// What is known now.
    pub fn state(&self) -> State {
        let title = self.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.engine.view(&self.path().display().to_string(), &title)
    }

    /// Takes a capture, stores it and assesses all.
    ///
    /// # Errors
    /// A pose or an image that cannot be, an image that is not of its pose, a scan with some captures only, a folder that
    /// cannot be written.
    pub fn push(&mut self, pose: PushedPose, image: CameraImage) -> Result<Pushed, PushError> {
        let size = size_of(&image);
        self.know_size(size)?;
        self.pairs(image.scan.is_some())?;
        let (now, frame) = (self.now + PUSH_S, self.frame + 1);
        let mut engine = self.at(Step::Capture)?;
        engine.step(Input::Clock(now))?;
        engine.step(there(pose, now))?;
        let found = Wanted::of(engine.settings()).found_in(&image.grey, frame, now);
        engine.step(Input::Image(found))?;
        can_be(&engine, &[Step::Camera, Step::Robot])?;
        let effects = engine.step(Input::Command(Command::Take))?;
        (self.engine, self.now, self.frame) = (engine, now, frame);
        let outcome = self.perform(effects, Some(image))?.outcome()?;
        if let Pushed::Taken(_) = outcome {
            // until then nobody knows whether the image is one of this camera
            (self.size, self.camera_json) = (Some(size), None);
        }
        Ok(outcome)
    }

    /// Takes a capture out, or a placement with its touches.
    ///
    /// # Errors
    /// A name that none has; a folder that cannot be written.
    pub fn delete(&mut self, id: &str) -> Result<(), PushError> {
        self.obey(Command::Delete { id: id.into() })
    }

    /// Takes a deleted one in again; a touch likewise.
    ///
    /// # Errors
    /// As [`PushedSession::delete`].
    pub fn restore(&mut self, id: &str) -> Result<(), PushError> {
        self.obey(Command::Restore { id: id.into() })
    }

    /// Takes a capture out, and proposes its view as the next one.
    ///
    /// # Errors
    /// As [`PushedSession::delete`].
    pub fn retake(&mut self, id: &str) -> Result<(), PushError> {
        self.obey(Command::Retake { id: id.into() })
    }

    /// Undoes the last capture, placement, touch, deletion or restoring since the session was opened.
    ///
    /// # Errors
    /// Nothing to undo; a folder that cannot be written.
    pub fn undo(&mut self) -> Result<(), PushError> {
        self.obey(Command::Undo)
    }

    /// Proposes another view, not near this one.
    ///
    /// # Errors
    /// No view to skip.
    pub fn skip(&mut self) -> Result<(), PushError> {
        self.obey(Command::Skip { why: String::new() })
    }

    /// Writes the result, the same bytes as `handeye calibrate` does.
    ///
    /// # Errors
    /// No captures, a newest one that does not fit to the others, a folder that cannot be written.
    pub fn finish(&mut self) -> Result<Finished, PushError> {
        self.engine.step(Input::Command(Command::Finish))?;
        let finished = self.host.finish();
        let written = finished.as_ref().map(|f| f.written.clone()).map_err(Error::to_string);
        self.engine.step(Input::Written(written))?;
        Ok(finished?)
    }

    fn obey(&mut self, command: Command) -> Result<(), PushError> {
        let mut engine = self.at(Step::Capture)?;
        let effects = engine.step(Input::Command(command))?;
        self.engine = engine;
        self.perform(effects, None).map(|_| ())
    }

    /// The engine at a step, to try something: what it refuses has not happened.
    fn at(&self, step: Step) -> Result<Engine, Refusal> {
        let mut engine = self.engine.clone();
        engine.step(Input::Command(Command::Go { step }))?;
        Ok(engine)
    }

    /// Images have one size; intrinsics that did not say it are complete with the first one.
    fn know_size(&mut self, size: Size) -> Result<(), PushError> {
        if let Some(text) = &self.camera_json {
            let intrinsics = Some(intrinsics_from_json(text, Some(size))?);
            self.obey(Command::Camera { intrinsics })?;
        }
        self.has_size(size)
    }

    /// Whether an image has the size of those before it; for a camera that is given the engine says that.
    fn has_size(&self, size: Size) -> Result<(), PushError> {
        let is_given = self.engine.settings().intrinsics.is_some();
        match self.size.filter(|before| !is_given && *before != size) {
            None => Ok(()),
            Some((width, height)) => Err(refused(format!(
                "the image has {} x {} pixels, those before it have {width} x {height}",
                size.0, size.1
            ))),
        }
    }

    /// A dataset pairs images and scans: every capture has a scan, or none has. One that is half there would not be used.
    fn pairs(&self, has_scan: bool) -> Result<(), PushError> {
        // deleted ones may come back
        let with_scans = self.host.has_scans();
        if has_scan && self.engine.settings().scans.is_some_and(|own| own != ScanSettings::METRES) {
            return Err(refused(
                "the scans of this folder are not in metres: `handeye session` goes on with it, or begin in a new folder".into(),
            ));
        }
        match (with_scans, has_scan) {
            (Some(true), false) => Err(refused(
                "the captures before it have a scan each, and this one has none".into(),
            )),
            (Some(false), true) => {
                Err(refused("the captures before it have no scans, and this one has one".into()))
            }
            _ => Ok(()),
        }
    }

    fn perform(
        &mut self,
        effects: Vec<Effect>,
        mut image: Option<CameraImage>,
    ) -> Result<Done, PushError> {
        let mut done = Done::default();
        let mut waiting = VecDeque::from(effects);
        while let Some(effect) = waiting.pop_front() {
            let own = match &effect {
                Effect::Store { .. } | Effect::StorePlacement { .. } => image.take(),
                Effect::Refuse(refused) => {
                    done.refused = Some(refused.clone());
                    None
                }
                _ => None,
            };
            for input in self.host.perform(effect, own) {
                done.note(&input);
                waiting.extend(self.engine.step(input)?);
            }
        }
        match done.failed.take() {
            Some(why) => Err(refused(why)),
            None => Ok(done),
        }
    }
}

/// What a call led to.
#[derive(Default)]
struct Done {
    taken: Option<String>,
    refused: Option<RefusedCapture>,
    failed: Option<String>,
}

impl Done {
    fn note(&mut self, input: &Input) {
        match input {
            Input::Stored(Ok(id)) | Input::Touched(Ok(id)) => self.taken = Some(id.clone()),
            Input::Stored(Err(why)) | Input::Touched(Err(why)) | Input::Failed(why) => {
                self.failed = Some(why.clone());
            }
            _ => {}
        }
    }

    fn outcome(self) -> Result<Pushed, PushError> {
        match (self.taken, self.refused) {
            (Some(id), _) => Ok(Pushed::Taken(id)),
            // where nobody need go again, the board was not found
            (None, Some(RefusedCapture { why, base_from_flange: Some(_), .. })) => {
                Ok(Pushed::Unseen(why))
            }
            (None, Some(RefusedCapture { why, .. })) => Err(refused(why)),
            (None, None) => Err(refused("no capture was taken".into())),
        }
    }
}

/// A pose as it comes to the engine.
fn there(pose: PushedPose, now: f64) -> Input {
    match pose {
        PushedPose::Known(base_from_flange) => {
            let (typed, joints) = (vec![], vec![]);
            Input::Robot(RobotSample { time_s: now, base_from_flange, typed, joints })
        }
        PushedPose::Typed(text) => Input::Command(Command::Pose { text }),
    }
}

/// An image in a file, which is stored as it is.
///
/// # Errors
/// A file that cannot be read, or is no image.
pub fn image_in(path: &Path) -> Result<CameraImage, Error> {
    let grey = Arc::new(read_image(path, None)?);
    let bytes = || fs::read(path).map_err(|source| Error::Read { path: path.into(), source });
    let file = match folder::ending(path) {
        Some(ending) => Some((ending, bytes()?.into())),
        // of a kind that a session's folder does not hold
        None => None,
    };
    Ok(CameraImage { grey, file, scan: None })
}

/// The image with a scan that was taken with it.
pub fn with_scan(image: CameraImage, scan: &Scan) -> CameraImage {
    CameraImage { scan: Some(("ply".into(), simulated::cloud(scan).into())), ..image }
}

/// The size of the images that a folder holds.
fn size_of_images(folder: &SessionFolder) -> Option<Size> {
    let given = folder.settings().intrinsics.map(|camera| (camera.width, camera.height));
    let first = || {
        let captures = folder.captures();
        let name = captures.iter().find_map(|capture| capture.image.as_ref())?;
        image_size(&folder.path().join(name)).ok()
    };
    match folder.captures().is_empty() && folder.deleted().is_empty() {
        true => None,
        false => given.or_else(first),
    }
}

fn size_of(image: &CameraImage) -> Size {
    (image.grey.width() as u32, image.grey.height() as u32)
}

/// The time of the last thing that happened, s.
fn last_time(host: &Host) -> f64 {
    let state = host.state();
    let captures = state.captures.iter().filter_map(|capture| capture.robot_time_s);
    captures.chain(state.refused.iter().map(|refused| refused.time_s)).fold(0.0, f64::max)
}

/// Refuses a camera or a robot, those of the steps, that cannot be that of the cell.
fn can_be(engine: &Engine, which: &[Step]) -> Result<(), PushError> {
    let steps = engine.view("", "").steps;
    let is_wrong = |step: &&StepView| which.contains(&step.name) && !step.proven;
    match steps.iter().find(is_wrong).and_then(|step| step.proof.clone()) {
        Some(why) => Err(refused(why)),
        None => Ok(()),
    }
}

fn refused(message: String) -> PushError {
    PushError::Refused(Refusal { message, later: false })
}
