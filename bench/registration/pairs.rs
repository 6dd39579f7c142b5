//! The rigid fit of point pairs, beside the time that it takes to read them.

use handeye::{math::random::Random, register::rigid_fit};
use nalgebra::Vector3;
use serde_json::{Value, json};

use crate::clock;

const FEW: usize = 12;
const MANY: usize = 1_000_000;
/// Fits of few pairs in one measurement, each of other pairs.
const FITS: usize = 10_000;
const NOISE_M: f64 = 1e-3;
/// Numbers added side by side when reading, so that no addition waits for the one before.
const LANES: usize = 12;
const ROUNDS: usize = 9;

/// Medians of some rounds.
pub fn pairs() -> Value {
    let mut random = Random::new(1);
    let source: Vec<Vector3<f64>> = (0..MANY).map(|_| random.normal3()).collect();
    let target: Vec<Vector3<f64>> = source.iter().map(|p| p + random.normal3() * NOISE_M).collect();
    let few = || -> f64 {
        let some = source.windows(FEW).zip(target.windows(FEW)).take(FITS);
        some.map(|(p, q)| rigid_fit(p, q).expect("points in all directions").rms_m).sum()
    };
    let (mut small, mut large, mut reading) = (vec![], vec![], vec![]);
    for _ in 0..ROUNDS {
        reading.push(clock::milliseconds(|| sum(&source, &target)));
        large.push(clock::milliseconds(|| rigid_fit(&source, &target)));
        small.push(1e6 * clock::milliseconds(few) / FITS as f64);
    }
    json!({
        "few": FEW,
        "few_ns": median(small),
        "many": MANY,
        "many_ms": median(large),
        "reading_ms": median(reading),
    })
}

/// All coordinates once, as fast as they come out of memory.
fn sum(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> f64 {
    let mut sums = [0.0; LANES];
    for (p, q) in source.chunks_exact(LANES / 3).zip(target.chunks_exact(LANES / 3)) {
        for k in 0..LANES {
            sums[k] += p[k / 3][k % 3] + q[k / 3][k % 3];
        }
    }
    sums.iter().sum()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
