//! From how far off a registration still finds its way, and whether it knows when it did not.

use std::collections::BTreeMap;

use handeye::{
    Scan, Verdict,
    math::{lie, random::Random},
    register::{Dense, DenseConfig, register},
    simulate::Room,
};
use nalgebra::{Isometry3, Point3, Vector3};
use serde_json::{Value, json};

use crate::scenes::{self, DISTANCE_M, Order, Pair};

const SIZE: (u32, u32) = (240, 180);
/// The first scene; the scenes are others than those that are timed.
const FIRST_SEED: u64 = 1000;
/// How far off the start is about the middle of the scene, degrees and mm.
const STARTS: [(f64, f64); 5] = [(0.0, 0.0), (1.0, 5.0), (3.0, 10.0), (5.0, 20.0), (10.0, 30.0)];
/// How far views are from straight above, m, and turned, rad.
const ASIDE_M: f64 = 0.15;
const TILT: f64 = 0.2;
const TURN: f64 = 0.3;
/// Without a start, the second view is turned about the line of sight by up to this.
const FREE_TURN_DEG: f64 = 170.0;
/// More is wrong: degrees, and m at the middle of the scene.
const WRONG_DEG: f64 = 0.3;
const WRONG_M: f64 = 1.5e-3;

/// Words that tell one reason from another.
const WORDS: usize = 6;

#[derive(Default)]
struct Tally {
    right: usize,
    refused: usize,
    wrong: usize,
    /// Squared error over the stated covariance, over 6, of all accepted answers.
    normalised: Vec<f64>,
    /// How often each first reason was given.
    reasons: BTreeMap<String, usize>,
}

/// All starts, and none, with organised scans and clouds.
pub fn basin(count: u64) -> Value {
    let orders = [("organised", Order::Organised), ("cloud", Order::Rows)];
    let mut rows = vec![];
    for (name, order) in orders {
        for (turn_deg, shift_mm) in STARTS {
            let tally = tally(count, order, Some((turn_deg, 1e-3 * shift_mm)));
            rows.push(row(name, json!([turn_deg, shift_mm]), &tally));
        }
        rows.push(row(name, Value::Null, &tally(count, order, None)));
    }
    rows.into()
}

fn row(order: &str, start: Value, tally: &Tally) -> Value {
    let count = tally.normalised.len().max(1) as f64;
    json!({
        "order": order,
        "start": start,
        "right": tally.right,
        "refused": tally.refused,
        "wrong": tally.wrong,
        "reasons": tally.reasons,
        "normalised": tally.normalised.iter().sum::<f64>() / count,
    })
}

fn tally(count: u64, order: Order, off: Option<(f64, f64)>) -> Tally {
    let mut tally = Tally::default();
    for seed in FIRST_SEED..FIRST_SEED + count {
        let mut random = Random::new(seed);
        let pair = pair(off.is_none(), &mut random);
        let (turn_deg, shift_m) = off.unwrap_or_default();
        let start = match off {
            Some(_) => scenes::start_near(&pair.target_from_source, turn_deg, shift_m, &mut random),
            None => Isometry3::identity(),
        };
        let config = DenseConfig { global: off.is_none(), ..DenseConfig::default() };
        let scan = |scan: &Scan| scenes::cloud(scan, order);
        let found = register(&scan(&pair.source), &scan(&pair.target), &start, &config).ok();
        tally.add(found, &pair.target_from_source);
    }
    tally
}

fn pair(turned: bool, random: &mut Random) -> Pair {
    let room = Room::of_a_cell(random);
    let view = |random: &mut Random| {
        let mut some = |most: f64| random.between(-most, most);
        let aside = [some(ASIDE_M), some(ASIDE_M)];
        scenes::camera_above(aside[0], aside[1], [some(TILT), some(TILT), some(TURN)])
    };
    let (source, mut target) = (view(random), view(random));
    if turned {
        let turn = random.between(-FREE_TURN_DEG, FREE_TURN_DEG).to_radians();
        target *= Isometry3::rotation(Vector3::z() * turn);
    }
    scenes::scans(&room, SIZE, &source, &target, random)
}

impl Tally {
    fn refuse(&mut self, reason: &str) {
        self.refused += 1;
        let told = reason.split(' ').filter(|word| !word.contains(|c: char| c.is_ascii_digit()));
        let kind: Vec<&str> = told.take(WORDS).collect();
        *self.reasons.entry(kind.join(" ")).or_default() += 1;
    }

    fn add(&mut self, found: Option<Dense>, truth: &Isometry3<f64>) {
        let Some(found) = found else {
            self.refuse("a scan shows no surface");
            return;
        };
        if found.verdict != Verdict::Accepted {
            self.refuse(found.reasons.first().map_or("", String::as_str));
            return;
        }
        let error = lie::log(&truth.inv_mul(&found.target_from_source));
        let middle = Point3::new(0.0, 0.0, DISTANCE_M);
        let off = (truth * middle - found.target_from_source * middle).norm();
        let right = lie::omega(&error).norm().to_degrees() < WRONG_DEG && off < WRONG_M;
        *if right { &mut self.right } else { &mut self.wrong } += 1;
        let inverse = found.covariance.and_then(|c| c.try_inverse());
        self.normalised.extend(inverse.map(|i| error.dot(&(i * error)) / 6.0));
    }
}
