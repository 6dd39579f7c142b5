//! `handeye solve`: pose pairs in, answer out.

use std::{collections::HashSet, fs, path::Path};

use handeye::{
    Base, Calibration, Camera, Config, Flange, Method, Observation, Pose, Session, Setup, Target,
    TargetPose, calibrate,
};
use serde::Deserialize;
use serde_json::Value;

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
    let text = fs::read_to_string(path).map_err(|e| Failure::unreadable(path, &e))?;
    serde_json::from_str(&text).map_err(|e| {
        let Some((number, id)) = broken_pair(&text, &e) else {
            return Failure::in_json(path, &e, "");
        };
        let named = id.as_ref().map_or(String::new(), |id| format!(" ({id:?})"));
        let failure = Failure::in_json(path, &e, &format!("pair {number}{named}: "));
        failure.with_capture(&id.unwrap_or(number.to_string()))
    })
}

/// Number and id of the pair that an error of the whole file comes from.
fn broken_pair(text: &str, error: &serde_json::Error) -> Option<(usize, Option<String>)> {
    let whole: Value = serde_json::from_str(text).ok()?;
    let pairs = whole.get("pairs")?.as_array()?;
    let broken = |pair: &Value| Pair::deserialize(pair).err();
    let (k, own) = pairs.iter().enumerate().find_map(|(k, pair)| Some((k, broken(pair)?)))?;
    let id = pairs[k].get("id").and_then(Value::as_str).map(String::from);
    error.to_string().starts_with(&own.to_string()).then_some((k + 1, id))
}

fn session(pairs: Pairs, path: &Path) -> Result<Session, Failure> {
    let mut seen = HashSet::new();
    let mut observations = Vec::new();
    for (k, pair) in pairs.pairs.into_iter().enumerate() {
        let capture = pair.id.unwrap_or_else(|| (k + 1).to_string());
        if !seen.insert(capture.clone()) {
            let what = format!("pair {}: the id {capture:?} is there twice", k + 1);
            return Err(Failure::input(path, what).with_capture(&capture));
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
        camera_from_views: false,
        known_position: None,
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
