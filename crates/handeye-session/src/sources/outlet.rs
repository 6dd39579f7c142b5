//! What a source has to do with the session: it hands over images and poses, and says what goes wrong.

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
use handeye_io::{CellSettings, ScanSettings};
use tokio::sync::watch;

use crate::engine::{
    Input, Problem,
    rest::{ImageSample, RobotSample},
};

/// An image, as the camera's file has it where there is one.
#[derive(Debug, Clone)]
pub struct CameraImage {
    /// Its grey values.
    pub grey: Arc<GrayImage>,
    /// The file's ending and bytes: what is stored.
    pub file: Option<StoredFile>,
    /// The scan that the camera took with it (m), where it takes any.
    pub scan: Option<StoredFile>,
}

/// The ending of a file's name, and its bytes.
pub type StoredFile = (String, Arc<[u8]>);

impl CameraImage {
    /// The memory that it takes.
    fn bytes(&self) -> usize {
        let grey = self.grey.width() * self.grey.height() * size_of::<f32>();
        let files = [&self.file, &self.scan].into_iter().flatten();
        grey + files.map(|(_, bytes)| bytes.len()).sum::<usize>()
    }

    /// An image that stands in memory.
    pub fn in_memory(grey: Arc<GrayImage>) -> Self {
        Self { grey, file: None, scan: None }
    }
}

/// Images that may still be stored, by their numbers.
#[derive(Default)]
pub struct RecentImages(VecDeque<(u64, CameraImage)>);

/// A capture is of one of the last images.
const KEPT_IMAGES: usize = 16;
/// Large ones take no more memory together, bytes, but for the last two.
const KEPT_BYTES: usize = 512 << 20;

impl RecentImages {
    /// Keeps an image, and forgets old ones.
    pub fn keep(&mut self, frame: u64, image: CameraImage) {
        self.0.push_back((frame, image));
        let size = |(_, image): &(u64, CameraImage)| image.bytes();
        while self.0.len() > KEPT_IMAGES
            || (self.0.len() > 2 && self.0.iter().map(size).sum::<usize>() > KEPT_BYTES)
        {
            self.0.pop_front();
        }
    }

    /// One of them.
    pub fn get(&self, frame: u64) -> Option<CameraImage> {
        self.0.iter().find(|(number, _)| *number == frame).map(|(_, image)| image.clone())
    }

    /// The newest.
    pub fn newest(&self) -> Option<(u64, CameraImage)> {
        self.0.back().cloned()
    }
}

/// What is looked for in images.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// The board.
    pub target: TargetModel,
    /// The camera, where it is known.
    pub intrinsics: Option<Intrinsics>,
    /// How the scan is read that comes with each image; `None` where none comes.
    pub scans: Option<ScanSettings>,
}

impl Wanted {
    /// What the settings of a cell say of it.
    pub fn of(settings: &CellSettings) -> Self {
        let CellSettings { target, intrinsics, scans, .. } = settings.clone();
        Self { target, intrinsics, scans }
    }

    /// What an image shows that came at this time.
    pub fn found_in(&self, image: &GrayImage, frame: u64, time_s: f64) -> ImageSample {
        let corners = detect::detect_with(image, &self.target, self.intrinsics.as_ref());
        ImageSample {
            frame,
            time_s,
            size: (image.width() as u32, image.height() as u32),
            corners: corners.map_err(|e| e.to_string()),
        }
    }
}

/// The way from a source to the session.
#[derive(Clone)]
pub struct Outlet {
    to: Sender<Input>,
    images: Arc<Mutex<RecentImages>>,
    wanted: Arc<Mutex<Wanted>>,
    shown: watch::Sender<u64>,
    numbers: Arc<AtomicU64>,
    begin: Instant,
}

impl Outlet {
    /// Inputs go to `to`; `shown` gets the number of each image.
    pub fn new(to: Sender<Input>, wanted: Wanted, shown: watch::Sender<u64>) -> Self {
        Self {
            to,
            images: Arc::default(),
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

    /// Images that may still be stored.
    pub fn images(&self) -> MutexGuard<'_, RecentImages> {
        self.images.lock().unwrap_or_else(PoisonError::into_inner)
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

    /// Hands over an image that has come at this time, with the corners that are found in it.
    pub fn image(&self, image: CameraImage, time_s: f64) -> bool {
        let frame = self.numbers.fetch_add(1, Ordering::Relaxed) + 1;
        self.images().keep(frame, image.clone());
        self.shown.send_replace(frame);
        self.look(frame, &image, time_s)
    }

    /// Looks at the newest image again, for what is wanted now.
    pub fn look_again(&self, time_s: f64) -> bool {
        let newest = self.images().newest();
        newest.is_none_or(|(frame, image)| self.look(frame, &image, time_s))
    }

    fn look(&self, frame: u64, image: &CameraImage, time_s: f64) -> bool {
        self.input(Input::Image(self.wanted().found_in(&image.grey, frame, time_s)))
    }

    /// Says what goes wrong, by a fixed name and in a sentence, and what to do.
    pub fn trouble(&self, code: &str, message: String, advice: &str) -> bool {
        self.input(Input::Trouble(Problem { code: code.into(), message, advice: advice.into() }))
    }

    /// Whether anybody still listens.
    pub fn is_heard(&self) -> bool {
        self.input(Input::Clock(self.now()))
    }

    fn input(&self, input: Input) -> bool {
        self.to.send(input).is_ok()
    }
}
