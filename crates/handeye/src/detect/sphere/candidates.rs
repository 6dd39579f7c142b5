//! Where a ball may be, and which of these places is one.

use std::collections::BTreeMap;

use nalgebra::{Matrix4, Vector3, Vector4};

use crate::Scan;

/// A sphere, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Candidate {
    pub centre: Vector3<f64>,
    pub radius: f64,
}

/// No 3D camera measures farther, m.
const FARTHEST: f64 = 1000.0;
/// Points that stand for the scan.
const THINNED: usize = 60_000;
/// Side of a cell, of the radius that is looked for.
const CELL: f64 = 0.45;
/// Reach of the patch around a cell, in cells.
const REACH: f64 = 1.5;
/// Fewest points of a patch, and the most that are used of it.
const PATCH: (usize, usize) = (12, 250);
/// Cells with fewer points than this, in the mean, are too small for patches.
const FEWEST_IN_CELL: f64 = 1.7;
/// A patch's radius may differ by this factor from the one that is looked for: noise bends it.
const LIKE: f64 = 1.5;
/// Radii that are looked for where none is known, m, each as many times the one before as
/// [`LIKE`] spans.
const RADII: [f64; 8] = [0.004, 0.007, 0.013, 0.024, 0.045, 0.08, 0.15, 0.28];
/// The patch of a sphere scatters by no more than this part of the radius.
const SMOOTH: f64 = 0.08;
/// Rays nearer to the centre than this part of the radius must end on the ball.
const CORE: f64 = 0.85;
/// What is on the ball is off by no more than this part of the radius, or by the scatter.
const ON_BALL: f64 = 0.03;
/// The same, standard deviations of the scatter.
const ON_BALL_SIGMAS: f64 = 3.5;
/// Least share of the rays through the core that end on the ball; the others end before it.
const SEEN: f64 = 0.45;
/// Largest share that ends inside or behind it.
const BEHIND: f64 = 0.1;
/// Fewest rays that end on it.
const FEWEST_RAYS: usize = 20;
/// Steps that refine a candidate.
const STEPS: usize = 6;

/// Every n-th point of a scan.
pub(super) fn thinned(scan: &Scan) -> Vec<Vector3<f64>> {
    let sound = |p: &[f32; 3]| {
        let v = Vector3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
        (v.norm() < FARTHEST && v.z > 0.0).then_some(v)
    };
    let count = scan.points().iter().filter(|p| sound(p).is_some()).count();
    let step = count.div_ceil(THINNED).max(1);
    scan.points().iter().filter_map(sound).step_by(step).collect()
}

/// The sphere that most rays end on; of radius `radius`, or of any.
pub(super) fn best(points: &[Vector3<f64>], radius: Option<f64>) -> Option<Candidate> {
    let radii = radius.map_or_else(|| RADII.to_vec(), |r| vec![r]);
    let mut found: Option<(usize, Candidate)> = None;
    for r in radii {
        for start in patches(points, r) {
            let known = found.as_ref().is_some_and(|(_, c)| near(c, &start));
            if known {
                continue;
            }
            let Some((rays, candidate)) = confirmed(points, &start) else { continue };
            if found.as_ref().is_none_or(|(most, _)| rays > *most) {
                found = Some((rays, candidate));
            }
        }
    }
    found.map(|f| f.1)
}

/// A start from which the same ball would be found again.
fn near(known: &Candidate, start: &Candidate) -> bool {
    (known.centre - start.centre).norm() < 0.3 * known.radius
}

type Cell = (i64, i64, i64);

/// Spheres through the points around every cell.
fn patches(points: &[Vector3<f64>], radius: f64) -> Vec<Candidate> {
    let side = CELL * radius;
    let cell = |p: &Vector3<f64>| -> Cell {
        let at = |x: f64| (x / side).floor() as i64;
        (at(p.x), at(p.y), at(p.z))
    };
    let mut cells: BTreeMap<Cell, Vec<usize>> = BTreeMap::new();
    for (k, p) in points.iter().enumerate() {
        cells.entry(cell(p)).or_default().push(k);
    }
    if (points.len() as f64) < FEWEST_IN_CELL * cells.len() as f64 {
        return vec![];
    }
    let around = |(i, j, k): Cell| {
        let step = -2..=2;
        let all = step.clone().flat_map(move |a| step.clone().map(move |b| (a, b)));
        all.flat_map(move |(a, b)| (-2..=2).map(move |c| (i + a, j + b, k + c)))
    };
    let one = |(at, own): (&Cell, &Vec<usize>)| {
        let middle = own.iter().map(|&k| points[k]).sum::<Vector3<f64>>() / own.len() as f64;
        let near = around(*at).filter_map(|c| cells.get(&c)).flatten().map(|&k| points[k]);
        let patch: Vec<Vector3<f64>> =
            near.filter(|p| (p - middle).norm() < REACH * side).collect();
        let step = patch.len().div_ceil(PATCH.1).max(1);
        let patch: Vec<Vector3<f64>> = patch.into_iter().step_by(step).collect();
        let (sphere, scatter) = sphere_of(&patch)?;
        let like = sphere.radius < LIKE * radius && sphere.radius > radius / LIKE;
        let towards_camera = (sphere.centre - middle).dot(&middle) > 0.0;
        (like && towards_camera && scatter < SMOOTH * radius).then_some(sphere)
    };
    cells.iter().filter_map(one).collect()
}

/// The sphere `|p|² = 2 c·p + k` through points, and their scatter about it (m).
fn sphere_of(points: &[Vector3<f64>]) -> Option<(Candidate, f64)> {
    if points.len() < PATCH.0 {
        return None;
    }
    let count = points.len() as f64;
    let middle = points.iter().sum::<Vector3<f64>>() / count;
    let (mut a, mut b) = (Matrix4::zeros(), Vector4::zeros());
    for p in points {
        let q = p - middle;
        let row = (2.0 * q).push(1.0);
        a += row * row.transpose();
        b += row * q.norm_squared();
    }
    let x = a.cholesky()?.solve(&b);
    let centre: Vector3<f64> = x.xyz();
    let radius = (x.w + centre.norm_squared()).sqrt();
    let centre = centre + middle;
    let squares: f64 = points.iter().map(|p| ((p - centre).norm() - radius).powi(2)).sum();
    let scatter = (squares / (count - 4.0)).sqrt();
    (radius.is_finite() && scatter.is_finite()).then_some((Candidate { centre, radius }, scatter))
}

/// Refines a sphere on what ends on it, and counts these rays; `None` where it is no ball.
fn confirmed(points: &[Vector3<f64>], start: &Candidate) -> Option<(usize, Candidate)> {
    let near = |p: &&Vector3<f64>| off_axis(p, &start.centre) < 1.6 * start.radius;
    let close: Vec<Vector3<f64>> = points.iter().filter(near).copied().collect();
    let mut sphere = *start;
    let mut gate = 0.2 * start.radius;
    let mut tolerance = gate;
    for _ in 0..STEPS {
        let off = |p: &&Vector3<f64>| ((*p - sphere.centre).norm() - sphere.radius).abs() < gate;
        let front = |p: &&Vector3<f64>| (*p - sphere.centre).dot(*p) < 0.0;
        let on: Vec<Vector3<f64>> = close.iter().filter(off).filter(front).copied().collect();
        let (next, scatter) = sphere_of(&on)?;
        if next.radius > LIKE * start.radius || next.radius < start.radius / LIKE {
            return None;
        }
        sphere = next;
        tolerance = (ON_BALL * sphere.radius).max(ON_BALL_SIGMAS * scatter);
        gate = (0.6 * gate).max(tolerance);
    }
    let (mut on, mut before, mut behind) = (0, 0, 0);
    for p in &close {
        let distance = off_axis(p, &sphere.centre);
        if distance > CORE * sphere.radius {
            continue;
        }
        let t = meets(&p.normalize(), &sphere)?;
        match p.norm() - t {
            e if e.abs() < 1.5 * tolerance => on += 1,
            e if e > 0.0 => behind += 1,
            _ => before += 1,
        }
    }
    let all = (on + before + behind) as f64;
    let is_ball = on >= FEWEST_RAYS
        && on as f64 > SEEN * all
        && (behind as f64) < BEHIND * all
        && tolerance < 0.2 * sphere.radius;
    is_ball.then_some((on, sphere))
}

/// Distance (m) of a centre from the ray through a point.
pub(super) fn off_axis(p: &Vector3<f64>, centre: &Vector3<f64>) -> f64 {
    let u = p / p.norm();
    (centre - u * u.dot(centre)).norm()
}

/// How far along a unit ray a sphere is met, m.
pub(super) fn meets(u: &Vector3<f64>, s: &Candidate) -> Option<f64> {
    let along = u.dot(&s.centre);
    let root = s.radius.powi(2) - s.centre.norm_squared() + along * along;
    (root > 0.0 && along > 0.0).then(|| along - root.sqrt())
}
