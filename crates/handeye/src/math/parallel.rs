//! Work in parts, by a few threads.

use std::sync::{
    Mutex,
    atomic::{AtomicUsize, Ordering},
};

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
}
