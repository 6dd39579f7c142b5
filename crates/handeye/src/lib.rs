//! Hand-eye calibration: where a camera sits on a robot or beside it, and how certain that is.
//!
//! One function is the flow: [`calibrate()`] takes a [`Session`] (what robot, camera and touches measured) and returns a
//! [`Calibration`] (the answer with its covariance, the verdict, and the findings beside it).
//!
//! ```
//! use handeye::{Base, Camera, Config, Flange, Observation, Pose, Session, Setup, Target, Verdict, calibrate};
//! # use handeye::simulate::Cell;
//! # let (simulated, truth) = Cell { touches: 0, ..Cell::new(Setup::EyeInHand, 1) }.session(1)?;
//! # let recorded: Vec<(Pose<Base, Flange>, Pose<Camera, Target>)> = simulated
//! #     .observations
//! #     .iter()
//! #     .map(|o| (o.base_from_flange, o.candidates[0].camera_from_target))
//! #     .collect();
//! // what the robot reported and what the camera saw of the board, in metres, twelve captures or more
//! let captures = recorded.into_iter().enumerate().map(|(k, (base_from_flange, camera_from_target))| {
//!     Observation::bare(format!("{k:03}"), base_from_flange, camera_from_target)
//! });
//! let session = Session::of_captures(Setup::EyeInHand, captures.collect());
//!
//! let result = calibrate(&session, &Config::default())?;
//!
//! assert_eq!(result.verdict, Verdict::Accepted, "{:?}", result.reasons);
//! let flange_from_camera = result.hand_eye.mount_from_camera.expect("accepted answers are determined");
//! let predicted = result.predicted_tre_mm.as_ref().expect("and their error is predicted");
//! println!("camera at {:.4} m, 95 % of the points within {:.2} mm", flange_from_camera.translation(), predicted.p95);
//! # assert!(flange_from_camera.distance_to(&truth.hand_eye.mount_from_camera) < 2e-3);
//! # Ok::<(), handeye::Error>(())
//! ```
//!
//! Images, scans and touches make better answers than poses alone: [`detect`] finds boards to a hundredth of a pixel and
//! lifts their corners onto scans, and an [`Observation`] takes both. Frames are types: [`Pose`]`<A, B>` takes points of `B`
//! to `A`, and a product compiles only where the inner frames match. Lengths are metres, angles radians.
//!
//! Modules, lowest layer first: [`math`], [`frame`], [`model`] (what there is), [`findings`] (what is noticed),
//! [`detect`], [`intrinsics`], [`solve`] (closed forms), [`register`] (points, scans, parts), [`estimate`] (the joint fit),
//! [`mistakes`], [`calibrate`](mod@calibrate), [`tools`], [`simulate`].

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
pub use calibrate::{AnswerFrame, Config, calibrate, unjudged};
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
pub use model::relative::RelativeMotion;
pub use model::scan::Scan;
pub use model::session::{KnownPosition, LensSigma, Motion, Session, Stamped, Streams, TargetSize};
pub use model::target::TargetModel;
pub use model::verdict::Verdict;
/// Vectors, matrices and rotations of this library's functions, in the version that they take.
pub use nalgebra;
pub use solve::Method;
