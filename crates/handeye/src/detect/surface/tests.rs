//! Corners on rendered scans against where they are.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::step::pool;
use super::*;
use crate::{
    Point, Pose, TargetModel,
    math::random::Random,
    simulate::{Conditions, DepthSensor, Optics, PrintErrors, Scene},
};
use nalgebra::Vector6;

fn scene() -> Scene {
    let turn = Vector6::new(0.3, -0.4, 0.2, 0.0, 0.0, 0.0);
    Scene {
        target: TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 },
        camera_from_target: Pose::from_parts(&Matrix3::identity(), Vector3::new(-0.08, -0.05, 0.6))
            .retract(&turn),
        intrinsics: Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5),
    }
}

fn seen(scene: &Scene, sigma: f64, random: &mut Random) -> Vec<ImageCorner> {
    let covariance = Matrix2::identity() * sigma * sigma;
    let mut one = |(id, pixel): (u32, Vector2<f64>)| {
        let noise = Vector2::new(random.normal(), random.normal()) * sigma;
        ImageCorner { id, pixel: pixel + noise, covariance }
    };
    scene.corners().into_iter().map(&mut one).collect()
}

fn truth(scene: &Scene, id: u32) -> Vector3<f64> {
    (scene.camera_from_target * scene.target.corner(id).unwrap()).vector()
}

fn exact() -> DepthSensor {
    DepthSensor { sigma_at_1m: 0.0, ..DepthSensor::default() }
}

#[test]
fn an_exact_plane_gives_exact_points() {
    let scene = scene();
    let corners = seen(&scene, 0.0, &mut Random::new(1));
    let (found, missing) = lift(&corners, (640, 480), &scene.scan(&exact(), 1), None);
    assert_eq!((found.len(), missing.len()), (54, 0));
    for corner in found {
        assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-7);
    }
}

#[test]
fn a_scan_without_grid_gives_the_same_points() {
    let scene = scene();
    let corners = seen(&scene, 0.0, &mut Random::new(1));
    let grid = scene.scan(&exact(), 1);
    let cloud = Scan::new(grid.points().len(), 1, grid.points().to_vec()).unwrap();
    let (found, _) = lift(&corners, (640, 480), &cloud, Some(&scene.intrinsics));
    assert_eq!(found.len(), 54);
    for corner in found {
        assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-7);
    }
    let (found, missing) = lift(&corners, (640, 480), &cloud, None);
    assert!(found.is_empty() && missing.iter().all(|m| m.reason == Reason::NoGrid));
}

#[test]
fn a_picture_of_twice_the_scans_size_gives_the_same_points() {
    let scene = scene();
    let large = Scene { intrinsics: scene.intrinsics.resized(2.0), ..scene.clone() };
    let corners = seen(&large, 0.0, &mut Random::new(1));
    let (found, _) = lift(&corners, (1280, 960), &scene.scan(&exact(), 1), None);
    assert_eq!(found.len(), 54);
    for corner in found {
        assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-7);
    }
}

#[test]
fn errors_stay_inside_the_covariance() {
    let scene = scene();
    let mut random = Random::new(2);
    let sensor = DepthSensor { sigma_at_1m: 2e-3, ..DepthSensor::default() };
    let (mut sum, mut count) = (0.0, 0.0);
    for seed in 0..12 {
        let corners = seen(&scene, 0.05, &mut random);
        let (found, _) = lift(&corners, (640, 480), &scene.scan(&sensor, seed), None);
        for corner in found {
            let e = corner.in_camera.vector() - truth(&scene, corner.id);
            sum += e.dot(&(corner.covariance.try_inverse().unwrap() * e)) / 3.0;
            count += 1.0;
        }
    }
    let ratio = sum / count;
    assert!((0.85..1.15).contains(&ratio), "{ratio} of {count}");
}

fn with_points(scan: &Scan, change: impl Fn(usize, usize, [f32; 3]) -> [f32; 3]) -> Scan {
    let (w, h) = (scan.width(), scan.height());
    let all = scan.points().iter().enumerate().map(|(k, p)| change(k % w, k / w, *p));
    Scan::new(w, h, all.collect()).unwrap()
}

#[test]
fn holes_and_depth_edges_are_named() {
    let scene = scene();
    let corners = seen(&scene, 0.0, &mut Random::new(3));
    let (hole, edge) = (corners[12].pixel, corners[40].pixel);
    let near =
        |c: Vector2<f64>, x: usize, y: usize| (Vector2::new(x as f64, y as f64) - c).norm() < 9.0;
    let scan = with_points(&scene.scan(&exact(), 3), |x, y, p| {
        let step = if near(edge, x, y) && (x as f64) < edge.x { 0.9 } else { 1.0 };
        if near(hole, x, y) { [f32::NAN; 3] } else { p.map(|v| v * step) }
    });
    let (found, missing) = lift(&corners, (640, 480), &scan, None);
    assert_eq!(found.len() + missing.len(), 54);
    let reason = |id| missing.iter().find(|m| m.id == id).map(|m| m.reason);
    assert!(matches!(reason(12), Some(Reason::Hole { .. })), "{missing:?}");
    assert!(matches!(reason(40), Some(Reason::Edge(_) | Reason::OneSided)), "{missing:?}");
}

#[test]
fn flying_points_do_not_pull() {
    let scene = scene();
    let corners = seen(&scene, 0.0, &mut Random::new(4));
    let scan = with_points(&scene.scan(&exact(), 4), |x, y, p| {
        if (x * 7 + y * 13) % 5 == 0 { p.map(|v| v * 1.1) } else { p }
    });
    let (found, _) = lift(&corners, (640, 480), &scan, None);
    assert_eq!(found.len(), 54);
    for corner in found {
        assert!((corner.in_camera.vector() - truth(&scene, corner.id)).norm() < 1e-6);
    }
}

#[test]
fn a_corner_outside_of_the_scan_is_named() {
    let scene = scene();
    let mut corners = seen(&scene, 0.0, &mut Random::new(5));
    corners[0].pixel = Vector2::new(-40.0, 10.0);
    let (_, missing) = lift(&corners, (640, 480), &scene.scan(&exact(), 5), None);
    assert_eq!(missing[0], Missing { id: 0, reason: Reason::Outside });
}

fn stepped(step_mm: f64) -> DepthSensor {
    DepthSensor { sigma_at_1m: 1e-3, black_step_m: 1e-3 * step_mm, ..DepthSensor::default() }
}

/// Error of the corners: root mean square (m) and normalised square, over some captures, and the
/// pooled step.
fn errors(sensor: &DepthSensor, settled: bool) -> (f64, f64, Option<PooledStep>) {
    let scene = scene();
    let mut random = Random::new(7);
    let mut lifted = vec![];
    for seed in 0..8 {
        let corners = seen(&scene, 0.05, &mut random);
        let scan = scene.scan(sensor, seed);
        lifted.push(lift_coloured(&corners, (640, 480), &scan, None, &scene.target));
    }
    let (pooled, all) = settle(&lifted);
    let plain = lifted.iter().map(|l| &l.found);
    let corners: Vec<SurfaceCorner> = if settled {
        all.into_iter().flat_map(|a| a.0).collect()
    } else {
        plain.flatten().copied().collect()
    };
    assert!(corners.len() > 8 * 50, "{}", corners.len());
    let (mut square, mut normalised) = (0.0, 0.0);
    for c in &corners {
        let e = c.in_camera.vector() - truth(&scene, c.id);
        square += e.norm_squared();
        normalised += e.dot(&(c.covariance.try_inverse().unwrap() * e)) / 3.0;
    }
    let n = corners.len() as f64;
    ((square / n).sqrt(), normalised / n, pooled)
}

#[test]
fn a_step_between_the_colours_is_found_and_taken_off() {
    for step_mm in [0.4, -0.8, 3.0] {
        let (before, _, _) = errors(&stepped(step_mm), step_mm > 2.0);
        let (after, nees, pooled) = errors(&stepped(step_mm), true);
        let pooled = pooled.unwrap();
        let off = pooled.value_m - 1e-3 * step_mm;
        assert!(pooled.is_significant() && off.abs() < 3.5 * pooled.sigma_m, "{pooled:?}");
        assert!(pooled.sigma_m < 0.02e-3, "{pooled:?}");
        assert!(after < 0.1e-3, "{step_mm}: {after}");
        assert!(step_mm > 2.0 || before > 1.8 * after, "{step_mm}: {before} {after}");
        assert!((0.85..1.15).contains(&nees), "{step_mm}: {nees}");
    }
}

#[test]
fn without_a_step_nothing_changes() {
    let (plain, settled) = (errors(&stepped(0.0), false), errors(&stepped(0.0), true));
    assert!(!plain.2.unwrap().is_significant());
    assert_eq!((plain.0, plain.1), (settled.0, settled.1));
    assert!((0.85..1.15).contains(&plain.1), "{}", plain.1);
}

#[test]
fn a_twisted_and_bent_board_shows_no_step() {
    let scene = scene();
    let bent = Conditions {
        print: PrintErrors { bend_mm: 3.0, ..PrintErrors::default() },
        ..Conditions::default()
    };
    let corners: Vec<ImageCorner> = scene
        .corners_under(&bent, &Optics::default())
        .into_iter()
        .map(|c| ImageCorner { id: c.id, pixel: c.pixel, covariance: Matrix2::identity() * 1e-4 })
        .collect();
    let scan = scene.scan_under(&bent, &stepped(0.0), 1);
    let lifted = lift_coloured(&corners, (640, 480), &scan, None, &scene.target);
    let step = lifted.coloured.unwrap().step;
    assert!(step.value_m.abs() < 4.0 * step.sigma_m, "{step:?}");
}

#[test]
fn a_step_that_varies_is_taken_off_capture_by_capture() {
    let steps: Vec<Step> = [0.2, 0.9, 0.4, 0.7, 0.5]
        .map(|mm| Step { value_m: 1e-3 * mm, sigma_m: 1e-5, corners: 50 })
        .into();
    let pooled = pool(&steps).unwrap();
    assert!((0.2e-3..0.35e-3).contains(&pooled.spread_m), "{pooled:?}");
    assert!((0.09e-3..0.16e-3).contains(&pooled.sigma_m), "{pooled:?}");
    let scan = |s: &Step| {
        let corner = SurfaceCorner {
            id: 0,
            in_camera: Point::new(0.0, 0.0, 1.0),
            covariance: Matrix3::identity() * 1e-10,
        };
        let corners = vec![ColouredCorner { corner, depth_by_step: -0.5 }];
        let coloured = Coloured { corners, missing: vec![], step: *s };
        Lifted { coloured: Some(coloured), ..Lifted::default() }
    };
    let (pooled, settled) = settle(&steps.iter().map(scan).collect::<Vec<_>>());
    assert!(pooled.unwrap().is_significant());
    for (corners, _) in settled {
        let z = corners[0].in_camera.vector().z;
        assert!((z - 1.0).abs() < 1e-6, "each capture tells its own step well: {z}");
    }
}
