//! The surface of a mesh, cut into cubes like that of a cloud.
//!
//! Triangles say their normals, so the two sides of a thin sheet do not run into one another, and of a closed
//! mesh it is known which side is outside. In a cube, points of triangles that face another way are another surfel.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::patch::Patch;
use crate::{Error, TriangleMesh};

/// Points laid along the edge of a cube.
const ALONG: f64 = 3.0;
/// Cubes along a side of the mesh's bounding box are no more than this.
const MOST_CUBES: f64 = 1e5;
/// Normals on a surfel of a cube agree within 35 degrees.
const ALIKE: f64 = 0.82;
/// Variance of a plane through a cube and its neighbours, which is three edges wide, over the edge squared.
const ALONG_WINDOW: f64 = 0.75;

/// What lies in a cube and faces one way.
struct Held {
    normal: Vector3<f64>,
    sum: Vector3<f64>,
    count: f64,
}

/// Surfels of a mesh on which points are laid so far apart, m.
///
/// # Errors
/// A mesh too large to be covered.
pub(crate) fn patches(mesh: &TriangleMesh, spacing_m: f64) -> Result<Vec<Option<Patch>>, Error> {
    let (points, triangles) = mesh.laid(spacing_m)?;
    let normals = mesh.normals();
    let mut cubes: BTreeMap<[i32; 3], Vec<Held>> = BTreeMap::new();
    let low = points.iter().flatten().fold(0f32, |low, x| low.min(*x));
    let edge = (ALONG * spacing_m).max(f64::from(-low) / MOST_CUBES);
    for (point, triangle) in points.iter().zip(triangles) {
        let normal = normals[triangle as usize];
        let p = Vector3::from(point.map(f64::from));
        let held = cubes.entry(p.map(|x| (x / edge).floor() as i32).into()).or_default();
        let alike = |h: &&mut Held| h.normal.normalize().dot(&normal) > ALIKE;
        match held.iter_mut().find(alike) {
            Some(same) => {
                same.normal += normal;
                same.sum += p;
                same.count += 1.0;
            }
            None => held.push(Held { normal, sum: p, count: 1.0 }),
        }
    }
    Ok(cubes.values().flatten().map(|held| surfel(held, edge)).collect())
}

fn surfel(held: &Held, edge: f64) -> Option<Patch> {
    Some(Patch {
        mean: held.sum / held.count,
        normal: held.normal.try_normalize(0.0)?,
        across: 0.0,
        variance: 0.0,
        along: ALONG_WINDOW * edge * edge,
        held: held.count,
        count: 9.0 * held.count,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plate of 60 x 40 mm, this thick (mm), its triangles seen from outside.
    fn plate(thick: f32) -> TriangleMesh {
        let ends = [[0.0; 3], [0.06, 0.04, 1e-3 * thick]];
        let at = |k: usize| std::array::from_fn(|a| ends[k >> a & 1][a]);
        let sides =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
        TriangleMesh::new((0..8).map(at).collect(), triangles.collect()).unwrap()
    }

    #[test]
    fn both_sides_of_a_thin_sheet_have_their_own_surfels() {
        let surfels = patches(&plate(0.8), 4e-4).unwrap();
        let facing = |sign: f64| {
            let all = surfels.iter().flatten();
            all.filter(|p| p.normal.z * sign > 0.9).map(|p| p.mean.z).collect::<Vec<_>>()
        };
        let (upper, lower) = (facing(1.0), facing(-1.0));
        assert!(upper.len() > 500 && lower.len() > 500, "{} {}", upper.len(), lower.len());
        assert!(upper.iter().all(|z| (z - 8e-4).abs() < 1e-6));
        assert!(lower.iter().all(|z| z.abs() < 1e-6));
    }

    #[test]
    fn a_mesh_with_a_hole_or_inside_out_does_not_say_where_outside_is() {
        let whole = plate(2.0);
        assert!(whole.is_closed());
        let (vertices, triangles) = (whole.vertices().to_vec(), whole.triangles().to_vec());
        let open = TriangleMesh::new(vertices.clone(), triangles[..10].to_vec()).unwrap();
        assert!(!open.is_closed());
        let inside_out = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        assert!(!TriangleMesh::new(vertices, inside_out).unwrap().is_closed());
    }
}
