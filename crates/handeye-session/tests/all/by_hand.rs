//! Poses typed from a pendant, images one by one.

use handeye::{
    Flange, Pose, Setup,
    math::random::Random,
    nalgebra::{Matrix3, Vector3},
};
use handeye_io::{CellSettings, Writing};
use handeye_session::{
    engine::{
        Command, Effect, Engine, Flow, FolderState, Input, Problem, Sources, Step,
        rest::{ImageSample, RobotSample},
    },
    sources::virtual_cell::{Faults, VirtualCell},
};

struct Bench {
    cell: VirtualCell,
    engine: Engine,
    frame: u64,
    now: f64,
}

impl Bench {
    fn new(takes_images: bool) -> Self {
        let cell = VirtualCell::new(Setup::EyeInHand, 1, Faults::default()).unwrap();
        let settings = CellSettings { notation: "kuka".into(), ..cell.settings() };
        let folder = FolderState::new(settings);
        let by_hand =
            Sources { robot: Flow::Single, camera: Flow::Single, takes_images, is_virtual: false };
        let engine = Engine::new(folder, by_hand).0;
        Self { cell, engine, frame: 0, now: 0.0 }
    }

    fn image(&mut self, shows_board: bool) -> Vec<Effect> {
        self.frame += 1;
        self.now += 30.0; // nobody hurries
        let corners = match shows_board {
            true => Ok(self.cell.corners(self.now, &mut Random::new(self.frame))),
            false => Err("too dark".to_owned()),
        };
        let (frame, time_s) = (self.frame, self.now);
        let image = ImageSample { frame, time_s, size: (1280, 800), corners };
        self.engine.step(Input::Image(image)).unwrap()
    }

    fn pose(&mut self) -> Vec<Effect> {
        let writing = Writing::of("kuka").unwrap();
        let numbers = writing.numbers(&self.cell.standing(0.0));
        let text = numbers.iter().map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(" ");
        self.engine.step(Input::Command(Command::Pose { text })).unwrap()
    }

    fn ask(&mut self, command: Command) -> Vec<Effect> {
        self.engine.step(Input::Command(command)).unwrap()
    }

    fn stored(&mut self) {
        self.engine.step(Input::Stored(Ok("001".into()))).unwrap();
    }

    fn begin(&mut self) {
        self.image(true);
        self.pose();
        for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
            self.ask(Command::Confirm { step });
        }
    }
}

fn is_store(effects: &[Effect]) -> bool {
    matches!(effects, [Effect::Store { .. }])
}

#[test]
fn a_pose_and_an_image_make_one_capture_in_either_order() {
    let mut bench = Bench::new(false);
    bench.begin();
    assert!(is_store(&bench.ask(Command::Take)));
    bench.stored();
    // neither is used twice
    assert!(bench.ask(Command::Take).is_empty());
    assert!(
        bench.engine.view("", "").say.contains("type the pose"),
        "{}",
        bench.engine.view("", "").say
    );
    assert!(bench.image(true).is_empty());
    assert!(is_store(&bench.pose()));
    bench.stored();
    assert!(bench.ask(Command::Take).is_empty());
    assert!(bench.pose().is_empty());
    assert!(is_store(&bench.image(true)));
}

#[test]
fn an_image_without_the_board_is_refused_and_its_pose_waits_for_another() {
    let mut bench = Bench::new(false);
    bench.begin();
    bench.image(false);
    let effects = bench.ask(Command::Take);
    assert!(matches!(&effects[..], [Effect::Refuse(refused)] if refused.why.contains("too dark")));
    assert!(bench.ask(Command::Take).is_empty());
    assert!(is_store(&bench.image(true)));
}

#[test]
fn a_command_takes_the_image_once_the_pose_is_there() {
    let mut bench = Bench::new(true);
    assert_eq!(bench.engine.view("", "").camera.frame, 0);
    bench.begin();
    // an image of before the pose is not that of the pose
    assert_eq!(bench.ask(Command::Take), [Effect::Grab]);
    assert!(is_store(&bench.image(true)));
    bench.stored();
    assert!(bench.ask(Command::Take).is_empty());
    assert_eq!(bench.pose(), [Effect::Grab]);
    let trouble = Input::Trouble(Problem {
        code: "no-image".into(),
        message: "the command has failed".into(),
        advice: String::new(),
    });
    bench.engine.step(trouble).unwrap();
    assert_eq!(bench.engine.view("", "").problem.unwrap().code, "no-image");
    assert_eq!(bench.ask(Command::Take), [Effect::Grab]);
    assert!(is_store(&bench.image(true)));
}

#[test]
fn poses_that_are_none_are_refused_with_what_is_wrong() {
    let mut bench = Bench::new(false);
    for (text, said) in [
        ("1 2 3", "3 numbers"),
        ("X 1 Y 2 Z 3 RX 0 RY 0 RZ 0", "not those of kuka"),
        ("6e12 0 0 0 0 0", "farther than any robot"),
    ] {
        let refusal = bench.engine.step(Input::Command(Command::Pose { text: text.into() }));
        let why = refusal.unwrap_err().message;
        assert!(why.contains(said), "{why}");
    }
}

#[test]
fn nothing_is_finished_while_a_capture_may_still_say_that_something_moved() {
    let mut bench = Bench::new(false);
    bench.begin();
    bench.image(true);
    bench.pose();
    assert!(is_store(&bench.ask(Command::Take)));
    let finish = || Input::Command(Command::Finish);
    assert!(bench.engine.step(finish()).is_err());
    // it lies in the folder, and is being assessed
    let stored = handeye_io::StoredCapture {
        id: "001".into(),
        image: None,
        scan: None,
        base_from_flange: bench.cell.standing(0.0),
        typed: vec![],
        joints: vec![],
        robot_time_s: None,
        image_time_s: None,
    };
    let folder =
        FolderState { captures: vec![stored], ..FolderState::new(bench.engine.settings().clone()) };
    let effects = bench.engine.step(Input::Folder(Box::new(folder))).unwrap();
    bench.stored();
    let why = bench.engine.step(finish()).unwrap_err().to_string();
    assert!(why.contains("still being assessed"), "{why}");
    let [Effect::Assess { generation, .. }] = effects[..] else { panic!("{effects:?}") };
    let nothing = Input::Assessed { generation, assessment: Err("too few".into()) };
    bench.engine.step(nothing).unwrap();
    assert_eq!(bench.engine.step(finish()).unwrap(), [Effect::Write]);
}

#[test]
fn poses_wait_until_those_before_them_are_read_again() {
    let mut bench = Bench::new(false);
    bench.begin();
    let effects = bench.ask(Command::Notation { name: "fanuc".into(), reread: true });
    assert_eq!(effects, [Effect::Reread("fanuc".into())]);
    let pose = Input::Command(Command::Pose { text: "400 0 300 0 0 180".into() });
    let why = bench.engine.step(pose.clone()).unwrap_err().to_string();
    assert!(why.contains("being read again"), "{why}");
    bench.engine.step(Input::Failed("the disk is full".into())).unwrap();
    assert!(bench.engine.step(pose).is_ok());
}

/// With a camera beside the robot and a capture, at the step of the touches.
fn at_touches(takes_images: bool) -> Bench {
    let mut bench = Bench::new(takes_images);
    let capture = handeye_io::StoredCapture {
        id: "001".into(),
        image: None,
        scan: None,
        base_from_flange: bench.cell.standing(0.0),
        typed: vec![],
        joints: vec![],
        robot_time_s: None,
        image_time_s: None,
    };
    let folder = FolderState {
        captures: vec![capture],
        ..FolderState::new(CellSettings {
            setup: Setup::EyeToHand,
            ..bench.engine.settings().clone()
        })
    };
    let sources =
        Sources { robot: Flow::Single, camera: Flow::Single, takes_images, is_virtual: false };
    let (engine, effects) = Engine::new(folder, sources);
    bench.engine = engine;
    let [Effect::Assess { generation, .. }] = effects[..] else { panic!("{effects:?}") };
    let assessment = Err("too few".into());
    bench.engine.step(Input::Assessed { generation, assessment }).unwrap();
    bench.ask(Command::Go { step: Step::Touch });
    bench
}

fn is_placement(effects: &[Effect]) -> bool {
    matches!(effects, [Effect::StorePlacement { .. }])
}

#[test]
fn the_image_of_a_board_that_was_laid_down_is_waited_for_and_is_none_that_was_used() {
    let mut bench = at_touches(false);
    assert!(bench.ask(Command::Place).is_empty());
    assert!(bench.image(false).is_empty());
    let state = bench.engine.view("", "");
    assert!(state.taking.is_none());
    let problem = state.problem.unwrap();
    assert!(problem.code == "not-placed" && problem.message.contains("too dark"), "{problem:?}");
    // no pose need be typed for it
    assert!(bench.ask(Command::Place).is_empty());
    assert!(is_placement(&bench.image(true)));
    bench.engine.step(Input::Stored(Ok("p01".into()))).unwrap();
    // another placement needs another image
    assert!(bench.ask(Command::Place).is_empty());
    let why = bench.engine.view("", "").say;
    assert!(why.contains("waiting for an image of the board as it lies"), "{why}");
    assert!(is_placement(&bench.image(true)));
}

#[test]
fn a_command_takes_the_image_of_a_board_that_was_laid_down() {
    let mut bench = at_touches(true);
    bench.image(true); // that was not asked for
    assert_eq!(bench.ask(Command::Place), [Effect::Grab]);
    assert!(is_placement(&bench.image(true)));
}

/// A robot that streams, and images one by one.
struct Streaming {
    bench: Bench,
    /// Where it stands, and what it did before: times and how far it had moved, m.
    moved_m: f64,
}

impl Streaming {
    fn new(takes_images: bool) -> Self {
        let mut bench = Bench::new(takes_images);
        let folder = FolderState::new(bench.cell.settings());
        let sources =
            Sources { robot: Flow::Stream, camera: Flow::Single, takes_images, is_virtual: false };
        bench.engine = Engine::new(folder, sources).0;
        let mut streaming = Self { bench, moved_m: 0.0 };
        streaming.pass(4.0);
        streaming.image(streaming.bench.now);
        for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
            streaming.bench.ask(Command::Confirm { step });
        }
        streaming.nudge(); // that image is of another pose
        streaming
    }

    /// Time goes by, with a pose of the robot every 40 ms; returns what is to be done.
    fn pass(&mut self, seconds: f64) -> Vec<Effect> {
        let end = self.bench.now + seconds;
        let mut effects = vec![];
        while self.bench.now < end {
            self.bench.now += 0.04;
            let at = self.bench.cell.standing(0.0);
            let step: Pose<Flange, Flange> =
                Pose::from_parts(&Matrix3::identity(), Vector3::new(self.moved_m, 0.0, 0.0));
            let sample = RobotSample {
                time_s: self.bench.now,
                base_from_flange: at * step,
                typed: vec![],
                joints: vec![],
            };
            effects.extend(self.bench.engine.step(Input::Robot(sample)).unwrap());
            effects.extend(self.bench.engine.step(Input::Clock(self.bench.now)).unwrap());
        }
        effects
    }

    /// An image that says that it is of this time.
    fn image(&mut self, time_s: f64) -> Vec<Effect> {
        self.bench.frame += 1;
        let corners = Ok(self.bench.cell.corners(0.0, &mut Random::new(self.bench.frame)));
        let frame = self.bench.frame;
        let image = ImageSample { frame, time_s, size: (1280, 800), corners };
        self.bench.engine.step(Input::Image(image)).unwrap()
    }

    /// Somebody nudges it by two millimetres; it stands again.
    fn nudge(&mut self) -> Vec<Effect> {
        let mut effects = vec![];
        for _ in 0..10 {
            self.moved_m += 0.2e-3;
            effects.extend(self.pass(0.04));
        }
        effects.extend(self.pass(2.0));
        effects
    }
}

fn stores(effects: &[Effect]) -> bool {
    effects.iter().any(|effect| matches!(effect, Effect::Store { .. }))
}

#[test]
fn an_image_that_was_taken_before_the_robot_moved_is_not_of_where_it_is() {
    // a command that takes three seconds
    let mut streaming = Streaming::new(true);
    let begun = streaming.bench.now;
    assert_eq!(streaming.bench.ask(Command::Take), [Effect::Grab]);
    let moved = streaming.nudge();
    assert!(!stores(&moved), "{moved:?}");
    let late = streaming.image(begun);
    assert!(!stores(&late), "{late:?}");
    // it is taken once more, and that one is of now
    let again = streaming.pass(0.2);
    assert!(late.contains(&Effect::Grab) || again.contains(&Effect::Grab), "{late:?} {again:?}");
    let now = streaming.image(streaming.bench.now);
    assert!(stores(&now), "{now:?}");
}

#[test]
fn a_file_that_came_right_after_the_standstill_may_be_of_before_it() {
    let mut streaming = Streaming::new(false);
    streaming.bench.ask(Command::Take);
    // no file comes for a moment, and the robot is nudged: it stands since one second when the file comes
    for _ in 0..5 {
        streaming.moved_m += 0.2e-3;
        streaming.pass(0.04);
    }
    streaming.pass(1.0);
    let early = streaming.image(streaming.bench.now);
    assert!(!stores(&early), "{early:?}");
    let why = streaming.bench.engine.view("", "").taking.unwrap().why;
    assert!(why.contains("before the standstill"), "{why}");
    streaming.pass(1.0);
    let sure = streaming.image(streaming.bench.now);
    assert!(stores(&sure), "{sure:?}");
}
