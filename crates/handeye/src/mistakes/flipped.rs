//! A board whose corners were numbered from another end: it fits when it is rotated in its own plane.
//!
//! Corners that we detected rotate about their middle. Nobody knows where on the board the origin of poses from elsewhere
//! is: there one half turn about a point that is the same for all captures is looked for.

use nalgebra::{Rotation3, Vector2, Vector3};

use super::{outliers::Outliers, thresholds::RESTORABLE};
use crate::{Pose, Target, TargetModel, math::lie, solve::View};

/// A target rotated in its plane.
pub(super) struct Flip {
    /// By how many degrees.
    pub degrees: u32,
    /// About which point of its plane (m), where that is not the middle of its corners.
    pub about: Option<Vector2<f64>>,
}

/// Boards as outliers may have been read.
pub(crate) struct Boards<'a> {
    /// The target, where its corners were detected.
    pub target: Option<&'a TargetModel>,
    /// The frame that views are about, seen from the target's own.
    pub target_from_corner: Pose<Target, Target>,
    /// Captures whose target poses came from elsewhere.
    pub from_elsewhere: Vec<bool>,
}

/// By which rotation in its plane the target of capture `i` fits; `half_turn` is the common one of poses from elsewhere.
pub(super) fn flipped(
    outliers: &Outliers,
    boards: &Boards,
    half_turn: Option<Pose<Target, Target>>,
    i: usize,
) -> Option<Flip> {
    let about_middle = boards.target.and_then(|target| about_middle(outliers, boards, target, i));
    about_middle.map(|degrees| Flip { degrees, about: None }).or_else(|| {
        let turn = half_turn.filter(|turn| boards.from_elsewhere[i] && fits(outliers, i, turn))?;
        // the point that stays where it is, in the target's own frame
        let corner = boards.target_from_corner.translation().xy();
        Some(Flip { degrees: 180, about: Some(0.5 * turn.translation().xy() + corner) })
    })
}

fn about_middle(
    outliers: &Outliers,
    boards: &Boards,
    target: &TargetModel,
    i: usize,
) -> Option<u32> {
    let corner = boards.target_from_corner;
    let (columns, rows) = target.grid();
    let turns: &[u32] = if columns == rows { &[180, 90, 270] } else { &[180] };
    let about_corner = |degrees| corner.inverse() * turn_about_middle(target, degrees) * corner;
    turns.iter().copied().find(|&degrees| fits(outliers, i, &about_corner(degrees)))
}

/// Whether the rotation restores a capture.
fn fits(outliers: &Outliers, i: usize, turn: &Pose<Target, Target>) -> bool {
    outliers.candidates[i].iter().any(|view| outliers.is_restored(&rotated(view, turn)))
}

fn rotated(view: &View, turn: &Pose<Target, Target>) -> View {
    let carry = lie::adjoint(turn.inverse().iso());
    let mut rotated = view.clone();
    rotated.pair.camera_from_target = view.pair.camera_from_target * *turn;
    rotated.covariance = view.covariance.map(|c| carry * c * carry.transpose());
    rotated
}

/// The half turn that restores most outliers whose poses came from elsewhere: each proposes its own.
pub(super) fn common_half_turn(
    outliers: &Outliers,
    boards: &Boards,
) -> Option<Pose<Target, Target>> {
    let outside = outliers.outside().into_iter();
    let bare: Vec<usize> = outside.filter(|&i| boards.from_elsewhere[i]).collect();
    let restored =
        |turn: &Pose<Target, Target>| bare.iter().filter(|&&i| fits(outliers, i, turn)).count();
    bare.iter()
        .filter_map(|&i| half_turn_of(outliers, i))
        .map(|turn| (restored(&turn), turn))
        .filter(|(count, _)| *count > 0)
        .reduce(|best, next| if next.0 > best.0 { next } else { best })
        .map(|(_, turn)| turn)
}

/// The half turn in the target's plane that lies nearest to a capture's loop, about a point that the camera could have in
/// view.
fn half_turn_of(outliers: &Outliers, i: usize) -> Option<Pose<Target, Target>> {
    let half = Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI);
    outliers.candidates[i].iter().find_map(|view| {
        let open = outliers.found.hand_eye.loop_error(&view.pair);
        let t = open.translation();
        let turn = Pose::from_parts(half.matrix(), Vector3::new(t.x, t.y, 0.0));
        let in_view = t.norm() < 2.0 * view.pair.camera_from_target.translation().norm();
        (in_view && open.angle_to(&turn) < RESTORABLE.angle).then_some(turn)
    })
}

/// The target rotated in its plane about the middle of its corners: `target_from_rotated`.
fn turn_about_middle(target: &TargetModel, degrees: u32) -> Pose<Target, Target> {
    let corners = target.corners();
    let sum: Vector3<f64> = corners.iter().map(crate::Point::vector).sum();
    let middle = sum / corners.len().max(1) as f64;
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), f64::from(degrees).to_radians());
    Pose::from_parts(turn.matrix(), middle - turn * middle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::{
        Evidence,
        tests::{agreed, in_order, shift, with_target_moved},
    };

    fn boards(evidence: &Evidence, from_elsewhere: bool) -> Boards<'_> {
        Boards {
            target: evidence.target.as_ref().filter(|_| !from_elsewhere),
            target_from_corner: Pose::identity(),
            from_elsewhere: vec![from_elsewhere; evidence.names.len()],
        }
    }

    /// Sets in which one pose is left of every capture: an ambiguous one offers the right one beside the wrong one.
    fn unambiguous(captures: usize) -> Evidence {
        let mut evidence = in_order(captures, 8);
        let found = agreed(&evidence);
        for (capture, k) in evidence.declared.iter_mut().zip(found.reading) {
            capture.camera_from_target = vec![capture.camera_from_target[k]];
        }
        evidence
    }

    #[test]
    fn a_half_turn_about_the_middle_of_the_corners_restores_a_flipped_board() {
        let right = unambiguous(12);
        let target = right.target.clone().unwrap();
        for (degrees, expected) in [(180, Some(180)), (90, None)] {
            let wrong = with_target_moved(&right, &[4], turn_about_middle(&target, degrees));
            let found = agreed(&wrong);
            let outliers = Outliers::unfitted(&wrong.declared, &found);
            assert_eq!(outliers.outside(), [4]);
            let flip = flipped(&outliers, &boards(&wrong, false), None, 4);
            assert_eq!(flip.map(|f| f.degrees), expected, "a board of 9 x 6 has no quarter turns");
        }
    }

    #[test]
    fn poses_from_elsewhere_flip_about_one_point_that_they_tell() {
        let right = unambiguous(12);
        let half = turn_about_middle(right.target.as_ref().unwrap(), 180);
        let about = shift(0.02, 0.01, 0.0) * half * shift(-0.02, -0.01, 0.0);
        let wrong = with_target_moved(&right, &[4, 7], about);
        let found = agreed(&wrong);
        let outliers = Outliers::unfitted(&wrong.declared, &found);
        let boards = boards(&wrong, true);
        let turn = common_half_turn(&outliers, &boards).unwrap();
        let flip = flipped(&outliers, &boards, Some(turn), 4).unwrap();
        let at = 0.5 * about.translation().xy();
        assert!(flip.about.is_some_and(|p| (p - at).norm() < 2e-3), "{:?} {at}", flip.about);
        assert!(flipped(&outliers, &boards, None, 4).is_none());
    }
}
