//! Estimates `X = mount_from_camera` and `Y = anchor_from_target`, with covariance, from a start value.
//!
//! [`joint`] is the estimator: one maximum-likelihood fit of everything that was measured, with the noise of every
//! source ([`noise`]) and further unknowns ([`extra`]); `system` holds its equations, [`touch_residual`] those of touches.
//! [`place`] adds errors of the robot that belong to where it stands, `projection` makes the rigid answer from such a
//! fit; `drift` is for views taken one after the other, whose errors change slowly. [`evaluate`] leaves captures out,
//! [`predict`] states the error at the workpiece, `observability` names what the data leave free, [`certify`] proves an
//! optimum global, [`touch_pairs`] registers touches by point pairs. Plain least squares are in
//! [`crate::solve::least_squares`].

pub mod certify;
pub mod compensation;
pub mod drift;
pub mod evaluate;
pub mod extra;
pub mod joint;
pub mod noise;
pub(crate) mod observability;
pub mod place;
pub mod predict;
pub mod problem;
pub(crate) mod projection;
mod system;
pub mod touch_pairs;
pub mod touch_residual;

pub use extra::{Extra, ExtraKind};
pub use joint::{fit_joint, fit_views};
pub(crate) use noise::Sigma;
pub use noise::{KnownNoise, NoiseModel, Source};
pub use problem::{JointFit, Problem};
pub use touch_residual::{TouchedBoard, TouchedCorner};
