//! Choosing among given poses.

use nalgebra::{Rotation3, Vector6};

use super::*;
use crate::{Point, simulate::Cell};

/// A cell, and poses from where the camera sees the target.
fn cell(setup: Setup, count: usize) -> (Setting, Vec<Pose<Base, Flange>>) {
    let cell = Cell { captures: count, ..Cell::new(setup, 3) };
    let (near, far) = if setup == Setup::EyeInHand { (0.45, 0.75) } else { (0.95, 1.15) };
    let (low, high) = (Vector3::new(-0.2, -0.15, near), Vector3::new(0.2, 0.15, far));
    let setting = Setting {
        setup,
        target: cell.target.clone(),
        camera: cell.intrinsics,
        hand_eye: cell.hand_eye,
        noise: ExpectedNoise { depth_at_1m: Some(0.3e-3), ..ExpectedNoise::default() },
        volume: Volume::of_box(&low, &high, "box"),
    };
    (setting, cell.record(1).unwrap().truth.base_from_flange)
}

fn indices(plan: &Plan) -> Vec<usize> {
    plan.choices.iter().map(|c| c.candidate).collect()
}

#[test]
fn every_capture_lowers_the_error_and_the_last_figure_is_that_of_all() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let (setting, reachable) = cell(setup, 40);
        let plan = choose(&setting, &[], &reachable, 12).unwrap();
        assert!(plan.undetermined.is_empty());
        let mm: Vec<Option<f64>> =
            plan.choices.iter().map(|c| c.predicted_tre.as_ref().map(|t| t.rms)).collect();
        let known: Vec<f64> = mm.iter().flatten().copied().collect();
        assert!(known.len() >= 8 && mm[0].is_none(), "{mm:?}");
        assert!(known.windows(2).all(|w| w[1] < w[0]), "{mm:?}");
        let chosen: Vec<_> = indices(&plan).into_iter().map(|k| reachable[k]).collect();
        let again = predict(&setting, &chosen).unwrap().unwrap();
        assert!((again.rms - known[known.len() - 1]).abs() < 1e-9);
    }
}

#[test]
fn what_is_taken_already_counts_and_is_not_taken_again() {
    let (setting, reachable) = cell(Setup::EyeInHand, 40);
    let whole = choose(&setting, &[], &reachable, 10).unwrap();
    let first: Vec<_> = indices(&whole)[..4].iter().map(|&k| reachable[k]).collect();
    let rest = choose(&setting, &first, &reachable, 6).unwrap();
    assert_eq!(indices(&rest), indices(&whole)[4..]);
    assert_eq!(rest.choices[5].predicted_tre, whole.choices[9].predicted_tre);
    let twice = [reachable.as_slice(), &reachable].concat();
    assert_eq!(indices(&choose(&setting, &[], &twice, 10).unwrap()), indices(&whole));
}

#[test]
fn poses_that_do_not_show_the_target_are_passed_over() {
    let (setting, mut reachable) = cell(Setup::EyeInHand, 12);
    let away = Rotation3::new(Vector3::x() * 1.5);
    let turned = Vector6::new(away.scaled_axis().x, 0.0, 0.0, 0.0, 0.0, 0.0);
    for pose in &mut reachable[..6] {
        *pose = pose.retract(&turned);
    }
    let plan = choose(&setting, &[], &reachable, 6).unwrap();
    assert!(indices(&plan).iter().all(|k| *k >= 6));
    let refused = choose(&setting, &[], &reachable, 7).unwrap_err();
    assert!(matches!(refused, Error::TooFewPoses { found: 6, needed: 7, .. }), "{refused}");
}

#[test]
fn a_robot_of_one_axis_is_told_what_stays_free_and_gets_no_figure() {
    let (setting, _) = cell(Setup::EyeInHand, 1);
    let down = Rotation3::new(Vector3::x() * std::f64::consts::PI);
    let at = setting.hand_eye.anchor_from_target * Point::new(0.12, 0.075, 0.0);
    let over = |k: usize| {
        let turn = Rotation3::new(Vector3::z() * (0.4 * k as f64 - 1.2));
        let shift = Vector3::new(0.02 * k as f64 - 0.06, 0.01 * k as f64 - 0.03, 0.7);
        let flange = at.vector() + shift;
        Pose::from_parts((down * turn).matrix(), flange)
    };
    let reachable: Vec<Pose<Base, Flange>> = (0..7).map(over).collect();
    let plan = choose(&setting, &[], &reachable, 5).unwrap();
    assert!(plan.choices.iter().all(|c| c.predicted_tre.is_none()));
    assert_eq!(plan.undetermined, ["translation along the rotation axis z of flange"]);
    assert_eq!(predict(&setting, &reachable).unwrap(), None);
}

#[test]
fn no_capture_is_no_plan_and_no_error() {
    let (setting, reachable) = cell(Setup::EyeToHand, 3);
    let plan = choose(&setting, &[], &reachable, 0).unwrap();
    assert!(plan.choices.is_empty() && plan.undetermined.len() == 2, "{plan:?}");
    assert_eq!(predict(&setting, &[]).unwrap(), None);
}

#[test]
fn bad_settings_and_poses_are_refused_in_words() {
    let (good, reachable) = cell(Setup::EyeInHand, 8);
    let refused = |setting: &Setting| choose(setting, &[], &reachable, 3).unwrap_err();
    let noise = |change: &dyn Fn(&mut ExpectedNoise)| {
        let mut setting = good.clone();
        change(&mut setting.noise);
        refused(&setting).to_string()
    };
    assert!(noise(&|n| n.robot_position_m = -1e-3).contains("robot's noise"));
    assert!(noise(&|n| n.robot_rotation_rad = f64::NAN).contains("robot's noise"));
    assert!(noise(&|n| n.corner_px = 0.0).contains("must be positive"));
    assert!(noise(&|n| n.depth_at_1m = Some(f64::INFINITY)).contains("must be positive"));
    let mut empty = good.clone();
    empty.volume.points.clear();
    assert!(refused(&empty).to_string().contains("volume"));
    let mut astray = good.clone();
    astray.hand_eye.mount_from_camera =
        Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::repeat(f64::NAN));
    assert!(matches!(refused(&astray), Error::NotFinite { .. }));
    let nowhere = Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::repeat(f64::INFINITY));
    let poses = [reachable.as_slice(), &[nowhere]].concat();
    let message = choose(&good, &[], &poses, 3).unwrap_err().to_string();
    assert_eq!(message, "pose 9 of the robot is not finite");
    assert!(choose(&good, &[nowhere], &reachable, 3).is_err());
    assert!(predict(&good, &poses).is_err());
}
