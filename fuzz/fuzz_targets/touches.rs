//! Touched points, and targets.
#![no_main]

use handeye_fuzz::{file, told};
use handeye_io::{read_target, read_touched_points};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some(path) = file(data, &["csv", "json", "txt", "toml"]) else { return };
    told(read_touched_points(&path));
    if let Some(target) = told(read_target(&path)) {
        assert_eq!(target.corners().len(), target.len());
    }
});
