//! Targets in arbitrary images.
#![no_main]

use handeye_fuzz::targets::detect;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| detect::run(data));
