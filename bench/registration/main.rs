//! Registration of scans whose motion is known, for `bench/registration/run.py`, which sets other programs
//! beside it:
//!
//! ```text
//! cargo run --release -p handeye-bench --bin registration -- render FOLDER WIDTH HEIGHT SCENES
//! cargo run --release -p handeye-bench --bin registration -- register FOLDER SCENE
//! cargo run --release -p handeye-bench --bin registration -- threads FOLDER SCENE
//! cargo run --release -p handeye-bench --bin registration -- memory FOLDER SCENE
//! cargo run --release -p handeye-bench --bin registration -- trees FOLDER SCENE
//! cargo run --release -p handeye-bench --bin registration -- pairs
//! cargo run --release -p handeye-bench --bin registration -- basin SCENES
//! ```
//!
//! `render` writes scans and what is known of them, the same bytes for the same numbers; all others print
//! what they measured, as JSON.

mod basin;
mod clock;
mod pairs;
mod scenes;
mod speed;
mod trees;

use std::{env, path::Path, process::ExitCode};

fn main() -> ExitCode {
    let args: Vec<String> = env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let number = |text: &str| text.parse().unwrap_or(1);
    let measured = match args[..] {
        ["render", folder, width, height, count] => {
            let size = (number(width), number(height));
            (0..u64::from(number(count)))
                .for_each(|seed| scenes::render(Path::new(folder), size, seed));
            return ExitCode::SUCCESS;
        }
        ["register", folder, scene] => speed::register_all(Path::new(folder), scene),
        ["threads", folder, scene] => speed::threads(Path::new(folder), scene),
        ["memory", folder, scene] => speed::memory(Path::new(folder), scene),
        ["trees", folder, scene] => trees::trees(Path::new(folder), scene),
        ["pairs"] => pairs::pairs(),
        ["basin", count] => basin::basin(u64::from(number(count))),
        _ => {
            eprintln!(
                "render FOLDER WIDTH HEIGHT SCENES | register|threads|memory|trees FOLDER SCENE | pairs | \
                 basin SCENES"
            );
            return ExitCode::FAILURE;
        }
    };
    println!("{measured}");
    ExitCode::SUCCESS
}
