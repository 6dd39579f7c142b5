//! A progress bar for work of more than a second, only on a terminal.

use std::{
    io::{self, IsTerminal, Write},
    sync::Mutex,
    time::{Duration, Instant},
};

use crate::args::GlobalArgs;

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Characters of a full bar.
const WIDTH: usize = 30;

/// Tells a person how far the work is.
pub struct Progress {
    what: &'static str,
    start: Instant,
    shown: Mutex<bool>,
    wanted: bool,
}

impl Progress {
    /// For work named `what`.
    pub fn new(what: &'static str, global: &GlobalArgs) -> Self {
        let wanted = !global.quiet && io::stderr().is_terminal();
        Self { what, start: Instant::now(), shown: Mutex::new(false), wanted }
    }

    /// `done` of `all` are done.
    pub fn tell(&self, done: usize, all: usize) {
        if !self.wanted || self.start.elapsed() < PATIENCE {
            return;
        }
        let full = WIDTH * done / all.max(1);
        let Ok(mut shown) = self.shown.lock() else { return };
        *shown = true;
        let (bar, rest) = ("#".repeat(full), "-".repeat(WIDTH - full));
        crate::output::to_stderr(format_args!("\r{} [{bar}{rest}] {done}/{all} ", self.what));
        let _ = io::stderr().flush();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown.lock().is_ok_and(|s| *s) {
            crate::output::to_stderr(format_args!("\n"));
        }
    }
}
