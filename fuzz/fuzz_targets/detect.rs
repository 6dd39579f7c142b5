//! Targets in arbitrary images.
#![no_main]

use std::sync::LazyLock;

use handeye::{GrayImage, TargetModel, detect};
use handeye_fuzz::targets;
use libfuzzer_sys::fuzz_target;

static TARGETS: LazyLock<Vec<TargetModel>> = LazyLock::new(targets);

fuzz_target!(|data: &[u8]| {
    let [kind, width, pixels @ ..] = data else { return };
    let width = usize::from(*width).max(1);
    let height = pixels.len() / width;
    let values = pixels[..width * height].iter().map(|v| f32::from(*v)).collect();
    let Some(image) = GrayImage::new(width, height, values) else { return };
    let target = &TARGETS[usize::from(*kind) % TARGETS.len()];
    for corner in detect::detect(&image, target).iter().flatten() {
        assert!((corner.id as usize) < target.len());
        assert!(corner.pixel.iter().chain(corner.covariance.iter()).all(|x| x.is_finite()));
    }
});
