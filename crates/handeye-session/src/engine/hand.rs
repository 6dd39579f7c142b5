//! Captures whose pose or image does not stream: poses typed from the pendant, images saved by another program or taken
//! when they are asked for. Nobody sees whether robot and camera stand; but a pose and an image are used once, and one that
//! is older than what the other shows is none of it.

use handeye_io::Writing;

use super::{
    Effect, Engine, Flow, Refusal,
    obey::{later, wrong},
    rest::{Motion, RobotSample, UNKNOWN_DELAY_S},
};

/// The last pose and image that a capture was made of.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Used {
    frame: Option<u64>,
    pose_s: Option<f64>,
}

impl Used {
    pub(super) fn note(&mut self, frame: u64, pose_s: f64) {
        *self = Self { frame: Some(frame), pose_s: Some(pose_s) };
    }
}

impl Engine {
    /// Whether a pose that was typed then is used already.
    pub(super) fn is_used(&self, time_s: f64) -> bool {
        self.used.pose_s == Some(time_s)
    }

    /// Whether something was made of an image already.
    pub(super) fn is_used_image(&self, frame: u64) -> bool {
        self.used.frame == Some(frame)
    }

    /// Something was made of an image, or nothing can be.
    pub(super) fn note_image(&mut self, frame: u64) {
        self.used.frame = Some(frame);
    }

    /// A touch was made of the pose of then.
    pub(super) fn note_touch(&mut self, time_s: f64) {
        self.used.pose_s = Some(time_s);
    }

    /// Whether one of the two does not stream.
    pub(super) fn is_by_hand(&self) -> bool {
        [self.sources.robot, self.sources.camera].contains(&Flow::Single)
    }

    /// The number of the image that may be taken, or what is still missing.
    pub(super) fn ready_by_hand(&self) -> Result<u64, String> {
        let robot_since = self.robot_since()?;
        let image = self.images.back();
        match self.sources.camera {
            Flow::Stream => {
                let since = match &self.rest.image {
                    Motion::Stands(since) => *since,
                    Motion::Moves(why) => return Err(why.clone()),
                };
                let newest = image.ok_or("no image has come yet")?;
                match since < robot_since {
                    true => Ok(newest.frame),
                    false => {
                        Err("the image has changed since the pose was typed: type that of now"
                            .into())
                    }
                }
            }
            Flow::Single => {
                // one that is taken on demand is taken at the pose
                let is_own = |time_s: f64| !self.sources.takes_images || time_s > robot_since;
                let newest = image
                    .filter(|p| Some(p.frame) != self.used.frame && is_own(p.time_s))
                    .ok_or("waiting for the image of this pose")?;
                // of a file nobody knows how long it was on its way
                let on_its_way = if self.sources.takes_images { 0.0 } else { UNKNOWN_DELAY_S };
                let taken = newest.time_s - on_its_way;
                let is_old = self.sources.robot == Flow::Stream && taken < robot_since;
                match &newest.corners {
                    _ if is_old => {
                        Err("the image is of before the standstill: take another one".into())
                    }
                    Ok(_) => Ok(newest.frame),
                    Err(why) => Err(format!("the board is not found: {why}")),
                }
            }
        }
    }

    /// Since when the robot is where a capture may be taken.
    fn robot_since(&self) -> Result<f64, String> {
        match (self.sources.robot, &self.rest.robot) {
            (Flow::Stream, Motion::Stands(since)) => Ok(*since),
            (Flow::Stream, Motion::Moves(why)) => Err(why.clone()),
            (Flow::Single, _) => {
                self.typed_at().ok_or_else(|| "type the pose that the pendant shows".into())
            }
        }
    }

    /// When the pose was typed that no capture was made of yet.
    fn typed_at(&self) -> Option<f64> {
        let typed = self.robot.back()?.time_s;
        (self.used.pose_s != Some(typed)).then_some(typed)
    }

    /// Why an image that has come is of no use.
    pub(super) fn unseen_by_hand(&mut self) -> Option<String> {
        let newest = self.images.back().filter(|p| Some(p.frame) != self.used.frame)?;
        let is_before = self.robot_since().is_ok_and(|since| newest.time_s <= since);
        if self.sources.camera == Flow::Stream || (self.sources.takes_images && is_before) {
            return None;
        }
        let why = newest.corners.as_ref().err()?;
        let why = format!("the board is not found: {why}");
        // the pose stays: another image of it may come
        self.used.frame = Some(newest.frame);
        Some(why)
    }

    /// Asks for the image, where that can be asked for and the robot stands.
    pub(super) fn grab(&mut self) -> Vec<Effect> {
        if self.grabbing || !self.sources.takes_images || self.robot_since().is_err() {
            return vec![];
        }
        self.grabbing = true;
        vec![Effect::Grab]
    }

    /// Until poses are read again, nobody knows how a new one would be.
    pub(super) fn not_rereading(&self) -> Result<(), Refusal> {
        match self.rereading {
            true => Err(later("the poses are being read again: in a moment".into())),
            false => Ok(()),
        }
    }

    /// A pose that was typed.
    pub(super) fn typed(&mut self, text: &str) -> Result<Vec<Effect>, Refusal> {
        if self.sources.robot == Flow::Stream {
            return Err(later("poses come from the robot in this session, none are typed".into()));
        }
        let writing = Writing::of(&self.folder.settings.notation).map_err(wrong)?;
        self.not_rereading()?;
        let typed = writing.typed_numbers(text).map_err(wrong)?;
        let base_from_flange = writing.pose(&typed).map_err(wrong)?;
        // each has a time of its own
        let last = self.robot.back().map_or(f64::NEG_INFINITY, |s| s.time_s);
        let time_s = self.now.max(last + 1e-6);
        Ok(self.robot_at(RobotSample { time_s, base_from_flange, typed, joints: vec![] }))
    }
}
