//! A page in the user's browser.

use std::{
    path::Path,
    process::{Command, Stdio},
};

use crate::output::note;

/// What opens a page, by the system: a program, and its arguments before the page.
const OPENER: &[&str] = if cfg!(target_os = "windows") {
    &["explorer"]
} else if cfg!(target_os = "macos") {
    &["open"]
} else {
    &["xdg-open"]
};

/// Opens a page; where nothing here opens pages, says so and goes on.
pub fn open(page: &Path) {
    let page = std::path::absolute(page).unwrap_or_else(|_| page.into());
    open_address(&page.display().to_string());
}

/// The same with an address.
pub fn open_address(address: &str) {
    let quiet = |command: &mut Command| {
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().map(drop)
    };
    if let Err(error) = quiet(Command::new(OPENER[0]).args(&OPENER[1..]).arg(address)) {
        note!("the page cannot be opened ({}: {error}); open it by hand: {address}", OPENER[0]);
    }
}
