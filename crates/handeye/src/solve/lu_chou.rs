//! Hand-eye calibration in the eight-space of quaternions, rotation and position together.
//!
//! With `p = t x/2` beside the quaternion `x` of the camera, every motion gives eight equations,
//!
//! ```text
//! [ a - b     0     ] [ x ]
//! [ a' - b'   a - b ] [ p ] = 0          (a - b) x = a x - x b
//! ```
//!
//! linear in `(x, p)`. Least squares eliminates `p` and leaves a quadratic form of the unit vector
//! `x`. The part of `p` along `x` has no equation; the condition `xᵀp = 0` fixes it. The equations
//! of all motions, in both directions, enter through moments. The scalar parts of `a - b`, zero for
//! exact motions, are left out.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone.
//!
//! Y.-C. Lu and J. Chou, *Eight-space quaternion approach for robotic hand-eye calibration*, IEEE
//! SMC 1995.

use nalgebra::Matrix4;

use super::{
    daniilidis::{Products, from_dual},
    moments,
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let form = Products::new(&all).all_rows();
    let block = |i, j| form.fixed_view::<4, 4>(i, j).into_owned();
    let (upper, mixed, lower) = (block(0, 0), block(0, 4), block(4, 4));
    let (values, vectors) = jacobi::eigen(&lower);
    if !(values[2] - values[3] > jacobi::NO_GAP * values[0]) {
        return Err(open("the rotations between captures do not fix the camera's rotation"));
    }
    // inverse off the null vector, which is x but for noise
    let inverse = (0..3).fold(Matrix4::zeros(), |sum, k| {
        sum + vectors.column(k) * vectors.column(k).transpose() / values[k]
    });
    let (_, left) = jacobi::eigen(&(upper - mixed * inverse * mixed.transpose()));
    let x = left.column(3).into_owned();
    let p = -inverse * mixed.transpose() * x;
    Ok(place(pairs, from_dual(&x, &(p - x * x.dot(&p)))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::{
        moments::{Seen, left, motion, product, right},
        tests::{noisy_pairs, truths},
    };
    use nalgebra::{SMatrix, Vector4};

    /// Real and dual part of the motion's quaternion, without the scalar parts.
    fn dual((q, t): (Vector4<f64>, nalgebra::Vector3<f64>)) -> [Vector4<f64>; 2] {
        let dual = product(&Vector4::new(0.0, t.x, t.y, t.z), &q) * 0.5;
        [q, dual].map(|p| Vector4::new(0.0, p[1], p[2], p[3]))
    }

    #[test]
    fn moments_make_the_eight_equations_of_every_motion() {
        let all = moments::seen(&noisy_pairs(&truths()[0], 7)).unwrap();
        let form = |i: &Seen, j: &Seen| {
            let a = dual(motion(&i.a, &i.t_a, &j.a, &j.t_a));
            let b = dual(motion(&i.b, &i.t_b, &j.b, &j.t_b));
            let [real, low] = [0, 1].map(|k| left(&a[k]) - right(&b[k]));
            let mut rows = SMatrix::<f64, 8, 8>::zeros();
            rows.fixed_view_mut::<4, 4>(0, 0).copy_from(&real);
            rows.fixed_view_mut::<4, 4>(4, 0).copy_from(&low);
            rows.fixed_view_mut::<4, 4>(4, 4).copy_from(&real);
            rows.transpose() * rows
        };
        let motions = (1..all.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
        let one_by_one: SMatrix<f64, 8, 8> = motions.map(|(i, j)| form(&all[i], &all[j])).sum();
        let by_moments = Products::new(&all).all_rows();
        assert!((by_moments - one_by_one).norm() < 1e-12 * one_by_one.norm());
    }
}
