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
