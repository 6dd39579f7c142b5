//! From a bag to a dataset: images, scans and robot poses as files, and the manifest that describes them.

use std::{
    ffi::OsString,
    fs, io,
    path::{Path, PathBuf},
};

use handeye::{Setup, TargetModel};
use serde::Serialize;

use super::{
    Tick,
    moments::{self, Moment},
    robot::{Robot, RobotSource},
    survey::{self, Shot, Stamps, Survey},
    topics::{self, Asked, Chosen},
    writing,
};
use crate::{
    MANIFEST, Targets,
    error::{Error, unusable},
    files,
    robot::Urdf,
};

/// Whether the robot stood still for its images.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Motion {
    /// Still where it stood still at six places and more.
    #[default]
    Auto,
    /// It stood still: one image of each place.
    Still,
    /// It moved: many images, and the robot's poses over time.
    Moving,
}

/// What of a bag becomes a dataset, and what the bag does not say.
#[derive(Debug, Clone)]
pub struct BagOptions {
    /// Who carries the camera.
    pub setup: Option<Setup>,
    /// What the camera sees.
    pub target: Option<Targets>,
    /// The topic of the images; may be left out where there is one only.
    pub image: Option<String>,
    /// The topic of depth images or clouds, likewise.
    pub depth: Option<String>,
    /// The topic of the camera's intrinsics; that beside the images unless said.
    pub camera: Option<String>,
    /// Where the robot's poses come from.
    pub robot: RobotSource,
    /// The model of the arm; the bag's own unless said.
    pub urdf: Option<PathBuf>,
    /// Whether it stood still.
    pub motion: Motion,
    /// Most images of a robot in motion.
    pub most: usize,
    /// Which times count.
    pub stamps: Stamps,
}

/// What became of a bag.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Extracted {
    /// How many captures there are.
    pub captures: usize,
    /// Whether the robot moved in them.
    pub moving: bool,
    /// What was done, and what is worth knowing.
    pub notes: Vec<String>,
    /// What the manifest does not say, and somebody must add.
    pub questions: Vec<String>,
}

/// Places at which the robot must have stood still for the images to be taken there.
const FEWEST_PLACES: usize = 6;
/// Farthest in time (s) a scan may be from the image of a robot that moves, and of one that was still for each of them.
const BESIDE_MOVING_S: f64 = 1e-3;
const BESIDE_TRIGGERED_S: f64 = 0.5;
/// Scans that nobody asked for are not used where more captures than this share would be lost for lack of one.
const MOST_WITHOUT_SCAN: f64 = 0.2;

/// Writes a dataset into a new folder.
///
/// # Errors
/// A bag that cannot be read or lacks what is asked for; a folder that is there and not empty.
pub fn extract(
    bag: &Path,
    out: &Path,
    options: &BagOptions,
    tick: &Tick,
) -> Result<Extracted, Error> {
    if fs::read_dir(out).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(unusable(out, "is there already: name a new folder, or remove it"));
    }
    let survey = survey::survey(bag, options.stamps, tick)?;
    let plan = Plan::new(&survey, bag, options)?;
    let aside = Aside::new(out);
    let extracted = writing::write(plan, &aside.folder, tick)?;
    aside.take_its_place(out).map_err(|source| Error::Write { path: out.into(), source })?;
    Ok(extracted)
}

/// A folder beside the one that is wanted, or in it where it is there and empty, until all is written; whatever
/// happens, it does not stay.
struct Aside {
    folder: PathBuf,
}

impl Aside {
    fn new(out: &Path) -> Self {
        let part = format!("{}.part", files::process());
        let name = out.file_name().unwrap_or_default().to_string_lossy();
        let folder = match out.is_dir() {
            true => out.join(format!(".{part}")),
            false => out.with_file_name(format!(".{name}.{part}")),
        };
        Self { folder }
    }

    /// The manifest comes last: without it nothing is complete.
    fn take_its_place(&self, out: &Path) -> io::Result<()> {
        if !out.is_dir() {
            return fs::rename(&self.folder, out);
        }
        let entries = fs::read_dir(&self.folder)?.collect::<io::Result<Vec<_>>>()?;
        let mut names: Vec<OsString> = entries.into_iter().map(|e| e.file_name()).collect();
        names.sort_by_key(|name| name == MANIFEST);
        names.iter().try_for_each(|name| fs::rename(self.folder.join(name), out.join(name)))
    }
}

impl Drop for Aside {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.folder).ok();
    }
}

/// What is to be written.
pub(super) struct Plan<'a> {
    pub(super) bag: &'a Path,
    pub(super) survey: &'a Survey,
    pub(super) options: &'a BagOptions,
    pub(super) chosen: Chosen,
    pub(super) robot: Robot,
    pub(super) moving: bool,
    pub(super) captures: Vec<Capture>,
    pub(super) notes: Vec<String>,
}

/// An image, or a scan alone, and where the robot was.
pub(super) struct Capture {
    pub(super) name: String,
    pub(super) moment: Moment,
    /// The scan, where scans are used.
    pub(super) scan: Option<Shot>,
}

impl<'a> Plan<'a> {
    fn new(survey: &'a Survey, bag: &'a Path, options: &'a BagOptions) -> Result<Self, Error> {
        let asked = Asked {
            image: options.image.as_deref(),
            scan: options.depth.as_deref(),
            camera: options.camera.as_deref(),
        };
        let mut chosen = topics::choose(survey, &asked, bag)?;
        let urdf = urdf(survey, bag, options)?;
        let robot = Robot::of(survey, &options.robot, urdf, bag)?;
        let mut notes = std::mem::take(&mut chosen.notes);
        notes.extend(survey.broken.iter().cloned());
        notes.extend(robot.notes());
        for topic in &survey.unstamped {
            notes.push(format!("{topic} has messages without a time; that of recording is taken"));
        }
        let mut plan =
            Plan { bag, survey, options, chosen, robot, moving: false, captures: vec![], notes };
        plan.take_moments()?;
        plan.take_scans()?;
        if let (None, Some(Targets::One(target, _))) = (&plan.chosen.image, &options.target)
            && !matches!(target, TargetModel::Sphere { .. })
        {
            plan.notes.push("there are no images, and of scans alone only a ball can be found (kind = \"sphere\")".into());
        }
        Ok(plan)
    }

    /// The topic that leads: of images, or else of scans.
    fn leading(&self) -> &str {
        self.chosen.image.as_ref().or(self.chosen.scan.as_ref()).map_or("", String::as_str)
    }

    fn take_moments(&mut self) -> Result<(), Error> {
        let mut shots = self.survey.shots.get(self.leading()).cloned().unwrap_or_default();
        shots.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        if !self.robot.moves() {
            let source = &self.options.robot;
            let what = format!(
                "never moves by {source}: these are other frames than those of the arm, or it stood still throughout"
            );
            return Err(unusable(self.bag, what));
        }
        let sparse = self.robot.is_sparse();
        let found = if sparse && self.options.motion == Motion::Still {
            self.notes.push("the robot's poses come too seldom to see that it stood still: that is taken from --motion still, and of each image the nearest pose".into());
            moments::triggered(&shots, &self.robot)
        } else {
            self.interpolated(&shots, sparse)?
        };
        let numbered = found.into_iter().enumerate();
        let capture = |(k, moment)| Capture { name: format!("{:04}", k + 1), moment, scan: None };
        self.captures = numbered.map(capture).collect();
        Ok(())
    }

    /// The moments at which the robot's pose can be interpolated.
    fn interpolated(&mut self, shots: &[Shot], sparse: bool) -> Result<Vec<Moment>, Error> {
        if sparse {
            let what = "has poses of the robot too seldom to interpolate between them, less than two a second: record ten \
                        a second or more; where it stood still at every image: --motion still";
            return Err(unusable(self.bag, what));
        }
        let known = shots.iter().filter(|s| self.robot.at(s.time_s).is_some()).count();
        if known == 0 {
            return Err(unusable(self.bag, self.never_together(shots)));
        }
        if known < shots.len() {
            let text = "images were taken where the robot's pose is not known (before, after, or in a gap)";
            self.notes.push(format!("{} of {} {text}", shots.len() - known, shots.len()));
        }
        let still = moments::still(shots, &self.robot);
        let (places, few) = (still.len(), still.len() < FEWEST_PLACES);
        self.moving = match self.options.motion {
            Motion::Auto => few,
            Motion::Still => false,
            Motion::Moving => true,
        };
        if !self.moving && still.is_empty() {
            let what = "has no image at which the robot stood still; for images of a moving robot: --motion moving";
            return Err(unusable(self.bag, what));
        }
        if !self.moving {
            self.notes.push(format!(
                "the robot stood still at {places} places; of each the middle image is taken"
            ));
            return Ok(still);
        }
        if places > 0 && self.options.motion == Motion::Auto {
            self.notes.push(format!(
                "it stood still at {places} places only, fewer than {FEWEST_PLACES}: these alone with --motion still"
            ));
        }
        let found = moments::moving(shots, &self.robot, self.options.most);
        self.notes.push(format!(
            "the robot moved: {} of {} images are taken, and the time offset of the clocks is estimated",
            found.len(),
            shots.len()
        ));
        Ok(found)
    }

    fn never_together(&self, shots: &[Shot]) -> String {
        let range = |mut times: Vec<f64>| {
            times.sort_by(f64::total_cmp);
            match times[..] {
                [] => "never".to_owned(),
                [first, .., last] => format!("from {first:.3} to {last:.3} s"),
                [one] => format!("at {one:.3} s"),
            }
        };
        format!(
            "tells the robot's pose at no image: images are stamped {}, the robot {}, counted from {:.3} s. Were they \
             recorded together? Where the camera stamps by a clock of its own: --stamps recorded{}",
            range(shots.iter().map(|s| s.time_s).collect()),
            range(self.robot.times()),
            self.survey.epoch_s(),
            self.robot.notes().into_iter().map(|note| format!("; {note}")).collect::<String>()
        )
    }

    /// The scan of each capture; captures without one go, where scans are used.
    fn take_scans(&mut self) -> Result<(), Error> {
        let Some(topic) = &self.chosen.scan else { return Ok(()) };
        if self.chosen.image.is_none() {
            self.captures.iter_mut().for_each(|c| c.scan = Some(c.moment.shot));
            return Ok(());
        }
        let shots = self.survey.shots.get(topic).cloned().unwrap_or_default();
        for capture in &mut self.captures {
            let taken = capture.moment.shot.time_s;
            capture.scan = if self.moving || self.robot.is_sparse() {
                let limit = if self.moving { BESIDE_MOVING_S } else { BESIDE_TRIGGERED_S };
                let away = |s: &Shot| (s.time_s - taken).abs();
                let near = shots.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b)));
                near.filter(|s| away(s) <= limit)
            } else {
                moments::scan_beside(&capture.moment, &shots, &self.robot)
            };
        }
        let all = self.captures.len();
        let with = self.captures.iter().filter(|c| c.scan.is_some()).count();
        let few =
            self.options.depth.is_none() && all - with > (MOST_WITHOUT_SCAN * all as f64) as usize;
        if with == 0 || few {
            let which =
                if self.moving { "taken with" } else { "taken while the robot stood still for" };
            self.notes.push(format!(
                "{topic} is not used: only {with} of {all} images have a scan {which} them (--depth {topic} takes these alone)"
            ));
            self.captures.iter_mut().for_each(|c| c.scan = None);
            self.chosen.scan = None;
        } else if with < all {
            self.notes
                .push(format!("{} captures have no scan beside them and are left out", all - with));
            self.captures.retain(|c| c.scan.is_some());
        }
        Ok(())
    }
}

/// The model of the arm: the user's, or the one that the bag itself holds.
fn urdf(survey: &Survey, bag: &Path, options: &BagOptions) -> Result<Option<Urdf>, Error> {
    let RobotSource::Joints { base, flange, .. } = &options.robot else { return Ok(None) };
    match (&options.urdf, &survey.robot_description) {
        (Some(path), _) => Urdf::read(path, base, flange).map(Some),
        (None, Some(text)) => Urdf::parse(text, bag, base, flange).map(Some),
        (None, None) => Ok(None),
    }
}
