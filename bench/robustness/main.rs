//! The whole calibration on sessions that are spoilt in known ways, against the answer of the
//! captures that were left as they are.
//!
//! `cargo run --release -p handeye-bench --bin robustness -- [SESSIONS] [FILE] [FIRST SEED]`
//!
//! Prints a table; with a FILE, writes it between the markers `robustness` there. Seeds of failures
//! go to the standard error output.

#[path = "../section.rs"]
mod section;

use std::env;

use handeye::{Verdict, simulate::Mistake};

mod trial;
use trial::{AS_GOOD, Outcome, trial, whole_file};

/// One session whose order is wrong throughout for so many others.
const WHOLE_FILES: u64 = 10;

const HEAD: &str = "## Wrong captures among right ones

Simulated sessions of 8 to 20 captures in both setups, half of them with touches, a quarter with
scans, with robots that err by 0.1, 0.5 or 1.5 mm; up to 40 % of the captures are spoilt: by one
kind of mistake, or by all kinds mixed. The oracle is the same
calibration, given only the captures that were left as they are.

- *solved*: accepted, with an error below 1.2 times the oracle's (or the oracle has no answer
  either); *silently wrong*: accepted, with an error above three times the stated one (95 %) and
  above 1 mm.
- *found*: spoilt captures that were left out; *named*: spoilt captures whose reason says what
  happened; *clean left out*: right captures that were rejected.
";

fn main() {
    let args: Vec<String> = env::args().skip(1).collect();
    let number = |k: usize, or: u64| args.get(k).and_then(|a| a.parse().ok()).unwrap_or(or);
    let (count, first) = (number(0, 100), number(2, 0));
    let outcomes: Vec<Outcome> = (first..first + count).filter_map(watched).collect();
    let table = [HEAD.into(), sessions(&outcomes), captures(&outcomes), whole(count / WHOLE_FILES)];
    let text = table.join("\n");
    match args.get(1).filter(|a| !a.is_empty()) {
        Some(file) => section::write(file, "robustness", &text),
        None => print!("{text}"),
    }
}

fn watched(seed: u64) -> Option<Outcome> {
    let outcome = trial(seed)?;
    let clean_left_out = outcome.wronged();
    if outcome.silent || !outcome.solved() || clean_left_out > 0 {
        let kinds: Vec<String> = outcome.spoilt.iter().map(|(i, k)| format!("{i} {k:?}")).collect();
        eprintln!(
            "seed {seed}: {:?}, {} captures, error {:?} oracle {:?}{}, rejected {:?}, clean left \
             out {clean_left_out}, spoilt [{}], {:?}",
            outcome.result.verdict,
            outcome.captures,
            outcome.error,
            outcome.oracle,
            if outcome.silent { " SILENTLY WRONG" } else { "" },
            outcome.result.rejected,
            kinds.join(", "),
            outcome.result.reasons
        );
    }
    Some(outcome)
}

/// Sessions by what was wrong with them.
fn sessions(all: &[Outcome]) -> String {
    let mut table = String::from(
        "| sessions with | count | solved | refused | silently wrong | error / oracle, median | rms \
         | largest |\n|---|---|---|---|---|---|---|---|\n",
    );
    let only = |o: &&Outcome, kind: Mistake| {
        !o.spoilt.is_empty() && o.spoilt.iter().all(|(_, k)| *k == kind)
    };
    let mixed = |o: &&Outcome| {
        let first = o.spoilt.first().map(|s| s.1);
        o.spoilt.iter().any(|(_, k)| Some(*k) != first)
    };
    table += &row("nothing wrong", all.iter().filter(|o| o.spoilt.is_empty()).collect());
    for kind in Mistake::ALL {
        table += &row(kind.name(), all.iter().filter(|o| only(o, kind)).collect());
    }
    table += &row("several kinds", all.iter().filter(mixed).collect());
    table + &row("**all**", all.iter().collect())
}

fn row(name: &str, some: Vec<&Outcome>) -> String {
    let mut ratios: Vec<f64> = some.iter().filter_map(|o| o.ratio()).collect();
    ratios.sort_by(f64::total_cmp);
    let n = ratios.len().max(1) as f64;
    let rms = (ratios.iter().map(|r| r * r).sum::<f64>() / n).sqrt();
    let at = |k: usize| ratios.get(k).copied().unwrap_or(f64::NAN);
    let solved = some.iter().filter(|o| o.solved()).count();
    let refused = some.iter().filter(|o| o.error.is_none() && o.oracle.is_some()).count();
    format!(
        "| {name} | {} | {solved} ({:.1} %) | {refused} | {} | {:.3} | {rms:.3} | {:.2} |\n",
        some.len(),
        100.0 * solved as f64 / some.len().max(1) as f64,
        some.iter().filter(|o| o.silent).count(),
        at(ratios.len() / 2),
        at(ratios.len().saturating_sub(1))
    )
}

/// Captures by what was wrong with them.
fn captures(all: &[Outcome]) -> String {
    let mut table = String::from("| captures | count | found | named |\n|---|---|---|---|\n");
    for kind in Mistake::ALL {
        let sum = |f: &dyn Fn(&Outcome) -> usize| all.iter().map(f).sum::<usize>();
        let (count, missed) = (sum(&|o| o.of(kind).count()), sum(&|o| o.missed(kind)));
        let named = sum(&|o| o.named(kind));
        let share = |n: usize| 100.0 * n as f64 / count.max(1) as f64;
        table += &format!(
            "| {} | {count} | {:.1} % | {:.1} % |\n",
            kind.name(),
            share(count - missed),
            share(named)
        );
    }
    let accepted = || all.iter().filter(|o| o.error.is_some());
    let clean: usize = accepted().map(|o| o.captures - o.spoilt.len()).sum();
    let wronged: usize = accepted().map(Outcome::wronged).sum();
    let share = 100.0 * wronged as f64 / clean.max(1) as f64;
    table += &format!(
        "\nClean captures left out of accepted answers: {wronged} of {clean} ({share:.2} %).\n"
    );
    let close = all.iter().filter(|o| o.ratio().is_some_and(|r| r < AS_GOOD)).count();
    table
        + &format!(
            "Of {} sessions, {close} are within {AS_GOOD} times the oracle's error.\n",
            all.len()
        )
}

/// Sessions whose order is wrong throughout.
fn whole(count: u64) -> String {
    let all: Vec<_> = (0..count).filter_map(|seed| Some((seed, whole_file(seed)?))).collect();
    let named = |r: &handeye::Calibration| r.warnings.iter().any(|w| w.code == "order-shifted");
    for (seed, r) in all.iter().filter(|(_, r)| r.verdict == Verdict::Accepted || !named(r)) {
        eprintln!("whole file, seed {seed}: {:?} {:?} {:?}", r.verdict, r.reasons, r.warnings);
    }
    format!(
        "Of {} sessions whose robot poses are all one off, or reversed, {} were accepted; {} name the \
         order.\n",
        all.len(),
        all.iter().filter(|(_, r)| r.verdict == Verdict::Accepted).count(),
        all.iter().filter(|(_, r)| named(r)).count()
    )
}
