//! `handeye solve --method all`: published methods beside the likeliest answer, in a table.

use std::time::Instant;

use handeye::{Calibration, Camera, Config, Method, Mount, Pose, PosePair, Session, solve};
use handeye_io::{MeasuredPoses, PosesFile};
use serde::Serialize;

use crate::{
    difference::{Difference, difference},
    failure::Failure,
    output,
};

/// A method is run so many times; the median counts.
const RUNS: usize = 9;

/// What one method finds.
#[derive(Serialize)]
pub struct Row {
    method: &'static str,
    source: &'static str,
    equation: &'static str,
    mount_from_camera: Option<Pose<Mount, Camera>>,
    /// RMS error on captures that it has not seen.
    held_out_mm: Option<f64>,
    held_out_deg: Option<f64>,
    /// Predicted error (RMS) where the answer is used.
    predicted_tre_mm: Option<f64>,
    /// From the likeliest answer.
    difference: Option<Difference>,
    /// Median time of the method itself, on all pairs, in one thread.
    time_us: Option<f64>,
    /// Why it has no answer.
    failure: Option<String>,
}

/// All methods that are asked for, beside the likeliest answer.
#[derive(Serialize)]
pub struct Table {
    pub methods: Vec<Row>,
    /// The answer of `solve` without a method.
    pub answer: Calibration,
}

/// The methods of these names; `all` is all.
pub fn named(names: &[String]) -> Result<Vec<Method>, Failure> {
    if names.iter().any(|name| name == "all") {
        return Ok(Method::ALL.to_vec());
    }
    names.iter().map(|name| crate::solve::method(name)).collect()
}

/// Runs each method by itself.
pub fn compare(input: &PosesFile, methods: &[Method], config: &Config) -> Result<Table, Failure> {
    let MeasuredPoses::Pairs(session) = &input.measured else {
        let what = "several methods are compared on pairs; of two streams, name one method";
        return Err(Failure::Usage(what.into()));
    };
    let answer = input.calibrate(config)?;
    let pairs = pairs(session);
    let row = |&method: &Method| -> Result<Row, Failure> {
        let found = input.calibrate(&Config { method: Some(method), ..config.clone() })?;
        let mount_from_camera = found.hand_eye.mount_from_camera;
        let both = answer.hand_eye.mount_from_camera.zip(mount_from_camera);
        Ok(Row {
            method: method.name(),
            source: method.source(),
            equation: method.form().equation(),
            mount_from_camera,
            held_out_mm: found.held_out.translation_rms_mm,
            held_out_deg: found.held_out.rotation_rms_deg,
            predicted_tre_mm: found.predicted_tre_mm.as_ref().map(|tre| tre.rms),
            difference: both.map(|(a, b)| difference(&[], &a, &b)),
            time_us: time(&pairs, method),
            failure: mount_from_camera.is_none().then(|| found.reasons.join("; ")),
        })
    };
    let methods = methods.iter().map(row).collect::<Result<_, _>>()?;
    Ok(Table { methods, answer })
}

fn pairs(session: &Session) -> Vec<PosePair> {
    let pair = |o: &handeye::Observation| {
        let camera_from_target = o.candidates.first()?.camera_from_target;
        let anchor_from_mount = session.setup.anchor_from_mount(o.base_from_flange);
        Some(PosePair { anchor_from_mount, camera_from_target })
    };
    session.observations.iter().filter_map(pair).collect()
}

fn time(pairs: &[PosePair], method: Method) -> Option<f64> {
    let once = || {
        let began = Instant::now();
        solve::solve(pairs, method).ok()?;
        Some(began.elapsed().as_secs_f64() * 1e6)
    };
    let mut all = (0..RUNS).map(|_| once()).collect::<Option<Vec<f64>>>()?;
    all.sort_by(f64::total_cmp);
    Some(all[RUNS / 2])
}

/// Prints the table for people.
pub fn show(table: &Table) {
    let line = |cells: [&str; 6]| {
        let [name, held_out, degrees, tre, off, time] = cells;
        format!("  {name:<25}{held_out:>9}{degrees:>9}{tre:>11}{off:>12}{time:>9}\n")
    };
    let figure = |value: Option<f64>| value.map_or("-".into(), |v| format!("{v:.3}"));
    let mut text = "\n".to_owned()
        + &line(["method", "held out", "held out", "predicted", "from the", "time"])
        + &line(["", "mm", "degrees", "RMS, mm", "answer, mm", "us"]);
    for row in &table.methods {
        let off = row.difference.as_ref().map(|d| d.half_a_metre_before_camera_mm);
        let time = row.time_us.map_or("-".into(), |us| format!("{us:.0}"));
        let figures = [row.held_out_mm, row.held_out_deg, row.predicted_tre_mm, off].map(figure);
        let [held_out, degrees, tre, off] = figures.each_ref().map(String::as_str);
        text += &line([row.method, held_out, degrees, tre, off, &time]);
    }
    let about = "`held out`: error on captures that the method has not seen, one by one. `from the answer`: distance of a point \
                 half a metre before the camera from where the answer above puts it. `time`: the method alone.";
    output::print(&(text + "\n" + &output::wrapped("", about)));
    for row in &table.methods {
        if let Some(failure) = &row.failure {
            output::print(&output::wrapped(&format!("{}: ", row.method), failure));
        }
    }
}
