//! Images that somebody hands over one by one: chosen on the page, taken by the browser's own camera, or sent by a script.

use std::{
    collections::HashSet,
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::Path,
    sync::{Arc, Mutex, PoisonError},
};

use handeye_io::read_image_bytes;

use super::outlet::{CameraImage, Outlet};

/// The way of uploaded images into a session.
#[derive(Clone)]
pub struct Uploads {
    outlet: Outlet,
    contents: Arc<Mutex<Contents>>,
}

/// Sums of images that have come.
#[derive(Default)]
struct Contents {
    all: HashSet<u64>,
    newest: Option<u64>,
}

impl Uploads {
    /// Images go there, but for those that a session's folder holds.
    pub fn to(outlet: Outlet, folder: &Path) -> Self {
        let files = ["images", "verification"].map(|name| fs::read_dir(folder.join(name)));
        let files = files.into_iter().flatten().flatten().flatten();
        let all = files.filter_map(|file| Some(sum(&fs::read(file.path()).ok()?))).collect();
        Self { outlet, contents: Arc::new(Mutex::new(Contents { all, newest: None })) }
    }

    /// Hands over an image's file.
    ///
    /// # Errors
    /// What is no image, and an image that has come before: it would be of another pose.
    pub fn image(&self, bytes: &[u8]) -> Result<(), String> {
        let read = read_image_bytes(bytes, "the uploaded file").map_err(|e| e.to_string())?;
        let sum = sum(bytes);
        let mut contents = self.contents.lock().unwrap_or_else(PoisonError::into_inner);
        if contents.newest == Some(sum) {
            return Ok(()); // sent once more, for the answer was lost
        }
        if !contents.all.insert(sum) {
            return Err("this image has come before: take one of now".into());
        }
        contents.newest = Some(sum);
        drop(contents);
        let (grey, ending) = read;
        let file = Some((ending.to_owned(), bytes.into()));
        let now = self.outlet.now();
        match self.outlet.image(CameraImage { grey: Arc::new(grey), file, scan: None }, now) {
            true => Ok(()),
            false => Err("the session has ended".into()),
        }
    }
}

fn sum(bytes: &[u8]) -> u64 {
    let mut sum = DefaultHasher::new();
    bytes.hash(&mut sum);
    sum.finish()
}
