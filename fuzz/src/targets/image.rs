//! Images of every kind that is read.

use crate::{file, told};
use handeye_io::{image_size, read_image};

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let Some(path) = file(data, &["png", "jpg", "tiff", "bmp", "pgm"]) else { return };
    told(image_size(&path));
    if let Some(image) = told(read_image(&path, None)) {
        assert!(image.values().iter().all(|v| v.is_finite()));
        told(read_image(&path, Some(12)));
    }
}
