//! Corners on arbitrary scans.
#![no_main]

use handeye_fuzz::targets::lift;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| lift::run(data));
