//! Is it worth to correct the poses of a robot that errs by place?
//!
//! Only where captures say so that the correction has not seen: they are left out in blocks, once those that lie near
//! one another, once those that follow one another. Single ones do not tell it: their neighbours know their error.

use super::{
    arm::ArmFit,
    place::{Model, errors, metric, places, with_waves},
};
use crate::{
    Camera, Mount, Pose, Target,
    calibrate::{
        flow::views::Views,
        prediction::workpiece::inflation,
        result::{BlockGain, CompensationResult},
    },
    estimate::{
        ExtraKind, JointFit, KnownNoise, Problem, Source,
        compensation::{self, ByArm, Compensation, RobotErrors},
        joint,
        place::{Kernel, Place, Waves},
        projection::{self, Asked},
    },
};

/// Blocks that are left out in turn.
const BLOCKS: usize = 5;
/// A correction is offered where it takes away at least this part of what the rigid answer misses.
const WORTHWHILE: f64 = 0.1;

/// What the correction of a robot that errs by place is worth, and the correction where it is.
pub(crate) fn by_place(
    views: &Views,
    model: &Model,
    rigid: &Pose<Mount, Camera>,
    known: &KnownNoise,
) -> Option<CompensationResult> {
    let places = places(views, &[]);
    let metric = metric(views);
    let waves = Waves::fine(model.kernel, &self::places(views, &model.touches));
    let problem = with_waves((views, &model.touches), &model.plain, &waves);
    let fit = joint::refit(&problem, &model.fit, known);
    let gain = |blocks: Vec<Vec<usize>>| {
        let missed = |asked| {
            projection::missed_without(&problem, &fit, (asked, &metric), &blocks).map(|m| m * 1e3)
        };
        Some(BlockGain { rigid_mm: missed(Asked::Rigid)?, corrected_mm: missed(Asked::Whole)? })
    };
    let gains = Gains::of(&places, gain)?;
    let errors = errors(views, model.kernel, &waves, &fit);
    // errors by the joints cannot be told of a pose without the arm
    let applies = errors.arm.is_some() || matches!(model.kernel, Kernel::Pose { .. });
    let errors = RobotErrors::ByPlace(errors);
    let is_own = |kind: ExtraKind| kind.level().is_some();
    let offered = applies && gains.pay();
    let model = if offered { compensation(views, &fit, rigid, errors, is_own) } else { None };
    Some(gains.with(model))
}

/// The same of an arm that is not as its model says; `without` is the fit in which it is.
pub(crate) fn by_arm(
    views: &Views,
    arm: &ArmFit,
    without: (&Problem, &JointFit),
    rigid: &Pose<Mount, Camera>,
) -> Option<CompensationResult> {
    let (places, metric) = (places(views, &[]), metric(views));
    let gain = |blocks: Vec<Vec<usize>>| {
        let missed = |(problem, fit): (&Problem, &JointFit)| {
            let asked = (Asked::Whole, &metric);
            projection::missed_without(problem, fit, asked, &blocks).map(|m| m * 1e3)
        };
        let corrected_mm = missed((&arm.problem, &arm.fit))?;
        Some(BlockGain { rigid_mm: missed(without)?, corrected_mm })
    };
    let gains = Gains::of(&places, gain)?;
    let errors = RobotErrors::ByArm(ByArm {
        given: arm.model.clone(),
        corrected: arm.corrected.clone(),
        deviations: arm.which.clone(),
        seen: places,
    });
    let is_own = |kind: ExtraKind| matches!(kind, ExtraKind::Arm(_));
    let model =
        if gains.pay() { compensation(views, &arm.fit, rigid, errors, is_own) } else { None };
    Some(gains.with(model))
}

/// What captures miss that are left out in blocks.
struct Gains {
    by_place: BlockGain,
    by_time: BlockGain,
}

impl Gains {
    fn of(places: &[Place], gain: impl Fn(Vec<Vec<usize>>) -> Option<BlockGain>) -> Option<Self> {
        Some(Self { by_place: gain(near(places))?, by_time: gain(in_turn(places.len()))? })
    }

    fn pay(&self) -> bool {
        let pays = |g: &BlockGain| g.corrected_mm < (1.0 - WORTHWHILE) * g.rigid_mm;
        pays(&self.by_place) && pays(&self.by_time)
    }

    fn with(self, model: Option<Compensation>) -> CompensationResult {
        CompensationResult { by_place: self.by_place, by_time: self.by_time, model }
    }
}

/// `errors` are made of those extras that are `own`.
fn compensation(
    views: &Views,
    fit: &JointFit,
    rigid: &Pose<Mount, Camera>,
    errors: RobotErrors,
    is_own: impl Fn(ExtraKind) -> bool,
) -> Option<Compensation> {
    let own = (0..fit.extras.len()).filter(|&k| is_own(fit.extras[k].kind)).map(|k| 12 + k);
    let kept: Vec<usize> = (0..6).chain(own).collect();
    let covariance = fit.covariance.as_ref()? * inflation(fit)?;
    let covariance = covariance.select_rows(&kept).select_columns(&kept);
    let sigma = |source| fit.noise.sigma(source).unwrap_or(0.0);
    let back: Pose<Target, Target> = views.target_from_corner.inverse();
    Some(Compensation {
        setup: views.session.setup,
        rigid: *rigid,
        mount_from_camera: fit.hand_eye.mount_from_camera,
        anchor_from_target: fit.hand_eye.anchor_from_target * back,
        errors,
        covariance: compensation::triangle(&covariance),
        robot: [sigma(Source::RobotRotation), sigma(Source::RobotPosition)],
    })
}

/// Over how much captures are near one another: that of the middle one of the lengths that errors change over.
const NEAR: Kernel = Kernel::OF_POSES[1];

/// Captures that lie near one another.
fn near(places: &[Place]) -> Vec<Vec<usize>> {
    let n = places.len();
    let far = |i: usize, j: usize| 1.0 - NEAR.at(&places[i], &places[j]);
    let sum = |i: usize| (0..n).map(|j| far(i, j)).sum::<f64>();
    let most = |of: &dyn Fn(usize) -> f64| (0..n).max_by(|&i, &j| of(i).total_cmp(&of(j)));
    let mut middles: Vec<usize> = most(&sum).into_iter().collect();
    while middles.len() < BLOCKS.min(n) {
        let nearest = |i: usize| middles.iter().map(|&m| far(i, m)).fold(f64::INFINITY, f64::min);
        middles.extend(most(&nearest));
    }
    let mut blocks = vec![vec![]; middles.len()];
    for i in 0..n {
        let near =
            (0..middles.len()).min_by(|&a, &b| far(i, middles[a]).total_cmp(&far(i, middles[b])));
        if let Some(k) = near {
            blocks[k].push(i);
        }
    }
    blocks
}

/// Captures that follow one another.
fn in_turn(n: usize) -> Vec<Vec<usize>> {
    (0..BLOCKS).map(|k| (k * n / BLOCKS..(k + 1) * n / BLOCKS).collect()).collect()
}
