//! Does the robot err by place? Then no rigid answer is right everywhere, and what captures of one place share counts
//! once.
//!
//! The fit is repeated with errors by place among its unknowns ([`crate::estimate::place`]), for several lengths over
//! which they change; they are part of the model where the likelihood gains clearly. The answer is then the rigid one
//! that fits best where the captures are ([`crate::estimate::projection`]), and what it misses there is part of its
//! predicted error. Which model is right remains open: answer and covariance are those of the mixture of all, weighted
//! by their likelihood, independent errors among them. Where the gain is small nothing is said of the robot but that this is
//! open, if the predicted error is much larger for it.

mod captures;
mod mixture;
mod model;

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

use crate::{
    Camera, Mount, Pose, Setup,
    calibrate::{
        flow::{config::Config, limits::MOST_PREDICTED_MM, views::Views},
        prediction::{
            reach::{Reach, ToolReach, UsedTouches},
            workpiece::{Workpiece, inflation},
        },
        result::BlockGain,
    },
    estimate::{JointFit, Problem, Source, predict::Volume},
    findings::RobotFinding,
    register::rigid_fit::point_jacobian,
};
pub(super) use captures::{errors, metric, places, poses, with_waves, work};
use mixture::{Component, Mixture};
pub(super) use model::Model;
use model::{Candidate, NOTICED, Search};

/// Fewest captures that separate errors by place from noise.
const FEWEST_VIEWS: usize = 8;
/// Gain of the logarithm of the likelihood that errors by place must bring from many captures: their two levels gain as
/// much by chance in one of two hundred sets, and there are several lengths over which errors may change.
const GAIN: f64 = 4.0;
/// So few captures double it: there the noise itself is hardly known, and chance gains more.
const FEW_FOR_GAIN: f64 = 10.0;
/// Where it is open whether a robot errs by place, that is said once the predicted error is more than so many times as large
/// for it.
const MUCH: f64 = 1.5;

/// A robot that may err by place.
pub(crate) struct ByPlace {
    /// The fit with such errors, where they are part of the model.
    pub model: Option<Model>,
    /// From the fit's answer to the rigid one.
    step: Vector6<f64>,
    /// What is uncertain beside the fit's own covariance: the sample of places, and which model is right.
    more: Matrix6<f64>,
    /// Variance per axis (m²) of what the robot misses at one pose, whatever transform it is sent by.
    missed: f64,
    /// How likely it errs by place.
    share: f64,
    setup: Setup,
    /// The fit's answer.
    x: Pose<Mount, Camera>,
    /// Where it must be sent with its tool, where touches show how that is held.
    tool: Option<ToolReach>,
}

/// Looks whether the robot errs by place; `None` where nothing speaks for it. Touches show how the tool is held in the
/// `volume`.
pub(crate) fn errors_by_place(
    views: &Views,
    (problem, fit): (&Problem, &JointFit),
    touched: UsedTouches,
    volume: &Volume,
    config: &Config,
) -> Option<ByPlace> {
    let metric = metric(views);
    if !is_separable(views, fit, touched, &metric) {
        return None;
    }
    let search = Search { views, touched, volume, config, metric };
    let plain = search.plain(problem, fit);
    let bar = plain.iter().map(|p| p.fit.log_likelihood).fold(fit.log_likelihood, f64::max);
    let (candidates, tried) = search.candidates(&plain, bar);
    let gain = |k: usize| candidates[k].model.gain;
    let best = (0..candidates.len()).max_by(|&a, &b| gain(a).total_cmp(&gain(b)))?;
    if gain(best) < NOTICED {
        return None;
    }
    let components = components(fit, &candidates, tried)?;
    let setup = views.session.setup;
    if gain(best) < GAIN * (1.0 + FEW_FOR_GAIN / problem.views.len() as f64) {
        let Mixture { step, more, missed, share } =
            Mixture::of(&components, 0, &components[0].covariance);
        let (x, model, tool) = (components[0].x, None, None);
        return Some(ByPlace { x, model, step, more, missed, share, setup, tool });
    }
    let Candidate { model, tool, answer } = candidates.into_iter().nth(best)?;
    let x = model.fit.hand_eye.mount_from_camera;
    let (own, to_answer) = match tool {
        Some(_) => (answer.covariance, Vector6::zeros()),
        // the sample of places is in `more`
        None => (answer.covariance - model.sampling(), x.local(&answer.x)),
    };
    let Mixture { step, more, missed, share } = Mixture::of(&components, best + 1, &own);
    let step = to_answer + step;
    Some(ByPlace { x, model: Some(model), step, more, missed, share, setup, tool })
}

/// Whether the data can separate errors by place from noise.
fn is_separable(
    views: &Views,
    fit: &JointFit,
    touched: UsedTouches,
    metric: &Matrix6<f64>,
) -> bool {
    let has_flange = |k: &usize| views.session.touches[*k].base_from_flange.is_some();
    // of a robot in motion, errors of place and of time are one
    let moves = views.used.iter().any(|o| o.velocity.is_some());
    let enough = views.used.len() >= FEWEST_VIEWS && touched.used.iter().all(has_flange);
    enough && !moves && determines(fit, metric)
}

/// Independent errors, `fit`, and then all candidates; their prior probabilities are those of all that were `tried`.
fn components(fit: &JointFit, candidates: &[Candidate], tried: usize) -> Option<Vec<Component>> {
    let unpromising = (tried - candidates.len()) as f64 / tried as f64;
    let independent = Component {
        // what promised too little to be fitted counts as independent errors
        log_weight: (1.0 + unpromising).ln(),
        x: fit.hand_eye.mount_from_camera,
        covariance: fit.covariance.as_ref()?.fixed_view::<6, 6>(0, 0) * inflation(fit)?,
        missed: 0.0,
    };
    let prior = (tried as f64).ln();
    let weighted =
        |c: &Candidate| Component { log_weight: c.answer.log_weight - prior, ..c.answer };
    Some(std::iter::once(independent).chain(candidates.iter().map(weighted)).collect())
}

/// Whether the target is found to within an error that could be accepted: what hardly determines an answer tells
/// nothing of the places.
fn determines(fit: &JointFit, metric: &Matrix6<f64>) -> bool {
    let Some(covariance) = &fit.covariance else { return false };
    let square = (metric * covariance.fixed_view::<6, 6>(6, 6)).trace();
    square.sqrt() * 1e3 < MOST_PREDICTED_MM
}

impl ByPlace {
    /// Whether its errors are what looked like a wrong tip.
    pub(crate) fn explains_tip(&self) -> bool {
        self.model.as_ref().is_some_and(|m| !m.wrong_tip)
    }

    /// That it does, by how much, and what is left where its poses are corrected; or that it is open, where that is much
    /// of the predicted error.
    pub(crate) fn finding(
        &self,
        corrected: Option<BlockGain>,
        workpiece: &Workpiece,
    ) -> Option<RobotFinding> {
        let Some(model) = self.model.as_ref() else { return self.open(workpiece) };
        let sigma = |source| model.fit.noise.sigma(source).unwrap_or(0.0);
        Some(RobotFinding::ErrsByPlace {
            position_mm: 3f64.sqrt() * sigma(Source::PlacePosition) * 1e3,
            rotation_deg: 3f64.sqrt() * sigma(Source::PlaceRotation).to_degrees(),
            missed_mm: (3.0 * model.projection.missed).sqrt() * 1e3,
            gain: model.gain,
            corrected: corrected.map(|c| (c.corrected_mm, c.rigid_mm)),
        })
    }

    /// That it is open, where that makes the predicted error much larger.
    fn open(&self, workpiece: &Workpiece) -> Option<RobotFinding> {
        let (answer, _) = workpiece.rigid()?;
        let predicted_mm = workpiece.predicted_rms_mm(&answer)?;
        let independent_mm = workpiece.rms_of_best_mm()?;
        let finding =
            RobotFinding::MayErrByPlace { probability: self.share, predicted_mm, independent_mm };
        (predicted_mm > MUCH * independent_mm).then_some(finding)
    }
}

impl Reach for ByPlace {
    fn shift(&self, p: &Vector3<f64>) -> Vector3<f64> {
        let of_tool = self.tool.as_ref().map_or_else(Vector3::zeros, |tool| tool.shift(p));
        point_jacobian(p) * self.step + of_tool
    }

    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64> {
        let j = point_jacobian(p);
        let of_tool = self.tool.as_ref().map_or_else(Matrix3::zeros, |tool| tool.scatter(p));
        // the scatter of a tool's ways is what it misses
        let missed = if self.tool.is_some() { 0.0 } else { poses(self.setup) * self.missed };
        j * self.more * j.transpose() + Matrix3::identity() * missed + of_tool
    }

    fn share_of_noise(&self) -> f64 {
        // the scatter of a tool's ways is without noise
        if self.tool.is_some() { 0.0 } else { self.share }
    }

    fn by_unknowns(&self, p: &Vector3<f64>) -> Vec<(usize, Vector3<f64>)> {
        if let Some(tool) = &self.tool {
            return tool.by_unknowns(p);
        }
        let Some(Model { fit, projection, .. }) = &self.model else { return vec![] };
        let by = point_jacobian(p) * projection.carry.fixed_rows::<6>(0);
        let kept = fit.extras.iter().enumerate().filter(|(_, e)| e.kind.level().is_some());
        kept.map(|(k, _)| (12 + k, by.column(k).into_owned())).collect()
    }

    fn rigid(&self, covariance: &DMatrix<f64>) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)> {
        if let Some(tool) = &self.tool {
            let (x, own) = tool.rigid(covariance)?;
            return Some((x.retract(&self.step), own + self.more));
        }
        let x = self.x.retract(&self.step);
        let own = match &self.model {
            // the sample of places is in `more`
            Some(model) => {
                model.projection.covariance(covariance).fixed_view::<6, 6>(0, 0) - model.sampling()
            }
            None => covariance.fixed_view::<6, 6>(0, 0).into_owned(),
        };
        Some((x, own + self.more))
    }
}
