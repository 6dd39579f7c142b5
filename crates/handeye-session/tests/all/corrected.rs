//! What was declared wrongly is put right with the captures that there are.

use std::fs;

use handeye::{Setup, TargetModel};
use handeye_io::{CellSettings, NewTouch, SessionFolder, Writing, simulated};
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    live::{Camera, Cell, Live},
    sources::virtual_cell::{Faults, VirtualCell},
};
use serde_json::Value;

use crate::{new_folder, upload::until};

const CAPTURES: usize = 6;

fn state(live: &Live) -> Value {
    serde_json::from_str(&live.shown().borrow().json).unwrap()
}

fn is_assessed(state: &Value) -> bool {
    state["assessing"] == false && state["taking"].is_null()
}

/// Uploads an image of the cell, types the pose of its moment, and takes the capture.
fn take(live: &Live, cell: &VirtualCell, number: usize) {
    let now = 60.0 * (number + 1) as f64;
    cell.show_board(number, now - 30.0).unwrap();
    live.uploads().unwrap().image(&simulated::picture(&cell.image(now, number as u64))).unwrap();
    let numbers = Writing::of("ur").unwrap().numbers(&cell.sample(now).base_from_flange);
    let text = numbers.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(" ");
    live.command_blocking(Command::Pose { text }).unwrap();
    if number == 0 {
        until(live, "an image", |state| !state["camera"]["found"].is_null());
        for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
            live.command_blocking(Command::Confirm { step }).unwrap();
        }
    }
    live.command_blocking(Command::Take).unwrap();
    until(live, "a capture that is assessed", |state| {
        let captures = state["captures"].as_array().map_or(0, Vec::len);
        captures == number + 1 && is_assessed(state)
    });
}

fn off_mm(live: &Live, cell: &VirtualCell) -> f64 {
    let found = &state(live)["progress"]["mount_from_camera"]["translation_m"];
    let truth = cell.truth().mount_from_camera.translation();
    let at = |k: usize| found[k].as_f64().map_or(f64::NAN, |x| x - truth[k]);
    1e3 * (0..3).map(|k| at(k).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn a_board_of_another_size_is_put_right_and_the_captures_stay() {
    let root = new_folder();
    let cell = VirtualCell::new(Setup::EyeInHand, 6, Faults::default()).unwrap();
    let right = cell.settings().target;
    let settings = CellSettings { target: right.resized(1.1), guess: None, ..cell.settings() };
    let folder = SessionFolder::open(&root, Some(&settings)).unwrap();
    let live = Live::begin(Host::new(folder), Cell::Hand(Camera::Upload));
    (0..CAPTURES).for_each(|number| take(&live, &cell, number));
    let said = state(&live)["say"].as_str().unwrap().to_owned();
    assert!(said.starts_with("Something is wrong") && said.contains("at the step Board"), "{said}");

    live.command_blocking(Command::Target { target: right }).unwrap();
    until(&live, "captures that are read again", |state| {
        let fits = state["say"].as_str().is_some_and(|say| !say.contains("wrong"));
        fits && is_assessed(state) && state["captures"].as_array().map(Vec::len) == Some(CAPTURES)
    });
    let off = off_mm(&live, &cell);
    assert!(off < 2.0, "{off} mm");
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn a_camera_that_is_elsewhere_than_was_said_is_put_right_and_the_captures_stay() {
    let root = new_folder();
    let cell = VirtualCell::new(Setup::EyeToHand, 7, Faults::default()).unwrap();
    let settings = CellSettings { setup: Setup::EyeInHand, guess: None, ..cell.settings() };
    let folder = SessionFolder::open(&root, Some(&settings)).unwrap();
    let live = Live::begin(Host::new(folder), Cell::Hand(Camera::Upload));
    (0..CAPTURES).for_each(|number| take(&live, &cell, number));
    let said = state(&live)["say"].as_str().unwrap().to_owned();
    assert!(said.starts_with("Something is wrong"), "{said}");
    let setup = Some(Setup::EyeToHand);
    live.command_blocking(Command::Cell { setup, tolerance_mm: None }).unwrap();
    until(&live, "captures that are read again", |state| {
        let fits = state["say"].as_str().is_some_and(|say| !say.contains("wrong"));
        fits && is_assessed(state)
    });
    let off = off_mm(&live, &cell);
    assert!(off < 2.0, "{off} mm");
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn a_board_with_touched_corners_keeps_its_corners() {
    let root = new_folder();
    let cell = VirtualCell::new(Setup::EyeInHand, 6, Faults::default()).unwrap();
    let mut folder = SessionFolder::open(&root, Some(&cell.settings())).unwrap();
    let touch = NewTouch {
        placement: None,
        corner: 3,
        verifies: false,
        base_from_flange: cell.sample(0.0).base_from_flange,
        typed: &[],
        time_s: 1.0,
    };
    folder.touch(&touch).unwrap();
    let other = TargetModel::Checkerboard { columns: 7, rows: 5, square_mm: 30.0 };
    let why = folder.set(&CellSettings { target: other, ..cell.settings() }).unwrap_err();
    assert!(why.to_string().contains("delete the touches first"), "{why}");
    let target = cell.settings().target.resized(1.01);
    folder.set(&CellSettings { target, ..cell.settings() }).unwrap();
    drop(folder);
    fs::remove_dir_all(root).unwrap();
}
