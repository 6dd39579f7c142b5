//! Images and scans worked on by a few threads, each holding one at a time: memory does not grow
//! with their number.

use std::{
    path::Path,
    sync::{Mutex, PoisonError},
};

pub use handeye::math::parallel::in_order;

/// Images larger than this (pixels) are worked on by two threads at most: each takes some
/// twenty bytes a pixel.
const LARGE_PICTURE: u64 = 6_000_000;
/// More threads than this only fight for memory.
const MOST_THREADS: usize = 8;

/// As [`in_order`]; `progress` is told how many of how many are done, one more each time whichever thread tells it.
pub fn in_order_told<T: Send>(
    count: usize,
    threads: usize,
    progress: &(dyn Fn(usize, usize) + Sync),
    work: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let done = Mutex::new(0);
    in_order(count, threads, |k| {
        let result = work(k);
        // told while nobody else counts, or a smaller number could come after a larger one
        let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
        *done += 1;
        progress(*done, count);
        result
    })
}

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
    fn progress_never_goes_back() {
        let told = Mutex::new(vec![]);
        let tell = |done, all| {
            // time for another thread to count on
            std::thread::yield_now();
            told.lock().unwrap().push((done, all));
        };
        let made = in_order_told(400, 4, &tell, |k| k);
        assert_eq!(made, (0..400).collect::<Vec<_>>());
        assert_eq!(told.into_inner().unwrap(), (1..=400).map(|k| (k, 400)).collect::<Vec<_>>());
    }

    #[test]
    fn pictures_that_cannot_be_read_do_not_matter() {
        let threads = threads([Path::new("no such picture.png")]);
        assert!((1..=MOST_THREADS).contains(&threads));
    }
}
