//! Rounds of matching and stepping, from a start down to the nearest answer.
//!
//! Windows of the source, moved by the current transform, are compared with those of the target: those that
//! its camera sees in the same direction, or the nearest ones. Residuals are taken along the mean of both
//! normals,
//!
//! ```text
//! r = m · (R p + t - q)    J = [½ (R p + t + q) × m, m]    with m = ½ (R n_p + n_q)
//! ```
//!
//! With both normals, a match that is off along the surface does no harm to second order. Each is weighed
//! by the variance of both means across the surface, and those beyond some standard deviations do not
//! count (Tukey). A table would soon pull that limit below the residual of the few things upon it, and
//! they would never count again: so the limit begins at the gate, and narrows from round to round.
//!
//! S. Rusinkiewicz, *A symmetric objective function for ICP*, ACM Trans. Graph. 38(4), 2019.

use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, Matrix6, Translation3, UnitQuaternion, Vector3, Vector6};

use super::{
    icp::Stop,
    pair::{LEAST, Match, jacobian},
    patch::Patch,
    surface::Surface,
};
use crate::{
    Error,
    math::{linalg, parallel, statistics::SIGMAS_OF_MAD},
    register::options::{DenseConfig, DenseMethod},
};

/// Normals of a match are within 30 degrees.
const COSINE: f64 = 0.866;
/// Beyond so many standard deviations residuals do not count.
const TUKEY: f64 = 4.685;
/// Residuals that are less, over what their scatter promises, are not of two scans, but of one and its copy.
pub const LEAST_SIGMA: f64 = 0.1;
/// A round narrows the limit of residuals to this share.
const NARROWER: f64 = 0.6;
/// A round that moves by less than this share of the answer's standard deviation is the last.
const SETTLED: f64 = 0.02;
/// Rounds over some windows end earlier.
const SETTLED_SOME: f64 = 0.5;
/// Steps shorter than this many standard deviations may be noise.
const NEAR: f64 = 1.0;
/// Fewer matches are none.
pub const FEWEST: f64 = 20.0;
/// Windows that a thread works on at once.
const CHUNK: usize = 4096;
/// Windows stay matched while none moves by more than this share of the spread of one.
const MATCHED: f64 = 0.15;
/// Share of the information in all directions that single precision may feign in one.
const ROUNDED: f64 = 1e-9;
/// Windows that are looked at before all are.
const COARSE: f64 = 1500.0;
/// From nearby, windows are matched within so many times the spread of one.
const NEARBY: f64 = 3.0;
/// Among all windows none is matched farther away than this many times the spread of one.
const FINE: f64 = 1.5;
/// No window.
const NOWHERE: u32 = u32::MAX;

/// Where a descent is.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    pub target_from_source: Isometry3<f64>,
    pub iterations: usize,
    pub stop: Stop,
    /// Windows that count, and all.
    pub inliers: f64,
    pub all: f64,
    /// RMS distance across the surface, of those that count, m.
    pub rms_m: f64,
}

impl Reached {
    pub fn start(target_from_source: &Isometry3<f64>) -> Self {
        Self {
            target_from_source: *target_from_source,
            iterations: 0,
            stop: Stop::MaxIterations,
            inliers: 0.0,
            all: 0.0,
            rms_m: 0.0,
        }
    }
}

/// Turned about `middle` of the target, then shifted.
pub fn moved(at: &Isometry3<f64>, step: &Vector6<f64>, middle: &Vector3<f64>) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(step[0], step[1], step[2]));
    let shift = Vector3::new(step[3], step[4], step[5]);
    let t = turn * (at.translation.vector - middle) + middle + shift;
    Isometry3::from_parts(Translation3::from(t), turn * at.rotation)
}

/// Exact planes say nothing at all of some directions: there a step is short.
fn held(information: &Matrix6<f64>) -> Matrix6<f64> {
    information + Matrix6::from_diagonal(&nothing(information))
}

/// Information, of turns and of shifts, that is rounding.
pub fn nothing(information: &Matrix6<f64>) -> Vector6<f64> {
    let of = |k| information.fixed_view::<3, 3>(k, k).trace() * ROUNDED + f64::MIN_POSITIVE;
    let (turn, shift) = (of(0), of(3));
    Vector6::new(turn, turn, turn, shift, shift, shift)
}

/// Two surfaces, and the state of the rounds between them.
pub struct Descent<'a> {
    pub source: &'a Surface,
    pub target: &'a Surface,
    pub config: &'a DenseConfig,
    /// Matches farther apart do not count, m.
    gate: f64,
    /// Nor do residuals beyond this, m, where it is more than the limit by their deviations.
    width: f64,
    /// Standard deviation of residuals over that which their scatter promises.
    pub sigma: f64,
    /// Windows of the source that are looked at.
    looked_at: Vec<u32>,
    matches: Option<Matches>,
    /// Steps are kept to these columns, where not all directions are determined.
    pub along: Option<Matrix6<f64>>,
}

/// Which window of the target belongs to each of the source. Small steps do not change that.
struct Matches {
    /// Where the source was.
    at: Isometry3<f64>,
    /// Number of the target's window for each that is looked at.
    places: Vec<u32>,
}

/// Normal equations over matches, in the target frame.
struct Totals {
    information: Matrix6<f64>,
    gradient: Vector6<f64>,
    /// Lengths, over their standard deviations.
    residuals: Vec<f32>,
    /// Of those that count, m².
    squares: f64,
    inliers: f64,
    /// Windows looked at.
    all: f64,
}

impl<'a> Descent<'a> {
    pub fn new(source: &'a Surface, target: &'a Surface, config: &'a DenseConfig) -> Self {
        Self {
            source,
            target,
            config,
            gate: 0.0,
            width: 0.0,
            sigma: f64::INFINITY,
            looked_at: vec![],
            matches: None,
            along: None,
        }
    }

    /// Over some windows, residuals limited by the gate at first.
    ///
    /// # Errors
    /// [`Error::TooFewPoints`], [`Error::NotDetermined`].
    pub(crate) fn coarse(
        &mut self,
        reached: &mut Reached,
        gate: f64,
        stride: usize,
    ) -> Result<(), Error> {
        // means of windows lie apart along the surface, however near both are to each other
        (self.gate, self.width) = (gate.max(FINE * self.target.spread), gate);
        self.look_at(stride);
        self.descend(reached, SETTLED_SOME)
    }

    /// Over some windows.
    pub(crate) fn afar(&mut self, reached: &mut Reached, gate: f64) -> Result<(), Error> {
        self.coarse(reached, gate, self.source.stride(COARSE))
    }

    /// Over some windows, from nearby.
    pub(crate) fn nearby(&mut self, reached: &mut Reached) -> Result<(), Error> {
        self.afar(reached, NEARBY * self.source.spread)
    }

    /// Over all windows, from nearby.
    pub fn fine(&mut self, reached: &mut Reached) -> Result<(), Error> {
        (self.gate, self.width) = (FINE * self.target.spread, 0.0);
        self.look_at(1);
        self.descend(reached, SETTLED)
    }

    /// Matches among about so many windows, at a place that is nearly right; they are matched anew.
    pub(crate) fn each_nearby(&mut self, at: &Isometry3<f64>, count: f64, with: impl FnMut(Match)) {
        self.gate = NEARBY * self.source.spread;
        self.look_at(self.source.stride(count));
        self.match_all(at);
        self.each_match(at, 0..self.looked_at.len(), with);
    }

    /// At windows in every so manieth row and column.
    fn look_at(&mut self, stride: usize) {
        self.looked_at = self.source.every(stride);
        self.matches = None;
    }

    /// Rounds until steps are shorter than this share of the answer's standard deviation.
    fn descend(&mut self, reached: &mut Reached, settled: f64) -> Result<(), Error> {
        let mut last = f64::INFINITY;
        reached.stop = Stop::MaxIterations;
        for _ in 0..self.config.max_iterations {
            reached.iterations += 1;
            self.match_all(&reached.target_from_source);
            let sums = self.sums(&reached.target_from_source);
            if sums.inliers < FEWEST {
                return Err(Error::TooFewPoints {
                    found: sums.inliers as usize,
                    needed: FEWEST as usize,
                });
            }
            let usual = linalg::median(sums.residuals.iter().map(|r| f64::from(*r)));
            self.sigma = (SIGMAS_OF_MAD * usual).max(LEAST_SIGMA);
            let step = self.step(&sums)?;
            let (before, rms) = (reached.target_from_source, reached.rms_m);
            let middle = self.middle(&before);
            reached.target_from_source = moved(&reached.target_from_source, &step, &middle);
            (reached.inliers, reached.all) = (sums.inliers, sums.all);
            reached.rms_m = (sums.squares / sums.inliers).sqrt();
            if self.width > 0.0 {
                let weight = sums.information.fixed_view::<3, 3>(3, 3).trace();
                let usual = (sums.inliers / weight).sqrt();
                self.width *= NARROWER;
                if self.width < TUKEY * usual {
                    self.width = 0.0;
                }
                continue;
            }
            let length = step.dot(&(sums.information * step)).sqrt();
            // matches come and go for ever: once all is near, steps that do not shrink are their noise
            let noise = length < NEAR * self.sigma && length > 0.5 * last;
            let small = self.source.moved(&before, &reached.target_from_source)
                <= self.config.transformation_epsilon_m;
            if length <= settled * self.sigma || noise || small {
                reached.stop = Stop::Converged;
                break;
            }
            if (reached.rms_m - rms).abs() <= self.config.fitness_epsilon * rms {
                reached.stop = Stop::Fitness;
                break;
            }
            last = length;
        }
        Ok(())
    }

    fn step(&self, sums: &Totals) -> Result<Vector6<f64>, Error> {
        let free = || Error::NotDetermined {
            what: "the overlap does not constrain all directions".into(),
        };
        match &self.along {
            None => {
                let inverse = linalg::invert_spd(&held(&sums.information)).ok_or_else(free)?;
                Ok(-inverse * sums.gradient)
            }
            Some(along) => {
                // within the directions that are left, the others stay
                let mut within = along.transpose() * held(&sums.information) * along;
                for k in 0..6 {
                    if along.column(k).norm_squared() == 0.0 {
                        within[(k, k)] = 1.0;
                    }
                }
                let inverse = linalg::invert_spd(&within).ok_or_else(free)?;
                Ok(-along * inverse * along.transpose() * sums.gradient)
            }
        }
    }

    /// The middle of the source, about which it is turned.
    pub fn middle(&self, at: &Isometry3<f64>) -> Vector3<f64> {
        at.transform_point(&self.source.middle.into()).coords
    }

    /// In chunks, by all threads.
    pub fn chunks<T: Send>(&self, work: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
        let count = self.looked_at.len();
        parallel::in_order(count.div_ceil(CHUNK), self.config.threads, |k| {
            work(CHUNK * k..count.min(CHUNK * (k + 1)))
        })
    }

    /// Looks for the windows that belong together, unless they are known from a place nearby.
    fn match_all(&mut self, at: &Isometry3<f64>) {
        let reach = MATCHED * self.target.spread;
        if let Some(last) = &self.matches
            && self.source.moved(at, &last.at) <= reach
        {
            return;
        }
        let (r, t) = (at.rotation.to_rotation_matrix().into_inner(), at.translation.vector);
        let place = |k: &u32| {
            let own = self.source.patches[*k as usize].as_ref();
            own.and_then(|own| self.target.find(&(r * own.mean + t), self.gate))
                .map_or(NOWHERE, |k| k as u32)
        };
        let chunk = |range: Range<usize>| self.looked_at[range].iter().map(place).collect();
        let places = self.chunks::<Vec<u32>>(chunk).concat();
        self.matches = Some(Matches { at: *at, places });
    }

    fn sums(&self, at: &Isometry3<f64>) -> Totals {
        let mut total = Totals::none();
        for part in self.chunks(|range| self.part(at, range)) {
            total.information += part.information;
            total.gradient += part.gradient;
            total.residuals.extend(part.residuals);
            total.squares += part.squares;
            total.inliers += part.inliers;
            total.all += part.all;
        }
        total.information.fill_lower_triangle_with_upper_triangle();
        total
    }

    fn part(&self, at: &Isometry3<f64>, range: Range<usize>) -> Totals {
        let mut total = Totals::none();
        let is_along =
            matches!(self.config.method, DenseMethod::Symmetric | DenseMethod::PointToPlane);
        total.all = self.each_match(at, range, |found| {
            let residual = found.residual();
            if !is_along {
                return self.add_whole(&found, residual, &mut total);
            }
            let deviation = found.variance.sqrt();
            total.residuals.push((residual.abs() / deviation) as f32);
            let share = residual.abs() / self.limit(deviation);
            if share < 1.0 {
                let weight = (1.0 - share * share).powi(2) / found.variance;
                total.count(residual);
                total.add(&found.jacobian(), residual, weight);
            }
        });
        total
    }

    /// Of a match of which differences along the surface count as well.
    fn add_whole(&self, found: &Match, residual: f64, total: &mut Totals) {
        let covariance = match self.config.method {
            DenseMethod::PointToPoint => {
                Matrix3::identity() * (found.own.along + found.other.along)
            }
            _ => found.covariance(&(found.m * 2.0 - found.other.normal)),
        };
        let Some(rows) = found.whitened(&covariance) else { return };
        let lengths = rows.map(|row| row.dot(&found.apart));
        let length = Vector3::from(lengths).norm();
        total.residuals.push(length as f32);
        let mut share = length / (TUKEY * self.sigma);
        if self.width > 0.0 {
            share = share.min(residual.abs() / self.width);
        }
        if share < 1.0 {
            let weight = (1.0 - share * share).powi(2);
            total.count(residual);
            for (row, length) in rows.iter().zip(lengths) {
                total.add(&jacobian(&found.arm, row), length, weight);
            }
        }
    }

    /// Residuals beyond do not count.
    #[inline(always)]
    pub fn limit(&self, deviation: f64) -> f64 {
        (TUKEY * self.sigma * deviation).max(self.width)
    }

    /// All matches among some windows; returns how many windows there are.
    #[inline(always)]
    pub(crate) fn each_match(
        &self,
        at: &Isometry3<f64>,
        range: Range<usize>,
        mut with: impl FnMut(Match),
    ) -> f64 {
        let middle = self.middle(at);
        let (r, t) = (at.rotation.to_rotation_matrix().into_inner(), at.translation.vector);
        let Some(matches) = &self.matches else { return 0.0 };
        let pairs = self.looked_at[range.clone()].iter().zip(&matches.places[range.clone()]);
        for (k, place) in pairs {
            let Some(own) = &self.source.patches[*k as usize] else { continue };
            let other = self.target.patches.get(*place as usize).and_then(Option::as_ref);
            let Some(other) = other else { continue };
            let p = r * own.mean + t;
            let apart = p - other.mean;
            if let Some(n) = self.facing(&apart, &(r * own.normal), other) {
                let m = match self.config.method {
                    DenseMethod::PointToPlane => other.normal,
                    _ => (n + other.normal) * 0.5,
                };
                let variance = own.variance + other.variance + LEAST;
                let arm = p - apart * 0.5 - middle;
                with(Match { own, other, arm, apart, turned: n, m, variance });
            }
        }
        range.len() as f64
    }

    /// The moved normal on the other's side, of windows that are near and lie alike.
    #[inline(always)]
    fn facing(
        &self,
        apart: &Vector3<f64>,
        n: &Vector3<f64>,
        other: &Patch,
    ) -> Option<Vector3<f64>> {
        let is_near = apart.norm_squared() <= self.gate * self.gate;
        let cosine = n.dot(&other.normal);
        let is_facing = self.source.is_facing && self.target.is_facing;
        let n = if cosine < 0.0 && !is_facing { -n } else { *n };
        (is_near && n.dot(&other.normal) >= COSINE).then_some(n)
    }
}

impl Totals {
    fn none() -> Self {
        Self {
            information: Matrix6::zeros(),
            gradient: Vector6::zeros(),
            residuals: vec![],
            squares: 0.0,
            inliers: 0.0,
            all: 0.0,
        }
    }

    fn count(&mut self, residual: f64) {
        self.inliers += 1.0;
        self.squares += residual * residual;
    }

    #[inline(always)]
    fn add(&mut self, j: &[f64; 6], residual: f64, weight: f64) {
        for a in 0..6 {
            let weighted = weight * j[a];
            self.gradient[a] += weighted * residual;
            for b in a..6 {
                self.information[(a, b)] += weighted * j[b];
            }
        }
    }
}
