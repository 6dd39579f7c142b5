//! What every code does to the answer: the rows of all subjects. A result that was read back knows the code alone.

pub use super::row::Severity;
use super::{camera, captures, frames, movement, robot, row::Row, streams, target, touches};

const SUBJECTS: [&[&Row]; 8] = [
    camera::ROWS,
    captures::ROWS,
    frames::ROWS,
    movement::ROWS,
    robot::ROWS,
    streams::ROWS,
    target::ROWS,
    touches::ROWS,
];

fn rows() -> impl Iterator<Item = &'static Row> {
    SUBJECTS.into_iter().flatten().copied()
}

/// The codes of all findings.
pub fn codes() -> impl Iterator<Item = &'static str> {
    rows().map(|row| row.code)
}

/// A code that does something to an answer, as its row has it.
pub fn known(code: &str) -> Option<&'static str> {
    row(code).filter(|row| row.severity > Severity::Info).map(|row| row.code)
}

pub(crate) fn row(code: &str) -> Option<&'static Row> {
    rows().find(|row| row.code == code)
}
