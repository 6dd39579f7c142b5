//! Poses typed from a pendant, images one by one.

use handeye::{Setup, math::random::Random};
use handeye_io::{CellSettings, Writing};
use handeye_session::{
    engine::{
        Command, Effect, Engine, Flow, FolderState, Input, Problem, Sources, Step,
        rest::ImageSample,
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
        let folder = FolderState {
            settings,
            captures: vec![],
            deleted: vec![],
            refused: vec![],
            touches: vec![],
        };
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
    let folder = FolderState {
        settings: bench.engine.settings().clone(),
        captures: vec![stored],
        deleted: vec![],
        refused: vec![],
        touches: vec![],
    };
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
