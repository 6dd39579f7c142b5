//! Does the robot err by place? Then no rigid answer is right everywhere, and what captures of one place share counts
//! once.
//!
//! The fit is repeated with errors by place among its unknowns ([`crate::estimate::place`]), for several lengths over
//! which they change; they are part of the model where the likelihood gains clearly. The answer is then the rigid one
//! that fits best where the captures are ([`crate::estimate::projection`]), and what it misses there is part of its
//! predicted error. Which model is right remains open: answer and covariance are those of the mixture of all, weighted
//! by their likelihood, independent errors among them. Where the gain is small that is all: nothing is said of the robot.

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

use super::{
    alike::WAY_OF_A_TURN,
    joint::WRONG_TIP_PRIOR,
    reach::{Erring, Nearest, Reach, ToolReach},
    workpiece::inflation,
};
use crate::{
    Base, Camera, Flange, HandEye, Mount, Point, Pose, Setup, Target, Workspace,
    calibrate::{config::Config, limits::MOST_PREDICTED_MM, result::BlockGain, views::Views},
    estimate::{
        ExtraKind, JointFit, Problem, Source,
        compensation::ByPlace as Errors,
        extra::TIP_PRIOR,
        joint,
        place::{self, Kernel, Place, Waves},
        predict::Volume,
        projection::{self, Projection},
    },
    findings::RobotFinding,
    register::rigid_fit::point_jacobian,
};

/// Fewest captures from which errors by place are told from noise.
const FEWEST_VIEWS: usize = 8;
/// Gain of the logarithm of the likelihood that errors by place must bring from many captures: their two levels gain as
/// much by chance in one of two hundred sets, and there are several lengths over which errors may change.
const GAIN: f64 = 4.0;
/// So few captures double it: there the noise itself is hardly known, and chance gains more.
const FEW_FOR_GAIN: f64 = 10.0;
/// Gain from which answer and stated error allow for them, whether or not the robot is said to have them.
const NOTICED: f64 = 0.1;
/// So many of the lengths over which errors may change are fitted, those that promise most.
const MOST_FITTED: usize = 2;
/// Half the size of a target of unknown size, m: an error of the robot's rotation moves its points by so much times the
/// angle.
const HALF_SIZE: f64 = 0.07;

/// A robot that may err by place.
pub(super) struct ByPlace {
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
    /// What touches say of the way that its tool goes.
    tool: Option<ToolReach>,
}

/// A fit with errors by place.
pub(super) struct Model {
    pub kernel: Kernel,
    /// The problem without such errors.
    pub plain: Problem,
    pub problem: Problem,
    /// The touches behind the problem's boards, in their order.
    pub touches: Vec<usize>,
    pub fit: JointFit,
    errors: Errors,
    projection: Projection,
    /// By how much the logarithm of the likelihood gains.
    gain: f64,
}

/// One model's say about the camera's pose.
struct Say {
    log_weight: f64,
    x: Pose<Mount, Camera>,
    covariance: Matrix6<f64>,
    missed: f64,
}

/// Looks whether the robot errs by place; `None` where nothing speaks for it. `touches` are those behind the problem's
/// boards, in their order: they say where the tool goes in the `volume`.
pub(super) fn look(
    views: &Views,
    (problem, fit): (&Problem, &JointFit),
    touches: &[usize],
    volume: &Volume,
    config: &Config,
) -> Option<ByPlace> {
    let metric = metric(views);
    let told = touches.iter().all(|&k| views.session.touches[k].base_from_flange.is_some());
    // of a robot in motion, errors of place and of time are one
    let moves = views.used.iter().any(|o| o.velocity.is_some());
    if problem.views.len() < FEWEST_VIEWS || !told || moves || !determines(fit, &metric) {
        return None;
    }
    let look = Look { views, touches, volume, config, metric };
    let without = look.without(problem, fit);
    let levels = without.iter().map(|(_, fit)| fit.log_likelihood);
    let bar = levels.fold(fit.log_likelihood, f64::max);
    let (models, tried) = look.models(&without, bar);
    let best = (0..models.len()).max_by(|&a, &b| models[a].gain.total_cmp(&models[b].gain))?;
    if models[best].gain < NOTICED {
        return None;
    }
    let unpromising = (tried - models.len()) as f64 / tried as f64;
    let independent = Say {
        // what promised too little to be fitted counts as independent errors
        log_weight: (1.0 + unpromising).ln(),
        x: fit.hand_eye.mount_from_camera,
        covariance: fit.covariance.as_ref()?.fixed_view::<6, 6>(0, 0) * inflation(fit)?,
        missed: 0.0,
    };
    let weight = |m: &Model| m.gain - (tried as f64).ln();
    let say = |m: &Model| Some(Say { log_weight: weight(m), ..look.say(m)? });
    let says = std::iter::once(Some(independent)).chain(models.iter().map(say));
    let says: Vec<Say> = says.collect::<Option<_>>()?;
    let setup = views.session.setup;
    if models[best].gain < GAIN * (1.0 + FEW_FOR_GAIN / problem.views.len() as f64) {
        let Together { step, more, missed, share } = Together::of(&says, 0, &says[0].covariance);
        let (x, model, tool) = (says[0].x, None, None);
        return Some(ByPlace { x, model, step, more, missed, share, setup, tool });
    }
    let tool = look.tool(&models[best]);
    let own = match &tool {
        Some(_) => says[best + 1].covariance,
        None => models[best].without_sampling()?,
    };
    let Together { step, more, missed, share } = Together::of(&says, best + 1, &own);
    let model = models.into_iter().nth(best)?;
    let x = model.fit.hand_eye.mount_from_camera;
    let step = match tool {
        Some(_) => step,
        None => model.projection.step.fixed_rows::<6>(0) + step,
    };
    Some(ByPlace { x, model: Some(model), step, more, missed, share, setup, tool })
}

/// What errors by place are looked for in.
struct Look<'a> {
    views: &'a Views<'a>,
    touches: &'a [usize],
    volume: &'a Volume,
    config: &'a Config,
    metric: Matrix6<f64>,
}

impl Look<'_> {
    /// The problem without errors by place, and without what stands for them: a systematic difference between views and
    /// touches, a tip that is elsewhere.
    fn without(&self, problem: &Problem, fit: &JointFit) -> Vec<(Problem, JointFit)> {
        if self.touches.is_empty() {
            return vec![(problem.clone(), fit.clone())];
        }
        let plain = problem.without_systematic();
        let believed = plain.with_tip(self.config.known.tip_m.unwrap_or(TIP_PRIOR));
        let both = [Some(plain), believed].into_iter().flatten();
        let refitted = |p: Problem| {
            let fit = joint::refit(&p, fit, &self.config.known);
            (p, fit)
        };
        both.map(refitted).collect()
    }

    /// Fits with errors over the lengths that promise most, and how many lengths there are; gains are over `bar`.
    fn models(&self, without: &[(Problem, JointFit)], bar: f64) -> (Vec<Model>, usize) {
        let places = places(self.views, self.touches);
        let jointed = places.iter().all(Place::has_joints);
        let kernels = Kernel::OF_POSES.into_iter().chain(jointed.then_some(Kernel::OF_JOINTS));
        let kernels: Vec<Kernel> = kernels.collect();
        let promise = |kernel: &Kernel, plain: &(Problem, JointFit)| {
            let waves = Waves::new(*kernel, &places);
            let wider = with_waves((self.views, self.touches), &plain.0, &waves);
            let expected = place::expected_gain(&wider, &plain.1)?;
            (expected > NOTICED).then_some((expected, (*kernel, waves, wider)))
        };
        let of = |plain: &(Problem, JointFit)| {
            let mut promising: Vec<_> =
                kernels.iter().filter_map(|kernel| promise(kernel, plain)).collect();
            promising.sort_by(|a, b| b.0.total_cmp(&a.0));
            let promising = promising.into_iter().take(MOST_FITTED);
            let fitted = promising.filter_map(|(_, wider)| self.model(wider, plain, bar));
            fitted.collect::<Vec<_>>()
        };
        (without.iter().flat_map(of).collect(), kernels.len() * without.len())
    }

    fn model(
        &self,
        (kernel, waves, problem): (Kernel, Waves, Problem),
        (plain, near): &(Problem, JointFit),
        bar: f64,
    ) -> Option<Model> {
        let fit = joint::refit(&problem, near, &self.config.known);
        let at = work(self.views, &near.hand_eye);
        let projection = Projection::new((&problem, &fit), &fit.values, &self.metric, &at)?;
        let gain = fit.log_likelihood - bar;
        let errors = errors(self.views, kernel, &waves, &fit);
        let (plain, touches) = (plain.clone(), self.touches.to_vec());
        Some(Model { kernel, plain, problem, touches, fit, errors, projection, gain })
    }

    /// Where touches say how the tool is held: the way that it goes.
    fn tool(&self, model: &Model) -> Option<ToolReach> {
        if self.touches.is_empty() { None } else { ToolReach::new(self.views, model, self.volume) }
    }

    fn say(&self, model: &Model) -> Option<Say> {
        let Some(tool) = self.tool(model) else { return model.say(&self.metric) };
        let covariance = model.fit.covariance.as_ref()? * inflation(&model.fit)?;
        let Nearest { x, covariance, variance, .. } = tool.answer(&covariance)?;
        let once = model.projection.missed_once(&model.fit, &self.metric) - model.projection.missed;
        let missed = variance / poses(self.views.session.setup) + once;
        Some(Say { log_weight: 0.0, x, covariance, missed })
    }
}

impl Erring for Model {
    fn fit(&self) -> &JointFit {
        &self.fit
    }

    fn is_own(&self, kind: ExtraKind) -> bool {
        kind.level().is_some()
    }

    fn learns_tip(&self) -> bool {
        self.problem.tip_prior() == Some(WRONG_TIP_PRIOR)
    }

    fn says(&self, at: &Place) -> Pose<Base, Flange> {
        at.base_from_flange
    }

    fn really(&self, at: &Place) -> Pose<Base, Flange> {
        at.base_from_flange.retract(&self.errors.at(at))
    }

    /// To first order: errors hardly differ within themselves.
    fn reaching(&self, flange: &Pose<Base, Flange>, near: &Place) -> Option<Place> {
        let joints = match &self.errors.arm {
            Some(arm) => arm.inverse(flange, &near.joints)?,
            None => near.joints.clone(),
        };
        let there = Place { base_from_flange: *flange, joints, ..near.clone() };
        let says = flange.retract(&-self.errors.at(&there));
        Some(Place { base_from_flange: says, ..there })
    }

    fn by_own(&self, at: &Place) -> DMatrix<f64> {
        self.errors.by_unknowns(at).unknowns
    }

    fn rest(&self, at: &Place) -> [f64; 2] {
        self.errors.by_unknowns(at).rest()
    }
}

impl Model {
    /// What it says of the rigid answer.
    fn say(&self, metric: &Matrix6<f64>) -> Option<Say> {
        let x = self.fit.hand_eye.mount_from_camera;
        let covariance = self.fit.covariance.as_ref()? * inflation(&self.fit)?;
        Some(Say {
            log_weight: 0.0,
            x: x.retract(&self.projection.step.fixed_rows::<6>(0).into_owned()),
            covariance: self.projection.covariance(&covariance).fixed_view::<6, 6>(0, 0).into(),
            missed: self.projection.missed_once(&self.fit, metric),
        })
    }

    fn sampling(&self) -> Matrix6<f64> {
        self.projection.sampling.fixed_view::<6, 6>(0, 0).into()
    }

    /// Covariance of its answer, but for the sample of places.
    fn without_sampling(&self) -> Option<Matrix6<f64>> {
        let covariance = self.fit.covariance.as_ref()? * inflation(&self.fit)?;
        let all = self.projection.covariance(&covariance);
        Some(all.fixed_view::<6, 6>(0, 0) - self.sampling())
    }
}

/// Several models' say, beside that of one of them.
struct Together {
    /// From its answer to the mean of all.
    step: Vector6<f64>,
    /// What all are less certain of than it.
    more: Matrix6<f64>,
    missed: f64,
    /// Weight of all but the first.
    share: f64,
}

impl Together {
    /// Mean and covariance of the mixture, beside the `base`, which counts with this covariance elsewhere.
    fn of(says: &[Say], base: usize, own: &Matrix6<f64>) -> Self {
        let most = says.iter().map(|s| s.log_weight).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = says.iter().map(|s| (s.log_weight - most).exp()).sum();
        let weights = says.iter().map(|s| (s.log_weight - most).exp() / sum);
        let (mut mean, mut second, mut covariance) =
            (Vector6::zeros(), Matrix6::zeros(), Matrix6::zeros());
        let mut missed = 0.0;
        for (say, weight) in says.iter().zip(weights) {
            let d = says[base].x.local(&say.x);
            mean += d * weight;
            second += d * d.transpose() * weight;
            covariance += say.covariance * weight;
            missed += say.missed * weight;
        }
        let more = at_least_nothing(&(covariance - own));
        let share = 1.0 - (says[0].log_weight - most).exp() / sum;
        Self { step: mean, more: more + second - mean * mean.transpose(), missed, share }
    }
}

/// The part of a symmetric matrix that adds.
fn at_least_nothing(m: &Matrix6<f64>) -> Matrix6<f64> {
    // rotations and positions are of different size
    let scale = Matrix6::from_diagonal(
        &Vector6::new(1.0, 1.0, 1.0, WAY_OF_A_TURN, WAY_OF_A_TURN, WAY_OF_A_TURN).map(f64::recip),
    );
    let eigen = (scale * m * scale).symmetric_eigen();
    let values = Matrix6::from_diagonal(&eigen.eigenvalues.map(|v| v.max(0.0)));
    let back = scale.map(|x| if x == 0.0 { 0.0 } else { x.recip() });
    back * (eigen.eigenvectors * values * eigen.eigenvectors.transpose()) * back
}

/// Whether the target is found to within an error that could be accepted: what hardly determines an answer tells
/// nothing of the places.
fn determines(fit: &JointFit, metric: &Matrix6<f64>) -> bool {
    let Some(covariance) = &fit.covariance else { return false };
    let square = (metric * covariance.fixed_view::<6, 6>(6, 6)).trace();
    square.sqrt() * 1e3 < MOST_PREDICTED_MM
}

/// Where the robot is in captures, then in touches.
pub(super) fn places(views: &Views, touches: &[usize]) -> Vec<Place> {
    let captured = views.used.iter().map(|o| Place::new(&o.base_from_flange, &o.joints));
    let touched = touches.iter().map(|&k| &views.session.touches[k]);
    let touched =
        touched.filter_map(|t| Some(Place::new(&t.base_from_flange?, &t.joints).touching()));
    captured.chain(touched).collect()
}

/// The problem with the strengths of the waves over its [`places`] among its unknowns.
pub(super) fn with_waves(
    (views, touches): (&Views, &[usize]),
    problem: &Problem,
    waves: &Waves,
) -> Problem {
    let setup = views.session.setup;
    let mut wider = problem.clone();
    let mut rows = waves.at.row_iter().map(|row| row.transpose());
    for ((view, o), row) in wider.views.iter_mut().zip(&views.used).zip(&mut rows) {
        view.by_robot = Some(place::of_view(setup, &o.base_from_flange, &row).into());
    }
    let corners = wider.boards.iter_mut().flat_map(|b| &mut b.corners);
    for ((corner, &k), row) in corners.zip(touches).zip(rows) {
        corner.by_robot = views.session.touches[k]
            .base_from_flange
            .map(|flange| place::of_view(Setup::EyeInHand, &flange, &row).into());
    }
    wider.extras.extend(waves.extras(0));
    wider
}

/// Errors by place as a fit has them.
pub(super) fn errors(views: &Views, kernel: Kernel, waves: &Waves, fit: &JointFit) -> Errors {
    let arm = match kernel {
        Kernel::Joints(_) => views.session.arm.clone(),
        Kernel::Pose { .. } => None,
    };
    let own: Vec<f64> = (0..fit.extras.len())
        .filter(|&k| fit.extras[k].kind.level().is_some())
        .map(|k| fit.values[k])
        .collect();
    let sigma = |source| fit.noise.sigma(source).unwrap_or(0.0);
    Errors {
        kernel,
        waves: waves.by_about.row_iter().map(|row| row.iter().copied().collect()).collect(),
        about: waves.about.clone(),
        strengths: own.chunks_exact(6).map(|six| std::array::from_fn(|k| six[k])).collect(),
        level: [sigma(Source::PlaceRotation), sigma(Source::PlacePosition)],
        arm,
    }
}

/// How many poses of the robot are in the way of one point: a camera on the flange looks from one, and the tool goes to
/// another one.
pub(super) fn poses(setup: Setup) -> f64 {
    match setup {
        Setup::EyeInHand => 2.0,
        Setup::EyeToHand => 1.0,
    }
}

/// What a residual costs: the mean square over points of the target.
pub(super) fn metric(views: &Views) -> Matrix6<f64> {
    projection::metric(&points(views))
}

/// Fewest captures in a workspace that stand for the poses in it.
const FEWEST_AT_WORK: usize = 8;

/// The captures that are like the robot's work: those whose target lies in the workspace where one is given and enough of
/// them do, else all.
pub(super) fn work(views: &Views, hand_eye: &HandEye) -> Vec<usize> {
    let all: Vec<usize> = (0..views.views.len()).collect();
    let Some(Workspace { minimum, maximum }) = &views.session.workspace else { return all };
    let points = points(views);
    let middle = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let is_inside = |i: &usize| {
        let pair = &views.views[*i].pair;
        let seen = pair.camera_from_target * Point::from_vector(middle);
        let at = match views.session.setup {
            Setup::EyeToHand => (hand_eye.mount_from_camera * seen).vector(),
            Setup::EyeInHand => seen.vector(),
        };
        (0..3).all(|k| minimum[k] <= at[k] && at[k] <= maximum[k])
    };
    let inside: Vec<usize> = all.iter().copied().filter(is_inside).collect();
    if inside.len() < FEWEST_AT_WORK { all } else { inside }
}

/// Points of the target, about the origin of the residuals.
fn points(views: &Views) -> Vec<Vector3<f64>> {
    match &views.session.target {
        Some(target) => {
            let back = views.target_from_corner.inverse();
            let own = |c: &Point<Target>| (back * *c).vector();
            target.corners().iter().map(own).collect()
        }
        None => {
            let sides = [-HALF_SIZE, HALF_SIZE];
            let edges = sides.iter().flat_map(|x| sides.map(|y| (*x, y)));
            edges.flat_map(|(x, y)| sides.map(|z| Vector3::new(x, y, z))).collect()
        }
    }
}

impl ByPlace {
    /// Whether a tip that is elsewhere was an error by place.
    pub(super) fn explains_tip(&self, given: &Problem) -> bool {
        let model = self.model.as_ref();
        model.is_some_and(|m| m.problem.tip_prior() != given.tip_prior())
    }

    /// That it does, by how much, and what is left where its poses are corrected; `None` where that is open.
    pub(super) fn finding(&self, corrected: Option<BlockGain>) -> Option<RobotFinding> {
        let model = self.model.as_ref()?;
        let sigma = |source| model.fit.noise.sigma(source).unwrap_or(0.0);
        Some(RobotFinding::ErrsByPlace {
            position_mm: 3f64.sqrt() * sigma(Source::PlacePosition) * 1e3,
            rotation_deg: 3f64.sqrt() * sigma(Source::PlaceRotation).to_degrees(),
            missed_mm: (3.0 * model.projection.missed).sqrt() * 1e3,
            gain: model.gain,
            corrected: corrected.map(|c| (c.corrected_mm, c.rigid_mm)),
        })
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
        // a tool's own way says what is missed at each point
        let missed = if self.tool.is_some() { 0.0 } else { poses(self.setup) * self.missed };
        j * self.more * j.transpose() + Matrix3::identity() * missed + of_tool
    }

    fn share_of_noise(&self) -> f64 {
        // what touches say of the tool is no noise
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
