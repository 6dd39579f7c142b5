//! Cameras in `.npz` files: a matrix and coefficients, or single numbers `fx fy ppx ppy`.

use std::path::Path;

use super::found::Found;
use crate::{
    error::{Error, Place, malformed},
    npy::Archive,
};

const MATRIX: [&str; 7] =
    ["K", "mtx", "cameraMatrix", "camera_matrix", "intrinsic_matrix", "intrinsics", "matrix"];
const COEFFICIENTS: [&str; 7] =
    ["dist", "D", "distCoeffs", "dist_coeffs", "distortion", "distortion_coefficients", "coeffs"];

pub(super) fn intrinsics(path: &Path) -> Result<Found, Error> {
    let archive = Archive::read(path)?;
    let values = |names: &[&str]| -> Result<Option<Vec<f64>>, Error> {
        let array = names.iter().find_map(|name| archive.array(name)).transpose()?;
        Ok(array.map(|a| a.values()))
    };
    let number = |names: &[&str]| Ok::<_, Error>(values(names)?.and_then(|v| v.first().copied()));
    let distortion = values(&COEFFICIENTS)?.unwrap_or_default();
    if let Some(k) = values(&MATRIX)? {
        return Ok(Found { distortion, ..Found::from_matrix(&k, &Place::file(path))? });
    }
    let Some(fx) = number(&["fx"])? else {
        let names: Vec<&str> = archive.names().collect();
        return Err(malformed(
            Place::file(path),
            format!("holds no camera, but {}", names.join(", ")),
            format!("an array named {} is looked for", MATRIX.join(", ")),
        ));
    };
    Ok(Found {
        fx: Some(fx),
        fy: number(&["fy"])?,
        cx: number(&["cx", "ppx"])?,
        cy: number(&["cy", "ppy"])?,
        distortion,
        ..Found::default()
    })
}
