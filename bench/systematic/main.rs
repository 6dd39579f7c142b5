//! Errors that all captures share: a board of another size, a lens that is nearly right, scans in another frame,
//! things that move. Each row is a kind of error of one size; its cells are simulated with known truth, calibrated
//! as a user would, and judged by the error that the answer really has against the one that it states.

mod cell;
mod faults;

use std::{env, process::ExitCode};

use cell::{Kind, Outcome, run};
use faults::Fault;
use handeye::Setup;

/// An accepted answer is silently wrong where its true error exceeds the stated one by this factor.
const SILENT: f64 = 1.5;

/// One row: a fault in one kind of cell.
struct Row {
    fault: Fault,
    kind: Kind,
    outcomes: Vec<Outcome>,
}

fn main() -> ExitCode {
    let mut arguments = env::args().skip(1);
    let group = arguments.next().unwrap_or_else(|| "size".into());
    let seeds: u64 = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(10);
    let first: u64 = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(1);
    let Some(faults) = faults::group(&group) else {
        eprintln!("unknown group {group}: {}", faults::GROUPS.join(", "));
        return ExitCode::from(2);
    };
    println!("{}", HEAD);
    let mut all = vec![];
    for kind in kinds() {
        for fault in faults.iter().filter(|f| f.concerns(kind.scans)) {
            let outcomes = in_parallel(*fault, kind, first..first + seeds);
            let row = Row { fault: *fault, kind, outcomes };
            println!("{}", row.text());
            all.push(row);
        }
    }
    println!("{}", summary(&all));
    ExitCode::SUCCESS
}

const HEAD: &str = "fault                     cell                    acc  within  silent worst  true/mm stated/mm  size-found";

fn kinds() -> Vec<Kind> {
    let only = env::var("KIND").unwrap_or_default();
    let mut all = vec![];
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for touches in [0, 6, 12] {
            for scans in [false, true] {
                all.push(Kind { setup, touches, scans });
            }
        }
    }
    all.retain(|k| k.name().contains(&only));
    all
}

/// The cells of some seeds, on two processors.
fn in_parallel(fault: Fault, kind: Kind, seeds: std::ops::Range<u64>) -> Vec<Outcome> {
    let seeds: Vec<u64> = seeds.collect();
    let (low, high) = seeds.split_at(seeds.len() / 2);
    let of = |part: &[u64]| part.iter().filter_map(|s| run(&fault, kind, *s)).collect::<Vec<_>>();
    std::thread::scope(|scope| {
        let other = scope.spawn(|| of(high));
        let mut all = of(low);
        all.extend(other.join().unwrap_or_default());
        all
    })
}

impl Row {
    fn text(&self) -> String {
        let accepted: Vec<&Outcome> = self.outcomes.iter().filter(|o| o.accepted).collect();
        let ratio = |o: &&Outcome| o.true_mm / o.stated_mm;
        let within =
            100.0 * accepted.iter().map(|o| o.within).sum::<f64>() / accepted.len().max(1) as f64;
        let silent = accepted.iter().filter(|o| ratio(o) > SILENT).count();
        let worst = accepted.iter().map(ratio).fold(0.0, f64::max);
        let of = |f: fn(&Outcome) -> f64| median(accepted.iter().map(|o| f(o)).collect());
        let every = |f: fn(&Outcome) -> f64| median(self.outcomes.iter().map(f).collect());
        format!(
            "{:<25} {:<22} {:>2}/{:<2} {:>5.1} % {:>5} {:>6.2} {:>8.2} {:>8.2}  {:.5} +- {:.5}",
            self.fault.name(),
            self.kind.name(),
            accepted.len(),
            self.outcomes.len(),
            within,
            silent,
            worst,
            of(|o| o.true_mm),
            of(|o| o.stated_mm),
            every(|o| o.size.0),
            every(|o| o.size.1),
        )
    }
}

fn summary(rows: &[Row]) -> String {
    let of = |name: &str, clean: bool| {
        let rows = rows.iter().filter(|r| r.fault.is_none() == clean);
        let all: Vec<&Outcome> = rows.flat_map(|r| &r.outcomes).collect();
        let accepted: Vec<&&Outcome> = all.iter().filter(|o| o.accepted).collect();
        let silent = accepted.iter().filter(|o| o.true_mm > SILENT * o.stated_mm).count();
        let within = accepted.iter().map(|o| o.within).sum::<f64>() / accepted.len().max(1) as f64;
        format!(
            "{name}: {} cells, {} accepted, {:.1} % of points within, {silent} silent",
            all.len(),
            accepted.len(),
            100.0 * within
        )
    };
    format!("{}\n{}", of("clean", true), of("faulty", false))
}

fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}
