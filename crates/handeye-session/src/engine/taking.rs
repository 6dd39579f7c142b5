//! Poses and images as they come, and the capture that is waited for.

use handeye::{Base, Flange, Pose, model::residual::Residual};
use handeye_io::RefusedCapture;

use super::{
    Effect, Engine, Flow, Problem, Step,
    rest::{self, ImageSample, Motion, RobotSample},
};

/// Samples are kept for so long, s.
const KEPT_S: f64 = 12.0;
/// A capture that is waited for is refused after so long, s.
pub(super) const PATIENCE_S: f64 = 15.0;
/// A board that is not found while all stands is looked for so long, s.
pub(super) const LOOKING_S: f64 = 2.5;
/// A robot stands at another pose, rad and m.
pub(super) const ELSEWHERE: Residual = Residual { angle: 0.03, distance: 0.01 };
/// A robot that has moved is not within this of where it was, rad and m.
const THE_SAME_POSE: Residual = Residual { angle: 2e-5, distance: 2e-5 };
/// An image of the same pose is not this far from it, px.
pub(super) const ANOTHER_IMAGE_PX: f64 = 3.0;
/// Approaches from which the delay of the images is known.
const APPROACHES: usize = 5;
/// Images may be so much later than the latest approach shows, s.
const DELAY_MARGIN_S: f64 = 0.05;
/// Fewer captures do not determine where robot and camera sit.
pub(super) const KNOWN: usize = 4;
/// Images that come later than this are worth a word, s.
pub(super) const LATE_S: f64 = 0.3;

/// A capture that is waited for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wish {
    pub(super) since: f64,
    pub(super) why: String,
    asked: Asked,
    /// Whether it is the image of a board that was laid down to be touched.
    pub(super) is_placement: bool,
    /// Since when all stands, but the board is not found.
    unseen_since: Option<f64>,
}

/// Who asked for a capture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asked {
    /// A person or a program, who wants to know what becomes of it.
    Person,
    /// Nobody: captures are taken by themselves, sooner or later.
    Automatic,
}

impl Wish {
    pub(super) fn new(since: f64, asked: Asked) -> Self {
        Self { since, why: String::new(), asked, is_placement: false, unseen_since: None }
    }

    pub(super) fn of_placement(since: f64) -> Self {
        Self { is_placement: true, ..Self::new(since, Asked::Person) }
    }
}

impl Engine {
    pub(super) fn robot_at(&mut self, sample: RobotSample) -> Vec<Effect> {
        // a clock that was set back: what was seen belongs to another time
        if self.robot.back().is_some_and(|last| sample.time_s < last.time_s) {
            self.robot.clear();
            self.memory.robot = None;
            self.memory.robot_far = None;
        }
        self.now = self.now.max(sample.time_s);
        self.problem.take_if(|problem| problem.is_of_robot());
        self.follow_arm(&sample);
        self.robot.push_back(sample);
        while self.robot.len() > 1 && self.robot[0].time_s < self.now - KEPT_S {
            self.robot.pop_front();
        }
        match self.is_by_hand() {
            true => self.wait(),
            false => vec![],
        }
    }

    pub(super) fn image(&mut self, sample: ImageSample) -> Vec<Effect> {
        if self.images.back().is_some_and(|last| sample.time_s < last.time_s) {
            self.images.clear();
            self.memory.image = None;
        }
        self.now = self.now.max(sample.time_s);
        self.grabbing = false;
        // looked at again, for another board
        self.images.retain(|old| old.frame != sample.frame);
        self.images.push_back(sample);
        while self.images.len() > 1 && self.images[0].time_s < self.now - KEPT_S {
            self.images.pop_front();
        }
        self.wait()
    }

    /// Judges whether all stands, and takes the capture that is waited for.
    pub(super) fn wait(&mut self) -> Vec<Effect> {
        let delay = self.delay().map(|s| s + DELAY_MARGIN_S);
        let robot = &*self.robot.make_contiguous();
        let images = &*self.images.make_contiguous();
        self.rest = rest::judge((robot, images), &mut self.memory, delay, self.now);
        // once for each approach
        if let Motion::Stands(since) = self.rest.robot
            && self.approach_measured != Some(since)
            && let Some(late) = rest::delay(&self.rest, robot, images)
        {
            self.approach_measured = Some(since);
            self.delays.push_back(late);
            while self.delays.len() > APPROACHES {
                self.delays.pop_front();
            }
        }
        if self.is_by_hand() {
            self.rest.ready = self.ready_by_hand();
        }
        if self.automatic && self.wish.is_none() && !self.storing && self.is_elsewhere() {
            self.wish = Some(Wish::new(self.now, Asked::Automatic));
        }
        match self.wish.as_ref().is_some_and(|wish| wish.is_placement) {
            true => self.fulfil_placement(),
            false => self.fulfil(),
        }
    }

    /// How much later images come than they are taken, s: an upper bound from the last approaches.
    pub(super) fn delay(&self) -> Option<f64> {
        self.delays.iter().copied().reduce(f64::max)
    }

    /// Whether the robot is where no capture was taken, and none was refused.
    fn is_elsewhere(&self) -> bool {
        let Some(here) = self.robot.back().map(|s| s.base_from_flange) else { return false };
        let near = |pose: &Pose<Base, Flange>| Residual::between(pose, &here).is_within(ELSEWHERE);
        let taken = self.folder.captures.iter().map(|c| c.base_from_flange);
        let refused = self.folder.refused.iter().filter_map(|r| r.base_from_flange);
        self.step == Step::Capture && !taken.chain(refused).any(|pose| near(&pose))
    }

    fn fulfil(&mut self) -> Vec<Effect> {
        let by_hand = self.is_by_hand();
        let Some(wish) = &mut self.wish else { return vec![] };
        match self.rest.ready.clone() {
            Ok(frame) => {
                let (Some(robot), Some(image)) =
                    (self.robot.back(), self.images.iter().find(|p| p.frame == frame))
                else {
                    return vec![];
                };
                let (here, verifies) = (robot.base_from_flange, self.step == Step::Verify);
                let why = match (self.pose_of_another(&here, image), verifies) {
                    // a capture's pose with another image is what a view is to show
                    (Some(_), true) => None,
                    (None, true) => self.view_of_another(&here),
                    (other, false) => other,
                };
                if let Some(why) = why.or_else(|| self.pose_of_touch(&here)) {
                    return self.refuse(why, false);
                }
                let effect = Effect::Store {
                    verifies,
                    frame,
                    robot: robot.clone(),
                    image_time_s: image.time_s - self.delay().unwrap_or(0.0),
                };
                (self.wish, self.storing, self.problem) = (None, true, None);
                self.used.note(frame, robot.time_s);
                vec![effect]
            }
            Err(why) if by_hand => {
                wish.why = why;
                match self.unseen_by_hand() {
                    Some(why) => self.refuse(why, true),
                    None => self.grab(),
                }
            }
            Err(why) => {
                let stands = matches!(self.rest.robot, Motion::Stands(since) if self.now - since > LOOKING_S);
                let unseen = self.images.back().is_some_and(|p| p.corners.is_err());
                let since = match stands && unseen {
                    true => Some(*wish.unseen_since.get_or_insert(self.now)),
                    false => None,
                };
                (wish.unseen_since, wish.why) = (since, why.clone());
                let is_unseen = since.is_some_and(|since| self.now - since > LOOKING_S);
                let is_over = wish.asked == Asked::Person && self.now - wish.since > PATIENCE_S;
                match is_unseen || is_over {
                    true => self.refuse(why, is_unseen),
                    false => vec![],
                }
            }
        }
    }

    /// Where the robot says that it is where a capture was taken, and the image shows something else: why that is no capture.
    fn pose_of_another(&self, here: &Pose<Base, Flange>, image: &ImageSample) -> Option<String> {
        let assessed = self.assessed.as_ref()?;
        let of = self.folder.captures.iter().find(|c| is_same(&c.base_from_flange, here))?;
        let before = assessed.measured.iter().find(|m| m.id == of.id)?;
        let moved_px = rest::moved(&before.corners, image.corners.as_ref().ok()?)?;
        (moved_px > ANOTHER_IMAGE_PX).then(|| {
            format!(
                "the robot's pose is that of capture {}, but the image has moved by {moved_px:.0} px since: the pose was not read anew, or camera or board were moved",
                of.id
            )
        })
    }

    /// Where a pose that is handed over is that of a touch: why that is no capture.
    fn pose_of_touch(&self, here: &Pose<Base, Flange>) -> Option<String> {
        let is_handed = self.sources.robot == Flow::Single;
        let of = self.touch_at(here).filter(|_| is_handed)?;
        Some(format!(
            "the robot's pose is that of the touch {} of corner {}: it was not read anew",
            of.id, of.corner
        ))
    }

    /// Takes no capture; where the board was not found, nobody is sent there again.
    fn refuse(&mut self, why: String, is_unseen: bool) -> Vec<Effect> {
        self.wish = None;
        let is_proposed = self.next().is_some_and(|next| self.was_at(next));
        // where robot and camera sit is not known by captures yet
        let is_astray = is_unseen && is_proposed && self.folder.captures.len() < KNOWN;
        self.problem = Some(Problem {
            code: if is_astray { "board-not-where-expected" } else { "not-taken" }.into(),
            message: format!("no capture was taken: {why}"),
            advice: match (is_astray, is_unseen) {
                (true, _) => "the board was expected at this view: drive by hand until it is seen and take it, several times; from the fourth capture on it is found whether notation, unit or direction of the poses, the setup or the board are other than declared",
                (_, true) => "go to another pose from where the whole board is seen, or skip this view",
                _ => "see that the robot stands and its pose is read anew, then take it again",
            }
            .into(),
        });
        let here = self.robot.back().map(|s| s.base_from_flange);
        let base_from_flange = here.filter(|_| is_unseen);
        vec![Effect::Refuse(RefusedCapture { why, base_from_flange, time_s: self.now })]
    }
}

/// Whether the robot has not moved from one pose to the other.
pub(super) fn is_same(one: &Pose<Base, Flange>, other: &Pose<Base, Flange>) -> bool {
    Residual::between(one, other).is_within(THE_SAME_POSE)
}
