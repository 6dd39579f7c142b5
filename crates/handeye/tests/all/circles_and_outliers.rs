//! Grids of circles with other circles beside them.

use std::collections::BTreeMap;

use handeye::{
    GrayImage, ImageCorner, Intrinsics, Point, Pose, Target, TargetModel,
    detect::{self, NotFound},
    simulate::{Optics, Scene},
};
use nalgebra::{Matrix3, Vector2, Vector3, Vector6};

fn symmetric(columns: u32, rows: u32) -> TargetModel {
    TargetModel::CircleGrid { columns, rows, pitch_mm: 20.0 }
}

/// The middle of the board 18 pitches away, tilted about an axis in its plane, and turned a little.
fn scene(target: &TargetModel, tilt: f64) -> Scene {
    let corners = target.corners();
    let sum = corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>();
    let centre = sum / corners.len() as f64;
    let away = Vector3::new(0.0, 0.0, 18.0 * target.pitch_m());
    let turn = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0);
    let axis: f64 = 0.8;
    let camera_from_target = Pose::from_parts(&Matrix3::identity(), away)
        .retract(&turn(tilt * axis.cos(), tilt * axis.sin(), 0.0))
        .retract(&turn(0.0, 0.0, 0.3))
        .retract(&Vector6::new(0.0, 0.0, 0.0, -centre.x, -centre.y, 0.0));
    let intrinsics = Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5);
    Scene { target: target.clone(), camera_from_target, intrinsics }
}

/// Root mean square distance to the truth, px, in the best of the board's symmetries.
fn rms(scene: &Scene, found: &[ImageCorner]) -> f64 {
    let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
    let under = |map: &Vec<u32>| {
        let off = found.iter().map(|c| (c.pixel - truth[&map[c.id as usize]]).norm_squared());
        (off.sum::<f64>() / found.len() as f64).sqrt()
    };
    scene.target.symmetries().iter().map(under).fold(f64::INFINITY, f64::min)
}

/// Circles that are not the board's, as large as its own: `outliers` in pitches on the board's plane, px more aside.
fn with_outliers(scene: &Scene, outliers: &[(f64, f64, f64)]) -> GrayImage {
    let picture = scene.picture(&Optics::default(), 5);
    let (width, height) = (picture.width(), picture.height());
    let pitch = scene.target.pitch_m();
    let at = |x: f64, y: f64| {
        let on_board = Point::<Target>::new(x * pitch, y * pitch, 0.0);
        scene.intrinsics.project(&(scene.camera_from_target * on_board).vector()).unwrap()
    };
    let circles: Vec<(Vector2<f64>, f64)> = outliers
        .iter()
        .map(|&(x, y, aside)| {
            let centre = at(x, y) + Vector2::repeat(aside);
            (centre, 0.25 * (at(x + 0.5, y) - at(x - 0.5, y)).norm())
        })
        .collect();
    let dark = |x: usize, y: usize| {
        let p = Vector2::new(x as f64, y as f64);
        // paper around, so that each is a circle on white as those of the board are
        let of = |(c, r): &(Vector2<f64>, f64)| ((c - p).norm(), *r);
        circles
            .iter()
            .map(of)
            .filter(|(d, r)| *d < 1.6 * r)
            .map(|(d, r)| (r + 0.5 - d).clamp(0.0, 1.0))
            .next()
    };
    let pixels = (0..width * height)
        .map(|k| match dark(k % width, k / width) {
            Some(cover) => (200.0 - 160.0 * cover) as f32,
            None => picture.at(k % width, k / width),
        })
        .collect();
    GrayImage::new(width, height, pixels).unwrap()
}

/// A larger board is not the declared one with outliers beside it.
#[test]
fn outliers_beside_a_grid_do_not_hide_it() {
    let on_the_lattice = [(-1.0, 0.0, 0.0), (7.0, 2.0, 0.0), (3.0, 5.0, 0.0)];
    let beside = [(-1.2, 1.3, 2.0), (7.3, 3.4, -3.0), (2.4, 5.2, 1.0)];
    for outliers in [on_the_lattice, beside] {
        for tilt in [0.0, 0.4] {
            let scene = scene(&symmetric(7, 5), tilt);
            let found = detect::detect(&with_outliers(&scene, &outliers), &scene.target);
            let found = found.unwrap_or_else(|e| panic!("{outliers:?}, {tilt}: {e}"));
            let rms = rms(&scene, &found);
            assert!(rms < 0.05, "{outliers:?}, {tilt}: {rms}");
        }
    }
    for (columns, rows) in [(8, 5), (7, 6)] {
        let larger = scene(&symmetric(columns, rows), 0.2);
        let found = detect::detect(&larger.picture(&Optics::default(), 1), &symmetric(7, 5));
        assert!(matches!(found, Err(NotFound::OtherSize { .. })), "{found:?}");
    }
}
