//! Hand-eye calibration as a Procrustes problem in four dimensions.
//!
//! A rigid transform is taken for a rotation of four-space,
//!
//! ```text
//! T ↦ [ R        t/d ]
//!     [ -tᵀR/d   1   ]          d large,
//! ```
//!
//! and a rotation of four-space is a left and a right multiplication by unit quaternions. `A X = X B`
//! then splits into one eigenvalue problem for each of the two quaternions of `X`,
//! `Σ |Q(a) x - W(b) x|² → min`, with the projections of the motions on left multiplications,
//!
//! ```text
//! a = (cos²(θ/2),  sin θ n/2 + (t + Rᵀt)/4d)
//! ```
//!
//! and likewise, with `-d`, on the right. Both are solved here in the limit of large `d`: with
//! `ε = 1/d` a dual number, both quaternions are the two signs of one `x₀ + ε x₁`, where `x₁` is
//! the first-order change of the eigenvector, and `t_X = 2 vec(x₁ x₀*)`. No sign of a quaternion
//! occurs. All motions between up to 17 captures are used, of more those from each to 16 others.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone; motions near half turns
//! weigh nothing, as `a` vanishes with the cosine of half the angle.
//!
//! J. Wu, Y. Sun, M. Wang and M. Liu, *Hand-eye calibration: 4-D Procrustes analysis approach*,
//! IEEE T-IM 69(6), 2020.

use nalgebra::{Matrix4, Vector3, Vector4};

use super::{
    daniilidis::from_dual,
    moments::{self, Seen},
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

/// Motions from each of many captures.
const PARTNERS: usize = 16;

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let (form, change) = forms(&all);
    let (values, vectors) = jacobi::eigen(&form);
    let least = values[3];
    let x_0 = vectors.column(3).into_owned();
    if !(values[2] - least > jacobi::NO_GAP * values[0]) {
        return Err(open("the rotations between captures do not fix the camera's rotation"));
    }
    let push = change * x_0;
    let x_1: Vector4<f64> = (0..3)
        .map(|k| vectors.column(k) * (vectors.column(k).dot(&push) / (least - values[k])))
        .sum();
    // 2 vec(x₁ x₀*) is the position of the dual quaternion x₀ + ε x₁
    Ok(place(pairs, from_dual(&x_0, &x_1)))
}

/// `Σ (Q(a) - W(b))ᵀ (Q(a) - W(b))` and its derivative by `1/d`.
fn forms(all: &[Seen]) -> (Matrix4<f64>, Matrix4<f64>) {
    let n = all.len();
    let (mut form, mut change) = (Matrix4::zeros(), Matrix4::zeros());
    let mut add = |i: &Seen, j: &Seen| {
        let (a, a_1) = projection(&moments::motion(&i.a, &i.t_a, &j.a, &j.t_a));
        let (b, b_1) = projection(&moments::motion(&i.b, &i.t_b, &j.b, &j.t_b));
        let g = moments::left(&a) - moments::right(&b);
        let g_1 = moments::left(&a_1) - moments::right(&b_1);
        form += g.transpose() * g;
        change += g.transpose() * g_1;
    };
    if n <= PARTNERS + 1 {
        (1..n).for_each(|j| (0..j).for_each(|i| add(&all[i], &all[j])));
    } else {
        let other = |i: usize, k: usize| (i + 1 + k * (n - 1) / PARTNERS) % n;
        (0..n).for_each(|i| (0..PARTNERS).for_each(|k| add(&all[i], &all[other(i, k)])));
    }
    (form, change + change.transpose())
}

/// The left quaternion of a motion in four-space, and its derivative by `1/d`.
fn projection((q, t): &(Vector4<f64>, Vector3<f64>)) -> (Vector4<f64>, Vector4<f64>) {
    let middle = (t + moments::matrix(q).transpose() * t) * 0.25;
    (q * q[0], Vector4::new(0.0, middle.x, middle.y, middle.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_projection_is_that_of_the_rotation_of_four_space() {
        let (q, t) = (Vector4::new(0.5, -0.7, 0.1, 0.5), Vector3::new(0.3, -0.2, 0.4));
        let (q, inverse_d) = (q.normalize(), 1e-7);
        let mut four = Matrix4::identity(); // scalar first
        four.fixed_view_mut::<3, 3>(1, 1).copy_from(&moments::matrix(&q));
        four.fixed_view_mut::<3, 1>(1, 0).copy_from(&(t * inverse_d));
        let low = -(moments::matrix(&q).transpose() * t) * inverse_d;
        four.fixed_view_mut::<1, 3>(0, 1).copy_from(&low.transpose());
        let (a, a_1) = projection(&(q, t));
        for k in 0..4 {
            let along = moments::left(&Vector4::ith(k, 1.0)).dot(&four) / 4.0;
            assert!((along - a[k] - a_1[k] * inverse_d).abs() < 1e-13);
        }
    }
}
