//! Captures of a robot that moves, and late images.

use handeye::{Setup, math::random::Random};
use handeye_session::{
    engine::{Command, Effect, Engine, FolderState, Input, Sources, Step, rest::ImageSample},
    sources::virtual_cell::{Faults, VirtualCell},
};

/// A robot that is driven and told to stand, and what the engine does then.
struct Trial {
    cell: VirtualCell,
    engine: Engine,
    random: Random,
    now: f64,
    frame: u64,
}

/// A capture that was taken: how far the flange was from what the image shows, m.
struct Taken {
    waited_s: f64,
    off_m: f64,
}

impl Trial {
    fn new(faults: Faults, seed: u64) -> Self {
        let cell = VirtualCell::new(Setup::EyeInHand, seed, faults).unwrap();
        let folder = FolderState::new(cell.settings());
        let engine = Engine::new(folder, Sources::VIRTUAL).0;
        let mut trial = Self { cell, engine, random: Random::new(seed), now: 0.0, frame: 0 };
        trial.pass(1.0);
        for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
            trial.engine.step(Input::Command(Command::Confirm { step })).unwrap();
        }
        trial
    }

    /// Time goes by; returns what is to be stored, and when.
    fn pass(&mut self, seconds: f64) -> Option<Taken> {
        let begin = self.now;
        while self.now < begin + seconds {
            self.now += 0.04;
            let mut inputs = vec![Input::Robot(self.cell.sample(self.now))];
            self.frame += 1;
            if self.frame.is_multiple_of(5) {
                inputs.push(Input::Image(ImageSample {
                    frame: self.frame,
                    time_s: self.now,
                    size: (1280, 800),
                    corners: Ok(self.cell.corners(self.now, &mut self.random)),
                }));
            }
            inputs.push(Input::Clock(self.now));
            for input in inputs {
                for effect in self.engine.step(input).unwrap() {
                    if let Effect::Store { frame, .. } = effect {
                        let imaged = self.cell.flange_in_image(frame as f64 * 0.04);
                        // where it would be without delay
                        let there = self.cell.standing(self.now);
                        let off_m = imaged.distance_to(&there);
                        return Some(Taken { waited_s: self.now - begin, off_m });
                    }
                }
            }
        }
        None
    }

    /// Drives somewhere near; the capture is asked for at once, as impatient people do.
    fn take(&mut self) -> Option<Taken> {
        let by = |random: &mut Random, most: f64| [0; 3].map(|_| random.between(-most, most));
        let (shift, turn) = (by(&mut self.random, 60.0), by(&mut self.random, 6.0));
        self.cell.jog(shift, turn, self.now);
        // before the first delayed image moves, and after
        let early = self.random.between(0.1, 1.5);
        self.pass(early);
        self.engine.step(Input::Command(Command::Take)).unwrap();
        let taken = self.pass(6.0);
        self.engine.step(Input::Stored(Err("only tried".into()))).unwrap();
        self.engine.step(Input::Command(Command::Cancel)).unwrap();
        taken
    }
}

#[test]
fn no_capture_of_500_is_taken_while_the_robot_creeps() {
    let still =
        (0..20).filter_map(|seed| Trial::new(Faults::default(), seed).take()).collect::<Vec<_>>();
    let longest = still.iter().map(|t| t.waited_s).fold(0.0, f64::max);
    println!("of 20 standing robots {} were captured, after {longest:.1} s at most", still.len());
    assert!(still.len() == 20 && longest < 4.0, "{} {longest}", still.len());
    assert!(still.iter().all(|t| t.off_m < 1e-6));

    let mut taken = 0;
    for seed in 0..50 {
        let faults = match seed % 2 {
            0 => Faults { creep_m_s: 0.2e-3, ..Faults::default() },
            _ => Faults { creep_rad_s: 0.02f64.to_radians(), ..Faults::default() },
        };
        let mut trial = Trial::new(faults, seed);
        taken += (0..10).filter_map(|_| trial.take()).count();
    }
    assert_eq!(taken, 0, "of 500");
}

#[test]
fn late_images_are_of_the_standstill_and_their_delay_is_named() {
    let (mut wrong, mut taken, mut unnamed) = (vec![], 0, vec![]);
    for seed in 0..50 {
        let late = Random::new(seed).between(0.1, 1.0);
        let mut trial = Trial::new(Faults { image_delay_s: late, ..Faults::default() }, seed);
        for k in 0..10 {
            if let Some(capture) = trial.take() {
                taken += 1;
                wrong.extend((capture.off_m > 20e-6).then_some((seed, k, late, capture.off_m)));
            }
        }
        let state = trial.engine.view("", "");
        let named = state.camera.delay_s.unwrap_or(f64::NAN);
        // the images are 0.2 s apart
        if !((named - late).abs() < 0.25) {
            unnamed.push((late, named));
        }
        if late > 0.5 {
            assert!(
                state
                    .problem
                    .is_some_and(|p| p.message.contains("later") || p.code == "not-written")
            );
        }
    }
    println!("{taken} of 500 were taken");
    assert!(wrong.is_empty(), "{wrong:?}");
    assert!(unnamed.is_empty(), "{unnamed:?}");
    assert!(taken > 450, "{taken}");
}
