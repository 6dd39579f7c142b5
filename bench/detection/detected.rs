//! What `detect` finds, and its processor time.

use std::{fs, hint::black_box, path::Path};

use handeye::{ImageCorner, TargetModel, detect::detect as find};
use handeye_io::read_image;
use serde_json::{Map, Value, json};

/// An image is looked at again until so much time went by, ns, or so often.
const LONG_ENOUGH: f64 = 8e7;
const MOST_CALLS: usize = 40;

/// Reads `truth.json`, writes `handeye.json`.
pub fn detect(folder: &Path) {
    let text = fs::read_to_string(folder.join("truth.json")).expect("a rendered folder");
    let truths: Vec<Value> = serde_json::from_str(&text).expect("a truth as render writes it");
    let all: Map<String, Value> = truths.iter().filter_map(|truth| one(folder, truth)).collect();
    let text = serde_json::to_string(&all).expect("finite numbers");
    fs::write(folder.join("handeye.json"), text).expect("space for the result");
}

fn one(folder: &Path, truth: &Value) -> Option<(String, Value)> {
    let file = truth["file"].as_str()?;
    let target: TargetModel = serde_json::from_value(truth["target"].clone()).ok()?;
    let image = read_image(&folder.join(file), None).expect("a picture as render writes it");
    let found = find(&image, &target);
    let ms = milliseconds(|| drop(black_box(find(black_box(&image), &target))));
    let corner = |c: &ImageCorner| {
        let s = c.covariance;
        json!([c.id, c.pixel.x, c.pixel.y, s[(0, 0)], s[(0, 1)], s[(1, 1)]])
    };
    let (corners, refusal) = match found {
        Ok(corners) => (corners.iter().map(corner).collect(), None),
        Err(reason) => (vec![], Some(reason.to_string())),
    };
    Some((file.into(), json!({ "corners": corners, "ms": ms, "refusal": refusal })))
}

/// Processor time of a call; the kernel counts in steps of up to 4 ms.
fn milliseconds(call: impl Fn()) -> f64 {
    let (start, mut calls) = (processor_ns(), 0);
    while calls == 0 || (processor_ns() - start < LONG_ENOUGH && calls < MOST_CALLS) {
        call();
        calls += 1;
    }
    (processor_ns() - start) / calls as f64 / 1e6
}

/// Processor time of this thread, the only one, ns.
fn processor_ns() -> f64 {
    let text = fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse().ok()).unwrap_or(0.0)
}
