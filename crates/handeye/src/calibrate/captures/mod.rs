//! Which captures count: those that agree, and of those that repeat one another one; what moved in between; and how far
//! each lies from the answer.
//!
//! | file | question |
//! |---|---|
//! | `repeated`, `near_duplicates` | captures of one robot pose, or of few places, that repeat one another |
//! | `agreement` | which captures agree, on which pose candidate? `gate` and `masked` find them, `rejected` says why others do not, `doubt` whether the majority is clear |
//! | `movement`, `moved` | did anything move, and what does it do to the answer? |
//! | `sequence` | do errors drift from capture to capture? |
//! | `residuals` | residual of every capture and touch |

pub(crate) mod agreement;
mod doubt;
mod gate;
mod masked;
pub(crate) mod moved;
pub(crate) mod movement;
pub(crate) mod near_duplicates;
mod rejected;
pub(crate) mod repeated;
pub(crate) mod residuals;
pub(crate) mod sequence;
