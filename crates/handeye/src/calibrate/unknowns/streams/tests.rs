use super::*;
use crate::{
    Anchor, Base, Camera, Flange, HandEye, Mount, Setup, Streams, Target, Verdict, calibrate,
    math::{lie, random::Random},
};
use nalgebra::{Isometry3, Vector3, Vector6};

type Poses<A, B> = Vec<Stamped<Pose<A, B>>>;

fn pose<A, B>(t: [f64; 3], r: [f64; 3]) -> Pose<A, B> {
    Pose::claim(Isometry3::new(t.into(), r.into()))
}

fn truth() -> HandEye {
    HandEye {
        mount_from_camera: pose([0.05, -0.02, 0.11], [0.1, -0.3, 1.5]),
        anchor_from_target: pose([0.8, 0.1, 0.02], [0.02, 3.0, -0.1]),
    }
}

/// A wandering flange that turns by half a rad about all axes and repeats itself every 628 s.
fn wander(t: f64) -> Pose<Base, Flange> {
    let turn = Vector3::new(
        0.5 * (0.9 * t).sin() + 0.1 * (2.3 * t).sin(),
        2.8 + 0.4 * (0.63 * t).cos(),
        0.6 * (0.41 * t).sin(),
    );
    let place = Vector3::new(
        0.5 + 0.15 * (0.77 * t).sin(),
        0.2 * (0.53 * t).cos(),
        0.6 + 0.1 * (1.1 * t).sin(),
    );
    Pose::claim(Isometry3::new(place, turn))
}

/// A recording: how the robot moves, the rates, the offset and what is added.
struct Scene {
    setup: Setup,
    motion: fn(f64) -> Pose<Base, Flange>,
    seconds: f64,
    robot_hz: f64,
    camera_hz: f64,
    offset: f64,
    /// Noise of target poses, rad and m per axis.
    noise: (f64, f64),
    scale: f64,
}

impl Scene {
    fn new(offset: f64) -> Self {
        Self {
            setup: Setup::EyeInHand,
            motion: wander,
            seconds: 20.0,
            robot_hz: 100.0,
            camera_hz: 30.0,
            offset,
            noise: (0.0, 0.0),
            scale: 1.0,
        }
    }

    fn seen(&self, t: f64) -> Pose<Camera, Target> {
        let at: Pose<Anchor, Mount> = self.setup.anchor_from_mount((self.motion)(t));
        (at * truth().mount_from_camera).inverse() * truth().anchor_from_target
    }

    fn record(&self, seed: u64) -> Streams {
        let mut random = Random::new(seed);
        let robot = (0..(self.seconds * self.robot_hz) as usize)
            .map(|k| k as f64 / self.robot_hz)
            .map(|t| Stamped { time_s: t, pose: (self.motion)(t) })
            .collect();
        let camera: Poses<Camera, Target> = (0..(self.seconds * self.camera_hz) as usize)
            .map(|k| 0.007 + k as f64 / self.camera_hz)
            .map(|t| {
                let (turn, shift) =
                    (random.normal3() * self.noise.0, random.normal3() * self.noise.1);
                let mut iso = *self.seen(t).retract(&lie::tangent(&turn, &shift)).iso();
                iso.translation.vector *= self.scale;
                Stamped { time_s: t + self.offset, pose: Pose::claim(iso) }
            })
            .collect();
        Streams { setup: self.setup, robot, camera, unknown_scale: self.scale != 1.0 }
    }
}

fn solved(streams: &Streams) -> Calibration {
    calibrate(&streams.session(), &Config::default()).unwrap()
}

fn misses(found: &Calibration) -> (f64, f64) {
    let x = found.hand_eye.mount_from_camera.expect("an answer");
    let truth = truth().mount_from_camera;
    (x.angle_to(&truth), x.distance_to(&truth))
}

#[test]
fn exact_streams_give_offset_and_pose() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for offset in [0.0, 0.1234, -3.21, 7.5, 1.7e9] {
            let streams = Scene { setup, ..Scene::new(offset) }.record(1);
            let found = solved(&streams);
            assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
            let (turn, distance) = misses(&found);
            assert!(turn < 1e-5 && distance < 1e-5, "{setup:?} {offset}: {turn} {distance}");
            // stamps near 1.7e9 s are rounded to 2e-7 s
            let time = found.time_offset_s.unwrap();
            assert!((time - offset).abs() < 2e-6, "{setup:?} {offset}: {time}");
        }
    }
}

#[test]
fn under_noise_the_error_of_the_offset_stays_inside_its_sigma() {
    let (mut squares, mut poses, trials) = (0.0, 0.0, 20);
    for seed in 0..trials {
        let noise = (0.3_f64.to_radians(), 1e-3);
        let setup = if seed % 2 == 0 { Setup::EyeInHand } else { Setup::EyeToHand };
        let scene = Scene { noise, setup, ..Scene::new(0.25 - 0.04 * seed as f64) };
        let found = solved(&scene.record(seed));
        let (time, sigma) = (found.time_offset_s.unwrap(), found.time_offset_sigma_s.unwrap());
        assert!(sigma < 3e-3, "{sigma}");
        squares += ((time - scene.offset) / sigma).powi(2);
        let covariance =
            crate::calibrate::result::matrix(&found.hand_eye.covariance.mount_from_camera.unwrap());
        let miss = found.hand_eye.mount_from_camera.unwrap().local(&truth().mount_from_camera);
        poses += miss.dot(&(covariance.try_inverse().unwrap() * miss));
    }
    let (time, pose) = (squares / trials as f64, poses / trials as f64);
    assert!((0.35..2.0).contains(&time), "{time}");
    assert!((3.0..9.5).contains(&pose), "{pose}");
}

#[test]
fn the_order_of_the_samples_does_not_matter() {
    let scene = Scene { noise: (2e-3, 5e-4), ..Scene::new(0.3) };
    let streams = scene.record(5);
    let mut turned = streams.clone();
    turned.robot.reverse();
    turned.camera.rotate_left(123);
    let (a, b) = (solved(&streams), solved(&turned));
    assert_eq!((a.hand_eye, a.time_offset_s), (b.hand_eye, b.time_offset_s));
    assert!(b.warnings.iter().any(|w| w.code == "stream-unsorted"));
}

#[test]
fn moments_before_zero_are_in_the_order_of_their_times() {
    let scene = Scene::new(0.0);
    let early = |s: &mut f64| *s -= 15.0;
    let mut streams = scene.record(1);
    streams.robot.iter_mut().for_each(|s| early(&mut s.time_s));
    streams.camera.iter_mut().for_each(|s| early(&mut s.time_s));
    let times: Vec<f64> =
        streams.session().in_order().observations.iter().filter_map(|o| o.time_s).collect();
    assert!(times[0] < 0.0 && times.is_sorted(), "{times:?}");
}

#[test]
fn gaps_jitter_and_wrong_poses_do_no_harm() {
    let scene = Scene { noise: (2e-3, 5e-4), ..Scene::new(-0.8) };
    let mut streams = scene.record(9);
    streams.robot.drain(400..520);
    streams.camera.drain(100..140);
    let mut random = Random::new(3);
    for sample in &mut streams.robot {
        let t = sample.time_s + random.between(-0.004, 0.004);
        *sample = Stamped { time_s: t, pose: wander(t) };
    }
    for k in (0..streams.camera.len()).step_by(9) {
        streams.camera[k].pose =
            pose([0.1, 0.2, 0.5 + 0.001 * k as f64], [0.3, 2.0, 0.001 * k as f64]);
    }
    let found = solved(&streams);
    assert!((found.time_offset_s.unwrap() + 0.8).abs() < 4.0 * found.time_offset_sigma_s.unwrap());
    let (turn, distance) = misses(&found);
    assert!(turn < 2e-3 && distance < 1e-3, "{turn} {distance}");
    assert!(found.warnings.iter().filter(|w| w.code == "stream-gaps").count() == 2);
    assert!(!found.rejected.is_empty());
}

#[test]
fn a_sparse_robot_stream_gives_the_moments() {
    let scene = Scene { robot_hz: 4.0, camera_hz: 30.0, seconds: 40.0, ..Scene::new(0.4) };
    let found = solved(&scene.record(2));
    let (turn, distance) = misses(&found);
    assert!(turn < 1e-4 && distance < 1e-4, "{turn} {distance}");
    assert!((found.time_offset_s.unwrap() - 0.4).abs() < 1e-4);
}

#[test]
fn a_robot_that_does_not_move_leaves_the_offset_open() {
    let scene = Scene { motion: |_| wander(1.0), noise: (2e-3, 5e-4), ..Scene::new(0.3) };
    let found = solved(&scene.record(1));
    assert_eq!(found.verdict, Verdict::Undetermined);
    assert_eq!(found.time_offset_s, None);
    assert!(found.undetermined.iter().any(|u| u == TIME_OFFSET), "{:?}", found.undetermined);
    assert!(found.hand_eye.mount_from_camera.is_none());
}

/// What a robot reports that is noisy itself.
fn noisy_robot(scene: &Scene, seed: u64) -> Streams {
    let mut streams = scene.record(seed);
    let mut random = Random::new(seed + 100);
    for sample in &mut streams.robot {
        let off = lie::tangent(&(random.normal3() * 1e-4), &(random.normal3() * 2e-5));
        sample.pose = sample.pose.retract(&off);
    }
    streams
}

#[test]
fn noise_of_the_robot_is_no_motion() {
    let scene = Scene { motion: |_| wander(1.0), noise: (1e-4, 2e-5), ..Scene::new(0.3) };
    for seed in 0..4 {
        let found = solved(&noisy_robot(&scene, seed));
        assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
        assert_eq!((found.time_offset_s, found.hand_eye.mount_from_camera), (None, None));
        assert_eq!(found.undetermined, ["the pose of the camera on the flange", TIME_OFFSET]);
        assert!(found.reasons[0].contains("the robot does not move"), "{:?}", found.reasons);
    }
}

#[test]
fn noise_of_the_robot_is_no_change_of_speed() {
    let about_z = |t: f64| {
        let twist = Vector6::new(0.0, 0.0, 0.3, 0.0, 0.0, 0.0);
        Pose::claim(*wander(0.0).iso() * lie::exp(&(twist * t)))
    };
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let noise = (1e-4, 2e-5);
        let scene = Scene { motion: about_z, noise, setup, seconds: 10.0, ..Scene::new(0.2) };
        for seed in 0..3 {
            let found = solved(&noisy_robot(&scene, seed));
            assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
            assert_eq!((found.time_offset_s, found.time_offset_sigma_s), (None, None));
            let named = &found.undetermined;
            assert!(named.iter().any(|u| u == TIME_OFFSET), "{named:?}");
            assert!(named.iter().any(|u| u.starts_with("rotation about")), "{named:?}");
            assert!(found.warnings.iter().all(|w| w.code != "time-offset-ambiguous"));
        }
    }
}

#[test]
fn constant_speed_leaves_the_offset_open() {
    let screw = |t: f64| {
        let twist = Vector6::new(0.2, 0.1, 0.3, 0.02, 0.01, 0.05);
        Pose::claim(*wander(0.0).iso() * lie::exp(&(twist * t)))
    };
    for noise in [(0.0, 0.0), (2e-3, 5e-4)] {
        let found = solved(&Scene { motion: screw, noise, ..Scene::new(0.3) }.record(1));
        assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
        assert_eq!(found.time_offset_s, None);
        assert!(found.undetermined.iter().any(|u| u == TIME_OFFSET), "{:?}", found.undetermined);
    }
}

#[test]
fn streams_of_different_motions_are_not_accepted() {
    let mut streams = Scene::new(0.0).record(1);
    let other: fn(f64) -> Pose<Base, Flange> = |t| wander(1.7 * t + 100.0);
    streams.robot = Scene { motion: other, ..Scene::new(0.0) }.record(2).robot;
    let found = solved(&streams);
    assert_ne!(found.verdict, Verdict::Accepted);
}

/// Stations at which the robot rests, quick moves between them; images at rest only.
#[test]
fn pictures_at_rest_need_no_offset() {
    fn stations(t: f64) -> Pose<Base, Flange> {
        let (k, rest) = ((t / 2.0).floor(), t.rem_euclid(2.0));
        let u = ((rest - 1.5) / 0.5).clamp(0.0, 1.0);
        wander(3.0 * (k + u * u * (3.0 - 2.0 * u)))
    }
    let scene = Scene { motion: stations, seconds: 60.0, noise: (1e-3, 3e-4), ..Scene::new(0.2) };
    let mut streams = scene.record(4);
    streams.camera.retain(|s| (0.3..1.2).contains(&(s.time_s - 0.2).rem_euclid(2.0)));
    let found = solved(&streams);
    let (turn, distance) = misses(&found);
    assert!(turn < 2e-3 && distance < 2e-3, "{turn} {distance}");
}

#[test]
fn errors_that_neighbours_share_are_noticed() {
    let scene = Scene::new(0.1);
    let mut streams = scene.record(1);
    let mut random = Random::new(8);
    // each error holds for about a second
    let mut error = Vector6::zeros();
    for sample in &mut streams.camera {
        let fresh = lie::tangent(&(random.normal3() * 5e-3), &(random.normal3() * 1e-3));
        error = error * 0.97 + fresh * (1.0 - 0.97_f64.powi(2)).sqrt();
        sample.pose = sample.pose.retract(&error);
    }
    let found = solved(&streams);
    assert!(found.captures.len() <= 60, "{}", found.captures.len());
}

#[test]
fn offset_and_scale_are_found_together() {
    for scale in [0.01, 2.5] {
        let exact = solved(&Scene { scale, ..Scene::new(0.6) }.record(1));
        assert!((exact.scale.unwrap() / scale - 1.0).abs() < 1e-5);
        assert!((exact.time_offset_s.unwrap() - 0.6).abs() < 1e-5);
        assert!(misses(&exact).1 < 1e-5);
    }
}

#[test]
fn a_recording_of_half_an_hour_is_no_burden() {
    let scene = Scene { seconds: 1800.0, robot_hz: 50.0, camera_hz: 5.0, ..Scene::new(-40.2) };
    let found = solved(&Scene { noise: (2e-3, 5e-4), ..scene }.record(6));
    let (time, sigma) = (found.time_offset_s.unwrap(), found.time_offset_sigma_s.unwrap());
    assert!((time + 40.2).abs() < 4.0 * sigma && sigma < 5e-3, "{time} {sigma}");
    // every angular frequency of the motion is a multiple of 0.01 rad/s
    let other = found.warnings.iter().find(|w| w.code == "time-offset-ambiguous").unwrap();
    assert!(other.message.contains("588.1"), "{}", other.message);
}

#[test]
fn bad_streams_are_refused_in_words() {
    let good = Scene::new(0.0).record(1);
    let mut none = good.clone();
    none.camera.clear();
    let said = calibrate(&none.session(), &Config::default()).unwrap_err().to_string();
    assert!(said.starts_with("of the camera stream 0 samples"), "{said}");
    let mut broken = good.clone();
    broken.robot[7].time_s = f64::INFINITY;
    let said = calibrate(&broken.session(), &Config::default()).unwrap_err().to_string();
    assert_eq!(said, "time_s of robot sample 8 is not finite");
}

#[test]
fn too_few_samples_end_with_a_verdict() {
    let good = Scene::new(0.0).record(1);
    let mut short = good.clone();
    short.camera.truncate(2);
    let mut same_time = good.clone();
    same_time.robot.iter_mut().for_each(|s| s.time_s = 1.0);
    // too short a time for any pose in between
    let mut instant = good;
    instant.robot.iter_mut().for_each(|s| s.time_s *= 1e-300);
    for (streams, said) in [
        (short, "of the camera stream 2 samples at different times can be used, at least 3 are"),
        (same_time, "of the robot stream 0 samples at different times"),
        (instant, "no time offset makes the rotations of robot and camera agree"),
    ] {
        let found = solved(&streams);
        assert_eq!(found.verdict, Verdict::Undetermined);
        assert!(found.reasons[0].contains(said), "{:?}", found.reasons);
        assert_eq!((found.time_offset_s, found.hand_eye.mount_from_camera), (None, None));
        assert_eq!(found.undetermined, ["the pose of the camera on the flange", TIME_OFFSET]);
    }
}
