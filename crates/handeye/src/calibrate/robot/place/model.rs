//! Fits with errors by place among their unknowns, for the lengths over which these may change.

use nalgebra::Matrix6;

use super::{
    captures::{errors, places, poses, with_waves, work},
    mixture::Component,
};
use crate::{
    Base, Camera, Flange, Mount, Pose,
    calibrate::{
        flow::{config::Config, limits::VERY_MANY, views::Views},
        prediction::{
            reach::{Erring, Nearest, ToolReach, UsedTouches},
            workpiece::inflation,
        },
    },
    estimate::{
        ExtraKind, JointFit, Problem,
        compensation::{ByPlace as Errors, ByUnknowns},
        extra::TIP_PRIOR,
        joint,
        place::{self, Kernel, Place, Waves},
        predict::Volume,
        projection::Projection,
    },
};

/// So many of the lengths over which errors may change are fitted, those that promise most.
const MOST_FITTED: usize = 2;
/// Gain from which answer and stated error allow for such errors, whether or not the robot is said to have them.
pub(super) const NOTICED: f64 = 0.1;
/// The same of very many captures: what gains no more hardly moves the answer of them all, and takes long to fit.
const NOTICED_IN_MANY: f64 = 2.0;

/// A fit with errors by place.
pub(crate) struct Model {
    pub kernel: Kernel,
    /// The problem without such errors.
    pub plain: Problem,
    pub problem: Problem,
    /// The touches behind the problem's boards, in their order.
    pub touches: Vec<usize>,
    pub fit: JointFit,
    /// Whether the tip is wrong in it.
    pub wrong_tip: bool,
    errors: Errors,
    pub(super) projection: Projection,
    /// By how much the logarithm of the likelihood gains.
    pub gain: f64,
}

/// A model, and its answer.
pub(super) struct Candidate {
    pub model: Model,
    /// Where its robot must be sent with the tool, where touches show how that is held.
    pub tool: Option<ToolReach>,
    /// The answer; its weight is still that of one model.
    pub answer: Component,
}

/// A problem without errors by place, and whether the tip is wrong in it.
pub(super) struct Plain {
    problem: Problem,
    pub fit: JointFit,
    wrong_tip: bool,
}

/// What errors by place are searched for in.
pub(super) struct Search<'a> {
    pub views: &'a Views<'a>,
    pub touched: UsedTouches<'a>,
    pub volume: &'a Volume,
    pub config: &'a Config,
    pub metric: Matrix6<f64>,
}

impl Search<'_> {
    /// The problem without errors by place, and without what stands for them: a systematic difference between views and
    /// touches, a wrong tip.
    pub fn plain(&self, problem: &Problem, fit: &JointFit) -> Vec<Plain> {
        let UsedTouches { used, wrong_tip } = self.touched;
        if used.is_empty() {
            return vec![Plain { problem: problem.clone(), fit: fit.clone(), wrong_tip }];
        }
        let refitted = |problem: Problem, wrong_tip: bool| {
            let fit = joint::refit(&problem, fit, &self.config.known);
            Plain { problem, fit, wrong_tip }
        };
        let plain = problem.without_systematic();
        let prior = self.config.known.tip_m.unwrap_or(TIP_PRIOR);
        let right = wrong_tip.then(|| refitted(plain.with_tip(prior), false));
        [refitted(plain, wrong_tip)].into_iter().chain(right).collect()
    }

    /// Fits with errors over the lengths that promise most, and how many were looked at; gains are over `bar`.
    pub fn candidates(&self, plain: &[Plain], bar: f64) -> (Vec<Candidate>, usize) {
        let places = places(self.views, self.touched.used);
        let jointed = places.iter().all(Place::has_joints);
        let kernels = Kernel::OF_POSES.into_iter().chain(jointed.then_some(Kernel::OF_JOINTS));
        let kernels: Vec<Kernel> = kernels.collect();
        let all = plain.iter().flat_map(|p| self.candidates_over(p, &kernels, &places, bar));
        (all.collect(), kernels.len() * plain.len())
    }

    fn candidates_over(
        &self,
        plain: &Plain,
        kernels: &[Kernel],
        places: &[Place],
        bar: f64,
    ) -> Vec<Candidate> {
        let noticed = if plain.problem.views.len() > VERY_MANY { NOTICED_IN_MANY } else { NOTICED };
        let promising = |kernel: &Kernel| {
            let waves = Waves::new(*kernel, places);
            let wider = with_waves((self.views, self.touched.used), &plain.problem, &waves);
            let expected = place::expected_gain(&wider, &plain.fit)?;
            (expected > noticed).then_some((expected, *kernel, waves, wider))
        };
        let mut found: Vec<_> = kernels.iter().filter_map(promising).collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.truncate(MOST_FITTED);
        let fitted = found.into_iter().filter_map(|(_, kernel, waves, wider)| {
            let model = self.model((kernel, &waves, wider), plain, bar)?;
            self.candidate(model)
        });
        fitted.collect()
    }

    fn model(
        &self,
        (kernel, waves, problem): (Kernel, &Waves, Problem),
        plain: &Plain,
        bar: f64,
    ) -> Option<Model> {
        let fit = joint::refit(&problem, &plain.fit, &self.config.known);
        let at = work(self.views, &plain.fit.hand_eye);
        Some(Model {
            kernel,
            plain: plain.problem.clone(),
            touches: self.touched.used.to_vec(),
            wrong_tip: plain.wrong_tip,
            errors: errors(self.views, kernel, waves, &fit),
            projection: Projection::new((&problem, &fit), &fit.values, &self.metric, &at)?,
            gain: fit.log_likelihood - bar,
            problem,
            fit,
        })
    }

    fn candidate(&self, model: Model) -> Option<Candidate> {
        let Model { fit, projection, .. } = &model;
        let covariance = fit.covariance.as_ref()? * inflation(fit)?;
        let missed_once = projection.missed_once(fit, &self.metric);
        let tool = match self.touched.used {
            [] => None,
            _ => ToolReach::new(self.views, &model, self.volume),
        };
        let log_weight = model.gain;
        let answer = match &tool {
            None => {
                let covariance = projection.covariance(&covariance).fixed_view::<6, 6>(0, 0).into();
                Component { log_weight, x: model.rigid(), covariance, missed: missed_once }
            }
            Some(tool) => {
                let Nearest { x, covariance, variance, .. } = tool.answer(&covariance)?;
                let from_pose_to_pose = missed_once - projection.missed;
                let missed = variance / poses(self.views.session.setup) + from_pose_to_pose;
                Component { log_weight, x, covariance, missed }
            }
        };
        Some(Candidate { model, tool, answer })
    }
}

impl Model {
    /// The rigid answer that fits best where the captures are.
    fn rigid(&self) -> Pose<Mount, Camera> {
        let step = self.projection.step.fixed_rows::<6>(0).into_owned();
        self.fit.hand_eye.mount_from_camera.retract(&step)
    }

    pub(super) fn sampling(&self) -> Matrix6<f64> {
        self.projection.sampling.fixed_view::<6, 6>(0, 0).into()
    }
}

impl Erring for Model {
    fn fit(&self) -> &JointFit {
        &self.fit
    }

    fn is_own(&self, kind: ExtraKind) -> bool {
        kind.level().is_some()
    }

    fn corrects_tip(&self) -> bool {
        self.wrong_tip
    }

    fn knows(&self, at: &Place) -> bool {
        matches!(self.kernel, Kernel::Pose { .. }) || at.has_joints()
    }

    fn reported(&self, at: &Place) -> Pose<Base, Flange> {
        at.base_from_flange
    }

    fn actual(&self, at: &Place) -> Pose<Base, Flange> {
        at.base_from_flange.retract(&self.errors.at(at))
    }

    /// To first order: errors hardly differ within themselves.
    fn place_for(&self, flange: &Pose<Base, Flange>, near: &Place) -> Option<Place> {
        let joints = match &self.errors.arm {
            Some(arm) => arm.inverse(flange, &near.joints)?,
            None => near.joints.clone(),
        };
        let there = Place { base_from_flange: *flange, joints, ..near.clone() };
        let reported = flange.retract(&-self.errors.at(&there));
        Some(Place { base_from_flange: reported, ..there })
    }

    fn errors(&self, at: &Place) -> ByUnknowns {
        self.errors.by_unknowns(at)
    }
}
