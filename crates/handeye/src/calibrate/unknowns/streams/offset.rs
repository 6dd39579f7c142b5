//! By how much one clock is ahead of the other, before anything else is known.
//!
//! The angle by which a body turns within a window of time is the same for robot and camera, for
//! `A_ij X = X B_ij` makes the two rotations conjugate. Written over time,
//!
//! ```text
//! a(t) = angle(R(t)⁻¹ R(t + w))        score(o) = Σ_w n ln(Σ (a_robot(t - o) - a_camera(t))² / S)
//! ```
//!
//! with `S` what the two vary about their means over the `n` common times: a long overlap that
//! agrees beats a short one, and one in which nothing varies says nothing. A short window sees the
//! speed, a long one also where the axis turns. Every offset that leaves a quarter of the shorter
//! stream in common is tried on a grid; the best few are refined by golden section.
//!
//! J. Furrer et al., *Evaluation of combined time-offset estimation and hand-eye calibration on
//! robotic datasets*, FSR 2017 (angular speeds); M. Ackerman et al., *Sensor calibration with unknown
//! correspondence: solving AX=XB using Euclidean-group invariants*, IROS 2013.

use super::stream::Stream;
use crate::math::lie;

/// Turn (rad) that a window should hold on average: 10 degrees, far above an image's noise.
const WINDOW_TURN: f64 = 0.175;
/// The long window over the short one.
const LONG: f64 = 4.0;
/// A window is no longer than this part of the shorter stream.
const LONGEST_WINDOW: f64 = 0.2;
/// Most steps of the grid per stream; the cost grows with the square.
const MOST_STEPS: f64 = 6000.0;
/// A short window spans twice as many steps of the grid at least: a valley of the score is as wide.
const LEAST_STEPS: f64 = 2.0;
/// Steps of the grid per interval between samples.
const STEPS_PER_INTERVAL: f64 = 2.0;
/// Part of the shorter stream that must be common.
const LEAST_COMMON: f64 = 0.25;
/// Fewest common times that say anything.
const FEWEST_COMMON: usize = 8;
/// Difference of angles (rad) that is taken for noise: what images and interpolation do at best.
const NOISE: f64 = 1e-3;
/// Minima of the score that are followed up: motions that repeat have several.
const MOST_CANDIDATES: usize = 4;
/// Rounds of golden section: a grid step shrinks by 1e-4.
const GOLDEN_ROUNDS: usize = 20;

/// Angles turned within both windows at evenly spaced times; `NaN` where a pose is missing.
struct Angles {
    by_window: [Vec<f64>; 2],
}

fn angle(stream: &Stream, t: f64, window: f64) -> f64 {
    let turned = |a, b: nalgebra::Isometry3<f64>| lie::angle(&a, &b.rotation);
    let from = stream.at(t - 0.5 * window).map(|p| p.rotation);
    from.zip(stream.at(t + 0.5 * window)).map_or(f64::NAN, |(a, b)| turned(a, b))
}

impl Angles {
    fn of(stream: &Stream, windows: [f64; 2], step: f64) -> Self {
        let count = (stream.duration() / step) as usize + 1;
        let series = |w| (0..count).map(|k| angle(stream, k as f64 * step, w)).collect();
        Self { by_window: windows.map(series) }
    }
}

/// Sums over the common times of one window.
#[derive(Default)]
struct Sums {
    n: f64,
    a: f64,
    b: f64,
    aa: f64,
    bb: f64,
    ab: f64,
}

impl Sums {
    fn add(&mut self, a: f64, b: f64) {
        if a.is_finite() && b.is_finite() {
            self.n += 1.0;
            self.a += a;
            self.b += b;
            self.aa += a * a;
            self.bb += b * b;
            self.ab += a * b;
        }
    }

    /// `n ln(differences / variation)`; `None` with too little in common.
    fn score(&self, fewest: f64) -> Option<f64> {
        if self.n < fewest {
            return None;
        }
        let noise = self.n * NOISE * NOISE;
        let differences = (self.aa + self.bb - 2.0 * self.ab).max(0.0) + noise;
        let variation = self.aa - self.a * self.a / self.n + self.bb - self.b * self.b / self.n;
        Some(self.n * (differences / (variation.max(0.0) + noise)).ln())
    }
}

/// How well robot and camera fit at one offset of the grid: robot time `k` is camera time `k + lag`.
fn on_grid(robot: &Angles, camera: &Angles, lag: isize, fewest: f64) -> Option<f64> {
    let window = |w: usize| {
        let (r, c) = (&robot.by_window[w], &camera.by_window[w]);
        let mut sums = Sums::default();
        let first = (-lag).max(0) as usize;
        let last = r.len().min((c.len() as isize - lag).max(0) as usize);
        for k in first..last {
            sums.add(r[k], c[(k as isize + lag) as usize]);
        }
        sums.score(fewest)
    };
    Some(window(0)? + window(1).unwrap_or(0.0))
}

/// Offsets (s; camera minus robot, both counted from their first samples) that fit best, best first.
/// Empty where the two have too little in common, or nothing varies.
pub(super) fn candidates(robot: &Stream, camera: &Stream) -> Vec<f64> {
    let shorter = robot.duration().min(camera.duration());
    let slower = robot.interval.max(camera.interval);
    if !(shorter > 0.0 && slower > 0.0) {
        return vec![];
    }
    let longer = robot.duration().max(camera.duration());
    let step = (slower / STEPS_PER_INTERVAL).max(longer / MOST_STEPS);
    let windows = windows(robot, shorter, slower.max(LEAST_STEPS * step));
    let (r, c) = (Angles::of(robot, windows, step), Angles::of(camera, windows, step));
    let valid = |a: &Angles| a.by_window[0].iter().filter(|x| x.is_finite()).count();
    let fewest = (LEAST_COMMON * valid(&r).min(valid(&c)) as f64).max(FEWEST_COMMON as f64);
    let lags = -(r.by_window[0].len() as isize)..=c.by_window[0].len() as isize;
    let scores: Vec<(isize, f64)> =
        lags.filter_map(|lag| Some((lag, on_grid(&r, &c, lag, fewest)?))).collect();
    let apart = (windows[0] / step).ceil() as isize;
    let refined = |lag: isize| refine(robot, camera, windows, lag as f64 * step, step);
    lowest(scores, apart).into_iter().map(refined).collect()
}

fn windows(robot: &Stream, shorter: f64, slower: f64) -> [f64; 2] {
    let turn: f64 =
        robot.poses.windows(2).map(|w| lie::angle(&w[0].rotation, &w[1].rotation)).sum();
    let typical = WINDOW_TURN * robot.duration() / turn.max(f64::MIN_POSITIVE);
    let longest = (LONGEST_WINDOW * shorter).max(slower);
    let short = typical.clamp((2.0 * slower).min(longest), longest);
    [short, (LONG * short).min(longest)]
}

/// The lowest scores that are `apart` from each other; scores that say nothing are not among them.
fn lowest(mut scores: Vec<(isize, f64)>, apart: isize) -> Vec<isize> {
    scores.retain(|s| s.1 < 0.0);
    scores.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let mut chosen: Vec<isize> = vec![];
    for (lag, _) in scores {
        if chosen.len() < MOST_CANDIDATES && chosen.iter().all(|c| (c - lag).abs() > apart) {
            chosen.push(lag);
        }
    }
    chosen
}

/// Golden section within a grid step either way.
fn refine(robot: &Stream, camera: &Stream, windows: [f64; 2], at: f64, step: f64) -> f64 {
    let count = (camera.duration() / step) as usize + 1;
    let series = |w| (0..count).map(|k| angle(camera, k as f64 * step, w)).collect::<Vec<f64>>();
    let seen = windows.map(series);
    let cost = |offset: f64| {
        let (mut sum, mut n) = (0.0, 0.0);
        for (w, window) in windows.into_iter().enumerate() {
            for (k, &b) in seen[w].iter().enumerate().filter(|(_, b)| b.is_finite()) {
                let a = angle(robot, k as f64 * step - offset, window);
                if a.is_finite() {
                    sum += (a - b).powi(2);
                    n += 1.0;
                }
            }
        }
        sum / f64::max(n, 1.0)
    };
    golden(cost, at - step, at + step)
}

fn golden(cost: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let section = 0.5 * (5_f64.sqrt() - 1.0);
    let inner = |low: f64, high: f64| (high - section * (high - low), low + section * (high - low));
    let (mut a, mut b) = inner(low, high);
    let (mut at_a, mut at_b) = (cost(a), cost(b));
    for _ in 0..GOLDEN_ROUNDS {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = inner(low, high).0;
            at_a = cost(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = inner(low, high).1;
            at_b = cost(b);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn golden_section_finds_the_least() {
        let least = golden(|x| (x - 0.3).powi(2), -1.0, 1.0);
        assert!((least - 0.3).abs() < 1e-4);
    }

    #[test]
    fn scores_too_near_a_better_one_are_no_candidates() {
        let scores = (-50..50_isize).map(|k| (k, -f64::from(100 - (k.abs() as i32)))).collect();
        assert_eq!(lowest(scores, 30), [0, -31, 31]);
    }
}
