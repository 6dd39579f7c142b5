//! Calibrations of cameras.
#![no_main]

use handeye_fuzz::targets::camera;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| camera::run(data));
