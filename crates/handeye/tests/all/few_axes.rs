//! Robots that turn about one axis only, or not at all: what the motions determine is given, what
//! they do not is named, and a touch or a measured height fills it in.

use handeye::{
    Base, Calibration, Camera, Config, Flange, Method, Observation, Point, Pose, Session, Setup,
    Target, TargetModel, Touch, Verdict, calibrate, estimate::KnownNoise, math::random::Random,
    model::session::KnownPosition, simulate::Cell,
};
use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};

fn flange_from_camera() -> Pose<Flange, Camera> {
    Pose::claim(Isometry3::new(Vector3::new(0.07, -0.03, 0.05), Vector3::new(0.1, -0.05, 0.6)))
}

fn base_from_target() -> Pose<Base, Target> {
    Pose::claim(Isometry3::new(Vector3::new(0.45, 0.1, 0.02), Vector3::new(0.0, 0.0, 0.3)))
}

/// Twelve views from above, the flange turned about its own z by multiples of `turn`.
fn session(turn: f64) -> Session {
    let mut random = Random::new(11);
    let view = |k: usize| {
        let down = UnitQuaternion::from_scaled_axis(Vector3::x() * std::f64::consts::PI);
        let rotation = down * UnitQuaternion::from_scaled_axis(Vector3::z() * turn * k as f64);
        let at = Vector3::new(
            random.between(0.3, 0.6),
            random.between(-0.1, 0.3),
            random.between(0.5, 0.7),
        );
        let base_from_flange: Pose<Base, Flange> =
            Pose::claim(Isometry3::from_parts(at.into(), rotation));
        let exact: Pose<Camera, Target> =
            (base_from_flange * flange_from_camera()).inverse() * base_from_target();
        let (w, t) = (random.normal3() * 2e-4, random.normal3() * 1e-4);
        let noise = Vector6::new(w.x, w.y, w.z, t.x, t.y, t.z);
        Observation::bare(format!("{k:02}"), base_from_flange, exact.retract(&noise))
    };
    Session {
        target: Some(TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 }),
        ..Session::of_captures(Setup::EyeInHand, (0..12).map(view).collect())
    }
}

fn touched(corners: &[u32]) -> Vec<Touch> {
    let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
    let touch = |&corner: &u32| Touch {
        placement: "board".into(),
        corner,
        in_base: Point::from_vector((base_from_target() * board.corner(corner).unwrap()).vector()),
        base_from_flange: None,
        joints: vec![],
    };
    corners.iter().map(touch).collect()
}

fn off(found: &Calibration) -> (f64, f64) {
    let x = found.hand_eye.mount_from_camera.unwrap();
    let e: Vector6<f64> = flange_from_camera().rename().local(&x);
    (e.fixed_rows::<3>(0).norm(), e.fixed_rows::<3>(3).norm())
}

#[test]
fn one_axis_leaves_the_position_along_it() {
    let found = calibrate(&session(0.5), &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
    assert_eq!(found.undetermined, ["translation along the rotation axis z of flange"]);
    assert!(found.hand_eye.mount_from_camera.is_none() && found.predicted_tre_mm.is_none());
    assert!(
        found.candidates.iter().all(|k| k.predicted_tre_mm.is_none()) && found.advice.is_empty()
    );
    let known = found.determined.unwrap();
    assert!(Vector3::from(known.free_translations[0]).z > 0.9999);
    let truth = flange_from_camera();
    let [x, y, z, w] = known.rotation_xyzw.unwrap();
    let rotation = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    assert!(rotation.angle_to(&truth.iso().rotation) < 1e-3);
    let off = Vector3::from(known.translation_across_m.unwrap()) - truth.translation();
    assert!(off.xy().norm() < 3e-4, "{off}");
}

/// Exact views whose robot turns about one axis of its flange, as far as rounding lets it.
fn exact(axis: Vector3<f64>) -> Session {
    let view = |k: usize| {
        let s = k as f64;
        let down = UnitQuaternion::from_scaled_axis(Vector3::new(3.0, 0.1, 0.2));
        let turn = UnitQuaternion::from_scaled_axis(axis * (0.4 * s - 1.0));
        let at = Vector3::new(0.6 + 0.1 * s.sin(), 0.15 * (1.7 * s).cos(), 0.5 + 0.01 * s);
        let base_from_flange: Pose<Base, Flange> =
            Pose::claim(Isometry3::from_parts(at.into(), down * turn));
        let seen = (base_from_flange * flange_from_camera()).inverse() * base_from_target();
        Observation::bare(format!("{k:02}"), base_from_flange, seen)
    };
    Session::of_captures(Setup::EyeInHand, (0..15).map(view).collect())
}

#[test]
fn rounding_does_not_pass_for_information() {
    for axis in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(1.0, 2.0, 3.0).normalize()]
    {
        let found = calibrate(&exact(axis), &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Undetermined, "{axis}: {:?}", found.reasons);
        let [named] = found.undetermined.as_slice() else { panic!("{:?}", found.undetermined) };
        assert!(named.starts_with("translation along the rotation axis "), "{named}");
        assert!(found.hand_eye.mount_from_camera.is_none());
        let known = found.determined.unwrap();
        assert!(Vector3::from(known.free_translations[0]).dot(&axis).abs() > 0.9999);
        let t = flange_from_camera().translation();
        let across = t - axis * axis.dot(&t);
        assert!((Vector3::from(known.translation_across_m.unwrap()) - across).norm() < 1e-6);
    }
}

/// Exact views of a robot at these places.
fn seen_from(places: impl IntoIterator<Item = Isometry3<f64>>) -> Session {
    let view = |(k, place): (usize, Isometry3<f64>)| {
        let base_from_flange: Pose<Base, Flange> = Pose::claim(place);
        let seen = (base_from_flange * flange_from_camera()).inverse() * base_from_target();
        Observation::bare(format!("{k:02}"), base_from_flange, seen)
    };
    let all = places.into_iter().enumerate().map(view).collect();
    Session::of_captures(Setup::EyeInHand, all)
}

#[test]
fn two_places_over_and_over_are_not_called_inverted() {
    let first = Isometry3::new(Vector3::new(0.6, 0.0, 0.5), Vector3::new(3.0, 0.1, 0.2));
    for turn in [Vector3::new(0.5, 0.1, 0.0), Vector3::new(-0.2, 0.3, 0.4)] {
        let second = first * Isometry3::new(Vector3::new(0.1, -0.05, 0.02), turn);
        let session = seen_from((0..10).map(|k| if k % 2 == 0 { first } else { second }));
        let found = calibrate(&session, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
        assert!(!found.undetermined.is_empty());
        let codes: Vec<&str> = found.warnings.iter().map(|w| w.code.as_str()).collect();
        assert_eq!(codes, ["captures-repeated"]);
    }
}

#[test]
fn rounding_is_no_drift() {
    let truth = flange_from_camera().translation();
    for size in [0.002, 0.02, 0.5] {
        let place = |k: u32| {
            let s = f64::from(k);
            let turn = Vector3::new((2.3 * s).sin(), (1.7 * s).cos(), (3.1 * s).sin()) * size;
            let first = Isometry3::new(Vector3::new(0.6, 0.0, 0.5), Vector3::new(3.0, 0.1, 0.2));
            first * UnitQuaternion::from_scaled_axis(turn)
        };
        let session = seen_from((0..15).map(place));
        let found =
            calibrate(&Session { in_sequence: true, ..session }, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
        assert!(found.warnings.is_empty(), "{:?}", found.warnings);
        let x = found.hand_eye.mount_from_camera.unwrap();
        assert!((x.translation() - truth).norm() < 1e-6);
    }
}

#[test]
fn known_noise_below_rounding_does_not_either() {
    let known = KnownNoise {
        robot_rotation_rad: Some(1e-12),
        robot_position_m: Some(1e-12),
        ..KnownNoise::default()
    };
    let config = Config { known, ..Config::default() };
    let found = calibrate(&exact(Vector3::z()), &config).unwrap();
    assert_eq!(found.undetermined, ["translation along the rotation axis z of flange"]);
}

#[test]
fn what_is_open_is_so_for_every_method() {
    for turn in [0.0, 0.5] {
        let session = Session { target: None, ..session(turn) };
        let plain = calibrate(&session, &Config::default()).unwrap();
        for method in Method::ALL {
            let config = Config { method: Some(method), ..Config::default() };
            let found = calibrate(&session, &config).unwrap();
            let name = method.name();
            assert_eq!(found.verdict, Verdict::Undetermined, "{name}: {:?}", found.reasons);
            assert_eq!(found.undetermined, plain.undetermined, "{name}");
            assert!(found.hand_eye.mount_from_camera.is_none(), "{name}");
            assert!(found.held_out.translation_rms_mm.unwrap() < 1.0, "{name}");
            assert!(found.captures.iter().all(|c| c.residual_mm.is_none_or(|r| r < 1.0)), "{name}");
        }
    }
}

#[test]
fn a_touch_determines_it_and_is_named_for_it() {
    let session = Session { touches: touched(&[0, 8, 45]), ..session(0.5) };
    let found = calibrate(&session, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?} {:?}", found.reasons, found.undetermined);
    assert!(found.warnings.iter().any(|w| w.code == "determined-by-touches"));
    let (angle, distance) = off(&found);
    assert!(angle < 1e-3 && distance < 1e-3, "{angle} {distance}");
}

/// As well as the tip is known, half a millimetre: the views say nothing of it.
#[test]
fn one_touch_determines_it_as_well_as_the_tip_is_known() {
    let session = Session { touches: touched(&[22]), ..session(0.5) };
    let found = calibrate(&session, &Config::default()).unwrap();
    assert!(found.undetermined.is_empty(), "{:?}", found.undetermined);
    let (angle, distance) = off(&found);
    assert!(angle < 1e-3 && distance < 1e-3, "{angle} {distance}");
    let covariance = found.hand_eye.covariance.mount_from_camera.unwrap();
    let along = covariance[5][5].sqrt();
    assert!((4e-4..1.5e-3).contains(&along), "{along}");
    assert!(found.predicted_tre_mm.is_some_and(|e| e.rms < 1.5));
}

#[test]
fn a_measured_height_determines_it() {
    let z = flange_from_camera().translation().z;
    let known = KnownPosition { axis: Vector3::z(), value_m: z, sigma_m: 5e-4 };
    let session = Session { known_position: Some(known), ..session(0.5) };
    let found = calibrate(&session, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?} {:?}", found.reasons, found.undetermined);
    let (angle, distance) = off(&found);
    assert!(angle < 1e-3 && distance < 1e-3, "{angle} {distance}");
    let covariance = found.hand_eye.covariance.mount_from_camera.unwrap();
    let along = covariance[5][5].sqrt();
    assert!((3e-4..2e-3).contains(&along), "{along}");
    let warning = found.warnings.iter().find(|w| w.code == "determined-by-known-position").unwrap();
    assert!(warning.message.contains("translation along"), "{}", warning.message);
}

/// Half turns about the three axes of the flange: the rotations alone fit four cameras.
#[test]
fn half_turns_are_solved_and_no_method_invents_an_answer() {
    use std::f64::consts::PI;
    let turns = [Vector3::zeros(), Vector3::x() * PI, Vector3::y() * PI, Vector3::z() * PI];
    let view = |(k, turn): (usize, Vector3<f64>)| {
        let s = k as f64;
        let at = Vector3::new(0.6 + 0.2 * s.sin(), 0.3 * (1.7 * s).cos(), 0.5 + 0.1 * s);
        let first = Isometry3::new(at, Vector3::new(3.0, 0.1, 0.2));
        let base_from_flange: Pose<Base, Flange> =
            Pose::claim(first * UnitQuaternion::from_scaled_axis(turn));
        let seen = (base_from_flange * flange_from_camera()).inverse() * base_from_target();
        Observation::bare(format!("{k:02}"), base_from_flange, seen)
    };
    let all = turns.into_iter().enumerate().map(view).collect();
    let session = Session::of_captures(Setup::EyeInHand, all);
    let found = calibrate(&session, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    assert!(off(&found).0 < 1e-6 && off(&found).1 < 1e-6);
    for method in Method::ALL {
        let config = Config { method: Some(method), ..Config::default() };
        let found = calibrate(&session, &config).unwrap();
        if found.verdict == Verdict::Accepted {
            assert!(off(&found).0 < 1e-6 && off(&found).1 < 1e-6, "{}", method.name());
        } else {
            assert!(found.hand_eye.mount_from_camera.is_none(), "{}", method.name());
            assert!(found.reasons[0].starts_with(method.name()), "{:?}", found.reasons);
        }
    }
}

#[test]
fn no_rotation_leaves_the_whole_position() {
    let found = calibrate(&session(0.0), &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
    assert_eq!(found.undetermined, ["the position of the camera on flange"]);
    let [x, y, z, w] = found.determined.unwrap().rotation_xyzw.unwrap();
    let rotation = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    assert!(rotation.angle_to(&flange_from_camera().iso().rotation) < 1e-3);
}

#[test]
fn a_robot_that_stands_still_determines_nothing() {
    let mut still = session(0.5);
    let first = still.observations[0].clone();
    still.observations.iter_mut().for_each(|o| {
        (o.base_from_flange, o.candidates) = (first.base_from_flange, first.candidates.clone());
    });
    let found = calibrate(&still, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
    assert!(found.hand_eye.mount_from_camera.is_none() && !found.undetermined.is_empty());
}

/// A robot whose tilt is its noise: the views say nothing of the position along its axis, and must not
/// contradict touches that do.
#[test]
fn tilt_that_is_noise_contradicts_no_touches() {
    for seed in 0..25 {
        let mut cell = Cell { captures: 12, ..Cell::new(Setup::EyeInHand, seed) };
        cell.viewing.tilt_rad = 0.0;
        let (session, truth) = cell.session(seed).unwrap();
        let found = calibrate(&session, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Accepted, "{seed}: {:?}", found.reasons);
        let x = found.hand_eye.mount_from_camera.unwrap();
        let off = (x.translation() - truth.hand_eye.mount_from_camera.translation()).norm();
        assert!(off < 2e-3, "{seed}: {off}");
        let alone = Session { touches: vec![], ..session };
        let found = calibrate(&alone, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Undetermined, "{seed}");
    }
}
