//! Zstandard, unpacked by a library that is Rust alone: frame after frame, as programs write them.

use std::io::{Error, ErrorKind, Read, Result, copy, sink};

use ruzstd::decoding::{
    BlockDecodingStrategy, FrameDecoder,
    errors::{FrameDecoderError, ReadFrameHeaderError},
};

/// The largest window that is unpacked, as Zstandard's own program has it.
const LARGEST_WINDOW: u64 = 1 << 27;

/// What is packed in one frame or several, bytes by bytes.
pub(crate) struct Zstd<R> {
    packed: R,
    decoder: FrameDecoder,
    is_in_frame: bool,
    is_empty: bool,
}

impl<R: Read> Zstd<R> {
    pub fn new(packed: R) -> Self {
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(LARGEST_WINDOW);
        Self { packed, decoder, is_in_frame: false, is_empty: true }
    }

    /// Begins the next frame; false where there is none.
    fn begin(&mut self) -> Result<bool> {
        let mut first = [0];
        loop {
            if self.packed.read(&mut first)? == 0 {
                // a file of nothing is none that was packed
                return if self.is_empty {
                    Err(ErrorKind::UnexpectedEof.into())
                } else {
                    Ok(false)
                };
            }
            match self.decoder.init((&first[..]).chain(&mut self.packed)) {
                Ok(()) => {
                    (self.is_in_frame, self.is_empty) = (true, false);
                    return Ok(true);
                }
                Err(FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::SkipFrame {
                    length,
                    ..
                })) => {
                    self.is_empty = false;
                    copy(&mut (&mut self.packed).take(length.into()), &mut sink())?;
                }
                Err(error) => return Err(Error::other(error)),
            }
        }
    }

    /// Whether the frame that ends here is as it was packed.
    fn end(&mut self) -> Result<()> {
        self.is_in_frame = false;
        let stated = self.decoder.get_checksum_from_data();
        let found = self.decoder.get_calculated_checksum();
        match stated.zip(found) {
            Some((stated, found)) if stated != found => {
                Err(Error::new(ErrorKind::InvalidData, "its checksum differs"))
            }
            _ => Ok(()),
        }
    }
}

impl<R: Read> Read for Zstd<R> {
    fn read(&mut self, into: &mut [u8]) -> Result<usize> {
        while self.is_in_frame || self.begin()? {
            let found = self.decoder.read(into)?;
            if found > 0 || into.is_empty() {
                return Ok(found);
            }
            if self.decoder.is_finished() {
                self.end()?;
            } else {
                self.decoder
                    .decode_blocks(&mut self.packed, BlockDecodingStrategy::UptoBlocks(1))
                    .map_err(Error::other)?;
            }
        }
        Ok(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    fn packed(bytes: &[u8]) -> Vec<u8> {
        compress_to_vec(bytes, CompressionLevel::Fastest)
    }

    fn unpacked(bytes: &[u8]) -> Result<Vec<u8>> {
        let mut all = vec![];
        Zstd::new(bytes).read_to_end(&mut all).map(|_| all)
    }

    fn text(from: u32, to: u32) -> Vec<u8> {
        (from..to).flat_map(|k| format!("{k} ").into_bytes()).collect()
    }

    #[test]
    fn frames_one_after_another_are_one_text() {
        let (one, other) = (text(0, 50_000), text(50_000, 60_000));
        // four bytes that every reader passes over
        let skipped = [0x50, 0x2a, 0x4d, 0x18, 4, 0, 0, 0, 9, 9, 9, 9];
        let all = [packed(&one), skipped.to_vec(), packed(&[]), packed(&other)].concat();
        assert_eq!(unpacked(&all).unwrap(), [one, other].concat());
    }

    #[test]
    fn what_is_cut_or_changed_is_an_error() {
        let whole = packed(&text(0, 50_000));
        for length in [0, 3, 9, whole.len() / 2, whole.len() - 1] {
            assert!(unpacked(&whole[..length]).is_err(), "{length}");
        }
        let mut changed = whole.clone();
        let last = changed.len() - 1;
        changed[last] ^= 1;
        assert!(unpacked(&changed).unwrap_err().to_string().contains("checksum"));
        assert!(unpacked(b"no Zstandard at all").is_err());
    }

    #[test]
    fn what_comes_before_a_cut_is_still_read() {
        let bytes = text(0, 100_000);
        let whole = packed(&bytes);
        let mut found = vec![];
        assert!(Zstd::new(&whole[..whole.len() / 2]).read_to_end(&mut found).is_err());
        assert!(found.len() > 100_000 && bytes.starts_with(&found), "{}", found.len());
    }
}
