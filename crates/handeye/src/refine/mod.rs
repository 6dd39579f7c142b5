//! Refinement of both unknowns from a start, with covariance.
//!
//! [`joint`] is the estimator: one maximum-likelihood fit of everything that was measured, the
//! noise of every source estimated alongside, `system` its equations. [`drift`] is the same for views
//! taken one after the other, whose errors may change slowly. [`pose_fit`] is least squares, for
//! starts and for comparison.

pub mod drift;
pub mod extra;
pub mod joint;
pub mod noise;
pub mod pose_fit;
mod system;
pub mod touched;

pub use extra::{Extra, ExtraKind};
pub use joint::{JointFit, KnownPosition, Problem, fit_joint, fit_views};
pub use noise::{KnownNoise, NoiseModel, Sigma, Source};
pub(crate) use pose_fit::fit_weighted;
pub use pose_fit::{View, fit_fixed_weights};
pub use touched::{TouchedBoard, TouchedCorner};
