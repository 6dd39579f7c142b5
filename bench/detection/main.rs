//! Images of boards whose corners are known, and what `detect` finds in them; for
//! `bench/detection/run.py`, which sets other detectors beside it:
//!
//! ```text
//! cargo run --release -p handeye-bench --bin detection -- render FOLDER ACCURACY HARD EMPTY
//! cargo run --release -p handeye-bench --bin detection -- detect FOLDER
//! cargo run --release -p handeye-bench --bin detection -- search HARD EMPTY
//! ```
//!
//! The numbers are images per case. `render` writes PNG files and `truth.json`, the same bytes for
//! the same numbers; `detect` reads both and writes `handeye.json`. `search` draws and
//! looks at many images without writing them, and prints what was found.

mod detected;
mod pictures;
mod placing;
mod search;

use std::{env, path::Path, process::ExitCode};

fn main() -> ExitCode {
    let args: Vec<String> = env::args().skip(1).collect();
    let number = |k: usize| args.get(k).and_then(|a| a.parse().ok()).unwrap_or(1);
    if args.first().is_some_and(|a| a == "search") {
        println!("{}", search::search(number(1), number(2)));
        return ExitCode::SUCCESS;
    }
    match (args.first().map(String::as_str), args.get(1)) {
        (Some("render"), Some(folder)) => {
            pictures::render(Path::new(folder), number(2), number(3), number(4));
        }
        (Some("detect"), Some(folder)) => detected::detect(Path::new(folder)),
        _ => {
            eprintln!("render FOLDER ACCURACY HARD EMPTY | detect FOLDER | search HARD EMPTY");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
