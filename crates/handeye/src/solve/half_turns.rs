//! Captures between which the robot turns by 180 degrees.
//!
//! A half turn about `a` is one about `-a`, so `R_A R_X = R_X R_B` says `R_X b = ±a` only: with half
//! turns about two axes four rotations fit. The position is least squares of
//! `(R_A - I) t_X = R_X t_B - t_A` for each; along the axis that is `aᵀ t_A = ± bᵀ t_B`, which only the
//! right one fulfils.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};

use super::{few_axes, motions, motions::Motion, shared::place_target};
use crate::{
    HandEye, Pose, PosePair,
    math::{jacobi, lie},
};

/// Turns (rad) this near to 180 degrees may be about either sense of their axis.
const NEAR: f64 = 0.1;
/// Sine of the angle between two axes below which they are one.
const ONE_AXIS: f64 = 0.1;

/// The answers that two half turns about different axes leave; none without such turns.
pub(super) fn solve(pairs: &[PosePair]) -> Vec<HandEye> {
    let all = motions::motions(pairs);
    let axes: Vec<(Vector3<f64>, Vector3<f64>)> = all.iter().filter_map(axes).collect();
    let two = axes.iter().enumerate().find_map(|(i, one)| {
        let other = axes[i + 1..].iter().find(|o| one.0.cross(&o.0).norm() > ONE_AXIS)?;
        Some((one, other))
    });
    let Some((one, other)) = two else { return vec![] };
    let answer = |(first, second): (f64, f64)| {
        let matrix = one.0 * one.1.transpose() * first + other.0 * other.1.transpose() * second;
        let rotation = jacobi::nearest_rotation(&matrix)?.to_rotation_matrix().into_inner();
        let t = few_axes::position(&all, &rotation);
        Some(place_target(pairs, &Pose::from_parts(&rotation, t)))
    };
    let senses = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    senses.into_iter().filter_map(answer).collect()
}

/// The axes of a half turn in the mount and in the camera.
fn axes(m: &Motion) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let axis = |r: &UnitQuaternion<f64>| {
        let turn = lie::so3_log(r);
        (turn.norm() > PI - NEAR).then(|| turn.normalize())
    };
    axis(&m.a.rotation).zip(axis(&m.b.rotation))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::{
        Anchor, Mount,
        solve::tests::{pose, truths},
    };

    /// One pose and three others turned from it by exactly 180 degrees about the axes of the mount.
    pub(crate) fn half_turns(truth: &HandEye) -> Vec<PosePair> {
        let first: Pose<Anchor, Mount> = pose([0.6, 0.0, 0.5], [3.0, 0.1, 0.2]);
        let places = [[0.2, 0.3, -0.1], [-0.1, 0.25, 0.2], [0.15, -0.2, 0.3], [0.0, 0.1, -0.2]];
        let turns = [[0.0; 3], [PI, 0.0, 0.0], [0.0, PI, 0.0], [0.0, 0.0, PI]];
        let one = |(place, turn): ([f64; 3], [f64; 3])| {
            let anchor_from_mount = first * pose(place, turn);
            let seen = (anchor_from_mount * truth.mount_from_camera).inverse();
            PosePair { anchor_from_mount, camera_from_target: seen * truth.anchor_from_target }
        };
        places.into_iter().zip(turns).map(one).collect()
    }

    #[test]
    fn one_of_the_answers_is_right() {
        for truth in truths() {
            let pairs = half_turns(&truth);
            for three in [&pairs[..3], &pairs[1..]] {
                let found = solve(three);
                let off = |h: &HandEye| h.mount_from_camera.local(&truth.mount_from_camera).norm();
                assert_eq!(found.len(), 4);
                assert_eq!(found.iter().filter(|h| off(h) < 1e-9).count(), 1);
            }
        }
    }
}
