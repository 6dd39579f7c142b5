//! Robot-world / hand-eye by a linear system of quaternion parts.
//!
//! `a x = y b` for the quaternions of every pose. Its scalar part gives `x₀`; with that, and divided
//! by `y₀`, its vector part is linear in six unknowns,
//!
//! ```text
//! (a₀ I + [a]ₓ + a aᵀ/a₀) x/y₀ - (b₀ I - [b]ₓ + a bᵀ/a₀) y/y₀ = b - (b₀/a₀) a
//! ```
//!
//! The method fails where `a₀` or `y₀` is zero. So robot poses are taken from their mean, poses
//! turned from it by more than 174 degrees are left out, and the target frame is turned by 180
//! degrees about an axis if that makes `y₀` larger. The positions are linear least squares.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone; less than three poses
//! within 174 degrees of their mean.
//!
//! H. Zhuang, Z. Roth and R. Sudhakar, *Simultaneous robot/world and tool/flange calibration by
//! solving homogeneous transformation equations of the form AX = YB*, IEEE T-RA 10(4), 1994.

use nalgebra::{Isometry3, Matrix3, SMatrix, UnitQuaternion, Vector4, Vector6};

use super::{
    kronecker::Centred,
    moments::{self, between, product, vector},
    shared::open,
};
use crate::{Error, HandEye, Pose, PosePair, math::jacobi};

/// Least scalar part of a pose that is used.
const LEAST_SCALAR: f64 = 0.05;

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let (x, y) = rotations(&all).ok_or_else(|| open("the rotations do not fix the camera's"))?;
    with_positions(pairs, &x, &y)
}

/// The answer from quaternions seen from the first capture: positions by least squares.
pub(super) fn with_positions(
    pairs: &[PosePair],
    x: &Vector4<f64>,
    y: &Vector4<f64>,
) -> Result<HandEye, Error> {
    let first = &pairs[0];
    let r_x = jacobi::rotation_of(x);
    // Y = A_0 Y' B_0⁻¹
    let r_y: UnitQuaternion<f64> = first.anchor_from_mount.iso().rotation
        * jacobi::rotation_of(y)
        * first.camera_from_target.iso().rotation;
    let (t_x, t_y) = Centred::new(pairs).positions(&r_y.to_rotation_matrix().into_inner())?;
    Ok(HandEye {
        mount_from_camera: Pose::claim(Isometry3::from_parts(t_x.into(), r_x)),
        anchor_from_target: Pose::claim(Isometry3::from_parts(t_y.into(), r_y)),
    })
}

fn rotations(all: &[moments::Seen]) -> Option<(Vector4<f64>, Vector4<f64>)> {
    let mean = jacobi::leading(&all.iter().map(|s| s.a * s.a.transpose()).sum())
        .unwrap_or_else(|| all[0].a);
    let guess = moments::loops(all);
    let guess = between(&mean, &jacobi::leading(&(guess.transpose() * guess))?);
    let turn = Vector4::ith(guess.iamax(), 1.0); // y t* has its largest part as its scalar
    let (mut normal, mut rhs) = (SMatrix::<f64, 6, 6>::zeros(), Vector6::zeros());
    for s in all {
        let (a, b) = (between(&mean, &s.a), product(&turn, &s.b));
        if a[0].abs() < LEAST_SCALAR {
            continue;
        }
        let (v_a, v_b) = (vector(&a), vector(&b));
        let left = Matrix3::identity() * a[0] + v_a.cross_matrix() + v_a * v_a.transpose() / a[0];
        let right = Matrix3::identity() * b[0] - v_b.cross_matrix() + v_a * v_b.transpose() / a[0];
        let mut row = SMatrix::<f64, 3, 6>::zeros();
        row.fixed_view_mut::<3, 3>(0, 0).copy_from(&left);
        row.fixed_view_mut::<3, 3>(0, 3).copy_from(&-right);
        normal += row.transpose() * row;
        rhs += row.transpose() * (v_b - v_a * (b[0] / a[0]));
    }
    let w = moments::solve_spd(&normal, &rhs)?;
    let y = Vector4::new(1.0, w[3], w[4], w[5]);
    let x = scalar_of_x(all, &mean, &turn, &w, &y);
    Some((x, product(&mean, &product(&y, &turn))))
}

/// `x` with its scalar part `x₀/y₀ = (b₀ + a·x - b·y)/a₀`, as a mean weighted by `a₀²`.
fn scalar_of_x(
    all: &[moments::Seen],
    mean: &Vector4<f64>,
    turn: &Vector4<f64>,
    w: &Vector6<f64>,
    y: &Vector4<f64>,
) -> Vector4<f64> {
    let mut x = Vector4::new(0.0, w[0], w[1], w[2]);
    let (mut sum, mut weight) = (0.0, 0.0);
    for s in all {
        let (a, b) = (between(mean, &s.a), product(turn, &s.b));
        sum += a[0] * (b[0] + vector(&a).dot(&vector(&x)) - vector(&b).dot(&vector(y)));
        weight += a[0] * a[0];
    }
    x[0] = sum / weight;
    x
}
