//! ROS bags: recordings of topics, message by message.
//!
//! A bag is read from its beginning, never by its index: one that was not closed is read as far as it goes.

mod extract;
mod mcap;
mod messages;
mod moments;
mod pictures;
mod robot;
mod ros1;
mod sqlite;
mod survey;
mod topics;
mod wire;
mod writing;

use std::{
    io::Read,
    path::{Path, PathBuf},
};

use crate::{
    error::{Error, unusable},
    files,
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

/// The ends of the names of bags.
const ENDINGS: [&str; 3] = ["bag", "mcap", "db3"];

/// Whether it is a bag, or a folder of one that was split.
pub fn is_bag(path: &Path) -> bool {
    if path.is_file() {
        return ENDINGS.contains(&files::extension(path).as_str());
    }
    !parts(path).is_empty()
}

/// Reads every message of a bag, in the order of its files; returns what is broken.
pub(crate) fn read(path: &Path, take: &mut Take) -> Result<Vec<String>, Error> {
    let all = if path.is_dir() { parts(path) } else { vec![path.to_path_buf()] };
    if all.is_empty() {
        return Err(unusable(path, "holds no bag: no file that ends in .mcap, .db3 or .bag"));
    }
    let mut broken = vec![];
    for file in &all {
        let mut unpacked = 0;
        let mut take = |message: &Message| {
            if message.encoding != Encoding::Cdr || !message.bytes.starts_with(&ZSTANDARD) {
                return take(message);
            }
            let bytes = unpack(message.bytes, file)?;
            unpacked += bytes.len() as u64;
            bounded(unpacked, file)?;
            take(&Message { bytes: &bytes, ..*message })
        };
        if let Some(what) = read_file(file, &mut take)? {
            broken.push(format!("{}: {what}", file.display()));
        }
    }
    Ok(broken)
}

fn read_file(file: &Path, take: &mut Take) -> Result<Cut, Error> {
    match files::extension(file).as_str() {
        "mcap" => mcap::read(file, take),
        "db3" => sqlite::read(file, take),
        "bag" => ros1::read(file, take),
        "zstd" | "zst" => {
            Err(unusable(file, "is packed as a whole: unpack it first, with zstd -d"))
        }
        _ => Err(unusable(file, "is no bag: its name ends in neither .mcap nor .db3 nor .bag")),
    }
}

/// The files of a bag that is a folder.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return vec![] };
    let mut all: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    all.retain(|p| p.is_file() && ENDINGS.contains(&files::extension(p).as_str()));
    all.sort_by(|a, b| files::natural(&a.to_string_lossy(), &b.to_string_lossy()));
    all
}

/// A type's name without what ROS 2 puts in its middle.
fn plain_kind(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}

/// Unpacks a message that was packed alone.
fn unpack(packed: &[u8], file: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = vec![];
    zstd::Decoder::new(packed)
        .and_then(|decoder| decoder.take(LARGEST as u64).read_to_end(&mut bytes))
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

/// Pictures of one colour are packed to a hundredth; more than this many times its size no bag unpacks to.
const MOST_UNPACKED: u64 = 500;
