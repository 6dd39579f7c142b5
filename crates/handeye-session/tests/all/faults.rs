//! What goes wrong with the machine: nothing that was confirmed is lost, and the session goes on.

use std::{fs, path::Path, process::Command as Program};

use handeye::Setup;
use handeye_io::SessionFolder;
use handeye_session::{
    engine::{Command, Destination, Step},
    host::Host,
    script::Player,
    sources::virtual_cell::{Faults, VirtualCell},
};

use crate::new_folder;

/// A disk of its own that is small, taken away at the end; `None` where this user may mount none.
struct Disk(std::path::PathBuf);

impl Disk {
    fn mounted() -> Option<Self> {
        let root = new_folder();
        fs::create_dir_all(&root).ok()?;
        let mount = ["-t", "tmpfs", "-o", "size=4m", "handeye-test"];
        let done = Program::new("mount").args(mount).arg(&root).output();
        match done.is_ok_and(|done| done.status.success()) {
            true => Some(Self(root)),
            false => {
                fs::remove_dir_all(&root).ok();
                None
            }
        }
    }

    /// Leaves so many bytes.
    fn fill_up_to(&self, left: usize) -> std::path::PathBuf {
        let filler = self.0.join("filler");
        let block = vec![1; 4096];
        let mut written = vec![];
        while fs::write(&filler, &written).is_ok() {
            written.extend(block.iter().cycle().take(16 * block.len()));
        }
        while fs::write(&filler, &written).is_err() {
            written.truncate(written.len() - block.len());
        }
        written.truncate(written.len() - left);
        fs::write(&filler, &written).unwrap();
        filler
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        Program::new("umount").arg(&self.0).output().ok();
        fs::remove_dir_all(&self.0).ok();
    }
}

fn begun(root: &Path) -> Player {
    let cell = VirtualCell::new(Setup::EyeInHand, 7, Faults::default()).unwrap();
    let folder = SessionFolder::open(root, Some(&cell.settings())).unwrap();
    let mut player = Player::new(Host::new(folder), cell);
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).unwrap();
    }
    player
}

fn names(player: &Player) -> Vec<String> {
    player.state().captures.iter().map(|c| c.id.clone()).collect()
}

#[test]
fn on_a_full_disk_no_capture_is_lost_and_the_next_one_is_taken_once_there_is_room() {
    let Some(disk) = Disk::mounted() else {
        println!("SKIPPED: no disk can be mounted here");
        return;
    };
    let root = disk.0.join("cell");
    let mut player = begun(&root);
    player.command(Command::Take).unwrap();
    player.command(Command::Drive { to: Destination::Next }).unwrap();
    player.command(Command::Take).unwrap();
    assert_eq!(names(&player), ["001", "002"]);
    let journal = fs::read(root.join("journal.jsonl")).unwrap();
    for left in [0, 8 << 10, 64 << 10] {
        let filler = disk.fill_up_to(left);
        player.command(Command::Drive { to: Destination::Next }).unwrap();
        player.command(Command::Take).unwrap();
        let state = player.state();
        let problem = state.problem.as_ref().unwrap();
        assert_eq!((&problem.code[..], names(&player).len()), ("not-written", 2), "{problem:?}");
        assert!(problem.advice.contains("the captures before it are safe"), "{problem:?}");
        assert_eq!(fs::read(root.join("journal.jsonl")).unwrap(), journal);
        fs::remove_file(filler).unwrap();
    }
    player.command(Command::Take).unwrap();
    assert_eq!(names(&player), ["001", "002", "003"]);
    drop(player);
    let again = SessionFolder::open(&root, None).unwrap();
    assert_eq!(again.captures().len(), 3);
    assert!(again.dataset().unwrap().captures.len() == 3);
}
