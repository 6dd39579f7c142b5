//! Every closed form on pose sets from files, with the time of a call.
//!
//! `cargo run --release -p handeye-bench --bin closed_forms -- [--untimed] FILE...`
//!
//! A line of a file is one capture: rotation by rows and translation (m) of `anchor_from_mount`,
//! then of `camera_from_target`, 24 numbers. Printed per file and method, tab-separated: file,
//! method, microseconds of processor time per call (median of batches, zero if untimed), and the
//! rotation by rows and the translation of `mount_from_camera` — or `refused` and why.

use std::{env, fs, hint::black_box, time::Instant};

use handeye::{Method, Pose, PosePair, solve::solve};
use nalgebra::{Matrix3, Vector3};

/// Processor time of one batch, ns; the kernel counts in steps of up to 4 ms.
const BATCH: f64 = 3e7;
const BATCHES: usize = 7;

fn main() {
    let (flags, files): (Vec<_>, Vec<_>) = env::args().skip(1).partition(|a| a == "--untimed");
    for file in files {
        let text = fs::read_to_string(&file).expect("a readable file");
        let pairs: Vec<PosePair> = text.lines().map(pair).collect();
        for method in Method::ALL {
            match solve(&pairs, method) {
                Err(error) => println!("{file}\t{}\trefused\t{error}", method.name()),
                Ok(answer) => {
                    let x = answer.mount_from_camera;
                    let numbers: Vec<String> = x
                        .rotation()
                        .transpose()
                        .iter()
                        .chain(x.translation().iter())
                        .map(|v| format!("{v:.17e}"))
                        .collect();
                    let call = || solve(black_box(&pairs), method).is_ok();
                    let time = if flags.is_empty() { microseconds(call) } else { 0.0 };
                    println!("{file}\t{}\t{time:.3}\t{}", method.name(), numbers.join(" "));
                }
            }
        }
    }
}

fn pair(line: &str) -> PosePair {
    let n: Vec<f64> = line.split_whitespace().map(|x| x.parse().expect("a number")).collect();
    let rotation = |k: usize| Matrix3::from_row_slice(&n[k..k + 9]);
    let translation = |k: usize| Vector3::from_column_slice(&n[k..k + 3]);
    PosePair {
        anchor_from_mount: Pose::from_parts(&rotation(0), translation(9)),
        camera_from_target: Pose::from_parts(&rotation(12), translation(21)),
    }
}

/// Median processor time of a call.
fn microseconds(call: impl Fn() -> bool) -> f64 {
    let batch = |calls: usize| {
        let start = processor_time();
        for _ in 0..calls {
            black_box(call());
        }
        (processor_time() - start) / calls as f64
    };
    let started = Instant::now();
    let mut calls = 0;
    while started.elapsed().as_nanos() < 5_000_000 {
        black_box(call());
        calls += 1;
    }
    let calls = (calls as f64 * BATCH / 5e6).ceil() as usize;
    let mut all: Vec<f64> = (0..BATCHES).map(|_| batch(calls)).collect();
    all.sort_by(f64::total_cmp);
    all[BATCHES / 2] / 1e3
}

/// Nanoseconds this process has run; of the wall clock where the kernel does not tell.
fn processor_time() -> f64 {
    let told = fs::read_to_string("/proc/self/schedstat").ok();
    let first = told.as_deref().and_then(|t| t.split_whitespace().next());
    first.and_then(|n| n.parse().ok()).unwrap_or_else(|| {
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
        now.map_or(0.0, |d| d.as_nanos() as f64)
    })
}
