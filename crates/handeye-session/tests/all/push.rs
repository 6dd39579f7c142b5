//! Captures that a program hands over: image and pose, one after the other.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use handeye::{Config, GrayImage, Scan, Setup, Verdict};
use handeye_io::{Dataset, Writing, calibrate::calibrate_dataset, simulated};
use handeye_session::{
    push::{Declared, PushError, Pushed, PushedPose, PushedSession, image_in, with_scan},
    sources::{
        outlet::CameraImage,
        virtual_cell::{Faults, VirtualCell},
    },
};

use crate::new_folder;

/// A program with a robot and a camera.
struct Program {
    cell: VirtualCell,
    root: PathBuf,
    now: f64,
}

/// What it knows of its cell.
fn declared(cell: &VirtualCell) -> Declared {
    let settings = cell.settings();
    let camera = settings.intrinsics.unwrap();
    let keys = serde_json::json!({
        "fx": camera.fx, "fy": camera.fy, "cx": camera.cx, "cy": camera.cy, "distortion_model": "none"
    });
    Declared {
        setup: Some(settings.setup),
        target: Some(settings.target),
        camera_json: Some(keys.to_string()),
        tolerance_mm: Some(0.5),
        notation: Some("kuka".into()),
        tip_mm: settings.tip_mm,
    }
}

impl Program {
    fn new(seed: u64) -> Self {
        Self::of(Setup::EyeInHand, seed)
    }

    fn of(setup: Setup, seed: u64) -> Self {
        let cell = VirtualCell::new(setup, seed, Faults::default()).unwrap();
        let root = new_folder();
        fs::create_dir_all(&root).unwrap();
        Self { cell, root, now: 0.0 }
    }

    fn folder(&self) -> PathBuf {
        self.root.join("cell")
    }

    fn open(&self) -> PushedSession {
        PushedSession::open(&self.folder(), &declared(&self.cell)).unwrap()
    }

    fn image(&self) -> CameraImage {
        CameraImage::in_memory(Arc::new(self.cell.image(self.now, 1)))
    }

    fn pose(&self) -> PushedPose {
        PushedPose::Known(self.cell.sample(self.now).base_from_flange)
    }

    /// Drives to the proposed view, or to one of its own.
    fn drive(&mut self, session: &PushedSession, number: usize) {
        match session.state().next {
            Some(next) => self.cell.drive(next.base_from_flange, self.now),
            None => self.cell.show_board(number, self.now).unwrap(),
        }
        self.now += 20.0;
    }

    /// Brings the tip to the proposed corner, and touches it.
    fn touch(&mut self, session: &mut PushedSession) -> Result<String, PushError> {
        let corner = session.state().touch.unwrap().corner;
        self.cell.drive_tip(corner, self.now);
        self.now += 20.0;
        session.touch(self.pose(), None)
    }

    fn push(&self, session: &mut PushedSession) -> Result<Pushed, PushError> {
        session.push(self.pose(), self.image())
    }

    /// Takes so many captures.
    fn take(&mut self, session: &mut PushedSession, count: usize) {
        for _ in 0..count {
            let number = session.state().captures.len();
            self.drive(session, number);
            assert!(matches!(self.push(session).unwrap(), Pushed::Taken(_)));
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.root).ok();
    }
}

fn names(session: &PushedSession) -> Vec<String> {
    session.state().captures.iter().map(|c| c.id.clone()).collect()
}

fn blank() -> CameraImage {
    let grey = GrayImage::new(1280, 800, vec![90.0; 1280 * 800]).unwrap();
    CameraImage::in_memory(Arc::new(grey))
}

#[track_caller]
fn refuses<T>(done: Result<T, PushError>, said: &str) {
    let why = done.err().expect("a refusal").to_string();
    assert!(why.contains(said), "{why}");
}

#[test]
fn a_program_is_led_to_a_result_that_is_true() {
    let mut program = Program::new(3);
    let mut session = program.open();
    assert!(session.state().say.contains("take the first capture"), "{}", session.state().say);
    for number in 0..30 {
        program.drive(&session, number);
        let taken = program.push(&mut session).unwrap();
        assert_eq!(taken, Pushed::Taken(format!("{:03}", number + 1)));
        if session.state().progress.unwrap().enough {
            break;
        }
    }
    let state = session.state();
    assert!(state.progress.unwrap().enough && state.captures.len() < 15, "{}", state.say);
    let finished = session.finish().unwrap();
    assert_eq!(finished.calibration.verdict, Verdict::Accepted);
    let found = finished.calibration.hand_eye.mount_from_camera.unwrap();
    let off = found.distance_to(&program.cell.truth().mount_from_camera);
    assert!(off < 1e-3, "{off}");
    assert!(session.state().say.starts_with("Accepted"), "{}", session.state().say);

    // the folder says the same by itself
    let dataset = Dataset::open(&program.folder()).unwrap();
    let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
    assert_eq!(again, finished.calibration);
    // and captures can follow a result
    program.take(&mut session, 1);
    assert!(session.state().result.is_none());
}

/// All files of a folder, by name.
fn files(root: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let entries = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    let mut all: Vec<_> = entries
        .flat_map(|path| match path.is_dir() {
            true => files(&path),
            false => vec![(path.clone(), fs::read(path).unwrap())],
        })
        .collect();
    all.sort();
    all
}

#[test]
fn the_same_pushes_give_the_same_bytes() {
    let run = |interrupted: bool| {
        let mut program = Program::new(4);
        let mut session = program.open();
        program.take(&mut session, 2);
        session.push(program.pose(), blank()).unwrap();
        if interrupted {
            drop(session);
            session = program.open();
        }
        program.take(&mut session, 3);
        session.finish().unwrap();
        let named = |(path, bytes): (PathBuf, Vec<u8>)| {
            (path.strip_prefix(program.folder()).unwrap().to_path_buf(), bytes)
        };
        let all: Vec<_> = files(&program.folder()).into_iter().map(named).collect();
        assert!(all.iter().any(|(path, _)| path.ends_with("result/report.html")));
        all
    };
    let (first, again, interrupted) = (run(false), run(false), run(true));
    let differ = |other: &[(PathBuf, Vec<u8>)]| -> Vec<PathBuf> {
        first.iter().zip(other).filter(|(a, b)| a != b).map(|(a, _)| a.0.clone()).collect()
    };
    assert_eq!(differ(&again), [] as [PathBuf; 0]);
    assert_eq!(differ(&interrupted), [] as [PathBuf; 0]);
    assert_eq!((again.len(), interrupted.len()), (first.len(), first.len()));
}

#[test]
fn a_session_goes_on_and_nobody_else_writes_to_its_folder() {
    let mut program = Program::new(5);
    let mut session = program.open();
    program.take(&mut session, 4);
    let known = session.state().progress.unwrap().p95_mm;
    refuses(PushedSession::open(&program.folder(), &Declared::default()), "in use by another");
    drop(session);

    let mut session = PushedSession::open(&program.folder(), &Declared::default()).unwrap();
    assert_eq!(session.state().progress.unwrap().p95_mm, known);
    assert_eq!(session.state().cell.notation, "kuka");
    session.delete("002").unwrap();
    assert_eq!(names(&session), ["001", "003", "004"]);
    refuses(session.delete("002"), "no capture 002");
    session.restore("002").unwrap();
    assert_eq!(session.state().progress.unwrap().p95_mm, known);
    session.undo().unwrap();
    assert_eq!(names(&session), ["001", "003", "004"]);
    session.undo().unwrap();
    refuses(session.undo(), "nothing to undo");
    let next = session.state().next.unwrap().base_from_flange;
    session.skip().unwrap();
    assert!(session.state().next.unwrap().base_from_flange.distance_to(&next) > 1e-3);
    program.take(&mut session, 1);
    assert_eq!(names(&session).last().unwrap(), "005");
    drop(session);

    let other = Declared { setup: Some(Setup::EyeToHand), ..Declared::default() };
    refuses(PushedSession::open(&program.folder(), &other), "begin a session in a new folder");
    let tighter = Declared { tolerance_mm: Some(0.2), ..declared(&program.cell) };
    let session = PushedSession::open(&program.folder(), &tighter).unwrap();
    assert_eq!(session.state().cell.tolerance_mm, 0.2);
}

#[test]
fn what_cannot_be_is_refused_and_nothing_is_lost() {
    let mut program = Program::new(6);
    let nothing = Declared::default();
    refuses(PushedSession::open(&program.folder(), &nothing), "setup and target");
    for (wrong, said) in [
        (Declared { tolerance_mm: Some(f64::NAN), ..declared(&program.cell) }, "positive"),
        (Declared { notation: Some("robo".into()), ..declared(&program.cell) }, "kuka"),
        (Declared { camera_json: Some("{\"fx\": 1}".into()), ..declared(&program.cell) }, "fy"),
        (Declared { camera_json: Some("[]".into()), ..declared(&program.cell) }, "no intrinsics"),
    ] {
        // the size of the images is asked for before the rest
        let opened = PushedSession::open(&program.folder(), &wrong);
        refuses(opened.and_then(|mut session| program.push(&mut session)), said);
        fs::remove_dir_all(program.folder()).ok();
    }
    let mut session = program.open();
    // an image without the board, the first one already
    let unseen = session.push(program.pose(), blank()).unwrap();
    assert!(matches!(&unseen, Pushed::Unseen(why) if why.contains("not found")), "{unseen:?}");
    program.take(&mut session, 4);
    let before = fs::read(program.folder().join("robot.csv")).unwrap();

    let PushedPose::Known(pose) = program.pose() else { panic!() };
    let numbers = Writing::of("kuka").unwrap().numbers(&pose);
    let typed = |scale: f64| {
        let text = |(k, x): (usize, &f64)| (if k < 3 { x * scale } else { *x }).to_string();
        let all: Vec<String> = numbers.iter().enumerate().map(text).collect();
        PushedPose::Typed(all.join(" "))
    };
    let mut scaled = *pose.iso();
    scaled.translation.vector *= 1e3;
    let in_mm = PushedPose::Known(handeye::Pose::claim(scaled));
    for (pose, image, said) in [
        (typed(1e-3), program.image(), "are its lengths in another unit"),
        (in_mm, program.image(), "are its lengths in another unit"),
        (PushedPose::Typed("1 2 3".into()), program.image(), "3 numbers"),
        (PushedPose::Typed("up a bit".into()), program.image(), "something else than numbers"),
        (
            typed(1.0),
            CameraImage::in_memory(Arc::new(GrayImage::new(64, 48, vec![0.0; 3072]).unwrap())),
            "the images have 64 x 48 pixels",
        ),
    ] {
        refuses(session.push(pose, image), said);
    }
    // a pose that was not read anew
    let stuck = program.pose();
    session.push(stuck.clone(), program.image()).unwrap();
    program.drive(&session, 7);
    let moved = program.image();
    let PushedPose::Known(pose) = stuck else { panic!() };
    refuses(session.push(PushedPose::Known(pose), moved), "the pose was not read anew");

    session.delete("005").unwrap();
    assert_eq!(fs::read(program.folder().join("robot.csv")).unwrap(), before);
    assert!(matches!(program.push(&mut session).unwrap(), Pushed::Taken(id) if id == "006"));
    assert_eq!(session.state().refused.len(), 2);
}

#[test]
fn numbers_as_typed_and_files_as_they_are_lie_in_the_folder() {
    let mut program = Program::new(7);
    let mut session = program.open();
    let file = program.root.join("shot.PNG");
    let png = simulated::picture(&program.cell.image(0.0, 1));
    fs::write(&file, &png).unwrap();
    let PushedPose::Known(pose) = program.pose() else { panic!() };
    let numbers = Writing::of("kuka").unwrap().numbers(&pose);
    let text: Vec<String> = numbers.iter().map(f64::to_string).collect();
    session.push(PushedPose::Typed(text.join(" ")), image_in(&file).unwrap()).unwrap();
    assert_eq!(fs::read(program.folder().join("images/001.png")).unwrap(), png);
    let journal = fs::read_to_string(program.folder().join("journal.jsonl")).unwrap();
    assert!(journal.contains("\"typed\":["), "{journal}");
    assert!(session.state().captures[0].base_from_flange.distance_to(&pose) < 1e-12);
    // a scan goes with every capture, or with none
    let cloud = Scan::new(2, 1, vec![[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]]).unwrap();
    refuses(session.push(program.pose(), with_scan(program.image(), &cloud)), "have no scans");
    let nowhere = image_in(&program.root.join("nowhere.png")).unwrap_err();
    assert!(nowhere.to_string().contains("does not exist"), "{nowhere}");

    // without intrinsics images have one size
    let root = program.root.join("open");
    let free = Declared { camera_json: None, ..declared(&program.cell) };
    let mut session = PushedSession::open(&root, &free).unwrap();
    program.take(&mut session, 1);
    drop(session);
    let mut session = PushedSession::open(&root, &Declared::default()).unwrap();
    let small = CameraImage::in_memory(Arc::new(GrayImage::new(64, 48, vec![0.0; 3072]).unwrap()));
    refuses(session.push(program.pose(), small), "those before it have 1280 x 800");
}

/// Whether the folder's own result is the session's.
#[track_caller]
fn assert_is_of_folder(program: &Program, session: &mut PushedSession) -> handeye::Calibration {
    let found = session.finish().unwrap().calibration;
    let dataset = Dataset::open(&program.folder()).unwrap();
    let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
    assert_eq!(again, found);
    found
}

#[test]
fn corners_are_touched_and_the_result_is_made_with_them() {
    let mut program = Program::new(7);
    let mut session = program.open();
    refuses(session.touch(program.pose(), None), "first captures are taken");
    program.take(&mut session, 6);
    let seen = program.image();
    let error = |session: &PushedSession| session.state().progress.unwrap().p95_mm.unwrap();
    let before = error(&session);
    refuses(session.place(program.image(), None), "no other one is laid down");
    for number in 1..=4 {
        assert_eq!(program.touch(&mut session).unwrap(), format!("t{number:02}"));
    }
    let state = session.state();
    let touched = state.touch.unwrap();
    assert_eq!(touched.touches.len(), 4);
    assert!(touched.touches.iter().all(|t| t.used && t.residual_mm.unwrap() < 1.5), "{touched:?}");
    assert!(error(&session) < before, "{} {before}", error(&session));
    assert!(state.say.starts_with("Bring the tip to corner"), "{}", state.say);

    // a pose that was not read anew, none of the board's corners, no pose
    let stale = PushedPose::Known(session.state().captures[5].base_from_flange);
    refuses(session.touch(stale, None), "the robot's pose is that of capture 006");
    refuses(session.touch(program.pose(), None), "still where it touched corner");
    program.cell.drive_tip(touched.corner, program.now);
    program.now += 20.0;
    refuses(session.touch(program.pose(), Some(54_321)), "no corner 54321");
    refuses(session.touch(PushedPose::Typed("1 2 3".into()), None), "3 numbers");
    assert_eq!(session.touch(program.pose(), Some(touched.corner)).unwrap(), "t05");

    refuses(session.push(program.pose(), seen), "the robot's pose is that of the touch t05");

    let names = |session: &PushedSession| -> Vec<String> {
        session.state().touch.unwrap().touches.into_iter().map(|t| t.id).collect()
    };
    let (all, without) = (["t01", "t02", "t03", "t04", "t05"], ["t01", "t03", "t04", "t05"]);
    session.untouch("t02").unwrap();
    assert_eq!(names(&session), without);
    refuses(session.untouch("t02"), "no touch t02");
    session.restore("t02").unwrap();
    assert_eq!(names(&session), all);
    session.undo().unwrap();
    assert_eq!(names(&session), without);
    session.undo().unwrap();
    assert_eq!(names(&session), all);
    session.undo().unwrap(); // the last touch
    assert_eq!(names(&session), all[..4]);
    session.restore("t05").unwrap();
    assert_eq!(names(&session), all);
    // captures may follow, and another who opens the folder finds all of it
    program.take(&mut session, 1);
    let found = assert_is_of_folder(&program, &mut session);
    assert_eq!(found.touches.iter().filter(|touch| touch.used).count(), 5);
    drop(session);
    session = program.open();
    assert_eq!(names(&session).len(), 5);
}

#[test]
fn a_tip_is_needed_and_one_that_no_tool_has_is_refused() {
    let mut program = Program::new(7);
    let open = |tip_mm| {
        PushedSession::open(&program.folder(), &Declared { tip_mm, ..declared(&program.cell) })
    };
    refuses(open(Some([0.0, f64::NAN, 1.0])), "three numbers of millimetres");
    refuses(open(Some([0.0; 3])), "three numbers of millimetres");
    let mut session = open(None).unwrap();
    program.take(&mut session, 2);
    refuses(session.touch(program.pose(), Some(0)), "where the tool's tip is");
    drop(session);
    // who opens it again may say it
    session = program.open();
    assert_eq!(session.state().touch.unwrap().tip_mm, program.cell.settings().tip_mm);
    program.touch(&mut session).unwrap();
}

#[test]
fn boards_are_laid_into_the_view_and_touched() {
    let mut program = Program::of(Setup::EyeToHand, 9);
    let mut session = program.open();
    program.take(&mut session, 5);
    refuses(program.touch(&mut session), "cannot touch the board that it carries");
    program.drive(&session, 0);
    let carried = session.place(program.image(), Some(program.pose()));
    refuses(carried, "the board that the robot carries");
    for number in 1..=2 {
        program.cell.lay(program.now);
        program.now += 20.0;
        let unseen = session.place(blank(), None).unwrap();
        assert!(matches!(&unseen, Pushed::Unseen(why) if why.contains("not found")), "{unseen:?}");
        let placed = session.place(program.image(), Some(program.pose())).unwrap();
        assert_eq!(placed, Pushed::Taken(format!("p{number:02}")));
        refuses(session.place(program.image(), None), "still lies as in placement");
        for _ in 0..3 {
            program.touch(&mut session).unwrap();
        }
    }
    let touched = session.state().touch.unwrap();
    assert_eq!(touched.placements.iter().map(|p| p.touches).collect::<Vec<_>>(), [3, 3]);
    assert!(touched.touches.iter().all(|t| t.used && t.residual_mm.unwrap() < 2.0), "{touched:?}");
    program.cell.take_away();
    let found = assert_is_of_folder(&program, &mut session);
    assert_eq!(found.touches.len(), 6);
    session.delete("p01").unwrap();
    assert_eq!(session.state().touch.unwrap().touches.len(), 3);
    session.restore("p01").unwrap();
    refuses(session.retake("p01"), "no capture p01");
    // where the board of the one before lay, none lies now
    session.delete("p02").unwrap();
    refuses(session.touch(program.pose(), Some(1)), "cannot touch the board that it carries");
}

#[test]
fn a_capture_is_taken_again_from_its_view() {
    let mut program = Program::new(8);
    let mut session = program.open();
    program.take(&mut session, 6);
    refuses(session.retake("009"), "no capture 009");
    let poses = |session: &PushedSession| session.state().captures[1].base_from_flange;
    let wanted = poses(&session);
    session.retake("002").unwrap();
    assert_eq!(session.state().captures.len(), 5);
    let next = session.state().next.unwrap().base_from_flange;
    assert!(next.distance_to(&wanted) < 1e-9, "{next:?} {wanted:?}");
    // what is done with touches leaves it; a capture that stands again need not be taken again
    let is_proposed = |session: &PushedSession| {
        session.state().next.is_some_and(|next| next.base_from_flange.distance_to(&wanted) < 1e-9)
    };
    program.touch(&mut session).unwrap();
    assert!(is_proposed(&session));
    session.restore("002").unwrap();
    assert!(!is_proposed(&session));
    session.retake("002").unwrap();
    program.drive(&session, 0);
    assert_eq!(program.push(&mut session).unwrap(), Pushed::Taken("007".into()));
    assert!(!is_proposed(&session));
}
