//! Views that are planned one after the other, in simulated cells of which the planner knows a guess.

use std::f64::consts::PI;

use nalgebra::{Matrix3, UnitQuaternion, Vector3, Vector6};

use super::super::*;
use crate::{
    HandEye, Session, Verdict, calibrate,
    estimate::predict::difference,
    math::random::Random,
    model::kinematics::{Arm, DhConvention, Joint},
    simulate::{Cell, CellNoise},
};

/// What a person with a ruler would guess.
const RULER: GuessSigma = GuessSigma { rotation_rad: 0.1, position_m: 0.03 };

struct Trial {
    cell: Cell,
    planner: Planner,
    poses: Vec<Pose<Base, Flange>>,
}

fn trial(setup: Setup, seed: u64) -> Trial {
    let noise = CellNoise { robot_repeatability_m: 0.0, ..CellNoise::default() };
    let cell = Cell { captures: 1, placements: 0, touches: 0, noise, ..Cell::new(setup, seed) };
    let first = cell.record(seed).unwrap().truth.base_from_flange;
    let mut random = Random::new(seed ^ 77);
    let turn = random.normal3() * RULER.rotation_rad;
    let shift = random.normal3() * RULER.position_m;
    let off = Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z);
    let guess = cell.hand_eye.mount_from_camera.retract(&off);
    let (near, far) = (cell.viewing.nearest_m, cell.viewing.farthest_m);
    let (low, high) = (Vector3::new(-0.2, -0.15, near), Vector3::new(0.2, 0.15, far));
    let setting = Setting {
        setup,
        target: cell.target.clone(),
        camera: cell.intrinsics,
        hand_eye: HandEye { mount_from_camera: guess, anchor_from_target: Pose::identity() },
        noise: ExpectedNoise { robot_position_m: 0.5e-3 / 3f64.sqrt(), ..ExpectedNoise::default() },
        volume: Volume::of_box(&low, &high, "box"),
    };
    let viewing = Viewing {
        nearest_m: near,
        farthest_m: far,
        ..Viewing::usual(&cell.intrinsics, &cell.target)
    };
    let within = Residual { angle: 1.2, distance: 0.7 };
    let reach = NearReach { stood: first.clone(), within, surroundings: Surroundings::default() };
    let planner = Planner {
        setting,
        guess: Some(RULER),
        taken: vec![],
        failed: vec![],
        viewing,
        reach: Reach::Near(reach),
        candidates: 500,
        threads: 1,
    };
    Trial { cell, planner, poses: first }
}

impl Trial {
    /// All that was captured by now.
    fn session(&self, seed: u64) -> Session {
        let cell = Cell { captures: self.poses.len(), ..self.cell.clone() };
        let mut session = cell.record_at(&self.poses, seed).unwrap().session();
        session.observations.retain(|o| !o.candidates.is_empty());
        session
    }

    /// Takes the captures and tells the planner.
    fn take(&mut self, seed: u64) -> Session {
        let session = self.session(seed);
        let of = |o: &crate::Observation| Taken {
            base_from_flange: o.base_from_flange,
            camera_from_target: o.candidates[0].camera_from_target,
        };
        self.planner.taken = session.observations.iter().map(of).collect();
        session
    }
}

#[test]
fn next_views_from_a_rough_guess_are_seen_and_end_in_a_good_answer() {
    let (mut seen, mut all, mut good) = (0, 0, 0);
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for seed in 0..4 {
            let mut trial = trial(setup, 40 + seed);
            trial.take(seed);
            for _ in 1..10 {
                let next = trial.planner.next().unwrap();
                all += 1;
                seen += usize::from(trial.cell.shows_target_at(&next.station.base_from_flange));
                trial.poses.push(next.station.base_from_flange);
                trial.take(seed);
            }
            let session = trial.session(seed);
            let answer = calibrate(&session, &crate::Config::default()).unwrap();
            assert_eq!(answer.verdict, Verdict::Accepted, "{:?}", answer.reasons);
            let x = answer.hand_eye.mount_from_camera.unwrap();
            let off = difference(&trial.cell.hand_eye.mount_from_camera, &x);
            let volume = &trial.planner.setting.volume.points;
            let worst = volume.iter().map(|p| off(p).norm()).fold(0.0, f64::max);
            good += usize::from(worst < 1e-3);
        }
    }
    assert!(seen * 100 >= all * 98, "{seen} of {all} views show the whole board");
    assert!(good >= 7, "{good} of 8 within a millimetre everywhere");
}

#[test]
fn a_route_reaches_the_tolerance_and_says_what_each_view_brings() {
    let mut trial = trial(Setup::EyeInHand, 3);
    trial.planner.guess = None;
    trial.planner.setting.hand_eye = trial.cell.hand_eye;
    let route = trial.planner.route(20, Some(0.6)).unwrap();
    assert!((6..20).contains(&route.views.len()), "{}", route.views.len());
    let last = route.views.last().unwrap();
    assert!(last.after.as_ref().unwrap().p95 <= 0.6);
    assert!(route.undetermined.is_empty());
    assert!(
        last.reason().ends_with("mm (95 %)") && last.reason().contains('→'),
        "{}",
        last.reason()
    );
    assert!(route.views[0].reason().ends_with("needed to determine all directions"));
    // what each view brings follows upon the one before
    for pair in route.views.windows(2) {
        assert_eq!(pair[0].after, pair[1].before);
    }
    trial.planner.threads = 3;
    assert_eq!(trial.planner.route(20, Some(0.6)).unwrap(), route, "by three threads");
}

#[test]
fn what_failed_is_not_tried_again() {
    let mut trial = trial(Setup::EyeToHand, 5);
    trial.take(5);
    let first = trial.planner.next().unwrap();
    trial.planner.failed.push(first.station.base_from_flange);
    let second = trial.planner.next().unwrap();
    let apart =
        Residual::between(&first.station.base_from_flange, &second.station.base_from_flange);
    assert!(apart.angle > 0.1 || apart.distance > 0.05, "{apart:?}");
}

#[test]
fn what_is_not_seen_or_not_reached_is_said() {
    let trial = trial(Setup::EyeInHand, 6);
    // nobody knows where the board is
    let message = trial.planner.next().unwrap_err().to_string();
    assert!(message.contains("the camera would not surely see the whole target"), "{message}");
    let far = Pose::from_parts(&Matrix3::identity(), Vector3::new(9.0, 0.0, 0.0));
    let mut away = trial.planner.clone();
    (away.guess, away.setting.hand_eye) = (None, trial.cell.hand_eye);
    let Reach::Near(near) = &mut away.reach else { panic!() };
    near.stood = vec![far];
    let message = away.next().unwrap_err().to_string();
    assert!(message.contains("the robot does not reach"), "{message}");
    away.viewing.nearest_m = 5.0;
    assert!(away.next().unwrap_err().to_string().contains("make no sense"));
}

/// An arm with four axes: its flange looks down and turns about the vertical alone.
fn four_axes() -> ArmReach {
    let joint = |a: f64, alpha: f64, d: f64, prismatic: bool| Joint {
        a,
        alpha,
        d,
        theta_offset: 0.0,
        beta: 0.0,
        prismatic,
    };
    let joints = vec![
        joint(0.35, 0.0, 0.77, false),
        joint(0.3, PI, 0.0, false),
        joint(0.0, 0.0, 0.1, true),
        joint(0.0, 0.0, 0.0, false),
    ];
    ArmReach {
        arm: Arm::new(DhConvention::Standard, joints),
        limits: vec![(-2.3, 2.3), (-2.5, 2.5), (0.0, 0.2), (-6.0, 6.0)],
        now: vec![0.0; 4],
        surroundings: Surroundings::default(),
    }
}

#[test]
fn an_arm_with_four_axes_has_views_enough_and_touches_close_its_height() {
    let mut reach = four_axes();
    let mut t = trial(Setup::EyeInHand, 4);
    let down = UnitQuaternion::new(Vector3::x() * PI).to_rotation_matrix();
    let centre = Vector3::new(0.12, 0.075, 0.0);
    t.cell.hand_eye = HandEye {
        mount_from_camera: Pose::from_parts(&Matrix3::identity(), Vector3::new(0.06, -0.03, 0.05)),
        anchor_from_target: Pose::from_parts(
            down.matrix(),
            Vector3::new(0.45, 0.0, 0.02) - down * centre,
        ),
    };
    let mut random = Random::new(3);
    let drawn = (0..100_000).map(|_| -> Vec<f64> {
        reach.limits.iter().map(|(low, high)| random.between(*low, *high)).collect()
    });
    let seen = |joints: &Vec<f64>| t.cell.shows_target_at(&reach.arm.base_from_flange(joints));
    let first: Vec<Vec<f64>> = drawn.filter(seen).take(3).collect();
    reach.now = first[2].clone();
    t.poses = first.iter().map(|joints| reach.arm.base_from_flange(joints)).collect();
    t.take(1);
    t.planner.setting.hand_eye = t.cell.hand_eye;
    let v = &mut t.planner.viewing;
    (v.nearest_m, v.farthest_m) = (0.2, 0.8);
    t.planner.reach = Reach::Arm(reach);
    let route = t.planner.route(12, None).unwrap();
    assert_eq!(route.views.len(), 12, "{:?}", route.stopped);
    for view in &route.views {
        let there = view.station.base_from_flange;
        assert!(t.cell.shows_target_at(&there));
        assert!((there.rotation().column(2) + Vector3::z()).norm() < 1e-9);
    }
    assert!(!route.undetermined.is_empty() && route.expected.is_none());
    // a robot that errs more where it touches has more corners touched
    t.poses.extend(route.views.iter().map(|view| view.station.base_from_flange));
    t.take(1);
    let tip_exact = TouchNoise { touch_m: 0.2e-3, tip_m: 1e-5 };
    let touches = |robot_m: f64, tolerance: f64| {
        let mut planner = t.planner.clone();
        planner.setting.noise.robot_position_m = robot_m;
        planner.touches(12, &tip_exact, Some(tolerance))
    };
    let (exact, usual) = (touches(0.05e-3, 0.7), touches(0.5e-3, 0.7));
    assert!(exact.len() < usual.len(), "{} {}", exact.len(), usual.len());
    let after = exact.last().unwrap().after.as_ref().unwrap().p95;
    assert!(after <= ENOUGH * 0.7, "{after}");
}
