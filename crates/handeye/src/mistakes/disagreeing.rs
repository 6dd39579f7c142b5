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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::tests::{agreed, in_order, shift, with_robot};

    #[test]
    fn outliers_are_said_from_three_of_fifteen_on() {
        let right = in_order(15, 3);
        let of = |count: usize| {
            let wrong = with_robot(&right, |k, c| match k % 4 == 0 && k / 4 < count {
                true => shift(0.05 + 0.01 * k as f64, 0.1, 0.0) * c.anchor_from_mount,
                false => c.anchor_from_mount,
            });
            let agreed_on = agreed(&wrong);
            disagreeing(&wrong, &Outliers::unfitted(&wrong.declared, &agreed_on))
        };
        assert_eq!(of(2), None);
        assert_eq!(of(3).unwrap().captures, [0, 4, 8]);
    }
}
