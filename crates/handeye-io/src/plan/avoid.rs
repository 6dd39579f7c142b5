//! What stands in the cell and what the robot carries, as a file says it:
//!
//! ```toml
//! clearance_mm = 20
//! [[box]]
//! name = "table"
//! minimum_mm = [-600, -800, -50]     # in the base
//! maximum_mm = [600, 800, 0]
//! [[on_flange]]
//! name = "camera"
//! minimum_mm = [-60, -40, 0]         # in the flange
//! maximum_mm = [60, 40, 120]
//! ```

use std::path::Path;

use handeye::tools::plan::{Capsule, Cuboid, Obstacle, On, Part};
use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use serde::Deserialize;

use crate::{
    error::{Error, Place, malformed},
    files,
};

/// Unless the file says it, m.
const USUAL_CLEARANCE: f64 = 0.01;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Avoid {
    clearance_mm: Option<f64>,
    #[serde(default, rename = "box")]
    boxes: Vec<BoxSpec>,
    #[serde(default)]
    on_flange: Vec<BoxSpec>,
}

/// A box along the axes of its frame, or turned about its middle.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BoxSpec {
    name: String,
    minimum_mm: [f64; 3],
    maximum_mm: [f64; 3],
    rotation_xyzw: Option<[f64; 4]>,
}

/// What a file says.
pub(super) struct Avoided {
    pub(super) obstacles: Vec<Obstacle>,
    pub(super) carried: Vec<Part>,
    pub(super) clearance_m: f64,
}

impl Default for Avoided {
    fn default() -> Self {
        Self { obstacles: vec![], carried: vec![], clearance_m: USUAL_CLEARANCE }
    }
}

pub(super) fn read(path: &Path) -> Result<Avoided, Error> {
    let text = files::text(path)?;
    let found: Avoid = toml::from_str(&text).map_err(|e| {
        let line = e.span().map(|span| 1 + text[..span.start].matches('\n').count());
        let place = Place { line, ..Place::file(path) };
        let advice = "it has clearance_mm, [[box]] and [[on_flange]], each with name, minimum_mm and maximum_mm";
        malformed(place, e.message().to_owned(), advice)
    })?;
    let cuboid = |spec: &BoxSpec| cuboid(spec, path);
    let obstacle = |spec: &BoxSpec| Ok(Obstacle { name: spec.name.clone(), shape: cuboid(spec)? });
    let carried = |spec: &BoxSpec| {
        let shape = Capsule::around(&cuboid(spec)?);
        Ok(Part { name: spec.name.clone(), on: On::Flange, shape })
    };
    let clearance_m = found.clearance_mm.map_or(USUAL_CLEARANCE, |mm| mm * 1e-3);
    if !(clearance_m.is_finite() && (0.0..10.0).contains(&clearance_m)) {
        let what = "clearance_mm is no distance";
        return Err(malformed(Place::file(path), what, "give millimetres, zero or more"));
    }
    Ok(Avoided {
        obstacles: found.boxes.iter().map(obstacle).collect::<Result<_, Error>>()?,
        carried: found.on_flange.iter().map(carried).collect::<Result<_, Error>>()?,
        clearance_m,
    })
}

fn cuboid(spec: &BoxSpec, path: &Path) -> Result<Cuboid, Error> {
    let wrong = |what: String| {
        let advice = "minimum_mm is less than maximum_mm, in mm; rotation_xyzw is a quaternion";
        malformed(Place::file(path), format!("box {}: {what}", spec.name), advice)
    };
    let [low, high] = [spec.minimum_mm, spec.maximum_mm].map(|p| Vector3::from(p) * 1e-3);
    let half = (high - low) * 0.5;
    let [x, y, z, w] = spec.rotation_xyzw.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-6)
        .ok_or_else(|| wrong("its rotation is none".into()))?;
    let shape = Cuboid { middle: Isometry3::from_parts(((low + high) * 0.5).into(), turn), half };
    shape.check().map_err(|e| wrong(e.to_string()))?;
    Ok(shape)
}
