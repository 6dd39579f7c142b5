//! Captures whose images were exchanged: each fits the robot pose of the other one.

use super::{
    evidence::{Evidence, Explanation},
    outliers::Outliers,
    score::scored,
};
use crate::findings::CaptureFinding;

/// The outlier with which capture `i` looks exchanged: one image fits the other's robot pose, and the other one nearly.
pub(super) fn partner(outliers: &Outliers, i: usize) -> Option<usize> {
    let is_exchanged = |&j: &usize| {
        outliers.fits(i, j) && outliers.nearly_fits(j, i)
            || outliers.nearly_fits(i, j) && outliers.fits(j, i)
    };
    let others = outliers.outside().into_iter().filter(|&j| j != i);
    others.filter(is_exchanged).min_by_key(|&j| (j.abs_diff(i), j))
}

/// All pairs that are each other's partners, and the score with them exchanged back.
pub(super) fn exchanged(evidence: &Evidence, outliers: &Outliers) -> Option<Explanation> {
    let mut corrected = evidence.declared.clone();
    let mut pairs = vec![];
    for i in outliers.outside() {
        if let Some(j) = partner(outliers, i).filter(|&j| i < j && partner(outliers, j) == Some(i))
        {
            let of_i = std::mem::take(&mut corrected[i].camera_from_target);
            corrected[i].camera_from_target =
                std::mem::replace(&mut corrected[j].camera_from_target, of_i);
            pairs.extend([i, j]);
        }
    }
    let finding = CaptureFinding::ImagesExchanged { captures: evidence.named(&pairs) };
    (!pairs.is_empty()).then(|| Explanation {
        captures: pairs,
        ..Explanation::new(finding, scored(&corrected).map(|(after, _)| after))
    })
}
