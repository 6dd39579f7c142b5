//! Touched points, and targets.

use crate::{file, told};
use handeye_io::{read_target, read_touched_points};

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let Some(path) = file(data, &["csv", "json", "txt", "toml"]) else { return };
    told(read_touched_points(&path));
    if let Some(target) = told(read_target(&path)) {
        assert_eq!(target.corners().len(), target.len());
    }
}
