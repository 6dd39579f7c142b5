//! Feeds one target with good input that was changed at random: `shake TARGET SECONDS`.
//!
//! It knows nothing of which code an input reaches, and needs no build of its own: enough to notice what broke lately. The
//! seeds are those of `corpus/TARGET`; the changes are the same in every run.

use std::{
    env, fs,
    panic::{self, AssertUnwindSafe},
    path::{Path, PathBuf},
    process,
    sync::{
        Mutex,
        atomic::{AtomicU64, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use handeye::math::random::Random;
use handeye_fuzz::{folder, targets::ALL};

const LONGEST: usize = 65_536;
/// An input that takes longer (s) is a fault.
const PATIENCE: u64 = 20;
/// Most changes of one input.
const MOST_CHANGES: f64 = 8.0;
/// Numbers that readers have to stand.
const NUMBERS: [&str; 10] =
    ["nan", "-inf", "1e308", "-1", "0", "4294967296", "99999999999999999999", "1e-320", "", "-"];

/// When the current input began, in milliseconds since the start; zero between two.
static BEGAN: AtomicU64 = AtomicU64::new(0);

/// What the first panic of an input said, in whatever thread.
static SAID: Mutex<String> = Mutex::new(String::new());

fn main() {
    let words: Vec<String> = env::args().skip(1).collect();
    let [name, seconds] = &words[..] else { panic!("shake TARGET SECONDS") };
    let run = ALL.iter().find(|(known, _)| known == name).expect("a target").1;
    let seconds = Duration::from_secs(seconds.parse().expect("a number of seconds"));
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let seeds = seeds(&here.join("corpus").join(name));
    let kept = folder().join("current");
    let faults = here.join("artifacts").join(name);
    // panics of other crates that are caught and told are no faults
    panic::set_hook(Box::new(|what| {
        let mut said = SAID.lock().expect("a message");
        if said.is_empty() {
            *said = what.to_string();
        }
    }));
    let start = Instant::now();
    let watched = (kept.clone(), faults.clone());
    thread::spawn(move || watch(start, &watched.0, &watched.1));

    let mut random = Random::new(1);
    let mut count = 0;
    while start.elapsed() < seconds {
        let input =
            if count < seeds.len() { seeds[count].clone() } else { changed(&seeds, &mut random) };
        fs::write(&kept, &input).expect("a temporary file can be written");
        SAID.lock().expect("a message").clear();
        BEGAN.store(1 + start.elapsed().as_millis() as u64, Ordering::Relaxed);
        let ended = panic::catch_unwind(AssertUnwindSafe(|| run(&input)));
        BEGAN.store(0, Ordering::Relaxed);
        if ended.is_err() {
            let said = SAID.lock().expect("a message").clone();
            fault(&kept, &faults, &format!("panicked: {said}"));
        }
        count += 1;
    }
    println!("stat::number_of_executed_units: {count}"); // as libFuzzer says it
}

/// Ends the program where an input takes too long.
fn watch(start: Instant, kept: &Path, faults: &Path) {
    loop {
        thread::sleep(Duration::from_millis(500));
        let began = BEGAN.load(Ordering::Relaxed);
        if began > 0 && start.elapsed().as_millis() as u64 > began + 1000 * PATIENCE {
            fault(kept, faults, &format!("takes more than {PATIENCE} s"));
        }
    }
}

fn fault(kept: &Path, faults: &Path, what: &str) -> ! {
    let path = faults.join("fault");
    fs::create_dir_all(faults).and_then(|()| fs::copy(kept, &path)).expect("the input can be kept");
    eprintln!("{what}\nthe input is {}", path.display());
    process::exit(1)
}

fn seeds(folder: &Path) -> Vec<Vec<u8>> {
    let entries = fs::read_dir(folder).expect("seeds: run the program `seeds` first");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("a seed").path()).collect();
    paths.sort();
    let mut all: Vec<Vec<u8>> = paths.iter().map(|p| fs::read(p).expect("a seed")).collect();
    all.push(vec![]);
    all
}

/// A whole number below `limit`.
fn below(random: &mut Random, limit: usize) -> usize {
    ((random.unit() * limit as f64) as usize).min(limit.saturating_sub(1))
}

fn changed(seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut input = seeds[below(random, seeds.len())].clone();
    for _ in 0..=random.between(0.0, MOST_CHANGES) as usize {
        change(&mut input, seeds, random);
    }
    input.truncate(LONGEST);
    input
}

fn change(input: &mut Vec<u8>, seeds: &[Vec<u8>], random: &mut Random) {
    let at = below(random, input.len() + 1);
    let end = (at + 1 + below(random, 16)).min(input.len());
    match below(random, 9) {
        0 if at < input.len() => input[at] ^= 1 << below(random, 8),
        1 if at < input.len() => {
            input[at] = [0, 1, 0x7f, 0x80, 0xff, b'0', b' ', b'\n'][below(random, 8)]
        }
        2 => input
            .splice(at.min(end)..end, (0..4).map(|_| [0xff, 0x00, 0x7f][below(random, 3)]))
            .for_each(drop),
        3 => input.truncate(at),
        4 => input.drain(at.min(end)..end).for_each(drop),
        5 => {
            let part = input[at.min(end)..end].to_vec();
            input.splice(at..at, part).for_each(drop);
        }
        6 => {
            let other = &seeds[below(random, seeds.len())];
            let from = below(random, other.len() + 1);
            input.truncate(at);
            input.extend(&other[from..]);
        }
        7 => input.insert(at, below(random, 256) as u8),
        _ => number(input, at, random),
    }
}

/// Puts another number in the place of one that is written in text.
fn number(input: &mut Vec<u8>, from: usize, random: &mut Random) {
    let Some(begin) = (from..input.len()).find(|k| input[*k].is_ascii_digit()) else { return };
    let is_part = |b: &u8| b.is_ascii_digit() || b".eE+-".contains(b);
    let end = (begin..input.len()).find(|k| !is_part(&input[*k])).unwrap_or(input.len());
    let other = NUMBERS[below(random, NUMBERS.len())];
    input.splice(begin..end, other.bytes()).for_each(drop);
}
