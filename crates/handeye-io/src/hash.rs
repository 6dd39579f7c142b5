//! A short name for content: FNV-1a of 64 bits (Fowler, Noll, Vo), the same on every machine and in every version.
//! It tells results apart; it is no protection against somebody who forges them.

use std::fmt;

/// Where the sum begins.
const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
/// Its factor.
const PRIME: u64 = 0x0100_0000_01b3;

/// The hash of some bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hash(u64);

impl Hash {
    /// Of these bytes.
    pub fn of(bytes: &[u8]) -> Self {
        Self(BASIS).and(bytes)
    }

    /// Of all bytes so far and these.
    pub fn and(self, bytes: &[u8]) -> Self {
        Self(bytes.iter().fold(self.0, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(PRIME)))
    }
}

impl fmt::Display for Hash {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_the_published_vectors() {
        for (text, hash) in
            [("", "cbf29ce484222325"), ("a", "af63dc4c8601ec8c"), ("foobar", "85944171f73967e8")]
        {
            assert_eq!(Hash::of(text.as_bytes()).to_string(), hash);
        }
        assert_eq!(Hash::of(b"foo").and(b"bar"), Hash::of(b"foobar"));
    }
}
