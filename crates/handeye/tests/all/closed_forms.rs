//! What every closed form has to survive, and its agreement with OpenCV.

use std::f64::consts::PI;

use handeye::{
    Anchor, Camera, Error, HandEye, Method, Mount, Pose, PosePair, Target,
    solve::{self, solve},
};
use nalgebra::{Isometry3, Matrix3, Quaternion, UnitQuaternion, Vector3};

fn pose<A, B>(t: [f64; 3], axis_angle: [f64; 3]) -> Pose<A, B> {
    Pose::claim(Isometry3::new(Vector3::from(t), Vector3::from(axis_angle)))
}

/// An answer with the camera turned by `axis_angle` in its mount.
fn truth(axis_angle: [f64; 3]) -> HandEye {
    HandEye {
        mount_from_camera: pose([0.05, -0.02, 0.11], axis_angle),
        anchor_from_target: pose([0.8, 0.1, 0.02], [0.02, 3.0, -0.1]),
    }
}

/// What the camera of `truth` sees from there.
fn seen(truth: &HandEye, anchor_from_mount: Pose<Anchor, Mount>) -> PosePair {
    let anchor_from_camera = anchor_from_mount * truth.mount_from_camera;
    PosePair {
        anchor_from_mount,
        camera_from_target: anchor_from_camera.inverse() * truth.anchor_from_target,
    }
}

/// Pairs whose mounts are turned by `rotations`, each somewhere else.
fn turned(truth: &HandEye, rotations: &[[f64; 3]]) -> Vec<PosePair> {
    let place = |k: usize| {
        let k = k as f64;
        [0.5 + 0.1 * (1.7 * k).sin(), 0.1 * (2.9 * k).cos(), 0.5 + 0.1 * (4.3 * k).sin()]
    };
    let poses = rotations.iter().enumerate().map(|(k, r)| pose(place(k), *r));
    poses.map(|anchor_from_mount| seen(truth, anchor_from_mount)).collect()
}

fn usual(count: usize) -> Vec<[f64; 3]> {
    let one = |k: f64| [0.6 * k.sin(), 2.8 + 0.4 * (1.3 * k).cos(), 0.8 * (0.7 * k).sin()];
    (0..count).map(|k| one(k as f64)).collect()
}

#[track_caller]
fn assert_near(found: &HandEye, wanted: &HandEye, tolerance: f64, what: &str) {
    let x = (found.mount_from_camera, wanted.mount_from_camera);
    let y = (found.anchor_from_target, wanted.anchor_from_target);
    for (name, angle, distance) in [
        ("X", x.0.angle_to(&x.1), x.0.distance_to(&x.1)),
        ("Y", y.0.angle_to(&y.1), y.0.distance_to(&y.1)),
    ] {
        assert!(angle < tolerance, "{what}: {name} turned by {angle} rad");
        assert!(distance < tolerance, "{what}: {name} off by {distance} m");
    }
}

#[track_caller]
fn assert_all_find(truth: &HandEye, pairs: &[PosePair], tolerance: f64, what: &str) {
    for method in Method::ALL {
        let what = format!("{}: {what}", method.name());
        assert_near(&solve(pairs, method).expect(&what), truth, tolerance, &what);
    }
}

/// Half turns about axes of the frame and across them, and none at all.
const MOUNTS: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [PI, 0.0, 0.0],
    [0.0, PI, 0.0],
    [0.0, 0.0, PI],
    [PI * 0.6, PI * 0.8, 0.0],
    [0.0, -PI * 0.6, PI * 0.8],
    [PI * 0.6, 0.0, -PI * 0.8],
    [PI - 1e-9, 0.0, 0.0],
];

#[test]
fn mounts_turned_by_180_degrees_and_not_at_all() {
    for mount in MOUNTS {
        for count in [3, 4, 15] {
            let (truth, what) = (truth(mount), format!("mount {mount:?}, {count} poses"));
            assert_all_find(&truth, &turned(&truth, &usual(count)), 1e-9, &what);
        }
    }
}

#[test]
fn motions_by_exactly_180_degrees_among_others() {
    let half_turns = [
        [0.0; 3],
        [PI, 0.0, 0.0],
        [0.0, PI, 0.0],
        [0.0, 0.0, PI],
        [0.4, 0.1, 0.0],
        [0.0, 0.5, 0.2],
    ];
    for mount in MOUNTS {
        let truth = truth(mount);
        let what = format!("half turns, mount {mount:?}");
        assert_all_find(&truth, &turned(&truth, &half_turns), 1e-9, &what);
    }
}

/// Then the rotations of four cameras fit, and only positions can tell which is right.
#[test]
fn nothing_but_half_turns_is_refused_or_gives_the_truth() {
    let truth = truth([0.1, -0.3, 1.5]);
    let turns = [[0.0; 3], [PI, 0.0, 0.0], [0.0, PI, 0.0], [0.0, 0.0, PI]];
    for method in Method::ALL {
        match solve(&turned(&truth, &turns), method) {
            Ok(found) => assert_near(&found, &truth, 1e-9, method.name()),
            Err(refused) => assert!(matches!(refused, Error::NotDetermined { .. }), "{refused}"),
        }
    }
}

/// Quarter turns: rotation matrices of zeros and ones, systems of exactly deficient rank.
#[test]
fn quarter_turns_give_the_truth() {
    let quarter = PI / 2.0;
    let turns = [[0.0; 3], [quarter, 0.0, 0.0], [0.0, quarter, 0.0], [0.0, 0.0, quarter]];
    for mount in [[0.0; 3], [0.0, quarter, 0.0], [PI, 0.0, 0.0], [0.1, -0.3, 1.5]] {
        let truth = truth(mount);
        let what = format!("quarter turns, mount {mount:?}");
        assert_all_find(&truth, &turned(&truth, &turns), 1e-9, &what);
    }
}

#[test]
fn captures_taken_again_change_nothing() {
    let truth = truth([0.1, -0.3, 1.5]);
    let three = turned(&truth, &usual(3));
    let again: Vec<PosePair> = three.iter().cycle().take(30).copied().collect();
    assert_all_find(&truth, &again, 1e-9, "three captures ten times");
}

#[test]
fn two_captures_are_refused_also_when_taken_again() {
    let two = turned(&truth([0.1, -0.3, 1.5]), &usual(2));
    let again: Vec<PosePair> = two.iter().cycle().take(10).copied().collect();
    for method in Method::ALL {
        let refused = solve(&two, method);
        assert!(matches!(refused, Err(Error::TooFewPoses { found: 2, needed: 3, .. })));
        let refused = solve(&again, method);
        assert!(matches!(refused, Err(Error::NotDetermined { .. })), "{}", method.name());
    }
}

#[test]
fn a_robot_that_does_not_rotate_is_refused() {
    let pairs = turned(&truth([0.1, -0.3, 1.5]), &[[0.0, 3.0, 0.1]; 8]);
    for method in Method::ALL {
        let refused = solve(&pairs, method);
        assert!(matches!(refused, Err(Error::NotDetermined { .. })), "{}", method.name());
    }
}

/// Where the mount stays in its place, the systems of three methods have no right-hand side.
#[test]
fn a_robot_that_only_rotates_gives_the_truth_or_is_refused_by_name() {
    let truth = truth([0.1, -0.3, 1.5]);
    let here = |r: &[f64; 3]| seen(&truth, pose([0.3, 0.2, 0.1], *r));
    let pairs: Vec<PosePair> = usual(8).iter().map(here).collect();
    for method in Method::ALL {
        if matches!(method, Method::Andreff | Method::AndreffScaled | Method::Li) {
            let refused = solve(&pairs, method);
            assert!(matches!(refused, Err(Error::NotDetermined { .. })), "{}", method.name());
        } else {
            assert_near(&solve(&pairs, method).unwrap(), &truth, 1e-9, method.name());
        }
    }
}

/// A quaternion and its negative are one rotation.
#[test]
fn signs_of_quaternions_change_nothing() {
    let pairs = noisy(&turned(&truth([0.1, -0.3, 1.5]), &usual(12)), 2e-3);
    let negated: Vec<PosePair> = pairs.iter().enumerate().map(|(k, p)| negate(k, p)).collect();
    for method in Method::ALL {
        let (one, other) = (solve(&pairs, method).unwrap(), solve(&negated, method).unwrap());
        assert_near(&other, &one, 1e-12, method.name());
    }
}

fn negate(k: usize, pair: &PosePair) -> PosePair {
    let turned = |iso: &Isometry3<f64>, negative: bool| {
        let q = iso.rotation.into_inner();
        let q: Quaternion<f64> = if negative { -q } else { q };
        Isometry3::from_parts(iso.translation, UnitQuaternion::new_unchecked(q))
    };
    PosePair {
        anchor_from_mount: Pose::claim(turned(pair.anchor_from_mount.iso(), k % 3 == 1)),
        camera_from_target: Pose::claim(turned(pair.camera_from_target.iso(), k % 5 < 2)),
    }
}

/// Poses of the target off by waves of `size` (rad, m).
fn noisy(pairs: &[PosePair], size: f64) -> Vec<PosePair> {
    let wave = |k: usize, i: usize| size * (7.3 * k as f64 + 2.9 * i as f64 + 0.7).sin();
    let mut pairs = pairs.to_vec();
    for (k, pair) in pairs.iter_mut().enumerate() {
        let off = pose::<Target, Target>(
            [wave(k, 0), wave(k, 1), wave(k, 2)],
            [wave(k, 3), wave(k, 4), wave(k, 5)],
        );
        pair.camera_from_target = pair.camera_from_target * off;
    }
    pairs
}

/// The linear answers of bad data are no rotations, some mirror: what comes out never does.
#[test]
fn answers_are_rotations_however_bad_the_data() {
    let size = [0.03, 0.3, 1.0, 3.0];
    for (size, count) in size.into_iter().flat_map(|s| [(s, 3), (s, 4), (s, 9), (s, 30)]) {
        let pairs = noisy(&turned(&truth([0.1, -0.3, 1.5]), &usual(count)), size);
        for method in Method::ALL {
            let Ok(found) = solve(&pairs, method) else { continue };
            for r in [found.mount_from_camera.rotation(), found.anchor_from_target.rotation()] {
                assert!((r.determinant() - 1.0).abs() < 1e-12, "{}", method.name());
                assert!((r * r.transpose() - Matrix3::identity()).norm() < 1e-12);
            }
        }
    }
}

#[test]
fn captures_turned_by_one_degree_suffice_when_they_are_exact() {
    let truth = truth([0.1, -0.3, 1.5]);
    let small: Vec<[f64; 3]> = usual(8).iter().map(|r| r.map(|x| 0.02 * x)).collect();
    assert_all_find(&truth, &turned(&truth, &small), 1e-6, "one degree");
}

#[test]
fn a_base_far_away_costs_no_more_than_its_digits() {
    let truth = truth([0.1, -0.3, 1.5]);
    let far: Pose<Anchor, Anchor> = pose([1000.0, -2000.0, 300.0], [0.2, 0.7, -1.1]);
    let mut pairs = turned(&truth, &usual(12));
    for pair in &mut pairs {
        pair.anchor_from_mount = far * pair.anchor_from_mount;
    }
    let moved = HandEye { anchor_from_target: far * truth.anchor_from_target, ..truth };
    assert_all_find(&moved, &pairs, 1e-8, "far away");
}

#[test]
fn an_unknown_unit_of_the_camera_leaves_the_camera_in_its_place() {
    let truth = truth([0.1, -0.3, 1.5]);
    let mut pairs = turned(&truth, &usual(8));
    for pair in &mut pairs {
        let mut iso = *pair.camera_from_target.iso();
        iso.translation.vector *= 1000.0;
        pair.camera_from_target = Pose::claim(iso);
    }
    let found = solve(&pairs, Method::AndreffScaled).unwrap();
    assert_near(&found, &truth, 1e-9, "millimetres");
    let scale = solve::andreff::solve_with_scale(&pairs).unwrap().scale;
    assert!((scale * 1000.0 - 1.0).abs() < 1e-9, "{scale}");
}

/// A quaternion near a half turn may come with either sign; one motion with the wrong one spoils
/// the eight equations of all.
#[test]
fn motions_near_a_half_turn_never_spoil_the_dual_quaternions() {
    let mut random = handeye::math::random::Random::new(15);
    let (mut worst, mut near) = (0.0f64, 0);
    for _ in 0..1000 {
        let truth = truth((random.normal3() * 0.8).into());
        let mut turn = |_| {
            let tilt = random.normal3() * 0.3;
            let spin = Vector3::z() * random.between(-PI, PI);
            let both =
                UnitQuaternion::from_scaled_axis(tilt) * UnitQuaternion::from_scaled_axis(spin);
            both.scaled_axis().into()
        };
        let rotations: Vec<[f64; 3]> = (0..15).map(&mut turn).collect();
        let mut pairs = turned(&truth, &rotations);
        for pair in &mut pairs {
            let (w, t) = (random.normal3() * 1e-3, random.normal3() * 0.3e-3);
            pair.camera_from_target = pair.camera_from_target * pose(t.into(), w.into());
        }
        let angles = solve::motions::motions(&pairs);
        near += angles.iter().filter(|m| m.a.rotation.angle() > 170f64.to_radians()).count();
        let found = solve(&pairs, Method::Daniilidis).unwrap();
        worst = worst.max(found.mount_from_camera.distance_to(&truth.mount_from_camera));
    }
    println!("{near} motions beyond 170 degrees; worst of 1000: {:.2} mm", worst * 1e3);
    assert!(near > 1000 && worst < 5e-3, "{near} {worst}");
}

/// Fifteen noisy pairs and what OpenCV made of them; `bench/closed_forms/run.py --oracle` wrote it.
const ORACLE: &str = include_str!("closed_forms_opencv.txt");

#[test]
fn opencv_agrees_to_a_millionth() {
    let (mut pairs, mut compared) = (Vec::new(), 0);
    for line in ORACLE.lines().filter(|line| !line.starts_with('#')) {
        let (name, numbers) = line.split_once(' ').unwrap();
        let n: Vec<f64> = numbers.split(' ').map(|x| x.parse().unwrap()).collect();
        if name == "pair" {
            pairs.push(PosePair {
                anchor_from_mount: from_numbers(&n[..12]),
                camera_from_target: from_numbers(&n[12..]),
            });
            continue;
        }
        let wanted: Pose<Mount, Camera> = from_numbers(&n);
        let found = solve(&pairs, Method::from_name(name).unwrap()).unwrap().mount_from_camera;
        let (angle, distance) = (found.angle_to(&wanted), found.distance_to(&wanted));
        assert!(angle < 1e-6 && distance < 1e-6, "{name}: {angle} rad, {distance} m");
        compared += 1;
    }
    assert_eq!(compared, 7);
}

/// Rotation by rows, then translation (m).
fn from_numbers<A, B>(n: &[f64]) -> Pose<A, B> {
    Pose::from_parts(&Matrix3::from_row_slice(&n[..9]), Vector3::from_column_slice(&n[9..]))
}
