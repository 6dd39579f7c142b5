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
