//! What bare target poses may leave open beside both poses: the unit of their distances, and the
//! camera's clock against the robot's.
//!
//! Both act on a view as a motion of its target pose, `C exp(c)`:
//!
//! ```text
//! larger by the share s:     c = (0, Rᵀ t) s                     C = (R, t)
//! clock ahead by τ more:     c = -Ad((X C)⁻¹) v τ                v = velocity of the mount
//! ```
//!
//! the second because `C` at the time of `A exp(v τ)` is `X⁻¹ exp(-v τ) A⁻¹ Y`.

use std::collections::BTreeMap;

use nalgebra::{SMatrix, Vector6};

use crate::{
    HandEye,
    calibrate::{result::Calibration, views::Views},
    detect::sight::{CLOCK, Sight, TARGET_SCALE},
    estimate::{Extra, ExtraKind, JointFit},
    math::lie,
    solve::View,
};

/// Unknowns beside both poses; by default there are none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Unknown {
    /// Distances to the target are known up to one factor, and given with a factor near one.
    pub scale: bool,
    /// How the mount moves, by the name of the capture: velocity (rad/s, m/s) against the anchor,
    /// in the mount frame. Where there are any, the camera's clock is free; stamps are given nearly
    /// right.
    pub velocities: BTreeMap<String, Vector6<f64>>,
}

/// Standard deviation of the belief in a factor: far more than any motion leaves open.
const ANY_SCALE: f64 = 10.0;
/// Standard deviation of the belief in a time offset (s): the same.
const ANY_TIME: f64 = 10.0;
/// A factor known no better than this leaves the distances open.
const FREE_SCALE: f64 = 0.2;
/// A time offset known no better than this (s) pairs nothing: robots move by decimetres meanwhile.
const FREE_TIME: f64 = 0.5;

impl Unknown {
    /// The unknowns, about where the data stand now.
    pub(super) fn extras(&self) -> Vec<Extra> {
        extras(self.scale, self.clock())
    }

    fn clock(&self) -> bool {
        !self.velocities.is_empty()
    }

    /// Tells the views how they move with the unknowns.
    pub(super) fn set_free(&self, views: &mut Views, at: &HandEye) {
        if self.scale || self.clock() {
            for (view, o) in views.views.iter_mut().zip(&views.used) {
                *view = self.freed(view, self.velocities.get(&o.capture), at);
            }
        }
    }

    /// A view that moves with the unknowns.
    pub(crate) fn freed(&self, view: &View, velocity: Option<&Vector6<f64>>, at: &HandEye) -> View {
        let c = &view.pair.camera_from_target;
        let known = match &view.sight {
            Some(sight) => Sight::clone(sight),
            None => Sight::moving(SMatrix::zeros()),
        };
        let mut by = known.by_camera;
        if self.scale {
            by.set_column(TARGET_SCALE, &Sight::by_size(c));
        }
        if let Some(velocity) = velocity {
            let target_from_mount = (at.mount_from_camera * *c).inverse();
            by.set_column(CLOCK, &(-lie::adjoint(target_from_mount.iso()) * velocity));
        }
        View { sight: Some(Sight { by_camera: by, ..known }.into()), ..view.clone() }
    }

    /// Reports what the fit found, as a change of what was given; `None` where the data leave it
    /// open.
    pub(super) fn report(&self, fit: &JointFit, result: &mut Calibration) {
        if self.scale {
            let found = scale(fit);
            result.scale = found.map(|s| s.0);
            result.scale_sigma = found.map(|s| s.1);
            if found.is_none() {
                result.undetermined.push("scale of the measured distances".into());
            }
        }
        if self.clock() {
            let found = clock(fit);
            result.time_offset_s = found.map(|t| t.0);
            result.time_offset_sigma_s = found.map(|t| t.1);
        }
    }
}

/// The unknowns that are free.
pub(super) fn extras(scale: bool, clock: bool) -> Vec<Extra> {
    let unit = Extra::about_zero(ExtraKind::Camera(TARGET_SCALE), ANY_SCALE);
    let time = Extra::about_zero(ExtraKind::Camera(CLOCK), ANY_TIME);
    [scale.then_some(unit), clock.then_some(time)].into_iter().flatten().collect()
}

/// `measured / metric` and its standard deviation; `None` where the fit leaves it open.
pub(crate) fn scale(fit: &JointFit) -> Option<(f64, f64)> {
    let (share, sigma) = fit.extra(ExtraKind::Camera(TARGET_SCALE))?;
    let larger = 1.0 + share;
    (sigma < FREE_SCALE && larger > 0.0).then(|| (1.0 / larger, sigma / larger.powi(2)))
}

/// How much farther the camera's clock is ahead (s) and its standard deviation; `None` where the fit
/// leaves it open.
pub(crate) fn clock(fit: &JointFit) -> Option<(f64, f64)> {
    fit.extra(ExtraKind::Camera(CLOCK)).filter(|(_, sigma)| *sigma < FREE_TIME)
}
