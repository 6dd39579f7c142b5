use std::{
    fs,
    path::PathBuf,
    sync::atomic::{AtomicUsize, Ordering},
};

use handeye::{Config, Setup, Verdict};
use handeye_io::{Dataset, SessionFolder, calibrate::calibrate_dataset, read_result};
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    script::{Action, Player},
    sources::virtual_cell::{Faults, VirtualCell},
};

static FOLDERS: AtomicUsize = AtomicUsize::new(0);

fn new_folder() -> PathBuf {
    let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
    let name = format!("handeye-virtual-{}-{number}", std::process::id());
    let root = std::env::temp_dir().join(name);
    fs::remove_dir_all(&root).ok();
    root
}

fn player(root: &std::path::Path, setup: Setup, seed: u64, faults: Faults) -> Player {
    let cell = VirtualCell::new(setup, seed, faults).unwrap();
    let folder = SessionFolder::open(root, Some(&cell.settings())).unwrap();
    Player::new(Host::new(folder), cell)
}

fn begin(player: &mut Player) {
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).unwrap();
    }
    player.command(Command::Take).unwrap();
}

const UNTIL_ENOUGH: &str = r#"[{"repeat": [{"do": "drive", "to": "next"}, {"do": "take"}], "until": "enough", "most": 30}]"#;

#[test]
fn a_session_in_a_virtual_cell_ends_with_a_result_that_is_true() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let root = new_folder();
        let mut player = player(&root, setup, 7, Faults::default());
        begin(&mut player);
        let actions: Vec<Action> = serde_json::from_str(UNTIL_ENOUGH).unwrap();
        player.play(&actions).unwrap();
        let state = player.state();
        let progress = state.progress.as_ref().unwrap();
        println!("{} captures: {:?}; {:?}", progress.captures, progress.history, state.refused);
        assert!(progress.enough && progress.verdict == Verdict::Accepted, "{}", state.say);
        player.command(Command::Finish).unwrap();
        assert!(player.state().say.starts_with("Accepted"), "{}", player.state().say);

        let result = read_result(&root.join("result/calibration.json")).unwrap();
        let found = result.hand_eye.mount_from_camera.unwrap();
        let truth = player.cell().truth().mount_from_camera;
        let off_mm = found.distance_to(&truth) * 1e3;
        println!("off by {off_mm:.3} mm, {:.3} degrees", found.angle_to(&truth).to_degrees());
        assert!(off_mm < 0.5, "{off_mm}");

        // the folder is an ordinary dataset, with the same answer
        let dataset = Dataset::open(&root).unwrap();
        let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
        assert_eq!(again.hand_eye, result.hand_eye);
        drop(player);
        fs::remove_dir_all(root).unwrap();
    }
}
