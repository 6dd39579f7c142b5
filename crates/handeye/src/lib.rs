//! Hand-eye calibration.

pub mod calibrate;
pub mod detect;
pub mod error;
pub mod estimate;
pub mod findings;
pub mod frame;
pub mod intrinsics;
pub mod math;
pub mod mistakes;
pub mod model;
pub mod register;
pub mod simulate;
pub mod solve;
pub mod tools;

pub use calibrate::result::Calibration;
pub use calibrate::sequence::calibrate_sequence;
pub use calibrate::streams::{Stamped, Streams, calibrate_moving, calibrate_streams};
pub use calibrate::unscaled::calibrate_unscaled;
pub use calibrate::{AnswerFrame, Config, Unknown, calibrate, unjudged};
pub use error::Error;
pub use findings::Warning;
pub use frame::{
    Anchor, Base, Camera, FirstJoint, Flange, Frame, LastLink, Mount, Point, Pose, Target, Tip,
    Tool, quaternion_xyzw,
};
pub use model::camera::{Distortion, Intrinsics};
pub use model::image::GrayImage;
pub use model::mesh::TriangleMesh;
pub use model::observation::{
    Correspondence, HandEye, ImageCorner, Observation, Placement, PosePair, Setup, SurfaceCorner,
    TargetPose, Touch, Workspace,
};
pub use model::scan::Scan;
pub use model::session::{KnownPosition, LensSigma, Session, TargetSize};
pub use model::target::TargetModel;
pub use model::verdict::Verdict;
/// Vectors, matrices and rotations of this library's functions, in the version that they take.
pub use nalgebra;
pub use solve::Method;
