//! Balls in rendered scans against where they are.

use nalgebra::Vector3;

use super::*;
use crate::{
    Intrinsics, Pose, TargetModel,
    math::random::Random,
    simulate::{DepthSensor, Scene},
};

fn scene(diameter_mm: f64, centre: [f64; 3]) -> Scene {
    let centre = Vector3::from(centre);
    Scene {
        target: TargetModel::Sphere { diameter_mm: Some(diameter_mm) },
        camera_from_target: Pose::from_parts(&Matrix3::identity(), centre),
        intrinsics: Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5),
    }
}

fn sensor(sigma_mm: f64, diameter_mm: f64) -> DepthSensor {
    DepthSensor {
        sigma_at_1m: 1e-3 * sigma_mm,
        table_behind_m: 0.5e-3 * diameter_mm,
        ..DepthSensor::default()
    }
}

#[test]
fn an_exact_ball_is_found_exactly() {
    for (d, at) in [(50.0, [0.05, -0.03, 0.6]), (25.0, [-0.1, 0.08, 0.4]), (120.0, [0.0, 0.0, 0.9])]
    {
        let scan = scene(d, at).scan(&sensor(0.0, d), 1);
        for known in [Some(1e-3 * d), None] {
            let ball = find(&scan, known).unwrap();
            let off = (ball.centre.vector() - Vector3::from(at)).norm();
            assert!(off < 2e-6, "{d} {known:?}: {off}");
            assert!((ball.diameter_m - 1e-3 * d).abs() < 4e-6, "{ball:?}");
        }
    }
}

/// A ball at random places, with noise; its normalised squared error over three.
fn nees(size: Size, smooth: bool) -> f64 {
    let mut random = Random::new(5);
    let (mut sum, count) = (0.0, 250);
    for seed in 0..count {
        let at =
            [random.between(-0.05, 0.05), random.between(-0.05, 0.05), random.between(0.5, 0.8)];
        let small = Scene {
            intrinsics: Intrinsics::pinhole(200, 200, 600.0, 600.0, 99.5, 99.5),
            ..scene(50.0, at)
        };
        let scan = small.scan(&sensor(1.0, 50.0), seed + 5000);
        let scan =
            if smooth { smoothed(&scan, &small.scan(&sensor(0.0, 50.0), seed)) } else { scan };
        let centre = Vector3::from(at) + random.normal3() * 1e-3;
        let start = candidates::Candidate { centre, radius: 0.025 };
        let ball = Fit::of(&scan, &start, size).unwrap().ball();
        let e = ball.centre.vector() - Vector3::from(at);
        let one = e.dot(&(ball.covariance.try_inverse().unwrap() * e)) / 3.0;
        sum += one;
    }
    sum / f64::from(count as u32)
}

/// The noise of each depth shared with its neighbours in the row: what a camera's filter does.
fn smoothed(noisy: &Scan, exact: &Scan) -> Scan {
    let (noisy, exact_points) = (noisy.points(), exact.points());
    let noise = |k: usize| f64::from(noisy[k][2]) - f64::from(exact_points[k][2]);
    let n = noisy.len();
    let one = |k: usize| {
        let share = 0.25 * noise((k + n - 1) % n) + 0.5 * noise(k) + 0.25 * noise((k + 1) % n);
        let p = exact_points[k];
        p.map(|x| (f64::from(x) * (1.0 + share / f64::from(p[2]))) as f32)
    };
    Scan::new(exact.width(), exact.height(), (0..n).map(one).collect()).unwrap()
}

#[test]
fn errors_stay_inside_the_covariance() {
    for (size, smooth) in
        [(Size::Given, false), (Size::Given, true), (Size::Free, false), (Size::Free, true)]
    {
        let ratio = nees(size, smooth);
        // filters share noise over two pixels, not ever less over all: the covariance is on the safe side
        let expected = if smooth { 0.4..1.15 } else { 0.85..1.15 };
        assert!(expected.contains(&ratio), "{size:?}, shared noise {smooth}: {ratio}");
    }
}

#[test]
fn a_ball_is_found_wherever_it_is() {
    let mut random = Random::new(6);
    for seed in 0..4 {
        let at = [random.between(-0.15, 0.15), random.between(-0.1, 0.1), random.between(0.5, 0.8)];
        let scan = scene(50.0, at).scan(&sensor(1.0, 50.0), seed);
        for known in [Some(0.05), None] {
            let ball = find(&scan, known).unwrap();
            let e = ball.centre.vector() - Vector3::from(at);
            let chi2 = e.dot(&(ball.covariance.try_inverse().unwrap() * e));
            assert!(chi2 < 25.0, "{seed} {known:?}: {chi2} {e} {ball:?}");
        }
    }
}

#[test]
fn a_cloud_without_grid_gives_the_same_ball() {
    let scan = scene(50.0, [0.05, 0.02, 0.6]).scan(&sensor(0.3, 50.0), 3);
    let cloud = Scan::new(scan.points().len(), 1, scan.points().to_vec()).unwrap();
    let (a, b) = (find(&scan, None).unwrap(), find(&cloud, None).unwrap());
    assert!((a.centre.vector() - b.centre.vector()).norm() < 1e-9);
}

fn with_points(scan: &Scan, change: impl Fn(usize, usize, [f32; 3]) -> [f32; 3]) -> Scan {
    let w = scan.width();
    let all = scan.points().iter().enumerate().map(|(k, p)| change(k % w, k / w, *p));
    Scan::new(w, scan.height(), all.collect()).unwrap()
}

#[test]
fn clutter_and_a_finger_before_the_ball_do_not_pull() {
    let at = [0.02, 0.01, 0.6];
    let scan = scene(50.0, at).scan(&sensor(0.3, 50.0), 4);
    // a finger over the left of the ball, a pipe and a box beside it, and flying points
    let cluttered = with_points(&scan, |x, y, p| {
        let z = match (x, y) {
            (300..=329, 0..=250) => 0.5,
            (450..=490, _) => {
                0.58 - 0.02 * (1.0 - ((x as f32 - 470.0) / 21.0).powi(2)).max(0.0).sqrt()
            }
            (100..=200, 300..=400) => 0.55 + 0.0002 * (x as f32 - 100.0),
            _ if (x * 7 + y * 13) % 11 == 0 => p[2] * 1.07,
            _ => return p,
        };
        [(x as f32 - 319.5) / 600.0 * z, (y as f32 - 239.5) / 600.0 * z, z]
    });
    for known in [Some(0.05), None] {
        let ball = find(&cluttered, known).unwrap();
        let e = ball.centre.vector() - Vector3::from(at);
        let chi2 = e.dot(&(ball.covariance.try_inverse().unwrap() * e));
        assert!(e.norm() < 0.3e-3 && chi2 < 25.0, "{known:?}: {e} {chi2}");
    }
}

#[test]
fn reasons_are_named() {
    let d = 50.0;
    let scan = scene(d, [0.0, 0.0, 0.6]).scan(&sensor(0.3, d), 6);
    let other = find(&scan, Some(0.0492)).map(|b| b.diameter_m);
    assert!(other.is_ok(), "1.6 % is within what is tolerated: {other:?}");
    for wanted in [0.04, 0.1] {
        let Err(NoBall::OtherSize { wanted_mm, found_mm }) = find(&scan, Some(wanted)) else {
            panic!("{wanted}: {:?}", find(&scan, Some(wanted)));
        };
        assert!((wanted_mm - 1e3 * wanted).abs() < 1e-9 && (found_mm - 50.0).abs() < 0.2);
    }
    let words = NoBall::OtherSize { wanted_mm: 50.0, found_mm: 49.2 }.to_string();
    assert_eq!(words, "no ball of 50 mm: a ball of 49.2 mm is there");
    // the table alone
    let board = Scene {
        target: TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 },
        ..scene(d, [-0.08, -0.05, 0.6])
    };
    let table = board.scan(&sensor(0.5, d), 7);
    assert_eq!(find(&table, Some(0.05)).unwrap_err(), NoBall::None);
    assert_eq!(find(&table, None).unwrap_err(), NoBall::None);
    let wild = with_points(&scan, |x, y, _| [1e30, (x + y) as f32 * 1e28, 1e30]);
    assert_eq!(find(&wild, Some(0.05)).unwrap_err(), NoBall::Empty(0));
    let nothing = with_points(&scan, |_, _, _| [f32::NAN; 3]);
    assert_eq!(find(&nothing, None).unwrap_err(), NoBall::Empty(0));
}
