//! PLY: a header that names elements and their properties, then the elements, in text or binary.
//! Greg Turk, "The PLY Polygon File Format", 1994.

use std::{fs::File, io::Read, path::Path};

use crate::{
    error::{Error, Place, malformed},
    files,
    mesh::Fans,
    records::{Column, Number, check_count, cut_short, of_lines, of_records},
};

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

enum Property {
    One(String, Number),
    /// A count of the first type, then as many items of the second.
    List(String, Number, Number),
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

/// A file, its header understood and its elements not yet read.
pub(crate) struct Ply {
    bytes: Vec<u8>,
    header: Header,
}

/// Longest header of a file that is asked whether it has faces, bytes.
const LONGEST_HEADER: u64 = 1 << 16;
/// Usual names of a face's list of vertices.
const LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Whether the header promises faces.
pub(crate) fn has_faces(path: &Path) -> bool {
    let mut start = Vec::new();
    let read = File::open(path).and_then(|f| f.take(LONGEST_HEADER).read_to_end(&mut start));
    let header = read.ok().and_then(|_| header(&start));
    header.is_some_and(|h| h.elements.iter().any(|e| e.name == "face" && e.count > 0))
}

impl Ply {
    /// Reads a file's bytes and its header.
    pub(crate) fn read(path: &Path) -> Result<Ply, Error> {
        let bytes = files::bytes(path)?;
        let header = header(&bytes)
            .ok_or_else(|| wrong("is not a PLY file with a complete header", path))?;
        Ok(Ply { bytes, header })
    }

    /// Width and height of a camera's grid of so many points, where the header says them.
    pub(crate) fn grid(&self, count: usize) -> Option<(usize, usize)> {
        self.header.grid.filter(|(w, h)| w.checked_mul(*h) == Some(count))
    }

    /// All vertices, each as `point` makes it of the three coordinates.
    pub(crate) fn vertices(
        &self,
        point: impl Fn([f64; 3]) -> [f32; 3],
        path: &Path,
    ) -> Result<Vec<[f32; 3]>, Error> {
        let (at, vertex) = self.element("vertex", path)?;
        let columns =
            coordinates(vertex).ok_or_else(|| wrong("its vertices have no x, y and z", path))?;
        let fewest = fewest_bytes(vertex, self.header.encoding);
        check_count(vertex.count, "points", fewest, self.body().len(), path)?;
        let found = match self.header.encoding {
            Encoding::Ascii => {
                self.lines(at).and_then(|lines| of_lines(lines, vertex.count, columns, point))
            }
            _ => self.binary_vertices(at, columns, point),
        };
        found.ok_or_else(|| cut_short(vertex.count, "points", path))
    }

    /// All faces, those of more than three corners cut into triangles that share the first corner.
    pub(crate) fn triangles(&self, path: &Path) -> Result<Vec<[u32; 3]>, Error> {
        let (at, face) = self.element("face", path)?;
        let is_list = |p: &Property| matches!(p, Property::List(n, ..) if LISTS.contains(&&**n));
        let list = face.properties.iter().position(is_list);
        let list = list.ok_or_else(|| wrong("its faces have no list vertex_indices", path))?;
        let fewest = fewest_bytes(face, self.header.encoding);
        check_count(face.count, "faces", fewest, self.body().len(), path)?;
        let mut fans = Fans::default();
        let read = match self.header.encoding {
            Encoding::Ascii => self.ascii_faces(at, list, &mut fans),
            _ => self.binary_faces(at, list, &mut fans),
        };
        check_count(fans.triangles.len(), "triangles", 0, 0, path)?;
        read.ok_or_else(|| cut_short(face.count, "faces", path))?;
        Ok(fans.triangles)
    }

    fn body(&self) -> &[u8] {
        &self.bytes[self.header.end..]
    }

    fn element(&self, name: &str, path: &Path) -> Result<(usize, &Element), Error> {
        let at = self.header.elements.iter().position(|e| e.name == name);
        let at = at.ok_or_else(|| wrong(&format!("the PLY file has no element {name}"), path))?;
        Ok((at, &self.header.elements[at]))
    }

    /// The lines of text from an element's first on: each element stands on a line of its own.
    fn lines(&self, at: usize) -> Option<impl Iterator<Item = &str>> {
        let mut before = self.header.elements[..at].iter();
        let before = before.try_fold(0usize, |n, e| n.checked_add(e.count))?;
        let text = std::str::from_utf8(self.body()).ok()?;
        Some(text.lines().filter(|l| !l.trim_ascii().is_empty()).skip(before))
    }

    /// Where an element begins in the binary body.
    fn start(&self, at: usize) -> Option<usize> {
        let big = self.header.encoding == Encoding::Big;
        let mut offset = 0usize;
        for element in &self.header.elements[..at] {
            if let Some((size, _)) = fixed(element) {
                offset = offset.checked_add(size.checked_mul(element.count)?)?;
                continue;
            }
            for _ in 0..element.count {
                let (_, next) = values(self.body(), offset, element, big)?;
                offset = (next > offset).then_some(next)?;
            }
        }
        (offset <= self.body().len()).then_some(offset)
    }

    fn binary_vertices(
        &self,
        at: usize,
        columns: [usize; 3],
        point: impl Fn([f64; 3]) -> [f32; 3],
    ) -> Option<Vec<[f32; 3]>> {
        let big = self.header.encoding == Encoding::Big;
        let (body, vertex) = (self.body(), &self.header.elements[at]);
        let mut offset = self.start(at)?;
        if let Some((size, places)) = fixed(vertex) {
            let columns = columns.map(|c| places[c]);
            return of_records(body.get(offset..)?, size, vertex.count, columns, big, point);
        }
        let mut points = Vec::with_capacity(vertex.count);
        for _ in 0..vertex.count {
            let (row, next) = values(body, offset, vertex, big)?;
            points.push(point(columns.map(|c| row[c])));
            offset = next;
        }
        Some(points)
    }

    fn binary_faces(&self, at: usize, list: usize, fans: &mut Fans) -> Option<()> {
        let big = self.header.encoding == Encoding::Big;
        let (mut rest, face) = (self.body().get(self.start(at)?..)?, &self.header.elements[at]);
        for _ in 0..face.count {
            fans.begin();
            for (k, property) in face.properties.iter().enumerate() {
                match property {
                    Property::One(_, number) => rest = rest.get(number.size()..)?,
                    Property::List(_, count, item) => {
                        let items = length(count.read(rest, big)?)?;
                        rest = rest.get(count.size()..)?;
                        let (these, after) =
                            rest.split_at_checked(items.checked_mul(item.size())?)?;
                        if k == list {
                            for raw in these.chunks_exact(item.size()) {
                                fans.corner(vertex(item.read(raw, big)?))?;
                            }
                        }
                        rest = after;
                    }
                }
            }
        }
        Some(())
    }

    fn ascii_faces(&self, at: usize, list: usize, fans: &mut Fans) -> Option<()> {
        let face = &self.header.elements[at];
        let mut lines = self.lines(at)?;
        for _ in 0..face.count {
            let mut words = lines.next()?.split_ascii_whitespace();
            fans.begin();
            for (k, property) in face.properties.iter().enumerate() {
                let first = words.next()?;
                if let Property::List(..) = property {
                    for _ in 0..length(first.parse().ok()?)? {
                        let word = words.next()?;
                        if k == list {
                            fans.corner(vertex(word.parse().ok()?))?;
                        }
                    }
                }
            }
        }
        Some(())
    }
}

/// The number of a vertex. What is none becomes the largest one, which no vertex has.
fn vertex(number: f64) -> u32 {
    let is_number = number >= 0.0 && number < f64::from(u32::MAX) && number.fract() == 0.0;
    if is_number { number as u32 } else { u32::MAX }
}

/// A list's length, which some files write as a floating-point number.
fn length(number: f64) -> Option<usize> {
    (number >= 0.0 && number.fract() == 0.0).then_some(number as usize)
}

fn wrong(what: &str, path: &Path) -> Error {
    malformed(Place::file(path), what, "export it as PLY again")
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
            ["property", "list", count, item, name] => {
                let property = Property::List(name.into(), number(count)?, number(item)?);
                header.elements.last_mut()?.properties.push(property);
            }
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
        Property::One(_, n) | Property::List(_, n, _) => n.size(),
    };
    element.properties.iter().map(size).sum::<usize>().saturating_sub(1)
}

/// Size of an element, and where its numbers are, unless it has lists.
fn fixed(element: &Element) -> Option<(usize, Vec<Column>)> {
    let (mut size, mut places) = (0, vec![]);
    for property in &element.properties {
        let Property::One(_, number) = property else { return None };
        places.push(Column { offset: size, number: *number });
        size += number.size();
    }
    Some((size, places))
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
        let (Property::One(_, kind) | Property::List(_, kind, _)) = property;
        *row.get_mut(i)? = kind.read(body.get(offset..)?, big)?;
        offset += kind.size();
        if let Property::List(_, _, item) = property {
            offset = offset.checked_add((row[i].max(0.0) as usize).checked_mul(item.size())?)?;
        }
    }
    (offset <= body.len()).then_some((row, offset))
}
