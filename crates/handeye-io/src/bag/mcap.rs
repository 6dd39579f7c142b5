//! MCAP, the container of ROS 2 since 2023 (mcap.dev/spec), read from its beginning without its index.

use std::{collections::BTreeMap, fs::File, io::Read, path::Path};

use mcap::{
    records::Record,
    sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions},
};

use super::{Cut, Encoding, LARGEST, Message, Take, bounded, plain_kind};
use crate::error::{Error, unusable};

/// Most bytes asked for at once.
const PIECE: usize = 1 << 20;

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
    unpacked: u64,
}

pub(super) fn read(path: &Path, take: &mut Take) -> Result<Cut, Error> {
    let mut file = File::open(path).map_err(|source| Error::Read { path: path.into(), source })?;
    let options = LinearReaderOptions::default()
        .with_record_length_limit(LARGEST)
        .with_validate_chunk_crcs(true);
    let mut reader = LinearReader::new_with_options(options);
    let mut known = Known::default();
    let mut any = false;
    while let Some(event) = reader.next_event() {
        match event {
            Ok(LinearReadEvent::ReadRequest(wanted)) => {
                let count = file
                    .read(reader.insert(wanted.min(PIECE)))
                    .map_err(|source| Error::Read { path: path.into(), source })?;
                reader.notify_read(count);
            }
            Ok(LinearReadEvent::Record { opcode, data }) => {
                any = true;
                known.unpacked += data.len() as u64;
                bounded(known.unpacked, path)?;
                match mcap::parse_record(opcode, data) {
                    Ok(record) => known.record(&record, take)?,
                    Err(error) => return Ok(Some(format!("is broken: {error}"))),
                }
            }
            Err(error) if !any => return Err(unusable(path, format!("is no MCAP file: {error}"))),
            Err(error) => return Ok(Some(ending(&error))),
        }
    }
    Ok(None)
}

fn ending(error: &mcap::McapError) -> String {
    match error {
        mcap::McapError::UnexpectedEof => {
            "ends too early: the recording was not closed, or not copied whole".into()
        }
        other => format!("is broken: {other}"),
    }
}

impl Known {
    fn record(&mut self, record: &Record, take: &mut Take) -> Result<(), Error> {
        match record {
            Record::Schema { header, .. } => {
                self.kinds.insert(header.id, plain_kind(&header.name));
            }
            Record::Channel(channel) => {
                let kind = self.kinds.get(&channel.schema_id).cloned().unwrap_or_default();
                let encoding = match channel.message_encoding.as_str() {
                    "cdr" => Some(Encoding::Cdr),
                    "ros1" => Some(Encoding::Ros1),
                    _ => None,
                };
                self.channels
                    .insert(channel.id, Channel { topic: channel.topic.clone(), kind, encoding });
            }
            Record::Message { header, data } => {
                let Some(channel) = self.channels.get(&header.channel_id) else { return Ok(()) };
                let Some(encoding) = channel.encoding else { return Ok(()) };
                let recorded = i64::try_from(header.log_time).unwrap_or(0);
                let (topic, kind) = (channel.topic.as_str(), channel.kind.as_str());
                take(&Message { topic, kind, encoding, recorded, bytes: data })?;
            }
            _ => {}
        }
        Ok(())
    }
}
