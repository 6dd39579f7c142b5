//! A folder in which another program saves images: any vendor's viewer. It is asked again and again, for network drives
//! tell nobody of new files. A file counts once it no longer changes and can be read; one that was seen under another name
//! is not a new one. Where scans come with the images, the scan lies beside its image, with the same name and an ending of
//! its own.

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

use super::{
    outlet::{CameraImage, Outlet, Wanted},
    scan,
};

/// How often the folder is asked.
const POLL: Duration = Duration::from_millis(300);
/// A file that cannot be read is given up after so many times: by then it would have been written.
const TRIES: usize = 20;
/// Likewise an image whose scan does not come: cameras write scans for long.
const TRIES_WITH_SCAN: usize = 200;
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
    /// Scans beside images, as they were at the last look.
    scans: BTreeMap<PathBuf, FileState>,
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
            for found in watched.look(&outlet.wanted()) {
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
        let (waiting, contents, scans) = (BTreeMap::new(), HashSet::new(), BTreeMap::new());
        Self { folder, done, waiting, contents, scans }
    }

    /// New images, in the order of their time; or why a file is none.
    fn look(&mut self, wanted: &Wanted) -> Vec<Result<CameraImage, String>> {
        let mut all = files(&self.folder);
        let most = if wanted.scans.is_some() { TRIES_WITH_SCAN } else { TRIES };
        if wanted.scans.is_some() {
            all.retain(|(path, _)| !is_depth(path));
        }
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
            match read(&path, state.0).and_then(|found| self.with_scan(&path, found, wanted)) {
                Ok((image, sum)) => {
                    self.waiting.remove(&path);
                    self.done.insert(path, state);
                    if self.contents.insert(sum) {
                        found.push(Ok(image));
                    }
                }
                Err(why) if tries + 1 >= most => {
                    self.waiting.remove(&path);
                    self.done.insert(path, state);
                    found.push(Err(why));
                }
                Err(_) => _ = self.waiting.insert(path, (state, tries + 1)),
            }
        }
        found
    }

    /// With the scan that lies beside it, where one is to come.
    fn with_scan(
        &mut self,
        path: &Path,
        (image, sum): (CameraImage, u64),
        wanted: &Wanted,
    ) -> Result<(CameraImage, u64), String> {
        let Some(settings) = &wanted.scans else { return Ok((image, sum)) };
        let beside = scan::beside(path).ok_or_else(|| {
            format!(
                "no scan lies beside {}: save it there under the same name, such as {}",
                path.display(),
                path.with_extension("ply").display()
            )
        })?;
        let state = fs::metadata(&beside)
            .map(|m| (m.len(), m.modified().ok()))
            .map_err(|e| e.to_string())?;
        if self.scans.insert(beside.clone(), state) != Some(state) {
            return Err(format!("{} is still being written", beside.display()));
        }
        Ok((CameraImage { scan: Some(scan::read(&beside, wanted, settings)?), ..image }, sum))
    }
}

/// Whether an image is the depth that belongs to another one of the same name.
fn is_depth(path: &Path) -> bool {
    let is_tiff = ending(path).is_some_and(|ending| ending.starts_with("tif"));
    is_tiff && ["png", "jpg", "jpeg", "bmp"].iter().any(|e| path.with_extension(e).exists())
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
    use handeye::TargetModel;
    use handeye_io::{ScanSettings, simulated, units::LengthUnit};

    use super::*;

    fn image(grey: f32) -> Vec<u8> {
        simulated::picture(&handeye::GrayImage::new(32, 16, vec![grey; 512]).unwrap())
    }

    fn wanted(scans: Option<ScanSettings>) -> Wanted {
        let target = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        Wanted { target, intrinsics: None, scans }
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
        assert!(watched.look(&wanted(None)).is_empty() && watched.look(&wanted(None)).is_empty());

        // half a file, then the whole one
        let whole = image(20.0);
        fs::write(folder.join("a.png"), &whole[..whole.len() / 2]).unwrap();
        assert!(watched.look(&wanted(None)).is_empty() && watched.look(&wanted(None)).is_empty());
        fs::write(folder.join("a.png"), &whole).unwrap();
        assert!(watched.look(&wanted(None)).is_empty());
        assert_eq!(names(&watched.look(&wanted(None))), [true]);
        assert!(watched.look(&wanted(None)).is_empty());

        // another name for it is no other image; written under a name for a while, then renamed, is one
        fs::rename(folder.join("a.png"), folder.join("b.png")).unwrap();
        assert!(watched.look(&wanted(None)).is_empty() && watched.look(&wanted(None)).is_empty());
        fs::write(folder.join("c.part"), image(30.0)).unwrap();
        assert!(watched.look(&wanted(None)).is_empty() && watched.look(&wanted(None)).is_empty());
        fs::rename(folder.join("c.part"), folder.join("c.PNG")).unwrap();
        assert!(watched.look(&wanted(None)).is_empty());
        assert_eq!(names(&watched.look(&wanted(None))), [true]);

        // what never becomes an image is said once
        fs::write(folder.join("d.png"), b"no image").unwrap();
        let said: Vec<_> = (0..TRIES + 5).flat_map(|_| watched.look(&wanted(None))).collect();
        assert_eq!(names(&said), [false]);
        fs::remove_dir_all(folder).unwrap();
    }
    /// Points of a board 0.6 m away, in a file.
    fn cloud(unit: f64) -> String {
        let head = "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
        let points =
            (0..9).map(|k| format!("{} {} {}\n", 0.01 * f64::from(k) / unit, 0.0, 0.6 / unit));
        points.fold(head.to_owned(), |text, line| text + &line)
    }

    #[test]
    fn an_image_waits_for_the_scan_that_lies_beside_it() {
        let folder = std::env::temp_dir().join(format!("handeye-watch-3d-{}", std::process::id()));
        fs::remove_dir_all(&folder).ok();
        fs::create_dir_all(&folder).unwrap();
        let settings =
            ScanSettings { length_unit: Some(LengthUnit::Millimetre), depth_scale: None };
        let mut watched = Watched::new(folder.clone());
        let mut look = |times| {
            (0..times).flat_map(|_| watched.look(&wanted(Some(settings)))).collect::<Vec<_>>()
        };
        fs::write(folder.join("a.png"), image(10.0)).unwrap();
        assert!(look(5).is_empty());
        let whole = cloud(1e-3);
        fs::write(folder.join("a.ply"), &whole[..150]).unwrap();
        assert!(look(5).is_empty());
        fs::write(folder.join("a.ply"), &whole).unwrap();
        let found = look(3);
        let scan = found[0].as_ref().unwrap().scan.clone().unwrap();
        assert_eq!((found.len(), &scan.0[..], &scan.1[..]), (1, "ply", whole.as_bytes()));

        // metres where millimetres are said; no scan at all
        fs::write(folder.join("b.png"), image(20.0)).unwrap();
        fs::write(folder.join("b.ply"), cloud(1.0)).unwrap();
        let why = look(TRIES_WITH_SCAN + 5).remove(0).unwrap_err();
        assert!(why.contains("b.ply") && why.contains("unit"), "{why}");
        fs::write(folder.join("c.png"), image(30.0)).unwrap();
        let why = look(TRIES_WITH_SCAN + 5).remove(0).unwrap_err();
        assert!(why.contains("no scan lies beside"), "{why}");
        fs::remove_dir_all(folder).unwrap();
    }
}
