//! Robot-world / hand-eye in closed form, by the Kronecker product.
//!
//! Every pose pair closes one loop, `A X = Y B`:
//!
//! ```text
//! anchor_from_mount · mount_from_camera = anchor_from_target · target_from_camera
//!         A                  X                   Y                   B
//! ```
//!
//! Rotation first: `vec(R_Y) = (R_B ⊗ R_A) vec(R_X)` holds for every pair, so `(vec R_X, vec R_Y)`
//! are the leading singular vectors of `P = Σ R_B ⊗ R_A`. They are found by squaring `PᵀP`, which
//! leaves the leading one standing: `k` squarings do the work of `2^k` steps of a power iteration.
//! Translation then is linear least squares.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone; then the two largest
//! singular values are equal. Half turns among others are no trouble, and no quaternion has a sign.
//!
//! M. Shah, *Solving the robot-world/hand-eye calibration problem using the Kronecker product*,
//! J. Mechanisms and Robotics 5(3), 2013.

use nalgebra::{Isometry3, Matrix3, SMatrix, UnitQuaternion};

use super::{kronecker, kronecker::Centred, shared::open};
use crate::{Error, HandEye, Pose, PosePair, math::jacobi};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let (r_x, r_y) = rotations(&kronecker::sum(pairs))?;
    let r = r_y.to_rotation_matrix().into_inner();
    let (t_x, t_y) = Centred::new(pairs).positions(&r)?;
    Ok(HandEye {
        mount_from_camera: Pose::claim(Isometry3::from_parts(t_x.into(), r_x)),
        anchor_from_target: Pose::claim(Isometry3::from_parts(t_y.into(), r_y)),
    })
}

/// `R_X` and `R_Y` from `P`.
pub(super) fn rotations(
    p: &SMatrix<f64, 9, 9>,
) -> Result<(UnitQuaternion<f64>, UnitQuaternion<f64>), Error> {
    let free = || open("the rotations do not fix the camera's");
    let x = leading(&(p.transpose() * p)).ok_or_else(free)?;
    let y = p * x;
    let x = Matrix3::from_column_slice(x.as_slice());
    let y = Matrix3::from_column_slice(y.as_slice());
    // A singular pair is known up to one common sign: take the one that makes rotations.
    let sign = x.determinant().signum();
    let rotation = |m: Matrix3<f64>| jacobi::nearest_rotation(&(m * sign)).ok_or_else(free);
    Ok((rotation(x)?, rotation(y)?))
}

/// Squarings that find an eigenvector whose next eigenvalue is smaller by one part in 1e13.
const MOST_SQUARINGS: usize = 50;

/// Share of the other eigenvalues of a power at which one counts as left alone.
const SINGLE: f64 = 1e-14;

/// The leading eigenvector of a positive matrix; `None` when the largest eigenvalue is not single.
fn leading(m: &SMatrix<f64, 9, 9>) -> Option<SMatrix<f64, 9, 1>> {
    let mut power = m / m.trace();
    for _ in 0..MOST_SQUARINGS {
        let square = symmetric_square(&power);
        let trace = square.trace(); // Σ λ² where Σ λ = 1: it is 1 when one λ is left
        power = square / trace;
        if 1.0 - trace < SINGLE {
            let largest = power.diagonal().imax();
            let x = power.column(largest).normalize();
            return Some((m * x).normalize()); // one step with m itself takes off the rounding
        }
    }
    None
}

fn symmetric_square(m: &SMatrix<f64, 9, 9>) -> SMatrix<f64, 9, 9> {
    let mut square = SMatrix::<f64, 9, 9>::zeros();
    for j in 0..9 {
        for i in 0..=j {
            let entry = m.column(i).dot(&m.column(j));
            square[(i, j)] = entry;
            square[(j, i)] = entry;
        }
    }
    square
}
