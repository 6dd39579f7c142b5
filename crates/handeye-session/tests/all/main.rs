//! Sessions from outside: with virtual cells, whose truth is known.

#![allow(clippy::unwrap_used, reason = "a test fails loudly")]
#![allow(clippy::result_large_err, reason = "an error ends the test: its size costs nothing")]

mod arm;
mod by_hand;
mod corrected;
mod faults;
mod gate;
mod german;
#[cfg(unix)]
mod line;
#[cfg(unix)]
mod line_programs;
mod long;
mod mistakes;
mod openapi;
mod placements;
mod push;
mod scans;
mod standstill;
mod upload;
mod ur_fields;
mod ur_rtde;
mod ur_rtde_live;
mod ur_simulator;
mod verify;
mod virtual_cell;

use std::{
    fs,
    path::PathBuf,
    sync::atomic::{AtomicUsize, Ordering},
};

static FOLDERS: AtomicUsize = AtomicUsize::new(0);

/// A name for a folder that is not there yet.
fn new_folder() -> PathBuf {
    let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
    let name = format!("handeye-live-{}-{number}", std::process::id());
    let root = std::env::temp_dir().join(name);
    fs::remove_dir_all(&root).ok();
    root
}
