//! Does what the engine wants done: stores, assesses, writes.

use std::{path::Path, sync::Arc};

use handeye::{Calibration, Config, Session};
use handeye_io::{
    Dataset, Error, NewCapture, NewPlacement, NewTouch, ResultFolder, SessionFolder,
    calibrate::{calibrate_dataset, write_run},
    report::dataset_html,
    simulated,
};

use crate::{
    assess::{Measured, NextWanted, assess},
    engine::{Effect, FolderState, Input, Written, rest::RobotSample},
    sources::{
        outlet::{CameraImage, StoredFile},
        virtual_cell::VirtualCell,
    },
};

/// The folder, and what was measured in it.
pub struct Host {
    folder: SessionFolder,
    measured: Measured,
}

/// The folder of the result in a session's folder.
pub const RESULT: &str = "result";

impl Host {
    /// Of a folder that is open.
    pub fn new(folder: SessionFolder) -> Self {
        Self { folder, measured: Measured::default() }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Whether captures, deleted ones among them, have scans; `None` without any.
    pub fn has_scans(&self) -> Option<bool> {
        let mut all = self.folder.captures().into_iter().chain(self.folder.deleted());
        all.next().map(|capture| capture.scan.is_some())
    }

    /// What the folder holds.
    pub fn state(&self) -> FolderState {
        let owned = |all: Vec<&handeye_io::StoredCapture>| all.into_iter().cloned().collect();
        FolderState {
            settings: self.folder.settings().clone(),
            captures: owned(self.folder.captures()),
            verification: owned(self.folder.verification()),
            deleted: self.deleted(),
            refused: self.folder.refused().into_iter().cloned().collect(),
            placements: self.folder.placements().into_iter().cloned().collect(),
            laid_last: self.folder.laid_last().map(Into::into),
            touches: self.folder.touches().into_iter().cloned().collect(),
            arm: self.folder.urdf().cloned(),
        }
    }

    /// Names of captures, views, placements and touches that were deleted.
    fn deleted(&self) -> Vec<String> {
        let captures = self.folder.deleted().into_iter().map(|c| &c.id[..]);
        captures.chain(self.folder.deleted_beside()).map(Into::into).collect()
    }

    /// Does it; returns what it led to. Effects for sources are not for it.
    pub fn perform(&mut self, effect: Effect, image: Option<CameraImage>) -> Vec<Input> {
        match effect {
            Effect::Store { verifies, robot, image_time_s, .. } => {
                self.store(verifies, (&robot, image_time_s), image)
            }
            Effect::StorePlacement { image_time_s, .. } => self.place(image_time_s, image),
            Effect::StoreTouch { corner, placement, verifies, robot } => {
                let stored = self.folder.touch(&NewTouch {
                    placement: placement.as_deref(),
                    corner,
                    verifies,
                    base_from_flange: robot.base_from_flange,
                    typed: &robot.typed,
                    time_s: robot.time_s,
                });
                let stored = stored.map_err(|e| e.to_string());
                vec![Input::Folder(Box::new(self.state())), Input::Touched(stored)]
            }
            Effect::Untouch(id) => {
                let done = self.folder.untouch(&id);
                self.changed(done)
            }
            Effect::Refuse(refused) => {
                let done = self.folder.refuse(refused);
                self.changed(done)
            }
            Effect::Delete(id) => {
                let done = self.folder.delete(&id);
                self.changed(done)
            }
            Effect::Restore(id) => {
                let done = self.folder.restore(&id);
                self.changed(done)
            }
            Effect::Configure(settings) => {
                let done = self.folder.set(&settings);
                self.changed(done)
            }
            Effect::Reread(notation) => {
                let done = self.folder.reread(&notation);
                self.changed(done)
            }
            Effect::Assess { generation, not_near, goes_on, joints } => {
                let wanted = NextWanted { not_near: &not_near, goes_on, joints: joints.as_deref() };
                let assessment = assess(&self.folder, &mut self.measured, wanted);
                let assessment = assessment.map(Arc::new).map_err(|e| e.to_string());
                vec![Input::Assessed { generation, assessment }]
            }
            Effect::Write => {
                let written = self.finish().map(|finished| finished.written);
                vec![Input::Written(written.map_err(|e| e.to_string()))]
            }
            Effect::Drive(_)
            | Effect::DriveTip(_)
            | Effect::Lay(_)
            | Effect::Jog(..)
            | Effect::Grab => vec![],
        }
    }

    fn store(
        &mut self,
        verifies: bool,
        (robot, image_time_s): (&RobotSample, f64),
        image: Option<CameraImage>,
    ) -> Vec<Input> {
        let Some(image) = image else {
            return vec![Input::Stored(Err("the image is gone: take the capture again".into()))];
        };
        let picture = stored_picture(&image);
        let capture = NewCapture {
            base_from_flange: robot.base_from_flange,
            typed: &robot.typed,
            joints: &robot.joints,
            robot_time_s: Some(robot.time_s),
            image_time_s: Some(image_time_s),
            image: Some(file(&picture)),
            scan: image.scan.as_ref().map(file),
        };
        let stored = match verifies {
            true => self.folder.verify(&capture),
            false => self.folder.take(&capture),
        };
        let stored = stored.map_err(|e| e.to_string());
        // first what lies in the folder: until then it is being stored
        vec![Input::Folder(Box::new(self.state())), Input::Stored(stored)]
    }

    fn place(&mut self, image_time_s: f64, image: Option<CameraImage>) -> Vec<Input> {
        let Some(image) = image else {
            return vec![Input::Stored(Err("the image is gone: take it again".into()))];
        };
        let picture = stored_picture(&image);
        let stored = self.folder.place(&NewPlacement {
            image_time_s: Some(image_time_s),
            image: Some(file(&picture)),
            scan: image.scan.as_ref().map(file),
        });
        let stored = stored.map_err(|e| e.to_string());
        vec![Input::Folder(Box::new(self.state())), Input::Stored(stored)]
    }

    fn changed(&self, done: Result<(), Error>) -> Vec<Input> {
        let failed = done.err().map(|e| Input::Failed(e.to_string()));
        failed.into_iter().chain([Input::Folder(Box::new(self.state()))]).collect()
    }

    /// Writes the result as `handeye calibrate --out result` does, the same bytes.
    ///
    /// # Errors
    /// A folder that cannot be read or written.
    pub fn finish(&self) -> Result<Finished, Error> {
        let dataset = self.folder.dataset()?;
        let out = self.folder.path().join(RESULT);
        let results = ResultFolder::open(&out)?;
        let (calibration, session) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {})?;
        let page = dataset_html(&dataset, &calibration, &session);
        write_run((&out, &results), Some(&dataset), &calibration, &page, vec![])?;
        let files = vec!["calibration.json".into(), "report.html".into()];
        let written = Written { folder: out.display().to_string(), files };
        Ok(Finished { written, calibration, dataset, session })
    }
}

/// A result that was written, and what it was made of.
#[derive(Debug)]
pub struct Finished {
    /// Its files.
    pub written: Written,
    /// The result.
    pub calibration: Calibration,
    /// The folder as a dataset.
    pub dataset: Dataset,
    /// What was measured in it.
    pub session: Session,
}

/// The file of an image: the camera's own, where there is one.
fn stored_picture(image: &CameraImage) -> StoredFile {
    let made = || ("png".into(), simulated::picture(&image.grey).into());
    image.file.clone().unwrap_or_else(made)
}

/// A file as the folder takes it.
fn file((ending, bytes): &StoredFile) -> (&str, &[u8]) {
    (ending, bytes)
}

/// Drives a virtual cell where the engine says so; whether the effect was one of those.
pub fn drive(cell: &VirtualCell, effect: &Effect, now: f64) -> bool {
    match effect {
        Effect::Drive(to) => cell.drive(*to, now),
        Effect::DriveTip(corner) => cell.drive_tip(*corner, now),
        Effect::Lay(true) => cell.lay(now),
        Effect::Lay(false) => cell.take_away(),
        Effect::Jog(by, turn) => cell.jog(*by, *turn, now),
        _ => return false,
    }
    true
}
