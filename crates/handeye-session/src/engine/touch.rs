//! Corners that the tip of a tool touches: a second instrument beside the camera, and what closes directions that a robot
//! with few axes leaves open.

use std::collections::BTreeSet;

use handeye::{
    calibrate::result::TouchResult, model::residual::Residual, nalgebra::Vector3,
    tools::plan::spread_corners,
};
use handeye_io::StoredTouch;

use super::{
    Change, Effect, Engine, Flow, Refusal, Step,
    obey::{later, wrong},
    rest::{Motion, RobotSample},
    say::{Proof, capitalised, contradiction, proof},
    shown::{TouchShown, TouchView},
    taking::THE_SAME_POSE,
};

/// No tip is farther from the flange, mm.
const FARTHEST_TIP_MM: f64 = 2000.0;
/// Fewer touches say nothing about one another.
const FEWEST: usize = 3;
/// A robot is seen to move within this time, s: a standstill that is found anew before may be that of before the drive. No drive
/// is shorter.
const SETTING_OFF_S: f64 = 0.3;

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
        match self.lays_boards() && self.newest_placement().is_none() {
            true => Err(later(
                "the robot cannot touch the board that it carries: first lay the board into the view, and take its image (`place`)".into(),
            )),
            false => Ok(()),
        }
    }

    pub(super) fn tip(&mut self, in_flange_mm: [f64; 3]) -> Result<Vec<Effect>, Refusal> {
        let far = Vector3::from(in_flange_mm).norm();
        if !(far > 0.0 && far < FARTHEST_TIP_MM) {
            return Err(wrong(
                "the tip is three numbers of millimetres in the flange, not zero and not more than 2 m away",
            ));
        }
        self.configure(handeye_io::CellSettings {
            tip_mm: Some(in_flange_mm),
            ..self.settings().clone()
        })
    }

    /// The corner to touch next: the first of corners far from each other that was not touched.
    pub(super) fn next_corner(&self) -> Option<u32> {
        self.may_touch().ok()?;
        let here = self.newest_placement().map(|p| &p.id);
        let here = self.folder.touches.iter().filter(|t| t.placement.as_ref() == here);
        let touched: BTreeSet<u32> = here.map(|t| t.corner).collect();
        let spread = spread_corners(&self.settings().target, touched.len() + 1);
        // once all were touched, from the first one again
        spread.iter().find(|corner| !touched.contains(corner)).or(spread.first()).copied()
    }

    pub(super) fn touch(&mut self, corner: Option<u32>) -> Result<Vec<Effect>, Refusal> {
        self.may_touch()?;
        if self.step != Step::Touch {
            return Err(later("corners are touched in the step `touch`".into()));
        }
        if self.settings().tip_mm.is_none() {
            return Err(later("first say where the tool's tip is in the flange".into()));
        }
        self.may_touch_board()?;
        let corner = corner.or_else(|| self.next_corner()).ok_or_else(|| wrong("which corner?"))?;
        if self.settings().target.corner(corner).is_none() {
            return Err(wrong(format!("the board has no corner {corner}")));
        }
        self.not_rereading()?;
        if self.storing || self.assessing {
            return Err(later("what came before is still being assessed: touch then".into()));
        }
        if self.wish.is_some() {
            return Err(later(
                "the image of the board is waited for: touch it then, or cancel that".into(),
            ));
        }
        let robot = self.touching_pose()?;
        self.note_touch(robot.time_s);
        self.tip_to = None;
        self.storing = true;
        self.forget_problem();
        let placement = self.newest_placement().map(|p| p.id.clone());
        Ok(vec![Effect::StoreTouch { corner, placement, robot }])
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
        let same = |t: &&StoredTouch| {
            Residual::between(&t.base_from_flange, here).is_within(THE_SAME_POSE)
        };
        if let Some(before) = self.folder.touches.iter().find(same) {
            return Err(later(format!(
                "the tip is still where it touched corner {}: bring it to the next one",
                before.corner
            )));
        }
        Ok(robot)
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
        let count = self.folder.touches.len();
        match (self.touch_view(), count) {
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
        let Some(view) = self.touch_view() else { return String::new() };
        if view.tip_mm.is_none() {
            return "Where is the tip of the touching tool in the flange? Enter it in millimetres."
                .into();
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

    /// What is shown of touches; `None` where none can be made.
    pub(super) fn touch_view(&self) -> Option<TouchView> {
        let corner = self.next_corner()?;
        let result = self.assessed.as_ref().filter(|_| !self.assessing).map(|a| &a.calibration);
        // of a corner that was touched several times, in that order
        let of = |k: usize, t: &StoredTouch| {
            let same =
                |other: &&StoredTouch| (other.corner, &other.placement) == (t.corner, &t.placement);
            let before = self.folder.touches[..k].iter().filter(same).count();
            let on_it = |found: &&TouchResult| {
                found.corner == t.corner && t.placement.as_ref().is_none_or(|p| *p == found.capture)
            };
            result?.touches.iter().filter(on_it).nth(before)
        };
        let shown = self.folder.touches.iter().enumerate().map(|(k, t)| TouchShown {
            id: t.id.clone(),
            placement: t.placement.clone(),
            corner: t.corner,
            residual_mm: of(k, t).map(|found| found.residual_mm),
            used: of(k, t).is_some_and(|found| found.used),
        });
        let touches: Vec<TouchShown> = shown.collect();
        let all: Vec<f64> =
            touches.iter().filter(|t| t.used).filter_map(|t| t.residual_mm).collect();
        let mean = all.iter().map(|mm| mm * mm).sum::<f64>() / all.len() as f64;
        let rms_mm = (!all.is_empty()).then(|| mean.sqrt());
        let (columns, _) = self.settings().target.grid();
        let (tip_mm, at_corner) = (self.settings().tip_mm, self.is_tip_there(corner));
        Some(TouchView {
            tip_mm,
            corner,
            columns,
            lays: self.lays_boards(),
            placements: self.placements_shown(),
            placement: self.newest_placement().map(|p| p.id.clone()),
            lying: (self.sources.is_virtual && self.lays_boards()).then(|| self.lying()),
            touches,
            rms_mm,
            at_corner,
        })
    }
}
