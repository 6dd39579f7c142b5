//! Refinement of both unknowns from a start, with covariance.
//!
//! [`joint`] is the estimator: one maximum-likelihood fit of everything that was measured, the
//! noise of every source estimated alongside, `system` its equations. `drift` is the same for views
//! taken one after the other, whose errors may change slowly. Plain least squares, for starts and for
//! comparison, are in [`crate::solve::least_squares`].

pub mod certify;
pub mod drift;
pub mod evaluate;
pub mod extra;
pub mod joint;
pub mod noise;
pub(crate) mod observability;
pub mod predict;
pub mod problem;
mod system;
pub mod touched;
pub mod touches;

pub use extra::{Extra, ExtraKind};
pub use joint::{fit_joint, fit_views};
pub(crate) use noise::Sigma;
pub use noise::{KnownNoise, NoiseModel, Source};
pub use problem::{JointFit, Problem};
pub use touched::{TouchedBoard, TouchedCorner};
