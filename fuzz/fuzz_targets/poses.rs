//! Poses of robots, in many notations.
#![no_main]

use handeye_fuzz::targets::poses;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| poses::run(data));
