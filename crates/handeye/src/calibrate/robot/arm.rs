//! What is wrong with the arm itself, found with the camera's help.
//!
//! Where joint values and a model of the arm were given, its joint zeros, and then all of its
//! links, may deviate from the model, each by about so much as the likelihood of the data says.
//! They do so only where that pays: by the likelihood, and by what was left out. The corrected arm
//! stands beside the answer for the robot as it is; the fit is linearised again where it leads.

use nalgebra::{DMatrix, DVector};

use crate::{
    Base, Flange, Observation, Pose, Setup, Touch,
    calibrate::{
        flow::{config::Config, views::Views},
        prediction::reach::{Erring, UsedTouches},
        result::{ArmDeviation, ArmHeldOut, ArmResult},
        touches::views_and_touches::held_out_views,
    },
    estimate::{
        Extra, ExtraKind, JointFit, Problem, Source, compensation::ByUnknowns, evaluate, joint,
        place::Place,
    },
    findings::RobotFinding,
    math::lie,
    model::{
        kinematics::{Arm, CONSISTENT, Deviation},
        residual::Residual,
    },
};

/// The fit in which the arm deviates from its model.
pub(crate) struct ArmFit {
    /// The equations about `arm`; what is left of the deviations is among the extras.
    pub problem: Problem,
    pub fit: JointFit,
    /// The arm as it was given, and as it is.
    pub model: Arm,
    pub arm: Arm,
    pub which: Vec<Deviation>,
    /// The arm with all that was found.
    pub corrected: Arm,
    wrong_tip: bool,
    moved: Vec<f64>,
    prior_sigma: Vec<f64>,
    held_out: ArmHeldOut,
    robot_mm: (f64, f64),
}

/// Fewest captures with joint values.
const FEWEST_VIEWS: usize = 8;
/// How far a usual industrial arm deviates from its drawings, in angles and lengths; and the factors on both that are
/// tried.
const USUAL: Residual = Residual { angle: 3e-4, distance: 0.25e-3 };
const FACTORS: [f64; 3] = [1.0, 4.0, 16.0];
/// Gain of the logarithm of the likelihood that a deviating arm must bring.
const GAIN: f64 = 6.0;
/// What was left out may be missed by this factor more, no more: noise.
const HELD_OUT_SLACK: f64 = 1.02;
/// Rounds of linearising the deviations.
const ROUNDS: usize = 3;
/// The deviations are found when none moves by more than this part of its standard deviation.
const SETTLED: f64 = 0.05;

/// Looks whether the arm deviates.
pub(crate) fn fitted_arm(
    views: &Views,
    problem: &Problem,
    fit: &JointFit,
    touched: UsedTouches,
    config: &Config,
) -> Result<Option<ArmFit>, RobotFinding> {
    let Some(model) = &views.session.arm else { return Ok(None) };
    if model.check().is_err() || views.used.len() < FEWEST_VIEWS {
        return Ok(None);
    }
    if views.used.iter().any(|o| o.joints.len() != model.joints.len()) {
        return Ok(None);
    }
    consistent(views, model)?;
    let look = Look { views, model, problem, touched, config };
    // a systematic difference stands for what an arm that is known need not leave open
    let rigid = look.without_systematic(fit);
    let mut best: Option<Trial> = None;
    let mut bar = fit.log_likelihood.max(rigid.log_likelihood) + GAIN;
    for which in [model.offsets(), model.deviations()] {
        let trials = FACTORS.iter().filter_map(|f| look.trial(model, &which, *f, &[], &rigid));
        let Some(trial) =
            trials.max_by(|a, b| a.fit.log_likelihood.total_cmp(&b.fit.log_likelihood))
        else {
            continue;
        };
        // each step up the ladder must pay for itself
        if trial.fit.log_likelihood > bar {
            bar = trial.fit.log_likelihood + GAIN;
            best = Some(trial);
        }
    }
    let Some(trial) = best else { return Ok(None) };
    let held_out = ArmHeldOut {
        before_mm: look.missed_mm(problem, fit),
        after_mm: look.missed_mm(&trial.problem, &trial.fit),
    };
    let worse = held_out.after_mm.zip(held_out.before_mm);
    if worse.is_none_or(|(after, before)| after > HELD_OUT_SLACK * before) {
        return Ok(None);
    }
    Ok(Some(look.settled(trial, &rigid, held_out, fit)))
}

/// One way for the arm to deviate.
struct Trial {
    which: Vec<Deviation>,
    prior_sigma: Vec<f64>,
    problem: Problem,
    fit: JointFit,
}

struct Look<'a> {
    views: &'a Views<'a>,
    model: &'a Arm,
    problem: &'a Problem,
    touched: UsedTouches<'a>,
    config: &'a Config,
}

impl Look<'_> {
    fn without_systematic(&self, fit: &JointFit) -> JointFit {
        joint::refit(&self.problem.without_systematic(), fit, &self.config.known)
    }

    /// The fit with these deviations free about an arm that has moved by so much already.
    fn trial(
        &self,
        arm: &Arm,
        which: &[Deviation],
        factor: f64,
        moved: &[f64],
        near: &JointFit,
    ) -> Option<Trial> {
        if which.is_empty() {
            return None;
        }
        let sigma = |d: &Deviation| {
            factor * if d.parameter.is_angle() { USUAL.angle } else { USUAL.distance }
        };
        let prior_sigma: Vec<f64> = which.iter().map(sigma).collect();
        let mut problem = self.about(arm, which);
        problem.extras.extend(prior_sigma.iter().enumerate().map(|(k, sigma)| Extra {
            kind: ExtraKind::Arm(k),
            prior_mean: -moved.get(k).copied().unwrap_or(0.0),
            prior_sigma: *sigma,
        }));
        let fit = joint::refit(&problem, near, &self.config.known);
        fit.covariance.as_ref()?;
        Some(Trial { which: which.to_vec(), prior_sigma, problem, fit })
    }

    /// The problem with every robot pose where this arm puts it, and how it moves from there.
    fn about(&self, arm: &Arm, which: &[Deviation]) -> Problem {
        let (setup, n) = (self.views.session.setup, which.len());
        let mut problem = self.problem.without_systematic();
        for (view, o) in problem.views.iter_mut().zip(&self.views.used) {
            let correction = correction(self.model, arm, &o.joints);
            let base_from_flange = corrected(&o.base_from_flange, &correction);
            view.pair.anchor_from_mount = setup.anchor_from_mount(base_from_flange);
            let by = arm.by_deviations(&o.joints, which);
            // to_hand: (F exp(ξ))⁻¹ = F⁻¹ exp(-Ad(F) ξ)
            let by = match setup {
                Setup::EyeInHand => by,
                Setup::EyeToHand => DMatrix::from_column_slice(
                    6,
                    n,
                    (-lie::adjoint(base_from_flange.iso()) * by).as_slice(),
                ),
            };
            view.by_robot = Some(by.into());
        }
        let corners = problem.boards.iter_mut().flat_map(|b| &mut b.corners);
        for (corner, &k) in corners.zip(self.touched.used) {
            let touch = &self.views.session.touches[k];
            let (Some(flange), true) =
                (touch.base_from_flange, touch.joints.len() == arm.joints.len())
            else {
                continue;
            };
            let moved = corrected(&flange, &correction(self.model, arm, &touch.joints));
            corner.in_base = (moved * (flange.inverse() * touch.in_base)).vector();
            corner.base_from_flange = Some(moved);
            corner.by_robot = Some(arm.by_deviations(&touch.joints, which).into());
        }
        problem
    }

    /// RMS residual (mm) of views, and of touches, that were left out of the fit.
    fn missed_mm(&self, problem: &Problem, fit: &JointFit) -> Option<f64> {
        let left_out = held_out_views(problem, fit, self.config);
        evaluate::rms(&left_out).translation_rms_mm
    }

    /// The fit linearised where it leads.
    fn settled(
        &self,
        trial: Trial,
        rigid: &JointFit,
        held_out: ArmHeldOut,
        given: &JointFit,
    ) -> ArmFit {
        let n = trial.which.len();
        let factor = trial.prior_sigma.first().map_or(1.0, |s| {
            s / if trial.which[0].parameter.is_angle() { USUAL.angle } else { USUAL.distance }
        });
        let mut moved = vec![0.0; n];
        let mut arm = self.model.clone();
        let mut now = trial;
        for _ in 0..ROUNDS {
            let step: Vec<f64> =
                (0..n).map(|k| now.fit.extra(ExtraKind::Arm(k)).map_or(0.0, |x| x.0)).collect();
            let sigma = |k| now.fit.extra(ExtraKind::Arm(k)).map_or(1.0, |x| x.1);
            if (0..n).all(|k| step[k].abs() < SETTLED * sigma(k)) {
                break;
            }
            let next: Vec<f64> = moved.iter().zip(&step).map(|(m, s)| m + s).collect();
            let there = self.model.moved(&now.which, &next);
            // values of the arm's extras start at zero again
            let near = without_arm(&now.fit);
            let Some(trial) = self.trial(&there, &now.which, factor, &next, &near) else { break };
            (moved, arm, now) = (next, there, trial);
        }
        let robot = |f: &JointFit| f.noise.sigma(Source::RobotPosition).unwrap_or(0.0) * 1e3;
        let found = ArmFit {
            wrong_tip: self.touched.wrong_tip,
            corrected: arm.clone(),
            robot_mm: (robot(given).max(robot(rigid)), robot(&now.fit)),
            problem: now.problem,
            fit: now.fit,
            model: self.model.clone(),
            arm,
            which: now.which,
            moved,
            prior_sigma: now.prior_sigma,
            held_out,
        };
        let corrected = found.model.moved(&found.which, &found.values());
        ArmFit { corrected, ..found }
    }
}

/// The fit without what it says of the arm.
fn without_arm(fit: &JointFit) -> JointFit {
    let arm = |e: &Extra| matches!(e.kind, ExtraKind::Arm(_));
    let kept: Vec<usize> = (0..fit.extras.len()).filter(|&k| !arm(&fit.extras[k])).collect();
    JointFit {
        extras: kept.iter().map(|&k| fit.extras[k]).collect(),
        values: DVector::from_iterator(kept.len(), kept.iter().map(|&k| fit.values[k])),
        ..fit.clone()
    }
}

/// `model flange⁻¹ · arm flange`: what puts a flange right, on its right.
fn correction(model: &Arm, arm: &Arm, joints: &[f64]) -> Pose<Flange, Flange> {
    model.base_from_flange(joints).inverse() * arm.base_from_flange(joints)
}

fn corrected(flange: &Pose<Base, Flange>, correction: &Pose<Flange, Flange>) -> Pose<Base, Flange> {
    *flange * *correction
}

/// Refuses joint values that do not lead to the flange poses beside them.
fn consistent(views: &Views, model: &Arm) -> Result<(), RobotFinding> {
    let apart = |joints: &[f64], flange: &Pose<Base, Flange>| {
        !Residual::between(&model.base_from_flange(joints), flange).is_within(CONSISTENT)
    };
    let differ = |at: String| RobotFinding::JointsAndPosesDiffer { at };
    let of_view = |o: &&&Observation| apart(&o.joints, &o.base_from_flange);
    if let Some(o) = views.used.iter().find(of_view) {
        return Err(differ(format!("capture {}", o.capture)));
    }
    let of_touch = |t: &&Touch| {
        !t.joints.is_empty() && t.base_from_flange.is_some_and(|f| apart(&t.joints, &f))
    };
    match views.session.touches.iter().find(of_touch) {
        Some(t) => Err(differ(format!("the touch of corner {} of {:?}", t.corner, t.placement))),
        None => Ok(()),
    }
}

impl Erring for ArmFit {
    fn fit(&self) -> &JointFit {
        &self.fit
    }

    fn is_own(&self, kind: ExtraKind) -> bool {
        matches!(kind, ExtraKind::Arm(_))
    }

    fn corrects_tip(&self) -> bool {
        self.wrong_tip
    }

    fn knows(&self, at: &Place) -> bool {
        at.joints.len() == self.model.joints.len()
    }

    fn reported(&self, at: &Place) -> Pose<Base, Flange> {
        self.model.base_from_flange(&at.joints)
    }

    fn actual(&self, at: &Place) -> Pose<Base, Flange> {
        self.corrected.base_from_flange(&at.joints)
    }

    fn place_for(&self, flange: &Pose<Base, Flange>, near: &Place) -> Option<Place> {
        let joints = self.corrected.inverse(flange, &near.joints)?;
        Some(Place::new(&self.model.base_from_flange(&joints), &joints))
    }

    fn errors(&self, at: &Place) -> ByUnknowns {
        ByUnknowns::wholly_known(self.arm.by_deviations(&at.joints, &self.which))
    }
}

/// A deviation is known when the data make its standard deviation smaller than this part of what
/// was believed.
const OBSERVED: f64 = 0.9;

impl ArmFit {
    /// The deviations' whole values.
    pub(crate) fn values(&self) -> Vec<f64> {
        let rest = |k| self.fit.extra(ExtraKind::Arm(k)).map_or(0.0, |x: (f64, f64)| x.0);
        self.moved.iter().enumerate().map(|(k, m)| m + rest(k)).collect()
    }

    /// That it deviates.
    pub(crate) fn finding(&self) -> RobotFinding {
        let (parameters, (before_mm, after_mm)) = (self.which.len(), self.robot_mm);
        RobotFinding::ArmDeviates { parameters, before_mm, after_mm }
    }

    /// For files; the answer about the target's own origin.
    pub(crate) fn as_result(&self, views: &Views, predicted_tre_mm: Option<f64>) -> ArmResult {
        let answer = self.fit.hand_eye.retarget(views.target_from_corner.inverse());
        let values = self.values();
        let one = |(k, d): (usize, &Deviation)| {
            let sigma = self.fit.extra(ExtraKind::Arm(k)).map_or(0.0, |x| x.1);
            let unit = |v: f64| if d.parameter.is_angle() { v.to_degrees() } else { v * 1e3 };
            ArmDeviation {
                joint: d.joint + 1,
                parameter: d.parameter,
                value: unit(values[k]),
                sigma: unit(sigma),
                observed: sigma < OBSERVED * self.prior_sigma[k],
            }
        };
        ArmResult {
            model: self.corrected.clone(),
            deviations: self.which.iter().enumerate().map(one).collect(),
            mount_from_camera: answer.mount_from_camera,
            anchor_from_target: answer.anchor_from_target,
            tip_offset_mm: self.tip_offset_mm(),
            held_out: self.held_out,
            robot_before_mm: self.robot_mm.0,
            robot_after_mm: self.robot_mm.1,
            predicted_tre_mm,
        }
    }

    fn tip_offset_mm(&self) -> Option<[f64; 3]> {
        let in_flange = |b: &crate::estimate::TouchedBoard| {
            b.corners.iter().all(|c| c.base_from_flange.is_some())
        };
        let touched = !self.problem.boards.is_empty() && self.problem.boards.iter().all(in_flange);
        let at = |k| self.fit.extra(ExtraKind::Tip(k)).map_or(0.0, |x: (f64, f64)| x.0 * 1e3);
        touched.then(|| std::array::from_fn(at))
    }
}
