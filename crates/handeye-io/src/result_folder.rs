//! The files of one run, written into their folder together or not at all.
//!
//! Whatever happens, `calibration.json` never stands beside the page of another run. Runs into one folder take
//! turns (a lock on the folder, which the system frees when a program dies). A run writes all its files into a
//! hidden folder beside the results first, where a full disk ends it without harm. Only then the old result is
//! moved aside, the new files are renamed into place, and the new result comes last: a program that is killed in
//! between leaves a page without a result, never one with the wrong result. What killed runs left behind is removed
//! by the next run.

use std::{
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};

use crate::{Error, files, hash::Hash};

/// The result: the file that comes last.
pub const RESULT: &str = "calibration.json";
/// First part of the name of a folder in which a run prepares its files; its process id follows.
const STAGING: &str = ".handeye-run.";
/// Last part of the names of files and folders that are not finished.
const UNFINISHED: &str = ".part";
/// The file that is locked where a system cannot lock a folder.
const LOCK: &str = ".handeye.lock";

/// The folder that a run writes into, as it was when the run began.
pub struct ResultFolder {
    path: PathBuf,
    before: Option<Hash>,
}

/// What a run puts into its folder.
#[derive(Default)]
pub struct RunFiles {
    /// Names in the folder and contents; the result is among them.
    pub files: Vec<(String, Vec<u8>)>,
    /// Names of files that this run does not have: those of an earlier run do not belong to it.
    pub absent: Vec<&'static str>,
}

impl ResultFolder {
    /// Makes the folder where it is missing, and remembers which result lies in it.
    ///
    /// # Errors
    /// [`Error::Write`] where it cannot be made.
    pub fn open(path: &Path) -> Result<Self, Error> {
        fs::create_dir_all(path).map_err(|e| cannot_write(path, e))?;
        Ok(Self { path: path.into(), before: result_in(path) })
    }

    /// Writes all files of a run together. Says whether another run had put its result there since this one
    /// began; this run's result is the one that stays.
    ///
    /// # Errors
    /// [`Error::Write`]; then the folder's older files are as they were.
    pub fn publish(&self, run: &RunFiles) -> Result<bool, Error> {
        let _turn = turn(&self.path).map_err(|e| cannot_write(&self.path, e))?;
        remove_leftovers(&self.path);
        let has_other = result_in(&self.path) != self.before;
        let staging = self.path.join(format!("{STAGING}{}{UNFINISHED}", files::process()));
        let done = stage(&staging, run).and_then(|()| replace(&self.path, &staging, run));
        fs::remove_dir_all(&staging).ok();
        done.map_err(|(name, e)| cannot_write(&self.path.join(name), e))?;
        Ok(has_other)
    }
}

fn cannot_write(path: &Path, source: io::Error) -> Error {
    Error::Write { path: path.into(), source }
}

/// A hash of the result in a folder.
fn result_in(folder: &Path) -> Option<Hash> {
    fs::read(folder.join(RESULT)).ok().map(|bytes| Hash::of(&bytes))
}

/// Waits until no other run writes into the folder. The lock ends with what is returned, and with the program.
fn turn(folder: &Path) -> io::Result<Option<File>> {
    // a folder can be locked itself on most systems: then no file remains
    if let Ok(handle) = File::open(folder)
        && handle.lock().is_ok()
    {
        return Ok(Some(handle));
    }
    let path = folder.join(LOCK);
    let handle = File::options().create(true).truncate(false).write(true).open(path)?;
    match handle.lock() {
        Ok(()) => Ok(Some(handle)),
        // a file system without locks: renames alone keep the time short in which runs can meet
        Err(e) if e.kind() == io::ErrorKind::Unsupported => Ok(None),
        Err(e) => Err(e),
    }
}

/// What could not be done, and with which file.
type Failed = (String, io::Error);

/// What could not be done with this file.
fn with(name: &str) -> impl FnOnce(io::Error) -> Failed {
    let name = name.to_owned();
    move |error| (name, error)
}

/// Writes all files into the folder of unfinished ones.
fn stage(staging: &Path, run: &RunFiles) -> Result<(), Failed> {
    fs::remove_dir_all(staging).ok();
    fs::create_dir(staging).map_err(with(RESULT))?;
    for (name, content) in &run.files {
        write_through(&staging.join(name), content).map_err(with(name))?;
    }
    Ok(())
}

fn write_through(path: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(content)?;
    file.sync_all()
}

/// Puts the staged files into the folder's place; puts the old ones back where one cannot be moved.
fn replace(folder: &Path, staging: &Path, run: &RunFiles) -> Result<(), Failed> {
    let old = staging.join("old");
    fs::create_dir(&old).map_err(with(RESULT))?;
    let (mut aside, mut placed) = (vec![], vec![]);
    let done = move_aside(folder, &old, run, &mut aside)
        .and_then(|()| move_in(folder, staging, run, &mut placed));
    if done.is_err() {
        placed.iter().for_each(|name| drop(fs::remove_file(folder.join(name))));
        // the old result comes back last
        for name in aside.iter().rev() {
            fs::rename(old.join(name), folder.join(name)).ok();
        }
    }
    done
}

/// Moves the older files away, the result first: from then on none stands beside a page that is not its own.
fn move_aside<'a>(
    folder: &Path,
    old: &Path,
    run: &'a RunFiles,
    moved: &mut Vec<&'a str>,
) -> Result<(), Failed> {
    let written = run.files.iter().map(|(name, _)| name.as_str());
    let others = run.absent.iter().copied().chain(written).filter(|name| *name != RESULT);
    for name in [RESULT].into_iter().chain(others) {
        // a folder of that name is somebody's own
        if folder.join(name).is_dir() {
            return Err(with(name)(io::ErrorKind::IsADirectory.into()));
        }
        match fs::rename(folder.join(name), old.join(name)) {
            Ok(()) => moved.push(name),
            Err(e) if e.kind() == io::ErrorKind::NotFound => {}
            Err(e) => return Err(with(name)(e)),
        }
    }
    Ok(())
}

/// Moves the new files into the folder, the result last.
fn move_in<'a>(
    folder: &Path,
    staging: &Path,
    run: &'a RunFiles,
    placed: &mut Vec<&'a str>,
) -> Result<(), Failed> {
    let mut names: Vec<&str> = run.files.iter().map(|(name, _)| name.as_str()).collect();
    names.sort_by_key(|name| *name == RESULT);
    for name in names {
        fs::rename(staging.join(name), folder.join(name)).map_err(with(name))?;
        placed.push(name);
    }
    Ok(())
}

/// Removes what runs that are dead left in a folder.
fn remove_leftovers(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let Some(writer) = writer_of(&name) else { continue };
        if !is_dead(writer) {
            continue;
        }
        match entry.path().is_dir() {
            true => fs::remove_dir_all(entry.path()).ok(),
            false => fs::remove_file(entry.path()).ok(),
        };
    }
}

/// The process that wrote an unfinished file or folder: `.NAME.PID.part`.
fn writer_of(name: &str) -> Option<u32> {
    let (rest, pid) = name.strip_prefix('.')?.strip_suffix(UNFINISHED)?.rsplit_once('.')?;
    (!rest.is_empty()).then(|| pid.parse().ok())?
}

/// Whether there certainly is no such process; where the system does not tell, nothing is certain.
fn is_dead(pid: u32) -> bool {
    let processes = Path::new("/proc");
    processes.join("self").exists() && !processes.join(pid.to_string()).exists()
}

#[cfg(test)]
mod tests {
    use std::{path::PathBuf, process::Command, thread};

    use super::*;

    const PAGE: &str = "report.html";
    const ARM: &str = "corrected_arm.json";

    fn folder(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("handeye-{name}-{}", std::process::id()));
        fs::remove_dir_all(&path).ok();
        path
    }

    /// Files of a run that all say which one it is.
    fn run(id: &str, size: usize) -> RunFiles {
        let content = id.repeat(size).into_bytes();
        let files = [RESULT, PAGE].map(|name| (name.to_owned(), content.clone()));
        RunFiles { files: files.into(), absent: vec![ARM] }
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().flatten();
        let mut names: Vec<String> =
            entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn runs_at_the_same_time_leave_the_files_of_one_run() {
        let out = folder("at-once");
        let write = |id: &str| {
            for _ in 0..50 {
                // each opens its own, as processes do
                ResultFolder::open(&out).unwrap().publish(&run(id, 1000)).unwrap();
            }
        };
        let check = || {
            for _ in 0..2000 {
                let turn = turn(&out).unwrap();
                let (result, page) = (fs::read(out.join(RESULT)), fs::read(out.join(PAGE)));
                assert_eq!(result.ok(), page.ok());
                drop(turn);
            }
        };
        ResultFolder::open(&out).unwrap();
        thread::scope(|s| {
            s.spawn(|| write("a"));
            s.spawn(|| write("b"));
            s.spawn(check);
        });
        assert_eq!(names(&out), [RESULT, PAGE]);
        fs::remove_dir_all(out).unwrap();
    }

    #[test]
    fn a_run_that_wrote_in_the_meantime_is_noticed() {
        let out = folder("meantime");
        let (first, second) =
            (ResultFolder::open(&out).unwrap(), ResultFolder::open(&out).unwrap());
        assert!(!first.publish(&run("a", 1)).unwrap());
        assert!(second.publish(&run("b", 1)).unwrap());
        assert_eq!(fs::read(out.join(PAGE)).unwrap(), b"b");
        assert!(!ResultFolder::open(&out).unwrap().publish(&run("c", 1)).unwrap());
        fs::remove_dir_all(out).unwrap();
    }

    #[test]
    fn files_that_a_run_does_not_have_do_not_stay() {
        let out = folder("absent");
        let folder = ResultFolder::open(&out).unwrap();
        fs::write(out.join(ARM), "of an earlier run").unwrap();
        fs::write(out.join("notes.txt"), "the user's").unwrap();
        folder.publish(&run("a", 1)).unwrap();
        assert_eq!(names(&out), [RESULT, "notes.txt", PAGE]);
        fs::remove_dir_all(out).unwrap();
    }

    #[test]
    fn a_file_that_cannot_be_replaced_leaves_the_old_set() {
        let out = folder("in-the-way");
        let folder = ResultFolder::open(&out).unwrap();
        folder.publish(&run("old", 1)).unwrap();
        let mut next = run("new", 1);
        next.files.push(("no/such/folder.txt".into(), vec![]));
        assert!(folder.publish(&next).is_err());
        assert_eq!(fs::read(out.join(RESULT)).unwrap(), b"old");
        assert_eq!(fs::read(out.join(PAGE)).unwrap(), b"old");
        // a folder in the place of a file is not moved away
        let taken = RunFiles { files: vec![("taken".into(), vec![])], absent: vec![] };
        fs::create_dir_all(out.join("taken/inside")).unwrap();
        assert!(folder.publish(&taken).is_err());
        assert!(out.join("taken/inside").is_dir());
        // renames that fail half-way are taken back
        fs::create_dir_all(out.join("staged")).unwrap();
        fs::write(out.join("staged").join(PAGE), "new").unwrap();
        assert!(replace(&out, &out.join("staged"), &run("new", 1)).is_err());
        assert_eq!(fs::read(out.join(RESULT)).unwrap(), b"old");
        assert_eq!(fs::read(out.join(PAGE)).unwrap(), b"old");
        fs::remove_dir_all(out).unwrap();
    }

    #[test]
    fn what_dead_runs_left_is_removed_and_what_others_write_stays() {
        let out = folder("leftovers");
        let mut dead = Command::new("true").spawn().unwrap();
        let gone = dead.id();
        dead.wait().unwrap();
        if !is_dead(gone) {
            eprintln!("skipped: this system does not tell which processes are there");
            return;
        }
        let own = std::process::id();
        fs::create_dir_all(out.join(format!(".handeye-run.{gone}.part/old"))).unwrap();
        for name in [format!(".report.html.{gone}.part"), format!(".urdf.{own}.part")] {
            fs::write(out.join(name), "half").unwrap();
        }
        for name in [".part", ".x.part", "report.1.part"] {
            fs::write(out.join(name), "the user's").unwrap();
        }
        ResultFolder::open(&out).unwrap().publish(&run("a", 1)).unwrap();
        let expected =
            [".part", &format!(".urdf.{own}.part"), ".x.part", RESULT, "report.1.part", PAGE];
        assert_eq!(names(&out), expected);
        fs::remove_dir_all(out).unwrap();
    }

    /// A small file system in memory, where the system lets us make one.
    fn small_disk(at: &Path) -> bool {
        fs::create_dir_all(at).unwrap();
        let made = Command::new("mount")
            .args(["-t", "tmpfs", "-o", "size=256k", "tmpfs"])
            .arg(at)
            .output();
        made.is_ok_and(|m| m.status.success())
    }

    #[test]
    fn a_full_disk_leaves_the_old_result_with_its_page() {
        let disk = folder("full-disk");
        if !small_disk(&disk) {
            eprintln!("skipped: no small file system can be mounted here");
            fs::remove_dir_all(disk).unwrap();
            return;
        }
        let out = disk.join("result");
        let folder = ResultFolder::open(&out).unwrap();
        folder.publish(&run("old", 100)).unwrap();
        let mut large = run("new", 100);
        large.files[1].1 = vec![b'x'; 1 << 20];
        let error = folder.publish(&large).unwrap_err().to_string();
        assert!(error.contains("report.html: cannot be written"), "{error}");
        assert_eq!(fs::read(out.join(RESULT)).unwrap(), "old".repeat(100).into_bytes());
        assert_eq!(fs::read(out.join(PAGE)).unwrap(), "old".repeat(100).into_bytes());
        assert_eq!(names(&out), [RESULT, PAGE]);
        assert!(Command::new("umount").arg(&disk).status().unwrap().success());
        fs::remove_dir_all(disk).unwrap();
    }
}
