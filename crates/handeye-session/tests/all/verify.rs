//! Views that verify the captures: they say whether the answer still holds, and are no part of it.

use std::{fs, path::Path};

use handeye::{
    Base, Config, Flange, Pose, Setup,
    nalgebra::{Isometry3, Vector3},
};
use handeye_io::{Dataset, SessionFolder, calibrate::calibrate_dataset, read_result};
use handeye_session::{
    engine::{Command, Destination, Step, shown::VerifyView},
    host::Host,
    script::Player,
    sources::{
        mistakes::Event,
        virtual_cell::{Faults, VirtualCell},
    },
};

use crate::new_folder;

fn player(root: &Path, setup: Setup) -> Player {
    let cell = VirtualCell::new(setup, 7, Faults::default()).unwrap();
    let folder = SessionFolder::open(root, Some(&cell.settings())).unwrap();
    Player::new(Host::new(folder), cell)
}

/// A session whose captures are enough, at the step `verify`.
fn calibrated(root: &Path, setup: Setup) -> Player {
    let mut player = player(root, setup);
    let early = player.command(Command::Go { step: Step::Verify }).unwrap_err();
    assert!(early.contains("first captures are taken"), "{early}");
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).unwrap();
    }
    player.command(Command::Take).unwrap();
    while !player.state().progress.is_some_and(|p| p.enough) {
        player.command(Command::Drive { to: Destination::Next }).unwrap();
        player.command(Command::Take).unwrap();
        assert!(player.state().captures.len() < 30);
    }
    assert!(player.state().next.is_none(), "enough is enough");
    player.command(Command::Go { step: Step::Verify }).unwrap();
    player
}

fn view(player: &mut Player) {
    player.command(Command::Drive { to: Destination::Next }).unwrap();
    player.command(Command::Take).unwrap();
}

#[test]
fn views_that_agree_verify_the_result_and_are_no_part_of_it() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let root = new_folder();
        let mut player = calibrated(&root, setup);
        let captures = player.state().captures.len();
        assert!(player.state().say.contains("not made with it"), "{}", player.state().say);
        let refused = player.command(Command::Confirm { step: Step::Verify }).unwrap_err();
        assert!(refused.contains("no view has been taken and no corner touched"), "{refused}");
        (0..3).for_each(|_| view(&mut player));
        let state = player.state();
        let verified = state.verify.unwrap();
        assert_eq!(verified.agrees, Some(true), "{verified:?}");
        let names: Vec<&str> = verified.views.iter().map(|v| &v.id[..]).collect();
        assert_eq!(names, ["v01", "v02", "v03"]);
        assert!(verified.views.iter().all(|v| v.distance_mm.is_some_and(|mm| mm < 2.0)));
        assert_eq!(state.captures.len(), captures);
        assert!(state.say.starts_with("Verified by 3 views"), "{}", state.say);

        player.command(Command::Confirm { step: Step::Verify }).unwrap();
        let said = player.state().say;
        assert!(said.starts_with("Accepted") && said.contains("verified by 3 views"), "{said}");
        let result = read_result(&root.join("result/calibration.json")).unwrap();
        assert_eq!(result.captures.len(), captures);
        let (again, _) =
            calibrate_dataset(&Dataset::open(&root).unwrap(), &Config::default(), &|_, _| {})
                .unwrap();
        assert_eq!(again.run_id, result.run_id);
        drop(player);

        // they are there when the session goes on
        let folder = SessionFolder::open(&root, None).unwrap();
        let kept: Vec<_> = folder.verification().iter().map(|v| v.image.clone().unwrap()).collect();
        assert_eq!(kept, ["verification/v01.png", "verification/v02.png", "verification/v03.png"]);
        assert!(kept.iter().all(|name| root.join(name).is_file()));
        fs::remove_dir_all(root).unwrap();
    }
}

#[test]
fn after_a_knock_a_view_contradicts_and_no_result_is_written() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let root = new_folder();
        let mut player = calibrated(&root, setup);
        view(&mut player);
        assert_eq!(player.state().verify.unwrap().agrees, Some(true));
        let knock = Isometry3::new(Vector3::new(3e-3, -2e-3, 1e-3), Vector3::new(0.0, 4e-3, 0.0));
        player.cell().happens(&Event::CameraMoved(Pose::claim(knock)));
        view(&mut player);
        let state = player.state();
        assert_eq!(state.verify.unwrap().agrees, Some(false));
        assert!(state.say.starts_with("Not verified: in view v02"), "{}", state.say);
        let refused = player.command(Command::Finish).unwrap_err();
        assert!(refused.contains("not verified"), "{refused}");
        assert!(!root.join("result").exists());

        // a view that was wrong itself is deleted, restored and undone as captures are
        player.command(Command::Delete { id: "v02".into() }).unwrap();
        assert_eq!(player.state().verify.unwrap().agrees, Some(true));
        assert!(root.join("deleted/verification/v02.png").is_file());
        player.command(Command::Undo).unwrap();
        assert_eq!(player.state().verify.unwrap().agrees, Some(false));
        player.command(Command::Undo).unwrap();
        assert_eq!(player.state().verify.unwrap().views.len(), 1);
        player.command(Command::Finish).unwrap();
        assert!(player.state().say.starts_with("Accepted"), "{}", player.state().say);
        drop(player);
        fs::remove_dir_all(root).unwrap();
    }
}

/// Where the robot is led.
fn to(player: &mut Player, pose: &Pose<Base, Flange>) {
    player.cell().drive(*pose, player.now());
    player.pass(30.0);
}

#[test]
fn what_was_asked_for_in_one_step_is_not_done_in_another() {
    let root = new_folder();
    let mut player = calibrated(&root, Setup::EyeInHand);
    let refused = player.command(Command::Retake { id: "001".into() }).unwrap_err();
    assert!(refused.contains("step `capture`"), "{refused}");
    assert!(player.state().captures.iter().any(|c| c.id == "001"));

    // the robot stands where the last capture was taken, and sees the same
    player.command(Command::Take).unwrap();
    let problem = player.state().problem.unwrap();
    assert!(problem.message.contains("verifies more"), "{problem:?}");
    assert!(player.state().verify.unwrap().views.is_empty());

    // a result that was written stays one while nothing has changed
    player.command(Command::Finish).unwrap();
    player.command(Command::Go { step: Step::Verify }).unwrap();
    player.command(Command::Go { step: Step::Result }).unwrap();
    assert!(player.state().result.is_some());
    player.command(Command::Go { step: Step::Verify }).unwrap();
    view(&mut player);
    assert!(player.state().result.is_none());
    drop(player);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn at_the_pose_of_a_capture_an_image_that_has_moved_contradicts() {
    let root = new_folder();
    let mut player = calibrated(&root, Setup::EyeInHand);
    player.command(Command::Finish).unwrap();
    player.command(Command::Go { step: Step::Verify }).unwrap();
    let knock = Isometry3::new(Vector3::new(3e-3, -2e-3, 1e-3), Vector3::new(0.0, 4e-3, 0.0));
    player.cell().happens(&Event::CameraMoved(Pose::claim(knock)));
    let pose = player.state().captures[1].base_from_flange;
    to(&mut player, &pose);
    player.command(Command::Take).unwrap();
    let state = player.state();
    assert_eq!(state.verify.unwrap().agrees, Some(false), "{:?}", state.problem);
    assert!(player.command(Command::Finish).is_err());
    drop(player);
    fs::remove_dir_all(root).unwrap();
}

/// Touches corners to verify, on a board that is laid into the view first where the robot carries the one of the captures.
fn touch(player: &mut Player, setup: Setup, count: usize) {
    if setup == Setup::EyeToHand {
        player.command(Command::Drive { to: Destination::Placement }).unwrap();
        player.pass(3.0);
        player.command(Command::Place).unwrap();
    }
    for _ in 0..count {
        player.command(Command::Drive { to: Destination::Touch }).unwrap();
        player.command(Command::Touch { corner: None }).unwrap();
    }
}

fn verified(player: &Player) -> VerifyView {
    player.state().verify.unwrap()
}

/// Of each touch that verifies, how far it is from the prediction, mm.
fn touched_mm(player: &Player) -> Vec<f64> {
    let touches = verified(player).touch.unwrap().touches;
    touches.into_iter().map(|t| t.residual_mm.unwrap()).collect()
}

#[test]
fn touches_verify_the_result_and_are_no_part_of_it() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let root = new_folder();
        let mut player = calibrated(&root, setup);
        if setup == Setup::EyeToHand {
            let carried = player.command(Command::Touch { corner: None }).unwrap_err();
            assert!(carried.contains("cannot touch the board that it carries"), "{carried}");
        }
        let to_do = verified(&player).say_touch.unwrap();
        let expected = match setup {
            Setup::EyeInHand => "Bring the tip to corner ",
            Setup::EyeToHand => "Lay the board, or another of the same kind, into the view",
        };
        assert!(to_do.starts_with(expected), "{to_do}");
        touch(&mut player, setup, 4);
        let view = verified(&player);
        assert_eq!(view.agrees, Some(true), "{view:?}");
        let (off, expected) = (touched_mm(&player), view.touches_expected_mm.unwrap());
        println!("{setup:?}: {off:.2?} mm, {expected:.2} mm expected");
        assert!(off.len() == 4 && off.iter().all(|mm| *mm < 3.0 * expected), "{off:?}");
        assert!(expected < 1.5, "{expected}");
        let state = player.state();
        assert!(state.say.starts_with("Verified by 4 touches: "), "{}", state.say);
        assert_eq!(view.say_touch.as_ref(), Some(&state.say));
        assert!(state.touch.unwrap().touches.is_empty(), "they are none of the answer's");

        // with a view as well, both are said
        view_too(&mut player);
        let said = player.state().say;
        assert!(said.starts_with("Verified by a view: ") && said.contains("; by 4 touches: "));
        player.command(Command::Confirm { step: Step::Verify }).unwrap();
        let said = player.state().say;
        assert!(said.starts_with("Accepted") && said.contains("by 4 touches"), "{said}");
        let result = read_result(&root.join("result/calibration.json")).unwrap();
        assert!(result.touches.is_empty());
        assert!(!root.join("touches.csv").exists());
        let dataset = Dataset::open(&root).unwrap();
        assert!(dataset.placements.is_empty() && dataset.touches.is_empty());
        let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
        assert_eq!(again.run_id, result.run_id);
        let off = touched_mm(&player);
        drop(player);

        // they are there when the session goes on, and say the same
        let mut player = player_of(&root, setup);
        player.pass(1.0);
        assert_eq!(touched_mm(&player), off);
        drop(player);
        fs::remove_dir_all(root).unwrap();
    }
}

/// One more view, from where the next one is proposed.
fn view_too(player: &mut Player) {
    view(player);
    assert_eq!(verified(player).views.len(), 1);
}

/// A session that goes on.
fn player_of(root: &Path, setup: Setup) -> Player {
    let cell = VirtualCell::new(setup, 7, Faults::default()).unwrap();
    Player::new(Host::new(SessionFolder::open(root, None).unwrap()), cell)
}

#[test]
fn touches_that_contradict_keep_the_result_from_being_written() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let root = new_folder();
        let mut player = calibrated(&root, setup);
        touch(&mut player, setup, 3);
        // another corner than is said
        player.command(Command::Drive { to: Destination::Touch }).unwrap();
        let there = verified(&player).touch.unwrap().corner;
        let wrong = (there + 9) % 54;
        player.command(Command::Touch { corner: Some(wrong) }).unwrap();
        let said = player.state().say;
        assert!(
            said.starts_with(&format!("Not verified: at corner {wrong} the tip was ")),
            "{said}"
        );
        let refused = player.command(Command::Finish).unwrap_err();
        assert!(refused.contains("not verified"), "{refused}");
        assert!(!root.join("result").exists());
        player.command(Command::Untouch { id: "t04".into() }).unwrap();
        assert_eq!(verified(&player).agrees, Some(true));
        player.command(Command::Undo).unwrap();
        assert_eq!(verified(&player).agrees, Some(false));
        player.command(Command::Undo).unwrap();

        // a tip that is elsewhere than declared
        let tip = player.cell().settings().tip_mm.unwrap();
        let declared = [tip[0] + 3.0, tip[1], tip[2] - 4.0];
        player.command(Command::Tip { in_flange_mm: declared }).unwrap();
        let said = player.state().say;
        assert!(
            said.starts_with("Not verified: at all touches the tip was off by about"),
            "{said}"
        );
        player.command(Command::Tip { in_flange_mm: tip }).unwrap();
        assert_eq!(verified(&player).agrees, Some(true));

        // touches of the step before are the answer's again, on a board of their own
        player.command(Command::Go { step: Step::Touch }).unwrap();
        if setup == Setup::EyeToHand {
            let again = player.command(Command::Touch { corner: None }).unwrap_err();
            assert!(again.contains("cannot touch the board that it carries"), "{again}");
        }
        touch(&mut player, setup, 3);
        assert_eq!(player.state().touch.unwrap().touches.len(), 3);
        assert_eq!(touched_mm(&player).len(), 3);
        player.command(Command::Finish).unwrap();
        let result = read_result(&root.join("result/calibration.json")).unwrap();
        assert_eq!(result.touches.len(), 3);
        assert!(player.state().say.starts_with("Accepted"), "{}", player.state().say);
        drop(player);
        fs::remove_dir_all(root).unwrap();
    }
}

#[test]
fn after_a_knock_touches_contradict_a_camera_beside_the_robot() {
    let root = new_folder();
    let mut player = calibrated(&root, Setup::EyeToHand);
    let knock = Isometry3::new(Vector3::new(6e-3, -4e-3, 2e-3), Vector3::new(0.0, 8e-3, 0.0));
    player.cell().happens(&Event::CameraMoved(Pose::claim(knock)));
    touch(&mut player, Setup::EyeToHand, 4);
    let view = verified(&player);
    assert_eq!(view.agrees, Some(false), "{view:?}");
    assert!(player.state().say.starts_with("Not verified: at "), "{}", player.state().say);
    assert!(player.command(Command::Finish).is_err());
    drop(player);
    fs::remove_dir_all(root).unwrap();
}
