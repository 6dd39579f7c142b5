//! Motions that do not determine everything: all rotations about one axis (SCARA robots, a wrist
//! that only spins), or none at all.
//!
//! With `a` the axis in the mount and `b` in the camera, `R_X = R(a, φ) R₀` where `R₀` turns `b` onto
//! `a`. The loop `(R_A - I) t_X = R_X t_B - t_A` is linear in `t_X`, `cos φ` and `sin φ`: with
//! `w = R₀ t_B`,
//!
//! ```text
//! (R_A - I) t_X - cos φ (w - a aᵀw) - sin φ (a × w) = a aᵀw - t_A
//! ```
//!
//! The position along `a` is free; of all answers the one nearest to the origin is given. Without
//! rotations, `R_X` is the turn between the translations of mount and camera, and the whole position
//! is free.
//!
//! M. Ulrich and C. Steger, *Hand-eye calibration of SCARA robots using dual quaternions*, 2016.

use nalgebra::{Isometry3, Matrix3, SMatrix, SVector, UnitQuaternion, Vector3};

use super::{motions, shared::place_target};
use crate::{
    HandEye, Pose, PosePair,
    math::{jacobi, lie, linalg},
};

/// Eigenvalues below this part of the largest belong to directions that are free.
const FREE: f64 = 1e-9;

/// One of the answers that fit; `None` where the motions say nothing.
pub fn solve(pairs: &[PosePair]) -> Option<HandEye> {
    let all = motions::motions(pairs);
    let x = if motions::rotates(pairs) { about_one_axis(&all) } else { without_rotation(&all) }?;
    Some(place_target(pairs, &x))
}

fn about_one_axis(all: &[motions::Motion]) -> Option<Pose<crate::Mount, crate::Camera>> {
    let log = |r: &UnitQuaternion<f64>| lie::so3_log(r);
    let scatter: Matrix3<f64> =
        all.iter().map(|m| log(&m.a.rotation)).map(|w| w * w.transpose()).sum();
    let a: Vector3<f64> = jacobi::eigen(&scatter).1.column(0).into_owned();
    let b: Vector3<f64> = all.iter().map(|m| log(&m.b.rotation) * a.dot(&log(&m.a.rotation))).sum();
    let b = b.try_normalize(f64::MIN_POSITIVE)?;
    let turn = UnitQuaternion::rotation_between(&b, &a)
        .unwrap_or_else(|| UnitQuaternion::new(a.cross(&perpendicular(&a)) * std::f64::consts::PI));
    let (mut h, mut g) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros());
    for m in all {
        let w = turn * m.b.translation.vector;
        let along = a * a.dot(&w);
        let mut rows = SMatrix::<f64, 3, 5>::zeros();
        rows.fixed_view_mut::<3, 3>(0, 0).copy_from(&less_identity(&m.a.rotation));
        rows.set_column(3, &(along - w));
        rows.set_column(4, &-a.cross(&w));
        h += rows.transpose() * rows;
        g += rows.transpose() * (along - m.a.translation.vector);
    }
    let solution = least_norm(&h, &g);
    let angle = solution[4].atan2(solution[3]);
    let rotation = UnitQuaternion::new(a * angle) * turn;
    let rotation = rotation.to_rotation_matrix().into_inner();
    Some(Pose::from_parts(&rotation, position(all, &rotation)))
}

/// Least squares of `(R_A - I) t_X = R_X t_B - t_A` for a given `R_X`; of all solutions the shortest.
pub(super) fn position(all: &[motions::Motion], rotation: &Matrix3<f64>) -> Vector3<f64> {
    let (mut h, mut g) = (Matrix3::zeros(), Vector3::zeros());
    for m in all {
        let rows = less_identity(&m.a.rotation);
        h += rows.transpose() * rows;
        g += rows.transpose() * (rotation * m.b.translation.vector - m.a.translation.vector);
    }
    least_norm(&h, &g)
}

fn less_identity(rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
    rotation.to_rotation_matrix().into_inner() - Matrix3::identity()
}

fn perpendicular(a: &Vector3<f64>) -> Vector3<f64> {
    let other = if a.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    a.cross(&other).normalize()
}

fn without_rotation(all: &[motions::Motion]) -> Option<Pose<crate::Mount, crate::Camera>> {
    let moved: Matrix3<f64> =
        all.iter().map(|m| m.a.translation.vector * m.b.translation.vector.transpose()).sum();
    let rank = linalg::svd3(&moved).1;
    if !(rank[1] > FREE * rank[0]) {
        return None;
    }
    Some(Pose::claim(Isometry3::from_parts(
        Vector3::zeros().into(),
        jacobi::nearest_rotation(&moved)?,
    )))
}

/// `H⁺ g`: of all solutions the shortest.
fn least_norm<const N: usize>(h: &SMatrix<f64, N, N>, g: &SVector<f64, N>) -> SVector<f64, N> {
    let (values, vectors) = jacobi::eigen(h);
    let most = values.max();
    (0..N)
        .filter(|&k| values[k] > FREE * most)
        .map(|k| vectors.column(k) * (vectors.column(k).dot(g) / values[k]))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{exact_pairs, truths};

    /// The same views with the robot turned about one axis only, or moved without turning.
    fn pairs(angle: f64) -> Vec<PosePair> {
        let truth = truths()[0];
        let axis = Vector3::new(0.1, -0.2, 1.0).normalize();
        let place = |(k, p): (usize, PosePair)| {
            let turn = Pose::from_parts(
                &UnitQuaternion::new(axis * angle * k as f64).to_rotation_matrix().into_inner(),
                p.anchor_from_mount.translation(),
            );
            PosePair {
                anchor_from_mount: turn,
                camera_from_target: (turn * truth.mount_from_camera).inverse()
                    * truth.anchor_from_target,
            }
        };
        exact_pairs(&truth, 8).into_iter().enumerate().map(place).collect()
    }

    #[test]
    fn all_but_the_position_along_the_axis_is_found() {
        let truth = truths()[0].mount_from_camera;
        let pairs = pairs(0.4);
        let found = solve(&pairs).unwrap().mount_from_camera;
        assert!(found.angle_to(&truth) < 1e-9);
        let axis = motions::single_axis(&pairs).unwrap();
        let off = found.translation() - truth.translation();
        assert!((off - axis * axis.dot(&off)).norm() < 1e-9, "{off}");
    }

    #[test]
    fn translations_give_the_rotation() {
        let found = solve(&pairs(0.0)).unwrap().mount_from_camera;
        assert!(found.angle_to(&truths()[0].mount_from_camera) < 1e-9);
    }

    #[test]
    fn a_robot_that_stands_still_gives_nothing() {
        let still = vec![pairs(0.4)[0]; 5];
        assert!(solve(&still).is_none());
    }
}
