//! Files and folders of other programs.
#![no_main]

use handeye_fuzz::targets::import;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| import::run(data));
