//! Poses that stood still: a robot pose that was not read anew, an image stored twice, captures that repeat others.

use super::{
    evidence::{Evidence, Explanation},
    thresholds::{MOTION, SAME_ROBOT, SAME_VIEW},
};
use crate::{findings::CaptureFinding, model::residual::Residual, solve::consensus::Readings};

/// Captures with one robot pose during which the target moved in the images.
pub(super) fn robot(evidence: &Evidence) -> Option<Explanation> {
    let still = |a: &Readings, b: &Readings| is_same_robot(a, b) && !is_view_within(a, b, MOTION);
    let which = partners(&evidence.declared, still)?;
    let finding = CaptureFinding::RobotStill { captures: evidence.named(&which) };
    let obsolete = which.clone();
    Some(Explanation { obsolete, captures: which, ..Explanation::new(finding, None) })
}

/// Captures that show the same although the robot moved.
pub(super) fn camera(evidence: &Evidence) -> Option<Explanation> {
    let still = |a: &Readings, b: &Readings| {
        let robot = Residual::between(&a.anchor_from_mount, &b.anchor_from_mount);
        !robot.is_within(MOTION) && is_view_within(a, b, SAME_VIEW)
    };
    let which = partners(&evidence.declared, still)?;
    let finding = CaptureFinding::CameraStill { captures: evidence.named(&which) };
    Some(Explanation { captures: which, ..Explanation::new(finding, None) })
}

/// Captures that repeat one another: the same robot pose, the same view.
pub(super) fn repeated(evidence: &Evidence) -> Option<Explanation> {
    let same = |a: &Readings, b: &Readings| is_same_robot(a, b) && is_view_within(a, b, SAME_VIEW);
    let which = partners(&evidence.declared, same)?;
    let finding = CaptureFinding::Repeated { captures: evidence.named(&which) };
    Some(Explanation { captures: which, ..Explanation::new(finding, None) })
}

/// Whether two captures have one and the same robot pose.
pub(super) fn is_same_robot(a: &Readings, b: &Readings) -> bool {
    Residual::between(&a.anchor_from_mount, &b.anchor_from_mount).is_within(SAME_ROBOT)
}

/// Whether some pose candidates of two captures are this near.
fn is_view_within(a: &Readings, b: &Readings, limit: Residual) -> bool {
    let near = |x| b.camera_from_target.iter().any(|y| Residual::between(x, y).is_within(limit));
    a.camera_from_target.iter().any(near)
}

/// Every capture that has a partner; `None` where there is none.
fn partners(
    captures: &[Readings],
    is_pair: impl Fn(&Readings, &Readings) -> bool,
) -> Option<Vec<usize>> {
    let n = captures.len();
    let has = |&i: &usize| (0..n).any(|j| j != i && is_pair(&captures[i], &captures[j]));
    let all: Vec<usize> = (0..n).filter(has).collect();
    (!all.is_empty()).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::tests::{in_order, shift, with_robot, with_target_moved};

    #[test]
    fn a_robot_pose_stored_twice_is_frozen_up_to_a_tenth_of_a_millimetre() {
        let right = in_order(8, 1);
        assert_eq!(robot(&right), None);
        let near = |by: f64| {
            with_robot(&right, |k, c| match k {
                5 => right.declared[4].anchor_from_mount * shift(by, 0.0, 0.0),
                _ => c.anchor_from_mount,
            })
        };
        let found = robot(&near(0.9e-4)).unwrap();
        assert_eq!(
            (found.captures.as_slice(), found.obsolete.as_slice()),
            (&[4, 5][..], &[4, 5][..])
        );
        assert_eq!(robot(&near(1.1e-4)), None);
    }

    #[test]
    fn an_image_stored_twice_shows_the_same_to_a_millimetre() {
        let mut right = in_order(8, 1);
        assert_eq!(camera(&right), None);
        right.declared[3].camera_from_target = right.declared[6].camera_from_target.clone();
        assert_eq!(camera(&right).unwrap().captures, [3, 6]);
        let beside = |by| camera(&with_target_moved(&right, &[3], shift(by, 0.0, 0.0)));
        assert!(beside(0.9e-3).is_some());
        assert_eq!(beside(1.1e-3), None);
    }

    #[test]
    fn a_capture_stored_twice_repeats_and_is_not_frozen() {
        let mut right = in_order(8, 1);
        right.declared[2] = right.declared[1].clone();
        assert_eq!(repeated(&right).unwrap().captures, [1, 2]);
        assert_eq!((robot(&right), camera(&right)), (None, None));
    }
}
