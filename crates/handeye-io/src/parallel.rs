//! Images and scans worked on by a few threads, each holding one at a time: memory does not grow
//! with their number.

use std::path::Path;

pub use handeye::math::parallel::in_order;

/// Images larger than this (pixels) are worked on by two threads at most: each takes some
/// twenty bytes a pixel.
const LARGE_PICTURE: u64 = 6_000_000;
/// More threads than this only fight for memory.
const MOST_THREADS: usize = 8;

/// A thread for each core.
pub fn all_cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// So many threads, or one for each core where none is asked for.
pub(crate) fn or_all(threads: usize) -> usize {
    if threads == 0 { all_cores() } else { threads }
}

/// How many threads may work on these images at once.
pub fn threads<'a>(pictures: impl IntoIterator<Item = &'a Path>) -> usize {
    let cores = all_cores().min(MOST_THREADS);
    let mut sizes = pictures.into_iter().filter_map(|p| crate::image_size(p).ok());
    let large = sizes.any(|(w, h)| u64::from(w) * u64::from(h) > LARGE_PICTURE);
    if large { cores.min(2) } else { cores }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_that_cannot_be_read_do_not_matter() {
        let threads = threads([Path::new("no such picture.png")]);
        assert!((1..=MOST_THREADS).contains(&threads));
    }
}
