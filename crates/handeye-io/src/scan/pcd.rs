//! PCD, the Point Cloud Library's format, version 0.7: text, binary, or binary with each field
//! packed by LZF (Marc Lehmann's LibLZF format).

use std::path::Path;

use super::{Points, in_metres};
use crate::{
    error::{Error, Place, malformed},
    files,
    records::{Column, Number, check_count, cut_short, of_lines, of_records},
    units::LengthUnit,
};

#[derive(Default)]
struct Header {
    fields: Vec<String>,
    sizes: Vec<usize>,
    kinds: Vec<String>,
    counts: Vec<usize>,
    width: usize,
    height: usize,
    points: usize,
    data: String,
    end: usize,
}

/// Where a field lies in a record, in bytes and in words.
struct Field {
    column: Column,
    word: usize,
}

pub(super) fn read(path: &Path, unit: LengthUnit) -> Result<Points, Error> {
    let bytes = files::bytes(path)?;
    let wrong = |what: &str| malformed(Place::file(path), what, "export it as PCD 0.7 again");
    let header = header(&bytes).ok_or_else(|| wrong("is not a PCD file with a complete header"))?;
    let fields = ["x", "y", "z"].map(|name| field(&header, name));
    let [Some(x), Some(y), Some(z)] = fields else {
        return Err(wrong("its points have no x, y and z"));
    };
    let body = &bytes[header.end..];
    let fewest = if header.data == "binary" { record_size(&header) } else { 0 };
    check_count(header.points, "points", fewest, body.len(), path)?;
    let point = |p| in_metres(p, unit);
    let xyz = match header.data.as_str() {
        "ascii" => std::str::from_utf8(body).ok().and_then(|text| {
            of_lines(text.lines(), header.points, [x, y, z].map(|f| f.word), point)
        }),
        "binary" => {
            let columns = [x, y, z].map(|f| f.column);
            of_records(body, record_size(&header), header.points, columns, false, point)
        }
        "binary_compressed" => packed(body, &header, [x, y, z].map(|f| f.column), unit),
        other => return Err(wrong(&format!("its DATA is \"{other}\""))),
    };
    let xyz = xyz.ok_or_else(|| cut_short(header.points, "points", path))?;
    let organised = header.height > 1 && header.width.checked_mul(header.height) == Some(xyz.len());
    Ok(Points { xyz, grid: organised.then_some((header.width, header.height)) })
}

fn header(bytes: &[u8]) -> Option<Header> {
    let mut header = Header::default();
    while header.data.is_empty() {
        let length = bytes[header.end..].iter().position(|b| *b == b'\n')?;
        let line = std::str::from_utf8(&bytes[header.end..header.end + length]).ok()?.trim();
        header.end += length + 1;
        let mut words = line.split_whitespace();
        let key = words.next().unwrap_or_default();
        let texts: Vec<String> = words.map(String::from).collect();
        let numbers = || texts.iter().map(|w| w.parse().ok()).collect::<Option<Vec<usize>>>();
        match key {
            "FIELDS" => header.fields = texts,
            "SIZE" => header.sizes = numbers()?,
            "TYPE" => header.kinds = texts,
            "COUNT" => header.counts = numbers()?,
            "WIDTH" => header.width = *numbers()?.first()?,
            "HEIGHT" => header.height = *numbers()?.first()?,
            "POINTS" => header.points = *numbers()?.first()?,
            "DATA" => header.data = texts.first()?.clone(),
            _ => {}
        }
    }
    if header.counts.is_empty() {
        header.counts = vec![1; header.fields.len()];
    }
    let n = header.fields.len();
    let whole = header.sizes.len() == n && header.kinds.len() == n && header.counts.len() == n;
    let sane = header.sizes.iter().chain(&header.counts).all(|s| (1..=4096).contains(s));
    (whole && sane && n <= 256).then_some(header)
}

fn record_size(header: &Header) -> usize {
    header.sizes.iter().zip(&header.counts).map(|(s, c)| s * c).sum()
}

fn field(header: &Header, name: &str) -> Option<Field> {
    let at = header.fields.iter().position(|f| f == name)?;
    let before = header.sizes.iter().zip(&header.counts).take(at);
    let number = match (header.kinds[at].as_str(), header.sizes[at]) {
        ("F", 4) => Number::F32,
        ("F", 8) => Number::F64,
        ("I", 2) => Number::I16,
        ("I", 4) => Number::I32,
        ("U", 2) => Number::U16,
        _ => return None,
    };
    let word = header.counts[..at].iter().sum();
    let offset = before.map(|(s, c)| s * c).sum();
    Some(Field { column: Column { offset, number }, word })
}

/// One byte of LZF makes at most this many.
const MOST_EXPANSION: usize = 264;

/// All x, then all y, and so on, packed together.
fn packed(
    body: &[u8],
    header: &Header,
    columns: [Column; 3],
    unit: LengthUnit,
) -> Option<Vec<[f32; 3]>> {
    let size =
        |at: usize| Some(u32::from_le_bytes(body.get(at..at + 4)?.try_into().ok()?) as usize);
    let (packed, unpacked) = (size(0)?, size(4)?);
    let packed = body.get(8..8usize.checked_add(packed)?)?;
    let needed = header.points.checked_mul(record_size(header))?;
    if unpacked < needed || unpacked > packed.len().checked_mul(MOST_EXPANSION)? {
        return None;
    }
    let bytes = unpack_lzf(packed, unpacked)?;
    let at = |i: usize, c: Column| {
        c.number.read(bytes.get(c.offset * header.points + i * c.number.size()..)?, false)
    };
    let point = |i| {
        let [x, y, z] = columns.map(|c| at(i, c));
        Some(in_metres([x?, y?, z?], unit))
    };
    (0..header.points).map(point).collect()
}

/// LZF: a control byte below 32 copies that many bytes and one more; any other repeats bytes that
/// were written before.
fn unpack_lzf(packed: &[u8], length: usize) -> Option<Vec<u8>> {
    let mut out = Vec::with_capacity(length);
    let mut bytes = packed.iter();
    while let Some(&control) = bytes.next() {
        if control < 32 {
            let run = usize::from(control) + 1;
            out.extend_from_slice(bytes.as_slice().get(..run)?);
            bytes = bytes.as_slice()[run..].iter();
        } else {
            let mut run = usize::from(control >> 5);
            if run == 7 {
                run += usize::from(*bytes.next()?);
            }
            let back = (usize::from(control & 31) << 8) + usize::from(*bytes.next()?) + 1;
            let start = out.len().checked_sub(back)?;
            for i in start..start + run + 2 {
                out.push(out[i]);
            }
        }
        if out.len() > length {
            return None;
        }
    }
    (out.len() == length).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lzf_repeats_what_was_written() {
        // "ab", then 2 + 3 bytes from two back, then "c"
        let packed = [1, b'a', b'b', 3 << 5, 1, 0, b'c'];
        assert_eq!(
            unpack_lzf(&packed, 8).unwrap(),
            b"abababac"[..7].iter().chain(b"c").copied().collect::<Vec<_>>()
        );
    }

    #[test]
    fn damaged_lzf_is_noticed() {
        assert!(unpack_lzf(&[5, 1, 2], 6).is_none());
        assert!(unpack_lzf(&[3 << 5, 200], 5).is_none());
        assert!(unpack_lzf(&[0, 1], 9).is_none());
    }
}
