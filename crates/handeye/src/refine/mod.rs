//! Refinement of both unknowns from a start, with covariance.

pub mod noise;
pub mod pose_fit;

pub use noise::{NoiseModel, Sigma};
pub use pose_fit::{PoseFit, View, fit, fit_estimating_noise, fit_fixed_weights};
