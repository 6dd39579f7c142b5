//! Registration of rendered scenes: answers, processor time, threads, memory.

use std::{path::Path, time::Instant};

use handeye::register::{Dense, DenseConfig, register};
use nalgebra::Isometry3;
use serde_json::{Map, Value, json};

use crate::{
    clock,
    scenes::{self, Order, Pair},
};

const ORDERS: [(&str, Order); 3] =
    [("organised", Order::Organised), ("cloud", Order::Rows), ("shuffled", Order::Shuffled)];
/// Pairs of runs, with one thread and with two; the fastest of each counts.
const RUNS: usize = 9;

fn registered(pair: &Pair, start: &Isometry3<f64>, threads: usize) -> Dense {
    let config = DenseConfig { threads, ..DenseConfig::default() };
    register(&pair.source, &pair.target, start, &config).expect("scans that show a surface")
}

fn answer(found: &Dense) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("transform".into(), json!(scenes::rows(&found.target_from_source)));
    map.insert("verdict".into(), json!(found.verdict));
    map
}

/// Every order of the points: the answer, and processor time on one thread.
pub fn register_all(folder: &Path, name: &str) -> Value {
    let one = |(label, order): (&str, Order)| {
        let (pair, start) = scenes::load(folder, name, order);
        let mut measured = answer(&registered(&pair, &start, 1));
        measured.insert("ms".into(), json!(clock::milliseconds(|| registered(&pair, &start, 1))));
        (label.to_string(), Value::Object(measured))
    };
    ORDERS.into_iter().map(one).collect::<Map<_, _>>().into()
}

/// One thread and two in turn: the least wall time of each, and whether every bit of the answers is the same.
pub fn threads(folder: &Path, name: &str) -> Value {
    let one = |(label, order): (&str, Order)| {
        let (pair, start) = scenes::load(folder, name, order);
        let mut least = [f64::INFINITY; 2];
        for run in 0..2 * RUNS {
            let begun = Instant::now();
            std::hint::black_box(registered(&pair, &start, run % 2 + 1));
            least[run % 2] = least[run % 2].min(1e3 * begun.elapsed().as_secs_f64());
        }
        let same = bits(&registered(&pair, &start, 1)) == bits(&registered(&pair, &start, 2));
        (label.to_string(), json!({ "one": least[0], "two": least[1], "same": same }))
    };
    ORDERS.into_iter().map(one).collect::<Map<_, _>>().into()
}

/// All numbers of an answer.
fn bits(found: &Dense) -> Vec<u64> {
    let covariance = found.covariance.iter().flat_map(|c| c.iter().copied());
    let rest = [found.inlier_fraction, found.agreement, found.rms_m, found.sigma];
    let size = found.size.map_or([0.0; 2], |size| [size.ratio, size.sigma]);
    let pose = scenes::rows(&found.target_from_source);
    pose.into_iter().chain(covariance).chain(rest).chain(size).map(f64::to_bits).collect()
}

/// A pair of clouds, once: the answer, and the most memory that the process held.
pub fn memory(folder: &Path, name: &str) -> Value {
    let (pair, start) = scenes::load(folder, name, Order::Rows);
    let (_, before) = clock::resident();
    let begun = Instant::now();
    let mut measured = answer(&registered(&pair, &start, 1));
    measured.insert("seconds".into(), json!(begun.elapsed().as_secs_f64()));
    measured.insert("points".into(), json!([pair.source.width(), pair.target.width()]));
    measured.insert("before".into(), json!(before));
    measured.insert("peak".into(), json!(clock::resident().0));
    measured.into()
}
