//! A folder in which another program saves images: any vendor's viewer. It is asked again and again, for network drives
//! tell nobody of new files. A file counts once it no longer changes and can be read; one that was seen under another name
//! is not a new one.

use std::{
    collections::{BTreeMap, HashSet},
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::{Path, PathBuf},
    sync::Arc,
    thread,
    time::{Duration, SystemTime},
};

use handeye_io::read_image;

use super::outlet::{CameraImage, Outlet};

/// How often the folder is asked.
const POLL: Duration = Duration::from_millis(300);
/// A file that cannot be read is given up after so many times: by then it would have been written.
const TRIES: usize = 20;
/// Endings of images.
const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "tif", "tiff", "bmp"];
/// Larger files are no images of a camera, bytes.
const LARGEST: u64 = 512 << 20;

/// What is known of a file: size and time of the last change.
type FileState = (u64, Option<SystemTime>);

/// A folder that is watched.
struct Watched {
    folder: PathBuf,
    /// Files as they were when they were done with.
    done: BTreeMap<PathBuf, FileState>,
    /// Files that wait: as they were at the last look, and how often they could not be read.
    waiting: BTreeMap<PathBuf, (FileState, usize)>,
    /// Sums of images that have come.
    contents: HashSet<u64>,
}

/// Hands over every image that is saved into a folder from now on.
pub fn watch(folder: PathBuf, outlet: Outlet) {
    thread::spawn(move || {
        let mut watched = Watched::new(folder);
        let mut wanted = outlet.wanted();
        let mut was_there = true;
        let mut newest = 0.0;
        loop {
            let is_there = watched.folder.is_dir();
            if was_there && !is_there {
                let message = format!("the folder {} is gone", watched.folder.display());
                let advice = "is the drive connected? Images are taken again once it is back";
                outlet.trouble("folder-gone", message, advice);
            }
            was_there = is_there;
            let now = outlet.now();
            for found in watched.look() {
                newest = now;
                let alive = match found {
                    Ok(image) => outlet.image(image, now),
                    Err(why) => outlet.trouble("image-unreadable", why, "save the image again"),
                };
                if !alive {
                    return;
                }
            }
            let now_wanted = outlet.wanted();
            if now_wanted != wanted {
                wanted = now_wanted;
                outlet.look_again(newest);
            }
            thread::sleep(POLL);
        }
    });
}

impl Watched {
    /// Files that are there already are not of this session.
    fn new(folder: PathBuf) -> Self {
        let done = files(&folder).into_iter().collect();
        let (waiting, contents) = (BTreeMap::new(), HashSet::new());
        Self { folder, done, waiting, contents }
    }

    /// New images, in the order of their time; or why a file is none.
    fn look(&mut self) -> Vec<Result<CameraImage, String>> {
        let mut all = files(&self.folder);
        all.sort_by(|a, b| a.1.1.cmp(&b.1.1).then(a.0.cmp(&b.0)));
        self.waiting.retain(|path, _| all.iter().any(|(there, _)| there == path));
        let mut found = vec![];
        for (path, state) in all {
            if self.done.get(&path) == Some(&state) {
                continue;
            }
            let tries = match self.waiting.get(&path) {
                Some((before, tries)) if *before == state => *tries,
                // it is new, or still being written
                _ => {
                    self.waiting.insert(path, (state, 0));
                    continue;
                }
            };
            match read(&path, state.0) {
                Ok((image, sum)) => {
                    self.waiting.remove(&path);
                    self.done.insert(path, state);
                    if self.contents.insert(sum) {
                        found.push(Ok(image));
                    }
                }
                Err(why) if tries + 1 >= TRIES => {
                    self.waiting.remove(&path);
                    self.done.insert(path, state);
                    found.push(Err(why));
                }
                Err(_) => _ = self.waiting.insert(path, (state, tries + 1)),
            }
        }
        found
    }
}

/// Images in a folder, hidden ones aside.
fn files(folder: &Path) -> Vec<(PathBuf, FileState)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let one = |entry: fs::DirEntry| {
        let path = entry.path();
        let hidden = entry.file_name().to_string_lossy().starts_with('.');
        let meta = entry.metadata().ok().filter(|m| m.is_file() && m.len() > 0)?;
        (!hidden && ending(&path).is_some()).then(|| (path, (meta.len(), meta.modified().ok())))
    };
    entries.filter_map(one).collect()
}

/// The ending of an image's name, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    ENDINGS.contains(&&ending[..]).then_some(ending)
}

/// An image's file, and the sum of its bytes.
pub(super) fn read(path: &Path, length: u64) -> Result<(CameraImage, u64), String> {
    if length > LARGEST {
        return Err(format!("{} is no image: it has {length} bytes", path.display()));
    }
    let image = read_image(path, None).map_err(|e| e.to_string())?;
    let bytes = fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    if bytes.len() as u64 != length {
        return Err(format!("{} is still being written", path.display()));
    }
    let mut sum = DefaultHasher::new();
    bytes.hash(&mut sum);
    let ending = ending(path).unwrap_or("png".into());
    let file = Some((ending, bytes.into()));
    Ok((CameraImage { grey: Arc::new(image), file, scan: None }, sum.finish()))
}

#[cfg(test)]
mod tests {
    use handeye_io::simulated;

    use super::*;

    fn image(grey: f32) -> Vec<u8> {
        simulated::picture(&handeye::GrayImage::new(32, 16, vec![grey; 512]).unwrap())
    }

    fn names(found: &[Result<CameraImage, String>]) -> Vec<bool> {
        found.iter().map(Result::is_ok).collect()
    }

    #[test]
    fn files_count_once_they_are_whole() {
        let folder = std::env::temp_dir().join(format!("handeye-watch-{}", std::process::id()));
        fs::remove_dir_all(&folder).ok();
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("old.png"), image(10.0)).unwrap();
        let mut watched = Watched::new(folder.clone());
        assert!(watched.look().is_empty() && watched.look().is_empty());

        // half a file, then the whole one
        let whole = image(20.0);
        fs::write(folder.join("a.png"), &whole[..whole.len() / 2]).unwrap();
        assert!(watched.look().is_empty() && watched.look().is_empty());
        fs::write(folder.join("a.png"), &whole).unwrap();
        assert!(watched.look().is_empty());
        assert_eq!(names(&watched.look()), [true]);
        assert!(watched.look().is_empty());

        // another name for it is no other image; written under a name for a while, then renamed, is one
        fs::rename(folder.join("a.png"), folder.join("b.png")).unwrap();
        assert!(watched.look().is_empty() && watched.look().is_empty());
        fs::write(folder.join("c.part"), image(30.0)).unwrap();
        assert!(watched.look().is_empty() && watched.look().is_empty());
        fs::rename(folder.join("c.part"), folder.join("c.PNG")).unwrap();
        assert!(watched.look().is_empty());
        assert_eq!(names(&watched.look()), [true]);

        // what never becomes an image is said once
        fs::write(folder.join("d.png"), b"no image").unwrap();
        let said: Vec<_> = (0..TRIES + 5).flat_map(|_| watched.look()).collect();
        assert_eq!(names(&said), [false]);
        fs::remove_dir_all(folder).unwrap();
    }
}
