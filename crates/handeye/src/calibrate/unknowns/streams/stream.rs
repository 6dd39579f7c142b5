//! Poses over time, and the pose between two of them.
//!
//! Between samples a pose follows the polynomial through its neighbours in the logarithm at the
//! sample before, up to third order:
//!
//! ```text
//! T(t) = T_i exp(Σ_j L_j(t) log(T_i⁻¹ T_j))        j = i-1 .. i+2,  L_j Lagrange's polynomials
//! ```
//!
//! With two samples that is the screw motion between them. It does not matter in which frames the
//! poses are written: `G T(t) H` is what comes out for samples `G T_j H`.
//!
//! J. Selig, *Geometric Fundamentals of Robotics*, Springer 2005, chapter 4 (exponential map).

use nalgebra::{Isometry3, Vector6};

use crate::{
    Error, Stamped,
    math::{lie, linalg},
};

/// Poses in the order of their times.
#[derive(Debug, Clone, PartialEq)]
pub struct Stream {
    /// Time of the first sample, by the stream's own clock (s).
    pub(super) epoch: f64,
    /// Times after the first (s), ascending.
    pub(super) times: Vec<f64>,
    pub(super) poses: Vec<Isometry3<f64>>,
    /// Median time between samples (s).
    pub(super) interval: f64,
    /// Pauses that are gaps (s), where somebody said so.
    limit: Option<f64>,
    /// What was put right.
    pub(super) cleaned: Cleaned,
}

/// What was put right in a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Cleaned {
    /// Samples that came after one with a later time.
    pub unsorted: usize,
    /// Samples left out because the same pose is there with the same time.
    pub repeated: usize,
    /// Samples left out because another pose is there with the same time.
    pub conflicting: usize,
}

/// Pauses longer than so many median intervals are gaps: no pose is made up within.
pub(super) const GAP: f64 = 4.0;
/// Nor where the pose turns by more than this (rad) between two samples: a quarter turn.
const FARTHEST_TURN: f64 = std::f64::consts::FRAC_PI_2;
/// A neighbour nearer than this part of the interval says nothing about the curve: it would only
/// magnify its noise.
const NEAREST: f64 = 0.25;
/// Poses with the same time that differ by less (rad, m) are the same: rounding.
const SAME: f64 = 1e-9;

impl Stream {
    /// Sorts samples by time. Of the same sample twice one is kept; of different poses with the same
    /// time none. Errors call the stream by `name`.
    ///
    /// # Errors
    /// [`Error::NotFinite`] on times that are no numbers.
    pub fn new(samples: &[Stamped<Isometry3<f64>>], name: &str) -> Result<Self, Error> {
        if let Some(k) = samples.iter().position(|s| !s.time_s.is_finite()) {
            return Err(Error::NotFinite { what: format!("time_s of {name} sample {}", k + 1) });
        }
        let unsorted = samples.windows(2).filter(|w| w[1].time_s < w[0].time_s).count();
        let mut sorted: Vec<_> = samples.to_vec();
        sorted.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        let mut cleaned = Cleaned { unsorted, ..Cleaned::default() };
        let epoch = sorted.first().map_or(0.0, |s| s.time_s);
        let (mut times, mut poses) = (vec![], vec![]);
        for same_time in sorted.chunk_by(|a, b| a.time_s == b.time_s) {
            let first = same_time[0];
            let differs =
                |s: &Stamped<Isometry3<f64>>| lie::log(&first.pose.inv_mul(&s.pose)).norm() > SAME;
            if same_time.iter().any(differs) {
                cleaned.conflicting += same_time.len();
                continue;
            }
            cleaned.repeated += same_time.len() - 1;
            times.push(first.time_s - epoch);
            poses.push(first.pose);
        }
        let interval = linalg::median(times.windows(2).map(|w| w[1] - w[0]));
        Ok(Self { epoch, times, poses, interval, limit: None, cleaned })
    }

    /// Pauses longer than this (s) are gaps: four median intervals, unless said otherwise.
    pub fn limit(&self) -> f64 {
        self.limit.unwrap_or(GAP * self.interval)
    }

    /// The same stream, in which pauses longer than this (s) are gaps.
    pub fn with_limit(self, seconds: f64) -> Self {
        Self { limit: Some(seconds), ..self }
    }

    /// Samples that were left out, for others of the same time contradict them.
    pub fn conflicting(&self) -> usize {
        self.cleaned.conflicting
    }

    /// How many pauses are gaps.
    pub fn gaps(&self) -> usize {
        (1..self.times.len()).filter(|&k| !self.joined(k - 1)).count()
    }

    /// Times of the samples by the stream's own clock, ascending (s).
    pub fn times(&self) -> Vec<f64> {
        self.times.iter().map(|t| t + self.epoch).collect()
    }

    /// The pose at a time by the stream's own clock (s); `None` outside, and in gaps.
    pub fn at_time(&self, time_s: f64) -> Option<Isometry3<f64>> {
        self.at(time_s - self.epoch)
    }

    /// Time from the first sample to the last (s).
    pub(super) fn duration(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Whether the pose is known between sample `k` and the next.
    fn joined(&self, k: usize) -> bool {
        // the slack lets evenly spaced stamps pass whatever their rounding
        let near = self.times[k + 1] - self.times[k] <= self.limit() * (1.0 + 1e-9);
        near && lie::angle(&self.poses[k].rotation, &self.poses[k + 1].rotation) < FARTHEST_TURN
    }

    /// The pose at a time after the first sample (s); `None` outside, and in gaps.
    pub(super) fn at(&self, t: f64) -> Option<Isometry3<f64>> {
        let after = self.times.partition_point(|&s| s <= t);
        let i = after.checked_sub(1)?;
        if self.times[i] == t {
            return Some(self.poses[i]);
        }
        if after == self.times.len() || !self.joined(i) {
            return None;
        }
        let own = self.times[after] - self.times[i];
        let mut nodes = vec![i, after];
        if i > 0 && self.joined(i - 1) && self.times[i] - self.times[i - 1] > NEAREST * own {
            nodes.push(i - 1);
        }
        if after + 1 < self.times.len()
            && self.joined(after)
            && self.times[after + 1] - self.times[after] > NEAREST * own
        {
            nodes.push(after + 1);
        }
        Some(self.curve(i, &nodes, t))
    }

    fn curve(&self, i: usize, nodes: &[usize], t: f64) -> Isometry3<f64> {
        let lagrange = |j: usize| {
            let others = nodes.iter().filter(|&&k| k != j);
            others.fold(1.0, |l, &k| l * (t - self.times[k]) / (self.times[j] - self.times[k]))
        };
        let here = self.poses[i];
        let term = |&j: &usize| lie::log(&here.inv_mul(&self.poses[j])) * lagrange(j);
        here * lie::exp(&nodes.iter().filter(|&&j| j != i).map(term).sum::<Vector6<f64>>())
    }

    /// Velocity (rad/s, m/s) in the moving frame.
    pub(super) fn velocity(&self, t: f64) -> Option<Vector6<f64>> {
        let step = 0.25 * self.interval;
        let ahead = self.at(t + step).map(|p| (step, p));
        let behind = self.at(t - step).map(|p| (-step, p));
        let here = || self.at(t).map(|p| (0.0, p));
        let (t0, a) = behind.or_else(here)?;
        let (t1, b) = ahead.or_else(here)?;
        (t1 > t0).then(|| lie::log(&a.inv_mul(&b)) / (t1 - t0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    fn smooth(t: f64) -> Isometry3<f64> {
        Isometry3::new(
            Vector3::new(0.3 * t.sin(), 0.2 * (1.3 * t).cos(), 0.1 * t),
            Vector3::new(0.8 * (0.7 * t).sin(), 0.5 * t.cos(), 0.4 * (1.1 * t).sin()),
        )
    }

    fn sampled(times: &[f64]) -> Vec<Stamped<Isometry3<f64>>> {
        times.iter().map(|&t| Stamped { time_s: t, pose: smooth(t) }).collect()
    }

    fn even(count: usize, step: f64) -> Vec<f64> {
        (0..count).map(|k| k as f64 * step).collect()
    }

    #[test]
    fn a_screw_motion_is_followed_exactly() {
        let twist = Vector6::new(0.3, -0.2, 0.5, 0.1, 0.4, -0.3);
        let pose = |t: f64| smooth(0.4) * lie::exp(&(twist * t));
        let all: Vec<_> =
            [0.0, 0.11, 0.19, 0.3, 0.42].map(|t| Stamped { time_s: t, pose: pose(t) }).into();
        let stream = Stream::new(&all, "robot").unwrap();
        for t in [0.0, 0.05, 0.2, 0.31, 0.42] {
            assert!(lie::log(&pose(t).inv_mul(&stream.at(t).unwrap())).norm() < 1e-12);
            assert!((stream.velocity(t).unwrap() - twist).norm() < 1e-9, "{t}");
        }
    }

    #[test]
    fn the_error_between_samples_falls_with_the_fourth_power_of_the_interval() {
        let worst = |step: f64| {
            let stream =
                Stream::new(&sampled(&even((4.0 / step) as usize + 1, step)), "r").unwrap();
            let miss = |t: f64| lie::log(&smooth(t).inv_mul(&stream.at(t).unwrap())).norm();
            (0..100).map(|k| miss(1.0 + 0.02 * f64::from(k))).fold(0.0, f64::max)
        };
        let (coarse, fine) = (worst(0.1), worst(0.05));
        assert!(coarse < 2e-5, "{coarse}");
        assert!(coarse / fine > 12.0, "{}", coarse / fine);
    }

    #[test]
    fn other_frames_change_nothing_but_the_frames() {
        let (g, h) = (smooth(2.0), smooth(5.0));
        let samples = sampled(&even(20, 0.1));
        let turned: Vec<_> =
            samples.iter().map(|s| Stamped { pose: g * s.pose * h, ..*s }).collect();
        let (a, b) = (Stream::new(&samples, "r").unwrap(), Stream::new(&turned, "r").unwrap());
        for t in [0.33, 0.97, 1.85] {
            let (p, q) = (g * a.at(t).unwrap() * h, b.at(t).unwrap());
            assert!(lie::log(&p.inv_mul(&q)).norm() < 1e-12);
        }
    }

    #[test]
    fn nothing_is_made_up_in_gaps_and_outside() {
        let mut times = even(40, 0.1);
        times.drain(10..14);
        let stream = Stream::new(&sampled(&times), "robot").unwrap();
        assert_eq!(stream.gaps(), 1);
        assert!((stream.limit() - 0.4).abs() < 1e-9);
        assert!(stream.at(1.1).is_none());
        assert!(stream.at(0.95).is_none());
        assert!(stream.at(0.9).is_some());
        assert!(stream.at(1.45).is_some());
        assert!(
            stream.at(-1e-9).is_none() && stream.at(3.91).is_none() && stream.at(3.9).is_some()
        );
        assert!(stream.at(f64::NAN).is_none());
    }

    #[test]
    fn order_and_repetition_do_not_matter() {
        let samples = sampled(&even(20, 0.1));
        let mut shuffled = samples.clone();
        shuffled.reverse();
        shuffled.push(samples[3]);
        let stream = Stream::new(&shuffled, "robot").unwrap();
        let plain = Stream::new(&samples, "robot").unwrap();
        assert_eq!((&stream.times, &stream.poses), (&plain.times, &plain.poses));
        assert_eq!(stream.cleaned.repeated, 1);
        let other = Stamped { pose: smooth(9.0), ..samples[5] };
        let torn = Stream::new(&[samples.as_slice(), &[other]].concat(), "robot").unwrap();
        assert_eq!(torn.cleaned.conflicting, 2);
        assert_eq!(torn.times.len(), 19);
    }

    #[test]
    fn a_time_that_is_no_number_is_named() {
        let mut samples = sampled(&even(5, 0.1));
        samples[2].time_s = f64::NAN;
        let error = Stream::new(&samples, "camera").unwrap_err().to_string();
        assert_eq!(error, "time_s of camera sample 3 is not finite");
        assert!(Stream::new(&[], "camera").unwrap().at(0.0).is_none());
    }
}
