use super::*;
use crate::{
    Observation, Pose, Setup, calibrate,
    math::random::Random,
    solve::tests::{exact_pairs, pose, truths},
};

fn session(setup: Setup, pairs: &[PosePair]) -> Session {
    let observation = |(k, p): (usize, &PosePair)| {
        let robot = match setup {
            Setup::EyeInHand => p.anchor_from_mount.rename(),
            Setup::EyeToHand => p.anchor_from_mount.inverse().rename(),
        };
        Observation::bare(format!("{k:03}"), robot, p.camera_from_target)
    };
    Session {
        in_sequence: true,
        ..Session::of_captures(setup, pairs.iter().enumerate().map(observation).collect())
    }
}

/// Pairs whose target drifts by so much (rad, m) a capture, under a little noise.
fn drifting(count: usize, seed: u64, (turn, shift): (f64, f64)) -> Vec<PosePair> {
    let mut random = Random::new(seed);
    let mut drift = Pose::identity();
    let mut pairs = exact_pairs(&truths()[0], count);
    for pair in &mut pairs {
        let carry = lie::adjoint(pair.camera_from_target.inverse().iso());
        let step = lie::tangent(&(random.normal3() * turn), &(random.normal3() * shift));
        drift = drift.retract(&(carry * step));
        let own = lie::tangent(&(random.normal3() * 3e-4), &(random.normal3() * 3e-4));
        pair.camera_from_target = (pair.camera_from_target * drift.inverse()).retract(&own);
    }
    pairs
}

const SLOW: (f64, f64) = (1e-3, 1e-3);

/// The same of a camera that moves in its holder.
fn loose(count: usize, seed: u64, (turn, shift): (f64, f64)) -> Vec<PosePair> {
    let mut random = Random::new(seed);
    let mut drift: Pose<crate::Camera, crate::Camera> = Pose::identity();
    let mut pairs = exact_pairs(&truths()[0], count);
    for pair in &mut pairs {
        let step = lie::tangent(&(random.normal3() * turn), &(random.normal3() * shift));
        drift = drift.retract(&step);
        let own = lie::tangent(&(random.normal3() * 3e-4), &(random.normal3() * 3e-4));
        pair.camera_from_target = (drift.inverse() * pair.camera_from_target).retract(&own);
    }
    pairs
}

fn solved(session: &Session) -> Calibration {
    calibrate(session, &Config::default()).unwrap()
}

/// The same as if the errors of captures were independent.
fn as_independent(session: &Session) -> Calibration {
    calibrate(&Session { in_sequence: false, ..session.clone() }, &Config::default()).unwrap()
}

fn miss(found: &Calibration) -> f64 {
    let truth = truths()[0].mount_from_camera;
    found.hand_eye.mount_from_camera.unwrap().distance_to(&truth)
}

#[test]
fn independent_errors_leave_the_calibration_as_it_is() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let session = session(setup, &drifting(30, 1, (0.0, 0.0)));
        assert_eq!(solved(&session), as_independent(&session));
    }
}

#[test]
fn drift_is_found_and_the_answer_is_better() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let (mut with, mut without) = (0.0, 0.0);
        for seed in 0..6 {
            let session = session(setup, &drifting(50, seed, SLOW));
            let found = solved(&session);
            assert_eq!(found.chosen.as_deref(), Some(NAME), "seed {seed}");
            assert!(found.warnings.iter().any(|w| w.code == "drift"));
            assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
            let predicted = found.predicted_tre_mm.as_ref().unwrap();
            assert!(miss(&found) * 1e3 < 3.0 * predicted.rms, "{} {predicted:?}", miss(&found));
            with += miss(&found).powi(2);
            let plain = as_independent(&session);
            without += miss(&plain).powi(2);
        }
        assert!(with < 0.5 * without, "{setup:?}: {with} {without}");
    }
}

#[test]
fn a_camera_that_moves_in_its_holder_is_found_and_told_from_other_drift() {
    let told = |pairs: &[PosePair], side: &str| {
        let found = solved(&session(Setup::EyeInHand, pairs));
        let warning = found.warnings.iter().find(|w| w.code == "drift");
        usize::from(warning.is_some_and(|w| w.message.contains(side)))
    };
    let (mut camera, mut target) = (0, 0);
    for seed in 0..10 {
        camera += told(&loose(30, seed, SLOW), "the camera seems to move in its holder");
        target += told(&drifting(30, seed, SLOW), "the target or the robot seems to move");
    }
    assert!(camera >= 9 && target >= 9, "{camera} {target}");
}

#[test]
fn a_camera_that_walks_away_has_no_place() {
    let found = solved(&session(Setup::EyeInHand, &loose(30, 101, SLOW)));
    assert_eq!(found.verdict, Verdict::Rejected);
    assert!(found.reasons[0].contains("fasten it"), "{:?}", found.reasons);
}

#[test]
fn wrong_captures_are_left_out_beside_drift() {
    let mut pairs = drifting(50, 3, SLOW);
    for k in [7, 8, 21, 40] {
        pairs[k].camera_from_target = pose([0.1, 0.2, 0.4 + 0.01 * k as f64], [0.1, 2.0, k as f64]);
    }
    let found = solved(&session(Setup::EyeInHand, &pairs));
    assert_eq!(found.chosen.as_deref(), Some(NAME));
    assert_eq!(found.rejected, ["007", "008", "021", "040"]);
    assert!(miss(&found) < 3e-3, "{}", miss(&found));
}

#[test]
fn drift_does_not_excuse_robot_poses_in_the_wrong_order() {
    let pairs = drifting(40, 2, SLOW);
    let mut session = session(Setup::EyeInHand, &pairs);
    let robot: Vec<_> = session.observations.iter().map(|o| o.base_from_flange).collect();
    for (o, pose) in session.observations.iter_mut().zip(robot.iter().rev()) {
        o.base_from_flange = *pose;
    }
    assert_ne!(solved(&session).verdict, Verdict::Accepted);
}

#[test]
fn times_tell_the_order_and_names_do_not() {
    let pairs = drifting(40, 4, SLOW);
    let named = session(Setup::EyeInHand, &pairs);
    let mut renamed = named.clone();
    for (k, o) in renamed.observations.iter_mut().enumerate() {
        o.capture = format!("{:03}", 7 * k % 41);
        o.time_s = Some(k as f64 * 0.1);
    }
    let found = solved(&renamed);
    assert_eq!(found.chosen.as_deref(), Some(NAME));
    let wanted = solved(&named).hand_eye.mount_from_camera.unwrap();
    let x = found.hand_eye.mount_from_camera.unwrap();
    assert!(x.distance_to(&wanted) < 1e-4, "{}", x.distance_to(&wanted));
}

#[test]
fn a_method_asked_for_by_name_is_run_as_published() {
    let session = session(Setup::EyeInHand, &drifting(30, 5, SLOW));
    let config = Config { method: Some(crate::Method::Shah), ..Config::default() };
    let found = calibrate(&session, &config).unwrap();
    assert_eq!(found.method, "closed-form-shah");
}
