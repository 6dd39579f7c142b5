use super::{fit::At, *};
use crate::{Camera, Distortion, Pose, Target, math::random::Random};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3, Vector6};

#[test]
fn a_target_without_symmetry_keeps_its_poses() {
    let tag = TargetModel::Tag { dictionary: "DICT_4X4_50".into(), id: 0, size_mm: 48.0 };
    let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
    for target in [tag, board] {
        let same = symmetry_turn(&target, &target.symmetries()[0]);
        assert!(same.local(&Pose::identity()).norm() < 1e-12, "{target:?}");
    }
}
fn board() -> TargetModel {
    TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 }
}

fn camera() -> Intrinsics {
    let brown = [-0.2, 0.08, 1e-3, -5e-4, 0.01, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let pinhole = Intrinsics::pinhole(1280, 960, 1100.0, 1095.0, 640.0, 470.0);
    Intrinsics { distortion: Distortion::BrownConrady(brown), ..pinhole }
}

fn pose(random: &mut Random) -> Pose<Camera, Target> {
    let at = Vector3::new(
        random.between(-0.2, 0.0),
        random.between(-0.2, 0.0),
        random.between(0.6, 1.0),
    );
    let tilt = |random: &mut Random| random.between(-0.7, 0.7);
    let turn = Vector6::new(tilt(random), tilt(random), tilt(random), 0.0, 0.0, 0.0);
    Pose::from_parts(&Matrix3::identity(), at).retract(&turn)
}

fn corners(truth: &Pose<Camera, Target>, sigma: f64, random: &mut Random) -> Vec<ImageCorner> {
    let one = |(id, p): (usize, crate::Point<Target>)| {
        let pixel = camera().project(&(*truth * p).vector()).unwrap();
        let noise = Vector2::new(random.normal(), random.normal()) * sigma;
        let covariance = Matrix2::identity() * sigma.max(1e-3).powi(2);
        ImageCorner { id: id as u32, pixel: pixel + noise, covariance }
    };
    board().corners().into_iter().enumerate().map(one).collect()
}

#[test]
fn exact_corners_give_the_exact_pose() {
    let mut random = Random::new(3);
    for _ in 0..50 {
        let truth = pose(&mut random);
        let poses =
            target_poses(&corners(&truth, 0.0, &mut random), &[], &board(), &camera()).unwrap();
        let error = truth.local(&poses[0].pose.camera_from_target).norm();
        assert!(error < 1e-9, "{error}");
    }
}

#[test]
fn errors_stay_inside_the_covariance() {
    let mut random = Random::new(4);
    let trials = 300;
    let mut sum = 0.0;
    for _ in 0..trials {
        let truth = pose(&mut random);
        let seen = corners(&truth, 0.1, &mut random);
        let best = &target_poses(&seen, &[], &board(), &camera()).unwrap()[0].pose;
        let error = truth.local(&best.camera_from_target);
        let information = best.covariance.unwrap().try_inverse().unwrap();
        sum += error.dot(&(information * error)) / 6.0;
    }
    let ratio = sum / f64::from(trials);
    assert!((0.85..1.12).contains(&ratio), "{ratio}");
}

#[test]
fn a_few_bad_corners_are_left_out() {
    let mut random = Random::new(5);
    let truth = pose(&mut random);
    let mut seen = corners(&truth, 0.05, &mut random);
    for id in [3, 17, 40] {
        seen[id].pixel.x += 4.0;
    }
    let best = &target_poses(&seen, &[], &board(), &camera()).unwrap()[0];
    assert_eq!(best.left_out, vec![3, 17, 40]);
    assert!(truth.distance_to(&best.pose.camera_from_target) < 1e-3);
}

#[test]
fn residuals_beyond_the_covariance_widen_the_poses_covariance() {
    let mut random = Random::new(6);
    let truth = pose(&mut random);
    let mut seen = corners(&truth, 0.2, &mut random);
    let honest = target_poses(&seen, &[], &board(), &camera()).unwrap();
    seen.iter_mut().for_each(|c| c.covariance *= 0.01);
    let boasting = target_poses(&seen, &[], &board(), &camera()).unwrap();
    let trace = |p: &[PosedTarget]| p[0].pose.covariance.unwrap().trace();
    assert!((trace(&boasting) / trace(&honest) - 1.0).abs() < 0.3);
    assert!((boasting[0].excess_px - 0.2).abs() < 0.05, "{}", boasting[0].excess_px);
}

#[test]
fn a_distant_flat_board_has_two_poses() {
    let mut random = Random::new(7);
    let turn = Vector6::new(0.25, 0.1, 0.0, 0.0, 0.0, 0.0);
    let truth = Pose::from_parts(&Matrix3::identity(), Vector3::new(0.0, 0.0, 6.0)).retract(&turn);
    let poses = target_poses(&corners(&truth, 0.1, &mut random), &[], &board(), &camera()).unwrap();
    assert_eq!(poses.len(), 2);
    assert!(poses.iter().any(|p| p.pose.camera_from_target.angle_to(&truth) < 0.1));
}

#[test]
fn surface_corners_sharpen_the_depth() {
    let mut random = Random::new(8);
    let truth = pose(&mut random);
    let seen = corners(&truth, 0.1, &mut random);
    let surface: Vec<SurfaceCorner> = board()
        .corners()
        .into_iter()
        .enumerate()
        .map(|(id, p)| SurfaceCorner {
            id: id as u32,
            in_camera: crate::Point::from_vector((truth * p).vector() + random.normal3() * 1e-4),
            covariance: Matrix3::identity() * 1e-8,
        })
        .collect();
    let trace = |s: &[SurfaceCorner]| {
        let poses = target_poses(&seen, s, &board(), &camera()).unwrap();
        poses[0].pose.covariance.unwrap().trace()
    };
    assert!(trace(&surface) < 0.25 * trace(&[]));
}

#[test]
fn the_jacobian_matches_central_differences() {
    let mut random = Random::new(9);
    let truth = pose(&mut random);
    let (seen, camera) = (corners(&truth, 0.0, &mut random), camera());
    let fit = Fit::new(&seen, &[], &board(), &camera).unwrap();
    let (_, analytic) = fit.residual(&At::of(truth.iso()), &fit.seen[30]).unwrap();
    for k in 0..6 {
        let mut step = Vector6::zeros();
        step[k] = 1e-6;
        let at = |d: Vector6<f64>| {
            fit.residual(&At::of(truth.retract(&d).iso()), &fit.seen[30]).unwrap().0
        };
        let numeric = (at(step) - at(-step)) / 2e-6;
        assert!((analytic.column(k) - numeric).norm() < 1e-4, "{k}");
    }
}

#[test]
fn a_symmetry_of_the_board_explains_the_relabelled_corners() {
    let board = TargetModel::Checkerboard { columns: 6, rows: 6, square_mm: 30.0 };
    let mut random = Random::new(10);
    let truth = pose(&mut random);
    let pixel = |p: crate::Point<Target>| camera().project(&(truth * p).vector()).unwrap();
    let covariance = Matrix2::identity() * 1e-4;
    let seen: Vec<ImageCorner> = (0..36)
        .map(|id| ImageCorner { id, pixel: pixel(board.corner(id).unwrap()), covariance })
        .collect();
    let poses = target_poses(&seen, &[], &board, &camera()).unwrap();
    let all = with_symmetries(&poses[..1], &board);
    for (map, candidate) in board.symmetries().iter().zip(&all) {
        let again = target_poses(&relabelled(&seen, map), &[], &board, &camera()).unwrap();
        let refitted = &again[0].pose;
        assert!(candidate.camera_from_target.local(&refitted.camera_from_target).norm() < 1e-8);
        let difference = candidate.covariance.unwrap() - refitted.covariance.unwrap();
        assert!(difference.norm() < 1e-6 * refitted.covariance.unwrap().norm());
    }
}

#[test]
fn three_corners_are_too_few() {
    let mut random = Random::new(11);
    let seen = corners(&pose(&mut random), 0.0, &mut random);
    let error = target_poses(&seen[..3], &[], &board(), &camera()).unwrap_err();
    assert_eq!(error, Error::TooFewPoints { found: 3, needed: 4 });
    assert!(target_poses(&seen[..9], &[], &board(), &camera()).is_err(), "one row");
}

/// Known poses save the search for them, and nothing else.
#[test]
fn what_corners_typically_leave_is_the_same_from_known_poses() {
    let (mut random, camera) = (Random::new(11), camera());
    let poses: Vec<Pose<Camera, Target>> = (0..6).map(|_| pose(&mut random)).collect();
    let seen: Vec<_> = poses.iter().map(|pose| corners(pose, 0.3, &mut random)).collect();
    let near = |pose: &Pose<Camera, Target>| {
        let camera_from_target = pose.retract(&Vector6::repeat(1e-3));
        [TargetPose { camera_from_target, covariance: None }]
    };
    let near: Vec<[TargetPose; 1]> = poses.iter().map(near).collect();
    let pictures = seen.iter().zip(&near).map(|(c, n)| (&c[..], &n[..]));
    let found = typical_excess_near(pictures, &board(), &camera).unwrap();
    let pictures: Vec<&[ImageCorner]> = seen.iter().map(Vec::as_slice).collect();
    let posed = best_poses(&pictures, &board(), &camera, 2);
    let whole = typical_excess(posed.iter().flatten()).unwrap();
    assert!(whole > 0.01 && (found - whole).abs() < 1e-9, "{found} {whole}");
}
