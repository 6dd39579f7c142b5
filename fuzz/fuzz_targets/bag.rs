//! ROS bags, and models of arms.
#![no_main]

use handeye_fuzz::targets::bag;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| bag::run(data));
