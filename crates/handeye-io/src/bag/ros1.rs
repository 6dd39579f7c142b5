//! Bags of ROS 1, version 2.0 (wiki.ros.org/Bags/Format/2.0), read from the beginning: their index, which a recording
//! that was not closed does not have, is not needed.

use std::{
    collections::BTreeMap,
    fs::File,
    io::{BufReader, Read},
    path::Path,
};

use super::{
    Cut, Encoding, LARGEST, Message, Take, bounded,
    pieces::{early, fill, unpacked, up_to},
};
use crate::error::{Error, unusable};

const MAGIC: &[u8; 13] = b"#ROSBAG V2.0\n";

const MESSAGE: u8 = 2;
const CHUNK: u8 = 5;
const CONNECTION: u8 = 7;

/// Topic and type by the number of the connection.
type Connections = BTreeMap<u32, (String, String)>;

/// What was read, what is wrong with the bytes, or why none could be read.
type Found<T> = std::io::Result<Result<T, String>>;

/// One record: what its header says, and its data.
struct Record {
    fields: BTreeMap<String, Vec<u8>>,
    data: Vec<u8>,
    /// Whether the bytes ended before it did.
    cut: bool,
}

pub(super) fn read(path: &Path, take: &mut Take) -> Result<Cut, Error> {
    let failed = |source| Error::Read { path: path.into(), source };
    let mut file = BufReader::new(File::open(path).map_err(failed)?);
    let mut magic = [0; MAGIC.len()];
    let found = fill(&mut file, &mut magic).map_err(failed)?;
    if magic[..found].starts_with(b"#ROSBAG V1") {
        return Err(unusable(path, "is a bag of version 1: bring it up to date with `rosbag fix`"));
    }
    if &magic != MAGIC {
        return Err(unusable(path, "is no bag of ROS 1"));
    }
    let (mut connections, mut bytes_unpacked) = (Connections::new(), 0);
    loop {
        let record = match record(&mut file).map_err(failed)? {
            Ok(Some(record)) => record,
            Ok(None) => return Ok(None),
            Err(what) => return Ok(Some(what)),
        };
        let what = match record.op() {
            Some(CHUNK) => chunk(&record, &mut connections, &mut bytes_unpacked, path, take)?,
            _ if record.cut => None,
            _ => one(&record, &mut connections, take)?,
        };
        if what.is_some() || record.cut {
            return Ok(Some(what.unwrap_or_else(early)));
        }
    }
}

/// The next record; `None` at the end, and what is wrong where it is none.
fn record(from: &mut impl Read) -> Found<Option<Record>> {
    let (header, cut) = match block(from)? {
        Ok(Some(block)) => block,
        Ok(None) => return Ok(Ok(None)),
        Err(what) => return Ok(Err(what)),
    };
    let Some(fields) = fields(&header).filter(|_| !cut) else {
        return Ok(Err(if cut {
            early()
        } else {
            "is broken: a record's header cannot be read".into()
        }));
    };
    Ok(match block(from)? {
        Ok(Some((data, cut))) => Ok(Some(Record { fields, data, cut })),
        Ok(None) => Err(early()),
        Err(what) => Err(what),
    })
}

/// Bytes with their number before them, and whether they end too early.
fn block(from: &mut impl Read) -> Found<Option<(Vec<u8>, bool)>> {
    let mut length = [0; 4];
    match fill(from, &mut length)? {
        0 => return Ok(Ok(None)),
        4 => {}
        _ => return Ok(Err(early())),
    }
    let length = u32::from_le_bytes(length) as usize;
    if length > LARGEST {
        return Ok(Err(format!("is broken: a record of {length} bytes")));
    }
    Ok(Ok(Some(up_to(from, length as u64)?)))
}

fn fields(mut header: &[u8]) -> Option<BTreeMap<String, Vec<u8>>> {
    let mut all = BTreeMap::new();
    while !header.is_empty() {
        let (length, rest) = header.split_at_checked(4)?;
        let length = u32::from_le_bytes(length.try_into().ok()?) as usize;
        let (field, rest) = rest.split_at_checked(length)?;
        let equals = field.iter().position(|b| *b == b'=')?;
        let name = std::str::from_utf8(&field[..equals]).ok()?;
        all.insert(name.to_owned(), field[equals + 1..].to_vec());
        header = rest;
    }
    Some(all)
}

impl Record {
    fn op(&self) -> Option<u8> {
        self.fields.get("op")?.first().copied()
    }

    fn number(&self, name: &str) -> Option<u32> {
        Some(u32::from_le_bytes(self.fields.get(name)?.as_slice().try_into().ok()?))
    }

    fn text(&self, name: &str) -> Option<String> {
        text(&self.fields, name)
    }

    /// Seconds and nanoseconds, as ns.
    fn time(&self) -> i64 {
        let Some([a, b, c, d, e, f, g, h]) = self.fields.get("time").map(Vec::as_slice) else {
            return 0;
        };
        let (seconds, rest) =
            (u32::from_le_bytes([*a, *b, *c, *d]), u32::from_le_bytes([*e, *f, *g, *h]));
        i64::from(seconds) * 1_000_000_000 + i64::from(rest)
    }
}

fn text(fields: &BTreeMap<String, Vec<u8>>, name: &str) -> Option<String> {
    Some(String::from_utf8_lossy(fields.get(name)?).into_owned())
}

/// Takes a message, or remembers a connection.
fn one(record: &Record, connections: &mut Connections, take: &mut Take) -> Result<Cut, Error> {
    match record.op() {
        Some(CONNECTION) => {
            let kind = fields(&record.data).and_then(|about| text(&about, "type"));
            let (Some(number), Some(topic), Some(kind)) =
                (record.number("conn"), record.text("topic"), kind)
            else {
                return Ok(Some("is broken: a connection without topic or type".into()));
            };
            connections.insert(number, (topic, kind));
        }
        Some(MESSAGE) => {
            let connection = record.number("conn").and_then(|n| connections.get(&n));
            let Some((topic, kind)) = connection else {
                return Ok(Some(
                    "is broken: a message of a connection that was not announced".into(),
                ));
            };
            let (encoding, recorded) = (Encoding::Ros1, record.time());
            take(&Message { topic, kind, encoding, recorded, bytes: &record.data })?;
        }
        _ => {}
    }
    Ok(None)
}

/// Takes the records of a chunk, as far as it can be unpacked.
fn chunk(
    chunk: &Record,
    connections: &mut Connections,
    bytes_unpacked: &mut u64,
    path: &Path,
    take: &mut Take,
) -> Result<Cut, Error> {
    let compression = chunk.text("compression").unwrap_or_default();
    let (bytes, what) = match unpacked(&compression, &chunk.data) {
        Ok(found) => found,
        Err(what) => return Ok(Some(what)),
    };
    let mut cut = if chunk.cut { Some(early()) } else { what };
    *bytes_unpacked += bytes.len() as u64;
    bounded(*bytes_unpacked, path)?;
    let mut rest = bytes.as_slice();
    loop {
        match record(&mut rest) {
            Ok(Ok(Some(record))) if !record.cut => {
                if let Some(what) = one(&record, connections, take)? {
                    return Ok(Some(what));
                }
            }
            Ok(Ok(None)) => return Ok(cut),
            Ok(Ok(Some(_))) => return Ok(cut.take().or_else(|| Some(early()))),
            Ok(Err(what)) => return Ok(cut.take().or(Some(what))),
            Err(source) => return Err(Error::Read { path: path.into(), source }),
        }
    }
}
