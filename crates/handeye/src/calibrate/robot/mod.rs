//! What is wrong with the robot, beside noise: an arm that is not as its model says, or errors by place.
//!
//! The arm is asked first: where its joints tell what is wrong, nothing is left that only the place would tell.

mod arm;
mod best_rigid;
mod compensation;
mod place;

use crate::{
    calibrate::{
        flow::{config::Config, notes::Notes, views::Views},
        prediction::{
            reach::{Reach, ToolReach, UsedTouches},
            workpiece::Workpiece,
        },
        result::{ArmResult, CompensationResult, RobotErrorKind},
    },
    estimate::{JointFit, Problem, predict::Volume},
    findings::RobotFinding,
};
use arm::ArmFit;
use best_rigid::BestRigid;
use place::ByPlace;

/// The robot as the data have it.
pub(crate) struct Robot {
    arm: Option<ArmFit>,
    reach: Option<Box<dyn Reach>>,
    place: Option<ByPlace>,
    /// That its joint values cannot be used.
    inconsistent: Option<RobotFinding>,
}

impl Robot {
    /// Looks at arm and places.
    pub(crate) fn estimated(
        views: &Views,
        (problem, fit): (&Problem, &JointFit),
        touched: UsedTouches,
        volume: &Volume,
        config: &Config,
    ) -> Self {
        let (arm, inconsistent) = match arm::fitted_arm(views, problem, fit, touched, config) {
            Ok(arm) => (arm, None),
            Err(finding) => (None, Some(finding)),
        };
        let reach = arm.as_ref().and_then(|a| reach(views, a, volume));
        let place = match &reach {
            Some(_) => None,
            None => place::errors_by_place(views, (problem, fit), touched, volume, config),
        };
        Self { arm, reach, place, inconsistent }
    }

    /// The problem and fit with its errors, where they are part of the model; `without` otherwise.
    pub(crate) fn best<'a>(
        &'a self,
        without: (&'a Problem, &'a JointFit),
    ) -> (&'a Problem, &'a JointFit) {
        match (&self.arm, &self.reach, &self.place) {
            (Some(arm), Some(_), _) => (&arm.problem, &arm.fit),
            (_, _, Some(ByPlace { model: Some(model), .. })) => (&model.problem, &model.fit),
            _ => without,
        }
    }

    /// Whether its errors are what looked like a wrong tip.
    pub(crate) fn explains_tip(&self) -> bool {
        self.place.as_ref().is_some_and(ByPlace::explains_tip)
    }

    /// Where such a robot must be sent.
    pub(crate) fn reach(&self) -> Option<&dyn Reach> {
        let of_arm = self.reach.as_deref();
        of_arm.or(self.place.as_ref().map(|p| p as &dyn Reach))
    }

    /// Errors that a candidate is made for.
    pub(crate) fn errors(&self) -> Option<RobotErrorKind> {
        let of_place = self.place.is_some().then_some(RobotErrorKind::ByPlace);
        if self.reach.is_some() { Some(RobotErrorKind::OfArm) } else { of_place }
    }

    /// What is found of it.
    pub(crate) fn notes(
        &self,
        compensation: Option<&CompensationResult>,
        workpiece: &Workpiece,
    ) -> Notes {
        let corrected = compensation.filter(|c| c.model.is_some()).map(CompensationResult::worse);
        let of_place = self.place.as_ref().and_then(|p| p.finding(corrected, workpiece));
        let of_arm = self.arm.as_ref().map(ArmFit::finding);
        Notes::of(self.inconsistent.iter().cloned().chain(of_place).chain(of_arm))
    }

    /// The arm as it is, for files.
    pub(crate) fn arm(&self, views: &Views, workpiece: &Workpiece) -> Option<ArmResult> {
        let tre_mm = workpiece.rms_of_best_mm().filter(|_| self.reach.is_some());
        self.arm.as_ref().map(|a| a.as_result(views, tre_mm))
    }

    /// What correcting its poses is worth, where it errs; `without` is the fit in which it does not.
    pub(crate) fn compensation(
        &self,
        views: &Views,
        without: (&Problem, &JointFit),
        workpiece: &Workpiece,
        config: &Config,
    ) -> Option<CompensationResult> {
        let (rigid, _) = workpiece.rigid()?;
        match (&self.arm, &self.reach, &self.place) {
            (Some(arm), Some(_), _) => compensation::by_arm(views, arm, without, &rigid),
            (_, _, Some(ByPlace { model: Some(model), .. })) => {
                compensation::by_place(views, model, &rigid, &config.known)
            }
            _ => None,
        }
    }

    /// The fit in which the arm deviates.
    pub(crate) fn into_fit_of_arm(self) -> Option<JointFit> {
        self.arm.map(|a| a.fit)
    }
}

/// Where a robot must be sent that does not know of its arm's deviations: the tool is held as in the touches, or else the
/// answer is made for the poses of the captures.
fn reach(views: &Views, arm: &ArmFit, volume: &Volume) -> Option<Box<dyn Reach>> {
    if arm.problem.boards.is_empty() {
        return Some(Box::new(BestRigid::new(views, arm)?));
    }
    Some(Box::new(ToolReach::new(views, arm, volume)?))
}
