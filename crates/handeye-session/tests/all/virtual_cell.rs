//! A session from nothing to a result, played by a script.

use std::{fs, path::Path};

use handeye::{Config, Setup, Verdict};
use handeye_io::{Dataset, SessionFolder, calibrate::calibrate_dataset, read_result};
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    script::{Action, Player},
    sources::virtual_cell::{Faults, VirtualCell},
};

use crate::new_folder;

fn player(root: &Path, setup: Setup, seed: u64) -> Player {
    let cell = VirtualCell::new(setup, seed, Faults::default()).unwrap();
    let folder = SessionFolder::open(root, Some(&cell.settings())).unwrap();
    Player::new(Host::new(folder), cell)
}

fn begin(player: &mut Player) {
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).unwrap();
    }
    player.command(Command::Take).unwrap();
}

fn script(text: &str) -> Vec<Action> {
    serde_json::from_str(text).unwrap()
}

const UNTIL_ENOUGH: &str = r#"[{"repeat": [{"do": "drive", "to": "next"}, {"do": "take"}], "until": "enough", "most": 30}]"#;

#[test]
fn a_session_in_a_virtual_cell_ends_with_a_result_that_is_true() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let root = new_folder();
        let mut player = player(&root, setup, 7);
        begin(&mut player);
        player.play(&script(UNTIL_ENOUGH)).unwrap();
        let state = player.state();
        let progress = state.progress.as_ref().unwrap();
        assert!(progress.enough && progress.verdict == Verdict::Accepted, "{}", state.say);
        let stated = progress.p95_mm.unwrap();
        player.command(Command::Finish).unwrap();
        assert!(player.state().say.starts_with("Accepted"), "{}", player.state().say);

        let result = read_result(&root.join("result/calibration.json")).unwrap();
        let found = result.hand_eye.mount_from_camera.unwrap();
        let off_mm = found.distance_to(&player.cell().truth().mount_from_camera) * 1e3;
        println!(
            "{setup:?}: {} captures, {stated:.2} mm, off by {off_mm:.3} mm",
            progress.captures
        );
        assert!(off_mm < 0.5, "{off_mm}");

        // the folder is an ordinary dataset, with the same answer
        let dataset = Dataset::open(&root).unwrap();
        let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
        assert_eq!(again.hand_eye, result.hand_eye);
        assert_eq!(again.run_id, result.run_id);
        drop(player);
        fs::remove_dir_all(root).unwrap();
    }
}

#[test]
fn captures_are_deleted_restored_undone_and_skipped() {
    let root = new_folder();
    let mut player = player(&root, Setup::EyeInHand, 5);
    begin(&mut player);
    let one_more = script(r#"[{"do": "drive", "to": "next"}, {"do": "take"}]"#);
    (0..3).for_each(|_| player.play(&one_more).unwrap());
    let names = |player: &Player| -> Vec<String> {
        player.state().captures.iter().map(|c| c.id.clone()).collect()
    };
    assert_eq!(names(&player), ["001", "002", "003", "004"]);
    player.command(Command::Delete { id: "002".into() }).unwrap();
    assert_eq!(names(&player), ["001", "003", "004"]);
    assert_eq!(player.state().deleted[0].id, "002");
    player.command(Command::Undo).unwrap();
    assert_eq!(names(&player), ["001", "002", "003", "004"]);
    player.command(Command::Undo).unwrap(); // the last capture
    assert_eq!(names(&player), ["001", "002", "003"]);
    player.command(Command::Restore { id: "004".into() }).unwrap();
    assert_eq!(names(&player), ["001", "002", "003", "004"]);
    for (command, said) in [
        (Command::Delete { id: "017".into() }, "no capture 017"),
        (Command::Restore { id: "001".into() }, "no deleted capture 001"),
        (Command::Go { step: Step::Result }, "not open yet"),
        (Command::Cell { setup: None, tolerance_mm: Some(-1.0) }, "positive"),
        (Command::Cell { setup: Some(Setup::EyeToHand), tolerance_mm: None }, "its own setup"),
        (Command::Notation { name: "robo".into(), reread: false }, "there are matrix4x4"),
        (Command::Pose { text: "1 2 3".into() }, "none are typed"),
    ] {
        let why = player.command(command).unwrap_err();
        assert!(why.contains(said), "{why}");
    }
    // a capture that is taken again is taken where it was
    let there = player.state().captures[2].base_from_flange;
    player.command(Command::Retake { id: "003".into() }).unwrap();
    let next = player.state().next.unwrap();
    assert_eq!((names(&player).len(), &next.reason[..]), (3, "as capture 003 was taken"));
    assert!(next.base_from_flange.distance_to(&there) < 1e-9);
    player.play(&one_more).unwrap();
    assert_eq!(names(&player), ["001", "002", "004", "005"]);
    assert!(player.state().captures[3].base_from_flange.distance_to(&there) < 1e-3);
    assert!(!player.state().next.unwrap().reason.starts_with("as capture"));
    // a view that nobody can go to is not proposed again, nor anything near it
    let before = player.state().next.unwrap().base_from_flange;
    player.command(Command::Skip { why: "cannot reach".into() }).unwrap();
    let after = player.state().next.unwrap().base_from_flange;
    assert!(after.distance_to(&before) > 0.05 || after.angle_to(&before) > 0.1);
    // the tolerance may change at any time
    player.command(Command::Cell { setup: None, tolerance_mm: Some(5.0) }).unwrap();
    assert_eq!(Dataset::open(&root).unwrap().limits.max_error, Some(5e-3));
    assert_eq!(names(&player).len(), 4);
    drop(player);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn where_the_board_is_not_seen_no_capture_is_taken() {
    let root = new_folder();
    let mut player = player(&root, Setup::EyeInHand, 5);
    begin(&mut player);
    // the camera looks away
    player.command(Command::Jog { move_mm: [0.0; 3], turn_deg: [0.0, 60.0, 0.0] }).unwrap();
    player.command(Command::Take).unwrap();
    let state = player.state();
    assert_eq!(state.captures.len(), 1);
    assert!(state.refused[0].why.contains("the board is not found"), "{}", state.refused[0].why);
    assert_eq!(state.problem.unwrap().code, "not-taken");
    drop(player);
    // it is remembered: nobody is sent there again
    let folder = SessionFolder::open(&root, None).unwrap();
    assert!(folder.refused()[0].base_from_flange.is_some());
    drop(folder);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn corners_are_touched_and_judge_the_answer() {
    let root = new_folder();
    let mut player = player(&root, Setup::EyeInHand, 9);
    begin(&mut player);
    let refused = player.command(Command::Touch { corner: None }).unwrap_err();
    assert!(refused.contains("in the steps `touch` and `verify`"), "{refused}");
    player.play(&script(UNTIL_ENOUGH)).unwrap();
    player.command(Command::Go { step: Step::Touch }).unwrap();
    let mut corners = vec![];
    for _ in 0..6 {
        corners.push(player.state().touch.unwrap().corner);
        player.play(&script(r#"[{"do": "drive", "to": "touch"}, {"do": "touch"}]"#)).unwrap();
    }
    // the outermost first
    corners[..4].sort_unstable();
    assert_eq!(corners[..4], [0, 8, 45, 53]);
    let touch = player.state().touch.unwrap();
    println!("{} touches, {:?} mm from the answer", touch.touches.len(), touch.rms_mm);
    assert!(touch.touches.len() == 6 && touch.rms_mm.unwrap() < 0.5, "{touch:?}");

    // without moving the tip there is no further one
    let still = player.command(Command::Touch { corner: Some(20) }).unwrap_err();
    assert!(still.contains("the tip is still where it touched corner"), "{still}");

    // some are taken out
    player.command(Command::Undo).unwrap();
    assert_eq!(player.state().touch.unwrap().touches.len(), 5);
    player.command(Command::Untouch { id: "t02".into() }).unwrap();
    let names = |player: &Player| -> Vec<String> {
        player.state().touch.unwrap().touches.into_iter().map(|t| t.id).collect()
    };
    assert_eq!(names(&player), ["t01", "t03", "t04", "t05"]);
    player.command(Command::Finish).unwrap();
    let result = read_result(&root.join("result/calibration.json")).unwrap();
    assert_eq!(result.touches.len(), 4);
    assert_eq!(result.verdict, Verdict::Accepted, "{:?}", result.reasons);
    // and an ordinary dataset it is
    let dataset = Dataset::open(&root).unwrap();
    let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
    assert_eq!(again.run_id, result.run_id);

    // a corner that is not the one that was touched is named
    player.command(Command::Go { step: Step::Touch }).unwrap();
    player.play(&script(r#"[{"do": "drive", "to": "touch"}]"#)).unwrap();
    let there = player.state().touch.unwrap().corner;
    player.command(Command::Touch { corner: Some((there + 9) % 54) }).unwrap();
    let state = player.state();
    assert!(state.say.contains("is rejected as an outlier: the tip was"), "{}", state.say);
    player.command(Command::Finish).unwrap();
    let headline = player.state().result.unwrap().headline;
    let said = "Accepted, but: the touch of corner";
    assert!(headline.starts_with(said), "{headline}");
    drop(player);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn a_capture_that_repeats_another_keeps_nobody_from_finishing() {
    let root = new_folder();
    let mut player = player(&root, Setup::EyeInHand, 6);
    begin(&mut player);
    player.play(&script(UNTIL_ENOUGH)).unwrap();
    let count = player.state().captures.len();
    player.command(Command::Take).unwrap();
    assert_eq!(player.state().captures.len(), count + 1);
    player.command(Command::Finish).unwrap();
    assert!(player.state().say.starts_with("Accepted"), "{}", player.state().say);
    drop(player);
    fs::remove_dir_all(root).unwrap();
}
