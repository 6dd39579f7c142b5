//! Wrong captures among right ones: a small version of `bench/robustness`.

use handeye::{
    Config, Session, Setup, Verdict, calibrate,
    math::random::Random,
    simulate::{Cell, Mistake, spoil},
};

#[path = "../../../../bench/robustness/trial.rs"]
mod trial;
use trial::{Outcome, trial, whole_file};

const SESSIONS: u64 = 60;

#[test]
fn spoilt_captures_cost_nothing_and_no_answer_is_silently_wrong() {
    let all: Vec<Outcome> = (0..SESSIONS).filter_map(trial).collect();
    assert_eq!(all.len() as u64, SESSIONS);
    for (seed, outcome) in all.iter().enumerate() {
        assert!(!outcome.silent, "seed {seed}: {:?}", outcome.error);
    }
    let wronged: usize = all.iter().map(Outcome::wronged).sum();
    let captures: usize = all.iter().map(|o| o.captures).sum();
    assert!(
        wronged * 1000 <= captures.max(1000),
        "{wronged} of {captures} were right and left out"
    );
    // a last capture that is spoilt may be one after a knock: then another one is asked for
    let asks = |o: &&Outcome| o.result.warnings.iter().any(|w| w.code == "last-capture-displaced");
    assert!(all.iter().filter(asks).all(|o| o.spoilt.iter().any(|(k, _)| k + 1 == o.captures)));
    let solved = all.iter().filter(|o| o.solved() || asks(o)).count() as u64;
    assert!(solved + 1 >= SESSIONS, "{solved} of {SESSIONS}");
    let is_close = |o: &&Outcome| o.ratio().is_some_and(|r| r < trial::AS_GOOD) || asks(o);
    let close = all.iter().filter(is_close).count();
    assert!(close as u64 + 3 >= SESSIONS, "{close} of {SESSIONS}");
    let asking = all.iter().filter(asks).count() as u64;
    assert!(asking * 10 <= SESSIONS, "{asking} of {SESSIONS} end with a question");
    for kind in Mistake::ALL {
        let sum = |f: &dyn Fn(&Outcome) -> usize| all.iter().map(f).sum::<usize>();
        let (count, missed) = (sum(&|o| o.of(kind).count()), sum(&|o| o.missed(kind)));
        // a few millimetres are no surprise to a robot that errs by two
        let share = if kind == Mistake::Moving { 3 } else { 50 };
        assert!(missed * share <= count, "{kind:?}: {missed} of {count} were used");
        let named = sum(&|o| o.named(kind));
        assert!(named * 10 >= (count - missed) * 8, "{kind:?}: {named} of {count} are named");
    }
}

/// Three captures of a moving robot, a few millimetres each, make the noise look large enough for all.
#[test]
fn captures_that_hide_one_another_are_found() {
    let outcome = trial(442).unwrap();
    let moving = outcome.of(Mistake::Moving).count();
    assert!(moving >= 3, "{:?}", outcome.spoilt);
    assert_eq!(outcome.missed(Mistake::Moving), 0, "{:?}", outcome.spoilt);
    assert_eq!(outcome.wronged(), 0);
}

#[test]
fn a_file_in_a_wrong_order_is_rejected_and_the_order_is_named() {
    for seed in 0..6 {
        let found = whole_file(seed).unwrap();
        assert_eq!(found.verdict, Verdict::Rejected, "seed {seed}");
        assert!(found.warnings.iter().any(|w| w.code == "order-shifted"), "seed {seed}");
    }
}

fn spoilt(kind: Mistake, most: usize) -> (Session, Vec<usize>) {
    let cell = Cell { placements: 0, touches: 0, ..Cell::new(Setup::EyeInHand, 11) };
    let mut session = cell.session(11).unwrap().0;
    let which = spoil(&mut session, &[kind], most, &mut Random::new(5));
    (session, which.into_iter().map(|(i, _)| i).collect())
}

#[test]
fn every_mistake_that_can_be_undone_is_offered_and_not_done() {
    let codes = [
        (Mistake::Turned, 2, "target-turned"),
        (Mistake::Exchanged, 2, "captures-exchanged"),
        (Mistake::Stale, 1, "stale-robot-pose"),
        (Mistake::Shifted, 4, "order-shifted"),
        (Mistake::Mirrored, 2, "capture-rejected"),
    ];
    for (kind, most, code) in codes {
        let (session, which) = spoilt(kind, most);
        let found = calibrate(&session, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Accepted, "{kind:?}");
        let codes: Vec<&str> = found.warnings.iter().map(|w| w.code.as_str()).collect();
        assert!(codes.contains(&code), "{kind:?}: {codes:?}");
        for i in which {
            assert!(!found.captures[i].used, "{kind:?}: capture {i} stays out");
        }
    }
}

/// Half of the captures say one thing of the camera, half another: it was knocked.
#[test]
fn two_halves_that_contradict_each_other_are_rejected() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let here = Cell { captures: 8, placements: 0, touches: 0, ..Cell::new(setup, 21) };
        let there = Cell { hand_eye: Cell::new(setup, 22).hand_eye, seed: 22, ..here.clone() };
        let mut session = here.session(1).unwrap().0;
        for (k, mut o) in there.session(2).unwrap().0.observations.into_iter().enumerate() {
            o.capture = format!("{:03}", 100 + k);
            session.observations.push(o);
        }
        for left_out in [0, 1] {
            session.observations.truncate(16 - left_out);
            let found = calibrate(&session, &Config::default()).unwrap();
            assert_ne!(found.verdict, Verdict::Accepted, "{setup:?} {:?}", found.reasons);
        }
    }
}
