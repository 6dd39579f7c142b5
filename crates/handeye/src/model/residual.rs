//! By how much two poses differ, as angle and distance.
//!
//! Of a capture it is that of its loop `E = Y⁻¹ A X C`, which is the identity where the capture fits: `angle(E)`, and
//! `|t(E)|` at the target's origin.

use crate::{Pose, math::linalg::median};

/// By how much two poses differ, or the loop of a capture fails to close at the target's origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// rad.
    pub angle: f64,
    /// m.
    pub distance: f64,
}

impl Residual {
    /// From degrees and millimetres.
    pub(crate) const fn of(degrees: f64, millimetres: f64) -> Self {
        Self { angle: degrees.to_radians(), distance: millimetres * 1e-3 }
    }

    /// The angle in degrees.
    pub(crate) fn degrees(self) -> f64 {
        self.angle.to_degrees()
    }

    /// The distance in millimetres.
    pub(crate) fn millimetres(self) -> f64 {
        self.distance * 1e3
    }

    /// Between two poses.
    pub fn between<A, B>(a: &Pose<A, B>, b: &Pose<A, B>) -> Self {
        Self { angle: a.angle_to(b), distance: a.distance_to(b) }
    }

    /// Whether two poses differ by no more than `limit`; cheap where they are far apart.
    pub(crate) fn are_within<A, B>(a: &Pose<A, B>, b: &Pose<A, B>, limit: Self) -> bool {
        a.distance_to(b) <= limit.distance && Self::between(a, b).is_within(limit)
    }

    /// Medians of both, each by itself.
    pub(crate) fn median(all: &[Self]) -> Self {
        Self {
            angle: median(all.iter().map(|r| r.angle)),
            distance: median(all.iter().map(|r| r.distance)),
        }
    }

    /// Whether both are below a limit.
    pub fn is_within(self, limit: Self) -> bool {
        self.angle < limit.angle && self.distance < limit.distance
    }

    /// Both as one number, in units of another residual.
    pub(crate) fn over(self, unit: Self) -> f64 {
        (self.angle / unit.angle).hypot(self.distance / unit.distance)
    }

    /// So many times as large.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { angle: factor * self.angle, distance: factor * self.distance }
    }

    /// Both at least as large as those of another one.
    pub(crate) fn at_least(self, least: Self) -> Self {
        Self { angle: self.angle.max(least.angle), distance: self.distance.max(least.distance) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_one_of_angle_and_of_distance() {
        let limit = Residual::of(2.5, 15.0);
        assert!(Residual::of(2.4, 14.9).is_within(limit));
        assert!(!Residual::of(2.6, 0.0).is_within(limit));
        assert!(!Residual::of(0.0, 15.1).is_within(limit));
        assert_eq!(Residual::of(1.0, 1.0).at_least(Residual::of(0.5, 2.0)), Residual::of(1.0, 2.0));
    }
}
