//! From poses of a robot and of a board to where the camera sits on the robot.
//!
//!     cargo run --release -p handeye --example from_poses

use handeye::{
    Base, Camera, Config, Error, Flange, Observation, Pose, Session, Setup, Target, Verdict,
    calibrate,
    nalgebra::{Isometry3, Vector3},
};

/// Fifteen flange poses: position in metres, and rotation vector in radians, as a pendant of UR shows them.
const FLANGE: [[f64; 6]; 15] = [
    [0.52, 0.05, 0.45, 3.05, 0.22, -0.10],
    [0.61, -0.12, 0.41, 2.91, -0.35, 0.24],
    [0.48, -0.21, 0.52, 2.78, 0.61, -0.31],
    [0.66, 0.14, 0.38, 3.00, -0.10, 0.55],
    [0.57, 0.22, 0.47, 2.62, 0.43, 0.38],
    [0.45, 0.11, 0.55, 2.84, -0.52, -0.42],
    [0.63, -0.03, 0.50, 2.70, 0.15, -0.66],
    [0.50, -0.15, 0.39, 3.08, 0.35, 0.18],
    [0.58, 0.08, 0.56, 2.55, -0.25, 0.12],
    [0.69, -0.09, 0.44, 2.93, 0.54, 0.47],
    [0.54, 0.18, 0.42, 2.80, -0.41, -0.22],
    [0.47, -0.05, 0.49, 2.97, 0.08, 0.71],
    [0.60, 0.02, 0.37, 2.68, -0.60, 0.33],
    [0.55, -0.19, 0.53, 2.88, 0.30, -0.48],
    [0.64, 0.20, 0.46, 2.74, -0.18, -0.28],
];

fn main() -> Result<(), Error> {
    // what your robot reports and your camera sees stands here; this cell knows where its camera is
    let flange_from_camera: Pose<Flange, Camera> = pose([0.03, -0.06, 0.09], [0.02, -0.01, 1.57]);
    let base_from_target: Pose<Base, Target> = pose([0.56, 0.01, -0.02], [0.0, 0.01, 0.4]);
    let captures = FLANGE.iter().enumerate().map(|(k, [x, y, z, rx, ry, rz])| {
        let base_from_flange: Pose<Base, Flange> = pose([*x, *y, *z], [*rx, *ry, *rz]);
        // frames are types: a product that makes no sense does not compile
        let base_from_camera = base_from_flange * flange_from_camera;
        let camera_from_target = base_from_camera.inverse() * base_from_target;
        Observation::bare(format!("{k:02}"), base_from_flange, measured(camera_from_target, k))
    });
    let session = Session::of_captures(Setup::EyeInHand, captures.collect());

    let result = calibrate(&session, &Config::default())?;

    println!("{:?}: {}", result.verdict, result.reasons.join("; "));
    assert_eq!(result.verdict, Verdict::Accepted);
    if let Some(found) = result.hand_eye.mount_from_camera {
        println!("flange_from_camera: {:.4?} m", found.translation().as_slice());
    }
    if let Some(predicted) = &result.predicted_tre_mm {
        println!("95 % of the points in the workspace within {:.2} mm", predicted.p95);
    }
    for finding in &result.findings {
        println!("{}: {}", finding.code, finding.message);
    }
    Ok(())
}

/// A pose from a position and a rotation vector.
fn pose<A: handeye::Frame, B: handeye::Frame>(
    position: [f64; 3],
    rotation: [f64; 3],
) -> Pose<A, B> {
    Pose::claim(Isometry3::new(Vector3::from(position), Vector3::from(rotation)))
}

/// The pose as a camera measures it: some tenths of a millimetre and hundredths of a degree off.
fn measured(pose: Pose<Camera, Target>, k: usize) -> Pose<Camera, Target> {
    let noise = |n: usize| ((7 * k + 13 * n) as f64 * 2.4).sin();
    let position = [0, 1, 2].map(|n| 2e-4 * noise(n));
    let rotation = [3, 4, 5].map(|n| 4e-4 * noise(n));
    pose * self::pose::<Target, Target>(position, rotation)
}
