//! `handeye solve`: pose pairs in, answer out.

use std::{collections::HashSet, fs, path::Path};

use handeye::{
    Base, Calibration, Camera, Config, Flange, Method, Observation, Pose, Session, Setup, Target,
    TargetPose, calibrate,
};
use serde::Deserialize;

use crate::{
    args::{Manners, SolveArgs},
    failure::Failure,
    output,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pairs {
    setup: Setup,
    pairs: Vec<Pair>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pair {
    #[serde(default)]
    id: Option<String>,
    base_from_flange: Pose<Base, Flange>,
    camera_from_target: Pose<Camera, Target>,
}

pub fn run(args: &SolveArgs, manners: &Manners) -> Result<u8, Failure> {
    let method = args.method.as_deref().map(method).transpose()?;
    let session = session(read(&args.pairs)?, &args.pairs)?;
    let calibration = calibrate(&session, &Config { method, ..Config::default() })?;
    show(&calibration, manners);
    Ok(calibration.exit_code())
}

fn show(calibration: &Calibration, manners: &Manners) {
    if manners.json {
        output::json(calibration);
    } else {
        output::warnings(calibration, manners);
        output::summary(calibration);
    }
}

/// The published method of that name.
pub fn method(name: &str) -> Result<Method, Failure> {
    Method::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Method::ALL.iter().map(|m| m.name()).collect();
        Failure::Usage(format!("no method {name:?}; there are {}", known.join(", ")))
    })
}

fn read(path: &Path) -> Result<Pairs, Failure> {
    let text = fs::read_to_string(path).map_err(|e| Failure::input(path.display(), e))?;
    serde_json::from_str(&text).map_err(|e| Failure::input(path.display(), e))
}

fn session(pairs: Pairs, path: &Path) -> Result<Session, Failure> {
    let mut seen = HashSet::new();
    let mut observations = Vec::new();
    for (k, pair) in pairs.pairs.into_iter().enumerate() {
        let capture = pair.id.unwrap_or_else(|| (k + 1).to_string());
        if !seen.insert(capture.clone()) {
            let what = format!("pair {}: the id {capture:?} is there twice", k + 1);
            return Err(Failure::input(path.display(), what));
        }
        observations.push(Observation {
            capture,
            base_from_flange: pair.base_from_flange,
            corners: vec![],
            surface: vec![],
            candidates: vec![TargetPose {
                camera_from_target: pair.camera_from_target,
                covariance: None,
            }],
        });
    }
    Ok(Session {
        setup: pairs.setup,
        target: None,
        camera: None,
        observations,
        placements: vec![],
        touches: vec![],
        correspondences: vec![],
        workspace: None,
    })
}
