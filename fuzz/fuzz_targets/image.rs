//! Images of every kind that is read.
#![no_main]

use handeye_fuzz::targets::image;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| image::run(data));
