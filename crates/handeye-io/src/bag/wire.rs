//! Numbers and text out of the bytes of a message.
//!
//! ROS 1 packs fields one behind the other, little-endian. ROS 2 writes CDR: four bytes tell the byte order, and every
//! number starts at a multiple of its size (OMG, *DDS Interoperability Wire Protocol* 2.5, 2022, section 10.2).

/// How a message was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    Ros1,
    Cdr,
}

/// Where reading stands in a message.
#[derive(Debug, Clone)]
pub(super) struct Wire<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
    big_endian: bool,
}

/// What is wrong with a message.
pub(super) type Broken = String;

/// Bytes before the fields of a message in CDR.
const ENCAPSULATION: usize = 4;

macro_rules! number {
    ($name:ident, $Kind:ty) => {
        pub(super) fn $name(&mut self) -> Result<$Kind, Broken> {
            self.align(size_of::<$Kind>());
            let mut raw = [0; size_of::<$Kind>()];
            raw.copy_from_slice(self.take(size_of::<$Kind>())?);
            Ok(if self.big_endian {
                <$Kind>::from_be_bytes(raw)
            } else {
                <$Kind>::from_le_bytes(raw)
            })
        }
    };
}

impl<'a> Wire<'a> {
    pub(super) fn new(message: &'a [u8], encoding: Encoding) -> Result<Self, Broken> {
        if encoding == Encoding::Ros1 {
            return Ok(Wire { bytes: message, at: 0, encoding, big_endian: false });
        }
        let big_endian = match message {
            [0, 0, _, _, ..] => true,
            [0, 1, _, _, ..] => false,
            [0, kind, _, _, ..] => {
                return Err(format!("is of the CDR kind {kind}, which is not read"));
            }
            _ => return Err("is no CDR message".into()),
        };
        Ok(Wire { bytes: &message[ENCAPSULATION..], at: 0, encoding, big_endian })
    }

    number!(u8, u8);
    number!(u16, u16);
    number!(u32, u32);
    number!(u64, u64);
    number!(i32, i32);
    number!(f64, f64);

    pub(super) fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The next bytes as they are.
    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], Broken> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let Some(end) = end else {
            return Err(format!(
                "ends after {} bytes, {count} more are announced",
                self.bytes.len()
            ));
        };
        let found = &self.bytes[self.at..end];
        self.at = end;
        Ok(found)
    }

    /// All that was not read.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    pub(super) fn text(&mut self) -> Result<String, Broken> {
        let length = self.u32()? as usize;
        let bytes = self.take(length)?;
        let bytes = match self.encoding {
            Encoding::Cdr => bytes.strip_suffix(&[0]).unwrap_or(bytes),
            Encoding::Ros1 => bytes,
        };
        String::from_utf8(bytes.to_vec()).map_err(|_| "holds text that is not UTF-8".into())
    }

    /// A byte array with its length before it.
    pub(super) fn bytes(&mut self) -> Result<&'a [u8], Broken> {
        let length = self.u32()? as usize;
        self.take(length)
    }

    /// A list with its length before it.
    pub(super) fn list<T>(
        &mut self,
        one: impl Fn(&mut Self) -> Result<T, Broken>,
    ) -> Result<Vec<T>, Broken> {
        let count = self.u32()? as usize;
        // every element takes a byte at least: a wrong count asks for no more memory than there are bytes
        if count > self.bytes.len() - self.at {
            return Err(format!("announces a list of {count}, which it is too short for"));
        }
        (0..count).map(|_| one(self)).collect()
    }

    pub(super) fn numbers<const N: usize>(&mut self) -> Result<[f64; N], Broken> {
        let mut all = [0.0; N];
        for one in &mut all {
            *one = self.f64()?;
        }
        Ok(all)
    }

    fn align(&mut self, size: usize) {
        if self.encoding == Encoding::Cdr {
            self.at = self.at.next_multiple_of(size).min(self.bytes.len());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cdr_puts_numbers_at_multiples_of_their_size_and_ros_1_does_not() {
        let mut cdr = vec![0, 1, 0, 0, 7, 0, 0, 0];
        cdr.extend(5u32.to_le_bytes());
        cdr.extend(1.5f64.to_le_bytes());
        let mut wire = Wire::new(&cdr, Encoding::Cdr).unwrap();
        assert_eq!((wire.u8(), wire.u32(), wire.f64()), (Ok(7), Ok(5), Ok(1.5)));
        let mut packed = vec![7];
        packed.extend(5u32.to_le_bytes());
        let mut wire = Wire::new(&packed, Encoding::Ros1).unwrap();
        assert_eq!((wire.u8(), wire.u32()), (Ok(7), Ok(5)));
    }

    #[test]
    fn big_endian_messages_say_so_themselves() {
        let mut wire = Wire::new(&[0, 0, 0, 0, 0, 0, 1, 2], Encoding::Cdr).unwrap();
        assert_eq!(wire.u32(), Ok(258));
    }

    #[test]
    fn text_ends_with_a_zero_in_cdr_alone() {
        let cdr = [0, 1, 0, 0, 3, 0, 0, 0, b'a', b'b', 0];
        assert_eq!(Wire::new(&cdr, Encoding::Cdr).unwrap().text().unwrap(), "ab");
        let ros1 = [2, 0, 0, 0, b'a', b'b'];
        assert_eq!(Wire::new(&ros1, Encoding::Ros1).unwrap().text().unwrap(), "ab");
    }

    #[test]
    fn lengths_beyond_the_message_are_refused_without_memory() {
        let huge = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff];
        assert!(Wire::new(&huge, Encoding::Cdr).unwrap().bytes().is_err());
        assert!(Wire::new(&huge, Encoding::Cdr).unwrap().list(Wire::u8).is_err());
        assert!(Wire::new(&huge[..6], Encoding::Cdr).unwrap().text().is_err());
        assert!(Wire::new(&[0, 7, 0, 0], Encoding::Cdr).is_err());
    }
}
