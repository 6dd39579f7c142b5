//! What a bag holds: its topics, everything about the robot and the cameras, and when images were taken.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
    sync::Arc,
};

use nalgebra::Isometry3;
use serde::Serialize;

use super::{
    Message, Tick,
    messages::{self, CameraInfo, Header, JointState, Transform},
    read,
    wire::{Broken, Wire},
};
use crate::error::Error;

/// Which time of a message counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Stamps {
    /// That of its header: when it was measured.
    #[default]
    Header,
    /// That of the bag: when it was recorded.
    Recorded,
}

/// A topic of a bag.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Topic {
    /// Its type, as `sensor_msgs/Image`.
    #[serde(rename = "type")]
    pub kind: String,
    /// How many messages it has.
    pub messages: usize,
    /// The frame of the first one.
    pub frame: Option<String>,
    /// Size and encoding of the first image or cloud.
    pub shape: Option<String>,
}

/// An image, a depth image or a cloud: the how manieth of its topic, and when it was taken (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shot {
    pub(super) index: usize,
    pub(super) time_s: f64,
}

/// Transforms of one frame in another over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Edge {
    /// Whether the topic says that it never changes.
    pub(super) fixed: bool,
    /// Where it is told.
    pub(super) topics: BTreeSet<String>,
    pub(super) samples: Vec<(f64, Isometry3<f64>)>,
}

/// All of a bag but its images.
#[derive(Debug, Clone, Default)]
pub(crate) struct Survey {
    pub(super) topics: BTreeMap<String, Topic>,
    /// By child, then by parent.
    pub(super) edges: BTreeMap<String, BTreeMap<String, Edge>>,
    pub(super) joints: BTreeMap<String, Vec<(f64, JointState)>>,
    pub(super) poses: BTreeMap<String, Vec<(f64, Isometry3<f64>)>>,
    pub(super) cameras: BTreeMap<String, CameraInfo>,
    pub(super) shots: BTreeMap<String, Vec<Shot>>,
    pub(super) robot_description: Option<String>,
    /// Where the bag ends too early or is broken.
    pub(super) broken: Vec<String>,
    /// Topics with messages without a time of their own.
    pub(super) unstamped: Vec<String>,
    stamps: Stamps,
    /// What times count from, ns.
    epoch: Option<i64>,
}

/// What a bag holds, for people.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BagContents {
    /// By name.
    pub topics: BTreeMap<String, Topic>,
    /// The frames of the transforms, as a tree of indented lines.
    pub frames: Vec<String>,
    /// Names of the joints whose values it holds, by topic.
    pub joints: BTreeMap<String, Vec<String>>,
    /// Whether it holds a model of the robot.
    pub has_robot_description: bool,
    /// Where it ends too early or is broken.
    pub broken: Vec<String>,
}

/// Reads what a bag holds.
///
/// # Errors
/// What is no bag.
pub fn contents(path: &Path, tick: &Tick) -> Result<BagContents, Error> {
    let found = survey(path, Stamps::Header, tick)?;
    let names = |(topic, all): (&String, &Vec<(f64, JointState)>)| {
        let names = all.iter().flat_map(|(_, state)| state.names.iter().cloned());
        (topic.clone(), names.collect::<BTreeSet<_>>().into_iter().collect())
    };
    Ok(BagContents {
        frames: found.tree(),
        joints: found.joints.iter().map(names).collect(),
        has_robot_description: found.robot_description.is_some(),
        topics: found.topics,
        broken: found.broken,
    })
}

/// What images and clouds are.
pub(super) const IMAGE: &str = "sensor_msgs/Image";
pub(super) const COMPRESSED: &str = "sensor_msgs/CompressedImage";
pub(super) const CLOUD: &str = "sensor_msgs/PointCloud2";

/// Reads a bag, but no image of it.
pub(crate) fn survey(path: &Path, stamps: Stamps, tick: &Tick) -> Result<Survey, Error> {
    let mut found = Survey { stamps, ..Survey::default() };
    let mut unreadable: BTreeMap<String, (usize, Broken)> = BTreeMap::new();
    let broken = read(path, tick, &mut |message| {
        if let Err(what) = found.take(message) {
            unreadable.entry(message.topic.into()).or_insert((0, what)).0 += 1;
        }
        Ok(())
    })?;
    found.broken = broken;
    let each = unreadable.into_iter();
    found.broken.extend(each.map(|(topic, (n, what))| {
        format!("{n} messages of {topic} cannot be read, or not all of them: one {what}")
    }));
    Ok(found)
}

impl Survey {
    fn take(&mut self, message: &Message) -> Result<(), Broken> {
        let topic = self.topics.entry(message.topic.into()).or_insert_with(|| Topic {
            kind: message.kind.into(),
            messages: 0,
            frame: None,
            shape: None,
        });
        topic.messages += 1;
        let index = topic.messages - 1;
        let mut wire = Wire::new(message.bytes, message.encoding)?;
        match message.kind {
            "tf2_msgs/TFMessage" | "tf/tfMessage" => self.transforms(message, &mut wire)?,
            "sensor_msgs/JointState" => {
                let (header, names, positions) = messages::joint_state(&mut wire)?;
                let time = self.time(message, &header);
                let all = self.joints.entry(message.topic.into()).or_default();
                // the names are the same in every message, mostly
                let names = match all.last() {
                    Some((_, last)) if *last.names == names => Arc::clone(&last.names),
                    _ => Arc::new(names),
                };
                all.push((time, JointState { names, positions }));
            }
            "geometry_msgs/PoseStamped"
            | "geometry_msgs/PoseWithCovarianceStamped"
            | "geometry_msgs/TransformStamped"
            | "nav_msgs/Odometry" => {
                let has_child = !message.kind.contains("Pose");
                let pose = messages::pose_stamped(&mut wire, has_child)?;
                let time = self.time(message, &pose.header);
                self.note(message.topic, &pose.header, String::new);
                self.poses.entry(message.topic.into()).or_default().push((time, pose.pose));
            }
            "sensor_msgs/CameraInfo" => {
                let info = messages::camera_info(&mut wire)?;
                self.cameras.entry(message.topic.into()).or_insert(info);
            }
            "std_msgs/String" if message.topic.ends_with("robot_description") => {
                self.robot_description = Some(messages::text(&mut wire)?);
            }
            IMAGE | COMPRESSED | CLOUD => self.shot(message, index, &mut wire)?,
            _ => {}
        }
        Ok(())
    }

    fn shot(&mut self, message: &Message, index: usize, wire: &mut Wire) -> Result<(), Broken> {
        let (header, shape) = match message.kind {
            IMAGE => {
                let i = messages::image(wire)?;
                (i.header, format!("{} x {}, {}", i.width, i.height, i.encoding))
            }
            COMPRESSED => {
                let i = messages::compressed_image(wire)?;
                (i.header, i.format)
            }
            _ => {
                let c = messages::point_cloud(wire)?;
                (c.header, format!("{} x {} points", c.width, c.height))
            }
        };
        let time_s = self.time(message, &header);
        self.note(message.topic, &header, || shape);
        self.shots.entry(message.topic.into()).or_default().push(Shot { index, time_s });
        Ok(())
    }

    fn transforms(&mut self, message: &Message, wire: &mut Wire) -> Result<(), Broken> {
        let fixed = message.topic.ends_with("tf_static");
        let mut broken = Ok(());
        for transform in messages::transforms(wire)? {
            let Transform { header, child, parent_from_child } = match transform {
                Ok(transform) => transform,
                Err(what) => {
                    broken = Err(what); // the others of the message hold
                    continue;
                }
            };
            let time = if fixed { 0.0 } else { self.time(message, &header) };
            let edge = self.edges.entry(child).or_default().entry(header.frame).or_default();
            edge.fixed |= fixed;
            if !edge.topics.contains(message.topic) {
                edge.topics.insert(message.topic.into());
            }
            edge.samples.push((time, parent_from_child));
        }
        broken
    }

    /// When it was, after the first time of the bag (s).
    fn time(&mut self, message: &Message, header: &Header) -> f64 {
        let bare = header.stamp == 0;
        if bare && !self.unstamped.iter().any(|t| t == message.topic) {
            self.unstamped.push(message.topic.into());
        }
        let time =
            if bare || self.stamps == Stamps::Recorded { message.recorded } else { header.stamp };
        let epoch = *self.epoch.get_or_insert(time);
        // exact: a clock's nanoseconds do not fit into a number, their differences do
        time.saturating_sub(epoch) as f64 * 1e-9
    }

    fn note(&mut self, topic: &str, header: &Header, shape: impl FnOnce() -> String) {
        let Some(topic) = self.topics.get_mut(topic).filter(|t| t.frame.is_none()) else { return };
        topic.frame = Some(header.frame.clone());
        topic.shape = Some(shape()).filter(|s| !s.is_empty());
    }

    /// What the first time of the bag is, s.
    pub(super) fn epoch_s(&self) -> f64 {
        self.epoch.unwrap_or(0) as f64 * 1e-9
    }

    /// All frames of the transforms, as a tree of indented lines.
    fn tree(&self) -> Vec<String> {
        let parents: Vec<&String> = self.edges.values().flat_map(BTreeMap::keys).collect();
        let mut roots: Vec<&String> =
            parents.into_iter().filter(|p| !self.edges.contains_key(*p)).collect();
        roots.sort();
        roots.dedup();
        let mut lines = vec![];
        for root in roots {
            self.branch(root, 0, &mut lines);
        }
        lines
    }

    fn branch(&self, frame: &str, depth: usize, lines: &mut Vec<String>) {
        lines.push(format!("{}{frame}", "  ".repeat(depth)));
        if depth > MOST_DEPTH {
            return;
        }
        for (child, parents) in &self.edges {
            if parents.contains_key(frame) && lines.len() < MOST_LINES {
                self.branch(child, depth + 1, lines);
            }
        }
    }
}

/// A tree deeper than this turns in a circle.
const MOST_DEPTH: usize = 60;
/// More lines nobody reads.
const MOST_LINES: usize = 500;
