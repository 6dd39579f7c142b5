//! What a source has to do with the session: it hands over pictures and poses, and says what goes wrong.

use std::{
    collections::VecDeque,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
        mpsc::Sender,
    },
    time::Instant,
};

use handeye::{GrayImage, Intrinsics, TargetModel, detect};
use tokio::sync::watch;

use crate::engine::{
    Input,
    rest::{PictureSample, RobotSample},
};

/// A picture, as the camera's file has it where there is one.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Its grey values.
    pub image: Arc<GrayImage>,
    /// The file's ending and bytes: what is stored.
    pub file: Option<(String, Arc<[u8]>)>,
}

/// Pictures that may still be stored, by their numbers.
#[derive(Default)]
pub struct Pictures(VecDeque<(u64, Picture)>);

/// A capture is of one of the last pictures.
const KEPT_PICTURES: usize = 16;

impl Pictures {
    /// Keeps a picture, and forgets old ones.
    pub fn keep(&mut self, frame: u64, picture: Picture) {
        self.0.push_back((frame, picture));
        if self.0.len() > KEPT_PICTURES {
            self.0.pop_front();
        }
    }

    /// One of them.
    pub fn get(&self, frame: u64) -> Option<Picture> {
        self.0.iter().find(|(number, _)| *number == frame).map(|(_, picture)| picture.clone())
    }

    /// The newest.
    pub fn newest(&self) -> Option<(u64, Picture)> {
        self.0.back().cloned()
    }
}

/// What is looked for in pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// The board.
    pub target: TargetModel,
    /// The camera, where it is known.
    pub intrinsics: Option<Intrinsics>,
}

/// The way from a source to the session.
#[derive(Clone)]
pub struct Outlet {
    to: Sender<Input>,
    pictures: Arc<Mutex<Pictures>>,
    wanted: Arc<Mutex<Wanted>>,
    shown: watch::Sender<u64>,
    numbers: Arc<AtomicU64>,
    begin: Instant,
}

impl Outlet {
    /// Inputs go to `to`; `shown` is told the number of each picture.
    pub fn new(to: Sender<Input>, wanted: Wanted, shown: watch::Sender<u64>) -> Self {
        Self {
            to,
            pictures: Arc::default(),
            wanted: Arc::new(Mutex::new(wanted)),
            shown,
            numbers: Arc::default(),
            begin: Instant::now(),
        }
    }

    /// The session's clock, s: one that nobody sets.
    pub fn now(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    /// Pictures that may still be stored.
    pub fn pictures(&self) -> MutexGuard<'_, Pictures> {
        self.pictures.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is looked for now.
    pub fn wanted(&self) -> Wanted {
        self.wanted.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Something else is looked for from now on.
    pub fn want(&self, wanted: Wanted) {
        *self.wanted.lock().unwrap_or_else(PoisonError::into_inner) = wanted;
    }

    /// Hands over a pose; whether anybody still listens.
    pub fn robot(&self, sample: RobotSample) -> bool {
        self.input(Input::Robot(sample))
    }

    /// Hands over a picture that has come at this time, with the corners that are found in it.
    pub fn picture(&self, picture: Picture, time_s: f64) -> bool {
        let frame = self.numbers.fetch_add(1, Ordering::Relaxed) + 1;
        self.pictures().keep(frame, picture.clone());
        self.shown.send_replace(frame);
        self.look(frame, &picture, time_s)
    }

    /// Looks at the newest picture again, for what is wanted now.
    pub fn look_again(&self, time_s: f64) -> bool {
        let newest = self.pictures().newest();
        newest.is_none_or(|(frame, picture)| self.look(frame, &picture, time_s))
    }

    fn look(&self, frame: u64, picture: &Picture, time_s: f64) -> bool {
        let Wanted { target, intrinsics } = self.wanted();
        let image = &picture.image;
        let corners = detect::detect_with(image, &target, intrinsics.as_ref());
        self.input(Input::Picture(PictureSample {
            frame,
            time_s,
            size: (image.width() as u32, image.height() as u32),
            corners: corners.map_err(|e| e.to_string()),
        }))
    }

    /// Says what goes wrong, by a fixed name and in a sentence, and what to do.
    pub fn trouble(&self, code: &str, message: String, advice: &str) -> bool {
        self.input(Input::Trouble { code: code.into(), message, advice: advice.into() })
    }

    fn input(&self, input: Input) -> bool {
        self.to.send(input).is_ok()
    }
}
