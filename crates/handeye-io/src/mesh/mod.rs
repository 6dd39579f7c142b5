//! Surfaces of triangles: STL, OBJ, and PLY with faces.

mod obj;
mod stl;

use std::path::Path;

use handeye::{Scan, TriangleMesh};

use crate::{
    error::{Error, Place, malformed, undeclared},
    files,
    ply::{self, Ply},
    records::MOST_POINTS,
    units::LengthUnit,
};

/// Vertices (m) and the triangles between them, as a file has them.
struct Parts {
    vertices: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Points that are laid over a mesh: about as many as a scan has. More would hardly make the pieces of
/// its surface smaller.
const POINTS_ON_MESH: f64 = 3e5;
/// Finer than this, m, no camera tells points apart.
const FINEST_SPACING_M: f64 = 2e-4;

/// Points laid evenly over a mesh, to be compared with those of a scan.
///
/// # Errors
/// A mesh too large to be covered.
pub fn points_on(mesh: &TriangleMesh) -> Result<Scan, handeye::Error> {
    mesh.sampled(spacing_on(mesh))
}

/// How far apart points are laid on a mesh, m.
pub fn spacing_on(mesh: &TriangleMesh) -> f64 {
    (mesh.area_m2() / POINTS_ON_MESH).sqrt().max(FINEST_SPACING_M)
}

/// Whether a file is a mesh: STL, OBJ, and PLY whose header promises faces.
pub fn is_mesh(path: &Path) -> bool {
    match files::extension(path).as_str() {
        "stl" | "obj" => true,
        "ply" => ply::has_faces(path),
        _ => false,
    }
}

/// Reads a mesh into metres. None of these formats says its unit.
///
/// # Errors
/// What is no mesh, is cut short, has no face or one with a vertex that is not there, and a missing unit.
pub fn read_mesh(path: &Path, unit: Option<LengthUnit>) -> Result<TriangleMesh, Error> {
    let unit = unit.ok_or_else(|| {
        undeclared(path, "length_unit", "are the vertices in \"m\" or in \"mm\"?")
    })?;
    let parts = match files::extension(path).as_str() {
        "stl" => stl::read(path, unit)?,
        "obj" => obj::read(path, unit)?,
        "ply" => {
            let ply = Ply::read(path)?;
            let vertices = ply.vertices(|p| in_metres(p, unit), path)?;
            Parts { vertices, triangles: ply.triangles(path)? }
        }
        other => {
            return Err(malformed(
                Place::file(path),
                format!("meshes of kind \".{other}\" cannot be read"),
                "STL, OBJ and PLY can; export one of them",
            ));
        }
    };
    TriangleMesh::new(parts.vertices, parts.triangles)
        .map_err(|e| malformed(Place::file(path), e.to_string(), "export the mesh again"))
}

#[inline(always)]
fn in_metres(vertex: [f64; 3], unit: LengthUnit) -> [f32; 3] {
    vertex.map(|x| unit.to_metres(x) as f32)
}

/// Faces cut into triangles that share the face's first corner.
#[derive(Default)]
pub(crate) struct Fans {
    pub(crate) triangles: Vec<[u32; 3]>,
    first: Option<u32>,
    last: Option<u32>,
}

impl Fans {
    /// A new face.
    pub(crate) fn begin(&mut self) {
        (self.first, self.last) = (None, None);
    }

    /// The next corner of the face; `None` once there are more triangles than are read.
    pub(crate) fn corner(&mut self, vertex: u32) -> Option<()> {
        match (self.first, self.last) {
            (None, _) => self.first = Some(vertex),
            (Some(_), None) => self.last = Some(vertex),
            (Some(first), Some(last)) => {
                self.triangles.push([first, last, vertex]);
                self.last = Some(vertex);
            }
        }
        (self.triangles.len() <= MOST_POINTS).then_some(())
    }
}
