//! Poses of robot and target as JSON: pairs, motions, or two streams.

use std::{collections::HashSet, path::Path};

use handeye::{
    Base, Calibration, Camera, Config, Flange, Frame, Mount, Observation, Pose, RelativeMotion,
    Session, Setup, Stamped, Streams, Target, calibrate, estimate::KnownNoise,
    model::relative::START, solve::FEWEST_POSES,
};
use serde::{
    Deserialize, Deserializer,
    de::{self, DeserializeOwned},
};
use serde_json::Value;

use crate::{
    calibrate::run_id,
    error::{Error, in_json, unusable},
    files, parallel,
};

/// What was measured.
#[derive(Debug, Clone, PartialEq)]
pub enum MeasuredPoses {
    /// Both at the same moments; motions become such pairs.
    Pairs(Box<Session>),
    /// Each by its own clock.
    Streams(Streams),
}

/// The whole file.
#[derive(Debug, Clone, PartialEq)]
pub struct PosesFile {
    /// Its poses.
    pub measured: MeasuredPoses,
    /// What it says of the robot's noise.
    pub noise: KnownNoise,
}

impl PosesFile {
    /// Calibrates from its poses; what it says of noise comes before `config`.
    ///
    /// # Errors
    /// As [`calibrate()`].
    pub fn calibrate(&self, config: &Config) -> Result<Calibration, handeye::Error> {
        let (known, threads) = (self.noise.or(config.known), parallel::or_all(config.threads));
        let config = Config { known, threads, ..config.clone() };
        let calibration = match &self.measured {
            MeasuredPoses::Streams(streams) => calibrate(&streams.session(), &config),
            MeasuredPoses::Pairs(session) => calibrate(session, &config),
        }?;
        let id = run_id(&format!("{self:?}"), &calibration);
        Ok(calibration.of_run(id))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    setup: Setup,
    pairs: Option<Vec<Pair>>,
    motions: Option<Vec<MotionEntry>>,
    distance_m: Option<f64>,
    robot: Option<Vec<RobotSample>>,
    camera: Option<Vec<CameraSample>>,
    #[serde(default)]
    unknown_scale: bool,
    #[serde(default)]
    noise: Noise,
}

#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `base_from_flange`, `camera_from_target` and perhaps `id`"
)]
struct Pair {
    #[serde(default)]
    id: Option<String>,
    #[serde(deserialize_with = "of_robot")]
    base_from_flange: Pose<Base, Flange>,
    #[serde(deserialize_with = "of_target")]
    camera_from_target: Pose<Camera, Target>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `A`, `B` and perhaps `id`")]
struct MotionEntry {
    #[serde(default)]
    id: Option<String>,
    #[serde(rename = "A", deserialize_with = "of_mount")]
    mount: Pose<Mount, Mount>,
    #[serde(rename = "B", deserialize_with = "of_camera")]
    camera: Pose<Camera, Camera>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `time_s` and `base_from_flange`")]
struct RobotSample {
    time_s: f64,
    #[serde(deserialize_with = "of_robot")]
    base_from_flange: Pose<Base, Flange>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `time_s` and `camera_from_target`")]
struct CameraSample {
    time_s: f64,
    #[serde(deserialize_with = "of_target")]
    camera_from_target: Pose<Camera, Target>,
}

/// Targets whose distances are known up to one factor may be so many times farther than others.
const MOST_SCALE: f64 = 1e6;

fn of_robot<'de, D: Deserializer<'de>>(d: D) -> Result<Pose<Base, Flange>, D::Error> {
    within(d, 1.0, "robot")
}

fn of_target<'de, D: Deserializer<'de>>(d: D) -> Result<Pose<Camera, Target>, D::Error> {
    within(d, MOST_SCALE, "camera")
}

fn of_mount<'de, D: Deserializer<'de>>(d: D) -> Result<Pose<Mount, Mount>, D::Error> {
    within(d, 1.0, "robot")
}

fn of_camera<'de, D: Deserializer<'de>>(d: D) -> Result<Pose<Camera, Camera>, D::Error> {
    within(d, 1.0, "camera")
}

/// A pose that is not beyond any robot or camera.
fn within<'de, D: Deserializer<'de>, A: Frame, B: Frame>(
    d: D,
    scale: f64,
    whose: &str,
) -> Result<Pose<A, B>, D::Error> {
    let pose = Pose::<A, B>::deserialize(d)?;
    if !pose.farther(1.0 / scale).is_too_far() {
        return Ok(pose);
    }
    Err(de::Error::custom(format!(
        "{}_from_{} lies {:.1e} m away, beyond any {whose}: correct the number, or leave it out",
        A::NAME,
        B::NAME,
        pose.translation().amax()
    )))
}

#[derive(Deserialize, Default, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct Noise {
    robot_rotation_deg: Option<f64>,
    robot_position_mm: Option<f64>,
}

/// Reads the file.
///
/// # Errors
/// Files that cannot be read or used, with the line and the pair or sample.
pub fn read_poses(path: &Path) -> Result<PosesFile, Error> {
    let text = files::text(path)?;
    poses_from_json(text.strip_prefix('\u{feff}').unwrap_or(&text), path) // a byte order mark
}

/// The same of its text; errors call it by this name.
///
/// # Errors
/// As [`read_poses`].
pub fn poses_from_json(text: &str, path: &Path) -> Result<PosesFile, Error> {
    let document: Document = serde_json::from_str(text).map_err(|e| broken(path, text, &e))?;
    let noise = noise(document.noise, path)?;
    let (unknown_scale, setup) = (document.unknown_scale, document.setup);
    if let Some(session) = session_of_motions(&document, path)? {
        return Ok(PosesFile { measured: MeasuredPoses::Pairs(Box::new(session)), noise });
    }
    let measured = match (document.pairs, document.robot, document.camera) {
        (Some(pairs), None, None) if pairs.is_empty() => {
            let what = format!("`pairs` is empty: at least {FEWEST_POSES} are needed, {MORE}");
            return Err(unusable(path, what));
        }
        (Some(pairs), None, None) => {
            MeasuredPoses::Pairs(Box::new(session(setup, pairs, unknown_scale, path)?))
        }
        (None, Some(robot), Some(camera)) => {
            if let Some(empty) = empty_stream(&robot, &camera) {
                let what = format!(
                    "the stream `{empty}` is empty: record both while the robot moves and turns \
                     about two axes"
                );
                return Err(unusable(path, what));
            }
            MeasuredPoses::Streams(streams(setup, robot, camera, unknown_scale))
        }
        (None, None, None) => {
            let what = "neither `pairs`, nor `motions`, nor the streams `robot` and `camera`: give one of them; \
                        `handeye solve --help` shows both";
            return Err(unusable(path, what));
        }
        (Some(_), ..) => {
            let what = "`pairs` and streams: give `pairs` for poses of the same moments, or `robot` \
                        and `camera` for poses by two clocks, not both";
            return Err(unusable(path, what));
        }
        (None, robot, _) => {
            let missing = if robot.is_some() { "camera" } else { "robot" };
            return Err(unusable(
                path,
                format!("the stream `{missing}` is missing beside the other"),
            ));
        }
    };
    Ok(PosesFile { measured, noise })
}

/// What to take beyond the fewest.
const MORE: &str = "better 10 to 15, the board tilted by 30 degrees and more about two axes";

fn empty_stream(robot: &[RobotSample], camera: &[CameraSample]) -> Option<&'static str> {
    match (robot.is_empty(), camera.is_empty()) {
        (true, _) => Some("robot"),
        (_, true) => Some("camera"),
        _ => None,
    }
}

fn noise(noise: Noise, path: &Path) -> Result<KnownNoise, Error> {
    for (key, value) in [
        ("robot_rotation_deg", noise.robot_rotation_deg),
        ("robot_position_mm", noise.robot_position_mm),
    ] {
        if value.is_some_and(|v| !(v > 0.0)) {
            let what = format!("noise.{key} must be positive; leave it out where it is not known");
            return Err(unusable(path, what));
        }
    }
    Ok(KnownNoise {
        robot_rotation_rad: noise.robot_rotation_deg.map(f64::to_radians),
        robot_position_m: noise.robot_position_mm.map(|mm| mm * 1e-3),
        touch_m: None,
        tip_m: None,
    })
}

/// The failure of a file, with the pair or sample that it comes from.
fn broken(path: &Path, text: &str, error: &serde_json::Error) -> Error {
    let Ok(whole) = serde_json::from_str::<Value>(text) else {
        return match in_json(path, error, "") {
            Error::Json { place, what } => {
                Error::Json { place, what: format!("{what}: {}", advice(error)) }
            }
            other => other,
        };
    };
    if !whole.is_object() {
        return unusable(path, NO_OBJECT);
    }
    let Some(element) = broken_element(&whole, error) else {
        return in_json(path, error, "");
    };
    let named = element.id.as_ref().map_or(String::new(), |id| format!(" ({id})"));
    let called = format!("{} {}", element.kind, element.number);
    let capture = element.id.map_or(element.number.to_string(), |id| id.replace('"', ""));
    in_json(path, error, &format!("{called}{named}: ")).in_capture(&capture)
}

/// What is wrong with a file that holds a list, a number or the like.
const NO_OBJECT: &str = "the file must hold one JSON object, with `setup` and either `pairs`, or `motions`, or \
                         `robot` and `camera`; `handeye solve --help` shows both";

/// What to do about text that is no JSON.
fn advice(error: &serde_json::Error) -> &'static str {
    if error.is_eof() {
        "the file ends too early: was it written to the end?"
    } else {
        "JSON knows no NaN, no comments and no comma before a closing bracket"
    }
}

/// A pair or sample that is not what it should be.
struct Element {
    kind: &'static str,
    number: usize,
    id: Option<String>,
}

/// The pair or sample that an error of the whole file comes from.
fn broken_element(whole: &Value, error: &serde_json::Error) -> Option<Element> {
    fn of<T: DeserializeOwned>(value: &Value) -> Option<String> {
        T::deserialize(value).err().map(|e| e.to_string())
    }
    type Own = fn(&Value) -> Option<String>;
    let lists: [(&str, &'static str, Own); 4] = [
        ("motions", "motion", of::<MotionEntry>),
        ("pairs", "pair", of::<Pair>),
        ("robot", "robot sample", of::<RobotSample>),
        ("camera", "camera sample", of::<CameraSample>),
    ];
    lists.into_iter().find_map(|(key, kind, own)| {
        let list = whole.get(key)?.as_array()?;
        let (k, message) = list.iter().enumerate().find_map(|(k, v)| Some((k, own(v)?)))?;
        let id = match list[k].get("id").and_then(Value::as_str) {
            Some(id) => Some(format!("{id:?}")),
            None => list[k].get("time_s").map(|t| format!("time_s {t}")),
        };
        error.to_string().starts_with(&message).then_some(Element { kind, number: k + 1, id })
    })
}

/// The session of a file's motions; `None` where it has none.
fn session_of_motions(document: &Document, path: &Path) -> Result<Option<Session>, Error> {
    let Some(motions) = &document.motions else {
        if document.distance_m.is_some() {
            let what = "`distance_m` goes with `motions`: of pairs the target is where it was seen";
            return Err(unusable(path, what));
        }
        return Ok(None);
    };
    let has_others =
        document.pairs.is_some() || document.robot.is_some() || document.camera.is_some();
    if has_others || document.unknown_scale {
        let what = "`motions` stand alone, without `pairs`, streams and `unknown_scale`";
        return Err(unusable(path, what));
    }
    let motions = motions.iter().enumerate().map(|(k, motion)| RelativeMotion {
        id: motion.id.clone().unwrap_or_else(|| (k + 1).to_string()),
        mount_motion: motion.mount,
        camera_motion: motion.camera,
    });
    of_motions(document.setup, motions.collect(), document.distance_m, path).map(Some)
}

/// The session of motions, in a file that names them.
pub(crate) fn of_motions(
    setup: Setup,
    motions: Vec<RelativeMotion>,
    distance_m: Option<f64>,
    path: &Path,
) -> Result<Session, Error> {
    let distance_m = distance_m.unwrap_or(RelativeMotion::DISTANCE_M);
    if !(distance_m.is_finite() && distance_m > 0.0) {
        return Err(unusable(
            path,
            "`distance_m` must be positive: how far in front of the camera the work is",
        ));
    }
    let mut seen = HashSet::from([START]);
    for (k, motion) in motions.iter().enumerate() {
        if !seen.insert(&motion.id) {
            let what = match motion.id == START {
                true => format!(
                    "motion {}: the id {START:?} is that of the pose from which all begin",
                    k + 1
                ),
                false => format!("motion {}: the id {:?} is there twice", k + 1, motion.id),
            };
            return Err(unusable(path, what).in_capture(&motion.id));
        }
    }
    Ok(Session::of_motions(setup, motions, distance_m))
}

fn session(
    setup: Setup,
    pairs: Vec<Pair>,
    unknown_scale: bool,
    path: &Path,
) -> Result<Session, Error> {
    let mut seen = HashSet::new();
    let mut observations = Vec::new();
    for (k, pair) in pairs.into_iter().enumerate() {
        let capture = pair.id.unwrap_or_else(|| (k + 1).to_string());
        if !seen.insert(capture.clone()) {
            let what = format!("pair {}: the id {capture:?} is there twice", k + 1);
            return Err(unusable(path, what).in_capture(&capture));
        }
        observations.push(Observation::bare(
            capture,
            pair.base_from_flange,
            pair.camera_from_target,
        ));
    }
    Ok(Session { unknown_scale, in_sequence: true, ..Session::of_captures(setup, observations) })
}

fn streams(
    setup: Setup,
    robot: Vec<RobotSample>,
    camera: Vec<CameraSample>,
    unknown_scale: bool,
) -> Streams {
    let robot = robot.into_iter().map(|s| Stamped { time_s: s.time_s, pose: s.base_from_flange });
    let camera =
        camera.into_iter().map(|s| Stamped { time_s: s.time_s, pose: s.camera_from_target });
    Streams { setup, robot: robot.collect(), camera: camera.collect(), unknown_scale }
}
