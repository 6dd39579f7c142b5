use super::*;
use crate::{Camera, Point, Pose, Target, math::random::Random};

/// Sessions in which no alarm may be raised, for each camera and noise.
const SESSIONS: u64 = 17;

fn camera() -> Intrinsics {
    let mut k = [0.0; 12];
    (k[0], k[1], k[2], k[3]) = (-0.12, 0.07, 3e-4, -2e-4);
    let distortion = Distortion::BrownConrady(k);
    Intrinsics { distortion, ..Intrinsics::pinhole(1280, 960, 1000.0, 1002.0, 652.0, 471.0) }
}

fn board() -> TargetModel {
    TargetModel::Checkerboard { columns: 11, rows: 8, square_mm: 25.0 }
}

/// Views of the board from all sides, all of it in the image.
fn views(count: usize, noise_px: f64, shift_px: f64, seed: u64) -> Vec<Vec<ImageCorner>> {
    let mut random = Random::new(seed);
    let mut all = vec![];
    while all.len() < count {
        let turn = [(); 3].map(|()| random.between(-0.6, 0.6));
        let at = [(); 2].map(|()| random.between(-0.1, 0.1));
        let middle = Vector3::new(at[0], at[1], random.between(0.35, 0.6));
        let centred = nalgebra::Isometry3::translation(-0.125, -0.0875, 0.0);
        let pose = nalgebra::Isometry3::new(middle, turn.into()) * centred;
        let pose: Pose<Camera, Target> = Pose::claim(pose);
        let mut corner = |(id, p): (usize, Point<Target>)| {
            let noise = Vector2::new(random.normal(), random.normal()) * noise_px;
            let seen = camera().project(&(pose * p).vector())?;
            let inside = (0.0..1279.0).contains(&seen.x) && (0.0..959.0).contains(&seen.y);
            let pixel = (seen + noise).add_scalar(shift_px);
            let covariance = Matrix2::identity() * 0.01;
            inside.then_some(ImageCorner { id: id as u32, pixel, covariance })
        };
        all.extend(
            board().corners().into_iter().enumerate().map(&mut corner).collect::<Option<Vec<_>>>(),
        );
    }
    all
}

fn found(noise_px: f64, shift_px: f64, seed: u64, given: &Intrinsics) -> Shift {
    shift(&views(20, noise_px, shift_px, seed), &board(), given).unwrap()
}

#[test]
fn half_a_pixel_is_recognised_with_its_sign() {
    let right = |half: f64| {
        (0..10)
            .filter(|seed| found(0.03, half, *seed, &camera()).half_pixel() == Some(half))
            .count()
    };
    let counts = [right(0.5), right(-0.5)];
    assert!(counts.iter().all(|n| *n >= 8), "{counts:?} of 10");
}

#[test]
fn the_shift_stays_inside_its_covariance() {
    let mut sum = 0.0;
    for seed in 0..60 {
        let Shift { shift, covariance, .. } = found(0.1, 0.3, seed, &camera());
        let off = shift.add_scalar(-0.3);
        sum += off.dot(&covariance.cholesky().unwrap().solve(&off)) / 60.0;
    }
    assert!((0.8..2.6).contains(&sum), "mean chi-square {sum}, expected below 2");
}

#[test]
fn right_corners_raise_no_alarm_whatever_is_wrong_with_the_camera() {
    let mut random = Random::new(5);
    for seed in 0..SESSIONS {
        let angle = random.between(0.0, std::f64::consts::TAU);
        let focal = if seed % 2 == 0 { 1.002 } else { 0.998 };
        let (k, c) = (camera(), 3.0 * Vector2::new(angle.cos(), angle.sin()));
        let longer = Intrinsics { fx: focal * k.fx, fy: focal * k.fy, ..k };
        let beside = Intrinsics { cx: k.cx + c.x, cy: k.cy + c.y, ..k };
        for (what, given) in [("right", k), ("focal length", longer), ("centre", beside)] {
            for noise in [0.1, 0.03] {
                let shift = found(noise, 0.0, seed, &given);
                assert!(shift.half_pixel().is_none(), "{what}, {noise}, seed {seed}: {shift:?}");
            }
        }
    }
}

#[test]
fn views_that_do_not_tell_say_nothing() {
    let few = shift(&views(4, 0.1, 0.5, 1), &board(), &camera());
    assert!(few.is_none());
    let noisy = found(1.0, 0.5, 1, &camera());
    assert!(noisy.half_pixel().is_none(), "{noisy:?}");
    // all views alike: poses take up the shift
    let alike = vec![views(1, 0.1, 0.5, 1).remove(0); 8];
    let alike = shift(&alike, &board(), &camera());
    assert!(alike.is_none_or(|s| s.half_pixel().is_none()), "{alike:?}");
}

#[test]
fn a_fisheye_is_a_camera_too() {
    let given = Intrinsics { distortion: Distortion::KannalaBrandt([0.0; 4]), ..camera() };
    // not its views: it must only not fail
    let _ = shift(&views(6, 0.1, 0.5, 1), &board(), &given);
}
