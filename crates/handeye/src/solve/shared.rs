//! What all closed forms share: what is too little, and where the target is once the camera's place is known.

use nalgebra::{Isometry3, Vector3};

use crate::{Camera, Error, HandEye, Mount, Pose, PosePair, math::linalg};

/// Fewest captures that can fix the answer: two motions about different axes.
pub const FEWEST_POSES: usize = 3;

/// An answer that is left open, and by what.
pub(super) fn open(what: &str) -> Error {
    Error::NotDetermined { what: what.into() }
}

/// The answer whose camera is at `x`; the target where it fits best.
pub(super) fn place(pairs: &[PosePair], x: Isometry3<f64>) -> HandEye {
    place_target(pairs, &Pose::claim(x))
}

/// Says that there are too few captures.
pub(crate) fn too_few(found: usize) -> Error {
    Error::TooFewPoses {
        found,
        needed: FEWEST_POSES,
        advice: "take 10 to 15, the robot tilted by 30 degrees and more about two axes".into(),
    }
}

/// The target's place that fits best once the camera's is known: the mean of `A X B⁻¹`.
pub fn place_target(pairs: &[PosePair], mount_from_camera: &Pose<Mount, Camera>) -> HandEye {
    let seen: Vec<_> = pairs
        .iter()
        .map(|p| p.anchor_from_mount * *mount_from_camera * p.camera_from_target)
        .collect();
    let rotation = linalg::mean_rotation(seen.iter().map(|y| &y.iso().rotation));
    let translation =
        seen.iter().map(|y| y.translation()).sum::<Vector3<f64>>() / seen.len().max(1) as f64;
    HandEye {
        mount_from_camera: *mount_from_camera,
        anchor_from_target: Pose::claim(Isometry3::from_parts(translation.into(), rotation)),
    }
}
