//! A surface of triangles: what a part should be, or what was made from many scans.
//!
//! Points are laid over it where the lines of a square lattice pass through a triangle, along the axis
//! to which the triangle lies most nearly at right angles. So the surface decides where they lie, not
//! how it is cut, and triangles smaller than the spacing get their share. A line through a common edge
//! belongs to one side alone: both compute the edge from the same ends in the same order.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use crate::{Error, Scan, frame::FARTHEST_M};

/// Most points that are laid over a mesh, and most lattice lines that are followed for them.
const MOST_POINTS: f64 = 1e8;
/// Share of the edges of a closed mesh that must be paired: rounding of vertices opens a few.
const CLOSED: f64 = 0.99;
/// Points closer than this, m, cannot be told apart in single precision, nor by any camera.
const LEAST_SPACING_M: f64 = 1e-9;

/// A surface of triangles, in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    vertices: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// From its vertices (m) and, for each triangle, the numbers of three of them, from 0.
    ///
    /// # Errors
    /// No triangle at all, numbers of vertices that are not there, and vertices that are not finite or
    /// farther away than any robot reaches.
    pub fn new(vertices: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, Error> {
        if triangles.is_empty() {
            return Err(Error::Invalid("the mesh has no triangle".into()));
        }
        let is_near = |x: &f32| f64::from(x.abs()) <= FARTHEST_M;
        if let Some(k) = vertices.iter().position(|v| !v.iter().all(is_near)) {
            let [x, y, z] = vertices[k];
            let what = format!(
                "vertex {} of the mesh, ({x}, {y}, {z}) m, is not finite or beyond any robot and camera",
                k + 1
            );
            return Err(Error::Invalid(what));
        }
        let count = vertices.len();
        let is_there = |v: &u32| (*v as usize) < count;
        if let Some(k) = triangles.iter().position(|t| !t.iter().all(is_there)) {
            let what = format!(
                "triangle {} of the mesh has a vertex that is not there: {:?} of {count}, counted from 0",
                k + 1,
                triangles[k]
            );
            return Err(Error::Invalid(what));
        }
        Ok(Self { vertices, triangles })
    }

    /// Corners of the triangles, m.
    pub fn vertices(&self) -> &[[f32; 3]] {
        &self.vertices
    }
    /// The numbers of each triangle's vertices, from 0.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The area of all triangles, m².
    pub fn area_m2(&self) -> f64 {
        self.corners().map(|[a, b, c]| 0.5 * (b - a).cross(&(c - a)).norm()).sum()
    }

    /// Points laid evenly over the surface, in no order: neighbours are `spacing_m` apart where it faces
    /// along an axis, and up to 1.7 times as far where it is most aslant. The same surface gives the same
    /// points, whatever the order of its triangles and of their corners.
    ///
    /// # Errors
    /// A spacing that makes more than 100 million points, or is below a nanometre.
    pub fn sampled(&self, spacing_m: f64) -> Result<Scan, Error> {
        let (points, _) = self.laid(spacing_m)?;
        Scan::new(points.len(), 1, points).ok_or_else(|| Error::Invalid("no points".into()))
    }

    /// The points of [`sampled`](Self::sampled), and for each the number of its triangle.
    pub(crate) fn laid(&self, spacing_m: f64) -> Result<(Vec<[f32; 3]>, Vec<u32>), Error> {
        if !(spacing_m >= LEAST_SPACING_M && spacing_m.is_finite()) {
            let what = format!("points {spacing_m} m apart cannot be laid over a mesh");
            return Err(Error::Invalid(what));
        }
        let work: f64 = self.corners().map(|c| work(&c, spacing_m)).sum();
        if !(work <= MOST_POINTS) {
            let what = format!(
                "points {} mm apart would be about {work:.1e} on this mesh, more than {MOST_POINTS:.0e}: \
                 lay them wider apart",
                1e3 * spacing_m
            );
            return Err(Error::Invalid(what));
        }
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for (k, corners) in self.corners().enumerate() {
            lay(corners, spacing_m, &mut points);
            triangles.resize(points.len(), k as u32);
        }
        Ok((points, triangles))
    }

    /// Across each triangle, of length one; zero of those without area.
    pub(crate) fn normals(&self) -> Vec<Vector3<f64>> {
        self.corners().map(|c| normal(&c).try_normalize(0.0).unwrap_or_default()).collect()
    }

    /// Whether all but a few edges belong to two triangles that run along them in opposite directions, and normals point
    /// outwards: then they tell the side from which a surface can be seen. Vertices at one place count as one.
    pub(crate) fn is_closed(&self) -> bool {
        let mut places: BTreeMap<[u32; 3], u32> = BTreeMap::new();
        let mut number = |v: u32| {
            // -0.0 is at the place of 0.0
            let at = self.vertices[v as usize].map(|x| (x + 0.0).to_bits());
            let next = places.len() as u32;
            *places.entry(at).or_insert(next)
        };
        let mut edges = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(&mut number);
            if a != b && b != c && c != a {
                edges.extend([(a, b), (b, c), (c, a)]);
            }
        }
        edges.sort_unstable();
        let back = |&(a, b): &(u32, u32)| edges.binary_search(&(b, a)).is_ok();
        let volume: f64 = self.corners().map(|[a, b, c]| a.dot(&b.cross(&c))).sum();
        let paired = edges.iter().filter(|edge| back(edge)).count();
        volume > 0.0 && paired as f64 >= CLOSED * edges.len() as f64
    }

    fn corners(&self) -> impl Iterator<Item = [Vector3<f64>; 3]> {
        let vertex = |v: u32| Vector3::from(self.vertices[v as usize].map(f64::from));
        self.triangles.iter().map(move |t| t.map(vertex))
    }
}

/// Lattice points in a triangle and lattice lines across it, about.
fn work(corners: &[Vector3<f64>; 3], spacing: f64) -> f64 {
    let [a, b, c] = corners;
    let (one, other) = (b - a, c - a);
    let longest = one.amax().max(other.amax()).max((c - b).amax());
    0.5 * one.cross(&other).norm() / (spacing * spacing) + longest / spacing
}

/// Adds the lattice points of one triangle.
fn lay(mut corners: [Vector3<f64>; 3], spacing: f64, into: &mut Vec<[f32; 3]>) {
    let w = normal(&corners).iamax();
    let (u, v) = ((w + 1) % 3, (w + 2) % 3);
    corners.sort_by(|p, q| {
        p[v].total_cmp(&q[v]).then(p[u].total_cmp(&q[u])).then(p[w].total_cmp(&q[w]))
    });
    let [a, b, c] = corners;
    let n = normal(&corners);
    if n[w] == 0.0 {
        return;
    }
    let (low, high) = (a[w].min(b[w]).min(c[w]), a[w].max(b[w]).max(c[w]));
    for along_v in multiples(a[v], c[v], spacing) {
        let on_edge = |p: &Vector3<f64>, q: &Vector3<f64>| {
            p[u] + (q[u] - p[u]) * ((along_v - p[v]) / (q[v] - p[v]))
        };
        let long = on_edge(&a, &c);
        let short = if along_v < b[v] { on_edge(&a, &b) } else { on_edge(&b, &c) };
        for along_u in multiples(long.min(short), long.max(short), spacing) {
            let away = n[u] * (along_u - a[u]) + n[v] * (along_v - a[v]);
            let mut point = [0.0; 3];
            point[u] = along_u as f32;
            point[v] = along_v as f32;
            point[w] = (a[w] - away / n[w]).clamp(low, high) as f32;
            into.push(point);
        }
    }
}

fn normal([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

/// Multiples of a step from `from` up to, but without, `to`. The quotient is rounded: which multiple is
/// the first, comparing tells.
fn multiples(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let before = (from / step).floor() as i64 - 1;
    let all = (before..).map(move |k| k as f64 * step);
    all.skip_while(move |x| *x < from).take_while(move |x| *x < to)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING_M: f64 = 0.01;

    /// A square of one metre, cut along one of its diagonals.
    fn square(other_diagonal: bool) -> TriangleMesh {
        let vertices = vec![[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]];
        let triangles =
            if other_diagonal { vec![[1, 2, 3], [1, 3, 0]] } else { vec![[0, 1, 2], [0, 2, 3]] };
        TriangleMesh::new(vertices, triangles).unwrap()
    }

    /// A ball of 0.2 m, cut by so many circles of latitude and twice as many of longitude.
    fn ball(rings: u32) -> TriangleMesh {
        let (mut vertices, mut triangles) = (vec![], vec![]);
        let around = 2 * rings;
        for i in 0..=rings {
            for j in 0..around {
                let (t, p) = (
                    std::f64::consts::PI * f64::from(i) / f64::from(rings),
                    std::f64::consts::TAU * f64::from(j) / f64::from(around),
                );
                let direction = [t.sin() * p.cos(), t.sin() * p.sin(), t.cos()];
                vertices.push(direction.map(|x| (0.2 * x) as f32));
                let (here, next) = (i * around + j, i * around + (j + 1) % around);
                if i < rings {
                    triangles.push([here, here + around, next]);
                    triangles.push([next, here + around, next + around]);
                }
            }
        }
        TriangleMesh::new(vertices, triangles).unwrap()
    }

    fn sorted(scan: &Scan) -> Vec<[f32; 3]> {
        let mut points = scan.points().to_vec();
        points.sort_by(|a, b| a.partial_cmp(b).unwrap());
        points
    }

    #[test]
    fn the_area_of_a_ball_is_that_of_its_surface() {
        let area = ball(200).area_m2();
        assert!((area / (4.0 * std::f64::consts::PI * 0.04) - 1.0).abs() < 1e-3, "{area}");
    }

    #[test]
    fn a_square_has_every_lattice_point_once_however_it_is_cut() {
        let points = sorted(&square(false).sampled(SPACING_M).unwrap());
        assert_eq!(points.len(), 100 * 100);
        assert_eq!(points, sorted(&square(true).sampled(SPACING_M).unwrap()));
        assert!(points.iter().all(|p| p[2] == 0.5));
    }

    #[test]
    fn points_lie_on_the_surface_as_close_as_was_asked() {
        let mesh = ball(300);
        let scan = mesh.sampled(SPACING_M).unwrap();
        let expected = mesh.area_m2() / (SPACING_M * SPACING_M);
        let count = scan.points().len() as f64;
        assert!(count > 0.75 * expected && count <= expected, "{count} of {expected}");
        for p in scan.points() {
            let radius = Vector3::from(p.map(f64::from)).norm();
            assert!((radius - 0.2).abs() < 1e-4, "{radius}");
        }
        // half a cell, and where the axis changes half of another
        let farthest = 1.75 * SPACING_M as f32;
        let tree = crate::register::KdTree::new(scan.points());
        for vertex in mesh.vertices() {
            assert!(tree.nearest(vertex, farthest).is_some(), "{vertex:?}");
        }
    }

    #[test]
    fn neither_the_order_of_triangles_nor_that_of_their_corners_matters() {
        let mesh = ball(40);
        let turned = |(k, t): (usize, &[u32; 3])| match k % 3 {
            0 => [t[1], t[2], t[0]],
            1 => [t[2], t[1], t[0]],
            _ => *t,
        };
        let triangles = mesh.triangles().iter().enumerate().rev().map(turned).collect();
        let other = TriangleMesh::new(mesh.vertices().to_vec(), triangles).unwrap();
        let points = sorted(&mesh.sampled(SPACING_M).unwrap());
        assert_eq!(points, sorted(&other.sampled(SPACING_M).unwrap()));
    }

    #[test]
    fn triangles_smaller_than_the_spacing_get_their_share() {
        let (fine, coarse) = (ball(400), ball(60));
        let count = |mesh: &TriangleMesh| mesh.sampled(SPACING_M).unwrap().points().len() as f64;
        assert!((count(&fine) / count(&coarse) - 1.0).abs() < 0.02);
    }

    #[test]
    fn triangles_without_area_have_no_points() {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        let mesh = TriangleMesh::new(vertices, vec![[0, 1, 2], [0, 0, 0], [1, 1, 2]]).unwrap();
        assert!(mesh.sampled(SPACING_M).unwrap().points().is_empty());
        assert_eq!(mesh.area_m2(), 0.0);
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        let message = |vertices: &[[f32; 3]], triangles: &[[u32; 3]]| {
            TriangleMesh::new(vertices.to_vec(), triangles.to_vec()).unwrap_err().to_string()
        };
        let good = [[0.0; 3], [1.0; 3], [0.0, 1.0, 0.0]];
        assert_eq!(message(&good, &[]), "the mesh has no triangle");
        assert_eq!(
            message(&good, &[[0, 1, 2], [0, 1, 3]]),
            "triangle 2 of the mesh has a vertex that is not there: [0, 1, 3] of 3, counted from 0"
        );
        for wrong in [f32::NAN, f32::INFINITY, -2e6] {
            let found = message(&[[0.0; 3], [0.0, wrong, 0.0]], &[[0, 1, 0]]);
            assert!(found.starts_with("vertex 2 of the mesh, (0, "), "{found}");
        }
    }

    #[test]
    fn absurd_spacings_are_refused() {
        for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-12] {
            let message = square(false).sampled(spacing).unwrap_err().to_string();
            assert!(message.contains("cannot be laid"), "{message}");
        }
        let message = square(false).sampled(5e-5).unwrap_err().to_string();
        assert!(message.starts_with("points 0.05 mm apart would be about 4.0e8"), "{message}");
        let needle = vec![[0.0; 3], [1e6, 0.0, 0.0], [1e6, 1e-6, 0.0]];
        let needle = TriangleMesh::new(needle, vec![[0, 1, 2]]).unwrap();
        assert!(needle.sampled(1e-4).is_err());
    }
}
