//! Corners that the tip of a tool touches: a second instrument beside the camera, and what closes directions that a robot
//! with few axes leaves open.

use std::collections::BTreeSet;

use handeye::{
    Base, Flange, Pose, calibrate::result::TouchResult, nalgebra::Vector3,
    tools::plan::spread_corners,
};
use handeye_io::StoredTouch;

use super::{
    Change, Effect, Engine, Flow, Refusal, Step,
    obey::{later, wrong},
    rest::{Motion, RobotSample},
    say::{Proof, capitalised, contradiction, proof},
    shown::{TouchShown, TouchView},
    taking::is_same,
};

/// No tip is farther from the flange, mm.
const FARTHEST_TIP_MM: f64 = 2000.0;
/// Fewer touches say nothing about one another.
const FEWEST: usize = 3;
/// A robot is seen to move within this time, s: a standstill that is found anew before may be that of before the drive. No drive
/// is shorter.
const SETTING_OFF_S: f64 = 0.3;

pub(super) const WHERE_IS_THE_TIP: &str =
    "Where is the tip of the touching tool in the flange? Enter it in millimetres.";

/// Where the tip of a tool is in the flange, mm.
///
/// # Errors
/// Where none is.
pub(crate) fn tip(in_flange_mm: [f64; 3]) -> Result<[f64; 3], Refusal> {
    let far = Vector3::from(in_flange_mm).norm();
    match far > 0.0 && far < FARTHEST_TIP_MM {
        true => Ok(in_flange_mm),
        false => Err(wrong(
            "the tip is three numbers of millimetres in the flange, not zero and not more than 2 m away",
        )),
    }
}

impl Engine {
    /// Whether corners can be touched.
    pub(super) fn may_touch(&self) -> Result<(), Refusal> {
        if self.settings().target.corners().is_empty() {
            return Err(wrong("this target has no corners that could be touched"));
        }
        match self.folder.captures.is_empty() {
            true => Err(later("first captures are taken, then corners are touched".into())),
            false => Ok(()),
        }
    }

    /// Whether a board lies where it can be touched.
    pub(super) fn may_touch_board(&self) -> Result<(), Refusal> {
        self.may_touch()?;
        match self.lays_boards() && self.newest_placement(self.touches_verify()).is_none() {
            true => Err(later(
                "the robot cannot touch the board that it carries: first lay the board into the view, and take its image (`place`)".into(),
            )),
            false => Ok(()),
        }
    }

    pub(super) fn tip(&mut self, in_flange_mm: [f64; 3]) -> Result<Vec<Effect>, Refusal> {
        self.configure(handeye_io::CellSettings {
            tip_mm: Some(tip(in_flange_mm)?),
            ..self.settings().clone()
        })
    }

    /// Whether touches that are made now verify the captures, and the answer is not made with them.
    pub(super) fn touches_verify(&self) -> bool {
        self.step == Step::Verify
    }

    /// The corner to touch next: the first of corners far from each other that was not touched.
    pub(super) fn next_corner(&self, verifies: bool) -> Option<u32> {
        self.may_touch().ok()?;
        let here = self.newest_placement(verifies).map(|p| &p.id);
        let here = self.folder.touches.iter().filter(|t| t.placement.as_ref() == here);
        let touched: BTreeSet<u32> = here.map(|t| t.corner).collect();
        let spread = spread_corners(&self.settings().target, touched.len() + 1);
        // once all were touched, from the first one again
        spread.iter().find(|corner| !touched.contains(corner)).or(spread.first()).copied()
    }

    pub(super) fn touch(&mut self, corner: Option<u32>) -> Result<Vec<Effect>, Refusal> {
        self.may_touch()?;
        self.touches_now("corners are touched in the steps `touch` and `verify`")?;
        if self.settings().tip_mm.is_none() {
            return Err(later("first say where the tool's tip is in the flange".into()));
        }
        self.may_touch_board()?;
        let verifies = self.touches_verify();
        let next = || self.next_corner(verifies);
        let corner = corner.or_else(next).ok_or_else(|| wrong("which corner?"))?;
        if self.settings().target.corner(corner).is_none() {
            return Err(wrong(format!("the board has no corner {corner}")));
        }
        self.not_rereading()?;
        if self.storing || self.assessing {
            return Err(later("what came before is still being assessed: touch then".into()));
        }
        if self.wish.is_some() {
            return Err(later("an image is waited for: touch then, or cancel that".into()));
        }
        let robot = self.touching_pose()?;
        self.note_touch(robot.time_s);
        self.tip_to = None;
        self.storing = true;
        self.forget_problem();
        let placement = self.newest_placement(verifies).map(|p| p.id.clone());
        Ok(vec![Effect::StoreTouch { corner, placement, verifies, robot }])
    }

    /// Whether corners are touched in this step.
    pub(super) fn touches_now(&self, otherwise: &str) -> Result<(), Refusal> {
        match self.step {
            Step::Touch => Ok(()),
            Step::Verify => self.may_verify(),
            _ => Err(later(otherwise.into())),
        }
    }

    /// The pose with the tip at a corner: the robot stands, and where no touch was made before.
    fn touching_pose(&self) -> Result<RobotSample, Refusal> {
        if let (Flow::Stream, Motion::Moves(why)) = (self.sources.robot, &self.rest.robot) {
            return Err(later(format!("no touch was taken: {why}")));
        }
        let typed = self.sources.robot == Flow::Single;
        let robot = self.robot.back().cloned().filter(|s| !typed || !self.is_used(s.time_s));
        let robot = robot.ok_or_else(|| {
            later("type the pose that the pendant shows with the tip at the corner".into())
        })?;
        if self.tip_to.is_some_and(|(to, _)| !self.is_tip_there(to)) {
            return Err(later("no touch was taken: the robot is on its way to the corner".into()));
        }
        let here = &robot.base_from_flange;
        let mut captures = self.folder.captures.iter().chain(&self.folder.verification);
        if let Some(of) = captures.find(|c| is_same(&c.base_from_flange, here)) {
            return Err(later(format!(
                "the robot's pose is that of capture {}: bring the tip to the corner, and read the pose anew",
                of.id
            )));
        }
        if let Some(before) = self.touch_at(here) {
            return Err(later(format!(
                "the tip is still where it touched corner {}: bring it to the next one",
                before.corner
            )));
        }
        Ok(robot)
    }

    /// The touch that was made at this pose.
    pub(super) fn touch_at(&self, here: &Pose<Base, Flange>) -> Option<&StoredTouch> {
        self.folder.touches.iter().find(|touch| is_same(&touch.base_from_flange, here))
    }

    /// Whether the tip of a virtual cell's tool was led to a corner, and stands there.
    fn is_tip_there(&self, corner: u32) -> bool {
        let since = match self.rest.robot {
            Motion::Stands(since) => since,
            Motion::Moves(_) => return false,
        };
        let has_set_off = |begun: f64| since > begun && self.now > begun + SETTING_OFF_S;
        self.tip_to.is_some_and(|(to, begun)| to == corner && has_set_off(begun))
    }

    pub(super) fn untouch(&mut self, id: String) -> Result<Vec<Effect>, Refusal> {
        match self.folder.touches.iter().any(|touch| touch.id == id) {
            true => {
                self.changes.push(Change::Untouched(id.clone()));
                Ok(vec![Effect::Untouch(id)])
            }
            false => Err(wrong(format!("there is no touch {id}"))),
        }
    }

    pub(super) fn touched(&mut self, touched: Result<String, String>) -> Vec<Effect> {
        self.storing = false;
        match touched {
            Ok(id) => self.changes.push(Change::Touched(id)),
            Err(why) => self.trouble("not-written", why),
        }
        vec![]
    }

    pub(super) fn touch_proof(&self) -> Proof {
        let count = self.folder.touches.iter().filter(|touch| !touch.verifies).count();
        match (self.touch_view(false), count) {
            (None, _) => proof(true, "corners are not touched in this cell"),
            (Some(view), 0) if view.lays && view.placement.is_none() => {
                proof(false, "no board was laid into the view to be touched; this step is optional")
            }
            (Some(_), 0) => proof(false, "no corner was touched; this step is optional"),
            (Some(view), _) => match view.rms_mm {
                Some(rms) => {
                    proof(true, format!("{count} touches, {rms:.2} mm (RMS) from the answer"))
                }
                None => proof(true, format!("{count} touches")),
            },
        }
    }

    pub(super) fn say_touch(&self) -> String {
        if let Err(why) = self.may_touch() {
            return format!("{}.", capitalised(&why.message));
        }
        let Some(view) = self.touch_view(false) else { return String::new() };
        if view.tip_mm.is_none() {
            return WHERE_IS_THE_TIP.into();
        }
        let assessed = self.assessed.as_ref().filter(|_| !self.assessing);
        if let Some(why) = assessed.and_then(|assessed| assessed.contradiction()) {
            return contradiction(why, self.folder.captures.len());
        }
        let last = view.touches.last();
        if let Some(TouchShown { corner, residual_mm: Some(mm), used: false, .. }) = last {
            return format!(
                "The touch of corner {corner} is rejected as an outlier: the tip was {mm:.1} mm from where the captures put it. Was it this corner, and did the tip slip? Delete it, and touch again."
            );
        }
        if let Some(what) = self.say_placement(view.corner) {
            return what;
        }
        let go_on = match view.touches.len() < FEWEST {
            true => "",
            false => " Or finish.",
        };
        format!("Bring the tip to corner {} of the board, and touch it.{go_on}", view.corner)
    }

    /// What is shown of touches, those that verify the captures or those that the answer is made with; `None` where none can be
    /// made.
    pub(super) fn touch_view(&self, verifies: bool) -> Option<TouchView> {
        let corner = self.next_corner(verifies)?;
        let touches = match verifies {
            true => self.verifying_touches(),
            false => self.touches_used(),
        };
        let all: Vec<f64> =
            touches.iter().filter(|t| t.used).filter_map(|t| t.residual_mm).collect();
        let mean = all.iter().map(|mm| mm * mm).sum::<f64>() / all.len() as f64;
        let rms_mm = (!all.is_empty()).then(|| mean.sqrt());
        let (columns, _) = self.settings().target.grid();
        let (tip_mm, at_corner) = (self.settings().tip_mm, self.is_tip_there(corner));
        let lays = self.lays_boards();
        Some(TouchView {
            tip_mm,
            corner,
            columns,
            lays,
            placements: self.placements_shown(verifies),
            placement: self.newest_placement(verifies).map(|p| p.id.clone()),
            lying: (self.sources.is_virtual && lays).then(|| self.lying(verifies)),
            touches,
            rms_mm,
            at_corner,
        })
    }

    /// The touches that the answer is made with.
    fn touches_used(&self) -> Vec<TouchShown> {
        let made: Vec<&StoredTouch> =
            self.folder.touches.iter().filter(|touch| !touch.verifies).collect();
        let result = self.assessed.as_ref().filter(|_| !self.assessing).map(|a| &a.calibration);
        // of a corner that was touched several times, in that order
        let of = |k: usize, t: &StoredTouch| {
            let same =
                |other: &&StoredTouch| (other.corner, &other.placement) == (t.corner, &t.placement);
            let before = made[..k].iter().copied().filter(same).count();
            let on_it = |found: &&TouchResult| {
                found.corner == t.corner && t.placement.as_ref().is_none_or(|p| *p == found.capture)
            };
            result?.touches.iter().filter(on_it).nth(before)
        };
        let shown = made.iter().enumerate().map(|(k, t)| TouchShown {
            id: t.id.clone(),
            placement: t.placement.clone(),
            corner: t.corner,
            residual_mm: of(k, t).map(|found| found.residual_mm),
            used: of(k, t).is_some_and(|found| found.used),
        });
        shown.collect()
    }
}
