//! What is wrong with the robot, beside noise: an arm that is not as its model says, or errors by place.
//!
//! The arm is asked first: where its joints tell what is wrong, nothing is left that only the place would tell.

use super::{
    arm::{self, ArmFit},
    place::{self, ByPlace},
    reach::{ArmReach, Reach},
    workpiece::Workpiece,
};
use crate::{
    calibrate::{
        config::Config,
        notes::Notes,
        result::{ArmResult, BY_PLACE, WITH_ARM},
        views::Views,
    },
    estimate::{JointFit, Problem, predict::Volume},
    findings::RobotFinding,
};

/// The robot as the data have it.
pub(super) struct Robot {
    arm: Option<ArmFit>,
    reach: Option<ArmReach>,
    place: Option<ByPlace>,
    /// That its joint values cannot be used.
    inconsistent: Option<RobotFinding>,
}

impl Robot {
    /// Looks at arm and places; `used` are the touches behind the problem's boards, in their order.
    pub(super) fn look(
        views: &Views,
        (problem, fit): (&Problem, &JointFit),
        used: &[usize],
        volume: &Volume,
        config: &Config,
    ) -> Self {
        let (arm, inconsistent) = match arm::look(views, problem, fit, used, config) {
            Ok(arm) => (arm, None),
            Err(finding) => (None, Some(finding)),
        };
        let reach = arm.as_ref().and_then(|a| ArmReach::new(views, a, volume));
        let place = match &reach {
            Some(_) => None,
            None => place::look(views, problem, fit, config),
        };
        Self { arm, reach, place, inconsistent }
    }

    /// The problem and fit with its errors, where they are part of the model; `without` otherwise.
    pub(super) fn best<'a>(
        &'a self,
        without: (&'a Problem, &'a JointFit),
    ) -> (&'a Problem, &'a JointFit) {
        match (&self.arm, &self.reach, &self.place) {
            (Some(arm), Some(_), _) => (&arm.problem, &arm.fit),
            (_, _, Some(ByPlace { model: Some(model), .. })) => (&model.problem, &model.fit),
            _ => without,
        }
    }

    /// Where such a robot must be sent.
    pub(super) fn reach(&self) -> Option<&dyn Reach> {
        let of_arm = self.reach.as_ref().map(|r| r as &dyn Reach);
        of_arm.or(self.place.as_ref().map(|p| p as &dyn Reach))
    }

    /// The name of the candidate that allows for its errors.
    pub(super) fn name(&self) -> Option<&'static str> {
        let of_place = self.place.is_some().then_some(BY_PLACE);
        if self.reach.is_some() { Some(WITH_ARM) } else { of_place }
    }

    /// What is found of it.
    pub(super) fn notes(&self) -> Notes {
        let of_place = self.place.as_ref().and_then(ByPlace::finding);
        let of_arm = self.arm.as_ref().map(ArmFit::finding);
        Notes::of(self.inconsistent.iter().cloned().chain(of_place).chain(of_arm))
    }

    /// The arm as it is, for files.
    pub(super) fn arm(&self, views: &Views, workpiece: &Workpiece) -> Option<ArmResult> {
        let tre_mm = workpiece.rms_of_best_mm().filter(|_| self.reach.is_some());
        self.arm.as_ref().map(|a| a.as_result(views, tre_mm))
    }

    /// The fit in which the arm deviates.
    pub(super) fn into_fit_of_arm(self) -> Option<JointFit> {
        self.arm.map(|a| a.fit)
    }
}
