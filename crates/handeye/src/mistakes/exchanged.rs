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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::tests::{agreed, in_order, shift, with_robot};

    #[test]
    fn both_images_must_fit_the_other_robot_pose() {
        let mut wrong = in_order(12, 2);
        let of_two = wrong.declared[2].camera_from_target.clone();
        wrong.declared[2].camera_from_target = wrong.declared[9].camera_from_target.clone();
        let half = wrong.clone();
        wrong.declared[9].camera_from_target = of_two;
        let agreed_on = agreed(&wrong);
        let outliers = Outliers::unfitted(&wrong.declared, &agreed_on);
        let found = exchanged(&wrong, &outliers).unwrap();
        assert_eq!(found.captures, [2, 9]);
        assert!(found.score() < 3.0, "{found:?}");
        let agreed_on = agreed(&half);
        assert_eq!(exchanged(&half, &Outliers::unfitted(&half.declared, &agreed_on)), None);
    }

    #[test]
    fn the_second_image_may_be_somewhat_off() {
        let right = in_order(12, 2);
        let with_off = |off: f64| {
            let wrong = with_robot(&right, |k, c| match k {
                2 => right.declared[9].anchor_from_mount * shift(off, 0.0, 0.0),
                9 => right.declared[2].anchor_from_mount,
                _ => c.anchor_from_mount,
            });
            let agreed_on = agreed(&wrong);
            let outliers = Outliers::unfitted(&wrong.declared, &agreed_on);
            let typical = outliers.typical.distance;
            (partner(&outliers, 2), typical)
        };
        let (exact, typical) = with_off(0.0);
        assert_eq!(exact, Some(9));
        assert_eq!(with_off(2.0 * typical).0, Some(9));
        assert_eq!(with_off(5.0 * typical).0, None);
    }
}
