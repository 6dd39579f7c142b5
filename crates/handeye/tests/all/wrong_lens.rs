//! A focal length that is a little wrong beside robots that are exact, and that are not.

use handeye::{
    Calibration, Config, LensSigma, Pose, Session, Setup, Verdict, calibrate, detect,
    estimate::predict::{Volume, difference},
    model::camera::PARAMETERS,
    simulate::{Cell, CellNoise, Truth},
};
use nalgebra::SVector;

/// The share by which the focal length that is given is too long.
const WRONG: f64 = 2e-3;

/// Images as rendered ones are measured: 0.05 px.
const EXACT: CellNoise = CellNoise { corner_px: 0.05, ..CellNoise::NONE };

fn session(setup: Setup, seed: u64, captures: usize, noise: CellNoise) -> (Session, Truth) {
    let cell = Cell { noise, captures, placements: 0, touches: 0, ..Cell::new(setup, seed) };
    let (mut session, truth) = cell.session(seed).unwrap();
    let mut longer = SVector::<f64, PARAMETERS>::zeros();
    longer[0] = cell.intrinsics.fx * WRONG; // and fy in proportion
    let camera = cell.intrinsics.moved(&longer);
    session.camera = Some(camera);
    for o in &mut session.observations {
        let posed = detect::target_poses(&o.corners, &[], &cell.target, &camera).unwrap();
        o.candidates = detect::with_symmetries(&posed, &cell.target);
    }
    (session, truth)
}

fn off_mm(truth: &Truth, found: &Pose<handeye::Mount, handeye::Camera>) -> f64 {
    truth.hand_eye.mount_from_camera.distance_to(found) * 1e3
}

fn of(found: &Calibration, candidate: &str) -> Pose<handeye::Mount, handeye::Camera> {
    let candidate = found.candidates.iter().find(|c| c.name == candidate).unwrap();
    candidate.hand_eye.mount_from_camera.unwrap()
}

#[test]
fn an_exact_robot_shows_that_the_focal_length_is_wrong() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for (seed, captures) in [(1, 15), (2, 19), (3, 30)] {
            let (session, truth) = session(setup, seed, captures, EXACT);
            let found = calibrate(&session, &Config::default()).unwrap();
            assert_eq!(found.verdict, Verdict::Accepted, "{setup:?} {:?}", found.reasons);
            let camera = found.camera.expect("a camera that was found wrong").intrinsics;
            let left = (camera.fx / 1800.0 - 1.0).abs();
            let off = off_mm(&truth, &found.hand_eye.mount_from_camera.unwrap());
            println!(
                "{setup:?} {captures} captures: off by {off:.3} mm, Shah {:.2} mm, focal length \
                 {left:.1e}",
                off_mm(&truth, &of(&found, "closed-form-shah"))
            );
            assert!(left < 0.1 * WRONG, "{setup:?} {captures}: {left:.1e}");
            assert!(off < 0.25, "{setup:?} {captures}: {off}");
        }
    }
}

/// 95 % point of the error over what the camera saw, over the stated one.
fn ratio(session: &Session, truth: &Truth, found: &Calibration) -> f64 {
    let target = session.target.as_ref().unwrap();
    let seen = session.observations.iter().map(|o| o.candidates[0].camera_from_target);
    let points =
        seen.flat_map(|view| target.corners().into_iter().map(move |c| (view * c).vector()));
    let seen = Volume::around(points, "what the camera saw").unwrap();
    let own = found.hand_eye.mount_from_camera.unwrap();
    let off = difference(&truth.hand_eye.mount_from_camera, &own);
    let mut all: Vec<f64> = seen.points.iter().map(|p| off(p).norm() * 1e3).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() * 95 / 100] / found.predicted_tre_mm.as_ref().unwrap().p95
}

/// Beside a robot that errs by 0.6 mm the same error is three to four times its own uncertainty, and drowns at times;
/// the stated error must know that.
#[test]
fn beside_a_usual_robot_the_stated_error_covers_it() {
    let noise =
        CellNoise { robot_absolute_m: 0.6e-3, robot_absolute_rad: 6e-4, ..CellNoise::default() };
    let ratio = |seed: u64| {
        let (session, truth) = session(Setup::EyeToHand, seed, 15, noise);
        let found = calibrate(&session, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Accepted, "{seed} {:?}", found.reasons);
        ratio(&session, &truth, &found)
    };
    let all: Vec<f64> = (40..60).map(ratio).collect();
    let covered = all.iter().filter(|r| **r <= 1.0).count();
    println!("{covered} of 20 are covered: {all:.2?}");
    assert!(covered >= 14 && all.iter().all(|r| *r < 1.75), "{covered}: {all:.2?}");
}

/// Whoever states how well a lens is known is believed against the robot.
#[test]
fn a_stated_lens_is_kept() {
    let (mut session, _) = session(Setup::EyeToHand, 5, 20, EXACT);
    let moved = |session: &Session| {
        let found = calibrate(session, &Config::default()).unwrap();
        found.camera.map_or(0.0, |c| c.intrinsics.fx - session.camera.unwrap().fx)
    };
    assert!(moved(&session) < -0.9 * WRONG * 1800.0);
    session.lens_sigma = Some(LensSigma { focal_px: Some(0.05), center_px: Some(0.1) });
    assert_eq!(moved(&session), 0.0);
}
