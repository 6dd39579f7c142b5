//! Robots that err by place: their answer is the rigid one that fits best, and as exact as it says.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use handeye::{
    Calibration, Config, Observation, Session, Setup, TargetPose, calibrate,
    simulate::{ArmErrors, Cell, CellNoise, Viewing},
};
use nalgebra::{Matrix6, Vector6};

const CAPTURES: usize = 20;
/// Poses that tell which rigid answer fits best.
const MORE: usize = 100;

/// A cell's first captures as bare pose pairs, and those after them without the camera's noise.
fn captures(errors: ArmErrors, setup: Setup, seed: u64) -> (Session, Session) {
    let usual = Cell::new(setup, 500 + seed);
    let cell = Cell {
        captures: CAPTURES + MORE,
        placements: 0,
        touches: 0,
        arm: Some(errors),
        noise: CellNoise {
            robot_absolute_m: 0.0,
            robot_absolute_rad: 0.0,
            robot_systematic_m: 0.0,
            robot_systematic_rad: 0.0,
            ..CellNoise::default()
        },
        viewing: Viewing { spin_rad: 1.0, tilt_rad: 0.6, ..usual.viewing },
        ..usual
    };
    let (session, truth) = cell.session(seed).unwrap();
    let bare = |o: &Observation, camera_from_target| Observation {
        candidates: vec![TargetPose { camera_from_target, covariance: None }],
        ..Observation::bare(o.capture.clone(), o.base_from_flange, camera_from_target)
    };
    let (first, more) = session.observations.split_at(CAPTURES);
    let seen = first.iter().map(|o| bare(o, o.candidates[0].camera_from_target)).collect();
    let exact = more.iter().zip(&truth.camera_from_target[CAPTURES..]);
    let exact = exact.map(|(o, truth)| bare(o, *truth)).collect();
    (Session::of_captures(setup, seen), Session::of_captures(setup, exact))
}

fn run(session: &Session) -> Calibration {
    let config = Config { max_error_mm: Some(50.0), ..Config::default() };
    calibrate(session, &config).unwrap()
}

fn errs_by_place(found: &Calibration) -> bool {
    found.warnings.iter().any(|w| w.code == "robot-errs-by-place")
}

/// The step from the answer to the best one, and its covariance.
fn off(found: &Calibration, more: &Session) -> (Vector6<f64>, Matrix6<f64>) {
    let of_more = run(more);
    let best = of_more.candidates.iter().find(|c| c.name == "least-squares").unwrap();
    let x = found.hand_eye.mount_from_camera.unwrap();
    let rows = found.hand_eye.covariance.mount_from_camera.unwrap();
    let step = x.local(&best.hand_eye.mount_from_camera.unwrap());
    (step, Matrix6::from_fn(|i, j| rows[i][j]))
}

#[test]
fn a_robot_that_errs_by_place_is_named_and_the_best_rigid_answer_is_as_near_as_stated() {
    let errors = ArmErrors { length_m: 0.4e-3, angle_rad: 8e-4, ..ArmErrors::default() };
    let (mut named, mut squares, mut cells) = (0, 0.0, 0u32);
    let (mut own, mut independent) = (0.0, 0.0);
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for seed in 0..6 {
            let (session, more) = captures(errors, setup, seed);
            let found = run(&session);
            named += u32::from(errs_by_place(&found));
            cells += 1;
            let (step, covariance) = off(&found, &more);
            squares += step.dot(&(covariance.try_inverse().unwrap() * step));
            own += step.fixed_rows::<3>(3).norm_squared();
            let joint = found.candidates.iter().find(|c| c.name == "joint").unwrap();
            let x = found.hand_eye.mount_from_camera.unwrap();
            let from_joint = joint.hand_eye.mount_from_camera.unwrap().local(&x.retract(&step));
            independent += from_joint.fixed_rows::<3>(3).norm_squared();
        }
    }
    assert!(named * 4 >= cells * 3, "{named} of {cells}");
    // 6 where the stated covariance is that of the error; the best answer here weighs rotations otherwise, and
    // its arms err more than most
    let mean = squares / f64::from(cells);
    assert!((2.0..20.0).contains(&mean), "{mean}");
    assert!(own < 0.8 * independent, "{own} {independent}");
}

#[test]
fn a_robot_that_does_not_is_left_alone() {
    let mut named = 0;
    for seed in 0..12 {
        let (session, _) = captures(ArmErrors::NONE, Setup::EyeInHand, seed);
        named += usize::from(errs_by_place(&run(&session)));
    }
    assert!(named <= 1, "{named} of 12");
}
