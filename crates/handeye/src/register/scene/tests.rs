use nalgebra::{Matrix6, Vector3, Vector6};

use super::*;
use crate::{
    Base, Config, Flange, Intrinsics, Observation, Session, Setup, calibrate,
    math::{lie, random::Random},
    simulate::Room,
};

const PI: f64 = std::f64::consts::PI;

struct Cell {
    surfaces: Vec<Surface>,
    base_from_flange: Vec<Isometry3<f64>>,
    flange_from_camera: Isometry3<f64>,
}

/// Scans of a cell by a camera on a robot whose poses err by so many metres and radians.
fn cell(count: usize, seed: u64, robot: (f64, f64)) -> Cell {
    turned_cell(count, seed, robot, [0.3, 0.3, 0.6])
}

/// The camera is tilted and turned by angles up to these.
fn turned_cell(count: usize, seed: u64, robot: (f64, f64), turns: [f64; 3]) -> Cell {
    let mut random = Random::new(seed);
    let room = Room::of_a_cell(&mut random);
    let flange_from_camera = Isometry3::new([0.05, -0.03, 0.08].into(), [0.02, -0.03, 1.5].into());
    let camera = Intrinsics::pinhole(240, 180, 240.0, 240.0, 119.5, 89.5);
    let (mut surfaces, mut base_from_flange) = (vec![], vec![]);
    for _ in 0..count {
        let mut some = |s: f64| random.between(-s, s);
        let down = Isometry3::new(
            [some(0.12), some(0.12), 0.75 + some(0.1)].into(),
            [PI, 0.0, 0.0].into(),
        );
        let turn = Isometry3::new(Vector3::zeros(), turns.map(&mut some).into());
        let base_from_camera = down * turn;
        let scan = room.scan(&base_from_camera, &camera, 5e-4, &mut random);
        surfaces.push(Surface::of(&scan, 1).unwrap());
        let (w, v) = (random.normal3() * robot.1, random.normal3() * robot.0);
        let error = lie::exp(&Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z));
        base_from_flange.push(base_from_camera * flange_from_camera.inverse() * error);
    }
    Cell { surfaces, base_from_flange, flange_from_camera }
}

fn placed(cell: &Cell, guess: Option<&Isometry3<f64>>) -> Placed {
    place(&cell.surfaces, &cell.base_from_flange, guess, &DenseConfig::default(), &|_, _| ())
}

#[test]
fn scans_are_placed_as_surely_as_they_say() {
    let mut squares = vec![];
    for seed in 0..3 {
        let cell = cell(8, 50 + seed, (0.0, 0.0));
        let placed = placed(&cell, None);
        let camera = |k: usize| cell.base_from_flange[k] * cell.flange_from_camera;
        let all: Vec<_> =
            placed.poses.iter().enumerate().filter_map(|(k, p)| Some((k, (*p)?))).collect();
        assert!(all.len() >= 7, "{} of 8", all.len());
        // about the scene as a whole nothing is said: errors among each other
        let scene = |(k, p): &(usize, TargetPose)| camera(*k) * p.camera_from_target.iso();
        let first = scene(&all[0]);
        let errors: Vec<Vector6<f64>> =
            all.iter().map(|one| lie::log(&(first.inverse() * scene(one)))).collect();
        let mean: Vector6<f64> = errors.iter().sum::<Vector6<f64>>() / errors.len() as f64;
        for (error, (_, pose)) in errors.iter().zip(&all) {
            let off = error - mean;
            let covariance: Matrix6<f64> = pose.covariance.unwrap();
            squares.push(off.dot(&(covariance.try_inverse().unwrap() * off)) / 6.0);
            assert!(lie::omega(&off).norm() < 2e-3 && lie::nu(&off).norm() < 2e-3, "{off}");
        }
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    println!("normalised error squared {mean:.2}");
    assert!((0.5..2.5).contains(&mean), "{mean}");
}

fn calibrated(cell: &Cell) -> crate::Calibration {
    let placed = placed(cell, None);
    let observe = |(k, pose): (usize, &Option<TargetPose>)| {
        let robot = Pose::<Base, Flange>::claim(cell.base_from_flange[k]);
        let bare = Observation::bare(format!("{k}"), robot, Pose::identity());
        Observation { candidates: pose.iter().copied().collect(), ..bare }
    };
    let observations = placed.poses.iter().enumerate().map(observe).collect();
    let session = Session::of_captures(Setup::EyeInHand, observations);
    calibrate(&session, &Config::default()).unwrap()
}

#[test]
fn a_camera_is_calibrated_without_a_target() {
    let cell = cell(14, 61, (1e-4, 1e-4));
    let found = calibrated(&cell);
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    let x = found.hand_eye.mount_from_camera.unwrap();
    let off = lie::log(&cell.flange_from_camera.inv_mul(x.iso()));
    let (deg, mm) = (lie::omega(&off).norm().to_degrees(), 1e3 * lie::nu(&off).norm());
    println!("{deg:.3} deg, {mm:.2} mm");
    assert!(deg < 0.05 && mm < 0.6, "{deg} deg, {mm} mm");
}

#[test]
fn turns_about_one_axis_leave_the_camera_undetermined() {
    let found = calibrated(&turned_cell(10, 62, (1e-4, 1e-4), [0.0, 0.0, 0.6]));
    assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
    assert!(!found.undetermined.is_empty());
}

#[test]
fn a_guess_saves_the_search() {
    let cell = cell(6, 52, (1e-4, 1e-4));
    let off = lie::exp(&Vector6::new(0.01, -0.02, 0.01, 0.004, 0.005, -0.003));
    let guess = cell.flange_from_camera * off;
    let pairs = std::cell::Cell::new(0);
    let counted = |guess: Option<&Isometry3<f64>>| {
        pairs.set(0);
        let config = DenseConfig::default();
        let count = |_, _| pairs.set(pairs.get() + 1);
        (place(&cell.surfaces, &cell.base_from_flange, guess, &config, &count), pairs.get())
    };
    let (found, looked_at) = counted(Some(&guess));
    let (without, looked_at_without) = counted(None);
    assert!(found.poses.iter().flatten().count() >= 5);
    assert!(looked_at < looked_at_without, "{looked_at} {looked_at_without}");
    for (k, pose) in found.poses.iter().enumerate() {
        let Some(pose) = pose else { continue };
        let Some(other) = &without.poses[k] else { continue };
        let first = |placed: &Placed| placed.poses[0].unwrap().camera_from_target;
        let one = pose.camera_from_target * first(&found).inverse();
        let two = other.camera_from_target * first(&without).inverse();
        let off = lie::log(&one.iso().inv_mul(two.iso()));
        assert!(lie::omega(&off).norm() < 2e-3 && lie::nu(&off).norm() < 2e-3, "{off}");
    }
}

#[test]
fn nothing_is_placed_in_a_scene_that_slides() {
    let mut cell = cell(4, 53, (0.0, 0.0));
    let mut random = Random::new(1);
    let camera = Intrinsics::pinhole(160, 120, 160.0, 160.0, 79.5, 59.5);
    let solid = crate::simulate::Solid::Block { half: [2.0, 2.0, 0.01] };
    let room = Room {
        things: vec![crate::simulate::Thing { solid, room_from_thing: Isometry3::identity() }],
    };
    for (surface, base_from_flange) in cell.surfaces.iter_mut().zip(&cell.base_from_flange) {
        let scan =
            room.scan(&(base_from_flange * cell.flange_from_camera), &camera, 5e-4, &mut random);
        *surface = Surface::of(&scan, 1).unwrap();
    }
    let found = placed(&cell, Some(&cell.flange_from_camera));
    assert!(found.poses.iter().all(Option::is_none));
    let why = |link: &Link| link.left_out.clone().unwrap();
    assert!(
        found.links.iter().all(|link| why(link).contains("does not constrain")),
        "{:?}",
        found.links[0]
    );
}

#[test]
fn an_object_of_known_shape_is_a_target() {
    let mut random = Random::new(71);
    let camera = Intrinsics::pinhole(240, 180, 300.0, 300.0, 119.5, 89.5);
    // a part: blocks that lean, and a ball, on a table
    let thing = |solid, at: [f64; 3], turn: [f64; 3]| crate::simulate::Thing {
        solid,
        room_from_thing: Isometry3::new(at.into(), turn.into()),
    };
    let block = |half| crate::simulate::Solid::Block { half };
    let part = vec![
        thing(block([0.08, 0.05, 0.02]), [0.0, 0.0, 0.02], [0.0; 3]),
        thing(block([0.03, 0.03, 0.03]), [0.04, 0.01, 0.04], [0.6, 0.5, 0.4]),
        thing(block([0.03, 0.02, 0.03]), [-0.04, -0.02, 0.04], [-0.7, 0.4, 0.0]),
        thing(crate::simulate::Solid::Ball { radius: 0.025 }, [-0.04, 0.03, 0.05], [0.0; 3]),
    ];
    let table = thing(block([0.5, 0.4, 0.01]), [0.0, 0.0, -0.01], [0.0; 3]);
    let room = Room { things: [part.clone(), vec![table]].concat() };
    let alone = Room { things: part };
    let down = Isometry3::new([0.0, 0.0, 0.5].into(), [PI, 0.0, 0.0].into());
    let model = |turn: f64, random: &mut Random| {
        let at = Isometry3::rotation([turn, 0.0, 0.0].into()) * down;
        let scan = alone.scan(&at, &camera, 2e-5, random);
        let points = scan.points().iter().filter(|p| p[2].is_finite());
        points.map(|p| at.transform_point(&p.map(f64::from).into()).coords).collect::<Vec<_>>()
    };
    let points: Vec<[f32; 3]> =
        [model(0.0, &mut random), model(0.7, &mut random), model(-0.7, &mut random)]
            .concat()
            .into_iter()
            .map(|p| p.map(|x| x as f32).into())
            .collect();
    let object = Surface::of(&crate::Scan::new(points.len(), 1, points).unwrap(), 1).unwrap();
    let (mut surfaces, mut mounts, mut truths) = (vec![], vec![], vec![]);
    let flange_from_camera = Isometry3::new([0.05, -0.03, 0.08].into(), [0.02, -0.03, 1.5].into());
    for _ in 0..6 {
        let mut some = |s: f64| random.between(-s, s);
        let turn = Isometry3::new(Vector3::zeros(), [some(0.3), some(0.3), some(1.5)].into());
        let room_from_camera =
            Isometry3::translation(some(0.05), some(0.05), 0.05 + some(0.05)) * down * turn;
        surfaces.push(
            Surface::of(&room.scan(&room_from_camera, &camera, 3e-4, &mut random), 1).unwrap(),
        );
        mounts.push(room_from_camera * flange_from_camera.inverse());
        truths.push(room_from_camera.inverse());
    }
    let found = place_object(&object, &surfaces, &mounts, &DenseConfig::default(), &|_, _| ());
    let mut right = 0;
    for (pose, truth) in found.poses.iter().zip(&truths) {
        let Some(pose) = pose else { continue };
        let off = lie::log(&truth.inv_mul(pose.camera_from_target.iso()));
        let (deg, mm) = (lie::omega(&off).norm().to_degrees(), 1e3 * lie::nu(&off).norm());
        let inverse = pose.covariance.unwrap().try_inverse().unwrap();
        let square = off.dot(&(inverse * off)) / 6.0;
        assert!(deg < 1.5 && mm < 2.0 && square < 6.0, "{deg} deg, {mm} mm, {square}");
        right += 1;
    }
    let why: Vec<_> = found.links.iter().map(|link| &link.left_out).collect();
    assert!(right >= 4, "{right}: {why:?}");
}
