use nalgebra::Vector3;

use super::*;
use crate::{
    Intrinsics,
    math::{lie, linalg, random::Random},
    register::DenseMethod,
    simulate::{Room, Solid, Thing},
};

const PI: f64 = std::f64::consts::PI;

fn above(x: f64, y: f64, turn: [f64; 3]) -> Isometry3<f64> {
    let down = Isometry3::new([x, y, 0.8].into(), [PI, 0.0, 0.0].into());
    down * Isometry3::new(Vector3::zeros(), turn.into())
}

/// Two scans of a cell from different sides, with 0.5 mm of noise, and the truth.
fn scans_of(
    width: u32,
    seed: u64,
    lens: impl Fn(Intrinsics) -> Intrinsics,
) -> (Scan, Scan, Isometry3<f64>) {
    let mut random = Random::new(seed);
    let room = Room::of_a_cell(&mut random);
    let (one, other) =
        (above(0.05, -0.1, [0.12, 0.05, 0.1]), above(-0.1, 0.15, [-0.15, -0.1, -0.1]));
    let lens = lens(camera(width));
    let source = room.scan(&one, &lens, 5e-4, &mut random);
    let target = room.scan(&other, &lens, 5e-4, &mut random);
    (source, target, other.inv_mul(&one))
}

fn camera(width: u32) -> Intrinsics {
    let (height, f) = (width * 3 / 4, f64::from(width));
    Intrinsics::pinhole(width, height, f, f, 0.5 * f - 0.5, 0.375 * f - 0.5)
}

fn scans(seed: u64, lens: impl Fn(Intrinsics) -> Intrinsics) -> (Scan, Scan, Isometry3<f64>) {
    scans_of(240, seed, lens)
}

fn off(truth: &Isometry3<f64>, random: &mut Random) -> Isometry3<f64> {
    let turn = random.normal3().normalize() * 1f64.to_radians();
    truth * Isometry3::new(random.normal3().normalize() * 5e-3, turn)
}

/// Degrees, and mm at the middle of the table.
fn errors(truth: &Isometry3<f64>, found: &Isometry3<f64>) -> (f64, f64) {
    let middle = Vector3::new(0.0, 0.0, 0.8).into();
    let apart = (truth.transform_point(&middle) - found.transform_point(&middle)).norm();
    (lie::angle(&truth.rotation, &found.rotation).to_degrees(), 1e3 * apart)
}

/// Six cells, each registered from a start that is off a little; all are right, and their medians better.
fn six_cells(width: u32, registered: impl Fn(&Scan, &Scan, &Isometry3<f64>) -> Dense) {
    let (mut turned, mut shifted) = (vec![], vec![]);
    for seed in 0..6 {
        let (source, target, truth) = scans_of(width, seed, |k| k);
        let start = off(&truth, &mut Random::new(100 + seed));
        let found = registered(&source, &target, &start);
        assert_eq!((found.stop, found.verdict), (Stop::Converged, Verdict::Accepted));
        assert!(found.inlier_fraction > 0.4, "{}", found.inlier_fraction);
        let (turn, shift) = errors(&truth, &found.target_from_source);
        assert!(turn < 0.1 && shift < 0.4, "{seed}: {turn} deg, {shift} mm");
        turned.push(turn);
        shifted.push(shift);
    }
    let (turn, shift) = (linalg::median(turned), linalg::median(shifted));
    println!("{turn:.4} deg, {shift:.3} mm");
    assert!(turn < 0.04 && shift < 0.15, "{turn} deg, {shift} mm");
}

#[test]
fn two_scans_of_a_cell_are_brought_together() {
    six_cells(240, |source, target, start| {
        register(source, target, start, &DenseConfig::default()).unwrap()
    });
}

#[test]
fn a_lens_that_distorts_does_not_matter() {
    let barrel = |k: Intrinsics| Intrinsics {
        distortion: crate::Distortion::BrownConrady([
            -0.2, 0.05, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        ]),
        ..k
    };
    let (source, target, truth) = scans(1, barrel);
    let start = off(&truth, &mut Random::new(5));
    let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
    let (turn, shift) = errors(&truth, &found.target_from_source);
    assert!(turn < 0.05 && shift < 0.2, "{turn} deg, {shift} mm");
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let (source, target, truth) = scans(2, |k| k);
    let start = off(&truth, &mut Random::new(6));
    let with = |threads| {
        register(&source, &target, &start, &DenseConfig { threads, ..DenseConfig::default() })
            .unwrap()
    };
    assert_eq!(with(1), with(2));
    assert_eq!(with(1), with(7));
}

#[test]
fn moving_the_target_moves_only_the_answer() {
    let (source, target, truth) = scans(3, |k| k);
    let start = off(&truth, &mut Random::new(7));
    let plain = register(&source, &target, &start, &DenseConfig::default()).unwrap();
    let turn = Isometry3::new(Vector3::zeros(), [0.0, 0.0, PI / 2.0].into());
    // a quarter turn of the image: rows become columns
    let (width, height) = (target.width(), target.height());
    let point = |k: usize| {
        let (x, y) = (k % height, k / height);
        let [px, py, pz] = target.points()[(height - 1 - x) * width + y];
        [-py, px, pz]
    };
    let turned = Scan::new(height, width, (0..width * height).map(point).collect()).unwrap();
    let found = register(&source, &turned, &(turn * start), &DenseConfig::default()).unwrap();
    let (degrees, mm) = errors(&(turn * plain.target_from_source), &found.target_from_source);
    // the blocks are others
    assert!(degrees < 0.02 && mm < 0.1, "{degrees} deg, {mm} mm");
}

#[test]
fn scans_of_different_things_are_refused() {
    let (source, target, truth) = scans(4, |k| k);
    let away = Isometry3::translation(0.0, 0.0, 1.0) * truth;
    let found = register(&source, &target, &away, &DenseConfig::default()).unwrap();
    assert_eq!((found.verdict, found.stop), (Verdict::Rejected, Stop::NoMatches));
    assert_eq!(found.target_from_source, away);
    let nothing = Scan::new(4, 1, vec![[f32::NAN; 3]; 4]).unwrap();
    let error = register(&nothing, &target, &truth, &DenseConfig::default()).unwrap_err();
    assert!(error.to_string().contains("source scan"), "{error}");
}

/// The points that were seen, in any order.
fn shuffled(scan: &Scan, seed: u64) -> Scan {
    let mut random = Random::new(seed);
    let mut points: Vec<[f32; 3]> =
        scan.points().iter().filter(|p| p[0].is_finite()).copied().collect();
    for k in (1..points.len()).rev() {
        points.swap(k, (random.unit() * (k + 1) as f64) as usize);
    }
    Scan::new(points.len(), 1, points).unwrap()
}

#[test]
fn clouds_are_brought_together_whatever_the_order_of_their_points() {
    six_cells(366, |source, target, start| {
        let with = |order: u64, threads| {
            let (source, target) = (shuffled(source, order), shuffled(target, order + 1));
            let config = DenseConfig { threads, ..DenseConfig::default() };
            register(&source, &target, start, &config).unwrap()
        };
        let found = with(1, 1);
        assert_eq!(found, with(3, 2));
        found
    });
}

#[test]
fn every_method_comes_to_the_same_place_or_does_not_claim_it() {
    let (source, target, truth) = scans(1, |k| k);
    let start = off(&truth, &mut Random::new(8));
    let methods = [
        (DenseMethod::Symmetric, 0.4),
        (DenseMethod::PointToPlane, 0.5),
        (DenseMethod::PlaneToPlane, 1.5),
    ];
    let by = |method| {
        let config = DenseConfig { method, restarts: false, ..DenseConfig::default() };
        let found = register(&source, &target, &start, &config).unwrap();
        let (turn, shift) = errors(&truth, &found.target_from_source);
        (found.verdict, turn, shift)
    };
    for (method, mm) in methods {
        let (verdict, turn, shift) = by(method);
        assert_eq!(verdict, Verdict::Accepted, "{method:?}");
        assert!(turn < 0.5 * mm && shift < mm, "{method:?}: {turn} deg, {shift} mm");
    }
    // places of windows say little along a surface: it turns the right way, and does not claim the rest
    let (verdict, turn, _) = by(DenseMethod::PointToPoint);
    assert!(verdict != Verdict::Accepted && turn < 0.3, "{verdict:?} {turn} deg");
}

/// Starts up to 30 mm and 10 degrees off, from random sides: right or refused.
#[test]
fn no_answer_is_silently_wrong() {
    let (mut right, mut error, mut runs) = (0, 0.0, 0);
    for seed in 0..24 {
        let mut random = Random::new(1000 + seed);
        let room = Room::of_a_cell(&mut random);
        let mut some = |s: f64| random.between(-s, s);
        let mut view = || above(some(0.15), some(0.15), [some(0.2), some(0.2), some(0.3)]);
        let (one, other) = (view(), view());
        let source = room.scan(&one, &camera(240), 5e-4, &mut random);
        let target = room.scan(&other, &camera(240), 5e-4, &mut random);
        let truth = other.inv_mul(&one);
        let turn = random.normal3().normalize() * 10f64.to_radians();
        let to = Isometry3::translation(0.0, 0.0, 0.8);
        let away = Isometry3::new(random.normal3().normalize() * 0.03, turn);
        let start = truth * to * away * to.inverse();
        let (source, target) = match seed % 3 {
            0 => (shuffled(&source, seed), shuffled(&target, seed + 1)),
            _ => (source, target),
        };
        let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
        runs += 1;
        if found.verdict != Verdict::Accepted {
            assert!(!found.reasons.is_empty());
            continue;
        }
        let (turn, shift) = errors(&truth, &found.target_from_source);
        assert!(turn < 0.3 && shift < 1.5, "{seed}: {turn} deg, {shift} mm");
        right += 1;
        let off = lie::log(&truth.inv_mul(&found.target_from_source));
        error += off.dot(&(found.covariance.unwrap().try_inverse().unwrap() * off)) / 6.0;
    }
    println!("{right} of {runs}, normalised error {}", error / f64::from(right));
    assert!(right >= 15, "{right}");
    assert!((0.6..1.8).contains(&(error / f64::from(right))), "{}", error / f64::from(right));
}

/// A camera turned a little about what it looks at, which is alone in the room.
fn undetermined(solid: Solid, turn: [f64; 3]) -> Vec<String> {
    let room_from_thing = Isometry3::new(Vector3::zeros(), turn.into());
    let thing = Thing { solid, room_from_thing };
    let room = Room { things: vec![thing] };
    let mut random = Random::new(9);
    let one = Isometry3::new([0.0, 0.0, 0.8].into(), [PI, 0.0, 0.0].into());
    let source = room.scan(&one, &camera(240), 3e-4, &mut random);
    let target = room.scan(&one, &camera(240), 3e-4, &mut random);
    let start = Isometry3::new([1e-3, -2e-3, 1e-3].into(), [2e-3, 1e-3, -3e-3].into());
    let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
    if found.undetermined.is_empty() {
        assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    } else {
        assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
        assert_eq!(found.covariance, None);
    }
    found.undetermined
}

fn shifts_and_turns(named: &[String]) -> (usize, usize) {
    let shifts = named.iter().filter(|n| n.starts_with("a shift")).count();
    (shifts, named.len() - shifts)
}

#[test]
fn what_slides_on_itself_is_named() {
    let plane = undetermined(Solid::Block { half: [2.0, 2.0, 0.01] }, [0.0; 3]);
    assert_eq!(shifts_and_turns(&plane), (2, 1), "{plane:?}");
    assert!(plane[2].starts_with("a turn about (0.00, 0.00, 1.00)"), "{plane:?}");
    let ball = undetermined(Solid::Ball { radius: 0.2 }, [0.0; 3]);
    assert_eq!(shifts_and_turns(&ball), (0, 3), "{ball:?}");
    let bar = undetermined(Solid::Bar { radius: 0.1, half: 1.0 }, [0.0, PI / 2.0, 0.0]);
    assert!(bar[0].starts_with("a shift along (1.00, 0.00"), "{bar:?}");
    let block = undetermined(Solid::Block { half: [0.15, 0.15, 0.15] }, [0.7, 0.6, 0.0]);
    assert!(block.is_empty(), "{block:?}");
}

/// A table of 0.6 m, 0.8 m away, of which depth is wrong by noise, and by as much that changes slowly.
fn wavy_table(noise_m: f64, random: &mut Random) -> Scan {
    let waves: Vec<[f64; 3]> = (0..40)
        .map(|_| [random.normal() * 44.0, random.normal() * 44.0, random.between(0.0, 2.0 * PI)])
        .collect();
    let point = |_| {
        let (x, y) = (random.between(-0.3, 0.3), random.between(-0.3, 0.3));
        let slow: f64 = waves.iter().map(|[a, b, c]| (a * x + b * y + c).cos()).sum();
        let z = 0.8 + noise_m * (random.normal() + slow * (2.0 / waves.len() as f64).sqrt());
        [x, y, z].map(|x| x as f32)
    };
    let points: Vec<[f32; 3]> = (0..60_000).map(point).collect();
    Scan::new(points.len(), 1, points).unwrap()
}

#[test]
fn slow_errors_of_depth_are_no_shape() {
    let mut random = Random::new(12);
    for noise in [0.0, 1e-4, 3e-4] {
        let (source, target) = (wavy_table(noise, &mut random), wavy_table(noise, &mut random));
        for method in [DenseMethod::Symmetric, DenseMethod::PointToPlane] {
            let config = DenseConfig { method, ..DenseConfig::default() };
            let found = register(&source, &target, &Isometry3::identity(), &config).unwrap();
            assert_eq!(found.verdict, Verdict::Undetermined, "{noise} {method:?} {found:?}");
            assert_eq!(shifts_and_turns(&found.undetermined), (2, 1), "{:?}", found.undetermined);
        }
    }
}

#[test]
fn a_scan_lies_on_itself() {
    let (source, _, _) = scans(4, |camera| camera);
    let cloud = shuffled(&source, 5);
    for scan in [&source, &cloud] {
        for gate in [0.05, 0.002] {
            let config =
                DenseConfig { max_correspondence_distance_m: gate, ..DenseConfig::default() };
            let found = register(scan, scan, &Isometry3::identity(), &config).unwrap();
            assert_eq!(found.verdict, Verdict::Accepted, "{gate} {:?}", found.reasons);
            let (turn, shift) = errors(&Isometry3::identity(), &found.target_from_source);
            assert!(turn < 1e-6 && shift < 1e-6, "{turn} deg, {shift} mm");
            assert!(found.inlier_fraction > 0.95 && found.agreement > 0.99, "{found:?}");
        }
    }
}

/// Two scans of a cell from sides that have nothing to do with one another.
fn scans_from_anywhere(seed: u64) -> (Scan, Scan, Isometry3<f64>) {
    let mut random = Random::new(2000 + seed);
    let room = Room::of_a_cell(&mut random);
    let mut some = |s: f64| random.between(-s, s);
    let mut view = || above(some(0.15), some(0.15), [some(0.2), some(0.2), some(3.0)]);
    let (one, other) = (view(), view());
    let source = room.scan(&one, &camera(240), 5e-4, &mut random);
    let target = room.scan(&other, &camera(240), 5e-4, &mut random);
    (source, target, other.inv_mul(&one))
}

#[test]
fn a_start_is_found_without_one() {
    let config = DenseConfig { global: true, ..DenseConfig::default() };
    let mut right = 0;
    for seed in 0..12 {
        let (source, target, truth) = scans_from_anywhere(seed);
        let found = register(&source, &target, &Isometry3::identity(), &config).unwrap();
        if found.verdict == Verdict::Accepted {
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.3 && shift < 1.5, "{seed}: {turn} deg, {shift} mm");
            right += 1;
        }
    }
    println!("{right} of 12");
    assert!(right >= 8, "{right}");
}

#[test]
fn a_start_that_is_found_does_not_depend_on_the_number_of_threads() {
    let (source, target, _) = scans_from_anywhere(3);
    let with = |threads| {
        let config = DenseConfig { global: true, threads, ..DenseConfig::default() };
        register(&source, &target, &Isometry3::identity(), &config).unwrap()
    };
    assert_eq!(with(1), with(3));
}

/// A source that is a percent too large lies where as much of it is too high as too low; it is measured.
#[test]
fn scans_of_another_size_are_refused() {
    let (source, target, truth) = scans(3, |k| k);
    let start = off(&truth, &mut Random::new(9));
    for (source, target) in
        [(source.clone(), target.clone()), (shuffled(&source, 1), shuffled(&target, 2))]
    {
        let by = |scale: f32| {
            let points = source.points().iter().map(|p| p.map(|x| x * scale)).collect();
            let grown = Scan::new(source.width(), source.height(), points).unwrap();
            register(&grown, &target, &start, &DenseConfig::default()).unwrap()
        };
        let same = by(1.0);
        let size = same.size.unwrap();
        assert_eq!(same.verdict, Verdict::Accepted);
        assert!((size.ratio - 1.0).abs() < 4.0 * size.sigma, "{size:?}");
        let other = by(1.01);
        let size = other.size.unwrap();
        assert_eq!(other.verdict, Verdict::Rejected, "{size:?}");
        assert!((size.ratio - 1.0 / 1.01).abs() < 4.0 * size.sigma, "{size:?}");
        assert!(other.reasons.iter().any(|r| r.contains("% smaller")), "{:?}", other.reasons);
    }
}

/// Uneven ground of 0.6 m, as seen from above, 1 m below the camera or wherever it is shifted.
fn ground(seed: u64, up: f64) -> Scan {
    let mut random = Random::new(seed);
    let height = |x: f64, y: f64| {
        0.03 * (9.0 * x + 1.0).sin() * (7.0 * y).cos() + 0.02 * (17.0 * y + 5.0 * x * x).sin()
    };
    let points: Vec<[f32; 3]> = (0..40_000)
        .map(|_| {
            let (x, y) = (random.between(-0.3, 0.3), random.between(-0.3, 0.3));
            [x, y, up + height(x, y) + 3e-4 * random.normal()].map(|v| v as f32)
        })
        .collect();
    Scan::new(points.len(), 1, points).unwrap()
}

/// From below it would look alike: the side on which it is seen must not be guessed.
#[test]
fn ground_over_the_origin_is_found_like_ground_below_it() {
    let down = Isometry3::new([0.0, 0.0, 1.0].into(), [PI, 0.0, 0.0].into());
    let seen: Vec<[f32; 3]> = ground(1, 0.0)
        .points()
        .iter()
        .map(|p| (down * nalgebra::Point3::from(p.map(f64::from))).coords.map(|x| x as f32).into())
        .collect();
    let source = Scan::new(seen.len(), 1, seen).unwrap();
    for up in [-1.0, 0.0, 0.8, 1.5] {
        let truth = Isometry3::translation(0.0, 0.0, up) * down.inverse();
        let start = off(&truth, &mut Random::new(3));
        let found = register(&source, &ground(2, up), &start, &DenseConfig::default()).unwrap();
        let (turn, shift) = errors(&truth, &found.target_from_source);
        assert_eq!(found.verdict, Verdict::Accepted, "{up}: {:?}", found.reasons);
        assert!(turn < 0.02 && shift < 0.1, "{up}: {turn} deg, {shift} mm");
    }
}

/// Part of what both see was moved between the scans.
#[test]
fn scans_that_differ_at_many_places_are_refused() {
    let (source, target, truth) = scans(2, |k| k);
    let start = off(&truth, &mut Random::new(4));
    let by = |share: f32| {
        let (width, height) = (target.width(), target.height());
        let last = width - (share * width as f32) as usize;
        let nearer = |(k, p): (usize, &[f32; 3])| {
            if k % width >= last { p.map(|x| 0.97 * x) } else { *p }
        };
        let points = target.points().iter().enumerate().map(nearer).collect();
        let changed = Scan::new(width, height, points).unwrap();
        register(&source, &changed, &start, &DenseConfig::default()).unwrap()
    };
    let (few, many) = (by(0.05), by(0.3));
    assert_eq!(few.verdict, Verdict::Accepted, "{:?}", few.reasons);
    assert!(few.agreement < 0.995, "{}", few.agreement);
    assert_eq!(many.verdict, Verdict::Rejected);
    assert!(
        many.reasons[0].contains("the aligned scans contradict each other"),
        "{:?}",
        many.reasons
    );
}

/// Three planes are the same in every size, and noise of their normals tells nothing.
#[test]
fn the_size_of_a_corner_is_not_told() {
    let mut random = Random::new(6);
    let mut corner = || {
        let points: Vec<[f32; 3]> = (0..30_000)
            .map(|k| {
                let mut p = [0.0, random.between(0.0, 0.3), random.between(0.0, 0.3)];
                p.rotate_right(k % 3);
                p.map(|x| (x + 1e-3 * random.normal()) as f32)
            })
            .collect();
        Scan::new(points.len(), 1, points).unwrap()
    };
    let (source, target) = (corner(), corner());
    let start = Isometry3::new([0.003, -0.002, 0.001].into(), [0.005, 0.004, -0.006].into());
    let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
    assert_eq!((found.verdict, found.size), (Verdict::Accepted, None), "{:?}", found.reasons);
}

/// Of dense clouds, neighbours along the surface lie as near as the right one.
#[test]
fn distances_between_places_get_stuck_and_say_so() {
    let config = DenseConfig { method: DenseMethod::PointToPoint, ..DenseConfig::default() };
    let (mut stuck, mut moved) = (0, 0);
    for seed in 0..3 {
        let (source, target, truth) = scans_of(480, seed, |k| k);
        let start = truth * Isometry3::translation(0.009, -0.009, 0.008);
        let found =
            register(&shuffled(&source, 1), &shuffled(&target, 2), &start, &config).unwrap();
        let (turn, shift) = errors(&truth, &found.target_from_source);
        let right = turn < 0.1 && shift < 0.5;
        assert!(right || found.verdict != Verdict::Accepted, "{seed}: {turn} deg, {shift} mm");
        moved += usize::from(found.target_from_source != start);
        stuck += usize::from(found.reasons.iter().any(|r| r.contains("local minimum")));
    }
    assert!(stuck > 0 && moved == 3, "{stuck} {moved}");
}
