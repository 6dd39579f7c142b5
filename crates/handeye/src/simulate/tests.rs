//! Images against what geometry and optics say of them.

use std::f64::consts::{FRAC_PI_3, PI};

use nalgebra::{Matrix3, Vector2, Vector3, Vector6};

use super::*;
use super::{conditions::Slope, render::BitDepth};
use crate::{
    Camera, Flange, GrayImage, Intrinsics, Pose, Setup, Target, TargetModel, detect::detect,
};

const SIZE: (u32, u32) = (400, 320);

fn board(columns: u32, rows: u32) -> TargetModel {
    TargetModel::Checkerboard { columns, rows, square_mm: 20.0 }
}

/// Corner 0 at `pixel`, squares of `square_px`, square to the camera.
fn facing(pixel: [f64; 2], square_px: f64) -> Pose<Camera, Target> {
    let depth = 0.02 * 1000.0 / square_px;
    let off = Vector2::new(pixel[0] - 199.5, pixel[1] - 159.5) * depth / 1000.0;
    Pose::from_parts(&Matrix3::identity(), Vector3::new(off.x, off.y, depth))
}

fn scene(target: TargetModel, camera_from_target: Pose<Camera, Target>) -> Scene {
    let intrinsics = Intrinsics::pinhole(SIZE.0, SIZE.1, 1000.0, 1000.0, 199.5, 159.5);
    Scene { target, camera_from_target, intrinsics }
}

/// An 8 x 5 board, turned and tilted.
fn tilted() -> Scene {
    let turn = Vector6::new(0.3, -0.25, 0.2, 0.0, 0.0, 0.0);
    scene(board(8, 5), facing([70.0, 70.0], 34.0).retract(&turn))
}

fn sharp() -> Optics {
    Optics { blur_px: 0.0, noise: 0.0, depth: BitDepth::Twelve, ..Optics::default() }
}

/// Share of the light beyond an edge that reaches a point `x` away from it, averaged over
/// `aperture`.
fn profile(x: f64, aperture: f64, spread: impl Fn(f64) -> f64) -> f64 {
    let steps = 400;
    let at = |k: i32| x + aperture * ((f64::from(k) + 0.5) / f64::from(steps) - 0.5);
    (0..steps).map(|k| spread(at(k))).sum::<f64>() / f64::from(steps)
}

fn ramp(width: f64) -> impl Fn(f64) -> f64 {
    move |x| (x / width + 0.5).clamp(0.0, 1.0)
}

fn disc(radius: f64) -> impl Fn(f64) -> f64 {
    move |x| {
        let s = (x / radius).clamp(-1.0, 1.0);
        0.5 + (s * (1.0 - s * s).sqrt() + s.asin()) / PI
    }
}

/// Largest difference (share of the contrast) from the profile of an edge, over all places that it
/// can have in a pixel.
fn off_the_profile(optics: &Optics, spread: impl Fn(f64) -> f64) -> f64 {
    let contrast = optics.white - optics.black;
    let mut most = 0.0f64;
    for k in 0..10 {
        let edge = 199.0 + f64::from(k) / 10.0;
        // the corner is far up: between black on the left and white on the right
        let picture = scene(board(2, 2), facing([edge, 30.0], 250.0)).picture(optics, 1);
        for x in 180..220 {
            let wanted = profile(f64::from(x) - edge, optics.aperture_px, &spread);
            let grey = f64::from(picture.at(x as usize, 150));
            let white_left = picture.at(150, 150) > 128.0;
            let share = (grey - optics.black) / contrast;
            let found = if white_left { 1.0 - share } else { share };
            most = most.max((found - wanted).abs());
        }
    }
    most
}

fn gaussian(sigma: f64) -> impl Fn(f64) -> f64 {
    move |x| 0.5 * statrs::function::erf::erfc(-x / (sigma * 2f64.sqrt()))
}

/// A spread after a Gaussian, by the trapezoidal rule.
fn after(sigma: f64, spread: impl Fn(f64) -> f64) -> impl Fn(f64) -> f64 {
    let weight = |k: i32| (-0.5 * (f64::from(k) / 20.0).powi(2)).exp();
    let sum: f64 = (-100..=100).map(weight).sum();
    move |x| {
        let at = |k: i32| weight(k) * spread(x + sigma * f64::from(k) / 20.0);
        (-100..=100).map(at).sum::<f64>() / sum
    }
}

#[test]
fn an_edge_out_of_focus_has_the_profile_of_a_disc() {
    for radius in [0.5, 1.0, 2.0, 3.5, 6.0] {
        let optics = Optics { blur_px: 0.5, defocus_px: radius, ..sharp() };
        let off = off_the_profile(&optics, after(0.5, disc(radius)));
        assert!(off < 0.003, "radius {radius} px: {off}");
    }
    for radius in [2.0, 4.0, 6.0] {
        let off = off_the_profile(&Optics { defocus_px: radius, ..sharp() }, disc(radius));
        assert!(off < 0.005, "radius {radius} px, otherwise sharp: {off}");
    }
}

#[test]
fn a_moved_edge_is_a_ramp_as_wide_as_the_motion_across_it() {
    for (motion_px, motion_rad) in [(3.0, 0.0), (3.0, FRAC_PI_3), (5.3, 0.4), (8.0, 2.8)] {
        let optics = Optics { motion_px, motion_rad, ..sharp() };
        let off = off_the_profile(&optics, ramp(motion_px * motion_rad.cos().abs()));
        assert!(off < 0.012, "{motion_px} px, {motion_rad} rad: {off}");
    }
    let along = Optics { motion_px: 5.0, motion_rad: 0.5 * PI, ..sharp() };
    assert!(off_the_profile(&along, ramp(1e-9)) < 0.03, "a motion along the edge changes nothing");
}

#[test]
fn a_wider_pixel_averages_over_its_width() {
    for aperture_px in [1.0, 2.0, 3.0] {
        let off = off_the_profile(&Optics { aperture_px, ..sharp() }, ramp(1e-9));
        assert!(off < 0.004, "{aperture_px} px: {off}");
    }
    for aperture_px in [1.0, 1.3, 1.5, 2.5] {
        let optics = Optics { blur_px: 0.5, aperture_px, ..sharp() };
        let off = off_the_profile(&optics, gaussian(0.5));
        assert!(off < 0.004, "{aperture_px} px: {off}");
    }
}

#[test]
fn spreads_combine() {
    let optics = Optics { blur_px: 0.7, motion_px: 2.0, aperture_px: 2.0, ..sharp() };
    let off = off_the_profile(&optics, after(0.7, ramp(2.0)));
    assert!(off < 0.004, "{off}");
}

fn mean_and_variance(values: &[f32]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().map(|v| f64::from(*v)).sum::<f64>() / n;
    (mean, values.iter().map(|v| (f64::from(*v) - mean).powi(2)).sum::<f64>() / n)
}

#[test]
fn noise_is_that_of_reading_and_of_the_light() {
    let nothing = TargetModel::CircleGrid { columns: 3, rows: 3, pitch_mm: 1.0 };
    let scene = scene(nothing, Pose::from_parts(&Matrix3::identity(), -Vector3::z()));
    for (depth, background) in [(BitDepth::Eight, 40.0), (BitDepth::Twelve, 180.0)] {
        let optics = Optics { noise: 1.5, shot: 0.05, depth, background, ..Optics::default() };
        let picture = scene.picture(&optics, 3);
        let (mean, variance) = mean_and_variance(picture.values());
        let wanted = 1.5 * 1.5 + 0.05 * background + depth.step().powi(2) / 12.0;
        assert!((mean - background).abs() < 0.05, "{mean}");
        assert!((variance / wanted - 1.0).abs() < 0.03, "{variance} {wanted}");
        let stored = |v: &f32| (f64::from(*v) / depth.step()).fract() == 0.0;
        assert!(picture.values().iter().all(stored));
        let finer = picture.values().iter().any(|v| v.fract() != 0.0);
        assert_eq!(finer, depth == BitDepth::Twelve);
    }
}

/// Pixels in the hull of the corners.
fn on_board(scene: &Scene) -> impl Iterator<Item = (usize, usize)> {
    let corners = scene.corners();
    let all = |f: fn(&Vector2<f64>) -> f64| corners.iter().map(move |c| f(&c.1));
    let (left, right) = (all(|p| p.x).fold(f64::MAX, f64::min), all(|p| p.x).fold(0.0, f64::max));
    let (top, bottom) = (all(|p| p.y).fold(f64::MAX, f64::min), all(|p| p.y).fold(0.0, f64::max));
    (top as usize..bottom as usize)
        .flat_map(move |y| (left as usize..right as usize).map(move |x| (x, y)))
}

#[test]
fn glare_turns_its_share_of_the_black_into_white() {
    let scene = scene(board(8, 5), facing([70.0, 70.0], 34.0));
    for share in [0.15, 0.33, 0.6] {
        let glare = Some(Glare { share, at: [0.3, 0.4] });
        let under = Conditions { glare, ..Conditions::default() };
        let (plain, lit) = (scene.picture(&sharp(), 1), scene.picture_under(&under, &sharp(), 1));
        let black: Vec<_> = on_board(&scene).filter(|(x, y)| plain.at(*x, *y) < 50.0).collect();
        let white = black.iter().filter(|(x, y)| lit.at(*x, *y) >= 254.9).count();
        let found = white as f64 / black.len() as f64;
        assert!((found - share).abs() < 0.03, "{share}: {found}");
        let corners = scene.corners_under(&under, &sharp());
        assert!(corners.iter().any(|c| c.visible == Some(false)));
        assert!(corners.iter().any(|c| c.visible == Some(true)));
    }
}

#[test]
fn light_falls_off_towards_one_side() {
    let nothing = TargetModel::CircleGrid { columns: 3, rows: 3, pitch_mm: 1.0 };
    let scene = scene(nothing, Pose::from_parts(&Matrix3::identity(), -Vector3::z()));
    let light = Slope { share: 0.5, towards_rad: 0.0 };
    let under = Conditions { light, ..Conditions::default() };
    let picture = scene.picture_under(&under, &Optics { background: 200.0, ..sharp() }, 1);
    for y in [0, 160, 319] {
        assert_eq!((picture.at(0, y), picture.at(399, y)), (200.0, 100.0));
        assert!((picture.at(200, y) - 150.0).abs() < 0.2);
    }
}

#[test]
fn what_is_in_front_hides_the_board_and_nothing_else() {
    let shapes =
        [Shape::Side { share: 0.5, towards_rad: 0.4 }, Shape::Disc { share: 0.2, at: [0.5, 0.5] }];
    for shape in shapes {
        let occlusion = Some(Occlusion { shape, grey: 90.0, seed: 5 });
        let under = Conditions { occlusion, ..Conditions::default() };
        let (here, other) = (tilted(), scene(board(7, 6), tilted().camera_from_target));
        let optics = Optics { noise: 0.0, ..Optics::default() };
        let plain = here.picture(&optics, 1);
        let (a, b) =
            (here.picture_under(&under, &optics, 1), other.picture_under(&under, &optics, 1));
        let mut hidden = 0.0;
        let all = here.corners_under(&under, &optics);
        for c in &all {
            let (x, y) = (c.pixel.x.round() as usize, c.pixel.y.round() as usize);
            match c.visible {
                Some(true) => assert_eq!(a.at(x, y), plain.at(x, y)),
                Some(false) => assert_eq!(a.at(x, y), covered(&here, &other, &b, &under, x, y)),
                None => hidden += 0.5,
            }
            hidden += f64::from(u8::from(c.visible == Some(false)));
        }
        let wanted = if matches!(shape, Shape::Side { .. }) { 0.5 } else { 0.2 };
        assert!((hidden / all.len() as f64 - wanted).abs() < 0.12, "{shape:?}: {hidden}");
    }
}

/// What is seen at a hidden pixel of one board: the same before another board, if hidden there.
fn covered(
    here: &Scene,
    other: &Scene,
    before_other: &GrayImage,
    under: &Conditions,
    x: usize,
    y: usize,
) -> f32 {
    let at = Vector2::new(x as f64, y as f64);
    let shape = under.occlusion.unwrap().shape;
    let depth = |scene: &Scene| conditions::Cover::new(scene, &shape).depth(&at);
    if depth(other) > 8.0 {
        before_other.at(x, y)
    } else {
        here.picture_under(under, &Optics { noise: 0.0, ..Optics::default() }, 1).at(x, y)
    }
}

/// Root mean square distance (px) of the corners that are found from those that should be.
fn misses(picture: &GrayImage, scene: &Scene, under: &Conditions) -> f64 {
    let truth = scene.corners_under(under, &Optics::default());
    let found = detect(picture, &scene.target).unwrap();
    assert_eq!(found.len(), truth.len());
    let all = found.iter().zip(&truth).map(|(f, t)| (f.pixel - t.pixel).norm_squared());
    (all.sum::<f64>() / truth.len() as f64).sqrt()
}

#[test]
fn corners_are_where_the_print_has_them() {
    let prints = [
        PrintErrors { corner_mm: 0.3, seed: 4, ..PrintErrors::default() },
        PrintErrors { scale: [0.02, -0.03], ..PrintErrors::default() },
        PrintErrors { bend_mm: 8.0, ..PrintErrors::default() },
        PrintErrors { corner_mm: 0.2, scale: [0.01, 0.02], bend_mm: -5.0, seed: 9 },
    ];
    for print in prints {
        let (scene, under) = (tilted(), Conditions { print, ..Conditions::default() });
        let picture = scene.picture_under(&under, &Optics::default(), 2);
        let (right, faultless) =
            (misses(&picture, &scene, &under), misses(&picture, &scene, &Conditions::default()));
        assert!(right < 0.2 * faultless, "{print:?}: {right} px, {faultless} px");
    }
}

#[test]
fn two_boards_are_both_where_they_should_be() {
    let (one, two) = (scene(board(6, 5), facing([40.0, 40.0], 28.0)), board(4, 3));
    let beside = facing([260.0, 120.0], 30.0);
    let under = Conditions { others: vec![(two.clone(), beside)], ..Conditions::default() };
    let picture = one.picture_under(&under, &Optics::default(), 1);
    let two = scene(two, beside);
    let alone = Conditions::default();
    let sees = |scene: &Scene| {
        let near = |p: &Vector2<f64>, other: &GrayImage| {
            let (x, y) = (p.x.round() as usize, p.y.round() as usize);
            (x - 5..x + 5).all(|x| (y - 5..y + 5).all(|y| picture.at(x, y) == other.at(x, y)))
        };
        let other = scene.picture_under(&alone, &Optics::default(), 1);
        scene.corners().iter().all(|c| near(&c.1, &other))
    };
    assert!(sees(&one) && sees(&two));
}

#[test]
fn clutter_is_behind_the_board_and_follows_from_its_seed() {
    for pattern in Pattern::ALL {
        let clutter = |seed| Clutter { pattern, seed };
        let alone = |seed| clutter(seed).picture(SIZE, &sharp(), 1);
        assert_eq!(alone(1), alone(1));
        assert_ne!(alone(1), alone(2));
        assert!(mean_and_variance(alone(1).values()).1 > 100.0, "{pattern:?}");
        let under = Conditions { clutter: Some(clutter(1)), ..Conditions::default() };
        let scene = tilted();
        let (plain, picture) =
            (scene.picture(&sharp(), 1), scene.picture_under(&under, &sharp(), 1));
        assert_eq!(picture.at(2, 2), alone(1).at(2, 2));
        let same = |p: &Vector2<f64>| {
            let (x, y) = (p.x.round() as usize, p.y.round() as usize);
            picture.at(x, y) == plain.at(x, y)
        };
        assert!(scene.corners().iter().all(|c| same(&c.1)), "{pattern:?}");
    }
}

#[test]
fn a_board_outside_of_the_picture_leaves_the_background() {
    let picture = scene(board(3, 3), facing([3000.0, 50.0], 20.0)).picture(&sharp(), 1);
    assert!(picture.values().iter().all(|v| *v == 120.0));
}

#[test]
fn the_tip_touches_the_board_that_the_scans_show() {
    let noise = CellNoise {
        robot_repeatability_m: 0.0,
        robot_absolute_m: 0.0,
        robot_absolute_rad: 0.0,
        corner_px: 0.0,
        touch_m: 0.0,
        ..CellNoise::default()
    };
    let sensor = DepthSensor { sigma_at_1m: 0.0, ..DepthSensor::default() };
    for (bow_mm, print_scale) in [(0.0, [0.0; 2]), (3.0, [0.0; 2]), (0.0, [0.01, -0.02])] {
        let usual = Cell::new(Setup::EyeInHand, 5);
        let cell = Cell { noise, depth: Some(sensor), bow_mm, print_scale, ..usual };
        let (session, truth) = cell.session(5).unwrap();
        let view = &session.observations[0];
        let base_from_camera =
            view.base_from_flange * truth.hand_eye.mount_from_camera.rename::<Flange, Camera>();
        for touch in &session.touches {
            let seen = view.surface.iter().find(|c| c.id == touch.corner).unwrap();
            let seen = base_from_camera * seen.in_camera;
            let off = (seen.vector() - touch.in_base.vector()).norm();
            assert!(off < 2e-5, "{bow_mm} {print_scale:?} {} {off}", touch.corner);
        }
    }
}
