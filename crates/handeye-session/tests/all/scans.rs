//! A 3D camera whose viewer saves image and scan into a folder.

use std::fs;

use handeye::{Config, Setup};
use handeye_io::{
    CellSettings, Dataset, ScanSettings, SessionFolder, Writing, calibrate::calibrate_dataset,
    read_result, simulated,
};
use handeye_session::{
    engine::{Command, Step},
    host::{Host, RESULT},
    live::{Camera, Cell, Live},
    sources::virtual_cell::{Faults, VirtualCell},
};
use serde_json::Value;

use crate::{new_folder, upload::until};

const CAPTURES: usize = 6;

#[test]
fn scans_lie_with_their_images_in_the_dataset_and_count_in_the_result() {
    let (root, viewer) = (new_folder(), new_folder());
    fs::create_dir_all(&viewer).unwrap();
    let cell = VirtualCell::new(Setup::EyeInHand, 4, Faults::default()).unwrap();
    let settings = CellSettings { scans: Some(ScanSettings::METRES), ..cell.settings() };
    let folder = SessionFolder::open(&root, Some(&settings)).unwrap();
    let live = Live::begin(Host::new(folder), Cell::Hand(Camera::Folder(viewer.clone())));
    let writing = Writing::of("ur").unwrap();
    for k in 0..CAPTURES {
        let now = 60.0 * (k + 1) as f64;
        cell.show_board(k, now - 30.0).unwrap();
        let scan = simulated::cloud(&cell.scan(now, k as u64));
        fs::write(viewer.join(format!("{k}.ply")), scan).unwrap();
        let image = simulated::picture(&cell.image(now, k as u64));
        fs::write(viewer.join(format!("{k}.png")), image).unwrap();
        until(&live, "the image", |state| state["camera"]["frame"].as_u64() == Some(k as u64 + 1));
        let numbers = writing.numbers(&cell.sample(now).base_from_flange);
        let text = numbers.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(" ");
        live.command_blocking(Command::Pose { text }).unwrap();
        if k == 0 {
            for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
                live.command_blocking(Command::Confirm { step }).unwrap();
            }
        }
        live.command_blocking(Command::Take).unwrap();
        until(&live, "a capture that is assessed", |state| {
            let captures = state["captures"].as_array().map_or(0, Vec::len);
            captures == k + 1 && state["assessing"] == false && state["taking"].is_null()
        });
    }
    let state: Value = serde_json::from_str(&live.shown().borrow().json).unwrap();
    let depth = state["captures"].as_array().unwrap().iter().map(|c| c["corners_3d"].as_u64());
    assert!(depth.clone().all(|corners| corners > Some(40)), "{:?}", depth.collect::<Vec<_>>());
    live.command_blocking(Command::Finish).unwrap();
    until(&live, "the result", |state| !state["result"].is_null());
    let result = read_result(&root.join(RESULT).join("calibration.json")).unwrap();
    let x = result.hand_eye.mount_from_camera.unwrap();
    let off = cell.truth().mount_from_camera.distance_to(&x) * 1e3;
    assert!(off < 1.5, "{off} mm: {:?}", result.reasons);
    let dataset = Dataset::open(&root).unwrap();
    let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
    assert_eq!(again.run_id, result.run_id);
    assert!(again.captures.iter().all(|c| c.corners_3d > 40));
    for folder in [root, viewer] {
        fs::remove_dir_all(folder).unwrap();
    }
}
