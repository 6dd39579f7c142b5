//! Labellings of a board that look the same.

use nalgebra::{Matrix3, Vector3};

use super::PosedTarget;
use crate::{ImageCorner, Pose, Target, TargetModel, TargetPose, math::lie};

/// The poses under every labelling that looks the same, see [`TargetModel::symmetries`]: for each
/// pose the given labelling first.
pub fn with_symmetries(poses: &[PosedTarget], target: &TargetModel) -> Vec<TargetPose> {
    let turns: Vec<_> = target.symmetries().iter().map(|map| symmetry_turn(target, map)).collect();
    let one = |posed: &PosedTarget, turn: &Pose<Target, Target>| TargetPose {
        camera_from_target: posed.pose.camera_from_target * *turn,
        covariance: posed.pose.covariance.map(|c| {
            let carry = lie::adjoint(turn.inverse().iso());
            carry * c * carry.transpose()
        }),
    };
    turns.iter().flat_map(|turn| poses.iter().map(move |posed| one(posed, turn))).collect()
}

/// Corners under another labelling, in the order of their new ids.
pub(crate) fn relabelled(corners: &[ImageCorner], map: &[u32]) -> Vec<ImageCorner> {
    let one = |c: &ImageCorner| Some(ImageCorner { id: *map.get(c.id as usize)?, ..*c });
    let mut all: Vec<ImageCorner> = corners.iter().filter_map(one).collect();
    all.sort_by_key(|c| c.id);
    all
}

/// The turn of the board that takes corner `map[id]` to corner `id`.
pub(crate) fn symmetry_turn(target: &TargetModel, map: &[u32]) -> Pose<Target, Target> {
    let here: Vec<Vector3<f64>> = target.corners().iter().map(|c| c.vector()).collect();
    let there: Vec<Vector3<f64>> =
        map.iter().filter_map(|&id| here.get(id as usize).copied()).collect();
    let (Some(from), Some(into)) = (axes(&there), axes(&here)) else { return Pose::identity() };
    let rotation = into * from.transpose();
    Pose::from_parts(&rotation, here[0] - rotation * there[0])
}

/// Axes that move with the corners: from the first to the second one, and from there towards the
/// corner farthest from that line.
fn axes(corners: &[Vector3<f64>]) -> Option<Matrix3<f64>> {
    let (first, second) = (corners.first()?, corners.get(1)?);
    let x = (second - first).normalize();
    let off = |c: &Vector3<f64>| x.cross(&(c - first)).norm_squared();
    // of equally far ones the first
    let farthest = corners.iter().rev().max_by(|a, b| off(a).total_cmp(&off(b)))?;
    let down = farthest - first;
    let y = (down - x * x.dot(&down)).normalize();
    Some(Matrix3::from_columns(&[x, y, x.cross(&y)]))
}
