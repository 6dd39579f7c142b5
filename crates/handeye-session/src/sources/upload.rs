//! Images that somebody hands over one by one: chosen on the page, taken by the browser's own camera, or sent by a script.

use std::{
    collections::HashSet,
    hash::{DefaultHasher, Hash, Hasher},
    sync::{Arc, Mutex, PoisonError},
};

use handeye_io::read_image_bytes;

use super::outlet::{CameraImage, Outlet};

/// The way of uploaded images into a session.
#[derive(Clone)]
pub struct Uploads {
    outlet: Outlet,
    /// Sums of images that have come.
    contents: Arc<Mutex<HashSet<u64>>>,
}

impl Uploads {
    /// Images go there.
    pub fn to(outlet: Outlet) -> Self {
        Self { outlet, contents: Arc::default() }
    }

    /// Hands over an image's file.
    ///
    /// # Errors
    /// What is no image, and an image that has come before: it would be of another pose.
    pub fn image(&self, bytes: &[u8]) -> Result<(), String> {
        let read = read_image_bytes(bytes, "the uploaded file").map_err(|e| e.to_string())?;
        let mut sum = DefaultHasher::new();
        bytes.hash(&mut sum);
        let mut contents = self.contents.lock().unwrap_or_else(PoisonError::into_inner);
        if !contents.insert(sum.finish()) {
            return Err("this image has come before: take one of now".into());
        }
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
