//! Images of every kind that is read.
#![no_main]

use handeye_fuzz::{file, told};
use handeye_io::{image_size, read_image};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some(path) = file(data, &["png", "jpg", "tiff", "bmp", "pgm"]) else { return };
    told(image_size(&path));
    if let Some(image) = told(read_image(&path, None)) {
        assert!(image.values().iter().all(|v| v.is_finite()));
        told(read_image(&path, Some(12)));
    }
});
