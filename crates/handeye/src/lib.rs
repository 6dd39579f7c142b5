//! Hand-eye calibration.

pub mod calibrate;
pub mod calibration;
pub mod camera;
pub mod certify;
mod chance;
pub mod detect;
pub mod diagnose;
pub mod dictionary;
pub mod error;
pub mod evaluate;
pub mod findings;
pub mod frame;
mod gram;
pub mod image;
pub mod intrinsics;
pub mod kinematics;
pub mod lens;
pub mod lie;
pub mod linalg;
pub mod observation;
pub mod parallel;
pub mod pivot;
pub mod pixel_origin;
pub mod plan;
pub mod predict;
pub mod refine;
pub mod register;
pub mod repeat;
pub mod scan;
pub mod scene;
pub mod sequence;
pub mod simulate;
pub mod solve;
pub mod streams;
pub mod target;
pub mod target_art;
pub mod touches;
pub mod triangle_mesh;
pub mod unscaled;
pub mod verify;

pub use calibrate::{
    AnswerFrame, Config, LensSigma, Session, TargetSize, Unknown, calibrate, unjudged,
};
pub use calibration::{Calibration, Verdict};
pub use camera::{Distortion, Intrinsics};
pub use error::{Error, Warning};
pub use frame::{
    Anchor, Base, Camera, FirstJoint, Flange, Frame, LastLink, Mount, Point, Pose, Target, Tip,
    Tool, quaternion_xyzw,
};
pub use image::GrayImage;
/// Vectors, matrices and rotations of this library's functions, in the version that they take.
pub use nalgebra;
pub use observation::{
    Correspondence, HandEye, ImageCorner, Observation, Placement, PosePair, Setup, SurfaceCorner,
    TargetPose, Touch, Workspace,
};
pub use scan::Scan;
pub use sequence::calibrate_sequence;
pub use solve::Method;
pub use streams::{Stamped, Streams, calibrate_moving, calibrate_streams};
pub use target::TargetModel;
pub use triangle_mesh::TriangleMesh;
pub use unscaled::calibrate_unscaled;
