//! ROS bags: recordings of topics, message by message.
//!
//! A bag is read from its beginning, never by its index: one that was not closed is read as far as it goes.

mod extract;
mod frames;
mod mcap;
mod messages;
mod moments;
mod pictures;
mod pieces;
mod robot;
mod ros1;
#[cfg(feature = "sqlite")]
mod sqlite;
mod survey;
mod topics;
mod wire;
mod writing;

use std::{
    fs::File,
    io::{BufReader, BufWriter, Read, Write},
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
};

use handeye::model::names::natural;

use crate::{
    error::{Error, unusable},
    files,
    packed::Zstd,
};
pub use extract::{BagOptions, Extracted, Motion, extract};
pub use robot::RobotSource;
pub use survey::{BagContents, Stamps, Topic, contents};
pub(crate) use wire::Encoding;

/// A message as it stands in a bag.
pub(crate) struct Message<'a> {
    pub(crate) topic: &'a str,
    /// Its type, as `sensor_msgs/Image`.
    pub(crate) kind: &'a str,
    pub(crate) encoding: Encoding,
    /// When it was recorded, ns.
    pub(crate) recorded: i64,
    pub(crate) bytes: &'a [u8],
}

/// What is done with each message.
pub(crate) type Take<'t> = dyn FnMut(&Message) -> Result<(), Error> + 't;

/// Why a file ends too early; `None` where it is whole.
pub(crate) type Cut = Option<String>;

/// Largest message and largest chunk that are read.
const LARGEST: usize = 1 << 30;

/// How a message begins that was packed alone.
const ZSTANDARD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

/// What to do with a bag where something else is needed.
pub(crate) const ADVICE: &str =
    "is a ROS bag: `handeye bag` shows what it holds, and makes a folder of captures out of it";

/// The ends of the names of bags.
const ENDINGS: [&str; 3] = ["bag", "mcap", "db3"];
/// What follows them where the recorder packed whole files.
const PACKED: &str = "zstd";
/// And where it did not close a bag of ROS 1.
const ACTIVE: &str = "active";

/// Whether it is a bag, or a folder of one that was split.
pub fn is_bag(path: &Path) -> bool {
    if path.is_file() {
        return has_ending(path);
    }
    !parts(path).is_empty()
}

/// Is called again and again while a bag is read; where it unwinds, the work ends and leaves nothing behind.
pub type Tick<'t> = dyn Fn() + 't;

/// Reads every message of a bag, in the order of its files; returns what is broken.
pub(crate) fn read(path: &Path, tick: &Tick, take: &mut Take) -> Result<Vec<String>, Error> {
    std::fs::metadata(path).map_err(|source| Error::Read { path: path.into(), source })?;
    let all = if path.is_dir() { parts(path) } else { vec![path.to_path_buf()] };
    if path.file_name().is_some_and(|name| name == "metadata.yaml") {
        return Err(unusable(path, "tells of a bag, and is none: give its folder"));
    }
    if all.is_empty() {
        return Err(unusable(path, "holds no bag: no file that ends in .mcap, .db3 or .bag"));
    }
    let mut broken = vec![];
    for file in &all {
        let mut unpacked = 0;
        let mut take = |message: &Message| {
            tick();
            if message.encoding != Encoding::Cdr || !message.bytes.starts_with(&ZSTANDARD) {
                return take(message);
            }
            let bytes = unpack(message.bytes, file)?;
            unpacked += bytes.len() as u64;
            bounded(unpacked, file)?;
            take(&Message { bytes: &bytes, ..*message })
        };
        if let Some(what) = read_file(file, tick, &mut take)? {
            broken.push(format!("{}: {what}", file.display()));
        }
    }
    Ok(broken)
}

fn read_file(file: &Path, tick: &Tick, take: &mut Take) -> Result<Cut, Error> {
    match files::extension(file).as_str() {
        "mcap" => mcap::read(file, take),
        #[cfg(feature = "sqlite")]
        "db3" => sqlite::read(file, take),
        #[cfg(not(feature = "sqlite"))]
        "db3" => Err(crate::error::not_built_in(file, "SQLite", "sqlite")),
        "bag" | ACTIVE => ros1::read(file, take),
        PACKED => {
            let (unpacked, cut) = Unpacked::new(file, tick)?;
            let found = read_file(&unpacked.file, tick, take);
            found.map(|more| cut.or(more)).map_err(|error| match error {
                Error::Unusable { what, .. } => unusable(file, what),
                other => other,
            })
        }
        _ => Err(unusable(file, "is no bag: its name ends in neither .mcap nor .db3 nor .bag")),
    }
}

/// The files of a bag that is a folder.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return vec![] };
    let mut all: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    all.retain(|p| p.is_file() && has_ending(p));
    all.sort_by(|a, b| natural(&a.to_string_lossy(), &b.to_string_lossy()));
    all
}

fn has_ending(path: &Path) -> bool {
    let ending = match files::extension(path).as_str() {
        PACKED | ACTIVE => files::extension(&path.with_extension("")),
        other => other.to_owned(),
    };
    ENDINGS.contains(&ending.as_str())
}

/// A file that was packed as a whole, unpacked among the temporary ones.
struct Unpacked {
    file: PathBuf,
}

impl Unpacked {
    /// As far as it can be unpacked, and why no farther.
    fn new(packed: &Path, tick: &Tick) -> Result<(Self, Cut), Error> {
        let source = |source| Error::Read { path: packed.into(), source };
        let name = packed.file_stem().unwrap_or_default().to_string_lossy();
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let (process, count) = (files::process(), COUNT.fetch_add(1, Ordering::Relaxed));
        let file = files::temporary_folder().join(format!("handeye-{process}-{count}-{name}"));
        let this = Self { file };
        let target = |source| Error::Write { path: this.file.clone(), source };
        let mut into = BufWriter::new(File::create(&this.file).map_err(target)?);
        let mut from = Zstd::new(BufReader::new(File::open(packed).map_err(source)?));
        let (mut piece, mut unpacked) = (vec![0; 1 << 20], 0);
        let cut = loop {
            tick();
            match from.read(&mut piece) {
                Ok(0) => break None,
                Ok(count) => {
                    into.write_all(&piece[..count]).map_err(target)?;
                    unpacked += count as u64;
                    bounded(unpacked, packed)?;
                }
                Err(error) => break Some(format!("cannot be unpacked to its end: {error}")),
            }
        };
        into.flush().map_err(target)?;
        Ok((this, cut))
    }
}

impl Drop for Unpacked {
    fn drop(&mut self) {
        std::fs::remove_file(&self.file).ok();
    }
}

/// A type's name without what ROS 2 puts in its middle.
fn plain_kind(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}

/// Unpacks a message that was packed alone.
fn unpack(packed: &[u8], file: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = vec![];
    Zstd::new(packed)
        .take(LARGEST as u64)
        .read_to_end(&mut bytes)
        .map_err(|error| unusable(file, format!("a message cannot be unpacked: {error}")))?;
    Ok(bytes)
}

/// Says no where a few bytes unpack to far too many.
fn bounded(unpacked: u64, file: &Path) -> Result<(), Error> {
    let size = std::fs::metadata(file).map_or(0, |m| m.len());
    if unpacked > size.saturating_mul(MOST_UNPACKED) + LARGEST as u64 {
        return Err(unusable(
            file,
            format!("unpacks to more than {MOST_UNPACKED} times its size: it is broken"),
        ));
    }
    Ok(())
}

/// Images of one colour are packed to a hundredth; more than this many times its size no bag unpacks to.
const MOST_UNPACKED: u64 = 500;
