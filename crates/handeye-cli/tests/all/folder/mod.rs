//! A folder of its own for a test, and the program run in it.

use std::{
    fs,
    path::PathBuf,
    process::{Command, Stdio},
    sync::atomic::{AtomicUsize, Ordering},
};

use serde_json::Value;

/// Removed at the end of the test.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("handeye-cli-{}-{n}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// Puts a file there: text, `@missing`, `@folder`, or `@png 640x480`.
    pub fn put(&self, name: &str, content: &str) {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        match content.split_once(' ').unwrap_or((content, "")) {
            ("@missing", _) => {}
            ("@folder", _) => fs::create_dir(path).unwrap(),
            ("@png", size) => {
                let (w, h) = size.split_once('x').unwrap();
                let picture = image::GrayImage::new(w.parse().unwrap(), h.parse().unwrap());
                picture.save(path).unwrap();
            }
            _ => fs::write(path, content).unwrap(),
        }
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    /// Names in a folder below, sorted; none if it does not exist.
    pub fn list(&self, name: &str) -> Vec<String> {
        let entries = fs::read_dir(self.0.join(name)).into_iter().flatten().flatten();
        let mut names: Vec<String> =
            entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).ok();
    }
}

/// How the program ended.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Run {
    /// The one JSON document on standard output.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|e| {
            panic!("not one JSON document: {e}\n{}{}", self.stdout, self.stderr)
        })
    }

    /// What stands behind `error: `; nothing may stand before it.
    pub fn error(&self) -> String {
        self.stderr.trim().strip_prefix("error: ").unwrap_or(&self.stderr).to_owned()
    }
}

/// Runs the program in a folder.
pub fn handeye(folder: &Folder, args: &[&str]) -> Run {
    let output = command(folder, args).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Run {
        code: output.status.code().unwrap_or_else(|| panic!("{args:?} was ended by a signal")),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    }
}

/// The program, ready to run in a folder, always at the same time.
pub fn command(folder: &Folder, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_handeye"));
    command.env("SOURCE_DATE_EPOCH", "1773480413");
    command.args(args).current_dir(&folder.0).stdin(Stdio::null());
    command
}
