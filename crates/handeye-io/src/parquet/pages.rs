//! The pages of a column: a dictionary perhaps, then values, plain or as indices into it.

use std::io::Read;

use flate2::read::GzDecoder;

use super::{Broken, thrift::Value};
use crate::packed::Zstd;

/// The values of a column.
pub(super) enum Column {
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

/// Where a column lies in the file, and how.
pub(super) struct Chunk {
    kind: Kind,
    codec: i64,
    start: usize,
    length: usize,
    is_optional: bool,
}

/// Physical types, by their numbers.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Bool,
    Int32,
    Int64,
    Float,
    Double,
    Text,
}

/// Largest page, unpacked.
const LARGEST_PAGE: usize = 256 << 20;
/// Most bytes of all texts of a column.
const MOST_TEXT: usize = 256 << 20;

impl Chunk {
    /// From the column's description in the footer.
    pub(super) fn of(about: &Value, is_optional: bool) -> Result<Self, Broken> {
        let kind = match about.number(1)? {
            0 => Kind::Bool,
            1 => Kind::Int32,
            2 => Kind::Int64,
            4 => Kind::Float,
            5 => Kind::Double,
            _ => Kind::Text,
        };
        let data = about.size(9)?;
        let start = about.size(11).map_or(data, |dictionary| dictionary.min(data));
        Ok(Self { kind, codec: about.number(4)?, start, length: about.size(7)?, is_optional })
    }

    /// All its values, one for each of so many rows.
    pub(super) fn read(&self, bytes: &[u8], rows: usize) -> Result<Column, Broken> {
        let end = self.start.checked_add(self.length);
        let mut rest =
            end.and_then(|end| bytes.get(self.start..end)).ok_or("lies beyond the file")?;
        let mut dictionary = Values::none(self.kind);
        let mut all = Values::none(self.kind);
        while all.len() < rows && !rest.is_empty() {
            let (header, length) = Value::parse_with_length(rest)?;
            let size = header.size(3)?;
            let packed = rest[length..].get(..size).ok_or("a page is cut off")?;
            rest = &rest[length + size..];
            match header.number(1)? {
                0 => {
                    let page = self.unpacked(packed, &header)?;
                    self.values(&page, header.field(5)?, &dictionary, &mut all, rows)?;
                }
                2 => {
                    let page = self.unpacked(packed, &header)?;
                    let count = header.field(7)?.size(1)?;
                    dictionary = Values::none(self.kind);
                    dictionary.plain(&page, count)?;
                }
                3 => return Err("is stored in data pages of version 2, which are not read".into()),
                _ => {}
            }
        }
        match all.len() == rows {
            true => Ok(all.column()),
            false => Err(format!("has {} values for {rows} rows", all.len())),
        }
    }

    fn unpacked(&self, packed: &[u8], header: &Value) -> Result<Vec<u8>, Broken> {
        let size = header.size(2)?;
        if size > LARGEST_PAGE {
            return Err(format!("has a page of {size} bytes, more than {LARGEST_PAGE}"));
        }
        let mut page = vec![];
        let limit = size as u64;
        let read = match self.codec {
            0 => packed.take(limit).read_to_end(&mut page),
            2 => GzDecoder::new(packed).take(limit).read_to_end(&mut page),
            6 => Zstd::new(packed).take(limit).read_to_end(&mut page),
            1 if snap::raw::decompress_len(packed).is_ok_and(|found| found == size) => {
                page = snap::raw::Decoder::new()
                    .decompress_vec(packed)
                    .map_err(|e| format!("has a page that cannot be unpacked: {e}"))?;
                Ok(size)
            }
            1 => return Err("has a page that cannot be unpacked".into()),
            other => {
                return Err(format!(
                    "is packed by codec {other}; write it with zstd, snappy or gzip"
                ));
            }
        };
        match read {
            Ok(found) if found == size => Ok(page),
            _ => Err("a page cannot be unpacked".into()),
        }
    }

    /// The values of a page, behind the levels that say which are missing.
    fn values(
        &self,
        page: &[u8],
        header: &Value,
        dictionary: &Values,
        all: &mut Values,
        rows: usize,
    ) -> Result<(), Broken> {
        let count = header.size(1)?;
        if count > rows - all.len() {
            return Err(format!("has more values than {rows} rows"));
        }
        let mut rest = page;
        let mut is_there = vec![true; count];
        if self.is_optional {
            let (levels, behind) = sized(page)?;
            is_there = hybrid(levels, 1, count)?.iter().map(|level| *level == 1).collect();
            rest = behind;
        }
        let present = is_there.iter().filter(|there| **there).count();
        let mut found = Values::none(self.kind);
        match header.number(2)? {
            0 => found.plain(rest, present)?,
            3 if self.kind == Kind::Bool => {
                let values = hybrid(sized(rest)?.0, 1, present)?;
                found.numbers = values.iter().map(|v| f64::from(*v)).collect();
            }
            2 | 8 => {
                let (width, indices) = rest.split_first().ok_or("a page is empty")?;
                found.looked_up(dictionary, &hybrid(indices, u32::from(*width), present)?)?;
            }
            other => return Err(format!("has values of encoding {other}, which is not read")),
        }
        all.append(found, &is_there)
    }
}

/// What stands behind its own length, and what behind that.
fn sized(bytes: &[u8]) -> Result<(&[u8], &[u8]), Broken> {
    let cut = "a page is cut off";
    let (length, rest) = bytes.split_first_chunk::<4>().ok_or(cut)?;
    rest.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or(cut.into())
}

/// Small numbers, as runs of one value or packed bits.
fn hybrid(mut bytes: &[u8], width: u32, count: usize) -> Result<Vec<u32>, Broken> {
    let broken = || Broken::from("a page has broken indices");
    let mut all = vec![];
    if width > 32 {
        return Err(broken());
    }
    while all.len() < count {
        let head = varint(&mut bytes).ok_or_else(broken)?;
        let left = count - all.len();
        if head & 1 == 0 {
            let (value, rest) =
                bytes.split_at_checked(width.div_ceil(8) as usize).ok_or_else(broken)?;
            let value = value.iter().rev().fold(0u64, |v, b| v << 8 | u64::from(*b)) as u32;
            let run = usize::try_from(head >> 1).map_err(|_| broken())?;
            if run == 0 {
                return Err(broken());
            }
            all.resize(all.len() + run.min(left), value);
            bytes = rest;
        } else {
            let groups = usize::try_from(head >> 1).map_err(|_| broken())?;
            let length = groups.checked_mul(width as usize).ok_or_else(broken)?;
            let (packed, rest) = bytes.split_at(length.min(bytes.len()));
            let values = groups.saturating_mul(8).min(left);
            if values == 0 || packed.len() * 8 < values * width as usize {
                return Err(broken());
            }
            all.extend((0..values).map(|k| bits(packed, k * width as usize, width)));
            bytes = rest;
        }
    }
    Ok(all)
}

fn varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..35).step_by(7) {
        let (byte, rest) = bytes.split_first()?;
        *bytes = rest;
        value |= u64::from(byte & 0x7f) << shift;
        if *byte < 0x80 {
            return Some(value);
        }
    }
    None
}

/// So many bits from a place on, the lowest first.
fn bits(bytes: &[u8], start: usize, width: u32) -> u32 {
    let bit = |k: u32| {
        let at = start + k as usize;
        u32::from(bytes[at / 8] >> (at % 8) & 1) << k
    };
    (0..width).map(bit).sum()
}

/// Values while a column is put together: numbers, or texts.
struct Values {
    kind: Kind,
    numbers: Vec<f64>,
    texts: Vec<String>,
    text_bytes: usize,
}

impl Values {
    fn none(kind: Kind) -> Self {
        Self { kind, numbers: vec![], texts: vec![], text_bytes: 0 }
    }

    fn len(&self) -> usize {
        self.numbers.len() + self.texts.len()
    }

    fn push_text(&mut self, text: &str) -> Result<(), Broken> {
        self.text_bytes += text.len();
        self.texts.push(text.into());
        match self.text_bytes <= MOST_TEXT {
            true => Ok(()),
            false => Err(format!("holds more than {MOST_TEXT} bytes of text")),
        }
    }

    /// Values one behind the other.
    fn plain(&mut self, bytes: &[u8], count: usize) -> Result<(), Broken> {
        let cut = || Broken::from("a page is cut off");
        let chunk = |size: usize| {
            let length = count.checked_mul(size).ok_or_else(cut)?;
            bytes.get(..length).map(|b| b.chunks_exact(size)).ok_or_else(cut)
        };
        fn of<const N: usize>(b: &[u8]) -> [u8; N] {
            std::array::from_fn(|k| b[k])
        }
        match self.kind {
            Kind::Double => self.numbers.extend(chunk(8)?.map(|b| f64::from_le_bytes(of(b)))),
            Kind::Int64 => self.numbers.extend(chunk(8)?.map(|b| i64::from_le_bytes(of(b)) as f64)),
            Kind::Float => {
                self.numbers.extend(chunk(4)?.map(|b| f64::from(f32::from_le_bytes(of(b)))))
            }
            Kind::Int32 => {
                self.numbers.extend(chunk(4)?.map(|b| f64::from(i32::from_le_bytes(of(b)))))
            }
            Kind::Bool if bytes.len() * 8 >= count => {
                self.numbers.extend((0..count).map(|k| f64::from(bits(bytes, k, 1))));
            }
            Kind::Bool => return Err(cut()),
            Kind::Text => {
                let mut rest = bytes;
                for _ in 0..count {
                    let (text, behind) = sized(rest)?;
                    self.push_text(&String::from_utf8_lossy(text))?;
                    rest = behind;
                }
            }
        }
        Ok(())
    }

    fn looked_up(&mut self, dictionary: &Values, indices: &[u32]) -> Result<(), Broken> {
        let beyond = "an index lies beyond the dictionary";
        for k in indices.iter().map(|k| *k as usize) {
            match self.kind {
                Kind::Text => self.push_text(dictionary.texts.get(k).ok_or(beyond)?)?,
                _ => self.numbers.push(*dictionary.numbers.get(k).ok_or(beyond)?),
            }
        }
        Ok(())
    }

    /// Adds values, with a gap wherever one is missing.
    fn append(&mut self, found: Values, is_there: &[bool]) -> Result<(), Broken> {
        let (mut numbers, mut texts) = (found.numbers.into_iter(), found.texts.into_iter());
        for there in is_there {
            match self.kind {
                Kind::Text if *there => self.push_text(&texts.next().unwrap_or_default())?,
                Kind::Text => self.push_text("")?,
                _ if *there => self.numbers.push(numbers.next().unwrap_or(f64::NAN)),
                _ => self.numbers.push(f64::NAN),
            }
        }
        Ok(())
    }

    fn column(self) -> Column {
        match self.kind {
            Kind::Text => Column::Texts(self.texts),
            _ => Column::Numbers(self.numbers),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_and_packed_bits_follow_one_another() {
        // three times 5, then 0 to 7 in three bits each
        let bytes = [0x06, 0x05, 0x03, 0b1000_1000, 0b1100_0110, 0b1111_1010];
        assert_eq!(hybrid(&bytes, 3, 11), Ok(vec![5, 5, 5, 0, 1, 2, 3, 4, 5, 6, 7]));
    }

    #[test]
    fn broken_runs_end() {
        for bytes in [&[][..], &[0x00, 0x01], &[0x01], &[0x03], &[0xff; 9]] {
            assert!(hybrid(bytes, 3, 11).is_err(), "{bytes:?}");
        }
        assert!(hybrid(&[0xfe, 0xff, 0xff, 0xff, 0x0f, 0x01], 1, 4).is_ok_and(|v| v == [1; 4]));
    }
}
