//! What people get wrong, in whole sessions: it is named while they stand there, and nothing is accepted that is not true.

use std::fs;

use handeye::{
    Pose, Setup,
    nalgebra::{Rotation3, Vector3},
};
use handeye_io::SessionFolder;
use handeye_session::{
    engine::{Command, Destination, Step},
    host::Host,
    script::Player,
    sources::{
        mistakes::{Event, Mistake},
        virtual_cell::{Faults, VirtualCell},
    },
};

use crate::new_folder;

fn play(
    setup: Setup,
    seed: u64,
    mistake: Option<Mistake>,
    event: Option<(usize, Event)>,
) -> String {
    let root = new_folder();
    let cell = VirtualCell::new(setup, seed, Faults { mistake, ..Faults::default() }).unwrap();
    let folder = SessionFolder::open(&root, Some(&cell.settings())).unwrap();
    let mut player = Player::new(Host::new(folder), cell);
    let mut log = format!("== {setup:?} {mistake:?} {event:?}\n");
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        if let Err(why) = player.command(Command::Confirm { step }) {
            log += &format!("  {step:?}: {why}\n");
            fs::remove_dir_all(root).unwrap();
            return log;
        }
    }
    for k in 1..=12 {
        if let Some((_, event)) = event.filter(|(at, _)| *at == k) {
            player.cell().happens(&event);
        }
        let taken = player.state().captures.len();
        if k > 1 {
            if let Err(why) = player.command(Command::Drive { to: Destination::Next }) {
                log += &format!("  {k} drive: {why}\n");
            }
        }
        let mut took = player.command(Command::Take);
        if player.state().captures.len() == taken {
            let problem = player.state().problem.unwrap();
            log += &format!("  {k} missed: {} {}\n", problem.code, problem.message);
            player.show_board(k).unwrap();
            took = player.command(Command::Take);
        }
        if let Err(why) = took {
            log += &format!("  {k} take: {why}\n");
        }
        let state = player.state();
        log += &format!("  {k} n {} say {:?}", state.captures.len(), state.say);
        if let Some(problem) = &state.problem {
            log += &format!(" PROBLEM {} {}", problem.code, problem.message);
        }
        if let Some(p) = &state.progress {
            let codes: Vec<String> = p.findings.iter().map(|f| format!("{:?}", f.code)).collect();
            log += &format!(
                " {:?} enough {} p95 {:?} {:?} | {}",
                p.verdict,
                p.enough,
                p.p95_mm,
                codes,
                p.reasons.join(" / ")
            );
        }
        log += "\n";
        if state.progress.is_some_and(|p| p.enough) {
            break;
        }
    }
    player.command(Command::Finish).ok();
    log += &format!("  END {:?}\n", player.state().result.map(|r| r.headline));
    if std::env::var("KEEP").is_ok() {
        log += &format!("{}\n", root.display());
    } else {
        fs::remove_dir_all(root).unwrap();
    }
    log
}

#[test]
fn explore() {
    let turn = |deg: f64| Rotation3::new(Vector3::new(0.0, 0.0, deg.to_radians()));
    let small = Rotation3::new(Vector3::new(0.01, -0.006, 0.0));
    let cases: Vec<(Option<Mistake>, Option<(usize, Event)>)> = vec![
        (Some(Mistake::Notation { written: "kuka", read: "staubli" }), None),
        (Some(Mistake::Notation { written: "ur", read: "fanuc" }), None),
        (Some(Mistake::Lengths(1.0 / 25.4)), None),
        (Some(Mistake::Inverted), None),
        (Some(Mistake::Behind), None),
        (Some(Mistake::Square(1.05)), None),
        (Some(Mistake::FocalLength(1.04)), None),
        (Some(Mistake::OtherSetup), None),
        (Some(Mistake::Mirrored), None),
        (
            None,
            Some((
                9,
                Event::CameraMoved(Pose::from_parts(
                    small.matrix(),
                    Vector3::new(0.002, 0.0, 0.001),
                )),
            )),
        ),
        (
            None,
            Some((
                5,
                Event::CameraMoved(Pose::from_parts(
                    small.matrix(),
                    Vector3::new(0.002, 0.0, 0.001),
                )),
            )),
        ),
        (
            None,
            Some((
                5,
                Event::BoardMoved(Pose::from_parts(
                    turn(0.0).matrix(),
                    Vector3::new(0.008, 0.0, 0.0),
                )),
            )),
        ),
        (
            None,
            Some((
                5,
                Event::BoardMoved(Pose::from_parts(
                    turn(180.0).matrix(),
                    Vector3::new(0.24, 0.15, 0.0),
                )),
            )),
        ),
    ];
    let only: Option<usize> = std::env::var("ONLY").ok().and_then(|k| k.parse().ok());
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        for (k, (mistake, event)) in cases.iter().enumerate() {
            if only.is_none_or(|o| o == k) {
                println!("{}", play(setup, 41 + k as u64, *mistake, *event));
            }
        }
    }
}
