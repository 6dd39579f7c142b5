//! PLY: a header that names elements and their properties, then the elements, in text or binary.
//! Greg Turk, "The PLY Polygon File Format", 1994.

use std::path::Path;

use super::{Column, Number, Points, check_count, cut_short, in_metres, of_lines, of_records};
use crate::{
    error::{Error, Place, malformed},
    files,
    units::LengthUnit,
};

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

enum Property {
    One(String, Number),
    List(Number, Number),
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
    grid: Option<(usize, usize)>,
    end: usize,
}

pub(super) fn read(path: &Path, unit: LengthUnit) -> Result<Points, Error> {
    let bytes = files::bytes(path)?;
    let wrong = |what: &str| malformed(Place::file(path), what, "export it as PLY again");
    let header = header(&bytes).ok_or_else(|| wrong("is not a PLY file with a complete header"))?;
    let body = &bytes[header.end..];
    let at = header.elements.iter().position(|e| e.name == "vertex");
    let at = at.ok_or_else(|| wrong("the PLY file has no element vertex"))?;
    let vertex = &header.elements[at];
    let columns = coordinates(vertex).ok_or_else(|| wrong("its vertices have no x, y and z"))?;
    check_count(vertex.count, fewest_bytes(vertex, header.encoding), body.len(), path)?;
    let xyz = if header.encoding == Encoding::Ascii {
        ascii(body, &header.elements, at, columns, unit)
    } else {
        binary(body, &header, at, columns, unit)
    };
    let xyz = xyz.ok_or_else(|| cut_short(vertex.count, path))?;
    let grid = header.grid.filter(|(w, h)| w.checked_mul(*h) == Some(xyz.len()));
    Ok(Points { xyz, grid })
}

fn header(bytes: &[u8]) -> Option<Header> {
    let mut header = Header { encoding: Encoding::Ascii, elements: vec![], grid: None, end: 0 };
    let (mut sides, mut first) = ((None, None), true);
    loop {
        let length = bytes[header.end..].iter().position(|b| *b == b'\n')?;
        let line = std::str::from_utf8(&bytes[header.end..header.end + length]).ok()?.trim();
        header.end += length + 1;
        if first && line != "ply" {
            return None;
        }
        first = false;
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["end_header"] => break,
            ["format", name, _] => header.encoding = encoding(name)?,
            ["element", name, count] => header.elements.push(Element {
                name: name.into(),
                count: count.parse().ok()?,
                properties: vec![],
            }),
            ["property", "list", count, item, _] => header
                .elements
                .last_mut()?
                .properties
                .push(Property::List(number(count)?, number(item)?)),
            ["property", kind, name] => {
                let property = Property::One(name.into(), number(kind)?);
                header.elements.last_mut()?.properties.push(property);
            }
            ["obj_info" | "comment", "num_cols" | "width", n] => sides.0 = n.parse().ok(),
            ["obj_info" | "comment", "num_rows" | "height", n] => sides.1 = n.parse().ok(),
            _ => {}
        }
    }
    header.grid = sides.0.zip(sides.1);
    Some(header)
}

fn encoding(name: &str) -> Option<Encoding> {
    match name {
        "ascii" => Some(Encoding::Ascii),
        "binary_little_endian" => Some(Encoding::Little),
        "binary_big_endian" => Some(Encoding::Big),
        _ => None,
    }
}

fn number(name: &str) -> Option<Number> {
    Some(match name {
        "char" | "int8" => Number::I8,
        "uchar" | "uint8" => Number::U8,
        "short" | "int16" => Number::I16,
        "ushort" | "uint16" => Number::U16,
        "int" | "int32" => Number::I32,
        "uint" | "uint32" => Number::U32,
        "float" | "float32" => Number::F32,
        "double" | "float64" => Number::F64,
        _ => return None,
    })
}

fn coordinates(vertex: &Element) -> Option<[usize; 3]> {
    let named = |wanted: &str| {
        vertex.properties.iter().position(|p| matches!(p, Property::One(name, _) if name == wanted))
    };
    Some([named("x")?, named("y")?, named("z")?])
}

fn fewest_bytes(element: &Element, encoding: Encoding) -> usize {
    let size = |p: &Property| match p {
        _ if encoding == Encoding::Ascii => 2,
        Property::One(_, n) | Property::List(n, _) => n.size(),
    };
    element.properties.iter().map(size).sum::<usize>().saturating_sub(1)
}

/// Each element stands on a line of its own.
fn ascii(
    body: &[u8],
    elements: &[Element],
    at: usize,
    columns: [usize; 3],
    unit: LengthUnit,
) -> Option<Vec<[f32; 3]>> {
    let before = elements[..at].iter().try_fold(0usize, |n, e| n.checked_add(e.count))?;
    let text = std::str::from_utf8(body).ok()?;
    let lines = text.lines().filter(|l| !l.trim_ascii().is_empty()).skip(before);
    of_lines(lines, elements[at].count, columns, unit)
}

fn binary(
    body: &[u8],
    header: &Header,
    at: usize,
    columns: [usize; 3],
    unit: LengthUnit,
) -> Option<Vec<[f32; 3]>> {
    let big = header.encoding == Encoding::Big;
    let mut offset = 0;
    for element in &header.elements[..at] {
        for _ in 0..element.count {
            let (_, next) = values(body, offset, element, big)?;
            offset = (next > offset).then_some(next)?;
        }
    }
    let vertex = &header.elements[at];
    if let Some((size, columns)) = fixed(vertex, columns) {
        return of_records(body.get(offset..)?, size, vertex.count, columns, big, unit);
    }
    let mut points = Vec::with_capacity(vertex.count);
    for _ in 0..vertex.count {
        let (row, next) = values(body, offset, vertex, big)?;
        points.push(in_metres(columns.map(|c| row[c]), unit));
        offset = next;
    }
    Some(points)
}

/// Size of an element, and where its coordinates are, unless it has lists.
fn fixed(element: &Element, columns: [usize; 3]) -> Option<(usize, [Column; 3])> {
    let (mut size, mut places) = (0, vec![]);
    for property in &element.properties {
        let Property::One(_, number) = property else { return None };
        places.push(Column { offset: size, number: *number });
        size += number.size();
    }
    Some((size, columns.map(|c| places[c])))
}

/// Most properties of a vertex that are kept.
const MOST_PROPERTIES: usize = 64;

/// One element's values (a list counts as its length), and where the next element begins.
fn values(
    body: &[u8],
    mut offset: usize,
    element: &Element,
    big: bool,
) -> Option<([f64; MOST_PROPERTIES], usize)> {
    let mut row = [0.0; MOST_PROPERTIES];
    for (i, property) in element.properties.iter().enumerate() {
        let (Property::One(_, kind) | Property::List(kind, _)) = property;
        *row.get_mut(i)? = kind.read(body.get(offset..)?, big)?;
        offset += kind.size();
        if let Property::List(_, item) = property {
            offset = offset.checked_add((row[i].max(0.0) as usize).checked_mul(item.size())?)?;
        }
    }
    (offset <= body.len()).then_some((row, offset))
}
