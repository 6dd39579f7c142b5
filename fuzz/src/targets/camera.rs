//! Calibrations of cameras.

use crate::{file, told};
use handeye_io::read_intrinsics;

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let extensions = ["yaml", "json", "xml", "npz", "calib", "txt", "toml"];
    let Some(path) = file(data, &extensions) else { return };
    told(read_intrinsics(&path, None, None));
    if let Some(camera) = told(read_intrinsics(&path, Some("left"), Some((640, 480)))) {
        assert!(camera.check().is_ok());
    }
}
