//! Do robot and image stand, and is the image newer than the standstill?
//!
//! A capture taken in motion, or with an image of a moment before, is wrong by millimetres and looks right. Speed is judged
//! by what is *proven*: over a window of samples a line is fitted, and the speed that its slope may have at three standard
//! deviations must be below a limit,
//!
//! ```text
//! |v| + 3 σ_v < limit,      σ_v = σ √12 / (T √n)
//! ```
//!
//! with σ found from the samples themselves. So noise makes the answer later, never wrong. Of images the same is asked for
//! the affine motion of the target's corners, in which the noise of single corners averages out.
//!
//! An image arrives later than it was taken, by a delay that nobody states. It is found from approaches: the image stands
//! so much later than the robot. Until one is known a capture waits longer than any delay that occurs.

use handeye::{Base, Flange, ImageCorner, Pose};
use nalgebra::{Matrix3, Vector2, Vector3};

/// The robot, at a moment.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotSample {
    /// When, s, by the session's clock.
    pub time_s: f64,
    /// Where the flange is.
    pub base_from_flange: Pose<Base, Flange>,
    /// The numbers from which that was read, where they were typed.
    pub typed: Vec<f64>,
    /// Its joint values (rad, m), where it gives those.
    pub joints: Vec<f64>,
}

/// An image, and what it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageSample {
    /// Its number.
    pub frame: u64,
    /// When it arrived, s, by the session's clock.
    pub time_s: f64,
    /// Width and height, px.
    pub size: (u32, u32),
    /// The target's corners, or why they were not found.
    pub corners: Result<Vec<ImageCorner>, String>,
}

/// Whether one of the two stands.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// It stands since then, s.
    Stands(f64),
    /// It moves, or this is not known yet: a sentence.
    Moves(String),
}

/// What the samples say.
#[derive(Debug, Clone, PartialEq)]
pub struct Rest {
    /// The robot.
    pub robot: Motion,
    /// The image.
    pub image: Motion,
    /// The number of the image that may be taken, or why none may be.
    pub ready: Result<u64, String>,
}

/// Since when robot and image are where they are, s: longer than samples are kept. A camera that repeats an old image
/// stands, too.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// The robot.
    pub robot: Option<f64>,
    /// The robot, small motions aside that no image need show.
    pub robot_far: Option<f64>,
    /// The image.
    pub image: Option<f64>,
}

impl Memory {
    /// `since` is the time of the first sample of the standstill, where samples before it were elsewhere.
    fn renew(memory: &mut Option<f64>, since: Option<f64>, first: f64) -> f64 {
        let since = since.or(*memory).unwrap_or(first);
        *memory = Some(since);
        since
    }
}

/// Largest speed that is a standstill: what is left of it in a tenth of a second is a hundredth of a millimetre.
const SLOW_M_S: f64 = 0.1e-3;
/// Largest rate of rotation likewise.
const SLOW_RAD_S: f64 = 0.01 * std::f64::consts::PI / 180.0;
/// Largest speed of corners in the image, px/s.
const SLOW_PX_S: f64 = 0.25;
/// Windows over which the robot's speed is judged, the shortest first, s.
const ROBOT_WINDOWS: [f64; 4] = [0.3, 0.6, 1.2, 2.4];
/// Windows over which the image's speed is judged, s.
const IMAGE_WINDOWS: [f64; 4] = [0.45, 0.9, 1.8, 3.6];
/// Standard deviations within which a speed must be slow.
const SURE: f64 = 3.0;
/// Fewer samples prove nothing.
const FEWEST: usize = 3;
/// The robot's own numbers are never known better, m.
const LEAST_M: f64 = 1e-6;
/// Likewise, rad.
const LEAST_RAD: f64 = 1e-6;
/// Corners are never known better, px.
const LEAST_PX: f64 = 0.005;
/// A place is another one beyond so many standard deviations.
const ELSEWHERE: f64 = 6.0;
/// Samples older than this are of no use: robot or camera have fallen silent, s.
const SILENT_S: f64 = 2.0;
/// While the delay of the images is not known, robot and image stand together for so long, s: no camera is later.
pub(super) const UNKNOWN_DELAY_S: f64 = 1.5;
/// An image that stands since so much before the robot did may still be of the same approach, s.
const BEFORE_S: f64 = 0.25;
/// Motions of the robot that every image shows, m and rad.
const FAR: [f64; 2] = [1e-3, 2e-3];

/// Judges the samples of the last seconds, the oldest first. `delay_s` is how much later an image arrives than it was taken.
pub fn judge(
    (robot, images): (&[RobotSample], &[ImageSample]),
    memory: &mut Memory,
    delay_s: Option<f64>,
    now: f64,
) -> Rest {
    let (robot, image) = (robot_motion(robot, memory, now), image_motion(images, memory, now));
    let ready = ready((&robot, &image), images, memory, delay_s, now);
    Rest { robot, image, ready }
}

fn ready(
    (robot, image): (&Motion, &Motion),
    images: &[ImageSample],
    memory: &Memory,
    delay_s: Option<f64>,
    now: f64,
) -> Result<u64, String> {
    let robot_since = match robot {
        Motion::Stands(since) => *since,
        Motion::Moves(why) => return Err(why.clone()),
    };
    let image_since = match image {
        Motion::Stands(since) => *since,
        Motion::Moves(why) => return Err(why.clone()),
    };
    let newest = images.last().ok_or("no image has come yet")?;
    let interval = typical_interval(images);
    let far_since = memory.robot_far.unwrap_or(robot_since);
    if image_since < far_since - 2.0 * interval - BEFORE_S {
        return Err(format!(
            "the image has stood for {:.1} s, but the robot has moved since: it is the image of an earlier pose",
            now - image_since
        ));
    }
    let Some(delay) = delay_s else {
        let since = robot_since.max(image_since);
        return match now - since > UNKNOWN_DELAY_S {
            true => Ok(newest.frame),
            false => Err(format!(
                "waiting {UNKNOWN_DELAY_S} s: how late the images are is not known yet ({:.1} s)",
                now - since
            )),
        };
    };
    match newest.time_s - delay > robot_since {
        true => Ok(newest.frame),
        false => Err(format!(
            "the newest image is {:.1} s old: it may be of before the standstill",
            now - newest.time_s + delay
        )),
    }
}

/// How much later the image stood than the robot, after a motion that both have seen; an upper bound.
pub fn delay(rest: &Rest, robot: &[RobotSample], images: &[ImageSample]) -> Option<f64> {
    let (Motion::Stands(robot_since), Motion::Stands(image_since)) = (&rest.robot, &rest.image)
    else {
        return None;
    };
    // both have moved before: the standstill begins within what was seen
    let seen =
        robot.first()?.time_s < robot_since - 0.1 && images.first()?.time_s < image_since - 0.1;
    let late = image_since - robot_since;
    (seen && late > -typical_interval(images)).then(|| late.max(0.0))
}

fn robot_motion(samples: &[RobotSample], memory: &mut Memory, now: f64) -> Motion {
    let Some(last) = samples.last() else {
        return Motion::Moves("the robot has not sent a pose yet".into());
    };
    if now - last.time_s > SILENT_S {
        return Motion::Moves(format!("no pose of the robot for {:.0} s", now - last.time_s));
    }
    let there = last.base_from_flange;
    let offset = |s: &RobotSample| {
        let off = there.inverse() * s.base_from_flange;
        let turned = off.iso().rotation.scaled_axis();
        (s.time_s, [off.translation(), turned])
    };
    let offsets: Vec<(f64, [Vector3<f64>; 2])> = samples.iter().map(offset).collect();
    let first = offsets[0].0;
    Memory::renew(&mut memory.robot_far, since(&offsets, FAR), first);
    let limits = [(SLOW_M_S, LEAST_M), (SLOW_RAD_S, LEAST_RAD)];
    // how fast it is now: by the shortest window that proves a motion
    let mut moves = None;
    for window in ROBOT_WINDOWS {
        let from = offsets.partition_point(|(t, _)| *t < last.time_s - window);
        let inside = &offsets[from..];
        // a window that is filled: of slower streams it is a longer one
        if inside.len() < FEWEST || inside[0].0 > last.time_s - 0.6 * window {
            continue;
        }
        let speeds = [0, 1].map(|k| {
            let points: Vec<(f64, Vector3<f64>)> = inside.iter().map(|(t, o)| (*t, o[k])).collect();
            Line::through(&points, limits[k].1)
        });
        if (0..2).all(|k| speeds[k].speed + SURE * speeds[k].sigma < limits[k].0) {
            let slow = [SLOW_M_S, SLOW_RAD_S].map(|speed| speed * ROBOT_WINDOWS[0]);
            let near = [0, 1].map(|k: usize| (ELSEWHERE * speeds[k].scatter).max(slow[k]));
            return Motion::Stands(Memory::renew(&mut memory.robot, since(&offsets, near), first));
        }
        moves = moves.or_else(|| faster(&speeds));
    }
    Motion::Moves(moves.unwrap_or_else(|| "the robot has just stopped".into()))
}

/// In a sentence, how fast the robot moves, where that is proven.
fn faster([position, rotation]: &[Line; 2]) -> Option<String> {
    if position.speed > SURE * position.sigma && position.speed > SLOW_M_S {
        Some(format!("the robot still moves {:.1} mm/s", position.speed * 1e3))
    } else if rotation.speed > SURE * rotation.sigma && rotation.speed > SLOW_RAD_S {
        Some(format!("the robot still rotates {:.2} degrees/s", rotation.speed.to_degrees()))
    } else {
        None
    }
}

/// The time of the first of the last samples that are near the last one; `None` where all are.
fn since(offsets: &[(f64, [Vector3<f64>; 2])], near: [f64; 2]) -> Option<f64> {
    let elsewhere = |o: &[Vector3<f64>; 2]| (0..2).any(|k| o[k].norm() > near[k]);
    let last = offsets.iter().rposition(|(_, o)| elsewhere(o))?;
    offsets.get(last + 1).map(|(time, _)| *time)
}

/// A line through samples over time.
#[derive(Clone, Copy)]
struct Line {
    /// Length of its slope.
    speed: f64,
    /// Standard deviation of the slope, along one axis.
    sigma: f64,
    /// Scatter about it, along one axis.
    scatter: f64,
}

impl Line {
    fn through(points: &[(f64, Vector3<f64>)], least: f64) -> Self {
        let n = points.len() as f64;
        let middle = points.iter().map(|(t, _)| t).sum::<f64>() / n;
        let mean = points.iter().map(|(_, p)| p).sum::<Vector3<f64>>() / n;
        let spread: f64 = points.iter().map(|(t, _)| (t - middle).powi(2)).sum();
        let slope =
            points.iter().map(|(t, p)| (p - mean) * (t - middle)).sum::<Vector3<f64>>() / spread;
        let rest = |(t, p): &(f64, Vector3<f64>)| (p - mean - slope * (t - middle)).norm_squared();
        let freedom = (3.0 * (n - 2.0)).max(1.0);
        let scatter = (points.iter().map(rest).sum::<f64>() / freedom).sqrt().max(least);
        Self { speed: slope.norm(), sigma: scatter / spread.sqrt(), scatter }
    }
}

fn image_motion(images: &[ImageSample], memory: &mut Memory, now: f64) -> Motion {
    let Some(last) = images.last() else {
        return Motion::Moves("no image has come yet".into());
    };
    if now - last.time_s > SILENT_S {
        return Motion::Moves(format!("no image for {:.0} s", now - last.time_s));
    }
    let corners = match &last.corners {
        Ok(corners) => Sorted::new(corners),
        Err(why) => return Motion::Moves(format!("the board is not found: {why}")),
    };
    // how far the corners were from where they are
    let shift = |p: &ImageSample| {
        p.corners.as_ref().ok().and_then(|before| Shift::between(before, &corners))
    };
    let shifts: Vec<(f64, Option<Shift>)> = images.iter().map(|p| (p.time_s, shift(p))).collect();
    let mut moves: Option<String> = None;
    for window in IMAGE_WINDOWS {
        let from = shifts.partition_point(|(t, _)| *t < last.time_s - window);
        let inside = &shifts[from..];
        if inside.len() < FEWEST || inside[0].0 > last.time_s - 0.6 * window {
            continue;
        }
        let all: Option<Vec<(f64, Shift)>> =
            inside.iter().map(|(t, s)| Some((*t, (*s)?))).collect();
        let Some(all) = all else {
            moves.get_or_insert_with(|| "the board was not found a moment ago".into());
            continue;
        };
        let is_slow = |(t, shift): &(f64, Shift)| {
            let allowed = SLOW_PX_S * (last.time_s - t);
            last.time_s - t < 0.6 * window || shift.length + SURE * shift.sigma < allowed
        };
        let (first, farthest) = all[0];
        if all.iter().all(is_slow) {
            let since = image_since(&shifts);
            return Motion::Stands(Memory::renew(&mut memory.image, since, shifts[0].0));
        }
        let speed = farthest.length / (last.time_s - first).max(1e-3);
        if speed > SLOW_PX_S && farthest.length > SURE * farthest.sigma {
            moves.get_or_insert_with(|| format!("the image still moves {speed:.1} px/s"));
        }
    }
    Motion::Moves(moves.unwrap_or_else(|| "the image has just come to rest".into()))
}

/// The time of the first of the last images that show the target where it is; `None` where all do.
fn image_since(shifts: &[(f64, Option<Shift>)]) -> Option<f64> {
    let slow = SLOW_PX_S * IMAGE_WINDOWS[0];
    let near = |s: &Option<Shift>| s.is_some_and(|s| s.length < (ELSEWHERE * s.sigma).max(slow));
    let last = shifts.iter().rposition(|(_, s)| !near(s))?;
    shifts.get(last + 1).map(|(time, _)| *time)
}

/// How far the target has moved in the image between two lists of its corners, px; `None` where they share too few.
pub fn moved(before: &[ImageCorner], after: &[ImageCorner]) -> Option<f64> {
    Shift::between(before, &Sorted::new(after)).map(|shift| shift.length)
}

/// Corners by their ids.
struct Sorted(Vec<ImageCorner>);

impl Sorted {
    fn new(corners: &[ImageCorner]) -> Self {
        let mut sorted = corners.to_vec();
        sorted.sort_by_key(|corner| corner.id);
        Self(sorted)
    }

    fn find(&self, id: u32) -> Option<&ImageCorner> {
        self.0.binary_search_by_key(&id, |corner| corner.id).ok().map(|k| &self.0[k])
    }
}

/// Where a corner is, and how far from there it was.
type Moved = (Vector2<f64>, Vector2<f64>);

/// How far the target has moved in the image between two images, as an affine motion of its corners.
#[derive(Clone, Copy)]
struct Shift {
    /// Root mean square over the corners, px.
    length: f64,
    /// Its standard deviation, px.
    sigma: f64,
}

impl Shift {
    /// `None` where too few corners are in both.
    fn between(before: &[ImageCorner], after: &Sorted) -> Option<Self> {
        let pair = |b: &ImageCorner| {
            let a = after.find(b.id)?;
            Some((a.pixel, b.pixel - a.pixel))
        };
        let pairs: Vec<Moved> = before.iter().filter_map(pair).collect();
        if pairs.len() < 4 {
            return None;
        }
        let n = pairs.len() as f64;
        let middle = pairs.iter().map(|(at, _)| at).sum::<Vector2<f64>>() / n;
        let row = |at: &Vector2<f64>| {
            Vector3::new(1.0, (at.x - middle.x) / 100.0, (at.y - middle.y) / 100.0)
        };
        let normal =
            pairs.iter().map(|(at, _)| row(at) * row(at).transpose()).sum::<Matrix3<f64>>();
        let inverse = normal.try_inverse()?;
        let motion =
            |k: usize| inverse * pairs.iter().map(|(at, by)| row(at) * by[k]).sum::<Vector3<f64>>();
        let (x, y) = (motion(0), motion(1));
        let moved = |at: &Vector2<f64>| Vector2::new(row(at).dot(&x), row(at).dot(&y));
        let square = |f: &dyn Fn(&Moved) -> f64| pairs.iter().map(f).sum::<f64>();
        let length = (square(&|(at, _)| moved(at).norm_squared()) / n).sqrt();
        // of few corners the scatter says little: they are no better than what is stated of them
        let stated = |c: &ImageCorner| c.covariance.trace() / 2.0;
        let mean = |all: &[ImageCorner]| all.iter().map(stated).sum::<f64>() / all.len() as f64;
        let freedom = (2.0 * n - 6.0).max(1.0);
        let scatter = square(&|(at, by)| (by - moved(at)).norm_squared()) / freedom;
        let scatter = scatter.max(mean(before) + mean(&after.0)).sqrt();
        // six numbers are fitted to 2n
        Some(Self { length, sigma: scatter.max(LEAST_PX) * (6.0 / n).sqrt() })
    }
}

/// Typical time between two images, s.
fn typical_interval(images: &[ImageSample]) -> f64 {
    let mut gaps: Vec<f64> = images.windows(2).map(|two| two[1].time_s - two[0].time_s).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(gaps.len() / 2).copied().unwrap_or(0.0)
}
