//! What people and scripts ask for: obeyed, or refused with the reason.

use handeye::Setup;
use handeye_io::{CellSettings, Writing};

use super::{
    Change, Command, Destination, Effect, Engine, Flow, Problem, Step,
    say::WHETHER_MOVED,
    taking::{Asked, Wish},
};
use crate::assess::ProposedView;

/// Why a command is not obeyed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Refusal {
    /// Why.
    pub message: String,
    /// Whether it would be obeyed at another time.
    pub later: bool,
}

impl Engine {
    pub(super) fn obey(&mut self, command: Command) -> Result<Vec<Effect>, Refusal> {
        match command {
            Command::Confirm { step } => self.confirm(step),
            Command::Go { step } => self.go(step),
            Command::Cell { setup, tolerance_mm } => self.change_cell(setup, tolerance_mm),
            Command::Target { target } => {
                target.check().map_err(|e| wrong(e.to_string()))?;
                self.configure(CellSettings { target, ..self.settings().clone() })
            }
            Command::Camera { intrinsics } => {
                intrinsics.map_or(Ok(()), |c| c.check()).map_err(|e| wrong(e.to_string()))?;
                self.configure(CellSettings { intrinsics, ..self.settings().clone() })
            }
            Command::Notation { name, reread } => {
                Writing::of(&name).map_err(wrong)?;
                if reread {
                    return self.reread(name);
                }
                self.configure(CellSettings { notation: name, ..self.settings().clone() })
            }
            Command::Take => self.want(),
            Command::Automatic { on } => {
                self.automatic = on;
                Ok(vec![])
            }
            Command::Cancel => {
                self.wish = None;
                Ok(vec![])
            }
            Command::Grab if self.sources.takes_images => {
                self.grabbing = true;
                Ok(vec![Effect::Grab])
            }
            Command::Grab => Err(wrong("images come by themselves in this session")),
            Command::Pose { text } => self.typed(&text),
            Command::Delete { id } => self.delete(id),
            Command::Restore { id } => self.restore(id),
            Command::Retake { id } => self.retake(id),
            Command::Undo => self.undo(),
            Command::Skip { .. } => self.skip(),
            Command::Tip { in_flange_mm } => self.tip(in_flange_mm),
            Command::Place => self.place(),
            Command::Touch { corner } => self.touch(corner),
            Command::Untouch { id } => self.untouch(id),
            Command::Finish => self.finish(),
            Command::Drive { to } => self.drive(to),
            Command::Jog { .. } if !self.sources.is_virtual => Err(only_virtual()),
            Command::Jog { move_mm, turn_deg } => {
                self.tip_to = None; // it is led away
                Ok(vec![Effect::Jog(move_mm, turn_deg)])
            }
        }
    }

    /// The view to take next: that of a capture which is to be taken again, else the most informative one.
    pub(super) fn next(&self) -> Option<&ProposedView> {
        let assessed = self.assessed.as_ref().filter(|_| !self.assessing);
        let again = self.again.as_ref().map(|(_, view)| view);
        again.or_else(|| assessed?.next.as_ref())
    }

    fn go(&mut self, step: Step) -> Result<Vec<Effect>, Refusal> {
        if step == Step::Touch {
            self.may_touch()?;
        } else if step == Step::Verify {
            self.may_verify()?;
        } else if step > self.farthest {
            let step = step.name();
            return Err(later(format!("the step {step} is not open yet: confirm those before it")));
        }
        let is_another_plan = (self.step == Step::Verify) != (step == Step::Verify);
        self.enter(step);
        let mut effects = if step == Step::Touch { vec![] } else { self.take_away() };
        // where to drive next is another question then
        if is_another_plan {
            effects.extend(self.assess());
        }
        Ok(effects)
    }

    fn change_cell(
        &mut self,
        setup: Option<Setup>,
        tolerance_mm: Option<f64>,
    ) -> Result<Vec<Effect>, Refusal> {
        if tolerance_mm.is_some_and(|mm| !(mm > 0.0 && mm.is_finite())) {
            return Err(wrong("the tolerance is a positive number of millimetres"));
        }
        let old = self.settings();
        let setup = setup.unwrap_or(old.setup);
        self.configure(CellSettings {
            setup,
            // where the camera sits on the robot says nothing of where it stands beside it
            guess: old.guess.filter(|_| setup == old.setup),
            tolerance_mm: tolerance_mm.unwrap_or(old.tolerance_mm),
            ..old.clone()
        })
    }

    fn skip(&mut self) -> Result<Vec<Effect>, Refusal> {
        if self.again.take().is_some() {
            return Ok(vec![]);
        }
        let next = self.next().ok_or_else(|| later("there is no next view to skip".into()))?;
        self.skipped.push(next.base_from_flange);
        Ok(self.assess())
    }

    /// Takes a capture out, and proposes its view again.
    fn retake(&mut self, id: String) -> Result<Vec<Effect>, Refusal> {
        if self.step != Step::Capture {
            return Err(later("captures are retaken in the step `capture`".into()));
        }
        if !self.folder.captures.iter().any(|capture| capture.id == id) {
            return Err(wrong(format!("there is no capture {id}")));
        }
        let again = self.assessed.as_ref().and_then(|assessed| assessed.view_of(&id));
        let effects = self.delete(id.clone())?;
        self.again = again.map(|view| (id, view));
        Ok(effects)
    }

    fn confirm(&mut self, step: Step) -> Result<Vec<Effect>, Refusal> {
        if step != self.step {
            return Err(later(format!("the session is at another step: {}", self.step.name())));
        }
        let proof = self.proof(step);
        if !proof.proven {
            return Err(later(proof.text));
        }
        match step.next() {
            // whoever wants touches goes there
            Some(Step::Touch | Step::Verify | Step::Result) => self.finish(),
            Some(next) => {
                self.enter(next);
                Ok(vec![])
            }
            None => Ok(vec![]),
        }
    }

    pub(super) fn configure(&mut self, settings: CellSettings) -> Result<Vec<Effect>, Refusal> {
        let is_other = !settings.is_of_same_cell(self.settings());
        if is_other && self.sources.is_virtual {
            return Err(wrong("a virtual cell has its own setup, camera and board"));
        }
        Ok(vec![Effect::Configure(Box::new(settings))])
    }

    /// Poses that were typed in another notation are read again, the captures' and the last one.
    fn reread(&mut self, name: String) -> Result<Vec<Effect>, Refusal> {
        if self.sources.robot == Flow::Stream {
            return Err(wrong("poses come from the robot itself in this session, none are typed"));
        }
        self.robot.clear();
        self.rereading = true;
        Ok(vec![Effect::Reread(name)])
    }

    fn want(&mut self) -> Result<Vec<Effect>, Refusal> {
        if !self.takes_captures() {
            return Err(later("captures are taken in the steps `capture` and `verify`".into()));
        }
        if self.step == Step::Verify {
            self.may_verify()?;
        }
        self.not_rereading()?;
        if self.storing {
            return Err(later("a capture is being stored".into()));
        }
        if self.wish.is_none() {
            self.wish = Some(Wish::new(self.now, Asked::Person));
        }
        self.forget_problem();
        Ok(self.wait())
    }

    /// What was wrong with the last capture or touch; what is wrong with the robot stays.
    pub(super) fn forget_problem(&mut self) {
        self.problem = self.problem.take().filter(Problem::is_of_robot);
    }

    fn delete(&mut self, id: String) -> Result<Vec<Effect>, Refusal> {
        let is_placement = self.folder.placements.iter().any(|p| p.id == id);
        let mut captures = self.folder.captures.iter().chain(&self.folder.verification);
        if !is_placement && !captures.any(|c| c.id == id) {
            return Err(wrong(format!("there is no capture {id}")));
        }
        self.changes.push(Change::Deleted(id.clone()));
        Ok(vec![Effect::Delete(id)])
    }

    fn restore(&mut self, id: String) -> Result<Vec<Effect>, Refusal> {
        if !self.folder.deleted.contains(&id) {
            return Err(wrong(format!("there is no deleted capture {id}")));
        }
        self.changes.push(Change::Restored(id.clone()));
        Ok(vec![Effect::Restore(id)])
    }

    fn undo(&mut self) -> Result<Vec<Effect>, Refusal> {
        match self.changes.pop() {
            None => Err(later("there is nothing to undo".into())),
            Some(Change::Touched(id)) => Ok(vec![Effect::Untouch(id)]),
            Some(Change::Restored(id)) if self.folder.touches.iter().any(|t| t.id == id) => {
                Ok(vec![Effect::Untouch(id)])
            }
            Some(Change::Taken(id) | Change::Placed(id) | Change::Restored(id)) => {
                Ok(vec![Effect::Delete(id)])
            }
            Some(Change::Deleted(id) | Change::Untouched(id)) => Ok(vec![Effect::Restore(id)]),
        }
    }

    fn finish(&mut self) -> Result<Vec<Effect>, Refusal> {
        if self.folder.captures.is_empty() {
            return Err(later("there are no captures yet".into()));
        }
        // a capture that says that something has moved would not be heard
        if self.storing || self.assessing {
            return Err(later("the captures are still being assessed: finish then".into()));
        }
        // whether the camera still is where it was is then not known, and a result would not say so
        if let Some(id) = self.newest_outlier() {
            return Err(later(format!(
                "the newest capture, {id}, does not fit to those before it. {WHETHER_MOVED}"
            )));
        }
        match self.not_verified() {
            Some(why) => Err(later(why)),
            None => Ok(vec![Effect::Write]),
        }
    }

    fn drive(&mut self, to: Destination) -> Result<Vec<Effect>, Refusal> {
        if !self.sources.is_virtual {
            return Err(only_virtual());
        }
        if to == Destination::Placement {
            return self.lay();
        }
        if to == Destination::Touch {
            self.may_drive_to_board()?;
            let none = || later("no corner is to be touched".into());
            let corner = self.next_corner(self.touches_verify()).ok_or_else(none)?;
            self.tip_to = Some((corner, self.now));
            return Ok(vec![Effect::DriveTip(corner)]);
        }
        self.tip_to = None;
        let next = self.next().ok_or_else(|| later("there is no next view yet".into()))?;
        let to = Effect::Drive(next.base_from_flange);
        Ok(self.take_away().into_iter().chain([to]).collect())
    }
}

pub(super) fn wrong(message: impl Into<String>) -> Refusal {
    Refusal { message: message.into(), later: false }
}

pub(super) fn later(message: String) -> Refusal {
    Refusal { message, later: true }
}

fn only_virtual() -> Refusal {
    wrong("no robot is moved but that of a virtual cell: drive it by its pendant")
}
