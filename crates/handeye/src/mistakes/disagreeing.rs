//! Captures that agree with no others, and nothing known explains them.

use super::{
    evidence::{Evidence, Explanation},
    outliers::Outliers,
    thresholds::{FEWEST, MOST_OUTLIERS},
};
use crate::findings::CaptureFinding;

/// The outliers, where they are more than a few and those that agree are enough to say so.
pub(super) fn disagreeing(evidence: &Evidence, outliers: &Outliers) -> Option<Explanation> {
    let n = evidence.names.len();
    let out: Vec<usize> = (0..n).filter(|&i| !outliers.found.agrees[i]).collect();
    let are_many = out.len() > 1 && out.len() as f64 > MOST_OUTLIERS * n as f64;
    let finding = CaptureFinding::Disagreeing { captures: evidence.named(&out) };
    (are_many && n - out.len() >= FEWEST)
        .then(|| Explanation { captures: out, ..Explanation::new(finding, None) })
}
