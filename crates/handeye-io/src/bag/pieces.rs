//! Bytes of files that may end too early, and packed ones.

use std::io::{Read, Result};

use lz4_flex::frame::FrameDecoder;

use super::{Cut, LARGEST};
use crate::packed::Zstd;

/// What is said of a file that was cut.
pub(super) fn early() -> String {
    "ends too early: the recording was not closed, or not copied whole".into()
}

/// Reads as much as there is.
pub(super) fn fill(from: &mut impl Read, into: &mut [u8]) -> Result<usize> {
    let mut found = 0;
    while found < into.len() {
        match from.read(&mut into[found..])? {
            0 => break,
            n => found += n,
        }
    }
    Ok(found)
}

/// The next bytes, and whether there are fewer of them.
pub(super) fn up_to(from: &mut impl Read, length: u64) -> Result<(Vec<u8>, bool)> {
    let mut bytes = vec![];
    from.take(length).read_to_end(&mut bytes)?;
    let cut = (bytes.len() as u64) < length;
    Ok((bytes, cut))
}

/// The bytes of a chunk, and what was wrong where they are not all of them.
pub(super) fn unpacked(
    compression: &str,
    packed: &[u8],
) -> std::result::Result<(Vec<u8>, Cut), String> {
    let mut bytes = vec![];
    let most = LARGEST as u64;
    let all = match compression {
        "none" | "" => {
            bytes.extend(packed);
            Ok(bytes.len())
        }
        "bz2" => bzip2::read::BzDecoder::new(packed).take(most).read_to_end(&mut bytes),
        "lz4" => FrameDecoder::new(packed).take(most).read_to_end(&mut bytes),
        "zstd" => Zstd::new(packed).take(most).read_to_end(&mut bytes),
        other => return Err(format!("has a chunk compressed by \"{other}\", which is not read")),
    };
    let what = |error| format!("is broken: a chunk cannot be unpacked ({error})");
    Ok((bytes, all.err().map(what)))
}
