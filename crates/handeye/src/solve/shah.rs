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
//! are the leading singular vectors of `Σ R_B ⊗ R_A`. Translation then is linear least squares.
//!
//! M. Shah, *Solving the robot-world/hand-eye calibration problem using the Kronecker product*,
//! J. Mechanisms and Robotics 5(3), 2013.

use nalgebra::{DMatrix, Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use super::isometry;
use crate::{Error, HandEye, Pose, PosePair, linalg};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let (r_x, r_y) = rotations(pairs)?;
    let (t_x, t_y) = translations(pairs, &r_y)?;
    Ok(HandEye {
        mount_from_camera: Pose::claim(isometry(&r_x, t_x)),
        anchor_from_target: Pose::claim(isometry(&r_y, t_y)),
    })
}

fn rotations(pairs: &[PosePair]) -> Result<(Matrix3<f64>, Matrix3<f64>), Error> {
    let k: SMatrix<f64, 9, 9> = pairs.iter().map(|p| p.r_b().kronecker(&p.r_a())).sum();
    let svd = linalg::svd(&DMatrix::from_column_slice(9, 9, k.as_slice()));
    let x = Matrix3::from_column_slice(svd.v.column(0).into_owned().as_slice());
    let y = Matrix3::from_column_slice(svd.u.column(0).into_owned().as_slice());
    // A singular pair is known up to one common sign: take the one that makes rotations.
    let sign = x.determinant().signum();
    let rotation = |m: Matrix3<f64>| {
        linalg::nearest_rotation(&(m * sign))
            .ok_or(Error::NotDetermined { what: "the rotations do not fix the camera's".into() })
    };
    Ok((rotation(x)?, rotation(y)?))
}

/// `R_A t_X - t_Y = R_Y t_B - t_A`, by its normal equations: they are well conditioned, since both
/// unknowns are lengths and all coefficients are rotations.
pub(super) fn translations(
    pairs: &[PosePair],
    r_y: &Matrix3<f64>,
) -> Result<(Vector3<f64>, Vector3<f64>), Error> {
    // a common offset of t_A only moves t_Y: taking it out keeps digits when the base is far
    let offset = pairs.iter().map(PosePair::t_a).sum::<Vector3<f64>>() / pairs.len() as f64;
    let (mut normal, mut rhs) = (Matrix6::zeros(), Vector6::zeros());
    for pair in pairs {
        let mut row = SMatrix::<f64, 3, 6>::zeros();
        row.fixed_view_mut::<3, 3>(0, 0).copy_from(&pair.r_a());
        row.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Matrix3::identity());
        normal += row.transpose() * row;
        rhs += row.transpose() * (r_y * pair.t_b() - (pair.t_a() - offset));
    }
    let inverse = linalg::invert_spd(&normal).ok_or(Error::NotDetermined {
        what: "the motions do not fix the camera's position".into(),
    })?;
    let mut t = inverse * rhs;
    t += inverse * (rhs - normal * t);
    let half = |k| Vector3::new(t[k], t[k + 1], t[k + 2]);
    Ok((half(0), half(3) + offset))
}
