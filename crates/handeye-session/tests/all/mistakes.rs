//! What people get wrong, and what happens to a cell, in whole sessions: it is named while they stand there, and nothing is
//! accepted that is not true.

use std::fs;

use handeye::{
    Pose, Setup,
    nalgebra::{Rotation3, Vector3},
};
use handeye_io::SessionFolder;
use handeye_session::{
    engine::{Command, Destination, Step, shown::State},
    host::Host,
    script::Player,
    sources::{
        mistakes::{Event, Mistake},
        virtual_cell::{Faults, VirtualCell},
    },
};

use crate::new_folder;

/// No session goes on for longer.
const MOST: usize = 12;
/// A mistake is named before this capture.
const IN_TIME: usize = 8;

/// A session of which something is wrong.
struct Case {
    setup: Setup,
    seed: u64,
    faults: Faults,
    /// What happens before which capture.
    event: Option<(usize, Event)>,
    /// Words by which it is named.
    named: &'static [&'static str],
}

impl Case {
    fn mistake(setup: Setup, mistake: Mistake, named: &'static [&'static str]) -> Self {
        let faults = Faults { mistake: Some(mistake), ..Faults::default() };
        Self { setup, seed: 41, faults, event: None, named }
    }

    fn event(setup: Setup, at: usize, event: Event, named: &'static [&'static str]) -> Self {
        Self { setup, seed: 41, faults: Faults::default(), event: Some((at, event)), named }
    }

    /// Plays it; returns what was seen, and panics where it was not named in time or an untrue answer was accepted.
    fn play(&self) -> String {
        let root = new_folder();
        let cell = VirtualCell::new(self.setup, self.seed, self.faults).unwrap();
        let folder = SessionFolder::open(&root, Some(&cell.settings())).unwrap();
        let mut player = Player::new(Host::new(folder), cell);
        let mut log =
            vec![format!("{:?}, {:?}, {:?}", self.setup, self.faults.mistake, self.event)];
        let named_at = self.until_named(&mut player, &mut log);
        let in_time = self.event.map_or(IN_TIME, |(at, _)| at + 1);
        assert!(named_at.is_some_and(|at| at < in_time), "{named_at:?}: {log:#?}");
        // whoever goes on nevertheless gets no wrong answer
        if let Err(why) = player.command(Command::Finish) {
            log.push(format!("not finished: {why}"));
        } else {
            let result = player.state().result.unwrap();
            let off = off_mm(&player);
            let is_true = off.is_some_and(|mm| mm < 0.5);
            let said = format!("finished: {}, off by {off:?} mm", result.headline);
            log.push(said);
            assert!(!result.headline.starts_with("Accepted") || is_true, "{log:#?}");
        }
        drop(player);
        fs::remove_dir_all(root).unwrap();
        log.join("\n  ")
    }

    /// Takes captures until the mistake is named; the number of the one at which it is.
    fn until_named(&self, player: &mut Player, log: &mut Vec<String>) -> Option<usize> {
        for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
            if let Err(why) = player.command(Command::Confirm { step }) {
                let is_named = self.names(&why);
                log.push(format!("at the step {}: {why}", step.name()));
                return is_named.then_some(0);
            }
        }
        for number in 1..=MOST {
            if let Some((_, event)) = self.event.filter(|(at, _)| *at == number) {
                player.cell().happens(&event);
            }
            let before = player.state().captures.len();
            let driven =
                number == 1 || player.command(Command::Drive { to: Destination::Next }).is_ok();
            if driven {
                player.command(Command::Take).ok();
            }
            let mut state = player.state();
            let mut said = sentences(&state);
            if state.captures.len() == before {
                // then by hand to where the board is seen
                player.show_board(number).unwrap();
                player.command(Command::Take).ok();
                state = player.state();
                said += &sentences(&state);
            }
            log.push(format!("{number}: {said}"));
            let has_happened = self.event.is_none_or(|(at, _)| number >= at);
            if has_happened && self.names(&said) {
                return Some(number);
            }
        }
        None
    }

    fn names(&self, said: &str) -> bool {
        self.named.iter().any(|words| said.contains(words))
    }
}

/// What the page says.
fn sentences(state: &State) -> String {
    let problem = state.problem.iter().map(|p| format!("{} {}", p.message, p.advice));
    let all: Vec<String> = std::iter::once(state.say.clone()).chain(problem).collect();
    all.join(" | ")
}

/// How far the answer is off, at the corners as the camera saw them (95 %), mm.
fn off_mm(player: &Player) -> Option<f64> {
    let (state, truth) = (player.state(), player.cell().truth().mount_from_camera);
    let found = state.progress?.mount_from_camera?;
    let corners = state.cell.target.corners();
    let views = state.captures.iter().filter_map(|c| c.camera_from_target);
    let mut all: Vec<f64> = views
        .flat_map(|view| corners.iter().map(move |c| view * *c))
        .map(|p| ((found * p).vector() - (truth * p).vector()).norm() * 1e3)
        .collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() * 95 / 100).copied()
}

fn all_are_named(cases: &[Case]) {
    for case in cases {
        println!("{}", case.play());
    }
}

const HAND: Setup = Setup::EyeInHand;
const BASE: Setup = Setup::EyeToHand;

#[test]
fn poses_that_are_read_wrongly_are_named() {
    let euler = Mistake::Notation { written: "kuka", read: "staubli" };
    let quaternion = Mistake::Notation { written: "quaternion-wxyz", read: "quaternion-xyzw" };
    let metres = Mistake::Notation { written: "ur", read: "fanuc" };
    all_are_named(&[
        Case::mistake(HAND, euler, &["written as kuka"]),
        Case::mistake(BASE, quaternion, &["quaternion-wxyz", "wxyz"]),
        Case::mistake(HAND, metres, &["another unit"]),
        Case::mistake(BASE, Mistake::Lengths(25.4), &["another unit"]),
        Case::mistake(BASE, Mistake::Inverted, &["flange_from_base"]),
    ]);
}

#[test]
fn poses_that_are_none_of_the_image_are_named() {
    let late = Faults { image_delay_s: 0.8, ..Faults::default() };
    let creeps = Faults { creep_m_s: 0.4e-3, ..Faults::default() };
    all_are_named(&[
        Case::mistake(
            HAND,
            Mistake::Behind,
            &["each image belongs to the robot pose", "the pose was not read anew"],
        ),
        Case::mistake(HAND, Mistake::Frozen, &["the pose was not read anew"]),
        Case {
            setup: BASE,
            seed: 41,
            faults: late,
            event: None,
            named: &["later than they are taken"],
        },
        Case {
            setup: BASE,
            seed: 41,
            faults: creeps,
            event: None,
            named: &["still moves 0.4 mm/s"],
        },
    ]);
}

#[test]
fn a_wrong_board_or_camera_is_named() {
    all_are_named(&[
        Case::mistake(HAND, Mistake::Square(1.05), &["as large as declared"]),
        Case::mistake(BASE, Mistake::Square(0.98), &["as large as declared"]),
        Case::mistake(BASE, Mistake::OtherBoard, &["not found", "9 x 6"]),
        Case::mistake(
            HAND,
            Mistake::FocalLength(1.04),
            &["focal", "intrinsics", "as large as declared"],
        ),
        Case::mistake(HAND, Mistake::OtherResolution, &["the intrinsics are for"]),
        Case::mistake(BASE, Mistake::Mirrored, &["mirrored"]),
        Case::mistake(HAND, Mistake::OtherSetup, &["the setup is"]),
        Case::mistake(BASE, Mistake::OtherSetup, &["the setup is"]),
    ]);
}

#[test]
fn what_moves_in_the_middle_is_named() {
    let knock = Rotation3::new(Vector3::new(0.01, -0.006, 0.0));
    let knocked =
        Event::CameraMoved(Pose::from_parts(knock.matrix(), Vector3::new(0.002, 0.0, 0.001)));
    let half_turn = Rotation3::new(Vector3::new(0.0, 0.0, std::f64::consts::PI));
    let turned =
        Event::BoardMoved(Pose::from_parts(half_turn.matrix(), Vector3::new(0.24, 0.15, 0.0)));
    let shifted = Event::BoardMoved(Pose::from_parts(
        Rotation3::identity().matrix(),
        Vector3::new(0.008, 0.0, 0.0),
    ));
    all_are_named(&[
        Case::event(HAND, 9, knocked, &["Capture 009 is rejected as an outlier"]),
        Case::event(BASE, 9, knocked, &["Capture 009 is rejected as an outlier"]),
        Case::event(HAND, 6, shifted, &["Capture 006 is rejected as an outlier"]),
        Case::event(HAND, 6, turned, &["Capture 006 is rejected as an outlier"]),
    ]);
}
