//! Sets so small that chance explains much.

use handeye::{
    Base, Camera, Config, Flange, Pose, Session, Setup, Target, Verdict, calibrate,
    model::session::KnownPosition,
    simulate::{Cell, Truth},
};
use nalgebra::{Isometry3, Vector3};

fn session(captures: usize, setup: Setup, seed: u64) -> (Session, Truth) {
    let cell = Cell { captures, placements: 0, touches: 0, ..Cell::new(setup, seed) };
    cell.session(seed).unwrap()
}

/// Part of four or five captures fits under another convention by chance.
#[test]
fn clean_sets_of_four_and_five_captures_are_not_called_inverted() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for captures in [4, 5] {
            for seed in 0..40 {
                let (session, _) = session(captures, setup, seed);
                let found = calibrate(&session, &Config::default()).unwrap();
                let codes: Vec<&str> = found.warnings.iter().map(|w| w.code.as_str()).collect();
                assert!(
                    !codes.iter().any(|c| c.ends_with("inverted")),
                    "{setup:?} {captures} {seed}: {:?}",
                    found.reasons
                );
                assert!(
                    !found.reasons.iter().any(|r| r.contains("leave-one-out residual")),
                    "{setup:?} {captures} {seed}: {:?}",
                    found.reasons
                );
            }
        }
    }
}

/// A robot that turns about its flange says nothing of lengths.
#[test]
fn a_robot_that_only_turns_does_not_judge_the_size_of_the_target() {
    for seed in 0..20 {
        let (mut session, truth) = session(12, Setup::EyeInHand, seed);
        let place = session.observations[0].base_from_flange.translation();
        for (k, o) in session.observations.iter_mut().enumerate() {
            // the same turns in one place, and what the camera then sees
            let x = truth.hand_eye.mount_from_camera;
            let turned = o.base_from_flange.rotation();
            let noise =
                Vector3::new(0.7, -0.4, 0.3) * (1e-4 * ((k * 7 + seed as usize) as f64).sin());
            let there: Pose<Base, Flange> = Pose::from_parts(&turned, place);
            let board: Pose<Base, Target> =
                Pose::claim(Isometry3::translation(place.x, place.y, place.z - 0.6));
            let camera: Pose<Flange, Camera> = x.rename();
            let seen = camera.inverse() * (there.inverse() * board);
            o.base_from_flange = Pose::from_parts(&turned, place + noise);
            o.candidates.truncate(1);
            o.candidates[0].camera_from_target = seen;
            o.candidates[0].covariance = None;
            o.corners.clear();
        }
        let found = calibrate(&session, &Config::default()).unwrap();
        assert!(found.warnings.iter().all(|w| w.code != "target-scale"), "seed {seed}");
        assert!(found.target_scale.is_none(), "seed {seed}");
    }
}

#[test]
fn a_measured_position_that_the_data_contradict_is_named() {
    let (mut session, truth) = session(15, Setup::EyeInHand, 4);
    let z = truth.hand_eye.mount_from_camera.translation().z;
    for (off, named) in [(0.0, false), (0.03, true)] {
        let (axis, value_m) = (Vector3::z(), z + off);
        session.known_position = Some(KnownPosition { axis, value_m, sigma_m: 1e-3 });
        let found = calibrate(&session, &Config::default()).unwrap();
        let says = found.warnings.iter().any(|w| w.code == "known-position-disagrees");
        assert_eq!(says, named, "{off}: {:?}", found.warnings);
        // where position and target cannot both be right, there may be no answer
        assert!(named || found.verdict == Verdict::Accepted, "{:?}", found.reasons);
    }
}
