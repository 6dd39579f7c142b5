//! Where the flange was at any time: by transforms, by poses, or by joint values.
//!
//! Between samples the pose is interpolated; outside of them and in gaps there is none.

use std::path::Path;

use handeye::{
    Base, Flange, Pose, Stamped,
    calibrate::streams::{Stream, joints_between},
};
use nalgebra::Isometry3;

use super::survey::{Edge, Survey};
use crate::{
    error::{Error, nearest, unusable},
    robot::Urdf,
};

/// Where the robot's poses come from.
#[derive(Debug, Clone, PartialEq)]
pub enum RobotSource {
    /// Transforms from one frame to another.
    Frames {
        /// The robot's base.
        base: String,
        /// Its flange.
        flange: String,
    },
    /// A topic of poses of the flange in the base.
    Poses {
        /// Its name.
        topic: String,
    },
    /// Joint values and a model of the arm.
    Joints {
        /// The topic; may be left out where there is one only.
        topic: Option<String>,
        /// The model's base.
        base: String,
        /// The model's flange.
        flange: String,
    },
}

impl std::fmt::Display for RobotSource {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            RobotSource::Frames { base, flange } => {
                write!(f, "the transforms from {base} to {flange}")
            }
            RobotSource::Poses { topic } => write!(f, "the poses on {topic}"),
            RobotSource::Joints { base, flange, .. } => {
                write!(f, "joint values, the model from {base} to {flange}")
            }
        }
    }
}

/// The flange over time.
pub(super) enum Robot {
    Links(Vec<Link>),
    Poses(Stream),
    Joints { urdf: Box<Urdf>, values: JointStream },
}

/// Joint values over time.
pub(super) struct JointStream {
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    /// Pauses longer than this (s) are gaps.
    limit: f64,
    /// Messages whose values are not finite.
    left_out: usize,
}

/// One transform of a chain, or its inverse.
pub(super) struct Link {
    name: String,
    inverse: bool,
    motion: Motion,
}

enum Motion {
    Fixed(Isometry3<f64>),
    Moving(Stream),
}

/// A pose at one time, and the joint values behind it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct At {
    pub(super) base_from_flange: Pose<Base, Flange>,
    pub(super) joints: Vec<f64>,
}

/// Poses that differ less (rad, m) are the same.
const SAME: f64 = 1e-9;
/// Samples of a transform that does not change may differ by this (rad, m).
const ROUNDING: f64 = 1e-5;
/// Pauses longer than this many intervals are gaps; nineteen of twenty intervals are no longer than the one that counts,
/// which neither bursts nor two senders make short.
const GAP: f64 = 4.0;
const USUAL: f64 = 0.95;
/// Pauses longer than this (s) are gaps, however seldom samples come: a robot goes a long way in that time.
const LONGEST_PAUSE_S: f64 = 0.5;

/// Joints seldom turn farther, rad.
const MOST_TURNED_RAD: f64 = 4.0 * std::f64::consts::PI;

impl Robot {
    pub(super) fn of(
        survey: &Survey,
        source: &RobotSource,
        urdf: Option<Urdf>,
        bag: &Path,
    ) -> Result<Robot, Error> {
        match source {
            RobotSource::Frames { base, flange } => {
                links(survey, base, flange, bag).map(Robot::Links)
            }
            RobotSource::Poses { topic } => {
                let known = survey.poses.keys().map(String::as_str);
                let samples = survey.poses.get(topic).ok_or_else(|| {
                    let holds = survey.topics.get(topic).map_or(String::new(), |t| {
                        format!(
                            ", which holds {}: PoseStamped, PoseWithCovarianceStamped, TransformStamped and Odometry are read",
                            t.kind
                        )
                    });
                    let known = listed("topics of poses", known);
                    unusable(bag, format!("has no poses on {topic}{holds}; {known}"))
                })?;
                stream(samples, topic, bag).map(Robot::Poses)
            }
            RobotSource::Joints { topic, .. } => {
                let urdf = urdf.ok_or_else(|| {
                    unusable(
                        bag,
                        "holds no robot_description: give the model of the arm (--urdf FILE)",
                    )
                })?;
                joints(survey, topic.as_deref(), urdf, bag)
            }
        }
    }

    /// Where the flange was; `None` outside of what was recorded, and in gaps.
    pub(super) fn at(&self, time_s: f64) -> Option<At> {
        let bare = |iso| At { base_from_flange: Pose::claim(iso), joints: vec![] };
        match self {
            Robot::Links(links) => {
                let one = |pose: Isometry3<f64>, link: &Link| Some(pose * link.at(time_s)?);
                links.iter().try_fold(Isometry3::identity(), one).map(bare)
            }
            Robot::Poses(stream) => stream.at_time(time_s).map(bare),
            Robot::Joints { urdf, values } => {
                let joints = values.at(time_s)?;
                Some(At { base_from_flange: urdf.arm().base_from_flange(&joints), joints })
            }
        }
    }

    /// When it was measured: of a chain, the times of its fastest link.
    pub(super) fn times(&self) -> Vec<f64> {
        match self {
            Robot::Links(links) => {
                let moving = links.iter().filter_map(|link| match &link.motion {
                    Motion::Moving(stream) => Some(stream.times()),
                    Motion::Fixed(_) => None,
                });
                moving.max_by_key(Vec::len).unwrap_or_default()
            }
            Robot::Poses(stream) => stream.times(),
            Robot::Joints { values, .. } => values.times.clone(),
        }
    }

    /// The names of the joints, where there are any.
    pub(super) fn urdf(&self) -> Option<&Urdf> {
        match self {
            Robot::Joints { urdf, .. } => Some(urdf),
            _ => None,
        }
    }

    /// What is worth knowing of what was recorded.
    pub(super) fn notes(&self) -> Vec<String> {
        let said = |name: &str, stream: &Stream| {
            let (gaps, limit, others) = (stream.gaps(), stream.limit(), stream.conflicting());
            let gap = format!(
                "{name} has {gaps} gaps, pauses longer than {limit:.3} s or jumps; no pose is made up within"
            );
            let twice = format!(
                "{name} has {others} samples that contradict others of the same time; they are left out"
            );
            [(gaps > 0).then_some(gap), (others > 0).then_some(twice)].into_iter().flatten()
        };
        match self {
            Robot::Links(links) => {
                let moving = links.iter().filter_map(|link| match &link.motion {
                    Motion::Moving(stream) => Some(said(&link.name, stream)),
                    Motion::Fixed(_) => None,
                });
                moving.flatten().collect()
            }
            Robot::Poses(stream) => said("the robot's topic", stream).collect(),
            Robot::Joints { values: JointStream { times, values, limit, left_out }, .. } => {
                let largest = values.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
                let turned = format!(
                    "joint values reach {largest:.0}: are they degrees? JointState holds radians, and so they are read"
                );
                let gaps = times.windows(2).filter(|w| w[1] - w[0] > *limit).count();
                let what = format!(
                    "joint values have {gaps} gaps, pauses longer than {limit:.3} s; none are made up within"
                );
                let bad = format!(
                    "{left_out} messages with joint values that are not finite are left out"
                );
                let notes = [
                    (largest > MOST_TURNED_RAD).then_some(turned),
                    (gaps > 0).then_some(what),
                    (*left_out > 0).then_some(bad),
                ];
                notes.into_iter().flatten().collect()
            }
        }
    }

    /// Whether the flange is ever anywhere else.
    pub(super) fn moves(&self) -> bool {
        let mut poses = self.times().into_iter().filter_map(|t| self.at(t));
        let Some(first) = poses.next() else { return false };
        poses.any(|pose| {
            let apart = first.base_from_flange.iso().inv_mul(pose.base_from_flange.iso());
            handeye::math::lie::log(&apart).norm() > LEAST_MOTION
        })
    }

    /// Where the flange was at the sample nearest to a time, no farther away than half the usual interval.
    pub(super) fn nearest(&self, time_s: f64) -> Option<At> {
        let times = self.times();
        let away = |t: &f64| (t - time_s).abs();
        let near = times.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
        self.at(*near).filter(|_| away(near) <= 0.5 * usual(&times))
    }

    /// Whether samples come too seldom to interpolate between them.
    pub(super) fn is_sparse(&self) -> bool {
        usual(&self.times()) > LONGEST_PAUSE_S
    }
}

/// A robot whose flange turns or moves less than this (rad, m) stood still throughout.
const LEAST_MOTION: f64 = 1e-3;

/// An interval between samples that is longer than most, s.
fn usual(times: &[f64]) -> f64 {
    let mut all: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    all.sort_by(f64::total_cmp);
    let k = (USUAL * all.len() as f64) as usize;
    all.get(k.min(all.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

impl Link {
    fn at(&self, time_s: f64) -> Option<Isometry3<f64>> {
        let parent_from_child = match &self.motion {
            Motion::Fixed(pose) => *pose,
            Motion::Moving(stream) => stream.at_time(time_s)?,
        };
        Some(if self.inverse { parent_from_child.inverse() } else { parent_from_child })
    }
}

fn listed<'a>(what: &str, all: impl Iterator<Item = &'a str>) -> String {
    let all: Vec<&str> = all.collect();
    if all.is_empty() {
        format!("there are no {what}")
    } else {
        format!("{what}: {}", all.join(", "))
    }
}

/// The transforms that lead from the base to the flange.
fn links(survey: &Survey, base: &str, flange: &str, bag: &Path) -> Result<Vec<Link>, Error> {
    let (down, up) = (ancestors(survey, flange, bag)?, ancestors(survey, base, bag)?);
    let Some(k) = down.frames.iter().position(|frame| up.frames.contains(frame)) else {
        if let Some(what) = down.end.or(up.end) {
            return Err(unusable(bag, what));
        }
        let broken = survey.broken.iter().map(|what| format!("; {what}")).collect::<String>();
        let what = format!(
            "has no transforms that join {base} (part of {}) and {flange} (part of {}){broken}",
            up.frames[up.frames.len() - 1],
            down.frames[down.frames.len() - 1]
        );
        return Err(unusable(bag, what));
    };
    let j = up.frames.iter().position(|frame| *frame == down.frames[k]).unwrap_or(0);
    let mut all = vec![];
    for pair in up.frames[..=j].windows(2) {
        all.push(link(survey, &pair[0], &pair[1], true, bag)?);
    }
    for pair in down.frames[..=k].windows(2).rev() {
        all.push(link(survey, &pair[0], &pair[1], false, bag)?);
    }
    Ok(all)
}

/// A frame, its parent, and so on.
struct Ancestors {
    frames: Vec<String>,
    /// Why they end before the root.
    end: Option<String>,
}

fn ancestors(survey: &Survey, frame: &str, bag: &Path) -> Result<Ancestors, Error> {
    let known = || {
        let edges = survey.edges.iter();
        edges.flat_map(|(c, p)| std::iter::once(c).chain(p.keys())).map(String::as_str)
    };
    if !known().any(|name| name == frame) {
        let near =
            nearest(frame, known()).map_or(String::new(), |n| format!(" (did you mean {n}?)"));
        let mut all: Vec<&str> = known().collect();
        all.sort_unstable();
        all.dedup();
        let what = format!(
            "has no transforms of the frame {frame}{near}; {}",
            listed("frames", all.into_iter())
        );
        return Err(unusable(bag, what));
    }
    let mut frames = vec![frame.to_owned()];
    let mut end = None;
    while let Some(parents) = survey.edges.get(&frames[frames.len() - 1]) {
        let names: Vec<&str> = parents.keys().map(String::as_str).collect();
        if names.len() > 1 {
            let last = &frames[frames.len() - 1];
            end = Some(format!(
                "has transforms of {last} in {}, so that it does not tell where {last} is",
                names.join(" and ")
            ));
            break;
        }
        if frames.iter().any(|f| f == names[0]) {
            let what = format!("has transforms that turn in a circle at {}", names[0]);
            return Err(unusable(bag, what));
        }
        frames.push(names[0].to_owned());
    }
    Ok(Ancestors { frames, end })
}

fn link(
    survey: &Survey,
    child: &str,
    parent: &str,
    inverse: bool,
    bag: &Path,
) -> Result<Link, Error> {
    let name = format!("the transform from {parent} to {child}");
    let edge = &survey.edges[child][parent];
    Ok(Link { motion: motion(edge, &name, bag)?, name, inverse })
}

fn motion(edge: &Edge, name: &str, bag: &Path) -> Result<Motion, Error> {
    // the last that was said holds, where it was said once for all
    let first = if edge.fixed { edge.samples[edge.samples.len() - 1].1 } else { edge.samples[0].1 };
    let limit = if edge.fixed { ROUNDING } else { SAME };
    let stays = |(_, pose): &(f64, Isometry3<f64>)| {
        handeye::math::lie::log(&first.inv_mul(pose)).norm() < limit
    };
    if edge.samples.iter().all(stays) {
        return Ok(Motion::Fixed(first));
    }
    if edge.fixed {
        let what = format!(
            "says on tf_static that {name} never changes, and gives several: record the bag anew, or take the joint values \
             (--joints)"
        );
        return Err(unusable(bag, what));
    }
    if edge.topics.len() > 1 {
        let topics: Vec<&str> = edge.topics.iter().map(String::as_str).collect();
        let what = format!(
            "tells {name} on several topics, {}: of two robots? Copy the bag without one of them",
            topics.join(" and ")
        );
        return Err(unusable(bag, what));
    }
    stream(&edge.samples, name, bag).map(Motion::Moving)
}

fn stream(samples: &[(f64, Isometry3<f64>)], name: &str, bag: &Path) -> Result<Stream, Error> {
    let stamped: Vec<_> = samples.iter().map(|&(time_s, pose)| Stamped { time_s, pose }).collect();
    let stream = Stream::new(&stamped, name).map_err(|error| unusable(bag, error.to_string()))?;
    let limit = limit(&stream.times());
    Ok(stream.with_limit(limit))
}

fn joints(survey: &Survey, topic: Option<&str>, urdf: Urdf, bag: &Path) -> Result<Robot, Error> {
    let known = || survey.joints.keys().map(String::as_str);
    let topic = match (topic, survey.joints.len()) {
        (Some(topic), _) => topic,
        (None, 1) => known().next().unwrap_or_default(),
        (None, _) => {
            return Err(unusable(
                bag,
                format!("say which joint values (--joints TOPIC); {}", listed("topics", known())),
            ));
        }
    };
    let Some(states) = survey.joints.get(topic) else {
        return Err(unusable(
            bag,
            format!("has no joint values on {topic}; {}", listed("topics of them", known())),
        ));
    };
    let (mut samples, mut left_out): (Vec<(f64, Vec<f64>)>, usize) = (vec![], 0);
    for (time, state) in states {
        let value = |name: &String| {
            state.positions.get(state.names.iter().position(|n| n == name)?).copied()
        };
        // grippers may share the topic with messages of their own
        match urdf.joint_names().iter().map(value).collect::<Option<Vec<f64>>>() {
            Some(values) if values.iter().all(|x| x.is_finite()) => samples.push((*time, values)),
            Some(_) => left_out += 1,
            None => {}
        }
    }
    if samples.is_empty() {
        let named: std::collections::BTreeSet<_> =
            states.iter().flat_map(|(_, s)| s.names.iter()).collect();
        let what = format!(
            "{topic} has no single message with finite values of all joints of the model ({}); its messages name {}",
            urdf.joint_names().join(", "),
            named.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ")
        );
        return Err(unusable(bag, what));
    }
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    samples.dedup_by(|a, b| a.0 == b.0);
    let (times, values): (Vec<f64>, _) = samples.into_iter().unzip();
    let limit = limit(&times);
    let values = JointStream { times, values, limit, left_out };
    Ok(Robot::Joints { urdf: Box::new(urdf), values })
}

fn limit(times: &[f64]) -> f64 {
    (GAP * usual(times)).min(LONGEST_PAUSE_S) * (1.0 + 1e-9)
}

impl JointStream {
    /// Values at a time, between those of two samples.
    fn at(&self, time_s: f64) -> Option<Vec<f64>> {
        let after = self.times.partition_point(|t| *t <= time_s);
        let i = after.checked_sub(1)?;
        if self.times[i] == time_s {
            return Some(self.values[i].clone());
        }
        let step = self.times.get(after)? - self.times[i];
        if step > self.limit {
            return None;
        }
        let part = (time_s - self.times[i]) / step;
        Some(joints_between(&self.values[i], &self.values[after], part))
    }
}
