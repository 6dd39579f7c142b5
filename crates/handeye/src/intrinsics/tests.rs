use super::{
    adjustment::{Corner, Shared, linearised, residual},
    *,
};
use crate::{
    Distortion,
    math::{lie, linalg::root_mean, random::Random},
    model::camera::LENS_PARAMETERS,
};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3, Vector6};

const BROWN: [f64; 12] = [-0.28, 0.11, 6e-4, -4e-4, -0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const RATIONAL: [f64; 12] = [0.9, -0.2, 6e-4, -4e-4, 0.05, 1.1, 0.3, -0.1, 0.0, 0.0, 0.0, 0.0];
const PRISM: [f64; 12] = [0.9, -0.2, 6e-4, -4e-4, 0.05, 1.1, 0.3, -0.1, 8e-3, -2e-3, -6e-3, 1e-3];

fn board() -> TargetModel {
    TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 }
}

fn camera(k: [f64; 12]) -> Intrinsics {
    let pinhole = Intrinsics::pinhole(1280, 960, 1050.0, 1047.0, 652.0, 467.0);
    Intrinsics { distortion: Distortion::BrownConrady(k), ..pinhole }
}

/// The board all over the image, tilted by up to `tilt` rad.
fn views(n: usize, camera: &Intrinsics, tilt: f64, sigma: f64, seed: u64) -> Vec<Vec<ImageCorner>> {
    let mut random = Random::new(seed);
    let mut view = || loop {
        let z = random.between(0.35, 0.6);
        let at = Vector3::new(random.between(-0.35, 0.2) * z, random.between(-0.3, 0.15) * z, z);
        let turn = Vector3::from_fn(|_, _| random.between(-tilt, tilt));
        let turn = lie::tangent(&turn, &Vector3::zeros());
        let pose = Pose::<Camera, Target>::from_parts(&Matrix3::identity(), at).retract(&turn);
        let mut one = |(id, p): (usize, crate::Point<Target>)| {
            let pixel = camera.project(&(pose * p).vector())?;
            let inside = (0.0..1279.0).contains(&pixel.x) && (0.0..959.0).contains(&pixel.y);
            let noise = Vector2::new(random.normal(), random.normal()) * sigma;
            let covariance = Matrix2::identity() * sigma.max(1e-4).powi(2);
            inside.then(|| ImageCorner { id: id as u32, pixel: pixel + noise, covariance })
        };
        let all: Vec<_> = board().corners().into_iter().enumerate().filter_map(&mut one).collect();
        if all.len() == 54 {
            return all;
        }
    };
    (0..n).map(|_| view()).collect()
}

#[test]
fn exact_corners_give_the_exact_camera() {
    let truth = camera(BROWN);
    let found =
        calibrate(&views(12, &truth, 0.6, 0.0, 1), &board(), 1280, 960, LensModel::default())
            .unwrap();
    assert_eq!(found.parameters.len(), 9);
    let c = found.intrinsics;
    assert!((c.fx - truth.fx).abs() < 1e-5 && (c.cy - truth.cy).abs() < 1e-5, "{c:?}");
    assert!((c.coefficients()[4] - BROWN[4]).abs() < 1e-5, "{c:?}");
}

#[test]
fn errors_stay_inside_the_covariance() {
    let truth = camera(BROWN);
    let wanted =
        [truth.fx, truth.fy, truth.cx, truth.cy, BROWN[0], BROWN[1], BROWN[2], BROWN[3], BROWN[4]];
    let (mut sum, mut count) = (0.0, 0.0);
    for seed in 0..12 {
        let found = calibrate(
            &views(12, &truth, 0.6, 0.1, seed),
            &board(),
            1280,
            960,
            LensModel::default(),
        )
        .unwrap();
        let c = found.intrinsics;
        let mut got = vec![c.fx, c.fy, c.cx, c.cy];
        got.extend(&c.coefficients()[..5]);
        if found.parameters.len() < 9 {
            continue; // k3 was not worth its price: then the model is wrong by that much
        }
        let e = nalgebra::DVector::from_fn(9, |i, _| got[i] - wanted[i]);
        sum += e.dot(&found.covariance.cholesky().unwrap().solve(&e)) / 9.0;
        count += 1.0;
    }
    let ratio = sum / f64::max(count, 1.0);
    assert!(count == 0.0 || (0.5..1.7).contains(&ratio), "{ratio} of {count}");
}

#[test]
fn a_lens_without_distortion_gets_none() {
    let truth = Intrinsics::pinhole(1280, 960, 1050.0, 1047.0, 652.0, 467.0);
    let found =
        calibrate(&views(10, &truth, 0.6, 0.1, 3), &board(), 1280, 960, LensModel::default())
            .unwrap();
    assert_eq!(found.intrinsics.distortion, Distortion::None);
    assert!((found.intrinsics.fx - 1050.0).abs() < 2.0);
}

#[test]
fn parallel_views_leave_the_focal_length_open() {
    let parallel = views(8, &camera(BROWN), 0.0, 0.1, 4);
    let error = calibrate(&parallel, &board(), 1280, 960, LensModel::default()).unwrap_err();
    assert!(error.to_string().contains("focal length"), "{error}");
}

/// Root of the mean squared distance (px) between the images of one ray in two cameras, where the
/// board was seen.
fn apart(truth: &Intrinsics, found: &Intrinsics, views: &[Vec<ImageCorner>]) -> f64 {
    let off = |corner: &ImageCorner| {
        let ray = truth.ray(&corner.pixel).unwrap();
        (found.project(&ray).unwrap() - corner.pixel).norm_squared()
    };
    root_mean(views.iter().flatten().map(off)).unwrap()
}

#[test]
fn every_model_of_a_lens_is_found() {
    let fisheye = Distortion::KannalaBrandt([-0.03, 0.01, -4e-3, 1e-3]);
    let fisheye = Intrinsics { fx: 520.0, fy: 519.0, distortion: fisheye, ..camera(BROWN) };
    for (lens, truth, parameters) in [
        (LensModel::BrownConrady, camera(BROWN), 9),
        (LensModel::Rational, camera(RATIONAL), 12),
        (LensModel::ThinPrism, camera(PRISM), 16),
        (LensModel::KannalaBrandt, fisheye, 8),
    ] {
        let all = views(20, &truth, 0.6, 0.02, 7);
        let found = calibrate(&all, &board(), 1280, 960, lens).unwrap();
        let off = apart(&truth, &found.intrinsics, &all);
        assert!(off < 0.3 && found.rms_px < 0.03, "{lens:?}: {off} {}", found.rms_px);
        assert!(found.parameters.len() <= parameters, "{:?}", found.parameters);
        assert!(found.covariance.clone().cholesky().is_some(), "{lens:?}");
    }
    let all = views(20, &fisheye, 0.6, 0.02, 7);
    let wrong = calibrate(&all, &board(), 1280, 960, LensModel::BrownConrady);
    assert!(!wrong.is_ok_and(|c| c.rms_px < 0.03), "a fisheye is not of Brown's model");
}

#[test]
fn a_wrong_camera_is_told_from_a_right_one() {
    let truth = camera(BROWN);
    let mut chances = vec![];
    for seed in 0..12 {
        let all = views(12, &truth, 0.6, 0.1, seed);
        let right = cross_check(&all, &board(), &truth).unwrap();
        chances.push(right.chance);
        let given = Intrinsics { fx: truth.fx + 12.0, ..truth };
        let wrong = cross_check(&all, &board(), &given).unwrap();
        assert!(wrong.chance < 1e-6, "{}", wrong.chance);
        assert!(wrong.rms_given_px > 1.05 * wrong.found.rms_px);
    }
    // chances of a right camera are even
    let mean = chances.iter().sum::<f64>() / 12.0;
    assert!((0.2..0.8).contains(&mean) && chances.iter().all(|c| *c > 1e-3), "{chances:?}");
}

#[test]
fn two_views_are_too_few() {
    let error = calibrate(
        &views(2, &camera(BROWN), 0.6, 0.1, 5),
        &board(),
        1280,
        960,
        LensModel::default(),
    );
    assert!(matches!(error, Err(Error::TooFewPoses { found: 2, needed: 3, .. })));
}

#[test]
fn bad_corners_and_a_bad_view_are_left_out() {
    let truth = camera(BROWN);
    let mut all = views(12, &truth, 0.6, 0.1, 6);
    all[2][10].pixel.x += 8.0;
    all[4].iter_mut().for_each(|c| c.pixel.x += 30.0 * (0.7 * f64::from(c.id)).sin());
    let found = calibrate(&all, &board(), 1280, 960, LensModel::default()).unwrap();
    assert_eq!(found.views[2].left_out, vec![10]);
    assert!(found.views[4].camera_from_target.is_none());
    assert!((found.intrinsics.fx - truth.fx).abs() < 3.0, "{:?}", found.intrinsics);
}

#[test]
fn jacobians_match_central_differences() {
    let camera = camera(BROWN);
    let pose = lie::exp(&Vector6::new(0.2, -0.3, 0.1, -0.1, 0.05, 0.5));
    let in_target = Vector3::new(0.12, 0.09, 0.0);
    let corner = Corner { id: 0, in_target, pixel: Vector2::zeros(), variance: 1.0, weight: 1.0 };
    let (_, by_shared, by_pose) = linearised(&camera, &pose, &corner).unwrap();
    for k in 0..LENS_PARAMETERS {
        let mut d = Shared::zeros();
        d[k] = 1e-5;
        let at = |d: Shared| residual(&camera.moved_lens(&d), &pose, &corner).unwrap();
        assert!(((at(d) - at(-d)) / 2e-5 - by_shared.column(k)).norm() < 1e-4, "{k}");
    }
    let fisheye = Distortion::KannalaBrandt([-0.03, 0.01, -4e-3, 1e-3]);
    let fisheye = Intrinsics { distortion: fisheye, ..camera };
    let (_, by_shared, _) = linearised(&fisheye, &pose, &corner).unwrap();
    for k in 0..8 {
        let mut d = Shared::zeros();
        d[k] = 1e-5;
        let at = |d: Shared| residual(&fisheye.moved_lens(&d), &pose, &corner).unwrap();
        assert!(((at(d) - at(-d)) / 2e-5 - by_shared.column(k)).norm() < 1e-4, "{k}");
    }
    for k in 0..6 {
        let mut d = Vector6::zeros();
        d[k] = 1e-6;
        let at = |d: Vector6<f64>| residual(&camera, &(pose * lie::exp(&d)), &corner).unwrap();
        assert!(((at(d) - at(-d)) / 2e-6 - by_pose.column(k)).norm() < 1e-3, "{k}");
    }
}
