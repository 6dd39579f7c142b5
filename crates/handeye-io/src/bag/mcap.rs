//! MCAP, the container of ROS 2 since 2023 (mcap.dev/spec), read from its beginning without its index.

use std::{collections::BTreeMap, fs::File, io::BufReader, path::Path};

use super::{
    Cut, Encoding, LARGEST, Message, Take, bounded,
    pieces::{early, fill, unpacked, up_to},
    plain_kind,
    wire::{Broken, Wire},
};
use crate::error::{Error, unusable};

const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

const SCHEMA: u8 = 3;
const CHANNEL: u8 = 4;
const MESSAGE: u8 = 5;
const CHUNK: u8 = 6;
/// What follows is the index.
const DATA_END: u8 = 15;

/// A topic, and how its messages are written; `None` where that is not ROS.
struct Channel {
    topic: String,
    kind: String,
    encoding: Option<Encoding>,
}

#[derive(Default)]
struct Known {
    kinds: BTreeMap<u16, String>,
    channels: BTreeMap<u16, Channel>,
}

pub(super) fn read(path: &Path, take: &mut Take) -> Result<Cut, Error> {
    let failed = |source| Error::Read { path: path.into(), source };
    let mut file = BufReader::new(File::open(path).map_err(failed)?);
    let mut magic = [0; MAGIC.len()];
    fill(&mut file, &mut magic).map_err(failed)?;
    if magic != MAGIC {
        return Err(unusable(path, "is no MCAP file of version 0"));
    }
    let (mut known, mut unpacked, mut worst) = (Known::default(), 0, None);
    loop {
        let mut head = [0; 9];
        if fill(&mut file, &mut head).map_err(failed)? < head.len() {
            return Ok(worst.or_else(|| Some(early())));
        }
        let (kind, length) = head_of(&head);
        if kind == DATA_END {
            return Ok(worst);
        }
        if length > LARGEST as u64 {
            return Ok(Some(format!("is broken: a record of {length} bytes")));
        }
        let (bytes, cut) = up_to(&mut file, length).map_err(failed)?;
        if kind == CHUNK {
            let (records, what) = match chunk(&bytes, cut) {
                Ok(chunk) => chunk,
                Err(what) => return Ok(Some(what)),
            };
            unpacked += records.len() as u64;
            bounded(unpacked, path)?;
            let what = what.or(known.records(&records, cut, take)?);
            worst = worst.or(what);
        } else if !cut {
            worst = worst.or(known.record(kind, &bytes, take)?);
        }
        if cut {
            return Ok(worst.or_else(|| Some(early())));
        }
    }
}

/// Kind and length of a record.
fn head_of(head: &[u8; 9]) -> (u8, u64) {
    let [kind, length @ ..] = head;
    (*kind, u64::from_le_bytes(*length))
}

/// The records of a chunk, and what is wrong with it. Of one whose checksum is wrong nothing is read.
fn chunk(bytes: &[u8], cut: bool) -> Result<(Vec<u8>, Cut), String> {
    let broken = |what: Broken| if cut { early() } else { format!("is broken: a chunk {what}") };
    let mut wire = Wire::new(bytes, Encoding::Ros1).map_err(broken)?;
    let mut head = || {
        wire.u64()?;
        wire.u64()?;
        Ok((wire.u64()?, wire.u32()?, wire.text()?, wire.u64()?))
    };
    let (size, checksum, compression, length) = head().map_err(broken)?;
    if size > LARGEST as u64 {
        return Err(broken(format!("has {size} bytes")));
    }
    let packed = wire.rest();
    let packed = packed.get(..length as usize).unwrap_or(packed);
    let (records, what) = unpacked(&compression, packed)?;
    if cut {
        return Ok((records, Some(early())));
    }
    if what.is_none() && checksum != 0 && crc32fast::hash(&records) != checksum {
        return Ok((
            vec![],
            Some("is broken: a chunk has a wrong checksum, and is left out".into()),
        ));
    }
    Ok((records, what))
}

impl Known {
    /// Takes the records of a chunk, as far as they go.
    fn records(&mut self, mut bytes: &[u8], cut: bool, take: &mut Take) -> Result<Cut, Error> {
        while let Some((head, rest)) = bytes.split_first_chunk::<9>() {
            let (kind, length) = head_of(head);
            let Some((record, rest)) =
                usize::try_from(length).ok().and_then(|length| rest.split_at_checked(length))
            else {
                break;
            };
            if let Some(what) = self.record(kind, record, take)? {
                return Ok(Some(what));
            }
            bytes = rest;
        }
        let what = "is broken: a chunk ends within a record";
        Ok((!bytes.is_empty() && !cut).then(|| what.into()))
    }

    fn record(&mut self, kind: u8, bytes: &[u8], take: &mut Take) -> Result<Cut, Error> {
        let broken = |what: Broken| Some(format!("is broken: a record {what}"));
        let mut wire = match Wire::new(bytes, Encoding::Ros1) {
            Ok(wire) => wire,
            Err(what) => return Ok(broken(what)),
        };
        let done = match kind {
            SCHEMA => self.schema(&mut wire),
            CHANNEL => self.channel(&mut wire),
            MESSAGE => match wire.u16().and_then(|channel| {
                wire.u32()?;
                let recorded = wire.u64()?;
                wire.u64()?;
                Ok((channel, recorded))
            }) {
                Ok((channel, recorded)) => {
                    let Some(channel) = self.channels.get(&channel) else { return Ok(None) };
                    let Some(encoding) = channel.encoding else { return Ok(None) };
                    let recorded = i64::try_from(recorded).unwrap_or(0);
                    let (topic, kind) = (channel.topic.as_str(), channel.kind.as_str());
                    take(&Message { topic, kind, encoding, recorded, bytes: wire.rest() })?;
                    Ok(())
                }
                Err(what) => Err(what),
            },
            _ => Ok(()),
        };
        Ok(done.err().and_then(broken))
    }

    fn schema(&mut self, wire: &mut Wire) -> Result<(), Broken> {
        let id = wire.u16()?;
        self.kinds.insert(id, plain_kind(&wire.text()?));
        Ok(())
    }

    fn channel(&mut self, wire: &mut Wire) -> Result<(), Broken> {
        let (id, schema, topic) = (wire.u16()?, wire.u16()?, wire.text()?);
        let encoding = match wire.text()?.as_str() {
            "cdr" => Some(Encoding::Cdr),
            "ros1" => Some(Encoding::Ros1),
            _ => None,
        };
        let kind = self.kinds.get(&schema).cloned().unwrap_or_default();
        self.channels.insert(id, Channel { topic, kind, encoding });
        Ok(())
    }
}
