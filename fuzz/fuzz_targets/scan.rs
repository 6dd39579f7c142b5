//! Scans and meshes of every kind that is read.
#![no_main]

use std::{panic, sync::Once};

use handeye_fuzz::targets::scan;
use libfuzzer_sys::fuzz_target;

static QUIET: Once = Once::new();

fuzz_target!(|data: &[u8]| {
    // Panics of other crates that are caught and told are no faults: only those that leave this
    // function end the program.
    QUIET.call_once(|| panic::set_hook(Box::new(|what| eprintln!("panicked: {what}"))));
    scan::run(data);
});
