//! Pictures and scans worked on by a few threads, each holding one at a time: memory does not grow
//! with their number.

use std::{
    path::Path,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

/// Pictures larger than this (pixels) are worked on by two threads at most: each takes some
/// twenty bytes a pixel.
const LARGE_PICTURE: u64 = 6_000_000;
/// More threads than this only fight for memory.
const MOST_THREADS: usize = 8;

/// How many threads may work on these pictures at once.
pub fn threads<'a>(pictures: impl IntoIterator<Item = &'a Path>) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from).min(MOST_THREADS);
    let mut sizes = pictures.into_iter().filter_map(|p| crate::image_size(p).ok());
    let large = sizes.any(|(w, h)| u64::from(w) * u64::from(h) > LARGE_PICTURE);
    if large { cores.min(2) } else { cores }
}

/// `work(0), work(1) ...` up to `count`, in this order, whatever order they were made in.
pub fn in_order<T: Send>(count: usize, threads: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let take = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(slot) = slots.get(k) else { break };
            let result = work(k);
            if let Ok(mut slot) = slot.lock() {
                *slot = Some(result);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(count) {
            scope.spawn(take);
        }
        take();
    });
    slots.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_keep_their_order_with_any_number_of_threads() {
        let squares: Vec<usize> = (0..50).map(|k| k * k).collect();
        for threads in [0, 1, 3, 100] {
            assert_eq!(in_order(50, threads, |k| k * k), squares);
        }
        assert!(in_order(0, 4, |k| k).is_empty());
    }

    #[test]
    fn pictures_that_cannot_be_read_do_not_matter() {
        let threads = threads([Path::new("no such picture.png")]);
        assert!((1..=MOST_THREADS).contains(&threads));
    }
}
