//! Thrift's compact protocol, as far as Parquet's headers need it: any structure, as a tree.

use super::Broken;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// Whole numbers and truth values.
    Number(i64),
    Bytes(Vec<u8>),
    List(Vec<Value>),
    /// Fields by their numbers.
    Struct(Vec<(i16, Value)>),
    /// What no header of Parquet needs.
    Other,
}

/// Structures nest so far at most.
const DEEPEST: usize = 16;

impl Value {
    /// The structure that bytes begin with.
    pub(super) fn parse(bytes: &[u8]) -> Result<Value, Broken> {
        Self::parse_with_length(bytes).map(|(value, _)| value)
    }

    /// The same, and how many bytes it takes.
    pub(super) fn parse_with_length(bytes: &[u8]) -> Result<(Value, usize), Broken> {
        let mut reader = Reader { bytes, at: 0 };
        let value = reader.structure(0).ok_or("its headers are broken")?;
        Ok((value, reader.at))
    }

    pub(super) fn field(&self, wanted: i16) -> Result<&Value, Broken> {
        let fields = match self {
            Value::Struct(fields) => &fields[..],
            _ => &[],
        };
        let found = fields.iter().find(|(number, _)| *number == wanted).map(|(_, value)| value);
        found.ok_or(format!("a header has no field {wanted}"))
    }

    pub(super) fn number(&self, wanted: i16) -> Result<i64, Broken> {
        match self.field(wanted)? {
            Value::Number(x) => Ok(*x),
            _ => Err(format!("field {wanted} of a header is no number")),
        }
    }

    /// The same, of what counts or points.
    pub(super) fn size(&self, wanted: i16) -> Result<usize, Broken> {
        usize::try_from(self.number(wanted)?)
            .map_err(|_| format!("field {wanted} of a header is negative"))
    }

    pub(super) fn list(&self, wanted: i16) -> Result<&[Value], Broken> {
        match self.field(wanted)? {
            Value::List(items) => Ok(items),
            _ => Err(format!("field {wanted} of a header is no list")),
        }
    }

    pub(super) fn text(&self, wanted: i16) -> Result<String, Broken> {
        self.field(wanted)?.as_text()
    }

    pub(super) fn as_text(&self) -> Result<String, Broken> {
        match self {
            Value::Bytes(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
            _ => Err("a name in a header is no text".into()),
        }
    }
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn byte(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.at)?;
        self.at += 1;
        Some(byte)
    }

    fn unsigned(&mut self) -> Option<u64> {
        let mut value = 0u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(value);
            }
        }
        None
    }

    /// A signed number: zigzag.
    fn signed(&mut self) -> Option<i64> {
        let n = self.unsigned()?;
        Some((n >> 1) as i64 ^ -((n & 1) as i64))
    }

    fn structure(&mut self, depth: usize) -> Option<Value> {
        let (mut fields, mut number) = (vec![], 0i16);
        if depth > DEEPEST {
            return None;
        }
        loop {
            let head = self.byte()?;
            if head == 0 {
                return Some(Value::Struct(fields));
            }
            number = match head >> 4 {
                0 => i16::try_from(self.signed()?).ok()?,
                step => number.checked_add(i16::from(step))?,
            };
            let value = match head & 15 {
                1 => Value::Number(1), // a truth value stands in its head
                2 => Value::Number(0),
                kind => self.value(kind, depth)?,
            };
            fields.push((number, value));
        }
    }

    fn value(&mut self, kind: u8, depth: usize) -> Option<Value> {
        match kind {
            1..=3 => self.byte().map(|b| Value::Number(i64::from(b))),
            4..=6 => self.signed().map(Value::Number),
            7 => self.skip(8),
            8 => {
                let length = usize::try_from(self.unsigned()?).ok()?;
                let end = self.at.checked_add(length)?;
                let bytes = self.bytes.get(self.at..end)?.to_vec();
                self.at = end;
                Some(Value::Bytes(bytes))
            }
            9 | 10 => self.list(depth),
            12 => self.structure(depth + 1),
            _ => None,
        }
    }

    fn skip(&mut self, count: usize) -> Option<Value> {
        self.at = self.at.checked_add(count).filter(|at| *at <= self.bytes.len())?;
        Some(Value::Other)
    }

    fn list(&mut self, depth: usize) -> Option<Value> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => usize::try_from(self.unsigned()?).ok()?,
            few => usize::from(few),
        };
        // every element takes a byte or more
        if count > self.bytes.len() - self.at || depth > DEEPEST {
            return None;
        }
        (0..count).map(|_| self.value(head & 15, depth + 1)).collect::<Option<_>>().map(Value::List)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn structures_are_read_by_their_fields() {
        // 1: 150, 2: [b"ab"], 4: true, then a byte that is not its own
        let bytes = [0x15, 0xac, 0x02, 0x19, 0x18, 0x02, b'a', b'b', 0x21, 0x00, 0x77];
        let (value, length) = Value::parse_with_length(&bytes).unwrap();
        assert_eq!((value.number(1), length), (Ok(150), 10));
        assert_eq!(value.list(2).unwrap()[0].as_text(), Ok("ab".into()));
        assert_eq!(value.number(4), Ok(1));
    }

    #[test]
    fn sizes_that_no_bytes_back_are_refused() {
        for bytes in
            [&[0x18, 0xff, 0xff, 0xff, 0x7f][..], &[0x19, 0xf5, 0xff, 0xff, 0x7f], &[0x1c; 40]]
        {
            assert!(Value::parse(bytes).is_err());
        }
    }

    #[test]
    fn what_nests_without_end_is_refused() {
        for kind in [0x19, 0x1c] {
            assert!(Value::parse(&vec![kind; 1 << 20]).is_err());
        }
    }
}
