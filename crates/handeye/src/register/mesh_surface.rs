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
pub fn patches(mesh: &TriangleMesh, spacing_m: f64) -> Result<Vec<Option<Patch>>, Error> {
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
