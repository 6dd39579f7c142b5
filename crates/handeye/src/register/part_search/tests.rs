use nalgebra::{Isometry3, Vector3, Vector6};

use super::{DEVIATIONS_95, PRECISE, imprecise};

use crate::{
    Scan, TriangleMesh, Verdict,
    math::{lie, random::Random},
    register::{Dense, DenseConfig, Surface, register_surfaces, search::Search},
};

/// Points on a mesh are so far apart, m.
const SPACING: f64 = 4e-4;

/// A prism over a polygon of which each four corners that are named are a convex piece, mm.
fn prism(corners: &[[f64; 2]], pieces: &[[u32; 4]], height: f64) -> TriangleMesh {
    let count = corners.len() as u32;
    let at = |z: f64| corners.iter().map(move |[x, y]| [*x, *y, z].map(|mm| (1e-3 * mm) as f32));
    let mut triangles: Vec<[u32; 3]> = vec![];
    for [a, b, c, d] in pieces {
        triangles.extend([[*a, *c, *b], [*a, *d, *c]]);
        triangles.extend([[*a, *b, *c], [*a, *c, *d]].map(|t| t.map(|v| v + count)));
    }
    for k in 0..count {
        let next = (k + 1) % count;
        triangles.extend([[k, next, count + next], [k, count + next, count + k]]);
    }
    TriangleMesh::new(at(0.0).chain(at(height)).collect(), triangles).unwrap()
}

/// An angle of unequal legs, cut off at one end.
fn angle() -> TriangleMesh {
    let corners = [[0.0, 0.0], [80.0, 0.0], [80.0, 18.0], [22.0, 18.0], [22.0, 50.0], [0.0, 38.0]];
    prism(&corners, &[[0, 1, 2, 3], [0, 3, 4, 5]], 30.0)
}

fn cuboid(x: f64, y: f64, z: f64) -> TriangleMesh {
    prism(&[[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]], &[[0, 1, 2, 3]], z)
}

/// A mesh as a camera at the origin sees it, with 0.1 mm of noise.
fn scan(mesh: &TriangleMesh, scan_from_part: &Isometry3<f64>, random: &mut Random) -> Scan {
    let side = 190;
    let corners: Vec<[Vector3<f64>; 3]> = mesh
        .triangles()
        .iter()
        .map(|t| {
            let at = |v: u32| Vector3::from(mesh.vertices()[v as usize].map(f64::from));
            t.map(|v| scan_from_part.transform_point(&at(v).into()).coords)
        })
        .collect();
    let point = |k: usize| {
        let pixel = |n: usize| (n as f64 - 0.5 * (side as f64 - 1.0)) * 1.2e-3;
        let ray = Vector3::new(pixel(k % side), pixel(k / side), 1.0);
        let depth = corners.iter().filter_map(|c| hit(&ray, c)).fold(f64::INFINITY, f64::min);
        let depth = depth + 1e-4 * random.normal();
        if depth.is_finite() { (ray * depth).map(|x| x as f32).into() } else { [f32::NAN; 3] }
    };
    Scan::new(side, side, (0..side * side).map(point).collect()).unwrap()
}

/// Where a ray from the origin meets a triangle (Möller and Trumbore).
fn hit(ray: &Vector3<f64>, [a, b, c]: &[Vector3<f64>; 3]) -> Option<f64> {
    let (one, other) = (b - a, c - a);
    let p = ray.cross(&other);
    let inverse = 1.0 / one.dot(&p);
    let u = -a.dot(&p) * inverse;
    let q = (-a).cross(&one);
    let (v, t) = (ray.dot(&q) * inverse, other.dot(&q) * inverse);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// A part 0.4 m in front of the camera, rotated, with its middle on the axis.
fn placed(rotated: [f64; 3]) -> Isometry3<f64> {
    let pose = Isometry3::new([0.0, 0.0, 0.4].into(), rotated.into());
    pose * Isometry3::translation(-0.04, -0.025, -0.015)
}

/// Views from which three sides are seen.
const VIEWS: [[f64; 3]; 3] = [[0.7, 0.6, 0.4], [-2.3, 0.5, 0.9], [0.4, 2.4, -0.8]];

fn found(source: &Surface, target: &Surface, threads: usize) -> Dense {
    let config = DenseConfig { global: true, threads, ..DenseConfig::default() };
    register_surfaces(source, target, &Isometry3::identity(), &config)
}

/// Degrees, and mm at the middle of the part.
fn errors(truth: &Isometry3<f64>, found: &Isometry3<f64>) -> (f64, f64) {
    let middle = Vector3::new(0.04, 0.025, 0.015).into();
    let apart = (truth.transform_point(&middle) - found.transform_point(&middle)).norm();
    (lie::angle(&truth.rotation, &found.rotation).to_degrees(), 1e3 * apart)
}

fn is_right(truth: &Isometry3<f64>, found: &Isometry3<f64>) -> bool {
    let (degrees, mm) = errors(truth, found);
    degrees < 0.3 && mm < 0.3
}

#[test]
fn a_part_is_found_in_a_scan_of_one_side_and_a_scan_in_the_part() {
    let mut random = Random::new(3);
    let part = Surface::of_mesh(&angle(), SPACING).unwrap().unwrap();
    for view in VIEWS {
        let truth = placed(view);
        let scan = Surface::of(&scan(&angle(), &truth, &mut random), 1).unwrap();
        let there = found(&part, &scan, 1);
        assert_eq!(there.verdict, Verdict::Accepted, "{view:?} {:?}", there.reasons);
        assert!(is_right(&truth, &there.target_from_source), "{view:?}");
        assert!(there.explained.unwrap() > 0.9 && there.places.is_empty(), "{there:?}");
        let back = found(&scan, &part, 1);
        assert_eq!(back.verdict, Verdict::Accepted, "{view:?} {:?}", back.reasons);
        assert!(is_right(&truth, &back.target_from_source.inverse()), "{view:?}");
    }
}

#[test]
fn a_symmetric_part_is_answered_with_the_list_of_its_places() {
    let cuboid = cuboid(80.0, 50.0, 30.0);
    let part = Surface::of_mesh(&cuboid, SPACING).unwrap().unwrap();
    let truth = placed(VIEWS[0]);
    let scan = Surface::of(&scan(&cuboid, &truth, &mut Random::new(4)), 1).unwrap();
    let answer = found(&part, &scan, 1);
    assert_eq!(answer.verdict, Verdict::Undetermined, "{:?}", answer.reasons);
    assert_eq!(answer.places.len(), 4, "{:?}", answer.reasons);
    assert_eq!(answer.places[0], answer.target_from_source);
    assert!(answer.places.iter().any(|at| is_right(&truth, at)));
    assert!(answer.reasons.iter().any(|r| r.contains("180 degrees")), "{:?}", answer.reasons);
}

#[test]
fn a_part_that_is_not_there_is_refused() {
    let truth = placed(VIEWS[0]);
    let other = cuboid(100.0, 40.0, 20.0);
    for (shown, searched) in [(angle(), other.clone()), (other, angle())] {
        let scan = Surface::of(&scan(&shown, &truth, &mut Random::new(5)), 1).unwrap();
        let part = Surface::of_mesh(&searched, SPACING).unwrap().unwrap();
        let answer = found(&part, &scan, 1);
        assert_eq!(answer.verdict, Verdict::Rejected, "{answer:?}");
    }
}

#[test]
fn a_part_that_is_found_does_not_depend_on_the_number_of_threads() {
    let part = Surface::of_mesh(&angle(), SPACING).unwrap().unwrap();
    let scan = Surface::of(&scan(&angle(), &placed(VIEWS[1]), &mut Random::new(6)), 1).unwrap();
    assert_eq!(found(&part, &scan, 1), found(&part, &scan, 3));
}

#[test]
fn a_deviation_is_how_far_the_surface_moves() {
    let mut random = Random::new(9);
    let part = Surface::of_mesh(&angle(), SPACING).unwrap().unwrap();
    let truth = placed(VIEWS[1]);
    let scan = Surface::of(&scan(&angle(), &truth, &mut random), 1).unwrap();
    let by = Vector6::new(4e-4, -1e-4, 2e-4, 1e-4, 3e-4, -2e-4);
    let [low, high] = [Vector3::zeros(), Vector3::new(0.08, 0.05, 0.03)];
    for (source, target, at) in [(&part, &scan, truth), (&scan, &part, truth.inverse())] {
        let search = Search::new(source, target, 1).unwrap();
        let found = search.deviation(&at, &(by * by.transpose()));
        // over a box around the part instead of its surface
        let moved = |corner: usize| {
            let p = Vector3::from_fn(|k, _| if corner >> k & 1 == 0 { low[k] } else { high[k] });
            let p = if at == truth { p.into() } else { truth.transform_point(&p.into()) };
            ((at * lie::exp(&by)).transform_point(&p) - at.transform_point(&p)).norm_squared()
        };
        let corners = ((0..8).map(moved).sum::<f64>() / 8.0).sqrt();
        assert!((found / corners - 1.0).abs() < 0.1, "{found} {corners}");
    }
}

#[test]
fn a_part_that_is_determined_poorly_is_not_called_found() {
    let mut random = Random::new(3);
    let part = Surface::of_mesh(&angle(), SPACING).unwrap().unwrap();
    let scan = Surface::of(&scan(&angle(), &placed(VIEWS[0]), &mut random), 1).unwrap();
    let search = Search::new(&part, &scan, 1).unwrap();
    let mut answer = found(&part, &scan, 1);
    let covariance = answer.covariance.unwrap();
    let deviation = search.deviation(&answer.target_from_source, &covariance);
    let up_to_limit = PRECISE * search.radius() / (DEVIATIONS_95 * deviation);
    for (share, is_named) in [(0.98, false), (1.02, true)] {
        answer.covariance = Some(covariance * (share * up_to_limit).powi(2));
        assert_eq!(imprecise(&answer, &search).is_some(), is_named, "{share}");
    }
}
