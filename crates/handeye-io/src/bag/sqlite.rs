//! Bags of ROS 2 in SQLite, the container before MCAP: tables `topics` and `messages`.

use std::path::Path;

use rusqlite::{Connection, OpenFlags, Row, types::ValueRef};

use super::{Cut, Encoding, Message, Take, plain_kind};
use crate::error::{Error, unusable};

/// Views would have anything computed; only tables are read.
const TABLES: &str =
    "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('topics', 'messages')";
const MESSAGES: &str = "SELECT topics.name, topics.type, topics.serialization_format, messages.timestamp, \
                        messages.data FROM messages JOIN topics ON messages.topic_id = topics.id ORDER BY messages.id";

pub(super) fn read(path: &Path, take: &mut Take) -> Result<Cut, Error> {
    std::fs::metadata(path).map_err(|source| Error::Read { path: path.into(), source })?;
    let wrong = |error: rusqlite::Error| unusable(path, format!("is no bag in SQLite: {error}"));
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let database = Connection::open_with_flags(path, flags).map_err(wrong)?;
    // SQLite refuses a file that is shorter than its header says, but where its schema could be repaired
    database.pragma_update(None, "writable_schema", true).map_err(wrong)?;
    let tables: i64 = database.query_row(TABLES, [], |row| row.get(0)).map_err(wrong)?;
    if tables != 2 {
        return Err(unusable(path, "is no bag: it has no tables `topics` and `messages`"));
    }
    let mut statement = database.prepare(MESSAGES).map_err(wrong)?;
    let mut rows = statement.query([]).map_err(wrong)?;
    loop {
        match rows.next() {
            Ok(Some(row)) => {
                if let Some(what) = message(row, take)? {
                    return Ok(Some(what));
                }
            }
            Ok(None) => return Ok(None),
            Err(error) => {
                let what = "is broken, or was not copied whole";
                return Ok(Some(format!("{what}: messages are read as far as it goes ({error})")));
            }
        }
    }
}

fn message(row: &Row, take: &mut Take) -> Result<Cut, Error> {
    let text = |k: usize| row.get::<_, String>(k).map_err(|e| e.to_string());
    let found = (|| {
        Ok((
            text(0)?,
            plain_kind(&text(1)?),
            text(2)?,
            row.get::<_, i64>(3).map_err(|e| e.to_string())?,
        ))
    })();
    let (topic, kind, format, recorded) = match found {
        Ok(found) => found,
        Err::<_, String>(what) => return Ok(Some(format!("is broken: {what}"))),
    };
    let Ok(ValueRef::Blob(bytes)) = row.get_ref(4) else {
        return Ok(Some("is broken: a message without bytes".into()));
    };
    if format != "cdr" {
        return Ok(None);
    }
    take(&Message { topic: &topic, kind: &kind, encoding: Encoding::Cdr, recorded, bytes })?;
    Ok(None)
}
