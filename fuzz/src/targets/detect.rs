//! Targets in arbitrary images.

use std::sync::LazyLock;

use crate::boards;
use handeye::{GrayImage, TargetModel, detect};

/// First bytes below this are those of images in which any board is looked for.
const RECOGNISED: u8 = 16;

static TARGETS: LazyLock<Vec<TargetModel>> = LazyLock::new(boards);

/// Reads some bytes.
pub fn run(data: &[u8]) {
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
    // it looks for everything: seldom, so that the others have their turn
    if *kind < RECOGNISED
        && let Some(found) = detect::recognise(&[image])
    {
        assert!(!found.target.is_empty() && found.images == 1);
    }
}
