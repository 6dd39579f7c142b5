//! What two streams leave open although a fit has found it: noise of the robot passes for motion.
//!
//! A robot that stands still leaves everything open, one that moves at a constant velocity the
//! offset of the clocks: the camera's place then goes along with it.

use nalgebra::{Matrix6, Vector6};

use super::{choose::Both, stream::Stream};
use crate::{
    Error, Session,
    calibrate::{
        flow::unknown,
        unknowns::settle::{Settled, Stand},
    },
    estimate::evaluate,
    math::{lie, linalg},
    model::residual::Residual,
    solve::{View, least_squares},
};

/// Scatter of poses that may be noise: twice what a poor robot reports at rest.
const MOST_AT_REST: Residual = Residual { angle: 0.02, distance: 5e-3 };
/// Scatter that is rest, whatever the camera sees.
const AT_REST: Residual = Residual { angle: 1e-3, distance: 1e-3 };
/// Motion is more than so many times the residual of the loops.
const ABOVE_NOISE: f64 = 3.0;

/// Scatter (root mean square) of a stream's poses about their mean.
fn scatter(stream: &Stream) -> Residual {
    let n = stream.poses.len().max(1) as f64;
    let rotation = linalg::mean_rotation(stream.poses.iter().map(|p| &p.rotation));
    let place = stream.poses.iter().map(|p| p.translation.vector).sum::<nalgebra::Vector3<f64>>();
    let place = place / n;
    let turn = |p: &nalgebra::Isometry3<f64>| lie::angle(&p.rotation, &rotation).powi(2);
    let turns: f64 = stream.poses.iter().map(turn).sum();
    let shifts: f64 =
        stream.poses.iter().map(|p| (p.translation.vector - place).norm_squared()).sum();
    Residual { angle: (turns / n).sqrt(), distance: (shifts / n).sqrt() }
}

/// Whether the robot does not move, or no more than the loops fail to close by.
pub(super) fn still(both: &Both, settled: Option<&Settled>) -> Option<Error> {
    let scatter = scatter(&both.robot);
    let noise = settled.is_some_and(|s| {
        let pair = |v: &View| Some(s.fit.hand_eye.loop_residual(&v.pair));
        let all: Vec<_> = s.views.iter().map(pair).collect();
        let found = evaluate::rms(&all);
        let (deg, mm) = (found.rotation_rms_deg, found.translation_rms_mm);
        let limit = |size: Option<f64>| ABOVE_NOISE * size.unwrap_or(0.0);
        let (angle, distance) = (limit(deg).to_radians(), limit(mm) * 1e-3);
        scatter.is_within(Residual { angle, distance })
    });
    let at_rest = if settled.is_some() {
        scatter.is_within(MOST_AT_REST) && noise || scatter.angle == 0.0 && scatter.distance == 0.0
    } else {
        scatter.is_within(AT_REST)
    };
    at_rest.then(|| Error::NotDetermined {
        what: format!(
            "the robot does not move: its poses differ by {:.3} degrees and {:.3} mm (RMS), no more \
             than noise; record both streams while it turns by 30 degrees and more about two axes, \
             and starts and stops",
            scatter.degrees(),
            scatter.millimetres()
        ),
    })
}

/// Standard deviations by which the clocks are moved to see whether that costs what it should.
const MOVED: f64 = 20.0;
/// Factor on the residual below which it costs nothing. By as many standard deviations it should be
/// 1.5 and more.
const COSTS: f64 = 1.2;
/// Squared distance, in units of its noise, beyond which a capture is wrong anyway.
const WRONG: f64 = 50.0;
/// Fewer captures in common tell nothing.
const FEWEST: usize = 6;

/// Whether the clocks may be moved against each other at no cost although the fit finds an offset,
/// the motion being steady: its standard deviation then comes from noise in the velocities.
pub(super) fn clock_is_free(both: &Both, chosen: &[usize], settled: &Settled) -> bool {
    let Some((_, sigma)) = unknown::clock(&settled.fit) else { return false };
    let Stand { offset, scale } = settled.stand;
    if !steady(&both.captures(chosen, offset, scale).velocities.unwrap_or_default()) {
        return false;
    }
    let right = |&k: &usize| {
        let found = both.captures(&[k], offset, scale).pairs.first().copied();
        let distance = |pair| settled.fit.distance(&View::bare(pair), both.setup);
        found.and_then(distance).is_some_and(|d2| d2 < WRONG)
    };
    let right: Vec<usize> = chosen.iter().copied().filter(right).collect();
    let Some(here) = cost(both, &right, settled, offset) else { return false };
    let by = both.apart().max(MOVED * sigma);
    [-by, by].into_iter().any(|by| {
        cost(both, &right, settled, offset + by).is_some_and(|there| there < COSTS * here)
    })
}

/// Whether velocities vary by less than their mean.
fn steady(velocities: &[Vector6<f64>]) -> bool {
    let n = velocities.len().max(1) as f64;
    let mean = velocities.iter().sum::<Vector6<f64>>() / n;
    let spread = velocities.iter().map(|v| (v - mean).norm_squared()).sum::<f64>() / n;
    spread < mean.norm_squared()
}

/// Mean squared distance of captures at an offset, in units of their noise, both poses being fitted
/// anew.
fn cost(both: &Both, chosen: &[usize], settled: &Settled, offset: f64) -> Option<f64> {
    let pairs = both.captures(chosen, offset, settled.stand.scale).pairs;
    if pairs.len() < FEWEST {
        return None;
    }
    let fit = &settled.fit;
    let views: Vec<View> = pairs.into_iter().map(View::bare).collect();
    let weight = |v: &View| {
        let noise = fit.noise.covariance(v, &fit.hand_eye, both.setup);
        linalg::invert_spd(&noise)
    };
    let weights: Vec<Matrix6<f64>> = views.iter().map(weight).collect::<Option<_>>()?;
    let at = least_squares::fit_weighted(&views, &weights, &fit.hand_eye);
    let one = |(v, w): (&View, &Matrix6<f64>)| {
        let r = least_squares::residual(&at, &v.pair);
        r.dot(&(w * r))
    };
    Some(views.iter().zip(&weights).map(one).sum::<f64>() / views.len() as f64)
}

/// The session with the mean velocity in place of each: what noise adds to them says nothing.
pub(super) fn steadied(mut session: Session) -> Session {
    let all = || session.observations.iter().filter_map(|o| o.velocity);
    let mean = all().sum::<Vector6<f64>>() / all().count().max(1) as f64;
    session.observations.iter_mut().for_each(|o| o.velocity = o.velocity.map(|_| mean));
    session
}
