//! Scans in PLY: its vertices.

use std::path::Path;

use super::{Points, in_metres};
use crate::{error::Error, ply::Ply, units::LengthUnit};

pub(super) fn read(path: &Path, unit: LengthUnit) -> Result<Points, Error> {
    let ply = Ply::read(path)?;
    let xyz = ply.vertices(|p| in_metres(p, unit), path)?;
    let grid = ply.grid(xyz.len());
    Ok(Points { xyz, grid })
}
