//! NumPy's `.npy` and `.npz`: a header in Python's notation, then the numbers as they lie in memory.
//!
//! NumPy enhancement proposal 1; PKWARE APPNOTE.TXT for the zip around an `.npz`.

use std::{io::Read, path::Path};

use flate2::read::DeflateDecoder;

use crate::{
    error::{Error, Place, malformed},
    files,
};

/// An array of numbers, its elements not yet converted.
#[derive(Debug, Clone)]
pub(crate) struct Array {
    /// Lengths along its axes.
    pub(crate) shape: Vec<usize>,
    kind: u8,
    size: usize,
    big_endian: bool,
    fortran: bool,
    data: Vec<u8>,
}

impl Array {
    /// Reads an `.npy` file.
    pub(crate) fn read(path: &Path) -> Result<Array, Error> {
        Self::parse(files::bytes(path)?, &Place::file(path))
    }

    /// Number of elements.
    pub(crate) fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Elements are whole numbers.
    pub(crate) fn is_integer(&self) -> bool {
        self.kind != b'f'
    }

    /// All elements, last axis fastest.
    pub(crate) fn values(&self) -> Vec<f64> {
        (0..self.len()).map(|i| self.element(self.stored_at(i))).collect()
    }

    /// Where element `i` (last axis fastest) lies in the file.
    fn stored_at(&self, mut i: usize) -> usize {
        if !self.fortran {
            return i;
        }
        let (mut at, mut stride) = (0, self.len());
        for n in self.shape.iter().rev() {
            stride /= n;
            at += (i % n) * stride;
            i /= n;
        }
        at
    }

    fn element(&self, i: usize) -> f64 {
        let mut bytes = [0u8; 8];
        let raw = &self.data[i * self.size..(i + 1) * self.size];
        bytes[..self.size].copy_from_slice(raw);
        if self.big_endian {
            bytes[..self.size].reverse();
        }
        let [b0, b1, b2, b3, ..] = bytes;
        match (self.kind, self.size) {
            (b'f', 8) => f64::from_le_bytes(bytes),
            (b'f', _) => f32::from_le_bytes([b0, b1, b2, b3]).into(),
            (b'i', 1) => i8::from_le_bytes([b0]).into(),
            (b'i', 2) => i16::from_le_bytes([b0, b1]).into(),
            (b'i', 4) => i32::from_le_bytes([b0, b1, b2, b3]).into(),
            (b'i', _) => i64::from_le_bytes(bytes) as f64,
            _ => u64::from_le_bytes(bytes) as f64,
        }
    }

    fn parse(bytes: Vec<u8>, place: &Place) -> Result<Array, Error> {
        let wrong = |what: &str| malformed(place.clone(), what, "save it again with numpy.save");
        let header = header(&bytes).ok_or_else(|| wrong("is not an .npy array"))?;
        let descr = quoted(header.text, "'descr':").ok_or_else(|| wrong("has no 'descr'"))?;
        let (kind, size, big_endian) = element_type(descr)
            .ok_or_else(|| wrong(&format!("holds elements of type {descr}, not plain numbers")))?;
        let shape = shape(header.text).ok_or_else(|| wrong("has no readable 'shape'"))?;
        let needed = shape.iter().try_fold(size, |n, axis| n.checked_mul(*axis));
        let present = bytes.len() - header.end;
        if needed.is_none_or(|n| n > present) {
            return Err(wrong(&format!(
                "is cut short: shape {shape:?}, but {present} bytes of data"
            )));
        }
        let fortran = header.text.contains("'fortran_order': True");
        let data = bytes[header.end..].to_vec();
        Ok(Array { shape, kind, size, big_endian, fortran, data })
    }
}

struct Header<'a> {
    text: &'a str,
    end: usize,
}

fn header(bytes: &[u8]) -> Option<Header<'_>> {
    let major = *bytes.strip_prefix(b"\x93NUMPY")?.first()?;
    let (start, length): (usize, usize) = match major {
        1 => (10, u16::from_le_bytes(bytes.get(8..10)?.try_into().ok()?) as usize),
        _ => (12, u32::from_le_bytes(bytes.get(8..12)?.try_into().ok()?) as usize),
    };
    let end = start.checked_add(length)?;
    Some(Header { text: std::str::from_utf8(bytes.get(start..end)?).ok()?, end })
}

fn quoted<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let rest = text.split_once(key)?.1.trim_start().strip_prefix('\'')?;
    Some(rest.split_once('\'')?.0)
}

fn element_type(descr: &str) -> Option<(u8, usize, bool)> {
    let bytes = descr.as_bytes();
    let (order, kind) = (*bytes.first()?, *bytes.get(1)?);
    let size = descr.get(2..)?.parse().ok()?;
    let known = match kind {
        b'f' => matches!(size, 4 | 8),
        b'i' | b'u' => matches!(size, 1 | 2 | 4 | 8),
        b'b' => size == 1,
        _ => false,
    };
    known.then_some((kind, size, order == b'>'))
}

fn shape(text: &str) -> Option<Vec<usize>> {
    let inside = text.split_once("'shape':")?.1.split_once('(')?.1.split_once(')')?.0;
    let axes = inside.split(',').map(str::trim).filter(|s| !s.is_empty());
    let shape: Vec<usize> = axes.map(|s| s.parse().ok()).collect::<Option<_>>()?;
    (shape.len() <= 8).then_some(shape)
}

/// Largest array that is unpacked.
const LARGEST_ARRAY: u64 = 2 << 30;

/// The named arrays of an `.npz` file, each unpacked when asked for.
pub(crate) struct Archive {
    place: Place,
    bytes: Vec<u8>,
    entries: Vec<Entry>,
}

struct Entry {
    name: String,
    method: u16,
    packed: usize,
    unpacked: u64,
    offset: usize,
}

impl Archive {
    /// Reads an `.npz` file's list of arrays.
    pub(crate) fn read(path: &Path) -> Result<Archive, Error> {
        let (place, bytes) = (Place::file(path), files::bytes(path)?);
        let entries = central_directory(&bytes).ok_or_else(|| {
            malformed(
                place.clone(),
                "is not a complete .npz archive",
                "save it again with numpy.savez",
            )
        })?;
        Ok(Archive { place, bytes, entries })
    }

    /// Names of the arrays.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|e| e.name.as_str())
    }

    /// One array; `None` if there is none of that name.
    pub(crate) fn array(&self, name: &str) -> Option<Result<Array, Error>> {
        let entry = self.entries.iter().find(|e| e.name == name)?;
        let place = Place { field: Some(name.into()), ..self.place.clone() };
        Some(self.unpack(entry, &place).and_then(|bytes| Array::parse(bytes, &place)))
    }

    fn unpack(&self, entry: &Entry, place: &Place) -> Result<Vec<u8>, Error> {
        let cut = || malformed(place.clone(), "is cut short or damaged", "copy the file again");
        if entry.unpacked > LARGEST_ARRAY {
            return Err(Error::TooLarge {
                place: place.clone(),
                what: "the array's size in bytes".into(),
                found: entry.unpacked,
                limit: LARGEST_ARRAY,
                advice: "is it the right array?".into(),
            });
        }
        let packed = packed(&self.bytes, entry).ok_or_else(cut)?;
        match entry.method {
            0 => Ok(packed.to_vec()),
            8 => {
                let mut bytes = Vec::new();
                let mut unpacking = DeflateDecoder::new(packed).take(entry.unpacked);
                unpacking.read_to_end(&mut bytes).map_err(|_| cut())?;
                Ok(bytes)
            }
            other => Err(malformed(
                place.clone(),
                format!("is packed by method {other}"),
                "save it with numpy.savez or numpy.savez_compressed",
            )),
        }
    }
}

fn u16_at(bytes: &[u8], at: usize) -> Option<usize> {
    Some(u16::from_le_bytes(bytes.get(at..at.checked_add(2)?)?.try_into().ok()?).into())
}

fn u32_at(bytes: &[u8], at: usize) -> Option<usize> {
    Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?) as usize)
}

/// The entries listed at the end of a zip file.
fn central_directory(bytes: &[u8]) -> Option<Vec<Entry>> {
    let from = bytes.len().saturating_sub(65_557);
    let end = from + bytes[from..].windows(4).rposition(|w| w == b"PK\x05\x06")?;
    let (count, mut at) = (u16_at(bytes, end + 10)?, u32_at(bytes, end + 16)?);
    let mut entries = Vec::new();
    for _ in 0..count {
        if bytes.get(at..at.checked_add(4)?)? != b"PK\x01\x02" {
            return None;
        }
        let name_length = u16_at(bytes, at + 28)?;
        let name = std::str::from_utf8(bytes.get(at + 46..at + 46 + name_length)?).ok()?;
        entries.push(Entry {
            name: name.strip_suffix(".npy").unwrap_or(name).into(),
            method: u16_at(bytes, at + 10)? as u16,
            packed: u32_at(bytes, at + 20)?,
            unpacked: u32_at(bytes, at + 24)? as u64,
            offset: u32_at(bytes, at + 42)?,
        });
        at += 46 + name_length + u16_at(bytes, at + 30)? + u16_at(bytes, at + 32)?;
    }
    Some(entries)
}

/// An entry's bytes, behind its local header.
fn packed<'a>(bytes: &'a [u8], entry: &Entry) -> Option<&'a [u8]> {
    let at = entry.offset;
    let start = at + 30 + u16_at(bytes, at + 26)? + u16_at(bytes, at + 28)?;
    bytes.get(start..start.checked_add(entry.packed)?)
}

/// An `.npy` file of 64-bit numbers.
pub(crate) fn encode(shape: &[usize], values: &[f64]) -> Vec<u8> {
    let axes: String = shape.iter().map(|n| format!("{n}, ")).collect();
    let mut text =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", axes.trim_end());
    while !(10 + text.len() + 1).is_multiple_of(64) {
        text.push(' ');
    }
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_header(header: &str, data: &[u8]) -> Result<Array, Error> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        Array::parse(bytes, &Place::file(Path::new("a.npy")))
    }

    #[test]
    fn an_array_comes_back_as_it_was_written() {
        let bytes = encode(&[2, 3], &[1.0, 2.0, 3.0, 4.0, 5.0, f64::MIN_POSITIVE]);
        assert_eq!((bytes.len() - 48) % 64, 0);
        let array = Array::parse(bytes, &Place::default()).unwrap();
        assert_eq!(array.shape, [2, 3]);
        assert_eq!(array.values(), [1.0, 2.0, 3.0, 4.0, 5.0, f64::MIN_POSITIVE]);
    }

    #[test]
    fn fortran_order_and_big_endian_numbers_are_put_right() {
        let header = "{'descr': '>i2', 'fortran_order': True, 'shape': (2, 3), }";
        let data: Vec<u8> = [1i16, 4, 2, 5, 3, -6].iter().flat_map(|v| v.to_be_bytes()).collect();
        assert_eq!(with_header(header, &data).unwrap().values(), [1.0, 2.0, 3.0, 4.0, 5.0, -6.0]);
    }

    #[test]
    fn a_header_that_promises_more_than_the_file_holds_is_refused() {
        for shape in ["(4000000000, 4000000000)", "(3,)"] {
            let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
            let message = with_header(&header, &[0; 16]).unwrap_err().to_string();
            assert!(message.contains("is cut short"), "{message}");
        }
    }

    #[test]
    fn pickled_objects_are_refused() {
        let header = "{'descr': '|O', 'fortran_order': False, 'shape': (1,), }";
        let message = with_header(header, &[0; 16]).unwrap_err().to_string();
        assert!(message.contains("type |O, not plain numbers"), "{message}");
    }
}
