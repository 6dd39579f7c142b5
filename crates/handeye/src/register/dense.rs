//! Registration of two organised scans.
//!
//! Windows of the source, moved by the current transform, are compared with those that the target's camera
//! sees in the same direction, along the mean of both normals:
//!
//! ```text
//! r = ½ (R n_p + n_q) · (R p + t - q)        J = [(R p + t) × m, m]  with m = ½ (R n_p + n_q)
//! ```
//!
//! With both normals, a match that is off along the surface does no harm to second order. Residuals are
//! weighed by the scatter across both windows, and those beyond some standard deviations do
//! not count (Tukey).
//!
//! S. Rusinkiewicz, *A symmetric objective function for ICP*, ACM Trans. Graph. 38(4), 2019.

use nalgebra::{Isometry3, Matrix6, Translation3, UnitQuaternion, Vector3, Vector6};

use super::{icp::Stop, patch::Patch, surface::Surface};
use crate::{Error, Scan, linalg, parallel};

/// When to match and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DenseConfig {
    /// Windows farther apart are not compared, m.
    pub max_correspondence_distance_m: f64,
    /// Most rounds.
    pub max_iterations: usize,
    /// Threads; the answer is the same with any number.
    pub threads: usize,
}

impl Default for DenseConfig {
    fn default() -> Self {
        Self { max_correspondence_distance_m: 0.01, max_iterations: 60, threads: 1 }
    }
}

/// A registration of two scans.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    /// The whole transform, the start included.
    pub target_from_source: Isometry3<f64>,
    /// Rounds over all windows, and over some.
    pub iterations: usize,
    /// Why it ended.
    pub stop: Stop,
    /// Share of the source's windows that have found a match which counts.
    pub inlier_fraction: f64,
    /// RMS distance across the surface, of the matches, m.
    pub rms_m: f64,
}

/// Only each so manieth window of a row, and row, at first.
const STRIDES: [usize; 2] = [4, 1];
/// Normals of a match are within 30 degrees.
const COSINE: f64 = 0.866;
/// Beyond so many standard deviations residuals do not count.
const TUKEY: f64 = 4.685;
/// Standard deviations in a median absolute deviation.
const MAD: f64 = 1.4826;
/// A round that moves by less than this share of the answer's standard deviation is the last.
const SETTLED: f64 = 0.02;
/// Rounds over some windows end earlier.
const SETTLED_SOME: f64 = 0.5;
/// Steps shorter than this many standard deviations may be noise.
const NEAR: f64 = 1.0;
/// Fewer matches are none.
const FEWEST: f64 = 20.0;
/// Windows that a thread works on at once.
const CHUNK: usize = 4096;
/// Windows stay matched while none moves by more than this share of the spread of one.
const MATCHED: f64 = 0.2;
/// Among all windows none is matched farther away than this many times the spread of one.
const FINE: f64 = 2.0;
/// No window.
const NOWHERE: u32 = u32::MAX;
/// No scatter is less, m²: rounding of single precision.
const LEAST: f64 = 1e-12;

/// Registers two organised scans, from a start that is right to some millimetres and degrees.
///
/// # Errors
/// [`Error::TooFewPoints`] where nothing can be compared, [`Error::NotDetermined`] where the common surface
/// leaves a direction free.
pub fn register(
    source: &Scan,
    target: &Scan,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    let surface = |scan: &Scan, name| {
        Surface::of(scan, config.threads)
            .ok_or_else(|| Error::Invalid(format!("the {name} scan shows no surface")))
    };
    let (source, target) = (surface(source, "source")?, surface(target, "target")?);
    let sigma = f64::INFINITY;
    let matches = Matches { stride: 0, at: *start, places: vec![] };
    let mut round = Round { source: &source, target: &target, config, sigma, stride: 1, matches };
    let mut found = Dense {
        target_from_source: *start,
        iterations: 0,
        stop: Stop::MaxIterations,
        inlier_fraction: 0.0,
        rms_m: 0.0,
    };
    for stride in STRIDES {
        round.stride = stride;
        round.descend(&mut found)?;
    }
    Ok(found)
}

/// Turned about `middle` of the target, then shifted.
fn moved(at: &Isometry3<f64>, step: &Vector6<f64>, middle: &Vector3<f64>) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(step[0], step[1], step[2]));
    let shift = Vector3::new(step[3], step[4], step[5]);
    let t = turn * (at.translation.vector - middle) + middle + shift;
    Isometry3::from_parts(Translation3::from(t), turn * at.rotation)
}

struct Round<'a> {
    source: &'a Surface,
    target: &'a Surface,
    config: &'a DenseConfig,
    /// Standard deviation of residuals over their scatter.
    sigma: f64,
    stride: usize,
    matches: Matches,
}

/// Which window of the target belongs to each of the source. Small steps do not change that.
struct Matches {
    /// Of one window in so many rows and columns.
    stride: usize,
    /// Where the source was.
    at: Isometry3<f64>,
    /// Numbers of windows.
    places: Vec<u32>,
}

/// Normal equations over matches, in the target frame.
struct Totals {
    information: Matrix6<f64>,
    gradient: Vector6<f64>,
    /// Lengths, over their scatter.
    residuals: Vec<f32>,
    /// Of those that count, m².
    squares: f64,
    inliers: f64,
    /// Windows looked at.
    all: f64,
}

impl Round<'_> {
    /// Rounds until steps are short.
    fn descend(&mut self, found: &mut Dense) -> Result<(), Error> {
        let settled = if self.stride == 1 { SETTLED } else { SETTLED_SOME };
        let mut last = f64::INFINITY;
        found.stop = Stop::MaxIterations;
        while found.iterations < self.config.max_iterations {
            found.iterations += 1;
            self.match_all(&found.target_from_source);
            let sums = self.sums(&found.target_from_source);
            if sums.inliers < FEWEST {
                return Err(Error::TooFewPoints {
                    found: sums.inliers as usize,
                    needed: FEWEST as usize,
                });
            }
            self.sigma = MAD * linalg::median(sums.residuals.iter().map(|r| f64::from(*r)));
            let inverse = linalg::invert_spd(&sums.information).ok_or_else(|| {
                Error::NotDetermined { what: "the common surface can slide on itself".into() }
            })?;
            let step = -inverse * sums.gradient;
            let middle = self.middle(&found.target_from_source);
            found.target_from_source = moved(&found.target_from_source, &step, &middle);
            found.inlier_fraction = sums.inliers / sums.all;
            found.rms_m = (sums.squares / sums.inliers).sqrt();
            let length = step.dot(&(sums.information * step)).sqrt();
            // matches come and go for ever: once all is near, steps that do not shrink are their noise
            let noise = length < NEAR * self.sigma && length > 0.5 * last;
            if length <= settled * self.sigma || noise {
                found.stop = Stop::Converged;
                break;
            }
            last = length;
        }
        Ok(())
    }

    fn middle(&self, at: &Isometry3<f64>) -> Vector3<f64> {
        at.transform_point(&self.source.middle.into()).coords
    }

    /// In chunks, by all threads.
    fn chunks<T: Send>(&self, work: impl Fn(std::ops::Range<usize>) -> T + Sync) -> Vec<T> {
        let count = self.source.patches.len();
        parallel::in_order(count.div_ceil(CHUNK), self.config.threads, |k| {
            work(CHUNK * k..count.min(CHUNK * (k + 1)))
        })
    }

    /// Looks for the windows that belong together, unless they are known from a place nearby.
    fn match_all(&mut self, at: &Isometry3<f64>) {
        let last = &self.matches;
        let reach = MATCHED * self.target.spread;
        let is_near = |p: &Vector3<f64>| {
            let p = (*p).into();
            (at.transform_point(&p) - last.at.transform_point(&p)).norm() <= reach
        };
        if last.stride == self.stride && self.source.corners.iter().all(is_near) {
            return;
        }
        let mut gate = self.config.max_correspondence_distance_m;
        if self.stride == 1 {
            gate = gate.min(FINE * self.target.spread);
        }
        let (r, t) = (at.rotation.to_rotation_matrix().into_inner(), at.translation.vector);
        let place = |k: usize| {
            let own = self.source.patches[k].as_ref().filter(|_| self.source.is_in(k, self.stride));
            own.and_then(|own| self.target.find(&(r * own.mean + t), gate))
                .map_or(NOWHERE, |k| k as u32)
        };
        let places = self.chunks(|range| range.map(place).collect::<Vec<u32>>()).concat();
        self.matches = Matches { stride: self.stride, at: *at, places };
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

    fn part(&self, at: &Isometry3<f64>, range: std::ops::Range<usize>) -> Totals {
        let mut total = Totals::none();
        let middle = self.middle(at);
        let (r, t) = (at.rotation.to_rotation_matrix().into_inner(), at.translation.vector);
        for k in range.filter(|k| self.source.is_in(*k, self.stride)) {
            let Some(own) = &self.source.patches[k] else { continue };
            total.all += 1.0;
            let place = self.matches.places[k];
            let Some(other) = self.target.patches.get(place as usize).and_then(Option::as_ref)
            else {
                continue;
            };
            let p = r * own.mean + t;
            if let Some(n) = self.facing(&(p - other.mean), &(r * own.normal), other) {
                let variance = own.across / own.held + other.across / other.held + LEAST;
                total.add(
                    &(p - middle),
                    &((n + other.normal) * 0.5),
                    &(p - other.mean),
                    variance,
                    TUKEY * self.sigma,
                );
            }
        }
        total
    }

    /// The moved normal on the other's side, of windows that are near and lie alike.
    #[inline(always)]
    fn facing(
        &self,
        apart: &Vector3<f64>,
        n: &Vector3<f64>,
        other: &Patch,
    ) -> Option<Vector3<f64>> {
        let gate = self.config.max_correspondence_distance_m;
        let is_near = apart.norm_squared() <= gate * gate;
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

    /// A match that is `d` apart at `arm` from the middle, `m` across the surface.
    #[inline(always)]
    fn add(
        &mut self,
        arm: &Vector3<f64>,
        m: &Vector3<f64>,
        d: &Vector3<f64>,
        variance: f64,
        limit: f64,
    ) {
        let residual = m.dot(d);
        let scaled = residual.abs() / variance.sqrt();
        self.residuals.push(scaled as f32);
        let share = scaled / limit;
        if share >= 1.0 {
            return;
        }
        let weight = (1.0 - share * share).powi(2) / variance;
        self.inliers += 1.0;
        self.squares += residual * residual;
        let turn = arm.cross(m);
        let j = [turn.x, turn.y, turn.z, m.x, m.y, m.z];
        for a in 0..6 {
            let weighted = weight * j[a];
            self.gradient[a] += weighted * residual;
            for b in a..6 {
                self.information[(a, b)] += weighted * j[b];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Intrinsics, lie,
        simulate::{Random, Room},
    };

    const PI: f64 = std::f64::consts::PI;

    fn above(x: f64, y: f64, turn: [f64; 3]) -> Isometry3<f64> {
        let down = Isometry3::new([x, y, 0.8].into(), [PI, 0.0, 0.0].into());
        down * Isometry3::new(Vector3::zeros(), turn.into())
    }

    /// Two scans of a cell from different sides, with 0.5 mm of noise, and the truth.
    fn scans(seed: u64, lens: impl Fn(Intrinsics) -> Intrinsics) -> (Scan, Scan, Isometry3<f64>) {
        let mut random = Random::new(seed);
        let room = Room::of_a_cell(&mut random);
        let (one, other) =
            (above(0.05, -0.1, [0.12, 0.05, 0.1]), above(-0.1, 0.15, [-0.15, -0.1, -0.1]));
        let intrinsics = lens(Intrinsics::pinhole(240, 180, 240.0, 240.0, 119.5, 89.5));
        let source = room.scan(&one, &intrinsics, 5e-4, &mut random);
        let target = room.scan(&other, &intrinsics, 5e-4, &mut random);
        (source, target, other.inv_mul(&one))
    }

    fn off(truth: &Isometry3<f64>, random: &mut Random) -> Isometry3<f64> {
        let turn = random.normal3().normalize() * 1f64.to_radians();
        truth * Isometry3::new(random.normal3().normalize() * 5e-3, turn)
    }

    /// Degrees, and mm at the middle of the table.
    fn errors(truth: &Isometry3<f64>, found: &Isometry3<f64>) -> (f64, f64) {
        let middle = Vector3::new(0.0, 0.0, 0.8).into();
        let apart = (truth.transform_point(&middle) - found.transform_point(&middle)).norm();
        (lie::angle(&truth.rotation, &found.rotation).to_degrees(), 1e3 * apart)
    }

    #[test]
    fn two_scans_of_a_cell_are_brought_together() {
        let (mut turned, mut shifted) = (vec![], vec![]);
        for seed in 0..6 {
            let (source, target, truth) = scans(seed, |k| k);
            let start = off(&truth, &mut Random::new(100 + seed));
            let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
            assert_eq!(found.stop, Stop::Converged);
            assert!(found.inlier_fraction > 0.4, "{}", found.inlier_fraction);
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.1 && shift < 0.4, "{seed}: {turn} deg, {shift} mm");
            turned.push(turn);
            shifted.push(shift);
        }
        let (turn, shift) = (linalg::median(turned), linalg::median(shifted));
        println!("{turn:.4} deg, {shift:.3} mm");
        assert!(turn < 0.04 && shift < 0.15, "{turn} deg, {shift} mm");
    }

    #[test]
    fn a_lens_that_distorts_does_not_matter() {
        let barrel = |k: Intrinsics| Intrinsics {
            distortion: crate::Distortion::BrownConrady([
                -0.2, 0.05, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            ]),
            ..k
        };
        let (source, target, truth) = scans(1, barrel);
        let start = off(&truth, &mut Random::new(5));
        let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
        let (turn, shift) = errors(&truth, &found.target_from_source);
        assert!(turn < 0.05 && shift < 0.2, "{turn} deg, {shift} mm");
    }

    #[test]
    fn the_answer_does_not_depend_on_the_number_of_threads() {
        let (source, target, truth) = scans(2, |k| k);
        let start = off(&truth, &mut Random::new(6));
        let with = |threads| {
            register(&source, &target, &start, &DenseConfig { threads, ..DenseConfig::default() })
                .unwrap()
        };
        assert_eq!(with(1), with(2));
        assert_eq!(with(1), with(7));
    }

    #[test]
    fn moving_the_target_moves_only_the_answer() {
        let (source, target, truth) = scans(3, |k| k);
        let start = off(&truth, &mut Random::new(7));
        let plain = register(&source, &target, &start, &DenseConfig::default()).unwrap();
        let turn = Isometry3::new(Vector3::zeros(), [0.0, 0.0, PI / 2.0].into());
        // a quarter turn of the picture: rows become columns
        let (width, height) = (target.width(), target.height());
        let point = |k: usize| {
            let (x, y) = (k % height, k / height);
            let [px, py, pz] = target.points()[(height - 1 - x) * width + y];
            [-py, px, pz]
        };
        let turned = Scan::new(height, width, (0..width * height).map(point).collect()).unwrap();
        let found = register(&source, &turned, &(turn * start), &DenseConfig::default()).unwrap();
        let (degrees, mm) = errors(&(turn * plain.target_from_source), &found.target_from_source);
        // the blocks are others
        assert!(degrees < 0.02 && mm < 0.1, "{degrees} deg, {mm} mm");
    }

    #[test]
    fn scans_of_different_things_are_refused() {
        let (source, target, truth) = scans(4, |k| k);
        let away = Isometry3::translation(0.0, 0.0, 1.0) * truth;
        let error = register(&source, &target, &away, &DenseConfig::default()).unwrap_err();
        assert!(matches!(error, Error::TooFewPoints { .. }), "{error}");
        let nothing = Scan::new(4, 1, vec![[f32::NAN; 3]; 4]).unwrap();
        let error = register(&nothing, &target, &truth, &DenseConfig::default()).unwrap_err();
        assert!(error.to_string().contains("source scan"), "{error}");
    }

    /// The points that were seen, in any order.
    fn shuffled(scan: &Scan, seed: u64) -> Scan {
        let mut random = Random::new(seed);
        let mut points: Vec<[f32; 3]> =
            scan.points().iter().filter(|p| p[0].is_finite()).copied().collect();
        for k in (1..points.len()).rev() {
            points.swap(k, (random.unit() * (k + 1) as f64) as usize);
        }
        Scan::new(points.len(), 1, points).unwrap()
    }

    #[test]
    fn clouds_are_brought_together_whatever_the_order_of_their_points() {
        let (mut turned, mut shifted) = (vec![], vec![]);
        for seed in 0..6 {
            let (source, target, truth) = scans(seed, |k| k);
            let start = off(&truth, &mut Random::new(100 + seed));
            let with = |order: u64, threads| {
                let (source, target) = (shuffled(&source, order), shuffled(&target, order + 1));
                let config = DenseConfig { threads, ..DenseConfig::default() };
                register(&source, &target, &start, &config).unwrap()
            };
            let found = with(1, 1);
            assert_eq!(found, with(3, 2));
            assert_eq!(found.stop, Stop::Converged);
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.1 && shift < 0.4, "{seed}: {turn} deg, {shift} mm");
            turned.push(turn);
            shifted.push(shift);
        }
        let (turn, shift) = (linalg::median(turned), linalg::median(shifted));
        println!("{turn:.4} deg, {shift:.3} mm");
        assert!(turn < 0.04 && shift < 0.15, "{turn} deg, {shift} mm");
    }
}
