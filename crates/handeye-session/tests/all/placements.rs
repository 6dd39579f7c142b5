//! Corners of boards that are laid into the view of a camera beside the robot.

use std::{fs, path::Path};

use handeye::{Config, Setup, Verdict};
use handeye_io::{Dataset, SessionFolder, calibrate::calibrate_dataset, read_result};
use handeye_session::{
    engine::{Command, Destination, Step, shown::TouchView},
    host::Host,
    script::{Action, Player},
    sources::virtual_cell::{Faults, VirtualCell},
};

use crate::new_folder;

fn player(root: &Path, setup: Setup) -> Player {
    let cell = VirtualCell::new(setup, 9, Faults::default()).unwrap();
    let folder = SessionFolder::open(root, Some(&cell.settings())).unwrap();
    Player::new(Host::new(folder), cell)
}

fn play(player: &mut Player, text: &str) {
    let actions: Vec<Action> = serde_json::from_str(text).unwrap();
    player.play(&actions).unwrap();
}

/// A session with captures that are enough, or so many, at the step of the touches.
fn with_captures(root: &Path, setup: Setup, count: usize) -> Player {
    let mut player = player(root, setup);
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).unwrap();
    }
    player.command(Command::Take).unwrap();
    let goes_on = |player: &Player| {
        let state = player.state();
        state.captures.len() < count && !state.progress.is_some_and(|p| p.enough)
    };
    while goes_on(&player) {
        play(&mut player, r#"[{"do": "drive", "to": "next"}, {"do": "take"}]"#);
    }
    player.command(Command::Go { step: Step::Touch }).unwrap();
    player
}

const PLACE: &str = r#"[{"do": "drive", "to": "placement"}, {"wait_s": 3}, {"do": "place"}]"#;
const TOUCH: &str = r#"[{"do": "drive", "to": "touch"}, {"do": "touch"}]"#;

fn touches(player: &Player) -> TouchView {
    player.state().touch.unwrap()
}

fn names(player: &Player) -> Vec<String> {
    touches(player).touches.into_iter().map(|t| t.id).collect()
}

fn placements(player: &Player) -> Vec<(String, usize)> {
    touches(player).placements.into_iter().map(|p| (p.id, p.touches)).collect()
}

/// The result that the session wrote is what the folder gives.
fn assert_same_bytes(root: &Path) {
    let result = read_result(&root.join("result/calibration.json")).unwrap();
    let dataset = Dataset::open(root).unwrap();
    let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
    assert_eq!(again.run_id, result.run_id);
    assert_eq!(again.hand_eye, result.hand_eye);
    assert_eq!(again.touches, result.touches);
}

#[test]
fn corners_of_a_board_that_is_laid_into_the_view_are_touched() {
    let root = new_folder();
    let mut player = with_captures(&root, Setup::EyeToHand, 30);
    let said = player.state().say;
    assert!(said.starts_with("Lay the board, or another of the same kind"), "{said}");
    let early = player.command(Command::Touch { corner: None }).unwrap_err();
    assert!(early.contains("cannot touch the board that it carries"), "{early}");

    // as long as no other board lies there, the camera sees that one
    let carried = player.command(Command::Place).unwrap_err();
    assert!(carried.contains("this is the board that the robot carries"), "{carried}");

    play(&mut player, PLACE);
    assert_eq!(placements(&player), [("p01".into(), 0)]);
    assert!(root.join("placements/p01.png").is_file());
    let again = player.command(Command::Place).unwrap_err();
    assert!(again.contains("the board still lies as in placement p01"), "{again}");

    let mut corners = vec![];
    for _ in 0..6 {
        corners.push(touches(&player).corner);
        play(&mut player, TOUCH);
    }
    corners[..4].sort_unstable();
    assert_eq!(corners[..4], [0, 8, 45, 53]);
    let touch = touches(&player);
    println!("{} touches, {:?} mm from the answer", touch.touches.len(), touch.rms_mm);
    assert!(touch.touches.iter().all(|t| t.placement.as_deref() == Some("p01") && t.used));
    assert!(touch.rms_mm.unwrap() < 0.5, "{touch:?}");
    player.command(Command::Finish).unwrap();
    let result = read_result(&root.join("result/calibration.json")).unwrap();
    assert_eq!(result.touches.len(), 6);
    assert_eq!(result.verdict, Verdict::Accepted, "{:?}", result.reasons);
    let off_mm = result.hand_eye.mount_from_camera.unwrap();
    let off_mm = off_mm.distance_to(&player.cell().truth().mount_from_camera) * 1e3;
    println!("off by {off_mm:.3} mm");
    assert!(off_mm < 0.5, "{off_mm}");
    assert_same_bytes(&root);

    // the next placement begins with the outermost corners again, and a wrong one is named
    player.command(Command::Go { step: Step::Touch }).unwrap();
    play(&mut player, PLACE);
    let there = touches(&player).corner;
    assert!([0, 8, 45, 53].contains(&there), "{there}");
    // a tip that is moved away from its corner is not there any more
    player.command(Command::Drive { to: Destination::Touch }).unwrap();
    assert!(touches(&player).at_corner);
    player.command(Command::Jog { move_mm: [0.0, 0.0, -40.0], turn_deg: [0.0; 3] }).unwrap();
    assert!(player.state().robot.stands && !touches(&player).at_corner);
    player.command(Command::Drive { to: Destination::Touch }).unwrap();
    player.command(Command::Touch { corner: Some((there + 9) % 54) }).unwrap();
    let said = player.state().say;
    assert!(said.contains(&format!("The touch of corner {}", (there + 9) % 54)), "{said}");
    assert!(said.contains("is rejected as an outlier: the tip was"), "{said}");
    player.command(Command::Finish).unwrap();
    let headline = player.state().result.unwrap().headline;
    assert!(headline.starts_with("Accepted, but: the touch of corner"), "{headline}");
    assert_same_bytes(&root);
    drop(player);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn placements_and_touches_are_deleted_undone_and_gone_on_with() {
    let root = new_folder();
    let mut player = with_captures(&root, Setup::EyeToHand, 6);
    play(&mut player, PLACE);
    (0..2).for_each(|_| play(&mut player, TOUCH));
    play(&mut player, PLACE);
    play(&mut player, TOUCH);
    assert_eq!(placements(&player), [("p01".into(), 2), ("p02".into(), 1)]);

    // a touch comes back, by undoing and by its name
    player.command(Command::Untouch { id: "t01".into() }).unwrap();
    assert_eq!(names(&player), ["t02", "t03"]);
    assert_eq!(player.state().deleted[0].id, "t01");
    player.command(Command::Undo).unwrap();
    assert_eq!(names(&player), ["t01", "t02", "t03"]);
    player.command(Command::Untouch { id: "t02".into() }).unwrap();
    player.command(Command::Restore { id: "t02".into() }).unwrap();
    assert_eq!(names(&player), ["t01", "t02", "t03"]);
    player.command(Command::Undo).unwrap();
    player.command(Command::Undo).unwrap();
    assert_eq!(names(&player), ["t01", "t02", "t03"]);

    // with the captures goes the board that lay there
    player.command(Command::Go { step: Step::Capture }).unwrap();
    player.command(Command::Go { step: Step::Touch }).unwrap();
    let why = player.command(Command::Drive { to: Destination::Touch }).unwrap_err();
    assert!(why.contains("first lay a board into the view"), "{why}");

    // with a placement its touches go and come
    player.command(Command::Delete { id: "p01".into() }).unwrap();
    assert_eq!(placements(&player), [("p02".into(), 1)]);
    assert_eq!(names(&player), ["t03"]);
    assert!(root.join("deleted/placements/p01.png").is_file());
    player.command(Command::Undo).unwrap();
    assert_eq!(names(&player), ["t01", "t02", "t03"]);
    player.command(Command::Undo).unwrap(); // the last touch
    player.command(Command::Undo).unwrap(); // the second placement
    assert_eq!(placements(&player), [("p01".into(), 2)]);
    player.command(Command::Finish).unwrap();
    assert_same_bytes(&root);

    // nothing is lost with the session
    let before = touches(&player);
    drop(player);
    let cell = VirtualCell::new(Setup::EyeToHand, 9, Faults::default()).unwrap();
    let mut player = Player::new(Host::new(SessionFolder::open(&root, None).unwrap()), cell);
    player.command(Command::Go { step: Step::Touch }).unwrap();
    assert_eq!(touches(&player).touches, before.touches);
    assert_eq!(placements(&player), [("p01".into(), 2)]);
    assert_eq!(player.state().deleted.len(), 1);
    drop(player);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn a_board_that_lies_already_is_not_laid_down() {
    let root = new_folder();
    let mut player = with_captures(&root, Setup::EyeInHand, 4);
    let why = player.command(Command::Place).unwrap_err();
    assert!(why.contains("lies where it is touched"), "{why}");
    drop(player);
    fs::remove_dir_all(root).unwrap();
}
