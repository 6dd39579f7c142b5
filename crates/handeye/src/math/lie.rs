//! Exponential, logarithm, adjoint and Jacobians of SO(3) and SE(3).
//!
//! A tangent vector of SE(3) is `ξ = (ω, v)`, rotation (rad) first, then translation (m).
//! With `θ = |ω|` and `[ω]ₓ` the cross-product matrix,
//!
//! ```text
//! exp(ω)    = I + sin θ/θ [ω]ₓ + (1 - cos θ)/θ² [ω]ₓ²
//! exp(ω, v) = (exp(ω), J_l(ω) v)                       J_l(ω) = ∫₀¹ exp(sω) ds
//! ```
//!
//! T. Barfoot, *State Estimation for Robotics*, 2nd ed. 2024, chapter 8; the coupling block `Q` of
//! the SE(3) Jacobian is his (8.91), with the tangent's halves swapped.

use nalgebra::{Isometry3, Matrix3, Matrix6, Translation3, UnitQuaternion, Vector3, Vector6};

/// Below this angle (rad) series replace closed forms, whose terms would cancel.
const SMALL_ANGLE: f64 = 1e-3;

/// `[v]ₓ`, with `[v]ₓ w = v × w`.
pub fn hat(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// Rotation half of a tangent vector.
pub fn omega(xi: &Vector6<f64>) -> Vector3<f64> {
    Vector3::new(xi[0], xi[1], xi[2])
}

/// Translation half of a tangent vector.
pub fn nu(xi: &Vector6<f64>) -> Vector3<f64> {
    Vector3::new(xi[3], xi[4], xi[5])
}

/// Tangent vector from its rotation and translation halves.
pub fn tangent(omega: &Vector3<f64>, nu: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(omega.x, omega.y, omega.z, nu.x, nu.y, nu.z)
}

/// `exp` of SE(3).
pub fn exp(xi: &Vector6<f64>) -> Isometry3<f64> {
    let w = omega(xi);
    let translation = so3_left_jacobian(&w) * nu(xi);
    Isometry3::from_parts(Translation3::from(translation), so3_exp(&w))
}

/// `log` of SE(3); the rotation's angle is in `[0, π]`.
pub fn log(pose: &Isometry3<f64>) -> Vector6<f64> {
    let w = so3_log(&pose.rotation);
    tangent(&w, &(so3_left_jacobian_inverse(&w) * pose.translation.vector))
}

/// `exp` of SO(3).
pub(crate) fn so3_exp(w: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(*w)
}

/// `log` of SO(3): axis times angle, the angle in `[0, π]`. Exact for half turns.
pub(crate) fn so3_log(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (v, w) = (rotation.imag(), rotation.w);
    let (v, w) = if w < 0.0 { (-v, -w) } else { (v, w) };
    let sine = v.norm(); // of half the angle
    if sine < 1e-10 { v * 2.0 } else { v * (2.0 * sine.atan2(w) / sine) }
}

/// Angle (rad, in `[0, π]`) between two rotations.
pub fn angle(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    let between = a.inverse() * b;
    2.0 * between.imag().norm().atan2(between.w.abs())
}

/// `Ad(T)`, with `T exp(ξ) T⁻¹ = exp(Ad(T) ξ)`: `[[R, 0], [[t]ₓ R, R]]`.
pub fn adjoint(pose: &Isometry3<f64>) -> Matrix6<f64> {
    let r = pose.rotation.to_rotation_matrix().into_inner();
    blocks(&r, &Matrix3::zeros(), &(hat(&pose.translation.vector) * r), &r)
}

/// `J_l(ω)` of SO(3): `exp(ω + δ) ≈ exp(J_l(ω) δ) exp(ω)`.
pub(crate) fn so3_left_jacobian(w: &Vector3<f64>) -> Matrix3<f64> {
    let theta2 = w.norm_squared();
    let theta = theta2.sqrt();
    let (a, b) = if theta < SMALL_ANGLE {
        (0.5 - theta2 / 24.0, 1.0 / 6.0 - theta2 / 120.0)
    } else {
        ((1.0 - theta.cos()) / theta2, (theta - theta.sin()) / (theta2 * theta))
    };
    let k = hat(w);
    Matrix3::identity() + a * k + b * k * k
}

/// `J_l(ω)⁻¹` of SO(3), for angles up to and including `π`.
pub(crate) fn so3_left_jacobian_inverse(w: &Vector3<f64>) -> Matrix3<f64> {
    let theta2 = w.norm_squared();
    let theta = theta2.sqrt();
    let c = if theta < SMALL_ANGLE {
        1.0 / 12.0 + theta2 / 720.0
    } else {
        // (1 + cos θ) / (2 θ sin θ) written by half angles: no 0/0 at θ = π
        (1.0 - 0.5 * theta * (0.5 * theta).cos() / (0.5 * theta).sin()) / theta2
    };
    // K² = w wᵀ - θ² I
    Matrix3::identity() * (1.0 - c * theta2) - 0.5 * hat(w) + w * (c * w).transpose()
}

/// `J_l(ξ)⁻¹` of SE(3).
pub(crate) fn left_jacobian_inverse(xi: &Vector6<f64>) -> Matrix6<f64> {
    let j = so3_left_jacobian_inverse(&omega(xi));
    blocks(&j, &Matrix3::zeros(), &(-j * coupling(xi) * j), &j)
}

/// `ad(ξ)` of SE(3): `J_r(ξ)⁻¹ = J_l(ξ)⁻¹ + ad(ξ)`.
pub(crate) fn ad(xi: &Vector6<f64>) -> Matrix6<f64> {
    let k = hat(&omega(xi));
    blocks(&k, &Matrix3::zeros(), &hat(&nu(xi)), &k)
}

/// The block `Q(ω, v)` that couples rotation into translation. With `K = [ω]ₓ`, `P = [v]ₓ` and `d = ω·v`, products of
/// three and four of them are shorter: `KPK = -d K`, `K²P + PK² = -θ² P - d K`, `KPK² + K²PK = -2d K²`.
fn coupling(xi: &Vector6<f64>) -> Matrix3<f64> {
    let (w, v) = (omega(xi), nu(xi));
    let (k, p, d) = (hat(&w), hat(&v), w.dot(&v));
    let theta2 = w.norm_squared();
    let theta = theta2.sqrt();
    let (a, b, c) = if theta < 1e-2 {
        (1.0 / 6.0 - theta2 / 120.0, 1.0 / 24.0 - theta2 / 720.0, 1.0 / 120.0 - theta2 / 2520.0)
    } else {
        let (s, cos) = theta.sin_cos();
        let theta4 = theta2 * theta2;
        (
            (theta - s) / (theta2 * theta),
            (0.5 * theta2 + cos - 1.0) / theta4,
            0.5 * (2.0 * theta - 3.0 * s + theta * cos) / (theta4 * theta),
        )
    };
    let crossed = w * v.transpose() + v * w.transpose() - Matrix3::from_diagonal_element(2.0 * d);
    let squared = w * w.transpose() - Matrix3::from_diagonal_element(theta2);
    p * (0.5 - b * theta2) + k * (d * (2.0 * b - a)) + crossed * a - squared * (2.0 * c * d)
}

/// `J_l(ξ)⁻¹ Ad(T)`: both have two blocks alike and one of zeros.
pub(crate) fn left_jacobian_inverse_after(
    xi: &Vector6<f64>,
    pose: &Isometry3<f64>,
) -> Matrix6<f64> {
    let j = so3_left_jacobian_inverse(&omega(xi));
    let r = pose.rotation.to_rotation_matrix().into_inner();
    let turned = j * r;
    let moved = j * (hat(&pose.translation.vector) * r - coupling(xi) * turned);
    blocks(&turned, &Matrix3::zeros(), &moved, &turned)
}

fn blocks(a: &Matrix3<f64>, b: &Matrix3<f64>, c: &Matrix3<f64>, d: &Matrix3<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(a);
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(b);
    m.fixed_view_mut::<3, 3>(3, 0).copy_from(c);
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(d);
    m
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn samples() -> Vec<Vector6<f64>> {
        let directions = [
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(0.0, -0.6, 0.8),
            Vector3::new(1.0, -2.0, 0.5).normalize(),
        ];
        let angles = [0.0, 1e-9, 1e-5, 9.9e-4, 1.1e-3, 9.9e-3, 1.1e-2, 0.3, 1.7, 3.0, PI - 1e-6];
        let v = Vector3::new(0.4, -0.7, 1.3);
        directions.iter().flat_map(|d| angles.iter().map(move |a| tangent(&(d * *a), &v))).collect()
    }

    #[test]
    fn log_undoes_exp() {
        for xi in samples() {
            assert!((log(&exp(&xi)) - xi).norm() < 1e-9, "{xi}");
        }
    }

    #[test]
    fn a_product_of_blocks_is_that_of_the_matrices() {
        for (xi, other) in samples().iter().zip(samples().iter().rev()) {
            let pose = exp(other);
            let whole = left_jacobian_inverse(xi) * adjoint(&pose);
            assert!((left_jacobian_inverse_after(xi, &pose) - whole).norm() < 1e-12 * whole.norm());
        }
    }

    #[test]
    fn half_turns_survive() {
        for axis in
            [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(1.0, 1.0, 0.0).normalize()]
        {
            let pose = exp(&tangent(&(axis * PI), &Vector3::new(0.1, 0.2, 0.3)));
            let again = exp(&log(&pose));
            assert!((again.to_homogeneous() - pose.to_homogeneous()).norm() < 1e-12);
        }
    }

    #[test]
    fn adjoint_carries_tangents_across() {
        let pose = exp(&samples()[20]);
        for xi in samples() {
            let carried = exp(&(adjoint(&pose) * xi)).to_homogeneous();
            let moved = (pose * exp(&xi) * pose.inverse()).to_homogeneous();
            assert!((carried - moved).norm() < 1e-9);
        }
    }

    /// Central difference of `log(exp(ξ)⁻¹ exp(ξ + h e))`, Richardson-extrapolated.
    fn differences(
        xi: &Vector6<f64>,
        side: impl Fn(&Isometry3<f64>, &Isometry3<f64>) -> Vector6<f64>,
    ) -> Matrix6<f64> {
        let at = |h: f64| {
            let mut j = Matrix6::zeros();
            for k in 0..6 {
                let mut step = Vector6::zeros();
                step[k] = h;
                let ahead = side(&exp(xi), &exp(&(xi + step)));
                let behind = side(&exp(xi), &exp(&(xi - step)));
                j.set_column(k, &((ahead - behind) / (2.0 * h)));
            }
            j
        };
        (at(1e-4) * 4.0 - at(2e-4)) / 3.0
    }

    #[test]
    fn inverse_jacobians_invert_central_differences() {
        for xi in samples() {
            let right = differences(&xi, |a, b| log(&a.inv_mul(b)));
            let left = differences(&xi, |a, b| log(&(b * a.inverse())));
            let inverse = left_jacobian_inverse(&xi);
            assert!((inverse * left - Matrix6::identity()).norm() < 1e-6, "left at {xi}");
            let inverse = inverse + ad(&xi);
            assert!((inverse * right - Matrix6::identity()).norm() < 1e-6, "right at {xi}");
        }
    }
}
