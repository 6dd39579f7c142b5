use super::*;
use crate::{
    Distortion, Pose,
    math::random::Random,
    simulate::{Optics, Scene},
};
use nalgebra::{Matrix3, Vector3, Vector6};

fn symmetric(columns: u32, rows: u32) -> TargetModel {
    TargetModel::CircleGrid { columns, rows, pitch_mm: 20.0 }
}

fn asymmetric(columns: u32, rows: u32) -> TargetModel {
    TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm: 20.0 }
}

fn modified(columns: u32, rows: u32) -> TargetModel {
    TargetModel::ModifiedCircleGrid { columns, rows, pitch_mm: 20.0 }
}

fn pinhole() -> Intrinsics {
    Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5)
}

fn bent() -> Intrinsics {
    let brown = [-0.2, 0.05, 0.001, -0.001, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    Intrinsics { distortion: Distortion::BrownConrady(brown), ..pinhole() }
}

/// The middle of the board at `depth` pitches on the optical axis, tilted by `tilt` about an axis
/// in its plane, turned by `roll`.
fn scene(
    target: &TargetModel,
    camera: Intrinsics,
    (tilt, axis, roll): (f64, f64, f64),
    depth: f64,
) -> Scene {
    let corners = target.corners();
    let sum = corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>();
    let centre = sum / corners.len() as f64;
    let away = Vector3::new(0.0, 0.0, depth * target.pitch_m());
    let turn = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0);
    let camera_from_target = Pose::from_parts(&Matrix3::identity(), away)
        .retract(&turn(tilt * axis.cos(), tilt * axis.sin(), 0.0))
        .retract(&turn(0.0, 0.0, roll))
        .retract(&Vector6::new(0.0, 0.0, 0.0, -centre.x, -centre.y, 0.0));
    Scene { target: target.clone(), camera_from_target, intrinsics: camera }
}

type Error = (Vector2<f64>, Matrix2<f64>);

/// Errors of all centres, under the labelling among the board's symmetries that fits.
fn errors(scene: &Scene, found: &[ImageCorner]) -> Vec<Error> {
    let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
    let under = |map: &Vec<u32>| -> Vec<Error> {
        found.iter().map(|c| (c.pixel - truth[&map[c.id as usize]], c.covariance)).collect()
    };
    let all = scene.target.symmetries();
    all.iter().map(under).min_by(|a, b| rms(a).total_cmp(&rms(b))).unwrap()
}

fn rms(errors: &[Error]) -> f64 {
    (errors.iter().map(|e| e.0.norm_squared()).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Mean of the squared errors over their covariances; 1 is expected.
fn expected_ratio(errors: &[Error]) -> f64 {
    let one = |(e, c): &Error| e.dot(&(c.try_inverse().unwrap() * e));
    errors.iter().map(one).sum::<f64>() / (2.0 * errors.len() as f64)
}

/// Errors over some views of a target; all its circles must be found in each.
fn views_of(target: &TargetModel, camera: &Intrinsics, optics: &Optics, depth: f64) -> Vec<Error> {
    let mut random = Random::new(3);
    let one = |k: u64| {
        let tilt = random.between(0.0, 1.1);
        let (axis, roll) = (random.between(0.0, 6.3), random.between(0.0, 6.3));
        let scene = scene(target, *camera, (tilt, axis, roll), depth);
        let found = detect(&scene.picture(optics, k), target);
        let found = found.unwrap_or_else(|e| panic!("{target:?}, view {k}, tilt {tilt}: {e}"));
        assert_eq!(found.len(), target.len());
        let errors = errors(&scene, &found);
        assert!(rms(&errors) < 0.25, "{target:?}, view {k}: labelled wrongly");
        errors
    };
    (0..6).flat_map(one).collect()
}

#[test]
fn every_kind_is_found_in_every_turn_and_tilt() {
    let mut all = vec![];
    for (target, depth) in
        [(symmetric(7, 5), 18.0), (asymmetric(4, 11), 26.0), (modified(8, 6), 18.0)]
    {
        for k in 0..12 {
            let k = f64::from(k);
            let scene = scene(&target, pinhole(), (0.1 * k, 2.1 * k, 0.7 * k), depth);
            let picture = scene.picture(&Optics::default(), k as u64);
            let found = detect(&picture, &target).unwrap_or_else(|e| panic!("{target:?} {k}: {e}"));
            assert_eq!(found.len(), target.len(), "{target:?} {k}");
            let errors = errors(&scene, &found);
            assert!(rms(&errors) < 0.03, "{target:?} {k}: {}", rms(&errors));
            all.extend(errors);
        }
    }
    assert!(rms(&all) < 0.01, "{}", rms(&all));
    let ratio = expected_ratio(&all);
    assert!((0.8..1.25).contains(&ratio), "{ratio}");
}

#[test]
fn noise_blur_light_and_polarity_cost_little() {
    let usual = Optics::default();
    let light_on_dark = Optics { black: 210.0, white: 40.0, ..usual };
    // optics, depth in pitches, goal px
    let cases = [
        ("noisy", Optics { noise: 8.0, ..usual }, 18.0, 0.03),
        ("blurred", Optics { blur_px: 2.0, ..usual }, 18.0, 0.015),
        ("sharp", Optics { blur_px: 0.4, noise: 1.0, ..usual }, 18.0, 0.006),
        ("light on dark", light_on_dark, 18.0, 0.01),
        ("uneven light", Optics { vignetting: 0.7, ..usual }, 18.0, 0.015),
        ("faint", Optics { black: 100.0, white: 130.0, ..usual }, 18.0, 0.05),
        ("four pixels wide", usual, 50.0, 0.03),
    ];
    for (name, optics, depth, goal) in cases {
        for target in [symmetric(7, 5), asymmetric(4, 7), modified(7, 6)] {
            let errors = views_of(&target, &pinhole(), &optics, depth);
            let ratio = expected_ratio(&errors);
            assert!(rms(&errors) < goal, "{name}, {target:?}: {}", rms(&errors));
            // a sharp image's rounding is less than its covariance takes it for
            assert!((0.7..1.25).contains(&ratio), "{name}, {target:?}: {ratio}");
        }
    }
}

/// The ellipses' own centres, fitted from the true places.
fn uncorrected(scene: &Scene, picture: &GrayImage) -> Vec<Error> {
    let sheet = Sheet {
        image: picture,
        target: &scene.target,
        board: Board::of(&scene.target).unwrap(),
        camera: Some(&scene.intrinsics),
    };
    let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
    let sightings: Vec<Sighting> = truth
        .iter()
        .map(|(&id, &pixel)| Sighting {
            on_board: sheet.on_board(id).unwrap(),
            pixel,
            covariance: Matrix2::identity(),
        })
        .collect();
    let size = (picture.width(), picture.height());
    let view = View::fit(&sightings, size, Some(&scene.intrinsics)).unwrap();
    let one = |s: &Sighting, truth: &Vector2<f64>| {
        let shape = view.circle(&s.on_board, 0.25).unwrap().1;
        let rough = Rough { centre: *truth, shape, dark: true, clear: 2.0 };
        let found = ellipse::fit(picture, &rough).unwrap();
        (found.centre - truth, found.covariance)
    };
    sightings.iter().zip(truth.values()).map(|(s, t)| one(s, t)).collect()
}

#[test]
fn large_circles_are_corrected_for_perspective_and_lens() {
    let target = symmetric(4, 3);
    for (camera, goal, with_camera) in [(pinhole(), 0.01, 0.01), (bent(), 0.03, 0.01)] {
        let (mut before, mut after, mut knowing) = (vec![], vec![], vec![]);
        for k in 0..6 {
            let k = f64::from(k);
            let scene = scene(&target, camera, (0.2 + 0.15 * k, 2.1 * k, 0.7 * k), 8.0);
            let picture = scene.picture(&Optics::default(), k as u64);
            before.extend(uncorrected(&scene, &picture));
            after.extend(errors(&scene, &detect(&picture, &target).unwrap()));
            let found = detect_with(&picture, &target, Some(&camera)).unwrap();
            knowing.extend(errors(&scene, &found));
        }
        assert!(rms(&before) > 0.15, "there is something to correct: {}", rms(&before));
        assert!(rms(&after) < goal, "{}", rms(&after));
        assert!(rms(&knowing) < with_camera, "{}", rms(&knowing));
    }
}

#[test]
fn a_part_of_a_grid_with_a_larger_circle_is_enough() {
    let target = modified(8, 6);
    let mut scene = scene(&target, pinhole(), (0.3, 1.0, 0.2), 12.0);
    let corner = scene.corners().iter().find(|c| c.0 == 40).unwrap().1;
    // the corner with the larger circle moves to the middle of the left edge
    let ray = Vector3::new((80.0 - corner.x) / 900.0, (300.0 - corner.y) / 900.0, 0.0) * 0.24;
    scene.camera_from_target =
        Pose::from_parts(&Matrix3::identity(), ray) * scene.camera_from_target;
    let picture = scene.picture(&Optics::default(), 1);
    let found = detect(&picture, &target).unwrap();
    assert!((24..44).contains(&found.len()), "{}", found.len());
    assert!(rms(&errors(&scene, &found)) < 0.02);
}

#[test]
fn circles_just_inside_the_picture_are_found() {
    for target in [symmetric(7, 5), modified(7, 5)] {
        let mut scene = scene(&target, pinhole(), (0.0, 0.0, 0.0), 18.0);
        let left = scene.corners().iter().map(|c| c.1.x).fold(f64::INFINITY, f64::min);
        // 50 px to a pitch: the edge of the widest circle comes to 2 px from the image's
        let radius = if target == symmetric(7, 5) { 12.5 } else { 20.0 };
        let aside = (radius + 2.0 - left) / 900.0 * 18.0 * target.pitch_m();
        let shift = Pose::from_parts(&Matrix3::identity(), Vector3::new(aside, 0.0, 0.0));
        scene.camera_from_target = shift * scene.camera_from_target;
        let found = detect(&scene.picture(&Optics::default(), 4), &target).unwrap();
        assert_eq!(found.len(), target.len());
        assert!(rms(&errors(&scene, &found)) < 0.01, "{}", rms(&errors(&scene, &found)));
    }
}

#[test]
fn a_covered_circle_is_not_guessed() {
    let target = symmetric(7, 5);
    let scene = scene(&target, pinhole(), (0.3, 1.0, 0.2), 18.0);
    let picture = scene.picture(&Optics::default(), 6);
    let hidden = scene.corners()[17].1;
    let width = picture.width();
    let values = picture.values().iter().enumerate().map(|(k, v)| {
        let at = Vector2::new((k % width) as f64, (k / width) as f64);
        if (at - hidden).norm() < 18.0 { 210.0 } else { *v }
    });
    let picture = GrayImage::new(width, picture.height(), values.collect()).unwrap();
    assert_eq!(detect(&picture, &target), Err(NotFound::TooFew { found: 34, needed: 35 }));
}

#[test]
fn a_grid_of_another_size_is_named() {
    let picture = |target: &TargetModel| {
        scene(target, pinhole(), (0.4, 1.0, 0.3), 18.0).picture(&Optics::default(), 5)
    };
    let message = |picture: &GrayImage, target| detect(picture, &target).unwrap_err().to_string();
    let shown = picture(&symmetric(7, 5));
    assert!(
        message(&shown, symmetric(6, 5)).contains("7 x 5"),
        "{}",
        message(&shown, symmetric(6, 5))
    );
    assert!(message(&shown, symmetric(8, 6)).contains("7 x 5"));
    assert!(detect(&shown, &asymmetric(4, 7)).is_err());
    assert!(detect(&shown, &modified(7, 5)).is_err(), "no circle is larger");
    let shown = picture(&asymmetric(4, 7));
    assert!(
        message(&shown, asymmetric(4, 9)).contains("4 x 7"),
        "{}",
        message(&shown, asymmetric(4, 9))
    );
    assert!(detect(&shown, &symmetric(4, 7)).is_err());
    let shown = picture(&modified(7, 5));
    assert!(detect(&shown, &modified(6, 5)).is_err());
}

#[test]
fn pictures_without_circles_say_so() {
    let checkerboard = |columns, rows| TargetModel::Checkerboard { columns, rows, square_mm: 20.0 };
    let targets = || [symmetric(4, 3), symmetric(7, 5), asymmetric(4, 5), modified(5, 4)];
    for depth in [18.0, 60.0, 110.0] {
        let board = checkerboard(9, 6);
        for tilt in [0.0, 0.5, 1.0] {
            let scene = scene(&board, pinhole(), (tilt, 1.0, 0.3), depth);
            let picture = scene.picture(&Optics::default(), 7);
            for target in targets() {
                assert!(detect(&picture, &target).is_err(), "{target:?} in a checkerboard {depth}");
            }
        }
    }
    for (width, height) in [(24, 24), (25, 301), (640, 480)] {
        let flat = GrayImage::new(width, height, vec![128.0; width * height]).unwrap();
        let mut random = Random::new(9);
        let noise = (0..width * height).map(|_| random.between(0.0, 255.0) as f32).collect();
        let noise = GrayImage::new(width, height, noise).unwrap();
        for target in targets() {
            assert_eq!(detect(&flat, &target), Err(NotFound::NoCorners));
            assert!(detect(&noise, &target).is_err());
        }
    }
    let broken = GrayImage::new(64, 64, vec![f32::NAN; 4096]).unwrap();
    assert!(detect(&broken, &symmetric(4, 3)).is_err());
}

#[test]
fn a_ball_is_not_looked_for_in_pictures() {
    let picture = GrayImage::new(64, 64, vec![128.0; 4096]).unwrap();
    let ball = TargetModel::Sphere { diameter_mm: Some(50.0) };
    let message = crate::detect::detect(&picture, &ball).unwrap_err().to_string();
    assert_eq!(message, "a ball cannot be found in images: it is found in 3D scans only");
}
