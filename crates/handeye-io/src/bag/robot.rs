//! Where the flange was at any time: by transforms, by poses, or by joint values.
//!
//! Between samples the pose is interpolated; outside of them and in gaps there is none.

use std::path::Path;

use handeye::{
    Base, Flange, Pose,
    streams::{Stamped, Stream},
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
/// Pauses longer than this many median intervals are gaps, as for poses.
const GAP: f64 = 4.0;

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
                    unusable(
                        bag,
                        format!("has no poses on {topic}; {}", listed("topics of poses", known)),
                    )
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
    pub(super) fn gaps(&self) -> Vec<String> {
        let said = |name: &str, stream: &Stream| {
            (stream.gaps() > 0).then(|| {
                let (count, limit) = (stream.gaps(), stream.limit());
                format!(
                    "{name} has {count} gaps, pauses longer than {limit:.3} s or jumps; no pose is made up within"
                )
            })
        };
        match self {
            Robot::Links(links) => {
                let one = |link: &Link| match &link.motion {
                    Motion::Moving(stream) => said(&link.name, stream),
                    Motion::Fixed(_) => None,
                };
                links.iter().filter_map(one).collect()
            }
            Robot::Poses(stream) => said("the robot's topic", stream).into_iter().collect(),
            Robot::Joints { values: JointStream { times, limit, .. }, .. } => {
                let gaps = times.windows(2).filter(|w| w[1] - w[0] > *limit).count();
                let what = format!(
                    "joint values have {gaps} gaps, pauses longer than {limit:.3} s; none are made up within"
                );
                (gaps > 0).then_some(what).into_iter().collect()
            }
        }
    }
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
    let Some(k) = down.iter().position(|frame| up.contains(frame)) else {
        let what = format!(
            "has no transforms that join {base} (part of {}) and {flange} (part of {})",
            up[up.len() - 1],
            down[down.len() - 1]
        );
        return Err(unusable(bag, what));
    };
    let j = up.iter().position(|frame| *frame == down[k]).unwrap_or(0);
    let mut all = vec![];
    for pair in up[..=j].windows(2) {
        all.push(link(survey, &pair[0], &pair[1], true, bag)?);
    }
    for pair in down[..=k].windows(2).rev() {
        all.push(link(survey, &pair[0], &pair[1], false, bag)?);
    }
    Ok(all)
}

/// A frame, its parent, and so on to the root.
fn ancestors(survey: &Survey, frame: &str, bag: &Path) -> Result<Vec<String>, Error> {
    let is_known =
        survey.edges.contains_key(frame) || survey.edges.values().any(|p| p.contains_key(frame));
    if !is_known {
        let known = || {
            survey
                .edges
                .iter()
                .flat_map(|(c, p)| std::iter::once(c).chain(p.keys()))
                .map(String::as_str)
        };
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
    let mut chain = vec![frame.to_owned()];
    while let Some(parents) = survey.edges.get(&chain[chain.len() - 1]) {
        let names: Vec<&String> = parents.keys().collect();
        if names.len() > 1 {
            let both = names.iter().map(|n| n.as_str()).collect::<Vec<_>>().join(" and ");
            let what = format!(
                "has transforms of {} in {both}: which of them holds?",
                chain[chain.len() - 1]
            );
            return Err(unusable(bag, what));
        }
        if chain.contains(names[0]) {
            return Err(unusable(
                bag,
                format!("has transforms that turn in a circle at {}", names[0]),
            ));
        }
        chain.push(names[0].clone());
    }
    Ok(chain)
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
    let first = edge.samples[0].1;
    let stays =
        |(_, pose): &(f64, Isometry3<f64>)| handeye::lie::log(&first.inv_mul(pose)).norm() < SAME;
    if edge.samples.iter().all(stays) {
        return Ok(Motion::Fixed(first));
    }
    if edge.fixed {
        return Err(unusable(bag, format!("says that {name} never changes, and gives several")));
    }
    stream(&edge.samples, name, bag).map(Motion::Moving)
}

fn stream(samples: &[(f64, Isometry3<f64>)], name: &str, bag: &Path) -> Result<Stream, Error> {
    let stamped: Vec<_> = samples.iter().map(|&(time_s, pose)| Stamped { time_s, pose }).collect();
    Stream::new(&stamped, name).map_err(|error| unusable(bag, error.to_string()))
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
    let mut samples: Vec<(f64, Vec<f64>)> = vec![];
    for (time, state) in states {
        let value = |name: &String| {
            state.positions.get(state.names.iter().position(|n| n == name)?).copied()
        };
        // grippers may share the topic with messages of their own
        if let Some(values) = urdf.joint_names().iter().map(value).collect::<Option<Vec<f64>>>() {
            samples.push((*time, values));
        }
    }
    if samples.is_empty() {
        let named =
            states.iter().flat_map(|(_, s)| &s.names).collect::<std::collections::BTreeSet<_>>();
        let what = format!(
            "{topic} has no message with all joints of the model ({}); it has {}",
            urdf.joint_names().join(", "),
            named.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ")
        );
        return Err(unusable(bag, what));
    }
    if samples.iter().any(|(_, v)| v.iter().any(|x| !x.is_finite())) {
        return Err(unusable(bag, format!("{topic} has joint values that are not finite")));
    }
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    samples.dedup_by(|a, b| a.0 == b.0);
    let (times, values): (Vec<f64>, _) = samples.into_iter().unzip();
    let limit = limit(&times);
    Ok(Robot::Joints { urdf: Box::new(urdf), values: JointStream { times, values, limit } })
}

fn limit(times: &[f64]) -> f64 {
    GAP * handeye::linalg::median(times.windows(2).map(|w| w[1] - w[0])) * (1.0 + 1e-9)
}

impl JointStream {
    /// Values at a time, by a straight line between two samples.
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
        Some(
            self.values[i]
                .iter()
                .zip(&self.values[after])
                .map(|(a, b)| a + part * (b - a))
                .collect(),
        )
    }
}
