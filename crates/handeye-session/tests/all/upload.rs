//! Images that are handed over one by one: a pose and an image make a capture, and no image counts twice.

use std::{
    fs, thread,
    time::{Duration, Instant},
};

use handeye::Setup;
use handeye_io::{CellSettings, SessionFolder, Writing, simulated};
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    live::{Camera, Cell, Live},
    sources::virtual_cell::{Faults, VirtualCell},
};
use serde_json::Value;

use crate::new_folder;

const PATIENCE: Duration = Duration::from_secs(120);

pub fn until(live: &Live, what: &str, seen: impl Fn(&Value) -> bool) {
    let begin = Instant::now();
    loop {
        let state: Value = serde_json::from_str(&live.shown().borrow().json).unwrap();
        if seen(&state) {
            return;
        }
        assert!(begin.elapsed() < PATIENCE, "{what}: {state:#}");
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn an_image_that_is_uploaded_and_a_typed_pose_make_a_capture() {
    let root = new_folder();
    let cell = VirtualCell::new(Setup::EyeInHand, 2, Faults::default()).unwrap();
    let settings = CellSettings { notation: "kuka".into(), ..cell.settings() };
    let folder = SessionFolder::open(&root, Some(&settings)).unwrap();
    let live = Live::begin(Host::new(folder), Cell::Hand(Camera::Upload));
    until(&live, "uploads", |state| state["camera"]["uploads"] == true);
    let uploads = live.uploads().unwrap();
    let png = simulated::picture(&cell.image(0.0, 1));
    let refused = uploads.image(b"no image").unwrap_err();
    assert!(refused.contains("the uploaded file") && refused.contains("not an image"), "{refused}");
    assert!(uploads.image(&png[..png.len() / 2]).unwrap_err().contains("cannot be decoded"));
    uploads.image(&png).unwrap();
    // the answer may have been lost
    uploads.image(&png).unwrap();
    until(&live, "the board", |state| state["camera"]["found"] == "54 of 54 corners");

    let numbers = Writing::of("kuka").unwrap().numbers(&cell.sample(0.0).base_from_flange);
    let text = numbers.iter().map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(" ");
    live.command_blocking(Command::Pose { text }).unwrap();
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        live.command_blocking(Command::Confirm { step }).unwrap();
    }
    live.command_blocking(Command::Take).unwrap();
    until(&live, "a capture", |state| state["captures"].as_array().is_some_and(|c| c.len() == 1));
    uploads.image(&simulated::picture(&cell.image(9.0, 2))).unwrap();
    assert!(uploads.image(&png).unwrap_err().contains("has come before"));
    // the file as it came
    assert_eq!(fs::read(root.join("images/001.png")).unwrap(), png);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn where_images_come_by_themselves_none_is_uploaded() {
    let root = new_folder();
    let cell = VirtualCell::new(Setup::EyeInHand, 2, Faults::default()).unwrap();
    let folder = SessionFolder::open(&root, Some(&cell.settings())).unwrap();
    let live = Live::begin(Host::new(folder), Cell::Virtual(Box::new(cell)));
    assert!(live.uploads().is_none());
    fs::remove_dir_all(root).ok();
}
