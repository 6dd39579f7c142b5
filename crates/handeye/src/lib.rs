//! Hand-eye calibration.

pub mod camera;
pub mod detect;
pub mod error;
pub mod frame;
pub mod image;
pub mod intrinsics;
pub mod lie;
pub mod observation;
pub mod scan;
pub mod simulate;
pub mod target;

pub use camera::{Distortion, Intrinsics};
pub use error::{Error, Warning};
pub use frame::{Anchor, Base, Camera, Flange, Frame, Mount, Point, Pose, Target, Tip, Tool};
pub use image::GrayImage;
pub use observation::{
    Correspondence, HandEye, ImageCorner, Observation, Placement, PosePair, Setup, SurfaceCorner,
    TargetPose, Touch, Workspace,
};
pub use scan::Scan;
pub use target::TargetModel;
