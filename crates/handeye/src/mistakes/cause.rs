//! Why one capture does not agree: what would restore it, offered, never done. A cause is named only where no other one
//! restores it as well.

use super::{
    exchanged, flipped,
    flipped::{Boards, Flip},
    other_pose,
    outliers::Outliers,
    thresholds::{FARTHEST, MOST_EXPLAINED},
};
use crate::{
    findings::captures::{Cause, Other, Stands},
    model::session::Session,
};

/// The cause of every outlier; without a fit, or with too many outliers, by how much it disagrees.
pub(crate) fn causes(
    outliers: &Outliers,
    boards: &Boards,
    session: &Session,
) -> Vec<(usize, Cause)> {
    let outside = outliers.outside();
    let are_few = outside.len() as f64 <= MOST_EXPLAINED * outliers.candidates.len() as f64;
    let is_tested = are_few && outliers.is_fitted();
    let half_turn = is_tested.then(|| flipped::common_half_turn(outliers, boards)).flatten();
    let of = |i: usize| {
        let known = is_tested.then(|| {
            let flip = flipped::flipped(outliers, boards, half_turn, i);
            restoring(outliers, session, flip, i)
        });
        (i, known.flatten().unwrap_or_else(|| disagreement(outliers, session, i)))
    };
    outside.into_iter().map(of).collect()
}

/// The one thing that restores capture `i`.
fn restoring(
    outliers: &Outliers,
    session: &Session,
    flip: Option<Flip>,
    i: usize,
) -> Option<Cause> {
    let seen = session.read_from();
    let elsewhere = other_pose::fitting(outliers, i);
    if flip.is_none()
        && let Some(j) = exchanged::partner(outliers, i)
    {
        return Some(Cause::Exchanged { seen, with: session.observations[j].capture.clone() });
    }
    match (flip, elsewhere.as_slice()) {
        (Some(Flip { degrees, about }), []) => Some(Cause::TargetRotated {
            degrees,
            about_mm: about.map(|m| (m * 1e3).into()),
            has_corners: session.target.is_some(),
        }),
        (None, &[j]) => Some(Cause::FitsPoseOf { seen, other: other(session, i, j) }),
        (None, []) => {
            let owner = other_pose::owner(outliers, i)?;
            Some(Cause::HasPoseOf { seen, other: other(session, i, owner) })
        }
        _ => None,
    }
}

/// Capture `j` as seen from capture `i`.
fn other(session: &Session, i: usize, j: usize) -> Other {
    let stands = match j {
        _ if j == i + 1 => Stands::After,
        _ if j + 1 == i => Stands::Before,
        _ => Stands::Elsewhere,
    };
    Other { name: session.observations[j].capture.clone(), stands }
}

fn disagreement(outliers: &Outliers, session: &Session, i: usize) -> Cause {
    let residual = outliers.residual(&outliers.candidates[i][outliers.found.reading[i]]);
    let reach = session.observations[i].base_from_flange.translation().norm();
    Cause::Disagrees {
        distance_mm: residual.distance * 1e3,
        angle_deg: residual.angle.to_degrees(),
        out_of_reach_m: (reach > FARTHEST).then_some(reach),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Pose,
        estimate::{self, KnownNoise},
        mistakes::Evidence,
        mistakes::tests::{agreed, in_order, session, shift, with_robot},
        solve::{View, consensus::Consensus},
    };

    /// The causes of the outliers of a simulated session that was made wrong.
    fn of(wrong: &Evidence) -> Vec<(usize, Cause)> {
        against(wrong, &agreed(wrong))
    }

    /// The same where it is known what agrees.
    fn against(wrong: &Evidence, found: &Consensus) -> Vec<(usize, Cause)> {
        let session = session(wrong.names.len(), 9);
        let bare = Outliers::unfitted(&wrong.declared, found);
        let view = |i: usize| bare.candidates[i][found.reading[i]].clone();
        let inside: Vec<View> =
            crate::mistakes::score::agreeing(found).into_iter().map(view).collect();
        let known = KnownNoise::default();
        let fit = estimate::fit_views(&inside, &found.hand_eye, &known, wrong.setup).unwrap();
        let fit = Some((&fit, wrong.setup));
        let outliers = Outliers::new(&wrong.declared, bare.candidates.clone(), found, fit);
        let boards = Boards {
            target: wrong.target.as_ref(),
            target_from_corner: Pose::identity(),
            from_elsewhere: vec![false; wrong.names.len()],
        };
        causes(&outliers, &boards, &session)
    }

    fn robots(right: &Evidence, of: impl Fn(usize) -> usize) -> Evidence {
        with_robot(right, |k, _| right.declared[of(k)].anchor_from_mount)
    }

    #[test]
    fn captures_in_order_have_no_cause() {
        assert!(of(&in_order(12, 9)).is_empty());
    }

    #[test]
    fn each_outlier_has_the_cause_that_was_made() {
        let right = in_order(12, 9);
        let exchanged =
            of(&robots(&right, |k| [k, 8, 3][usize::from(k == 3) + 2 * usize::from(k == 8)]));
        assert!(
            matches!(&exchanged[..], [(3, Cause::Exchanged { .. }), (8, Cause::Exchanged { .. })]),
            "{exchanged:?}"
        );
        let stale = of(&robots(&right, |k| if k == 6 { 5 } else { k }));
        let is_before = |other: &Other| other.stands == Stands::Before;
        assert!(
            matches!(&stale[..], [(6, Cause::HasPoseOf { other, .. })] if is_before(other)),
            "{stale:?}"
        );
    }

    #[test]
    fn what_nothing_restores_is_said_with_how_far_it_is_off() {
        let right = in_order(12, 9);
        let off = |by: f64| {
            with_robot(&right, |k, c| match k {
                2 => shift(0.0, 0.0, by) * c.anchor_from_mount,
                _ => c.anchor_from_mount,
            })
        };
        let found = of(&off(0.2));
        let [(2, Cause::Disagrees { distance_mm, out_of_reach_m: None, .. })] = &found[..] else {
            panic!("{found:?}")
        };
        assert!((distance_mm - 200.0).abs() < 5.0, "{distance_mm}");
    }

    #[test]
    fn of_more_outliers_than_half_none_is_explained_by_a_chance_fit() {
        let right = in_order(10, 9);
        let causes = |wrong: usize| {
            let mut found = agreed(&right);
            (0..wrong).for_each(|k| found.agrees[k] = false);
            // neighbours exchanged, and the last one with the pose of the first
            let of = |k: usize| {
                if k >= wrong {
                    k
                } else if k == 4 {
                    0
                } else {
                    k ^ 1
                }
            };
            against(&robots(&right, of), &found)
        };
        let four = causes(4);
        assert_eq!(four.len(), 4, "{four:?}");
        assert!(four.iter().all(|(_, cause)| matches!(cause, Cause::Exchanged { .. })), "{four:?}");
        let six = causes(6);
        assert_eq!(six.len(), 6, "{six:?}");
        assert!(six.iter().all(|(_, cause)| matches!(cause, Cause::Disagrees { .. })), "{six:?}");
    }
}
