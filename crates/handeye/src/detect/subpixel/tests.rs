use super::{
    disc::{LANES, Pixels},
    model::Model,
    *,
};
use crate::{
    Intrinsics, Pose, TargetModel,
    detect::subpixel::disc::Light,
    math::random::Random,
    simulate::{Optics, Scene},
};
use nalgebra::{Vector3, Vector6};

#[test]
fn the_jacobian_matches_central_differences() {
    let at = Parameters::from_column_slice(&[0.3, -0.2, 0.4, 1.8, 110.0, -60.0, 0.2, 0.01, -0.02]);
    let lights = [Light::Multiplies, Light::Adds];
    let places = [(0.5, 0.1), (-3.0, 2.0), (1.0, -4.0)];
    for (light, (x, y)) in lights.iter().flat_map(|light| places.map(|place| (*light, place))) {
        let one = |v: f32| [v; LANES];
        let (x, y, grey, weight) = (&one(x), &one(y), &one(0.0), &one(1.0));
        let pixel = Pixels { x, y, grey, weight };
        let rows = Model::new(&at, light).rows::<false>(&pixel);
        for k in 0..9 {
            let mut step = Parameters::zeros();
            step[k] = 1e-2;
            let value =
                |at: &Parameters| -f64::from(Model::new(at, light).rows::<false>(&pixel)[9][0]);
            let numeric = (value(&(at + step)) - value(&(at - step))) / 2e-2;
            let analytic = f64::from(rows[k][0]);
            assert!((analytic - numeric).abs() < 3e-3 * (3.0 + numeric.abs()), "{k}");
        }
    }
}

/// Fits every corner of six images from starts 0.5 px off: errors and their covariances.
fn errors(cell_px: f64, optics: &Optics) -> Vec<(Vector2<f64>, Matrix2<f64>)> {
    let mut random = Random::new(42);
    let mut all = vec![];
    for seed in 0..6 {
        let scene = scene(cell_px, &mut random);
        let picture = scene.picture(optics, seed);
        for (rough, truth) in rough_corners(&scene, &mut random) {
            if let Ok(fitted) = fit(&picture, &rough) {
                all.push((fitted.pixel - truth, fitted.covariance));
            }
        }
    }
    all
}

/// A 10 x 7 board, tilted up to 45 degrees.
fn scene(cell_px: f64, random: &mut Random) -> Scene {
    let focal = 1000.0;
    let (square, depth) = (0.02, 0.02 * focal / cell_px);
    let tilt = random.between(0.0, 0.78);
    let axis = random.between(0.0, std::f64::consts::TAU);
    let tilt = Vector6::new(tilt * axis.cos(), tilt * axis.sin(), 0.0, 0.0, 0.0, 0.0);
    let roll = Vector6::new(0.0, 0.0, random.between(-0.52, 0.52), 0.0, 0.0, 0.0);
    let centre = Vector6::new(0.0, 0.0, 0.0, -4.5 * square, -3.0 * square, 0.0);
    let away = Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::new(0.0, 0.0, depth));
    Scene {
        target: TargetModel::Checkerboard { columns: 10, rows: 7, square_mm: 20.0 },
        camera_from_target: away.retract(&tilt).retract(&roll).retract(&centre),
        intrinsics: Intrinsics::pinhole(800, 600, focal, focal, 399.5, 299.5),
    }
}

fn rough_corners(scene: &Scene, random: &mut Random) -> Vec<(RoughCorner, Vector2<f64>)> {
    let corners = scene.corners();
    let at = |id: u32| corners.iter().find(|c| c.0 == id).map(|c| c.1);
    let one = |&(id, truth): &(u32, Vector2<f64>)| {
        let next = |step: u32, last: bool| {
            let there = if last { truth - at(id - step)? } else { at(id + step)? - truth };
            Some(there)
        };
        let off = Vector2::new(random.between(-0.35, 0.35), random.between(-0.35, 0.35));
        let rough = RoughCorner {
            pixel: truth + off,
            along_x: next(1, id % 10 == 9)?,
            along_y: next(10, id / 10 == 6)?,
            clean: 1.0,
            marker: None,
        };
        Some((rough, truth))
    };
    corners.iter().filter_map(one).collect()
}

fn rms(errors: &[(Vector2<f64>, Matrix2<f64>)]) -> f64 {
    (errors.iter().map(|e| e.0.norm_squared()).sum::<f64>() / errors.len() as f64).sqrt()
}

#[test]
fn corners_are_found_to_a_few_hundredths_of_a_pixel() {
    // cell px, blur px, noise, goal px
    let cases = [
        (60.0, 0.6, 1.5, 0.009),
        (45.0, 0.9, 2.5, 0.014),
        (45.0, 2.0, 3.0, 0.019),
        (14.0, 0.7, 2.0, 0.010),
        (45.0, 1.0, 8.0, 0.034),
    ];
    for (cell_px, blur_px, noise, goal) in cases {
        let errors = errors(cell_px, &Optics { blur_px, noise, ..Optics::default() });
        assert!(errors.len() > 410, "{} corners", errors.len());
        assert!(rms(&errors) < goal, "{cell_px} {blur_px} {noise}: {}", rms(&errors));
        let ratio = expected_ratio(&errors);
        assert!((0.9..1.15).contains(&ratio), "{cell_px} {blur_px} {noise}: {ratio}");
    }
}

/// Mean of the squared errors over their covariances; 1 is expected.
fn expected_ratio(errors: &[(Vector2<f64>, Matrix2<f64>)]) -> f64 {
    let one = |(e, c): &(Vector2<f64>, Matrix2<f64>)| e.dot(&(c.try_inverse().unwrap() * e));
    errors.iter().map(one).sum::<f64>() / (2.0 * errors.len() as f64)
}

#[test]
fn light_that_fades_does_not_move_corners() {
    let optics = Optics { vignetting: 0.5, noise: 0.5, ..Optics::default() };
    assert!(rms(&errors(45.0, &optics)) < 0.006);
}

#[test]
fn a_lens_out_of_focus_costs_little() {
    let optics = Optics { blur_px: 0.5, defocus_px: 2.0, ..Optics::default() };
    assert!(rms(&errors(45.0, &optics)) < 0.03);
}

#[test]
fn a_flat_picture_has_no_corner() {
    let flat = GrayImage::new(60, 60, vec![90.0; 3600]).unwrap();
    let rough = RoughCorner {
        pixel: Vector2::new(30.0, 30.0),
        along_x: Vector2::new(20.0, 0.0),
        along_y: Vector2::new(0.0, 20.0),
        clean: 1.0,
        marker: None,
    };
    assert_eq!(fit(&flat, &rough), Err(Unfit::NoCorner));
    let rough = RoughCorner { pixel: Vector2::new(3.0, 30.0), ..rough };
    assert_eq!(fit(&flat, &rough), Err(Unfit::AtTheEdge));
}

/// A checkerboard of whole black and white pixels, as a rasterised print has it.
#[test]
fn perfectly_sharp_corners_are_all_found() {
    for cell in [8.0, 14.77, 29.53, 59.06, 147.64] {
        let edge = |k: usize| 5.3 + cell * k as f64;
        let size = edge(7).ceil() as usize + 5;
        let index = |x: usize| ((x as f64 - edge(0)) / cell).floor() as i64;
        let grey = |x: usize, y: usize| {
            let board = |k: i64| (0..7).contains(&k);
            let black = board(index(x)) && board(index(y)) && (index(x) + index(y)) % 2 == 0;
            if black { 0.0 } else { 255.0 }
        };
        let pixels = (0..size * size).map(|k| grey(k % size, k / size)).collect();
        let image = GrayImage::new(size, size, pixels).unwrap();
        for (i, j) in (1..7).flat_map(|i| (1..7).map(move |j| (i, j))) {
            let on_edge = |k: usize| edge(k).ceil() - 0.5;
            let truth = Vector2::new(on_edge(i), on_edge(j));
            for off in [(0.0, 0.0), (0.4, -0.3), (-0.5, 0.5), (0.7, 0.2)] {
                let rough = RoughCorner {
                    pixel: truth + Vector2::new(off.0, off.1),
                    along_x: Vector2::new(cell, 0.0),
                    along_y: Vector2::new(0.0, cell),
                    clean: 1.0,
                    marker: None,
                };
                let error = fit(&image, &rough).map(|f| (f.pixel - truth).norm());
                assert!(error.is_ok_and(|e| e < 0.05), "{cell} {i} {j} {off:?}: {error:?}");
            }
        }
    }
}

/// Black below and to the right of the middle, white elsewhere, under a veil that gets brighter to the
/// upper left; `chequered` is black to the upper left too.
fn square_in_glare(light: f64, chequered: bool) -> GrayImage {
    let grey = |x: f64, y: f64| {
        let side = |d: f64| 1.0 / (1.0 + (-1.5 * d).exp());
        let other = if chequered { side(-x) * side(-y) } else { 0.0 };
        let veil = light * (-(x + y) / 6.0).exp();
        (210.0 - 170.0 * (side(x) * side(y) + other) + veil).round().clamp(0.0, 255.0) as f32
    };
    let at = |k: usize| grey((k % 60) as f64 - 30.0, (k / 60) as f64 - 30.0);
    GrayImage::new(60, 60, (0..3600).map(at).collect()).unwrap()
}

#[test]
fn where_glare_drowns_a_black_square_its_corner_is_not_in_sight() {
    let rough = RoughCorner {
        pixel: Vector2::new(30.2, 29.9),
        along_x: Vector2::new(20.0, 0.0),
        along_y: Vector2::new(0.0, 20.0),
        clean: 1.0,
        marker: None,
    };
    let in_sight =
        |light, chequered| fit(&square_in_glare(light, chequered), &rough).map(|f| f.in_sight);
    assert_eq!(in_sight(110.0, false), Ok(false));
    assert_eq!(in_sight(10.0, true), Ok(true));
}
