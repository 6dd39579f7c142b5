//! What was done in a session, a line of JSON each; a line counts once its end is written.

use std::{
    collections::BTreeSet,
    fs::{self, File},
    io::Write,
    path::{Path, PathBuf},
};

use handeye::{Base, Flange, Pose};
use serde::{Deserialize, Serialize};

use super::CellSettings;
use crate::{
    Error, Place, Writing,
    error::malformed,
    files::{self, write_atomically},
};

/// A capture as it was stored.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredCapture {
    /// Its name.
    pub id: String,
    /// Its image, relative to the folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<String>,
    /// Its scan likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scan: Option<String>,
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// The numbers from which that was read, where they were typed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub typed: Vec<f64>,
    /// Its joint values (rad, m), where it gave those.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<f64>,
    /// When the robot stood there, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot_time_s: Option<f64>,
    /// When the picture was taken, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image_time_s: Option<f64>,
}

/// A capture that was not taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RefusedCapture {
    /// Why.
    pub why: String,
    /// Where the robot stood; `None` where that was not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_from_flange: Option<Pose<Base, Flange>>,
    /// When, s.
    pub time_s: f64,
}

/// A corner of the board that the tip of a tool touched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredTouch {
    /// Its name.
    pub id: String,
    /// Which corner.
    pub corner: u32,
    /// Of the board of which placement (eye-to-hand).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement: Option<String>,
    /// Whether it verifies the answer, which is not made with it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub verifies: bool,
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// The numbers from which that was read, where they were typed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub typed: Vec<f64>,
    /// When, s.
    pub time_s: f64,
}

/// A board that lies in the camera's view, to be touched (eye-to-hand).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredPlacement {
    /// Its name.
    pub id: String,
    /// Its image, relative to the folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<String>,
    /// Its scan likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scan: Option<String>,
    /// When the image was taken, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image_time_s: Option<f64>,
}

/// A line of the journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Line {
    /// What is known of the cell from now on.
    Cell(Box<CellSettings>),
    /// A capture was taken.
    Take(StoredCapture),
    /// A view was taken that verifies the answer, and is none of the captures that it is made with.
    Verify(StoredCapture),
    /// A capture was not taken.
    Refuse(RefusedCapture),
    /// An image was taken of a board that lies in the view.
    Place(StoredPlacement),
    /// A capture was deleted, or a placement.
    Delete(String),
    /// And taken in again; a touch likewise.
    Restore(String),
    /// A corner was touched.
    Touch(StoredTouch),
    /// A touch was deleted.
    Untouch(String),
    /// The poses up to here were typed in this notation, whatever was said before; it is that of the cell from now on.
    Reread(String),
}

/// The journal's file, and what it says.
pub(super) struct Journal {
    path: PathBuf,
    lines: Vec<Line>,
}

impl Journal {
    /// Reads a journal; one that is missing is empty. A last line without its end was never confirmed, and is taken away.
    pub(super) fn read(path: &Path) -> Result<Self, Error> {
        if !path.exists() {
            return Ok(Self { path: path.into(), lines: vec![] });
        }
        let bytes = fs::read(path).map_err(|source| Error::Read { path: path.into(), source })?;
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
        if whole < bytes.len() {
            write_atomically(path, &bytes[..whole])?;
        }
        if whole == 0 {
            return Ok(Self { path: path.into(), lines: vec![] });
        }
        let text = files::text(path)?;
        let line = |(k, line): (usize, &str)| {
            serde_json::from_str(line).map_err(|e| {
                let what = format!("is no line of a session's journal: {e}");
                let advice =
                    "the captures are in images/ and robot.csv: calibrate the folder as it is";
                malformed(Place::line(path, k + 1), what, advice)
            })
        };
        let mut journal = Self { path: path.into(), lines: vec![] };
        for numbered in text.lines().enumerate() {
            journal.add(line(numbered)?);
        }
        Ok(journal)
    }

    /// A line, and what it changes in those before it.
    fn add(&mut self, line: Line) {
        if let Line::Reread(notation) = &line {
            let reading = Writing::of(notation);
            for before in &mut self.lines {
                let (pose, typed) = match before {
                    Line::Take(c) | Line::Verify(c) => (&mut c.base_from_flange, &c.typed),
                    Line::Touch(t) => (&mut t.base_from_flange, &t.typed),
                    Line::Cell(settings) => {
                        settings.notation.clone_from(notation);
                        continue;
                    }
                    _ => continue,
                };
                // it was tried before the line was written
                if let Some(again) = reading.as_ref().ok().and_then(|r| r.pose(typed).ok()) {
                    *pose = again;
                }
            }
        }
        self.lines.push(line);
    }

    /// Writes a line and syncs it; on a full disk the journal is as before.
    pub(super) fn append(&mut self, line: Line) -> Result<(), Error> {
        let failed = |source| Error::Write { path: self.path.clone(), source };
        let mut text = serde_json::to_string(&line).map_err(|e| failed(e.into()))?;
        text.push('\n');
        let mut file =
            File::options().create(true).append(true).open(&self.path).map_err(failed)?;
        let length = file.metadata().map_err(failed)?.len();
        let written = file.write_all(text.as_bytes()).and_then(|()| file.sync_all());
        if let Err(source) = written {
            file.set_len(length).ok();
            return Err(failed(source));
        }
        self.add(line);
        Ok(())
    }

    /// What is known of the cell.
    pub(super) fn settings(&self) -> Option<&CellSettings> {
        self.lines.iter().rev().find_map(|line| match line {
            Line::Cell(settings) => Some(&**settings),
            _ => None,
        })
    }

    /// What lines of one kind say, in their order.
    fn each<'a, T>(&'a self, said: fn(&'a Line) -> Option<&'a T>) -> Vec<&'a T> {
        self.lines.iter().filter_map(said).collect()
    }

    /// All captures that were ever taken.
    pub(super) fn taken(&self) -> Vec<&StoredCapture> {
        self.each(|line| match line {
            Line::Take(capture) => Some(capture),
            _ => None,
        })
    }

    /// All views that were ever taken to verify the answer.
    pub(super) fn verifying(&self) -> Vec<&StoredCapture> {
        self.each(|line| match line {
            Line::Verify(view) => Some(view),
            _ => None,
        })
    }

    /// Both.
    pub(super) fn stored(&self) -> Vec<&StoredCapture> {
        self.taken().into_iter().chain(self.verifying()).collect()
    }

    /// All placements that there ever were.
    pub(super) fn placed(&self) -> Vec<&StoredPlacement> {
        self.each(|line| match line {
            Line::Place(placement) => Some(placement),
            _ => None,
        })
    }

    /// Those that stand.
    pub(super) fn placements(&self) -> Vec<&StoredPlacement> {
        let gone = self.gone();
        self.placed().into_iter().filter(|p| !gone.contains(&p.id[..])).collect()
    }

    /// The names of captures, views, placements and touches that are deleted.
    fn gone(&self) -> BTreeSet<&str> {
        let mut gone = BTreeSet::new();
        for line in &self.lines {
            match line {
                Line::Delete(id) | Line::Untouch(id) => _ = gone.insert(&id[..]),
                Line::Restore(id) => _ = gone.remove(&id[..]),
                _ => {}
            }
        }
        gone
    }

    pub(super) fn stands(&self, id: &str) -> bool {
        !self.gone().contains(id)
    }

    /// Of captures or views, those that were not deleted.
    pub(super) fn standing<'a>(&self, all: Vec<&'a StoredCapture>) -> Vec<&'a StoredCapture> {
        let gone = self.gone();
        all.into_iter().filter(|c| !gone.contains(&c.id[..])).collect()
    }

    pub(super) fn deleted(&self) -> Vec<&StoredCapture> {
        let gone = self.gone();
        self.stored().into_iter().filter(|c| gone.contains(&c.id[..])).collect()
    }

    /// All touches that were ever made.
    pub(super) fn touched(&self) -> Vec<&StoredTouch> {
        self.each(|line| match line {
            Line::Touch(touch) => Some(touch),
            _ => None,
        })
    }

    /// Those that stand; with a placement its touches go, and come back.
    pub(super) fn touches(&self) -> Vec<&StoredTouch> {
        let gone = self.gone();
        self.of_standing_boards().filter(|touch| !gone.contains(&touch.id[..])).collect()
    }

    /// Those that were deleted themselves.
    pub(super) fn deleted_touches(&self) -> Vec<&StoredTouch> {
        let gone = self.gone();
        self.of_standing_boards().filter(|touch| gone.contains(&touch.id[..])).collect()
    }

    fn of_standing_boards(&self) -> impl Iterator<Item = &StoredTouch> {
        let gone = self.gone();
        let stands =
            move |t: &&StoredTouch| t.placement.as_ref().is_none_or(|p| !gone.contains(&p[..]));
        self.touched().into_iter().filter(stands)
    }

    /// Placements that were deleted.
    pub(super) fn deleted_placements(&self) -> Vec<&StoredPlacement> {
        let gone = self.gone();
        self.placed().into_iter().filter(|p| gone.contains(&p.id[..])).collect()
    }

    pub(super) fn refused(&self) -> Vec<&RefusedCapture> {
        self.each(|line| match line {
            Line::Refuse(refused) => Some(refused),
            _ => None,
        })
    }
}
