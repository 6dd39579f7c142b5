//! Manifests, with images, scans and poses beside them.
#![no_main]

use handeye_fuzz::targets::manifest;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| manifest::run(data));
