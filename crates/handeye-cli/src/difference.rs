//! How far two transforms of a camera differ, in numbers that people can picture.

use std::path::PathBuf;

use handeye::{Camera, Mount, Pose};
use nalgebra::Vector3;
use serde::Serialize;

/// Where a part may lie, m before the camera.
const BEFORE_CAMERA: f64 = 0.5;

/// One answer against the mean, or against another.
#[derive(Serialize)]
pub struct Difference {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub results: Vec<PathBuf>,
    pub camera_origin_mm: f64,
    pub half_a_metre_before_camera_mm: f64,
    pub rotation_deg: f64,
}

/// A point where a part may lie, in the camera.
pub fn far() -> Vector3<f64> {
    Vector3::new(0.0, 0.0, BEFORE_CAMERA)
}

/// Of the second from the first.
pub fn difference(
    results: &[PathBuf],
    a: &Pose<Mount, Camera>,
    b: &Pose<Mount, Camera>,
) -> Difference {
    let at = |pose: &Pose<Mount, Camera>| pose.rotation() * far() + pose.translation();
    Difference {
        results: results.to_vec(),
        camera_origin_mm: 1e3 * a.distance_to(b),
        half_a_metre_before_camera_mm: 1e3 * (at(a) - at(b)).norm(),
        rotation_deg: a.angle_to(b).to_degrees(),
    }
}

/// `p = 0.42`: as many digits as tell something.
pub fn chance(p: f64) -> String {
    match p {
        p if p < 1e-4 => "p < 0.0001".into(),
        p if p < 0.1 => format!("p = {p:.4}"),
        p => format!("p = {p:.2}"),
    }
}

#[cfg(test)]
mod tests {
    use super::chance;

    #[test]
    fn a_chance_reads_like_a_number() {
        let read = [1.0, 0.42, 0.0123, 1e-9].map(chance);
        assert_eq!(read, ["p = 1.00", "p = 0.42", "p = 0.0123", "p < 0.0001"]);
    }
}
