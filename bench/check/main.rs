//! Measures `handeye check` on simulated mistakes and writes the table into BENCHMARK.md:
//!
//! ```text
//! cargo run --release -p handeye-bench --bin check [-- CASES CLEAN]
//! ```

mod cases;
#[path = "../section.rs"]
mod section;

use std::{env, fmt::Write as _, fs, path::Path, thread};

use cases::{MISTAKES, Mistake, Row, Tellable, row};

/// Cases over all mistakes, and cases with none.
const USUAL: (u64, u64) = (2000, 1000);
const HEAD: &str = "## `handeye check`

Simulated cells with one mistake each, 4 to 15 captures, both setups, corners or board poses, robot
0.5 mm and 0.03 degrees, corners 0.1 px; written as files, read and checked as a user's.
`cargo run --release -p handeye-bench --bin check` makes this table.

";

fn main() {
    let number = |k: usize| env::args().nth(k).and_then(|a| a.parse().ok());
    let (cases, clean) = (number(1).unwrap_or(USUAL.0), number(2).unwrap_or(USUAL.1));
    let each = cases.div_ceil(MISTAKES.len() as u64);
    let root = env::temp_dir().join(format!("handeye-check-{}", std::process::id()));
    let work: Vec<(Mistake, u64)> =
        MISTAKES.iter().map(|m| (*m, each)).chain([(Mistake::None, clean)]).collect();
    let rows: Vec<(Mistake, Row)> = thread::scope(|scope| {
        // two halves: files are written beside computing
        let half = |odd: usize| {
            let (work, root) = (&work, &root);
            move || -> Vec<(usize, Row)> {
                let mine = work.iter().enumerate().filter(|(k, _)| k % 2 == odd);
                mine.map(|(k, (m, n))| {
                    let answered = row(*m, *n, &root.join(odd.to_string()));
                    eprintln!("{:<44} {answered:?}", m.name());
                    (k, answered)
                })
                .collect()
            }
        };
        let (a, b) = (scope.spawn(half(0)), scope.spawn(half(1)));
        let mut all = [a, b].map(|t| t.join().expect("a half of the cases")).concat();
        all.sort_by_key(|(k, _)| *k);
        all.into_iter().map(|(k, r)| (work[k].0, r)).collect()
    });
    fs::remove_dir_all(&root).ok();
    let text = table(&rows);
    print!("{text}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../BENCHMARK.md");
    section::write(path, "check", &format!("{HEAD}{text}"));
}

fn table(rows: &[(Mistake, Row)]) -> String {
    let mut text = String::from(
        "| mistake | what data can tell | right | too few captures, or no trace | nothing wrong claimed |\n\
         |---|---|---|---|---|\n",
    );
    let (mut all, mut right) = (0, 0);
    let share = |(all, good): (usize, usize)| match all {
        0 => ("".into(), "".into()),
        _ => (all.to_string(), format!("{good} of {all}")),
    };
    for (mistake, row) in rows.iter().filter(|(m, _)| *m != Mistake::None) {
        let told = match mistake.tellable(cases::CAPTURES.1) {
            Tellable::Alone => "alone",
            Tellable::AmongOthers => "among others that fit alike",
            Tellable::Nothing => "nothing",
        };
        let ((_, good), (few, quiet)) = (share(row.tellable), share(row.untellable));
        let _ = writeln!(text, "| {} | {told} | {good} | {few} | {quiet} |", mistake.name());
        all += row.tellable.0;
        right += row.tellable.1;
    }
    let percent = 100.0 * right as f64 / all.max(1) as f64;
    let _ = writeln!(text, "\nRight explanation first: {right} of {all} ({percent:.1} %).");
    for (_, row) in rows.iter().filter(|(m, _)| *m == Mistake::None) {
        let (clean, quiet) = row.untellable;
        let _ = writeln!(text, "False alarms: {} in {clean} clean datasets.", clean - quiet);
    }
    text
}
