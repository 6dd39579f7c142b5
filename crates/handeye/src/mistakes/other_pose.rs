//! A capture at the robot pose of another one: its image fits that pose, or another image was taken at its own.

use std::cmp::Reverse;

use super::outliers::Outliers;

/// Captures whose robot poses image `i` fits, the likeliest first, one of those with the same robot pose.
pub(super) fn fitting(outliers: &Outliers, i: usize) -> Vec<usize> {
    let mut all: Vec<usize> = outliers.others(i).filter(|&j| outliers.fits(i, j)).collect();
    // where both fit, it is an exchange; neighbours are likelier
    all.sort_by_key(|&j| (Reverse(outliers.fits(j, i)), j.abs_diff(i) != 1, j));
    if let Some(&first) = all.first() {
        all.retain(|&j| j == first || !outliers.is_same_robot(j, first));
    }
    all
}

/// The capture whose image was taken at the robot pose of capture `i`: the one before rather than another.
pub(super) fn owner(outliers: &Outliers, i: usize) -> Option<usize> {
    let taken = outliers.others(i).filter(|&j| outliers.fits(j, i));
    taken.min_by_key(|&j| (j + 1 != i, j.abs_diff(i), j))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::tests::{agreed, in_order, with_robot};

    #[test]
    fn a_pose_that_was_read_too_early_has_its_owner_before() {
        let right = in_order(12, 5);
        let stale =
            with_robot(&right, |k, _| right.declared[if k == 6 { 5 } else { k }].anchor_from_mount);
        let found = agreed(&stale);
        let outliers = Outliers::unfitted(&stale.declared, &found);
        assert_eq!(outliers.outside(), [6]);
        assert!(fitting(&outliers, 6).is_empty());
        assert_eq!(owner(&outliers, 6), Some(5));
    }

    #[test]
    fn an_image_that_fits_two_captures_with_one_robot_pose_fits_one() {
        let mut wrong = in_order(12, 5);
        wrong.declared[9].camera_from_target = wrong.declared[2].camera_from_target.clone();
        let found = agreed(&wrong);
        assert_eq!(fitting(&Outliers::unfitted(&wrong.declared, &found), 9), [2]);
        wrong.declared[3] = wrong.declared[2].clone();
        let found = agreed(&wrong);
        assert_eq!(fitting(&Outliers::unfitted(&wrong.declared, &found), 9), [2]);
    }
}
