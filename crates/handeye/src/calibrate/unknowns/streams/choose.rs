//! Which moments of two streams become views.
//!
//! Samples that follow each other closely share their errors, and many of them make a fit surer than
//! it is. So views are spread evenly over the motion, not over time: the path of the robot is cut
//! into cells of equal length, and of each cell the moment at which the robot is slowest is taken,
//! for an error of the clocks does least there. How many cells is decided by the data: as long as
//! the residuals of neighbouring views are alike, they are halved.

use nalgebra::{Isometry3, Vector6};

use super::Stream;
use crate::{
    Pose, PosePair, Setup,
    calibrate::unknowns::settle::{Captures, Settled},
    math::lie,
    solve::least_squares,
};

/// Most views; more would take long and hardly tell more.
pub(super) const MOST_VIEWS: usize = 120;
/// Fewer views are not asked for, however alike their residuals are.
pub(super) const FEWEST_VIEWS: usize = 30;
/// Length of path (m) that counts as one rad of turn.
const METRES_PER_RAD: f64 = 0.3;
/// Correlation of neighbouring residuals that is let pass: covariances are then 20 % too small at most.
const ALIKE: f64 = 0.1;

/// Both streams, the robot's as flange poses in the base.
pub(super) struct Both {
    pub setup: Setup,
    pub robot: Stream,
    pub camera: Stream,
}

/// One moment: camera time after the first sample (s), and what is measured there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    pub robot: Isometry3<f64>,
    pub camera: Isometry3<f64>,
    /// Velocity of the flange (rad/s, m/s), in the flange.
    pub velocity: Vector6<f64>,
    /// By the camera's own clock, s.
    pub camera_time_s: f64,
}

impl Both {
    /// Whether moments are the camera's samples. The other stream is interpolated, so the sparser
    /// one gives the moments; the camera's in doubt, for its samples are the noisier ones.
    fn at_camera(&self) -> bool {
        2.0 * self.camera.interval >= self.robot.interval
    }

    /// Time of the camera's first sample minus that of the robot's, by their own clocks (s).
    pub fn epochs(&self) -> f64 {
        self.camera.epoch - self.robot.epoch
    }

    /// Offsets nearer than this (s) are one and the same, on the way to the best.
    pub fn apart(&self) -> f64 {
        5.0 * self.robot.interval.max(self.camera.interval)
    }

    /// Number of samples of the stream that gives the moments.
    pub fn samples(&self) -> usize {
        if self.at_camera() { self.camera.times.len() } else { self.robot.times.len() }
    }

    /// Sample `k` of the one stream and the pose of the other at that time, the camera's clock being
    /// `offset` ahead, both counted from their first samples.
    pub fn moment(&self, k: usize, offset: f64) -> Option<Moment> {
        let (robot_time, camera_time) = if self.at_camera() {
            (self.camera.times[k] - offset, self.camera.times[k])
        } else {
            (self.robot.times[k], self.robot.times[k] + offset)
        };
        let (robot, camera) = if self.at_camera() {
            (self.robot.at(robot_time)?, self.camera.poses[k])
        } else {
            (self.robot.poses[k], self.camera.at(camera_time)?)
        };
        let velocity = self.robot.velocity(robot_time)?;
        Some(Moment { robot, camera, velocity, camera_time_s: camera_time + self.camera.epoch })
    }

    /// The robot at a time by its own clock (s); the camera's pose of that moment is not looked at.
    pub fn robot_at(&self, time_s: f64) -> Option<Moment> {
        let t = time_s - self.robot.epoch;
        let (robot, velocity) = (self.robot.at(t)?, self.robot.velocity(t)?);
        Some(Moment { robot, camera: Isometry3::identity(), velocity, camera_time_s: time_s })
    }

    /// The pair of a moment.
    pub fn pair(&self, m: &Moment) -> PosePair {
        PosePair {
            anchor_from_mount: self.setup.anchor_from_mount(Pose::claim(m.robot)),
            camera_from_target: Pose::claim(m.camera),
        }
    }

    /// Velocity of the mount against the anchor, in the mount. Where the mount is the base, the
    /// flange moves by `v` in its own frame and the base by `-Ad(base_from_flange) v` seen from it.
    pub fn mount_velocity(&self, m: &Moment) -> Vector6<f64> {
        match self.setup {
            Setup::EyeInHand => m.velocity,
            Setup::EyeToHand => -lie::adjoint(&m.robot) * m.velocity,
        }
    }

    /// The captures of these samples at a stand; samples without a pose on the other side are left
    /// out.
    pub fn captures(&self, chosen: &[usize], offset: f64, scale: f64) -> Captures {
        let moments = chosen.iter().filter_map(|&k| self.moment(k, offset));
        let (pairs, velocities) =
            moments.map(|m| (self.pair(&m).farther(1.0 / scale), self.mount_velocity(&m))).unzip();
        Captures { pairs, velocities: Some(velocities) }
    }
}

/// Up to `most` samples, spread evenly over the robot's path.
pub(super) fn choose(both: &Both, offset: f64, most: usize) -> Vec<usize> {
    let moments: Vec<(usize, Moment)> =
        (0..both.samples()).filter_map(|k| Some((k, both.moment(k, offset)?))).collect();
    if moments.len() <= most {
        return moments.into_iter().map(|(k, _)| k).collect();
    }
    let length = |v: &Vector6<f64>| lie::omega(v).norm() + lie::nu(v).norm() / METRES_PER_RAD;
    let mut path = vec![0.0];
    for pair in moments.windows(2) {
        let step = length(&lie::log(&pair[0].1.robot.inv_mul(&pair[1].1.robot)));
        path.push(path[path.len() - 1] + step);
    }
    let cell = path[path.len() - 1] / most as f64;
    let number = |at: f64| if cell > 0.0 { ((at / cell) as usize).min(most - 1) } else { 0 };
    let slower = |i: &usize, j: &usize| {
        let speed = |k: usize| length(&moments[k].1.velocity);
        speed(*i).total_cmp(&speed(*j)).then(i.cmp(j))
    };
    let all: Vec<usize> = (0..moments.len()).collect();
    let cells = all.chunk_by(|&i, &j| number(path[i]) == number(path[j]));
    let slowest = cells.filter_map(|c| c.iter().copied().min_by(slower));
    slowest.map(|i| moments[i].0).collect()
}

/// Correlation of the residuals of neighbouring views, each in units of its own noise; zero where it
/// may be chance, or too small to matter.
pub(super) fn likeness(settled: &Settled, setup: Setup) -> f64 {
    let fit = &settled.fit;
    let white = |view: &crate::solve::View| {
        let pair = view.with(&fit.extras, &fit.values);
        let r = least_squares::residual(&fit.hand_eye, &pair);
        let noise = fit.noise.covariance(view, &fit.hand_eye, setup).cholesky()?;
        noise.l().solve_lower_triangular(&r)
    };
    let residuals: Vec<Vector6<f64>> = settled.views.iter().filter_map(white).collect();
    let products: f64 = residuals.windows(2).map(|w| w[0].dot(&w[1])).sum();
    let squares: f64 = residuals.iter().map(Vector6::norm_squared).sum();
    let found = products / squares.max(f64::MIN_POSITIVE);
    // two standard deviations of what independent residuals show
    let chance = 2.0 / (6.0 * residuals.len().max(1) as f64).sqrt();
    if found > ALIKE.max(chance) { found } else { 0.0 }
}
