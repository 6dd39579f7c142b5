//! Processor time and memory of this process.

use std::{fs, hint::black_box};

/// A call is repeated until so much time went by, ns, or so often.
const LONG_ENOUGH: f64 = 4e8;
const MOST_CALLS: usize = 2000;

/// Processor time of a call, on this thread alone, ms; the kernel counts in steps of up to 4 ms.
pub fn milliseconds<T>(call: impl Fn() -> T) -> f64 {
    let (start, mut calls) = (processor_ns(), 0);
    while calls == 0 || (processor_ns() - start < LONG_ENOUGH && calls < MOST_CALLS) {
        black_box(call());
        calls += 1;
    }
    (processor_ns() - start) / calls as f64 / 1e6
}

/// Processor time of the main thread, ns.
fn processor_ns() -> f64 {
    let text = fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|t| t.parse().ok()).unwrap_or(0.0)
}

/// The most memory that the process ever held, and what it holds now, bytes.
pub fn resident() -> (f64, f64) {
    let text = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let bytes = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name));
        let number = line.and_then(|line| line.split_whitespace().nth(1));
        1024.0 * number.and_then(|n| n.parse().ok()).unwrap_or(f64::NAN)
    };
    (bytes("VmHWM:"), bytes("VmRSS:"))
}
