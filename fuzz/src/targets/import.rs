//! Files and folders of other programs.

use std::fs;

use crate::{file, folder, told};
use handeye::Setup;
use handeye_io::{Declared, Direction, import, read_result};

const ENDINGS: [&str; 13] = [
    "parquet", "csv", "txt", "json", "yaml", "yml", "calib", "launch", "xml", "py", "dat", "toml",
    "samples",
];

fn direction(name: &str) -> Direction {
    Direction::named(name).expect("one that is known")
}

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let Some(path) = file(data, &ENDINGS) else { return };
    let declared = |camera, directions: &[&str]| Declared {
        setup: Some(Setup::EyeToHand),
        camera,
        directions: directions.iter().map(|name| direction(name)).collect(),
        sequence: Some("a".into()),
        length_unit: None,
    };
    let all = ["base_from_flange", "camera_from_target", "camera_from_base"];
    told(import(&path, &declared(None, &all)));
    told(import(&path, &declared(Some(path.clone()), &all)));
    told(read_result(&path));
    // the tables of KinHEC, all three of them this one
    if path.extension().is_some_and(|e| e == "parquet") {
        let set = folder().join("kinhec");
        fs::create_dir_all(&set).expect("a temporary folder can be made");
        for name in ["sequences.parquet", "a.parquet"] {
            fs::copy(&path, set.join(name)).expect("a temporary file can be copied");
        }
        told(import(&set, &declared(None, &[])));
    }
}
