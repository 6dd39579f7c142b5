//! Two windows that belong together.

use nalgebra::{Matrix3, Vector3};

use super::patch::Patch;

/// No variance is less, m²: rounding of single precision.
pub const LEAST: f64 = 1e-12;

/// Two windows that belong together.
pub(crate) struct Match<'a> {
    pub own: &'a Patch,
    pub other: &'a Patch,
    /// Half way between both means, from the middle of the source.
    pub arm: Vector3<f64>,
    /// From the other's mean to the moved one.
    pub apart: Vector3<f64>,
    /// The own normal, turned to the other's side.
    pub turned: Vector3<f64>,
    /// Mean of both normals, or the other's alone.
    pub m: Vector3<f64>,
    /// Of their distance along it, m².
    pub variance: f64,
}

impl Match<'_> {
    /// Three directions which together weigh differences by the inverse of this covariance.
    pub(crate) fn whitened(&self, covariance: &Matrix3<f64>) -> Option<[Vector3<f64>; 3]> {
        let root = covariance.cholesky()?.l().try_inverse()?;
        Some([0, 1, 2].map(|k| root.row(k).transpose()))
    }

    /// Of the place of both windows' points, which may be anywhere along their surfaces.
    pub fn covariance(&self, moved_normal: &Vector3<f64>) -> Matrix3<f64> {
        let of = |p: &Patch, n: &Vector3<f64>| {
            Matrix3::identity() * p.along + n * n.transpose() * (p.variance - p.along)
        };
        of(self.own, moved_normal)
            + of(self.other, &self.other.normal)
            + Matrix3::identity() * LEAST
    }

    #[inline(always)]
    pub fn residual(&self) -> f64 {
        self.m.dot(&self.apart)
    }

    /// By turn and shift.
    #[inline(always)]
    pub(crate) fn jacobian(&self) -> [f64; 6] {
        jacobian(&self.arm, &self.m)
    }
}

/// Of a distance along `m`, by turn and shift.
#[inline(always)]
pub(crate) fn jacobian(arm: &Vector3<f64>, m: &Vector3<f64>) -> [f64; 6] {
    let turn = arm.cross(m);
    [turn.x, turn.y, turn.z, m.x, m.y, m.z]
}
