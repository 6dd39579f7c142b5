//! ROS bags, and models of arms.

use std::fs;

use crate::{file, folder, told};
use handeye::Setup;
use handeye_io::{
    Dataset, Urdf,
    bag::{BagOptions, Motion, RobotSource, Stamps, contents, extract},
};

const ENDINGS: [&str; 4] = ["mcap", "db3", "bag", "urdf"];

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let Some(path) = file(data, &ENDINGS) else { return };
    let (base, flange) = ("base_link".to_owned(), "tool0".to_owned());
    if path.extension().is_some_and(|e| e == "urdf") {
        told(Urdf::read(&path, &base, &flange));
        return;
    }
    if told(contents(&path, &|| ())).is_none() {
        return;
    }
    let frames = RobotSource::Frames { base: base.clone(), flange: flange.clone() };
    let joints = RobotSource::Joints { topic: None, base, flange };
    for (robot, motion) in [(frames, Motion::Moving), (joints, Motion::Still)] {
        let out = folder().join("out");
        let options = BagOptions {
            setup: Some(Setup::EyeInHand),
            target: None,
            image: None,
            depth: None,
            camera: None,
            robot,
            urdf: None,
            motion,
            most: 4,
            stamps: Stamps::Header,
        };
        if told(extract(&path, &out, &options, &|| ())).is_some() {
            told(Dataset::open(&out));
        }
        fs::remove_dir_all(&out).ok();
    }
}
