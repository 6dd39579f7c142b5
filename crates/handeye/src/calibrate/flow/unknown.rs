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

use nalgebra::{SMatrix, Vector6};

use super::{config::Config, evidence::UnitAndClock, views::Views};
use crate::{
    HandEye,
    detect::sight::{CLOCK, Sight, TARGET_SCALE},
    estimate::{Extra, ExtraKind, JointFit},
    math::lie,
    model::session::Session,
    solve::View,
};

/// Unknowns beside both poses, with where they stood before; by default there are none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Unknown {
    /// The factor (measured over metric) that was taken out of the distances to the target: it is free about one.
    pub scale: Option<f64>,
    /// Camera time minus robot time (s) as it was taken out of the times: it is free about zero.
    pub time_offset_s: Option<f64>,
}

/// Prior standard deviation of a factor: far more than any motion leaves open.
const ANY_SCALE: f64 = 10.0;
/// Prior standard deviation of a time offset (s): the same.
const ANY_TIME: f64 = 10.0;
/// A factor known no better than this leaves the distances open.
const FREE_SCALE: f64 = 0.2;
/// A time offset known no better than this (s) pairs nothing: robots move by decimetres meanwhile.
const FREE_TIME: f64 = 0.5;

/// What is asked of captures: what the user wants, and what is free beside both poses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Task<'a> {
    pub config: &'a Config,
    pub unknown: Unknown,
}

impl Unknown {
    /// What a session leaves open of which nothing was taken out.
    pub fn of(session: &Session) -> Self {
        let moves = session.observations.iter().any(|o| o.velocity.is_some());
        Self { scale: None, time_offset_s: moves.then_some(0.0) }
    }

    /// The unknowns of a fit, about where the data stand now.
    pub fn extras(&self) -> Vec<Extra> {
        let unit = Extra::about_zero(ExtraKind::Camera(TARGET_SCALE), ANY_SCALE);
        let time = Extra::about_zero(ExtraKind::Camera(CLOCK), ANY_TIME);
        self.scale.map(|_| unit).into_iter().chain(self.time_offset_s.map(|_| time)).collect()
    }

    /// Lets the views move with the unknowns.
    pub(crate) fn set_free(&self, views: &mut Views, at: &HandEye) {
        if *self != Self::default() {
            for (view, o) in views.views.iter_mut().zip(&views.used) {
                *view = self.freed(view, o.velocity.as_ref(), at);
            }
        }
    }

    /// A view that moves with the unknowns.
    pub fn freed(&self, view: &View, velocity: Option<&Vector6<f64>>, at: &HandEye) -> View {
        let c = &view.pair.camera_from_target;
        let known = match &view.sight {
            Some(sight) => Sight::clone(sight),
            None => Sight::moving(SMatrix::zeros()),
        };
        let mut by = known.by_camera;
        if self.scale.is_some() {
            by.set_column(TARGET_SCALE, &Sight::by_size(c));
        }
        if let (Some(_), Some(velocity)) = (self.time_offset_s, velocity) {
            let target_from_mount = (at.mount_from_camera * *c).inverse();
            by.set_column(CLOCK, &(-lie::adjoint(target_from_mount.iso()) * velocity));
        }
        View { sight: Some(Sight { by_camera: by, ..known }.into()), ..view.clone() }
    }

    /// Unit and clock for what a fit found about where they stood: a factor and a later time (s), each with its standard
    /// deviation, or `None` where the data leave them open.
    pub(crate) fn found(
        &self,
        factor: Option<(f64, f64)>,
        later: Option<(f64, f64)>,
    ) -> UnitAndClock {
        let mut found = UnitAndClock::default();
        if let Some(before) = self.scale {
            found.scale = factor.map(|(s, _)| s * before);
            found.scale_sigma = factor.map(|(_, sigma)| sigma * before);
        }
        if let Some(before) = self.time_offset_s {
            found.time_offset_s = later.map(|(t, _)| before + t);
            found.time_offset_sigma_s = later.map(|(_, sigma)| sigma);
        }
        found
    }

    /// That nothing is known of them.
    pub(crate) fn open(&self) -> UnitAndClock {
        self.found(None, None)
    }
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
