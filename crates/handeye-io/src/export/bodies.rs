//! Frames of a camera that its URDF knows: where the optical frame lies in the body.

use std::path::Path;

use handeye::{
    Calibration, Pose,
    calibrate::result::{BodyFrame, FrameNames},
};

use crate::{Error, robot};

/// A calibration that knows the link `body` of a URDF, which fixed joints connect with the link `optical`, the frame that
/// the camera was calibrated in (x right, y down, z forward).
///
/// # Errors
/// What is no URDF, links that it does not have, joints between them that move.
pub fn with_body(
    calibration: Calibration,
    urdf: &Path,
    body: &str,
    optical: &str,
) -> Result<Calibration, Error> {
    let body_from_camera = Pose::claim(robot::rigid(urdf, body, optical)?);
    let frames = calibration.frames.clone().unwrap_or_default();
    let others = frames.bodies.into_iter().filter(|other| other.name != body);
    let bodies = [BodyFrame { name: body.into(), body_from_camera }].into_iter().chain(others);
    let frames = FrameNames { camera: Some(optical.into()), bodies: bodies.collect(), ..frames };
    Ok(calibration.with_frames(Some(frames)))
}
