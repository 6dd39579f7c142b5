//! Views one after the other, and how slowly what changes with them changes.

use crate::{
    Setup,
    estimate::{Extra, KnownNoise, NoiseModel, noise},
    solve::View,
};
use nalgebra::Vector6;

/// What gives way, and so in whose axes drift is slow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The target, the odometry or the robot: slow in the axes of the target.
    Target,
    /// The camera in its holder: slow in its own axes.
    Camera,
}

/// Views in the order in which they were taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    /// Who carries the camera.
    pub setup: Setup,
    /// What drifts.
    pub side: Side,
    /// All of them, those that are not used too.
    pub views: Vec<View>,
    /// Time from the view before to each, in mean intervals; that of the first is not used.
    pub after: Vec<f64>,
    /// What is free beside `X` and `Y`; parameters of the camera only, two at most.
    pub extras: Vec<Extra>,
}

/// How the slow part of the error moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drift {
    /// Turn in one interval, rad per axis.
    pub rotation: f64,
    /// Shift in one interval, m per axis.
    pub position: f64,
    /// Change of the unit of distances in one interval, as a part of it.
    pub scale: f64,
    /// After how many intervals it is forgotten.
    pub memory: f64,
}

impl Drift {
    pub(super) const NONE: Self = Self { rotation: 0.0, position: 0.0, scale: 0.0, memory: 1.0 };
}

/// One view of a sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slow {
    /// The slow part of its residual, perturbing `camera_from_target` on the right.
    pub drift: Vector6<f64>,
    /// Its residual where drift is told by the other views alone (rotation, rad; position, m).
    pub left_out: Vector6<f64>,
    /// The square of that in units of its standard deviation; six on average.
    pub squared_mahalanobis: f64,
}

/// Largest number of extras.
pub(crate) const EXTRAS: usize = 2;

/// Prior standard deviation of the logarithm of each noise level: a factor of ten either way.
pub(crate) const LOG_PRIOR_SIGMA: f64 = 2.3;

/// Where the noise stands: logarithms of the standard deviations, and of the memory.
#[derive(Clone)]
pub(crate) struct Levels {
    pub(super) noise: NoiseModel,
    pub(super) drift: Drift,
    pub(super) free: bool,
}

impl Levels {
    /// What is free, as logarithms.
    pub(super) fn get(&self, known: &KnownNoise) -> Vec<f64> {
        let free = |s: &&noise::Sigma| known.sigma(s.source).is_none();
        let mut all: Vec<f64> =
            self.noise.sigmas.iter().filter(free).map(|s| s.sigma.ln()).collect();
        if self.free {
            let d = &self.drift;
            all.extend([d.memory.ln(), d.rotation.ln(), d.position.ln()]);
            all.extend((d.scale > 0.0).then(|| d.scale.ln()));
        }
        all
    }

    pub(super) fn set(&mut self, values: &[f64], known: &KnownNoise) {
        let mut values = values.iter().map(|v| v.exp());
        for s in self.noise.sigmas.iter_mut().filter(|s| known.sigma(s.source).is_none()) {
            s.sigma = values.next().unwrap_or(s.sigma);
        }
        let d = &mut self.drift;
        for value in [&mut d.memory, &mut d.rotation, &mut d.position, &mut d.scale] {
            *value = values.next().unwrap_or(*value);
        }
    }
}

/// Longest and shortest memory, in intervals.
pub(crate) const MEMORY: (f64, f64) = (0.5, 1e4);
