//! Processor time of the estimator, one thread, in process: medians of batches.
//!
//! `cargo run --release -p handeye-bench --bin speed -- [FILE]`; with a FILE, writes it between the
//! markers `speed` there as well.

#[allow(clippy::unwrap_used, dead_code, reason = "shared with tests")]
#[path = "../../crates/handeye/tests/all/problem/mod.rs"]
mod problem;
#[path = "../section.rs"]
mod section;

use std::{env, fs, hint::black_box};

use handeye::{
    Config, Pose, PosePair, Setup, TargetModel, calibrate,
    estimate::{
        KnownNoise,
        extra::{TIP_PRIOR, tip},
        fit_joint, fit_views,
    },
    math::random::Random,
    simulate::{Cell, CellNoise, DepthSensor},
    solve::{Method, View, solve},
};
use nalgebra::{Isometry3, Vector3, Vector6};

const HEAD: &str = "## Speed of the estimator

Processor time, one thread, in process, medians of batches. The machine's own speed is in the section
on closed forms, in the time that OpenCV's SHAH takes there.

";

fn line(table: &mut String, text: &str) {
    println!("{text}");
    *table += &format!("- {text}\n");
}

fn main() {
    let mut table = String::from(HEAD);
    for n in [15, 50, 200, 1000, 10_000] {
        let pairs = pairs(n);
        let start = solve(&pairs, Method::Shah).expect("well-posed");
        let views: Vec<View> = pairs.into_iter().map(View::bare).collect();
        let known = KnownNoise::default();
        let fit = || fit_views(black_box(&views), &start, &known, Setup::EyeInHand).is_ok();
        line(
            &mut table,
            &format!(
                "fit of {n} pose pairs, noise of six sources found: {:.3} ms",
                milliseconds(fit)
            ),
        );
    }
    for setup in [Setup::EyeToHand, Setup::EyeInHand] {
        for depth in [false, true] {
            let session = session(setup, depth);
            let problem = problem::problem(&session, &tip(TIP_PRIOR));
            let start = problem::start(&session, Method::Shah);
            let known = KnownNoise::default();
            let fit = || fit_joint(black_box(&problem), &start, &known).is_ok();
            line(
                &mut table,
                &format!(
                    "joint fit, {setup:?}, 20 captures of 88 corners, 12 touches, depth {depth}: {:.2} ms",
                    milliseconds(fit)
                ),
            );
            let run = || calibrate(black_box(&session), &Config::default()).is_ok();
            line(
                &mut table,
                &format!(
                    "calibrate, {setup:?}, 20 captures of 88 corners, 12 touches, depth {depth}, all \
                 candidates, with leave-one-out: {:.1} ms",
                    milliseconds(run)
                ),
            );
        }
    }
    if let Some(file) = env::args().nth(1) {
        section::write(file, "speed", &table);
    }
}

/// Noisy views of an eye-in-hand camera all around a target.
fn pairs(n: usize) -> Vec<PosePair> {
    let mut random = Random::new(5);
    let x = Isometry3::new(Vector3::new(0.05, 0.02, 0.1), Vector3::new(0.1, -0.2, 1.5));
    let y = Isometry3::new(Vector3::new(0.6, 0.1, 0.0), Vector3::new(0.0, 0.0, 0.4));
    let one = |_| {
        let seen = Isometry3::new(random.normal3() * 0.05 + Vector3::z(), random.normal3() * 0.4);
        let noise = |r: &mut Random, w: f64, t: f64| {
            let (w, t) = (r.normal3() * w, r.normal3() * t);
            Vector6::new(w.x, w.y, w.z, t.x, t.y, t.z)
        };
        let robot = Pose::claim(y * seen.inverse() * x.inverse());
        PosePair {
            anchor_from_mount: robot.retract(&noise(&mut random, 5e-4, 3e-4)),
            camera_from_target: Pose::claim(seen).retract(&noise(&mut random, 1e-3, 2e-4)),
        }
    };
    (0..n).map(one).collect()
}

fn session(setup: Setup, depth: bool) -> handeye::Session {
    let cell = Cell {
        target: TargetModel::Checkerboard { columns: 11, rows: 8, square_mm: 25.0 },
        captures: 20,
        touches: if setup == Setup::EyeToHand { 6 } else { 12 },
        placements: if setup == Setup::EyeToHand { 2 } else { 0 },
        depth: depth.then(DepthSensor::default),
        noise: CellNoise::default(),
        ..Cell::new(setup, 3)
    };
    cell.session(4).expect("a cell").0
}

/// Processor time, ns; the kernel counts in steps of up to 4 ms.
fn processor_ns() -> f64 {
    let text = fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse().ok()).unwrap_or(0.0)
}

fn milliseconds(mut call: impl FnMut() -> bool) -> f64 {
    let mut all: Vec<f64> = (0..7)
        .map(|_| {
            let (start, mut calls) = (processor_ns(), 0.0);
            while processor_ns() - start < 6e7 {
                black_box(call());
                calls += 1.0;
            }
            (processor_ns() - start) / calls / 1e6
        })
        .collect();
    all.sort_by(f64::total_cmp);
    all[3]
}
