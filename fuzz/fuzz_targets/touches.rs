//! Touched points, and targets.
#![no_main]

use handeye_fuzz::targets::touches;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| touches::run(data));
