//! Whole sessions in virtual cells: how many captures until the session says "enough", and whether that is true.
//!
//! `session SEEDS FIRST [BENCHMARK.md]`

#[path = "../section.rs"]
mod section;

use std::{env, fs, path::PathBuf, time::Instant};

use handeye::{Camera, Intrinsics, Point, Pose, Setup, Target, simulate::Cell};
use handeye_io::{SessionFolder, small_jpeg};
use handeye_session::{
    assess::{Measured, NextWanted, assess},
    engine::{Command, Destination, Step},
    host::Host,
    script::Player,
    sources::{
        outlet::Wanted,
        virtual_cell::{Faults, VirtualCell},
    },
};

/// No session goes on for longer.
const MOST: usize = 30;

/// What became of a session.
struct Ended {
    captures: usize,
    stated_mm: f64,
    true_mm: f64,
}

/// A session in a folder of its own, with its first capture.
fn begun(setup: Setup, seed: u64) -> (PathBuf, Player) {
    let root = env::temp_dir().join(format!("handeye-bench-session-{}", std::process::id()));
    fs::remove_dir_all(&root).ok();
    let cell = VirtualCell::new(setup, seed, Faults::default()).expect("a cell");
    let folder = SessionFolder::open(&root, Some(&cell.settings())).expect("a folder");
    let mut player = Player::new(Host::new(folder), cell);
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).expect("a step that is proven");
    }
    player.command(Command::Take).expect("a first capture");
    (root, player)
}

/// Plays a session until it is enough; `None` where it never is.
fn play(setup: Setup, seed: u64) -> Option<Ended> {
    let (root, mut player) = begun(setup, seed);
    let is_enough = |player: &Player| player.state().progress.is_some_and(|p| p.enough);
    while !is_enough(&player) && player.state().captures.len() < MOST {
        let driven = player.command(Command::Drive { to: Destination::Next });
        if driven.and_then(|()| player.command(Command::Take)).is_err() {
            break;
        }
    }
    let ended = is_enough(&player).then(|| ended(&player)).flatten();
    fs::remove_dir_all(&root).ok();
    ended
}

/// Captures at which an assessment is timed.
const TIMED: usize = 20;

/// Seconds until a session with so many captures has assessed the newest one; the median of five.
fn assessment_s(setup: Setup, seed: u64) -> f64 {
    let (root, mut player) = begun(setup, seed);
    while player.state().captures.len() < TIMED {
        let taken = player.state().captures.len();
        if player.command(Command::Drive { to: Destination::Next }).is_err() {
            player.show_board(taken).expect("a view of the board");
        }
        player.command(Command::Take).expect("a capture");
    }
    drop(player);
    let mut folder = SessionFolder::open(&root, None).expect("the folder");
    let newest = folder.captures().last().expect("captures").id.clone();
    let mut all: Vec<f64> = (0..5)
        .map(|_| {
            let mut before = Measured::default();
            folder.delete(&newest).expect("a capture that is deleted");
            assess(&folder, &mut before, NextWanted::default()).expect("an assessment");
            folder.restore(&newest).expect("a capture that is restored");
            let begin = Instant::now();
            assess(&folder, &mut before, NextWanted::default()).expect("an assessment");
            begin.elapsed().as_secs_f64()
        })
        .collect();
    fs::remove_dir_all(&root).ok();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}

/// A camera of 2.3 MP.
const LARGE: (u32, u32) = (1920, 1200);

/// Seconds of an image of that size: its corners, and the picture that the page gets; medians of eleven.
fn image_s(seed: u64) -> [f64; 2] {
    let usual = Cell::new(Setup::EyeInHand, seed);
    let (width, height) = LARGE;
    let focal = 0.94 * f64::from(width);
    let (cx, cy) = (0.5 * f64::from(width - 1), 0.5 * f64::from(height - 1));
    let intrinsics = Intrinsics::pinhole(width, height, focal, focal, cx, cy);
    let cell = Cell { intrinsics, captures: 1, placements: 0, touches: 0, ..usual };
    let image = cell.record(seed).expect("a recording").picture(0);
    let wanted = Wanted { target: cell.target, intrinsics: Some(intrinsics), scans: None };
    let time = |what: &dyn Fn()| {
        let one = |_| {
            let begin = Instant::now();
            what();
            begin.elapsed().as_secs_f64()
        };
        let mut all: Vec<f64> = (0..11).map(one).collect();
        all.sort_by(f64::total_cmp);
        all[5]
    };
    let corners = || assert!(wanted.found_in(&image, 1, 0.0).corners.is_ok());
    let picture = || assert!(small_jpeg(&image, 1280).is_some());
    [time(&corners), time(&picture)]
}

fn ended(player: &Player) -> Option<Ended> {
    let (state, truth) = (player.state(), player.cell().truth().mount_from_camera);
    let progress = state.progress?;
    let found = progress.mount_from_camera?;
    let corners = state.cell.target.corners();
    let seen = state.captures.iter().filter_map(|c| c.camera_from_target);
    let off = |p: Point<Camera>| ((found * p).vector() - (truth * p).vector()).norm() * 1e3;
    let of_view = |view: Pose<Camera, Target>| corners.iter().map(move |c| view * *c);
    let mut all: Vec<f64> = seen.flat_map(of_view).map(off).collect();
    all.sort_by(f64::total_cmp);
    let true_mm = all[all.len() * 95 / 100];
    Some(Ended { captures: state.captures.len(), stated_mm: progress.p95_mm?, true_mm })
}

fn main() {
    let number =
        |k: usize, usual: u64| env::args().nth(k).and_then(|n| n.parse().ok()).unwrap_or(usual);
    let (seeds, first) = (number(1, 50), number(2, 3001));
    let mut rows = String::new();
    for (setup, name) in [(Setup::EyeInHand, "eye-in-hand"), (Setup::EyeToHand, "eye-to-hand")] {
        let all: Vec<Option<Ended>> =
            (first..first + seeds).map(|seed| play(setup, seed)).collect();
        let tolerance = VirtualCell::new(setup, first, Faults::default())
            .expect("a cell")
            .settings()
            .tolerance_mm;
        let done: Vec<&Ended> = all.iter().flatten().collect();
        let held = done.iter().filter(|e| e.true_mm <= tolerance).count();
        let stated = done.iter().filter(|e| e.true_mm <= e.stated_mm).count();
        let mut captures: Vec<usize> = done.iter().map(|e| e.captures).collect();
        captures.sort_unstable();
        let worst = done.iter().map(|e| e.true_mm).fold(0.0, f64::max);
        let median = captures.get(captures.len() / 2).copied().unwrap_or(0);
        let row = format!(
            "| {name} | {} of {} | {median} | {held} of {} | {stated} of {} | {worst:.2} |\n",
            done.len(),
            all.len(),
            done.len(),
            done.len()
        );
        print!("{row}");
        rows += &row;
    }
    let timed = [Setup::EyeInHand, Setup::EyeToHand].map(|setup| assessment_s(setup, first));
    println!("assessment: {:.0} ms and {:.0} ms", timed[0] * 1e3, timed[1] * 1e3);
    let image = image_s(first);
    println!("image of 2.3 MP: {:.0} ms and {:.0} ms", image[0] * 1e3, image[1] * 1e3);
    let text = format!(
        "## Sessions\n\n\
         `bench/session/run`: whole sessions of {seeds} virtual cells (seeds from {first}), rendered images, a robot with 0.1 mm and \
         0.01 degrees, a first guess off by 20 mm and 3 degrees; the next view is taken until the session says that the captures \
         are enough for its tolerance of 0.5 mm. *true*: the error (95 %) at all corners in all captures is below the tolerance; \
         *stated*: below what the session states.\n\n\
         | setup | enough within {MOST} captures | median of captures | true | stated | largest true error, mm |\n\
         |---|---|---|---|---|---|\n{rows}\n\
         From a capture that is stored, the {TIMED}th, to its assessment with the next view (image read, corners found, calibrated, \
         planned): {:.0} ms (eye-in-hand) and {:.0} ms (eye-to-hand), median of five, of the clock on the wall, by {} \
         threads. Of an image of 2.3 MP that comes live the corners take {:.0} ms, and the picture that the page gets {:.0} ms.\n",
        timed[0] * 1e3,
        timed[1] * 1e3,
        handeye_io::parallel::threads([]),
        image[0] * 1e3,
        image[1] * 1e3
    );
    if let Some(file) = env::args().nth(3) {
        section::write(file, "session", &text);
    }
}
