//! A folder that grows capture by capture, and is an ordinary dataset at any moment.
//!
//! ```text
//! handeye.toml        the manifest
//! robot.csv           the flange's pose in each capture, in the robot's notation, and its joint values
//! robot/robot.urdf    the robot's model, where one was given, and the meshes of its links
//! touches.csv         the same for each corner that was touched; touches that verify the answer are in the journal alone
//! images/001.png      scans/001.ply
//! placements/p01.png  boards that lie in the view, to be touched
//! verification/v01.png    views that verify the answer, which is not made with them
//! journal.jsonl       what was done, a line each: the truth, from which the rest follows
//! deleted/            images and scans of captures that were deleted, for those who want them back
//! ```
//!
//! A capture's files are written aside and synced first, then its line in the journal, then they are renamed into place
//! and the table of poses is written anew. A program that is killed in between leaves a capture that is whole, or one
//! that was never confirmed: [`SessionFolder::open`] makes the folder agree with its journal again.

mod arm;
mod journal;
mod manifest;
mod touches;

use std::{
    fs::{self, File, TryLockError},
    path::{Path, PathBuf},
    sync::Arc,
};

use handeye::{Base, Flange, Intrinsics, Pose};

use crate::{
    CaptureSource, Dataset, Error, MANIFEST, Urdf, Writing, error::unusable,
    files::write_atomically,
};
use journal::{Journal, Line};
pub use journal::{RefusedCapture, StoredCapture, StoredPlacement, StoredTouch};
pub use manifest::{ArmLinks, CameraGuess, CellSettings, ScanSettings};
pub use touches::{NewPlacement, NewTouch};

/// The journal's name.
const JOURNAL: &str = "journal.jsonl";
/// The table of touches.
const TOUCHES: &str = "touches.csv";
/// The robot's model.
const URDF: &str = "robot/robot.urdf";
/// Where files of deleted captures are kept.
const DELETED: &str = "deleted";
/// The folder of verification views.
const VERIFICATION: &str = "verification";
/// The folder of placements.
const PLACEMENTS: &str = "placements";
/// No session has more of those.
const MOST_VIEWS: u32 = 99;
/// No session has more captures.
const MOST_CAPTURES: u32 = 9999;

/// The folder of a session; no other program writes to it as long as this exists.
pub struct SessionFolder {
    root: PathBuf,
    journal: Journal,
    settings: CellSettings,
    urdf: Option<Arc<Urdf>>,
    _lock: File,
}

/// What a capture consists of.
#[derive(Debug, Clone)]
pub struct NewCapture<'a> {
    /// The flange's pose, as the robot reported it.
    pub base_from_flange: Pose<Base, Flange>,
    /// The numbers from which that was read, where they were typed.
    pub typed: &'a [f64],
    /// Joint values (rad, m), where the robot gave those.
    pub joints: &'a [f64],
    /// When the robot stood there, s.
    pub robot_time_s: Option<f64>,
    /// When the picture was taken, s, by the same clock.
    pub image_time_s: Option<f64>,
    /// The image's file: its ending (`png`) and its bytes.
    pub image: Option<(&'a str, &'a [u8])>,
    /// The scan's file likewise, to be read as the settings say, or in metres.
    pub scan: Option<(&'a str, &'a [u8])>,
}

/// The files of a capture or placement: image and scan, each an ending and bytes.
type NewFiles<'a> = [Option<(&'a str, &'a [u8])>; 2];
/// And their names in the folder.
type FileNames = [Option<String>; 2];

impl SessionFolder {
    /// Opens a folder that a session has written, or begins one in an empty or missing folder. `settings` are asked for in
    /// a new one.
    ///
    /// # Errors
    /// A folder that holds something else, or that another session writes to.
    pub fn open(root: &Path, settings: Option<&CellSettings>) -> Result<Self, Error> {
        fs::create_dir_all(root).map_err(|source| write(root, source))?;
        let lock = locked(root)?;
        let path = root.join(JOURNAL);
        let is_new = !path.exists();
        if is_new && has_files(root) {
            return Err(unusable(
                root,
                format!(
                    "holds files, but no {JOURNAL} of a session: give an empty or a new folder"
                ),
            ));
        }
        let mut journal = Journal::read(&path)?;
        let settings = match (journal.settings(), settings) {
            (Some(own), _) => own.clone(),
            (None, Some(new)) => {
                journal.append(Line::Cell(Box::new(new.clone())))?;
                new.clone()
            }
            (None, None) => {
                return Err(unusable(root, "is new: a session needs to know the cell (settings)"));
            }
        };
        let urdf = arm::of(root, settings.arm.as_ref())?;
        let folder = Self { root: root.into(), journal, settings, urdf, _lock: lock };
        folder.settle()?;
        Ok(folder)
    }

    /// Whether a session has begun in a folder.
    pub fn is_one(root: &Path) -> bool {
        root.join(JOURNAL).is_file()
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.root
    }

    /// What is known of the cell.
    pub fn settings(&self) -> &CellSettings {
        &self.settings
    }

    /// The captures that stand, in the order in which they were taken.
    pub fn captures(&self) -> Vec<&StoredCapture> {
        self.journal.standing(self.journal.taken())
    }

    /// Views that verify the answer, in the order in which they were taken: no captures, the answer is not made with them.
    pub fn verification(&self) -> Vec<&StoredCapture> {
        self.journal.standing(self.journal.verifying())
    }

    /// Captures that were deleted, and views.
    pub fn deleted(&self) -> Vec<&StoredCapture> {
        self.journal.deleted()
    }

    /// Captures that were not taken, and why.
    pub fn refused(&self) -> Vec<&RefusedCapture> {
        self.journal.refused()
    }

    /// The dataset of the captures that stand; without any it has none.
    ///
    /// # Errors
    /// As [`Dataset::open`].
    pub fn dataset(&self) -> Result<Dataset, Error> {
        match self.captures().is_empty() {
            true => Dataset::without_captures(&self.root.join(MANIFEST)),
            false => Dataset::open(&self.root),
        }
    }

    /// What verifies the answer, as a dataset of the camera as the answer has it: views, and touches of the board with the
    /// placements that they are on.
    ///
    /// # Errors
    /// As [`Dataset::open`].
    pub fn verification_dataset(&self, camera: Option<Intrinsics>) -> Result<Dataset, Error> {
        let source = |view: &&StoredCapture| CaptureSource {
            id: view.id.clone(),
            base_from_flange: view.base_from_flange,
            joints: view.joints.clone(),
            time_s: None,
            image: view.image.as_ref().map(|name| self.root.join(name)),
            scan: view.scan.as_ref().map(|name| self.root.join(name)),
            corners: None,
            camera_from_target: None,
            robot_record: 0,
        };
        let captures = self.verification().iter().map(source).collect();
        let mut cell = Dataset::without_captures(&self.root.join(MANIFEST))?;
        cell.intrinsics = camera.or(cell.intrinsics);
        cell.touches = self.touches_verifying();
        cell.placements = self.placements_verifying();
        cell.captures = captures;
        Ok(cell)
    }

    /// Refuses the settings of another cell where there are captures: whoever declares them anew has taken the wrong folder.
    ///
    /// # Errors
    /// [`Error::Unusable`] where setup, camera or target differ.
    pub fn is_of_cell(&self, settings: &CellSettings) -> Result<(), Error> {
        match settings.is_of_same_cell(&self.settings) || self.journal.taken().is_empty() {
            true => Ok(()),
            false => Err(unusable(
                &self.root,
                "has captures of another camera, board or setup, or scans in another unit: begin a session in a new folder, or change what is wrong on the page of this session",
            )),
        }
    }

    /// Other settings. Captures are read anew with them.
    ///
    /// # Errors
    /// [`Error::Unusable`] for a target of other corners once corners were touched; a folder that cannot be written.
    pub fn set(&mut self, settings: &CellSettings) -> Result<(), Error> {
        let corners = |of: &CellSettings| (of.setup, of.target.grid(), of.target.len());
        if corners(settings) != corners(&self.settings) && !self.touches().is_empty() {
            return Err(unusable(
                &self.root,
                "has touches of corners, whose numbers are those of the board as it was: delete the touches first",
            ));
        }
        self.journal.append(Line::Cell(Box::new(settings.clone())))?;
        self.settings = settings.clone();
        self.settle()
    }

    /// Reads the numbers of all poses again, as those of another notation: they were typed in it, and nobody had said so.
    ///
    /// # Errors
    /// Poses that were not typed, or are none in the other notation; a folder that cannot be written.
    pub fn reread(&mut self, notation: &str) -> Result<(), Error> {
        let reading = Writing::of(notation).map_err(|why| unusable(&self.root, why))?;
        let captures = self.journal.stored().into_iter().map(|c| (&c.id, &c.typed));
        let touches = self.journal.touched().into_iter().map(|t| (&t.id, &t.typed));
        for (id, typed) in captures.chain(touches) {
            let why = match typed.is_empty() {
                true => "was not typed, the robot gave it".to_owned(),
                false => match reading.pose(typed) {
                    Ok(_) => continue,
                    Err(why) => format!("is none of {notation}: {why}"),
                },
            };
            return Err(unusable(
                &self.root,
                format!("the pose of {id} {why}; nothing is read again"),
            ));
        }
        self.journal.append(Line::Reread(notation.into()))?;
        self.settings.notation = notation.into();
        self.settle()
    }

    /// Stores a capture; what it returns, its name, is never used for another.
    ///
    /// # Errors
    /// A folder that cannot be written, as when the disk is full: then the capture is not there at all.
    pub fn take(&mut self, capture: &NewCapture) -> Result<String, Error> {
        let number = self.journal.taken().len() as u32 + 1;
        if number > MOST_CAPTURES {
            return Err(unusable(&self.root, format!("has {MOST_CAPTURES} captures already")));
        }
        self.store(capture, format!("{number:03}"), ("images", "scans"), Line::Take)
    }

    /// Stores a view that verifies the answer likewise.
    ///
    /// # Errors
    /// As [`SessionFolder::take`].
    pub fn verify(&mut self, view: &NewCapture) -> Result<String, Error> {
        let number = self.journal.verifying().len() as u32 + 1;
        if number > MOST_VIEWS {
            return Err(unusable(
                &self.root,
                format!("has {MOST_VIEWS} verification views already"),
            ));
        }
        self.store(view, format!("v{number:02}"), (VERIFICATION, VERIFICATION), Line::Verify)
    }

    fn store(
        &mut self,
        capture: &NewCapture,
        id: String,
        (images, scans): (&str, &str),
        line: fn(StoredCapture) -> Line,
    ) -> Result<String, Error> {
        self.store_files(&id, (images, scans), [capture.image, capture.scan], |[image, scan]| {
            line(StoredCapture {
                id: id.clone(),
                image,
                scan,
                base_from_flange: capture.base_from_flange,
                typed: capture.typed.to_vec(),
                joints: capture.joints.to_vec(),
                robot_time_s: capture.robot_time_s,
                image_time_s: capture.image_time_s,
            })
        })?;
        Ok(id)
    }

    /// Writes files aside, then the line with their names, then brings them into their folders.
    fn store_files(
        &mut self,
        id: &str,
        (images, scans): (&str, &str),
        [image, scan]: NewFiles,
        line: impl FnOnce(FileNames) -> Line,
    ) -> Result<(), Error> {
        let mut aside = vec![];
        let mut place = |folder: &str, file: Option<(&str, &[u8])>| -> Result<_, Error> {
            let Some((ending, bytes)) = file else { return Ok(None) };
            let name = format!("{folder}/{id}.{ending}");
            let path = self.aside(&name);
            make_parent(&path)?;
            aside.push(path.clone());
            write_atomically(&path, bytes)?;
            Ok(Some(name))
        };
        let files = place(images, image).and_then(|image| Ok([image, place(scans, scan)?]));
        let written = files.and_then(|names| self.journal.append(line(names)));
        if written.is_err() {
            aside.iter().for_each(|path| _ = fs::remove_file(path));
        }
        written?;
        self.settle()
    }

    /// Remembers a capture that was not taken, and why.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn refuse(&mut self, refused: RefusedCapture) -> Result<(), Error> {
        self.journal.append(Line::Refuse(refused))
    }

    /// Takes a capture out, a verification view, or a placement with its touches; its files are kept aside.
    ///
    /// # Errors
    /// No such capture; a folder that cannot be written.
    pub fn delete(&mut self, id: &str) -> Result<(), Error> {
        let is_placement = self.placements().iter().any(|p| p.id == id);
        if !is_placement && !self.captures().iter().chain(&self.verification()).any(|c| c.id == id)
        {
            return Err(unusable(&self.root, format!("has no capture {id}")));
        }
        self.journal.append(Line::Delete(id.into()))?;
        self.settle()
    }

    /// Takes a deleted capture in again, a view, a placement with its touches, or a touch.
    ///
    /// # Errors
    /// As [`SessionFolder::delete`].
    pub fn restore(&mut self, id: &str) -> Result<(), Error> {
        if !self.deleted().iter().any(|c| c.id == id) && !self.deleted_beside().contains(&id) {
            return Err(unusable(&self.root, format!("has no deleted capture {id}")));
        }
        self.journal.append(Line::Restore(id.into()))?;
        self.settle()
    }

    /// Where a file lies that is not part of the dataset (yet, or any more).
    fn aside(&self, name: &str) -> PathBuf {
        self.root.join(DELETED).join(name)
    }

    /// Makes files agree with the journal: what stands lies in its place, what was deleted aside; then table and manifest.
    fn settle(&self) -> Result<(), Error> {
        let captures = self.journal.stored().into_iter().map(|c| (&c.id, [&c.image, &c.scan]));
        let placements = self.journal.placed().into_iter().map(|p| (&p.id, [&p.image, &p.scan]));
        for (id, files) in captures.chain(placements) {
            let stands = self.journal.stands(id);
            for name in files.into_iter().flatten() {
                let (aside, there) = (self.aside(name), self.root.join(name));
                let (from, to) = if stands { (aside, there) } else { (there, aside) };
                if from.exists() {
                    make_parent(&to)?;
                    fs::rename(&from, &to).map_err(|source| write(&to, source))?;
                }
            }
        }
        // only those that are empty go
        let aside = ["images", "scans", VERIFICATION, PLACEMENTS].map(|name| self.aside(name));
        let emptied = [DELETED, VERIFICATION, PLACEMENTS].map(|name| self.root.join(name));
        aside.iter().chain(&emptied).for_each(|path| _ = fs::remove_dir(path));
        self.write_if_changed("robot.csv", &self.table())?;
        let touches = self.touches_used();
        match touches.is_empty() {
            true => _ = fs::remove_file(self.root.join(TOUCHES)),
            false => self.write_if_changed(TOUCHES, &self.table_of(&touches))?,
        }
        let held = manifest::Held {
            has_scans: self.captures().iter().any(|c| c.scan.is_some()),
            has_touches: !touches.is_empty(),
            placements: self.placements_used(),
            has_joints: self.has_joints(),
        };
        self.write_if_changed(MANIFEST, &manifest::text(&self.settings, &held))
    }

    fn table(&self) -> String {
        let poses = self.captures();
        let poses = poses.iter().map(|c| (&c.id[..], &c.base_from_flange));
        // as on the pendant: mistakes about these numbers can be found in them
        let writing = Writing::of(&self.settings.notation);
        let table = writing.map_or_else(|_| String::new(), |writing| writing.table(poses));
        match self.has_joints() {
            true => self.with_joints(&table),
            false => table,
        }
    }

    fn write_if_changed(&self, name: &str, text: &str) -> Result<(), Error> {
        let path = self.root.join(name);
        match fs::read(&path).is_ok_and(|old| old == text.as_bytes()) {
            true => Ok(()),
            false => write_atomically(&path, text.as_bytes()),
        }
    }
}

fn write(path: &Path, source: std::io::Error) -> Error {
    Error::Write { path: path.into(), source }
}

fn make_parent(path: &Path) -> Result<(), Error> {
    let folder = path.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder).map_err(|source| write(folder, source))
}

/// Whether there is anything but hidden files.
fn has_files(root: &Path) -> bool {
    let is_visible = |entry: fs::DirEntry| !entry.file_name().to_string_lossy().starts_with('.');
    fs::read_dir(root).is_ok_and(|all| all.flatten().any(is_visible))
}

/// A lock that ends with the program: two sessions do not write to one folder.
fn locked(root: &Path) -> Result<File, Error> {
    let path = root.join(".session.lock");
    let file = File::options().create(true).truncate(false).write(true).open(&path);
    let file = file.map_err(|source| write(&path, source))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(unusable(
            root,
            "is in use by another session: end that one, or open its address in another browser",
        )),
        // a file system without locks
        Err(TryLockError::Error(e)) if e.kind() == std::io::ErrorKind::Unsupported => Ok(file),
        Err(TryLockError::Error(source)) => Err(write(&path, source)),
    }
}

#[cfg(test)]
mod tests;
